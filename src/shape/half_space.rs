//! A half space: a floor, a wall, a slope.

use super::{Solid, require_finite};
use crate::error::{Error, Result};
use crate::mass::MassProperties;
use crate::math::Vector3;

/// All points with `normal · x ≤ offset`: solid on one side of a plane, for ever.
///
/// The normal points out of the solid. It need not have unit length; the condition stands as
/// written, so `normal = (0, 0, 2), offset = 1` has its surface at `z = ½`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HalfSpace {
    /// Normal of the surface, out of the solid [-]; not zero.
    pub normal: [f64; 3],
    /// Value of `normal · x` on the surface [m, for a normal of unit length].
    pub offset: f64,
}

impl HalfSpace {
    /// The points with `normal · x ≤ offset`.
    pub fn new(normal: impl Into<[f64; 3]>, offset: f64) -> Self {
        Self { normal: normal.into(), offset }
    }

    /// The unit normal `n` and the distance `d` [m] of the surface `n · x = d`.
    pub fn plane(&self) -> (Vector3, f64) {
        // largest entry 1 first, lest the squares overflow
        let normal = Vector3::from(self.normal);
        let largest = normal.amax();
        let scaled = normal / largest;
        let length = scaled.norm();
        (scaled / length, self.offset / largest / length)
    }
}

impl Solid for HalfSpace {
    fn validate(&self, place: &str) -> Result<()> {
        require_finite(place, "normal", self.normal)?;
        if !Vector3::from(self.normal).amax().is_normal() {
            return Err(Error::value(place, "normal", "a vector with a direction", self.normal));
        }
        if !self.offset.is_finite() {
            return Err(Error::value(place, "offset", "finite", self.offset));
        }
        Ok(())
    }

    fn matter(&self, place: &str, _density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        Err(Error::refused(place, "is infinite and has no mass; its body must be fixed"))
    }

    fn bounding_radius(&self, _about: &Vector3) -> f64 {
        f64::INFINITY
    }
}
