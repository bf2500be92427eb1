//! What methods of integration promise: their order, their error control, and the bound on the result.

use bryla::math::{Matrix3, Vector3, quaternion};
use bryla::trajectory::Trajectory;
use bryla::{
    Body, Drag, Frame, Freedom, Method, PointGravity, Record, RunOptions, Scene, Thruster, UniformGravity, Wrench,
};

fn inertia(moments: [f64; 3]) -> Matrix3 {
    Matrix3::from_diagonal(&Vector3::from(moments))
}

/// A free body without symmetry.
fn free() -> Scene {
    let mut scene = Scene::new();
    scene.add(Body::with_inertia("body", 1.0, inertia([0.8, 1.5, 2.1])).angular_velocity([0.7, -0.4, 1.1])).unwrap();
    scene
}

/// A body without symmetry, its tensor slanted, under an oscillating torque of the world and a force of its own.
fn driven() -> Scene {
    let mut scene = Scene::new();
    let slanted = Matrix3::new(1.0, 0.2, -0.1, 0.2, 1.6, 0.3, -0.1, 0.3, 2.0);
    let body = Body::with_inertia("body", 1.3, slanted).angular_velocity([0.7, -0.4, 1.1]).velocity([0.5, 0.0, -0.2]);
    scene.add(body).unwrap();
    scene.add_effect(Wrench::new("body", [0.3, 0.1, 0.0], [0.5, 0.8, -0.3]).oscillating(2.0, 0.4));
    scene.add_effect(Wrench::new("body", [0.0, 0.5, 0.2], [0.2, 0.0, 0.1]).frame(Frame::Body));
    scene
}

/// A heavy top without symmetry.
fn top() -> Scene {
    let mut scene = Scene::new();
    let body = Body::with_inertia("body", 1.0, inertia([0.4, 0.5, 0.6]))
        .freedom(Freedom::pivot([0.1, 0.05, -0.5]))
        .orientation([0.9, 0.3, 0.2, 0.1].map(|x: f64| x / 0.95_f64.sqrt()))
        .angular_velocity([1.0, 2.0, 5.0]);
    scene.add(body).unwrap();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    scene
}

fn run(scene: &Scene, span: [f64; 2], options: &RunOptions) -> Trajectory {
    scene.run(span, options).unwrap()
}

/// Largest difference of all bodies at all samples: positions in metres, orientations in radians.
fn difference(a: &Trajectory, b: &Trajectory, scale: f64) -> f64 {
    assert_eq!(a.times(), b.times());
    let mut worst = 0.0_f64;
    for sample in 0..a.times().len() {
        for (a, b) in a.states(sample).iter().zip(b.states(sample)) {
            let place = (a.position - b.position).norm() / scale;
            worst = worst.max(place).max(quaternion::angle_between(&a.orientation, &b.orientation));
        }
    }
    worst
}

/// The slope of the error over halvings of the step, between errors where neither the next order nor
/// rounding shows.
fn measured_order(scene: &Scene, method: Method, record: &RunOptions) -> f64 {
    let span = [0.0, 2.0];
    let fixed = |steps: f64| RunOptions { method: Some(method), step: Some(2.0 / steps), estimate: false, ..record.clone() };
    // truth: a method of order 8 with 2000 steps; its truncation, 1e-9⁸ of a step, is below rounding
    let truth = RunOptions { method: Some(Method::Dop853), step: Some(1e-3), estimate: false, ..record.clone() };
    let truth = run(scene, span, &truth);
    let mut slope = f64::NAN;
    let mut last = f64::INFINITY;
    for halving in 2..14 {
        let error = difference(&run(scene, span, &fixed(f64::from(1 << halving))), &truth, 1.0);
        if error < 1e-12 {
            break;
        }
        if last < 0.1 {
            slope = (last / error).log2();
        }
        last = error;
        if error < 1e-11 {
            break;
        }
    }
    slope
}

#[test]
fn halving_the_step_divides_the_error_by_two_to_the_order() {
    for (name, scene) in [("free", free()), ("driven", driven()), ("top", top())] {
        for &method in Method::ALL {
            let slope = measured_order(&scene, method, &RunOptions::default().record(Record::End));
            let order = f64::from(method.order());
            // of high orders only two halvings lie between the first step that resolves the turning and rounding
            let slack = if order > 4.0 { 0.3 } else { 0.1 };
            println!("{name} {method}: order {order}, measured {slope:.2}");
            assert!((slope - order).abs() < slack || slope > order, "{name} {method}: order {order}, measured {slope:.3}");
        }
    }
}

#[test]
fn tolerances() {
    for (name, scene) in [("free", free()), ("driven", driven()), ("top", top())] {
        let times: Vec<_> = (0..=50).map(|i| f64::from(i) * 0.2).collect();
        let truth = RunOptions { method: Some(Method::Dop853), step: Some(2e-3), estimate: false, ..RunOptions::default() };
        let truth = run(&scene, [0.0, 10.0], &truth.t_eval(times.clone()).record(Record::Samples));
        for method in [Method::Dop853, Method::Tsit5, Method::Rk4] {
            for exponent in [3, 6, 9, 12] {
                let tolerance = 10_f64.powi(-exponent);
                if method != Method::Dop853 && exponent > 9 {
                    continue;
                }
                let options = RunOptions { method: Some(method), ..RunOptions::tolerance(tolerance) };
                let run = run(&scene, [0.0, 10.0], &options.t_eval(times.clone()).record(Record::Samples));
                let error = difference(&run, &truth, run.report().length_scale);
                let r = run.report();
                println!(
                    "{name} {method} {tolerance:.0e}: true {error:.2e} estimate {:.2e} met {:?} steps {} rejected {} seconds {:.1e} + {:.1e}",
                    r.error_estimate.unwrap(), r.met, r.counts.steps, r.counts.rejected, r.seconds.run, r.seconds.estimate
                );
            }
        }
    }
}
