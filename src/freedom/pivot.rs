//! A body that turns about a point at rest: a top.

use super::Scales;
use super::spin::{Form, Spin};
use crate::effect::series::{Place, SeriesBody, SeriesLoad};
use crate::error::{Error, Result};
use crate::math::series::Tape;
use crate::math::{Matrix3, Vector3};
use crate::state::{BodyMotion, BodyState, Load};
use crate::tolerance::VELOCITY_FITS_FREEDOM;

/// Coordinates `[q or R, L about the pivot]`.
///
/// ```text
/// r = −R p_body,  x = pivot + r,  v = ω × r,  L_p = I_p ω,  dL_p/dt = M + r × F
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pivot {
    spin: Spin,
    /// The point that rests, world axes [m].
    point: Vector3,
    /// From the pivot to the centre of mass, body axes [m].
    arm_body: Vector3,
    /// The same in the axes that the orientation leads from [m].
    arm_own: Vector3,
}

impl Pivot {
    pub(super) fn new(data: &super::Pivot, form: Form, motion: &BodyMotion, place: &str) -> Result<Self> {
        if !data.point_body.iter().all(|x| x.is_finite()) {
            return Err(Error::value(place, "freedom.pivot.point_body", "three finite numbers", data.point_body));
        }
        let arm_body = -Vector3::from(data.point_body);
        let pivot = motion.position - motion.rotation * arm_body;
        let slip = motion.velocity_at(&pivot).norm();
        if slip > VELOCITY_FITS_FREEDOM * (motion.velocity.norm() + motion.angular_velocity.norm() * arm_body.norm()) {
            let allowed = "that of a rotation about the pivot; leave it out and give angular_velocity";
            return Err(Error::value(place, "velocity", allowed, motion.velocity.as_slice()));
        }
        let inertia = super::about_point(motion, &arm_body);
        let spin = Spin::new(form, inertia);
        let arm_own = spin.own_axes(&arm_body);
        Ok(Self { spin, point: pivot, arm_body, arm_own })
    }

    /// Inertia about the pivot, body axes [kg·m²].
    pub(crate) fn inertia(&self, motion: &BodyMotion) -> Matrix3 {
        super::about_point(motion, &self.arm_body)
    }

    /// The point that rests, world axes [m].
    pub(super) fn point(&self) -> Vector3 {
        self.point
    }

    /// From the pivot to the centre of mass, body axes [m].
    pub(super) fn arm_body(&self) -> Vector3 {
        self.arm_body
    }

    /// Its rotation.
    pub(crate) fn spin(&self) -> &Spin {
        &self.spin
    }

    pub(super) fn dimension(&self) -> usize {
        self.spin.dimension()
    }

    pub(super) fn encode(&self, state: &BodyState, y: &mut [f64]) {
        let r = state.position - self.point;
        let momentum = state.angular_momentum + r.cross(&state.linear_momentum);
        self.spin.encode(&state.orientation, &momentum, y);
    }

    #[inline(always)]
    pub(super) fn decode(&self, y: &[f64], motion: &mut BodyMotion) {
        (motion.orientation, motion.rotation, motion.angular_velocity) = self.spin.decode(y);
        let r = motion.rotation * self.arm_body;
        motion.position = self.point + r;
        motion.velocity = motion.angular_velocity.cross(&r);
    }

    #[inline(always)]
    pub(super) fn rate(&self, y: &[f64], motion: &BodyMotion, load: &Load, dy: &mut [f64]) {
        let torque = load.torque + (motion.rotation * self.arm_body).cross(&load.force);
        self.spin.rate(y, &motion.rotation, &motion.angular_velocity, &torque, dy);
    }

    #[inline(always)]
    pub(super) fn rate_constant(&self, y: &[f64], load: &Load, dy: &mut [f64]) {
        self.spin.rate_constant(y, &self.arm_own, load, dy);
    }

    #[inline(always)]
    pub(super) fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        self.spin.rate_unloaded(y, dy);
    }

    pub(super) fn begin_series(&self, at: usize, motion: &BodyMotion, tape: &mut Tape) -> SeriesBody {
        let (attitude, spin, angular_velocity, axes) = self.spin.begin_series(at, tape);
        SeriesBody {
            mass: motion.mass,
            inertia: axes.transpose() * motion.inertia_body * axes,
            axes,
            attitude,
            angular_velocity,
            spin,
            momentum: None,
            place: Place::Arm(self.point, axes.tr_mul(&self.arm_body)),
            seen: None,
        }
    }

    pub(super) fn end_series(&self, body: &mut SeriesBody, load: SeriesLoad, tape: &mut Tape) {
        let torque = body.torque_about_pivot(load, tape);
        self.spin.end_series(body.spin, torque, tape);
    }

    #[inline]
    pub(super) fn error_size(&self, y0: &[f64], y1: &[f64], e: &[f64], scales: &Scales) -> f64 {
        self.spin.error_size(y0, y1, e, scales)
    }

    pub(super) fn reaction(&self, motion: &BodyMotion, load: &Load) -> Load {
        // Euler's equations about the pivot give the angular acceleration, the arm the acceleration
        let r = motion.rotation * self.arm_body;
        let w = motion.angular_velocity_body();
        let inertia = super::about_point(motion, &self.arm_body);
        let torque = motion.rotation.tr_mul(&(load.torque + r.cross(&load.force)));
        let alpha = motion.rotation * self.spin.over_inertia(&(torque - w.cross(&(inertia * w))));
        let a = alpha.cross(&r) + motion.angular_velocity.cross(&motion.velocity);
        super::missing_load(motion, load, &a, &alpha)
    }
}
