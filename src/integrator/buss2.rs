//! Buss's augmented method of order 2 (Buss 2000, J. Comput. Phys. 164:377), as game engines and flight
//! simulators use it.
//!
//! ```text
//! ω̄ = ω + ½h α + h²/12 (α × ω)        q₁ = exp(h ω̄) q        α = dω/dt
//! L₁ = L + h M                          M the torque half a step on
//! ```
//!
//! The bracket takes up that rotations about changing axes do not commute; with it the energy error of a free
//! body is of third order. Here α comes from the angular velocity half a step on, `ω + ½h α ≈ ω(½h)`, which the
//! torque there needs anyway. L of a free body stays to the last bit; the energy climbs, slowly.

use super::{Problem, StateVector};
use crate::state::Moment;

pub(super) const ORDER: u32 = 2;
pub(super) const EVALUATIONS: u32 = 2;
pub(super) const BODY_AXES: bool = false;
pub(super) const ERROR_ORDER: f64 = 0.0;

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    stage: Y,
    k1: Y,
    k2: Y,
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;

    fn new(n: usize) -> Self {
        Self { stage: Y::zeros(n), k1: Y::zeros(n), k2: Y::zeros(n) }
    }

    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        let Self { stage, k1, k2 } = self;
        k1.clone_from(k0);
        problem.to_generator(y, k1);

        // half a step on
        stage.clone_from(y);
        problem.act(stage, 0.5 * h, k1);
        problem.rate(at.after(0.5 * h), stage, k2);
        problem.to_generator(stage, k2);

        // ½h α = ω(½h) − ω, so that h²/12 α × ω = h/6 ω(½h) × ω
        problem.add_bracket(h / 6.0, k2, k1);
        stage.clone_from(y);
        problem.act(stage, h, k2);
        dy.set_sum(stage, -1.0, y);
    }
}
