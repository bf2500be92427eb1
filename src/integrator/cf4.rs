//! The commutator-free Lie-group method of order 4 (Celledoni, Marthinsen, Owren 2003, Future Gener.
//! Comput. Syst. 19:341).
//!
//! ```text
//! k_i = F(Y_i)      Y₂ = exp(½h k₁) Y      Y₃ = exp(½h k₂) Y      Y₄ = exp(h (k₃ − ½k₁)) Y₂
//! Y₁ = exp(h/12 (−k₁ + 2k₂ + 2k₃ + 3k₄)) exp(h/12 (3k₁ + 2k₂ + 2k₃ − k₄)) Y
//! ```
//!
//! Orientations move by rotations, so q stays on its sphere by itself; the other numbers move on straight
//! lines, on which it is the classical Runge–Kutta method. It works on the lecture's q and L in world axes,
//! so L of a free body stays to the last bit. Its energy drifts, and errors cost more than in body axes.

use super::{Problem, StateVector};
use crate::state::Moment;

pub(super) const ORDER: u32 = 4;
pub(super) const EVALUATIONS: u32 = 4;
pub(super) const BODY_AXES: bool = false;
pub(super) const ERROR_ORDER: f64 = 0.0;

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    y2: Y,
    stage: Y,
    exponent: Y,
    k: [Y; 4],
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;

    fn new(n: usize) -> Self {
        let zeros = || Y::zeros(n);
        Self { y2: zeros(), stage: zeros(), exponent: zeros(), k: std::array::from_fn(|_| zeros()) }
    }

    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        let Self { y2, stage, exponent, k: [k1, k2, k3, k4] } = self;
        k1.clone_from(k0);
        problem.to_generator(y, k1);

        y2.clone_from(y);
        problem.act(y2, 0.5 * h, k1);
        problem.rate(at.after(0.5 * h), y2, k2);
        problem.to_generator(y2, k2);

        stage.clone_from(y);
        problem.act(stage, 0.5 * h, k2);
        problem.rate(at.after(0.5 * h), stage, k3);
        problem.to_generator(stage, k3);

        stage.clone_from(y2);
        exponent.set_increment(1.0, [(1.0, k3), (-0.5, k1)]);
        problem.act(stage, h, exponent);
        problem.rate(at.after(h), stage, k4);
        problem.to_generator(stage, k4);

        stage.clone_from(y);
        exponent.set_increment(1.0 / 12.0, [(3.0, k1), (2.0, k2), (2.0, k3), (-1.0, k4)]);
        problem.act(stage, h, exponent);
        exponent.set_increment(1.0 / 12.0, [(-1.0, k1), (2.0, k2), (2.0, k3), (3.0, k4)]);
        problem.act(stage, h, exponent);
        dy.set_sum(stage, -1.0, y);
    }
}
