//! What one step of one body costs, method by method: alone, under an effect, and with its motion kept.
//!
//! Times are those of the thread's processor clock, so that other programs do not count.

use bryla::integrator::Control;
use bryla::math::{Matrix3, Vector3};
use bryla::{Body, Method, RunOptions, Scene, UniformGravity};
use cpu_time::ThreadTime;
use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use criterion::{Criterion, criterion_group, criterion_main};
use std::time::Duration;

/// Time of the thread's processor clock.
struct ProcessorTime;

impl Measurement for ProcessorTime {
    type Intermediate = ThreadTime;
    type Value = Duration;

    fn start(&self) -> ThreadTime {
        ThreadTime::now()
    }

    fn end(&self, start: ThreadTime) -> Duration {
        start.elapsed()
    }

    fn add(&self, a: &Duration, b: &Duration) -> Duration {
        *a + *b
    }

    fn zero(&self) -> Duration {
        Duration::ZERO
    }

    fn to_f64(&self, value: &Duration) -> f64 {
        value.as_nanos() as f64
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        WallTime.formatter()
    }
}

/// A free asymmetric body that tumbles.
fn scene() -> Scene {
    let mut scene = Scene::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.8, 1.5, 2.1));
    scene.add(Body::with_inertia("body", 1.0, inertia).angular_velocity([0.7, -0.4, 1.1])).expect("a valid body");
    scene
}

fn step(c: &mut Criterion<ProcessorTime>, group: &str, scene: &Scene, keep: bool) {
    let mut group = c.benchmark_group(group);
    for &method in Method::ALL {
        let plan = scene.compile(&RunOptions::method(method).step(0.01)).expect("a valid scene");
        let mut flight = plan.flight(0, 0.0, &Control::Step(0.01)).expect("the first group");
        group.bench_function(method.name(), |b| {
            b.iter(|| {
                flight.advance(f64::INFINITY).expect("a step");
                if keep {
                    flight.interpolate();
                }
            });
        });
    }
}

fn benches(c: &mut Criterion<ProcessorTime>) {
    let mut scene = scene();
    step(c, "step", &scene, false);
    step(c, "step and its motion", &scene, true);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    step(c, "step under gravity", &scene, false);
}

criterion_group! {
    name = all;
    config = Criterion::default().with_measurement(ProcessorTime);
    targets = benches
}
criterion_main!(all);
