//! Loads that the state turns on and off: at the right instants, with the order of the method kept.

use super::{LARGEST_ERROR, SMALLEST_ERROR, distance, free_body, last, run, stepping_through};
use bryla::simulation::Failure;
use bryla::{
    Body, Drag, EventKind, Measure, MeasureFunction, Method, RunError, RunOptions, Scene, Sphere, Switch, Thruster,
    UniformGravity,
};

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// A ball of 1 kg in gravity g = 10 m/s² whose engine lifts it by 30 N: it falls by 10, rises by 20 m/s².
fn hopper(switch: Switch) -> Scene {
    let mut scene = Scene::new();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    scene.add(Body::new("ball", Sphere::new(0.1)).mass(1.0).position([0.0, 0.0, 50.0]).collides(false)).unwrap();
    scene.add_effect(Thruster::new("ball", [0.0; 3], [0.0, 0.0, 30.0]).switch(switch));
    scene
}

#[test]
fn the_switch_times_of_a_sawtooth_are_those_of_the_formula() {
    // down to −2 m/s in 0.2 s; up to −1 m/s in 0.05 s, down again in 0.1 s, and so on
    let scene = hopper(Switch::new(Measure::Velocity(UP), -2.0, -1.0));
    let exact: Vec<f64> =
        (0..).flat_map(|k| [0.2 + 0.15 * f64::from(k), 0.25 + 0.15 * f64::from(k)]).take(10).collect();
    let ways = [
        RunOptions::tolerance(1e-9),
        RunOptions::method(Method::Rk4).step(0.013),
        RunOptions::method(Method::Heun).step(0.4),
        RunOptions::method(Method::Dop853).step(0.07),
        RunOptions::method(Method::Split2).step(0.07),
    ];
    for way in ways {
        let run = scene.run(0.0..0.9, &way).unwrap();
        let found: Vec<_> = run.events().iter().map(|event| event.time).collect();
        assert_eq!(found.len(), exact.len(), "{way:?}: {found:?}");
        for (found, exact) in found.iter().zip(&exact) {
            // constant forces are integrated exactly: rounding of speeds near 2 m/s, over 10 m/s², at every turn
            assert!((found - exact).abs() < 1e-14, "{way:?}: {found} {exact}");
        }
        assert!(run.events().iter().all(|event| event.kind == EventKind::Switch));
        assert_eq!(run.report().impacts, 0);
        let names: Vec<_> = run.events()[..2].iter().map(|event| event.name.as_str()).collect();
        assert_eq!(names, ["effect 2 (thruster) on", "effect 2 (thruster) off"]);
        // the engine works only while it is on: 10 J/m lost, 30 N along the way
        let energy = run.energy().unwrap();
        assert!(energy.drift() < 1e-11, "{way:?}: {}", energy.drift());
        assert!(energy.work.last().unwrap() < &-1.0);
    }
}

#[test]
fn between_the_values_it_starts_as_it_is_told() {
    let first = |switch: Switch| {
        let run = hopper(switch).run(0.0..0.3, &RunOptions::tolerance(1e-9)).unwrap();
        run.events().first().map(|event| (event.name.ends_with(" on"), (event.time * 1e9).round() / 1e9))
    };
    let speed = || Measure::Velocity(UP);
    // at rest, between −1 and 2: off falls to −1, on rises to 2 at 20 m/s²
    assert_eq!(first(Switch::new(speed(), -1.0, 2.0)), Some((true, 0.1)));
    assert_eq!(first(Switch::new(speed(), -1.0, 2.0).starts_on(true)), Some((false, 0.1)));
    // beyond a value it is what that value says
    assert_eq!(first(Switch::new(speed(), 1.0, 2.0)), Some((false, 0.1)));
    assert_eq!(first(Switch::new(speed(), -1.0, -0.5).starts_on(true)), Some((true, 0.1)));
    // and the other way round: on above, off below
    assert_eq!(first(Switch::new(Measure::Speed, 1.0, 0.5)), Some((true, 0.1)));
}

#[test]
fn every_method_keeps_its_order_across_switches_by_the_state() {
    // a tumbling body pushed to and fro through a place, by an engine off its centre
    let mut scene = free_body();
    let engine = |force: [f64; 3], measure, on, off| {
        Thruster::new("body", [0.1, 0.4, -0.2], force).switch(Switch::new(measure, on, off))
    };
    scene.add_effect(engine([0.8, 0.3, 0.5], Measure::Tilt { axis_body: UP, axis: UP }, 0.2, -0.2));
    scene.add_effect(engine([-0.5, 0.2, 0.1], Measure::Position([1.0, 0.0, 0.0]), 0.4, 0.25));
    let truth = run(&scene, 4.0, Method::Rk4, 4.0 / 32768.0);
    let switches = truth.events().len();
    assert!(switches >= 3, "{:?}", truth.events().iter().map(|e| (&e.name, e.time)).collect::<Vec<_>>());
    let truth = last(&truth);
    for method in stepping_through(&scene) {
        let error = |n: u32| {
            let run = run(&scene, 4.0, method, 4.0 / f64::from(n));
            (distance(&last(&run), &truth), run.events().len() == switches)
        };
        let within: Vec<_> = (1..14)
            .flat_map(|k| [1 << k, 3 << (k - 1)])
            .map(|n| (n, error(n)))
            .skip_while(|&(_, (e, all))| e >= LARGEST_ERROR || !all)
            .take_while(|&(_, (e, _))| e >= SMALLEST_ERROR)
            .map(|(n, (e, _))| (n, e))
            .collect();
        let [(first, coarse), .., (last, fine)] = within[within.len() / 2..] else {
            panic!("{method}: too few errors in the window: {within:?}")
        };
        let slope = (coarse / fine).ln() / (f64::from(last) / f64::from(first)).ln();
        let order = f64::from(method.order());
        assert!(slope >= order - 0.3, "{method}: {slope:.2} over {within:?}");
    }
}

