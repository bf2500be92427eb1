//! A box: origin in its centre, edges along the axes.

use super::{Solid, require_all_positive};
use crate::error::Result;
use crate::mass::{MassProperties, cuboid};
use crate::math::Vector3;

/// A box with its centre in the origin and its edges along x, y and z.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cuboid {
    /// Half of each edge's length [m].
    pub half_extents: [f64; 3],
}

impl Cuboid {
    /// A box from half of each edge's length [m].
    pub fn new(half_extents: impl Into<[f64; 3]>) -> Self {
        Self { half_extents: half_extents.into() }
    }
}

impl Solid for Cuboid {
    fn validate(&self, place: &str) -> Result<()> {
        require_all_positive(place, "half_extents", self.half_extents)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        Ok(cuboid::mass_properties(self.half_extents, density))
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        (about.abs() + Vector3::from(self.half_extents)).norm()
    }

    /// The corners: x runs fastest, then y, then z, each from its negative end.
    fn vertices(&self) -> Option<Vec<Vector3>> {
        let [a, b, c] = self.half_extents;
        let corner = |k: u8| {
            let side = |bit: u8, h: f64| if k & bit == 0 { -h } else { h };
            Vector3::new(side(1, a), side(2, b), side(4, c))
        };
        Some((0..8).map(corner).collect())
    }
}
