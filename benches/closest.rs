//! What a closest-features query costs, beside parry3d's in the same process.
//!
//! ```text
//! cargo bench --bench closest                 statistics, by criterion
//! cargo bench --bench closest -- --table      minima side by side, as in results/closest.md
//! ```
//!
//! Bodies are hulls of points on two ellipsoids of unit size, 8 to 2048 vertices. B moves about A at a
//! distance of 2.6 (apart), 2.05 (near, mixed) or 1.2 (overlapping), turning by 1e-2 or 1e-3 rad a
//! query or put anywhere (cold). Times include the poses' conversion. Before each group the fraction of
//! certified answers, the mean steps and the rungs are printed: only certified answers are worth timing.

use std::hint::black_box;
use std::time::Instant;

use bryla::closest::{Accuracy, Collider, PairCache, Rung, closest_features};
use bryla::math::{Pose, Quaternion, Vector3, quaternion};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use bryla::shape::{Capsule, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Shape, Sphere};
use criterion::{BenchmarkId, Criterion};
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query::details::{
    closest_points_support_map_support_map_with_params, contact_support_map_support_map_with_params,
};
use parry3d_f64::query::gjk::{GJKResult, VoronoiSimplex};
use parry3d_f64::shape::ConvexPolyhedron as ParryPolyhedron;

const SIZES: [usize; 5] = [8, 32, 128, 512, 2048];
const QUERIES: usize = 4096;

/// Points spread over an ellipsoid along a golden spiral, the same on every machine.
fn points(count: usize, axes: [f64; 3], phase: f64) -> Vec<[f64; 3]> {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let point = |k: usize| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / count as f64;
        let (s, c) = libm::sincos(golden * k as f64 + phase);
        let r = (1.0 - z * z).sqrt();
        [axes[0] * r * c, axes[1] * r * s, axes[2] * z]
    };
    (0..count).map(point).collect()
}

fn hull(points: &[[f64; 3]]) -> ConvexPolyhedron {
    ConvexPolyhedron::from_points(points).expect("the points are finite")
}

/// Poses of B about A.
fn poses(distance: f64, step: Option<f64>) -> Vec<Pose> {
    let mut state = 7u64;
    let mut random = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / 9007199254740992.0 * 2.0 - 1.0
    };
    let turn = |x: f64| quaternion::exp(&(Vector3::new(0.6, 0.0, 0.8) * x));
    let pose = |k: usize| {
        let Some(step) = step else {
            let q = Quaternion::new(random(), random(), random(), random());
            let d = Vector3::new(random(), random(), random());
            return Pose { position: d * (distance / d.norm()), orientation: quaternion::normalized(&q) };
        };
        let x = k as f64 * step;
        let (around, up) = (0.37 * x, 0.5 * libm::sin(0.11 * x));
        let ((s1, c1), (s2, c2)) = (libm::sincos(around), libm::sincos(up));
        Pose { position: Vector3::new(c1 * c2, s1 * c2, s2) * distance, orientation: turn(x) }
    };
    (0..QUERIES).map(pose).collect()
}

fn main() {
    if std::env::args().any(|a| a == "--table") {
        return table();
    }
    let mut criterion = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(600))
        .configure_from_args();
    for (regime, distance) in [("apart", 2.6), ("near", 2.05), ("overlapping", 1.2)] {
        for (motion, step) in [("cold", None), ("1e-2", Some(1e-2)), ("1e-3", Some(1e-3))] {
            let mut group = criterion.benchmark_group(format!("{regime}/{motion}"));
            let poses = poses(distance, step);
            for size in SIZES {
                let (pa, pb) = (points(size, [1.0, 0.8, 0.6], 0.0), points(size, [0.9, 1.0, 0.7], 1.0));
                let (a, b) = (hull(&pa), hull(&pb));
                report(regime, motion, size, &a, &b, &poses, step.is_some());

                // every query of the motion in turn; criterion divides by one query
                let home = Pose::identity();
                group.bench_function(BenchmarkId::new("bryla", size), |bencher| {
                    let (mut cache, mut k) = (PairCache::new(), 0);
                    bencher.iter(|| {
                        k = (k + 1) % QUERIES;
                        let cache = if step.is_some() { Some(&mut cache) } else { None };
                        closest_features(&a, &home, &b, black_box(&poses[k]), cache, Accuracy::Exact)
                            .expect("the poses are finite")
                            .signed_distance
                    });
                });
                let mut parry = Parry::new(regime, [&pa, &pb], &poses, step.is_some());
                group.bench_function(BenchmarkId::new("parry", size), |bencher| {
                    let mut k = 0;
                    bencher.iter(|| {
                        k = (k + 1) % QUERIES;
                        parry.query(k)
                    });
                });
            }
            group.finish();
        }
    }
    criterion.final_summary();
}

