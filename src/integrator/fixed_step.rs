//! What all methods with a fixed step share: the steps' ends, the slopes at them, and the motion
//! between them.

use super::{Counts, Front, Integrator, Kernel, Problem, Segment, StateVector};
use crate::tolerance::STEP_REMAINDER;

/// A method with a fixed step. Steps follow each other from the start or the last hard stop; the
/// one before a hard stop is shortened so that it ends there.
#[derive(Debug)]
pub(super) struct FixedStep<P: Problem, K> {
    step: f64,
    projection: bool,
    kernel: K,
    /// Slope at the front, if known.
    slope: P::Y,
    slope_known: bool,
    next_slope: P::Y,
    start: P::Y,
}

impl<P: Problem, K: Kernel<P::Y>> FixedStep<P, K> {
    pub(super) fn new(n: usize, step: f64, projection: bool) -> Self {
        Self {
            step,
            projection,
            kernel: K::new(n),
            slope: P::Y::zeros(n),
            slope_known: false,
            next_slope: P::Y::zeros(n),
            start: P::Y::zeros(n),
        }
    }
}

impl<P: Problem, K: Kernel<P::Y>> Integrator<P> for FixedStep<P, K> {
    fn advance(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        limit: f64,
        segment: &mut Segment,
        counts: &mut Counts,
    ) {
        let at = front.moment();
        if !self.slope_known {
            problem.rate(at, &front.y, &mut self.slope);
            counts.evaluations += 1;
        }

        // the step, cut or stretched by a hair so that it ends on the limit
        let left = front.time.until(limit);
        let last = left <= self.step * (1.0 + STEP_REMAINDER);
        let h = if last { left } else { self.step };
        self.start.clone_from(&front.y);
        self.kernel.step(problem, at, &mut front.y, &self.slope, h);
        let strayed = if self.projection { problem.project(&mut front.y) } else { problem.orientation_error(&front.y) };
        front.time = if last { crate::math::sum::Time::new(limit) } else { front.time + h };

        // the motion between the ends is the cubic through both states and slopes
        problem.rate(front.moment(), &front.y, &mut self.next_slope);
        segment.set_hermite(at, h, [&self.start, &self.slope, &front.y, &self.next_slope].map(AsRef::as_ref));
        std::mem::swap(&mut self.slope, &mut self.next_slope);
        self.slope_known = true;

        counts.steps += 1;
        counts.evaluations += u64::from(K::EVALUATIONS);
        counts.orientation_drift = counts.orientation_drift.max(strayed);
    }

    fn restart(&mut self) {
        self.slope_known = false;
    }
}
