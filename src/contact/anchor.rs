//! Where a contact that lasts goes when its bodies move.
//!
//! ```text
//! on a face     what one body turns along n, on a face of the other: n turns with the face, and with d = ∓n
//!               seen from the body  c = p + R d of a round,  c = p + Q d/h, h = √(d·Q d)  of an ellipsoid,
//!               gap = ∓d·(p − face) − R or − h
//! two balls     n along the line of centres,   gap = |p_b − p_a| − r_a − r_b
//! two edges     n across both,   gap = n·(p_b − p_a)
//! ```
//!
//! A corner is a round of radius 0, as is every point of two faces that lie on each other: their common plane
//! is what matters, and it turns with one of them. The side of a cylinder rests on a face as two rounds at the
//! ends of its axis. An ellipsoid's Q has the squares of its semi-axes; a rim of radius r about the axis e is the
//! ellipsoid without height, Q = r² (1 − e eᵀ). A cone on its side rests on its apex and its rim. What rolls
//! over an edge, or on a curve that is no ball, has no anchor here.

use super::cluster::{ClusterBody, Contact};
use super::manifold::{Manifold, ManifoldPoint, Surface};
use super::rest::Support;
use crate::closest::Feature;
use crate::math::{Matrix3, Pose, Vector3, quaternion};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
use crate::state::BodyMotion;

/// What of the two bodies makes a contact, each in its own axes, from its centre of mass [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Anchor {
    /// A surface of body b (or of a, where `of_b` is false) about a point of it, on a face of the other body
    /// through `foot`, with its normal from a to b in that body's axes.
    OnFace {
        /// Whether the surface is b's.
        of_b: bool,
        /// The point that it is about.
        point: Vector3,
        /// The surface.
        rolls: Rolls,
        /// A point of the face.
        foot: Vector3,
        /// The normal.
        normal: Vector3,
    },
    /// Two balls, of which one may be a corner.
    Balls {
        /// Their centres, of a and b.
        centers: [Vector3; 2],
        /// Their radii [m].
        radii: [f64; 2],
    },
    /// Two edges that cross.
    Edges {
        /// A point of each, of a and b.
        points: [Vector3; 2],
        /// Their unit directions.
        along: [Vector3; 2],
        /// The sign that makes their product point from a to b.
        side: f64,
    },
}

/// A surface that rolls on a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rolls {
    /// A round of this radius [m]; 0 of a corner.
    Round(f64),
    /// An ellipsoid, or a rim, by its Q, body axes [m²].
    Ellipsoid(Matrix3),
}

impl Rolls {
    /// How far it reaches along a unit direction of the body's axes [m], and its foremost point there, from
    /// what it is about.
    fn foremost(&self, d: &Vector3) -> (f64, Vector3) {
        match self {
            Self::Round(radius) => (*radius, *radius * d),
            Self::Ellipsoid(q) => {
                let height = d.dot(&(q * d)).sqrt();
                (height, q * d / height)
            }
        }
    }

    /// Velocity of the foremost point [m/s] where the direction changes at this rate [1/s], body axes.
    fn run(&self, d: &Vector3, rate: &Vector3) -> Vector3 {
        match self {
            Self::Round(radius) => *radius * rate,
            Self::Ellipsoid(q) => {
                let (height, point) = self.foremost(d);
                (q * rate - point.dot(rate) * point) / height
            }
        }
    }
}

/// Two touching surfaces, with their poses and the motions of their bodies.
#[derive(Debug, Clone, Copy)]
pub struct Faced<'a> {
    /// The surface.
    pub surface: Surface<'a>,
    /// Where its axes stand.
    pub pose: Pose,
    /// The motion of the body that it belongs to.
    pub motion: &'a BodyMotion,
}

