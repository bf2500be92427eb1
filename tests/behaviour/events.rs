//! Events of the user: found whatever the step, located to rounding, and the run ends where they say.

use std::sync::atomic::{AtomicU32, Ordering};

use bryla::simulation::Failure;
use bryla::{
    Body, Cuboid, Direction, EventKind, HalfSpace, Measure, Method, Passage, Record, RunError, RunOptions, Scene,
    Sphere, Spring, UniformGravity, UserEvent,
};

const G: f64 = 9.81;
/// Rounding of a time near 1 s.
const ULP: f64 = f64::EPSILON;

fn thrown_ball(speed: f64) -> Scene {
    let mut scene = Scene::new();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).collides(false);
    scene.add(ball.velocity([1.0, 0.0, speed]).angular_velocity([1.0, 2.0, 3.0])).unwrap();
    scene
}

fn up() -> Measure {
    Measure::Position([0.0, 0.0, 1.0])
}

fn times(run: &bryla::Trajectory) -> Vec<f64> {
    run.events().iter().map(|event| event.time).collect()
}

/// Every way to run: the closed form, error control, and fixed steps of polynomials of degree 3 and 7.
fn ways() -> Vec<RunOptions> {
    let step = |method, step| RunOptions::method(method).step(step).estimate(false);
    vec![
        RunOptions::tolerance(1e-9),
        RunOptions { method: Some(Method::Dop853), ..RunOptions::tolerance(1e-9) },
        step(Method::Rk4, 0.01),
        step(Method::Dop853, 0.5),
    ]
}

#[test]
fn the_times_of_a_throw_are_those_of_the_formula() {
    // z = v t − ½ g t² is 1 m high twice, and at its top in between
    let v = 6.0;
    let root = (v * v - 2.0 * G).sqrt();
    let exact = [(v - root) / G, v / G, (v + root) / G];
    for way in ways() {
        let options = way.event(UserEvent::new("height", up(), ["ball"]).value(1.0)).event(UserEvent::of_function(
            "top",
            |_, bodies| Ok(bodies[0].velocity.z),
            ["ball"],
        ));
        let run = thrown_ball(v).run(0.0..1.1, &options).unwrap();
        let found = times(&run);
        assert_eq!(found.len(), 3, "{found:?}");
        for (found, exact) in found.iter().zip(exact) {
            // a parabola is integrated exactly: what is left is rounding of positions, over the speed
            assert!((found - exact).abs() < 64.0 * ULP, "{found} {exact}");
        }
        let passages: Vec<_> = run.events().iter().map(|event| (event.name.as_str(), event.passage.unwrap())).collect();
        let wanted = [("height", Passage::Rising), ("top", Passage::Falling), ("height", Passage::Falling)];
        assert_eq!(passages, wanted);
        assert!(run.events().iter().all(|event| event.kind == EventKind::User && event.bodies == [0, 0]));
    }
}

#[test]
fn a_direction_leaves_the_other_out() {
    for (direction, count) in [(Direction::Rising, 1), (Direction::Falling, 1), (Direction::Both, 2)] {
        let options =
            RunOptions::tolerance(1e-9).event(UserEvent::new("h", up(), ["ball"]).value(1.0).direction(direction));
        assert_eq!(thrown_ball(6.0).run(0.0..1.1, &options).unwrap().events().len(), count, "{}", direction.name());
    }
}

