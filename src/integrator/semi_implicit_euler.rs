//! Semi-implicit Euler, the step of the lecture's hovercraft (§6).
//!
//! ```text
//! P₁ = P + h F        L₁ = L + h M          with the loads at the old state
//! x₁ = x + h P₁/m     q₁ = q + h q′(q, L₁)   the new velocity moves the body
//! ```
//!
//! Order 1 for 2 evaluations of the cheap part and 1 of the loads. Where forces come from a
//! potential, the energy of the translation swings but does not climb, as it does with Euler's
//! method; a tumbling body's still climbs.

use super::{Problem, StateVector};
use crate::state::Moment;

pub(super) const ORDER: u32 = 1;
pub(super) const EVALUATIONS: u32 = 1;
pub(super) const BODY_AXES: bool = false;
pub(super) const ERROR_ORDER: f64 = 0.0;

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    drift: Y,
    kicked: Y,
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;

    fn new(n: usize) -> Self {
        Self { drift: Y::zeros(n), kicked: Y::zeros(n) }
    }

    #[inline(always)]
    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, _at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        // the kick: what the loads do to the momenta
        let mut work = (self.drift.lend(), self.kicked.lend());
        let (drift, kicked) = (&mut work.0, &mut work.1);
        problem.drift(y, drift);
        dy.set_increment(h, [(1.0, k0), (-1.0, drift)]);
        kicked.set_sum(y, 1.0, dy);

        // the drift: the new momenta move the position
        problem.drift(kicked, drift);
        dy.add_scaled(h, drift);

        self.drift.take_back(work.0);
        self.kicked.take_back(work.1);
    }
}
