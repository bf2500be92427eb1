//! A circular cone: origin half way up its axis, which lies along z.

use super::{Solid, off_axis, require_positive};
use crate::error::Result;
use crate::mass::{MassProperties, cone};
use crate::math::Vector3;

/// A circular cone along z: its apex at `z = half_height`, its base at `z = −half_height`. The origin is
/// half way up; the centre of mass lies lower, at `z = −half_height/2`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cone {
    /// Radius of the base [m].
    pub radius: f64,
    /// Half of its height [m].
    pub half_height: f64,
}

impl Cone {
    /// A cone along z from the radius of its base [m] and half of its height [m].
    pub fn new(radius: f64, half_height: f64) -> Self {
        Self { radius, half_height }
    }
}

impl Solid for Cone {
    fn validate(&self, place: &str) -> Result<()> {
        require_positive(place, "radius", self.radius)?;
        require_positive(place, "half_height", self.half_height)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        Ok(cone::mass_properties(self.radius, self.half_height, density))
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        let apex = libm::hypot(off_axis(about), about.z - self.half_height);
        let base = libm::hypot(off_axis(about) + self.radius, about.z + self.half_height);
        apex.max(base)
    }
}
