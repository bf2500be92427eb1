//! What went wrong, as Python's exceptions.

use bryla::{RunError, SimulationError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

use crate::trajectory::PyTrajectory;

/// Bad input, a run that broke off, or an exception of Python itself.
#[derive(Debug)]
pub(crate) enum Failure {
    Input(bryla::Error),
    Simulation(Box<SimulationError>),
    Python(PyErr),
}

pub(crate) type Result<T, E = Failure> = std::result::Result<T, E>;

impl From<bryla::Error> for Failure {
    fn from(error: bryla::Error) -> Self {
        Self::Input(error)
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Input(error) => Self::Input(error),
            RunError::Simulation(error) => Self::Simulation(error),
        }
    }
}

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Input(error) => Python::attach(|py| raised(py, "Error", (error.to_string(),))),
            Failure::Simulation(error) => Python::attach(|py| {
                let message = error.to_string();
                let run = error.trajectory.map(|run| PyTrajectory::new(*run));
                raised(py, "SimulationError", (message, error.time, error.bodies, run))
            }),
            Failure::Python(error) => error,
        }
    }
}

/// A class of `bryla._errors`.
pub(crate) fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyType>> {
    static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();
    let module = MODULE.get_or_try_init(py, || py.import("bryla._errors").map(Bound::unbind))?;
    Ok(module.bind(py).getattr(name)?.cast_into()?)
}

/// An exception of `bryla._errors`; where it cannot be made, why.
fn raised<'py>(py: Python<'py>, name: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    match class(py, name).and_then(|class| class.call1(arguments)) {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}
