//! Circular cone along z, its origin half way up and its apex at `+h`.
//!
//! ```text
//! m = ⅔ π ρ r² h      c = (0, 0, −h/2)      I₃ = ³⁄₁₀ m r²      I₁ = I₂ = ³⁄₂₀ m (r² + h²)
//! ```
//!
//! with `h` half the height: the centre of mass lies a quarter of the height above the base.

use std::f64::consts::PI;

use crate::mass::MassProperties;
use crate::math::Vector3;

/// Mass properties of a cone along z about its centre of mass, from radius of the base and half
/// height [m] and density [kg/m³].
pub fn mass_properties(radius: f64, half_height: f64, density: f64) -> MassProperties {
    let (r, h) = (radius, half_height);
    let mass = density * (2.0 / 3.0 * PI * r * r * h);
    let across = 0.15 * mass * (r * r + h * h);
    MassProperties::diagonal(mass, Vector3::new(0.0, 0.0, -0.5 * h), Vector3::new(across, across, 0.3 * mass * r * r))
}
