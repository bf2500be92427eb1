//! Bodies that stick, against closed forms; each formula stands in its test.
//!
//! ```text
//! V = Σ mᵢ vᵢ/M      I Ω = Σ [Iᵢ ωᵢ + (xᵢ − X) × mᵢ (vᵢ − V)]      ΔE = what is left of the kinetic energy
//! ```
//!
//! Momenta and energies are held to 1e-12 of the case's own, places to 1e-12 of its size (eps of the search).

use super::meeting::{close, last, run, scene};
use bryla::math::{Vector3, quaternion};
use bryla::{
    Body, BodyMotion, Cuboid, EventKind, HalfSpace, Method, Response, RunError, RunOptions, Simulation, Sphere, Spring,
    UniformGravity,
};

const TIGHT: f64 = 1e-12;
const CLOSE: f64 = 1e-11;

fn ball(name: &str, radius: f64, mass: f64) -> Body {
    Body::new(name, Sphere::new(radius)).mass(mass)
}

fn energy(motions: &[BodyMotion]) -> f64 {
    motions.iter().map(BodyMotion::kinetic_energy).sum()
}

#[test]
fn two_balls_that_meet_off_centre_turn_about_their_common_centre() {
    // with d the line of centres and μ = m₁m₂/M: V = m₁ v/M, I = ⅖(m₁ r₁² + m₂ r₂²) + μ d², Ω = μ d × u/I,
    // and from there on a uniform turn about the axis across
    let (m1, r1, m2, r2, v, b) = (0.3, 0.05, 0.5, 0.08, 2.0, 0.1);
    let thrown = ball("thrown", r1, m1).position([-1.0, b, 0.0]).velocity([v, 0.0, 0.0]).response(Response::Stick);
    let run = run(&scene([thrown, ball("target", r2, m2)]), 1.5);
    assert_eq!(run.events().len(), 1);
    let event = &run.events()[0];
    assert_eq!((event.kind, event.bodies), (EventKind::Stick, [0, 1]));

    let d = Vector3::new(-((r1 + r2) * (r1 + r2) - b * b).sqrt(), b, 0.0); // from the target to the thrown
    let time = (1.0 + d.x) / v;
    assert!((event.time - time).abs() < CLOSE);
    let (whole, mu) = (m1 + m2, m1 * m2 / (m1 + m2));
    let inertia = 0.4 * (m1 * r1 * r1 + m2 * r2 * r2) + mu * d.norm_squared();
    let speed = Vector3::new(m1 * v / whole, 0.0, 0.0);
    let spin = mu * d.cross(&Vector3::new(v, 0.0, 0.0)) / inertia;

    // the event, under the names of both
    let levers = [m2 / whole * d, -m1 / whole * d];
    close(event.other_velocity[1], speed + spin.cross(&levers[0]), TIGHT * v);
    close(event.velocity[1], speed + spin.cross(&levers[1]), TIGHT * v);
    close(event.angular_velocity[1], spin, TIGHT * v / r1);
    close(event.impulse, m2 * event.velocity[1], TIGHT * m2 * v);
    close(event.point, r2 * d.normalize(), CLOSE);
    let lost = 0.5 * mu * v * v - 0.5 * inertia * spin.norm_squared();
    assert!((event.energy_lost - lost).abs() < TIGHT * v * v);

    // the samples after it, in closed form
    let motions = last(&run);
    let (left, center) = (1.5 - time, m1 / whole * d);
    for (motion, lever) in motions.iter().zip(levers) {
        let turned = quaternion::rotate(&quaternion::exp(&(left * spin)), &lever);
        close(motion.position, center + left * speed + turned, CLOSE);
        close(motion.velocity, speed + spin.cross(&turned), CLOSE * v);
        close(motion.angular_velocity, spin, TIGHT * v / r1);
        assert!(quaternion::angle_between(&motion.orientation, &quaternion::exp(&(left * spin))) < CLOSE);
    }
    assert!(run.energy().unwrap().drift() < TIGHT * m1 * v * v);
    let report = run.report();
    assert!(report.met == Some(true) && report.impacts == 1, "{report}");
}

