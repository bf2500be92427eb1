//! Lin–Canny in the plane: the walk over Voronoi regions as the lecture draws it (§8).
//!
//! ```text
//! F_A, F_B   any two features        a ∈ F_A, b ∈ F_B   their closest points
//! a ∈ V(F_B) and b ∈ V(F_A)          ⇒ closest of all (theorem 2)
//! else                               step to the neighbour across a violated wall
//! ```
//!
//! A step from a vertex to its edge shortens the distance; a step from an edge to its end, or from two
//! edges to the vertex and edge that carry their closest points, lowers a dimension at equal distance.
//! So no pair of features returns while the bodies are apart. A vertex behind an edge is no step: the
//! edge of largest signed distance is looked up, which proves overlap or leads the walk out. The bound
//! on the steps ends walks between overlapping bodies, whose depth is the largest separation over the
//! normals of all edges: in the plane these are complete.
//!
//! The answer carries the same certificate as in space; what `f64` cannot prove is repeated in
//! double-double.

use super::State;
use crate::error::{Error, Result};
use crate::math::double_double::{DoubleDouble, Real};
use crate::shape::convex_polygon::{ConvexPolygon, PlanarFeature};
use crate::tolerance::{CERTIFICATE_SLACK, COORDINATE_MAX};
use PlanarFeature::{Edge, Vertex};

/// Where a polygon stands in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlanarPose {
    /// Of the polygon's origin [m].
    pub position: [f64; 2],
    /// From the polygon's axes to the world's, counterclockwise [rad]. Its cosine and sine are those
    /// that `libm` rounds.
    pub angle: f64,
}

/// A pair of features that the walk visited, with their closest points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WalkStep {
    /// Feature of A.
    pub feature_a: PlanarFeature,
    /// Feature of B.
    pub feature_b: PlanarFeature,
    /// Closest point on it, world axes [m].
    pub point_a: [f64; 2],
    /// Closest point on it, world axes [m].
    pub point_b: [f64; 2],
}

/// The closest features of two polygons, in world axes.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarClosest {
    /// Distance where positive, minus the depth where negative [m].
    pub signed_distance: f64,
    /// The true signed distance is not below this [m].
    pub lower: f64,
    /// The true signed distance is not above this [m].
    pub upper: f64,
    /// What the interval says.
    pub state: State,
    /// The closest or deepest point of A [m].
    pub point_a: [f64; 2],
    /// The closest or deepest point of B [m].
    pub point_b: [f64; 2],
    /// Unit normal from A to B.
    pub normal: [f64; 2],
    /// The feature of A that carries `point_a`.
    pub feature_a: PlanarFeature,
    /// The feature of B that carries `point_b`.
    pub feature_b: PlanarFeature,
    /// The pairs of features that were visited, the last one last.
    pub path: Vec<WalkStep>,
    /// Whether `upper − lower ≤ 30 ε size`.
    pub certified: bool,
}

type V2<R> = [R; 2];

fn dot<R: Real>(a: V2<R>, b: V2<R>) -> R {
    a[0] * b[0] + a[1] * b[1]
}

fn sub<R: Real>(a: V2<R>, b: V2<R>) -> V2<R> {
    [a[0] - b[0], a[1] - b[1]]
}

fn along<R: Real>(a: V2<R>, d: V2<R>, k: R) -> V2<R> {
    [a[0] + k * d[0], a[1] + k * d[1]]
}

fn turned_right<R: Real>(d: V2<R>) -> V2<R> {
    [d[1], -d[0]]
}

fn length<R: Real>(d: V2<R>) -> R {
    dot(d, d).sqrt()
}

/// A polygon in the frame of the query: world axes, origin in that of A.
struct Placed<'a, R> {
    shape: &'a ConvexPolygon,
    turn: V2<R>,
    shift: V2<R>,
}

impl<'a, R: Real> Placed<'a, R> {
    fn new(shape: &'a ConvexPolygon, pose: &PlanarPose, shift: V2<R>) -> Self {
        let (s, c) = libm::sincos(pose.angle);
        let (s, c) = (R::from(s), R::from(c));
        let norm = (s * s + c * c).sqrt();
        Self { shape, turn: [c / norm, s / norm], shift }
    }

