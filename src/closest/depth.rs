//! How deep two bodies overlap: an inner polytope of their difference, grown from the inside.
//!
//! ```text
//! depth = min over directions n of max n·w over the difference
//! ```
//!
//! A closed surface of points of the difference around the origin, each of whose triangles is at least
//! `d` from the origin, proves that the ball of radius `d` lies in the difference: depth ≥ d. A
//! direction `n` proves depth ≤ max n·w. The triangle nearest to the origin is asked for the support
//! along its normal; either both numbers meet there, or the new point replaces the triangles that it
//! sees (the expanding polytope; van den Bergen 2001). So every answer is proved complete: no face and
//! no pair of edges can hide a smaller depth.
//!
//! Distances are taken as the least `n·w` over a triangle's corners, which bounds its distance whatever
//! rounding did to `n`. The surface is closed by construction, and where all its triangles face away
//! from the origin, their solid angles are positive and sum to a whole number of spheres: it goes
//! around the origin.

use super::cache::PairCache;
use super::pair::{Difference, Ids};
use super::search::Bounds;
use super::simplex::{Closest, Simplex, triangle_normal};
use super::vector::Vec3;
use crate::math::double_double::Real;

#[derive(Debug, Clone, Copy)]
struct Triangle<R> {
    corners: [u32; 3],
    across: [u32; 3],
    normal: Vec3<R>,
    /// Distance from the origin, along the normal [m].
    distance: R,
    /// Whether its normal has been tried in vain.
    stuck: bool,
    alive: bool,
}

struct Surface<R> {
    ids: Vec<Ids>,
    points: Vec<Vec3<R>>,
    triangles: Vec<Triangle<R>>,
    /// Scratch of an expansion.
    patch: Vec<u32>,
    rim: Vec<(u32, u32, u32)>,
}

/// The pairs of vertices that an inner polytope was grown from, the most useful ones.
pub(super) type Core = ([Ids; PairCache::CAPACITY], usize);

/// The depth from a simplex that holds the origin, or touches it. The bounds are those of the negative
/// depth; the upper one holds where it is below the pair's error, for then the surface encloses the
/// origin. The normal points from A to B, against the way out. Along with them the vertices to start
/// the next query of the same pair from.
pub(super) fn depth<R: Real>(
    pair: &impl Difference<R>,
    start: &Simplex<R>,
    gap: f64,
    steps: &mut u32,
    enough: impl Fn(&Bounds<R>) -> bool,
) -> (Bounds<R>, Core) {
    let gap = R::from(gap);
    let corners = match spanning(pair, start, gap) {
        Ok(corners) => corners,
        Err(flat) => return (flat, ([[0; 2]; PairCache::CAPACITY], 0)),
    };
    let mut surface = Surface::tetrahedron(&corners);
    let bounds = grow(pair, &mut surface, gap, steps, enough);
    let bounds = bounds.unwrap_or_else(|| flat_answer(start, pair, Vec3::new([0.0, 0.0, 1.0])));
    (bounds, surface.core())
}

/// The depth from the vertices of an earlier answer; none if the bodies are apart by now or the vertices
/// do not span space.
pub(super) fn depth_again(
    pair: &impl Difference<f64>,
    core: &[Ids],
    gap: f64,
    steps: &mut u32,
    enough: impl Fn(&Bounds<f64>) -> bool,
) -> Option<(Bounds<f64>, Core)> {
    let (first, rest) = core.split_at_checked(4)?;
    let corners = pair.simplex(first);
    let p = &corners.points;
    let volume = triangle_normal(&p[0], &p[1], &p[2]).dot(&(p[3] - p[0])).abs();
    if volume <= SPANNING * pair.size() * pair.size() * pair.size() {
        return None;
    }
    let mut surface = Surface::tetrahedron(&corners);
    for &ids in rest {
        if !surface.take_in(ids, pair.difference(ids)) {
            return None;
        }
    }
    let bounds = grow(pair, &mut surface, gap, steps, enough)?;
    Some((bounds, surface.core()))
}

/// Points are remembered that have a triangle within this many depths [-]. Larger: more points to take in
/// again each time; smaller: more to find.
const CORE_REACH: f64 = 1.1;

/// Smallest volume of a remembered tetrahedron to start from, as a fraction of the size cubed [-]: the
/// corners' rounding must not turn it inside out. Smaller ones are found anew.
const SPANNING: f64 = 1e-9;

