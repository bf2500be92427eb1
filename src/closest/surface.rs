//! A closed surface of points of the difference, from which the depth is read.
//!
//! It begins as a tetrahedron and takes in points one by one: what a new point sees is replaced by a fan
//! from it. So it stays closed and bends outward, and each triangle knows the three across its sides. The
//! places of triangles that are gone are filled again.

use std::cell::Cell;

use super::cache::{Packed, PairCache};
use super::pair::{Difference, Ids};
use super::simplex::{Closest, Simplex, triangle_normal};
use super::vector::Vec3;
use crate::math::double_double::{DoubleDouble, Real};

/// Points are remembered that have a triangle within this many depths [-]. Larger: more points to take in
/// again each time; smaller: more to find.
const CORE_REACH: f64 = 1.1;
/// Part of the sphere about the origin that a triangle may hide whose orientation is rounding [sr]: a
/// thousand of them stay far below the whole. Larger: a surface may be said to go around the origin that does not.
/// Smaller: more overlaps are repeated in double-double.
const HIDDEN: f64 = 1e-6;
/// How far below a triangle's plane a point may be and still lie on it, as a part of its distance from the origin, in
/// units of rounding [-]: the heights of both are right to some 8. Larger: what is a little sharp is taken for flat,
/// and a fan may lie below what it replaced. Smaller: a fan may fold back onto a triangle on its own plane.
const ON_PLANE: f64 = 16.0;
/// Of so many points the first are looked at when a surface is packed [-].
const LOOKED_AT: usize = 64;

#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle<R> {
    pub(super) corners: [u32; 3],
    across: [u32; 3],
    pub(super) normal: Vec3<R>,
    /// Distance from the origin of the lowest and of the highest corner, along the normal [m].
    pub(super) distance: R,
    top: R,
    /// Whether its normal has been tried in vain.
    pub(super) stuck: bool,
    alive: bool,
}

/// The surface, and the room to work in.
#[derive(Debug, Clone)]
pub(super) struct Surface<R> {
    pub(super) ids: Vec<Ids>,
    pub(super) points: Vec<Vec3<R>>,
    pub(super) triangles: Vec<Triangle<R>>,
    /// Whether the triangles know what is across their sides.
    linked: bool,
    /// Places of triangles that are gone.
    free: Vec<u32>,
    /// What a point sees, the sides around that, and for each point the fan's triangle that begins there.
    patch: Vec<u32>,
    rim: Vec<Rim>,
    fan: Vec<u32>,
}

/// A side of what a point sees: from one corner to the next, and the triangle across.
#[derive(Debug, Clone, Copy)]
struct Rim {
    from: u32,
    to: u32,
    beyond: u32,
}

impl<R> Surface<R> {
    const fn new() -> Self {
        Self {
            ids: Vec::new(),
            points: Vec::new(),
            triangles: Vec::new(),
            linked: true,
            free: Vec::new(),
            patch: Vec::new(),
            rim: Vec::new(),
            fan: Vec::new(),
        }
    }
}

impl<R> Default for Surface<R> {
    fn default() -> Self {
        Self::new()
    }
}

/// Numbers that surfaces are made in.
pub(super) trait Workshop: Real {
    /// Lends a surface to work on, whatever it holds.
    fn with_surface<T>(work: impl FnOnce(&mut Surface<Self>) -> T) -> T;
}

thread_local! {
    /// A surface that has been worked on in this thread: its memory serves the next one.
    static USED: Cell<Surface<f64>> = const { Cell::new(Surface::new()) };
}

impl Workshop for f64 {
    fn with_surface<T>(work: impl FnOnce(&mut Surface<f64>) -> T) -> T {
        let mut surface = USED.take();
        let made = work(&mut surface);
        USED.set(surface);
        made
    }
}

impl Workshop for DoubleDouble {
    fn with_surface<T>(work: impl FnOnce(&mut Surface<Self>) -> T) -> T {
        work(&mut Surface::new())
    }
}

/// The pairs of vertices that an inner polytope was grown from, the most useful ones.
pub(super) type Core = ([Ids; PairCache::CAPACITY], usize);

impl<R: Real> Surface<R> {
    fn clear(&mut self) {
        self.ids.clear();
        self.points.clear();
        self.triangles.clear();
        self.free.clear();
        self.fan.clear();
        self.linked = true;
    }

