//! Solvers of small contact problems, one a file; each answer carries its residual.
//!
//! All work in contact space: impulses `p`, relative velocities `u = W p + q` after them, and the matrix
//! `W = J M⁻¹ Jᵀ` of how an impulse at one contact moves another, everything scaled per contact so that
//! W's diagonal is near 1; then p and u share the unit √J and one residual serves both.
//!
//! | file | solves |
//! |---|---|
//! | [`active_set`] | contact without friction |
//! | [`newton`] | contact with Coulomb friction, by Newton's method |
//! | [`splitting`] | the same where Newton's method fails, by a slow and sure splitting |
//! | [`dense`] | the linear algebra beneath |
//!
//! [`Coulomb::solve`] is the ladder: all contacts carry, gripping or sliding as is known; Newton from there and from nothing; the splitting with
//! Newton as its last step; Newton on other branches. What comes out is the first answer whose residual is at most [`CERTIFIED`], else the best.

pub mod active_set;
pub mod dense;
pub mod newton;
pub mod splitting;

use smallvec::SmallVec;

use dense::{Dense, Vector, largest, least_norm, zeros};

/// Residual up to which a solution counts as one [-], relative to the largest velocity before. Rounding
/// leaves 1e-16 times the condition number of the contacts, mass ratios of 1e4 leave 1e-12. Larger: worse
/// answers pass. Smaller: the next solver is asked in vain.
pub const CERTIFIED: f64 = 1.0e-11;

/// The ρ of Newton's method that are tried where ρ = 1 and the splitting have failed [-].
const OTHER_BRANCHES: [f64; 4] = [0.1, 10.0, 0.01, 100.0];

/// Impulses, and how far they are from solving the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Scaled impulses, in the order of the rows.
    pub impulse: Vector,
    /// Natural-map residual over the largest velocity before [-].
    pub residual: f64,
}

impl Solution {
    /// The better of two answers.
    fn or(self, other: Self) -> Self {
        if other.residual < self.residual { other } else { self }
    }
}

/// Contact with friction: three rows a contact, the normal one first.
///
/// ```text
/// u = W p + q
/// p_n ≥ f,  u_n ≥ 0,  (p_n − f) u_n = 0                    normal, with a least impulse f ≥ 0
/// |p_t| ≤ μ p_n,  μ p_n u_t + |u_t| p_t = 0                Coulomb: what slides is braked by all of μ p_n
/// ```
///
/// A least impulse f > 0 is how restitution enters; the cone then holds for all of p. A contact that is
/// known to slide along `s` has `p_t = −μ p_n s` instead of the second line.
#[derive(Debug, Clone)]
pub struct Coulomb<'a> {
    /// W, scaled to a diagonal near 1, positive semidefinite [-].
    pub w: &'a Dense,
    /// Velocities without impulse.
    pub q: &'a [f64],
    /// Coefficients of friction μ, one a contact [-].
    pub friction: &'a [f64],
    /// Least normal impulses f, one a contact.
    pub floor: &'a [f64],
    /// Directions of sliding where they are known, unit, in the contact's tangents [-].
    pub slide: &'a [Option<[f64; 2]>],
}

