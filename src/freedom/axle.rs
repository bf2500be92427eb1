//! A body that turns about an axis at rest: a wheel, a pendulum.

use super::{Scales, Turning, direction, nearest_turn};
use crate::effect::series::{Place, SeriesBody, SeriesLoad};
use crate::error::{Error, Result};
use crate::math::series::{Attitude, Tape};
use crate::math::{Matrix3, Quaternion, Vector3, quaternion};
use crate::state::{BodyMotion, BodyState, Load};
use crate::tolerance::VELOCITY_FITS_FREEDOM;

/// Coordinates `[θ, L about the axle]`.
///
/// ```text
/// q = exp(θ u) q₀,  r = x − p,  ω = (L_u/I_u) u,  dL_u/dt = u·(M + r × F)       lecture (32)
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axle {
    /// Direction of the axle, world axes.
    axis: Vector3,
    /// A point of the axle, world axes [m].
    point: Vector3,
    /// From that point to the centre of mass, body axes [m].
    arm_body: Vector3,
    start_orientation: Quaternion,
    inv_moment: f64,
}

impl Axle {
    pub(super) fn new(data: &super::Axle, motion: &BodyMotion, place: &str) -> Result<Self> {
        let axis_body = direction(place, "freedom.axle.axis_body", data.axis_body)?;
        if !data.point_body.iter().all(|x| x.is_finite()) {
            return Err(Error::value(place, "freedom.axle.point_body", "three finite numbers", data.point_body));
        }
        let axis = motion.rotation * axis_body;
        let arm_body = -Vector3::from(data.point_body);
        let point = motion.position - motion.rotation * arm_body;
        let w = &motion.angular_velocity;
        if w.cross(&axis).norm() > VELOCITY_FITS_FREEDOM * w.norm() {
            return Err(Error::value(place, "angular_velocity", "along its axle", w.as_slice()));
        }
        let slip = motion.velocity_at(&point).norm();
        if slip > VELOCITY_FITS_FREEDOM * (motion.velocity.norm() + w.norm() * arm_body.norm()) {
            let allowed = "that of a rotation about the axle; leave it out and give angular_velocity";
            return Err(Error::value(place, "velocity", allowed, motion.velocity.as_slice()));
        }
        let moment = axis_body.dot(&(super::about_point(motion, &arm_body) * axis_body));
        Ok(Self { axis, point, arm_body, start_orientation: motion.orientation, inv_moment: 1.0 / moment })
    }

    /// Direction of the axle, world axes.
    pub(super) fn axis(&self) -> Vector3 {
        self.axis
    }

    /// A point of the axle, world axes [m].
    pub(super) fn point(&self) -> Vector3 {
        self.point
    }

    /// From that point to the centre of mass, body axes [m].
    pub(super) fn arm_body(&self) -> Vector3 {
        self.arm_body
    }

    pub(super) fn turning(&self, at: usize) -> Turning {
        Turning::Angle { at, axis: self.axis, start: self.start_orientation }
    }

    #[expect(clippy::unused_self, reason = "every chart answers this")]
    pub(super) fn dimension(&self) -> usize {
        2
    }

    pub(super) fn encode(&self, state: &BodyState, y: &mut [f64]) {
        let r = state.position - self.point;
        let turned = quaternion::log(&(state.orientation * self.start_orientation.conjugate()));
        y[0] = nearest_turn(self.axis.dot(&turned), y[0]);
        y[1] = self.axis.dot(&(state.angular_momentum + r.cross(&state.linear_momentum)));
    }

    #[inline]
    pub(super) fn decode(&self, y: &[f64], motion: &mut BodyMotion) {
        motion.orientation = quaternion::from_axis_angle(&self.axis, y[0]) * self.start_orientation;
        motion.rotation = quaternion::to_matrix(&motion.orientation);
        motion.angular_velocity = self.inv_moment * y[1] * self.axis;
        let r = motion.rotation * self.arm_body;
        motion.position = self.point + r;
        motion.velocity = motion.angular_velocity.cross(&r);
    }

    #[inline]
    pub(super) fn rate(&self, y: &[f64], motion: &BodyMotion, load: &Load, dy: &mut [f64]) {
        dy[0] = self.inv_moment * y[1];
        dy[1] = self.torque(motion, load);
    }

    #[inline]
    pub(super) fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        dy[0] = self.inv_moment * y[1];
        dy[1] = 0.0;
    }

    pub(super) fn begin_series(&self, at: usize, motion: &BodyMotion, tape: &mut Tape) -> SeriesBody {
        let (angle, spin) = (tape.number(at), tape.number(at + 1));
        let rate = tape.scaled(self.inv_moment, spin);
        tape.integrate(angle, rate);
        let rotation = quaternion::to_matrix(&self.start_orientation);
        let angular_velocity = tape.along(&rotation.tr_mul(&self.axis), rate);
        SeriesBody {
            mass: motion.mass,
            inertia: motion.inertia_body,
            axes: Matrix3::identity(),
            attitude: Attitude::Angle(at, self.axis, rotation),
            angular_velocity,
            spin,
            momentum: None,
            place: Place::Arm(self.point, self.arm_body),
            seen: None,
        }
    }

    pub(super) fn end_series(&self, body: &mut SeriesBody, load: SeriesLoad, tape: &mut Tape) {
        if let Some(torque) = body.torque_about_pivot(load, tape) {
            let axis = tape.constant(quaternion::to_matrix(&self.start_orientation).tr_mul(&self.axis));
            let torque = tape.dot(axis, torque);
            tape.integrate(body.spin, torque);
        }
    }

    #[inline]
    pub(super) fn error_size(&self, y0: &[f64], y1: &[f64], e: &[f64], scales: &Scales) -> f64 {
        let least = 1.0 / (self.inv_moment * scales.time);
        e[0].abs().max(e[1].abs() / y0[1].abs().max(y1[1].abs()).max(least))
    }

    /// Torque about the axle [N·m].
    fn torque(&self, motion: &BodyMotion, load: &Load) -> f64 {
        self.axis.dot(&(load.torque + (motion.position - self.point).cross(&load.force)))
    }

    pub(super) fn reaction(&self, motion: &BodyMotion, load: &Load) -> Load {
        let alpha = self.inv_moment * self.torque(motion, load) * self.axis;
        let r = motion.position - self.point;
        let a = alpha.cross(&r) + motion.angular_velocity.cross(&motion.velocity);
        super::missing_load(motion, load, &a, &alpha)
    }
}
