//! Motion without contact: an integrator on its problem, and the motion of its last step.

use super::{Front, Integrator, Problem, Segment, StateVector};
use crate::math::sum::Time;
use crate::state::BodyMotion;
use std::fmt::Debug;

/// What a flight has done so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Counts {
    /// Steps taken.
    pub steps: u64,
    /// Steps refused by error control.
    pub rejected: u64,
    /// Evaluations of Y′.
    pub evaluations: u64,
    /// Largest `||q| − 1|`, or `‖RᵀR − I‖`, before an orientation was put back [-].
    pub orientation_drift: f64,
}

impl Counts {
    /// Adds the work of another flight; of two drifts the larger stays.
    pub fn add(&mut self, other: &Self) {
        self.steps += other.steps;
        self.rejected += other.rejected;
        self.evaluations += other.evaluations;
        self.orientation_drift = self.orientation_drift.max(other.orientation_drift);
    }
}

/// Why a flight cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlightError {
    /// A number is not finite any more.
    #[error("state is not finite")]
    NotFinite,
    /// A user's function gave up.
    #[error("a user effect failed: {0}")]
    UserEffect(String),
    /// Error control wants ever shorter steps: the loads change too abruptly for the tolerance.
    #[error("no step is short enough for the tolerance, not even {0:e} s")]
    StepTooShort(f64),
}

/// The motion of a group of bodies between contacts.
pub trait Flight: Debug + Send {
    /// How far the motion is known [s].
    fn front(&self) -> f64;

    /// Takes one step, which ends at `limit` [s] or before it. Of the motion only the front is known
    /// then; [`interpolate`](Self::interpolate) makes the rest known.
    ///
    /// # Errors
    /// The state is not finite any more, no step is short enough, or a user's function failed.
    fn advance(&mut self, limit: f64) -> Result<(), FlightError>;

    /// Takes steps until the front is at `to` [s] or behind it, none of which passes `limit` [s]; for
    /// those who do not look at the motion between.
    ///
    /// # Errors
    /// As [`advance`](Self::advance).
    fn advance_past(&mut self, to: f64, limit: f64) -> Result<(), FlightError> {
        while self.front() < to {
            self.advance(limit)?;
        }
        Ok(())
    }

    /// Makes the motion within the last step known.
    ///
    /// # Errors
    /// The motion is not finite, though both of its ends are.
    fn interpolate(&mut self) -> Result<(), FlightError>;

    /// The motion of the last step that was interpolated, as numbers.
    fn segment(&self) -> &Segment;

    /// The motion of every body at `t` [s]: at the front, or within the last step, interpolated.
    fn at(&self, t: f64, motions: &mut [BodyMotion]);

    /// The same at a time from the start of the last step [s], which no rounding of large times blurs.
    fn at_offset(&self, offset: f64, motions: &mut [BodyMotion]);

    /// Cuts the last step, interpolated, at a time from its start [s]: the front is there now.
    fn cut(&mut self, offset: f64);

    /// Sets the front's clock and the start of its interval without switches [s].
    fn set_clock(&mut self, time: Time, since: f64);

    /// Marks that the interval up to the front is over: what follows sees the other side of a switch.
    ///
    /// # Errors
    /// As [`interpolate`](Self::interpolate).
    fn pass_switch(&mut self) -> Result<(), FlightError>;

    /// From now on adds noise to the change of every number in every step, up to this part of it [-], as rounding does;
    /// a closed form has none.
    fn add_noise(&mut self, _part: f64) {}

    /// Leaves out the effects at these places of the scene from the front on, and no others; a closed form has none
    /// to leave out.
    fn leave_out(&mut self, _effects: &[usize]) {}

    /// What has been done so far.
    fn counts(&self) -> &Counts;

    /// The front's instant, and the start of its interval without switches [s].
    fn clock(&self) -> (Time, f64);

    /// The front as it is kept in a saved state.
    fn saved_front(&self) -> Front<Vec<f64>>;

    /// Goes on from a saved front.
    fn resume(&mut self, front: &Front<Vec<f64>>, segment: Segment, counts: Counts);
}

/// A flight by numerical integration.
#[derive(Debug)]
pub struct Integration<P: Problem> {
    problem: P,
    integrator: Box<dyn Integrator<P>>,
    front: Front<P::Y>,
    /// Where the last step began.
    start: Time,
    /// The last step that was interpolated, and whether a later one waits for it.
    segment: Segment,
    stale: bool,
    counts: Counts,
    noise: Option<Noise>,
}

/// Roundings on purpose, with which runs that share their own show what these do.
#[derive(Debug)]
struct Noise {
    /// The largest, as a part of a number's change in a step [-].
    part: f64,
    /// `SplitMix64` (Steele, Lea, Flood 2014, OOPSLA), from a fixed seed: the same bits in every run.
    random: u64,
    /// The numbers where the step began.
    start: Vec<f64>,
}