    fn vertex(&self, i: usize) -> V2<R> {
        let ([x, y], [c, s]) = (self.shape.vertices()[i].map(R::from), self.turn);
        [c * x - s * y + self.shift[0], s * x + c * y + self.shift[1]]
    }

    /// Both ends of an edge.
    fn edge(&self, e: usize) -> [V2<R>; 2] {
        self.shape.edge(e).map(|i| self.vertex(i))
    }

    /// Outward unit normal of an edge.
    fn normal(&self, e: usize) -> V2<R> {
        let [p, q] = self.edge(e);
        let n = turned_right(sub(q, p));
        let l = length(n);
        n.map(|x| x / l)
    }

    /// The vertex farthest along `n` and its height.
    fn farthest(&self, n: V2<R>) -> (usize, R) {
        let mut best = (0, dot(n, self.vertex(0)));
        for i in 1..self.shape.vertices().len() {
            let h = dot(n, self.vertex(i));
            if h > best.1 {
                best = (i, h);
            }
        }
        best
    }

    /// The edges of a vertex whose walls `p` has crossed; where there is one, `p` is not in V(vertex).
    fn crossed_at_vertex(&self, i: usize, p: V2<R>) -> impl Iterator<Item = PlanarFeature> + use<R> {
        if self.shape.edge_count() == 0 {
            return [None; 2].into_iter().flatten();
        }
        let v = self.vertex(i);
        let d = sub(p, v);
        let (before, after) = (self.shape.edge_into(i), i);
        let (into, out) = (sub(v, self.edge(before)[0]), sub(self.edge(after)[1], v));
        let zero = R::from(0.0);
        let crossed = [(dot(d, out) > zero).then_some(Edge(after)), (dot(d, into) < zero).then_some(Edge(before))];
        crossed.into_iter().flatten()
    }

    /// The edge over which `p` is highest, and that height.
    fn highest_edge(&self, p: V2<R>) -> Option<(usize, R)> {
        let height = |e: usize| dot(self.normal(e), sub(p, self.edge(e)[0]));
        let heights = (0..self.shape.edge_count()).map(|e| (e, height(e)));
        heights.reduce(|best, x| if x.1 > best.1 { x } else { best })
    }
}

/// The foot of `p` on an edge, as the parameter from its first to its second end.
fn foot<R: Real>([a, b]: [V2<R>; 2], p: V2<R>) -> R {
    let e = sub(b, a);
    dot(sub(p, a), e) / dot(e, e)
}

/// How a walk ended.
enum End<R> {
    /// At the closest points.
    Apart([V2<R>; 2]),
    /// The bodies overlap or touch, or the steps ran out: the sweep decides.
    Sweep,
}

/// What either precision found; points in the frame of the query.
struct Answer<R> {
    features: [PlanarFeature; 2],
    points: [V2<R>; 2],
    normal: V2<R>,
    lower: R,
    upper: R,
}

