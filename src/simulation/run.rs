//! Whole runs: a scene over a span, sampled, with its error estimated.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::clock::thread_seconds;
use super::estimate::{self, Comparison};
use super::{Failure, RunError, Simulation, SimulationError};
use crate::error::{Error, Result};
use crate::freedom::Scales;
use crate::integrator::{Control, Limits};
use crate::plan::Plan;
use crate::scene::{RunOptions, Scene, Span};
use crate::trajectory::Trajectory;

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Part of the present pass that is done, 0..=1.
    pub fraction: f64,
    /// Number of the pass, from 1: an error estimate takes several.
    pub pass: u32,
}

/// Told how far a run is, after every step; it may stop the run.
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
        let began = thread_seconds();
        let plan = self.compile(options)?;
        let compile = thread_seconds() - began;
        let mut result = plan.run_observed(span, observer);
        if let Ok(run) = &mut result {
            run.report.seconds.compile = compile;
        }
        result
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
        let span = span.into();
        let times = self.options().times(span)?;
        match (self.options().step, self.tolerance()) {
            (Some(step), _) => self.run_with_step(span, &times, step, observer),
            (None, tolerance) => {
                let tolerance = tolerance.unwrap_or(crate::plan::DEFAULT_TOLERANCE);
                self.run_to_tolerance(span, &times, tolerance, observer)
            }
        }
    }

    /// One run with the step asked for, and one with twice the step to estimate its error.
    fn run_with_step(
        &self,
        span: Span,
        times: &[f64],
        step: f64,
        observer: Observer<'_>,
    ) -> Result<Trajectory, RunError> {
        let plan = Arc::new(self.clone());
        let began = thread_seconds();
        let mut run = pass(&plan, span, times, Control::Step(step), 1, observer).map_err(Box::new)?;
        run.report.seconds.run = thread_seconds() - began;
        run.report.horizon = run.end;
        run.report.length_scale = estimate::length_scale(&run);
        if !self.options().estimate {
            return Ok(run);
        }

        let began = thread_seconds();
        let coarse = pass(&plan, span, times, Control::Step(2.0 * step), 2, observer);
        run.report.seconds.estimate = thread_seconds() - began;
        match coarse {
            Ok(coarse) => {
                let gain = libm::pow(2.0, f64::from(self.method().order()));
                let comparison = Comparison::new(&run, &coarse, gain, self.rounding(span), None);
                run.report.error_estimate = Some(comparison.worst);
                run.report.estimated_by = "against a second run with twice the step";
            }
            Err(error) if error.kind == Failure::Interrupted => return Err(Box::new(error).into()),
            Err(_) => run.report.estimated_by = "not estimated: a second run with twice the step broke off",
        }
        Ok(run)
    }

    /// Makes passes with ever smaller steps, or smaller errors of a step, until two of them agree to the
    /// tolerance.
    fn run_to_tolerance(
        &self,
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
        let plan = Arc::new(self.clone());
        let knob = Knob::new(self);
        let mut scales = Scales { length: self.first_length_scale(span), time: span.end - span.start };
        let mut setting = knob.first(self, span, tolerance);
        if self.options().estimate {
            setting *= knob.ratio;
        }
        let began = thread_seconds();
        let mut coarse: Option<(Trajectory, f64)> = None;
        for number in 1..=PASSES {
            let before = thread_seconds();
            let mut failure = None;
            let mut run = match pass(&plan, span, times, knob.control(setting, scales), number, observer) {
                Ok(run) => run,
                Err(error) if error.kind == Failure::Interrupted => return Err(Box::new(error).into()),
                Err(mut error) => {
                    // what a coarse step broke, a finer one may mend: the run so far is compared too
                    let Some(run) = error.trajectory.take() else { return Err(Box::new(error).into()) };
                    failure = Some(error);
                    *run
                }
            };
            run.report.tolerance = Some(tolerance);
            run.report.length_scale = estimate::length_scale(&run);
            run.report.horizon = run.end;
            run.report.seconds.run = thread_seconds() - before;
            run.report.seconds.estimate = before - began;
            scales.length = run.report.length_scale;
            let mut estimate = f64::INFINITY;
            if let Some((coarse, coarse_setting)) = &coarse {
                let comparison = Comparison::new(
                    &run,
                    coarse,
                    knob.gain(*coarse_setting, setting),
                    self.rounding(span),
                    Some(tolerance),
                );
                estimate = comparison.worst;
                run.report.error_estimate = Some(comparison.within_horizon);
                run.report.estimated_by = knob.estimated_by();
                run.report.met = Some(comparison.worst <= tolerance);
                run.report.horizon = comparison.horizon;
            }

            // done, or at the end of what is affordable
            let next = knob.next(setting, tolerance, estimate);
            let steps = run.report.counts.steps as f64 * knob.longer(setting, next);
            let given_up = coarse.is_some() && (steps > MOST_STEPS || setting <= knob.least) || number == PASSES;
            if estimate <= tolerance || given_up || !self.options().estimate {
                return match failure {
                    Some(error) => Err(Box::new(SimulationError { trajectory: Some(Box::new(run)), ..error }).into()),
                    None => Ok(run),
                };
            }
            coarse = Some((run, setting));
            setting = next;
        }
        Err(Error::refused("run", "no pass was made").into())
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

/// What is turned to make a run finer: the step, or the error allowed in one.
///
/// ```text
/// error of the result ∝ settingᵖ        p the method's order for steps, 1 for a step's error
/// ```
struct Knob {
    controls_error: bool,
    order: f64,
    /// How much coarser the run is that the first is compared with [-].
    ratio: f64,
    /// The finest setting that makes sense.
    least: f64,
}

impl Knob {
    fn new(plan: &Plan) -> Self {
        let controls_error = plan.method().controls_error();
        Self {
            controls_error,
            order: f64::from(plan.method().order()),
            ratio: if controls_error { LOCAL_RATIO } else { 2.0 },
            least: if controls_error { LEAST_LOCAL } else { 0.0 },
        }
    }

    fn first(&self, plan: &Plan, span: Span, tolerance: f64) -> f64 {
        if self.controls_error { FIRST_LOCAL * tolerance } else { 0.5 * plan.first_step(span.end - span.start) }
    }

    fn control(&self, setting: f64, scales: Scales) -> Control {
        if self.controls_error {
            Control::Error(Limits { local: setting, scales, longest: f64::INFINITY })
        } else {
            Control::Step(setting)
        }
    }

    /// How many times smaller the error of the finer setting is. A step's error allowed below
    /// rounding gains nothing.
    fn gain(&self, coarse: f64, fine: f64) -> f64 {
        if self.controls_error {
            ((coarse + LEAST_LOCAL) / (fine + LEAST_LOCAL)).max(1.0) / GAIN_CAUTION
        } else {
            libm::pow(coarse / fine, self.order)
        }
    }

    /// The setting that should meet the tolerance, where this one left an estimate.
    fn next(&self, setting: f64, tolerance: f64, estimate: f64) -> f64 {
        let (power, range) =
            if self.controls_error { (1.0, (1e-4, 1.0 / self.ratio)) } else { (1.0 / self.order, (1.0 / 32.0, 0.5)) };
        let shrink = if estimate.is_finite() { libm::pow(SAFETY * tolerance / estimate, power) } else { range.1 };
        (setting * shrink.clamp(range.0, range.1)).max(self.least)
    }

    /// How many times more steps another setting takes.
    fn longer(&self, setting: f64, next: f64) -> f64 {
        if self.controls_error { libm::pow(setting / next, 1.0 / self.order) } else { setting / next }
    }

    fn estimated_by(&self) -> &'static str {
        if self.controls_error {
            "against a second run that allowed larger errors of a step"
        } else {
            "against a second run with a longer step"
        }
    }
}

