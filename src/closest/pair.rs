//! Two posed polyhedra and their difference.
//!
//! ```text
//! C = { b − a },   w(i, j) = R_B b_j + t − R_A a_i,   t = x_B + R_B c_B − x_A − R_A c_A
//! ```
//!
//! The distance of the bodies is that of C from the origin, their depth how far the origin is inside.
//! Vertices are taken about the bodies' centres, world axes, and `t` joins the centres: where both
//! bodies are in the world does not enter the error.
//!
//! **Error bounds.** With `u = ε/2`, `ρ` the radii, `t` between the centres, `s` the signed distance, and
//! `R` the rotation of `q/|q|` as computed; entries of `|R|` taken by size, `‖|R|‖ ≤ √3`:
//!
//! ```text
//! ‖δR‖ ≤ √3 u          every entry is rounded once: the products of a quaternion's leading parts and
//!                      their sums are exact, and what is left out is 2⁻²⁶ of that
//! |δ(R v)| ≤ 5.5 u ρ   √3 for R, √3 for three products, 1 for each of two sums
//! |δ(n·w)| ≤ 9.5 u (ρ_A + ρ_B) + 5 u |t| + 6.5 u |s|     lower bound: 3 for a dot product, 1 for joining it;
//!                      t is a difference; n is a unit vector to 4.5; joining, and rounding off the result
//! |δ|p|| ≤ 9.5 u (ρ_A + ρ_B) + 5 u |t| + 7.5 u |s|        upper bound, apart: 2 for joining both points, 2
//!                      for their weighted sum; the weights sum to 1 + 3 u
//! |δ(n·w)| ≤ 10.5 u (ρ_A + ρ_B) + 6 u |t| + 5.5 u |s|     upper bound, overlapping: 2 for joining both
//!                      points, 3 for the height of a triangle
//! ```
//!
//! so the height of the difference along any direction, and the length of any of its points, are known
//! to the largest of these. That number is charged once to the lower and once to the upper bound of every
//! answer. A vertex about a centre that is not the origin is rounded: 1 u. A piece of a compound is turned
//! twice: 2 u for its own rotation, 9 u for the product of the two.
//!
//! A body may be the set of all points within `rounding` of a polyhedron: balls and capsules are. Every
//! `s(n)` then falls by that radius, and so does the signed distance, whatever the state.

use super::answer::Feature;
use super::meridian::Axis;
use super::rotation::{Rotations, precise_rotation, rotate, rotate_back, rotation, rotations};
use super::simplex::Simplex;
use super::vector::Vec3;
use crate::math::double_double::{DoubleDouble, Real};
use crate::math::{Pose, Quaternion, Vector3};
use crate::shape::convex_polyhedron::{ConvexPolyhedron, SCAN, highest, others_reach, top_of};
use crate::tolerance::CERTIFICATE_WIDTH;

/// A vertex of each body.
pub(super) type Ids = [u32; 2];

/// Bound of rounding in heights and lengths, in units `u` times the radii [-]; see the module.
const RADII_UNITS: f64 = 10.5;
/// The same for the distance of the centres [-].
const CENTERS_UNITS: f64 = 6.0;
/// The same for the distance, and for the depth [-].
const DISTANCE_UNITS: f64 = 7.5;
const DEPTH_UNITS: f64 = 5.5;
/// What vertices about a centre that is not the origin add, in units `u` times the radii [-].
pub(super) const OFF_CENTER_UNITS: f64 = 1.0;
/// Relative rounding in the climbed heights of one body, in units `u` [-]: two dot products and the
/// direction's own rotation cancel from a comparison; what is left is 2 · (3 + 1) u.
const PLATEAU_UNITS: f64 = 10.0;
/// Points of an inner polytope [-]: bodies of 100 vertices need 10 to 60; beyond this the depth is given
/// with the bounds that are proved.
const POINTS: usize = 1024;
/// Vertices of equal height that are followed before all are looked at.
const PLATEAU: usize = 32;

