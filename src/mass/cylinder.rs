//! Circular cylinder along z.
//!
//! ```text
//! m = 2 π ρ r² h      I₃ = ½ m r²      I₁ = I₂ = m (r²/4 + h²/3)      h half the height
//! ```

use std::f64::consts::PI;

use crate::mass::MassProperties;
use crate::math::Vector3;

/// Mass properties of a cylinder along z about its centre, from radius and half height [m] and
/// density [kg/m³].
pub fn mass_properties(radius: f64, half_height: f64, density: f64) -> MassProperties {
    let (r, h) = (radius, half_height);
    let mass = density * (2.0 * PI * r * r * h);
    let across = mass * (r * r / 4.0 + h * h / 3.0);
    MassProperties::diagonal(mass, Vector3::zeros(), Vector3::new(across, across, 0.5 * mass * r * r))
}
