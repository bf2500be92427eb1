//! A cluster: bodies and the points in which they touch at one instant.
//!
//! ```text
//! u = v_b + ω_b × r_b − v_a − ω_a × r_a         velocity of b relative to a at the contact, r = p − x
//! [Δv; Δω] = Y [j; r × j]                       what an impulse j does to a body of mobility Y
//! u⁺ = u⁻ + W j                                 W = Σ over both bodies
//! ```
//!
//! The **mobility** Y is the inverse of mass and inertia. A fixed body, and one that is driven along a
//! prescribed motion, has none. A body of fewer freedoms has the mobility `B (Bᵀ M B)⁻¹ Bᵀ`, with the
//! freedoms as columns of B: a wheel on an axle takes an impulse as a wheel on an axle.
//!
//! ```
//! use bryla::contact::cluster::{ClusterBody, Contact};
//! use bryla::contact::collision::{Law, collide};
//! use bryla::math::{Matrix3, Vector3};
//! use bryla::BodyMotion;
//!
//! let mut ball = BodyMotion::at_rest(2.0, 0.1 * Matrix3::identity());
//! ball.position = Vector3::new(0.0, 0.0, 0.5);
//! ball.velocity = Vector3::new(0.0, 0.0, -3.0);
//! let bodies = [ClusterBody::fixed(), ClusterBody::free(&ball, &(10.0 * Matrix3::identity()))];
//! let floor = Contact::new(0, 1, Vector3::zeros(), Vector3::z()).restitution(0.5);
//!
//! let after = collide(&bodies, &[floor], Law::default())?;
//! assert!((after.velocities[1].linear.z - 1.5).abs() < 1e-15);
//! assert!((after.impulses[0].z - 9.0).abs() < 1e-14);
//! # Ok::<(), bryla::contact::cluster::ClusterError>(())
//! ```

use super::solver::dense::Dense;
use crate::math::{Matrix3, Vector3};
use crate::state::BodyMotion;
use smallvec::SmallVec;

/// How a body answers impulses: the symmetric 6×6 matrix from (impulse, angular impulse about the centre
/// of mass) to (change of v, change of ω), world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mobility {
    /// From impulse to Δv [1/kg].
    pub linear: Matrix3,
    /// From angular impulse to Δv, its transpose from impulse to Δω [1/(kg·m)].
    pub coupling: Matrix3,
    /// From angular impulse to Δω [1/(kg·m²)].
    pub angular: Matrix3,
}

impl Mobility {
    /// That of a body which no impulse moves: fixed, or driven.
    pub fn none() -> Self {
        Self { linear: Matrix3::zeros(), coupling: Matrix3::zeros(), angular: Matrix3::zeros() }
    }

    /// That of a free body of this mass [kg] and inverse inertia in **world** axes, `R I⁻¹ Rᵀ` [1/(kg·m²)].
    pub fn free(mass: f64, inv_inertia: &Matrix3) -> Self {
        let angular = 0.5 * (inv_inertia + inv_inertia.transpose());
        Self { linear: Matrix3::identity() / mass, coupling: Matrix3::zeros(), angular }
    }

    /// That of a body held to some freedoms, each a pair (v, ω) in world axes: mass [kg], inertia about the
    /// centre of mass in **world** axes [kg·m²].
    ///
    /// ```text
    /// Y = Σ c cᵀ over the freedoms c, made orthogonal in M (Gram and Schmidt, twice)
    /// ```
    ///
    /// A planar body has two shifts and one turn, a wheel on an axle one turn with the velocity `ω × (x − a)`
    /// of its centre. Freedoms that follow from those before them are left out.
    pub fn within(mass: f64, inertia: &Matrix3, freedoms: &[(Vector3, Vector3)]) -> Self {
        let product = |a: &(Vector3, Vector3), b: &(Vector3, Vector3)| mass * a.0.dot(&b.0) + a.1.dot(&(inertia * b.1));
        let mut basis: Vec<(Vector3, Vector3)> = Vec::new();
        let mut mobility = Self::none();
        for freedom in freedoms {
            let mut c = *freedom;
            let before = product(&c, &c);
            for _ in 0..2 {
                for b in &basis {
                    let along = product(b, &c);
                    c = (c.0 - along * b.0, c.1 - along * b.1);
                }
            }
            let square = product(&c, &c);
            if square <= DEPENDENT * before || square <= 0.0 {
                continue;
            }
            let length = square.sqrt();
            c = (c.0 / length, c.1 / length);
            mobility.linear += c.0 * c.0.transpose();
            mobility.coupling += c.0 * c.1.transpose();
            mobility.angular += c.1 * c.1.transpose();
            basis.push(c);
        }
        mobility
    }

