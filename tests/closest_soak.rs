//! Warm steps in great number: bodies that drift, turn and meet, each query starting from the last.
//!
//! The suite takes a sample. The documented run of 1e8 steps, some five minutes of an idle core:
//!
//! ```text
//! STEPS=100000000 cargo test --release --test closest_soak -- --ignored --nocapture
//! ```
//!
//! Every answer must be certified, finite and consistent: the interval of a cold query in double-double,
//! asked now and then, must meet the warm one's.

#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]

use bryla::closest::{Accuracy, PairCache, Rung, State, closest_features};
use bryla::math::{Pose, Vector3, quaternion};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;

struct Random(u64);

impl Random {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * (self.0 >> 11) as f64 / 9007199254740992.0
    }

    fn vector(&mut self) -> Vector3 {
        Vector3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0))
    }

    /// A body of 4 to 130 points, now and then on a coarse grid, thin or long.
    fn body(&mut self) -> ConvexPolyhedron {
        let count = self.within(2.0, 7.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
        let count = libm::exp2(count) as usize + 1;
        let axes = match self.within(0.0, 6.0) {
            x if x < 1.0 => [1.0, 1.0, 1e-3],
            x if x < 2.0 => [1e-3, 1.0, 1e-3],
            _ => [1.0, 0.8, 0.6],
        };
        let on_grid = self.within(0.0, 1.0) < 0.25;
        let points: Vec<[f64; 3]> = (0..count)
            .map(|_| {
                let v = self.vector().map(|x| if on_grid { (2.0 * x).round() / 2.0 } else { x });
                [v.x * axes[0], v.y * axes[1], v.z * axes[2]]
            })
            .collect();
        ConvexPolyhedron::from_points(&points).unwrap()
    }
}

#[derive(Debug, Default)]
struct Tally {
    steps: u64,
    rungs: [u64; 4],
    states: [u64; 3],
    width: f64,
    rounds: u64,
    most_rounds: u32,
}

fn soak(steps: u64) -> Tally {
    const A_PAIR: u64 = 4000;
    let (mut r, mut t) = (Random(1), Tally::default());
    while t.steps < steps {
        let (a, b) = (r.body(), r.body());
        let (spin_a, spin_b, pull) = (0.03 * r.vector(), 0.03 * r.vector(), r.within(0.2, 2.0));
        let (mut pose_a, mut pose_b) = (Pose::identity(), Pose { position: r.vector(), ..Pose::identity() });
        let mut velocity = 0.02 * r.vector();
        let mut cache = PairCache::new();
        for k in 0..A_PAIR.min(steps - t.steps) {
            // B swings about A on a spring, both turn
            velocity -= 1e-4 * pull * pose_b.position;
            pose_b.position += velocity;
            pose_a.orientation = quaternion::normalized(&(quaternion::exp(&spin_a) * pose_a.orientation));
            pose_b.orientation = quaternion::normalized(&(quaternion::exp(&spin_b) * pose_b.orientation));

            let warm = closest_features(&a, &pose_a, &b, &pose_b, Some(&mut cache), Accuracy::Exact).unwrap();
            let size = a.radius() + b.radius() + pose_b.position.norm();
            let width = (warm.upper - warm.lower) / (f64::EPSILON * size.max(f64::MIN_POSITIVE));
            assert!(warm.certified && width <= 20.0, "{width} {a:?} {pose_a:?} {b:?} {pose_b:?} {warm:?}");
            let numbers = [warm.signed_distance, warm.point_a.norm(), warm.point_b.norm()];
            assert!(numbers.iter().all(|x| x.is_finite()), "{a:?} {pose_a:?} {b:?} {pose_b:?} {warm:?}");
            assert!((warm.normal.norm() - 1.0).abs() < 1e-15, "{a:?} {pose_a:?} {b:?} {pose_b:?} {warm:?}");
            if k % 1000 == 999 {
                let cold = closest_features(&b, &pose_b, &a, &pose_a, None, Accuracy::Exact).unwrap();
                assert!(
                    cold.lower <= warm.upper && warm.lower <= cold.upper,
                    "{a:?} {pose_a:?} {b:?} {pose_b:?} {warm:?} {cold:?}"
                );
            }

            t.steps += 1;
            t.width = t.width.max(width);
            t.rounds += u64::from(warm.steps);
            t.most_rounds = t.most_rounds.max(warm.steps);
            t.rungs[match warm.rung {
                Rung::Verified => 0,
                Rung::Walked => 1,
                Rung::Searched => 2,
                Rung::DoubleDouble => 3,
            }] += 1;
            t.states[match warm.state {
                State::Separated => 0,
                State::Touching => 1,
                State::Overlapping => 2,
            }] += 1;
        }
    }
    t
}

fn report(t: &Tally) {
    println!(
        "{} warm steps: {} apart, {} touching, {} overlapping; {} verified, {} walked, {} searched, {} in double-double; \
         {:.2} rounds a step, at most {}; widest interval {:.1} eps size",
        t.steps,
        t.states[0],
        t.states[1],
        t.states[2],
        t.rungs[0],
        t.rungs[1],
        t.rungs[2],
        t.rungs[3],
        t.rounds as f64 / t.steps as f64,
        t.most_rounds,
        t.width
    );
}

#[test]
fn warm_steps_stay_certified() {
    report(&soak(40_000));
}

#[test]
#[ignore = "minutes to hours: the documented run, see the module"]
fn warm_steps_stay_certified_at_length() {
    report(&soak(std::env::var("STEPS").ok().and_then(|n| n.parse().ok()).unwrap_or(100_000_000)));
}