#[test]
fn a_row_of_balls_picks_each_other_up() {
    // k balls have v/k; with gaps s between surfaces the next is met after s k/v
    let (n, s, v) = (6, 0.3, 2.0);
    let bodies = (0..n).map(|k| {
        let at = f64::from(k) * (0.2 + s);
        let ball = ball(&format!("ball {k}"), 0.1, 0.7).position([at, 0.0, 0.0]).response(Response::Stick);
        if k == 0 { ball.velocity([v, 0.0, 0.0]) } else { ball }
    });
    let run = run(&scene(bodies), 4.0);
    let mut time = 0.0;
    assert_eq!(run.events().len(), 5);
    for (i, event) in run.events().iter().enumerate() {
        let k = u32::try_from(i + 1).unwrap();
        time += s * f64::from(k) / v;
        assert_eq!((event.kind, event.bodies), (EventKind::Stick, [i, i + 1]));
        assert!((event.time - time).abs() < CLOSE, "{k}: {:e}", event.time - time);
        close(event.velocity[1], [v / f64::from(k + 1), 0.0, 0.0], TIGHT * v);
        let reduced = 0.7 * f64::from(k) / f64::from(k + 1);
        let met = v / f64::from(k);
        assert!((event.energy_lost - 0.5 * reduced * met * met).abs() < TIGHT * v * v);
    }
    for (k, motion) in (0..n).zip(last(&run)) {
        let first = 5.0 * s + (4.0 - time) * v / f64::from(n);
        close(motion.position, [first + 0.2 * f64::from(k), 0.0, 0.0], CLOSE);
        assert!(motion.angular_velocity.norm() < TIGHT * v / 0.1);
    }
}

#[test]
fn what_has_merged_bounces_as_one_body() {
    // a dumb-bell whose larger ball lands: j = (1 + e) v/(1/M + x²/I), its lever x from the common centre
    let (m, r1, r2, v, e) = (0.4, 0.1, 0.2, 3.0, 0.6);
    let small = ball("small", r1, m).position([-0.5, 0.0, 1.0]).velocity([1.0, 0.0, -v]).response(Response::Stick);
    let large = ball("large", r2, m).position([0.0, 0.0, 1.0]).velocity([0.0, 0.0, -v]).restitution(e);
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed();
    let run = run(&scene([floor, small, large]), 0.3);
    let kinds: Vec<_> = run.events().iter().map(|event| (event.kind, event.bodies)).collect();
    assert_eq!(kinds, [(EventKind::Stick, [1, 2]), (EventKind::Bounce, [0, 2])]);
    let event = &run.events()[1];
    let x = 0.5 * (r1 + r2);
    let inertia = 0.4 * m * (r1 * r1 + r2 * r2) + 2.0 * m * x * x;
    let j = (1.0 + e) * v / (0.5 / m + x * x / inertia);
    assert!((event.time - 0.8 / v).abs() < CLOSE);
    close(event.impulse, [0.0, 0.0, j], TIGHT * j);
    close(event.angular_velocity[1], [0.0, -x * j / inertia, 0.0], TIGHT * v / r1);
    close(event.velocity[1], [0.5, 0.0, e * v], TIGHT * v);
    let lost = 0.5 * (1.0 - e * e) * v * v / (0.5 / m + x * x / inertia);
    assert!((event.energy_lost - lost).abs() < TIGHT * v * v);
    let motions = last(&run);
    assert!((energy(&run.motions(0)) - energy(&motions) - lost - run.events()[0].energy_lost).abs() < TIGHT * v * v);
}

#[test]
fn a_compound_tumbles_with_its_momenta_kept_and_its_parts_in_place() {
    // three cuboids that meet askew, under gravity: P falls as m g t, L about the common centre and the distances of
    // the parts stay, for 20 s and some 60 turns
    let block = |name: &str, half: [f64; 3], x: f64| {
        let body = Body::new(name, Cuboid::new(half)).density(800.0).position([x, 0.02 * x, -0.03 * x]);
        body.velocity([-4.0 * x, 0.5 * x, 0.3]).angular_velocity([x, 2.0, 3.0 - x]).response(Response::Stick)
    };
    let bodies =
        [block("a", [0.1, 0.05, 0.02], -0.5), block("b", [0.05, 0.07, 0.11], 0.0), block("c", [0.08, 0.03, 0.06], 0.5)];
    let mut scene = scene(bodies);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    let run = run(&scene, 20.0);
    assert_eq!(run.events().iter().filter(|event| event.kind == EventKind::Stick).count(), 2);
    let merged = run.times().iter().position(|&t| t > run.events()[1].time).unwrap();
    let shape = |sample: usize| {
        let m = run.motions(sample);
        let seen = |i: usize| m[0].rotation.tr_mul(&(m[i].position - m[0].position));
        let turned = |i: usize| m[0].orientation.conjugate() * m[i].orientation;
        ([seen(1), seen(2)], [turned(1), turned(2)])
    };
    let whole: f64 = run.motions(0).iter().map(|motion| motion.mass).sum();
    let centre = |sample: usize| {
        let motions = run.motions(sample);
        let v: Vector3 = motions.iter().map(|m| m.mass * m.velocity).sum::<Vector3>() / whole;
        (motions.iter().map(|m| m.mass * m.position).sum::<Vector3>() / whole, v)
    };
    let spin = |sample: usize| {
        let total = run.total(sample, Vector3::zeros());
        let (x, _) = centre(sample);
        total.angular_momentum - x.cross(&total.linear_momentum)
    };
    let (x0, v0) = centre(0);
    let (places, turns) = shape(merged);
    for sample in 0..run.times().len() {
        let t = run.times()[sample];
        let g = Vector3::new(0.0, 0.0, -9.81);
        let (x, v) = centre(sample);
        close(v, v0 + t * g, TIGHT * 200.0);
        close(x, x0 + t * v0 + 0.5 * t * t * g, TIGHT * 2000.0);
        close(spin(sample), spin(0), TIGHT * whole);
        if sample >= merged {
            let (now, turned) = shape(sample);
            (0..2).for_each(|i| close(now[i], places[i], 1e-11));
            assert!((0..2).all(|i| quaternion::angle_between(&turned[i], &turns[i]) < 1e-11));
        }
    }
    assert!(run.energy().unwrap().drift() < TIGHT * whole * 9.81 * 2000.0);
}