/// The closest features of two convex polygons, walking from `start`, or from their first vertices.
///
/// # Errors
/// A pose that is not finite or beyond 1e30, or a start that names no feature.
///
/// ```
/// use bryla::closest::planar::{PlanarPose, closest_features_planar};
/// use bryla::shape::convex_polygon::{ConvexPolygon, PlanarFeature};
///
/// let square = ConvexPolygon::from_points(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])?;
/// let away = PlanarPose { position: [4.0, 0.0], angle: std::f64::consts::FRAC_PI_4 };
/// let found = closest_features_planar(&square, &PlanarPose::default(), &square, &away, None)?;
/// assert!((found.signed_distance - (3.0 - 2f64.sqrt())).abs() < 1e-15);
/// assert_eq!(found.feature_a, PlanarFeature::Edge(1));
/// # Ok::<(), bryla::Error>(())
/// ```
pub fn closest_features_planar(
    a: &ConvexPolygon,
    pose_a: &PlanarPose,
    b: &ConvexPolygon,
    pose_b: &PlanarPose,
    start: Option<(PlanarFeature, PlanarFeature)>,
) -> Result<PlanarClosest> {
    for (pose, field) in [(pose_a, "pose_a"), (pose_b, "pose_b")] {
        if !pose.angle.is_finite() || !pose.position.iter().all(|x| x.abs() <= COORDINATE_MAX) {
            return Err(Error::value("closest features", field, "finite and within ±1e30", pose));
        }
    }
    let (first, second) = start.unwrap_or((Vertex(0), Vertex(0)));
    for (feature, shape) in [(first, a), (second, b)] {
        let exists = match feature {
            Vertex(i) => i < shape.vertices().len(),
            Edge(e) => e < shape.edge_count(),
        };
        if !exists {
            return Err(Error::value("closest features", "start", "a feature of the polygon", feature));
        }
    }

    // in f64; what that cannot prove, in double-double
    let shift: [f64; 2] = sub(pose_b.position, pose_a.position);
    let size = a.radius() + b.radius() + length(shift);
    let mut path = Vec::new();
    let (pa, pb) = (Placed::new(a, pose_a, [0.0; 2]), Placed::new(b, pose_b, shift));
    let rough = find(&pa, &pb, [first, second], size, pose_a.position, &mut path);
    let mut answer = finish(&rough, f64::UNIT * ERROR_UNITS * size, size, pose_a.position);
    if !answer.certified {
        let shift = [0, 1].map(|k| DoubleDouble::sum(pose_b.position[k], -pose_a.position[k]));
        let (pa, pb) = (Placed::new(a, pose_a, [DoubleDouble::default(); 2]), Placed::new(b, pose_b, shift));
        let precise = find(&pa, &pb, rough.features, size, pose_a.position, &mut path);
        answer = finish(&precise, DoubleDouble::UNIT * ERROR_UNITS * size, size, pose_a.position);
    }
    answer.path = path;
    Ok(answer)
}

/// Rounding of a height or a length, in units `u` times the size [-]: 3 for the rotation, 4 for turning
/// a vertex, 2 for the shift, 3 for the normal, 3 for the product, and as much for a second vertex.
const ERROR_UNITS: f64 = 24.0;

/// The walk and, where it ends in contact, the sweep.
fn find<R: Real>(
    a: &Placed<'_, R>,
    b: &Placed<'_, R>,
    mut features: [PlanarFeature; 2],
    size: f64,
    origin: [f64; 2],
    path: &mut Vec<WalkStep>,
) -> Answer<R> {
    if let End::Apart(points) = walk(a, b, &mut features, origin, path) {
        let d = sub(points[1], points[0]);
        let distance = length(d);
        if distance > R::from(R::UNIT * ERROR_UNITS * size) {
            // an edge's own normal is exact where a short difference is all rounding
            let normal = match features {
                [Edge(e), _] => a.normal(e),
                [_, Edge(e)] => b.normal(e).map(|x| -x),
                _ => d.map(|x| x / distance),
            };
            let lower = -b.farthest(normal.map(|x| -x)).1 - a.farthest(normal).1;
            return Answer { features, points, normal, lower, upper: distance };
        }
    }
    sweep(a, b)
}

