//! Seventeen families of pairs: the usual, and the ones that break closest-feature queries.

use crate::random::Random;
use bryla::math::{Pose, Quaternion, Vector3, quaternion};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;

/// Two posed bodies.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) a: ConvexPolyhedron,
    pub(crate) pose_a: Pose,
    pub(crate) b: ConvexPolyhedron,
    pub(crate) pose_b: Pose,
}

/// A family by name.
pub(crate) type Family = (&'static str, fn(&mut Random) -> Case);

/// Every family.
pub(crate) const FAMILIES: &[Family] = &[
    ("random_sep", random_sep),
    ("random_pen", random_pen),
    ("parallel_faces", parallel_faces),
    ("parallel_edges", parallel_edges),
    ("aligned_grid", aligned_grid),
    ("needle", needle),
    ("plate", plate),
    ("offset1e6", offset1e6),
    ("gap1e-12", gap_1e_12),
    ("touch_grid", touch_grid),
    ("touch_random", touch_random),
    ("near_parallel", near_parallel),
    ("scale_ratio", scale_ratio),
    ("near_coplanar", near_coplanar),
    ("flat", flat),
    ("deep_pen", deep_pen),
    ("rest_pen", rest_pen),
];

/// A sequence of its own for every family.
pub(crate) fn random(name: &str) -> Random {
    Random(name.bytes().fold(0xcbf29ce484222325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100000001b3)))
}

impl Random {
    fn step(&mut self, reach: u64, grid: f64) -> f64 {
        grid * (self.below(2 * reach + 1) as f64 - reach as f64)
    }

    fn decade(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.within(libm::log(low), libm::log(high)))
    }

    pub(crate) fn orientation(&mut self) -> Quaternion {
        loop {
            let q = Quaternion::new(
                self.within(-1.0, 1.0),
                self.within(-1.0, 1.0),
                self.within(-1.0, 1.0),
                self.within(-1.0, 1.0),
            );
            if (0.1..1.0).contains(&q.norm()) {
                return quaternion::normalized(&q);
            }
        }
    }

    pub(crate) fn pose(&mut self, position: Vector3) -> Pose {
        Pose { position, orientation: self.orientation() }
    }
}

pub(crate) fn cuboid(h: [f64; 3]) -> ConvexPolyhedron {
    let corner = |k: usize| std::array::from_fn(|i| if (k >> i) & 1 == 0 { -h[i] } else { h[i] });
    ConvexPolyhedron::from_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
}

/// Points on an ellipsoid.
fn pebble(r: &mut Random, count: usize, axes: [f64; 3]) -> ConvexPolyhedron {
    let points: Vec<[f64; 3]> =
        (0..count).map(|_| r.direction()).map(|d| [d.x * axes[0], d.y * axes[1], d.z * axes[2]]).collect();
    ConvexPolyhedron::from_points(&points).unwrap()
}

fn prism(sides: u32, radius: f64, half: f64) -> ConvexPolyhedron {
    let rim = |k: u32| libm::sincos(std::f64::consts::TAU * f64::from(k) / f64::from(sides));
    let points: Vec<[f64; 3]> =
        (0..sides).map(rim).flat_map(|(s, c)| [-half, half].map(|z| [radius * c, radius * s, z])).collect();
    ConvexPolyhedron::from_points(&points).unwrap()
}

/// Any ordinary body of about unit size.
fn body(r: &mut Random) -> ConvexPolyhedron {
    match r.below(5) {
        0 => cuboid([r.within(0.2, 1.0), r.within(0.2, 1.0), r.within(0.2, 1.0)]),
        1 => pebble(r, 4, [1.0; 3]),
        2 => pebble(r, 8, [1.0, 0.8, 0.6]),
        3 => pebble(r, 14, [1.0; 3]),
        _ => {
            let sides = 3 + u32::try_from(r.below(4)).unwrap();
            prism(sides, r.within(0.3, 1.0), r.within(0.2, 1.0))
        }
    }
}

fn at_distance(r: &mut Random, a: ConvexPolyhedron, b: ConvexPolyhedron, low: f64, high: f64) -> Case {
    let (pose_a, d) = (r.pose(Vector3::zeros()), r.direction());
    let reach = a.radius() + b.radius();
    let distance = r.within(low, high) * reach;
    let pose_b = r.pose(d * distance);
    Case { a, pose_a, b, pose_b }
}

fn random_sep(r: &mut Random) -> Case {
    let (a, b) = (body(r), body(r));
    at_distance(r, a, b, 0.9, 2.5)
}

fn random_pen(r: &mut Random) -> Case {
    let (a, b) = (body(r), body(r));
    at_distance(r, a, b, 0.1, 0.8)
}