/// Of the radii that round off bodies: their sum and the subtraction [-].
const ROUNDING_UNITS: f64 = 3.0;
/// Of a point placed in the world in double-double: two rotations of 22 u and the sums [-].
const REMOTE_UNITS: f64 = 48.0;
/// Size below which squares underflow, and what they lose of lengths then [m]. Larger: gaps that are told would count as
/// touching.
const UNDERFLOW: f64 = 1e-150;
/// What a piece's own rotation adds, in units `u` times the radii [-].
const PIECE_UNITS: f64 = 11.0;

/// The difference of two posed convex bodies, as the searches see it.
pub(super) trait Difference<R: Real> {
    /// From the centre of A to that of B, world axes [m].
    fn between(&self) -> Vec3<R>;

    /// Both radii and the distance of the centres [m].
    fn size(&self) -> f64;

    /// Bound of the rounding error of a height or a length near `distance` [m].
    fn error(&self, distance: f64) -> f64;

    /// Width of an interval that is promised of the last rung [m].
    fn promise(&self) -> f64 {
        CERTIFICATE_WIDTH * self.size()
    }

    /// Up to how many points an inner polytope is grown.
    fn most_points(&self) -> usize;

    /// The lowest point of the difference along `n`, searched from `from`, and a proven lower bound of
    /// its height `n · w`, but for the pair's `error` times `|n|`.
    fn lowest(&self, n: &Vec3<R>, from: Option<Ids>) -> (Ids, R);

    /// A point of the difference [m].
    fn difference(&self, ids: Ids) -> Vec3<R>;

    /// The point of A that belongs to it, about the centre of A, world axes [m].
    fn point_a(&self, i: u32) -> Vec3<R>;

    /// The simplex of up to four points of the difference.
    fn simplex(&self, ids: &[Ids]) -> Simplex<R>;

    /// The common axis of two bodies of revolution, where there is one.
    fn axis(&self) -> Option<Axis<R>> {
        None
    }

    /// The features of A and B that carry a simplex, for the normal from A to B.
    fn features(&self, simplex: &Simplex<R>, normal: &Vec3<R>) -> [Feature; 2];
}

/// Where a convex body stands: the pose of what it belongs to, its own place there, and how far beyond
/// its core it reaches.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand<'a> {
    pub(super) pose: &'a Pose,
    pub(super) piece: Option<&'a Placement>,
    /// Distance from the core within which a point belongs to the body [m].
    pub(super) rounding: f64,
}

/// Where a piece stands in its compound, in both precisions.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Placement {
    position: Vec3<f64>,
    rows: [Vec3<f64>; 3],
    precise: [Vec3<DoubleDouble>; 3],
}

impl Placement {
    pub(super) fn new(pose: &Pose) -> Self {
        let precise = precise_rotation(&pose.orientation);
        Self { position: Vec3(pose.position.into()), rows: precise.map(|r| Vec3(r.to_f64())), precise }
    }

    /// A point of the piece in the compound's axes [m].
    pub(super) fn point(&self, p: [f64; 3]) -> Vector3 {
        (rotate(&self.rows, &Vec3(p)) + self.position).to_vector()
    }

    /// A direction of the piece in the compound's axes.
    pub(super) fn vector(&self, v: [f64; 3]) -> Vector3 {
        rotate(&self.rows, &Vec3(v)).to_vector()
    }

    /// The rotation from the piece to the compound, as rows.
    #[inline]
    pub(super) fn turn(&self) -> &[Vec3<f64>; 3] {
        &self.rows
    }
}

impl Stand<'_> {
    /// The rotation of the body's axes.
    #[inline]
    pub(super) fn rows<R: Heights>(&self) -> [Vec3<R>; 3] {
        let outer = R::rotation(&self.pose.orientation);
        let Some(piece) = self.piece else { return outer };
        // each row of the product: the columns of the inner rotation, turned back
        outer.map(|row| rotate_back(R::rows_of(piece), &row))
    }

    /// Where a point of the body is in the world, in double-double: positions and centres may be large
    /// and cancel.
    pub(super) fn precise_point(&self, p: [f64; 3]) -> Vec3<DoubleDouble> {
        let in_pose = match self.piece {
            Some(piece) => rotate(&piece.precise, &Vec3::new(p)) + Vec3::new(piece.position.0),
            None if p == [0.0; 3] => return Vec3::new(self.pose.position.into()),
            None => Vec3::new(p),
        };
        rotate(&precise_rotation(&self.pose.orientation), &in_pose) + Vec3::new(self.pose.position.into())
    }

    /// Where a point of the body is in the world [m].
    #[inline]
    pub(super) fn point(&self, p: [f64; 3]) -> Vector3 {
        let in_pose = match self.piece {
            Some(piece) => piece.point(p).into(),
            None if p == [0.0; 3] => return self.pose.position,
            None => p,
        };
        rotate(&rotation(&self.pose.orientation), &Vec3(in_pose)).to_vector() + self.pose.position
    }
}

