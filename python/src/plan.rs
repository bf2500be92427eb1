//! Plans.

use std::path::PathBuf;
use std::sync::Arc;

use bryla::{CostTable, Plan, RunOptions, Scene};
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::body::PyBody;
use crate::convert::{self, Reduced};
use crate::error::Result;
use crate::options::span;
use crate::run::run_watched;
use crate::simulation::PySimulation;
use crate::trajectory::PyTrajectory;

/// A scene after checking, with only what it calls for; made by Scene.compile.
#[pyclass(name = "Plan", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyPlan(Arc<Plan>);

impl PyPlan {
    pub(crate) fn new(plan: Plan) -> Self {
        Self(Arc::new(plan))
    }
}

#[pymethods]
impl PyPlan {
    /// The method of integration.
    #[getter]
    fn method(&self) -> &'static str {
        self.0.method().name()
    }

    /// The bodies, in the order of the body axis of every array.
    #[getter]
    fn bodies(&self) -> Vec<PyBody> {
        self.0.scene().bodies.iter().cloned().map(PyBody).collect()
    }

    /// What runs, what is left out, and why; and where the options name a span, what the run is predicted to
    /// take, by the user's own cost table if `calibrate` made one, else by the shipped one.
    #[pyo3(signature = ())]
    fn explain(&self) -> Result<String> {
        Ok(self.0.explain_priced(&CostTable::of_user()?))
    }

    /// Starts the scene at time t [s], to be advanced by hand; the plan must have method and step.
    #[pyo3(signature = (t=0.0))]
    fn start(&self, t: f64) -> Result<PySimulation> {
        Ok(PySimulation::new(self.0.start(t)?))
    }

    /// Runs the plan over a span [s], that of the scene's run options if none is given; see Scene.run.
    #[pyo3(signature = (t_span=None, *, progress=false))]
    fn run(&self, py: Python<'_>, t_span: Option<(f64, f64)>, progress: bool) -> Result<PyTrajectory> {
        let span = span(t_span, self.0.options())?;
        run_watched(py, progress, |observer| self.0.run_observed(span, observer))
    }

    /// Steps and time [s] that a run over a span is predicted to take: (steps, run, estimate), by the same
    /// table as in explain. Where a function of the user is called, some steps are taken to time them. None where
    /// contacts cannot be foreseen, and where a step breaks off.
    #[pyo3(signature = (t_span=None))]
    fn predict(&self, py: Python<'_>, t_span: Option<(f64, f64)>) -> Result<Option<(f64, f64, f64)>> {
        let (span, costs) = (span(t_span, self.0.options())?, CostTable::of_user()?);
        let predicted = py.detach(|| self.0.predict(span, &costs));
        Ok(predicted.map(|predicted| (predicted.steps, predicted.run, predicted.estimate)))
    }

    fn __repr__(&self) -> String {
        format!("<bryla.Plan: {} bodies, {}>", self.0.bodies().len(), self.0.method())
    }

    /// Refused where there is a user effect, which is code.
    fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>> {
        self.0.check_writable()?;
        let text = self.0.scene().to_text(bryla::scene::file::Format::Json)?;
        Ok(convert::reduce(&py.get_type::<Self>(), &(text, self.0.options()))?)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> Result<Self> {
        let (text, options): (String, RunOptions) = convert::from_bytes(bytes)?;
        let scene = Scene::from_text(&text, bryla::scene::file::Format::Json)?;
        Ok(Self::new(scene.compile(&options)?))
    }
}

/// Measures what a step of each method costs on this machine, and writes the table, from which `explain` and
/// `predict` tell how long a run will take; returns where. It takes a second or so.
///
/// Parameters
/// ----------
/// path : path, optional
///     Where the table goes; by default where `explain` looks for it, bryla/costs.toml in the user's folder for
///     configuration.
#[pyfunction]
#[pyo3(signature = (path=None))]
pub(crate) fn calibrate(py: Python<'_>, path: Option<PathBuf>) -> Result<PathBuf> {
    let nowhere = || bryla::Error::refused("calibrate", "the system names no folder for configuration; give a path");
    let path = path.or_else(CostTable::user_path).ok_or_else(nowhere)?;
    let table = py.detach(CostTable::measure)?;
    table.save(&path)?;
    Ok(path)
}
