//! The contact manifold: all points in which two touching convex bodies carry each other.
//!
//! The closest features give one pair of points; two cubes face on face touch in a polygon. Every
//! separation of the two bodies is some direction's,
//!
//! ```text
//! s(n) = min n·b − max n·a,      signed distance = max s(n)
//! ```
//!
//! so the contact's normals are the n whose s(n) is within ε of the signed distance. Tried are, exactly, the
//! normals of the faces that hold the closest points, the products of the edges and axes of round sides that do, and
//! what is across an axis to another, or to an edge, along it:
//!
//! | normals found | contact |
//! |---|---|
//! | one direction | the patches foremost along it, cut with each other: polygon, segment or point |
//! | several | the cone that they span: vertex on vertex, vertex on edge, parallel edges |
//! | several, on a round side | the one with the largest s |
//! | none (round bodies) | the normal of the closest points |
//!
//! The patches of both bodies (all that lies within ε of foremost, see [`Surface`]) meet in
//!
//! | patches | points |
//! |---|---|
//! | point on anything | one |
//! | segment on polygon | both ends of what lies inside |
//! | segment on segment | the crossing, or both ends of the overlap of parallel ones |
//! | polygon on polygon | every corner of the intersection |
//!
//! Order: corners of a, then of b, then crossings, each by their numbers, sorted counterclockwise about the
//! normal from the first; the same bodies in the same poses give the same list. All is worked out in the
//! axes of a, so a far origin costs no digits; a half space counts as b's partner in its own axes too.

pub use super::patch::Surface;

use super::cluster::Contact;
use super::patch::Corner;
use crate::closest::Feature;
use crate::math::{Pose, Vector3, quaternion};

/// One point of a manifold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ManifoldPoint {
    /// On the surface of a, world axes [m].
    pub point_a: Vector3,
    /// On the surface of b, world axes [m].
    pub point_b: Vector3,
    /// From a to b along the normal [m]; negative in overlap.
    pub gap: f64,
    /// The feature of a that makes this a corner, where a has features.
    pub feature_a: Option<Feature>,
    /// The feature of b.
    pub feature_b: Option<Feature>,
}

/// All points in which two bodies touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Manifold {
    /// Unit normals from a to b, world axes: one, or those that span the cone of normals.
    pub normals: Vec<Vector3>,
    /// The points; at least one.
    pub points: Vec<ManifoldPoint>,
}

impl Manifold {
    /// The contacts that the manifold means, between the bodies of these places in a cluster: one a point,
    /// half way between the surfaces.
    pub fn contacts(&self, a: usize, b: usize, friction: f64, restitution: f64) -> Vec<Contact> {
        let of = |p: &ManifoldPoint| Contact {
            a,
            b,
            point: 0.5 * (p.point_a + p.point_b),
            normals: self.normals[..].into(),
            friction,
            restitution,
        };
        self.points.iter().map(of).collect()
    }
}

/// Closest points of two bodies, as a query of closest features gives them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// On a, world axes [m].
    pub point_a: Vector3,
    /// On b, world axes [m].
    pub point_b: Vector3,
    /// Unit normal from a to b, world axes.
    pub normal: Vector3,
    /// Signed distance [m].
    pub signed_distance: f64,
}

impl From<&crate::closest::ClosestFeatures> for Touch {
    fn from(c: &crate::closest::ClosestFeatures) -> Self {
        Self { point_a: c.point_a, point_b: c.point_b, normal: c.normal, signed_distance: c.signed_distance }
    }
}

