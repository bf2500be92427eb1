//! Power series of the motion, of any order (Jorba, Zou 2005, Exp. Math. 14:99; Biscani, Izzo 2021, MNRAS 504:2614).
//!
//! ```text
//! y(t + s) = Σ c_k s^k,  k = 0 … N        by recurrences from the loads themselves, without differences
//! h = min (ε/|c_k|)^(1/k),  k = N − 1, N   the longest step whose last terms stay below the error ε allowed
//! ```
//!
//! What is left out of a step is some seventh of its last term. The series is the motion within the step too. Its
//! products take N² operations where a step's length grows with N, so that the order rises with the digits asked for:
//! some `N = 1 − ½ ln ε` costs least. Cheaper than order 8 at tolerances of some 1e-8 and below. It takes loads that are
//! power series themselves: gravity, engines, wrenches, drag in proportion to the speed. It keeps neither |L| nor the
//! energy, but at high order loses them by rounding only.

use super::stepper::{SHORTEST, cut};
use super::{Control, Counts, FlightError, Front, Integrator, Limits, Problem, Segment, StateVector};
use crate::math::series::Tape;
use crate::math::sum::Time;
use crate::state::Moment;

/// The order where steps are given.
pub(super) const ORDER: u32 = 8;
/// A series counts as one evaluation.
pub(super) const EVALUATIONS: u32 = 1;
pub(super) const BODY_AXES: bool = true;
/// Orders that can be asked for: at least two terms tell a step's length, and beyond the last there are no digits.
pub(crate) const ORDERS: std::ops::RangeInclusive<u32> = 3..=40;

/// The order that costs least for a tolerance [-]: that of Jorba and Zou, and where no finer runs follow, which have
/// shorter steps, so much more as the work of an order that does not grow with it pays for.
pub(crate) fn order_for(tolerance: f64, finer_follow: bool) -> u32 {
    let order = 1.0 - 0.5 * libm::log(tolerance) + if finer_follow { 0.0 } else { LONGER };
    ORDERS.into_iter().find(|&n| f64::from(n) >= order).unwrap_or(*ORDERS.end())
}

/// Orders beyond Jorba's and Zou's that cost least [-]: of tops and driven bodies the time hardly changes from 4 to 8.
const LONGER: f64 = 6.0;

/// Work of a step of some order, as a multiple of that where steps are given [-]: some part grows with the order, some
/// with its square, even at 21. Measured on a top at orders 12, 18 and 24.
pub(crate) fn effort(order: u32) -> f64 {
    let work = |order: u32| f64::from(order * (order + 21));
    work(order) / work(ORDER)
}

/// The method on its way.
#[derive(Debug)]
pub(super) struct Taylor<P: Problem> {
    order: usize,
    control: Control,
    projection: bool,
    /// The recurrences, played from the start of the last step, and the interval without switches whose loads they
    /// know; not a number where they know none.
    tape: Tape,
    since: f64,
    /// The last step: its start and its length.
    at: Moment,
    began: Time,
    h: f64,
    terms: P::Y,
    increment: P::Y,
}

impl<P: Problem> Taylor<P> {
    pub(super) fn new(order: u32, n: usize, control: Control, projection: bool) -> Self {
        let order = order as usize;
        Self {
            order,
            control,
            projection,
            tape: Tape::new(order),
            since: f64::NAN,
            at: Moment { time: 0.0, since: 0.0 },
            began: Time::default(),
            h: 0.0,
            terms: P::Y::zeros(n),
            increment: P::Y::zeros(n),
        }
    }

    /// Finds the series at the front.
    fn expand(&mut self, problem: &P, front: &Front<P::Y>) {
        self.at = front.moment();
        if self.since != front.since {
            self.tape = problem.tape(self.at, self.order);
            self.since = front.since;
        }
        self.tape.play(self.at.time, front.y.as_ref());
    }

    /// The longest step whose last two terms are as small as the limits say [s].
    fn longest(&mut self, problem: &P, y: &P::Y, limits: &Limits) -> f64 {
        let mut longest = limits.longest;
        for k in [self.order - 1, self.order] {
            self.tape.read(k, self.terms.as_mut());
            let size = problem.error_size(y, y, &self.terms, &limits.scales);
            if size > 0.0 {
                longest = longest.min(libm::pow(limits.local / size, 1.0 / k as f64));
            }
        }
        longest
    }
}

impl<P: Problem> Integrator<P> for Taylor<P> {
    fn advance(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        (to, limit): (f64, f64),
        counts: &mut Counts,
    ) -> Result<(), FlightError> {
        loop {
            self.began = front.time;
            self.expand(problem, front);
            counts.evaluations += 1;

            // where the step ends
            let left = front.time.until(limit);
            let step = match &self.control {
                Control::Step(step) => *step,
                Control::Mesh(mesh) => front.time.until(mesh.end_after(front.time.value)),
                Control::Error(limits) => {
                    let limits = *limits;
                    let longest = self.longest(problem, &front.y, &limits);
                    if longest <= SHORTEST * front.time.value.abs() {
                        return Err(FlightError::StepTooShort(longest));
                    }
                    // no sliver is left before the limit
                    if longest < left && 2.0 * longest > left { 0.5 * left } else { longest }
                }
            };
            let (h, end) = cut(front.time, step, limit);
            self.h = h;
            self.tape.change(h, self.increment.as_mut());
            let strayed =
                if self.projection { problem.project(&front.y, &front.rest, &mut self.increment) } else { 0.0 };
            front.y.add_compensated(&self.increment, &mut front.rest);
            if !front.y.is_finite() {
                return Err(FlightError::NotFinite);
            }
            front.time = end;
            counts.steps += 1;
            let strayed = if self.projection { strayed } else { problem.orientation_error(&front.y) };
            counts.orientation_drift = counts.orientation_drift.max(strayed);
            if end.value >= to {
                // what the last step has strayed is put right by the next
                counts.orientation_drift = counts.orientation_drift.max(problem.orientation_error(&front.y));
                return Ok(());
            }
        }
    }

    fn last_start(&self) -> Time {
        self.began
    }

    fn interpolate(&mut self, problem: &mut P, _front: &Front<P::Y>, segment: &mut Segment, _counts: &mut Counts) {
        // terms of s/h; orientations are divided by their length where they are read, as at the step's end
        let n = problem.dimension();
        let coefficients = segment.set_span(self.at, self.h, n, self.order + 1);
        let mut scale = 1.0;
        for (k, terms) in coefficients.chunks_exact_mut(n.max(1)).enumerate() {
            self.tape.read(k, terms);
            for c in terms {
                *c *= scale;
            }
            scale *= self.h;
        }
    }

    fn restart(&mut self) {
        self.since = f64::NAN;
    }
}