/// A turned frame in which B stands on A, shifted by `shift` and lifted by `gap`.
fn stacked(
    r: &mut Random,
    a: ConvexPolyhedron,
    b: ConvexPolyhedron,
    heights: [f64; 2],
    shift: [f64; 2],
    gap: f64,
    twist: f64,
) -> Case {
    let q = r.orientation();
    let pose_a = Pose { position: Vector3::zeros(), orientation: q };
    let lift = Vector3::new(shift[0], shift[1], heights[0] + heights[1] + gap);
    let turn = quaternion::from_axis_angle(&Vector3::z(), twist);
    let pose_b = Pose { position: pose_a.vector(&lift), orientation: quaternion::normalized(&(q * turn)) };
    Case { a, pose_a, b, pose_b }
}

fn parallel_faces(r: &mut Random) -> Case {
    let (ha, hb) = (r.within(0.2, 1.0), r.within(0.2, 1.0));
    let a = cuboid([1.0, r.within(0.2, 1.0), ha]);
    let b = if r.below(2) == 0 { cuboid([r.within(0.2, 1.0), 1.0, hb]) } else { prism(6, 0.7, hb) };
    let gap = if r.below(2) == 0 { r.decade(1e-13, 1.0) } else { -r.decade(1e-13, 0.1) };
    let (shift, twist) = ([r.within(-0.5, 0.5), r.within(-0.5, 0.5)], r.within(0.0, 6.0));
    stacked(r, a, b, [ha, hb], shift, gap, twist)
}

fn parallel_edges(r: &mut Random) -> Case {
    // two roofs, ridge along ridge
    let roof = |s: f64, w: f64| {
        ConvexPolyhedron::from_points(&[
            [-1.0, 0.0, s],
            [1.0, 0.0, s],
            [-1.0, w, 0.0],
            [1.0, w, 0.0],
            [-1.0, -w, 0.0],
            [1.0, -w, 0.0],
        ])
        .unwrap()
    };
    let (a, b) = (roof(1.0, r.within(0.2, 1.0)), roof(-1.0, r.within(0.2, 1.0)));
    let gap = if r.below(2) == 0 { r.decade(1e-13, 1.0) } else { -r.decade(1e-13, 0.1) };
    let shift = [r.within(-1.5, 1.5), 0.0];
    stacked(r, a, b, [1.0, 1.0], shift, gap, 0.0)
}

fn aligned_grid(r: &mut Random) -> Case {
    let mut box_of = || cuboid([1, 1, 1].map(|_| 0.25 * (1.0 + r.below(4) as f64)));
    let (a, b) = (box_of(), box_of());
    let position = Vector3::new(r.step(10, 0.25), r.step(10, 0.25), r.step(10, 0.25));
    Case { a, pose_a: Pose::identity(), b, pose_b: Pose { position, ..Pose::identity() } }
}

fn needle(r: &mut Random) -> Case {
    let thin = r.decade(1e-6, 1e-3);
    let a = match r.below(3) {
        0 => cuboid([1.0, thin, thin]),
        1 => ConvexPolyhedron::from_points(&[
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, thin, 0.0],
            [0.0, -thin, thin],
            [0.1, 0.0, -thin],
        ])
        .unwrap(),
        _ => prism(5, thin, 1.0),
    };
    let b = if r.below(2) == 0 { a.clone() } else { body(r) };
    let high = if r.below(2) == 0 { 0.3 } else { 1.5 };
    at_distance(r, a, b, 0.0, high)
}

fn plate(r: &mut Random) -> Case {
    let thin = r.decade(1e-6, 1e-3);
    let a = if r.below(2) == 0 { cuboid([1.0, 1.0, thin]) } else { prism(8, 1.0, thin) };
    let b = if r.below(2) == 0 { a.clone() } else { body(r) };
    let high = if r.below(2) == 0 { 0.3 } else { 1.5 };
    at_distance(r, a, b, 0.0, high)
}

fn offset1e6(r: &mut Random) -> Case {
    let (a, b) = (body(r), body(r));
    let mut case = at_distance(r, a, b, 0.3, 1.6);
    let far = r.direction() * 1e6;
    case.pose_a.position += far;
    case.pose_b.position += far;
    case
}

/// Moves B along the answer's normal so that about `gap` is left.
fn moved_to(case: Case, gap: f64) -> Case {
    let Case { a, pose_a, b, mut pose_b } = case;
    for _ in 0..3 {
        let now =
            bryla::closest::closest_features(&a, &pose_a, &b, &pose_b, None, bryla::closest::Accuracy::Exact).unwrap();
        pose_b.position += now.normal * (gap - now.signed_distance);
    }
    Case { a, pose_a, b, pose_b }
}

fn gap_1e_12(r: &mut Random) -> Case {
    let case = random_sep(r);
    moved_to(case, 1e-12)
}

fn touch_grid(r: &mut Random) -> Case {
    let case = aligned_grid(r);
    let (ha, hb) = (case.a.vertices()[0], case.b.vertices()[0]);
    let axis = usize::try_from(r.below(3)).unwrap();
    let mut pose_b = case.pose_b;
    pose_b.position[axis] = ha[axis].abs() + hb[axis].abs();
    // beside it: face to face, edge to edge or corner to corner
    for other in 0..3 {
        let reach = ha[other].abs() + hb[other].abs();
        pose_b.position[other] = pose_b.position[other].clamp(-reach, reach);
    }
    Case { pose_b, ..case }
}

