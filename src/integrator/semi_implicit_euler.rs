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

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    drift: Y,
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;

    fn new(n: usize) -> Self {
        Self { drift: Y::zeros(n) }
    }

    #[inline]
    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, _at: Moment, y: &mut Y, k1: &Y, h: f64) {
        // the kick: what the loads do to the momenta
        problem.drift(y, &mut self.drift);
        y.add_scaled(h, k1);
        y.add_scaled(-h, &self.drift);

        // the drift: the new momenta move the position
        problem.drift(y, &mut self.drift);
        y.add_scaled(h, &self.drift);
    }
}