#[test]
fn no_graze_is_missed_and_no_near_miss_is_one() {
    // throws whose top is the height asked for, to rounding; the run's ends and steps lie anywhere
    let mut state = 41_u64;
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for trial in 0..400 {
        let v = 1.0 + 9.0 * random();
        let top = v * v / (2.0 * G);
        let end = (1.2 + random()) * v / G;
        // in every fourth run a step ends on the top itself
        let step = if trial % 4 == 0 { v / G / 8.0 } else { 0.02 + 0.3 * random() };
        let way = [
            RunOptions::tolerance(1e-9),
            RunOptions::method(Method::Rk4).step(step).estimate(false),
            RunOptions { method: Some(Method::Dop853), ..RunOptions::tolerance(1e-9) },
        ];
        let way = way[trial % 3].clone();
        for (gap, count) in [(0.0, 1), (1e-11 * top, 0), (-1e-11 * top, 2)] {
            let options = way.clone().event(UserEvent::new("touch", up(), ["ball"]).value(top + gap));
            let run = thrown_ball(v).run(0.0..end, &options).unwrap();
            let found = run.events();
            assert_eq!(found.len(), count, "{trial}: v = {v}, gap {gap:e}, {way:?}: {found:?}");
            for event in found {
                assert_eq!(event.passage == Some(Passage::Touching), count == 1, "{trial}: gap {gap:e}");
                // how far the band of 1e-11 reaches in time: √(2·1e-11) of the time up
                assert!((event.time - v / G).abs() < 1e-5 * v / G, "{trial}: {} {}", event.time, v / G);
            }
        }
    }
}

#[test]
fn a_terminal_event_ends_the_run_there() {
    let mut scene = thrown_ball(6.0);
    // a second body, whose own clock may have run further
    scene
        .add(Body::new("other", Cuboid::new([0.1; 3])).mass(1.0).collides(false).angular_velocity([0.3, 0.2, 0.1]))
        .unwrap();
    let landing = 2.0 * 6.0 / G;
    for way in ways() {
        for record in [Record::Dense, Record::Samples, Record::End] {
            let land = UserEvent::new("land", up(), ["ball"]).direction(Direction::Falling).terminal(true);
            let late = UserEvent::new("late", up(), ["ball"]).value(-1.0);
            let options = way.clone().event(land).event(late).record(record);
            let run = scene.run(0.0..10.0, &options).unwrap();
            assert_eq!(run.ended_by(), Some("land"));
            assert!((run.end() - landing).abs() < 64.0 * ULP);
            assert_eq!(times(&run), [run.end()]);
            // the last sample is that of the event, the others those before it
            assert_eq!(*run.times().last().unwrap(), run.end());
            let ball = run.states(run.times().len() - 1)[0];
            assert!(ball.position.z.abs() < 64.0 * ULP && (ball.position.x - landing).abs() < 64.0 * ULP);
            let sooner = scene.run(0.0..run.end(), &way.clone().record(record)).unwrap();
            let (a, b) =
                (run.states(run.times().len() - 1)[1], *sooner.states(sooner.times().len() - 1).last().unwrap());
            // both are the motion of one method, whose steps differ: 1e-9 each at 0.2 rad a step
            assert!((a.orientation - b.orientation).norm() < 1e-8, "{way:?}");
            assert_eq!(run.at(0.5 * run.end()).is_ok(), record == Record::Dense);
            if let Some(met) = run.report().met {
                assert!(met && run.report().error_estimate.unwrap() <= 1e-9, "{}", run.report());
            }
        }
    }
    let never = RunOptions::tolerance(1e-9).event(UserEvent::new("far", up(), ["ball"]).value(100.0).terminal(true));
    let run = scene.run(0.0..1.0, &never).unwrap();
    assert_eq!((run.ended_by(), run.end(), run.times().len()), (None, 1.0, 201));
}

#[test]
fn the_error_of_a_run_that_an_event_ends_is_that_of_its_end() {
    // an oscillator x = cos 2t, ended where it has come down to 0.3
    let mut scene = Scene::new();
    scene.add(Body::new("bob", Sphere::new(0.1)).mass(1.0).position([1.0, 0.0, 0.0]).collides(false)).unwrap();
    scene.add_effect(Spring::to_world("bob", [0.0; 3], 4.0));
    let exact = 0.3_f64.acos() / 2.0;
    for tolerance in [1e-5, 1e-8, 1e-11] {
        let end = UserEvent::new("down", Measure::Position([1.0, 0.0, 0.0]), ["bob"]).value(0.3).terminal(true);
        let run = scene.run(0.0..10.0, &RunOptions::tolerance(tolerance).event(end)).unwrap();
        let estimate = run.report().error_estimate.unwrap();
        // the place is that of the event; what its time is off by shows in the momentum, −m 2 sin 2t
        let error = (run.end() - exact).abs();
        assert!(run.report().met == Some(true) && estimate <= tolerance, "{}", run.report());
        assert!(error <= tolerance, "{tolerance:e}: {error:e}");
    }
}

