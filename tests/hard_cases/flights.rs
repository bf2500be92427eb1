//! Projectiles, satellites and the hovercraft, against their formulas.

use std::ops::ControlFlow;

use bryla::integrator::free_rotation::FreeRotation;
use bryla::math::{Matrix3, Vector3, quaternion};
use bryla::{
    Body, Drag, Freedom, Measure, Method, PointGravity, Record, RunOptions, Scene, Sphere, Thruster, UniformGravity,
    UserEvent,
};

/// A throw straight up against quadratic drag: `t = (v∞/g) atan(v/v∞)`, `v∞² = m g/k`.
#[test]
fn a_throw_through_air_has_its_top_where_the_formula_says() {
    const G: f64 = 9.81;
    let (speed, drag, mass) = (40.0, 0.02, 0.5);
    let limit = (mass * G / drag).sqrt();
    let exact = limit / G * (speed / limit).atan();
    let mut scene = Scene::new();
    scene.add(Body::new("ball", Sphere::new(0.05)).mass(mass).velocity([0.0, 0.0, speed])).unwrap();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    scene.add_effect(Drag::new(0.0, drag));
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let top = UserEvent::new("top", Measure::Velocity([0.0, 0.0, 1.0]), ["ball"]);
        let run = scene.run([0.0, 2.0 * exact], &RunOptions::tolerance(tolerance).event(top)).unwrap();
        let [event] = run.events() else { panic!("{:?}", run.events()) };
        println!("{tolerance:e}: {:.2e}", event.time / exact - 1.0);
        assert!((event.time / exact - 1.0).abs() <= tolerance, "{tolerance:e}: {} {exact}", event.time);
    }
}

/// Three turns of an orbit of eccentricity 0.6: Kepler's equation `M = E − e sin E`, and the rotation of a free body.
#[test]
fn a_satellite_is_where_kepler_says_and_turned_as_euler_says() {
    let (e, moments, spin) = (0.6_f64, Vector3::new(0.8, 1.5, 2.1), Vector3::new(0.7, -0.4, 1.1));
    let mut scene = Scene::new();
    let body = Body::with_inertia("moon", 1.0, Matrix3::from_diagonal(&moments)).angular_velocity(spin);
    // semi-major axis and μ are 1; it starts at its periapsis
    scene.add(body.position([1.0 - e, 0.0, 0.0]).velocity([0.0, ((1.0 + e) / (1.0 - e)).sqrt(), 0.0])).unwrap();
    scene.add_effect(PointGravity::new(1.0, [0.0; 3]).gradient_torque(false));
    let times: Vec<f64> = (1..=60).map(|i| 0.1 * std::f64::consts::PI * f64::from(i)).collect();
    let options = RunOptions::tolerance(1e-10).t_eval(times.clone()).record(Record::Samples);
    let run = scene.run([0.0, times[59]], &options).unwrap();
    let truth = FreeRotation::new(
        moments,
        Matrix3::identity(),
        bryla::math::Quaternion::identity(),
        moments.component_mul(&spin),
    );
    for (sample, &t) in times.iter().enumerate() {
        let mut anomaly = t;
        for _ in 0..100 {
            anomaly -= (anomaly - e * anomaly.sin() - t) / (1.0 - e * anomaly.cos());
        }
        let exact = Vector3::new(anomaly.cos() - e, (1.0 - e * e).sqrt() * anomaly.sin(), 0.0);
        let state = run.states(sample)[0];
        let (off, angle) =
            ((state.position - exact).norm(), quaternion::angle_between(&state.orientation, &truth.at(t).0));
        assert!(off < 1e-9 && angle < 1e-9, "t = {t}: {off:.2e} m, {angle:.2e} rad");
    }
}

/// An engine on the centre of mass of a hull that turns at a steady rate: `v = (F/m ω) Σ k [sin ωt, −cos ωt]` between
/// switches, and its integral, in the plane and as a free body.
#[test]
fn a_hovercraft_is_where_its_formula_says_over_six_switches() {
    let (force, mass, rate) = (3.0, 2.0, 0.7_f64);
    let schedule = [(0.31, 1.0), (0.77, -0.4), (1.13, 0.0), (1.9, 0.8), (2.6, 0.3), (3.3, 0.0)];
    let end = 4.0;

    // x, v and the time, from switch to switch
    let (mut x, mut v, mut t) = ([0.0; 2], [0.0; 2], 0.0);
    let mut factor = 0.0;
    for (next, k) in schedule.into_iter().chain([(end, 0.0)]) {
        let (a, h) = (factor * force / mass, next - t);
        let (s0, c0, s1, c1) = ((rate * t).sin(), (rate * t).cos(), (rate * next).sin(), (rate * next).cos());
        x[0] += h * v[0] + a / rate * (-(c1 - c0) / rate - h * s0);
        x[1] += h * v[1] + a / rate * (-(s1 - s0) / rate + h * c0);
        v[0] += a / rate * (s1 - s0);
        v[1] -= a / rate * (c1 - c0);
        (t, factor) = (next, k);
    }

    let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.4, 0.5));
    for freedom in [Freedom::planar([0.0, 0.0, 1.0]), Freedom::Free] {
        let mut scene = Scene::new();
        let hull = Body::with_inertia("hull", mass, inertia).freedom(freedom.clone());
        scene.add(hull.angular_velocity([0.0, 0.0, rate])).unwrap();
        scene.add_effect(Thruster::new("hull", [0.0; 3], [force, 0.0, 0.0]).schedule(schedule.to_vec()));
        for method in [None, Some(Method::Dop853), Some(Method::Tsit5)] {
            let options = RunOptions { method, ..RunOptions::tolerance(1e-10) };
            let run = scene.run([0.0, end], &options.record(Record::End)).unwrap();
            let state = run.states(run.times().len() - 1)[0];
            let off = (state.position.x - x[0]).hypot(state.position.y - x[1]);
            println!("{freedom:?}, {method:?}: {off:.2e} m, off the plane {:.2e} m", state.position.z);
            assert!(off < 1e-10, "{freedom:?}, {method:?}: {off:.2e} m");
            assert!(state.position.z.abs() < 1e-13, "{freedom:?}, {method:?}: {:.2e} m", state.position.z);
        }
    }
}

