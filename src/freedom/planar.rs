//! A body that moves in a plane: the lecture's hovercraft (§6).

use super::spin::{put, vector};
use super::{Scales, Turning, direction, nearest_turn};
use crate::effect::series::{Place, SeriesBody, SeriesLoad, add};
use crate::error::{Error, Result};
use crate::math::series::{Attitude, Tape};
use crate::math::{Matrix3, Quaternion, Vector3, quaternion};
use crate::state::{BodyMotion, BodyState, Load};
use crate::tolerance::VELOCITY_FITS_FREEDOM;

/// Coordinates `[u, w, θ, P_u, P_w, L_n]`: place in the plane, angle about its normal, and momenta.
///
/// ```text
/// x = x₀ + u e₁ + w e₂,  q = exp(θ n) q₀,  ω = (L_n/I_n) n,  I_n = n·I n
/// ```
///
/// The normal stays where it is in the body, so `I_n` is a constant (32). Where it is no principal
/// axis, or forces leave the plane, the constraint holds the body with a reaction.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Planar {
    e1: Vector3,
    e2: Vector3,
    normal: Vector3,
    start: Vector3,
    start_orientation: Quaternion,
    inv_mass: f64,
    inv_moment: f64,
}

impl Planar {
    pub(super) fn new(data: &super::Planar, motion: &BodyMotion, place: &str) -> Result<Self> {
        let normal = direction(place, "freedom.planar.normal", data.normal)?;
        let (v, w) = (&motion.velocity, &motion.angular_velocity);
        if v.dot(&normal).abs() > VELOCITY_FITS_FREEDOM * v.norm() {
            return Err(Error::value(place, "velocity", "in the plane of its freedom", v.as_slice()));
        }
        if w.cross(&normal).norm() > VELOCITY_FITS_FREEDOM * w.norm() {
            return Err(Error::value(place, "angular_velocity", "along the normal of its plane", w.as_slice()));
        }

        // the first axis lies close to the world's x, or y where x is close to the normal
        let near = if normal.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
        let e1 = (near - normal * normal.dot(&near)).normalize();
        let e2 = normal.cross(&e1);

        let n_body = motion.rotation.tr_mul(&normal);
        Ok(Self {
            e1,
            e2,
            normal,
            start: motion.position - e1 * e1.dot(&motion.position) - e2 * e2.dot(&motion.position),
            start_orientation: motion.orientation,
            inv_mass: 1.0 / motion.mass,
            inv_moment: 1.0 / n_body.dot(&(motion.inertia_body * n_body)),
        })
    }

    pub(super) fn place(&self, at: usize) -> super::Place {
        super::Place::Plane { at, start: self.start, axes: [self.e1, self.e2] }
    }

    pub(super) fn turning(&self, at: usize) -> Turning {
        Turning::Angle { at: at + 2, axis: self.normal, start: self.start_orientation }
    }

    /// Two shifts and a turn.
    pub(super) fn freedoms(&self) -> [(Vector3, Vector3); 3] {
        let none = Vector3::zeros();
        [(self.e1, none), (self.e2, none), (none, self.normal)]
    }

    #[expect(clippy::unused_self, reason = "every chart answers this")]
    pub(super) fn dimension(&self) -> usize {
        6
    }

    pub(super) fn encode(&self, state: &BodyState, y: &mut [f64]) {
        let turned = quaternion::log(&(state.orientation * self.start_orientation.conjugate()));
        let angle = nearest_turn(self.normal.dot(&turned), y[2]);
        put(y, &Vector3::new(self.e1.dot(&state.position), self.e2.dot(&state.position), angle));
        let p = &state.linear_momentum;
        put(&mut y[3..], &Vector3::new(self.e1.dot(p), self.e2.dot(p), self.normal.dot(&state.angular_momentum)));
    }

