//! A capsule: origin in its centre, axis along z.

use super::{Solid, off_axis, require_positive};
use crate::error::{Error, Result};
use crate::mass::{MassProperties, capsule};
use crate::math::Vector3;

/// All points within `radius` of the segment from `−half_height` to `half_height` on the z axis: a
/// cylinder with a half sphere on each end, `2 (half_height + radius)` long, its centre in the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Capsule {
    /// Radius of the cylinder and of the half spheres [m].
    pub radius: f64,
    /// Half of the cylinder's height, without the half spheres [m]; 0 makes a ball.
    pub half_height: f64,
}

impl Capsule {
    /// A capsule along z from its radius [m] and half of the cylinder's height [m].
    pub fn new(radius: f64, half_height: f64) -> Self {
        Self { radius, half_height }
    }
}

impl Solid for Capsule {
    fn validate(&self, place: &str) -> Result<()> {
        require_positive(place, "radius", self.radius)?;
        if self.half_height >= 0.0 && self.half_height.is_finite() {
            return Ok(());
        }
        Err(Error::value(place, "half_height", "finite and not negative", self.half_height))
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        Ok(capsule::mass_properties(self.radius, self.half_height, density))
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        libm::hypot(off_axis(about), about.z.abs() + self.half_height) + self.radius
    }
}
