//! What accuracy costs: one scene, several methods, steps and tolerances, error against time.
//!
//! Error and time come from the same run. The error is that of the end state, against a closed form
//! where the scene has one, else against a much finer run whose own error is estimated and stated.

use std::fmt;
use std::ops::ControlFlow;

use crate::error::{Error, Result};
use crate::integrator::Method;
use crate::plan::Plan;
use crate::scene::{Record, RunOptions, Scene, Span};
use crate::simulation::clock::thread_seconds;
use crate::simulation::estimate::difference;
use crate::simulation::{Observer, RunError};
use crate::state::BodyState;
use crate::text::short;
use crate::trajectory::Trajectory;

/// What is compared.
#[derive(Debug, Clone, PartialEq)]
pub struct CompareOptions {
    /// Methods of integration; all that the scene allows if empty.
    pub methods: Vec<Method>,
    /// Lengths of a step [s]; halvings from a first guess if neither steps nor tolerances are given.
    pub steps: Vec<f64>,
    /// Errors that the result may have [-], for the methods that choose their steps by them; the error is not
    /// estimated in these runs, which costs extra.
    pub tolerances: Vec<f64>,
    /// How often each run is timed [-]; the least and the middle time are reported.
    pub repeats: u32,
    /// Everything else.
    pub run: RunOptions,
}

impl Default for CompareOptions {
    fn default() -> Self {
        let (methods, steps, tolerances) = Default::default();
        Self { methods, steps, tolerances, repeats: 5, run: RunOptions::default() }
    }
}

/// One run of the comparison.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Row {
    /// Method of integration.
    pub method: Method,
    /// Length of a step [s]; of the closed form, the whole span; under a tolerance, the mean of the run.
    pub step: f64,
    /// Error that the result was allowed [-]; none where the step was given.
    pub tolerance: Option<f64>,
    /// Error of the end state [-]: the larger of position error over the length scale and orientation
    /// error in radians, over all bodies. None where the run broke off.
    pub error: Option<f64>,
    /// Evaluations of Y′.
    pub evaluations: u64,
    /// Steps.
    pub steps: u64,
    /// Least processor time of the repeats [s].
    pub seconds_min: f64,
    /// Middle processor time of the repeats [s].
    pub seconds_median: f64,
}

/// What accuracy costs in one scene.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ComparisonTable {
    /// The runs, method by method.
    pub rows: Vec<Row>,
    /// What the errors are measured against.
    pub reference: String,
    /// Estimated error of the reference itself [-]; errors below are not told apart from it.
    pub reference_error: f64,
}

impl Scene {
    /// Error against time for several methods and steps.
    ///
    /// # Errors
    /// Bad input, and a scene whose reference run breaks off.
    pub fn compare(&self, span: impl Into<Span>, options: &CompareOptions) -> Result<ComparisonTable, RunError> {
        self.compare_observed(span, options, &mut |_| ControlFlow::Continue(()))
    }