impl Anchor {
    /// The anchor of a manifold's point; none where the contact has no single normal, or rolls over
    /// an edge or on a curve that is no ball.
    pub fn new(a: &Faced<'_>, b: &Faced<'_>, manifold: &Manifold, point: &ManifoldPoint) -> Option<Self> {
        let [n] = manifold.normals[..] else { return None };
        let count = manifold.points.len();
        let own = |body: &Faced<'_>, p: &Vector3| body.motion.rotation.tr_mul(&(p - body.motion.position));

        // on a face of a, on a face of b
        if let (true, Some((point_b, rolls))) = (a.has_face(&n), b.rolls(count, &point.point_b, &-n)) {
            let normal = a.motion.rotation.tr_mul(&n);
            let (point_b, foot) = (own(b, &point_b), own(a, &point.point_a));
            return Some(Self::OnFace { of_b: true, point: point_b, rolls, foot, normal });
        }
        if let (true, Some((point_a, rolls))) = (b.has_face(&-n), a.rolls(count, &point.point_a, &n)) {
            let normal = b.motion.rotation.tr_mul(&n);
            let (point_a, foot) = (own(a, &point_a), own(b, &point.point_b));
            return Some(Self::OnFace { of_b: false, point: point_a, rolls, foot, normal });
        }

        // ball on ball or corner
        let ball = |body: &Faced<'_>, feature: Option<Feature>| match (&body.surface, feature) {
            (Surface::Sphere(sphere), _) => Some(sphere.radius),
            (Surface::Polyhedron(_), Some(Feature::Vertex(_))) => Some(0.0),
            _ => None,
        };
        let is_sphere = |body: &Faced<'_>| matches!(body.surface, Surface::Sphere(_));
        if let (true, Some(r_a), Some(r_b)) =
            (is_sphere(a) || is_sphere(b), ball(a, point.feature_a), ball(b, point.feature_b))
        {
            let centers = [own(a, &(point.point_a - r_a * n)), own(b, &(point.point_b + r_b * n))];
            return Some(Self::Balls { centers, radii: [r_a, r_b] });
        }

        // edge on edge
        let edge = |body: &Faced<'_>, feature: Option<Feature>| match (&body.surface, feature) {
            (Surface::Polyhedron(shape), Some(Feature::Edge(edge))) => Some(body.turned(&along(shape, edge as usize))),
            _ => None,
        };
        let (e, f) = (edge(a, point.feature_a)?, edge(b, point.feature_b)?);
        let across = e.cross(&f).dot(&n);
        (across != 0.0).then(|| Self::Edges {
            points: [own(a, &point.point_a), own(b, &point.point_b)],
            along: [a.motion.rotation.tr_mul(&e), b.motion.rotation.tr_mul(&f)],
            side: across.signum(),
        })
    }

    /// The contact where the bodies are now, with the rates of its point and normal; friction is that of
    /// `contact`.
    pub fn support(&self, contact: &Contact, bodies: &[ClusterBody]) -> Support {
        let (a, b) = (&bodies[contact.a].motion, &bodies[contact.b].motion);
        let at = |point: Vector3, normal: Vector3| {
            Contact::new(contact.a, contact.b, point, normal).friction(contact.friction)
        };
        match self {
            Self::OnFace { of_b, point, rolls, normal, .. } => {
                let (face, other) = if *of_b { (a, b) } else { (b, a) };
                let n = face.rotation * normal;
                let (d, rate) = towards_face(*of_b, normal, a, b);
                let touched = other.point(&(point + rolls.foremost(&d).1));
                Support {
                    point_velocity: other.velocity_at(&touched) + other.rotation * rolls.run(&d, &rate),
                    normal_rate: face.angular_velocity.cross(&n),
                    contact: at(touched, n),
                }
            }
            Self::Balls { centers, radii } => {
                let (center_a, center_b) = (a.point(&centers[0]), b.point(&centers[1]));
                let line = center_b - center_a;
                let length = line.norm();
                let n = line / length;
                let across = b.velocity_at(&center_b) - a.velocity_at(&center_a);
                let normal_rate = (across - n.dot(&across) * n) / length;
                Support {
                    point_velocity: a.velocity_at(&center_a) + radii[0] * normal_rate,
                    normal_rate,
                    contact: at(center_a + radii[0] * n, n),
                }
            }
            Self::Edges { points, along, side } => {
                let (e, f) = (a.rotation * along[0], b.rotation * along[1]);
                let (p, q) = (a.point(&points[0]), b.point(&points[1]));
                let across = e.cross(&f);
                let n = *side * across / across.norm();

                // the point of a's edge nearest to b's
                let s = (q - p).cross(&f).dot(&across) / across.norm_squared();
                Support::edge_on_edge(at(p + s * e, n), bodies, &e, &f)
            }
        }
    }

    /// Angular rate at which the point of contact runs about the surface that it is on [rad/s], beyond what the
    /// bodies turn: a rim that lies almost flat is run about fast.
    pub fn running(&self, a: &BodyMotion, b: &BodyMotion) -> f64 {
        let Self::OnFace { of_b, rolls: rolls @ Rolls::Ellipsoid(_), normal, .. } = self else { return 0.0 };
        let (d, rate) = towards_face(*of_b, normal, a, b);
        rolls.run(&d, &rate).norm() / rolls.foremost(&d).1.norm()
    }

    /// The gap between the bodies at the contact [m].
    pub fn gap(&self, a: &BodyMotion, b: &BodyMotion) -> f64 {
        match self {
            Self::OnFace { of_b, point, rolls, foot, normal } => {
                let (face, other, sign) = if *of_b { (a, b, 1.0) } else { (b, a, -1.0) };
                let n = face.rotation * normal;
                let (reach, _) = rolls.foremost(&towards_face(*of_b, normal, a, b).0);
                sign * n.dot(&(other.point(point) - face.point(foot))) - reach
            }
            Self::Balls { centers, radii } => {
                (b.point(&centers[1]) - a.point(&centers[0])).norm() - radii[0] - radii[1]
            }
            Self::Edges { points, along, side } => {
                let across = (a.rotation * along[0]).cross(&(b.rotation * along[1]));
                *side * across.dot(&(b.point(&points[1]) - a.point(&points[0]))) / across.norm()
            }
        }
    }
}

