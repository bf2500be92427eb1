//! The signed distance of two small bodies by brute force in double-double, from their vertices alone.
//!
//! Apart: the least distance over all pairs of point–triangle and segment–segment, whichever vertices
//! these join; each is a distance of points of the bodies, and the closest features are among them. It
//! is closed by the support bound along the direction found, so it proves itself.
//! Overlapping: the largest separation over the normals of all triples of either body's vertices and
//! all products of two vertex differences; each is a valid bound, and the true direction is among them.

use bryla::math::Pose;
use bryla::math::double_double::DoubleDouble as Dd;
use bryla::shape::convex_polyhedron::ConvexPolyhedron;

/// The truth about a pair.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Truth {
    pub(crate) signed_distance: f64,
}

type V = [Dd; 3];

fn dd(x: f64) -> Dd {
    Dd::from(x)
}

fn dot(a: &V, b: &V) -> Dd {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sub(a: &V, b: &V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: &V, b: &V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn along(a: &V, d: &V, k: Dd) -> V {
    [a[0] + k * d[0], a[1] + k * d[1], a[2] + k * d[2]]
}

/// Newton's root from the root in `f64`.
fn root(x: Dd) -> Dd {
    if x.hi <= 0.0 {
        return dd(0.0);
    }
    let y = dd(x.hi.sqrt());
    let y = dd(0.5) * (y + x / y);
    dd(0.5) * (y + x / y)
}

/// The vertices in the world, with the rotation of `q/|q|`.
fn world(body: &ConvexPolyhedron, pose: &Pose) -> Vec<V> {
    let [w, x, y, z] = [pose.orientation.w, pose.orientation.i, pose.orientation.j, pose.orientation.k].map(dd);
    let k = dd(2.0) / (w * w + x * x + y * y + z * z);
    let one = dd(1.0);
    let r = [
        [one - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)],
        [k * (x * y + w * z), one - k * (x * x + z * z), k * (y * z - w * x)],
        [k * (x * z - w * y), k * (y * z + w * x), one - k * (x * x + y * y)],
    ];
    let t = [pose.position.x, pose.position.y, pose.position.z].map(dd);
    let place = |v: &[f64; 3]| {
        let v = v.map(dd);
        std::array::from_fn(|i| dot(&r[i], &v) + t[i])
    };
    body.vertices().iter().map(place).collect()
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
}

fn triples(n: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    pairs(n).flat_map(move |(i, j)| (j + 1..n).map(move |k| (i, j, k)))
}

/// The separation of B from A along `n`, for a unit `n` whichever its sign: the larger of both.
fn separation(a: &[V], b: &[V], n: &V) -> Dd {
    let range = |body: &[V]| {
        let first = dot(n, &body[0]);
        body.iter()
            .skip(1)
            .map(|v| dot(n, v))
            .fold((first, first), |(lo, hi), h| (if h < lo { h } else { lo }, if h > hi { h } else { hi }))
    };
    let ((a_low, a_high), (b_low, b_high)) = (range(a), range(b));
    let (forward, backward) = (b_low - a_high, a_low - b_high);
    if forward > backward { forward } else { backward }
}

/// Vectors whose square is below this fraction of the squared size are taken for zero [-]: they come
/// from vertices on one line, whose normal other pairs give.
const ZERO: f64 = 1e-54;

/// The largest separation over every candidate direction.
fn deepest(a: &[V], b: &[V]) -> Dd {
    let mut best: Option<Dd> = None;
    let mut try_direction = |n: V, scale: Dd| {
        let square = dot(&n, &n);
        if square.hi <= ZERO * scale.hi || square.hi == 0.0 {
            return;
        }
        let length = root(square);
        let s = separation(a, b, &n.map(|x| x / length));
        if best.is_none_or(|b| s > b) {
            best = Some(s);
        }
    };
    for body in [a, b] {
        for (i, j, k) in triples(body.len()) {
            let (u, v) = (sub(&body[j], &body[i]), sub(&body[k], &body[i]));
            try_direction(cross(&u, &v), dot(&u, &u) * dot(&v, &v));
        }
    }
    for (i, j) in pairs(a.len()) {
        let u = sub(&a[j], &a[i]);
        for (k, l) in pairs(b.len()) {
            let v = sub(&b[l], &b[k]);
            try_direction(cross(&u, &v), dot(&u, &u) * dot(&v, &v));
        }
    }
    best.unwrap_or(dd(0.0)) // all on one line: any direction off it separates
}

/// Closest vector from `a0 + s u` to `b0 + t v` with s, t in [0, 1], if both are inside or at an end.
fn between_segments(a0: &V, u: &V, b0: &V, v: &V, mut visit: impl FnMut(V)) {
    let w = sub(b0, a0);
    let (uu, uv, vv, uw, vw) = (dot(u, u), dot(u, v), dot(v, v), dot(u, &w), dot(v, &w));
    let (zero, one) = (dd(0.0), dd(1.0));
    let clamp = |x: Dd| {
        if x < zero {
            zero
        } else if x > one {
            one
        } else {
            x
        }
    };
    let mut at = |s: Dd, t: Dd| visit(sub(&along(b0, v, t), &along(a0, u, s)));

    // the four ends against the other segment, and the common normal
    for s in [zero, one] {
        at(s, clamp((s * uv - vw) / vv));
    }
    for t in [zero, one] {
        at(clamp((uw + t * uv) / uu), t);
    }
    let det = uu * vv - uv * uv;
    if det.hi > ZERO * (uu * vv).hi {
        let (s, t) = ((uw * vv - uv * vw) / det, (uv * uw - uu * vw) / det);
        if s > zero && s < one && t > zero && t < one {
            at(s, t);
        }
    }
}

/// The vector from `p` to its foot on a triangle, if that is inside.
fn to_triangle(p: &V, [a, b, c]: [&V; 3]) -> Option<V> {
    let (u, v, w) = (sub(b, a), sub(c, a), sub(p, a));
    let n = cross(&u, &v);
    let nn = dot(&n, &n);
    if nn.hi <= ZERO * (dot(&u, &u) * dot(&v, &v)).hi {
        return None;
    }
    let (beta, gamma) = (dot(&cross(&w, &v), &n) / nn, dot(&cross(&u, &w), &n) / nn);
    let zero = dd(0.0);
    if beta < zero || gamma < zero || beta + gamma > dd(1.0) {
        return None;
    }
    let k = -(dot(&w, &n) / nn);
    Some(n.map(|x| x * k))
}

/// The shortest vector from A to B over all pairs of features.
fn shortest(a: &[V], b: &[V]) -> V {
    let mut best = sub(&b[0], &a[0]);
    let mut least = dot(&best, &best);
    let mut visit = |d: V| {
        let square = dot(&d, &d);
        if square < least {
            (best, least) = (d, square);
        }
    };
    for p in a {
        for q in b {
            visit(sub(q, p));
        }
    }
    let none = [dd(0.0); 3];
    for (i, j) in pairs(a.len()) {
        for (k, l) in pairs(b.len()) {
            between_segments(&a[i], &sub(&a[j], &a[i]), &b[k], &sub(&b[l], &b[k]), &mut visit);
        }
    }
    // a point against a segment, where the other body has no segment
    for (points, ends, sign) in [(a, b, 1.0), (b, a, -1.0)] {
        if points.len() == 1 {
            for (k, l) in pairs(ends.len()) {
                let v = sub(&ends[l], &ends[k]);
                let t = dot(&sub(&points[0], &ends[k]), &v) / dot(&v, &v);
                if t > dd(0.0) && t < dd(1.0) {
                    let d = sub(&along(&ends[k], &v, t), &points[0]);
                    visit(d.map(|x| x * dd(sign)));
                }
            }
        }
        for p in points {
            for (i, j, k) in triples(ends.len()) {
                if let Some(d) = to_triangle(p, [&ends[i], &ends[j], &ends[k]]) {
                    visit(along(&none, &d, dd(sign)));
                }
            }
        }
    }
    best
}

/// How far the support bound may stay below the distance, as a fraction of the size [-]: a direction that
/// is off by δ loses δ in the bound but δ² in the distance, and double-double cannot tell δ² < 1e-32.
const OPEN: f64 = 1e-16;

/// The signed distance, right to about 1e-28 of the size.
pub(crate) fn signed_distance(a: &ConvexPolyhedron, pose_a: &Pose, b: &ConvexPolyhedron, pose_b: &Pose) -> Truth {
    let (va, vb) = (world(a, pose_a), world(b, pose_b));
    let size = crate::size(a, pose_a, b, pose_b);

    // apart, if a support bound says so: along the shortest vector, or, where that is so short that its
    // direction is rounding, along any candidate direction
    let d = shortest(&va, &vb);
    let distance = root(dot(&d, &d));
    if distance.hi > 1e-10 * size {
        let proved = separation(&va, &vb, &d.map(|x| x / distance));
        if proved.hi > 0.0 {
            let gap = (distance - proved).hi;
            assert!(gap <= OPEN * size, "the oracle is open by {gap:e} at {:e}", distance.hi);
            return Truth { signed_distance: distance.hi };
        }
    }
    let s = deepest(&va, &vb);
    if s.hi > 0.0 {
        let along_it = separation(&va, &vb, &d.map(|x| x / distance));
        let proved = if along_it > s { along_it } else { s };
        let gap = (distance - proved).hi;
        assert!(gap <= OPEN * size, "the oracle is open by {gap:e} at {:e}", distance.hi);
        return Truth { signed_distance: distance.hi };
    }
    Truth { signed_distance: s.hi }
}
