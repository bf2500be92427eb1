//! Closest features of every pair of shapes, checked without an oracle.
//!
//! An answer carries what proves it. `s(n)` of its normal is worked out again from supports written down
//! here, in double-double: the signed distance is not below it. Apart, the two points are checked to lie
//! on their bodies: the signed distance is not above their distance. Both meet to within the certificate.
//! Overlapping, thousands of other directions are asked whether one leads out sooner. Beside that,
//! closed forms.
//!
//! The documented run, minutes: `PAIRS=20000 cargo test --release --test closest_shapes -- --ignored`.

#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]

mod closed_forms;
mod proof;
#[path = "../random/mod.rs"]
mod random;
mod regressions;

use random::Random;

use bryla::closest::{Accuracy, Collider, PairCache, Rung, State, closest_features};
use bryla::math::{Pose, Vector3, quaternion};
use bryla::shape::{Capsule, Compound, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Piece, Polyhedron, Shape, Sphere};

impl Random {
    pub(crate) fn pose(&mut self, position: Vector3) -> Pose {
        let turn = quaternion::from_axis_angle(&self.direction(), self.within(0.0, 6.0));
        Pose { position, orientation: turn }
    }
}

const KINDS: u64 = 9;

/// A shape of about unit size.
fn shape(r: &mut Random, kind: u64) -> Shape {
    let mut s = || r.within(0.2, 1.0);
    match kind {
        0 => Cuboid::new([s(), s(), s()]).into(),
        1 => Sphere::new(s()).into(),
        2 => Cylinder::new(s(), s()).into(),
        3 => Capsule::new(s(), s()).into(),
        4 => Cone::new(s(), s()).into(),
        5 => Ellipsoid::new([s(), s(), s()]).into(),
        6 => {
            let (a, b, c) = (s(), s(), s());
            let corners = [[a, b, c], [-a, -b, c], [-a, b, -c], [a, -b, -c]];
            Polyhedron::new(corners, [[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]].map(Vec::from)).into()
        }
        7 => {
            let pieces: Vec<Piece> = [0, 4, 1]
                .iter()
                .map(|&k| {
                    let pose = r.pose(Vector3::zeros());
                    let at = 0.8 * r.direction();
                    let q = pose.orientation;
                    Piece::new(shape(r, k)).position(at).orientation([q.w, q.i, q.j, q.k])
                })
                .collect();
            Compound::new(pieces).into()
        }
        _ => HalfSpace::new(r.direction(), r.within(-0.5, 0.5)).into(),
    }
}

#[derive(Debug, Default)]
struct Tally {
    pairs: usize,
    certified: usize,
    precise: usize,
    overlapping: usize,
    width: f64,
    steps: u64,
    warm_steps: u64,
}

fn check_pair(r: &mut Random, kinds: [u64; 2], tally: &mut Tally) {
    let (a, b) = (shape(r, kinds[0]), shape(r, kinds[1]));
    let (ca, cb) = (Collider::new(&a).unwrap(), Collider::new(&b).unwrap());
    let far = match r.below(4) {
        0 => 1e6,
        _ => 0.0,
    };
    let (away, distance, direction) = (far * r.direction(), r.within(0.0, 3.0), r.direction());
    let pose_a = r.pose(away);
    let pose_b = r.pose(pose_a.position + distance * direction);
    let label = format!("{a:?} {pose_a:?} {b:?} {pose_b:?}");

    let mut cache = PairCache::new();
    let cold = closest_features(&ca, &pose_a, &cb, &pose_b, Some(&mut cache), Accuracy::Exact).unwrap();
    proof::check(&cold, [(&a, &pose_a), (&b, &pose_b)], r, &label);
    let warm = closest_features(&ca, &pose_a, &cb, &pose_b, Some(&mut cache), Accuracy::Exact).unwrap();
    proof::check(&warm, [(&a, &pose_a), (&b, &pose_b)], r, &label);
    let swapped = closest_features(&cb, &pose_b, &ca, &pose_a, None, Accuracy::Exact).unwrap();
    assert!(swapped.lower <= cold.upper && cold.lower <= swapped.upper, "{label}: {cold:?} {swapped:?}");
    for accuracy in [Accuracy::Relative(1e-6), Accuracy::YesNo] {
        let rough = closest_features(&ca, &pose_a, &cb, &pose_b, None, accuracy).unwrap();
        assert!(rough.lower <= cold.upper && cold.lower <= rough.upper, "{label}: {cold:?} {rough:?}");
        assert!(rough.certified || rough.state == State::Overlapping, "{label}: {rough:?}");
    }

    tally.pairs += 1;
    tally.certified += usize::from(cold.certified);
    tally.precise += usize::from(cold.rung == Rung::DoubleDouble);
    tally.overlapping += usize::from(cold.state == State::Overlapping);
    tally.steps += u64::from(cold.steps);
    tally.warm_steps += u64::from(warm.steps);
    if cold.certified {
        tally.width = tally.width.max((cold.upper - cold.lower) / proof::size(&a, &pose_a, &b, &pose_b));
    }
    // apart or touching, nothing is left uncertified
    assert!(cold.certified || cold.state == State::Overlapping, "{label}: {cold:?}");
}

fn run(pairs: usize) {
    for first in 0..KINDS {
        for second in first..KINDS {
            if first == 8 && second == 8 {
                continue;
            }
            let mut r = Random(100 * first + second);
            let mut t = Tally::default();
            for _ in 0..pairs {
                check_pair(&mut r, [first, second], &mut t);
            }
            let n = t.pairs as f64;
            println!(
                "{:10} {:10}: {:5.1} % overlap, {:6.2} % certified, width {:4.1} eps size, {:5.1} steps, {:5.1} warm, {:5.1} % in double-double",
                shape(&mut Random(0), first).name(),
                shape(&mut Random(0), second).name(),
                100.0 * t.overlapping as f64 / n,
                100.0 * t.certified as f64 / n,
                t.width / f64::EPSILON,
                t.steps as f64 / n,
                t.warm_steps as f64 / n,
                100.0 * t.precise as f64 / n,
            );
        }
    }
}

#[test]
fn every_pair_of_shapes_proves_its_answer() {
    run(20);
}

#[test]
#[ignore = "minutes: the documented run, see the module"]
fn every_pair_of_shapes_proves_its_answer_at_length() {
    run(std::env::var("PAIRS").ok().and_then(|n| n.parse().ok()).unwrap_or(2000));
}
