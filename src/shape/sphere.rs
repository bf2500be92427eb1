//! A ball: origin in its centre.

use super::{Solid, require_positive};
use crate::error::Result;
use crate::mass::{MassProperties, sphere};
use crate::math::Vector3;

/// A ball with its centre in the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Sphere {
    /// Radius [m].
    pub radius: f64,
}

impl Sphere {
    /// A ball from its radius [m].
    pub fn new(radius: f64) -> Self {
        Self { radius }
    }
}

impl Solid for Sphere {
    fn validate(&self, place: &str) -> Result<()> {
        require_positive(place, "radius", self.radius)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        Ok(sphere::mass_properties(self.radius, density))
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        about.norm() + self.radius
    }
}
