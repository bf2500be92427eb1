//! Convex polygons in the plane, and their Voronoi regions.
//!
//! ```text
//! vertex v   the cone    { p : (p − v)·e_in ≥ 0 ≥ (p − v)·e_out }
//! edge v w   the strip   { p : (p − v)·e ≥ 0 ≥ (p − w)·e,  (p − v)·n ≥ 0 }
//! ```
//!
//! with `e` the edge's direction, `n` its outward normal (lecture §8, figure 10). The regions are closed and cover
//! the outside; neighbours share the ray between them.

use crate::error::{Error, Result};
use crate::math::double_double::DoubleDouble;
use crate::shape::hull::planar_hull;
use crate::tolerance::{COORDINATE_MAX, COORDINATE_MIN};

/// A convex polygon; of two vertices a segment, of one a point.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvexPolygon {
    vertices: Vec<[f64; 2]>,
    radius: f64,
}

/// A part of a polygon's border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PlanarFeature {
    /// A vertex, by its index.
    Vertex(usize),
    /// The edge that leaves the vertex of this index, counterclockwise.
    Edge(usize),
}

/// The outside points closer to a feature than to any other.
#[derive(Debug, Clone, PartialEq)]
pub struct VoronoiRegion {
    /// Whose region it is.
    pub feature: PlanarFeature,
    /// Where its border starts: the vertex, or both ends of the edge [m].
    pub base: Vec<[f64; 2]>,
    /// Unit directions in which its border leaves the first and the last base point. Of a lone point,
    /// whose region is the plane, none.
    pub rays: Vec<[f64; 2]>,
    walls: Vec<Wall>,
}

/// The half plane `(p − origin) · along ≥ 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Wall {
    origin: [f64; 2],
    from: [f64; 2],
    to: [f64; 2],
    kind: WallKind,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum WallKind {
    /// `along = to − from`.
    Forward,
    /// `along = from − to`.
    Backward,
    /// `along` is `to − from` turned to the right: outwards.
    Outward,
}

impl VoronoiRegion {
    /// Whether a point [m] is in the region, its border included. Decided in double-double: on the
    /// border both neighbours say yes.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        self.walls.iter().all(|wall| {
            let difference =
                |p: [f64; 2], q: [f64; 2]| [DoubleDouble::sum(q[0], -p[0]), DoubleDouble::sum(q[1], -p[1])];
            let [x, y] = difference(wall.origin, point);
            let [u, v] = difference(wall.from, wall.to);
            let [u, v] = match wall.kind {
                WallKind::Forward => [u, v],
                WallKind::Backward => [-u, -v],
                WallKind::Outward => [v, -u],
            };
            x * u + y * v >= DoubleDouble::default()
        })
    }
}

impl ConvexPolygon {
    /// The convex hull of points [m]: any number, repeated or on one line.
    ///
    /// # Errors
    /// No point, a coordinate that is not finite or beyond 1e30, or points that differ by less than 1e-30 in all.
    pub fn from_points(points: &[[f64; 2]]) -> Result<Self> {
        let refuse =
            |allowed: &str, value: &dyn std::fmt::Debug| Err(Error::value("convex polygon", "points", allowed, value));
        if points.is_empty() {
            return refuse("at least 1 point", &points.len());
        }
        if let Some(p) = points.iter().find(|p| p.iter().any(|x| x.is_nan() || x.abs() > COORDINATE_MAX)) {
            return refuse("finite and within ±1e30", p);
        }
        let vertices: Vec<[f64; 2]> = planar_hull(points).into_iter().map(|i| points[i]).collect();
        let span = vertices.iter().map(|v| (v[0] - vertices[0][0]).abs().max((v[1] - vertices[0][1]).abs()));
        let span = span.fold(0.0, f64::max);
        if span > 0.0 && span < COORDINATE_MIN {
            return refuse("at least 1e-30 across, or all equal", &span);
        }
        let radius = vertices.iter().map(|v| (v[0] * v[0] + v[1] * v[1]).sqrt()).fold(0.0, f64::max);
        Ok(Self { vertices, radius: radius * (1.0 + 4.0 * f64::EPSILON) })
    }