/// The least time of one query [ns]: many sweeps over all poses, of which the quickest counts, so that
/// what else the machine does is left out.
fn least(queries: usize, mut query: impl FnMut(usize) -> f64) -> f64 {
    const SWEEP: usize = 256;
    const SWEEPS: std::ops::Range<usize> = 24..2000;
    let (start, mut best, mut k) = (Instant::now(), f64::INFINITY, 0);
    for sweep in 0..SWEEPS.end {
        let began = Instant::now();
        for _ in 0..SWEEP {
            k = (k + 1) % queries;
            black_box(query(k));
        }
        best = best.min(began.elapsed().as_secs_f64() / SWEEP as f64);
        if sweep >= SWEEPS.start && start.elapsed().as_secs_f64() > 0.25 {
            break;
        }
    }
    1e9 * best
}

/// Minima of bryla and parry side by side, and what the accuracy switch saves.
fn table() {
    println!("| regime | motion | vertices | bryla ns | parry ns | ratio | certified |\n|---|---|---|---|---|---|---|");
    let home = Pose::identity();
    for (regime, distance) in [("apart", 2.6), ("near", 2.05), ("overlapping", 1.2)] {
        for (motion, step) in [("cold", None), ("1e-2", Some(1e-2)), ("1e-3", Some(1e-3))] {
            let poses = poses(distance, step);
            for size in SIZES {
                let (pa, pb) = (points(size, [1.0, 0.8, 0.6], 0.0), points(size, [0.9, 1.0, 0.7], 1.0));
                let (a, b) = (hull(&pa), hull(&pb));
                let (mut cache, mut certified, mut asked) = (PairCache::new(), 0u64, 0u64);
                let ours = least(QUERIES, |k| {
                    let cache = if step.is_some() { Some(&mut cache) } else { None };
                    let found = closest_features(&a, &home, &b, &poses[k], cache, Accuracy::Exact);
                    let found = found.expect("the poses are finite");
                    certified += u64::from(found.certified);
                    asked += 1;
                    found.signed_distance
                });
                let mut parry = Parry::new(regime, [&pa, &pb], &poses, step.is_some());
                let theirs = least(QUERIES, |k| parry.query(k));
                let share = 100.0 * certified as f64 / asked as f64;
                println!(
                    "| {regime} | {motion} | {size} | {ours:.0} | {theirs:.0} | {:.1} | {share:.2} % |",
                    theirs / ours
                );
            }
        }
    }

    println!("\n| pair | exact | 1e-9 | 1e-6 | yes/no |\n|---|---|---|---|---|");
    let collider = |shape: Shape| Collider::new(&shape).expect("a shape that collides");
    let round = [
        ("cuboid, cuboid", collider(Cuboid::new([0.6; 3]).into()), collider(Cuboid::new([0.5, 0.6, 0.7]).into())),
        ("sphere, capsule", collider(Sphere::new(0.9).into()), collider(Capsule::new(0.3, 0.6).into())),
        ("cylinder, cuboid", collider(Cylinder::new(0.6, 0.7).into()), collider(Cuboid::new([0.5, 0.6, 0.7]).into())),
        ("ellipsoid, cone", collider(Ellipsoid::new([1.0, 0.8, 0.6]).into()), collider(Cone::new(0.7, 0.7).into())),
        (
            "half space, cylinder",
            collider(HalfSpace::new([0.0, 0.0, 1.0], -1.0).into()),
            collider(Cylinder::new(0.6, 0.7).into()),
        ),
        (
            "hulls of 128",
            hull(&points(128, [1.0, 0.8, 0.6], 0.0)).into(),
            hull(&points(128, [0.9, 1.0, 0.7], 1.0)).into(),
        ),
    ];
    for (name, a, b) in &round {
        for (regime, distance) in [("apart", 2.6), ("overlapping", 1.0)] {
            for (motion, step) in [("cold", None), ("warm", Some(1e-2))] {
                let poses = poses(distance, step);
                let cost = |accuracy| {
                    let mut cache = PairCache::new();
                    least(QUERIES, |k| {
                        let cache = if step.is_some() { Some(&mut cache) } else { None };
                        closest_features(a, &home, b, &poses[k], cache, accuracy)
                            .expect("the poses are finite")
                            .signed_distance
                    })
                };
                let all = [Accuracy::Exact, Accuracy::Relative(1e-9), Accuracy::Relative(1e-6), Accuracy::YesNo];
                let [exact, fine, rough, yes_no] = all.map(cost);
                println!("| {name}, {regime}, {motion} | {exact:.0} | {fine:.0} | {rough:.0} | {yes_no:.0} |");
            }
        }
    }
}