/// The direction of a face as the other body sees it, and its rate [1/s], for the face's normal from a to b in
/// its body's axes.
fn towards_face(of_b: bool, normal: &Vector3, a: &BodyMotion, b: &BodyMotion) -> (Vector3, Vector3) {
    let (face, other) = if of_b { (a, b) } else { (b, a) };
    let d = face.rotation * if of_b { -normal } else { *normal };
    let rate = (face.angular_velocity - other.angular_velocity).cross(&d);
    (other.rotation.tr_mul(&d), other.rotation.tr_mul(&rate))
}

impl Faced<'_> {
    /// Whether the surface is flat along an outer normal, world axes.
    fn has_face(&self, n: &Vector3) -> bool {
        let own = self.pose.inverse_vector(n);
        match &self.surface {
            Surface::HalfSpace(_) => true,
            Surface::Polyhedron(shape) => {
                shape.faces().iter().any(|face| (Vector3::from(face.normal) - own).norm() <= FLAT)
            }
            Surface::Cylinder(_) => libm::hypot(own.x, own.y) <= FLAT,
            Surface::Cone(_) => libm::hypot(own.x, own.y) <= FLAT && own.z < 0.0,
            Surface::Sphere(_) | Surface::Capsule(_) | Surface::Ellipsoid(_) => false,
        }
    }

    /// What one of `count` points, world axes [m], is of, with the point that it is about, where the surface
    /// touches a face whose outer normal is −d.
    fn rolls(&self, count: usize, touched: &Vector3, d: &Vector3) -> Option<(Vector3, Rolls)> {
        let round = |radius: f64| Some((touched - radius * d, Rolls::Round(radius)));
        let ellipsoid = |center: Vector3, semi_axes: Vector3| {
            let turn = self.motion.rotation.transpose() * quaternion::to_matrix(&self.pose.orientation);
            let squares = Matrix3::from_diagonal(&semi_axes.component_mul(&semi_axes));
            Some((self.pose.point(&center), Rolls::Ellipsoid(turn * squares * turn.transpose())))
        };
        let rim = |radius: f64, z: f64| ellipsoid(Vector3::new(0.0, 0.0, z), Vector3::new(radius, radius, 0.0));
        let z = self.pose.inverse_point(touched).z;
        match &self.surface {
            Surface::Polyhedron(_) => round(0.0),
            Surface::Sphere(sphere) => round(sphere.radius),
            Surface::Capsule(capsule) => round(capsule.radius),
            Surface::Cylinder(_) | Surface::Cone(_) if count > 2 => round(0.0),
            Surface::Cylinder(cylinder) if count == 2 => round(cylinder.radius),
            Surface::Cylinder(cylinder) => rim(cylinder.radius, cylinder.half_height.copysign(z)),
            Surface::Cone(_) if z > 0.0 => round(0.0),
            Surface::Cone(cone) => rim(cone.radius, -cone.half_height),
            Surface::Ellipsoid(shape) => ellipsoid(Vector3::zeros(), shape.semi_axes.into()),
            Surface::HalfSpace(_) => None,
        }
    }

    fn turned(&self, v: &Vector3) -> Vector3 {
        self.pose.vector(v)
    }
}

/// Unit direction of an edge, the shape's axes.
fn along(shape: &ConvexPolyhedron, edge: usize) -> Vector3 {
    let [from, to] = shape.edge_vertices(edge).map(|v| Vector3::from(shape.vertices_about_center()[v]));
    (to - from).normalize()
}

/// How far a face's normal may be from the contact's for the contact to lie on that face [rad].
const FLAT: f64 = 1.0e-9;
