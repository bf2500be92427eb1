//! What a run shall watch for.

use std::sync::Arc;

use bryla::math::roots::Passage;
use bryla::{BodyMotion, Direction, Measure, MeasureFunction, UserEvent};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

use crate::convert::{List, Numbers, Plain, plain_class};
use crate::effect::called;
use crate::error::Result;

plain_class! {
    /// An event: a measure of the motion meets a value.
    ///
    ///     g(t) = measure(t, bodies) − value = 0
    ///
    /// It is searched for along the motion of every step, and located to a few ulp of the time. Steps are
    /// excluded by bounds of g, not by the signs at their ends, so that double roots and close pairs are
    /// seen; a touch is told where g comes to 0 within its rounding and goes back. A zero at the very
    /// start is no event, nor is one that the run ends on before g is seen leaving. Bodies of one event
    /// share one integrator and one clock.
    ///
    /// With a function it is code, and can neither be written to a file nor pickled. What the function
    /// raises ends the run and becomes the cause of its SimulationError.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     A name that no other event of the run has.
    /// measure : callable, str or dict
    ///     measure(t, bodies) -> float, a smooth function of a time [s] and a tuple of BodyMotion; or "speed",
    ///     "angular_speed", "distance" (of two bodies), {"position": n}, {"velocity": n},
    ///     {"angular_velocity": n}, {"angular_velocity_body": n} with a direction n of 3 numbers, or
    ///     {"tilt": {"axis_body": a, "axis": n}}, (R a)·n.
    /// bodies : list of str
    ///     The bodies that it is measured of, in this order.
    /// value : float
    ///     The value that it shall meet.
    /// direction : {"both", "rising", "falling"}
    ///     Which passages count; "both" (default) counts touches too.
    /// terminal : bool
    ///     Whether the run ends there.
    class "UserEvent" PyUserEvent(UserEvent)
    (name, measure, bodies, value=0.0, direction=Direction::Both.to_python(), terminal=false)
    as "(name, measure, bodies, value=0.0, direction='both', terminal=False)"
    {
        /// A name that no other event of the run has.
        name: String,
        /// What is watched: a callable, a str or a dict.
        measure: Measure,
        /// The bodies that it is measured of.
        bodies: Vec<String>,
        /// The value that it shall meet, in the unit of the measure.
        value: f64,
        /// Which passages count: "rising", "falling" or "both".
        direction: Direction,
        /// Whether the run ends there.
        terminal: bool,
    }
}

/// A measure as Python writes it.
#[derive(Debug)]
pub(crate) struct AnyMeasure(Measure);

impl Plain for Measure {
    type Value = AnyMeasure;

    fn to_python(&self) -> AnyMeasure {
        AnyMeasure(self.clone())
    }

    fn from_python(value: AnyMeasure) -> Result<Self> {
        Ok(value.0)
    }
}

/// A function of Python as a measure.
fn function_measure(function: Py<PyAny>) -> MeasureFunction {
    let function = Arc::new(function);
    let callee = function.clone();
    let call = move |t: f64, bodies: &[BodyMotion]| called(&callee, t, bodies, |given| given.extract());
    MeasureFunction::new(call).attach(function)
}

impl<'py> FromPyObject<'_, 'py> for AnyMeasure {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if obj.is_callable() {
            return Ok(Self(function_measure(obj.to_owned().unbind()).into()));
        }
        let unknown = || PyTypeError::new_err(format!("a callable, a name or a dict of one name wanted, got {obj:?}"));
        if let Ok(name) = obj.cast::<PyString>() {
            return match name.to_str()? {
                "speed" => Ok(Self(Measure::Speed)),
                "angular_speed" => Ok(Self(Measure::AngularSpeed)),
                "distance" => Ok(Self(Measure::Distance)),
                _ => Err(unknown()),
            };
        }
        let table = obj.cast::<PyDict>().map_err(|_| unknown())?;
        let (Some((name, value)), 1) = (table.iter().next(), table.len()) else { return Err(unknown()) };
        let direction = || value.extract::<Numbers<3>>().map(|n| n.0);
        Ok(Self(match name.extract::<String>()?.as_str() {
            "position" => Measure::Position(direction()?),
            "velocity" => Measure::Velocity(direction()?),
            "angular_velocity" => Measure::AngularVelocity(direction()?),
            "angular_velocity_body" => Measure::AngularVelocityBody(direction()?),
            "tilt" => {
                let axes = value.cast::<PyDict>().map_err(|_| unknown())?;
                let axis = |key| axes.get_item(key)?.ok_or_else(unknown)?.extract::<Numbers<3>>().map(|n| n.0);
                Measure::Tilt { axis_body: axis("axis_body")?, axis: axis("axis")? }
            }
            _ => return Err(unknown()),
        }))
    }
}

impl<'py> IntoPyObject<'py> for AnyMeasure {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        let table = PyDict::new(py);
        match &self.0 {
            Measure::Position(n)
            | Measure::Velocity(n)
            | Measure::AngularVelocity(n)
            | Measure::AngularVelocityBody(n) => table.set_item(self.0.name(), Numbers(*n))?,
            Measure::Tilt { axis_body, axis } => {
                let axes = PyDict::new(py);
                axes.set_item("axis_body", Numbers(*axis_body))?;
                axes.set_item("axis", Numbers(*axis))?;
                table.set_item(self.0.name(), axes)?;
            }
            Measure::Function(function) => {
                let attached = function.attached().and_then(|object| object.downcast::<Py<PyAny>>().ok());
                let made_here = || PyTypeError::new_err("a measure without a Python function");
                return Ok(attached.ok_or_else(made_here)?.bind(py).clone());
            }
            _ => return self.0.name().into_bound_py_any(py),
        }
        Ok(table.into_any())
    }
}

/// The events of a run, from Python's list.
pub(crate) fn events(given: &Bound<'_, PyAny>) -> PyResult<Vec<UserEvent>> {
    let events: List<Bound<'_, PyUserEvent>> = given.extract()?;
    Ok(events.0.iter().map(|event| event.get().0.clone()).collect())
}

/// The name of a passage.
pub(crate) fn passage(passage: Option<Passage>) -> Option<&'static str> {
    passage.map(Passage::name)
}
