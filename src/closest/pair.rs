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
//! **Error bounds.** With `u = ε/2`, `ρ` the radii and `R` the rotation of `q/|q|` as computed,
//!
//! ```text
//! ‖δR‖ ≤ 17 u        k = 2/|q|² to 4 u, which scales R − I (norm ≤ 2): 8 u; products and sums of the
//!                    entries: 9 u in the ∞-norm and so in the 2-norm
//! |δ(R v)| ≤ 22 u ρ  and 5 u for the three products and two sums of each component
//! |δ(n·w)| ≤ 29 u (ρ_A + ρ_B) + 10 u |t|   for a unit n, through either body's axes; of this 1 u ρ for
//!                    vertices taken about a centre that is not the origin
//! ```
//!
//! so the height of the difference along any direction, and the length of any of its points, are known
//! to `error`. The same number is charged once to the lower and once to the upper bound of every answer.

use super::simplex::Simplex;
use super::vector::Vec3;
use crate::math::double_double::{DoubleDouble, Real};
use crate::math::{Pose, Quaternion};
use crate::shape::convex_polyhedron::ConvexPolyhedron;

/// A vertex of each body.
pub(super) type Ids = [u32; 2];

/// Bound of rounding in heights and lengths, in units `u` times the radii [-]; see the module.
const RADII_UNITS: f64 = 29.0;
/// The same for the distance of the centres [-].
const CENTERS_UNITS: f64 = 10.0;
/// Relative rounding in the climbed heights of one body, in units `u` [-]: two dot products and the
/// direction's own rotation cancel from a comparison; what is left is 2 · (3 + 1) u.
const PLATEAU_UNITS: f64 = 10.0;
/// Up to this many vertices all are looked at, which costs no more than climbing.
const SCAN: usize = 16;
/// Vertices of equal height that are followed before all are looked at.
const PLATEAU: usize = 32;

/// Two polyhedra, posed.
#[derive(Debug)]
pub(super) struct Pair<'a, R> {
    pub(super) a: &'a ConvexPolyhedron,
    pub(super) b: &'a ConvexPolyhedron,
    /// Rows of the rotations, body to world.
    pub(super) rotation_a: [Vec3<R>; 3],
    pub(super) rotation_b: [Vec3<R>; 3],
    /// From the centre of A to that of B, world axes [m].
    pub(super) between: Vec3<R>,
    /// Both radii and the distance of the centres [m].
    pub(super) size: f64,
    /// Bound of the rounding error of a height or a length [m].
    pub(super) error: f64,
}

/// The rotation `q/|q|` as rows.
#[inline]
fn rows<R: Real>(q: &Quaternion) -> [Vec3<R>; 3] {
    let [w, x, y, z] = [q.w, q.i, q.j, q.k].map(R::from);
    let (one, two) = (R::from(1.0), R::from(2.0));
    let k = two / ((w * w + x * x) + (y * y + z * z));
    let (kx, ky, kz) = (k * x, k * y, k * z);
    let (xx, yy, zz) = (kx * x, ky * y, kz * z);
    let (xy, xz, yz) = (kx * y, kx * z, ky * z);
    let (wx, wy, wz) = (kx * w, ky * w, kz * w);
    [
        Vec3([one - (yy + zz), xy - wz, xz + wy]),
        Vec3([xy + wz, one - (xx + zz), yz - wx]),
        Vec3([xz - wy, yz + wx, one - (xx + yy)]),
    ]
}

/// `R v`.
#[inline]
fn rotate<R: Real>(rows: &[Vec3<R>; 3], v: &Vec3<R>) -> Vec3<R> {
    Vec3([rows[0].dot(v), rows[1].dot(v), rows[2].dot(v)])
}

/// `Rᵀ v`.
#[inline]
fn rotate_back<R: Real>(rows: &[Vec3<R>; 3], v: &Vec3<R>) -> Vec3<R> {
    rows[0].scaled(v.0[0]) + rows[1].scaled(v.0[1]) + rows[2].scaled(v.0[2])
}

