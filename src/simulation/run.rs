//! Whole runs: a scene over a span, sampled, with its error estimated.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::clock::thread_seconds;
use super::estimate::{self, Comparison};
use super::{Failure, Grain, RunError, Simulation, SimulationError};
use crate::error::{Error, Result};
use crate::freedom::Scales;
use crate::integrator::{Control, Limits, Mesh, Method};
use crate::plan::Plan;
use crate::scene::{RunOptions, Scene, Span};
use crate::trajectory::{EventKind, Trajectory};

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Part of the present pass that is done, 0..=1.
    pub fraction: f64,
    /// Number of the pass, from 1: an error estimate takes several.
    pub pass: u32,
}

/// Told how far a run is, after every step that is looked at, and after some hundred of those that are not; it may stop
/// the run.
pub type Observer<'a> = &'a mut dyn FnMut(Progress) -> ControlFlow<()>;

impl Scene {
    /// Runs the scene over a span [s].
    ///
    /// # Errors
    /// Bad input, and a run that cannot go on; the latter carries the trajectory so far.
    pub fn run(&self, span: impl Into<Span>, options: &RunOptions) -> Result<Trajectory, RunError> {
        self.run_observed(span, options, &mut |_| ControlFlow::Continue(()))
    }

    /// The same, with someone to be told how far it is, and who may stop it.
    ///
    /// # Errors
    /// As [`run`](Self::run); a run that was stopped ends in [`Failure::Interrupted`].
    pub fn run_observed(
        &self,
        span: impl Into<Span>,
        options: &RunOptions,
        observer: Observer<'_>,
    ) -> Result<Trajectory, RunError> {
        let (began, span) = (thread_seconds(), span.into());
        // the span takes part in the choice of a method; a bad one is refused by the run
        let t_span = (span.start < span.end && (span.end - span.start).is_finite()).then_some([span.start, span.end]);
        let plan = self.compile(&RunOptions { t_span, ..options.clone() })?;
        let compile = thread_seconds() - began;
        let mut result = run_shared(&Arc::new(plan), span, observer);
        if let Ok(run) = &mut result {
            run.report.seconds.compile = compile;
        }
        result
    }
}

/// Runs a plan that its trajectory will hold.
fn run_shared(plan: &Arc<Plan>, span: Span, observer: Observer<'_>) -> Result<Trajectory, RunError> {
    let times = plan.options().times(span)?;
    match (plan.options().step, plan.tolerance()) {
        (Some(step), _) => plan.run_with_step(span, &times, step, observer),
        (None, tolerance) => {
            let tolerance = tolerance.unwrap_or(crate::plan::DEFAULT_TOLERANCE);
            plan.run_to_tolerance(span, &times, tolerance, observer)
        }
    }
}

impl Plan {
    /// Runs the plan over a span [s].
    ///
    /// # Errors
    /// As [`Scene::run`].
    pub fn run(&self, span: impl Into<Span>) -> Result<Trajectory, RunError> {
        self.run_observed(span, &mut |_| ControlFlow::Continue(()))
    }

    /// The same, with someone to be told how far it is, and who may stop it.
    ///
    /// # Errors
    /// As [`Scene::run_observed`].
    pub fn run_observed(&self, span: impl Into<Span>, observer: Observer<'_>) -> Result<Trajectory, RunError> {
        run_shared(&Arc::new(self.clone()), span.into(), observer)
    }

