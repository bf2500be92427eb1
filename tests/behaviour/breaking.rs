//! What has stuck comes off under its breaking load, against closed forms; each formula stands in its test.
//!
//! ```text
//! dumb-bell of masses m₁, m₂ whose centres are d apart, μ = m₁m₂/(m₁ + m₂):
//! f = −μ d Ω² n along its line,  μ d α across it              n from a to b
//! ```
//!
//! Instants are held to 1e-9, momenta and energies to 1e-12 of the case's own, places to the accuracy of the instant.

use super::meeting::{close, last, run, scene};
use bryla::math::{Vector3, quaternion};
use bryla::{
    Body, BodyMotion, BreakingLoad, Cuboid, Event, EventKind, HalfSpace, Method, Response, RunError, RunOptions, Scene,
    Simulation, Sphere, Spring, Trajectory, UniformGravity, Wrench,
};

const TIGHT: f64 = 1e-12;
const CLOSE: f64 = 1e-11;
/// Accuracy of what a run to 1e-9 integrates [-].
const RUN: f64 = 1e-9;

fn ball(name: &str, radius: f64, mass: f64) -> Body {
    Body::new(name, Sphere::new(radius)).mass(mass)
}

fn force(newtons: f64) -> BreakingLoad {
    BreakingLoad::new(newtons, f64::INFINITY)
}

fn energy(motions: &[BodyMotion]) -> f64 {
    motions.iter().map(BodyMotion::kinetic_energy).sum()
}

fn kinds(run: &Trajectory) -> Vec<(EventKind, [usize; 2])> {
    run.events().iter().map(|event| (event.kind, event.bodies)).collect()
}

fn broken(run: &Trajectory) -> &Event {
    run.events().iter().find(|event| event.kind == EventKind::Break).unwrap()
}

/// Two balls that come from both sides and meet off centre, by `b` each, under this breaking load.
fn glancing(b: f64, load: BreakingLoad) -> Scene {
    let left = ball("left", 0.1, 0.4).position([-0.5, b, 0.0]).velocity([1.0, 0.0, 0.0]).response(Response::Stick);
    let right = ball("right", 0.2, 0.6).position([0.5, -b, 0.0]).velocity([-1.0, 0.0, 0.0]);
    scene([left.breaking_load(load), right])
}

#[test]
fn a_dumb_bell_holds_the_pull_of_its_turning_or_parts_at_once() {
    // Ω = μ d × u/I as they stick; the pull μ d Ω² stays
    let (m1, m2, r1, r2, b) = (0.4, 0.6, 0.1, 0.2, 0.06);
    let d = Vector3::new((0.09_f64 - 4.0 * b * b).sqrt(), -2.0 * b, 0.0);
    let mu: f64 = m1 * m2 / (m1 + m2);
    let inertia = 0.4 * (m1 * r1 * r1 + m2 * r2 * r2) + mu * d.norm_squared();
    let spin = mu * d.cross(&Vector3::new(-2.0, 0.0, 0.0)) / inertia;
    let pull = mu * 0.3 * spin.norm_squared();

    let held = run(&glancing(b, force(1.001 * pull)), 3.0);
    assert_eq!(kinds(&held), [(EventKind::Stick, [0, 1])]);
    let parts = run(&glancing(b, force(0.999 * pull)), 3.0);
    assert_eq!(kinds(&parts), [(EventKind::Stick, [0, 1]), (EventKind::Break, [0, 1])]);
    let [stuck, event] = parts.events() else { panic!() };
    assert!((stuck.time - (1.0 - d.x) / 2.0).abs() < CLOSE);
    assert_eq!(event.time, stuck.time);
    close(event.force, -pull * d.normalize(), CLOSE * pull);
    assert!(event.torque.norm() < CLOSE * pull * 0.3, "{:?}", event.torque);
    close(event.normal, d.normalize(), CLOSE);
    close(event.point, stuck.point, CLOSE);

    // they fly on with the velocities that they had as one, and their spins
    let (end, left) = (last(&parts), 3.0 - event.time);
    let centre = Vector3::new(0.5 * (1.0 - d.x) * (m1 - m2) - 0.5 * m1 + 0.5 * m2, (m1 - m2) * b, 0.0);
    let drift = Vector3::new(m1 - m2, 0.0, 0.0);
    for (i, lever) in [-m2 * d, m1 * d].into_iter().enumerate() {
        let velocity = drift + spin.cross(&lever);
        let was = [event.other_velocity, event.velocity][i];
        close(was[0], velocity, CLOSE);
        close(was[1], velocity, CLOSE);
        close(end[i].velocity, velocity, CLOSE);
        close(end[i].position, centre + lever + left * velocity, 10.0 * CLOSE);
        close(end[i].angular_velocity, spin, CLOSE * spin.norm());
        let turned = quaternion::exp(&(left * spin));
        assert!(quaternion::angle_between(&end[i].orientation, &turned) < 10.0 * CLOSE);
    }
    assert!((energy(&end) - energy(&last(&held))).abs() < TIGHT);
    for (a, b) in [(end[0], end[1]), (last(&held)[0], last(&held)[1])] {
        close(m1 * a.velocity + m2 * b.velocity, drift, TIGHT);
    }
    assert!(parts.energy().unwrap().drift() < TIGHT);
    assert_eq!((event.energy_lost, parts.report().met), (0.0, Some(true)));
}

