//! Convex polyhedra: built once, never changed.
//!
//! The hull of the given points (see [`hull`](mod@crate::shape::hull)) with everything that a query of closest
//! features asks for:
//!
//! ```text
//! vertices   as given, and about the body's centre, so that a far origin costs no digits
//! ring       the neighbours of each vertex on the hull's triangles, in fours with their coordinates: hill
//!            climbing is exact on it
//! faces      polygons: coplanar triangles merged; unit normal, offset, and how far the polygon is from flat
//! half-edges two to an edge (twin = h ^ 1), each once around its face
//! planes     one per edge and end, one per half-edge: the walls between Voronoi regions, each stored
//!            once and used by both sides with opposite sign
//! ```
//!
//! Polygons, segments and points (rank 2, 1, 0) are convex polyhedra too: a polygon has two faces
//! back to back, a segment one edge and no face.

mod blocks;
mod directions;
mod link;
mod polygons;
mod vector;

use crate::error::{Error, Result};
use crate::shape::hull;
use crate::tolerance::{COORDINATE_MAX, COORDINATE_MIN, FACE_FLATNESS};
pub(crate) use blocks::{Block, highest, others_reach, top_of};
use directions::{cells_per_side, cube_cell};
use polygons::polygons;
use vector::{add, area_vector, dot, norm, sub, unit};

/// Up to this many vertices all are looked at, which costs no more than climbing.
pub(crate) const SCAN: usize = 16;

/// No such index.
const NONE: u32 = u32::MAX;

/// A convex polyhedron; see the [module](self).
#[derive(Debug, Clone, PartialEq)]
pub struct ConvexPolyhedron {
    rank: usize,
    center: [f64; 3],
    radius: f64,
    vertices: Vec<[f64; 3]>,
    about_center: Vec<[f64; 3]>,
    sources: Vec<u32>,
    ring_start: Vec<u32>,
    ring: Vec<u32>,
    blocks: Vec<Block>,
    ring_block_start: Vec<u32>,
    ring_blocks: Vec<Block>,
    faces: Vec<Face>,
    half_edges: Vec<HalfEdge>,
    edges: Vec<Edge>,
    faces_at_start: Vec<u32>,
    faces_at: Vec<u32>,
    leaving_start: Vec<u32>,
    leaving: Vec<u32>,
    leaving_to: Vec<u32>,
    seeds: Vec<u32>,
}

/// A polygonal face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Outward unit normal, body axes.
    pub normal: [f64; 3],
    /// Largest `normal · v` over all vertices about the centre [m]: the body is on the inner side.
    pub offset: f64,
    /// How far the face's lowest vertex lies under that plane [m]: 0 up to rounding.
    pub fit_error: f64,
    /// One of its half-edges.
    pub half_edge: u32,
    /// How many sides it has.
    pub sides: u32,
}

/// An edge seen from one of its two faces; its twin is the one with the index `h ^ 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfEdge {
    /// The vertex it leaves.
    pub origin: u32,
    /// The next one counterclockwise around the face.
    pub next: u32,
    /// The face to its left, none for a segment.
    pub face: Option<u32>,
    /// Normal of the wall between the regions of the edge and of the face: unit, in the face's plane,
    /// towards its inside, body axes.
    pub inward: [f64; 3],
}

/// What the two half-edges `2 e` and `2 e + 1` share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// From the origin of half-edge `2 e` to that of `2 e + 1`: unit, body axes. It is also the normal
    /// of the walls between the regions of the edge and of its two ends.
    pub direction: [f64; 3],
    /// Length [m].
    pub length: f64,
}