    #[inline]
    pub(super) fn decode(&self, y: &[f64], motion: &mut BodyMotion) {
        let (place, momentum) = (vector(y), vector(&y[3..]));
        motion.position = self.start + place.x * self.e1 + place.y * self.e2;
        motion.orientation = quaternion::from_axis_angle(&self.normal, place.z) * self.start_orientation;
        motion.rotation = quaternion::to_matrix(&motion.orientation);
        motion.velocity = self.inv_mass * (momentum.x * self.e1 + momentum.y * self.e2);
        motion.angular_velocity = self.inv_moment * momentum.z * self.normal;
    }

    #[inline]
    pub(super) fn rate(&self, y: &[f64], _motion: &BodyMotion, load: &Load, dy: &mut [f64]) {
        self.rate_unloaded(y, dy);
        let f = &load.force;
        put(&mut dy[3..], &Vector3::new(self.e1.dot(f), self.e2.dot(f), self.normal.dot(&load.torque)));
    }

    #[inline]
    pub(super) fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        put(dy, &Vector3::new(self.inv_mass * y[3], self.inv_mass * y[4], self.inv_moment * y[5]));
        dy[3..6].fill(0.0);
    }

    pub(super) fn begin_series(&self, at: usize, motion: &BodyMotion, tape: &mut Tape) -> SeriesBody {
        let (place, angle) = (tape.numbers(at, 2), tape.number(at + 2));
        let (momentum, spin) = (tape.numbers(at + 3, 2), tape.number(at + 5));
        let velocity = tape.scaled(self.inv_mass, momentum);
        tape.integrate(place, velocity);
        let rate = tape.scaled(self.inv_moment, spin);
        tape.integrate(angle, rate);

        // the same in space
        let plane = Matrix3::from_columns(&[self.e1, self.e2, Vector3::zeros()]);
        let [place, velocity] = [place, velocity].map(|v| tape.linear(v, plane));
        let start = tape.constant(self.start);
        let position = tape.sum(place, 1.0, start);
        let rotation = quaternion::to_matrix(&self.start_orientation);
        let angular_velocity = tape.along(&rotation.tr_mul(&self.normal), rate);
        SeriesBody {
            mass: motion.mass,
            inertia: motion.inertia_body,
            axes: Matrix3::identity(),
            attitude: Attitude::Angle(at + 2, self.normal, rotation),
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
            let plane = Matrix3::from_columns(&[self.e1, self.e2, Vector3::zeros()]).transpose();
            let force = tape.linear(force, plane);
            tape.integrate(momentum, force);
        }
        let normal = tape.constant(self.normal);
        let normal_own = tape.constant(quaternion::to_matrix(&self.start_orientation).tr_mul(&self.normal));
        let parts = [(load.torque, normal), (load.torque_own, normal_own)];
        let mut torque = None;
        for (part, normal) in parts.into_iter().filter_map(|(part, normal)| Some((part?, normal))) {
            let along = tape.dot(normal, part);
            add(tape, &mut torque, along);
        }
        if let Some(torque) = torque {
            tape.integrate(body.spin, torque);
        }
    }

    #[inline]
    pub(super) fn error_size(&self, y0: &[f64], y1: &[f64], e: &[f64], scales: &Scales) -> f64 {
        let length = |v: &[f64]| (v[0] * v[0] + v[1] * v[1]).sqrt();
        let least = scales.length / (self.inv_mass * scales.time);
        let momentum = length(&e[3..]) / length(&y0[3..]).max(length(&y1[3..])).max(least);
        let least = 1.0 / (self.inv_moment * scales.time);
        let spin = e[5].abs() / y0[5].abs().max(y1[5].abs()).max(least);
        (length(e) / scales.length).max(momentum).max(e[2].abs()).max(spin)
    }

    pub(super) fn reaction(&self, motion: &BodyMotion, load: &Load) -> Load {
        let a = self.inv_mass * (load.force - self.normal * self.normal.dot(&load.force));
        let alpha = self.inv_moment * self.normal.dot(&load.torque) * self.normal;
        super::missing_load(motion, load, &a, &alpha)
    }
}
