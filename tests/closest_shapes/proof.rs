//! What proves an answer: supports and insides of every shape, written down once more.

use bryla::closest::{ClosestFeatures, State};
use bryla::math::double_double::DoubleDouble as Dd;
use bryla::math::{Pose, Vector3};
use bryla::shape::Shape;

use crate::random::Random;

type V = [Dd; 3];

fn dd(x: f64) -> Dd {
    Dd::from(x)
}

fn dot(a: &V, b: &V) -> Dd {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn root(x: Dd) -> Dd {
    if x.hi <= 0.0 {
        return dd(0.0);
    }
    let y = dd(x.hi.sqrt());
    dd(0.5) * (y + x / y)
}

/// The rotation of `q/|q|`.
fn matrix(pose: &Pose) -> [V; 3] {
    let [w, x, y, z] = [pose.orientation.w, pose.orientation.i, pose.orientation.j, pose.orientation.k].map(dd);
    let (k, one) = (dd(2.0) / (w * w + x * x + y * y + z * z), dd(1.0));
    [
        [one - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)],
        [k * (x * y + w * z), one - k * (x * x + z * z), k * (y * z - w * x)],
        [k * (x * z - w * y), k * (y * z + w * x), one - k * (x * x + y * y)],
    ]
}

/// `Rᵀ d`.
fn turn_back(pose: &Pose, d: &V) -> V {
    let r = matrix(pose);
    std::array::from_fn(|j| r[0][j] * d[0] + r[1][j] * d[1] + r[2][j] * d[2])
}

fn larger(a: Dd, b: Dd) -> Dd {
    if a > b { a } else { b }
}

fn size_of(x: Dd) -> Dd {
    if x.hi < 0.0 { -x } else { x }
}

/// The pieces of a shape, each with its pose.
fn pieces(shape: &Shape) -> Vec<(Shape, Pose)> {
    match shape {
        Shape::Compound(c) => c
            .pieces
            .iter()
            .map(|p| (p.shape.clone(), Pose { position: p.position.into(), orientation: p.pose().orientation }))
            .collect(),
        other => vec![(other.clone(), Pose::identity())],
    }
}

/// How far a shape reaches along `d`, its own axes: `max d · p`.
fn reach(shape: &Shape, d: &V) -> Dd {
    let across = root(d[0] * d[0] + d[1] * d[1]);
    let length = root(dot(d, d));
    match shape {
        Shape::Sphere(s) => dd(s.radius) * length,
        Shape::Capsule(s) => dd(s.radius) * length + dd(s.half_height) * size_of(d[2]),
        Shape::Cylinder(s) => dd(s.radius) * across + dd(s.half_height) * size_of(d[2]),
        Shape::Cone(s) => {
            let h = dd(s.half_height) * d[2];
            larger(h, dd(s.radius) * across - h)
        }
        Shape::Ellipsoid(s) => {
            let v: V = std::array::from_fn(|k| dd(s.semi_axes[k]) * d[k]);
            root(dot(&v, &v))
        }
        flat => {
            let heights = flat.vertices().unwrap().into_iter().map(|v| dot(&[dd(v.x), dd(v.y), dd(v.z)], d));
            heights.reduce(larger).unwrap()
        }
    }
}

/// How far a point, the shape's own axes, is outside the shape [m], to first order; negative inside.
pub(crate) fn outside(shape: &Shape, p: &Vector3) -> f64 {
    let across = libm::hypot(p.x, p.y);
    match shape {
        Shape::Sphere(s) => p.norm() - s.radius,
        Shape::Capsule(s) => libm::hypot(across, (p.z.abs() - s.half_height).max(0.0)) - s.radius,
        Shape::Cylinder(s) => (across - s.radius).max(p.z.abs() - s.half_height),
        Shape::Cone(s) => {
            let slope = libm::hypot(2.0 * s.half_height, s.radius);
            let side = ((p.z - s.half_height) * s.radius + 2.0 * s.half_height * across) / slope;
            side.max(-s.half_height - p.z)
        }
        Shape::Ellipsoid(s) => {
            let a = Vector3::from(s.semi_axes);
            let v = p.component_div(&a);
            let slope = v.component_div(&a).norm();
            if slope > 0.0 { (v.norm_squared() - 1.0) / (2.0 * slope) } else { -a.min() }
        }
        Shape::HalfSpace(s) => {
            let (n, d) = s.plane();
            n.dot(p) - d
        }
        Shape::Cuboid(s) => (p.abs() - Vector3::from(s.half_extents)).max(),
        Shape::Polyhedron(s) => {
            let height = |f: &Vec<usize>| {
                let [a, b, c] = [0, 1, 2].map(|k| Vector3::from(s.vertices[f[k]]));
                (b - a).cross(&(c - a)).normalize().dot(&(p - a))
            };
            s.faces.iter().map(height).fold(f64::MIN, f64::max)
        }
        other => panic!("{other:?}"),
    }
}