    /// The same, with someone to be told how far each run is, and who may stop it all.
    ///
    /// # Errors
    /// As [`compare`](Self::compare); a comparison that was stopped ends in `Failure::Interrupted`.
    pub fn compare_observed(
        &self,
        span: impl Into<Span>,
        options: &CompareOptions,
        observer: Observer<'_>,
    ) -> Result<ComparisonTable, RunError> {
        let span = span.into();
        let methods = if options.methods.is_empty() { Method::ALL } else { &options.methods };
        let base = RunOptions {
            tolerance: None,
            t_eval: None,
            order: None,
            estimate: false,
            record: Record::End,
            events: Vec::new(),
            ..options.run.clone()
        };
        let halvings = options.steps.is_empty() && options.tolerances.is_empty();
        let steps = if halvings { self.halvings(span, &base)? } else { options.steps.clone() };
        let shortest = steps.iter().copied().fold(f64::INFINITY, f64::min);
        let shortest = if shortest.is_finite() { shortest } else { self.halvings(span, &base)?[0] };
        let reference = Reference::new(self, span, shortest, &base, observer)?;

        if let Some(method) = options.methods.iter().find(|m| steps.is_empty() && !m.controls_error()) {
            let choosers: Vec<_> = Method::ALL.iter().filter(|m| m.controls_error()).map(|m| m.name()).collect();
            let allowed = format!("steps for {method}, which does not choose them, or only {}", choosers.join(", "));
            return Err(Error::value("compare", "tolerances", allowed, &options.tolerances).into());
        }

        let mut rows = Vec::new();
        for &method in methods {
            // the closed form takes no steps, and not every scene has one
            let by_step = steps.iter().map(|&step| (Some(step), None));
            let tolerances = if method.controls_error() { options.tolerances.as_slice() } else { &[] };
            let by_tolerance = tolerances.iter().map(|&tolerance| (None, Some(tolerance)));
            let paces =
                if method == Method::Exact { vec![(None, None)] } else { by_step.chain(by_tolerance).collect() };
            for (step, tolerance) in paces {
                let order = options.run.order.filter(|&order| method.allows_order(order).is_some());
                let run = RunOptions { method: Some(method), order, step, tolerance, ..base.clone() };
                let plan = match self.compile(&run) {
                    Err(_) if options.methods.is_empty() => break,
                    plan => plan?,
                };
                rows.push(row(&plan, span, &reference, options.repeats.max(1), observer)?);
            }
        }
        Ok(ComparisonTable { rows, reference: reference.name, reference_error: reference.error })
    }

    /// Steps for a comparison that names none: ten halvings from the plan's first guess.
    fn halvings(&self, span: Span, base: &RunOptions) -> Result<Vec<f64>> {
        let plan = self.compile(&RunOptions { method: None, ..base.clone() })?;
        let first = plan.first_step(span.end - span.start);
        Ok((0..HALVINGS).map(|k| first / f64::from(1 << k)).collect())
    }
}

/// Steps of a comparison that names none [-].
const HALVINGS: u32 = 10;
/// The reference's first step, as a part of the shortest step compared [-].
const REFERENCE_STEP: f64 = 0.25;
/// Halvings of the reference's step in search of the smallest error [-].
const REFERENCE_HALVINGS: u32 = 6;
/// Most steps of a reference run [-].
const REFERENCE_STEPS: f64 = 4.0e6;

/// What errors are measured against: states at the end of the span, and the length of their motion.
struct Reference {
    name: String,
    error: f64,
    states: Vec<BodyState>,
    length_scale: f64,
}

impl Reference {
    /// The closed form, where the scene has one; else the finest affordable run.
    fn new(
        scene: &Scene,
        span: Span,
        shortest: f64,
        base: &RunOptions,
        observer: Observer<'_>,
    ) -> Result<Self, RunError> {
        match scene.compile(&RunOptions { method: Some(Method::Exact), ..base.clone() }) {
            Ok(plan) => Ok(Self::read(&plan.run_observed(span, observer)?, "the closed form".to_owned(), 0.0)),
            Err(_) => Self::finest(scene, span, shortest, base, observer),
        }
    }

    fn read(run: &Trajectory, name: String, error: f64) -> Self {
        let states = run.states(run.times().len() - 1).to_vec();
        Self { name, error, states, length_scale: run.report().length_scale }
    }

    /// A run of order 8 with the step that leaves the smallest error; its error by Richardson's rule
    /// from the run before, and not below the rounding of its numbers.
    fn finest(
        scene: &Scene,
        span: Span,
        shortest: f64,
        base: &RunOptions,
        observer: Observer<'_>,
    ) -> Result<Self, RunError> {
        let method = Method::Dop853;
        let mut step = REFERENCE_STEP * shortest;
        let divisor = libm::pow(2.0, f64::from(method.order())) - 1.0;
        let mut fine = |step: f64| -> Result<Self, RunError> {
            let plan = scene.compile(&RunOptions { method: Some(method), step: Some(step), ..base.clone() })?;
            let name = format!("{method} with h = {} s", short(step));
            Ok(Self::read(&plan.run_observed(span, observer)?, name, f64::INFINITY))
        };
        let mut best = fine(2.0 * step)?;
        for _ in 0..REFERENCE_HALVINGS {
            let mut run = fine(step)?;
            run.error = (difference(&run.states, &best.states, run.length_scale) / divisor).max(f64::EPSILON);
            let better = run.error < best.error;
            if better {
                best = run;
            }
            if !better || best.error <= f64::EPSILON || (span.end - span.start) / step > 0.5 * REFERENCE_STEPS {
                break;
            }
            step *= 0.5;
        }
        best.name += &format!(", own error about {}", short(best.error));
        Ok(best)
    }

