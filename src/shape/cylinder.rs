//! A circular cylinder: origin in its centre, axis along z.

use super::{Solid, off_axis, require_positive};
use crate::error::Result;
use crate::mass::{MassProperties, cylinder};
use crate::math::Vector3;

/// A circular cylinder with its centre in the origin and its axis along z, from `−half_height` to
/// `half_height`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cylinder {
    /// Radius [m].
    pub radius: f64,
    /// Half of its height [m].
    pub half_height: f64,
}

impl Cylinder {
    /// A cylinder along z from its radius [m] and half of its height [m].
    pub fn new(radius: f64, half_height: f64) -> Self {
        Self { radius, half_height }
    }
}

impl Solid for Cylinder {
    fn validate(&self, place: &str) -> Result<()> {
        require_positive(place, "radius", self.radius)?;
        require_positive(place, "half_height", self.half_height)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        Ok(cylinder::mass_properties(self.radius, self.half_height, density))
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        libm::hypot(off_axis(about) + self.radius, about.z.abs() + self.half_height)
    }
}
