//! Whether the features of the last answer still are the closest: the test at the heart of Lin and Canny's
//! method (1991; lecture §8, theorem 2), made to prove its answer.
//!
//! Coherent motion rarely changes features. Where they are still the ones, that is seen without a search:
//!
//! ```text
//! a vertex and a face    the foot of the vertex is inside the walls of the face's edges; n the face's normal
//! edges and vertices     the closest points of the lines are inside both edges; n the line through them
//! ```
//!
//! provided that no vertex reaches farther along n than these do: a face's plane holds its whole body, and
//! of a vertex or an edge all neighbours are lower. Both give the same bounds as a search, and with the same
//! rounding. The foot has to be inside by more than the rounding of a wall, which is `u size²/length` for an
//! edge of that length. What is on a wall, or as high as its neighbours to within rounding, is left to the
//! search.

use super::Feature::{self, Edge, Face, Vertex};
use super::pair::{Difference, Pair, crest};
use super::vector::Vec3;
use crate::math::double_double::Real;
use crate::shape::convex_polyhedron::ConvexPolyhedron;

/// How far inside a wall a foot has to be, in units `u size²/length` [-]: the vertex seen from the other body
/// is off by 12, the wall by 8, the product by 3. Larger: more pairs are left to the search.
const WALL_UNITS: f64 = 64.0;
/// Sine of the angle of two edges below which they count as parallel [-]: the common perpendicular is off by
/// a rounding divided by it. Larger: more pairs are left to the search.
const PARALLEL: f64 = 1e-3;

/// What is proved of two cores, as points and features, world axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joined<R> {
    /// The point of A about its centre [m].
    pub(super) on_a: Vec3<R>,
    /// From the point of A to that of B [m].
    pub(super) point: Vec3<R>,
    /// Unit normal from A to B.
    pub(super) normal: Vec3<R>,
    /// Bounds of the signed distance, but for the pair's error [m].
    pub(super) lower: R,
    pub(super) upper: R,
    pub(super) features: [Feature; 2],
}

/// The closest points of two features, if these are the closest of bodies apart.
#[inline]
pub(super) fn joined(pair: &Pair<'_, f64>, features: [Feature; 2]) -> Option<Joined<f64>> {
    match features {
        [Vertex(i), Face(f)] => over_face(pair, 1, f, i),
        [Face(f), Vertex(j)] => over_face(pair, 0, f, j),
        _ => between(pair, features),
    }
}

/// A vertex of the other body over a face of A (0) or B (1).
#[inline]
fn over_face(pair: &Pair<'_, f64>, side: usize, f: u32, other: u32) -> Option<Joined<f64>> {
    let (body, other_body) = if side == 0 { (pair.a, pair.b) } else { (pair.b, pair.a) };
    let face = body.faces().get(f as usize)?;
    other_body.vertices_about_center().get(other as usize)?;

    // the vertex about the centre of the face's body
    let (vertex, between) =
        if side == 0 { (pair.point_b(other), pair.between) } else { (pair.point_a(other), -pair.between) };
    let at = vertex + between;
    let seen = pair.rotations.rotate_back(side, &at);
    let margin = WALL_UNITS * f64::UNIT * pair.size * pair.size;
    let (mut h, normal) = (face.half_edge as usize, Vec3(face.normal));
    for _ in 0..face.sides {
        let half = &body.half_edges()[h];
        let from_wall = Vec3(half.inward).dot(&(seen - Vec3(body.vertices_about_center()[half.origin as usize])));
        if from_wall * body.edges()[h / 2].length <= margin {
            return None;
        }
        h = half.next as usize;
    }

    // the face's plane holds its body; the other reaches towards it as far as its vertex
    let n = pair.rotations.rotate(side, &normal);
    let reach = crest(other_body, &-pair.rotations.rotate_back(1 - side, &n), [other; 2])?;
    let one_over = 1.0 / n.norm();
    let lower = (n.dot(&between) - face.offset - reach) * one_over;
    if lower <= pair.error(0.0) {
        return None;
    }
    let upper = lower + face.fit_error; // the face's lowest corner
    let unit = n.scaled(one_over);
    let foot = unit.scaled(upper);
    Some(if side == 0 {
        Joined { on_a: at - foot, point: foot, normal: unit, lower, upper, features: [Face(f), Vertex(other)] }
    } else {
        Joined { on_a: vertex, point: -foot, normal: -unit, lower, upper, features: [Vertex(other), Face(f)] }
    })
}