/// What share of the answers is certified, and from where.
fn report(
    regime: &str,
    motion: &str,
    size: usize,
    a: &ConvexPolyhedron,
    b: &ConvexPolyhedron,
    poses: &[Pose],
    warm: bool,
) {
    let (mut certified, mut steps, mut rungs, mut width) = (0, 0, [0; 4], 0.0f64);
    let mut cache = PairCache::new();
    for pose in poses {
        let cache = if warm { Some(&mut cache) } else { None };
        let answer =
            closest_features(a, &Pose::identity(), b, pose, cache, Accuracy::Exact).expect("the poses are finite");
        certified += usize::from(answer.certified);
        steps += answer.steps;
        width = width.max(answer.upper - answer.lower);
        rungs[match answer.rung {
            Rung::Verified => 0,
            Rung::Walked => 1,
            Rung::Searched => 2,
            Rung::DoubleDouble => 3,
        }] += 1;
    }
    let n = poses.len() as f64;
    eprintln!(
        "{regime}/{motion}/{size}: certified {:.2} %, {:.2} steps, verified {:.1} %, walked {:.1} %, double-double {}, widest {width:.1e}",
        100.0 * certified as f64 / n,
        f64::from(steps) / n,
        100.0 * f64::from(rungs[0]) / n,
        100.0 * f64::from(rungs[1]) / n,
        rungs[3],
    );
}

/// parry's quickest way: closest points from the last direction, and contact where bodies overlap.
struct Parry {
    bodies: [ParryPolyhedron; 2],
    poses: Vec<ParryPose>,
    apart: bool,
    warm: bool,
    direction: Option<Vector>,
    simplex: VoronoiSimplex,
}

impl Parry {
    fn new(regime: &str, points: [&[[f64; 3]]; 2], poses: &[Pose], warm: bool) -> Self {
        let bodies = points.map(|p| {
            let p: Vec<Vector> = p.iter().map(|v| Vector::new(v[0], v[1], v[2])).collect();
            ParryPolyhedron::from_convex_hull(&p).expect("a solid")
        });
        let pose = |p: &Pose| ParryPose {
            rotation: Rotation::from_xyzw(p.orientation.i, p.orientation.j, p.orientation.k, p.orientation.w),
            translation: Vector::new(p.position.x, p.position.y, p.position.z),
        };
        let poses = poses.iter().map(pose).collect();
        Self { bodies, poses, apart: regime == "apart", warm, direction: None, simplex: VoronoiSimplex::new() }
    }

    fn query(&mut self, k: usize) -> f64 {
        let (pose, [a, b]) = (black_box(&self.poses[k]), &self.bodies);
        let start = if self.warm { self.direction } else { None };
        let result = if self.apart {
            closest_points_support_map_support_map_with_params(pose, a, b, f64::MAX, &mut self.simplex, start)
        } else {
            contact_support_map_support_map_with_params(pose, a, b, f64::MAX, &mut self.simplex, start)
        };
        match result {
            GJKResult::ClosestPoints(p, q, d) => {
                self.direction = Some(d);
                (q - p).dot(d)
            }
            GJKResult::NoIntersection(d) | GJKResult::Proximity(d) => {
                self.direction = Some(d);
                0.0
            }
            GJKResult::Intersection => 0.0,
        }
    }
}