/// From one point to another in the world, and the rounding error of that in double-double [m].
pub(super) fn from_to(at_a: &Stand<'_>, a: [f64; 3], at_b: &Stand<'_>, b: [f64; 3]) -> (Vec3<DoubleDouble>, f64) {
    let reach = |at: &Stand<'_>, p: [f64; 3]| {
        let inner = at.piece.map_or(0.0, |piece| piece.position.norm());
        at.pose.position.amax() + inner + Vec3(p).norm()
    };
    let error = DoubleDouble::UNIT * REMOTE_UNITS * (reach(at_a, a) + reach(at_b, b));
    (at_b.precise_point(b) - at_a.precise_point(a), error)
}

/// What the size and the error of a pair are made of.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    pub(super) size: f64,
    /// Bound of the rounding error of a height or a length of about 0 [m].
    pub(super) error: f64,
}

/// What a signed distance adds to the rounding error of a pair, in units of it [-].
pub(super) fn error_of_distance<R: Heights>(distance: f64) -> f64 {
    let units = if distance < 0.0 { DEPTH_UNITS } else { DISTANCE_UNITS };
    units * R::COST * distance.abs()
}

impl Measure {
    /// For bodies of these radii [m] whose heights cost `extra` units more than a polyhedron's.
    #[inline]
    pub(super) fn new(unit: f64, radii: f64, centers: f64, stands: [&Stand<'_>; 2], extra: f64) -> Self {
        let rounding = stands[0].rounding + stands[1].rounding;
        let pieces = if stands.iter().any(|s| s.piece.is_some()) { PIECE_UNITS } else { 0.0 };
        let units = (RADII_UNITS + pieces + extra) * radii + CENTERS_UNITS * centers + ROUNDING_UNITS * rounding;
        Self { size: radii + centers + rounding, error: unit * units }
    }
}

/// Two polyhedra, posed.
#[derive(Debug)]
pub(super) struct Pair<'a, R> {
    pub(super) a: &'a ConvexPolyhedron,
    pub(super) b: &'a ConvexPolyhedron,
    /// Body to world.
    pub(super) rotations: Rotations<R>,
    /// From the centre of A to that of B, world axes [m].
    pub(super) between: Vec3<R>,
    /// Both radii and the distance of the centres [m].
    pub(super) size: f64,
    /// Bound of the rounding error of a height or a length of about 0 [m].
    pub(super) error: f64,
}

impl<'a> Pair<'a, f64> {
    #[inline]
    pub(super) fn new(a: &'a ConvexPolyhedron, at_a: &Stand<'_>, b: &'a ConvexPolyhedron, at_b: &Stand<'_>) -> Self {
        let are_near = a.is_about_origin() && b.is_about_origin() && at_a.piece.is_none() && at_b.piece.is_none();
        let (between, remote) = if are_near {
            (Vec3((at_b.pose.position - at_a.pose.position).into()), 0.0)
        } else {
            let (between, remote) = from_to(at_a, a.center(), at_b, b.center());
            (Vec3(between.to_f64()), remote)
        };
        Self::assemble(a, at_a, b, at_b, between, remote)
    }
}

impl<'a> Pair<'a, DoubleDouble> {
    pub(super) fn precise(
        a: &'a ConvexPolyhedron,
        at_a: &Stand<'_>,
        b: &'a ConvexPolyhedron,
        at_b: &Stand<'_>,
    ) -> Self {
        let (between, remote) = from_to(at_a, a.center(), at_b, b.center());
        Self::assemble(a, at_a, b, at_b, between, remote)
    }
}

