//! A body as the user describes it.

use crate::contact::BreakingLoad;
pub use crate::contact::Response;
use crate::error::{Error, Result};
use crate::freedom::{Freedom, Prescribed};
use crate::mass::MassProperties;
use crate::math::{Matrix3, Vector3, quaternion};
use crate::shape::Shape;
use crate::tolerance::QUATERNION_LENGTH;

/// One body: shape, mass, start and material. SI units, angles in radians.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Body {
    /// A name that no other body of the scene has.
    pub name: String,
    /// The solid; without one, mass and inertia are given.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub shape: Option<Shape>,
    /// Uniform density [kg/m³].
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub density: Option<f64>,
    /// Mass [kg]; instead of the density, or beside `inertia`.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub mass: Option<f64>,
    /// Inertia about the centre of mass, body axes [kg·m²]; instead of that of a uniform solid.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub inertia: Option<[[f64; 3]; 3]>,
    /// Where the centre of mass starts, world axes [m]; of a fixed body, the shape's origin.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub position: Option<[f64; 3]>,
    /// Where the origin of the shape's coordinates starts, world axes [m]; instead of `position`.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub origin: Option<[f64; 3]>,
    /// Rotation from body to world axes, (w, x, y, z).
    #[cfg_attr(feature = "serde", serde(default = "upright", skip_serializing_if = "is_upright"))]
    pub orientation: [f64; 4],
    /// Velocity of the centre of mass, world axes [m/s]; 0, or what the freedom asks, if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub velocity: Option<[f64; 3]>,
    /// Angular velocity, world axes [rad/s].
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub angular_velocity: Option<[f64; 3]>,
    /// Angular velocity, body axes [rad/s]; instead of `angular_velocity`.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub angular_velocity_body: Option<[f64; 3]>,
    /// Coefficient of friction; a pair has the geometric mean of both [-].
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub friction: f64,
    /// Coefficient of restitution, 0..=1; a pair has the larger of both [-].
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub restitution: f64,
    /// What happens when it touches another body.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_bounce"))]
    pub response: Response,
    /// The load under which what it sticks to, or what sticks to it, comes off; of a pair the weaker counts. Never, if
    /// absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub breaking_load: Option<BreakingLoad>,
    /// Whether it stays where it is.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub fixed: bool,
    /// The motion that it is moved along, whatever it meets; its position and orientation are those at time 0.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub motion: Option<Prescribed>,
    /// How it may move.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_free"))]
    pub freedom: Freedom,
    /// Whether its shape meets other bodies; if not, it serves for the mass alone.
    #[cfg_attr(feature = "serde", serde(default = "yes", skip_serializing_if = "Clone::clone"))]
    pub collides: bool,
}

const UPRIGHT: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

#[cfg(feature = "serde")]
mod defaults {
    //! What a file may leave out, and what a written file does.
    #![expect(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]

    use super::{Freedom, Response, UPRIGHT};

    pub(super) fn upright() -> [f64; 4] {
        UPRIGHT
    }
    pub(super) fn yes() -> bool {
        true
    }
    pub(super) fn is_upright(q: &[f64; 4]) -> bool {
        *q == UPRIGHT
    }
    pub(super) fn is_zero(x: &f64) -> bool {
        *x == 0.0
    }
    pub(super) fn is_bounce(response: &Response) -> bool {
        *response == Response::Bounce
    }
    pub(super) fn is_free(freedom: &Freedom) -> bool {
        *freedom == Freedom::Free
    }
}
#[cfg(feature = "serde")]
use defaults::{is_bounce, is_free, is_upright, is_zero, upright, yes};

impl Body {
    /// A body of this shape, at rest at the world's origin; give it a density or a mass.
    pub fn new(name: impl Into<String>, shape: impl Into<Shape>) -> Self {
        Self { shape: Some(shape.into()), ..Self::without_shape(name) }
    }

    /// A body known by its mass [kg] and its inertia about the centre of mass, body axes [kg·m²].
    pub fn with_inertia(name: impl Into<String>, mass: f64, inertia: impl Into<Matrix3>) -> Self {
        let i: Matrix3 = inertia.into();
        let rows = [0, 1, 2].map(|r| [0, 1, 2].map(|c| i[(r, c)]));
        Self { mass: Some(mass), inertia: Some(rows), ..Self::without_shape(name) }
    }

