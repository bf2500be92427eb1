//! What one step of one body costs, method by method: alone, with its motion kept, and both under an effect.
//!
//! Times are those of the thread's processor clock, so that other programs do not count.

use bryla::integrator::{Control, Flight};
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

/// Length of a step [s].
const STEP: f64 = 0.01;

/// A flight of the scene by the method.
fn flight(scene: &Scene, method: Method) -> Box<dyn Flight> {
    let plan = scene.compile(&RunOptions::method(method).step(STEP)).expect("a valid scene");
    plan.flight(0, 0.0, &Control::Step(STEP)).expect("the first group")
}

/// Steps that follow each other, nobody looking: the integrator alone.
fn kernel(c: &mut Criterion<ProcessorTime>, group: &str, scene: &Scene) {
    let mut group = c.benchmark_group(group);
    for &method in Method::ALL {
        let mut flight = flight(scene, method);
        group.bench_function(method.name(), |b| {
            b.iter_custom(|steps| {
                let last = flight.front() + (steps as f64 - 0.5) * STEP;
                let start = ThreadTime::now();
                flight.advance_past(last, f64::INFINITY).expect("steps");
                start.elapsed()
            });
        });
    }
}

/// A step at a call, whose motion is kept.
fn recorded(c: &mut Criterion<ProcessorTime>, group: &str, scene: &Scene) {
    let mut group = c.benchmark_group(group);
    for &method in Method::ALL {
        let mut flight = flight(scene, method);
        group.bench_function(method.name(), |b| {
            b.iter(|| {
                flight.advance(f64::INFINITY).expect("a step");
                flight.interpolate().expect("a finite motion");
            });
        });
    }
}

fn benches(c: &mut Criterion<ProcessorTime>) {
    let mut scene = scene();
    kernel(c, "step", &scene);
    recorded(c, "step and its motion", &scene);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    kernel(c, "step under gravity", &scene);
    recorded(c, "step and its motion under gravity", &scene);
}

criterion_group! {
    name = all;
    config = Criterion::default().with_measurement(ProcessorTime);
    targets = benches
}
criterion_main!(all);