/// The lecture's walk.
fn walk<R: Real>(
    a: &Placed<'_, R>,
    b: &Placed<'_, R>,
    features: &mut [PlanarFeature; 2],
    origin: [f64; 2],
    path: &mut Vec<WalkStep>,
) -> End<R> {
    let zero = R::from(0.0);
    let bound = 4 * (a.shape.vertices().len() + b.shape.vertices().len()) + 8;
    for _ in 0..bound {
        let points = closest_points(a, b, features);
        let [p, q] = points.map(|p| [p[0].to_f64() + origin[0], p[1].to_f64() + origin[1]]);
        path.push(WalkStep { feature_a: features[0], feature_b: features[1], point_a: p, point_b: q });

        // a wall that is violated, if any, leads to the next pair; onto an edge only where that shortens
        // the distance, for on a wall rounding may see either side, and the vertex's other edge may be the one
        let d = sub(points[1], points[0]);
        let shortens = |pair: [PlanarFeature; 2]| {
            let [p, q] = closest_points(a, b, &pair);
            (dot(sub(q, p), sub(q, p)) < dot(d, d)).then_some(pair)
        };
        let from_a = |i: usize| a.crossed_at_vertex(i, points[1]);
        let from_b = |j: usize| b.crossed_at_vertex(j, points[0]);
        let next = match *features {
            [Vertex(i), Vertex(j)] => {
                let onto_a = from_a(i).find_map(|f| shortens([f, Vertex(j)]));
                onto_a.or_else(|| from_b(j).find_map(|f| shortens([Vertex(i), f])))
            }
            [Vertex(i), Edge(e)] => match leave_edge(b, e, points[0]) {
                Left::Feature(f) => Some([Vertex(i), f]),
                Left::Behind => return End::Sweep,
                Left::Stays => from_a(i).find_map(|f| shortens([f, Edge(e)])),
            },
            [Edge(e), Vertex(j)] => match leave_edge(a, e, points[1]) {
                Left::Feature(f) => Some([f, Vertex(j)]),
                Left::Behind => return End::Sweep,
                Left::Stays => from_b(j).find_map(|f| shortens([Edge(e), f])),
            },
            [Edge(e), Edge(f)] => match lower_dimension(a, b, e, f) {
                Some(pair) => Some(pair),
                None => return End::Sweep,
            },
        };
        match next {
            Some(pair) => *features = pair,
            None if dot(d, d) > zero => return End::Apart(points),
            None => return End::Sweep,
        }
    }
    End::Sweep
}

/// Where a point leads from an edge.
enum Left {
    /// Its region holds the point.
    Stays,
    /// The point is beyond an end, or over another edge.
    Feature(PlanarFeature),
    /// The point is inside the polygon.
    Behind,
}

fn leave_edge<R: Real>(body: &Placed<'_, R>, e: usize, p: V2<R>) -> Left {
    let zero = R::from(0.0);
    let ends = body.edge(e);
    let height = dot(turned_right(sub(ends[1], ends[0])), sub(p, ends[0]));
    if height < zero {
        // behind: the edge that the point is highest over proves overlap or leads out
        return match body.highest_edge(p) {
            Some((f, h)) if h > zero && f != e => Left::Feature(Edge(f)),
            _ => Left::Behind,
        };
    }
    let t = foot(ends, p);
    let [i, j] = body.shape.edge(e);
    if t < zero {
        Left::Feature(Vertex(i))
    } else if t > R::from(1.0) {
        Left::Feature(Vertex(j))
    } else {
        Left::Stays
    }
}

/// The closest points of two features, an edge taken as its segment.
fn closest_points<R: Real>(a: &Placed<'_, R>, b: &Placed<'_, R>, features: &[PlanarFeature; 2]) -> [V2<R>; 2] {
    let on_edge = |body: &Placed<'_, R>, e: usize, p: V2<R>| {
        let ends = body.edge(e);
        let t = foot(ends, p);
        let t = if t < R::from(0.0) {
            R::from(0.0)
        } else if t > R::from(1.0) {
            R::from(1.0)
        } else {
            t
        };
        along(ends[0], sub(ends[1], ends[0]), t)
    };
    match *features {
        [Vertex(i), Vertex(j)] => [a.vertex(i), b.vertex(j)],
        [Vertex(i), Edge(e)] => [a.vertex(i), on_edge(b, e, a.vertex(i))],
        [Edge(e), Vertex(j)] => [on_edge(a, e, b.vertex(j)), b.vertex(j)],
        [Edge(e), Edge(f)] => match lower_dimension(a, b, e, f) {
            Some(pair) => closest_points(a, b, &pair),
            None => [crossing(a.edge(e), b.edge(f)); 2],
        },
    }
}

/// Where the line of the second edge meets the first edge, which it crosses.
fn crossing<R: Real>([p, q]: [V2<R>; 2], [r, s]: [V2<R>; 2]) -> V2<R> {
    let n = turned_right(sub(s, r));
    let (h, k) = (dot(n, sub(p, r)), dot(n, sub(q, r)));
    along(p, sub(q, p), h / (h - k))
}

