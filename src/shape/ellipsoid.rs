//! An ellipsoid: origin in its centre, axes along x, y and z.

use super::{Solid, require_all_positive};
use crate::error::Result;
use crate::mass::{MassProperties, ellipsoid};
use crate::math::Vector3;

/// The ellipsoid `(x/a)² + (y/b)² + (z/c)² ≤ 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ellipsoid {
    /// Its semi-axes `a, b, c` along x, y and z [m].
    pub semi_axes: [f64; 3],
}

impl Ellipsoid {
    /// An ellipsoid from its semi-axes along x, y and z [m].
    pub fn new(semi_axes: impl Into<[f64; 3]>) -> Self {
        Self { semi_axes: semi_axes.into() }
    }
}

impl Solid for Ellipsoid {
    fn validate(&self, place: &str) -> Result<()> {
        require_all_positive(place, "semi_axes", self.semi_axes)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        Ok(ellipsoid::mass_properties(self.semi_axes, density))
    }

    /// The distance of the centre plus the longest semi-axis: exact about the centre, elsewhere more
    /// than the farthest point's distance (a root of a polynomial of degree six).
    fn bounding_radius(&self, about: &Vector3) -> f64 {
        about.norm() + Vector3::from(self.semi_axes).max()
    }
}