/// A dumb-bell of two equal balls, made at t = 0.3 without a spin, on one of which a torque acts from t = 1 on.
fn spun_up(load: BreakingLoad) -> Scene {
    let left = ball("left", 0.1, 0.5).position([-0.4, 0.0, 0.0]).velocity([1.0, 0.0, 0.0]).response(Response::Stick);
    let right = ball("right", 0.1, 0.5).position([0.4, 0.0, 0.0]).velocity([-1.0, 0.0, 0.0]).breaking_load(load);
    let mut scene = scene([left, right]);
    scene.add_effect(Wrench::new("left", [0.0; 3], [0.0, 0.0, 0.02]).schedule([(1.0, 1.0)]));
    scene
}

/// Its moment of inertia, μ d, and its angular acceleration.
const SPUN_UP: [f64; 3] = [0.014, 0.05, 0.02 / 0.014];

#[test]
fn a_dumb_bell_that_is_spun_up_comes_apart_when_the_formula_says() {
    // Ω = α (t − 1), f² = (μ d)² (Ω⁴ + α²)
    let [_, pull, alpha] = SPUN_UP;
    let most = 0.4_f64;
    let spin = ((most / pull).powi(2) - alpha * alpha).powf(0.25);
    let time = 1.0 + spin / alpha;
    let run = run(&spun_up(force(most)), 5.0);
    assert_eq!(kinds(&run), [(EventKind::Stick, [0, 1]), (EventKind::Break, [0, 1])]);
    let event = broken(&run);
    assert!((event.time - time).abs() < RUN, "{:e}", event.time - time);
    assert!((event.force.norm() - most).abs() < TIGHT * most, "{:e}", event.force.norm() - most);
    // across the line μ d α, which turns the right ball's centre with the rest
    let angle = 0.5 * alpha * (time - 1.0) * (time - 1.0);
    let (line, across) = (Vector3::new(angle.cos(), angle.sin(), 0.0), Vector3::new(-angle.sin(), angle.cos(), 0.0));
    close(event.force, pull * (alpha * across - spin * spin * line), 10.0 * RUN);
    // the right ball's own turning, and the lever of what drives its centre
    close(event.torque, [0.0, 0.0, alpha * (0.4 * 0.5 * 0.01 + 0.1 * pull)], 10.0 * RUN);

    // the right ball goes straight on; the left one too, and turns ever faster
    let (end, left) = (last(&run), 5.0 - time);
    let velocity = 0.1 * spin * across;
    close(end[1].velocity, velocity, 10.0 * RUN);
    close(end[1].position, 0.1 * line + left * velocity, 100.0 * RUN);
    close(end[0].velocity, -velocity, 10.0 * RUN);
    close(end[1].angular_velocity, [0.0, 0.0, spin], 10.0 * RUN);
    close(end[0].angular_velocity, [0.0, 0.0, spin + 0.02 * left / (0.4 * 0.5 * 0.01)], 100.0 * RUN);

    // nothing is lost at the break, and the estimate covers what it does to the result
    assert_eq!(event.velocity[0], event.velocity[1]);
    assert!(run.energy().unwrap().drift() < 1e-8);
    let report = run.report();
    let error = (end[1].position - (0.1 * line + left * velocity)).norm() / report.length_scale;
    assert!(report.met == Some(true) && error <= report.error_estimate.unwrap(), "{error:e}, {report}");
}