/// Passes of a run to a tolerance [-]: the first guess and its halving find the order's regime, the
/// rest comes down to rounding from an estimate at most 2⁻⁵ a pass.
const PASSES: u32 = 24;
/// Most steps of a pass [-]; beyond it the tolerance is given up, honestly.
const MOST_STEPS: f64 = 2.0e7;
/// Part of the tolerance that the next pass aims at [-].
const SAFETY: f64 = 0.5;
/// Rounding of a run per radian [-]: what random problems of all families leave at most.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// How far above the rounding a tolerance must be [-].
const FLOOR: f64 = 16.0;
/// Error of a step that the first pass allows, as a part of the tolerance [-].
const FIRST_LOCAL: f64 = 0.1;
/// How many times larger it is in the run to compare with [-]: at order 8 that run costs 0.65 of the other.
const LOCAL_RATIO: f64 = 32.0;
/// How far the gain of a smaller error of a step is trusted [-]: by less than it promises by this factor.
const GAIN_CAUTION: f64 = 4.0;
/// Least error of a step that can be told from rounding [-].
const LEAST_LOCAL: f64 = 1.0e-15;

/// One pass over the span, every lane to its end; where one breaks off, the others stop there too.
fn pass(
    plan: &Arc<Plan>,
    span: Span,
    times: &[f64],
    control: Control,
    number: u32,
    observer: Observer<'_>,
) -> Result<Trajectory, SimulationError> {
    let refused = |error: Error| SimulationError {
        time: span.start,
        bodies: Vec::new(),
        kind: Failure::Refused(error.to_string()),
        trajectory: None,
    };
    let mut simulation = Simulation::new(plan.clone(), span, control).map_err(refused)?;
    let mut run = Trajectory::new(plan.clone(), times.to_vec());
    run.report.control = Some(control);
    for (group, spec) in plan.groups().iter().enumerate() {
        let motions: Vec<_> = spec.members.iter().map(|&i| plan.bodies()[i].start).collect();
        run.phases.push(plan.phase(group, span.start, &motions, &[]).map_err(refused)?);
    }

    let mut broken: Option<SimulationError> = None;
    let lanes = simulation.lanes.len();
    for lane in 0..lanes {
        let to = broken.as_ref().map_or(span.end, |error| error.time);
        let mut record = Some(&mut run);
        let mut ended = simulation.answer_touches(lane, 0, &mut record);
        while ended.is_ok() && simulation.lanes[lane].flight.front() < to {
            ended = simulation.step_lane(lane, &mut record);
            let done = (simulation.lanes[lane].flight.front() - span.start) / (span.end - span.start);
            let progress = Progress { fraction: (lane as f64 + done) / lanes as f64, pass: number };
            if observer(progress).is_break() {
                let time = simulation.lanes[lane].flight.front();
                ended = Err(simulation.failure(lane, time, Failure::Interrupted));
            }
        }
        let lane = &mut simulation.lanes[lane];
        let mut motions = lane.motions.clone();
        lane.flight.at(lane.flight.front(), &mut motions);
        run.record_rest(lane.phase, &motions, &mut lane.cursor, to.min(lane.flight.front()));
        if let Err(error) = ended {
            let stop = error.kind == Failure::Interrupted;
            if broken.as_ref().is_none_or(|other| error.time < other.time) {
                broken = Some(error);
            }
            if stop {
                break;
            }
        }
    }

    run.report.counts = simulation.counts();
    run.report.impacts = simulation.events.len() as u64;
    run.report.impact_iterations = simulation.iterations;
    run.events = simulation.events;
    run.events.sort_by(|a, b| a.time.total_cmp(&b.time));
    match broken {
        None => {
            run.end = span.end;
            Ok(run)
        }
        Some(error) => {
            run.events.retain(|event| event.time <= error.time);
            run.cut(error.time);
            Err(SimulationError { trajectory: Some(Box::new(run)), ..error })
        }
    }
}
