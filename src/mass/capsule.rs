//! Capsule along z: a cylinder with a half sphere on each end.
//!
//! ```text
//! m = m_c + m_s      m_c = 2 π ρ r² h      m_s = ⁴⁄₃ π ρ r³      h half the cylinder's height
//! I₃ = ½ m_c r² + ⅖ m_s r²
//! I₁ = I₂ = m_c (r²/4 + h²/3) + m_s (⅖ r² + ¾ h r + h²)
//! ```
//!
//! The last bracket is not the sphere's moment moved by `h`: the centre of a half sphere lies `⅜ r`
//! beyond its flat side, and both halves lie outward of it.

use crate::mass::{MassProperties, cylinder, sphere};
use crate::math::Vector3;

/// Mass properties of a capsule along z about its centre, from radius and half height of the
/// cylinder [m] and density [kg/m³].
pub fn mass_properties(radius: f64, half_height: f64, density: f64) -> MassProperties {
    let (r, h) = (radius, half_height);
    let (middle, ends) = (cylinder::mass_properties(r, h, density), sphere::mass_properties(r, density));
    let along = middle.inertia[(2, 2)] + ends.inertia[(2, 2)];
    let across = middle.inertia[(0, 0)] + ends.inertia[(0, 0)] + ends.mass * (0.75 * h * r + h * h);
    MassProperties::diagonal(middle.mass + ends.mass, Vector3::zeros(), Vector3::new(across, across, along))
}