/// The manifold of two posed bodies whose closest points are known, with all points whose gap is within
/// `eps` [m] of the least one.
///
/// `eps` decides what counts as flat: it should be some hundred times the rounding of the coordinates, and
/// far below the size of the bodies.
pub fn manifold(a: &Surface<'_>, pose_a: &Pose, b: &Surface<'_>, pose_b: &Pose, touch: &Touch, eps: f64) -> Manifold {
    // everything in the axes of a
    let b_in_a = Pose {
        position: pose_a.inverse_vector(&(pose_b.position - pose_a.position)),
        orientation: quaternion::normalized(&(pose_a.orientation.conjugate() * pose_b.orientation)),
    };
    let pair = Pair { a, b, b_in_a, eps };
    let hint = pose_a.inverse_vector(&touch.normal);
    let near_a = pose_a.inverse_vector(&(touch.point_a - pose_a.position));
    let near_b = pose_b.inverse_vector(&(touch.point_b - pose_b.position));
    let found = pair.normals(&near_a, &near_b, touch.signed_distance);
    let normals = if found.is_empty() { vec![hint] } else { found };

    // the points, along the middle of the normals
    let sum: Vector3 = normals.iter().sum();
    let n = if normals.len() == 1 { normals[0] } else { sum.try_normalize(0.0).unwrap_or(hint) };
    let mut points = pair.points(&n);
    let least = points.iter().map(|p| p.gap).fold(f64::INFINITY, f64::min);
    points.retain(|p| p.gap <= least + eps);
    if points.is_empty() {
        let b = b_in_a.point(&near_b);
        points.push(ManifoldPoint {
            point_a: near_a,
            point_b: b,
            gap: n.dot(&(b - near_a)),
            feature_a: None,
            feature_b: None,
        });
    }

    for p in &mut points {
        p.point_a = pose_a.point(&p.point_a);
        p.point_b = pose_a.point(&p.point_b);
    }
    Manifold { normals: normals.iter().map(|n| pose_a.vector(n)).collect(), points }
}

/// Two surfaces, in the axes of a.
struct Pair<'a, 'b> {
    a: &'a Surface<'b>,
    b: &'a Surface<'b>,
    b_in_a: Pose,
    eps: f64,
}

impl Pair<'_, '_> {
    /// The normals whose separation is within ε of the signed distance; those that differ by less than the
    /// tilt of ε over the bodies count once.
    fn normals(&self, near_a: &Vector3, near_b: &Vector3, distance: f64) -> Vec<Vector3> {
        if let Surface::HalfSpace(plane) = self.a {
            return vec![plane.plane().0];
        }
        if let Surface::HalfSpace(plane) = self.b {
            return vec![-self.b_in_a.vector(&plane.plane().0)];
        }
        let slack = 2.0 * self.eps;
        let mut tried = self.a.flat_at(near_a, slack);
        tried.extend(self.b.flat_at(near_b, slack).iter().map(|n| -self.b_in_a.vector(n)));
        let mut is_round = false;
        let lines_of_b = self.b.lines_at(near_b, slack);
        for e in self.a.lines_at(near_a, slack) {
            for f in &lines_of_b {
                let across = e.direction.cross(&self.b_in_a.vector(&f.direction));
                let length = across.norm();
                if length > PARALLEL {
                    tried.extend([across / length, -across / length]);
                } else if e.is_round || f.is_round {
                    let from = self.b_in_a.point(&f.from) - e.from;
                    tried.extend((from - e.direction.dot(&from) * e.direction).try_normalize(0.0));
                }
                is_round |= e.is_round || f.is_round;
            }
        }
        let size = self.size();
        let mut kept: Vec<(f64, Vector3)> = Vec::new();
        for n in tried {
            let separation = self.separation(&n);
            if separation < distance - self.eps {
                continue;
            }
            match kept.iter_mut().find(|(_, k)| (k - n).norm() * size <= 2.0 * self.eps) {
                Some(same) if separation > same.0 => *same = (separation, n),
                Some(_) => {}
                None => kept.push((separation, n)),
            }
        }
        if is_round {
            kept.sort_by(|a, b| b.0.total_cmp(&a.0));
            kept.truncate(1);
        }
        kept.into_iter().map(|(_, n)| n).collect()
    }