    /// The vertices, counterclockwise [m].
    pub fn vertices(&self) -> &[[f64; 2]] {
        &self.vertices
    }

    /// Radius of the disc about the origin of its axes that holds the polygon [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// How many edges: a segment has two, one for each side.
    pub fn edge_count(&self) -> usize {
        if self.vertices.len() == 1 { 0 } else { self.vertices.len() }
    }

    /// The indices of an edge's two vertices.
    pub fn edge(&self, edge: usize) -> [usize; 2] {
        [edge, (edge + 1) % self.vertices.len()]
    }

    /// The edge that enters a vertex.
    pub(crate) fn edge_into(&self, vertex: usize) -> usize {
        (vertex + self.vertices.len() - 1) % self.vertices.len()
    }

    /// The Voronoi regions of all vertices and edges, counterclockwise from the first vertex.
    pub fn voronoi_regions(&self) -> Vec<VoronoiRegion> {
        let count = self.vertices.len();
        if count == 1 {
            let feature = PlanarFeature::Vertex(0);
            return vec![VoronoiRegion { feature, base: self.vertices.clone(), rays: Vec::new(), walls: Vec::new() }];
        }
        let at = |i: usize| self.vertices[i];
        let normal = |edge: usize| {
            let ([ax, ay], [bx, by]) = (at(edge), at((edge + 1) % count));
            let (x, y) = (by - ay, ax - bx);
            let length = (x * x + y * y).sqrt();
            [x / length, y / length]
        };
        (0..count)
            .flat_map(|i| {
                let [before, after] = [self.edge_into(i), (i + 1) % count];
                let wall =
                    |origin, kind, edge: usize| Wall { origin, from: at(edge), to: at((edge + 1) % count), kind };
                let cone = VoronoiRegion {
                    feature: PlanarFeature::Vertex(i),
                    base: vec![at(i)],
                    rays: vec![normal(before), normal(i)],
                    walls: vec![wall(at(i), WallKind::Forward, before), wall(at(i), WallKind::Backward, i)],
                };
                let strip = VoronoiRegion {
                    feature: PlanarFeature::Edge(i),
                    base: vec![at(i), at(after)],
                    rays: vec![normal(i), normal(i)],
                    walls: vec![
                        wall(at(i), WallKind::Forward, i),
                        wall(at(after), WallKind::Backward, i),
                        wall(at(i), WallKind::Outward, i),
                    ],
                };
                [cone, strip]
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_cover_the_outside_and_share_their_borders() {
        let square =
            ConvexPolygon::from_points(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [0.0, 1.0]]).unwrap();
        let regions = square.voronoi_regions();
        assert_eq!(regions.len(), 8);
        let holders = |p: [f64; 2]| regions.iter().filter(|r| r.contains(p)).map(|r| r.feature).collect::<Vec<_>>();
        assert_eq!(holders([0.0, -3.0]), [PlanarFeature::Edge(0)]);
        assert_eq!(holders([2.0, -3.0]), [PlanarFeature::Vertex(1)]);
        // on the ray between them both say yes; inside none does
        assert_eq!(holders([1.0, -3.0]), [PlanarFeature::Edge(0), PlanarFeature::Vertex(1)]);
        assert_eq!(holders([0.25, 0.5]), []);
        assert_eq!(regions[2].rays, [[0.0, -1.0], [1.0, 0.0]]);
    }

    #[test]
    fn bad_points_are_refused_by_name() {
        let error = |points: &[[f64; 2]]| ConvexPolygon::from_points(points).unwrap_err().to_string();
        assert!(error(&[]).contains("points must be at least 1 point"));
        assert!(error(&[[f64::INFINITY, 0.0]]).contains("finite"));
        assert!(error(&[[0.0, 0.0], [1e-40, 0.0]]).contains("1e-30"));
    }
}