#[test]
fn a_torque_on_one_part_turns_the_whole() {
    // a dumb-bell of equal balls, of which gravity pulls at one only: F = m g on M = 2 m; at rest at first, horizontal
    // with the lever d/2: the torque m g d/2 cos φ about the centre, so ½ I φ′² = m g (d/2) sin φ
    let (m, r, g) = (0.5, 0.1, 2.0);
    let sticky = ball("left", r, m).position([-0.25, 0.0, 0.0]).velocity([1.0, 0.0, 0.0]).response(Response::Stick);
    let right = ball("right", r, m).position([0.25, 0.0, 0.0]).velocity([-1.0, 0.0, 0.0]);
    let mut scene = scene([sticky, right]);
    scene.add_effect(UniformGravity { acceleration: [0.0, 0.0, -g], bodies: Some(vec!["right".into()]) });
    let run = run(&scene, 0.5);
    let stuck = &run.events()[0];
    let start = 0.5 * (stuck.velocity[1] + stuck.other_velocity[1]);
    let (end, spin) = (last(&run), stuck.angular_velocity[1]);
    let t = 0.5 - stuck.time;
    let velocity = 0.5 * (end[0].velocity + end[1].velocity);
    close(velocity, start + Vector3::new(0.0, 0.0, -0.5 * g * t), 1e-9);

    let lever = |motions: [&BodyMotion; 2]| 0.5 * (motions[1].position - motions[0].position);
    let inertia = 2.0 * (0.4 * m * r * r + m * lever([&end[0], &end[1]]).norm_squared());
    let at = run.at(stuck.time).unwrap();
    let rise = lever([&end[0], &end[1]]).z - 0.5 * (at[1].position - at[0].position).z;
    let gained = 0.5 * inertia * (end[1].angular_velocity.norm_squared() - spin.norm_squared());
    assert!((gained + m * g * rise).abs() < 1e-9 * gained, "{gained} {rise}");
    assert!(gained > 0.05 * m, "{gained}");
}

