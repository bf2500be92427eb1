//! Splitting into flows that are known exactly: what the methods of this kind share.
//!
//! ```text
//! kick(h):  momenta move by h times the loads at the present position        exp(h B)
//! flow(h):  the bodies move without loads                                    exp(h A)
//! step(h) = kick(½h) flow(h) kick(½h)                                         order 2 (Strang 1968)
//! ```
//!
//! Steps of lengths γ₁h, …, γₛh with Σγ = 1 one after another cancel the errors of lower orders
//! (Suzuki 1990, Phys. Lett. A 146:319; Kahan, Li 1997, Math. Comp. 66:1089). The loads at the end of one
//! are those at the start of the next, so their kicks are one. The method is symmetric: run backwards, it
//! retraces its steps. |L| of a free body is kept to rounding, the energy swings within a bound that
//! shrinks as the order says, over any number of steps.
//!
//! A load that depends on velocities is not constant during a kick; it is then taken with the classical
//! Runge–Kutta method, which keeps orders up to 4.

use super::{Problem, StateVector};
use crate::freedom::RotationSplit;
use crate::state::Moment;

/// The vectors that a splitting works with.
#[derive(Debug)]
pub(super) struct Workspace<Y> {
    y: Y,
    /// What rounding dropped of y within the step.
    rest: Y,
    stage: Y,
    k: [Y; 4],
    drift: Y,
}

impl<Y: StateVector> Workspace<Y> {
    pub(super) fn new(n: usize) -> Self {
        let zeros = || Y::zeros(n);
        Self { y: zeros(), rest: zeros(), stage: zeros(), k: std::array::from_fn(|_| zeros()), drift: zeros() }
    }

    /// The change of `y` in a step of length `h`, made of parts `gammas`.
    pub(super) fn compose<P: Problem<Y = Y>>(
        &mut self,
        problem: &mut P,
        at: Moment,
        y: &Y,
        h: f64,
        (gammas, split): (&[f64], RotationSplit),
        dy: &mut Y,
    ) {
        self.y.clone_from(y);
        self.rest.as_mut().fill(0.0);
        let mut passed = 0.0;
        self.kick(problem, at, 0.5 * gammas[0] * h);
        for (i, gamma) in gammas.iter().enumerate() {
            problem.flow(&mut self.y, &mut self.rest, gamma * h, split);
            passed += gamma;
            let next = gammas.get(i + 1).copied().unwrap_or_default();
            let now = if i + 1 == gammas.len() { at.after(h) } else { at.after(passed * h) };
            self.kick(problem, now, 0.5 * (gamma + next) * h);
        }
        dy.set_sum(&self.y, -1.0, y);
        dy.add_scaled(1.0, &self.rest);
    }

    /// Moves the momenta by the loads at the present position.
    fn kick<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, h: f64) {
        if !problem.is_loaded() {
            return;
        }
        let Self { y, rest, stage, k: [k1, k2, k3, k4], drift } = self;
        loads(problem, at, y, k1, drift);
        if !problem.depends_on_velocity() {
            stage.set_increment(h, [(1.0, k1)]);
            return y.add_compensated(stage, rest);
        }
        stage.set_sum(y, 0.5 * h, k1);
        loads(problem, at, stage, k2, drift);
        stage.set_sum(y, 0.5 * h, k2);
        loads(problem, at, stage, k3, drift);
        stage.set_sum(y, h, k3);
        loads(problem, at, stage, k4, drift);
        stage.set_increment(h / 6.0, [(1.0, k1), (2.0, k2), (2.0, k3), (1.0, k4)]);
        y.add_compensated(stage, rest);
    }
}

/// The part of f that the loads make.
fn loads<P: Problem>(problem: &mut P, at: Moment, y: &P::Y, k: &mut P::Y, drift: &mut P::Y) {
    problem.rate(at, y, k);
    problem.drift(y, drift);
    k.add_scaled(-1.0, drift);
}

/// Declares the kernel of a composed splitting.
macro_rules! splitting_kernel {
    ($split:expr, $gammas:expr) => {
        #[derive(Debug)]
        pub(super) struct Kernel<Y>(super::splitting::Workspace<Y>);

        impl<Y: super::StateVector> super::Kernel<Y> for Kernel<Y> {
            const EVALUATIONS: u32 = EVALUATIONS;
            const NEEDS_SLOPE: bool = false;

            fn new(n: usize) -> Self {
                Self(super::splitting::Workspace::new(n))
            }

            fn step<P: super::Problem<Y = Y>>(
                &mut self,
                problem: &mut P,
                at: crate::state::Moment,
                y: &Y,
                _k0: &Y,
                h: f64,
                dy: &mut Y,
            ) {
                self.0.compose(problem, at, y, h, ($gammas, $split), dy);
            }
        }
    };
}
pub(super) use splitting_kernel;
