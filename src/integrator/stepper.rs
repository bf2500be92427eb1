//! What all one-step methods share: where steps end, how long they are, and what is kept of them.

use super::{Control, Counts, FlightError, Front, Integrator, Kernel, Limits, Problem, Segment, StateVector, Step};
use crate::math::sum::Time;
use crate::state::Moment;
use crate::tolerance::STEP_REMAINDER;

/// A one-step method on its way.
///
/// ```text
/// Y₁ = Y₀ + ΔY,  ΔY amended so that orientations stay on their sphere        both sums compensated
/// ```
///
/// With [`Control::Step`] steps follow each other from the start or the last hard stop, and the one
/// before a hard stop is shortened so that it ends there; [`Control::Mesh`] prescribes their ends. With
/// [`Control::Error`] the length follows
/// the method's own estimate `e` of a step's error, as a part of what is allowed (Gustafsson 1991,
/// ACM Trans. Math. Softw. 17:533):
///
/// ```text
/// accepted where e ≤ 1;   h ← 0.9 h e^(−0.85/k) e₋^(0.2/k)        k the order of e, e₋ of the step before
/// ```
#[derive(Debug)]
pub(super) struct Stepper<P: Problem, K> {
    control: Control,
    projection: bool,
    kernel: K,
    /// The last step.
    last: Stride<P::Y>,
    /// The slope at its end, and whether it is known.
    end_slope: P::Y,
    slope_known: bool,
    /// What rounding had dropped where it began.
    start_rest: P::Y,
    /// Length that error control proposes for the next step [s]; 0 where it has none yet.
    proposal: f64,
    /// Error of the last accepted step, as a part of what is allowed [-].
    last_error: f64,
    /// How often a user's function gave up since the front was at `failed_end` [s], where the first of these
    /// steps would have led.
    failures: u32,
    failed_end: f64,
}

/// A step: where and when it began, its length, its slope there, and its change.
#[derive(Debug)]
struct Stride<Y> {
    began: Time,
    at: Moment,
    h: f64,
    start: Y,
    slope: Y,
    increment: Y,
    /// How far the orientations had strayed when they were put back [-].
    strayed: f64,
}

impl<Y: StateVector> Stride<Y> {
    /// See [`StateVector::take`].
    #[inline(always)]
    fn take(&mut self) -> Self {
        let (start, slope, increment) = (self.start.take(), self.slope.take(), self.increment.take());
        Self { start, slope, increment, ..*self }
    }

    /// Starts at the front.
    #[inline(always)]
    fn begin(&mut self, front: &Front<Y>) {
        self.began = front.time;
        self.at = front.moment();
        self.start.clone_from(&front.y);
    }

    /// Moves the front's numbers by a step of length `h` from the start.
    #[inline(always)]
    fn attempt<P: Problem<Y = Y>>(
        &mut self,
        kernel: &mut impl Kernel<Y>,
        problem: &mut P,
        front: &mut Front<Y>,
        h: f64,
        projection: bool,
    ) {
        self.h = h;
        kernel.step(problem, self.at, &front.y, &self.slope, h, &mut self.increment);
        if projection {
            self.strayed = problem.project(&front.y, &front.rest, &mut self.increment);
        }
        front.y.add_compensated(&self.increment, &mut front.rest);
    }
}

/// Growth and shrinkage of a step are kept within these factors [-].
const GROWTH: (f64, f64) = (0.2, 6.0);
/// Factor of caution in the next step [-]: about one step in ten is refused at 0.95, one in fifty at 0.9.
const CAUTION: f64 = 0.9;
/// Refusals in a row after which the step is said to have no end [-]: each shortens it by at least a tenth.
const REFUSALS: u32 = 64;
/// Steps that a user's function may break before the run ends [-]: each is tried again at a fifth of its length.
const FAILURES: u32 = 3;
/// Steps shorter than this part of the instant's size cannot be told from none [-].
pub(super) const SHORTEST: f64 = 4.0 * f64::EPSILON;
/// Least error of the last step that the next takes note of [-].
const LEAST_ERROR: f64 = 1.0e-4;

/// A step of length `step` from an instant, cut or stretched by a hair where it ends on the limit: its length and its
/// end.
#[inline(always)]
pub(super) fn cut(time: Time, step: f64, limit: f64) -> (f64, Time) {
    let left = time.until(limit);
    if left <= step * (1.0 + STEP_REMAINDER) { (left, Time::new(limit)) } else { (step, time + step) }
}

impl<P: Problem, K: Kernel<P::Y>> Stepper<P, K> {
    pub(super) fn new(n: usize, control: Control, projection: bool) -> Self {
        Self::with(K::new(n), n, control, projection)
    }