/// Both radii and the distance of the centres, of half spaces the distance to the plane's origin.
pub(crate) fn size(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> f64 {
    let radius = |s: &Shape| match s {
        Shape::HalfSpace(h) => h.plane().1.abs(),
        s => s.bounding_radius(&Vector3::zeros()),
    };
    radius(a) + radius(b) + (pose_b.position - pose_a.position).norm()
}

/// `s(n)` of two pieces along a unit `n` (to rounding of `n`), world axes: none where it is unbounded.
fn separation(a: (&Shape, &Pose, &Pose), b: (&Shape, &Pose, &Pose), n: &V) -> Option<Dd> {
    // highest of A and lowest of B along n, both about the origin of A's pose
    let height = |(shape, inner, outer): (&Shape, &Pose, &Pose), d: &V| -> Option<Dd> {
        let in_outer = turn_back(outer, d);
        let local = turn_back(inner, &in_outer);
        let moved = dot(&in_outer, &[0, 1, 2].map(|k| dd(inner.position[k])));
        if let Shape::HalfSpace(h) = shape {
            // bounded along its own normal alone
            let g = h.normal.map(dd);
            let length = root(dot(&g, &g));
            let along = dot(&local, &g) / length;
            return (along.hi > 1.0 - 1e-14).then(|| dd(h.offset) / length);
        }
        Some(moved + reach(shape, &local))
    };
    let minus = [-n[0], -n[1], -n[2]];
    let t: V = std::array::from_fn(|k| dd(b.2.position[k]) - dd(a.2.position[k]));
    Some(dot(n, &t) - height(a, n)? - height(b, &minus)?)
}

/// Checks an answer; see the module.
pub(crate) fn check(
    answer: &ClosestFeatures,
    [(a, pose_a), (b, pose_b)]: [(&Shape, &Pose); 2],
    r: &mut Random,
    label: &str,
) {
    let unit = f64::EPSILON * size(a, pose_a, b, pose_b);
    let (in_a, in_b) = (pieces(a), pieces(b));
    let (part_a, part_b) = (&in_a[answer.part_a as usize], &in_b[answer.part_b as usize]);
    let has_plane = [a, b].iter().any(|s| matches!(s, Shape::HalfSpace(_)));
    assert!(answer.lower <= answer.signed_distance && answer.signed_distance <= answer.upper, "{label}: {answer:?}");
    assert!((answer.normal.norm() - 1.0).abs() < 4.0 * f64::EPSILON, "{label}: {answer:?}");

    // from below: s(n), every pair of pieces for the pair's own normal being too much to ask
    let n: V = std::array::from_fn(|k| dd(answer.normal[k]));
    let length = root(dot(&n, &n));
    let n = n.map(|x| x / length);
    let s = separation((&part_a.0, &part_a.1, pose_a), (&part_b.0, &part_b.1, pose_b), &n)
        .unwrap_or_else(|| panic!("{label}: the normal is not the plane's: {answer:?}"));
    assert!(s.hi <= answer.upper, "{label}: s(n) = {:e}, {answer:?}", s.hi);
    let simple = in_a.len() == 1 && in_b.len() == 1;
    // the normal in the answer is rounded to f64: it is off by ε, which costs ε size
    assert!(s.hi >= answer.lower - 4.0 * unit, "{label}: s(n) = {:e}, {answer:?}", s.hi);
    if !has_plane && answer.certified {
        assert!((s.hi - answer.signed_distance).abs() <= 40.0 * unit, "{label}: s(n) = {:e}, {answer:?}", s.hi);
    }

    // the points: on their pieces, and joined along the normal
    let reach = unit + 4.0 * f64::EPSILON * (pose_a.position.norm() + pose_b.position.norm());
    for (point, (shape, inner), pose) in [(answer.point_a, part_a, pose_a), (answer.point_b, part_b, pose_b)] {
        let local = inner.inverse_point(&pose.inverse_point(&point));
        assert!(outside(shape, &local) <= 16.0 * reach, "{label}: {:e} outside, {answer:?}", outside(shape, &local));
    }
    let apart = answer.point_b - answer.point_a;
    assert!((answer.normal.dot(&apart) - answer.signed_distance).abs() <= 8.0 * reach, "{label}: {answer:?}");
    if answer.state == State::Separated && answer.certified {
        assert!((apart.norm() - answer.signed_distance).abs() <= 40.0 * unit + 8.0 * reach, "{label}: {answer:?}");
    }

    // from above, overlapping: no direction leads out sooner
    if answer.state == State::Overlapping && !has_plane {
        for k in 0..200 {
            let spread = if k % 2 == 0 { libm::exp10(-f64::from(k / 20)) } else { 1e3 };
            let d = (answer.normal + spread * r.direction()).normalize();
            let d: V = std::array::from_fn(|k| dd(d[k]));
            let length = root(dot(&d, &d));
            let d = d.map(|x| x / length);
            let of = |i: &(Shape, Pose), j: &(Shape, Pose)| separation((&i.0, &i.1, pose_a), (&j.0, &j.1, pose_b), &d);
            let s = of(part_a, part_b).unwrap();
            assert!(!simple || s.hi <= answer.upper, "{label}: s = {:e} along {d:?}, {answer:?}", s.hi);
        }
    }
}
