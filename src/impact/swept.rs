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
        if waist >= WAIST * straight {
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
        self.height_of(0, d).max(self.height_of(1, d))
    }

    /// The support of a half along `d` [m].
    pub(super) fn height_of(&self, half: usize, d: &Vector3) -> f64 {
        let (along, from) = (d.dot(&self.axis), d.cross(&self.axis).norm());
        self.halves[half].iter().map(|[z, r]| z * along + r * from).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether anything is in a half.
    pub(super) fn has(&self, half: usize) -> bool {
        !self.halves[half].is_empty()
    }

    /// A point of a half that is as good as farthest along `d`, from the moving point [m]: good for a guess, since
    /// near the axis its direction from the axis is lost in rounding.
    pub(super) fn farthest(&self, half: usize, d: &Vector3) -> Vector3 {
        let along = d.dot(&self.axis);
        let out = d - along * self.axis;
        let from = out.norm();
        let mut top = (f64::NEG_INFINITY, [0.0; 2]);
        for &[z, r] in &self.halves[half] {
            let height = z * along + r * from;
            if height > top.0 {
                top = (height, [z, r]);
            }
        }
        let [z, r] = top.1;
        let out = if from > 0.0 { out / from } else { out };
        z * self.axis + r * out
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
        if part.is_nan() || part <= 0.0 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Instant;
    use crate::math::{Matrix3, Pose, Vector3, quaternion};

    fn spinning(spin: Vector3) -> Placed {
        let instant = Instant {
            pose: Pose::identity(),
            center: Vector3::zeros(),
            velocity: Vector3::zeros(),
            angular_velocity: spin,
        };
        Placed { instant, rotation: Matrix3::identity() }
    }

    /// The corners of a rod along x and, first, of one that is not cut.
    fn bodies() -> [Vec<Vector3>; 2] {
        let corners =
            |h: [f64; 3]| (0..8).map(move |k| Vector3::from_fn(|i, _| h[i] * f64::from((k >> i & 1) * 2 - 1)));
        [corners([0.5, 0.4, 0.3]).collect(), corners([1.0, 0.02, 0.03]).collect()]
    }

    #[test]
    fn what_is_swept_holds_the_body_at_every_angle_and_no_more() {
        for (corners, spin) in bodies().iter().zip([Vector3::new(1.0, 2.0, -3.0), Vector3::new(5.0, 0.0, 5.0)]) {
            let swept = Swept::new(corners, &spinning(spin));
            let axis = spin.normalize();
            for d in [Vector3::x(), Vector3::new(0.3, -0.5, 0.8), axis, -axis, Vector3::new(-1.0, 0.2, 0.9)] {
                // of 3600 angles the best misses the top by less than 0.05°, 4e-7 of the radius
                let turned = |k: u32| quaternion::exp(&(f64::from(k) * 1.745329251994330e-3 * axis));
                let tops = (0..3600).map(turned).flat_map(|q| corners.iter().map(move |v| quaternion::rotate(&q, v)));
                let top = tops.map(|v| d.dot(&v)).fold(f64::NEG_INFINITY, f64::max);
                let height = swept.height(&d);
                assert!((-1e-14..1e-6).contains(&(height - top)), "{d}: {height} {top}");
                for half in [0, 1].into_iter().filter(|half| swept.has(*half) && d.cross(&axis).norm() > 0.1) {
                    let (point, height) = (d.dot(&swept.farthest(half, &d)), swept.height_of(half, &d));
                    assert!((point - height).abs() < 1e-14, "{d}: {point} {height}");
                }
            }
        }
    }

    #[test]
    fn a_rod_that_spins_askew_is_cut_at_its_waist_and_a_block_is_not() {
        let [block, rod] = bodies();
        assert!(!Swept::new(&block, &spinning(Vector3::new(1.0, 2.0, -3.0))).has(1));
        let swept = Swept::new(&rod, &spinning(Vector3::new(1.0, 0.0, 1.0)));
        let axis = Vector3::new(1.0, 0.0, 1.0).normalize();
        // beside the waist, within the hull of both ends, which are √½ from the axis
        let beside = 0.3 * Vector3::y();
        for (half, up) in [(0, -1.0), (1, 1.0)] {
            assert!(swept.has(half));
            let d = (Vector3::y() - up * axis).normalize();
            assert!(swept.height_of(half, &d) < d.dot(&beside) - 0.1, "half {half}");
        }
        assert!(swept.height(&Vector3::y()) > 0.7);
    }

    #[test]
    fn a_parting_direction_is_half_as_good_as_the_best_or_there_is_none() {
        let [block, rod] = bodies();
        for corners in [&block, &rod] {
            for toward in [Vector3::new(0.3, -0.5, 0.8), Vector3::new(-1.0, 0.9, 0.2), Vector3::z()] {
                for shift in [0.0, 0.9, 1.1, 2.0, 30.0] {
                    // the box, moved by so much along a direction: its distance from the origin is closed
                    let center = shift * toward;
                    let h = corners[7];
                    let distance = Vector3::from_fn(|i, _| (center[i].abs() - h[i]).max(0.0)).norm();
                    let mut lowest = |n: &Vector3| {
                        let lower = |v: &&Vector3, w: &&Vector3| n.dot(v).total_cmp(&n.dot(w));
                        center + corners.iter().min_by(lower).unwrap()
                    };
                    let found = parting(&-Vector3::x(), 0.0, &mut lowest);
                    if distance == 0.0 {
                        assert!(found.is_none(), "{toward} {shift}");
                    } else if let Some(n) = found {
                        let height = n.dot(&lowest(&n));
                        assert!(height > 0.0 && height <= distance + 1e-15, "{toward} {shift}: {height} {distance}");
                        assert!(distance < 0.1 || height >= 0.5 * distance, "{toward} {shift}: {height} {distance}");
                    } else {
                        assert!(distance < 0.1, "{toward} {shift}: {distance}");
                    }
                    assert!(parting(&-Vector3::x(), distance + 35.0, &mut lowest).is_none());
                }
            }
        }
    }
}
