//! The preprocessed discrete Moser–Veselov method (Hairer, Vilmart 2006, J. Phys. A 39:13225).
//!
//! A step turns a body by a rotation that keeps |L| and the energy, found from one equation; moments of inertia that
//! are amended for the length of the step make it right to order 4, 6, 8 or 10 at nearly the same cost. Where no
//! torque acts, momentum, energy and angle stay true over any number of steps, but for rounding. A constant force
//! through the centre of mass moves the body exactly; torques and drag, which would cost the order, are refused.

use super::splitting::Workspace;
use super::{Problem, StateVector};
use crate::freedom::RotationSplit;
use crate::state::Moment;

/// The order where none is asked for.
pub(super) const ORDER: u32 = 10;
pub(super) const EVALUATIONS: u32 = 2;
pub(super) const BODY_AXES: bool = true;
/// Orders that can be asked for.
pub(crate) const ORDERS: [u32; 5] = [2, 4, 6, 8, 10];

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    workspace: Workspace<Y>,
    order: u32,
}

impl<Y: StateVector> Kernel<Y> {
    pub(super) fn of_order(n: usize, order: u32) -> Self {
        Self { workspace: Workspace::new(n), order }
    }
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;
    const NEEDS_SLOPE: bool = false;

    fn new(n: usize) -> Self {
        Self::of_order(n, ORDER)
    }

    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, _k0: &Y, h: f64, dy: &mut Y) {
        self.workspace.compose(problem, at, y, h, (&[1.0], RotationSplit::MoserVeselov(self.order)), dy);
    }
}
