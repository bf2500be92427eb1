//! What mass properties cost: closed forms, volume integrals with all their checks, principal axes.

use std::hint::black_box;

use bryla::{Cuboid, Polyhedron};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

/// A closed tube bent into a ring: `n` by `n` quadrilaterals, split into triangles.
fn torus(n: usize) -> Polyhedron {
    let angle = |i: usize| i as f64 * std::f64::consts::TAU / n as f64;
    let point = |i: usize, j: usize| {
        let ((su, cu), (sv, cv)) = (libm::sincos(angle(i)), libm::sincos(angle(j)));
        let r = 1.0 + 0.3 * cv;
        [r * cu, r * su, 0.3 * sv]
    };
    let vertices: Vec<[f64; 3]> = (0..n * n).map(|k| point(k / n, k % n)).collect();
    let at = |i: usize, j: usize| (i % n) * n + j % n;
    let cells = (0..n * n).map(|k| (k / n, k % n));
    let faces = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [vec![a, b, c], vec![a, c, d]]
    });
    Polyhedron::new(vertices, faces.collect::<Vec<_>>())
}

fn mass(c: &mut Criterion) {
    let cuboid = Cuboid::new([0.1, 0.2, 0.3]);
    c.bench_function("mass/cuboid", |b| b.iter(|| black_box(&cuboid).mass_properties(1000.0)));
    for n in [8, 32, 128] {
        let solid = torus(n);
        let id = BenchmarkId::new("mass/polyhedron, faces", 2 * n * n);
        c.bench_with_input(id, &solid, |b, solid| b.iter(|| black_box(solid).mass_properties(1000.0)));
    }
    let properties = torus(32).mass_properties(1000.0).expect("a torus is a solid");
    c.bench_function("mass/principal", |b| b.iter(|| black_box(&properties).principal()));
}

criterion_group!(benches, mass);
criterion_main!(benches);
