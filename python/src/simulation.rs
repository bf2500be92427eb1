//! Simulations that are advanced by hand.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};
use std::time::{Duration, Instant};

use bryla::{RunError, Simulation};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::body::PyBodyMotion;
use crate::effect::take_raised;
use crate::error::{Failure, Result};
use crate::report::PyCounts;
use crate::run::explained;
use crate::trajectory::PyEvent;

/// A running scene, advanced by hand; made by Plan.start or resume.
#[pyclass(name = "Simulation", module = "bryla", frozen)]
#[derive(Debug)]
pub(crate) struct PySimulation(Mutex<Simulation>);

/// Time between two looks at Python's signals.
const LOOK: Duration = Duration::from_millis(20);
/// Steps of the first piece that a long way is advanced by.
const FIRST_STEPS: f64 = 64.0;

impl PySimulation {
    pub(crate) fn new(simulation: Simulation) -> Self {
        Self(Mutex::new(simulation))
    }

    /// The simulation, unless it is at work: waiting for it here could wait for ever.
    fn idle(&self) -> Result<MutexGuard<'_, Simulation>> {
        self.0.try_lock().map_err(|_| {
            Failure::Python(PyRuntimeError::new_err("the simulation is being advanced; ask it when that has ended"))
        })
    }
}

/// Advances for a while, by pieces of `piece` [s] which grow; the bits do not depend on them.
fn advance_a_while(simulation: &mut Simulation, to: f64, piece: &mut f64) -> Result<(), RunError> {
    let began = Instant::now();
    loop {
        let next = simulation.time() + *piece;
        let end = if next < to { next } else { to };
        let at = Instant::now();
        simulation.advance(end)?;
        if end >= to || began.elapsed() >= LOOK {
            return Ok(());
        }
        if at.elapsed() < LOOK / 4 {
            *piece *= 2.0;
        }
    }
}

#[pymethods]
impl PySimulation {
    /// The time to which it was advanced [s].
    #[getter]
    fn time(&self) -> Result<f64> {
        Ok(self.idle()?.time())
    }

    /// What has happened so far, group by group.
    #[getter]
    fn events(&self) -> Result<Vec<PyEvent>> {
        let simulation = self.idle()?;
        Ok(simulation.events().iter().map(|event| PyEvent::new(simulation.plan(), event)).collect())
    }

    /// What has been done so far.
    #[getter]
    fn counts(&self) -> Result<PyCounts> {
        Ok(PyCounts(self.idle()?.counts()))
    }

    /// Advances to a time [s]. Steps are never shortened for it, so that advancing in pieces gives the
    /// same bits as advancing at once. Other threads go on meanwhile, and Ctrl-C stops it between steps.
    #[pyo3(signature = (to))]
    fn advance(&self, py: Python<'_>, to: f64) -> Result<()> {
        let mut simulation = self.idle()?;
        take_raised();
        let step = simulation.plan().options().step.filter(|_| to.is_finite()).unwrap_or(f64::INFINITY);
        let mut piece = FIRST_STEPS * step;
        loop {
            let result = {
                let simulation = &mut *simulation;
                py.detach(|| advance_a_while(simulation, to, &mut piece))
            };
            result.map_err(|error| explained(py, error.into(), None))?;
            if simulation.time() >= to {
                return Ok(());
            }
            py.check_signals()?;
        }
    }

    /// Motion of a body at the time to which the simulation was advanced.
    #[pyo3(signature = (name))]
    fn state(&self, name: &str) -> Result<PyBodyMotion> {
        Ok(PyBodyMotion(self.idle()?.motion(name)?))
    }

    /// Writes the running state to a file, conventionally .bryla; resume goes on from it with the same
    /// bits.
    #[pyo3(signature = (path))]
    fn save(&self, path: PathBuf) -> Result<()> {
        Ok(self.idle()?.save(path)?)
    }

    fn __repr__(&self) -> String {
        self.0.try_lock().map_or_else(
            |_| "<bryla.Simulation: being advanced>".to_owned(),
            |simulation| format!("<bryla.Simulation: t = {} s>", simulation.time()),
        )
    }
}

/// Loads a running state that Simulation.save wrote; it goes on with the same bits.
#[pyfunction]
#[pyo3(signature = (path))]
pub(crate) fn resume(path: PathBuf) -> Result<PySimulation> {
    Ok(PySimulation::new(Simulation::resume(path)?))
}
