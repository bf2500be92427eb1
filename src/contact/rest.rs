//! Contacts that last: which stick, slide or separate, and the forces that they carry.
//!
//! At a closed gap that is not opening the same laws hold for accelerations and forces as for velocities and
//! impulses in an impact (Baraff 1994; Glocker 2001):
//!
//! ```text
//! u̇_n ≥ 0,  f_n ≥ 0,  u̇_n f_n = 0                         separates, or carries
//! |f_t| ≤ μ f_n, against u̇_t      where u_t = 0             sticks, or starts to slide
//! f_t = −μ f_n u_t/|u_t|           where u_t ≠ 0             slides
//! ```
//!
//! The relative acceleration at the contact depends on where the point of contact goes (ċ) and how the normal
//! turns (ṅ), which is the geometry's part:
//!
//! ```text
//! u = v_b + ω_b × (c − x_b) − (the same of a)
//! u̇ = a_b + α_b × r_b + ω_b × (ċ − v_b) − (the same of a)      u̇_n = n·u̇ + ṅ·u
//! ```
//!
//! A corner carries its point of contact along, a ball leaves it beneath its centre; [`Support`] has a
//! constructor for each. Forces of redundant contacts are the shortest that carry the load.
//!
//! # What it is for, and when it fails
//! Small active sets: a body on its corners, an edge, a ball; a box on a box. With friction and sliding the
//! problem can have no solution (Painlevé 1895: a rod that is pushed over the floor at a steep angle); that is
//! the named error [`ClusterError::Inconsistent`], and the way out is an impact without collision:
//! [`collide`](super::collision::collide) on the same contacts.

use super::cluster::{ClusterBody, ClusterError, Contact, Frame, Row, Velocity, check, matrix, relative};
use super::problem::{PerContact, Scaled, choose_normals};
use super::solver::Coulomb;
use super::solver::dense::{Dense, Vector, largest, least_norm, zeros};
use crate::math::Vector3;
use crate::state::{BodyMotion, Load};

/// Acceleration of a body, world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Acceleration {
    /// Of the centre of mass [m/s²].
    pub linear: Vector3,
    /// Angular acceleration α [rad/s²].
    pub angular: Vector3,
}

impl Acceleration {
    /// None.
    pub fn zero() -> Self {
        Self { linear: Vector3::zeros(), angular: Vector3::zeros() }
    }

    /// That of a free body under a load, `a = F/m`, `α = I⁻¹ (M − ω × L)`.
    pub fn free(body: &ClusterBody, load: &Load) -> Self {
        let motion = &body.motion;
        let torque = load.torque - motion.angular_velocity.cross(&motion.angular_momentum());
        Self { linear: body.mobility.linear * load.force, angular: body.mobility.angular * torque }
    }

    /// That of a body held to some freedoms, whose centre of mass is accelerated by `own` [m/s²] where its velocities
    /// along these freedoms stay: `ω × (ω × r)` of one that turns about a point, r from there.
    ///
    /// ```text
    /// [a; α] = [own; 0] + Y [F − m own; M − ω × L]
    /// ```
    pub fn within(body: &ClusterBody, load: &Load, own: &Vector3) -> Self {
        let motion = &body.motion;
        let torque = load.torque - motion.angular_velocity.cross(&motion.angular_momentum());
        let more = body.mobility.times(&(load.force - motion.mass * own), &torque);
        Self { linear: own + more.linear, angular: more.angular }
    }
}

/// A contact that lasts, with its geometry in motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Where and how; its restitution is not read.
    pub contact: Contact,
    /// Velocity ċ of the point of contact, world axes [m/s].
    pub point_velocity: Vector3,
    /// Rate ṅ of the normal, world axes [1/s].
    pub normal_rate: Vector3,
}

impl Support {
    /// A corner of b on a face of a (or a fixed plane): the point goes with b, the normal turns with a.
    pub fn corner_of_b(contact: Contact, bodies: &[ClusterBody]) -> Self {
        let (a, b) = (&bodies[contact.a], &bodies[contact.b]);
        let point_velocity = b.motion.velocity_at(&contact.point);
        let normal_rate = a.motion.angular_velocity.cross(&contact.normals[0]);
        Self { contact, point_velocity, normal_rate }
    }

