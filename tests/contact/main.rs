//! Contact with known answers: each test states its formula and where it comes from.
//!
//! Errors are relative to the case's own speed and size. Tolerances: 1e-12 where only rounding enters
//! (a few operations on numbers of the case's size, 1e-16 each, times the condition of the contact matrix,
//! below 1e3 here).

mod impacts;
mod lasting;
mod manifolds;
#[path = "../random/mod.rs"]
mod random;

use bryla::BodyMotion;
use bryla::contact::cluster::{ClusterBody, Contact, Velocity};
use bryla::contact::collision::{Collision, Law, collide};
use bryla::math::{Matrix3, Vector3, quaternion};

const TIGHT: f64 = 1e-12;

fn vector(x: f64, y: f64, z: f64) -> Vector3 {
    Vector3::new(x, y, z)
}

/// A free body from mass, principal moments, position, velocity and angular velocity, turned by a quaternion.
fn body(mass: f64, moments: [f64; 3], x: Vector3, v: Vector3, w: Vector3, turn: [f64; 4]) -> ClusterBody {
    let mut motion = BodyMotion::at_rest(mass, Matrix3::from_diagonal(&moments.into()));
    motion.position = x;
    motion.velocity = v;
    motion.angular_velocity = w;
    motion.orientation = quaternion::normalized(&quaternion::from_scalar_first(turn));
    motion.rotation = quaternion::to_matrix(&motion.orientation);
    let inverse = Matrix3::from_diagonal(&Vector3::from(moments.map(|i| 1.0 / i)));
    ClusterBody::free(&motion, &inverse)
}

fn upright(mass: f64, moments: [f64; 3], x: Vector3, v: Vector3) -> ClusterBody {
    body(mass, moments, x, v, Vector3::zeros(), [1.0, 0.0, 0.0, 0.0])
}

/// A ball: I = 2/5 m R².
fn ball(mass: f64, radius: f64, x: Vector3, v: Vector3) -> ClusterBody {
    upright(mass, [0.4 * mass * radius * radius; 3], x, v)
}

/// A cube of side 2 h: I = 2/3 m h².
fn cube(mass: f64, half: f64, x: Vector3, v: Vector3) -> ClusterBody {
    upright(mass, [mass * half * half / 1.5; 3], x, v)
}

/// The four corners of a square of half side `h` about a point, across an axis.
fn corners(center: Vector3, axis: usize, h: f64) -> [Vector3; 4] {
    [[-h, -h], [h, -h], [h, h], [-h, h]].map(|[p, q]| {
        let mut offset = Vector3::zeros();
        offset[(axis + 1) % 3] = p;
        offset[(axis + 2) % 3] = q;
        center + offset
    })
}

fn answer(bodies: &[ClusterBody], contacts: &[Contact]) -> Collision {
    collide(bodies, contacts, Law::default()).expect("an answer")
}

fn close(a: &Vector3, b: &Vector3, tolerance: f64) {
    assert!((a - b).norm() <= tolerance, "{a:?} is not {b:?}");
}

/// Momentum and angular momentum about the origin of all free bodies.
fn momenta(bodies: &[ClusterBody], velocities: &[Velocity]) -> (Vector3, Vector3) {
    let mut sum = (Vector3::zeros(), Vector3::zeros());
    for (b, v) in bodies.iter().zip(velocities).filter(|(b, _)| !b.mobility.is_none()) {
        let motion = b.moving(v);
        let p = motion.mass * motion.velocity;
        sum.0 += p;
        sum.1 += motion.position.cross(&p) + motion.angular_momentum();
    }
    sum
}

fn before(bodies: &[ClusterBody]) -> Vec<Velocity> {
    bodies.iter().map(ClusterBody::velocity).collect()
}
