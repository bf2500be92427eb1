//! What bodies that have stuck carry where they hang together, and how much of it they bear (beyond).
//!
//! ```text
//! a_i = A + α × d_i + Ω × (Ω × d_i)                            a part of a compound, d_i = x_i − X
//! f = Σ (m_i a_i − F_i)                                        force, and
//! τ = Σ [I_i α + Ω × I_i Ω − M_i + (x_i − p) × (m_i a_i − F_i)]    torque about p, on the parts i of one side
//! ```
//!
//! Newton's and Euler's equations of the parts on one side of a joint: what the other side must exert on them at the
//! point p for the compound to move as one. The joints of a compound form a tree, so that every one has two sides, and
//! its load follows from the motion alone. A part that has stuck to something fixed has no acceleration: then the load
//! is what holds its weight.
//!
//! A joint bears a force and a torque, not an impulse: the blow that makes it, and blows that the compound takes
//! afterwards, last no time and break nothing.

use super::rest::Acceleration;
use crate::error::{Error, Result};
use crate::math::Vector3;
use crate::state::{BodyMotion, Load};

/// The load under which a joint breaks.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BreakingLoad {
    /// Largest force that the joint carries [N]; any, if left out.
    #[cfg_attr(feature = "serde", serde(default = "any", skip_serializing_if = "is_any"))]
    pub force: f64,
    /// Largest torque about the point of contact that it carries [N·m]; any, if left out.
    #[cfg_attr(feature = "serde", serde(default = "any", skip_serializing_if = "is_any"))]
    pub torque: f64,
}

#[cfg(feature = "serde")]
mod defaults {
    //! What a file may leave out, and what a written file does.
    #![expect(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]

    pub(super) fn any() -> f64 {
        f64::INFINITY
    }
    pub(super) fn is_any(x: &f64) -> bool {
        *x == f64::INFINITY
    }
}
#[cfg(feature = "serde")]
use defaults::{any, is_any};

impl BreakingLoad {
    /// A joint that never breaks.
    pub const NEVER: Self = Self { force: f64::INFINITY, torque: f64::INFINITY };

    /// A joint that breaks under more than this force [N], or this torque [N·m].
    pub fn new(force: f64, torque: f64) -> Self {
        Self { force, torque }
    }

    /// Of a pair the weaker, in force and in torque.
    #[must_use]
    pub fn weaker(&self, other: &Self) -> Self {
        Self { force: self.force.min(other.force), torque: self.torque.min(other.torque) }
    }

    /// Whether any load breaks it.
    pub fn is_finite(&self) -> bool {
        self.force.is_finite() || self.torque.is_finite()
    }

    /// Whether the joint gives way to this force [N] and torque [N·m].
    pub fn is_exceeded(&self, force: &Vector3, torque: &Vector3) -> bool {
        force.norm() > self.force || torque.norm() > self.torque
    }

    /// Refuses what is no load.
    pub(crate) fn validate(&self, place: &str) -> Result<()> {
        for (field, value) in [("breaking_load.force", self.force), ("breaking_load.torque", self.torque)] {
            if value.is_nan() || value <= 0.0 {
                return Err(Error::value(place, field, "a number > 0, or left out", value));
            }
        }
        Ok(())
    }
}

/// What a joint carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carried {
    /// Force on the one side, and torque about the joint, world axes.
    pub load: Load,
    /// Sum of the sizes of what the force [N] and the torque [N·m] are worked out from: rounding is measured by it.
    pub size: [f64; 2],
}

/// What a joint at a world point exerts on the parts of one side, each with its motion and what acts on it, where the
/// whole moves so.
pub fn carried<'a>(
    whole: &BodyMotion,
    acceleration: &Acceleration,
    side: impl IntoIterator<Item = (&'a BodyMotion, &'a Load)>,
    point: &Vector3,
) -> Carried {
    let (w, alpha) = (whole.angular_velocity, acceleration.angular);
    let mut carried = Carried { load: Load::zero(), size: [0.0; 2] };
    for (part, acting) in side {
        let (lever, arm) = (part.position - whole.position, part.position - point);
        let inertial = part.mass * (acceleration.linear + alpha.cross(&lever) + w.cross(&w.cross(&lever)));
        let force = inertial - acting.force;

        let turned = part.rotation * (part.inertia_body * part.rotation.tr_mul(&alpha));
        let spun = w.cross(&part.angular_momentum());
        carried.load.force += force;
        carried.load.torque += turned + spun - acting.torque + arm.cross(&force);

        let size = inertial.norm() + acting.force.norm();
        carried.size[0] += size;
        carried.size[1] += turned.norm() + spun.norm() + acting.torque.norm() + arm.norm() * size;
    }
    carried
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cluster::ClusterBody;
    use crate::contact::stick::{Merged, merge};
    use crate::math::{Matrix3, quaternion};

    #[test]
    fn both_sides_of_a_joint_exert_opposite_loads() {
        // Newton and Euler of the whole: what acts on all parts is what accelerates it, so the two sides' sums cancel
        let body = |x: [f64; 3], v: [f64; 3], mass: f64| {
            let mut body = BodyMotion::at_rest(mass, Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.25)));
            (body.position, body.velocity) = (x.into(), v.into());
            body.orientation = quaternion::exp(&Vector3::new(0.3 * mass, -0.2, 0.5));
            body.rotation = quaternion::to_matrix(&body.orientation);
            body.angular_velocity = Vector3::new(1.0, -2.0, 0.5 * mass);
            body
        };
        let parts = [body([0.0; 3], [1.0, 0.0, 2.0], 2.0), body([0.5, 0.1, -0.2], [0.0, 3.0, -1.0], 0.7)];
        let Merged { motion, inv_inertia_body, members, .. } = merge(&parts).unwrap();
        let parts = [0, 1].map(|i| members[i].motion(&motion, parts[i].mass, parts[i].inertia_body));
        let loads = [
            Load { force: Vector3::new(1.0, 2.0, -3.0), torque: Vector3::new(0.1, -0.4, 0.3) },
            Load { force: Vector3::new(0.5, -1.0, 4.0), torque: Vector3::new(0.7, 0.2, -0.1) },
        ];
        let mut total = Load::zero();
        for (part, load) in parts.iter().zip(&loads) {
            total.torque += load.torque;
            total.add_force_at(&load.force, &part.position, &motion);
        }
        let acceleration = Acceleration::free(&ClusterBody::free(&motion, &inv_inertia_body), &total);
        let point = Vector3::new(0.3, 0.0, -0.1);
        let [a, b] = [0, 1].map(|i| carried(&motion, &acceleration, [(&parts[i], &loads[i])], &point));
        // some dozen operations on numbers of the size that is told
        assert!((a.load.force + b.load.force).norm() < 64.0 * f64::EPSILON * (a.size[0] + b.size[0]));
        assert!((a.load.torque + b.load.torque).norm() < 64.0 * f64::EPSILON * (a.size[1] + b.size[1]));
        assert!(a.load.force.norm() > 1.0 && a.load.torque.norm() > 0.1);
    }
}
