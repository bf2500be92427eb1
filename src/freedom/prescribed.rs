//! A motion that nothing disturbs: a turntable, a conveyor, a bat.
//!
//! ```text
//! φ(t) = ∫₀ᵗ f dt′        c(t) = c(0) + φ v        R(t) = exp(φ [ω]) R(0)
//! ```
//!
//! The body point c moves with the velocity f v, the body turns about it with f ω; the factor f is constant between
//! the times of its schedule. Whatever it hits takes the blow, the body does not: it has no mass to speak of, and
//! the work that it does is brought in from outside.

use crate::effect::Schedule;
use crate::error::{Error, Result};
use crate::math::sum::Time;
use crate::math::{Vector3, quaternion};
use crate::shape::Shape;
use crate::state::BodyMotion;

/// Constant velocities times a factor of time.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Prescribed {
    /// Velocity v of the body point `center`, world axes [m/s].
    #[cfg_attr(feature = "serde", serde(default))]
    pub velocity: [f64; 3],
    /// Angular velocity ω, world axes [rad/s].
    #[cfg_attr(feature = "serde", serde(default))]
    pub angular_velocity: [f64; 3],
    /// The point c that the body turns about, shape axes [m]: its origin, unless told otherwise.
    #[cfg_attr(feature = "serde", serde(default))]
    pub center: [f64; 3],
    /// Pairs (time [s], factor f): 0 before the first, held after the last; 1 always, if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub schedule: Option<Schedule>,
}

impl Prescribed {
    /// Motion with this velocity [m/s].
    pub fn moving(velocity: impl Into<[f64; 3]>) -> Self {
        Self { velocity: velocity.into(), ..Self::default() }
    }

    /// Turning about the shape's origin with this angular velocity [rad/s].
    pub fn turning(angular_velocity: impl Into<[f64; 3]>) -> Self {
        Self { angular_velocity: angular_velocity.into(), ..Self::default() }
    }

    /// Turning about this point instead, shape axes [m].
    #[must_use]
    pub fn about(mut self, center: impl Into<[f64; 3]>) -> Self {
        self.center = center.into();
        self
    }

    /// With this factor: pairs (time [s], factor).
    #[must_use]
    pub fn schedule(mut self, schedule: impl Into<Schedule>) -> Self {
        self.schedule = Some(schedule.into());
        self
    }

    /// Refuses values that mean nothing.
    pub(crate) fn validate(&self, place: &str, shape: Option<&Shape>) -> Result<()> {
        let fields = [
            ("motion.velocity", self.velocity),
            ("motion.angular_velocity", self.angular_velocity),
            ("motion.center", self.center),
        ];
        for (field, value) in fields {
            if !value.iter().all(|x| x.is_finite()) {
                return Err(Error::value(place, field, "three finite numbers", value));
            }
        }
        if let Some(Shape::HalfSpace(_)) = shape {
            return Err(Error::refused(place, "a half space has no end to be moved; give a cuboid a motion"));
        }
        Schedule::validate(self.schedule.as_ref(), place)
    }

    /// The factor f that holds from the instant `t` [s] on.
    fn factor(&self, t: f64) -> f64 {
        Schedule::factor_or_one(self.schedule.as_ref(), t)
    }

    /// The integral φ of the factor [s].
    fn phase(&self, t: Time) -> f64 {
        let Some(Schedule(pairs)) = &self.schedule else { return t.value + t.rest };
        // of each piece the part between 0 and t
        let ends = pairs.iter().skip(1).map(|pair| pair.0).chain([f64::INFINITY]);
        let part = |(&(from, f), to): (&(f64, f64), f64)| f * (t.value.clamp(from, to) - 0f64.clamp(from, to));
        pairs.iter().zip(ends).map(part).sum::<f64>() + self.factor(t.value) * t.rest
    }

    /// Times at which the velocity jumps [s].
    pub(crate) fn switches(&self) -> Vec<f64> {
        Schedule::times(self.schedule.as_ref())
    }

    /// The next of them behind `t` [s], or infinity.
    pub(crate) fn next_switch(&self, t: f64) -> f64 {
        self.switches().into_iter().find(|&switch| switch > t).unwrap_or(f64::INFINITY)
    }

