//! A body against a plane: the lecture's first collision (§7).
//!
//! ```text
//! gap = min over vertices v of  n·(R v + x) − d
//! ```
//!
//! Over a plane only the lowest vertex counts, so the body need not be convex. A ball has one point.

use crate::math::Vector3;
use crate::shape::{HalfSpace, Shape};
use crate::state::BodyMotion;

/// A plane in the world: the half space is where `normal·x ≤ offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal out of the half space, world axes.
    pub normal: Vector3,
    /// Distance of the plane from the world's origin along the normal [m].
    pub offset: f64,
}

impl Plane {
    /// The plane of a half space whose frame stands as the body does.
    pub fn new(half_space: &HalfSpace, motion: &BodyMotion) -> Self {
        let given = Vector3::from(half_space.normal);
        let length = given.norm();
        let normal = motion.rotation * (given / length);
        Self { normal, offset: half_space.offset / length + normal.dot(&motion.position) }
    }
}

/// What of a body can touch a plane first: points of its axes [m], from the centre of mass, with a
/// ball of `radius` [m] around each.
#[derive(Debug, Clone, PartialEq)]
pub struct Collider {
    points: Vec<Vector3>,
    radius: f64,
}

impl Collider {
    /// The collider of a shape whose centre of mass is at `center`, shape axes [m]; none for shapes
    /// that are neither ball nor bounded by flat faces.
    pub fn new(shape: &Shape, center: &Vector3) -> Option<Self> {
        match shape {
            Shape::Sphere(sphere) => Some(Self { points: vec![-center], radius: sphere.radius }),
            _ => shape
                .vertices()
                .map(|vertices| Self { points: vertices.iter().map(|v| v - center).collect(), radius: 0.0 }),
        }
    }

    /// Distance of the body from the plane [m]; negative where it overlaps.
    pub fn gap(&self, motion: &BodyMotion, plane: &Plane) -> f64 {
        let n = motion.rotation.tr_mul(&plane.normal);
        let lowest = self.points.iter().map(|p| n.dot(p)).fold(f64::INFINITY, f64::min);
        plane.normal.dot(&motion.position) - plane.offset + lowest - self.radius
    }

    /// The points of the body no further than `reach` [m] from the plane: place in the list of
    /// vertices, and the point of the body's surface, world axes [m].
    pub fn touching(&self, motion: &BodyMotion, plane: &Plane, reach: f64) -> Vec<(usize, Vector3)> {
        let surface = |p: &Vector3| motion.point(p) - self.radius * plane.normal;
        self.points
            .iter()
            .map(surface)
            .enumerate()
            .filter(|(_, p)| plane.normal.dot(p) - plane.offset <= reach)
            .collect()
    }

    /// What touches, in words.
    pub fn features(&self, touching: &[usize]) -> String {
        if self.radius > 0.0 {
            return "ball".to_owned();
        }
        let names: Vec<_> = touching.iter().map(ToString::to_string).collect();
        match names.as_slice() {
            [one] => format!("vertex {one}"),
            many => format!("centroid of vertices {}", many.join(", ")),
        }
    }
}