    /// One run with the step asked for, and one with twice the step to estimate its error.
    fn run_with_step(
        self: &Arc<Self>,
        span: Span,
        times: &[f64],
        step: f64,
        observer: Observer<'_>,
    ) -> Result<Trajectory, RunError> {
        let course = Course { plan: self.clone(), span, times };
        let began = thread_seconds();
        let mut run = course.pass(self.controls(&Control::Step(step)), Grain::FINE, 1, observer).map_err(Box::new)?.0;
        run.report.seconds.run = thread_seconds() - began;
        run.report.step = step;
        run.report.horizon = run.end;
        run.report.length_scale = estimate::length_scale(&run);
        if !self.options().estimate {
            return Ok(run);
        }
        if self.is_closed() && !has_impacts(&run) {
            run.report.error_estimate = Some(self.rounding(span));
            run.report.estimated_by = "rounding of the closed form".into();
            return Ok(run);
        }

        let began = thread_seconds();
        let grain = Grain::times(2.0, full_gain(self.order()));
        let coarse = course.pass(self.controls(&Control::Step(2.0 * step)), grain, 2, observer);
        run.report.seconds.estimate = thread_seconds() - began;
        match coarse {
            Ok((coarse, _)) => {
                let gain = if has_impacts(&run) { EVENT_GAIN } else { full_gain(self.order()) };
                let comparison = Comparison::new(&run, &coarse, gain, self.rounding(span), None);
                run.report.error_estimate = Some(comparison.within_horizon);
                run.report.estimated_by = "against a second run with twice the step".into();
                if comparison.worst > comparison.within_horizon {
                    run.report.horizon = comparison.horizon;
                    run.report.estimated_by =
                        "up to the horizon, after which the impacts of a second run differ".into();
                }
            }
            Err(error) if error.kind.is_final() => return Err(Box::new(error).into()),
            Err(_) => run.report.estimated_by = "not estimated: a second run with twice the step broke off".into(),
        }
        Ok(run)
    }

