//! Simultaneous impact without friction: generalised reflections (Smith, Kaufman, Vouga, Tamstorf,
//! Grinspun 2012).
//!
//! Elastic contacts. Of the contacts that approach, all at once are answered by the reflection of the
//! velocities at the cone that those contacts allow; contacts that approach then are answered next, and so
//! on until none does:
//!
//! ```text
//! 0 ≤ λ ⟂ u + W λ ≥ 0   over the contacts with u_i < 0          stops them, by the least kinetic energy
//! u ← u + 2 W λ                                                 reflects: energy and momentum are exact
//! ```
//!
//! A blow runs through a row of touching balls and only the last flies off; balls struck symmetrically leave
//! symmetrically; a cube landing flat on four corners does not turn.
//!
//! Restitution below 1 is Moreau's mixture of that elastic answer with the plastic one, which stops all
//! contacts at once. Where contacts differ in restitution, each mixture holds for a slice of 0..1:
//!
//! ```text
//! u⁺ = ∫₀¹ answer(contacts with e_i > θ elastic, the others plastic) dθ
//! ```
//!
//! which for one e throughout is `e · elastic + (1 − e) · plastic`. Every term leaves no approach and no
//! more energy than before; both sets are convex, so the mixture does too.

use super::solver::active_set;
use super::solver::dense::{Dense, Vector, dot, zeros};

/// Impulses, how well they solve what was asked, and how many rounds of reflections it took.
pub(super) struct Reflected {
    pub(super) impulse: Vector,
    pub(super) residual: f64,
    pub(super) rounds: u32,
}

/// Rounds of purely elastic reflections [-]: they end by themselves, mostly after one for each contact, in
/// wedges after π over the angle. What is left then is stopped, and loses energy.
const ELASTIC_ROUNDS: u32 = 4096;

/// Rounds for `n` contacts where some are plastic, or rub [-]: these may go on for ever, ever weaker, and the
/// plastic answer ends them.
pub(super) fn rounds_for(n: usize) -> u32 {
    u32::try_from(64 + 16 * n).unwrap_or(u32::MAX)
}

/// The slices of 0..1 in which the same contacts are elastic: weight and which; the last is all plastic.
pub(super) fn slices(restitution: &[f64]) -> Vec<(f64, Vec<bool>)> {
    let mut levels: Vec<f64> = restitution.iter().copied().filter(|&e| e > 0.0).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut slices = Vec::new();
    let mut below = 0.0;
    for level in levels {
        slices.push((level - below, restitution.iter().map(|&e| e >= level).collect()));
        below = level;
    }
    slices.push((1.0 - below, vec![false; restitution.len()]));
    slices.retain(|(weight, _)| *weight > 0.0);
    slices
}

/// The mixture of answers for the scaled problem `u = W p + q`; `noise` is the approach [scaled] that
/// rounding alone may leave at each contact.
pub(super) fn reflect(w: &Dense, q: &[f64], restitution: &[f64], noise: &[f64]) -> Reflected {
    // one contact has the formula that all of this comes to
    if let (&[speed], &[e]) = (q, restitution) {
        let impulse = if speed < 0.0 { -(1.0 + e) * speed / w.at(0, 0) } else { 0.0 };
        return Reflected { impulse: Vector::from_slice(&[impulse]), residual: 0.0, rounds: 1 };
    }
    let mut mixed = Reflected { impulse: zeros(q.len()), residual: 0.0, rounds: 0 };
    for (weight, elastic) in slices(restitution) {
        let answer = answer(w, q, &elastic, noise);
        for (sum, p) in mixed.impulse.iter_mut().zip(&answer.impulse) {
            *sum += weight * p;
        }
        mixed.residual = mixed.residual.max(answer.residual);
        mixed.rounds += answer.rounds;
    }
    mixed
}

/// The answer where each contact is either elastic or plastic.
fn answer(w: &Dense, q: &[f64], elastic: &[bool], noise: &[f64]) -> Reflected {
    let n = q.len();
    let mut p = zeros(n);
    let mut worst = 0.0f64;
    let mut rounds = 0;
    if elastic.contains(&true) {
        let limit = if elastic.contains(&false) { rounds_for(n) } else { ELASTIC_ROUNDS };
        for round in 1..=limit {
            let u = w.times_plus(&p, q);
            let approaching: Vec<usize> = (0..n).filter(|&i| u[i] < -noise[i]).collect();
            if approaching.is_empty() {
                return Reflected { impulse: p, residual: worst, rounds };
            }
            rounds = round;
            let part = w.part(&approaching);
            let speeds: Vector = approaching.iter().map(|&i| u[i]).collect();
            let stop = active_set::solve(&part, &speeds);
            worst = worst.max(stop.residual);

            // what the elastic contacts give back is at most what stopping has taken
            let back: Vector =
                approaching.iter().zip(&stop.impulse).map(|(&i, p)| if elastic[i] { *p } else { 0.0 }).collect();
            let (taken, given) = (part.quadratic(&stop.impulse), part.quadratic(&back));
            let share = if given > taken { (taken / given).max(0.0).sqrt() } else { 1.0 };
            for ((&i, stop), back) in approaching.iter().zip(&stop.impulse).zip(&back) {
                p[i] += stop + share * back;
            }
        }
    }

    // the plastic answer: of everything, or of what the rounds have left
    let mut stops = 0;
    loop {
        let u = w.times_plus(&p, q);
        let stop = active_set::solve(w, &u);
        for (p, s) in p.iter_mut().zip(&stop.impulse) {
            *p += s;
        }
        worst = worst.max(if stops == 0 { stop.residual } else { 0.0 });
        stops += 1;
        let done = w.times_plus(&p, q).iter().zip(noise).all(|(u, noise)| *u >= -noise);
        if done || stops == STOPS {
            return Reflected { impulse: p, residual: worst, rounds: rounds + 1 };
        }
    }
}

/// Plastic answers to what the first has left by rounding [-]: each leaves a small part of it.
const STOPS: usize = 4;

/// The energy that impulses leave in the contacts, `p·q + ½ pᵀ W p` [J]: not above 0 where none is made.
pub(super) fn energy_change(w: &Dense, q: &[f64], p: &[f64]) -> f64 {
    dot(p, q) + 0.5 * w.quadratic(p)
}