/// The gradient of gravity throws a large satellite about beyond any tolerance: the run says up to when it is known, and
/// up to there it is what another method finds.
#[test]
fn a_tumbling_satellite_has_a_horizon() {
    let mut scene = Scene::new();
    // moments of a body a tenth of its orbit's size
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.8e-3, 1.5e-3, 2.1e-3));
    let body = Body::with_inertia("moon", 1.0, inertia).angular_velocity([0.7, -0.4, 1.1]);
    scene.add(body.position([0.4, 0.0, 0.0]).velocity([0.0, 2.0, 0.0])).unwrap();
    scene.add_effect(PointGravity::new(1.0, [0.0; 3]));
    let times: Vec<f64> = (1..=60).map(|i| 0.3 * f64::from(i)).collect();
    let run = |method| {
        let options = RunOptions { method: Some(method), ..RunOptions::tolerance(1e-8) };
        scene.run([0.0, 18.0], &options.t_eval(times.clone()).record(Record::Samples)).unwrap()
    };
    let (run, other) = (run(Method::Dop853), run(Method::Tsit5));
    let known = run.report().horizon.min(other.report().horizon);
    println!("{}", run.report());
    assert_eq!(run.report().met, Some(known >= 18.0));
    for (sample, &t) in times.iter().enumerate().filter(|(_, t)| **t <= known) {
        let angle = quaternion::angle_between(&run.states(sample)[0].orientation, &other.states(sample)[0].orientation);
        assert!(angle <= 2e-8, "t = {t}: {angle:.2e} rad");
    }
}

/// Engines push a hull until its drag turns round within a few ulp of the end of a step of the pass before: the run goes
/// on from there. Of its steps nothing is asked but that there is an end of them.
#[test]
fn a_turn_at_the_end_of_a_step_does_not_stop_the_clock() {
    let mut scene = Scene::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.4, 0.5));
    let hull = Body::with_inertia("hull", 2.0, inertia).freedom(Freedom::planar([0.0, 0.0, 1.0]));
    let hull = hull.velocity([-0.37975405133256723, 0.3, 0.0]).angular_velocity([0.0, 0.0, 0.10886487023896829]);
    scene.add(hull).unwrap();
    let engines = [
        (
            [-0.5, 0.0, 0.0],
            [0.7488452133871824, -0.9005498682441044, 0.0],
            [
                (0.30755066764990824, 0.14893710858567244),
                (1.3536992965869552, 0.5400141970316353),
                (2.5194199885611575, 0.0),
            ],
        ),
        (
            [0.4, 0.2, 0.0],
            [2.629802902185241, -0.17007631432079973, 0.0],
            [
                (0.24321630795851235, 0.9025195985861533),
                (1.5156525603485955, 0.42316608747831985),
                (3.9497912084549633, 0.0),
            ],
        ),
        (
            [0.4, -0.2, 0.0],
            [2.91672561586084, -0.11579609046291361, 0.0],
            [
                (0.9503915454865776, 0.2385714245842171),
                (1.2958565978549863, 0.6024295262424681),
                (3.3506975195020416, 0.0),
            ],
        ),
    ];
    for (point, force, schedule) in engines {
        scene.add_effect(Thruster::new("hull", point, force).schedule(schedule.to_vec()));
    }
    scene.add_effect(Drag::new(0.4, 0.2).angular(0.1, 0.05));

    let mut steps = 0;
    let mut count = |_| {
        steps += 1;
        if steps < 100_000 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let options = RunOptions::tolerance(3.499321480048751e-7);
    match scene.run_observed([0.0, 4.225537561363096], &options, &mut count) {
        Ok(run) => assert_eq!(run.report().met, Some(true)),
        Err(error) => panic!("{error}"),
    }
}