    /// Makes passes in threes, each with half the steps of the one before, until they agree to the
    /// tolerance; the finest is the result.
    ///
    /// Where the method controls its error, the steps follow it; else they are all the same. In either
    /// case a pass cuts every step of another in two, so that its error falls as the method's order says,
    /// and where it does not, the three show it.
    fn run_to_tolerance(
        self: &Arc<Self>,
        span: Span,
        times: &[f64],
        tolerance: f64,
        observer: Observer<'_>,
    ) -> Result<Trajectory, RunError> {
        let floor = FLOOR * self.rounding(span);
        if tolerance < floor {
            let allowed = format!("at least {floor:.1e}, what rounding leaves of this scene");
            return Err(Error::value("run", "tolerance", allowed, tolerance).into());
        }
        let course = Course { plan: self.clone(), span, times };
        let estimates = self.options().estimate;
        let mut pace = Pace::first(self, span, tolerance);
        let (began, mut mismatches, mut finest) = (thread_seconds(), 0, None::<Trajectory>);
        for number in 0..ROUNDS {
            let (before, mut failure) = (thread_seconds(), None);
            let most_trusted = trusted(full_gain(self.order()));
            let grain = |times| pace.grain(times, most_trusted);
            let (mut run, nodes) = course.attempt(
                self.controls(&pace.control),
                if estimates { grain(4.0) } else { Grain { nudge: 0.0, ..grain(4.0) } },
                3 * number + 1,
                observer,
                &mut failure,
            )?;
            run.report.length_scale = estimate::length_scale(&run);
            run.report.seconds.run = thread_seconds() - before;
            run.report.seconds.estimate = before - began;

            // one run is enough where nobody asks for its error, or where rounding is all there is
            let closed = self.is_closed() && !has_impacts(&run);
            if closed && estimates {
                run.report.error_estimate = Some(self.rounding(span));
                run.report.estimated_by = "rounding of the closed form".into();
                run.report.met = Some(failure.is_none());
            }
            if closed || !estimates {
                return finish(run, span, tolerance, &pace, failure);
            }

            // what coarse steps broke, finer ones may mend; where those break, the round before has told
            if failure.is_some() {
                let next = pace.finer(self.order(), tolerance, f64::INFINITY);
                let steps = run.report.counts.steps as f64 * pace.longer(self.order(), &next);
                match finest {
                    Some(finest) => return Ok(finest),
                    None if pace.is_finest() || steps > MOST_STEPS || number + 1 == ROUNDS => {
                        return finish(run, span, tolerance, &pace, failure);
                    }
                    None => pace = next,
                }
                continue;
            }

            // the same steps, each cut in two, and in four
            let coarser = run;
            let nodes: Vec<Arc<[f64]>> = nodes.into_iter().map(Into::into).collect();
            let cut = |pieces| nodes.iter().map(|nodes| Control::Mesh(Mesh { nodes: nodes.clone(), pieces })).collect();
            let (mut coarse, _) = course.attempt(cut(2), grain(2.0), 3 * number + 2, observer, &mut None)?;
            coarse.report.length_scale = coarser.report.length_scale;
            let before = thread_seconds();
            failure = None;
            let (mut run, _) = course.attempt(cut(4), grain(1.0), 3 * number + 3, observer, &mut failure)?;
            run.report.length_scale = estimate::length_scale(&run);
            run.report.seconds.run = thread_seconds() - before;
            run.report.seconds.estimate = before - began;
            let gain = if has_impacts(&run) { EVENT_GAIN } else { observed_gain(self, &coarser, &coarse, &run) };
            let against = |other, gain| Comparison::new(&run, other, gain, self.rounding(span), Some(tolerance));
            let mut comparison = against(&coarse, gain);
            if gain <= 1.0 + LEAST_TRUST {
                // where rounding rules, two runs may be wrong alike by chance; three hardly are
                comparison = comparison.and(against(&coarser, gain * gain));
            }
            run.report.error_estimate = Some(comparison.within_horizon);
            run.report.estimated_by = if comparison.worst.is_finite() {
                "against runs with steps twice and four times as long".into()
            } else {
                "up to the horizon, after which the impacts of a second run differ".into()
            };
            run.report.met = Some(comparison.worst <= tolerance);
            let next = pace.finer(self.order(), tolerance, comparison.worst);
            let steps = run.report.counts.steps as f64 * pace.longer(self.order(), &next);
            let differs = comparison.worst.is_infinite() && has_impacts(&run);
            mismatches += u32::from(differs);
            let is_last = pace.is_finest() || steps > MOST_STEPS || number + 1 == ROUNDS || mismatches == MISMATCHES;
            let length = run.report.length_scale;
            match finish(run, span, tolerance, &pace, failure) {
                Ok(mut run) => {
                    run.report.horizon = comparison.horizon;
                    if comparison.worst <= tolerance {
                        return Ok(run);
                    }
                    // not the one with the farthest horizon, which may be but the one with the luckiest estimate
                    finest = Some(run);
                }
                Err(error) if is_last && finest.is_none() => return Err(error),
                Err(_) => {}
            }
            if let Some(finest) = finest.take_if(|_| is_last) {
                return Ok(finest);
            }
            pace = next;
            pace.measure_by(length);
        }
        Err(Error::refused("run", "no pass was made").into())
    }

    /// Whether every flight has a closed form.
    fn is_closed(&self) -> bool {
        self.groups().iter().all(|group| group.method == Method::Exact)
    }

    /// Error that rounding alone leaves of a run [-]: some ε for every radian turned.
    fn rounding(&self, span: Span) -> f64 {
        let turning = self.bodies().iter().map(|body| body.start.angular_velocity.norm()).fold(0.0, f64::max);
        ROUNDING * (1.0 + turning * (span.end - span.start))
    }

    /// A guess of the length that position errors are measured by [m], before the paths are known.
    fn first_length_scale(&self, span: Span) -> f64 {
        let time = span.end - span.start;
        let reach =
            self.bodies().iter().map(|body| body.radius.max(body.start.velocity.norm() * time)).fold(0.0, f64::max);
        self.options().length_scale.unwrap_or(if reach > 0.0 { reach } else { 1.0 })
    }
}

