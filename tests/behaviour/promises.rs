//! Bits, saved states, and samples.

use super::{free_body, last, stepping_through};
use bryla::{Body, Cuboid, Drag, HalfSpace, Method, Record, RunOptions, Scene, Simulation, Thruster, UniformGravity};

/// The die on its table, with everything that a saved state must carry.
fn die() -> Scene {
    bryla::catalogue::bouncing_die().unwrap()
}

fn by_hand() -> RunOptions {
    RunOptions::method(Method::Rk4).step(1e-3)
}

#[test]
fn the_same_scene_twice_gives_the_same_bits() {
    for name in bryla::catalogue::NAMES {
        let scene = bryla::catalogue::scene(name).unwrap().unwrap();
        let span = scene.run.t_span.unwrap();
        let bits = || {
            let options = RunOptions::method(Method::Heun).step((span[1] - span[0]) / 1000.0).estimate(false);
            let run = scene.run(span, &options).unwrap();
            (0..run.times().len()).flat_map(|s| run.states(s).to_vec()).collect::<Vec<_>>()
        };
        assert_eq!(bits(), bits(), "{name}");
    }
}

#[test]
fn a_saved_state_goes_on_with_the_same_bits() {
    let folder = std::env::temp_dir().join(format!("bryla-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("at.bryla");
    let mut hovercraft = bryla::catalogue::hovercraft().unwrap();
    hovercraft.run = RunOptions::default();
    for (scene, body, times) in [(die(), "die", [0.33, 0.5, 0.89]), (hovercraft, "hovercraft", [3.7, 9.0, 15.0])] {
        let plan = scene.compile(&by_hand()).unwrap();
        let mut unbroken = plan.start(0.0).unwrap();
        let mut broken = plan.start(0.0).unwrap();
        for t in times {
            unbroken.advance(t).unwrap();
            broken.advance(t).unwrap();
            broken.save(&path).unwrap();
            broken = Simulation::resume(&path).unwrap();
            assert_eq!(unbroken.state(body).unwrap(), broken.state(body).unwrap(), "{body} at {t}");
            assert_eq!(unbroken.events(), broken.events());
            assert_eq!(unbroken.counts().steps, broken.counts().steps);
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_contact_that_is_saved_goes_on_with_the_same_bits() {
    let mut scene = Scene::new();
    scene.add(Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(0.3)).unwrap();
    let cube = Body::new("cube", Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, 0.1]).friction(0.3);
    scene.add(cube.velocity([2.0, 0.0, 0.0]).angular_velocity([0.0, 0.0, 3.0])).unwrap();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    let plan = scene.compile(&RunOptions::method(Method::Rk4).step(1e-2).estimate(false)).unwrap();
    let path = std::env::temp_dir().join(format!("bryla-contact-{}.bryla", std::process::id()));
    let mut unbroken = plan.start(0.0).unwrap();
    let mut broken = plan.start(0.0).unwrap();
    for t in [0.1234, 0.4, 1.0] {
        unbroken.advance(t).unwrap();
        broken.advance(t).unwrap();
        broken.save(&path).unwrap();
        broken = Simulation::resume(&path).unwrap();
        assert_eq!(unbroken.state("cube").unwrap(), broken.state("cube").unwrap(), "at {t}");
        assert_eq!(unbroken.events(), broken.events());
    }
    std::fs::remove_file(&path).unwrap();
    // it has come to rest
    assert_eq!(unbroken.state("cube").unwrap().linear_momentum, bryla::math::Vector3::zeros());
}

#[test]
fn advancing_in_pieces_is_advancing_at_once() {
    let plan = die().compile(&by_hand()).unwrap();
    let (mut pieces, mut once) = (plan.start(0.0).unwrap(), plan.start(0.0).unwrap());
    for i in 1..=8 {
        pieces.advance(0.1 * f64::from(i) + 1e-4).unwrap();
    }
    once.advance(0.8 + 1e-4).unwrap();
    assert_eq!(pieces.state("die").unwrap(), once.state("die").unwrap());
}

#[test]
fn a_simulation_by_hand_is_a_run() {
    // the span's end cuts the last step of a run; where a step ends there anyway, nothing differs
    let scene = die();
    let run = scene.run(0.0..0.5, &by_hand().estimate(false)).unwrap();
    let mut hand = scene.compile(&by_hand()).unwrap().start(0.0).unwrap();
    hand.advance(0.5).unwrap();
    let (a, b) = (run.states(run.times().len() - 1)[1], hand.state("die").unwrap());
    // after a bounce the steps no longer meet the span's end, and the state by hand is read from the cubic
    // of a step: error (ω h)⁴/384 with ω up to 200 rad/s
    assert!(super::distance(&a, &b) < 5e-6);
}

#[test]
fn samples_are_where_they_were_asked_for() {
    let mut scene = free_body();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    let times = vec![0.1, 0.25, 0.333, 1.0];
    let run = scene.run(0.0..1.0, &by_hand().t_eval(times.clone())).unwrap();
    assert_eq!(run.times(), times);
    for (sample, t) in times.iter().enumerate() {
        let exact = -0.5 * 9.81 * t * t + 0.5 * t;
        // rounding of up to 1000 steps of numbers up to 5
        assert!((run.states(sample)[0].position.z - exact).abs() < 1000.0 * f64::EPSILON * 5.0, "{t}");
        assert_eq!(run.at(*t).unwrap(), run.states(sample));
    }
    let default = scene.run(0.0..1.0, &by_hand()).unwrap();
    assert_eq!((default.times().len(), default.times()[0], default.end()), (201, 0.0, 1.0));
    let ends = scene.run(0.0..1.0, &by_hand().record(Record::End)).unwrap();
    assert_eq!(ends.times(), [0.0, 1.0]);
    assert_eq!(last(&ends), last(&default));
}

#[test]
fn what_is_recorded_does_not_change_the_motion() {
    // with few samples most steps are taken unseen, many at once; with all, one by one: the same steps, the same bits
    let mut switched = free_body();
    switched.add_effect(Thruster::new("body", [0.1, 0.2, 0.0], [2.0, 0.0, 1.0]).schedule([(0.31, 1.0), (0.62, 0.0)]));
    let top = bryla::catalogue::heavy_top().unwrap();
    let times = vec![0.0003, 0.25, 0.333, 0.3331, 0.9, 1.0];
    for (name, scene) in [("free", free_body()), ("switched", switched), ("top", top)] {
        for method in stepping_through(&scene) {
            let scene = Scene { run: RunOptions::default(), ..scene.clone() };
            let options = RunOptions::method(method).step(7e-4);
            let run = |record| scene.run(0.0..1.0, &options.clone().t_eval(times.clone()).record(record)).unwrap();
            let (seen, unseen) = (run(Record::Dense), run(Record::Samples));
            let ends = scene.run(0.0..1.0, &options.clone().record(Record::End)).unwrap();
            for (sample, t) in times.iter().enumerate() {
                assert_eq!(seen.states(sample), unseen.states(sample), "{name}, {method}, {t}");
            }
            assert_eq!(last(&seen), last(&ends), "{name}, {method}");
            for other in [unseen.report(), ends.report()] {
                assert_eq!(seen.report().counts.steps, other.counts.steps, "{name}, {method}");
            }
            assert_eq!(seen.report().error_estimate, unseen.report().error_estimate, "{name}, {method}");
        }
    }
}

#[test]
fn any_time_may_be_asked_for_afterwards() {
    // between samples the motion is that of the step, the cubic through its ends: error h⁴ of the fourth derivative
    let scene = free_body();
    let run = scene.run(0.0..1.0, &by_hand()).unwrap();
    let there = scene.run(0.0..0.4567, &by_hand()).unwrap();
    let apart =
        bryla::math::quaternion::angle_between(&run.at(0.4567).unwrap()[0].orientation, &last(&there).orientation);
    assert!(apart < 1e-11, "{apart:e}");
    let message = run.at(1.5).unwrap_err().to_string();
    assert_eq!(message, "trajectory: time must be within 0 to 1, got 1.5");
    let sparse = scene.run(0.0..1.0, &by_hand().record(Record::Samples)).unwrap();
    assert!(sparse.at(0.4567).unwrap_err().to_string().contains("record = dense"));
}

#[test]
fn at_an_impact_a_sample_shows_the_state_after_it() {
    let scene = die();
    let first = scene.run(0.0..0.4, &by_hand()).unwrap().events()[0].clone();
    let run = scene.run(0.0..0.4, &by_hand().t_eval(vec![0.0, first.time, 0.4])).unwrap();
    assert!((run.motions(1)[1].velocity - first.velocity[1]).norm() < 1e-15);
}

#[test]
fn an_observer_is_told_and_may_stop_the_run() {
    let mut told = Vec::new();
    let result = free_body().run_observed(0.0..1.0, &by_hand().estimate(false), &mut |progress| {
        told.push(progress.fraction);
        if progress.fraction >= 0.5 { std::ops::ControlFlow::Break(()) } else { std::ops::ControlFlow::Continue(()) }
    });
    let bryla::RunError::Simulation(error) = result.unwrap_err() else { panic!("not stopped") };
    assert_eq!(error.kind, bryla::simulation::Failure::Interrupted);
    assert!((error.trajectory.as_ref().unwrap().end() - 0.5).abs() < 2e-3);
    assert!(told.windows(2).all(|pair| pair[1] >= pair[0]) && told.len() >= 499);
}

#[test]
fn a_plan_without_a_step_cannot_be_advanced_by_hand() {
    let message = free_body().compile(&RunOptions::default()).unwrap().start(0.0).unwrap_err().to_string();
    assert_eq!(message, "run: a simulation that is advanced by hand needs method and step");
}

#[test]
fn absurd_steps_end_in_a_named_error_and_never_in_nan() {
    // drag far beyond the stability of Euler's method: the speed overflows
    let mut scene = free_body();
    scene.add_effect(Drag::new(0.0, 50.0));
    scene.add_effect(Thruster::new("body", [0.0; 3], [1e3, 0.0, 0.0]));
    // whoever looks on or not, the run ends where the last finite step does; if its motion is kept, that is finite too,
    // or it ends where that step began
    let mut ended = Vec::new();
    for record in [Record::Dense, Record::Samples, Record::End] {
        let options = RunOptions::method(Method::Euler).step(0.5).estimate(false).record(record);
        let error = scene.run(0.0..1000.0, &options).unwrap_err();
        let bryla::RunError::Simulation(error) = error else { panic!("{error}") };
        assert!(error.to_string().ends_with("body: state is not finite"), "{error}");
        let run = error.trajectory.as_ref().unwrap();
        assert!((0..run.times().len()).all(|s| run.states(s).iter().all(bryla::BodyState::is_finite)));
        ended.push((error.time, run.end()));
    }
    let [kept, samples, end] = ended[..] else { panic!("{ended:?}") };
    assert!(samples == end && samples.0 > 0.0 && samples.0 == samples.1, "{ended:?}");
    assert!([0.0, 0.5].contains(&(end.1 - kept.1)) && kept.0 == kept.1, "{ended:?}");
}