/// Grows the surface until its nearest triangle and a direction bound the depth to within the gap; none
/// if the bodies turn out to be apart.
fn grow<R: Real>(
    pair: &impl Difference<R>,
    surface: &mut Surface<R>,
    gap: R,
    steps: &mut u32,
    enough: impl Fn(&Bounds<R>) -> bool,
) -> Option<Bounds<R>> {
    let mut best: Option<Bounds<R>> = None;
    while surface.points.len() < pair.most_points() {
        *steps += 1;
        let Some(nearest) = surface.nearest() else { break };
        let Triangle { normal, distance, corners, stuck, .. } = surface.triangles[nearest];
        let (ids, low) = pair.lowest(&-normal, Some(surface.ids[corners[0] as usize]));
        if low > R::from(pair.error(0.0)) {
            return None;
        }

        // the nearest triangle and the best direction so far bound the depth; until they meet, the point
        // is the deepest along that direction
        let is_better = best.as_ref().is_none_or(|b| low > b.lower);
        if is_better && -low - distance > gap {
            let mut simplex = Simplex::empty();
            simplex.push(ids, pair.difference(ids));
            let _ = simplex.reduce();
            best = Some(Bounds { simplex, point: simplex.points[0], normal: -normal, lower: low, upper: -distance });
        }
        if let Some(b) = &mut best {
            b.upper = -distance;
            if -low - distance > gap && enough(b) {
                break;
            }
        }
        if -low - distance <= gap {
            let (simplex, point) = surface.nearest_witness(nearest, gap);
            return Some(Bounds { simplex, point, normal: -normal, lower: low, upper: -distance });
        }

        if !surface.ids.contains(&ids) {
            if !surface.expand(nearest, ids, pair.difference(ids)) {
                break;
            }
        } else if stuck {
            break;
        } else {
            surface.measure_closely(nearest);
        }
    }
    best
}

/// Four points of the difference that span space, from the given ones; or the answer, where a direction
/// is met in which the difference lies to one side of the origin.
fn spanning<R: Real>(pair: &impl Difference<R>, start: &Simplex<R>, gap: R) -> Result<Simplex<R>, Bounds<R>> {
    let mut simplex = *start;
    while simplex.count < 4 {
        // directions in which the simplex has no extent
        let p = simplex.points;
        let candidates: [Vec3<R>; 3] = match simplex.count {
            1 => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::new),
            2 => {
                let e = p[1] - p[0];
                let axis = smallest_axis(&e);
                let (u, v) = (e.cross(&axis), e.cross(&e.cross(&axis)));
                [u, v, u + v]
            }
            _ => [triangle_normal(&p[0], &p[1], &p[2]); 3],
        };

        // the farthest point on either side of what there is
        let mut farthest: Option<(R, Ids, Vec3<R>)> = None;
        for candidate in candidates {
            let length = candidate.norm();
            if length == R::from(0.0) {
                continue;
            }
            let unit = candidate.scaled(R::from(1.0) / length);
            for n in [unit, -unit] {
                let (ids, height) = pair.lowest(&n, Some(simplex.ids[0]));
                let extent = n.dot(&p[0]) - n.dot(&pair.difference(ids));
                if height >= -gap {
                    return Err(flat_answer(&simplex, pair, n));
                }
                let w = pair.difference(ids);
                let measure = match simplex.count {
                    2 => (w - p[0]).cross(&(p[1] - p[0])).norm(),
                    _ => extent,
                };
                if !simplex.contains(ids) && farthest.as_ref().is_none_or(|f| measure > f.0) {
                    farthest = Some((measure, ids, w));
                }
            }
        }
        let Some((_, ids, w)) = farthest else {
            return Err(flat_answer(&simplex, pair, Vec3::new([0.0, 0.0, 1.0])));
        };
        simplex.push(ids, w);
    }
    Ok(simplex)
}

/// The coordinate axis farthest from a direction.
fn smallest_axis<R: Real>(e: &Vec3<R>) -> Vec3<R> {
    let size = e.to_f64().map(f64::abs);
    let k = (0..3).fold(0, |best, k| if size[k] < size[best] { k } else { best });
    let mut axis = [0.0; 3];
    axis[k] = 1.0;
    Vec3::new(axis)
}

/// The answer where `n` separates the bodies to rounding.
fn flat_answer<R: Real>(simplex: &Simplex<R>, pair: &impl Difference<R>, n: Vec3<R>) -> Bounds<R> {
    let mut simplex = *simplex;
    simplex.count = simplex.count.min(3);
    let (_, lower) = pair.lowest(&n, Some(simplex.ids[0]));
    let point = match simplex.reduce() {
        Closest::At { point, .. } => point,
        Closest::Inside => simplex.points[0],
    };
    Bounds { simplex, point, normal: n, lower, upper: point.norm() }
}