/// Completes the report of the run that is kept; what broke it off is handed on with it.
fn finish(
    mut run: Trajectory,
    span: Span,
    tolerance: f64,
    pace: &Pace,
    failure: Option<SimulationError>,
) -> Result<Trajectory, RunError> {
    run.report.tolerance = Some(tolerance);
    run.report.horizon = run.end;
    let lanes = run.plan().groups().len() as f64;
    run.report.step = lanes * (span.end - span.start) / (run.report.counts.steps as f64).max(lanes);
    if let Control::Error(limits) = &pace.control {
        run.report.local_tolerance = Some(limits.local);
    }
    match failure {
        Some(error) => Err(Box::new(SimulationError { trajectory: Some(Box::new(run)), ..error }).into()),
        None => Ok(run),
    }
}

/// What the passes of a run have in common.
struct Course<'a> {
    plan: Arc<Plan>,
    span: Span,
    /// The samples [s].
    times: &'a [f64],
}

impl Course<'_> {
    /// One pass; where it breaks off, the run so far, and why in `failure`: what a coarse step broke, a
    /// finer one may mend.
    fn attempt(
        &self,
        controls: Vec<Control>,
        grain: Grain,
        number: u32,
        observer: Observer<'_>,
        failure: &mut Option<SimulationError>,
    ) -> Result<(Trajectory, Vec<Vec<f64>>), RunError> {
        match self.pass(controls, grain, number, observer) {
            Ok(done) => Ok(done),
            Err(error) if error.kind.is_final() => Err(Box::new(error).into()),
            Err(mut error) => {
                let Some(run) = error.trajectory.take() else { return Err(Box::new(error).into()) };
                *failure = Some(error);
                let nodes = vec![vec![self.span.start, self.span.end]; self.plan.groups().len()];
                Ok((*run, nodes))
            }
        }
    }

    /// One pass over the span, and the ends of the steps of every group. Every lane goes to its end; where one
    /// breaks off, the others stop there too.
    fn pass(
        &self,
        controls: Vec<Control>,
        grain: Grain,
        number: u32,
        observer: Observer<'_>,
    ) -> Result<(Trajectory, Vec<Vec<f64>>), SimulationError> {
        let Self { plan, span, times } = self;
        let span = *span;
        let refused = |error: Error| SimulationError {
            time: span.start,
            bodies: Vec::new(),
            kind: Failure::Refused(error.to_string()),
            trajectory: None,
        };
        let mut simulation = Simulation::new(plan.clone(), span, controls, grain).map_err(refused)?;
        let lanes = simulation.lanes.len();
        let mut run = Trajectory::new(plan.clone(), times.to_vec());
        for (group, spec) in plan.groups().iter().enumerate() {
            let motions: Vec<_> = spec.members.iter().map(|&i| plan.bodies()[i].start).collect();
            run.phases.push(plan.phase(group, span.start, &motions, &[]));
        }

        // those that may meet go by events; the others each on its own
        let mut broken: Option<SimulationError> = None;
        let alone = simulation.lanes_alone();
        let part = |of_all: usize| of_all as f64 / lanes as f64;
        let meeting = lanes - alone.len();
        if meeting > 0 {
            let mut tell = |done: f64| observer(Progress { fraction: part(meeting) * done, pass: number });
            broken = simulation.advance_meeting(span.end, &mut Some(&mut run), &mut tell).err();
        }
        let until = |simulation: &Simulation, broken: &Option<SimulationError>| {
            let stop = broken.as_ref().map_or(span.end, |error| error.time);
            simulation.ended.as_ref().map_or(stop, |(time, _)| time.min(stop))
        };
        for (k, &lane) in alone.iter().enumerate() {
            if broken.as_ref().is_some_and(|error| error.kind == Failure::Interrupted) {
                break;
            }
            let mut ended = Ok(());
            let front = |simulation: &Simulation| simulation.lanes[lane].flight.front();
            while ended.is_ok() && front(&simulation) < until(&simulation, &broken) {
                ended = simulation.skip_unseen(lane, &run, until(&simulation, &broken));
                if ended.is_ok() {
                    ended = simulation.step_lane(lane, &mut Some(&mut run));
                }
                let done = (front(&simulation) - span.start) / (span.end - span.start);
                let progress = Progress { fraction: part(meeting + k) + part(1) * done, pass: number };
                if observer(progress).is_break() {
                    let time = front(&simulation);
                    ended = Err(simulation.failure(lane, time, Failure::Interrupted));
                }
            }
            if let Err(error) = ended
                && broken.as_ref().is_none_or(|other| error.time < other.time)
            {
                broken = Some(error);
            }
        }
        for lane in 0..simulation.lanes.len() {
            // a step that was still open where a run ends is known up to there
            if let Err(error) = simulation.finish_step(lane, &mut Some(&mut run)) {
                if broken.as_ref().is_none_or(|other| error.time < other.time) {
                    broken = Some(error);
                }
                continue;
            }
            let to = until(&simulation, &broken);
            simulation.record_rest(lane, &mut run, to);
        }

        run.report.counts = simulation.counts();
        run.report.impacts =
            simulation.events.iter().filter(|e| matches!(e.kind, EventKind::Bounce | EventKind::Stick)).count() as u64;
        run.report.impact_iterations = simulation.iterations;
        run.report.touch_impacts = simulation.touch_impacts;
        run.heat = simulation.heat;
        run.heat.sort_by(|a, b| a.to.total_cmp(&b.to));
        run.work = simulation.work;
        run.work.sort_by(|a, b| a.to.total_cmp(&b.to));
        run.events = simulation.events;
        run.events.sort_by(|a, b| a.time.total_cmp(&b.time));
        // an event that ends the run goes before what broke off behind it
        let early = simulation.ended.filter(|(time, _)| broken.as_ref().is_none_or(|error| *time <= error.time));
        match broken.filter(|_| early.is_none()) {
            None => {
                run.end = span.end;
                run.close(early);
                Ok((run, simulation.lanes[..lanes].iter_mut().map(|lane| std::mem::take(&mut lane.nodes)).collect()))
            }
            Some(error) => {
                run.events.retain(|event| event.time <= error.time);
                run.cut(error.time);
                run.close(None);
                Err(SimulationError { trajectory: Some(Box::new(run)), ..error })
            }
        }
    }
}

