//! An elastic gas of polyhedra in a box: impacts a second, and what a thousand or ten thousand bodies cost each.
//!
//! ```text
//! cargo bench --all-features --bench gas [-- BODIES [IMPACTS_PER_BODY]]
//! ```
//!
//! Cubes, tetrahedra and octahedra of size 1 stand on a lattice that leaves nine tenths of the space empty,
//! with random velocities and spins; nothing is lost at an impact. One thread; the time is the thread's own.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints, and stops where it cannot go on")]
#![allow(clippy::disallowed_methods, reason = "no bits are promised of benches")]

use bryla::{Body, BodyMotion, Cuboid, EventKind, HalfSpace, Polyhedron, Record, RunOptions, Scene, Shape};

/// Numbers from a seed (`SplitMix64`, Steele, Lea, Flood 2014): the same on every machine.
struct Random(u64);

impl Random {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * (((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn vector(&mut self, size: f64) -> [f64; 3] {
        [0; 3].map(|_| self.within(-size, size))
    }
}

/// Distance of the lattice's points, in sizes of a body [-]: a tenth of the space is filled.
const SPACING: f64 = 2.2;

fn shapes() -> [Shape; 3] {
    let tetrahedron = Polyhedron::new(
        vec![[0.5, 0.5, 0.5], [0.5, -0.5, -0.5], [-0.5, 0.5, -0.5], [-0.5, -0.5, 0.5]],
        vec![vec![0, 1, 2], vec![0, 3, 1], vec![0, 2, 3], vec![1, 3, 2]],
    );
    let axes =
        [[0.6, 0.0, 0.0], [0.0, 0.6, 0.0], [0.0, 0.0, 0.6], [-0.6, 0.0, 0.0], [0.0, -0.6, 0.0], [0.0, 0.0, -0.6]];
    let faces = [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    let octahedron = Polyhedron::new(axes.to_vec(), faces.map(|f| f.to_vec()).to_vec());
    [Cuboid::new([0.5; 3]).into(), tetrahedron.into(), octahedron.into()]
}

fn gas(count: usize) -> Scene {
    let side = (1..=count).find(|side| side.pow(3) >= count).unwrap();
    let half = 0.5 * SPACING * side as f64;
    let mut random = Random(5);
    let mut scene = Scene::new();
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        for sign in [1.0, -1.0] {
            let mut normal = [0.0; 3];
            normal[axis] = sign;
            scene.add(Body::new(format!("{name}{sign}"), HalfSpace::new(normal, -half)).fixed()).unwrap();
        }
    }
    let shapes = shapes();
    for k in 0..count {
        let at = [k % side, k / side % side, k / (side * side)].map(|i| SPACING * (i as f64 + 0.5) - half);
        let body = Body::new(format!("{k}"), shapes[k % 3].clone()).density(1.0).position(at).restitution(1.0);
        let (v, w, q) = (random.vector(1.0), random.vector(1.0), random.vector(1.0));
        let q = [1.0, q[0], q[1], q[2]];
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        scene.add(body.velocity(v).angular_velocity(w).orientation(q.map(|x| x / length))).unwrap();
    }
    scene
}

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let counts = numbers.first().map_or(vec![1000, 10_000], |n| vec![*n]);
    let per_body = numbers.get(1).map_or(10.0, |n| *n as f64);
    println!("bodies  impacts  impacts/s  us/impact  energy drift");
    for count in counts {
        // a body meets another about once in the time in which it flies its spacing
        let scene = gas(count);
        let span = 1.2 * per_body;
        let began = cpu_time::ThreadTime::now();
        let run = match scene.run(0.0..span, &RunOptions::tolerance(1e-6).estimate(false).record(Record::End)) {
            Ok(run) => run,
            Err(error) => {
                println!("{count}: {error}");
                continue;
            }
        };
        let seconds = began.elapsed().as_secs_f64();
        let energy = |sample: usize| run.motions(sample).iter().map(BodyMotion::kinetic_energy).sum::<f64>();
        let drift = (energy(run.times().len() - 1) - energy(0)).abs() / energy(0);
        let impacts = run.events().iter().filter(|event| event.kind == EventKind::Bounce).count();
        println!(
            "{count:6}  {impacts:7}  {:9.0}  {:9.1}  {drift:12.1e}",
            impacts as f64 / seconds,
            1e6 * seconds / impacts as f64
        );
    }
}
