//! Eight families of moving pairs over the time 0..=1 s.

use crate::random::Random;
use bryla::closest::{Accuracy, closest_features};
use bryla::impact::{Motion, Moving};
use bryla::math::{Pose, Quaternion, Vector3, quaternion};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;

/// Two moving bodies.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    pub(crate) a: ConvexPolyhedron,
    pub(crate) motion_a: Motion,
    pub(crate) b: ConvexPolyhedron,
    pub(crate) motion_b: Motion,
}

/// A family by name.
pub(crate) type Family = (&'static str, fn(&mut Random) -> Case);

/// Every family.
pub(crate) const FAMILIES: &[Family] = &[
    ("small_step", small_step),
    ("tumble", tumble),
    ("spin_rod", spin_rod),
    ("spin_rod_plate", spin_rod_plate),
    ("bullet_plate", bullet_plate),
    ("graze", graze),
    ("pure_rotation", pure_rotation),
    ("two_rods", two_rods),
];

/// A sequence of its own for every family.
pub(crate) fn random(name: &str) -> Random {
    Random(name.bytes().fold(0xcbf29ce484222325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100000001b3)))
}

impl Random {
    fn decade(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.within(libm::log(low), libm::log(high)))
    }

    fn orientation(&mut self) -> Quaternion {
        quaternion::exp(&(self.within(0.0, 3.0) * self.direction()))
    }
}

fn cuboid(h: [f64; 3]) -> ConvexPolyhedron {
    let corner = |k: usize| std::array::from_fn(|i| if (k >> i) & 1 == 0 { -h[i] } else { h[i] });
    ConvexPolyhedron::from_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
}

/// A box, or the hull of points on an ellipsoid; within 1 of its centre.
fn solid(r: &mut Random) -> ConvexPolyhedron {
    let h: [f64; 3] = std::array::from_fn(|_| r.within(0.1, 0.57));
    if r.within(0.0, 1.0) < 0.5 {
        return cuboid(h);
    }
    let count = r.within(5.0, 40.0) as usize;
    let points: Vec<[f64; 3]> =
        (0..count).map(|_| r.direction()).map(|d| [d.x, d.y * (0.3 + h[1]), d.z * 1.7 * h[2]]).collect();
    ConvexPolyhedron::from_points(&points).unwrap()
}

fn rod(r: &mut Random) -> ConvexPolyhedron {
    cuboid([1.0, r.within(0.01, 0.04), 0.02])
}

/// A motion that starts turned anyhow and turns by so much about any axis.
fn moving(position: Vector3, velocity: Vector3, turn: f64) -> impl FnOnce(&mut Random) -> Motion {
    move |r| Motion::new(Pose { position, orientation: r.orientation() }, velocity, turn * r.direction())
}

/// What a step of a simulation asks: near, slow, little turning.
fn small_step(r: &mut Random) -> Case {
    let (a, b) = (solid(r), solid(r));
    let d = r.direction();
    let reach = a.radius() + b.radius();
    let motion_a = moving(Vector3::zeros(), 0.05 * r.direction(), 0.05)(r);
    let turn = r.within(0.0, 0.1);
    let place = d * reach * r.within(0.7, 1.0);
    let motion_b = moving(place, (0.1 * r.direction() - d) * 0.2, turn)(r);
    apart(r, Case { a, motion_a, b, motion_b })
}

/// Two bodies thrown at each other, up to 10 rad.
fn tumble(r: &mut Random) -> Case {
    let (a, b) = (solid(r), solid(r));
    let turns = [r.within(0.0, 10.0), r.within(0.0, 10.0)];
    let d = r.direction();
    let motion_a = moving(Vector3::zeros(), 0.3 * r.direction(), turns[0])(r);
    let speed = r.within(1.0, 4.0);
    let motion_b = moving(2.5 * d, (0.4 * r.direction() - d) * speed, turns[1])(r);
    Case { a, motion_a, b, motion_b }
}

/// A rod that spins by 1 to 300 rad and drifts towards a body.
fn spin_rod(r: &mut Random) -> Case {
    let (a, b) = (rod(r), solid(r));
    spin_past(r, a, b)
}

/// The same with a plate 1e-6 thin.
fn spin_rod_plate(r: &mut Random) -> Case {
    let (a, b) = (rod(r), cuboid([r.within(0.3, 0.9), r.within(0.3, 0.9), 5e-7]));
    spin_past(r, a, b)
}