#[test]
fn a_joint_that_bears_less_torque_breaks_by_it() {
    // the left ball's torque passes on α (I₂ + r μ d) to the right one as soon as it acts
    let [_, pull, alpha] = SPUN_UP;
    let carried = alpha * (0.4 * 0.5 * 0.01 + 0.1 * pull);
    let holds = run(&spun_up(BreakingLoad::new(1e6, 1.001 * carried)), 2.0);
    assert_eq!(kinds(&holds), [(EventKind::Stick, [0, 1])]);
    let breaks = run(&spun_up(BreakingLoad::new(1e6, 0.999 * carried)), 2.0);
    let event = broken(&breaks);
    assert_eq!(event.time, 1.0);
    close(event.torque, [0.0, 0.0, carried], CLOSE * carried);
    let end = last(&breaks);
    assert!(end[1].angular_velocity.norm() < TIGHT && end[1].velocity.norm() < TIGHT);
    close(end[0].angular_velocity, [0.0, 0.0, 0.02 / (0.4 * 0.5 * 0.01)], 10.0 * RUN);
}

/// A cube that has stuck to a ceiling at z = 1 after 0.1 s, while a force swings downwards on it.
fn hanging(load: BreakingLoad) -> Scene {
    let ceiling = Body::new("ceiling", HalfSpace::new([0.0, 0.0, -1.0], -1.0)).fixed().breaking_load(load);
    let cube = Body::new("cube", Cuboid::new([0.1; 3])).mass(2.0).position([0.3, 0.2, 0.8]).velocity([0.0, 0.0, 2.0]);
    let mut scene = scene([ceiling, cube.response(Response::Stick)]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    scene.add_effect(Wrench::new("cube", [0.0, 0.0, -30.0], [0.0; 3]).oscillating(0.8, -0.08).schedule([(0.1, 1.0)]));
    scene
}

#[test]
fn a_body_that_hangs_on_a_ceiling_falls_when_it_is_pulled_too_hard() {
    // m g + F sin(ω t + φ) = f_max; then v = −∫ (g + F/m sin), from rest
    let (m, g, f, w, phi) = (2.0_f64, 10.0_f64, 30.0_f64, 0.8_f64, -0.08_f64);
    let rises = run(&hanging(force(50.1)), 3.0);
    assert_eq!(kinds(&rises), [(EventKind::Stick, [0, 1])]);
    let most = 45.0;
    let time = ((most - m * g) / f).asin() / w - phi / w;
    let run = run(&hanging(force(most)), 1.8);
    assert_eq!(kinds(&run), [(EventKind::Stick, [0, 1]), (EventKind::Break, [0, 1])]);
    let event = broken(&run);
    assert!((event.time - time).abs() < CLOSE, "{:e}", event.time - time);
    close(event.force, [0.0, 0.0, most], CLOSE * most);
    assert!(event.torque.norm() < CLOSE * most, "{:?}", event.torque);
    close(event.point, [0.3, 0.2, 1.0], CLOSE);
    let (end, left) = (last(&run)[1], 1.8 - time);
    let (c0, c1) = ((w * time + phi).cos(), (w * 1.8 + phi).cos());
    let (s0, s1) = ((w * time + phi).sin(), (w * 1.8 + phi).sin());
    let velocity = -g * left - f / (m * w) * (c0 - c1);
    let fallen = 0.5 * g * left * left + f / (m * w) * (c0 * left - (s1 - s0) / w);
    close(end.velocity, [0.0, 0.0, velocity], 10.0 * RUN);
    close(end.position, [0.3, 0.2, 0.9 - fallen], 10.0 * RUN);
    assert!(end.angular_velocity.norm() < RUN);
    assert!(run.energy().unwrap().drift() < 1e-7);
}

#[test]
fn a_spring_tears_a_body_off_a_wall() {
    // the spring's other end is a free body: where the joint gives way it pulls by k s = f_max
    let wall = Body::new("wall", HalfSpace::new([1.0, 0.0, 0.0], 0.0)).fixed().response(Response::Stick);
    let block = ball("block", 0.1, 1.0).position([0.5, 0.0, 0.0]).velocity([-4.0, 0.0, 0.0]);
    let bob = ball("bob", 0.1, 0.25).position([2.0, 0.0, 0.0]).velocity([2.0, 0.0, 0.0]).collides(false);
    let mut scene = scene([wall, block.breaking_load(force(2.5)), bob]);
    scene.add_effect(Spring { rest_length: 1.5, ..Spring::between("block", "bob", 4.0) });
    let run = run(&scene, 1.0);
    let event = broken(&run);
    assert_eq!(event.bodies, [0, 1]);
    close(event.force, [-2.5, 0.0, 0.0], CLOSE);
    let at = run.at(event.time).unwrap();
    let stretched = (at[2].position - at[1].position).norm() - 1.5;
    assert!((4.0 * stretched - 2.5).abs() < 10.0 * RUN, "{stretched}");

    // in between the bob swings against the wall: s″ = −k s/m, from what the blow has left
    let stuck = &run.events()[0];
    let then = run.at(stuck.time).unwrap()[2];
    let (s0, v0) = (then.position.x - 0.1 - 1.5, then.linear_momentum.x / 0.25);
    let phase = 4.0 * (event.time - stuck.time);
    assert!((4.0 * (s0 * phase.cos() + v0 / 4.0 * phase.sin()) - 2.5).abs() < 10.0 * RUN);
    assert!(run.energy().unwrap().drift() < 10.0 * RUN);

    // then both swing about their centre of mass, which keeps the bob's momentum: w² = k/μ, μ = 0.2
    let (p, w) = (at[2].linear_momentum.x, 20.0_f64.sqrt());
    let s = 0.625 * (0.1 * w).cos() + p / 0.25 / w * (0.1 * w).sin();
    let after = run.at(event.time + 0.1).unwrap();
    assert!((after[2].position.x - after[1].position.x - 1.5 - s).abs() < 10.0 * RUN);
    assert!((after[1].linear_momentum.x + after[2].linear_momentum.x - p).abs() < 10.0 * RUN);
}

/// Three equal balls in a row, which a torque on the first spins up; the joints bear these forces.
fn chain(first: f64, second: f64) -> Scene {
    let row = |name: &str, x: f64, v: f64| ball(name, 0.1, 0.5).position([x, 0.0, 0.0]).velocity([v, 0.0, 0.0]);
    let a = row("a", -0.5, 1.0).response(Response::Stick).breaking_load(force(first));
    let c = row("c", 0.5, -1.0).response(Response::Stick).breaking_load(force(second));
    let mut scene = scene([a, row("b", 0.0, 0.0), c]);
    scene.add_effect(Wrench::new("a", [0.0; 3], [0.0, 0.0, 0.05]).schedule([(1.0, 1.0), (1.0 + 2.0, 0.0)]));
    scene
}

#[test]
fn of_a_chain_the_weaker_joint_breaks_and_the_rest_goes_on_as_one() {
    // both joints pull an outer ball inwards: f² = (m d)² (Ω⁴ + α²); I = 3·⅖ m r² + 2 m d²
    let (m, d): (f64, f64) = (0.5, 0.2);
    let inertia = 3.0 * 0.4 * m * 0.01 + 2.0 * m * d * d;
    let alpha: f64 = 0.05 / inertia;
    let most = 0.3;
    let spin = ((most / (m * d)).powi(2) - alpha * alpha).powf(0.25);
    let time = 1.0 + spin / alpha;
    for (first, second) in [(most, 100.0), (100.0, most)] {
        let run = run(&chain(first, second), 4.0);
        let pair = if first < second { [0, 1] } else { [1, 2] };
        let event = broken(&run);
        assert_eq!(run.events().iter().filter(|event| event.kind == EventKind::Break).count(), 1);
        assert_eq!(event.bodies, pair);
        assert!((event.time - time).abs() < RUN, "{:e}", event.time - time);
        assert!((event.force.norm() - most).abs() < RUN * most);

        // what is left turns about its own centre, which moves on: momenta and energy across the break
        let [before, after] = [-1.0, 1.0].map(|sign| run.at(event.time + sign * 1e-7).unwrap());
        let sum = |states: &[bryla::BodyState], f: &dyn Fn(&bryla::BodyState) -> Vector3| {
            states.iter().map(f).sum::<Vector3>()
        };
        let momentum = |states: &[bryla::BodyState]| sum(states, &|s| s.linear_momentum);
        close(momentum(&before), momentum(&after), TIGHT);
        let turning =
            |states: &[bryla::BodyState]| sum(states, &|s| s.angular_momentum + s.position.cross(&s.linear_momentum));
        // the torque goes on meanwhile, for 2e-7 s
        close(turning(&before) + Vector3::new(0.0, 0.0, 0.05 * 2e-7), turning(&after), 1e-14);
        let rest = if first < second { [1, 2] } else { [0, 1] };
        let end = last(&run);
        assert_eq!(end[rest[0]].angular_velocity, end[rest[1]].angular_velocity);
        assert!(((end[rest[0]].position - end[rest[1]].position).norm() - d).abs() < TIGHT);
        // the single ball flies straight on with Ω d
        let single = 3 - rest[0] - rest[1];
        assert!((end[single].velocity.norm() - d * spin).abs() < 10.0 * RUN);
        assert!(run.energy().unwrap().drift() < 1e-9);
        assert_eq!(run.report().met, Some(true));
    }
}

#[test]
fn what_a_joint_cannot_bear_lies_where_it_fell() {
    // the weight is more than the glue bears: it sticks, comes off at the same instant, and rests as any other body
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(0.5);
    let cube = Body::new("cube", Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, 0.6]).friction(0.5);
    let mut scene = scene([floor, cube.response(Response::Stick).breaking_load(force(9.0))]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    let run = run(&scene, 1.0);
    let all = [EventKind::Stick, EventKind::Break, EventKind::Rest].map(|kind| (kind, [0, 1]));
    assert_eq!(kinds(&run), all);
    let time = (2.0_f64 * 0.5 / 10.0).sqrt();
    assert!(run.events().iter().all(|event| (event.time - time).abs() < CLOSE));
    close(broken(&run).force, [0.0, 0.0, 10.0], CLOSE);
    let end = last(&run)[1];
    close(end.position, [0.0, 0.0, 0.1], CLOSE);
    assert_eq!(end.velocity, Vector3::zeros());
}

#[test]
fn what_has_come_off_sticks_again_where_it_meets_again() {
    // buoyant, and pulled off the ceiling by a swinging force: it comes off, rises, and sticks again
    let mut scene = hanging(force(45.0));
    scene.effects.clear();
    scene.add_effect(UniformGravity::new([0.0, 0.0, 5.0]));
    scene.add_effect(Wrench::new("cube", [0.0, 0.0, -60.0], [0.0; 3]).oscillating(2.0, -0.2));
    let run = run(&scene, 12.0);
    let found = kinds(&run);
    assert!(found.len() >= 5, "{found:?}");
    for (k, (kind, bodies)) in found.iter().enumerate() {
        assert_eq!((*kind, *bodies), ([EventKind::Stick, EventKind::Break][k % 2], [0, 1]));
    }
    // F sin(ω t + φ) = f_max + m g where it comes off
    for event in run.events().iter().filter(|event| event.kind == EventKind::Break) {
        assert!((60.0 * (2.0 * event.time - 0.2).sin() - 55.0).abs() < CLOSE, "{}", event.time);
    }
    assert!(run.energy().unwrap().drift() < 1e-6);
}

#[test]
fn a_compound_that_hangs_drops_what_hangs_below_the_joint_that_breaks() {
    // two balls stick, fly up, stick to the ceiling; the lower is pulled off by m g + F(t)
    let ceiling = Body::new("ceiling", HalfSpace::new([0.0, 0.0, -1.0], -2.0)).fixed().response(Response::Stick);
    let upper = ball("upper", 0.1, 1.0).position([0.0, 0.0, 1.0]);
    let lower = ball("lower", 0.1, 1.0).position([0.0, 0.0, 0.5]).velocity([0.0, 0.0, 4.0]).response(Response::Stick);
    let mut scene = scene([ceiling, upper, lower.breaking_load(force(7.0))]);
    scene.add_effect(Wrench::new("lower", [0.0, 0.0, -10.0], [0.0; 3]).oscillating(0.5, -1.0).schedule([(2.0, 1.0)]));
    let run = run(&scene, 4.0);
    let found = kinds(&run);
    assert_eq!(found, [(EventKind::Stick, [1, 2]), (EventKind::Stick, [0, 1]), (EventKind::Break, [1, 2])]);
    let (event, time) = (broken(&run), (0.7_f64.asin() + 1.0) / 0.5);
    assert!((event.time - time).abs() < CLOSE, "{} {time}", event.time);
    close(event.force, [0.0, 0.0, 7.0], CLOSE);
    let end = last(&run);
    close(end[1].position, [0.0, 0.0, 1.9], CLOSE);
    assert_eq!(end[1].velocity, Vector3::zeros());
    let left = 4.0 - time;
    let (c0, s0, c1, s1) = ((0.5 * time - 1.0).cos(), 0.7, 1.0_f64.cos(), 1.0_f64.sin());
    close(end[2].velocity, [0.0, 0.0, -20.0 * (c0 - c1)], 10.0 * RUN);
    close(end[2].position, [0.0, 0.0, 1.7 - 20.0 * (c0 * left - 2.0 * (s1 - s0))], 10.0 * RUN);
}

#[test]
fn a_saved_scene_breaks_with_the_same_bits() {
    // before it sticks, between, and after it has come apart
    for (scene, end) in [(spun_up(force(0.4)), 4.0), (chain(0.3, 100.0), 4.0), (hanging(force(45.0)), 1.8)] {
        for method in [Method::Rk4, Method::Dop853] {
            let plan = scene.compile(&RunOptions::method(method).step(0.01)).unwrap();
            for at in [0.05, 1.2, 3.2_f64.min(end - 0.1)] {
                let mut whole = plan.start(0.0).unwrap();
                whole.advance(at).unwrap();
                let id = std::process::id();
                let file = std::env::temp_dir().join(format!("bryla-break-{id}-{method}-{end}-{at}.bryla"));
                whole.save(&file).unwrap();
                let mut again = Simulation::resume(&file).unwrap();
                std::fs::remove_file(&file).unwrap();
                whole.advance(end).unwrap();
                again.advance(end).unwrap();
                assert_eq!(whole.events(), again.events(), "{method} {at}");
                assert!(whole.events().iter().any(|event| event.kind == EventKind::Break));
                for body in &scene.bodies {
                    assert_eq!(whole.motion(&body.name).unwrap(), again.motion(&body.name).unwrap(), "{method} {at}");
                }
            }
        }
    }
}

/// Why a run broke off.
fn refused(scene: &Scene) -> String {
    match scene.run(0.0..2.0, &RunOptions::tolerance(1e-6)).unwrap_err() {
        RunError::Simulation(error) => error.kind.to_string(),
        RunError::Input(error) => panic!("{error}"),
    }
}

#[test]
fn what_is_not_watched_is_refused_by_name() {
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed();
    let cube = |name: &str, z: f64| Body::new(name, Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, z]);
    let upper = cube("upper", 0.5).response(Response::Stick).breaking_load(force(100.0));
    let mut piled = scene([floor.clone(), cube("lower", 0.1), upper]);
    piled.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    assert_eq!(
        refused(&piled),
        "LastingContact: the bodies stay in contact, which cannot be followed further: upper may come off lower, whose \
         load is not watched in a contact that lasts"
    );

    let first = cube("first", 0.3).velocity([0.0, 0.0, -1.0]).response(Response::Stick).breaking_load(force(100.0));
    let second = cube("second", 0.8).velocity([0.0, 0.0, -1.0]).response(Response::Stick);
    assert_eq!(
        refused(&scene([floor, first, second])),
        "LastingContact: the bodies stay in contact, which cannot be followed further: second sticks to what has stuck \
         to something fixed or moved, and first may come off floor"
    );
}
