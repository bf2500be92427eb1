//! Sphere.
//!
//! ```text
//! m = ⁴⁄₃ π ρ r³      I = ⅖ m r²
//! ```

use std::f64::consts::PI;

use crate::mass::MassProperties;
use crate::math::Vector3;

/// Mass properties of a sphere about its centre, from radius [m] and density [kg/m³].
pub fn mass_properties(radius: f64, density: f64) -> MassProperties {
    let mass = density * (4.0 / 3.0 * PI * radius * radius * radius);
    MassProperties::diagonal(mass, Vector3::zeros(), Vector3::repeat(0.4 * mass * radius * radius))
}