/// The vertex and edge, or two vertices, that carry the closest points of two edges; none if they cross.
fn lower_dimension<R: Real>(a: &Placed<'_, R>, b: &Placed<'_, R>, e: usize, f: usize) -> Option<[PlanarFeature; 2]> {
    // they cross where each has its ends on both sides of the other
    let zero = R::from(0.0);
    let splits = |[p, q]: [V2<R>; 2], [r, s]: [V2<R>; 2]| {
        let n = turned_right(sub(q, p));
        let (h, k) = (dot(n, sub(r, p)), dot(n, sub(s, p)));
        (h > zero && k < zero) || (h < zero && k > zero)
    };
    if splits(a.edge(e), b.edge(f)) && splits(b.edge(f), a.edge(e)) {
        return None;
    }

    let mut best: Option<(R, [PlanarFeature; 2])> = None;
    let mut offer = |pair: [PlanarFeature; 2]| {
        let [p, q] = closest_points(a, b, &pair);
        let d = sub(q, p);
        let square = dot(d, d);
        if best.as_ref().is_none_or(|x| square < x.0) {
            best = Some((square, pair));
        }
    };
    for i in a.shape.edge(e) {
        offer([Vertex(i), Edge(f)]);
    }
    for j in b.shape.edge(f) {
        offer([Edge(e), Vertex(j)]);
    }
    best.map(|x| x.1)
}

/// The largest separation over all edge normals: minus the depth where the polygons overlap, and a
/// separating line where they touch.
fn sweep<R: Real>(a: &Placed<'_, R>, b: &Placed<'_, R>) -> Answer<R> {
    let mut best: Option<Answer<R>> = None;
    let mut offer = |normal: V2<R>, lower: R, features: [PlanarFeature; 2], points: [V2<R>; 2]| {
        if best.as_ref().is_none_or(|x| lower > x.lower) {
            best = Some(Answer { features, points, normal, lower, upper: lower });
        }
    };
    for e in 0..a.shape.edge_count() {
        let n = a.normal(e);
        let (j, depth) = b.farthest(n.map(|x| -x));
        let lower = -depth - dot(n, a.edge(e)[0]);
        let q = b.vertex(j);
        offer(n, lower, [Edge(e), Vertex(j)], [along(q, n, -lower), q]);
    }
    for e in 0..b.shape.edge_count() {
        let n = b.normal(e).map(|x| -x);
        let (i, height) = a.farthest(n);
        let lower = dot(n, b.edge(e)[0]) - height;
        let p = a.vertex(i);
        offer(n, lower, [Vertex(i), Edge(e)], [p, along(p, n, lower)]);
    }
    best.unwrap_or_else(|| {
        // two points on one spot
        let (points, zero) = ([a.vertex(0), b.vertex(0)], R::from(0.0));
        let normal = [R::from(1.0), zero];
        let lower = dot(normal, sub(points[1], points[0]));
        Answer { features: [Vertex(0); 2], points, normal, lower, upper: length(sub(points[1], points[0])) }
    })
}