impl Coulomb<'_> {
    /// Number of contacts.
    pub fn contacts(&self) -> usize {
        self.friction.len()
    }

    /// The point of the admissible impulses of contact `i` nearest to `p`: a cone cut off below f. For a
    /// contact that slides, the point of its ray with the same normal part.
    pub fn admissible(&self, i: usize, p: [f64; 3]) -> [f64; 3] {
        let (mu, floor) = (self.friction[i], self.floor[i]);
        if let Some(s) = self.slide[i] {
            let n = p[0].max(floor);
            return [n, -mu * n * s[0], -mu * n * s[1]];
        }
        let t = libm::hypot(p[1], p[2]);
        let n = if t <= mu * p[0] { p[0] } else { ((p[0] + mu * t) / (1.0 + mu * mu)).max(0.0) };
        let n = n.max(floor);
        let shrink = if t > mu * n { mu * n / t } else { 1.0 };
        [n, shrink * p[1], shrink * p[2]]
    }

    /// The largest entry of the natural map `p − P(p − u − μ |u_t| n)`, P the nearest admissible point
    /// (De Saxcé & Feng 1998): 0 exactly at a solution; or what approaches, which the map hides behind a large μ.
    pub fn residual(&self, p: &[f64]) -> f64 {
        let u = self.w.times_plus(p, self.q);
        if !largest(&u).is_finite() || !largest(p).is_finite() {
            return f64::INFINITY;
        }
        let mut worst = 0.0f64;
        for i in 0..self.contacts() {
            let (p, u) = (triple(p, i), triple(&u, i));
            let push = if self.slide[i].is_some() { 0.0 } else { self.friction[i] * libm::hypot(u[1], u[2]) };
            let nearest = self.admissible(i, [p[0] - u[0] - push, p[1] - u[1], p[2] - u[2]]);
            for k in 0..3 {
                worst = worst.max((p[k] - nearest[k]).abs());
            }
            worst = worst.max(-u[0]);
        }
        worst
    }

    /// The size that residuals are measured in: the largest velocity or least impulse.
    fn scale(&self) -> f64 {
        largest(self.q).max(largest(self.floor))
    }

    /// The answer with its impulses made admissible and its residual.
    fn certify(&self, p: &[f64]) -> Solution {
        let mut impulse = Vector::from_slice(p);
        for i in 0..self.contacts() {
            let p = triple(p, i);
            let mu = self.friction[i];
            let n = p[0].max(self.floor[i]);
            let t = libm::hypot(p[1], p[2]);
            let shrink = if t > mu * n { mu * n / t } else { 1.0 };
            impulse[3 * i..3 * i + 3].copy_from_slice(&[n, shrink * p[1], shrink * p[2]]);
        }
        let residual = self.residual(&impulse) / self.scale();
        Solution { impulse, residual }
    }

    /// The least-norm impulses where every contact carries: what is known to slide slides, all else grips.
    ///
    /// ```text
    /// p = p_n (1, −μ s)      one unknown and the normal row of a contact that slides, three of one that grips
    /// ```
    fn carry(&self) -> Vector {
        let slides = |i: usize| self.slide[i].is_some();
        let rows: SmallVec<[usize; 12]> =
            (0..self.q.len()).filter(|row| row.is_multiple_of(3) || !slides(row / 3)).collect();
        let ray = |i: usize| self.slide[i].map(|s| s.map(|s| -self.friction[i] * s));
        let a = Dense::from_fn(rows.len(), |r, c| {
            let (row, column) = (rows[r], rows[c]);
            let along = ray(column / 3).unwrap_or_default();
            let own = self.w.at(row, column);
            if along == [0.0; 2] {
                return own;
            }
            own + along[0] * self.w.at(row, column + 1) + along[1] * self.w.at(row, column + 2)
        });
        let stop: Vector = rows.iter().map(|&row| -self.q[row]).collect();
        let mut p = zeros(self.q.len());
        for (&row, x) in rows.iter().zip(least_norm(&a, &stop)) {
            p[row] = x;
            if let Some(along) = ray(row / 3) {
                (p[row + 1], p[row + 2]) = (along[0] * x, along[1] * x);
            }
        }
        p
    }

    /// Solves the problem by the ladder of the [module](self).
    pub fn solve(&self) -> Solution {
        if self.scale() == 0.0 {
            return Solution { impulse: zeros(self.q.len()), residual: 0.0 };
        }
        let none = zeros(self.q.len());
        let mut best = self.certify(&none);
        if best.residual <= CERTIFIED {
            return best;
        }
        best = best.or(self.certify(&self.carry()));
        if best.residual <= CERTIFIED {
            return best;
        }
        let mut starts = vec![best.impulse.clone(), none];
        for start in &starts {
            best = best.or(self.certify(&newton::solve(self, start, newton::ROUNDS, 1.0)));
            if best.residual <= CERTIFIED {
                return best;
            }
        }
        best = best.or(splitting::solve(self));
        starts.push(best.impulse.clone());
        for (start, rho) in starts.iter().flat_map(|s| OTHER_BRANCHES.map(|rho| (s, rho))) {
            if best.residual <= CERTIFIED {
                break;
            }
            best = best.or(self.certify(&newton::solve(self, start, newton::ROUNDS, rho)));
        }
        best
    }
}

/// The three entries of contact `i`.
#[inline]
pub(super) fn triple(x: &[f64], i: usize) -> [f64; 3] {
    [x[3 * i], x[3 * i + 1], x[3 * i + 2]]
}
