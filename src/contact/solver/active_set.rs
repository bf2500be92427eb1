//! Frictionless contact: the linear complementarity problem, by its active set.
//!
//! ```text
//! u = W p + q      0 ≤ p ⟂ u ≥ 0
//! ```
//!
//! W is symmetric and positive semidefinite, so this is the minimum of `½ pᵀ W p + qᵀ p` over `p ≥ 0`, the
//! velocities are unique, and the impulses are not where contacts are redundant. Two steps:
//!
//! 1. the active set by Lawson and Hanson's method (1974, ch. 23) on `W + δ 1`: each pass adds the contact
//!    that approaches fastest and drops those whose impulse would pull. The small δ makes the answer unique
//!    and the shortest to within δ, so that a symmetric problem has a symmetric set;
//! 2. on that set the least-norm solution of `W p = −q`, without δ.
//!
//! Where the second step pulls or leaves an approach, the first is repeated about its own answer
//! (Rockafellar's proximal point, 1976), which ends at a solution of the problem without δ.

use super::dense::{Cholesky, Dense, Vector, largest, least_norm, zeros};
use super::{CERTIFIED, Solution};

/// δ, as a fraction of W's unit diagonal [-]. Larger: the set is less that of the shortest solution.
/// Smaller: redundant contacts make the factor of W + δ fail.
const SHIFT: f64 = 1.0e-9;
/// Repetitions of the proximal point [-]: each divides the error by 1 + λ/δ for the least eigenvalue λ that
/// matters; one is the rule.
const REPEATS: usize = 20;

/// Solves the problem for a matrix of unit diagonal (near enough). The residual is the largest
/// `|min(p, u)|` over the largest `|q|`.
pub fn solve(w: &Dense, q: &[f64]) -> Solution {
    let scale = largest(q);
    if scale == 0.0 {
        return Solution { impulse: zeros(q.len()), residual: 0.0 };
    }
    let shifted = w.shifted(SHIFT);
    let mut center = zeros(q.len());
    let mut best = Solution { impulse: center.clone(), residual: f64::INFINITY };
    for _ in 0..REPEATS {
        let about: Vector = q.iter().zip(&center).map(|(q, c)| q - SHIFT * c).collect();
        center = active_set(&shifted, &about);
        let set: Vec<usize> = (0..q.len()).filter(|&i| center[i] > 0.0).collect();
        let wanted: Vector = set.iter().map(|&i| -q[i]).collect();
        let mut polished = zeros(q.len());
        for (&i, p) in set.iter().zip(least_norm(&w.part(&set), &wanted)) {
            polished[i] = p.max(0.0);
        }
        for impulse in [polished, center.clone()] {
            let residual = residual(w, q, &impulse) / scale;
            if residual < best.residual {
                best = Solution { impulse, residual };
            }
        }
        if best.residual <= CERTIFIED {
            break;
        }
    }
    best
}

/// The largest `|min(p, u)|`.
fn residual(w: &Dense, q: &[f64], p: &[f64]) -> f64 {
    let smaller = |(u, p): (&f64, &f64)| if u.is_nan() || p.is_nan() { f64::NAN } else { u.min(*p) };
    largest(&w.times_plus(p, q).iter().zip(p).map(smaller).collect::<Vector>())
}

/// Lawson and Hanson's method on a positive definite matrix. Each pass of the outer loop lowers the
/// objective, so no set comes twice; the bound only ends a race of roundings, with the best set so far.
fn active_set(w: &Dense, q: &[f64]) -> Vector {
    let n = q.len();
    let floor = 4.0 * f64::EPSILON * largest(q);
    let mut p = zeros(n);
    let mut set: Vec<usize> = Vec::new();
    for _ in 0..4 * n + 16 {
        // the fastest approach that is not in the set
        let u = w.times_plus(&p, q);
        let outside = (0..n).filter(|i| !set.contains(i) && u[*i] < -floor);
        let Some(next) = outside.min_by(|&i, &j| u[i].total_cmp(&u[j])) else { break };
        set.push(next);
        set.sort_unstable();

        // drop what would pull, until nothing does
        while !set.is_empty() {
            let wanted: Vector = set.iter().map(|&i| -q[i]).collect();
            let Some(factor) = Cholesky::new(&w.part(&set)) else { return p };
            let z = factor.solve(&wanted);
            if z.iter().all(|&z| z > 0.0) {
                for (&i, z) in set.iter().zip(z) {
                    p[i] = z;
                }
                break;
            }
            let ways = set.iter().zip(&z).filter(|(_, z)| **z <= 0.0);
            let way = ways.map(|(&i, z)| p[i] / (p[i] - z)).fold(1.0, f64::min);
            let way = if way.is_nan() { 0.0 } else { way };
            for (&i, z) in set.iter().zip(&z) {
                p[i] += way * (z - p[i]);
                if *z <= 0.0 && p[i] <= floor {
                    p[i] = 0.0;
                }
            }
            set.retain(|&i| p[i] > 0.0);
        }
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn redundant_contacts_share_the_load() {
        // four corners of a square plate: levers (±1, ±1), mass 1 and moment 1: rank 3
        let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let w = Dense::from_fn(4, |i, j| (1.0 + corners[i].0 * corners[j].0 + corners[i].1 * corners[j].1) / 3.0);
        let found = solve(&w, &[-1.0; 4]);
        assert!(found.impulse.iter().all(|p| (p - 0.75).abs() < 1e-14), "{found:?}");
        assert!(found.residual < 1e-14);
    }

    #[test]
    fn a_contact_that_would_pull_is_let_go() {
        // two unknowns, the second driven away by the first: p = (1, 0), u = (0, ½)
        let w = Dense::from_fn(2, |i, j| if i == j { 1.0 } else { 0.5 });
        let found = solve(&w, &[-1.0, 0.0]);
        assert_eq!(found.impulse[..], [1.0, 0.0]);
        // a body squeezed between two driven walls cannot be answered, and the residual says so
        let squeezed = Dense::from_fn(2, |i, j| if i == j { 1.0 } else { -1.0 });
        assert!(solve(&squeezed, &[-1.0, -1.0]).residual > 0.1);
    }
}
