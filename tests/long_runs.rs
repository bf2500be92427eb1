//! Hard motions and long ones: the middle axis, switches, and drift over many steps.

#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]
#![allow(clippy::disallowed_methods, reason = "no bits are promised of tests")]

use bryla::integrator::Control;
use bryla::integrator::free_rotation::FreeRotation;
use bryla::math::{Matrix3, Quaternion, Vector3, quaternion};
use bryla::state::BodyMotion;
use bryla::{Body, Freedom, Method, Record, RunOptions, Scene, Thruster};

fn free_body(moments: [f64; 3], spin: [f64; 3]) -> Scene {
    let mut scene = Scene::new();
    let inertia = Matrix3::from_diagonal(&Vector3::from(moments));
    scene.add(Body::with_inertia("body", 1.0, inertia).angular_velocity(spin)).unwrap();
    scene
}

fn closed_form(moments: [f64; 3], spin: [f64; 3]) -> FreeRotation {
    let momentum = Vector3::from(moments).component_mul(&Vector3::from(spin));
    FreeRotation::new(Vector3::from(moments), Matrix3::identity(), Quaternion::identity(), momentum)
}

/// Kinetic energy and |L| of the first body.
fn invariants(motion: &BodyMotion) -> (f64, f64) {
    (motion.kinetic_energy(), motion.angular_momentum().norm())
}

#[test]
fn near_the_middle_axis_the_tolerance_holds_up_to_the_horizon() {
    let (moments, spin) = ([1.0, 2.0, 3.0], [1e-6, 1.0, 1e-6]);
    let scene = free_body(moments, spin);
    let truth = closed_form(moments, spin);
    // the closed form holds it through all flips; what is integrated, as long as it says
    for (method, flips_wanted) in [(None, 6), (Some(Method::Dop853), 1), (Some(Method::Tsit5), 1)] {
        let options = RunOptions { method, ..RunOptions::tolerance(1e-10) };
        let run = scene.run([0.0, 300.0], &options.record(Record::Samples)).unwrap();
        let report = run.report();
        let (mut worst, mut flips, mut side) = (0.0_f64, 0, 1.0);
        for (sample, &t) in run.times().iter().enumerate().filter(|(_, t)| **t <= report.horizon) {
            let (q, momentum) = truth.at(t);
            worst = worst.max(quaternion::angle_between(&q, &run.states(sample)[0].orientation));
            if momentum.y * side < 0.0 {
                (flips, side) = (flips + 1, -side);
            }
        }
        println!("{method:?}: true {worst:.2e}, {flips} flips, {report}");
        assert!(worst <= report.error_estimate.unwrap() && worst <= 1e-10, "{method:?}: {worst:.2e}");
        assert!(flips >= flips_wanted, "{method:?}: {flips} flips only");
        assert_eq!(report.met, Some(report.horizon >= 300.0), "{method:?}");
    }
}

#[test]
fn no_step_straddles_a_switch_so_the_order_survives_it() {
    let mut scene = Scene::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.4, 0.5));
    let planar = Freedom::planar([0.0, 0.0, 1.0]);
    scene.add(Body::with_inertia("hull", 2.0, inertia).freedom(planar).angular_velocity([0.0, 0.0, 0.4])).unwrap();
    scene.add_effect(Thruster::new("hull", [-0.5, 0.1, 0.0], [2.0, 0.3, 0.0]).schedule(vec![
        (0.31, 1.0),
        (0.77, -0.4),
        (1.13, 0.0),
    ]));
    let end = |method, step| {
        let options = RunOptions { estimate: false, ..RunOptions::method(method).step(step) };
        let run = scene.run([0.0, 1.5], &options.record(Record::End)).unwrap();
        run.states(1)[0]
    };
    let truth = end(Method::Dop853, 1e-3);
    let error = |method, step| (end(method, step).position - truth.position).norm();
    for (method, step, slack) in [(Method::Heun, 0.02, 0.1), (Method::Rk4, 0.1, 0.3)] {
        let slope = (error(method, step) / error(method, 0.5 * step)).log2();
        // steps before a switch are cut, so that halving does not halve all of them
        assert!(slope > f64::from(method.order()) - slack, "{method}: measured {slope:.2}");
    }
}

/// Largest deviations of energy and |L| over so many steps, and of the energy's means over tenths.
fn drift(method: Method, steps: u32, step: f64) -> (f64, f64, f64) {
    drift_with(&RunOptions::method(method), steps, step)
}

