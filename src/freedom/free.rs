//! A free body: Y = (x, P, q, L), lecture (24).

use super::spin::{Form, Spin, put, vector};
use crate::state::{BodyMotion, BodyState, Load};

/// Coordinates `[x, P, q or R, L]`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Free {
    spin: Spin,
    inv_mass: f64,
}

impl Free {
    pub(super) fn new(form: Form, motion: &BodyMotion) -> Self {
        Self { spin: Spin { form, inv_inertia: super::inverse(&motion.inertia_body) }, inv_mass: 1.0 / motion.mass }
    }

    pub(super) fn dimension(&self) -> usize {
        6 + self.spin.dimension()
    }

    pub(super) fn encode(&self, state: &BodyState, y: &mut [f64]) {
        put(y, &state.position);
        put(&mut y[3..], &state.linear_momentum);
        self.spin.encode(&state.orientation, &state.angular_momentum, &mut y[6..]);
    }

    #[inline]
    pub(super) fn decode(&self, y: &[f64], motion: &mut BodyMotion) {
        motion.position = vector(y);
        motion.velocity = self.inv_mass * vector(&y[3..]);
        (motion.orientation, motion.rotation, motion.angular_velocity) = self.spin.decode(&y[6..]);
    }

    #[inline]
    pub(super) fn rate(&self, y: &[f64], motion: &BodyMotion, load: &Load, dy: &mut [f64]) {
        put(dy, &motion.velocity);
        put(&mut dy[3..], &load.force);
        self.spin.rate(&y[6..], &motion.rotation, &motion.angular_velocity, &load.torque, &mut dy[6..]);
    }

    #[inline]
    pub(super) fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        put(dy, &(self.inv_mass * vector(&y[3..])));
        dy[3..6].fill(0.0);
        self.spin.rate_unloaded(&y[6..], &mut dy[6..]);
    }

    #[inline]
    pub(super) fn project(&self, y: &mut [f64]) -> f64 {
        self.spin.project(&mut y[6..])
    }

    pub(super) fn orientation_error(&self, y: &[f64]) -> f64 {
        self.spin.orientation_error(&y[6..])
    }
}