#[test]
fn events_of_several_bodies_see_them_at_one_time() {
    // two balls that fly towards each other: their centres are 1 m apart at 0.5 s
    let mut scene = Scene::new();
    scene.add(Body::new("a", Sphere::new(0.1)).mass(1.0).collides(false).velocity([2.0, 0.0, 0.0])).unwrap();
    let b = Body::new("b", Sphere::new(0.1)).mass(1.0).collides(false);
    scene.add(b.position([3.0, 0.0, 0.0]).velocity([-2.0, 0.0, 0.0]).angular_velocity([0.0, 5.0, 1.0])).unwrap();
    scene.add(Body::new("post", Sphere::new(0.1)).fixed().origin([2.0, 0.0, 0.0]).collides(false)).unwrap();
    for way in ways() {
        let options = way
            .event(UserEvent::new("near", Measure::Distance, ["a", "b"]).value(1.0).direction(Direction::Falling))
            .event(UserEvent::new("pass", Measure::Distance, ["a", "post"]).value(0.5).direction(Direction::Rising));
        let run = scene.run(0.0..2.0, &options).unwrap();
        let found: Vec<_> = run.events().iter().map(|e| (e.name.as_str(), e.bodies)).collect();
        assert_eq!(found, [("near", [0, 1]), ("pass", [0, 2])]);
        for (time, exact) in times(&run).iter().zip([0.5, 1.25]) {
            assert!((time - exact).abs() < 16.0 * ULP, "{time}");
        }
    }
}

#[test]
fn an_impact_that_turns_the_velocity_is_an_event_of_the_velocity() {
    let mut scene = Scene::new();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    scene.add(Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed()).unwrap();
    scene.add(Body::new("ball", Sphere::new(0.1)).mass(1.0).position([0.0, 0.0, 1.1]).restitution(0.5)).unwrap();
    let options = RunOptions::tolerance(1e-9)
        .event(UserEvent::new("turn", Measure::Velocity([0.0, 0.0, 1.0]), ["ball"]).direction(Direction::Rising));
    let run = scene.run(0.0..0.6, &options).unwrap();
    let [bounce, turn] = run.events() else { panic!("{:?}", run.events()) };
    assert_eq!((bounce.kind, turn.kind, turn.time), (EventKind::Bounce, EventKind::User, bounce.time));
}

#[test]
fn advancing_in_pieces_and_from_a_file_gives_the_same_events() {
    let event = || UserEvent::new("slow", Measure::AngularVelocityBody([0.0, 1.0, 0.0]), ["book"]).value(0.1);
    let mut scene = Scene::new();
    let book = Body::new("book", Cuboid::new([0.1, 0.07, 0.015])).density(600.0);
    scene.add(book.angular_velocity_body([0.1, 6.0, 0.1])).unwrap();
    let options = RunOptions::method(Method::Rk4).step(1e-2).event(event());
    let whole = scene.run(0.0..9.0, &options.clone().estimate(false)).unwrap();
    assert!(whole.events().len() >= 3, "{}", whole.events().len());

    let mut simulation = scene.compile(&options).unwrap().start(0.0).unwrap();
    for piece in 1..=20 {
        simulation.advance(0.2 * f64::from(piece)).unwrap();
    }
    #[cfg(feature = "serde")]
    {
        let path = std::env::temp_dir().join(format!("bryla-events-{}.bryla", std::process::id()));
        simulation.save(&path).unwrap();
        simulation = bryla::Simulation::resume(&path).unwrap();
        std::fs::remove_file(path).unwrap();
    }
    simulation.advance(9.0).unwrap();
    // a run ends its last step at the end, which moves no event before it
    assert_eq!(simulation.events(), whole.events());
}

