//! What a spinning body sweeps, and a direction that parts it from another.
//!
//! A body that turns steadily about its moving point stays within a solid of revolution. Cut in two by the
//! plane through that point across the axis, its halves are tight also of a rod that spins askew: its swept
//! solid is a waisted one, and the hulls of the halves are the two cones.
//!
//! ```text
//! h(d) = max z (d·u) + r |d × u|      z along the axis u, r from it, over the corners of the half
//! ```
//!
//! The halves stay where they are, whatever the angle, so that one direction may hold for many turns. It is
//! found by the method of Mitchell, Dem'yanov and Malozemov (1974) for the point of a convex set nearest to
//! the origin, which needs only the set's lowest points; half of the distance is good enough.

use super::side::Placed;
use crate::math::Vector3;

/// The solid of revolution that a body fills when it spins.
pub(super) struct Swept {
    pub(super) spin: Vector3,
    axis: Vector3,
    /// Of either half the corners that may be farthest: how far along the axis and how far from it [m]. The second
    /// is empty where cutting leaves no waist.
    halves: [Vec<[f64; 2]>; 2],
}

impl Swept {
    /// What the hull of `corners` (from the moving point, shape axes [m]) sweeps.
    pub(super) fn new(corners: &[Vector3], placed: &Placed) -> Self {
        let spin = placed.instant.angular_velocity;
        let axis = spin / spin.norm();
        let axis_body = placed.rotation.tr_mul(&axis);
        let profile = |v: &Vector3| [v.dot(&axis_body), v.cross(&axis_body).norm()];
        let whole: Vec<[f64; 2]> = corners.iter().map(profile).collect();
        let halves = Self::cut(corners, &whole, &axis_body).unwrap_or_else(|| [whole, Vec::new()]);
        Self { spin, axis, halves }
    }

    /// What the hull of `points`, each from a point of the axis [m], sweeps when it goes around the axis.
    pub(super) fn around(axis: Vector3, points: impl Iterator<Item = Vector3>) -> Self {
        let whole = points.map(|p| [p.dot(&axis), p.cross(&axis).norm()]).collect();
        Self { spin: axis, axis, halves: [whole, Vec::new()] }
    }

    /// The halves, if the body is much thinner between than its ends would have it.
    fn cut(corners: &[Vector3], whole: &[[f64; 2]], axis: &Vector3) -> Option<[Vec<[f64; 2]>; 2]> {
        if corners.len() > FEW {
            return None;
        }
        let (mut waist, mut straight) = (0.0_f64, 0.0_f64);
        for (v, &[z_v, r_v]) in corners.iter().zip(whole).filter(|(_, [z, _])| *z > 0.0) {
            for (w, &[z_w, r_w]) in corners.iter().zip(whole).filter(|(_, [z, _])| *z <= 0.0) {
                let part = z_v / (z_v - z_w);
                waist = waist.max((v + part * (w - v)).cross(axis).norm_squared());
                straight = straight.max(r_v + part * (r_w - r_v));
            }
        }
        let waist = waist.sqrt();
        if !(waist < WAIST * straight) {
            return None;
        }
        Some([false, true].map(|up| {
            let mut half: Vec<_> = whole.iter().copied().filter(|[z, _]| (*z > 0.0) == up).collect();
            half.push([0.0, waist]);
            keep_farthest(&mut half);
            half
        }))
    }

    /// Its support along `d` [m].
    pub(super) fn height(&self, d: &Vector3) -> f64 {
        let (along, from) = (d.dot(&self.axis), d.cross(&self.axis).norm());
        self.halves.iter().flatten().map(|[z, r]| z * along + r * from).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether anything is in a half.
    pub(super) fn has(&self, half: usize) -> bool {
        !self.halves[half].is_empty()
    }

    /// The point of a half that is farthest along `d`, from the moving point [m].
    pub(super) fn farthest(&self, half: usize, d: &Vector3) -> Vector3 {
        let along = d.dot(&self.axis);
        let out = d - along * self.axis;
        let from = out.norm();
        let height = |[z, r]: &[f64; 2]| z * along + r * from;
        let top = self.halves[half].iter().fold([0.0, 0.0, f64::NEG_INFINITY], |top, p| {
            let h = height(p);
            if h > top[2] { [p[0], p[1], h] } else { top }
        });
        let out = if from > 0.0 { out / from } else { out };
        top[0] * self.axis + top[1] * out
    }
}

/// Leaves of the points (z, r) only those that are farthest in some direction with r upward: the upper hull.
fn keep_farthest(points: &mut Vec<[f64; 2]>) {
    points.sort_unstable_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    let mut kept = 0;
    for k in 0..points.len() {
        let [z, r] = points[k];
        while kept > 0 {
            let [z1, r1] = points[kept - 1];
            let is_under = if kept > 1 {
                let [z0, r0] = points[kept - 2];
                (z1 - z0) * (r - r0) >= (r1 - r0) * (z - z0)
            } else {
                z1 == z
            };
            if !is_under {
                break;
            }
            kept -= 1;
        }
        points[kept] = [z, r];
        kept += 1;
    }
    points.truncate(kept);
}

/// A unit direction along which a convex set is above the origin by at least half its distance; none where no
/// direction is found along which it is above at all, or where its distance is below `least` [m]. `lowest` gives
/// its lowest point along a direction [m].
pub(super) fn parting(first: &Vector3, least: f64, lowest: &mut dyn FnMut(&Vector3) -> Vector3) -> Option<Vector3> {
    // a mean of points of the set, and their weights
    let mut points = [(lowest(first), 1.0); POINTS];
    let mut mean = points[0].0;
    let mut best = (first.dot(&mean), *first);
    for count in 1..POINTS {
        let length = mean.norm();
        if length <= least || count > 8 && best.0 <= 0.0 {
            return None;
        }
        if best.0 >= ENOUGH * length {
            break;
        }
        let n = mean / length;
        let low = lowest(&n);
        if n.dot(&low) > best.0 {
            best = (n.dot(&low), n);
        }

        // weight goes from the point that is highest to the new one, as much as brings the mean nearest
        let weighed =
            points[..count].iter().map(|(p, weight)| if *weight > 0.0 { n.dot(p) } else { f64::NEG_INFINITY });
        let high = (0..count).zip(weighed).fold((0, f64::NEG_INFINITY), |top, p| if p.1 > top.1 { p } else { top }).0;
        let way = low - points[high].0;
        let part = (-mean.dot(&way) / way.norm_squared()).min(points[high].1);
        if !(part > 0.0) {
            break;
        }
        mean += part * way;
        points[high].1 -= part;
        points[count] = (low, part);
    }
    (best.0 > 0.0).then_some(best.1)
}

/// Points that a direction is found from [-]: most need two or three.
const POINTS: usize = 12;
/// Part of the distance that is good enough [-].
const ENOUGH: f64 = 0.5;
/// A body of more corners is not cut [-]: it is hardly a rod.
const FEW: usize = 16;
/// Radius of the cut, as a part of that which the hull of the ends would have, below which it is worth its while [-].
const WAIST: f64 = 0.5;
