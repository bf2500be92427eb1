//! Which feature of a polyhedron a point outside of it is nearest to, and the planes where that ends.
//!
//! ```text
//! face      above it, inside the walls on its edges
//! edge      between the walls at its ends, beyond the walls of both faces
//! vertex    beyond the ends of all edges that leave it
//! ```
//!
//! These are Voronoi regions outside of the polyhedron (Lin–Canny 1991 §3). A point within `slack` of a wall may count
//! as on either side: it belongs to the feature of more dimensions up to half of that behind the wall, and a motion is
//! said to leave a region where it is the whole of it behind.

use super::anchor::Wall;
use crate::math::Vector3;
use crate::shape::convex_polyhedron::ConvexPolyhedron;

/// A feature whose region holds a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Region {
    Face(usize),
    Edge(usize),
    Vertex(usize),
}

/// Cosine of the angle between a wall's normal and a line up to which the line counts as parallel to the wall [-], as in
/// the manifold.
const PARALLEL: f64 = 1.0e-7;

/// How what touches a polyhedron lies: as a point, or along a line of this direction, of which the walls that it crosses
/// cut off parts without ending the contact.
type Line<'a> = Option<&'a Vector3>;

fn runs_along(line: Line<'_>, wall: &Vector3) -> bool {
    line.is_none_or(|line| line.dot(wall).abs() <= PARALLEL)
}

impl Region {
    /// The region that holds a point, in the shape's axes from its centre.
    pub(super) fn of(shape: &ConvexPolyhedron, point: &Vector3, line: Line<'_>, slack: f64) -> Option<Self> {
        let corner = |v: usize| Vector3::from(shape.vertices_about_center()[v]);
        let inside = |h: usize| {
            let edge = &shape.half_edges()[h];
            let inward = Vector3::from(edge.inward);
            !runs_along(line, &inward) || inward.dot(&(point - corner(edge.origin as usize))) >= -0.5 * slack
        };
        let holds = |f: &usize| {
            let face = &shape.faces()[*f];
            let normal = Vector3::from(face.normal);
            normal.dot(point) > face.offset && runs_along(line, &normal) && shape.face_half_edges(*f).all(inside)
        };
        if let Some(f) = (0..shape.faces().len()).find(holds) {
            return Some(Self::Face(f));
        }

        // the nearest of the lines that run past it, and of the corners
        let mut nearest: Option<(f64, Self)> = None;
        let mut offer = |distance: f64, region: Self| {
            if nearest.is_none_or(|(least, _)| distance < least) {
                nearest = Some((distance, region));
            }
        };
        for (e, edge) in shape.edges().iter().enumerate() {
            let direction = Vector3::from(edge.direction);
            let from = point - corner(shape.edge_vertices(e)[0]);
            let along = direction.dot(&from);
            let runs_past = match line {
                Some(line) => line.cross(&direction).norm() <= PARALLEL,
                None => along >= -0.5 * slack && along <= edge.length + 0.5 * slack,
            };
            if runs_past {
                offer((from - along * direction).norm(), Self::Edge(e));
            }
        }
        if line.is_none() {
            for v in 0..shape.vertices_about_center().len() {
                offer((point - corner(v)).norm(), Self::Vertex(v));
            }
        }
        nearest.map(|(_, region)| region)
    }

    /// The walls of the region, in the shape's axes from its centre.
    pub(super) fn walls(self, shape: &ConvexPolyhedron, line: Line<'_>) -> Vec<Wall> {
        let corner = |v: usize| Vector3::from(shape.vertices_about_center()[v]);
        let through =
            |v: usize, normal: Vector3| Wall { of_b: false, normal, offset: normal.dot(&corner(v)), about: None };
        let inward = |h: usize| {
            let edge = &shape.half_edges()[h];
            through(edge.origin as usize, edge.inward.into())
        };
        let mut walls: Vec<Wall> = match self {
            Self::Face(f) => shape.face_half_edges(f).map(inward).collect(),
            Self::Edge(e) => {
                let direction = Vector3::from(shape.edges()[e].direction);
                let [from, to] = shape.edge_vertices(e);
                let outward = [2 * e, 2 * e + 1].map(|h| inward(h).turned_over());
                [through(from, direction), through(to, -direction)].into_iter().chain(outward).collect()
            }
            Self::Vertex(v) => {
                let backward = |&h: &u32| {
                    let direction = Vector3::from(shape.edges()[h as usize / 2].direction);
                    through(v, if h % 2 == 0 { -direction } else { direction })
                };
                shape.leaving(v).iter().map(backward).collect()
            }
        };
        walls.retain(|wall| runs_along(line, &wall.normal));
        walls
    }
}
