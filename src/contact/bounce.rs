//! A bounce: the frictionless impulse of one point.
//!
//! ```text
//! r = p − x,  u = v + ω × r,  u_n = n·u
//! j = −(1 + e) u_n / (1/m + n·[(I⁻¹ (r × n)) × r])
//! v ← v + j n/m        ω ← ω + I⁻¹ (r × j n)
//! ```
//!
//! The point's normal velocity becomes `−e u_n` (Newton's law of restitution). With e = 1 the energy
//! stays; with e < 1 the lost part is `½ (1 − e²) u_n²` times the point's effective mass.

use super::Answer;
use crate::math::{Matrix3, Vector3};
use crate::state::BodyMotion;

/// Lets a body rebound at the world point `p` [m] from a fixed plane with this unit normal, with
/// restitution `e`; `inv_inertia_body` is I⁻¹ in body axes.
pub fn bounce(motion: &mut BodyMotion, inv_inertia_body: &Matrix3, p: &Vector3, normal: &Vector3, e: f64) -> Answer {
    let before = motion.kinetic_energy();
    let r = p - motion.position;
    let inv_inertia = motion.rotation * inv_inertia_body * motion.rotation.transpose();
    let turn = inv_inertia * r.cross(normal);
    let inv_effective_mass = 1.0 / motion.mass + normal.dot(&turn.cross(&r));

    let approach = normal.dot(&motion.velocity_at(p));
    let j = -(1.0 + e) * approach / inv_effective_mass;
    motion.velocity += j / motion.mass * normal;
    motion.angular_velocity += j * turn;
    Answer { impulse: j * normal, energy_lost: before - motion.kinetic_energy() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rod() -> BodyMotion {
        let mut motion = BodyMotion::at_rest(2.0, Matrix3::from_diagonal(&Vector3::new(0.3, 0.5, 0.7)));
        motion.velocity = Vector3::new(0.3, -0.2, -1.5);
        motion.angular_velocity = Vector3::new(0.4, 1.0, -0.5);
        motion
    }

    #[test]
    fn the_point_rebounds_with_e_times_its_approach() {
        let (p, n) = (Vector3::new(0.4, -0.3, -0.2), Vector3::z());
        for e in [0.0, 0.5, 1.0] {
            let mut motion = rod();
            let inverse = Matrix3::from_diagonal(&Vector3::new(1.0 / 0.3, 1.0 / 0.5, 1.0 / 0.7));
            let (u, energy) = (n.dot(&motion.velocity_at(&p)), motion.kinetic_energy());
            let answer = bounce(&mut motion, &inverse, &p, &n, e);
            assert!((n.dot(&motion.velocity_at(&p)) + e * u).abs() < 64.0 * f64::EPSILON * u.abs());
            // ½ (1 − e²) u² m_eff, with j = −(1 + e) u m_eff
            let lost = 0.5 * (1.0 - e) * -u * answer.impulse.z;
            assert!((answer.energy_lost - lost).abs() < 64.0 * f64::EPSILON * energy);
            // the change of the body's momentum is the impulse
            let change = motion.mass * (motion.velocity - rod().velocity);
            assert!((change - answer.impulse).norm() < 64.0 * f64::EPSILON * answer.impulse.norm());
        }
    }
}
