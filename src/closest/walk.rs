//! Lin–Canny in space: the walk over the Voronoi regions of vertices, edges and faces (Lin and Canny
//! 1991; lecture §8).
//!
//! ```text
//! V(vertex)  behind the wall of each edge that leaves it
//! V(edge)    between the walls of its ends, outside the walls of its two faces
//! V(face)    above it, inside the walls of its edges
//! ```
//!
//! A pair of features is *settled* where the closest points lie inside both: vertex–vertex,
//! vertex–edge, edge–edge, vertex–face. From a settled pair the walk looks for a violated wall, takes the
//! neighbour across it, settles the new pair, and goes there only if the distance has fallen. So no pair
//! returns, whatever rounding says of the walls: regions are closed, parallel features settle on the
//! lower-dimensional member. A vertex behind a face is where a local minimum can be: the face that the
//! vertex is highest over leads out, or there is none and the bodies overlap.
//!
//! The walk proves nothing itself. It hands over the vertices that carry its points, and the search
//! checks them with one look around.

use super::Feature;
use super::pair::{Difference, Ids, Pair};
use super::simplex::Simplex;
use super::vector::Vec3;
use Feature::{Edge, Face, Surface, Vertex};

/// Moves after which the walk hands over to the search [-]: coherent motion needs 1 to 4.
const MOVES: u32 = 32;

type V = Vec3<f64>;

/// Two features with their closest points, about the centre of A, world axes.
#[derive(Debug, Clone, Copy)]
struct Settled {
    features: [Feature; 2],
    points: [V; 2],
    square: f64,
}

/// One of the two bodies, and how the world is seen from it.
#[derive(Debug, Clone, Copy)]
enum Side {
    A,
    B,
}

struct Walk<'p> {
    pair: &'p Pair<'p, f64>,
}

/// Walks from a pair of features to the pair that no wall leads away from. The vertices that carry its
/// closest points are given; none where the bodies overlap or the moves ran out.
pub(super) fn walk(pair: &Pair<'_, f64>, start: [Feature; 2], steps: &mut u32) -> Option<Simplex<f64>> {
    let walk = Walk { pair };
    let mut now = walk.settle(start)?;
    for _ in 0..MOVES {
        *steps += 1;
        match walk.next(&now) {
            Next::Moves(next) => now = next,
            Next::Stays => return Some(walk.carriers(&now)),
            Next::Overlaps => return None,
        }
    }
    None
}

enum Next {
    Moves(Settled),
    Stays,
    Overlaps,
}

