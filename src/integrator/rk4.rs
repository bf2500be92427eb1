//! The classical Runge–Kutta method (Kutta 1901).
//!
//! ```text
//! k₁ = Y′(t, Y)                 k₂ = Y′(t + ½h, Y + ½h k₁)
//! k₃ = Y′(t + ½h, Y + ½h k₂)    k₄ = Y′(t + h, Y + h k₃)
//! Y₁ = Y + h/6 (k₁ + 2 (k₂ + k₃) + k₄)
//! ```
//!
//! Order 4 for 4 evaluations, with the angular momentum in body axes: the same method on the
//! lecture's Y costs several times more for the same error, since L in world axes stands still
//! while the inertia turns beneath it. |L| and the energy are not kept: both have a trend, which falls 32
//! times per halving of h.

use super::{Problem, StateVector};
use crate::state::Moment;

pub(super) const ORDER: u32 = 4;
pub(super) const EVALUATIONS: u32 = 4;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 0.0;

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    stage: Y,
    k2: Y,
    k3: Y,
    k4: Y,
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;

    fn new(n: usize) -> Self {
        Self { stage: Y::zeros(n), k2: Y::zeros(n), k3: Y::zeros(n), k4: Y::zeros(n) }
    }

    #[inline(always)]
    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        let mut work = (self.stage.lend(), self.k2.lend(), self.k3.lend(), self.k4.lend());
        let (stage, k2, k3, k4) = (&mut work.0, &mut work.1, &mut work.2, &mut work.3);
        let middle = at.after(0.5 * h);

        stage.set_sum(y, 0.5 * h, k0);
        problem.rate(middle, stage, k2);
        stage.set_sum(y, 0.5 * h, k2);
        problem.rate(middle, stage, k3);
        stage.set_sum(y, h, k3);
        problem.rate(at.after(h), stage, k4);
        k2.add_scaled(1.0, k3);
        dy.set_increment(h / 6.0, [(1.0, k0), (2.0, k2), (1.0, k4)]);

        self.stage.take_back(work.0);
        self.k2.take_back(work.1);
        self.k3.take_back(work.2);
        self.k4.take_back(work.3);
    }
}
