//! Plans.

use std::sync::Arc;

use bryla::{Plan, RunOptions, Scene};
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

    /// What runs, what is left out, and why.
    #[pyo3(signature = ())]
    fn explain(&self) -> String {
        self.0.explain()
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