    /// Begins anew.
    pub(super) fn begin(&mut self, corners: &Simplex<R>) {
        self.clear();
        self.ids.extend(corners.ids);
        self.points.extend(corners.points);
        self.fan.extend([u32::MAX; 4]);

        // counterclockwise seen from outside
        let p = &self.points;
        let top = triangle_normal(&p[0], &p[1], &p[2]).dot(&(p[3] - p[0]));
        let faces = if top < R::from(0.0) {
            [([0, 1, 2], [3, 1, 2]), ([1, 3, 2], [3, 2, 0]), ([2, 3, 0], [1, 3, 0]), ([0, 3, 1], [2, 1, 0])]
        } else {
            [([0, 2, 1], [2, 1, 3]), ([1, 2, 3], [0, 2, 3]), ([2, 0, 3], [0, 3, 1]), ([0, 1, 3], [0, 1, 2])]
        };
        for (corners, across) in faces {
            let triangle = self.triangle(corners, across);
            self.triangles.push(triangle);
        }
    }

    /// Begins with a surface that was remembered. It is closed, whatever the poses are by now; it may be
    /// dented, or not go around the origin.
    pub(super) fn restore(&mut self, pair: &impl Difference<R>, packed: &Packed) {
        self.clear();
        for ids in packed.ids() {
            self.ids.push(ids);
            self.points.push(pair.difference(ids));
        }
        self.fan.resize(self.points.len(), u32::MAX);
        for corners in packed.triangles() {
            let triangle = self.triangle(corners, [u32::MAX; 3]);
            self.triangles.push(triangle);
        }
        self.linked = false;
    }

    /// Tells the triangles of a restored surface what is across their sides.
    fn link(&mut self) {
        let mut owner = [[0; Packed::POINTS]; Packed::POINTS];
        for (k, t) in (0..).zip(&self.triangles) {
            for side in 0..3 {
                owner[t.corners[side] as usize][t.corners[(side + 1) % 3] as usize] = k;
            }
        }
        for t in &mut self.triangles {
            t.across = [0, 1, 2].map(|side| owner[t.corners[(side + 1) % 3] as usize][t.corners[side] as usize]);
        }
        self.linked = true;
    }

    /// The surface to remember, if it is small enough.
    pub(super) fn pack(&self) -> Option<Packed> {
        let alive = || self.triangles.iter().filter(|t| t.alive);
        let (mut place_of, mut ids) = ([u32::MAX; LOOKED_AT], [[0; 2]; Packed::POINTS]);
        if self.ids.len() > place_of.len() {
            return None;
        }
        alive().for_each(|t| t.corners.iter().for_each(|&k| place_of[k as usize] = 0));
        let mut count = 0;
        for (place, &pair) in place_of.iter_mut().zip(&self.ids).filter(|(place, _)| **place == 0) {
            *ids.get_mut(count)? = pair;
            *place = u32::try_from(count).ok()?;
            count += 1;
        }
        Packed::of(&ids[..count], alive().map(|t| t.corners.map(|k| place_of[k as usize])))
    }

    #[inline]
    fn triangle(&self, corners: [u32; 3], across: [u32; 3]) -> Triangle<R> {
        let [a, b, c] = corners.map(|k| self.points[k as usize]);
        let n = triangle_normal(&a, &b, &c);
        let length = n.norm();
        if length == R::from(0.0) {
            let (normal, alive) = (Vec3::zero(), true);
            let mut flat = Triangle { corners, across, normal, distance: length, top: length, stuck: true, alive };
            self.close_up(&mut flat);
            return flat;
        }
        let normal = n.scaled(R::from(1.0) / length);
        let heights = [normal.dot(&a), normal.dot(&b), normal.dot(&c)];
        let (distance, top) = (least(heights), most(heights));
        Triangle { corners, across, normal, distance, top, stuck: false, alive: true }
    }

    /// The first four points, which span space, and up to `most` in all of those on the surface: the last of
    /// those that have a triangle near the way out. What is farther is soon found again.
    pub(super) fn core(&self, most: usize) -> Core {
        let mut core = [[0; 2]; PairCache::CAPACITY];
        let first = self.ids.len().min(4);
        core[..first].copy_from_slice(&self.ids[..first]);
        let mut count = first;
        let Some(nearest) = self.nearest() else { return (core, count) };
        let limit = self.triangles[nearest].distance * R::from(CORE_REACH);
        let mut near = 0u64;
        for t in self.triangles.iter().filter(|t| t.alive && t.distance <= limit) {
            near |= t.corners.iter().filter(|&&k| k < u64::BITS).fold(0, |set, &k| set | 1 << k);
        }
        for k in (first..self.ids.len().min(u64::BITS as usize)).rev() {
            if count < most && near >> k & 1 == 1 {
                core[count] = self.ids[k];
                count += 1;
            }
        }
        core[first..count].reverse();
        (core, count)
    }