    /// A corner of a on a face of b.
    pub fn corner_of_a(contact: Contact, bodies: &[ClusterBody]) -> Self {
        let (a, b) = (&bodies[contact.a], &bodies[contact.b]);
        let point_velocity = a.motion.velocity_at(&contact.point);
        let normal_rate = b.motion.angular_velocity.cross(&contact.normals[0]);
        Self { contact, point_velocity, normal_rate }
    }

    /// A ball b of this radius [m] on a face of a: the point stays beneath the ball's centre.
    pub fn ball_on_face(contact: Contact, bodies: &[ClusterBody], radius: f64) -> Self {
        let n = contact.normals[0];
        let normal_rate = bodies[contact.a].motion.angular_velocity.cross(&n);
        let center = bodies[contact.b].motion.velocity_at(&(contact.point + radius * n));
        Self { point_velocity: center - radius * normal_rate, normal_rate, contact }
    }

    /// A ball b on a ball a, of these radii [m]: the normal turns as the line of centres.
    pub fn ball_on_ball(contact: Contact, bodies: &[ClusterBody], radius_a: f64, radius_b: f64) -> Self {
        let n = contact.normals[0];
        let center_a = bodies[contact.a].motion.velocity_at(&(contact.point - radius_a * n));
        let center_b = bodies[contact.b].motion.velocity_at(&(contact.point + radius_b * n));
        let across = center_b - center_a;
        let normal_rate = (across - n.dot(&across) * n) / (radius_a + radius_b);
        Self { point_velocity: center_a + radius_a * normal_rate, normal_rate, contact }
    }

    /// Rounds about two lines that cross, of these directions in world axes and radii [m], 0 of an edge: the point
    /// stays between the points of the lines that are nearest to each other.
    pub fn line_on_line(contact: Contact, bodies: &[ClusterBody], along: [&Vector3; 2], radii: [f64; 2]) -> Self {
        let motions = [contact.a, contact.b].map(|k| &bodies[k].motion);
        Self::between_lines(contact, motions, along, radii)
    }

    /// The same for these motions of a and b.
    pub(super) fn between_lines(
        contact: Contact,
        [a, b]: [&BodyMotion; 2],
        [along_a, along_b]: [&Vector3; 2],
        [radius_a, radius_b]: [f64; 2],
    ) -> Self {
        let n = contact.normals[0];
        let across = along_a.cross(along_b);
        let side = across.dot(&n);
        let turning =
            a.angular_velocity.cross(along_a).cross(along_b) + along_a.cross(&b.angular_velocity.cross(along_b));
        let rate = turning / side;
        let normal_rate = rate - n.dot(&rate) * n;

        // how fast the nearest point runs along a's line
        let (on_a, on_b) = (contact.point - radius_a * n, contact.point + radius_b * n);
        let passing = b.velocity_at(&on_b) - a.velocity_at(&on_a) - (radius_a + radius_b) * normal_rate;
        let running = passing.cross(along_b).dot(&n) / side;
        let point_velocity = a.velocity_at(&on_a) + running * along_a + radius_a * normal_rate;
        Self { contact, point_velocity, normal_rate }
    }
}

/// What a contact does from now on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    /// It opens.
    Separate,
    /// It carries, and does not slide.
    Stick,
    /// It carries, and b slides over a along this unit direction, world axes.
    Slide(Vector3),
}

/// The contacts of a cluster at an instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Rest {
    /// What each contact does.
    pub holds: Vec<Hold>,
    /// Force on b of each contact, world axes [N].
    pub forces: Vec<Vector3>,
    /// The normal that each contact carries along.
    pub normals: Vec<Vector3>,
    /// Accelerations of the bodies with those forces.
    pub accelerations: Vec<Acceleration>,
    /// How far the forces are from solving the contact laws, relative to the largest relative acceleration [-].
    pub residual: f64,
}

/// Residual above which the laws count as contradicting each other [-]: solvers end at 1e-11 or orders of
/// magnitude above.
const INCONSISTENT: f64 = 1.0e-9;

/// Force, or acceleration in the same scale, that counts as none, as a fraction of the largest [-]: a hundred
/// times what the solvers leave.
const NOTHING: f64 = 1.0e-9;