fn drift_with(options: &RunOptions, steps: u32, step: f64) -> (f64, f64, f64) {
    let scene = free_body([0.8, 1.5, 2.1], [0.7, -0.4, 1.1]);
    let plan = scene.compile(&options.clone().step(step)).unwrap();
    let mut flight = plan.flight(0, 0.0, &Control::Step(step)).unwrap();
    let mut motions = [plan.bodies()[0].start];
    let (energy0, length0) = invariants(&motions[0]);
    let (mut energy, mut length) = (0.0_f64, 0.0_f64);
    let mut means = [0.0; 10];
    let each = steps / 1000;
    for sample in 0..1000_usize {
        for _ in 0..each {
            flight.advance(f64::INFINITY).unwrap();
        }
        flight.at(flight.front(), &mut motions);
        let (e, l) = invariants(&motions[0]);
        energy = energy.max((e / energy0 - 1.0).abs());
        length = length.max((l / length0 - 1.0).abs());
        means[sample / 100] += (e / energy0 - 1.0) / 100.0;
    }
    (energy, length, (means[9] - means[0]).abs())
}

#[test]
fn splittings_keep_the_momentum_and_bound_the_energy_over_many_steps() {
    for (method, step, swing) in
        [(Method::Split2, 0.01, 3e-6), (Method::Split4, 0.05, 1e-8), (Method::Axes2, 0.01, 1e-5)]
    {
        let (energy, length, trend) = drift(method, 100_000, step);
        println!("{method}: energy {energy:.2e}, trend {trend:.2e}, |L| {length:.2e}");
        // |L| changes by rounding alone, a random walk of 1e5 steps with some ε each
        assert!(length < 1e-12, "{method}: |L| {length:.2e}");
        assert!(energy < swing, "{method}: energy {energy:.2e}");
        assert!(trend < 0.05 * energy, "{method}: trend {trend:.2e}");
    }
    // power series of high order and the discrete rotation lose them by rounding only
    for (method, order, step) in [(Method::Taylor, 20, 0.25), (Method::Dmv, 10, 0.05)] {
        let (energy, length, trend) = drift_with(&RunOptions::method(method).order(order), 100_000, step);
        println!("{method}: energy {energy:.2e}, trend {trend:.2e}, |L| {length:.2e}");
        // a random walk of 1e5 roundings, of which compensated sums leave some ε
        assert!(energy < 1e-13 && length < 1e-13 && trend < 1e-13, "{method}: {energy:.2e} {length:.2e} {trend:.2e}");
    }
    // the same measure finds the climb of a method that has one
    let (energy, _, trend) = drift(Method::Heun, 100_000, 0.01);
    assert!(trend > 0.5 * energy);
}

/// The lectures' long run: 1e8 steps, 20 s to some minutes each. The long-run methods, `split6` and `dmv`, keep energy
/// and |L| within 3e-11 and have no trend.
#[test]
#[ignore = "minutes; cargo test --release --test long_runs -- --ignored --nocapture"]
fn drift_over_a_hundred_million_steps() {
    for (method, step) in [(Method::Split2, 0.01), (Method::Rk4, 0.01), (Method::Split4, 0.05), (Method::Dop853, 0.1)] {
        let (energy, length, trend) = drift(method, 100_000_000, step);
        println!("{method}, h = {step}: energy {energy:.2e}, trend {trend:.2e}, |L| {length:.2e}");
        assert!(length < 1e-5, "{method}: |L| {length:.2e}");
    }
    for method in [Method::Split6, Method::Dmv] {
        let (energy, length, trend) = drift(method, 100_000_000, 0.05);
        println!("{method}, h = 0.05: energy {energy:.2e}, trend {trend:.2e}, |L| {length:.2e}");
        let said = format!("{method}: energy {energy:.2e}, {trend:.2e}, |L| {length:.2e}");
        assert!(energy < 3e-11 && length < 3e-11 && trend < 3e-12, "{said}");
    }
}

#[test]
fn the_same_run_gives_the_same_bits() {
    let scene = free_body([0.8, 1.5, 2.1], [0.7, -0.4, 1.1]);
    for &method in Method::ALL {
        let options = RunOptions { method: Some(method), ..RunOptions::tolerance(1e-5) };
        let [a, b] = [(); 2].map(|()| scene.run([0.0, 1.0], &options).unwrap());
        assert_eq!(a.states(200), b.states(200), "{method}");
    }
}
