//! The point of a simplex that is closest to the origin.
//!
//! A simplex of the difference is up to four of its points `w`. The closest point `p = Σ λ w` lies on
//! the smallest of its faces whose Voronoi region holds the origin; what does not carry a weight is
//! dropped. The direction `n` handed on is normal to what is left, taken from its sides rather than
//! from `p`: near contact `p` is short and its direction all rounding, the sides are not.

use super::pair::Ids;
use super::vector::Vec3;
use crate::math::double_double::Real;

/// Up to four points of the difference with their vertices and weights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Simplex<R> {
    pub(super) count: usize,
    pub(super) ids: [Ids; 4],
    pub(super) points: [Vec3<R>; 4],
    pub(super) weights: [R; 4],
}

/// Where the origin is.
pub(super) enum Closest<R> {
    /// Outside or on the border: the closest point and a normal there, not of unit length.
    At { point: Vec3<R>, normal: Vec3<R> },
    /// Inside the tetrahedron, to rounding.
    Inside,
}

impl<R: Real> Simplex<R> {
    pub(super) fn empty() -> Self {
        let zero = R::from(0.0);
        Self { count: 0, ids: [[0; 2]; 4], points: [Vec3::zero(); 4], weights: [zero; 4] }
    }

    #[inline]
    pub(super) fn push(&mut self, ids: Ids, point: Vec3<R>) {
        self.ids[self.count] = ids;
        self.points[self.count] = point;
        self.count += 1;
    }

    #[inline]
    pub(super) fn contains(&self, ids: Ids) -> bool {
        self.ids[..self.count].contains(&ids)
    }

    /// Keeps the listed points, with these weights.
    #[inline]
    fn keep<const N: usize>(&mut self, which: [usize; N], weights: [R; N]) {
        // the indices rise, so nothing is overwritten before it is read
        for k in 0..N {
            if which[k] != k {
                self.ids[k] = self.ids[which[k]];
                self.points[k] = self.points[which[k]];
            }
            self.weights[k] = weights[k];
        }
        self.count = N;
    }

    /// `Σ λ w`.
    #[inline]
    pub(super) fn point(&self) -> Vec3<R> {
        let mut p = self.points[0].scaled(self.weights[0]);
        for k in 1..self.count {
            p = p + self.points[k].scaled(self.weights[k]);
        }
        p
    }

    /// Drops what does not carry the closest point to the origin.
    #[inline]
    pub(super) fn reduce(&mut self) -> Closest<R> {
        match self.count {
            0 | 1 => self.keep([0], [R::from(1.0)]),
            2 => self.segment([0, 1]),
            3 => self.triangle([0, 1, 2]),
            _ => {
                if self.tetrahedron() {
                    return Closest::Inside;
                }
            }
        }
        let point = self.point();
        Closest::At { point, normal: self.normal(&point) }
    }

    /// A normal of the simplex towards its closest point `p`.
    #[inline]
    fn normal(&self, p: &Vec3<R>) -> Vec3<R> {
        match self.count {
            2 => {
                // p less its part along the segment
                let e = self.points[1] - self.points[0];
                let n = *p - e.scaled(p.dot(&e) / e.norm_squared());
                if n.norm_squared() > R::from(0.0) { n } else { *p }
            }
            3 => {
                let n = triangle_normal(&self.points[0], &self.points[1], &self.points[2]);
                if n.norm_squared() == R::from(0.0) {
                    *p
                } else if n.dot(&self.points[0]) < R::from(0.0) {
                    -n
                } else {
                    n
                }
            }
            _ => *p,
        }
    }

    #[inline]
    fn segment(&mut self, [i, j]: [usize; 2]) {
        let (zero, one) = (R::from(0.0), R::from(1.0));
        let (a, b) = (self.points[i], self.points[j]);
        let e = b - a;
        let (along, length) = (-a.dot(&e), e.norm_squared());
        if along <= zero {
            self.keep([i], [one]);
        } else if along >= length {
            self.keep([j], [one]);
        } else {
            let s = along / length;
            self.keep([i, j], [one - s, s]);
        }
    }

    /// The regions of a triangle's corners, sides and inside, in this order (Ericson 2005, §5.1.5).
    #[inline]
    fn triangle(&mut self, [i, j, k]: [usize; 3]) {
        let (zero, one) = (R::from(0.0), R::from(1.0));
        let (a, b, c) = (self.points[i], self.points[j], self.points[k]);
        let (ab, ac) = (b - a, c - a);

        let (d1, d2) = (-ab.dot(&a), -ac.dot(&a));
        if d1 <= zero && d2 <= zero {
            return self.keep([i], [one]);
        }
        let (d3, d4) = (-ab.dot(&b), -ac.dot(&b));
        if d3 >= zero && d4 <= d3 {
            return self.keep([j], [one]);
        }
        // twice the areas that the origin's foot spans with the sides, times |n|: as products with the normal they
        // lose L/δ of a triangle of length L and width δ, where d₁ d₄ − d₃ d₂ would lose its square
        let n = triangle_normal(&a, &b, &c);
        let vc = n.dot(&a.cross(&b));
        if vc <= zero && d1 >= zero && d3 <= zero {
            return self.segment([i, j]);
        }
        let (d5, d6) = (-ab.dot(&c), -ac.dot(&c));
        if d6 >= zero && d5 <= d6 {
            return self.keep([k], [one]);
        }
        let vb = n.dot(&c.cross(&a));
        if vb <= zero && d2 >= zero && d6 <= zero {
            return self.segment([i, k]);
        }
        let va = n.dot(&b.cross(&c));
        if va <= zero && d4 - d3 >= zero && d5 - d6 >= zero {
            return self.segment([j, k]);
        }
        let sum = va + vb + vc;
        self.keep([i, j, k], [va / sum, vb / sum, vc / sum]);
    }

    /// The closest face of a tetrahedron; true if the origin is behind all four.
    #[inline(never)]
    fn tetrahedron(&mut self) -> bool {
        let zero = R::from(0.0);
        let mut best: Option<(R, Self)> = None;
        for [i, j, k, opposite] in [[0, 1, 2, 3], [0, 1, 3, 2], [0, 2, 3, 1], [1, 2, 3, 0]] {
            let n = triangle_normal(&self.points[i], &self.points[j], &self.points[k]);
            let origin_side = -n.dot(&self.points[i]);
            let inner_side = n.dot(&(self.points[opposite] - self.points[i]));
            let behind = if inner_side > zero { origin_side > zero } else { inner_side < zero && origin_side < zero };
            if behind {
                continue;
            }
            let mut face = *self;
            face.triangle([i, j, k]);
            let distance = face.point().norm_squared();
            if best.as_ref().is_none_or(|b| distance < b.0) {
                best = Some((distance, face));
            }
        }
        match best {
            Some((_, face)) => {
                *self = face;
                false
            }
            None => true,
        }
    }
}

/// The area vector of a triangle from its two shorter sides, whose product cancels least.
#[inline]
pub(super) fn triangle_normal<R: Real>(a: &Vec3<R>, b: &Vec3<R>, c: &Vec3<R>) -> Vec3<R> {
    let (ab, bc, ca) = (*b - *a, *c - *b, *a - *c);
    let (x, y, z) = (ab.norm_squared(), bc.norm_squared(), ca.norm_squared());
    if x >= y && x >= z {
        bc.cross(&ca)
    } else if y >= z {
        ca.cross(&ab)
    } else {
        ab.cross(&bc)
    }
}
