//! Contact with Coulomb friction by Newton's method on Alart and Curnier's equations (1991).
//!
//! ```text
//! y = p_n − ρ u_n     d = p_t − ρ u_t     any ρ > 0
//! F_n = p_n − max(f, y)
//! F_t = p_t − d min(1, R/|d|)         R = μ max(f, y)
//! ```
//!
//! F is 0 exactly at a solution, whatever ρ, and piecewise smooth: near one the method ends in a few rounds
//! at rounding; ρ decides which branch a start is on. Each step is the shortest that solves the linearised equations, so that redundant contacts
//! share what they carry and symmetry is kept. It may cycle far from a solution; the rounds are bounded and
//! the best iterate is returned.

use super::dense::{Dense, Vector, largest, least_norm, zeros};
use super::{Coulomb, triple};

/// Rounds before the next solver is asked [-]; few problems need more than ten.
pub const ROUNDS: usize = 40;
/// F over the largest velocity before below which a round that does not halve it has met rounding [-].
const ROUNDED: f64 = 1.0e-13;
/// Halvings of a step that does not lower F [-].
const HALVINGS: usize = 6;

/// Up to `rounds` steps from `start` with this ρ; returns the iterate of least F.
pub fn solve(problem: &Coulomb<'_>, start: &[f64], rounds: usize, rho: f64) -> Vector {
    let scale = problem.scale();
    let mut p = Vector::from_slice(start);
    let mut f = equations(problem, &p, rho);
    let mut best = (p.clone(), largest(&f));
    let mut before = f64::INFINITY;
    for _ in 0..rounds {
        let left = largest(&f);
        if left <= 4.0 * f64::EPSILON * scale || (left <= ROUNDED * scale && left > 0.5 * before) {
            break;
        }
        before = left;
        let minus: Vector = f.iter().map(|f| -f).collect();
        let step = least_norm(&slope(problem, &p, rho), &minus);

        // the whole step where it helps, a part of it where that helps, else the whole all the same
        let size = norm(&f);
        let mut found = None;
        let mut part = 1.0;
        for _ in 0..HALVINGS {
            let next: Vector = p.iter().zip(&step).map(|(p, s)| p + part * s).collect();
            let next_f = equations(problem, &next, rho);
            let next_size = norm(&next_f);
            if found.is_none() || next_size < size {
                found = Some((next, next_f));
            }
            if next_size < size {
                break;
            }
            part *= 0.5;
        }
        let Some((next, next_f)) = found else { break };
        (p, f) = (next, next_f);
        if !f.iter().all(|f| f.is_finite()) {
            break;
        }
        if largest(&f) < best.1 {
            best = (p.clone(), largest(&f));
        }
    }
    best.0
}

fn norm(f: &[f64]) -> f64 {
    super::dense::dot(f, f).sqrt()
}

/// Alart and Curnier's F.
fn equations(problem: &Coulomb<'_>, p: &[f64], rho: f64) -> Vector {
    let u = problem.w.times_plus(p, problem.q);
    let mut f = zeros(p.len());
    for i in 0..problem.contacts() {
        let (p, u) = (triple(p, i), triple(&u, i).map(|u| rho * u));
        let normal = (p[0] - u[0]).max(problem.floor[i]);
        f[3 * i] = p[0] - normal;
        let reach = problem.friction[i] * normal;
        let (x, y) = if let Some(s) = problem.slide[i] {
            (-reach * s[0], -reach * s[1])
        } else {
            let d = [p[1] - u[1], p[2] - u[2]];
            let length = libm::hypot(d[0], d[1]);
            let shrink = if length > reach { reach / length } else { 1.0 };
            (shrink * d[0], shrink * d[1])
        };
        f[3 * i + 1] = p[1] - x;
        f[3 * i + 2] = p[2] - y;
    }
    f
}

/// The derivative of F, of the branch that p is on: rows `∂F/∂p + ∂F/∂u W`.
fn slope(problem: &Coulomb<'_>, p: &[f64], rho: f64) -> Dense {
    let (n, w) = (p.len(), problem.w);
    let u = w.times_plus(p, problem.q);
    let mut g = Dense::zeros(n);
    // adds `factor · d(p_k − ρ u_k)` to a row
    let add = |g: &mut Dense, row: usize, k: usize, factor: f64| {
        if factor != 0.0 {
            for c in 0..n {
                let own = if c == k { 1.0 } else { 0.0 };
                g.set(row, c, g.at(row, c) + factor * (own - rho * w.at(k, c)));
            }
        }
    };
    for i in 0..problem.contacts() {
        let row = 3 * i;
        for k in 0..3 {
            g.set(row + k, row + k, 1.0);
        }
        let (p, u) = (triple(p, i), triple(&u, i).map(|u| rho * u));
        let closed = p[0] - u[0] > problem.floor[i];
        let mu = problem.friction[i];
        let reach = mu * (p[0] - u[0]).max(problem.floor[i]);
        if closed {
            add(&mut g, row, row, -1.0);
        }
        if let Some(s) = problem.slide[i] {
            add(&mut g, row + 1, row, if closed { mu * s[0] } else { 0.0 });
            add(&mut g, row + 2, row, if closed { mu * s[1] } else { 0.0 });
            continue;
        }
        // without a reach there is no friction, and the tangential impulse is 0
        let d = [p[1] - u[1], p[2] - u[2]];
        let length = libm::hypot(d[0], d[1]);
        if reach <= 0.0 {
            continue;
        }
        if length <= reach {
            add(&mut g, row + 1, row + 1, -1.0);
            add(&mut g, row + 2, row + 2, -1.0);
        } else {
            let s = [d[0] / length, d[1] / length];
            for k in 0..2 {
                add(&mut g, row + 1 + k, row, if closed { -mu * s[k] } else { 0.0 });
                for l in 0..2 {
                    let across = if k == l { 1.0 } else { 0.0 } - s[k] * s[l];
                    add(&mut g, row + 1 + k, row + 1 + l, -reach / length * across);
                }
            }
        }
    }
    g
}
