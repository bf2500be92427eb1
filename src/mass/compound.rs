//! Mass properties of several parts taken as one body.

use crate::mass::MassProperties;
use crate::mass::properties::point_inertia;
use crate::math::{Matrix3, Vector3};

impl MassProperties {
    /// The parts, given in common axes, as one rigid body.
    ///
    /// ```text
    /// m = Σ mᵢ      c = Σ mᵢ cᵢ / m      I = Σ [Iᵢ + mᵢ (|dᵢ|² 1 − dᵢ dᵢᵀ)]      dᵢ = cᵢ − c
    /// ```
    ///
    /// Centres are summed relative to the first, so that a body far from the origin loses nothing; a
    /// rounding error of `c` enters `I` by its square only. Of no parts: nothing, with mass 0.
    pub fn combined(parts: &[Self]) -> Self {
        let mass: f64 = parts.iter().map(|part| part.mass).sum();
        let reference = parts.first().map_or_else(Vector3::zeros, |part| part.center_of_mass);
        if mass == 0.0 {
            return Self { mass, center_of_mass: reference, inertia: Matrix3::zeros() };
        }

        let shift: Vector3 = parts.iter().map(|part| part.mass * (part.center_of_mass - reference)).sum();
        let center_of_mass = reference + shift / mass;
        let inertia =
            parts.iter().map(|part| part.inertia + point_inertia(part.mass, &(part.center_of_mass - center_of_mass)));
        Self { mass, center_of_mass, inertia: inertia.sum() }
    }
}