/// Part of the largest relative acceleration up to which one that nothing can change counts as a step's error [-]: a
/// stage of the method of order 4 is off by half the square of its step, which is 0.04 of the turning. Larger: contacts
/// that begin to slip are said to stick.
const STEP_ERROR: f64 = 1.0e-3;

/// Which contacts stick, slide and separate, and with which forces. `free` are the accelerations of the bodies
/// without contact forces ([`Acceleration::free`] for free bodies, the prescribed ones for driven bodies);
/// contacts whose sliding is slower than `slip_speed` [m/s] count as sticking, or about to slide.
///
/// # Errors
/// Numbers that no contact has; lists of different lengths; [`ClusterError::Inconsistent`].
pub fn rest(
    bodies: &[ClusterBody],
    free: &[Acceleration],
    supports: &[Support],
    slip_speed: f64,
) -> Result<Rest, ClusterError> {
    solve(bodies, free, supports, |_, slip| {
        let speed = libm::hypot(slip[0], slip[1]);
        (speed > slip_speed && speed > 0.0).then(|| slip.map(|s| s / speed))
    })
}

/// The same, where it is known which contacts slide and along which direction, world axes; `None` sticks, or is
/// about to slide. At an instant within a step whose ends slide one way, it is this way that friction opposes.
///
/// # Errors
/// As [`rest`].
pub fn rest_sliding(
    bodies: &[ClusterBody],
    free: &[Acceleration],
    supports: &[Support],
    sliding: &[Option<Vector3>],
) -> Result<Rest, ClusterError> {
    if sliding.len() != supports.len() {
        return Err(ClusterError::Lengths { bodies: supports.len(), accelerations: sliding.len() });
    }
    let frames: PerContact<Frame> = supports.iter().map(|s| Frame::new(&s.contact.normals[0])).collect();
    solve(bodies, free, supports, |i, _| {
        let [_, first, second] = frames[i].components(&sliding[i]?);
        let length = libm::hypot(first, second);
        (length > 0.0).then(|| [first / length, second / length])
    })
}

