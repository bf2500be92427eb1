//! Cuboid.
//!
//! ```text
//! m = 8 ρ a b c      I₁ = m (b² + c²)/3, and so on round      half extents a, b, c
//! ```

use crate::mass::MassProperties;
use crate::math::Vector3;

/// Mass properties of a cuboid about its centre, from half extents [m] and density [kg/m³].
pub fn mass_properties(half_extents: [f64; 3], density: f64) -> MassProperties {
    let [a, b, c] = half_extents;
    let mass = density * (8.0 * a * b * c);
    let third = mass / 3.0;
    let moments = Vector3::new(third * (b * b + c * c), third * (a * a + c * c), third * (a * a + b * b));
    MassProperties::diagonal(mass, Vector3::zeros(), moments)
}