    /// Whether no impulse moves the body.
    pub fn is_none(&self) -> bool {
        *self == Self::none()
    }

    /// Change of velocity by the impulse `j` [N·s] at the lever `r` [m] from the centre of mass.
    pub fn answer(&self, j: &Vector3, r: &Vector3) -> Velocity {
        self.times(j, &r.cross(j))
    }

    /// Change of velocity by an impulse [N·s] and an angular impulse about the centre of mass [N·m·s].
    pub(crate) fn times(&self, impulse: &Vector3, turn: &Vector3) -> Velocity {
        Velocity {
            linear: self.linear * impulse + self.coupling * turn,
            angular: self.coupling.tr_mul(impulse) + self.angular * turn,
        }
    }
}

/// Square of the sine below which a freedom counts as following from others [-]: rounding leaves 1e-30.
const DEPENDENT: f64 = 1.0e-24;

/// Velocity of a body, world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Velocity {
    /// Of the centre of mass [m/s].
    pub linear: Vector3,
    /// Angular velocity [rad/s].
    pub angular: Vector3,
}

impl Velocity {
    /// That of the body's point at the lever `r` from the centre of mass, `v + ω × r` [m/s].
    pub fn at(&self, r: &Vector3) -> Vector3 {
        self.linear + self.angular.cross(r)
    }
}

/// A body as a contact meets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClusterBody {
    /// Pose, velocities, mass and inertia. Mass and inertia of a body without mobility are not read.
    pub motion: BodyMotion,
    /// How it answers impulses.
    pub mobility: Mobility,
}

impl ClusterBody {
    /// A free body; `inv_inertia_body` is I⁻¹ in body axes.
    pub fn free(motion: &BodyMotion, inv_inertia_body: &Matrix3) -> Self {
        let inv_inertia = motion.rotation * inv_inertia_body * motion.rotation.transpose();
        Self { motion: *motion, mobility: Mobility::free(motion.mass, &inv_inertia) }
    }

    /// A body held to some freedoms; see [`Mobility::within`].
    pub fn within(motion: &BodyMotion, freedoms: &[(Vector3, Vector3)]) -> Self {
        let inertia = motion.rotation * motion.inertia_body * motion.rotation.transpose();
        Self { motion: *motion, mobility: Mobility::within(motion.mass, &inertia, freedoms) }
    }

    /// A body that moves as prescribed, whatever hits it.
    pub fn driven(motion: &BodyMotion) -> Self {
        Self { motion: *motion, mobility: Mobility::none() }
    }

    /// A fixed body.
    pub fn fixed() -> Self {
        Self::driven(&BodyMotion::at_rest(1.0, Matrix3::identity()))
    }

    /// Velocities before.
    pub fn velocity(&self) -> Velocity {
        Velocity { linear: self.motion.velocity, angular: self.motion.angular_velocity }
    }

    /// The motion with other velocities.
    pub fn moving(&self, velocity: &Velocity) -> BodyMotion {
        BodyMotion { velocity: velocity.linear, angular_velocity: velocity.angular, ..self.motion }
    }

    /// Lever from the centre of mass to a world point [m].
    pub(super) fn lever(&self, p: &Vector3) -> Vector3 {
        p - self.motion.position
    }
}