    /// The triangle nearest to the origin.
    pub(super) fn nearest(&self) -> Option<usize> {
        let mut best: Option<(usize, R)> = None;
        for (k, t) in self.triangles.iter().enumerate() {
            if t.alive && best.is_none_or(|b| t.distance < b.1) {
                best = Some((k, t.distance));
            }
        }
        best.map(|b| b.0)
    }

    /// The point of a triangle closest to the origin.
    fn witness(&self, triangle: usize) -> (Simplex<R>, Vec3<R>) {
        let mut simplex = self.simplex(self.triangles[triangle].corners);
        let point = match simplex.reduce() {
            Closest::At { point, .. } => point,
            Closest::Inside => simplex.point(),
        };
        (simplex, point)
    }

    fn simplex(&self, corners: [u32; 3]) -> Simplex<R> {
        let mut simplex = Simplex::empty();
        for k in corners {
            simplex.push(self.ids[k as usize], self.points[k as usize]);
        }
        simplex
    }

    /// Of the triangles on the nearest one's plane, that which the origin lies over.
    pub(super) fn nearest_witness(&self, nearest: usize, gap: R) -> (Simplex<R>, Vec3<R>) {
        let mut best = self.witness(nearest);
        let Triangle { normal, distance, .. } = self.triangles[nearest];
        let limit = distance + gap + gap;
        if best.1.norm() <= limit {
            return best;
        }
        for (k, t) in self.triangles.iter().enumerate() {
            // the foot's own triangle is as far as the foot; a sliver's distance says less than its corners
            let lies_low = || t.corners.iter().all(|&k| normal.dot(&self.points[k as usize]) >= distance - gap);
            if k != nearest && t.alive && t.distance <= limit && lies_low() {
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
    pub(super) fn measure_closely(&mut self, triangle: usize) {
        let mut copy = Triangle { stuck: true, ..self.triangles[triangle] };
        self.close_up(&mut copy);
        self.triangles[triangle] = copy;
    }

    /// The best of the normals through the closest point. One that turns the triangle over counts only where
    /// the triangle hides next to nothing of the sphere: else what faces the origin would count as facing
    /// away, and a surface as going around.
    fn close_up(&self, t: &mut Triangle<R>) {
        let Closest::At { point, normal } = self.simplex(t.corners).reduce() else { return };
        let [a, b, c] = t.corners.map(|k| self.points[k as usize]);
        let area = triangle_normal(&a, &b, &c).norm();
        for n in [point, normal] {
            let length = n.norm();
            if length == R::from(0.0) {
                continue;
            }
            let n = n.scaled(R::from(1.0) / length);
            let heights = [n.dot(&a), n.dot(&b), n.dot(&c)];
            let distance = least(heights);
            let is_oriented = n.dot(&t.normal) > R::from(0.0) || area <= R::from(HIDDEN) * distance * distance;
            if is_oriented && (distance > t.distance || t.normal == Vec3::zero()) {
                (t.normal, t.distance, t.top) = (n, distance, most(heights));
            }
        }
    }

    /// Replaces what a new point sees by a fan from it; false if rounding tore the rim.
    pub(super) fn expand(&mut self, first: usize, ids: Ids, point: Vec3<R>) -> bool {
        if !self.linked {
            self.link();
        }
        let apex = u32::try_from(self.points.len()).unwrap_or(u32::MAX);
        self.ids.push(ids);
        self.points.push(point);
        self.fan.push(u32::MAX);

        // the visible patch and its rim
        self.patch.clear();
        self.rim.clear();
        self.patch.push(u32::try_from(first).unwrap_or(u32::MAX));
        self.triangles[first].alive = false;
        let near = point.norm() * R::from(ON_PLANE * R::UNIT);
        let mut k = 0;
        while k < self.patch.len() {
            let Triangle { corners, across, .. } = self.triangles[self.patch[k] as usize];
            for side in 0..3 {
                let ends = [corners[side], corners[(side + 1) % 3]].map(|k| self.points[k as usize]);
                let beyond = &mut self.triangles[across[side] as usize];
                if !beyond.alive {
                    continue;
                }
                if beyond.sees(&point) || beyond.is_folded_onto(&point, &ends, near) {
                    beyond.alive = false;
                    self.patch.push(across[side]);
                } else {
                    self.rim.push(Rim { from: corners[side], to: corners[(side + 1) % 3], beyond: across[side] });
                }
            }
            k += 1;
        }
        // what was kept across one side may have gone across another
        self.rim.retain(|rim| self.triangles[rim.beyond as usize].alive);
        self.free.extend_from_slice(&self.patch);

        // the fan: its triangles follow one another around the rim, which is one loop or is refused
        let mut whole = self.rim.len() >= 3;
        for k in 0..self.rim.len() {
            let Rim { from, to, beyond } = self.rim[k];
            let triangle = self.triangle([from, to, apex], [beyond, u32::MAX, u32::MAX]);
            let place = if let Some(place) = self.free.pop() {
                self.triangles[place as usize] = triangle;
                place
            } else {
                self.triangles.push(triangle);
                u32::try_from(self.triangles.len() - 1).unwrap_or(u32::MAX)
            };
            let other = &mut self.triangles[beyond as usize];
            for side in 0..3 {
                if other.corners[side] == to && other.corners[(side + 1) % 3] == from {
                    other.across[side] = place;
                }
            }
            whole &= self.fan[from as usize] == u32::MAX;
            self.fan[from as usize] = place;
        }
        for &Rim { from, to, .. } in &self.rim {
            let (me, after) = (self.fan[from as usize], self.fan[to as usize]);
            if after == u32::MAX {
                whole = false;
                continue;
            }
            self.triangles[me as usize].across[1] = after;
            self.triangles[after as usize].across[2] = me;
        }
        for rim in &self.rim {
            self.fan[rim.from as usize] = u32::MAX;
        }
        whole
    }

    /// Takes in a point of the difference, if it is outside; false if rounding tore the rim.
    pub(super) fn take_in(&mut self, ids: Ids, point: Vec3<R>) -> bool {
        let seen = self.triangles.iter().position(|t| t.alive && t.sees(&point));
        seen.is_none_or(|first| self.expand(first, ids, point))
    }
}

impl<R: Real> Triangle<R> {
    /// Whether a point is strictly above all corners.
    #[inline]
    fn sees(&self, point: &Vec3<R>) -> bool {
        self.normal.dot(point) > self.top
    }

    /// Whether a point lies on the triangle's plane, to a height of `near`, and on the triangle's side of this side of
    /// it: a triangle between them would lie on this one, face down.
    #[inline]
    fn is_folded_onto(&self, point: &Vec3<R>, [from, to]: &[Vec3<R>; 2], near: R) -> bool {
        self.normal.dot(point) > self.top - near && self.normal.dot(&triangle_normal(from, to, point)) < R::from(0.0)
    }
}

/// The largest of three numbers.
#[inline]
fn most<R: Real>([a, b, c]: [R; 3]) -> R {
    let ab = if a > b { a } else { b };
    if ab > c { ab } else { c }
}

/// The least of three numbers.
#[inline]
fn least<R: Real>([a, b, c]: [R; 3]) -> R {
    let ab = if a < b { a } else { b };
    if ab < c { ab } else { c }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seen from the origin, a tetrahedron beside it has faces that look at it. Measured through its closest
    /// point, such a face must not come out as facing away: the surface would count as going around.
    #[test]
    fn a_face_towards_the_origin_is_never_turned_over() {
        let mut simplex = Simplex::empty();
        for (k, p) in (0..).zip([[1.0, 0.25, 0.0], [2.0, 1.0, 0.0], [2.0, -1.0, 0.0], [2.0, 0.0, 1.0]]) {
            simplex.push([k, k], Vec3(p));
        }
        let mut surface = Surface::new();
        surface.begin(&simplex);
        let towards: Vec<usize> = (0..4).filter(|&k| surface.triangles[k].distance < 0.0).collect();
        assert!(!towards.is_empty());
        for k in towards {
            surface.measure_closely(k);
            assert!(surface.triangles[k].distance < 0.0, "{:?}", surface.triangles[k]);
        }
    }

    /// What was packed comes back with its triangles, and grows as if it had never been away.
    #[test]
    fn a_restored_surface_knows_its_neighbours() {
        let mut simplex = Simplex::empty();
        for (k, p) in (0..).zip([[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]]) {
            simplex.push([k, k], Vec3(p));
        }
        let mut surface = Surface::new();
        surface.begin(&simplex);
        let across = |surface: &Surface<f64>| surface.triangles.iter().map(|t| t.across).collect::<Vec<_>>();
        let known = across(&surface);
        surface.linked = false;
        surface.link();
        assert_eq!(across(&surface), known);
        assert!(surface.take_in([4, 4], Vec3([3.0, 3.0, -3.0])));
        let packed = surface.pack().unwrap();
        assert_eq!((packed.ids().count(), packed.triangles().count()), (5, 6));
    }
}
