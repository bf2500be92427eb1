//! Running with Python looking on: other threads go on, Ctrl-C stops the run, progress is shown.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use bryla::integrator::FlightError;
use bryla::simulation::{self, Observer, Progress};
use bryla::{RunError, Trajectory};
use pyo3::exceptions::PyException;
use pyo3::prelude::*;

use crate::effect::take_raised;
use crate::error::{Failure, Result, class};
use crate::trajectory::PyTrajectory;

/// Time between two looks at Python's signals.
const LOOK: Duration = Duration::from_millis(20);
/// Time between two progress lines.
const SHOW: Duration = Duration::from_millis(200);
/// Steps between two looks at the clock.
const STEPS: u32 = 16;

/// Looks after a run from Python's side.
struct Watch {
    steps: u32,
    looked: Instant,
    /// When progress was shown last, if it is shown at all.
    shown: Option<Instant>,
    /// What a signal raised, such as `KeyboardInterrupt`.
    interrupted: Option<PyErr>,
}

impl Watch {
    fn told(&mut self, progress: Progress) -> ControlFlow<()> {
        self.steps += 1;
        if self.steps < STEPS {
            return ControlFlow::Continue(());
        }
        self.steps = 0;
        if self.looked.elapsed() < LOOK {
            return ControlFlow::Continue(());
        }
        let looked = Python::attach(|py| {
            py.check_signals()?;
            if self.shown.is_some_and(|shown| shown.elapsed() >= SHOW) {
                let percent = 100.0 * progress.fraction;
                write_line(py, &format!("bryla: pass {}, {percent:3.0} %", progress.pass))?;
                self.shown = Some(Instant::now());
            }
            Ok(())
        });
        self.looked = Instant::now();
        match looked {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.interrupted = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}

/// Writes over the present line of the terminal.
fn write_line(py: Python<'_>, text: &str) -> PyResult<()> {
    let stderr = py.import("sys")?.getattr("stderr")?;
    stderr.call_method1("write", (format!("\r{text:<32}"),))?;
    stderr.call_method0("flush")?;
    Ok(())
}

/// Whether a progress line would be seen.
fn on_terminal(py: Python<'_>) -> bool {
    let seen = || py.import("sys")?.getattr("stderr")?.call_method0("isatty")?.extract();
    seen().unwrap_or(false)
}

/// Does a run with Python looking on; warns where its tolerance is not met.
pub(crate) fn run_watched(
    py: Python<'_>,
    progress: bool,
    run: impl FnOnce(Observer<'_>) -> Result<Trajectory, RunError> + Send,
) -> Result<PyTrajectory> {
    let run = watched(py, progress, run)?;
    warn_unless_met(py, &run)?;
    Ok(PyTrajectory::new(run))
}

/// Does work with Python's lock released and Python looking on.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    progress: bool,
    work: impl FnOnce(Observer<'_>) -> Result<T, RunError> + Send,
) -> Result<T> {
    let now = Instant::now();
    let shown = (progress && on_terminal(py)).then_some(now);
    let mut watch = Watch { steps: 0, looked: now, shown, interrupted: None };
    take_raised();
    let result = py.detach(|| work(&mut |progress| watch.told(progress)));
    if watch.shown.is_some() {
        write_line(py, "")?;
        write_line(py, "")?;
    }
    result.map_err(|error| explained(py, error.into(), watch.interrupted.take()))
}

/// A failure together with the exception behind it, if there is one: that of a user's function is the
/// cause of the failure; one that shall end the program, such as `KeyboardInterrupt`, goes first and
/// has the failure as its cause.
pub(crate) fn explained(py: Python<'_>, failure: Failure, interrupted: Option<PyErr>) -> Failure {
    let Failure::Simulation(broken) = &failure else { return failure };
    // a step that a function broke may have been mended since
    let by_a_function = matches!(
        broken.kind,
        simulation::Failure::Flight(FlightError::UserEffect(_)) | simulation::Failure::UserEvent(..)
    );
    let raised = take_raised().filter(|raised| by_a_function || !raised.is_instance_of::<PyException>(py));
    let Some(behind) = interrupted.or(raised) else { return failure };
    let failure = PyErr::from(failure);
    let (first, cause) = if behind.is_instance_of::<PyException>(py) { (failure, behind) } else { (behind, failure) };
    first.set_cause(py, Some(cause));
    Failure::Python(first)
}

fn warn_unless_met(py: Python<'_>, run: &Trajectory) -> Result<()> {
    let report = run.report();
    let (Some(false), Some(tolerance)) = (report.met, report.tolerance) else { return Ok(()) };
    let text = format!(
        "the tolerance {tolerance:e} is met up to t = {} s only, of a run to t = {} s; see the trajectory's report",
        report.horizon,
        run.end(),
    );
    let text = std::ffi::CString::new(text).unwrap_or_default();
    PyErr::warn(py, class(py, "AccuracyWarning")?.as_any(), &text, 1)?;
    Ok(())
}
