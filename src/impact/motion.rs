//! Motions that the search can be proved on: a pose at any time, and bounds over any interval.

use crate::math::{Pose, Vector3, quaternion};

/// A body's motion at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// Where the shape's own axes stand.
    pub pose: Pose,
    /// The moving point of [`Moving::center`], world axes [m].
    pub center: Vector3,
    /// Its velocity [m/s].
    pub velocity: Vector3,
    /// Angular velocity ω, world axes [rad/s].
    pub angular_velocity: Vector3,
}

impl Instant {
    /// Velocity of the body at a world point, `v + ω × (p − c)` [m/s].
    pub fn velocity_at(&self, p: &Vector3) -> Vector3 {
        self.velocity + self.angular_velocity.cross(&(p - self.center))
    }
}

/// Bounds of a motion over an interval; they hold at every instant of it.
///
/// ```text
/// |x″(t) − a| ≤ δ        |ω(t)| ≤ w        |ω′(t)| ≤ w′
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionBounds {
    /// Acceleration a of the moving point, world axes [m/s²].
    pub acceleration: Vector3,
    /// How far the acceleration strays from it, δ [m/s²].
    pub deviation: f64,
    /// Largest angular speed w [rad/s].
    pub angular_speed: f64,
    /// Largest angular acceleration w′ [rad/s²].
    pub angular_acceleration: f64,
}

impl MotionBounds {
    /// No acceleration at all, and this angular speed [rad/s].
    pub fn uniform(angular_speed: f64) -> Self {
        Self { acceleration: Vector3::zeros(), deviation: 0.0, angular_speed, angular_acceleration: 0.0 }
    }
}

/// A motion on which the search for an impact is proved: a point of the body moves, and the body turns
/// about that point.
pub trait Moving {
    /// The moving point, shape axes [m].
    fn center(&self) -> Vector3;

    /// The motion at `t` [s].
    fn at(&self, t: f64) -> Instant;

    /// Bounds over `from..=to` [s].
    fn bounds(&self, from: f64, to: f64) -> MotionBounds;
}

/// A uniform motion: the body point `center` moves with constant velocity, and the body turns about it
/// with constant angular velocity.
///
/// ```text
/// x(t) = x₀ + v t        R(t) = exp(t [ω]) R(0)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Motion {
    /// Where the point `center` is at t = 0, world axes [m].
    pub position: Vector3,
    /// Orientation of the shape's axes at t = 0.
    pub orientation: crate::math::Quaternion,
    /// Velocity v of the point `center` [m/s].
    pub velocity: Vector3,
    /// Angular velocity ω, world axes [rad/s].
    pub angular_velocity: Vector3,
    /// The point that moves uniformly, shape axes [m].
    pub center: Vector3,
}

impl Motion {
    /// The uniform motion of the shape's origin from a pose.
    pub fn new(pose: Pose, velocity: impl Into<Vector3>, angular_velocity: impl Into<Vector3>) -> Self {
        Self {
            position: pose.position,
            orientation: pose.orientation,
            velocity: velocity.into(),
            angular_velocity: angular_velocity.into(),
            center: Vector3::zeros(),
        }
    }

    /// A body that rests.
    pub fn resting(pose: Pose) -> Self {
        Self::new(pose, Vector3::zeros(), Vector3::zeros())
    }

    /// The same motion of another body point (shape axes [m]), which starts at `position`.
    #[must_use]
    pub fn about(mut self, center: impl Into<Vector3>) -> Self {
        self.center = center.into();
        self
    }
}

impl Moving for Motion {
    fn center(&self) -> Vector3 {
        self.center
    }

    #[inline]
    fn at(&self, t: f64) -> Instant {
        let start = quaternion::normalized(&self.orientation);
        let orientation = if self.angular_velocity == Vector3::zeros() {
            start
        } else {
            quaternion::exp(&(t * self.angular_velocity)) * start
        };
        let center = self.position + t * self.velocity;
        let offset = quaternion::rotate(&orientation, &self.center);
        Instant {
            pose: Pose { position: center - offset, orientation },
            center,
            velocity: self.velocity,
            angular_velocity: self.angular_velocity,
        }
    }

    #[inline]
    fn bounds(&self, _from: f64, _to: f64) -> MotionBounds {
        MotionBounds::uniform(self.angular_velocity.norm())
    }
}
