//! Euler's method (lecture §4).
//!
//! ```text
//! Y₁ = Y + h Y′(t, Y)
//! ```
//!
//! Order 1 for 1 evaluation. The lecture's warning: the error is too large for a stable simulation.
//! The energy of a free body climbs, and halving the step only halves the climb.

use super::{Problem, StateVector};
use crate::state::Moment;

pub(super) const ORDER: u32 = 1;
pub(super) const EVALUATIONS: u32 = 1;
pub(super) const BODY_AXES: bool = false;
pub(super) const ERROR_ORDER: f64 = 0.0;

#[derive(Debug)]
pub(super) struct Kernel<Y>(std::marker::PhantomData<Y>);

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;

    fn new(_n: usize) -> Self {
        Self(std::marker::PhantomData)
    }

    #[inline(always)]
    fn step<P: Problem<Y = Y>>(&mut self, _problem: &mut P, _at: Moment, _y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        dy.set_increment(h, [(1.0, k0)]);
    }
}