impl Walk<'_> {
    fn body(&self, side: Side) -> &crate::shape::convex_polyhedron::ConvexPolyhedron {
        match side {
            Side::A => self.pair.a,
            Side::B => self.pair.b,
        }
    }

    fn vertex(&self, side: Side, i: u32) -> V {
        match side {
            Side::A => self.pair.point_a(i),
            Side::B => self.pair.point_b(i) + self.pair.between,
        }
    }

    /// A point of the world in a body's axes, about its centre.
    fn seen_from(&self, side: Side, p: &V) -> V {
        match side {
            Side::A => self.pair.in_axes_of_a(p),
            Side::B => self.pair.in_axes_of_b(&(*p - self.pair.between)),
        }
    }

    /// The body's own coordinates of a vertex.
    fn local(&self, side: Side, i: u32) -> V {
        Vec3(self.body(side).vertices_about_center()[i as usize])
    }

    fn ends(&self, side: Side, e: u32) -> [u32; 2] {
        let half_edges = self.body(side).half_edges();
        [half_edges[2 * e as usize].origin, half_edges[2 * e as usize + 1].origin]
    }

    /// The move over the most violated wall that shortens the distance.
    fn next(&self, now: &Settled) -> Next {
        let [p, q] = now.points;
        let sides = [(0, Side::A, q), (1, Side::B, p)];
        for (k, side, other_point) in sides {
            let across = match now.features[k] {
                Surface(_) => None,
                Vertex(i) => self.edge_across(side, i, &other_point).map(Edge),
                Edge(e) => self.face_across(side, e, &other_point).map(Face),
                Face(f) => {
                    let (highest, height) = self.highest_face(side, f, &other_point);
                    if height <= 0.0 {
                        return Next::Overlaps;
                    }
                    (highest != f).then_some(Face(highest))
                }
            };
            let Some(feature) = across else { continue };
            let mut features = now.features;
            features[k] = feature;
            let jumps = matches!(now.features[k], Face(_));
            if let Some(next) = self.settle(features)
                && (next.square < now.square || jumps)
            {
                return Next::Moves(next);
            }
        }
        Next::Stays
    }

    /// The edge of a vertex whose wall a point has crossed farthest.
    fn edge_across(&self, side: Side, i: u32, p: &V) -> Option<u32> {
        let (body, d) = (self.body(side), self.seen_from(side, p) - self.local(side, i));
        let mut best = (0.0, None);
        for &h in body.leaving(i as usize) {
            let u = Vec3(body.edges()[h as usize / 2].direction);
            let beyond = if h % 2 == 0 { u.dot(&d) } else { -u.dot(&d) };
            if beyond > best.0 {
                best = (beyond, Some(h / 2));
            }
        }
        best.1
    }

    /// The face of an edge whose wall a point has crossed farther.
    fn face_across(&self, side: Side, e: u32, p: &V) -> Option<u32> {
        let body = self.body(side);
        let d = self.seen_from(side, p) - self.local(side, self.ends(side, e)[0]);
        let mut best = (0.0, None);
        for half in &body.half_edges()[2 * e as usize..2 * e as usize + 2] {
            let beyond = Vec3(half.inward).dot(&d);
            if let Some(f) = half.face
                && beyond > best.0
            {
                best = (beyond, Some(f));
            }
        }
        best.1
    }

    /// This face, if the point is above it; else the face that the point is highest over.
    fn highest_face(&self, side: Side, f: u32, p: &V) -> (u32, f64) {
        let (body, d) = (self.body(side), self.seen_from(side, p));
        let height = |face: &crate::shape::convex_polyhedron::Face| Vec3(face.normal).dot(&d) - face.offset;
        let own = height(&body.faces()[f as usize]);
        if own > 0.0 {
            return (f, own);
        }
        let heights = (0..).zip(body.faces()).map(|(k, face)| (k, height(face)));
        heights.fold((f, own), |best, x| if x.1 > best.1 { x } else { best })
    }

    /// The pair of lower features that carries the closest points; none where an edge pierces a face.
    fn settle(&self, features: [Feature; 2]) -> Option<Settled> {
        let pairs = match features {
            [Vertex(i), Vertex(j)] => {
                let points = [self.vertex(Side::A, i), self.vertex(Side::B, j)];
                return Some(Settled { features, points, square: (points[1] - points[0]).norm_squared() });
            }
            [Vertex(i), Edge(e)] => return Some(self.segments([i, i], self.ends(Side::B, e), features)),
            [Edge(e), Vertex(j)] => return Some(self.segments(self.ends(Side::A, e), [j, j], features)),
            [Edge(e), Edge(f)] => return Some(self.segments(self.ends(Side::A, e), self.ends(Side::B, f), features)),
            [Vertex(i), Face(f)] => {
                if let Some(settled) = self.over_face(Side::B, f, i) {
                    return Some(settled);
                }
                self.edges_of(Side::B, f).map(|e| [Vertex(i), Edge(e)]).collect::<Vec<_>>()
            }
            [Face(f), Vertex(j)] => {
                if let Some(settled) = self.over_face(Side::A, f, j) {
                    return Some(settled);
                }
                self.edges_of(Side::A, f).map(|e| [Edge(e), Vertex(j)]).collect()
            }
            [Edge(e), Face(f)] => {
                let ends = self.ends(Side::A, e).map(|i| [Vertex(i), Face(f)]);
                if self.pierces(Side::B, f, self.ends(Side::A, e)) {
                    return None;
                }
                self.edges_of(Side::B, f).map(|g| [Edge(e), Edge(g)]).chain(ends).collect()
            }
            [Face(f), Edge(e)] => {
                let ends = self.ends(Side::B, e).map(|j| [Face(f), Vertex(j)]);
                if self.pierces(Side::A, f, self.ends(Side::B, e)) {
                    return None;
                }
                self.edges_of(Side::A, f).map(|g| [Edge(g), Edge(e)]).chain(ends).collect()
            }
            [Face(f), Face(_)] => {
                let corner = self.body(Side::A).face_vertices(f as usize).next()?;
                vec![[Vertex(u32::try_from(corner).ok()?), features[1]]]
            }
            [Surface(_), _] | [_, Surface(_)] => return None, // polyhedra have none
        };
        let settled = pairs.into_iter().filter_map(|pair| match pair {
            [Vertex(i), Face(f)] => self.over_face(Side::B, f, i),
            [Face(f), Vertex(j)] => self.over_face(Side::A, f, j),
            pair => self.settle(pair),
        });
        settled.reduce(|best, x| if x.square < best.square { x } else { best })
    }

    fn edges_of(&self, side: Side, f: u32) -> impl Iterator<Item = u32> {
        self.body(side).face_half_edges(f as usize).map(|h| u32::try_from(h / 2).unwrap_or(u32::MAX))
    }

    /// A vertex of the other body over or behind a face, inside the walls of its edges.
    fn over_face(&self, side: Side, f: u32, other: u32) -> Option<Settled> {
        let body = self.body(side);
        let other_side = if matches!(side, Side::A) { Side::B } else { Side::A };
        let p = self.vertex(other_side, other);
        let d = self.seen_from(side, &p);
        let is_outside = |h: usize| {
            let half = &body.half_edges()[h];
            Vec3(half.inward).dot(&(d - self.local(side, half.origin))) < 0.0
        };
        if body.face_half_edges(f as usize).any(is_outside) {
            return None;
        }
        let face = &body.faces()[f as usize];
        let height = Vec3(face.normal).dot(&d) - face.offset;
        let n = self.pair.rotations.rotate(usize::from(matches!(side, Side::B)), &Vec3(face.normal));
        let foot = p - n.scaled(height);
        let (features, points) = match side {
            Side::A => ([Face(f), Vertex(other)], [foot, p]),
            Side::B => ([Vertex(other), Face(f)], [p, foot]),
        };
        Some(Settled { features, points, square: height * height })
    }

    /// Whether an edge of the other body goes through a face.
    fn pierces(&self, side: Side, f: u32, ends: [u32; 2]) -> bool {
        let body = self.body(side);
        let other_side = if matches!(side, Side::A) { Side::B } else { Side::A };
        let [p, q] = ends.map(|i| self.seen_from(side, &self.vertex(other_side, i)));
        let face = &body.faces()[f as usize];
        let (h, k) = (Vec3(face.normal).dot(&p) - face.offset, Vec3(face.normal).dot(&q) - face.offset);
        if (h > 0.0) == (k > 0.0) {
            return false;
        }
        let through = p + (q - p).scaled(h / (h - k));
        body.face_half_edges(f as usize).all(|h| {
            let half = &body.half_edges()[h];
            Vec3(half.inward).dot(&(through - self.local(side, half.origin))) >= 0.0
        })
    }

    /// Two segments, or a point where both ends are the same vertex (Ericson 2005, §5.1.9).
    fn segments(&self, [i, j]: [u32; 2], [k, l]: [u32; 2], features: [Feature; 2]) -> Settled {
        let (a, b) = (self.vertex(Side::A, i), self.vertex(Side::B, k));
        let u = if i == j { Vec3([0.0; 3]) } else { self.vertex(Side::A, j) - a };
        let v = if k == l { Vec3([0.0; 3]) } else { self.vertex(Side::B, l) - b };
        let w = a - b;
        let (uu, vv, uv, uw, vw) = (u.dot(&u), v.dot(&v), u.dot(&v), u.dot(&w), v.dot(&w));
        let ratio = |x: f64, y: f64| if y > 0.0 { (x / y).clamp(0.0, 1.0) } else { 0.0 };

        // the common normal if there is one, then each parameter against the other
        let mut s = ratio(uv * vw - uw * vv, uu * vv - uv * uv);
        let mut t = (uv * s + vw) / if vv > 0.0 { vv } else { 1.0 };
        if t <= 0.0 || vv == 0.0 {
            (s, t) = (ratio(-uw, uu), 0.0);
        } else if t >= 1.0 {
            (s, t) = (ratio(uv - uw, uu), 1.0);
        }
        let points = [a + u.scaled(s), b + v.scaled(t)];
        let end = |parameter: f64, [from, to]: [u32; 2], feature: Feature| match feature {
            Edge(_) if parameter <= 0.0 => Vertex(from),
            Edge(_) if parameter >= 1.0 => Vertex(to),
            feature => feature,
        };
        let features = [end(s, [i, j], features[0]), end(t, [k, l], features[1])];
        Settled { features, points, square: (points[1] - points[0]).norm_squared() }
    }

    /// The vertices of a settled pair, as points of the difference: of a face the three about the foot.
    fn carriers(&self, now: &Settled) -> Simplex<f64> {
        let mut simplex = Simplex::empty();
        let mut add = |ids: Ids| simplex.push(ids, self.pair.difference(ids));
        match now.features {
            [Vertex(i), Vertex(j)] => add([i, j]),
            [Vertex(i), Edge(e)] => self.ends(Side::B, e).into_iter().for_each(|j| add([i, j])),
            [Edge(e), Vertex(j)] => self.ends(Side::A, e).into_iter().for_each(|i| add([i, j])),
            [Edge(e), Edge(f)] => {
                let ([i, j], [k, l]) = (self.ends(Side::A, e), self.ends(Side::B, f));
                [[i, k], [j, k], [j, l], [i, l]].into_iter().for_each(&mut add);
            }
            [Vertex(i), Face(f)] => {
                self.corners_about(Side::B, f, &now.points[1]).into_iter().for_each(|j| add([i, j]));
            }
            [Face(f), Vertex(j)] => {
                self.corners_about(Side::A, f, &now.points[0]).into_iter().for_each(|i| add([i, j]));
            }
            _ => {}
        }
        if let [Edge(_), Edge(_)] = now.features {
            // half of the parallelogram holds the point
            let (p, mut best) = (now.points[1] - now.points[0], simplex);
            best.count = 3;
            let mut least = f64::MAX;
            for skipped in 0..4 {
                let mut half = Simplex::empty();
                (0..4).filter(|&k| k != skipped).for_each(|k| half.push(simplex.ids[k], simplex.points[k]));
                let mut reduced = half;
                let _ = reduced.reduce();
                let off = (reduced.point() - p).norm_squared();
                if off < least {
                    (best, least) = (half, off);
                }
            }
            return best;
        }
        simplex
    }

    /// Three corners of a face whose triangle holds a point of it.
    fn corners_about(&self, side: Side, f: u32, p: &V) -> [u32; 3] {
        let (body, d) = (self.body(side), self.seen_from(side, p));
        let n = Vec3(body.faces()[f as usize].normal);
        let mut corners = body.face_half_edges(f as usize).map(|h| body.half_edges()[h].origin);
        let (first, mut before) = (corners.next().unwrap_or(0), corners.next().unwrap_or(0));
        let apex = self.local(side, first);
        let mut triangle = [first, before, before];
        for corner in corners {
            triangle = [first, before, corner];
            // the first diagonal that has the point on its right ends the fan
            if n.dot(&(self.local(side, corner) - apex).cross(&(d - apex))) <= 0.0 {
                break;
            }
            before = corner;
        }
        triangle
    }
}