/// A point in which two bodies touch. Impulses and forces are those on b.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// Place of body a in the list of bodies.
    pub a: usize,
    /// Place of body b.
    pub b: usize,
    /// Where they touch, world axes [m]. Both bodies take the impulse here, so that angular momentum is
    /// kept to rounding; between two points a gap apart, take the middle.
    pub point: Vector3,
    /// Unit normals from a to b, world axes: one, or several where the contact has no single normal (vertex
    /// on vertex, vertex on edge, parallel edges). Several span the cone of normals, and the response
    /// chooses in it; see [`collision`](super::collision).
    pub normals: SmallVec<[Vector3; 1]>,
    /// Coefficient of friction μ [-].
    pub friction: f64,
    /// Coefficient of restitution e [-].
    pub restitution: f64,
}

impl Contact {
    /// A contact with one normal, without friction, of restitution 0.
    pub fn new(a: usize, b: usize, point: Vector3, normal: Vector3) -> Self {
        Self { a, b, point, normals: SmallVec::from_buf([normal]), friction: 0.0, restitution: 0.0 }
    }

    /// Velocity of b relative to a at the point, for these motions of the bodies [m/s].
    pub fn slip(&self, motions: &[BodyMotion]) -> Vector3 {
        motions[self.b].velocity_at(&self.point) - motions[self.a].velocity_at(&self.point)
    }

    /// Sets the normals.
    #[must_use]
    pub fn normals(self, normals: impl Into<Vec<Vector3>>) -> Self {
        Self { normals: SmallVec::from_vec(normals.into()), ..self }
    }

    /// Sets the coefficient of friction.
    #[must_use]
    pub fn friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// Sets the coefficient of restitution.
    #[must_use]
    pub fn restitution(self, restitution: f64) -> Self {
        Self { restitution, ..self }
    }
}

/// Why a cluster has no answer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClusterError {
    /// A number that no contact has.
    #[error("contact {contact}: {field} must be {allowed}, got {value}")]
    Value {
        /// The contact's place in the list.
        contact: usize,
        /// The field.
        field: &'static str,
        /// What would be accepted.
        allowed: &'static str,
        /// What was given.
        value: f64,
    },
    /// A body's numbers are not finite.
    #[error("body {body} of the cluster: its motion is not finite")]
    NotFinite {
        /// The body's place in the list.
        body: usize,
    },
    /// No impulse ends the approach: a body is squeezed between driven or fixed ones.
    #[error(
        "contact {contact}: no impulse ends the approach of {approach} m/s; bodies are squeezed between driven ones"
    )]
    Squeezed {
        /// The contact that keeps approaching fastest.
        contact: usize,
        /// How fast [m/s].
        approach: f64,
    },
    /// No forces meet the laws of contact: sliding with friction can contradict them (Painlevé 1895).
    #[error("no forces meet the laws of contact, residual {residual}; an impact without collision is due")]
    Inconsistent {
        /// How far the best forces are from meeting them, relative to the largest acceleration [-].
        residual: f64,
    },
    /// Accelerations were not given for each body.
    #[error("{accelerations} accelerations for {bodies} bodies")]
    Lengths {
        /// Number of bodies.
        bodies: usize,
        /// Number of accelerations.
        accelerations: usize,
    },
}

/// A contact's frame: normal and two tangents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame(pub(super) [Vector3; 3]);

impl Frame {
    /// The frame of a unit normal; its tangents depend on the normal only.
    pub(super) fn new(normal: &Vector3) -> Self {
        // across the axis that the normal is farthest from
        let k = normal.iamin();
        let mut axis = Vector3::zeros();
        axis[k] = 1.0;
        let first = normal.cross(&axis).normalize();
        Self([*normal, first, normal.cross(&first)])
    }

    /// The components of a vector.
    pub(super) fn components(&self, vector: &Vector3) -> [f64; 3] {
        self.0.map(|axis| axis.dot(vector))
    }

    /// The vector of these components.
    pub(super) fn vector(&self, components: [f64; 3]) -> Vector3 {
        components[0] * self.0[0] + components[1] * self.0[1] + components[2] * self.0[2]
    }
}

/// One row of a contact problem: a contact and a direction in which it can push.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) contact: usize,
    pub(super) direction: Vector3,
}