impl<'a> Pair<'a, f64> {
    #[inline]
    pub(super) fn new(a: &'a ConvexPolyhedron, pose_a: &Pose, b: &'a ConvexPolyhedron, pose_b: &Pose) -> Self {
        let between = if a.is_about_origin() && b.is_about_origin() {
            Vec3((pose_b.position - pose_a.position).into())
        } else {
            Vec3(center_to_center(a, pose_a, b, pose_b).to_f64())
        };
        let (rotation_a, rotation_b) = (rows(&pose_a.orientation), rows(&pose_b.orientation));
        Self::assemble(a, rotation_a, b, rotation_b, between)
    }
}

impl<'a> Pair<'a, DoubleDouble> {
    pub(super) fn precise(a: &'a ConvexPolyhedron, pose_a: &Pose, b: &'a ConvexPolyhedron, pose_b: &Pose) -> Self {
        let between = center_to_center(a, pose_a, b, pose_b);
        let (rotation_a, rotation_b) = (rows(&pose_a.orientation), rows(&pose_b.orientation));
        Self::assemble(a, rotation_a, b, rotation_b, between)
    }
}

/// `t` in double-double: positions and centres may be large and cancel.
fn center_to_center(a: &ConvexPolyhedron, pose_a: &Pose, b: &ConvexPolyhedron, pose_b: &Pose) -> Vec3<DoubleDouble> {
    let center = |body: &ConvexPolyhedron, pose: &Pose| {
        rotate(&rows(&pose.orientation), &Vec3::new(body.center())) + Vec3::new(pose.position.into())
    };
    center(b, pose_b) - center(a, pose_a)
}

impl<'a, R: Real + Heights> Pair<'a, R> {
    #[inline]
    fn assemble(
        a: &'a ConvexPolyhedron,
        rotation_a: [Vec3<R>; 3],
        b: &'a ConvexPolyhedron,
        rotation_b: [Vec3<R>; 3],
        between: Vec3<R>,
    ) -> Self {
        let (radii, centers) = (a.radius() + b.radius(), Vec3::<f64>(between.to_f64()).norm());
        let error = R::UNIT * (RADII_UNITS * radii + CENTERS_UNITS * centers);
        Self { a, b, rotation_a, rotation_b, between, size: radii + centers, error }
    }

    /// A vertex of A about its centre, world axes.
    #[inline]
    pub(super) fn point_a(&self, i: u32) -> Vec3<R> {
        rotate(&self.rotation_a, &R::vertex(self.a, i as usize))
    }

    /// A vertex of B about its centre, world axes.
    #[inline]
    pub(super) fn point_b(&self, j: u32) -> Vec3<R> {
        rotate(&self.rotation_b, &R::vertex(self.b, j as usize))
    }

    /// `w(i, j)`: a point of the difference [m].
    #[inline]
    pub(super) fn difference(&self, [i, j]: Ids) -> Vec3<R> {
        (self.point_b(j) + self.between) - self.point_a(i)
    }

    /// The simplex of up to four points of the difference. Neighbouring pairs often share a vertex, which
    /// is then placed once.
    #[inline]
    pub(super) fn simplex(&self, ids: &[Ids]) -> Simplex<R> {
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

    /// The lowest point of the difference along `n`, by climbing from `from`, and a proven lower bound of
    /// its height `n · w`, but for the pair's `error` times `|n|`.
    #[inline]
    pub(super) fn lowest(&self, n: &Vec3<R>, from: Option<Ids>) -> (Ids, R) {
        let (da, db) = (rotate_back(&self.rotation_a, n), -rotate_back(&self.rotation_b, n));
        let (i, high_a) = R::farthest(self.a, &da, from.map(|f| f[0]));
        let (j, high_b) = R::farthest(self.b, &db, from.map(|f| f[1]));
        ([i, j], n.dot(&self.between) - high_a - high_b)
    }

    /// A direction of the world in the axes of A.
    #[inline]
    pub(super) fn in_axes_of_a(&self, n: &Vec3<R>) -> Vec3<R> {
        rotate_back(&self.rotation_a, n)
    }

    /// A direction of the world in the axes of B.
    #[inline]
    pub(super) fn in_axes_of_b(&self, n: &Vec3<R>) -> Vec3<R> {
        rotate_back(&self.rotation_b, n)
    }
}

/// How vertices are read and the farthest is found in either precision.
pub(super) trait Heights: Real {
    /// A vertex about the body's centre, body axes.
    fn vertex(body: &ConvexPolyhedron, k: usize) -> Vec3<Self>;