impl<'a, R: Heights> Pair<'a, R> {
    #[inline]
    fn assemble(
        a: &'a ConvexPolyhedron,
        at_a: &Stand<'_>,
        b: &'a ConvexPolyhedron,
        at_b: &Stand<'_>,
        between: Vec3<R>,
        remote: f64,
    ) -> Self {
        let (radii, centers) = (a.radius() + b.radius(), Vec3::<f64>(between.to_f64()).norm());
        let extra = if a.is_about_origin() && b.is_about_origin() { 0.0 } else { OFF_CENTER_UNITS };
        let Measure { size, error } = Measure::new(R::COST, radii, centers, [at_a, at_b], extra);
        let lost = if size < UNDERFLOW && between != Vec3::zero() { UNDERFLOW } else { 0.0 };
        let rotations = if at_a.piece.is_none() && at_b.piece.is_none() {
            R::rotations(&at_a.pose.orientation, &at_b.pose.orientation)
        } else {
            Rotations::of(&at_a.rows(), &at_b.rows())
        };
        Self { a, b, rotations, between, size, error: error + remote + lost }
    }

    /// A vertex of B about its centre, world axes.
    #[inline]
    pub(super) fn point_b(&self, j: u32) -> Vec3<R> {
        self.rotations.rotate(1, &R::vertex(self.b, j as usize))
    }

    /// A direction of the world in the axes of A.
    #[inline]
    pub(super) fn in_axes_of_a(&self, n: &Vec3<R>) -> Vec3<R> {
        self.rotations.rotate_back(0, n)
    }

    /// A direction of the world in the axes of B.
    #[inline]
    pub(super) fn in_axes_of_b(&self, n: &Vec3<R>) -> Vec3<R> {
        self.rotations.rotate_back(1, n)
    }
}

impl<R: Heights> Difference<R> for Pair<'_, R> {
    #[inline]
    fn between(&self) -> Vec3<R> {
        self.between
    }

    #[inline]
    fn size(&self) -> f64 {
        self.size
    }

    #[inline]
    fn error(&self, distance: f64) -> f64 {
        self.error + error_of_distance::<R>(distance)
    }

    fn most_points(&self) -> usize {
        POINTS
    }

    #[inline]
    fn lowest(&self, n: &Vec3<R>, from: Option<Ids>) -> (Ids, R) {
        let [along_a, along_b] = self.rotations.rotate_back_both(n);
        let (i, high_a) = R::farthest(self.a, &along_a, from.map(|f| f[0]));
        let (j, high_b) = R::farthest(self.b, &-along_b, from.map(|f| f[1]));
        ([i, j], n.dot(&self.between) - high_a - high_b)
    }

    /// `w(i, j)`.
    #[inline]
    fn difference(&self, [i, j]: Ids) -> Vec3<R> {
        (self.point_b(j) + self.between) - self.point_a(i)
    }

    #[inline]
    fn point_a(&self, i: u32) -> Vec3<R> {
        self.rotations.rotate(0, &R::vertex(self.a, i as usize))
    }

    /// Neighbouring pairs often share a vertex, which is then placed once.
    #[inline]
    fn simplex(&self, ids: &[Ids]) -> Simplex<R> {
        let mut simplex = Simplex::empty();
        let Some(&[mut i, mut j]) = ids.first() else { return simplex };
        let (mut a, mut b) = (self.point_a(i), self.point_b(j) + self.between);
        for &ids in ids.iter().take(4) {
            if ids[0] != i {
                (i, a) = (ids[0], self.point_a(ids[0]));
            }
            if ids[1] != j {
                (j, b) = (ids[1], self.point_b(ids[1]) + self.between);
            }
            simplex.push(ids, b - a);
        }
        simplex
    }

    #[inline]
    fn features(&self, simplex: &Simplex<R>, normal: &Vec3<R>) -> [Feature; 2] {
        let ids = &simplex.ids[..simplex.count];
        [
            feature(self.a, ids, 0, || self.in_axes_of_a(normal).to_f64()),
            feature(self.b, ids, 1, || (-self.in_axes_of_b(normal)).to_f64()),
        ]
    }
}