/// Checks what the solvers rely on.
pub(super) fn check(bodies: &[ClusterBody], contacts: &[Contact]) -> Result<(), ClusterError> {
    for (body, b) in bodies.iter().enumerate() {
        let m = &b.motion;
        let vectors = [m.position, m.velocity, m.angular_velocity];
        let matrices = [b.mobility.linear, b.mobility.coupling, b.mobility.angular];
        let finite = vectors.iter().all(|v| v.iter().all(|x| x.is_finite()))
            && matrices.iter().all(|m| m.iter().all(|x| x.is_finite()));
        if !finite {
            return Err(ClusterError::NotFinite { body });
        }
    }
    for (contact, c) in contacts.iter().enumerate() {
        let refuse = |field, allowed, value| Err(ClusterError::Value { contact, field, allowed, value });
        for (field, place) in [("a", c.a), ("b", c.b)] {
            if place >= bodies.len() {
                return refuse(field, "a place in the list of bodies", place as f64);
            }
        }
        if c.a == c.b {
            return refuse("b", "another body than a", c.b as f64);
        }
        if !(c.friction >= 0.0 && c.friction.is_finite()) {
            return refuse("friction", "finite and not negative", c.friction);
        }
        if !(0.0..=1.0).contains(&c.restitution) {
            return refuse("restitution", "in 0..=1", c.restitution);
        }
        if let Some(x) = c.point.iter().find(|x| !x.is_finite()) {
            return refuse("point", "finite", *x);
        }
        if c.normals.is_empty() {
            return refuse("normals", "at least one vector", 0.0);
        }
        for n in &c.normals {
            let length = n.norm();
            if length.is_nan() || (length - 1.0).abs() > UNIT {
                return refuse("normals", "unit vectors, by length", length);
            }
        }
    }
    Ok(())
}

/// How far a normal's length may be from 1 [-]: rounding of a division leaves 2e-16. What is longer by more
/// was not meant as a unit vector.
const UNIT: f64 = 1.0e-9;

/// Velocity of b relative to a at a contact [m/s].
pub(super) fn relative(bodies: &[ClusterBody], contact: &Contact, velocities: &[Velocity]) -> Vector3 {
    let at = |k: usize| velocities[k].at(&bodies[k].lever(&contact.point));
    at(contact.b) - at(contact.a)
}

/// The matrix W of rows: entry (i, j) is what a unit impulse along row j does to the relative velocity
/// along row i.
pub(super) fn matrix(bodies: &[ClusterBody], contacts: &[Contact], rows: &[Row]) -> Dense {
    let mut w = Dense::zeros(rows.len());
    for (j, source) in rows.iter().enumerate() {
        let from = &contacts[source.contact];
        for (body, sign) in [(from.b, 1.0), (from.a, -1.0)] {
            let mobility = &bodies[body].mobility;
            if mobility.is_none() {
                continue;
            }
            let change = mobility.answer(&(sign * source.direction), &bodies[body].lever(&from.point));
            let mut i = 0;
            for own in rows[..=j].chunk_by(|row, next| row.contact == next.contact) {
                let (first, to) = (i, &contacts[own[0].contact]);
                i += own.len();
                let sign = if to.b == body {
                    1.0
                } else if to.a == body {
                    -1.0
                } else {
                    continue;
                };
                let moved = sign * change.at(&bodies[body].lever(&to.point));
                for (i, row) in (first..).zip(own) {
                    w.set(i, j, w.at(i, j) + row.direction.dot(&moved));
                }
            }
        }
    }
    for j in 0..rows.len() {
        for i in 0..j {
            w.set(j, i, w.at(i, j));
        }
    }
    w
}

/// Velocities after impulses at the contacts (on b, world axes [N·s]).
pub(super) fn velocities_after(bodies: &[ClusterBody], contacts: &[Contact], impulses: &[Vector3]) -> Vec<Velocity> {
    let mut velocities: Vec<Velocity> = bodies.iter().map(ClusterBody::velocity).collect();
    for (contact, impulse) in contacts.iter().zip(impulses) {
        for (k, sign) in [(contact.a, -1.0), (contact.b, 1.0)] {
            if bodies[k].mobility.is_none() {
                continue;
            }
            let change = bodies[k].mobility.answer(&(sign * impulse), &bodies[k].lever(&contact.point));
            velocities[k].linear += change.linear;
            velocities[k].angular += change.angular;
        }
    }
    velocities
}