/// Two features of dimension 0 or 1 whose closest points are inside both, and along the line of these no other
/// vertex reaches as far.
#[inline]
fn between(pair: &Pair<'_, f64>, features: [Feature; 2]) -> Option<Joined<f64>> {
    let [i, j] = ends(pair.a, features[0])?;
    let [k, l] = ends(pair.b, features[1])?;
    let (from_a, from_b) = (pair.point_a(i), pair.point_b(k) + pair.between);
    let w = from_b - from_a;
    let to_a = || pair.point_a(j) - from_a;
    let to_b = || pair.point_b(l) + pair.between - from_b;

    // the point of A, the vector to that of B, and a normal taken from the edges
    let (on_a, point, normal) = match (i == j, k == l) {
        (true, true) => (from_a, w, w),
        (true, false) => {
            let v = to_b();
            let point = w + v.scaled(fraction(-v.dot(&w), v.norm_squared())?);
            (from_a, point, across(&point, &v))
        }
        (false, true) => {
            let u = to_a();
            let step = u.scaled(fraction(u.dot(&w), u.norm_squared())?);
            (from_a + step, w - step, across(&(w - step), &u))
        }
        (false, false) => {
            let (u, v) = (to_a(), to_b());
            let n = u.cross(&v);
            let (square, uu, vv) = (n.norm_squared(), u.norm_squared(), v.norm_squared());
            if square <= PARALLEL * PARALLEL * uu * vv {
                return None;
            }
            let (uv, uw, vw) = (u.dot(&v), u.dot(&w), v.dot(&w));
            let s = fraction(uw * vv - vw * uv, square)?;
            let t = fraction(uw * uv - vw * uu, square)?;
            let on_a = from_a + u.scaled(s);
            (on_a, from_b + v.scaled(t) - on_a, if n.dot(&w) < 0.0 { -n } else { n })
        }
    };
    let upper = point.norm();
    if upper <= pair.error(0.0) {
        return None;
    }

    let unit = normal.scaled(1.0 / normal.norm());
    let [along_a, along_b] = pair.rotations.rotate_back_both(&unit);
    let reach_a = crest(pair.a, &along_a, [i, j])?;
    let reach_b = crest(pair.b, &-along_b, [k, l])?;
    let lower = unit.dot(&pair.between) - reach_a - reach_b;
    Some(Joined { on_a, point, normal: unit, lower, upper, features })
}

/// A ratio strictly between 0 and 1.
#[inline]
fn fraction(part: f64, whole: f64) -> Option<f64> {
    (part > 0.0 && part < whole).then(|| part / whole)
}

/// The part of a vector across an edge.
#[inline]
fn across(p: &Vec3<f64>, edge: &Vec3<f64>) -> Vec3<f64> {
    *p - edge.scaled(p.dot(edge) / edge.norm_squared())
}

/// The ends of an edge, or a vertex twice, if the body has it.
#[inline]
fn ends(body: &ConvexPolyhedron, feature: Feature) -> Option<[u32; 2]> {
    match feature {
        Vertex(i) => body.vertices_about_center().get(i as usize).map(|_| [i, i]),
        Edge(e) => {
            let half_edges = body.half_edges().get(2 * e as usize..2 * e as usize + 2)?;
            Some([half_edges[0].origin, half_edges[1].origin])
        }
        _ => None,
    }
}
