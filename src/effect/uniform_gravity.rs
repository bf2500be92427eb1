//! Uniform gravity.

use super::{BodyMotion, Effect, Load, Moment, Target, finite};
use crate::error::Result;
use crate::math::Vector3;

/// Uniform gravity: the same acceleration everywhere.
///
/// ```text
/// F = m g        M = 0        U = −m g·x
/// ```
///
/// The force acts at the centre of mass, so it has no lever arm and turns nothing
/// (lecture, remark after (10)).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UniformGravity {
    /// Acceleration g, world axes [m/s²].
    pub acceleration: [f64; 3],
    /// The bodies it acts on; all if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub bodies: Option<Vec<String>>,
}

impl UniformGravity {
    /// Gravity with this acceleration [m/s²] on all bodies.
    pub fn new(acceleration: impl Into<[f64; 3]>) -> Self {
        Self { acceleration: acceleration.into(), bodies: None }
    }

    /// The same on the named bodies only.
    #[must_use]
    pub fn on<S: Into<String>>(mut self, bodies: impl IntoIterator<Item = S>) -> Self {
        self.bodies = Some(bodies.into_iter().map(Into::into).collect());
        self
    }
}

impl Effect for UniformGravity {
    fn validate(&self, place: &str) -> Result<()> {
        finite(place, "acceleration", self.acceleration).map(drop)
    }

    fn target(&self) -> Target {
        Target::each(self.bodies.as_ref())
    }

    fn idle(&self) -> Option<&'static str> {
        (self.acceleration == [0.0; 3]).then_some("its acceleration is 0")
    }

    fn conservative(&self) -> bool {
        true
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn is_constant(&self) -> bool {
        true
    }

    fn add_to_one(&self, _at: Moment, body: &BodyMotion, load: &mut Load) {
        load.force += body.mass * Vector3::from(self.acceleration);
    }

    fn potential_energy(&self, _at: Moment, bodies: &[BodyMotion]) -> f64 {
        let g = Vector3::from(self.acceleration);
        bodies.iter().map(|body| -body.mass * g.dot(&body.position)).sum()
    }
}
