//! Where a contact that lasts goes when its bodies move.
//!
//! ```text
//! on a face     a point of one body, or a round about it, on a face of the other: n turns with the face,
//!               c = p ∓ r n,   gap = n·(p − face) − r
//! two balls     n along the line of centres,   gap = |p_b − p_a| − r_a − r_b
//! two edges     n across both,   gap = n·(p_b − p_a)
//! ```
//!
//! A corner is a round of radius 0, as is every point of two faces that lie on each other: their common plane
//! is what matters, and it turns with one of them. The side of a cylinder rests on a face as two rounds at the
//! ends of its axis. A rim that rolls, the side of a cone, an ellipsoid have no anchor here.

use super::cluster::{ClusterBody, Contact};
use super::manifold::{Manifold, ManifoldPoint, Surface};
use super::rest::Support;
use crate::closest::Feature;
use crate::math::{Pose, Vector3};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
use crate::state::BodyMotion;

/// What of the two bodies makes a contact, each in its own axes, from its centre of mass [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Anchor {
    /// A point of body b (or of a, where `of_b` is false) with a round of this radius about it, on a face of
    /// the other body through `foot`, with its normal from a to b in that body's axes.
    OnFace {
        /// Whether the point is b's.
        of_b: bool,
        /// The point.
        point: Vector3,
        /// Radius of the round [m]; 0 of a corner.
        radius: f64,
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
    /// The anchor of a manifold's point; none where the contact has no single normal, or rolls on a curve that
    /// is neither ball nor cylinder.
    pub fn new(a: &Faced<'_>, b: &Faced<'_>, manifold: &Manifold, point: &ManifoldPoint) -> Option<Self> {
        let [n] = manifold.normals[..] else { return None };
        let count = manifold.points.len();
        let own = |body: &Faced<'_>, p: &Vector3| body.motion.rotation.tr_mul(&(p - body.motion.position));

        // on a face of a, on a face of b
        if let (true, Some(radius)) = (a.has_face(&n), b.round(count)) {
            let point_b = own(b, &(point.point_b + radius * n));
            let normal = a.motion.rotation.tr_mul(&n);
            return Some(Self::OnFace { of_b: true, point: point_b, radius, foot: own(a, &point.point_a), normal });
        }
        if let (true, Some(radius)) = (b.has_face(&-n), a.round(count)) {
            let point_a = own(a, &(point.point_a - radius * n));
            let normal = b.motion.rotation.tr_mul(&n);
            return Some(Self::OnFace { of_b: false, point: point_a, radius, foot: own(b, &point.point_b), normal });
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
            Self::OnFace { of_b, point, radius, normal, .. } => {
                let (face, other, sign) = if *of_b { (a, b, 1.0) } else { (b, a, -1.0) };
                let n = face.rotation * normal;
                let center = other.point(point);
                let normal_rate = face.angular_velocity.cross(&n);
                Support {
                    point_velocity: other.velocity_at(&center) - sign * radius * normal_rate,
                    normal_rate,
                    contact: at(center - sign * radius * n, n),
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

    /// The gap between the bodies at the contact [m].
    pub fn gap(&self, a: &BodyMotion, b: &BodyMotion) -> f64 {
        match self {
            Self::OnFace { of_b, point, radius, foot, normal } => {
                let (face, other, sign) = if *of_b { (a, b, 1.0) } else { (b, a, -1.0) };
                let n = face.rotation * normal;
                sign * n.dot(&(other.point(point) - face.point(foot))) - radius
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

    /// The radius of the round that one of `count` points is of; none of a surface that rolls otherwise.
    fn round(&self, count: usize) -> Option<f64> {
        match &self.surface {
            Surface::Polyhedron(_) => Some(0.0),
            Surface::Sphere(sphere) => Some(sphere.radius),
            Surface::Capsule(capsule) => Some(capsule.radius),
            Surface::Cylinder(cylinder) if count == 2 => Some(cylinder.radius),
            Surface::Cylinder(_) | Surface::Cone(_) if count > 2 => Some(0.0),
            Surface::Cylinder(_) | Surface::Cone(_) | Surface::HalfSpace(_) | Surface::Ellipsoid(_) => None,
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
