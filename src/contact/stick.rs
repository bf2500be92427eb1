//! Sticking to a fixed body: all motion ends, and the kinetic energy is lost.

use super::Answer;
use crate::math::Vector3;
use crate::state::BodyMotion;

/// Brings a body to rest where it is.
pub fn stick(motion: &mut BodyMotion) -> Answer {
    let answer = Answer { impulse: -motion.mass * motion.velocity, energy_lost: motion.kinetic_energy() };
    motion.velocity = Vector3::zeros();
    motion.angular_velocity = Vector3::zeros();
    answer
}
