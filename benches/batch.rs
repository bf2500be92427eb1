//! Body-steps a second of one core: free bodies in a batch, and one body alone.
//!
//! Least time of many repetitions, by the thread's processor clock, so that other programs do not count. The figure
//! depends on the width of the vector registers that the compiler may use:
//! `RUSTFLAGS="-C target-cpu=native" cargo bench --all-features --bench batch`.

use std::num::NonZero;

use bryla::integrator::Control;
use bryla::math::{Matrix3, Vector3};
use bryla::{Batch, Body, BodyMotion, Method, RunOptions, Scene};
use cpu_time::ThreadTime;

/// Length of a step [s].
const STEP: f64 = 0.01;
/// Steps of a repetition.
const STEPS: u32 = 1000;
const REPETITIONS: u32 = 100;

/// Least time of the repetitions [s].
fn least(mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let start = ThreadTime::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..REPETITIONS).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.8, 1.5, 2.1));
    let features = [
        ("avx512f", cfg!(target_feature = "avx512f")),
        ("avx2", cfg!(target_feature = "avx2")),
        ("sse2", cfg!(target_feature = "sse2")),
    ];
    let widest = features.iter().find(|(_, there)| *there).map_or("none", |(name, _)| name);
    println!("vector registers: {widest}");

    for bodies in [32, 1024, 32 * 1024] {
        let motion = |i: u32| {
            let mut motion = BodyMotion::at_rest(1.0, inertia);
            motion.angular_velocity = Vector3::new(0.7, -0.4 + 1e-3 * f64::from(i % 100), 1.1);
            motion
        };
        let mut batch = Batch::new((0..bodies).map(motion).collect()).expect("valid bodies");
        let steps = (STEPS * 32 / bodies).max(1);
        let seconds = least(|| batch.advance(STEP, u64::from(steps), NonZero::<usize>::MIN).expect("steps"));
        let rate = f64::from(bodies) * f64::from(steps) / seconds;
        println!("batch of {bodies:>5}: {:6.1} M body-steps/s, {:6.1} ns each", rate / 1e6, 1e9 / rate);
    }

    let mut scene = Scene::new();
    scene.add(Body::with_inertia("body", 1.0, inertia).angular_velocity([0.7, -0.4, 1.1])).expect("a valid body");
    let plan = scene.compile(&RunOptions::method(Method::Rk4).step(STEP)).expect("a valid scene");
    let mut flight = plan.flight(0, 0.0, &Control::Step(STEP)).expect("the first group");
    let seconds = least(|| {
        let last = flight.front() + (f64::from(STEPS) - 0.5) * STEP;
        flight.advance_past(last, f64::INFINITY).expect("steps");
    });
    let rate = f64::from(STEPS) / seconds;
    println!("one body alone : {:6.1} M body-steps/s, {:6.1} ns each", rate / 1e6, 1e9 / rate);
}