    /// Reach of the smaller body [m], at least.
    fn size(&self) -> f64 {
        let of = |s: &Surface<'_>| {
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            axes.iter().map(|d| s.reach(d) + s.reach(&-d)).fold(0.0, f64::max)
        };
        of(self.a).min(of(self.b))
    }

    /// s(n).
    fn separation(&self, n: &Vector3) -> f64 {
        let towards = -self.b_in_a.inverse_vector(n);
        n.dot(&self.b_in_a.position) - self.b.reach(&towards) - self.a.reach(n)
    }

    /// The points in which the patches along `n` meet.
    fn points(&self, n: &Vector3) -> Vec<ManifoldPoint> {
        let plane = Plane::new(n);
        let towards = -self.b_in_a.inverse_vector(n);
        let of_b: Vec<Corner> = self.b.foremost(&towards, self.eps).iter().map(|c| c.moved(&self.b_in_a)).collect();
        let mut a = plane.patch(&self.a.foremost(n, self.eps), self.eps);
        let mut b = plane.patch(&of_b, self.eps);
        a.rim = self.a.disc(n, self.eps).map(|(middle, radius)| (plane.flat(&middle), radius));
        b.rim = self.b.disc(&towards, self.eps).map(|(middle, r)| (plane.flat(&self.b_in_a.point(&middle)), r));
        let (face_a, face_b) = (self.a.face_of(&a.corners, n), self.b.face_of(&b.corners, &towards));

        // a half space is met wherever the other patch lies
        if let Surface::HalfSpace(h) = self.a {
            let (normal, offset) = h.plane();
            return self.on_plane(&b, &normal, offset, false);
        }
        if let Surface::HalfSpace(h) = self.b {
            let (normal, offset) = h.plane();
            let normal = self.b_in_a.vector(&normal);
            return self.on_plane(&a, &normal, offset + normal.dot(&self.b_in_a.position), true);
        }

        // corners of each inside the other, and crossings of their sides and rims
        let mut met: Vec<([f64; 2], Option<Feature>, Option<Feature>)> = Vec::new();
        for (k, p) in a.flat.iter().enumerate() {
            if b.holds(p, self.eps) {
                met.push((*p, a.corners[k].feature(), if b.flat.len() > 2 { face_b } else { b.feature(self.b, 0) }));
            }
        }
        for (k, p) in b.flat.iter().enumerate() {
            if a.holds(p, self.eps) {
                met.push((*p, if a.flat.len() > 2 { face_a } else { a.feature(self.a, 0) }, b.corners[k].feature()));
            }
        }
        for (i, side) in a.sides().enumerate() {
            met.extend(b.crossings_of_rim(side).map(|p| (p, a.feature(self.a, i), None)));
        }
        for (j, other) in b.sides().enumerate() {
            met.extend(a.crossings_of_rim(other).map(|p| (p, None, b.feature(self.b, j))));
            for (i, side) in a.sides().enumerate().filter(|_| a.rim.is_none() && b.rim.is_none()) {
                if let Some(p) = crossing(side, other, self.eps) {
                    met.push((p, a.feature(self.a, i), b.feature(self.b, j)));
                }
            }
        }
        let mut kept: Vec<([f64; 2], Option<Feature>, Option<Feature>)> = Vec::new();
        for m in met {
            if kept.iter().all(|k| distance(&k.0, &m.0) > 2.0 * self.eps) {
                kept.push(m);
            }
        }
        around(&mut kept);
        let made = kept.into_iter().map(|(p, feature_a, feature_b)| {
            let (point_a, point_b) = (plane.point(&p, a.height(&p)), plane.point(&p, b.height(&p)));
            ManifoldPoint { point_a, point_b, gap: n.dot(&(point_b - point_a)), feature_a, feature_b }
        });
        made.collect()
    }

    /// The corners of a patch above the plane `normal · x = offset`.
    fn on_plane(&self, patch: &Patch, normal: &Vector3, offset: f64, patch_is_a: bool) -> Vec<ManifoldPoint> {
        let point = |corner: &Corner| {
            let gap = normal.dot(&corner.at) - offset;
            let foot = corner.at - gap * normal;
            let feature = corner.feature();
            if patch_is_a {
                ManifoldPoint { point_a: corner.at, point_b: foot, gap, feature_a: feature, feature_b: None }
            } else {
                ManifoldPoint { point_a: foot, point_b: corner.at, gap, feature_a: None, feature_b: feature }
            }
        };
        let mut points: Vec<ManifoldPoint> = patch.corners.iter().map(point).collect();
        let least = points.iter().map(|p| p.gap).fold(f64::INFINITY, f64::min);
        points.retain(|p| p.gap <= least + self.eps);
        points
    }
}

/// Sine of the angle below which two edges have no common normal worth trying [-]: their product would be
/// rounding. Such edges touch along faces or as parallel edges, whose normals are the faces'.
const PARALLEL: f64 = 1.0e-7;

/// A plane across a normal, with two axes.
struct Plane {
    normal: Vector3,
    first: Vector3,
    second: Vector3,
}

