//! Resistance of a medium.

use super::series::{Place, SeriesBody, SeriesLoad, add};
use super::{BodyMotion, Effect, Load, Moment, Target, finite, not_negative, power_of};
use crate::error::Result;
use crate::math::Vector3;
use crate::math::series::Tape;

/// Drag on translation and rotation, linear and quadratic.
///
/// ```text
/// u = v − wind
/// F = −(linear + quadratic |u|) u
/// M = −(angular_linear + angular_quadratic |ω|) ω
/// ```
///
/// The coefficients do not know the body's shape: for air, `quadratic = ½ ρ c_d A`. Strong drag
/// makes the equations stiff: an explicit method then needs a step below `2 m/linear`.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields, default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Drag {
    /// Force per speed [N·s/m].
    pub linear: f64,
    /// Force per speed squared [N·s²/m²].
    pub quadratic: f64,
    /// Torque per angular speed [N·m·s].
    pub angular_linear: f64,
    /// Torque per angular speed squared [N·m·s²].
    pub angular_quadratic: f64,
    /// Velocity of the medium, world axes [m/s].
    pub wind: [f64; 3],
    /// The bodies it acts on; all if absent.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub bodies: Option<Vec<String>>,
}

impl Drag {
    /// Drag on translation: force per speed [N·s/m] and per speed squared [N·s²/m²].
    pub fn new(linear: f64, quadratic: f64) -> Self {
        Self { linear, quadratic, ..Self::default() }
    }

    /// Drag on rotation: torque per angular speed [N·m·s] and per its square [N·m·s²].
    #[must_use]
    pub fn angular(mut self, linear: f64, quadratic: f64) -> Self {
        self.angular_linear = linear;
        self.angular_quadratic = quadratic;
        self
    }

    /// Velocity of the medium [m/s].
    #[must_use]
    pub fn wind(mut self, wind: impl Into<[f64; 3]>) -> Self {
        self.wind = wind.into();
        self
    }

    /// The same on the named bodies only.
    #[must_use]
    pub fn on<S: Into<String>>(mut self, bodies: impl IntoIterator<Item = S>) -> Self {
        self.bodies = Some(bodies.into_iter().map(Into::into).collect());
        self
    }
}

impl Effect for Drag {
    fn validate(&self, place: &str) -> Result<()> {
        not_negative(place, "linear", self.linear)?;
        not_negative(place, "quadratic", self.quadratic)?;
        not_negative(place, "angular_linear", self.angular_linear)?;
        not_negative(place, "angular_quadratic", self.angular_quadratic)?;
        finite(place, "wind", self.wind).map(drop)
    }

    fn target(&self) -> Target {
        Target::each(self.bodies.as_ref())
    }

    fn idle(&self) -> Option<&'static str> {
        [self.linear, self.quadratic, self.angular_linear, self.angular_quadratic]
            .iter()
            .all(|&c| c == 0.0)
            .then_some("all its coefficients are 0")
    }

    fn has_series(&self) -> bool {
        self.quadratic == 0.0 && self.angular_quadratic == 0.0
    }

    fn add_series(&self, _at: Moment, body: &mut SeriesBody, load: &mut SeriesLoad, tape: &mut Tape) {
        if self.linear != 0.0 {
            let wind = tape.constant(self.linear * Vector3::from(self.wind));
            add(tape, &mut load.force, wind);
            match body.place {
                Place::Moving(_, velocity) => {
                    let force = tape.scaled(-self.linear, velocity);
                    add(tape, &mut load.force, force);
                }
                Place::Arm(_, arm) => {
                    // −k ω × r
                    let force = tape.linear(body.angular_velocity, self.linear * arm.cross_matrix());
                    add(tape, &mut load.force_own, force);
                }
            }
        }
        if self.angular_linear != 0.0 {
            let torque = tape.scaled(-self.angular_linear, body.angular_velocity);
            add(tape, &mut load.torque_own, torque);
        }
    }

    fn kinks(&self, body: &BodyMotion) -> [Option<Vector3>; 2] {
        [
            (self.quadratic > 0.0).then(|| body.velocity - Vector3::from(self.wind)),
            (self.angular_quadratic > 0.0).then_some(body.angular_velocity),
        ]
    }

    fn add_to_one(&self, _at: Moment, body: &BodyMotion, load: &mut Load) {
        let u = body.velocity - Vector3::from(self.wind);
        load.force -= (self.linear + self.quadratic * u.norm()) * u;
        let w = &body.angular_velocity;
        load.torque -= (self.angular_linear + self.angular_quadratic * w.norm()) * w;
    }

    /// Minus the power of the force on the body: wind that drives a body counts as negative.
    fn dissipated_power(&self, at: Moment, bodies: &[BodyMotion]) -> f64 {
        -power_of(self, at, bodies)
    }
}