fn spin_past(r: &mut Random, a: ConvexPolyhedron, b: ConvexPolyhedron) -> Case {
    let turn = r.decade(1.0, 300.0);
    let motion_a = moving(Vector3::zeros(), 0.2 * r.direction(), turn)(r);
    let d = r.direction();
    let motion_b = moving(d * r.within(0.9, 2.2), -d * r.within(0.2, 1.5) + 0.2 * r.direction(), 0.5)(r);
    apart(r, Case { a, motion_a, b, motion_b })
}

/// A small body at 10 to 1000 a second and a plate 1e-6 to 1e-2 thin.
fn bullet_plate(r: &mut Random) -> Case {
    let b = cuboid([0.02, r.within(0.01, 0.03), 0.02]);
    let a = cuboid([0.5, 0.5, r.decade(5e-7, 5e-3)]);
    let turn = r.within(0.0, 30.0);
    let motion_a = moving(Vector3::zeros(), 0.2 * r.direction(), 1.0)(r);
    let speed = r.decade(10.0, 1000.0);
    let (d, aim, when) = (r.direction(), 0.3 * r.direction(), r.within(0.1, 1.2));
    let motion_b = moving(aim + d * speed * when, -d * speed, turn)(r);
    Case { a, motion_a, b, motion_b }
}

/// A pass whose least gap is between −1e-3 and 1e-3, mostly far closer to 0.
fn graze(r: &mut Random) -> Case {
    let (a, b) = (solid(r), solid(r));
    let (d, across) = (r.direction(), r.direction());
    let turn = if r.within(0.0, 1.0) < 0.5 { 0.0 } else { r.within(0.0, 1.0) };
    let motion_a = moving(Vector3::zeros(), Vector3::zeros(), 0.0)(r);
    let speed = r.within(3.0, 6.0);
    let mut motion_b = moving(d * 1.2 - 0.5 * speed * across, speed * across, turn)(r);

    // the least gap on a grid, made finer around it; then moved there along its normal
    let wanted = r.decade(1e-9, 1e-3) * if r.within(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
    for _ in 0..3 {
        let gap = |t: f64| {
            let (pose_a, pose_b) = (motion_a.at(t).pose, motion_b.at(t).pose);
            closest_features(&a, &pose_a, &b, &pose_b, None, Accuracy::Exact).unwrap()
        };
        let (mut middle, mut half) = (0.5, 0.5);
        for _ in 0..12 {
            let times = (0..=20).map(|k| (middle + half * (f64::from(k) / 10.0 - 1.0)).clamp(0.0, 1.0));
            let least = times.min_by(|s, t| gap(*s).signed_distance.total_cmp(&gap(*t).signed_distance));
            (middle, half) = (least.unwrap_or(middle), 0.2 * half);
        }
        let closest = gap(middle);
        motion_b.position += closest.normal * (wanted - closest.signed_distance);
    }
    Case { a, motion_a, b, motion_b }
}

/// Turning in place, up to 6 rad.
fn pure_rotation(r: &mut Random) -> Case {
    let (a, b) = (solid(r), solid(r));
    let turns = [r.within(0.0, 6.0), r.within(0.0, 6.0)];
    let motion_a = moving(Vector3::zeros(), Vector3::zeros(), turns[0])(r);
    let place = r.direction() * (a.radius() + b.radius()) * r.within(0.5, 1.0);
    let motion_b = moving(place, Vector3::zeros(), turns[1])(r);
    apart(r, Case { a, motion_a, b, motion_b })
}

/// Two rods that spin by 1 to 100 rad.
fn two_rods(r: &mut Random) -> Case {
    let (a, b) = (rod(r), rod(r));
    let turns = [r.decade(1.0, 100.0), r.decade(1.0, 100.0)];
    let motion_a = moving(Vector3::zeros(), 0.2 * r.direction(), turns[0])(r);
    let d = r.direction();
    let motion_b = moving(d * r.within(0.8, 2.1), -d * r.within(0.0, 1.5), turns[1])(r);
    apart(r, Case { a, motion_a, b, motion_b })
}

/// The case, drawn apart where it starts in overlap or nearly so.
fn apart(r: &mut Random, mut case: Case) -> Case {
    for _ in 0..8 {
        let (pose_a, pose_b) = (case.motion_a.at(0.0).pose, case.motion_b.at(0.0).pose);
        let closest = closest_features(&case.a, &pose_a, &case.b, &pose_b, None, Accuracy::Exact).unwrap();
        if closest.signed_distance > 1e-3 {
            break;
        }
        case.motion_b.position += closest.normal * (r.within(1e-3, 0.1) - closest.signed_distance);
    }
    case
}