/// Whether bodies have touched.
fn has_impacts(run: &Trajectory) -> bool {
    run.events.iter().any(|event| event.passage.is_none())
}

/// How many times smaller the error is at half the step, where the method shows its order [-].
fn full_gain(order: u32) -> f64 {
    libm::pow(2.0, f64::from(order))
}

/// How far a gain is trusted [-]: a part of it; and where there is none, four times the difference of the runs is taken.
fn trusted(gain: f64) -> f64 {
    1.0 + ((gain - 1.0) / GAIN_CAUTION).max(LEAST_TRUST)
}

/// The gain by which the error of the finest of three runs is told, each with half the steps of the one
/// before. A load with a kink, such as drag at the turn of a motion, costs the method its order; then the
/// differences fall more slowly, and less is trusted.
fn observed_gain(plan: &Plan, coarser: &Trajectory, coarse: &Trajectory, fine: &Trajectory) -> f64 {
    let [first, second] = [(coarse, coarser), (fine, coarse)].map(|(a, b)| Comparison::new(a, b, 2.0, 0.0, None).worst);
    let seen = if second > 0.0 { first / second } else { f64::INFINITY };
    let gain = full_gain(plan.order()).min(seen);
    // series converge irregularly at steps that are four times as long as the last
    if plan.method() == Method::Taylor { trusted(0.5 * gain) } else { trusted(gain) }
}

/// How fine the first run of a round is.
pub(super) struct Pace {
    pub(super) control: Control,
}

impl Pace {
    /// The first try: steps whose error is a part of the tolerance, or that follow every body's turning.
    pub(super) fn first(plan: &Plan, span: Span, tolerance: f64) -> Self {
        let time = span.end - span.start;
        let gain = full_gain(plan.order());
        let part = if plan.options().estimate { FIRST_LOCAL * trusted(gain) * gain } else { FIRST_LOCAL };
        if !plan.method().controls_error() {
            return Self { control: Control::Step(plan.first_step(time)) };
        }
        let scales = Scales { length: plan.first_length_scale(span), time };
        let local = (part * tolerance).clamp(LEAST_LOCAL, MOST_LOCAL);
        Self { control: Control::Error(Limits { local, scales, longest: f64::INFINITY }) }
    }

