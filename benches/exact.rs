//! What the closed form of free rotation costs: setting up, one more time, and a step of a uniform grid.

use std::hint::black_box;

use bryla::integrator::free_rotation::FreeRotation;
use bryla::math::{Matrix3, Quaternion, Vector3};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// One body for each way through the code.
const BODIES: [(&str, [f64; 3], [f64; 3]); 4] = [
    ("generic", [0.8, 1.5, 2.1], [0.5, -1.3, 0.7]),
    ("flipping", [1.0, 2.0, 3.0], [1e-6, 2.0, 1e-6]),
    ("near switch", [1.0, 2.0, 3.0], [0.15, 1.0, 0.1]),
    ("symmetric", [1.0, 1.0, 2.0], [0.3, -0.4, 1.7]),
];

/// Steps of the uniform grid [-].
const STEPS: u32 = 1000;

fn exact(criterion: &mut Criterion) {
    for (name, moments, momentum) in BODIES {
        let new = || {
            FreeRotation::new(
                black_box(Vector3::from(moments)),
                black_box(Matrix3::identity()),
                black_box(Quaternion::identity()),
                black_box(Vector3::from(momentum)),
            )
        };
        let motion = new();
        let mut group = criterion.benchmark_group(name);
        group.bench_function("set-up", |b| b.iter(new));
        let mut t = 0.0;
        group.bench_function("at", |b| {
            b.iter(|| {
                t += 0.01;
                black_box(&motion).at(black_box(t))
            });
        });
        group.throughput(Throughput::Elements(u64::from(STEPS)));
        group.bench_function("uniform", |b| {
            b.iter(|| {
                for state in black_box(&motion).uniform(black_box(0.0), black_box(0.01), STEPS as usize) {
                    black_box(state);
                }
            });
        });
        group.finish();
    }
}

criterion_group!(benches, exact);
criterion_main!(benches);