impl<R: Real> Surface<R> {
    fn tetrahedron(corners: &Simplex<R>) -> Self {
        let mut surface = Self {
            ids: Vec::with_capacity(32),
            points: Vec::with_capacity(32),
            triangles: Vec::with_capacity(128),
            patch: Vec::with_capacity(16),
            rim: Vec::with_capacity(16),
        };
        surface.ids.extend(corners.ids);
        surface.points.extend(corners.points);

        // counterclockwise seen from outside
        let p = &surface.points;
        let top = triangle_normal(&p[0], &p[1], &p[2]).dot(&(p[3] - p[0]));
        let faces = if top < R::from(0.0) {
            [([0, 1, 2], [3, 1, 2]), ([1, 3, 2], [3, 2, 0]), ([2, 3, 0], [1, 3, 0]), ([0, 3, 1], [2, 1, 0])]
        } else {
            [([0, 2, 1], [2, 1, 3]), ([1, 2, 3], [0, 2, 3]), ([2, 0, 3], [0, 3, 1]), ([0, 1, 3], [0, 1, 2])]
        };
        for (corners, across) in faces {
            let triangle = surface.triangle(corners, across);
            surface.triangles.push(triangle);
        }
        surface
    }

    fn triangle(&self, corners: [u32; 3], across: [u32; 3]) -> Triangle<R> {
        let [a, b, c] = corners.map(|k| self.points[k as usize]);
        let n = triangle_normal(&a, &b, &c);
        let length = n.norm();
        if length == R::from(0.0) {
            let mut flat =
                Triangle { corners, across, normal: Vec3::zero(), distance: length, stuck: false, alive: true };
            self.close_up(&mut flat);
            return flat;
        }
        let normal = n.scaled(R::from(1.0) / length);
        let distance = least(normal.dot(&a), normal.dot(&b), normal.dot(&c));
        Triangle { corners, across, normal, distance, stuck: false, alive: true }
    }

    /// The first four points, which span space, and those of the others that have a triangle near the
    /// way out: what is farther is soon found again.
    fn core(&self) -> Core {
        let mut core = [[0; 2]; PairCache::CAPACITY];
        let first = self.ids.len().min(4);
        core[..first].copy_from_slice(&self.ids[..first]);
        let mut count = first;
        let Some(nearest) = self.nearest() else { return (core, count) };
        let limit = self.triangles[nearest].distance * R::from(CORE_REACH);
        let mut near = 0u128;
        for t in self.triangles.iter().filter(|t| t.alive && t.distance <= limit) {
            t.corners.iter().filter(|&&k| k < u128::BITS).for_each(|&k| near |= 1 << k);
        }
        for k in (first..self.ids.len().min(u128::BITS as usize)).rev() {
            if count < PairCache::CAPACITY && near >> k & 1 == 1 {
                core[count] = self.ids[k];
                count += 1;
            }
        }
        core[first..count].reverse();
        (core, count)
    }

    /// The triangle nearest to the origin.
    fn nearest(&self) -> Option<usize> {
        let mut best: Option<usize> = None;
        for (k, t) in self.triangles.iter().enumerate() {
            if t.alive && best.is_none_or(|b| t.distance < self.triangles[b].distance) {
                best = Some(k);
            }
        }
        best
    }

    /// The point of a triangle closest to the origin.
    fn witness(&self, triangle: usize) -> (Simplex<R>, Vec3<R>) {
        let mut simplex = Simplex::empty();
        for k in self.triangles[triangle].corners {
            simplex.push(self.ids[k as usize], self.points[k as usize]);
        }
        let point = match simplex.reduce() {
            Closest::At { point, .. } => point,
            Closest::Inside => simplex.point(),
        };
        (simplex, point)
    }

    /// Of the triangles on the nearest one's plane, that which the origin lies over.
    fn nearest_witness(&self, nearest: usize, gap: R) -> (Simplex<R>, Vec3<R>) {
        let mut best = self.witness(nearest);
        let limit = self.triangles[nearest].distance + gap + gap;
        if best.1.norm() <= limit {
            return best;
        }
        let Triangle { normal, distance, .. } = self.triangles[nearest];
        for (k, t) in self.triangles.iter().enumerate() {
            let [a, b, c] = t.corners.map(|k| normal.dot(&self.points[k as usize]));
            if t.alive && least(a, b, c) >= distance - gap {
                let other = self.witness(k);
                if other.1.norm_squared() < best.1.norm_squared() {
                    best = other;
                }
            }
        }
        best
    }