impl ConvexPolyhedron {
    /// The convex hull of points [m, body axes]: any number, repeated, on one plane, line or spot.
    ///
    /// # Errors
    /// No point at all, a coordinate that is not finite or beyond 1e30, or points that differ by less
    /// than 1e-30 in all.
    pub fn from_points(points: &[[f64; 3]]) -> Result<Self> {
        let refuse = |allowed: &str, value: &dyn std::fmt::Debug| {
            Err(Error::value("convex polyhedron", "points", allowed, value))
        };
        if points.is_empty() || u32::try_from(points.len()).is_err() {
            return refuse("between 1 and 2³²−1 points", &points.len());
        }
        if let Some(p) = points.iter().find(|p| p.iter().any(|x| x.is_nan() || x.abs() > COORDINATE_MAX)) {
            return refuse("finite and within ±1e30", p);
        }

        // the centre: the origin where that is near, so that the coordinates stay as given
        let center = center_of(points);
        let reach = |about: &[f64; 3]| points.iter().map(|p| norm(&sub(p, about))).fold(0.0, f64::max);
        let span = reach(&center);
        if span > 0.0 && span < COORDINATE_MIN {
            return refuse("at least 1e-30 across, or all equal", &span);
        }

        // a coordinate 1e-40 times smaller than the body is below every rounding, and would underflow
        let given: Vec<[f64; 3]> =
            points.iter().map(|p| p.map(|x| if x.abs() < 1e-40 * span { 0.0 } else { x })).collect();
        let hull = hull::hull(&given);
        let about_center: Vec<[f64; 3]> = hull.vertices.iter().map(|&i| sub(&given[i], &center)).collect();
        let radius = about_center.iter().map(norm).fold(0.0, f64::max) * (1.0 + 4.0 * f64::EPSILON);

        // triangles and rings in terms of the kept vertices
        let mut kept = vec![NONE; points.len()];
        for (k, &i) in (0..).zip(&hull.vertices) {
            kept[i] = k;
        }
        let triangles: Vec<[u32; 3]> = hull.triangles.iter().map(|t| t.map(|i| kept[i])).collect();
        let loops = match hull.rank {
            3 => polygons(&about_center, &triangles, FACE_FLATNESS * radius),
            2 => {
                let front: Vec<u32> = (0..).take(about_center.len()).collect();
                let back = front.iter().rev().copied().collect();
                vec![front, back]
            }
            _ => Vec::new(),
        };

        let mut body = Self {
            rank: hull.rank,
            center,
            radius,
            vertices: hull.vertices.iter().map(|&i| given[i]).collect(),
            sources: hull.vertices.iter().map(|&i| u32::try_from(i).unwrap_or(NONE)).collect(),
            about_center,
            ring_start: Vec::new(),
            ring: Vec::new(),
            blocks: Vec::new(),
            ring_block_start: Vec::new(),
            ring_blocks: Vec::new(),
            faces: Vec::new(),
            half_edges: Vec::new(),
            edges: Vec::new(),
            faces_at_start: Vec::new(),
            faces_at: Vec::new(),
            leaving_start: Vec::new(),
            leaving: Vec::new(),
            leaving_to: Vec::new(),
            seeds: Vec::new(),
        };
        body.link(&triangles, &loops);
        body.seed();
        Ok(body)
    }