#[test]
fn a_tolerance_is_kept_across_switches() {
    let mut scene = hopper(Switch::new(Measure::Velocity(UP), -2.0, -1.0));
    scene.add_effect(Drag { quadratic: 0.3, linear: 0.1, ..Drag::default() });
    let truth = scene.run(0.0..3.0, &RunOptions::tolerance(1e-12)).unwrap();
    for tolerance in [1e-4, 1e-7, 1e-10] {
        let run = scene.run(0.0..3.0, &RunOptions::tolerance(tolerance)).unwrap();
        assert_eq!(run.report().met, Some(true), "{}", run.report());
        let error = (last(&run).position - last(&truth).position).norm() / run.report().length_scale;
        assert!(
            error <= run.report().error_estimate.unwrap() + truth.report().error_estimate.unwrap()
                && error <= tolerance,
            "{tolerance:e}: {error:e}"
        );
        assert_eq!(run.events().len(), truth.events().len());
    }
}

#[test]
fn a_switch_that_is_put_beyond_its_value_turns_at_once() {
    // two engines with one switch: both turn at the same instant
    let switch = || Switch::new(Measure::Velocity(UP), -2.0, -1.0);
    let mut scene = hopper(switch());
    scene.add_effect(Thruster::new("ball", [0.0; 3], [0.0, 0.0, 1.0]).switch(switch()));
    let run = scene.run(0.0..0.5, &RunOptions::method(Method::Rk4).step(0.03)).unwrap();
    let events = run.events();
    assert!(events.len() >= 4 && events.len() % 2 == 0, "{}", events.len());
    for pair in events.chunks(2) {
        assert!((pair[0].time - pair[1].time).abs() < 1e-14 && pair[0].name != pair[1].name, "{pair:?}");
    }
}

#[test]
fn switching_that_accumulates_ends_in_a_named_error() {
    // turned at 1 − e^(−π k/8 …): these instants run up to t = 1
    let measure = MeasureFunction::new(|t, _| Ok((8.0 * (1.0 - t).abs().max(1e-300).ln()).sin()));
    let scene = hopper(Switch::new(measure, -0.5, 0.5));
    match scene.run(0.0..3.0, &RunOptions::method(Method::Rk4).step(0.01).estimate(false)) {
        Err(RunError::Simulation(error)) => {
            assert_eq!(error.kind, Failure::AccumulatingEvents("effect 2 (thruster)".into()), "{error}");
            assert!(error.time < 1.0 && error.trajectory.unwrap().events().len() > 16);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_state_that_is_saved_knows_what_is_on() {
    let scene = hopper(Switch::new(Measure::Velocity(UP), -2.0, -1.0));
    let plan = scene.compile(&RunOptions::method(Method::Rk4).step(0.013)).unwrap();
    let mut whole = plan.start(0.0).unwrap();
    whole.advance(1.0).unwrap();
    let mut pieces = plan.start(0.0).unwrap();
    pieces.advance(0.23).unwrap();
    #[cfg(feature = "serde")]
    {
        let path = std::env::temp_dir().join(format!("bryla-switch-{}.bryla", std::process::id()));
        pieces.save(&path).unwrap();
        pieces = bryla::Simulation::resume(&path).unwrap();
        std::fs::remove_file(path).unwrap();
    }
    pieces.advance(1.0).unwrap();
    assert_eq!(pieces.state("ball").unwrap(), whole.state("ball").unwrap());
    assert_eq!(pieces.events(), whole.events());
}

#[test]
fn bad_switches_are_refused() {
    for (switch, message) in [
        (
            Switch::new(Measure::Speed, 1.0, 1.0),
            "effect 2 (thruster): off must be another value than on, or it would switch for ever, got 1.0",
        ),
        (Switch::new(Measure::Speed, f64::NAN, 1.0), "effect 2 (thruster): on must be a finite number, got NaN"),
        (
            Switch::new(Measure::Distance, 0.0, 1.0),
            "effect 2 (thruster): switch measure must be of one body, not of 2 as distance, got Distance",
        ),
    ] {
        let error = hopper(switch).compile(&RunOptions::tolerance(1e-6)).unwrap_err().to_string();
        assert_eq!(error, message);
    }
}
