//! A free body: Y = (x, P, q, L), lecture (24).

use super::Scales;
use super::spin::{Form, RotationSplit, Spin, put, vector};
use crate::effect::series::{Place, SeriesBody, SeriesLoad};
use crate::math::Vector3;
use crate::math::series::Tape;
use crate::math::sum::two_sum;
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
        Self { spin: Spin::new(form, motion.inertia_body), inv_mass: 1.0 / motion.mass }
    }

    /// Its rotation.
    pub(crate) fn spin(&self) -> &Spin {
        &self.spin
    }

    /// The inverses of its mass [1/kg] and of its principal moments [1/(kg·m²)], and their [gaps](Spin::gaps).
    pub(crate) fn inverses(&self) -> (f64, &Vector3, &Vector3) {
        (self.inv_mass, self.spin.inv_moments(), self.spin.gaps())
    }

    #[inline]
    pub(super) fn flow(&self, y: &mut [f64], rest: &mut [f64], h: f64, split: RotationSplit) {
        for i in 0..3 {
            (y[i], rest[i]) = two_sum(y[i], h * self.inv_mass * y[3 + i] + rest[i]);
        }
        self.spin.flow(&mut y[6..], &mut rest[6..], h, split);
    }

    pub(super) fn dimension(&self) -> usize {
        6 + self.spin.dimension()
    }

    pub(super) fn encode(&self, state: &BodyState, y: &mut [f64]) {
        put(y, &state.position);
        put(&mut y[3..], &state.linear_momentum);
        self.spin.encode(&state.orientation, &state.angular_momentum, &mut y[6..]);
    }

    #[inline(always)]
    pub(super) fn decode(&self, y: &[f64], motion: &mut BodyMotion) {
        motion.position = vector(y);
        motion.velocity = self.inv_mass * vector(&y[3..]);
        (motion.orientation, motion.rotation, motion.angular_velocity) = self.spin.decode(&y[6..]);
    }

    #[inline(always)]
    pub(super) fn rate(&self, y: &[f64], motion: &BodyMotion, load: &Load, dy: &mut [f64]) {
        put(dy, &motion.velocity);
        put(&mut dy[3..], &load.force);
        self.spin.rate(&y[6..], &motion.rotation, &motion.angular_velocity, &load.torque, &mut dy[6..]);
    }

    #[inline(always)]
    pub(super) fn rate_constant(&self, y: &[f64], load: &Load, dy: &mut [f64]) {
        self.rate_unloaded(y, dy);
        put(&mut dy[3..], &load.force);
        if load.torque != Vector3::zeros() {
            self.spin.rate_constant(&y[6..], &Vector3::zeros(), load, &mut dy[6..]);
        }
    }

    #[inline(always)]
    pub(super) fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        put(dy, &(self.inv_mass * vector(&y[3..])));
        dy[3..6].fill(0.0);
        self.spin.rate_unloaded(&y[6..], &mut dy[6..]);
    }

    pub(super) fn begin_series(&self, at: usize, motion: &BodyMotion, tape: &mut Tape) -> SeriesBody {
        let position = tape.numbers(at, 3);
        let momentum = tape.numbers(at + 3, 3);
        let velocity = tape.scaled(self.inv_mass, momentum);
        tape.integrate(position, velocity);
        let (attitude, spin, angular_velocity, axes) = self.spin.begin_series(at + 6, tape);
        SeriesBody {
            mass: motion.mass,
            inertia: axes.transpose() * motion.inertia_body * axes,
            axes,
            attitude,
            angular_velocity,
            spin,
            momentum: Some(momentum),
            place: Place::Moving(position, velocity),
            seen: None,
        }
    }

    pub(super) fn end_series(&self, body: &mut SeriesBody, load: SeriesLoad, tape: &mut Tape) {
        let force = body.sum_world(load.force, load.force_own, tape);
        if let (Some(momentum), Some(force)) = (body.momentum, force) {
            tape.integrate(momentum, force);
        }
        let torque = body.sum_own(load.torque, load.torque_own, tape);
        self.spin.end_series(body.spin, torque, tape);
    }

    #[inline]
    pub(super) fn error_size(&self, y0: &[f64], y1: &[f64], e: &[f64], scales: &Scales) -> f64 {
        let place = vector(e).norm() / scales.length;
        let least = scales.length / (self.inv_mass * scales.time);
        let momentum = vector(&e[3..]).norm() / vector(&y0[3..]).norm().max(vector(&y1[3..]).norm()).max(least);
        place.max(momentum).max(self.spin.error_size(&y0[6..], &y1[6..], &e[6..], scales))
    }
}