impl Noise {
    fn add_to(&mut self, y: &[f64], rest: &mut [f64]) {
        for ((y, rest), start) in y.iter().zip(rest).zip(&self.start) {
            self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mut z = self.random;
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            // the upper 53 digits, as a number of −1..1
            let random = 2.0 * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 1.0;
            *rest += self.part * random * (y - start);
        }
    }
}

impl<P: Problem> Integration<P> {
    /// A flight that starts at `t` [s] with the numbers `y`.
    pub fn new(problem: P, integrator: Box<dyn Integrator<P>>, t: f64, y: &[f64]) -> Self {
        let mut start = P::Y::zeros(y.len());
        start.as_mut().copy_from_slice(y);
        let front = Front { time: Time::new(t), since: t, y: start, rest: P::Y::zeros(y.len()) };
        let (segment, counts) = (Segment::default(), Counts::default());
        Self { problem, integrator, front, start: Time::new(t), segment, stale: false, counts, noise: None }
    }
}

impl<P: Problem> Integration<P> {
    /// A step, and more while the front is before `to` [s]. Why one failed is what a user's function
    /// complained about, before what came of it.
    fn take_steps(&mut self, to: f64, limit: f64) -> Result<(), FlightError> {
        let Self { problem, integrator, front, start, counts, stale, noise, .. } = self;
        *stale = true;
        if let Some(noise) = noise {
            noise.start.copy_from_slice(front.y.as_ref());
        }
        let taken = integrator.advance(problem, front, (to, limit), counts);
        if let Some(noise) = noise {
            noise.add_to(front.y.as_ref(), front.rest.as_mut());
        }
        *start = integrator.last_start();
        taken.map_err(|error| problem.take_failure().map_or(error, FlightError::UserEffect))
    }
}

impl<P: Problem> Flight for Integration<P> {
    fn front(&self) -> f64 {
        self.front.time.value
    }

    fn advance(&mut self, limit: f64) -> Result<(), FlightError> {
        self.take_steps(f64::NEG_INFINITY, limit)
    }

    fn advance_past(&mut self, to: f64, limit: f64) -> Result<(), FlightError> {
        if self.noise.is_none() {
            return if self.front() < to { self.take_steps(to, limit) } else { Ok(()) };
        }
        while self.front() < to {
            self.advance(limit)?;
        }
        Ok(())
    }

    fn interpolate(&mut self) -> Result<(), FlightError> {
        if !std::mem::take(&mut self.stale) {
            return Ok(());
        }
        let Self { problem, integrator, front, segment, counts, .. } = self;
        integrator.interpolate(problem, front, segment, counts);

        self.stale = !segment.is_finite();
        if self.stale { Err(FlightError::NotFinite) } else { Ok(()) }
    }

    fn segment(&self) -> &Segment {
        &self.segment
    }

    fn at(&self, t: f64, motions: &mut [BodyMotion]) {
        // the ends are the integrator's own states, to the bit
        if self.segment.dimension == 0 || t >= self.front.time.value {
            return self.problem.decode(self.front.y.as_ref(), motions);
        }
        self.at_offset(t - self.segment.start, motions);
    }

    fn at_offset(&self, offset: f64, motions: &mut [BodyMotion]) {
        let mut y = P::Y::zeros(self.segment.dimension);
        self.segment.at_offset(offset, y.as_mut());
        self.problem.decode(y.as_ref(), motions);
    }

    fn cut(&mut self, offset: f64) {
        self.segment.at_offset(offset, self.front.y.as_mut());
        self.front.rest.as_mut().fill(0.0);
        self.front.time = self.start + offset;
        self.segment.end = self.front.time.value;
        self.integrator.restart();
    }

    fn set_clock(&mut self, time: Time, since: f64) {
        self.front.time = time;
        self.front.since = since;
    }

    fn pass_switch(&mut self) -> Result<(), FlightError> {
        // what lies behind the switch is seen from its own side
        self.interpolate()?;
        self.front.since = self.front.time.value;
        self.integrator.restart();
        Ok(())
    }

    fn add_noise(&mut self, part: f64) {
        self.noise = Some(Noise { part, random: 0, start: self.front.y.as_ref().to_vec() });
    }

    fn leave_out(&mut self, effects: &[usize]) {
        if self.problem.leave_out(effects) {
            self.integrator.restart();
        }
    }

    fn counts(&self) -> &Counts {
        &self.counts
    }

    fn clock(&self) -> (Time, f64) {
        (self.front.time, self.front.since)
    }

    fn saved_front(&self) -> Front<Vec<f64>> {
        let Front { time, since, y, rest } = &self.front;
        Front { time: *time, since: *since, y: y.as_ref().to_vec(), rest: rest.as_ref().to_vec() }
    }

    fn resume(&mut self, front: &Front<Vec<f64>>, segment: Segment, counts: Counts) {
        self.set_clock(front.time, front.since);
        self.start = Time::new(segment.start);
        self.front.y.as_mut().copy_from_slice(&front.y);
        self.front.rest.as_mut().copy_from_slice(&front.rest);
        self.segment = segment;
        self.stale = false;
        self.counts = counts;
        self.integrator.restart();
    }
}
