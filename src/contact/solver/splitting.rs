//! Contact with Coulomb friction by a splitting (ADMM), for problems on which Newton's method fails.
//!
//! The linear part and the cone take turns, joined by a multiplier y (Acary et al. 2017; Carpentier et al.
//! 2024), with De Saxcé's shift from the last velocities:
//!
//! ```text
//! (W + ρ) p = −q − μ |u_t| n + ρ z − y
//! z = the admissible impulse nearest to p + y/ρ
//! y ← y + ρ (p − z)
//! ```
//!
//! Slow near the answer but hard to mislead. From time to time Newton's method is asked to finish.

use super::dense::{Cholesky, Vector, largest, zeros};
use super::{CERTIFIED, Coulomb, Solution, newton, triple};

/// Rounds before the best answer so far is returned [-].
const ROUNDS: usize = 2000;
/// Rounds between two attempts of Newton's method [-].
const BETWEEN: usize = 50;
/// Rounds between two looks at the balance of both residuals, by which ρ is set [-].
const BALANCE: usize = 10;

/// Solves the problem, or returns the best answer found.
pub fn solve(problem: &Coulomb<'_>) -> Solution {
    let size = problem.q.len();
    let (mut z, mut y) = (zeros(size), zeros(size));
    let mut best = problem.certify(&z);
    let mut rho = 1.0;
    let Some(mut factor) = Cholesky::new(&problem.w.shifted(rho)) else { return best };
    for round in 1..=ROUNDS {
        let u = problem.w.times_plus(&z, problem.q);
        let mut right: Vector = (0..size).map(|k| rho * z[k] - y[k] - problem.q[k]).collect();
        for i in 0..problem.contacts() {
            if problem.slide[i].is_some() {
                continue;
            }
            let u = triple(&u, i);
            right[3 * i] -= problem.friction[i] * libm::hypot(u[1], u[2]);
        }
        let p = factor.solve(&right);
        let before = z.clone();
        for i in 0..problem.contacts() {
            let k = 3 * i;
            let nearest =
                problem.admissible(i, [p[k] + y[k] / rho, p[k + 1] + y[k + 1] / rho, p[k + 2] + y[k + 2] / rho]);
            z[k..k + 3].copy_from_slice(&nearest);
        }
        let mut primal = zeros(size);
        for k in 0..size {
            primal[k] = p[k] - z[k];
            y[k] += rho * primal[k];
        }

        if round % BETWEEN == 0 {
            best = best.or(problem.certify(&z));
            best = best.or(problem.certify(&newton::solve(problem, &z, newton::ROUNDS / 2, 1.0)));
            if best.residual <= CERTIFIED {
                break;
            }
        }
        if round % BALANCE == 0 && round < ROUNDS / 2 {
            let dual: Vector = z.iter().zip(&before).map(|(z, b)| rho * (z - b)).collect();
            let (r, s) = (largest(&primal), largest(&dual));
            let change = if r > 10.0 * s {
                2.0
            } else if s > 10.0 * r {
                0.5
            } else {
                1.0
            };
            if change != 1.0 {
                rho *= change;
                let Some(next) = Cholesky::new(&problem.w.shifted(rho)) else { break };
                factor = next;
            }
        }
    }
    best
}
