//! Convex polyhedra: built once, never changed.
//!
//! The hull of the given points (see [`hull`](mod@crate::shape::hull)) with everything that a query of closest
//! features asks for:
//!
//! ```text
//! vertices   as given, and about the body's centre, so that a far origin costs no digits
//! ring       the neighbours of each vertex on the hull's triangles: hill climbing is exact on it
//! faces      polygons: coplanar triangles merged; unit normal, offset, and how far the polygon is from flat
//! half-edges two to an edge (twin = h ^ 1), each once around its face
//! planes     one per edge and end, one per half-edge: the walls between Voronoi regions, each stored
//!            once and used by both sides with opposite sign
//! ```
//!
//! Polygons, segments and points (rank 2, 1, 0) are convex polyhedra too: a polygon has two faces
//! back to back, a segment one edge and no face.

use std::collections::BTreeMap;

use crate::error::{Error, Result};
use crate::math::double_double::{DoubleDouble, Real};
use crate::shape::hull;
use crate::tolerance::{COORDINATE_MAX, COORDINATE_MIN, FACE_FLATNESS};

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
    ring_points: Vec<[f64; 3]>,
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
            ring_points: Vec::new(),
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

    /// The neighbours of a vertex with their coordinates about the centre, side by side in memory.
    #[inline]
    pub(crate) fn ring_points(&self, vertex: usize) -> impl Iterator<Item = (u32, &[f64; 3])> {
        let range = self.ring_start[vertex] as usize..self.ring_start[vertex + 1] as usize;
        self.ring[range.clone()].iter().copied().zip(&self.ring_points[range])
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
            let mut best = at;
            for (k, v) in self.ring_points(at) {
                let h = dot(v, direction);
                if h > height {
                    (height, best) = (h, k as usize);
                }
            }
            if best == at {
                return at;
            }
            at = best;
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

    /// The edge between two vertices, if there is one.
    pub fn edge_between(&self, from: usize, to: usize) -> Option<usize> {
        let range = self.leaving_start[from] as usize..self.leaving_start[from + 1] as usize;
        let k = self.leaving_to[range.clone()].iter().position(|&v| v as usize == to)?;
        Some((self.leaving[range.start + k] / 2) as usize)
    }

    /// Rings, half-edges, faces and the walls of the Voronoi regions.
    fn link(&mut self, triangles: &[[u32; 3]], loops: &[Vec<u32>]) {
        let count = self.about_center.len();
        let sides = |corners: &[u32]| {
            let n = corners.len();
            (0..n).map(|k| (corners[k], corners[(k + 1) % n])).collect::<Vec<_>>()
        };

        // rings: along the triangles of a solid, around a polygon, from end to end of a segment
        let mut pairs: Vec<(u32, u32)> = match self.rank {
            3 => triangles.iter().flat_map(|t| sides(t)).collect(),
            2 => loops.iter().flat_map(|l| sides(l)).collect(),
            1 => vec![(0, 1), (1, 0)],
            _ => Vec::new(),
        };
        pairs.sort_unstable();
        pairs.dedup();
        (self.ring_start, self.ring) = grouped(count, &pairs);
        self.ring_points = self.ring.iter().map(|&k| self.about_center[k as usize]).collect();

        // half-edges, the twins next to each other
        let mut half_edge_of: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let unlinked = HalfEdge { origin: NONE, next: NONE, face: None, inward: [0.0; 3] };
        let mut make = |half_edges: &mut Vec<HalfEdge>, from: u32, to: u32| {
            if let Some(&h) = half_edge_of.get(&(from, to)) {
                return h;
            }
            let h = u32::try_from(half_edges.len()).unwrap_or(NONE);
            half_edges.extend([from, to].map(|origin| HalfEdge { origin, ..unlinked }));
            half_edge_of.extend([((from, to), h), ((to, from), h + 1)]);
            h
        };
        if self.rank == 1 {
            let h = make(&mut self.half_edges, 0, 1) as usize;
            (self.half_edges[h].next, self.half_edges[h + 1].next) = (1, 0);
        }
        for (f, corners) in (0..).zip(loops) {
            let around: Vec<u32> = sides(corners).iter().map(|&(i, j)| make(&mut self.half_edges, i, j)).collect();
            for (&h, &next) in around.iter().zip(around.iter().cycle().skip(1)) {
                self.half_edges[h as usize].next = next;
                self.half_edges[h as usize].face = Some(f);
            }
            self.faces.push(self.face(corners, around[0]));
        }

        // walls: along each edge, and inwards from each half-edge
        for e in 0..self.half_edges.len() / 2 {
            let [i, j] = self.edge_vertices(e);
            let along = sub(&self.about_center[j], &self.about_center[i]);
            let length = norm(&along);
            self.edges.push(Edge { direction: along.map(|x| x / length), length });
        }
        for h in 0..self.half_edges.len() {
            let u = self.edges[h / 2].direction;
            let u = if h % 2 == 0 { u } else { u.map(|x| -x) };
            if let Some(f) = self.half_edges[h].face {
                self.half_edges[h].inward = unit(&cross(&self.faces[f as usize].normal, &u));
            }
        }

        // what meets in each vertex
        let mut meeting: Vec<(u32, u32)> = (0..).zip(loops).flat_map(|(f, l)| l.iter().map(move |&v| (v, f))).collect();
        meeting.sort_unstable();
        (self.faces_at_start, self.faces_at) = grouped(count, &meeting);
        let mut leaving: Vec<(u32, u32)> = self.half_edges.iter().zip(0..).map(|(h, k)| (h.origin, k)).collect();
        leaving.sort_unstable();
        (self.leaving_start, self.leaving) = grouped(count, &leaving);
        self.leaving_to = self.leaving.iter().map(|&h| self.half_edges[(h ^ 1) as usize].origin).collect();
    }

    /// The plane of a loop of vertices: its area vector (Newell), moved out to hold the whole body.
    fn face(&self, corners: &[u32], half_edge: u32) -> Face {
        let at = |k: usize| &self.about_center[corners[k] as usize];
        let area = (2..corners.len()).fold([0.0; 3], |sum, k| add(&sum, &area_vector(at(0), at(k - 1), at(k))));
        let normal = unit(&area);
        let height = |v: &[f64; 3]| dot(&normal, v);
        let offset = self.about_center.iter().map(height).fold(f64::MIN, f64::max);
        let lowest = corners.iter().map(|&k| height(&self.about_center[k as usize])).fold(f64::MAX, f64::min);
        Face {
            normal,
            offset,
            fit_error: offset - lowest,
            half_edge,
            sides: u32::try_from(corners.len()).unwrap_or(NONE),
        }
    }

    /// For large bodies, the farthest vertex for a grid of directions on a cube.
    fn seed(&mut self) {
        let cells = cells_per_side(self.about_center.len());
        let mut at = 0;
        let mut seeds = Vec::with_capacity(6 * cells * cells);
        for cell in 0..6 * cells * cells {
            at = self.climb(at, &cube_direction(cell, cells));
            seeds.push(u32::try_from(at).unwrap_or(0));
        }
        self.seeds = seeds;
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

/// Sorted pairs as a table: where each first member's entries start, and the second members.
fn grouped(count: usize, pairs: &[(u32, u32)]) -> (Vec<u32>, Vec<u32>) {
    let starts = (0..=count).map(|i| pairs.partition_point(|p| (p.0 as usize) < i));
    (starts.map(|k| u32::try_from(k).unwrap_or(NONE)).collect(), pairs.iter().map(|p| p.1).collect())
}

/// Triangles merged into polygons where they lie on one plane to within `flatness` [m]: each region
/// grows from its largest triangle. A region that is not bounded by one simple loop, or holds a vertex inside,
/// stays in triangles.
fn polygons(vertices: &[[f64; 3]], triangles: &[[u32; 3]], flatness: f64) -> Vec<Vec<u32>> {
    let at = |i: u32| &vertices[i as usize];
    let areas: Vec<[f64; 3]> = triangles.iter().map(|t| area_vector(at(t[0]), at(t[1]), at(t[2]))).collect();
    let owner: BTreeMap<(u32, u32), usize> =
        triangles.iter().enumerate().flat_map(|(f, t)| (0..3).map(move |k| ((t[k], t[(k + 1) % 3]), f))).collect();
    let mut largest_first: Vec<usize> = (0..triangles.len()).collect();
    largest_first.sort_by(|&f, &g| norm(&areas[g]).total_cmp(&norm(&areas[f])).then(f.cmp(&g)));

    let mut region = vec![usize::MAX; triangles.len()];
    let mut loops = Vec::new();
    for seed in largest_first {
        if region[seed] != usize::MAX {
            continue;
        }

        // the triangles around the seed that lie on its plane and face its way
        let (normal, origin) = (unit(&areas[seed]), at(triangles[seed][0]));
        let flat = |f: usize| triangles[f].iter().all(|&i| dot(&normal, &sub(at(i), origin)).abs() <= flatness);
        let mut members = vec![seed];
        region[seed] = seed;
        let mut k = 0;
        while k < members.len() {
            let t = triangles[members[k]];
            for side in 0..3 {
                let f = owner[&(t[(side + 1) % 3], t[side])];
                if region[f] == usize::MAX && dot(&normal, &areas[f]) > 0.0 && flat(f) {
                    region[f] = seed;
                    members.push(f);
                }
            }
            k += 1;
        }

        // the border: half-edges whose twin belongs to another region
        let sides = members.iter().flat_map(|&f| (0..3).map(move |k| (triangles[f][k], triangles[f][(k + 1) % 3])));
        let border: Vec<(u32, u32)> = sides.filter(|&(i, j)| region[owner[&(j, i)]] != seed).collect();
        let next: BTreeMap<u32, u32> = border.iter().copied().collect();
        let walk: Vec<u32> = match border.first() {
            Some(&(start, _)) => {
                let around = std::iter::successors(Some(start), |i| next.get(i).copied().filter(|&j| j != start));
                around.take(border.len()).collect()
            }
            None => Vec::new(),
        };
        // one loop, and no vertex inside it: of a body of aspect 1e15 everything looks flat
        let is_polygon = walk.len() >= 3 && members.len() == walk.len() - 2;
        if is_polygon && walk.len() == border.len() && next.len() == border.len() {
            loops.push(walk);
        } else {
            loops.extend(members.iter().map(|&f| triangles[f].to_vec()));
        }
    }
    loops
}

/// Cells along each side of the cube of directions; up to this many vertices a climb is short anyway.
fn cells_per_side(vertices: usize) -> usize {
    match vertices {
        0..24 => 0,
        24..96 => 2,
        96..384 => 4,
        384..1536 => 8,
        _ => 12,
    }
}

/// The cell of the cube of directions that a direction points through.
#[inline]
fn cube_cell(d: &[f64; 3], cells: usize) -> usize {
    let [x, y, z] = d.map(f64::abs);
    let axis = if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    };
    let scale = 0.5 * cells as f64 / d[axis].abs();
    // a direction of length zero or NaN has no cell; the cast makes it the first
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, then clamped")]
    let cell = |v: f64| ((v * scale + 0.5 * cells as f64) as usize).min(cells - 1);
    let side = 2 * axis + usize::from(d[axis] < 0.0);
    (side * cells + cell(d[(axis + 1) % 3])) * cells + cell(d[(axis + 2) % 3])
}

/// The direction through the middle of a cell.
fn cube_direction(cell: usize, cells: usize) -> [f64; 3] {
    let (side, u, v) = (cell / (cells * cells), cell / cells % cells, cell % cells);
    let middle = |k: usize| (2.0 * k as f64 + 1.0) / cells as f64 - 1.0;
    let axis = side / 2;
    let mut d = [0.0; 3];
    d[axis] = if side % 2 == 0 { 1.0 } else { -1.0 };
    d[(axis + 1) % 3] = middle(u);
    d[(axis + 2) % 3] = middle(v);
    d
}

#[inline]
fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sub(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn add(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(a: &[f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Twice the area of a triangle along its normal. The corners are taken apart in double-double: of a
/// sliver, whose sides are all but parallel, the product in `f64` would lose the normal.
fn area_vector(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> [f64; 3] {
    let (u, v) = (from_to(a, b), from_to(a, c));
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        (u[i] * v[j] - u[j] * v[i]).to_f64()
    })
}

fn from_to(a: &[f64; 3], b: &[f64; 3]) -> [DoubleDouble; 3] {
    std::array::from_fn(|k| DoubleDouble::sum(b[k], -a[k]))
}

/// The unit vector along `a`; of the zero vector the z axis.
fn unit(a: &[f64; 3]) -> [f64; 3] {
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let scaled = a.map(|x| x / largest); // areas of tiny triangles would underflow when squared
    let length = norm(&scaled);
    scaled.map(|x| x / length)
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