    pub(super) fn with(kernel: K, n: usize, control: Control, projection: bool) -> Self {
        let zeros = || P::Y::zeros(n);
        Self {
            control,
            projection,
            kernel,
            last: Stride {
                began: Time::default(),
                at: Moment { time: 0.0, since: 0.0 },
                h: 0.0,
                start: zeros(),
                slope: zeros(),
                increment: zeros(),
                strayed: 0.0,
            },
            end_slope: zeros(),
            slope_known: false,
            start_rest: zeros(),
            proposal: 0.0,
            last_error: LEAST_ERROR,
            failures: 0,
            failed_end: f64::NEG_INFINITY,
        }
    }

    /// Starts a step at the front: the slope there.
    #[inline(always)]
    fn begin(&mut self, problem: &mut P, front: &Front<P::Y>, last: &mut Stride<P::Y>, counts: &mut Counts) {
        last.begin(front);
        if self.slope_known {
            last.slope.clone_from(&self.end_slope);
            self.slope_known = false;
        } else if K::NEEDS_SLOPE {
            problem.rate(last.at, &front.y, &mut last.slope);
            counts.evaluations += 1;
        }
    }

    /// Counts a step just tried; the evaluation at its start has been counted.
    #[inline(always)]
    fn count(&self, counts: &mut Counts) {
        counts.evaluations += u64::from(self.kernel.evaluations()) - u64::from(K::NEEDS_SLOPE);
    }

    /// Completes a step that ends at `time`.
    #[inline(always)]
    fn accept(&self, problem: &P, front: &mut Front<P::Y>, strayed: f64, time: Time, counts: &mut Counts) {
        let strayed = if self.projection { strayed } else { problem.orientation_error(&front.y) };
        front.time = time;
        counts.steps += 1;
        counts.orientation_drift = counts.orientation_drift.max(strayed);
    }

    /// A first length, from the sizes of the first and second derivative (Hairer, Nørsett, Wanner,
    /// Solving ODEs I, §II.4).
    fn first_length(&mut self, problem: &mut P, limits: &Limits, left: f64, counts: &mut Counts) -> f64 {
        let Self { start_rest: guess, end_slope, last: Stride { at, start, slope, increment, .. }, .. } = self;
        let size = |problem: &P, v: &P::Y, y: &P::Y| problem.error_size(y, y, v, &limits.scales) / limits.local;
        let d1 = size(problem, slope, start);
        let h0 = if d1 > 0.0 { (0.01 / (d1 * limits.local)).min(left) } else { left };

        // an Euler step shows how fast the slope changes
        guess.set_sum(start, h0, slope);
        problem.rate(at.after(h0), guess, end_slope);
        counts.evaluations += 1;
        increment.set_sum(end_slope, -1.0, slope);
        let d2 = size(problem, increment, start) / h0;
        let steepest = d1.max(d2);
        if steepest > 0.0 { libm::pow(0.01 / steepest, 1.0 / K::ERROR_ORDER).min(100.0 * h0) } else { left }
    }

    /// Takes steps of given lengths, as [`advance`](Integrator::advance) does.
    #[inline(always)]
    fn advance_given(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        (to, limit): (f64, f64),
        counts: &mut Counts,
    ) -> Result<(), FlightError> {
        // on copies that nobody else knows the place of: what one step leaves in registers the next finds there
        let mut here = Front { y: front.y.take(), rest: front.rest.take(), ..*front };
        let mut last = self.last.take();
        let outcome = loop {
            self.begin(problem, &here, &mut last, counts);
            let step = match &self.control {
                Control::Step(step) => *step,
                Control::Mesh(mesh) => here.time.until(mesh.end_after(here.time.value)),
                Control::Error(limits) => limits.longest,
            };
            let (h, time) = cut(here.time, step, limit);
            last.attempt(&mut self.kernel, problem, &mut here, h, self.projection);
            self.count(counts);
            self.accept(problem, &mut here, last.strayed, time, counts);
            if !here.y.is_finite() {
                // the front stays where the motion is still known
                (here.y, here.time) = (last.start.clone(), last.began);
                here.rest.as_mut().fill(0.0);
                break Err(FlightError::NotFinite);
            }
            if here.time.value >= to {
                break Ok(());
            }
        };
        *front = here;
        self.last = last;
        outcome
    }

    /// The same where the error decides the lengths.
    fn advance_controlled(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        (to, limit): (f64, f64),
        limits: &Limits,
        counts: &mut Counts,
    ) -> Result<(), FlightError> {
        loop {
            let mut last = self.last.take();
            self.begin(problem, front, &mut last, counts);
            self.last = last;
            self.take_controlled(problem, front, limit, limits, counts)?;
            if !front.y.is_finite() {
                return Err(FlightError::NotFinite);
            }
            if front.time.value >= to {
                return Ok(());
            }
        }
    }

