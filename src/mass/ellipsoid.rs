//! Ellipsoid.
//!
//! ```text
//! m = ⁴⁄₃ π ρ a b c      I₁ = m (b² + c²)/5, and so on round      semi-axes a, b, c
//! ```

use std::f64::consts::PI;

use crate::mass::MassProperties;
use crate::math::Vector3;

/// Mass properties of an ellipsoid about its centre, from semi-axes [m] and density [kg/m³].
pub fn mass_properties(semi_axes: [f64; 3], density: f64) -> MassProperties {
    let [a, b, c] = semi_axes;
    let mass = density * (4.0 / 3.0 * PI * a * b * c);
    let fifth = mass / 5.0;
    let moments = Vector3::new(fifth * (b * b + c * c), fifth * (a * a + c * c), fifth * (a * a + b * b));
    MassProperties::diagonal(mass, Vector3::zeros(), moments)
}
