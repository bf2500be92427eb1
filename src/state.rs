//! The state of a body, Y = (x, q, P, L) (lecture (24)), and the instant it belongs to.

use crate::math::{Matrix3, Quaternion, Vector3, quaternion};

/// State of one body, lecture (24): world axes, about the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyState {
    /// Centre of mass x [m].
    pub position: Vector3,
    /// Rotation q from body to world axes; of unit length.
    pub orientation: Quaternion,
    /// Linear momentum P = m v, lecture (18) [kg·m/s].
    pub linear_momentum: Vector3,
    /// Angular momentum L = I ω about the centre of mass, lecture (20) [kg·m²/s].
    pub angular_momentum: Vector3,
}

impl BodyState {
    /// Whether every number of the state is finite.
    pub fn is_finite(&self) -> bool {
        let q = &self.orientation.coords;
        [&self.position, &self.linear_momentum, &self.angular_momentum].iter().all(|v| v.iter().all(|x| x.is_finite()))
            && q.iter().all(|x| x.is_finite())
    }
}

/// Motion of one body at an instant: its state and what follows from it, worked out once per
/// evaluation and handed to every effect. World axes unless a name ends in `_body`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyMotion {
    /// Mass m [kg].
    pub mass: f64,
    /// Inertia about the centre of mass, body axes [kg·m²].
    pub inertia_body: Matrix3,
    /// Centre of mass x [m].
    pub position: Vector3,
    /// Rotation q from body to world axes; of unit length.
    pub orientation: Quaternion,
    /// The same rotation as a matrix R.
    pub rotation: Matrix3,
    /// Velocity v of the centre of mass, lecture (6) [m/s].
    pub velocity: Vector3,
    /// Angular velocity ω [rad/s].
    pub angular_velocity: Vector3,
}

impl BodyMotion {
    /// A body at rest at the world's origin.
    pub fn at_rest(mass: f64, inertia_body: Matrix3) -> Self {
        Self {
            mass,
            inertia_body,
            position: Vector3::zeros(),
            orientation: Quaternion::identity(),
            rotation: Matrix3::identity(),
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
        }
    }

    /// Whether position, rotation and velocities are finite.
    pub fn is_finite(&self) -> bool {
        let Self { position, rotation, velocity, angular_velocity, .. } = self;
        [position, velocity, angular_velocity].iter().all(|v| v.iter().all(|x| x.is_finite()))
            && rotation.iter().all(|x| x.is_finite())
    }

    /// The body point `p` (body axes, from the centre of mass) in the world, `R p + x` [m].
    pub fn point(&self, p_body: &Vector3) -> Vector3 {
        self.rotation * p_body + self.position
    }

    /// Velocity of the body at a world point, `v + ω × (p − x)` [m/s].
    pub fn velocity_at(&self, p: &Vector3) -> Vector3 {
        self.velocity + self.angular_velocity.cross(&(p - self.position))
    }

    /// Angular velocity in body axes [rad/s].
    pub fn angular_velocity_body(&self) -> Vector3 {
        self.rotation.tr_mul(&self.angular_velocity)
    }

    /// Angular momentum about the centre of mass, world axes, L = R I Rᵀ ω, lecture (20) [kg·m²/s].
    pub fn angular_momentum(&self) -> Vector3 {
        self.rotation * (self.inertia_body * self.angular_velocity_body())
    }

    /// Kinetic energy `½ m v² + ½ ω·L` [J].
    pub fn kinetic_energy(&self) -> f64 {
        let w = self.angular_velocity_body();
        0.5 * (self.mass * self.velocity.norm_squared() + w.dot(&(self.inertia_body * w)))
    }

    /// The lecture's state of this motion.
    pub fn state(&self) -> BodyState {
        BodyState {
            position: self.position,
            orientation: self.orientation,
            linear_momentum: self.mass * self.velocity,
            angular_momentum: self.angular_momentum(),
        }
    }

    /// The motion that a state means for a body of this mass and inertia.
    pub fn set_state(&mut self, state: &BodyState, inv_inertia_body: &Matrix3) {
        self.position = state.position;
        self.orientation = quaternion::normalized(&state.orientation);
        self.rotation = quaternion::to_matrix(&state.orientation);
        self.velocity = state.linear_momentum / self.mass;
        self.angular_velocity = self.rotation * (inv_inertia_body * self.rotation.tr_mul(&state.angular_momentum));
    }
}

/// An instant, and the side of a switch it is seen from.
///
/// A step never straddles a switch, but its last stage stands exactly on one. Schedules are
/// therefore read at `since`, which lies on the step's own side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// The instant [s].
    pub time: f64,
    /// Start of the interval without switches that the step lies in [s].
    pub since: f64,
}

impl Moment {
    /// The moment `h` later in the same interval.
    #[inline]
    #[must_use]
    pub fn after(self, h: f64) -> Self {
        Self { time: self.time + h, since: self.since }
    }
}

/// Force through the centre of mass and torque about it, world axes, lecture (10), (11).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Force F [N].
    pub force: Vector3,
    /// Torque M about the centre of mass [N·m].
    pub torque: Vector3,
}

impl Load {
    /// No force and no torque.
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), torque: Vector3::zeros() }
    }

    /// Adds a force that acts at a world point, `M += (p − x) × F`, lecture (10).
    pub fn add_force_at(&mut self, force: &Vector3, point: &Vector3, body: &BodyMotion) {
        self.force += force;
        self.torque += (point - body.position).cross(force);
    }

    /// Power of the load on a moving body, `F·v + M·ω` [W].
    pub fn power(&self, body: &BodyMotion) -> f64 {
        self.force.dot(&body.velocity) + self.torque.dot(&body.angular_velocity)
    }
}