/// How vertices are read and the farthest is found in either precision.
pub(super) trait Heights: Real {
    /// Bound of the relative error that the module's units stand for [-].
    const COST: f64;

    /// The rotation `q/|q|` as rows.
    fn rotation(q: &Quaternion) -> [Vec3<Self>; 3];

    /// Those of two.
    fn rotations(a: &Quaternion, b: &Quaternion) -> Rotations<Self>;

    /// A vertex about the body's centre, body axes.
    fn vertex(body: &ConvexPolyhedron, k: usize) -> Vec3<Self>;

    /// A piece's rotation.
    fn rows_of(piece: &Placement) -> &[Vec3<Self>; 3];

    /// A vertex farthest along `d`, body axes, and a bound of `d · v` over all vertices.
    fn farthest(body: &ConvexPolyhedron, d: &Vec3<Self>, from: Option<u32>) -> (u32, Self);
}

impl Heights for f64 {
    const COST: f64 = Self::UNIT;

    fn rotation(q: &Quaternion) -> [Vec3<f64>; 3] {
        rotation(q)
    }

    #[inline]
    fn rotations(a: &Quaternion, b: &Quaternion) -> Rotations<f64> {
        rotations(a, b)
    }

    #[inline]
    fn vertex(body: &ConvexPolyhedron, k: usize) -> Vec3<f64> {
        Vec3(body.vertices_about_center()[k])
    }

    #[inline]
    fn rows_of(piece: &Placement) -> &[Vec3<f64>; 3] {
        &piece.rows
    }

    /// Climbing is exact but for rounding: the vertices of a convex body that are at least as high as
    /// a given one hang together along its edges. So if a neighbour is as high as the top to within
    /// rounding, the plateau is followed to its end.
    #[inline]
    fn farthest(body: &ConvexPolyhedron, d: &Vec3<f64>, from: Option<u32>) -> (u32, f64) {
        let vertices = body.vertices_about_center();
        if vertices.len() <= SCAN {
            return highest(body.blocks(), &d.0);
        }

        // uphill, remembering how high the highest neighbour of the top is
        let mut at = from.unwrap_or_else(|| u32::try_from(body.seed_for(&d.0)).unwrap_or(0));
        let mut top = Vec3(vertices[at as usize]).dot(d);
        let runner_up = loop {
            let ring = body.ring_blocks(at as usize);
            let height = top_of(ring, &d.0);
            if height <= top {
                break height;
            }
            (at, top) = highest(ring, &d.0);
        };

        let slack = plateau_slack(body, d);
        if runner_up < top - slack { (at, top) } else { plateau_top(body, at, top, top - slack, &d.0) }
    }
}

/// How far apart heights along `d` have to be for the higher one to be told [m].
#[inline]
fn plateau_slack(body: &ConvexPolyhedron, d: &Vec3<f64>) -> f64 {
    // |d|₁ ≥ |d|
    PLATEAU_UNITS * f64::UNIT * body.radius() * (d.0[0].abs() + d.0[1].abs() + d.0[2].abs())
}

/// The height along `d`, body axes, of a vertex given twice or of the ends of an edge, if no other vertex comes as
/// high: none does where no neighbour does.
#[inline]
pub(super) fn crest(body: &ConvexPolyhedron, d: &Vec3<f64>, ends: Ids) -> Option<f64> {
    let [h, k] = ends.map(|i| Vec3(body.vertices_about_center()[i as usize]).dot(d));
    let floor = (if h < k { h } else { k }) - plateau_slack(body, d);
    let is_passed = |i: u32| others_reach(body.ring_blocks(i as usize), floor, &d.0, ends);
    let is_crest = !is_passed(ends[0]) && (ends[0] == ends[1] || !is_passed(ends[1]));
    is_crest.then_some(if h > k { h } else { k })
}

