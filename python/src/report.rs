//! Reports.

use bryla::Report;
use bryla::integrator::Counts;
use bryla::report::Seconds;
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::convert::{self, Reduced};

/// What has been done.
#[pyclass(name = "Counts", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyCounts(pub(crate) Counts);

#[pymethods]
impl PyCounts {
    /// Steps taken.
    #[getter]
    fn steps(&self) -> u64 {
        self.0.steps
    }

    /// Steps refused by error control.
    #[getter]
    fn rejected(&self) -> u64 {
        self.0.rejected
    }

    /// Evaluations of the right-hand side of the equations of motion.
    #[getter]
    fn evaluations(&self) -> u64 {
        self.0.evaluations
    }

    /// Largest | |q| − 1 |, or ‖RᵀR − 1‖, before an orientation was put back on its sphere [-].
    #[getter]
    fn orientation_drift(&self) -> f64 {
        self.0.orientation_drift
    }

    fn __repr__(&self) -> String {
        let Counts { steps, rejected, evaluations, orientation_drift } = self.0;
        format!(
            "<bryla.Counts: {steps} steps, {rejected} rejected, {evaluations} evaluations, \
             orientation drift {orientation_drift:.1e}>"
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

/// Processor time by stage [s].
#[pyclass(name = "Seconds", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PySeconds(Seconds);

#[pymethods]
impl PySeconds {
    /// Checking the scene and making the plan [s].
    #[getter]
    fn compile(&self) -> f64 {
        self.0.compile
    }

    /// The run whose result is kept [s].
    #[getter]
    fn run(&self) -> f64 {
        self.0.run
    }

    /// Other runs, from which its error is estimated [s].
    #[getter]
    fn estimate(&self) -> f64 {
        self.0.estimate
    }

    fn __repr__(&self) -> String {
        let Seconds { compile, run, estimate } = self.0;
        format!("<bryla.Seconds: compile {compile:.3e}, run {run:.3e}, estimate {estimate:.3e}>")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

/// What ran, what it cost, and how far the result is to be trusted; `print` shows it.
#[pyclass(name = "Report", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyReport(pub(crate) Report);

#[pymethods]
impl PyReport {
    /// Method of integration.
    #[getter]
    fn method(&self) -> &'static str {
        self.0.method.name()
    }

    /// Length of a step [s]; the mean one, where they differ.
    #[getter]
    fn step(&self) -> f64 {
        self.0.step
    }

    /// Largest error that a step was allowed [-], where that decided its length, or None.
    #[getter]
    fn local_tolerance(&self) -> Option<f64> {
        self.0.local_tolerance
    }

    /// Tolerance asked for [-], or None.
    #[getter]
    fn tolerance(&self) -> Option<f64> {
        self.0.tolerance
    }

    /// Estimated error of the result [-], or None: the larger of position error over length_scale and
    /// orientation error in radians, over all samples and bodies up to the horizon.
    #[getter]
    fn error_estimate(&self) -> Option<f64> {
        self.0.error_estimate
    }

    /// How the error was estimated, in words.
    #[getter]
    fn estimated_by(&self) -> &str {
        &self.0.estimated_by
    }

    /// Whether the estimate is within the tolerance over the whole span; None if none was asked for.
    #[getter]
    fn met(&self) -> Option<bool> {
        self.0.met
    }

    /// Time up to which the estimate is within the tolerance [s]; the end, if none was asked for.
    #[getter]
    fn horizon(&self) -> f64 {
        self.0.horizon
    }

    /// Length that position errors are measured by [m].
    #[getter]
    fn length_scale(&self) -> f64 {
        self.0.length_scale
    }

    /// Steps, evaluations, drift of the orientation.
    #[getter]
    fn counts(&self) -> PyCounts {
        PyCounts(self.0.counts)
    }

    /// Impacts answered.
    #[getter]
    fn impacts(&self) -> u64 {
        self.0.impacts
    }

    /// Rounds of the finder, over all impacts.
    #[getter]
    fn impact_iterations(&self) -> u64 {
        self.0.impact_iterations
    }

    /// Instants of impact at which a point took a blow only because its gap was below the touch gap.
    ///
    /// A landing that is flat to that angle, bodies that are hit together: with another touch gap, 1e-9 of the size,
    /// they come out differently.
    #[getter]
    fn touch_impacts(&self) -> u64 {
        self.0.touch_impacts
    }

    /// Processor time by stage [s].
    #[getter]
    fn seconds(&self) -> PySeconds {
        PySeconds(self.0.seconds)
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        let error = self.0.error_estimate.map_or_else(|| "not estimated".to_owned(), |error| format!("{error:.1e}"));
        format!("<bryla.Report: {}, error {error}, met {:?}>", self.0.method, self.0.met)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}