    /// Velocity of the centre [m/s] and angular velocity [rad/s] from the instant `t` [s] on.
    pub(crate) fn velocities(&self, t: f64) -> (Vector3, Vector3) {
        let f = self.factor(t);
        (f * Vector3::from(self.velocity), f * Vector3::from(self.angular_velocity))
    }

    /// Whether it moves from the instant `t` [s] on.
    pub(crate) fn moves(&self, t: f64) -> bool {
        let (v, w) = self.velocities(t);
        v != Vector3::zeros() || w != Vector3::zeros()
    }

    /// The motion of a body at the instant `t` that stands as `start` at time 0, with the velocity that holds from
    /// `since` [s] on.
    pub(crate) fn at(&self, start: &BodyMotion, t: Time, since: f64) -> BodyMotion {
        let phase = self.phase(t);
        let center = Vector3::from(self.center);
        let turn = phase * Vector3::from(self.angular_velocity);
        let orientation = quaternion::normalized(&(quaternion::exp(&turn) * start.orientation));
        let rotation = quaternion::to_matrix(&orientation);
        let arm = -(rotation * center);
        let (velocity, angular_velocity) = self.velocities(since);
        BodyMotion {
            position: start.point(&center) + phase * Vector3::from(self.velocity) + arm,
            orientation,
            rotation,
            velocity: velocity + angular_velocity.cross(&arm),
            angular_velocity,
            ..*start
        }
    }

    /// Acceleration of the point that `motion` tells of [m/s²].
    pub(crate) fn acceleration(&self, motion: &BodyMotion) -> Vector3 {
        let arm = -(motion.rotation * Vector3::from(self.center));
        motion.angular_velocity.cross(&motion.angular_velocity.cross(&arm))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Matrix3;

    fn start() -> BodyMotion {
        let mut start = BodyMotion::at_rest(1.0, Matrix3::identity());
        start.position = Vector3::new(1.0, 2.0, 3.0);
        start.orientation = quaternion::exp(&Vector3::new(0.2, -0.3, 0.5));
        start.rotation = quaternion::to_matrix(&start.orientation);
        start
    }

    #[test]
    fn the_motion_is_the_integral_of_its_velocities() {
        // f = 0, 2, −1 from −1 s and from 0.5 s on: the distance φ(t) is −2·(−t) before 0 and so on
        let motion = Prescribed::moving([1.0, 0.0, 0.5]).schedule([(-1.0, 2.0), (0.5, -1.0)]);
        let ways = [(-2.0, -2.0), (-1.0, -2.0), (-0.25, -0.5), (0.0, 0.0), (0.25, 0.5), (0.5, 1.0), (2.0, -0.5)];
        for (t, way) in ways {
            let moved = motion.at(&start(), Time::new(t), t);
            assert!((moved.position - start().position - way * Vector3::new(1.0, 0.0, 0.5)).norm() < 1e-15, "{t}");
        }
        assert_eq!(motion.at(&start(), Time::new(0.5), 0.5).velocity, Vector3::new(-1.0, 0.0, -0.5));
        assert_eq!((motion.moves(-1.5), motion.moves(-1.0), motion.next_switch(-1.0)), (false, true, 0.5));
    }

    #[test]
    fn velocity_and_acceleration_are_the_derivatives() {
        let motion = Prescribed { velocity: [0.4, -0.2, 0.1], ..Prescribed::turning([1.0, -2.0, 0.5]) }
            .about([0.3, 0.1, -0.2])
            .schedule([(0.0, 1.5)]);
        let (t, h) = (0.7, 1e-4);
        let [before, now, after] = [t - h, t, t + h].map(|t| motion.at(&start(), Time::new(t), t));
        // central differences: h²/6 of the third derivative, some 30 m/s³
        assert!(((after.position - before.position) / (2.0 * h) - now.velocity).norm() < 1e-6);
        assert!(((after.velocity - before.velocity) / (2.0 * h) - motion.acceleration(&now)).norm() < 1e-6);
        let turned = after.orientation * before.orientation.conjugate();
        assert!((turned.imag() / h - now.angular_velocity).norm() < 1e-6);
        let still = now.position + now.rotation * Vector3::from(motion.center);
        let begun = start().point(&Vector3::from(motion.center));
        assert!((still - begun - 1.5 * t * Vector3::from(motion.velocity)).norm() < 1e-15);
    }
}
