//! Heun's method, the improved Euler step (lecture §4).
//!
//! ```text
//! Ŷ  = Y + h Y′(t, Y)                      Euler's guess
//! Y₁ = Y + ½ h [Y′(t, Y) + Y′(t + h, Ŷ)]   mean of the slopes at both ends
//! ```
//!
//! Order 2 for 2 evaluations. The energy of a free body swings by an amount of order h², and has a
//! trend besides: at fixed span it falls 8 times per halving of h, where Euler's climb only halves.
//! Neither is bounded. Near the middle axis every error grows exponentially: shorten h.

use super::{Problem, StateVector};
use crate::state::Moment;

pub(super) const ORDER: u32 = 2;
pub(super) const EVALUATIONS: u32 = 2;
pub(super) const BODY_AXES: bool = false;
pub(super) const ERROR_ORDER: f64 = 0.0;

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    guess: Y,
    k2: Y,
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;

    fn new(n: usize) -> Self {
        Self { guess: Y::zeros(n), k2: Y::zeros(n) }
    }

    #[inline(always)]
    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        let mut work = (self.guess.lend(), self.k2.lend());
        let (guess, k2) = (&mut work.0, &mut work.1);
        guess.set_sum(y, h, k0);
        problem.rate(at.after(h), guess, k2);
        dy.set_increment(0.5 * h, [(1.0, k0), (1.0, k2)]);

        self.guess.take_back(work.0);
        self.k2.take_back(work.1);
    }
}
