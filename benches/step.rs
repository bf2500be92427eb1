//! What one step of one body costs, method by method: alone, under an effect, and with its motion kept.

use bryla::integrator::Control;
use bryla::math::{Matrix3, Vector3};
use bryla::{Body, Method, RunOptions, Scene, UniformGravity};
use criterion::{Criterion, criterion_group, criterion_main};

/// A free asymmetric body that tumbles.
fn scene() -> Scene {
    let mut scene = Scene::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.8, 1.5, 2.1));
    scene.add(Body::with_inertia("body", 1.0, inertia).angular_velocity([0.7, -0.4, 1.1])).expect("a valid body");
    scene
}

fn step(c: &mut Criterion, group: &str, scene: &Scene, keep: bool) {
    let mut group = c.benchmark_group(group);
    for &method in Method::ALL {
        let plan = scene.compile(&RunOptions::method(method).step(0.01)).expect("a valid scene");
        let mut flight = plan.flight(0, 0.0, Control::Step(0.01)).expect("the first group");
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

fn benches(c: &mut Criterion) {
    let mut scene = scene();
    step(c, "step", &scene, false);
    step(c, "step and its motion", &scene, true);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    step(c, "step under gravity", &scene, false);
}

criterion_group!(all, benches);
criterion_main!(all);