    fn without_shape(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            shape: None,
            density: None,
            mass: None,
            inertia: None,
            position: None,
            origin: None,
            orientation: UPRIGHT,
            velocity: None,
            angular_velocity: None,
            angular_velocity_body: None,
            friction: 0.0,
            restitution: 0.0,
            response: Response::Bounce,
            breaking_load: None,
            fixed: false,
            motion: None,
            freedom: Freedom::Free,
            collides: true,
        }
    }

    /// Uniform density [kg/m³].
    #[must_use]
    pub fn density(mut self, density: f64) -> Self {
        self.density = Some(density);
        self
    }

    /// Mass [kg].
    #[must_use]
    pub fn mass(mut self, mass: f64) -> Self {
        self.mass = Some(mass);
        self
    }

    /// Where the centre of mass starts, world axes [m]; of a fixed body, the shape's origin.
    #[must_use]
    pub fn position(mut self, position: impl Into<[f64; 3]>) -> Self {
        self.position = Some(position.into());
        self
    }

    /// Where the origin of the shape's coordinates starts, world axes [m].
    #[must_use]
    pub fn origin(mut self, origin: impl Into<[f64; 3]>) -> Self {
        self.origin = Some(origin.into());
        self
    }

    /// Rotation from body to world axes, (w, x, y, z).
    #[must_use]
    pub fn orientation(mut self, orientation: [f64; 4]) -> Self {
        self.orientation = orientation;
        self
    }

    /// Velocity of the centre of mass, world axes [m/s].
    #[must_use]
    pub fn velocity(mut self, velocity: impl Into<[f64; 3]>) -> Self {
        self.velocity = Some(velocity.into());
        self
    }

    /// Angular velocity, world axes [rad/s].
    #[must_use]
    pub fn angular_velocity(mut self, angular_velocity: impl Into<[f64; 3]>) -> Self {
        self.angular_velocity = Some(angular_velocity.into());
        self
    }

    /// Angular velocity, body axes [rad/s].
    #[must_use]
    pub fn angular_velocity_body(mut self, angular_velocity: impl Into<[f64; 3]>) -> Self {
        self.angular_velocity_body = Some(angular_velocity.into());
        self
    }

    /// Coefficient of friction [-].
    #[must_use]
    pub fn friction(mut self, friction: f64) -> Self {
        self.friction = friction;
        self
    }

    /// Coefficient of restitution, 0..=1 [-].
    #[must_use]
    pub fn restitution(mut self, restitution: f64) -> Self {
        self.restitution = restitution;
        self
    }

    /// What happens when it touches another body.
    #[must_use]
    pub fn response(mut self, response: Response) -> Self {
        self.response = response;
        self
    }

    /// The load under which what it sticks to, or what sticks to it, comes off.
    #[must_use]
    pub fn breaking_load(mut self, load: BreakingLoad) -> Self {
        self.breaking_load = Some(load);
        self
    }

    /// Makes it stay where it is.
    #[must_use]
    pub fn fixed(mut self) -> Self {
        self.fixed = true;
        self
    }

    /// The motion that it is moved along, whatever it meets.
    #[must_use]
    pub fn motion(mut self, motion: Prescribed) -> Self {
        self.motion = Some(motion);
        self
    }

    /// How it may move.
    #[must_use]
    pub fn freedom(mut self, freedom: Freedom) -> Self {
        self.freedom = freedom;
        self
    }

    /// Whether its shape meets other bodies.
    #[must_use]
    pub fn collides(mut self, collides: bool) -> Self {
        self.collides = collides;
        self
    }

    /// How messages call it.
    pub(crate) fn place(&self) -> String {
        format!("body {}", self.name)
    }

    /// Refuses values that mean nothing.
    ///
    /// # Errors
    /// Names the body, the field, its value and what is allowed.
    pub fn validate(&self) -> Result<()> {
        if self.name.trim().is_empty() {
            return Err(Error::value("body", "name", "a name that is not blank", &self.name));
        }
        let place = self.place();
        if let Some(shape) = &self.shape {
            shape.validate(&place)?;
        }
        self.validate_mass(&place)?;
        self.validate_start(&place)?;

        if !(self.friction.is_finite() && self.friction >= 0.0) {
            return Err(Error::value(place, "friction", "a finite number ≥ 0", self.friction));
        }
        if !(0.0..=1.0).contains(&self.restitution) {
            return Err(Error::value(place, "restitution", "between 0 and 1", self.restitution));
        }
        self.breaking_load.map_or(Ok(()), |load| load.validate(&place))
    }

    fn validate_mass(&self, place: &str) -> Result<()> {
        for (field, value) in [("density", self.density), ("mass", self.mass)] {
            if let Some(value) = value.filter(|x| !(x.is_finite() && *x > 0.0)) {
                return Err(Error::value(place, field, "a finite number > 0", value));
            }
        }
        let without_mass = [(self.fixed, "a fixed body"), (self.motion.is_some(), "a body with a motion")];
        if let Some((_, what)) = without_mass.into_iter().find(|(is, _)| *is) {
            return match &self.shape {
                None => Err(Error::refused(place, format!("{what} needs a shape, else it is nothing at all"))),
                Some(_) => Ok(()),
            };
        }
        match (&self.shape, self.density, self.mass, self.inertia) {
            (_, Some(_), Some(_), _) => Err(Error::refused(place, "density and mass exclude each other")),
            (_, Some(_), _, Some(_)) => Err(Error::refused(place, "density and inertia exclude each other; give mass")),
            (_, _, None, Some(_)) => Err(Error::refused(place, "inertia needs mass beside it")),
            (None, _, _, None) => Err(Error::refused(place, "without a shape, mass and inertia must be given")),
            (Some(_), None, None, None) => Err(Error::refused(place, "density or mass must be given")),
            (Some(Shape::HalfSpace(_)), ..) => {
                Err(Error::refused(place, "a half space has no finite mass; it must be fixed"))
            }
            _ => Ok(()),
        }
    }

    fn validate_start(&self, place: &str) -> Result<()> {
        let vectors = [
            ("position", self.position),
            ("origin", self.origin),
            ("velocity", self.velocity),
            ("angular_velocity", self.angular_velocity),
            ("angular_velocity_body", self.angular_velocity_body),
        ];
        for (field, value) in vectors {
            if let Some(value) = value.filter(|v| !v.iter().all(|x| x.is_finite())) {
                return Err(Error::value(place, field, "three finite numbers", value));
            }
        }
        let length = quaternion::from_scalar_first(self.orientation).norm();
        if !(1.0 - QUATERNION_LENGTH..=1.0 + QUATERNION_LENGTH).contains(&length) {
            let allowed = format!("a unit quaternion (w, x, y, z), length 1 ± {QUATERNION_LENGTH}");
            return Err(Error::value(place, "orientation", allowed, self.orientation));
        }
        if self.position.is_some() && self.origin.is_some() {
            return Err(Error::refused(place, "position and origin exclude each other"));
        }
        if self.angular_velocity.is_some() && self.angular_velocity_body.is_some() {
            return Err(Error::refused(place, "angular_velocity and angular_velocity_body exclude each other"));
        }
        if let Some(motion) = &self.motion {
            motion.validate(place, self.shape.as_ref())?;
            if self.fixed {
                return Err(Error::refused(place, "fixed and motion exclude each other"));
            }
        }
        let given =
            [(self.fixed, "fixed", "the body is fixed"), (self.motion.is_some(), "motion", "its motion says it")];
        if let Some((_, word, why)) = given.into_iter().find(|(is, ..)| *is) {
            if let Some((field, value)) = vectors[2..].iter().find_map(|(f, v)| v.map(|v| (*f, v))) {
                return Err(Error::value(place, field, format!("left out, since {why}"), value));
            }
            if self.freedom != Freedom::Free {
                return Err(Error::refused(place, format!("{word} and freedom exclude each other")));
            }
        }
        Ok(())
    }

    /// Mass, centre of mass (shape axes) and inertia of a body that moves.
    ///
    /// # Errors
    /// A shape that encloses no solid, an inertia that no solid can have.
    pub fn mass_properties(&self) -> Result<MassProperties> {
        let place = self.place();
        let solid = |density: f64| match &self.shape {
            Some(shape) => shape.mass_properties(density),
            None => Err(Error::refused(&place, "without a shape, mass and inertia must be given")),
        };
        match (self.density, self.mass, self.inertia) {
            (Some(density), ..) => solid(density),
            (None, Some(mass), Some(rows)) => {
                let center = if self.shape.is_some() { solid(1.0)?.center_of_mass } else { Vector3::zeros() };
                let inertia = Matrix3::from_fn(|r, c| rows[r][c]);
                MassProperties::new(&place, mass, center, inertia)
            }
            (None, Some(mass), None) => {
                let unit = solid(1.0)?;
                solid(mass / unit.mass)
            }
            (None, None, _) => Err(Error::refused(&place, "density or mass must be given")),
        }
    }
}
