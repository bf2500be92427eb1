//! Whole runs: a scene over a span, sampled, with its error estimated.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::clock::thread_seconds;
use super::estimate::{self, Comparison};
use super::{Failure, RunError, Simulation, SimulationError};
use crate::error::{Error, Result};
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
        let mut run = pass(&plan, span, times, step, 1, observer).map_err(Box::new)?;
        run.report.seconds.run = thread_seconds() - began;
        run.report.horizon = run.end;
        run.report.length_scale = estimate::length_scale(&run);
        if !self.options().estimate {
            return Ok(run);
        }

        let began = thread_seconds();
        let coarse = pass(&plan, span, times, 2.0 * step, 2, observer);
        run.report.seconds.estimate = thread_seconds() - began;
        match coarse {
            Ok(coarse) => {
                let comparison = Comparison::new(&run, &coarse, 2.0, None);
                run.report.error_estimate = Some(comparison.worst);
                run.report.estimated_by = "against a second run with twice the step".into();
            }
            Err(error) if error.kind.is_final() => return Err(Box::new(error).into()),
            Err(_) => run.report.estimated_by = "not estimated: a second run with twice the step broke off".into(),
        }
        Ok(run)
    }

    /// Shortens the step until two runs agree to the tolerance.
    fn run_to_tolerance(
        &self,
        span: Span,
        times: &[f64],
        tolerance: f64,
        observer: Observer<'_>,
    ) -> Result<Trajectory, RunError> {
        let length = span.end - span.start;
        let floor = self.rounding_floor(length);
        if tolerance < floor {
            let allowed = format!("at least {floor:.1e}, what rounding leaves of this scene");
            return Err(Error::value("run", "tolerance", allowed, tolerance).into());
        }
        let order = f64::from(self.method().order());
        let began = thread_seconds();
        let mut step = self.first_step(length);
        let mut coarse: Option<(Trajectory, f64)> = None;
        for number in 1..=PASSES {
            let plan = Arc::new(self.with_step(step));
            let before = thread_seconds();
            let mut failure = None;
            let mut run = match pass(&plan, span, times, step, number, observer) {
                Ok(run) => run,
                Err(error) if error.kind.is_final() => return Err(Box::new(error).into()),
                Err(mut error) => {
                    // what a coarse step broke, a finer one may mend: the run so far is compared too
                    let Some(run) = error.trajectory.take() else { return Err(Box::new(error).into()) };
                    failure = Some(error);
                    *run
                }
            };
            let seconds = thread_seconds() - before;
            run.report.tolerance = Some(tolerance);
            run.report.length_scale = estimate::length_scale(&run);
            run.report.horizon = run.end;
            run.report.seconds.run = seconds;
            run.report.seconds.estimate = before - began;
            let mut estimate = f64::INFINITY;
            if let Some((coarse, coarse_step)) = &coarse {
                let comparison = Comparison::new(&run, coarse, coarse_step / step, Some(tolerance));
                estimate = comparison.worst;
                run.report.error_estimate = Some(comparison.within_horizon);
                run.report.estimated_by = "against a second run with a longer step".into();
                run.report.met = Some(comparison.worst <= tolerance);
                run.report.horizon = comparison.horizon;
            }

            // done, or at the end of what is affordable
            let shrink = if estimate.is_finite() {
                libm::pow(SAFETY * tolerance / estimate, 1.0 / order).clamp(1.0 / 32.0, 0.5)
            } else {
                0.5
            };
            let next = step * shrink;
            if estimate <= tolerance || (coarse.is_some() && length / next > MOST_STEPS) || number == PASSES {
                return match failure {
                    Some(error) => Err(Box::new(SimulationError { trajectory: Some(Box::new(run)), ..error }).into()),
                    None => Ok(run),
                };
            }
            coarse = Some((run, step));
            step = next;
        }
        Err(Error::refused("run", "no pass was made").into())
    }

    /// The error that rounding alone leaves [-]: a few ε for every radian turned.
    fn rounding_floor(&self, length: f64) -> f64 {
        let turning = self.bodies().iter().map(|body| body.start.angular_velocity.norm()).fold(0.0, f64::max);
        FLOOR * (1.0 + turning * length)
    }
}

/// Passes of a run to a tolerance [-]: the first guess and its halving find the order's regime, the
/// rest comes down to rounding from an estimate at most 2⁻⁵ a pass.
const PASSES: u32 = 24;
/// Most steps of a pass [-]; beyond it the tolerance is given up, honestly.
const MOST_STEPS: f64 = 2.0e7;
/// Part of the tolerance that the next pass aims at [-].
const SAFETY: f64 = 0.5;
/// Rounding of a run per radian [-].
const FLOOR: f64 = 64.0 * f64::EPSILON;

/// One pass over the span, every lane to its end; where one breaks off, the others stop there too.
fn pass(
    plan: &Arc<Plan>,
    span: Span,
    times: &[f64],
    step: f64,
    number: u32,
    observer: Observer<'_>,
) -> Result<Trajectory, SimulationError> {
    let refused = |error: Error| SimulationError {
        time: span.start,
        bodies: Vec::new(),
        kind: Failure::Refused(error.to_string()),
        trajectory: None,
    };
    let mut simulation = Simulation::new(plan.clone(), span, step).map_err(refused)?;
    let mut run = Trajectory::new(plan.clone(), times.to_vec());
    run.report.step = step;
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