/// The answer in the world, with its interval rounded outwards.
fn finish<R: Real>(found: &Answer<R>, error: f64, size: f64, origin: [f64; 2]) -> PlanarClosest {
    let (lower, upper) = super::climb::outward(found.lower - R::from(error), found.upper + R::from(error));
    let world = |p: V2<R>| [p[0].to_f64() + origin[0], p[1].to_f64() + origin[1]];
    let state = if lower > 0.0 {
        State::Separated
    } else if upper < 0.0 {
        State::Overlapping
    } else {
        State::Touching
    };
    PlanarClosest {
        signed_distance: dot(found.normal, sub(found.points[1], found.points[0])).to_f64(),
        lower,
        upper,
        state,
        point_a: world(found.points[0]),
        point_b: world(found.points[1]),
        normal: found.normal.map(R::to_f64),
        feature_a: found.features[0],
        feature_b: found.features[1],
        path: Vec::new(),
        certified: upper - lower <= 2.0 * error + CERTIFICATE_SLACK * size,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polygon() -> impl Strategy<Value = ConvexPolygon> {
        let cloud = prop::collection::vec(prop::array::uniform2(-1.0..1.0f64), 1..12);
        let lattice = prop::collection::vec(prop::array::uniform2((-2i8..3).prop_map(|x| 0.5 * f64::from(x))), 1..12);
        prop_oneof![cloud, lattice].prop_map(|p| ConvexPolygon::from_points(&p).unwrap())
    }

    fn pose() -> impl Strategy<Value = PlanarPose> {
        let free = (prop::array::uniform2(-3.0..3.0f64), -4.0..4.0f64);
        let lattice = prop::array::uniform2((-4i8..5).prop_map(|x| 0.5 * f64::from(x))).prop_map(|p| (p, 0.0));
        prop_oneof![free, lattice].prop_map(|(position, angle)| PlanarPose { position, angle })
    }

    fn world(shape: &ConvexPolygon, pose: &PlanarPose) -> ConvexPolygon {
        let (s, c) = libm::sincos(pose.angle);
        let place = |v: &[f64; 2]| [c * v[0] - s * v[1] + pose.position[0], s * v[0] + c * v[1] + pose.position[1]];
        ConvexPolygon::from_points(&shape.vertices().iter().map(place).collect::<Vec<_>>()).unwrap()
    }

    /// Distance of a point from a segment.
    fn to_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
        let d = sub(b, a);
        let t = if d == [0.0; 2] { 0.0 } else { (dot(sub(p, a), d) / dot(d, d)).clamp(0.0, 1.0) };
        length(sub(p, along(a, d, t)))
    }

    /// The signed distance by brute force: all vertices against all edges, and all separating directions.
    fn truth(a: &ConvexPolygon, b: &ConvexPolygon) -> f64 {
        let sides = |s: &ConvexPolygon| -> Vec<[[f64; 2]; 2]> {
            let n = s.vertices().len();
            (0..n).map(|i| [s.vertices()[i], s.vertices()[(i + 1) % n]]).collect()
        };
        let height = |s: &ConvexPolygon, n: [f64; 2]| s.vertices().iter().map(|&v| dot(n, v)).fold(f64::MIN, f64::max);
        let mut separation = f64::MIN;
        for (from, sign) in [(a, 1.0), (b, -1.0)] {
            for [p, q] in sides(from) {
                let n = turned_right(sub(q, p));
                if n != [0.0; 2] {
                    let n = n.map(|x| sign * x / length(n));
                    separation = separation.max(-height(b, n.map(|x| -x)) - height(a, n));
                }
            }
        }
        if separation < -1e-12 && separation > f64::MIN {
            return separation; // else some vertex is at the distance from an edge, also where all are on one line
        }
        let ends = |s: &ConvexPolygon, t: &ConvexPolygon| {
            let distances =
                s.vertices().iter().flat_map(|&p| sides(t).into_iter().map(move |[a, b]| to_segment(p, a, b)));
            distances.fold(f64::MAX, f64::min)
        };
        ends(a, b).min(ends(b, a))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn the_walk_finds_the_signed_distance(
            a in polygon(), pose_a in pose(), b in polygon(), pose_b in pose(), i in 0usize..12, j in 0usize..12,
        ) {
            let start = (Vertex(i % a.vertices().len()), Vertex(j % b.vertices().len()));
            let found = closest_features_planar(&a, &pose_a, &b, &pose_b, Some(start)).unwrap();
            let want = truth(&world(&a, &pose_a), &world(&b, &pose_b));
            // the rounding of the brute force's own world coordinates, all below 5
            prop_assert!((found.signed_distance - want).abs() <= 64.0 * f64::EPSILON, "{} {want} {found:?}", found.signed_distance);
            prop_assert!(found.certified, "{found:?}");
            prop_assert!(found.lower <= found.signed_distance && found.signed_distance <= found.upper, "{found:?}");
            let along = dot(found.normal, sub(found.point_b, found.point_a));
            prop_assert!((along - found.signed_distance).abs() <= 64.0 * f64::EPSILON, "{found:?}");
        }

        /// Theorem 1: closest points lie in each other's regions. Theorem 2: pairs of features whose closest
        /// points do are the closest.
        #[test]
        fn both_theorems_hold(a in polygon(), b in polygon(), pose_b in pose()) {
            let home = PlanarPose::default();
            let placed = world(&b, &pose_b);
            let found = closest_features_planar(&a, &home, &placed, &home, None).unwrap();
            prop_assume!(found.state == State::Separated && found.signed_distance > 1e-6);
            // on a wall, rounding may have put a point on either side of it: some point within a few ε holds
            let holds = |shape: &ConvexPolygon, feature: PlanarFeature, p: [f64; 2]| {
                let region = shape.voronoi_regions().into_iter().find(|r| r.feature == feature).unwrap();
                let near = [[0.0, 0.0], [1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
                near.iter().any(|&d| region.contains(along(p, d, 16.0 * f64::EPSILON)))
            };
            prop_assert!(holds(&a, found.feature_a, found.point_b), "theorem 1: {found:?}");
            prop_assert!(holds(&placed, found.feature_b, found.point_a), "theorem 1: {found:?}");

            // theorem 2 over all pairs of features
            let (pa, pb) = (Placed::new(&a, &home, [0.0; 2]), Placed::new(&placed, &home, [0.0; 2]));
            for ra in a.voronoi_regions() {
                for rb in placed.voronoi_regions() {
                    let [p, q] = closest_points(&pa, &pb, &[ra.feature, rb.feature]);
                    if ra.contains(q) && rb.contains(p) {
                        let d = length(sub(q, p));
                        prop_assert!((d - found.signed_distance).abs() <= 64.0 * f64::EPSILON, "theorem 2: {d} {found:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn squares_on_a_lattice_touch_cross_and_part() {
        let square = ConvexPolygon::from_points(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]).unwrap();
        let at = |x: f64, y: f64| {
            let pose = PlanarPose { position: [x, y], angle: 0.0 };
            closest_features_planar(&square, &PlanarPose::default(), &square, &pose, None).unwrap()
        };
        for (x, y, want, state) in [
            (3.0, 0.0, 1.0, State::Separated),
            (3.0, 3.0, 2f64.sqrt(), State::Separated),
            (2.0, 0.5, 0.0, State::Touching),
            (2.0, 2.0, 0.0, State::Touching),
            (1.5, 0.0, -0.5, State::Overlapping),
            (0.0, 0.0, -2.0, State::Overlapping),
        ] {
            let found = at(x, y);
            assert_eq!(found.state, state, "at {x}, {y}");
            assert!(
                (found.signed_distance - want).abs() <= 2.0 * f64::EPSILON,
                "at {x}, {y}: {}",
                found.signed_distance
            );
        }
    }

    #[test]
    fn both_edges_of_a_vertex_are_tried() {
        // the triangle's lower side is parallel to the segment: rounding sees a wall crossed there that leads nowhere
        let segment = ConvexPolygon::from_points(&[[-1.0, 0.0], [1.0, -0.5]]).unwrap();
        let triangle = ConvexPolygon::from_points(&[[0.0, -2.0], [2.0, -2.5], [1.0, -2.0]]).unwrap();
        let home = PlanarPose::default();
        for start in [None, Some((Edge(0), Vertex(0))), Some((Edge(0), Vertex(1))), Some((Edge(0), Vertex(2)))] {
            let found = closest_features_planar(&segment, &home, &triangle, &home, start).unwrap();
            assert!(
                found.certified && (found.signed_distance - 1.5).abs() <= 4.0 * f64::EPSILON,
                "{start:?}: {found:?}"
            );
        }
    }

    #[test]
    fn a_good_start_makes_the_walk_short() {
        let rim = |k: u32| libm::sincos(std::f64::consts::TAU * f64::from(k) / 256.0);
        let disc = ConvexPolygon::from_points(&(0..256).map(rim).map(|(s, c)| [c, s]).collect::<Vec<_>>()).unwrap();
        let pose = |angle: f64| PlanarPose { position: [-3.0, 0.5], angle };
        let home = PlanarPose::default();
        let cold = closest_features_planar(&disc, &home, &disc, &pose(0.001), None).unwrap();
        let start = Some((cold.feature_a, cold.feature_b));
        let warm = closest_features_planar(&disc, &home, &disc, &pose(0.002), start).unwrap();
        assert!(warm.path.len() <= 3 && cold.path.len() > 10, "{} {}", warm.path.len(), cold.path.len());
        assert!(closest_features_planar(&disc, &home, &disc, &home, Some((Vertex(256), Vertex(0)))).is_err());
    }
}