/// The highest of the vertices that hang together with the top at heights from `floor` on.
#[inline(never)]
#[expect(clippy::manual_contains, reason = "of two or three, which `contains` is too wide for")]
fn plateau_top(body: &ConvexPolyhedron, at: u32, top: f64, floor: f64, d: &[f64; 3]) -> (u32, f64) {
    let mut seen = [at; PLATEAU];
    let (mut count, mut next) = (1, 0);
    let mut best = (at, top);
    while next < count {
        for block in body.ring_blocks(seen[next] as usize) {
            for (k, h) in block.at_least(floor, d) {
                if seen[..count].iter().any(|&known| known == k) {
                    continue;
                }
                if h > best.1 {
                    best = (k, h);
                }
                if count == PLATEAU {
                    // a large flat face: look at all
                    return highest(body.blocks(), d);
                }
                seen[count] = k;
                count += 1;
            }
        }
        next += 1;
    }
    best
}

impl Heights for DoubleDouble {
    /// Its rotation is not as finely made: 17 units in place of √3, below four times all bounds.
    const COST: f64 = 4.0 * Self::UNIT;

    fn rotation(q: &Quaternion) -> [Vec3<Self>; 3] {
        precise_rotation(q)
    }

    fn rotations(a: &Quaternion, b: &Quaternion) -> Rotations<Self> {
        Rotations::of(&precise_rotation(a), &precise_rotation(b))
    }

    /// As given, less the centre: without rounding.
    fn vertex(body: &ConvexPolyhedron, k: usize) -> Vec3<Self> {
        let (v, c) = (body.vertices()[k], body.center());
        Vec3([0, 1, 2].map(|i| Self::sum(v[i], -c[i])))
    }

    fn rows_of(piece: &Placement) -> &[Vec3<Self>; 3] {
        &piece.precise
    }

    /// All vertices are looked at in `f64`, and those near the top in double-double.
    fn farthest(body: &ConvexPolyhedron, d: &Vec3<Self>, _from: Option<u32>) -> (u32, Self) {
        let vertices = body.vertices_about_center();
        let rough = Vec3::<f64>(d.to_f64());
        let rough_height = |v: &[f64; 3]| Vec3(*v).dot(&rough);
        let top = vertices.iter().map(rough_height).fold(f64::MIN, f64::max);
        let floor = top - 16.0 * f64::EPSILON * body.radius() * rough.norm();
        let mut best: Option<(u32, Self)> = None;
        for (k, _) in (0..).zip(vertices).filter(|(_, v)| rough_height(v) >= floor) {
            let h = Self::vertex(body, k as usize).dot(d);
            if best.is_none_or(|b| h > b.1) {
                best = Some((k, h));
            }
        }
        best.unwrap_or((0, Self::default()))
    }
}

/// The feature spanned by a body's vertices in up to four pairs; of several faces the one that faces outward.
#[inline]
pub(super) fn feature(body: &ConvexPolyhedron, pairs: &[Ids], side: usize, outward: impl Fn() -> [f64; 3]) -> Feature {
    let mut distinct = [0; 4];
    let mut count = 0;
    for ids in pairs {
        if !distinct[..count].contains(&ids[side]) {
            distinct[count] = ids[side];
            count += 1;
        }
    }
    if count == 1 {
        return Feature::Vertex(distinct[0]);
    }
    if count == 2
        && let Some(e) = body.edge_between(distinct[0] as usize, distinct[1] as usize)
    {
        return Feature::Edge(u32::try_from(e).unwrap_or(u32::MAX));
    }
    if count == 3
        && let Some(f) = body.triangle(&distinct)
    {
        return Feature::Face(f);
    }
    let holds_all = |f: &u32| distinct[1..count].iter().all(|&v| body.faces_at(v as usize).contains(f));
    let mut candidates = body.faces_at(distinct[0] as usize).iter().copied().filter(holds_all);
    let first = candidates.next();
    if body.rank() == 3
        && let Some(f) = first
    {
        return Feature::Face(f);
    }

    // a polygon's two faces hold the same vertices; and rounding may have put them on no common face
    let d: Vec3<f64> = Vec3(outward());
    let facing = |&f: &u32| d.dot(&Vec3(body.faces()[f as usize].normal));
    let all = body.faces_at(distinct[0] as usize).iter().copied();
    all.max_by(|f, g| facing(f).total_cmp(&facing(g))).map_or(Feature::Vertex(distinct[0]), Feature::Face)
}
