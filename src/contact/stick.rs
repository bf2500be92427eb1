//! Sticking: bodies that touch become one (lecture §7).
//!
//! ```text
//! m = Σ mᵢ      x = Σ mᵢ xᵢ / m      v = Σ Pᵢ / m
//! L = Σ [Lᵢ + (xᵢ − x) × mᵢ (vᵢ − v)]      I = Σ [Iᵢ + mᵢ (|dᵢ|² 1 − dᵢ dᵢᵀ)]      ω = I⁻¹ L
//! ```
//!
//! Momentum and angular momentum are kept, kinetic energy is lost: the most that any impact can take. A
//! body that sticks to a fixed one stops; one that sticks to a driven body moves with it.
//!
//! The compound has the axes of its first member. A merged body can merge again, as one member.
//!
//! ```
//! use bryla::contact::stick::{Member, merge};
//! use bryla::math::{Matrix3, Vector3};
//! use bryla::BodyMotion;
//!
//! let mut dart = BodyMotion::at_rest(0.1, 1e-4 * Matrix3::identity());
//! dart.velocity = Vector3::new(3.0, 0.0, 0.0);
//! let mut block = BodyMotion::at_rest(0.2, 1e-3 * Matrix3::identity());
//! block.position = Vector3::new(0.1, 0.0, 0.0);
//! let merged = merge(&[dart, block]).ok_or("nothing to merge")?;
//! assert!((merged.motion.velocity.x - 1.0).abs() < 1e-15);
//! assert!((merged.energy_lost - 0.3).abs() < 1e-15);
//! # let Member { .. } = merged.members[0];
//! # Ok::<(), &str>(())
//! ```

use super::Answer;
use super::cluster::Velocity;
use crate::freedom::Riding;
use crate::mass::MassProperties;
use crate::math::{Matrix3, Pose, Vector3, quaternion};
use crate::state::BodyMotion;

/// Brings a body to rest where it is.
pub fn stick(motion: &mut BodyMotion) -> Answer {
    let answer = Answer { impulse: -motion.mass * motion.velocity, energy_lost: motion.kinetic_energy() };
    motion.velocity = Vector3::zeros();
    motion.angular_velocity = Vector3::zeros();
    answer
}

/// Lets a body move on with a driven one, as parts of one rigid body; `driver` is the driven body's motion.
/// The energy lost is that of the motion relative to the driver; the impulse is the body's change of
/// momentum.
pub fn stick_to_driven(motion: &mut BodyMotion, driver: &BodyMotion) -> Answer {
    let velocity = driver.velocity_at(&motion.position);
    let mut relative = *motion;
    relative.velocity -= velocity;
    relative.angular_velocity -= driver.angular_velocity;
    let answer = Answer { impulse: -motion.mass * relative.velocity, energy_lost: relative.kinetic_energy() };
    motion.velocity = velocity;
    motion.angular_velocity = driver.angular_velocity;
    answer
}

/// Where a member stands in its compound: its centre of mass and axes, in the compound's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Member {
    /// From the member's axes (about its centre of mass) to the compound's.
    pub pose: Pose,
    /// What joining did to the member [N·s]: the change of its momentum.
    pub impulse: Vector3,
    /// The change of its angular momentum about its own centre of mass, world axes [N·m·s].
    pub angular_impulse: Vector3,
}

/// Several bodies that have become one.
#[derive(Debug, Clone, PartialEq)]
pub struct Merged {
    /// The compound's motion; its axes are those of the first member, about the common centre of mass.
    pub motion: BodyMotion,
    /// Its I⁻¹ in its own axes [1/(kg·m²)].
    pub inv_inertia_body: Matrix3,
    /// Where each member stands in it, in the order given.
    pub members: Vec<Member>,
    /// Kinetic energy lost [J], not negative: summed from the relative motions, so that a merge of nearly
    /// equal motions loses no digits.
    pub energy_lost: f64,
}

/// Joins bodies at an instant into one; `None` of no bodies.
pub fn merge(bodies: &[BodyMotion]) -> Option<Merged> {
    let first = bodies.first()?;

    // the parts in the axes of the first, about its centre of mass
    let orientation = first.orientation;
    let into = orientation.conjugate();
    let turn_of = |body: &BodyMotion| quaternion::normalized(&(into * body.orientation));
    let parts: Vec<MassProperties> = bodies
        .iter()
        .map(|body| {
            let center = quaternion::rotate(&into, &(body.position - first.position));
            MassProperties { mass: body.mass, center_of_mass: Vector3::zeros(), inertia: body.inertia_body }
                .turned(&turn_of(body))
                .moved(center)
        })
        .collect();
    let whole = MassProperties::combined(&parts);
    let inv_inertia_body = whole.inv_inertia();
    let rotation = quaternion::to_matrix(&orientation);
    let center = rotation * whole.center_of_mass;

    // momenta relative to the first body's velocity, which keeps the digits of fast bodies that stick
    let drift: Vector3 = bodies.iter().map(|b| b.mass * (b.velocity - first.velocity)).sum();
    let velocity = first.velocity + drift / whole.mass;
    let angular_momentum: Vector3 = bodies
        .iter()
        .map(|b| {
            let lever = (b.position - first.position) - center;
            b.angular_momentum() + lever.cross(&(b.mass * (b.velocity - velocity)))
        })
        .sum();
    let angular_velocity = rotation * (inv_inertia_body * rotation.tr_mul(&angular_momentum));
    let motion = BodyMotion {
        mass: whole.mass,
        inertia_body: whole.inertia,
        position: first.position + center,
        orientation,
        rotation,
        velocity,
        angular_velocity,
    };

    let mut energy_lost = 0.0;
    let members = bodies
        .iter()
        .zip(&parts)
        .map(|(body, part)| {
            let joined = velocity_in(&motion, &(center_of(body, first) - center));
            let mut relative = *body;
            relative.velocity -= joined.linear;
            relative.angular_velocity -= joined.angular;
            energy_lost += relative.kinetic_energy();
            let pose = Pose { position: part.center_of_mass - whole.center_of_mass, orientation: turn_of(body) };
            Member { pose, impulse: -body.mass * relative.velocity, angular_impulse: -relative.angular_momentum() }
        })
        .collect();
    Some(Merged { motion, inv_inertia_body, members, energy_lost })
}

/// A body's centre of mass, seen from the first's.
fn center_of(body: &BodyMotion, first: &BodyMotion) -> Vector3 {
    body.position - first.position
}

/// Velocity of a point of the compound at a lever from its centre.
fn velocity_in(motion: &BodyMotion, lever: &Vector3) -> Velocity {
    Velocity { linear: motion.velocity + motion.angular_velocity.cross(lever), angular: motion.angular_velocity }
}

impl Member {
    /// The member's own motion while the compound moves with `whole`; `mass` and `inertia_body` are the
    /// member's.
    pub fn motion(&self, whole: &BodyMotion, mass: f64, inertia_body: Matrix3) -> BodyMotion {
        Riding { pose: self.pose }.motion(whole, &BodyMotion::at_rest(mass, inertia_body))
    }
}