#[test]
fn what_cannot_go_on_is_named() {
    let scene = thrown_ball(6.0);
    let fails = |event: UserEvent| match scene.run(0.0..1.0, &RunOptions::tolerance(1e-6).event(event)) {
        Err(RunError::Simulation(error)) => error,
        other => panic!("{other:?}"),
    };
    // zeros at 1 − e^(−k π/8): they run up to t = 1
    let zeno = UserEvent::of_function("zeno", |t, _| Ok((8.0 * (1.0 - t).abs().max(1e-300).ln()).sin()), ["ball"]);
    let error = fails(zeno);
    assert_eq!(error.kind, Failure::AccumulatingEvents("zeno".into()));
    assert!(error.time < 1.0 && error.trajectory.unwrap().events().len() > 16);

    let calls = AtomicU32::new(0);
    let gives_up = UserEvent::of_function(
        "gives up",
        move |t, _| if t > 0.5 { Err(format!("call {}", calls.fetch_add(1, Ordering::Relaxed))) } else { Ok(1.0) },
        ["ball"],
    );
    let error = fails(gives_up);
    assert_eq!(error.kind, Failure::UserEvent("gives up".into(), "call 0".into()));
    let nan = fails(UserEvent::of_function("nan", |t, _| Ok((0.5 - t).sqrt()), ["ball"]));
    assert_eq!(nan.to_string(), "t = 0.5 s, ball: event nan: its measure is not a finite number");

    // what a hash makes of the time has no roots that could be told
    let rough = |t: f64, _: &[_]| Ok((t.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40) as f64 - 8e6);
    assert_eq!(fails(UserEvent::of_function("rough", rough, ["ball"])).kind, Failure::UnresolvedEvent("rough".into()));
}

#[test]
fn bad_events_are_refused() {
    let scene = thrown_ball(6.0);
    let height = || UserEvent::new("height", up(), ["ball"]);
    for (events, message) in [
        (
            vec![UserEvent::new("h", up(), ["bal"])],
            "event h: bodies names \"bal\", which is not in the scene; there is ball",
        ),
        (vec![height(), height()], "run: event name must be one that no other event has, got \"height\""),
        (
            vec![UserEvent::new("h", up(), ["ball", "ball"])],
            "event h: bodies must be one name for position, got [\"ball\", \"ball\"]",
        ),
        (
            vec![UserEvent::new("h", Measure::Distance, ["ball"])],
            "event h: bodies must be 2 names for distance, got [\"ball\"]",
        ),
        (vec![height().value(f64::NAN)], "event height: value must be a finite number, got NaN"),
        (
            vec![UserEvent::new("h", Measure::Velocity([0.0; 3]), ["ball"])],
            "event h: measure must be along a finite direction other than 0, got [0.0, 0.0, 0.0]",
        ),
        (vec![UserEvent::new("", up(), ["ball"])], "event : name must be a name, got \"\""),
    ] {
        let options = RunOptions { events, ..RunOptions::tolerance(1e-6) };
        assert_eq!(scene.compile(&options).unwrap_err().to_string(), message);
    }
    let terminal = RunOptions::method(Method::Rk4).step(0.1).event(height().terminal(true));
    let message = scene.compile(&terminal).unwrap().start(0.0).unwrap_err().to_string();
    assert!(message.starts_with("event height: terminal: a simulation that is advanced by hand"), "{message}");
}

#[test]
fn the_plan_says_what_it_watches() {
    let options = RunOptions::tolerance(1e-6).event(UserEvent::new("land", up(), ["ball"]).terminal(true));
    let text = thrown_ball(6.0).compile(&options).unwrap().explain();
    assert!(text.contains("event land: position of ball at 0, both; ends the run"), "{text}");
}