    /// A vertex farthest along `d`, body axes, and a bound of `d · v` over all vertices.
    fn farthest(body: &ConvexPolyhedron, d: &Vec3<Self>, from: Option<u32>) -> (u32, Self);
}

impl Heights for f64 {
    #[inline]
    fn vertex(body: &ConvexPolyhedron, k: usize) -> Vec3<f64> {
        Vec3(body.vertices_about_center()[k])
    }

    /// Climbing is exact but for rounding: the vertices of a convex body that are at least as high as
    /// a given one hang together along its edges. So if a neighbour is as high as the top to within
    /// rounding, the plateau is followed to its end.
    #[inline]
    fn farthest(body: &ConvexPolyhedron, d: &Vec3<f64>, from: Option<u32>) -> (u32, f64) {
        let vertices = body.vertices_about_center();
        let height = |v: &[f64; 3]| v[0] * d.0[0] + v[1] * d.0[1] + v[2] * d.0[2];
        if vertices.len() <= SCAN {
            return highest(vertices, height);
        }

        // uphill, remembering the highest neighbour of the top
        let mut at = from.unwrap_or_else(|| u32::try_from(body.seed_for(&d.0)).unwrap_or(0));
        let mut top = height(&vertices[at as usize]);
        let mut runner_up;
        loop {
            let mut best = at;
            runner_up = f64::MIN;
            for (k, v) in body.ring_points(at as usize) {
                let h = height(v);
                if h > top {
                    (top, best) = (h, k);
                }
                runner_up = if h > runner_up { h } else { runner_up };
            }
            if best == at {
                break;
            }
            at = best;
        }

        // |d|₁ ≥ |d|
        let slack = PLATEAU_UNITS * Self::UNIT * body.radius() * (d.0[0].abs() + d.0[1].abs() + d.0[2].abs());
        if runner_up < top - slack { (at, top) } else { plateau_top(body, at, top, slack, height) }
    }
}

/// The highest of all vertices.
#[inline]
fn highest(vertices: &[[f64; 3]], height: impl Fn(&[f64; 3]) -> f64) -> (u32, f64) {
    let mut top = (0, f64::MIN);
    for (k, v) in (0..).zip(vertices) {
        let h = height(v);
        if h > top.1 {
            top = (k, h);
        }
    }
    top
}

/// The highest of the vertices that hang together with the top at heights within `slack` of it.
fn plateau_top(
    body: &ConvexPolyhedron,
    at: u32,
    top: f64,
    slack: f64,
    height: impl Fn(&[f64; 3]) -> f64,
) -> (u32, f64) {
    let mut seen = [at; PLATEAU];
    let (mut count, mut next) = (1, 0);
    let mut best = (at, top);
    let floor = top - slack;
    while next < count {
        for (k, v) in body.ring_points(seen[next] as usize) {
            let h = height(v);
            if h < floor || seen[..count].contains(&k) {
                continue;
            }
            if h > best.1 {
                best = (k, h);
            }
            if count == PLATEAU {
                // a large flat face: look at all
                return highest(body.vertices_about_center(), height);
            }
            seen[count] = k;
            count += 1;
        }
        next += 1;
    }
    best
}

impl Heights for DoubleDouble {
    /// As given, less the centre: without rounding.
    fn vertex(body: &ConvexPolyhedron, k: usize) -> Vec3<Self> {
        let (v, c) = (body.vertices()[k], body.center());
        Vec3([0, 1, 2].map(|i| Self::sum(v[i], -c[i])))
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