/// The problem, with the direction of sliding of each contact as its place and its slip in the tangents tell.
fn solve(
    bodies: &[ClusterBody],
    free: &[Acceleration],
    supports: &[Support],
    sliding: impl Fn(usize, [f64; 2]) -> Option<[f64; 2]>,
) -> Result<Rest, ClusterError> {
    let contacts: Vec<Contact> = supports.iter().map(|s| s.contact.clone()).collect();
    check(bodies, &contacts)?;
    if free.len() != bodies.len() {
        return Err(ClusterError::Lengths { bodies: bodies.len(), accelerations: free.len() });
    }
    let velocities: Vec<Velocity> = bodies.iter().map(ClusterBody::velocity).collect();
    let slips: PerContact<Vector3> = contacts.iter().map(|c| relative(bodies, c, &velocities)).collect();
    let active: PerContact<usize> = (0..contacts.len())
        .filter(|&i| !(bodies[contacts[i].a].mobility.is_none() && bodies[contacts[i].b].mobility.is_none()))
        .collect();

    // relative accelerations without forces, the turning of the normal in their normal part
    let at = |k: usize, s: &Support| {
        let (body, a) = (&bodies[k], &free[k]);
        a.linear
            + a.angular.cross(&body.lever(&s.contact.point))
            + body.motion.angular_velocity.cross(&(s.point_velocity - body.motion.velocity))
    };
    let bare: PerContact<Vector3> = supports.iter().map(|s| at(s.contact.b, s) - at(s.contact.a, s)).collect();
    let normals = choose_normals(bodies, &contacts, &active, &bare);
    let turned: PerContact<Vector3> = supports
        .iter()
        .zip(&bare)
        .zip(slips.iter().zip(&normals))
        .map(|((s, bare), (slip, n))| bare + s.normal_rate.dot(slip) * n)
        .collect();

    // the problem in the frames of the contacts, sliding ones with their direction
    let mut scaled = Scaled::new(bodies, &contacts, &active, &normals, &turned, 3);
    let frames: PerContact<Frame> = normals.iter().map(Frame::new).collect();
    let friction: Vector = active.iter().map(|&i| contacts[i].friction).collect();
    let slide: PerContact<Option<[f64; 2]>> = active
        .iter()
        .map(|&i| {
            let [_, first, second] = frames[i].components(&slips[i]);
            sliding(i, [first, second])
        })
        .collect();
    if active.len() > 1 && slide.iter().all(Option::is_none) {
        drop_unavoidable(&scaled.w, &mut scaled.q);
    }
    let floor = zeros(active.len());
    let problem = Coulomb { w: &scaled.w, q: &scaled.q, friction: &friction, floor: &floor, slide: &slide };
    let found = problem.solve();
    if found.residual > INCONSISTENT {
        return Err(ClusterError::Inconsistent { residual: found.residual });
    }

    // forces, what each contact does, accelerations
    let mut forces = vec![Vector3::zeros(); contacts.len()];
    let mut holds = vec![Hold::Separate; contacts.len()];
    let after = scaled.w.times_plus(&found.impulse, &scaled.q);
    let nothing = NOTHING * scaled.q.iter().fold(0.0, |m: f64, q| m.max(q.abs()));
    for (k, &i) in active.iter().enumerate() {
        let of = |x: &[f64]| [x[3 * k], x[3 * k + 1], x[3 * k + 2]];
        let (f, a) = (of(&found.impulse), of(&after));
        forces[i] = frames[i].vector(f.map(|f| scaled.size[k] * f));
        let starting = libm::hypot(a[1], a[2]);
        holds[i] = if f[0] <= nothing && a[0] > nothing {
            Hold::Separate
        } else if let Some(s) = slide[k] {
            Hold::Slide(frames[i].vector([0.0, s[0], s[1]]))
        } else if starting > nothing {
            // against the friction, which tells the way while the slip is still too slow to
            let way = if libm::hypot(f[1], f[2]) > starting { [-f[1], -f[2]] } else { [a[1], a[2]] };
            let length = libm::hypot(way[0], way[1]);
            Hold::Slide(frames[i].vector([0.0, way[0] / length, way[1] / length]))
        } else {
            Hold::Stick
        };
    }
    let mut accelerations = free.to_vec();
    for (contact, force) in contacts.iter().zip(&forces) {
        for (k, sign) in [(contact.a, -1.0), (contact.b, 1.0)] {
            let change = bodies[k].mobility.answer(&(sign * force), &bodies[k].lever(&contact.point));
            accelerations[k].linear += change.linear;
            accelerations[k].angular += change.angular;
        }
    }
    Ok(Rest { holds, forces, normals, accelerations, residual: found.residual })
}

/// Takes away accelerations that no forces could change, where they are small. Contacts on one body can be pressed
/// against each other without moving it, and then cannot all be told how to move: two points of a line that rolls
/// keep their distance whatever acts. While neither slips both laws agree, and what is left is a step's error.
fn drop_unavoidable(w: &Dense, q: &mut [f64]) {
    let stop: Vector = q.iter().map(|q| -q).collect();
    let left = w.times_plus(&least_norm(w, &stop), q);
    if largest(&left) <= STEP_ERROR * largest(q) {
        q.iter_mut().zip(left).for_each(|(q, left)| *q -= left);
    }
}

/// The smallest changes of velocity, in the bodies' own inertia, by impulses along rows (a contact, a unit
/// direction on b) after which the relative velocities along the rows have changed by these [m/s]. Of rows that
/// contradict each other the change is the least-squares one.
pub fn align(
    bodies: &[ClusterBody],
    contacts: &[Contact],
    rows: &[(usize, Vector3)],
    changes: &[f64],
) -> Vec<Velocity> {
    let problem: Vec<Row> = rows.iter().map(|&(contact, direction)| Row { contact, direction }).collect();
    let found = least_norm(&matrix(bodies, contacts, &problem), changes);
    let mut moved = vec![Velocity { linear: Vector3::zeros(), angular: Vector3::zeros() }; bodies.len()];
    for ((contact, direction), p) in rows.iter().zip(&found) {
        let contact = &contacts[*contact];
        for (k, sign) in [(contact.a, -1.0), (contact.b, 1.0)] {
            let change = bodies[k].mobility.answer(&(sign * *p * direction), &bodies[k].lever(&contact.point));
            moved[k].linear += change.linear;
            moved[k].angular += change.angular;
        }
    }
    moved
}