#[test]
fn what_falls_on_a_body_that_rests_and_sticks_to_it_rests_with_it() {
    let (a, h, g) = (0.1, 0.5, 10.0);
    let cube = |name: &str, z: f64| Body::new(name, Cuboid::new([a; 3])).mass(1.0).position([0.0, 0.0, z]);
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(0.5);
    let mut scene =
        scene([floor, cube("below", a).friction(0.5), cube("above", 3.0 * a + h).response(Response::Stick)]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
    let run = run(&scene, 1.0);
    let stick = run.events().iter().find(|event| event.kind == EventKind::Stick).unwrap();
    assert_eq!(stick.bodies, [1, 2]);
    assert!((stick.time - (2.0 * h / g).sqrt()).abs() < CLOSE);
    // both go on at half the speed, for no time at all: the floor takes the rest
    let speed = (2.0 * g * h).sqrt();
    close(stick.velocity[1], [0.0, 0.0, -0.5 * speed], CLOSE * speed);
    let bounce = run.events().iter().find(|event| event.kind == EventKind::Bounce).unwrap();
    assert_eq!((bounce.bodies, bounce.time), ([0, 1], stick.time));
    close(bounce.impulse, [0.0, 0.0, speed], CLOSE * speed);
    let end = last(&run);
    close(end[1].position, [0.0, 0.0, a], CLOSE);
    close(end[2].position, [0.0, 0.0, 3.0 * a], CLOSE);
    assert!(end.iter().all(|motion| motion.velocity == Vector3::zeros()));
    assert!(run.energy().unwrap().drift() < 1e-10 * g);
}

#[test]
fn what_sticks_to_a_body_that_has_stuck_to_the_floor_stops_too() {
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed();
    let second = Body::new("second", Cuboid::new([0.1; 3])).mass(1.0).position([0.02, 0.0, 1.0]);
    let first = ball("first", 0.1, 1.0).position([0.02, 0.0, 0.5]);
    let thrown = [second, first].map(|body| body.velocity([0.0, 0.0, -1.0]).response(Response::Stick));
    let [second, first] = thrown;
    let run = run(&scene([floor, second, first]), 2.0);
    // what stands still comes first, whatever the order in the scene
    let kinds: Vec<_> = run.events().iter().map(|event| (event.kind, event.bodies)).collect();
    assert_eq!(kinds, [(EventKind::Stick, [0, 2]), (EventKind::Stick, [2, 1])]);
    let event = &run.events()[1];
    assert!(event.features.starts_with("surface 0, face "), "{}", event.features);
    close(event.normal, [0.0, 0.0, 1.0], TIGHT);
    close(event.velocity[0], [0.0, 0.0, -1.0], TIGHT);
    assert!((event.energy_lost - 0.5).abs() < TIGHT);
    let end = last(&run);
    close(end[2].position, [0.02, 0.0, 0.1], CLOSE);
    close(end[1].position, [0.02, 0.0, 0.3], CLOSE);
    assert_eq!(energy(&end), 0.0);
}

#[test]
fn a_body_bounces_off_one_that_has_stuck_to_the_floor_as_off_the_floor() {
    // the floor is sticky, the balls are not: the first stays, the second comes back with e of its speed
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().response(Response::Stick);
    let drop = |name: &str, z: f64| ball(name, 0.1, 1.0).position([0.0, 0.0, z]).velocity([0.0, 0.0, -1.0]);
    let run = run(&scene([floor, drop("first", 0.5), drop("second", 1.0).restitution(0.5)]), 2.0);
    let kinds: Vec<_> = run.events().iter().map(|event| (event.kind, event.bodies)).collect();
    assert_eq!(kinds, [(EventKind::Stick, [0, 1]), (EventKind::Bounce, [1, 2])]);
    close(run.events()[1].velocity[1], [0.0, 0.0, 0.5], TIGHT);
    close(run.events()[1].impulse, [0.0, 0.0, 1.5], TIGHT);
    let end = last(&run);
    close(end[1].position, [0.0, 0.0, 0.1], CLOSE);
    close(end[2].position, [0.0, 0.0, 0.3 + 0.5 * 1.3], CLOSE);
}

#[test]
fn a_saved_compound_goes_on_with_the_same_bits() {
    let thrown = ball("thrown", 0.05, 0.3).position([-1.0, 0.1, 0.02]).velocity([2.0, 0.0, 0.0]);
    let target = Body::new("target", Cuboid::new([0.05, 0.1, 0.2])).mass(0.5).angular_velocity([0.1, 2.0, 0.3]);
    let late = ball("late", 0.05, 0.3).position([-3.0, 0.2, 0.02]).velocity([2.5, 0.0, 0.0]);
    let scene = scene([thrown.response(Response::Stick), target, late.response(Response::Stick)]);
    for method in [Method::Exact, Method::Rk4] {
        let plan = scene.compile(&RunOptions::method(method).step(0.01)).unwrap();
        let mut whole = plan.start(0.0).unwrap();
        whole.advance(1.0).unwrap();
        assert_eq!(whole.events().len(), 1);
        let file = std::env::temp_dir().join(format!("bryla-stick-{}-{method}.bryla", std::process::id()));
        whole.save(&file).unwrap();
        let mut again = Simulation::resume(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        whole.advance(2.5).unwrap();
        again.advance(2.5).unwrap();
        assert_eq!(whole.events(), again.events());
        assert_eq!(whole.events().len(), 2, "{method}");
        for name in ["thrown", "target", "late"] {
            assert_eq!(whole.motion(name).unwrap(), again.motion(name).unwrap(), "{method}");
        }
    }
}

#[test]
fn a_body_that_a_spring_holds_is_not_merged_and_says_so() {
    let mut scene = scene([
        ball("thrown", 0.1, 1.0).position([-1.0, 0.0, 0.0]).velocity([2.0, 0.0, 0.0]).response(Response::Stick),
        ball("held", 0.1, 1.0),
        ball("other", 0.1, 1.0).position([0.0, 1.0, 0.0]),
    ]);
    scene.add_effect(Spring { rest_length: 1.0, ..Spring::between("held", "other", 10.0) });
    let RunError::Simulation(error) = scene.run(0.0..1.0, &RunOptions::tolerance(1e-6)).unwrap_err() else { panic!() };
    let message = error.to_string();
    assert!(message.contains("thrown, held: body held: it shares its flight with other bodies"), "{message}");
    assert!((error.time - 0.4).abs() < 1e-6);
}
