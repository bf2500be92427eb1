//! The part of a body that lies foremost in a direction: a point, a segment, or a polygon.
//!
//! Exact for each surface; "foremost" means within ε of the farthest point, so that a face tilted by less
//! than ε over its extent counts as lying flat. A circular face is given as the regular polygon of
//! sixteen corners in its rim, and by the rim itself, which cuts what lies across it.

use crate::closest::Feature;
use crate::math::{Pose, Vector3};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
use crate::shape::{Capsule, Cone, Cylinder, Ellipsoid, HalfSpace, Sphere};

/// Corners of the polygon that stands for a circular face on a larger one [-]. Inside it a load is carried as by the
/// disc; in the slivers outside, up to 1 − cos(π/16) = 2 % of the radius, a load tips the body early.
pub(super) const DISC: usize = 16;

/// A surface that bodies can touch with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Surface<'a> {
    /// A convex polyhedron, or a polygon, segment or point.
    Polyhedron(&'a ConvexPolyhedron),
    /// All of space on one side of a plane.
    HalfSpace(&'a HalfSpace),
    /// A ball.
    Sphere(&'a Sphere),
    /// A cylinder.
    Cylinder(&'a Cylinder),
    /// A capsule.
    Capsule(&'a Capsule),
    /// A cone.
    Cone(&'a Cone),
    /// An ellipsoid.
    Ellipsoid(&'a Ellipsoid),
}

/// A corner of a patch and the feature it is, where the surface has features.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    pub(super) at: Vector3,
    pub(super) vertex: Option<usize>,
}

/// A straight line on a surface, or the axis of a side that is round about it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) from: Vector3,
    pub(super) direction: Vector3,
    pub(super) is_round: bool,
}

impl Surface<'_> {
    /// How far the surface reaches along a unit direction of its own axes [m].
    pub(super) fn reach(&self, d: &Vector3) -> f64 {
        let across = libm::hypot(d.x, d.y);
        match self {
            Self::Polyhedron(body) => {
                let center = Vector3::from(body.center());
                let v = body.vertices_about_center()[body.support((*d).into())];
                Vector3::from(v).dot(d) + center.dot(d)
            }
            Self::HalfSpace(_) => f64::INFINITY,
            Self::Sphere(s) => s.radius,
            Self::Cylinder(c) => c.radius * across + c.half_height * d.z.abs(),
            Self::Capsule(c) => c.radius + c.half_height * d.z.abs(),
            Self::Cone(c) => (c.half_height * d.z).max(c.radius * across - c.half_height * d.z),
            Self::Ellipsoid(e) => Vector3::from(e.semi_axes).component_mul(d).norm(),
        }
    }

    /// The circular face that lies within `eps` of the farthest point along a unit direction: its middle, own axes, and
    /// its radius [m].
    pub(super) fn disc(&self, d: &Vector3, eps: f64) -> Option<(Vector3, f64)> {
        let (radius, z) = match self {
            Self::Cylinder(c) => (c.radius, c.half_height.copysign(d.z)),
            Self::Cone(c) if d.z < 0.0 => (c.radius, -c.half_height),
            _ => return None,
        };
        (2.0 * radius * libm::hypot(d.x, d.y) <= eps).then(|| (Vector3::new(0.0, 0.0, z), radius))
    }

    /// The corners within `eps` of the farthest point along a unit direction, own axes; several of them in
    /// no particular order. Empty for a half space.
    pub(super) fn foremost(&self, d: &Vector3, eps: f64) -> Vec<Corner> {
        let across = Vector3::new(d.x, d.y, 0.0);
        let length = across.norm();
        let radial = if length > 0.0 { across / length } else { Vector3::x() };
        let axis = Vector3::z();
        let one = |at: Vector3| vec![Corner { at, vertex: None }];
        let all = |points: &[Vector3]| points.iter().map(|&at| Corner { at, vertex: None }).collect::<Vec<_>>();
        if let Some((middle, radius)) = self.disc(d, eps) {
            let corner = |k: usize| {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * k as f64 / DISC as f64);
                Corner { at: middle + radius * Vector3::new(cos, sin, 0.0), vertex: None }
            };
            return (0..DISC).map(corner).collect();
        }
        match self {
            Self::Polyhedron(body) => {
                let center = Vector3::from(body.center());
                let vertices = body.vertices_about_center();
                let top = Vector3::from(vertices[body.support((*d).into())]).dot(d);
                let near = |v: &[f64; 3]| Vector3::from(*v).dot(d) >= top - eps;
                let corner = |(k, v): (usize, &[f64; 3])| Corner { at: Vector3::from(*v) + center, vertex: Some(k) };
                vertices.iter().enumerate().filter(|(_, v)| near(v)).map(corner).collect()
            }
            Self::HalfSpace(_) => Vec::new(),
            Self::Sphere(s) => one(s.radius * d),
            Self::Cylinder(c) if 2.0 * c.half_height * d.z.abs() <= eps => {
                let line = c.radius * radial;
                all(&[line - c.half_height * axis, line + c.half_height * axis])
            }
            Self::Cylinder(c) => one(c.radius * radial + c.half_height.copysign(d.z) * axis),
            Self::Capsule(c) if 2.0 * c.half_height * d.z.abs() <= eps && c.half_height > 0.0 => {
                all(&[c.radius * d - c.half_height * axis, c.radius * d + c.half_height * axis])
            }
            Self::Capsule(c) => one(c.radius * d + c.half_height.copysign(d.z) * axis),
            Self::Cone(c) => {
                let (apex, rim) = (c.half_height * axis, c.radius * radial - c.half_height * axis);
                let (up, down) = (apex.dot(d), rim.dot(d));
                if (up - down).abs() <= eps { all(&[apex, rim]) } else { one(if up > down { apex } else { rim }) }
            }
            Self::Ellipsoid(e) => {
                let scaled = Vector3::from(e.semi_axes).component_mul(d);
                one(Vector3::from(e.semi_axes).component_mul(&scaled) / scaled.norm())
            }
        }
    }

    /// Outward normals of the flat faces that hold a point of the surface to within `eps`, own axes.
    pub(super) fn flat_at(&self, p: &Vector3, eps: f64) -> Vec<Vector3> {
        let cap = |half_height: f64, radius: f64, up: bool| {
            let z = if up { p.z } else { -p.z };
            ((z - half_height).abs() <= eps && libm::hypot(p.x, p.y) <= radius + eps)
                .then(|| if up { Vector3::z() } else { -Vector3::z() })
        };
        match self {
            Self::Polyhedron(body) => {
                let q = p - Vector3::from(body.center());
                let holds = |n: &Vector3, offset: f64| (n.dot(&q) - offset).abs() <= eps;
                let faces = body.faces().iter().map(|f| (Vector3::from(f.normal), f.offset));
                faces.filter(|(n, offset)| holds(n, *offset)).map(|(n, _)| n).collect()
            }
            Self::Cylinder(c) => [true, false].iter().filter_map(|&up| cap(c.half_height, c.radius, up)).collect(),
            Self::Cone(c) => cap(c.half_height, c.radius, false).into_iter().collect(),
            Self::HalfSpace(h) => vec![h.plane().0],
            _ => Vec::new(),
        }
    }

    /// The lines that run past a point of the surface: edges within `eps` of it, and the axis of the side that it is on;
    /// own axes.
    pub(super) fn lines_at(&self, p: &Vector3, eps: f64) -> Vec<Line> {
        let axis = |half_height: f64, radius: f64| {
            let beside = p.z.abs() <= half_height + eps && libm::hypot(p.x, p.y) >= radius - eps;
            beside.then(|| Line { from: Vector3::zeros(), direction: Vector3::z(), is_round: true })
        };
        match self {
            Self::Cylinder(c) => axis(c.half_height, c.radius).into_iter().collect(),
            Self::Capsule(c) => axis(c.half_height, c.radius).into_iter().collect(),
            Self::Polyhedron(body) => {
                let center = Vector3::from(body.center());
                let mut lines = Vec::new();
                for (e, edge) in body.edges().iter().enumerate() {
                    let direction = Vector3::from(edge.direction);
                    let from = center + Vector3::from(body.vertices_about_center()[body.edge_vertices(e)[0]]);
                    let along = (p - from).dot(&direction).clamp(0.0, edge.length);
                    if (p - from - along * direction).norm() <= eps {
                        lines.push(Line { from, direction, is_round: false });
                    }
                }
                lines
            }
            _ => Vec::new(),
        }
    }

    /// The face of a polyhedron that holds these vertices and faces most along a direction of its axes.
    pub(super) fn face_of(&self, corners: &[Corner], d: &Vector3) -> Option<Feature> {
        let Self::Polyhedron(body) = self else { return None };
        let at = corners.first()?.vertex?;
        let facing = |&f: &u32| Vector3::from(body.faces()[f as usize].normal).dot(d);
        let best = body.faces_at(at).iter().copied().max_by(|f, g| facing(f).total_cmp(&facing(g)))?;
        Some(Feature::Face(best))
    }

    /// The edge of a polyhedron between two corners.
    pub(super) fn edge_of(&self, from: &Corner, to: &Corner) -> Option<Feature> {
        let Self::Polyhedron(body) = self else { return None };
        let edge = body.edge_between(from.vertex?, to.vertex?)?;
        u32::try_from(edge).ok().map(Feature::Edge)
    }
}

impl Corner {
    /// The vertex that the corner is.
    pub(super) fn feature(&self) -> Option<Feature> {
        self.vertex.and_then(|v| u32::try_from(v).ok()).map(Feature::Vertex)
    }

    /// The corner seen from other axes.
    pub(super) fn moved(&self, pose: &Pose) -> Self {
        Self { at: pose.point(&self.at), ..*self }
    }
}