    fn error_of(&self, run: &Trajectory) -> f64 {
        difference(run.states(run.times().len() - 1), &self.states, self.length_scale)
    }
}

/// Times one method with one step, and measures its error.
fn row(plan: &Plan, span: Span, reference: &Reference, repeats: u32, observer: Observer<'_>) -> Result<Row, RunError> {
    let mut seconds = Vec::new();
    let mut outcome = None;
    for _ in 0..repeats {
        let began = thread_seconds();
        outcome = match plan.run_observed(span, observer) {
            Err(RunError::Simulation(broken)) if broken.kind.is_final() => return Err(broken.into()),
            other => Some(other),
        };
        seconds.push(thread_seconds() - began);
    }
    seconds.sort_by(f64::total_cmp);
    let (counts, error) = match outcome {
        Some(Ok(run)) => (run.report().counts, Some(reference.error_of(&run))),
        Some(Err(RunError::Simulation(broken))) => {
            (broken.trajectory.map(|run| run.report().counts).unwrap_or_default(), None)
        }
        Some(Err(input)) => return Err(input),
        None => return Err(Error::refused("compare", "no run was made").into()),
    };
    Ok(Row {
        method: plan.method(),
        step: plan.options().step.unwrap_or((span.end - span.start) / counts.steps.max(1) as f64),
        tolerance: plan.options().tolerance,
        error: error.filter(|e| e.is_finite()),
        evaluations: counts.evaluations,
        steps: counts.steps,
        seconds_min: seconds[0],
        seconds_median: seconds[seconds.len() / 2],
    })
}

impl ComparisonTable {
    /// The table as comma-separated values; a run that broke off has no error.
    pub fn to_csv(&self) -> String {
        let mut text = "method,step_s,tolerance,error,evaluations,steps,seconds_min,seconds_median\n".to_owned();
        for row in &self.rows {
            let error = row.error.map(|e| format!("{e:e}")).unwrap_or_default();
            let tolerance = row.tolerance.map(|e| format!("{e:e}")).unwrap_or_default();
            let Row { method, step, evaluations, steps, seconds_min, seconds_median, .. } = row;
            text += &format!(
                "{method},{step:e},{tolerance},{error},{evaluations},{steps},{seconds_min:e},{seconds_median:e}\n"
            );
        }
        text
    }
}

impl fmt::Display for ComparisonTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Error of the end state against {}", self.reference)?;
        writeln!(
            f,
            "{:<20} {:>10} {:>10} {:>11} {:>12} {:>10} {:>10}",
            "method", "step [s]", "tolerance", "error", "evaluations", "time [s]", "order"
        )?;
        let mut before: Option<&Row> = None;
        for row in &self.rows {
            let error = match row.error {
                None => "broke off".to_owned(),
                Some(e) if e < 10.0 * self.reference_error => format!("< {}", short(10.0 * self.reference_error)),
                Some(e) => short(e),
            };
            // the order that the error shows, from the row before
            let order = before.filter(|b| b.method == row.method && row.tolerance.is_none()).and_then(|b| {
                let (e0, e1) = (b.error?, row.error?);
                let told = e1 > 10.0 * self.reference_error && e0 > e1 && b.step > row.step;
                told.then(|| format!("{:.2}", libm::log(e0 / e1) / libm::log(b.step / row.step)))
            });
            writeln!(
                f,
                "{:<20} {:>10} {:>10} {error:>11} {:>12} {:>10} {:>10}",
                row.method.name(),
                short(row.step),
                row.tolerance.map(short).unwrap_or_default(),
                row.evaluations,
                short(row.seconds_min),
                order.unwrap_or_default(),
            )?;
            before = Some(row);
        }
        Ok(())
    }
}