fn touch_random(r: &mut Random) -> Case {
    let case = random_sep(r);
    moved_to(case, 0.0)
}

fn near_parallel(r: &mut Random) -> Case {
    let (ha, hb) = (0.5, r.within(0.2, 1.0));
    let (a, b) = (cuboid([1.0, 1.0, ha]), cuboid([r.within(0.3, 1.0), 0.6, hb]));
    let gap = if r.below(2) == 0 { r.decade(1e-10, 1e-2) } else { -r.decade(1e-10, 1e-2) };
    let (shift, twist) = ([r.within(-0.3, 0.3), r.within(-0.3, 0.3)], r.within(0.0, 6.0));
    let mut case = stacked(r, a, b, [ha, hb], shift, gap, twist);
    let tilt = r.direction() * r.decade(1e-16, 1e-7);
    case.pose_b.orientation = quaternion::normalized(&(quaternion::exp(&tilt) * case.pose_b.orientation));
    case
}

fn scale_ratio(r: &mut Random) -> Case {
    let small = r.decade(1e-6, 1e-2);
    let a = body(r);
    let b = pebble(r, 8, [small, 0.7 * small, 0.5 * small]);
    let mut case = at_distance(r, a, b, 0.0, 1.2);
    if r.below(2) == 0 {
        let gap = small * r.within(-0.5, 2.0);
        case = moved_to(case, gap);
    }
    case
}

fn near_coplanar(r: &mut Random) -> Case {
    // a lid whose middle is lifted by next to nothing
    let lift = r.decade(1e-16, 1e-6);
    let mut points = vec![[0.0, 0.0, 0.5 + lift], [0.3, 0.1, 0.5 + 0.8 * lift]];
    for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        points.extend([[x, y, 0.5], [x, y, -0.5]]);
    }
    let a = ConvexPolyhedron::from_points(&points).unwrap();
    let hb = r.within(0.2, 1.0);
    let b = cuboid([0.5, 0.4, hb]);
    let gap = if r.below(2) == 0 { r.decade(1e-13, 1e-2) } else { -r.decade(1e-13, 1e-2) };
    let (shift, twist) = ([r.within(-0.8, 0.8), r.within(-0.8, 0.8)], r.within(0.0, 6.0));
    stacked(r, a, b, [0.5, hb], shift, gap, twist)
}

/// Polygons, segments and points against anything.
fn flat(r: &mut Random) -> Case {
    let thing = |r: &mut Random| {
        let rim: Vec<[f64; 3]> = (0..6).map(|_| [r.step(4, 0.25), r.step(4, 0.25), 0.0]).collect();
        match r.below(4) {
            0 => ConvexPolyhedron::from_points(&[[0.0, 0.0, 0.0]]).unwrap(),
            1 => ConvexPolyhedron::from_points(&[[-0.5, 0.0, 0.0], [0.5, 0.25, 0.0]]).unwrap(),
            2 => ConvexPolyhedron::from_points(&rim).unwrap(),
            _ => body(r),
        }
    };
    let (a, b) = (thing(r), thing(r));
    if r.below(2) == 0 {
        // in one plane, on a grid: crossing, touching, apart
        let position = Vector3::new(r.step(6, 0.25), r.step(6, 0.25), if r.below(3) == 0 { 0.25 } else { 0.0 });
        return Case { a, pose_a: Pose::identity(), b, pose_b: Pose { position, ..Pose::identity() } };
    }
    at_distance(r, a, b, 0.0, 1.2)
}

fn deep_pen(r: &mut Random) -> Case {
    let (a, b) = (body(r), body(r));
    let offset = match r.below(3) {
        0 => Vector3::zeros(),
        1 => r.direction() * r.decade(1e-15, 1e-3),
        _ => r.direction() * r.within(0.0, 0.2),
    };
    if r.below(2) == 0 {
        let pose = r.pose(Vector3::zeros());
        return Case { a, pose_a: pose, b, pose_b: Pose { position: offset, ..pose } };
    }
    Case { a, pose_a: r.pose(Vector3::zeros()), b, pose_b: r.pose(offset) }
}

fn rest_pen(r: &mut Random) -> Case {
    let (ha, hb) = (r.within(0.2, 1.0), r.within(0.2, 1.0));
    let (a, b) = (cuboid([5.0, 5.0, ha]), cuboid([0.5, 0.5, hb]));
    let (shift, depth) = ([r.within(-4.0, 4.0), r.within(-4.0, 4.0)], r.decade(1e-12, 1e-2));
    let twist = if r.below(2) == 0 { 0.0 } else { r.within(0.0, 6.0) };
    stacked(r, a, b, [ha, hb], shift, -depth, twist)
}