    /// Measures a triangle through its closest point, where its normal led nowhere: a sliver's normal is
    /// rounding, its closest point is not.
    fn measure_closely(&mut self, triangle: usize) {
        let t = &self.triangles[triangle];
        let mut copy = Triangle {
            corners: t.corners,
            across: t.across,
            normal: t.normal,
            distance: t.distance,
            stuck: true,
            alive: true,
        };
        self.close_up(&mut copy);
        self.triangles[triangle] = copy;
    }

    fn close_up(&self, t: &mut Triangle<R>) {
        let mut simplex = Simplex::empty();
        for k in t.corners {
            simplex.push(self.ids[k as usize], self.points[k as usize]);
        }
        let Closest::At { point, normal } = simplex.reduce() else { return };
        for n in [point, normal] {
            let length = n.norm();
            if length == R::from(0.0) {
                continue;
            }
            let n = n.scaled(R::from(1.0) / length);
            let [a, b, c] = t.corners.map(|k| n.dot(&self.points[k as usize]));
            let distance = least(a, b, c);
            if distance > t.distance || t.normal == Vec3::zero() {
                (t.normal, t.distance) = (n, distance);
            }
        }
    }

    /// Replaces what a new point sees by a fan from it; false if rounding tore the rim.
    fn expand(&mut self, first: usize, ids: Ids, point: Vec3<R>) -> bool {
        let apex = u32::try_from(self.points.len()).unwrap_or(u32::MAX);
        self.ids.push(ids);
        self.points.push(point);

        // the visible patch and its rim
        let (mut patch, mut rim) = (std::mem::take(&mut self.patch), std::mem::take(&mut self.rim));
        patch.clear();
        rim.clear();
        patch.push(u32::try_from(first).unwrap_or(u32::MAX));
        self.triangles[first].alive = false;
        let mut k = 0;
        while k < patch.len() {
            let Triangle { corners, across, .. } = self.triangles[patch[k] as usize];
            for side in 0..3 {
                let beyond = across[side] as usize;
                if !self.triangles[beyond].alive {
                    continue;
                }
                if self.sees(&point, beyond) {
                    self.triangles[beyond].alive = false;
                    patch.push(across[side]);
                } else {
                    rim.push((corners[side], corners[(side + 1) % 3], across[side]));
                }
            }
            k += 1;
        }

        // the fan: its triangles follow one another around the rim, which is one loop or is refused
        rim.retain(|&(_, _, beyond)| self.triangles[beyond as usize].alive);
        let base = self.triangles.len();
        let mut whole = true;
        for &(from, to, beyond) in &rim {
            let me = u32::try_from(self.triangles.len()).unwrap_or(u32::MAX);
            let triangle = self.triangle([from, to, apex], [beyond, u32::MAX, u32::MAX]);
            let other = &mut self.triangles[beyond as usize];
            for side in 0..3 {
                if other.corners[side] == to && other.corners[(side + 1) % 3] == from {
                    other.across[side] = me;
                }
            }
            self.triangles.push(triangle);
        }
        for (k, &(_, to, _)) in rim.iter().enumerate() {
            match rim.iter().position(|r| r.0 == to) {
                Some(after) if self.triangles[base + after].across[2] == u32::MAX => {
                    self.triangles[base + k].across[1] = u32::try_from(base + after).unwrap_or(u32::MAX);
                    self.triangles[base + after].across[2] = u32::try_from(base + k).unwrap_or(u32::MAX);
                }
                _ => whole = false,
            }
        }
        (self.patch, self.rim) = (patch, rim);
        whole
    }

    /// Whether a point is strictly above a triangle.
    #[inline]
    fn sees(&self, point: &Vec3<R>, triangle: usize) -> bool {
        let t = &self.triangles[triangle];
        let height = t.normal.dot(point);
        t.corners.iter().all(|&k| height > t.normal.dot(&self.points[k as usize]))
    }

    /// Takes in a point of the difference, if it is outside; false if rounding tore the rim.
    fn take_in(&mut self, ids: Ids, point: Vec3<R>) -> bool {
        if self.ids.contains(&ids) {
            return true;
        }
        let seen = (0..self.triangles.len()).find(|&k| self.triangles[k].alive && self.sees(&point, k));
        seen.is_none_or(|first| self.expand(first, ids, point))
    }
}

fn least<R: Real>(a: R, b: R, c: R) -> R {
    let ab = if a < b { a } else { b };
    if ab < c { ab } else { c }
}