    /// The polyhedron with these vertices and faces (loops of vertex indices, counterclockwise seen
    /// from outside), provided that it is convex.
    ///
    /// # Errors
    /// Those of [`ConvexPolyhedron::from_points`]; a face that names a vertex which is not there, or
    /// that has a vertex in front of it.
    pub fn from_faces(vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> Result<Self> {
        let body = Self::from_points(vertices)?;
        for (f, corners) in faces.iter().enumerate() {
            if let Some(&k) = corners.iter().find(|&&k| k >= vertices.len()) {
                return Err(Error::mesh(
                    "convex polyhedron",
                    format!("face {f} names vertex {k}, of {}", vertices.len()),
                ));
            }
            let Some((&first, rest)) = corners.split_first() else { continue };
            let corner =
                |sum, pair: &[usize]| add(&sum, &area_vector(&vertices[first], &vertices[pair[0]], &vertices[pair[1]]));
            let area = rest.windows(2).fold([0.0; 3], corner);
            let (normal, length) = (unit(&area), norm(&area));
            let height = |p: &[f64; 3]| dot(&normal, &sub(p, &vertices[first]));
            let front = vertices.iter().enumerate().max_by(|p, q| height(p.1).total_cmp(&height(q.1)));
            if let Some((k, p)) = front.filter(|(_, p)| length > 0.0 && height(p) > FACE_FLATNESS * body.radius) {
                let reason = format!(
                    "face {f} has vertex {k} in front of it by {:.3e} m, so the solid is not convex: \
                     give a compound of convex pieces, or its hull",
                    height(p)
                );
                return Err(Error::mesh("convex polyhedron", reason));
            }
        }
        Ok(body)
    }

    /// Dimension: 3 a solid, 2 a polygon, 1 a segment, 0 a point.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// The point that all inner coordinates are taken about [m, body axes].
    pub fn center(&self) -> [f64; 3] {
        self.center
    }

    /// Whether the centre is the origin of the body's axes, so that it needs no turning.
    #[inline]
    pub(crate) fn is_about_origin(&self) -> bool {
        self.center.iter().all(|&x| x == 0.0)
    }

    /// Radius of the ball about [`center`](Self::center) that holds the body [m].
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The vertices as they were given [m, body axes]; coordinates below 1e-40 of the body's size are 0.
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// The vertices about the centre [m, body axes].
    pub fn vertices_about_center(&self) -> &[[f64; 3]] {
        &self.about_center
    }

    /// For each vertex its index among the points that the hull was built from.
    pub fn sources(&self) -> &[u32] {
        &self.sources
    }

    /// The neighbours of a vertex on the triangulated surface.
    #[inline]
    pub fn ring(&self, vertex: usize) -> &[u32] {
        &self.ring[self.ring_start[vertex] as usize..self.ring_start[vertex + 1] as usize]
    }

    /// All vertices in fours.
    #[inline]
    pub(crate) fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The neighbours of a vertex in fours.
    #[inline]
    pub(crate) fn ring_blocks(&self, vertex: usize) -> &[Block] {
        &self.ring_blocks[self.ring_block_start[vertex] as usize..self.ring_block_start[vertex + 1] as usize]
    }

    /// The faces.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// The faces that meet in a vertex.
    pub fn faces_at(&self, vertex: usize) -> &[u32] {
        &self.faces_at[self.faces_at_start[vertex] as usize..self.faces_at_start[vertex + 1] as usize]
    }

    /// The half-edges that leave a vertex.
    pub fn leaving(&self, vertex: usize) -> &[u32] {
        &self.leaving[self.leaving_start[vertex] as usize..self.leaving_start[vertex + 1] as usize]
    }

    /// The half-edges, those of edge `e` at `2 e` and `2 e + 1`.
    pub fn half_edges(&self) -> &[HalfEdge] {
        &self.half_edges
    }

    /// The edges.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The two vertices of an edge.
    pub fn edge_vertices(&self, edge: usize) -> [usize; 2] {
        [self.half_edges[2 * edge].origin as usize, self.half_edges[2 * edge + 1].origin as usize]
    }

    /// The vertices of a face, counterclockwise seen from outside.
    pub fn face_vertices(&self, face: usize) -> impl Iterator<Item = usize> {
        self.face_half_edges(face).map(|h| self.half_edges[h].origin as usize)
    }

    /// The half-edges around a face.
    pub fn face_half_edges(&self, face: usize) -> impl Iterator<Item = usize> {
        let Face { half_edge, sides, .. } = self.faces[face];
        let next = |&h: &usize| Some(self.half_edges[h].next as usize);
        std::iter::successors(Some(half_edge as usize), next).take(sides as usize)
    }

    /// A vertex that lies farthest in a direction of the body's axes.
    pub fn support(&self, direction: [f64; 3]) -> usize {
        self.climb(self.seed_for(&direction), &direction)
    }

    /// Climbs from neighbour to neighbour while that leads farther along `direction`. No vertex is
    /// visited twice, since the height rises strictly.
    #[inline]
    pub(crate) fn climb(&self, from: usize, direction: &[f64; 3]) -> usize {
        let mut at = from;
        let mut height = dot(&self.about_center[at], direction);
        loop {
            let (next, h) = highest(self.ring_blocks(at), direction);
            if h <= height {
                return at;
            }
            (at, height) = (next as usize, h);
        }
    }

    /// A vertex near the farthest one, from the table of directions.
    #[inline]
    pub(crate) fn seed_for(&self, direction: &[f64; 3]) -> usize {
        if self.seeds.is_empty() {
            return 0;
        }
        self.seeds[cube_cell(direction, cells_per_side(self.about_center.len()))] as usize
    }

    /// The face of a solid that has these three vertices and no more, if there is one.
    #[inline]
    pub(crate) fn triangle(&self, corners: &[u32]) -> Option<u32> {
        let &[i, j, k, ..] = corners else { return None };
        if self.rank < 3 {
            return None;
        }
        let range = self.leaving_start[i as usize] as usize..self.leaving_start[i as usize + 1] as usize;
        let side = self.leaving_to[range.clone()].iter().position(|&v| v == j)?;
        let h = self.leaving[range.start + side];
        [h, h ^ 1].into_iter().find_map(|h| {
            let last = self.half_edges[self.half_edges[h as usize].next as usize];
            let third = self.half_edges[last.next as usize];
            let closes = third.next == h && third.origin == k;
            last.face.filter(|_| closes)
        })
    }

    /// The edge between two vertices, if there is one.
    pub fn edge_between(&self, from: usize, to: usize) -> Option<usize> {
        let range = self.leaving_start[from] as usize..self.leaving_start[from + 1] as usize;
        let k = self.leaving_to[range.clone()].iter().position(|&v| v as usize == to)?;
        Some((self.leaving[range.start + k] / 2) as usize)
    }
}

/// The middle of the points' bounding box, or the origin where that is as good as inside the box.
fn center_of(points: &[[f64; 3]]) -> [f64; 3] {
    let low: [f64; 3] = std::array::from_fn(|k| points.iter().map(|p| p[k]).fold(f64::MAX, f64::min));
    let high: [f64; 3] = std::array::from_fn(|k| points.iter().map(|p| p[k]).fold(f64::MIN, f64::max));
    let middle = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
    let half_diagonal = 0.5 * norm(&sub(&high, &low));
    if norm(&middle) <= 0.5 * half_diagonal { [0.0; 3] } else { middle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn box_of(h: [f64; 3]) -> ConvexPolyhedron {
        let corners: Vec<[f64; 3]> =
            (0..8).map(|k| std::array::from_fn(|i| if k >> i & 1 == 0 { -h[i] } else { h[i] })).collect();
        ConvexPolyhedron::from_points(&corners).unwrap()
    }

    /// Euler's formula, twins, loops, and every wall where it belongs.
    fn assert_is_linked(body: &ConvexPolyhedron) {
        let (v, e, f) = (body.about_center.len(), body.edges.len(), body.faces.len());
        assert_eq!(v + f, e + 2, "Euler's formula: {v} vertices, {e} edges, {f} faces");
        for (h, half) in body.half_edges.iter().enumerate() {
            let end = body.half_edges[h ^ 1].origin;
            assert_eq!(body.half_edges[half.next as usize].origin, end);
            assert_eq!(body.half_edges[half.next as usize].face, half.face);
            assert!(body.ring(half.origin as usize).contains(&end));
            let normal = body.faces[half.face.unwrap() as usize].normal;
            assert!(dot(&normal, &half.inward).abs() < 1e-15);
        }
        for (f, face) in body.faces.iter().enumerate() {
            assert!(face.fit_error <= 2.0 * FACE_FLATNESS * body.radius, "{:e}", face.fit_error / body.radius);
            for h in body.face_half_edges(f) {
                let origin = &body.about_center[body.half_edges[h].origin as usize];
                for corner in body.face_vertices(f) {
                    let inside = dot(&body.half_edges[h].inward, &sub(&body.about_center[corner], origin));
                    assert!(inside >= -1e-9 * body.radius, "a face is not convex: {inside}");
                }
            }
        }
    }

    #[test]
    fn boxes_have_six_faces_however_thin_or_turned() {
        for h in [[1.0; 3], [1.0, 1.0, 1e-6], [84.0, 0.001, 84.0], [1e-6, 1.0, 1e-6]] {
            let body = box_of(h);
            assert_eq!((body.about_center.len(), body.edges.len(), body.faces.len()), (8, 12, 6), "{h:?}");
            assert_is_linked(&body);
            let q = crate::math::Pose::new([0.0; 3], [0.3, -0.5, 0.7, 0.4]);
            let turned: Vec<[f64; 3]> = body.vertices.iter().map(|&p| q.point(&p.into()).into()).collect();
            let turned = ConvexPolyhedron::from_points(&turned).unwrap();
            assert_eq!((turned.vertices.len(), turned.edges.len(), turned.faces.len()), (8, 12, 6), "turned {h:?}");
            assert_is_linked(&turned);
        }
    }

    #[test]
    fn polygons_segments_and_points_are_bodies_too() {
        let square =
            ConvexPolyhedron::from_points(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]).unwrap();
        assert_eq!((square.rank, square.edges.len(), square.faces.len()), (2, 4, 2));
        assert_eq!(square.faces[0].normal, [0.0, 0.0, 1.0]);
        assert_eq!(square.faces[1].normal, [0.0, 0.0, -1.0]);
        assert_is_linked(&square);
        let segment = ConvexPolyhedron::from_points(&[[0.0; 3], [1.0, 2.0, 2.0], [0.5, 1.0, 1.0]]).unwrap();
        assert_eq!((segment.rank, segment.edges.len(), segment.edges[0].length), (1, 1, 3.0));
        assert_eq!(segment.edge_between(1, 0), Some(0));
        let point = ConvexPolyhedron::from_points(&[[5.0, 6.0, 7.0]]).unwrap();
        assert_eq!((point.rank, point.radius, point.center), (0, 0.0, [5.0, 6.0, 7.0]));
    }

    #[test]
    fn a_far_origin_costs_no_digits() {
        let far = 9e4;
        let corners: Vec<[f64; 3]> =
            (0..8).map(|k| std::array::from_fn(|i| far + if k >> i & 1 == 0 { -1.0 } else { 1.0 })).collect();
        let body = ConvexPolyhedron::from_points(&corners).unwrap();
        assert_eq!(body.center, [far; 3]);
        assert!(body.about_center.iter().flatten().all(|x| x.abs() == 1.0));
        assert_eq!(body.vertices(), corners);
    }

    #[test]
    fn bad_points_are_refused_by_name() {
        let error = |points: &[[f64; 3]]| ConvexPolyhedron::from_points(points).unwrap_err().to_string();
        assert!(error(&[]).contains("points must be between 1 and"));
        assert!(error(&[[f64::NAN, 0.0, 0.0]]).contains("finite and within ±1e30, got [NaN"));
        assert!(error(&[[0.0; 3], [1e31, 0.0, 0.0]]).contains("finite"));
        assert!(error(&[[0.0; 3], [1e-40, 0.0, 0.0]]).contains("at least 1e-30 across"));
    }

    #[test]
    fn a_dent_is_refused_with_its_face() {
        let tetrahedron = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.2, 0.2]];
        let faces = [vec![0, 2, 1], vec![0, 1, 3], vec![0, 3, 2], vec![1, 2, 4], vec![2, 3, 4], vec![3, 1, 4]];
        let error = ConvexPolyhedron::from_faces(&tetrahedron, &faces).unwrap_err().to_string();
        assert!(error.contains("face 3 has vertex 3 in front of it") && error.contains("compound"), "{error}");
        let convex = [vec![0, 2, 1], vec![0, 1, 3], vec![0, 3, 2], vec![1, 2, 3]];
        assert!(ConvexPolyhedron::from_faces(&tetrahedron[..4], &convex).is_ok());
        assert!(
            ConvexPolyhedron::from_faces(&tetrahedron, &[vec![0, 1, 9]]).unwrap_err().to_string().contains("vertex 9")
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn climbing_finds_the_farthest_vertex(
            cloud in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 4..400),
            d in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let round: Vec<[f64; 3]> = cloud.iter().map(unit).collect();
            let body = ConvexPolyhedron::from_points(&round).unwrap();
            assert_is_linked(&body);
            let best = body.about_center.iter().map(|v| dot(v, &d)).fold(f64::MIN, f64::max);
            let found = dot(&body.about_center[body.support(d)], &d);
            prop_assert!(found >= best - 4.0 * f64::EPSILON, "{found} {best}");
        }
    }
}