/// What lies foremost, seen along the normal: its hull, counterclockwise, with the corners it is made of.
struct Patch {
    flat: Vec<[f64; 2]>,
    heights: Vec<f64>,
    corners: Vec<Corner>,
    /// The circle that the hull's corners are in, of a disc: its middle and radius.
    rim: Option<([f64; 2], f64)>,
}

impl Plane {
    fn new(normal: &Vector3) -> Self {
        let [normal, first, second] = super::cluster::Frame::new(normal).0;
        Self { normal, first, second }
    }

    fn point(&self, p: &[f64; 2], height: f64) -> Vector3 {
        p[0] * self.first + p[1] * self.second + height * self.normal
    }

    fn flat(&self, p: &Vector3) -> [f64; 2] {
        [self.first.dot(p), self.second.dot(p)]
    }

    /// The hull of corners; what is thinner than ε is a segment, what is shorter a point.
    fn patch(&self, corners: &[Corner], eps: f64) -> Patch {
        let mut order: Vec<usize> = (0..corners.len()).collect();
        let at: Vec<[f64; 2]> = corners.iter().map(|c| self.flat(&c.at)).collect();
        order.sort_by(|&i, &j| at[i][0].total_cmp(&at[j][0]).then(at[i][1].total_cmp(&at[j][1])));

        // Andrew's chain, which keeps only corners that stand out by more than ε
        let chain = |order: &mut dyn Iterator<Item = usize>| {
            let mut hull: Vec<usize> = Vec::new();
            for k in order {
                while hull.len() >= 2 && !stands_out(&at[hull[hull.len() - 2]], &at[hull[hull.len() - 1]], &at[k], eps)
                {
                    hull.pop();
                }
                hull.push(k);
            }
            hull.pop();
            hull
        };
        let mut hull = chain(&mut order.iter().copied());
        hull.extend(chain(&mut order.iter().rev().copied()));
        if hull.is_empty() {
            hull.extend(order.first());
        }
        if hull.len() == 2 && distance(&at[hull[0]], &at[hull[1]]) <= eps {
            hull.truncate(1);
        }
        Patch {
            flat: hull.iter().map(|&k| at[k]).collect(),
            heights: hull.iter().map(|&k| self.normal.dot(&corners[k].at)).collect(),
            corners: hull.iter().map(|&k| corners[k]).collect(),
            rim: None,
        }
    }
}

/// Whether `b` lies to the right of the way from `a` to `c` by more than ε: a corner of a counterclockwise
/// hull.
fn stands_out(a: &[f64; 2], b: &[f64; 2], c: &[f64; 2], eps: f64) -> bool {
    let (x, y) = ([c[0] - a[0], c[1] - a[1]], [b[0] - a[0], b[1] - a[1]]);
    x[1] * y[0] - x[0] * y[1] > eps * libm::hypot(x[0], x[1])
}