    /// Takes a step that was begun, which ends at `limit` or before it, as long as its error allows.
    fn take_controlled(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        limit: f64,
        limits: &Limits,
        counts: &mut Counts,
    ) -> Result<(), FlightError> {
        let left = front.time.until(limit);
        if self.proposal <= 0.0 {
            self.proposal = self.first_length(problem, limits, left, counts);
        }
        self.start_rest.clone_from(&front.rest);
        let mut grow = GROWTH.1;
        for _ in 0..REFUSALS {
            // the proposal, so that no sliver is left before the limit
            let wanted = self.proposal.min(limits.longest);
            let last = wanted * (1.0 + STEP_REMAINDER) >= left;
            let h = if last {
                left
            } else if 2.0 * wanted > left {
                0.5 * left
            } else {
                wanted
            };
            if h <= SHORTEST * front.time.value.abs() {
                return Err(FlightError::StepTooShort(h));
            }

            self.last.attempt(&mut self.kernel, problem, front, h, self.projection);
            let error = self.kernel.error(problem, &self.last.start, &front.y, h, &limits.scales);
            self.count(counts);
            let size = if front.y.is_finite() { error / limits.local } else { f64::INFINITY };
            if size == f64::INFINITY
                && let Some(message) = problem.take_failure()
            {
                // the path may not lead where the function gave up: shorter, but not for ever
                if self.failures == 0 {
                    self.failed_end = self.last.at.time + h;
                }
                self.failures += 1;
                if self.failures >= FAILURES {
                    return Err(FlightError::UserEffect(message));
                }
            }
            if size <= 1.0 {
                let size = size.max(LEAST_ERROR);
                let factor = CAUTION
                    * libm::pow(size, -0.85 / K::ERROR_ORDER)
                    * libm::pow(self.last_error, 0.2 / K::ERROR_ORDER);
                let next = h * factor.clamp(GROWTH.0, grow);
                // a step cut short by the limit says nothing against the length proposed before it
                self.proposal = if h < wanted { next.max(self.proposal) } else { next };
                self.last_error = size;
                let time = if last { Time::new(limit) } else { front.time + h };
                self.accept(problem, front, self.last.strayed, time, counts);
                if front.time.value >= self.failed_end {
                    self.failures = 0;
                }
                return Ok(());
            }

            // refused, or not a number: shorter, and no growth right after
            counts.rejected += 1;
            front.y.clone_from(&self.last.start);
            front.rest.clone_from(&self.start_rest);
            grow = 1.0;
            let factor = if size.is_finite() { CAUTION * libm::pow(size, -1.0 / K::ERROR_ORDER) } else { GROWTH.0 };
            self.proposal = h * factor.clamp(GROWTH.0, CAUTION);
        }
        Err(FlightError::StepTooShort(self.proposal))
    }
}

impl<P: Problem, K: Kernel<P::Y>> Integrator<P> for Stepper<P, K> {
    fn advance(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        span: (f64, f64),
        counts: &mut Counts,
    ) -> Result<(), FlightError> {
        match self.control {
            Control::Error(limits) if K::ESTIMATES_ERROR => {
                self.advance_controlled(problem, front, span, &limits, counts)?;
            }
            _ => self.advance_given(problem, front, span, counts)?,
        }
        // what the last step has strayed is put right by the next
        counts.orientation_drift = counts.orientation_drift.max(problem.orientation_error(&front.y));
        Ok(())
    }

    fn last_start(&self) -> Time {
        self.last.began
    }

    fn interpolate(&mut self, problem: &mut P, front: &Front<P::Y>, segment: &mut Segment, counts: &mut Counts) {
        if !K::NEEDS_SLOPE {
            let Stride { at, start, slope, .. } = &mut self.last;
            problem.rate(*at, start, slope);
            counts.evaluations += 1;
        }
        if !self.slope_known {
            problem.rate(self.last.at.after(self.last.h), &front.y, &mut self.end_slope);
            self.slope_known = K::NEEDS_SLOPE;
            counts.evaluations += 1;
        }
        let Self { last: Stride { at, h, start, slope, .. }, end_slope, kernel, .. } = self;
        let step = Step { at: *at, h: *h, y0: start, k0: slope, y1: &front.y, k1: end_slope };
        counts.evaluations += u64::from(kernel.interpolate(problem, &step, segment));
    }

    fn restart(&mut self) {
        self.slope_known = false;
        self.last_error = LEAST_ERROR;
    }
}
