//! A body that moves in a plane: the lecture's hovercraft (§6).

use super::spin::{put, vector};
use super::{Scales, direction};
use crate::error::{Error, Result};
use crate::math::{Quaternion, Vector3, quaternion};
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

    #[expect(clippy::unused_self, reason = "every chart answers this")]
    pub(super) fn dimension(&self) -> usize {
        6
    }

    pub(super) fn encode(&self, state: &BodyState, y: &mut [f64]) {
        let turned = quaternion::log(&(state.orientation * self.start_orientation.conjugate()));
        put(y, &Vector3::new(self.e1.dot(&state.position), self.e2.dot(&state.position), self.normal.dot(&turned)));
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
