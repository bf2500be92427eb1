//! Freedoms: how a body may move.

use bryla::freedom::{Axle, Pivot, Planar, Prescribed};
use bryla::{Freedom, Schedule};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::convert::{Numbers, Plain, plain_class};
use crate::error::{Failure, Result};

plain_class! {
    /// Motion in a plane through the body's start: 3 degrees of freedom.
    ///
    /// Parameters
    /// ----------
    /// normal : 3 numbers
    ///     Normal of the plane, world axes; of any length but 0.
    class "Planar" PyPlanar(Planar) (normal) as "(normal)" {
        /// Normal of the plane, world axes.
        normal: [f64; 3],
    }
}

plain_class! {
    /// Motion about a point that rests in the world: 3 degrees of freedom, a top.
    ///
    /// Parameters
    /// ----------
    /// point_body : 3 numbers
    ///     The point that rests, body axes from the centre of mass [m].
    class "Pivot" PyPivot(Pivot) (point_body) as "(point_body)" {
        /// The point that rests, body axes from the centre of mass [m].
        point_body: [f64; 3],
    }
}

plain_class! {
    /// Motion about an axis that rests in the world: 1 degree of freedom, a pendulum or a wheel.
    ///
    /// Parameters
    /// ----------
    /// point_body : 3 numbers
    ///     A point of the axis, body axes from the centre of mass [m].
    /// axis_body : 3 numbers
    ///     Direction of the axis, body axes; of any length but 0.
    class "Axle" PyAxle(Axle) (point_body, axis_body) as "(point_body, axis_body)" {
        /// A point of the axis, body axes from the centre of mass [m].
        point_body: [f64; 3],
        /// Direction of the axis, body axes.
        axis_body: [f64; 3],
    }
}

plain_class! {
    /// A motion that nothing disturbs: a turntable, a conveyor, a bat.
    ///
    /// The body point center moves with velocity, the body turns about it with angular_velocity, both times a factor
    /// that is constant between the times of the schedule. Position and orientation of the body are those at time 0.
    ///
    /// Parameters
    /// ----------
    /// velocity : 3 numbers
    ///     Velocity of the point center, world axes [m/s].
    /// angular_velocity : 3 numbers
    ///     Angular velocity, world axes [rad/s].
    /// center : 3 numbers
    ///     The point that the body turns about, shape axes [m].
    /// schedule : list of (time, factor), optional
    ///     Factor of both velocities: 0 before the first time [s], held after the last; 1 always, if absent.
    class "Prescribed" PyPrescribed(Prescribed)
    (*, velocity=Numbers([0.0; 3]), angular_velocity=Numbers([0.0; 3]), center=Numbers([0.0; 3]), schedule=None)
    as "(*, velocity=(0.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 0.0), center=(0.0, 0.0, 0.0), schedule=None)"
    {
        /// Velocity of the point center, world axes [m/s].
        velocity: [f64; 3],
        /// Angular velocity, world axes [rad/s].
        angular_velocity: [f64; 3],
        /// The point that the body turns about, shape axes [m].
        center: [f64; 3],
        /// Factor of both velocities: (time [s], factor), or None.
        schedule: Option<Schedule>,
    }
}

/// A motion as an argument or a value.
#[derive(Debug, Clone)]
pub(crate) struct AnyPrescribed(Prescribed);

impl Plain for Prescribed {
    type Value = AnyPrescribed;

    fn to_python(&self) -> AnyPrescribed {
        AnyPrescribed(self.clone())
    }

    fn from_python(value: AnyPrescribed) -> Result<Self> {
        Ok(value.0)
    }
}

impl<'py> FromPyObject<'_, 'py> for AnyPrescribed {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        Ok(Self(obj.cast::<PyPrescribed>()?.get().0.clone()))
    }
}

impl<'py> IntoPyObject<'py> for AnyPrescribed {
    type Target = PyPrescribed;
    type Output = Bound<'py, PyPrescribed>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        Bound::new(py, PyPrescribed(self.0))
    }
}

/// Any freedom, as an argument or a value: `"free"`, or an object.
#[derive(Debug, Clone)]
pub(crate) struct AnyFreedom(pub(crate) Freedom);

impl<'py> FromPyObject<'_, 'py> for AnyFreedom {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(freedom) = obj.cast::<PyPlanar>() {
            return Ok(Self(Freedom::Planar(freedom.get().0.clone())));
        }
        if let Ok(freedom) = obj.cast::<PyPivot>() {
            return Ok(Self(Freedom::Pivot(freedom.get().0.clone())));
        }
        if let Ok(freedom) = obj.cast::<PyAxle>() {
            return Ok(Self(Freedom::Axle(freedom.get().0.clone())));
        }
        if obj.extract::<&str>().is_ok_and(|name| name == Freedom::Free.name()) {
            return Ok(Self(Freedom::Free));
        }
        let given = obj.repr()?.to_string();
        let allowed = "\"free\", Planar, Pivot or Axle".to_owned();
        let error = bryla::Error::Value { place: "body".to_owned(), field: "freedom", allowed, value: given };
        Err(Failure::Input(error).into())
    }
}

impl<'py> IntoPyObject<'py> for AnyFreedom {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        Ok(match self.0 {
            Freedom::Free => PyString::new(py, Freedom::Free.name()).into_any(),
            Freedom::Planar(data) => Bound::new(py, PyPlanar(data))?.into_any(),
            Freedom::Pivot(data) => Bound::new(py, PyPivot(data))?.into_any(),
            Freedom::Axle(data) => Bound::new(py, PyAxle(data))?.into_any(),
        })
    }
}

impl Plain for Freedom {
    type Value = AnyFreedom;

    fn to_python(&self) -> AnyFreedom {
        AnyFreedom(self.clone())
    }

    fn from_python(value: AnyFreedom) -> Result<Self> {
        Ok(value.0)
    }
}

/// Adds the classes.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyPlanar>()?;
    module.add_class::<PyPivot>()?;
    module.add_class::<PyAxle>()?;
    module.add_class::<PyPrescribed>()
}
