//! Quantities of a motion that events and switches watch.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::math::Vector3;
use crate::state::BodyMotion;

/// A quantity of the motion of one body, or of several.
///
/// ```text
/// position n·x   velocity n·v   speed |v|   angular_velocity n·ω   angular_velocity_body n·Rᵀω   angular_speed |ω|
/// tilt (R a)·n   distance |x_b − x_a|
/// ```
///
/// `n` is a direction in world axes, or in body axes where the name says so; it need not be of unit length.
/// World axes elsewhere, about centres of mass.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Measure {
    /// Position of the centre of mass along a direction, n·x [m].
    Position([f64; 3]),
    /// Velocity of the centre of mass along a direction, n·v [m/s].
    Velocity([f64; 3]),
    /// Speed of the centre of mass, |v| [m/s].
    Speed,
    /// Angular velocity about a direction, n·ω [rad/s].
    AngularVelocity([f64; 3]),
    /// Angular velocity about a direction in body axes [rad/s].
    AngularVelocityBody([f64; 3]),
    /// Rate of rotation, |ω| [rad/s].
    AngularSpeed,
    /// How far a body axis leans towards a direction, (R a)·n [-]: the cosine of their angle for unit vectors.
    Tilt {
        /// Axis a of the body, body axes [-].
        axis_body: [f64; 3],
        /// Direction n, world axes [-].
        axis: [f64; 3],
    },
    /// Distance of the centres of mass of two bodies [m].
    Distance,
    /// A function of the user; it cannot be written to a file.
    #[cfg_attr(feature = "serde", serde(skip))]
    Function(MeasureFunction),
}

impl Measure {
    /// The name that files and reports use.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Position(_) => "position",
            Self::Velocity(_) => "velocity",
            Self::Speed => "speed",
            Self::AngularVelocity(_) => "angular_velocity",
            Self::AngularVelocityBody(_) => "angular_velocity_body",
            Self::AngularSpeed => "angular_speed",
            Self::Tilt { .. } => "tilt",
            Self::Distance => "distance",
            Self::Function(_) => "function",
        }
    }

    /// How many bodies it is of; none where any number will do.
    pub fn bodies(&self) -> Option<usize> {
        match self {
            Self::Function(_) => None,
            Self::Distance => Some(2),
            _ => Some(1),
        }
    }

    /// Refuses directions that mean nothing; `place` names whose they are.
    pub(crate) fn validate(&self, place: &str) -> Result<()> {
        let directions: &[[f64; 3]] = match self {
            Self::Position(n) | Self::Velocity(n) | Self::AngularVelocity(n) | Self::AngularVelocityBody(n) => &[*n],
            Self::Tilt { axis_body, axis } => &[*axis_body, *axis],
            _ => &[],
        };
        match directions.iter().find(|n| !n.iter().all(|x| x.is_finite()) || **n == [0.0; 3]) {
            Some(bad) => Err(Error::value(place, "measure", "along a finite direction other than 0", bad)),
            None => Ok(()),
        }
    }

    /// Its value at `t` [s] for the motions of its bodies.
    ///
    /// # Errors
    /// What a user's function complains about.
    pub fn value(&self, t: f64, bodies: &[BodyMotion]) -> Result<f64, String> {
        let (first, last) = match bodies {
            [first, .., last] => (first, last),
            [only] => (only, only),
            [] => return Err("no body to measure".to_owned()),
        };
        let along = |n: &[f64; 3], v: &Vector3| Vector3::from(*n).dot(v);
        Ok(match self {
            Self::Position(n) => along(n, &first.position),
            Self::Velocity(n) => along(n, &first.velocity),
            Self::Speed => first.velocity.norm(),
            Self::AngularVelocity(n) => along(n, &first.angular_velocity),
            Self::AngularVelocityBody(n) => along(n, &first.angular_velocity_body()),
            Self::AngularSpeed => first.angular_velocity.norm(),
            Self::Tilt { axis_body, axis } => along(axis, &(first.rotation * Vector3::from(*axis_body))),
            Self::Distance => (last.position - first.position).norm(),
            Self::Function(function) => return function.call(t, bodies),
        })
    }

    /// The size of the numbers that it is worked out from, by which its rounding is measured.
    pub(crate) fn size(&self, bodies: &[BodyMotion]) -> f64 {
        let largest = |of: fn(&BodyMotion) -> f64| bodies.iter().map(of).fold(0.0, f64::max);
        let length = |n: &[f64; 3]| Vector3::from(*n).norm();
        match self {
            Self::Position(n) => length(n) * largest(|body| body.position.norm()),
            Self::Velocity(n) => length(n) * largest(|body| body.velocity.norm()),
            Self::AngularVelocity(n) | Self::AngularVelocityBody(n) => {
                length(n) * largest(|body| body.angular_velocity.norm())
            }
            Self::Tilt { axis_body, axis } => length(axis_body) * length(axis),
            Self::Distance => largest(|body| body.position.norm()),
            Self::Speed | Self::AngularSpeed | Self::Function(_) => 0.0,
        }
    }
}

/// A function g(t, bodies) of the user: of a time [s] and the motions of the bodies that were named.
///
/// It is called several times a step, at any time within it, and must depend on nothing but its arguments.
/// What it complains about ends the run.
#[derive(Clone)]
pub struct MeasureFunction {
    function: Arc<Function>,
    attached: Option<Arc<dyn Any + Send + Sync>>,
}

type Function = dyn Fn(f64, &[BodyMotion]) -> Result<f64, String> + Send + Sync;

impl MeasureFunction {
    /// A function as a measure.
    pub fn new(function: impl Fn(f64, &[BodyMotion]) -> Result<f64, String> + Send + Sync + 'static) -> Self {
        Self { function: Arc::new(function), attached: None }
    }

    /// Keeps something of the caller's with it, such as what the function was made from.
    #[must_use]
    pub fn attach(mut self, object: Arc<dyn Any + Send + Sync>) -> Self {
        self.attached = Some(object);
        self
    }

    /// What the caller attached.
    pub fn attached(&self) -> Option<Arc<dyn Any + Send + Sync>> {
        self.attached.clone()
    }

    fn call(&self, t: f64, bodies: &[BodyMotion]) -> Result<f64, String> {
        (self.function)(t, bodies)
    }
}

impl fmt::Debug for MeasureFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("function")
    }
}

/// Two are equal when they are the same function.
impl PartialEq for MeasureFunction {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.function, &other.function)
    }
}

impl From<MeasureFunction> for Measure {
    fn from(function: MeasureFunction) -> Self {
        Self::Function(function)
    }
}