fn distance(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

impl Patch {
    /// The sides: none of a point, one of a segment, all of a polygon.
    fn sides(&self) -> impl Iterator<Item = [&[f64; 2]; 2]> {
        let n = self.flat.len();
        let count = if n < 3 { n.saturating_sub(1) } else { n };
        (0..count).map(move |k| [&self.flat[k], &self.flat[(k + 1) % n]])
    }

    /// The feature of side `k`; of a point its vertex.
    fn feature(&self, surface: &Surface<'_>, k: usize) -> Option<Feature> {
        let n = self.corners.len();
        match n {
            0 => None,
            1 => self.corners[0].feature(),
            _ => surface.edge_of(&self.corners[k], &self.corners[(k + 1) % n]),
        }
    }

    /// Whether a place lies in the patch to within ε.
    fn holds(&self, p: &[f64; 2], eps: f64) -> bool {
        if let Some((middle, radius)) = &self.rim {
            return distance(middle, p) <= radius + eps;
        }
        match &self.flat[..] {
            [] => false,
            [only] => distance(only, p) <= eps,
            [from, to] => {
                let (d, q) = ([to[0] - from[0], to[1] - from[1]], [p[0] - from[0], p[1] - from[1]]);
                let length = libm::hypot(d[0], d[1]);
                let (along, off) = ((d[0] * q[0] + d[1] * q[1]) / length, (d[0] * q[1] - d[1] * q[0]) / length);
                off.abs() <= eps && (-eps..=length + eps).contains(&along)
            }
            _ => self.sides().all(|[from, to]| {
                let (d, q) = ([to[0] - from[0], to[1] - from[1]], [p[0] - from[0], p[1] - from[1]]);
                d[0] * q[1] - d[1] * q[0] >= -eps * libm::hypot(d[0], d[1])
            }),
        }
    }

    /// Where a side crosses the rim; nowhere without one.
    fn crossings_of_rim(&self, [from, to]: [&[f64; 2]; 2]) -> impl Iterator<Item = [f64; 2]> + use<> {
        let (from, d) = (*from, [to[0] - from[0], to[1] - from[1]]);
        let parts = self.rim.map(|(middle, radius)| {
            let q = [from[0] - middle[0], from[1] - middle[1]];
            let square = d[0] * d[0] + d[1] * d[1];
            let (half, cross) = (-(d[0] * q[0] + d[1] * q[1]) / square, d[0] * q[1] - d[1] * q[0]);
            let off = cross * cross / square;
            let reach = ((radius * radius - off) / square).sqrt();
            [half - reach, half + reach]
        });
        let within = parts.into_iter().flatten().filter(|part| (0.0..=1.0).contains(part));
        within.map(move |part| [from[0] + part * d[0], from[1] + part * d[1]])
    }

    /// Height of the patch at a place: of the point, along the segment, or of the plane through a polygon
    /// (Newell's normal, which takes all corners alike).
    fn height(&self, p: &[f64; 2]) -> f64 {
        match &self.flat[..] {
            [] => 0.0,
            [_] => self.heights[0],
            [from, to] => {
                let (d, q) = ([to[0] - from[0], to[1] - from[1]], [p[0] - from[0], p[1] - from[1]]);
                let part = (d[0] * q[0] + d[1] * q[1]) / (d[0] * d[0] + d[1] * d[1]);
                self.heights[0] + part * (self.heights[1] - self.heights[0])
            }
            flat => {
                let n = flat.len();
                let count = n as f64;
                let middle = [0, 1].map(|k| flat.iter().map(|p| p[k]).sum::<f64>() / count);
                let level = self.heights.iter().sum::<f64>() / count;
                let mut normal = [0.0; 3];
                for k in 0..n {
                    let (i, j) = (k, (k + 1) % n);
                    let a = [flat[i][0] - middle[0], flat[i][1] - middle[1], self.heights[i] - level];
                    let b = [flat[j][0] - middle[0], flat[j][1] - middle[1], self.heights[j] - level];
                    for (c, entry) in normal.iter_mut().enumerate() {
                        *entry += a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
                    }
                }
                level - (normal[0] * (p[0] - middle[0]) + normal[1] * (p[1] - middle[1])) / normal[2]
            }
        }
    }
}

/// Where two sides cross, well inside both; sides that run along each other to within ε do not cross.
fn crossing([a, b]: [&[f64; 2]; 2], [c, d]: [&[f64; 2]; 2], eps: f64) -> Option<[f64; 2]> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
    let (lu, lv) = (libm::hypot(u[0], u[1]), libm::hypot(v[0], v[1]));
    let sine = (u[0] * v[1] - u[1] * v[0]) / (lu * lv);
    if sine.abs() * lu.min(lv) <= eps {
        return None;
    }
    let w = [c[0] - a[0], c[1] - a[1]];
    let s = (w[0] * v[1] - w[1] * v[0]) / (lu * lv * sine);
    let t = (w[0] * u[1] - w[1] * u[0]) / (lu * lv * sine);
    let inside = (-eps..=lu + eps).contains(&(s * lu)) && (-eps..=lv + eps).contains(&(t * lv));
    inside.then(|| [a[0] + s * u[0], a[1] + s * u[1]])
}

/// Sorts counterclockwise about the middle, from the first on.
fn around(points: &mut [([f64; 2], Option<Feature>, Option<Feature>)]) {
    if points.len() < 3 {
        return;
    }
    let count = points.len() as f64;
    let middle = [0, 1].map(|k| points.iter().map(|p| p.0[k]).sum::<f64>() / count);
    let angle = |p: &[f64; 2]| libm::atan2(p[1] - middle[1], p[0] - middle[0]);
    let start = angle(&points[0].0);
    let turn = |p: &[f64; 2]| {
        let t = angle(p) - start;
        if t < 0.0 { t + std::f64::consts::TAU } else { t }
    };
    points.sort_by(|p, q| turn(&p.0).total_cmp(&turn(&q.0)));
}