    /// What a pass does coarsely, `times` as much as the finest of a round; `gain` as in [`Grain::times`].
    fn grain(&self, times: f64, gain: f64) -> Grain {
        let step = match &self.control {
            Control::Error(limits) => libm::pow(limits.local / CONTACT_LOCAL, 1.0 / CONTACT_ORDER).min(2.0),
            Control::Step(_) | Control::Mesh(_) => 1.0,
        };
        Grain { step: 0.25 * times * step, ..Grain::times(times, gain) }
    }

    /// What should meet the tolerance, where this pace left an estimate.
    fn finer(&self, order: u32, tolerance: f64, estimate: f64) -> Self {
        let wanted = if estimate.is_finite() { SAFETY * tolerance / estimate } else { 0.0 };
        let control = match &self.control {
            Control::Error(limits) => {
                let local = (limits.local * wanted.clamp(1e-6, 0.25)).max(LEAST_LOCAL);
                Control::Error(Limits { local, ..*limits })
            }
            Control::Step(step) => {
                Control::Step(step * libm::pow(wanted, 1.0 / f64::from(order)).clamp(1.0 / 32.0, 0.5))
            }
            other @ Control::Mesh(_) => other.clone(),
        };
        Self { control }
    }

    /// How many times more steps another pace takes.
    fn longer(&self, order: u32, other: &Self) -> f64 {
        match (&self.control, &other.control) {
            (Control::Error(a), Control::Error(b)) => libm::pow(a.local / b.local, 1.0 / f64::from(order.max(1))),
            (Control::Step(a), Control::Step(b)) => a / b,
            _ => 1.0,
        }
    }

    /// Whether rounding forbids to go on.
    fn is_finest(&self) -> bool {
        matches!(&self.control, Control::Error(limits) if limits.local <= LEAST_LOCAL)
    }

    /// Measures positions by this length [m] from now on.
    fn measure_by(&mut self, length: f64) {
        if let Control::Error(limits) = &mut self.control {
            limits.scales.length = length;
        }
    }
}

/// By how much less a run with impacts is wrong than one that is twice as coarse [-]: both lie within their ε,
/// so twice their difference is taken.
const EVENT_GAIN: f64 = 1.5;
/// Rounds in which the impacts of the passes differ, after which they are said to [-]: shorter steps help where
/// these made the difference, not where ε did.
const MISMATCHES: u32 = 1;
/// Error of a flight's step up to which contact steps keep their length [-], and their order.
const CONTACT_LOCAL: f64 = 1.0e-8;
const CONTACT_ORDER: f64 = 4.0;
/// Rounds of three passes to a tolerance [-]: the first guess and its halving find the order's regime, the
/// rest comes down to rounding from an estimate at most 2⁻⁵ a round.
const ROUNDS: u32 = 24;
/// Most steps of a pass [-]; beyond it the tolerance is given up, honestly.
const MOST_STEPS: f64 = 2.0e7;
/// Part of the tolerance that the next round aims at [-].
const SAFETY: f64 = 0.25;
/// Rounding of a run per radian [-]: what random problems of all families leave at most.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// How far above the rounding a tolerance must be [-].
const FLOOR: f64 = 16.0;
/// Error of a step whose run meets the tolerance in most scenes, as a part of it [-].
const FIRST_LOCAL: f64 = 0.05;
/// By how much less than its order says a halving is trusted [-].
const GAIN_CAUTION: f64 = 4.0;
/// What is trusted of a halving at least [-]: below it rounding rules.
const LEAST_TRUST: f64 = 0.25;
/// Least error of a step that can be told from rounding [-].
const LEAST_LOCAL: f64 = 1.0e-15;
/// Largest error of a step in which halving shows the order [-].
const MOST_LOCAL: f64 = 1.0e-3;
