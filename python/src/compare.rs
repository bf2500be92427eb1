//! Comparisons: what accuracy costs.

use bryla::ComparisonTable;
use bryla::compare::Row;
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::convert::{self, Reduced};

/// One run of a comparison.
#[pyclass(name = "Row", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyRow(Row);

#[pymethods]
impl PyRow {
    /// Method of integration.
    #[getter]
    fn method(&self) -> &'static str {
        self.0.method.name()
    }

    /// Length of a step [s]; of the closed form, the whole span; under a tolerance, the mean of the run.
    #[getter]
    fn step(&self) -> f64 {
        self.0.step
    }

    /// Error that the result was allowed [-]; None where the step was given.
    #[getter]
    fn tolerance(&self) -> Option<f64> {
        self.0.tolerance
    }

    /// Error of the end state [-]: the larger of position error over the length scale and orientation
    /// error in radians, over all bodies; None where the run broke off.
    #[getter]
    fn error(&self) -> Option<f64> {
        self.0.error
    }

    /// Evaluations of the right-hand side of the equations of motion.
    #[getter]
    fn evaluations(&self) -> u64 {
        self.0.evaluations
    }

    /// Steps.
    #[getter]
    fn steps(&self) -> u64 {
        self.0.steps
    }

    /// Least processor time of the repeats [s].
    #[getter]
    fn seconds_min(&self) -> f64 {
        self.0.seconds_min
    }

    /// Middle processor time of the repeats [s].
    #[getter]
    fn seconds_median(&self) -> f64 {
        self.0.seconds_median
    }

    fn __repr__(&self) -> String {
        let Row { method, step, error, seconds_min, .. } = &self.0;
        let error = error.map_or_else(|| "broke off".to_owned(), |error| format!("error {error:.2e}"));
        format!("<bryla.Row: {method}, step {step:.3e} s, {error}, {seconds_min:.2e} s>")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

/// What accuracy costs in one scene; `print` shows the table.
#[pyclass(name = "ComparisonTable", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyComparisonTable(pub(crate) ComparisonTable);

#[pymethods]
impl PyComparisonTable {
    /// The runs, method by method: a list of Row.
    #[getter]
    fn rows(&self) -> Vec<PyRow> {
        self.0.rows.iter().cloned().map(PyRow).collect()
    }

    /// What the errors are measured against.
    #[getter]
    fn reference(&self) -> &str {
        &self.0.reference
    }

    /// Estimated error of the reference itself [-]; errors below are not told apart from it.
    #[getter]
    fn reference_error(&self) -> f64 {
        self.0.reference_error
    }

    /// The table as comma-separated values; a run that broke off has no error.
    #[pyo3(signature = ())]
    fn to_csv(&self) -> String {
        self.0.to_csv()
    }

    /// Draws error against processor time, both logarithmic, and returns the figure; needs matplotlib.
    ///
    /// Parameters
    /// ----------
    /// figure : matplotlib.figure.Figure, optional
    ///     Where to draw; a new figure by default.
    #[pyo3(signature = (figure=None))]
    fn plot<'py>(slf: &Bound<'py, Self>, figure: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("bryla._plot")?.call_method1("comparison", (slf, figure))
    }

    /// Number of rows.
    fn __len__(&self) -> usize {
        self.0.rows.len()
    }

    fn __str__(&self) -> String {
        self.0.to_string()
    }

    fn __repr__(&self) -> String {
        format!("<bryla.ComparisonTable: {} rows against {}>", self.0.rows.len(), self.0.reference)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

/// Adds the classes.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyRow>()?;
    module.add_class::<PyComparisonTable>()
}
