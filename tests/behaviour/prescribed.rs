//! Bodies on prescribed motions, and what they do to others, against closed forms; each formula stands in its test.

use super::meeting::{close, last, run, scene};
use bryla::math::{Vector3, quaternion};
use bryla::{
    Body, BreakingLoad, Cuboid, EventKind, HalfSpace, Prescribed, Response, RunError, RunOptions, Simulation, Sphere,
    UniformGravity,
};

const TIGHT: f64 = 1e-12;
const CLOSE: f64 = 1e-11;

#[test]
fn samples_of_a_moved_body_follow_its_formula() {
    // c = c₀ + φ v, R = exp(φ ω) R₀ with φ = t up to 1 s, then 1 − 2 (t − 1)
    let q = quaternion::exp(&Vector3::new(0.3, -0.2, 0.1));
    let (v, w, c) = (Vector3::new(0.4, 0.0, -0.3), Vector3::new(0.5, 2.0, -1.0), Vector3::new(0.2, -0.1, 0.0));
    let motion =
        Prescribed { velocity: v.into(), ..Prescribed::turning(w) }.about(c).schedule([(0.0, 1.0), (1.0, -2.0)]);
    let bat = Body::new("bat", Cuboid::new([0.3, 0.2, 0.1])).position([1.0, 2.0, 3.0]).motion(motion);
    let bat = bat.orientation(quaternion::to_scalar_first(&q));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([9.0, 0.0, 0.0]);
    let run = run(&scene([bat, ball]), 2.0);
    for (sample, &t) in run.times().iter().enumerate() {
        let (phase, f) = if t < 1.0 { (t, 1.0) } else { (1.0 - 2.0 * (t - 1.0), -2.0) };
        let orientation = quaternion::exp(&(phase * w)) * q;
        let centre = Vector3::new(1.0, 2.0, 3.0) + quaternion::rotate(&q, &c) + phase * v;
        let arm = -quaternion::rotate(&orientation, &c);
        let motion = run.motions(sample)[0];
        close(motion.position, centre + arm, 1e-14);
        close(motion.velocity, f * (v + w.cross(&arm)), 1e-14);
        close(motion.angular_velocity, f * w, 1e-14);
        assert!(quaternion::angle_between(&motion.orientation, &orientation) < 1e-14);
        assert_eq!(run.at(t).unwrap()[0], run.states(sample)[0]);
    }
    assert!(run.events().is_empty() && last(&run)[1].velocity == Vector3::zeros());
}

#[test]
fn a_ball_comes_back_from_a_moving_wall_by_its_speed_and_the_wall_does_the_work() {
    // against a wall of infinite mass and speed w: v⁺ = w + e (w − v); the wall's work is w j, j = m (v⁺ − v)
    let (m, v, w, e) = (0.5, -3.0, 2.0, 0.7);
    let wall = Body::new("wall", Cuboid::new([0.1, 1.0, 1.0])).position([-2.0, 0.0, 0.0]);
    let wall = wall.motion(Prescribed::moving([w, 0.0, 0.0]));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(m).position([1.0, 0.2, -0.3]).velocity([v, 0.0, 0.0]);
    let run = run(&scene([wall, ball.restitution(e)]), 1.0);
    let event = &run.events()[0];
    let time = 2.8 / (w - v);
    assert!((event.time - time).abs() < CLOSE && run.events().len() == 1);
    assert_eq!((event.kind, event.bodies), (EventKind::Bounce, [0, 1]));
    let after = w + e * (w - v);
    close(event.velocity[1], [after, 0.0, 0.0], TIGHT * after);
    close(event.impulse, [m * (after - v), 0.0, 0.0], TIGHT * m * after);
    assert_eq!(event.other_velocity, [Vector3::new(w, 0.0, 0.0); 2]);
    assert!((event.energy_lost - 0.5 * m * (1.0 - e * e) * (w - v) * (w - v)).abs() < TIGHT * m * after * after);
    let energy = run.energy().unwrap();
    assert!((energy.work.last().unwrap() - w * m * (after - v)).abs() < TIGHT * m * after * after);
    assert!(energy.drift() < TIGHT * m * after * after);
    close(last(&run)[1].position, [1.0 + v * time + after * (1.0 - time), 0.2, -0.3], CLOSE);
}

#[test]
fn a_bat_that_swings_about_its_handle_hits_with_the_speed_of_the_point_that_meets() {
    // the bat's end, at the lever x from the handle, has ω x; e = 1, no friction: v⁺ = 2 ω x − v along the normal
    let (w, x, r) = (4.0, 0.7, 0.05);
    let half = [0.4, 0.03, 0.03];
    let bat = Body::new("bat", Cuboid::new(half)).position([0.4, 0.0, 0.0]);
    let bat = bat.motion(Prescribed::turning([0.0, 0.0, w]).about([-0.4, 0.0, 0.0]));
    // after a quarter turn the bat lies along y; its face towards −x is then at x = −0.03
    let ball = Body::new("ball", Sphere::new(r)).mass(0.1).restitution(1.0).position([-0.03 - r, x, 0.0]);
    let run = run(&scene([bat, ball]), 0.6);
    let event = &run.events()[0];
    let quarter = std::f64::consts::FRAC_PI_2 / w;
    assert!((event.time - quarter).abs() < CLOSE, "{:e}", event.time - quarter);
    close(event.velocity[1], [-2.0 * w * x, 0.0, 0.0], CLOSE * w);
    close(event.point, [-0.03, x, 0.0], CLOSE);
    assert!(run.energy().unwrap().drift() < TIGHT);
}

#[test]
fn a_moved_body_meets_one_that_rests_on_the_floor() {
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed();
    let pusher = Body::new("pusher", Cuboid::new([0.1, 0.5, 0.05])).position([-1.0, 0.0, 0.2]);
    // it starts after a second, when the cube lies still
    let pusher = pusher.motion(Prescribed::moving([1.5, 0.0, 0.0]).schedule([(1.0, 1.0)]));
    let cube = Body::new("cube", Cuboid::new([0.2; 3])).mass(2.0).position([0.0, 0.0, 0.2]).restitution(0.5);
    let mut scene = scene([floor, pusher, cube]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    let run = run(&scene, 2.0);
    let hit = run.events().iter().find(|event| event.bodies == [1, 2]).unwrap();
    assert!((hit.time - 1.0 - 0.7 / 1.5).abs() < CLOSE, "{}", hit.time);
    close(hit.velocity[1], [1.5 * 1.5, 0.0, 0.0], CLOSE);
    assert!((last(&run)[2].position.x - 2.25 * (2.0 - hit.time)).abs() < CLOSE);
    assert!(run.energy().unwrap().drift() < CLOSE * 10.0);
}

#[test]
fn a_box_is_carried_along_by_a_conveyor_that_starts_to_run() {
    // slides with a = μ g up to the belt's speed u, after u/a, having lost ½ m u²; then it is carried
    let (mu, g, u, m) = (0.25, 10.0, 1.0, 3.0);
    let belt = Body::new("belt", Cuboid::new([20.0, 0.5, 0.1])).position([0.0, 0.0, -0.1]).friction(mu);
    let belt = belt.motion(Prescribed::moving([u, 0.0, 0.0]).schedule([(0.5, 1.0)]));
    let cube = Body::new("box", Cuboid::new([0.1; 3])).mass(m).friction(mu).position([0.0, 0.0, 0.1]);
    let mut scene = scene([belt, cube]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
    let run = run(&scene, 2.0);
    let (slide, end) = (u / (mu * g), last(&run)[1]);
    close(end.position, [0.5 * u * slide + u * (1.5 - slide), 0.0, 0.1], 1e-9);
    close(end.velocity, [u, 0.0, 0.0], 1e-9);
    let energy = run.energy().unwrap();
    let n = energy.work.len() - 1;
    // the belt's work: half of it moves the box, half is heat
    assert!((energy.work[n] - m * u * u).abs() < 1e-9 * m, "{}", energy.work[n] - m * u * u);
    assert!((energy.dissipated[n] - 0.5 * m * u * u).abs() < 1e-9 * m);
    assert!(energy.drift() < 1e-9 * m);
    assert_eq!(run.motions(40)[1].velocity, Vector3::zeros()); // until it starts
}

#[test]
fn a_box_on_a_turntable_goes_round_with_it_or_slides_off() {
    // ω² r < μ g: it sticks, and goes round with ω; above it slides outwards
    let (mu, g, r) = (0.4, 10.0, 0.5);
    for (w, sticks) in [(2.5, true), (3.2, false)] {
        let table = Body::new("table", Cuboid::new([2.0, 2.0, 0.05])).position([0.0, 0.0, -0.05]).friction(mu);
        let table = table.motion(Prescribed::turning([0.0, 0.0, w]));
        let cube = Body::new("box", Cuboid::new([0.1; 3])).mass(1.0).friction(mu).position([r, 0.0, 0.1]);
        let cube = cube.velocity([0.0, w * r, 0.0]).angular_velocity([0.0, 0.0, w]);
        let mut scene = scene([table, cube]);
        scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
        let run = run(&scene, 0.8);
        let end = last(&run)[1];
        let turned = Vector3::new(r * (0.8 * w).cos(), r * (0.8 * w).sin(), 0.1);
        if sticks {
            close(end.position, turned, 1e-8);
            assert!((end.angular_velocity - Vector3::new(0.0, 0.0, w)).norm() < 1e-8);
        } else {
            assert!(libm::hypot(end.position.x, end.position.y) > 1.05 * r);
        }
        assert!(run.energy().unwrap().drift() < 1e-8, "{:e}", run.energy().unwrap().drift());
    }
}

#[test]
fn a_lift_that_starts_takes_its_load_up() {
    let (u, e) = (1.0, 0.5);
    let lift = Body::new("lift", Cuboid::new([1.0, 1.0, 0.1])).position([0.0, 0.0, -0.1]);
    let lift = lift.motion(Prescribed::moving([0.0, 0.0, u]).schedule([(0.5, 1.0)])).restitution(e);
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([0.0, 0.0, 0.1]);
    let mut scene = scene([lift, ball]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    let run = run(&scene, 3.0);
    // it starts with a blow: v⁺ = (1 + e) u; bounces on the lift end after 2 e u/g/(1 − e); then it rides
    let first = run.events().iter().find(|event| event.kind == EventKind::Bounce).unwrap();
    assert_eq!(first.time, 0.5);
    close(first.velocity[1], [0.0, 0.0, (1.0 + e) * u], TIGHT);
    let lands = 0.5 + 2.0 * e * u / 10.0 / (1.0 - e);
    let rides = run.events().iter().rfind(|event| event.kind == EventKind::Contact).unwrap();
    assert!((rides.time - lands).abs() < 1e-9, "{} {lands}", rides.time);
    close(last(&run)[1].position, [0.0, 0.0, 0.1 + 2.5 * u], 1e-9);
    assert!(run.energy().unwrap().drift() < 1e-9);
}

#[test]
fn a_saved_run_with_a_moved_body_goes_on_with_the_same_bits() {
    let wall = Body::new("wall", Cuboid::new([0.1, 1.0, 1.0])).position([-2.0, 0.0, 0.0]);
    let wall = wall.motion(Prescribed::moving([1.0, 0.0, 0.0]).schedule([(0.2, 1.0), (0.9, -0.5)]));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([1.0, 0.2, -0.3]).velocity([-2.0, 0.0, 0.0]);
    let other = Body::new("other", Cuboid::new([0.1; 3])).fixed().position([1.5, 0.2, -0.3]);
    let scene = scene([wall, ball.restitution(1.0), other]);
    let plan = scene.compile(&RunOptions::method(bryla::Method::Rk4).step(0.01)).unwrap();
    let mut whole = plan.start(0.0).unwrap();
    whole.advance(0.6).unwrap();
    let file = std::env::temp_dir().join(format!("bryla-moved-{}.bryla", std::process::id()));
    whole.save(&file).unwrap();
    let mut again = Simulation::resume(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    for simulation in [&mut whole, &mut again] {
        simulation.advance(4.0).unwrap();
    }
    assert!(whole.events().len() >= 2);
    assert_eq!(whole.events(), again.events());
    assert_eq!(whole.motion("ball").unwrap(), again.motion("ball").unwrap());
    assert_eq!(whole.motion("wall").unwrap(), again.motion("wall").unwrap());
    close(whole.motion("wall").unwrap().position, [-2.0 + 0.7 - 0.5 * 3.1, 0.0, 0.0], 1e-14);
}

#[test]
fn what_rides_into_something_fixed_ends_the_run_by_name() {
    let wall = Body::new("wall", Cuboid::new([0.1, 1.0, 1.0])).motion(Prescribed::moving([1.0, 0.0, 0.0]));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([1.0, 0.0, 0.0]).response(Response::Stick);
    let post = Body::new("post", Sphere::new(0.1)).fixed().position([2.0, 0.0, 0.0]);
    let end = |bodies: Vec<Body>| {
        let error = scene(bodies).run(0.0..3.0, &RunOptions::tolerance(1e-6)).unwrap_err();
        let RunError::Simulation(error) = error else { panic!("{error}") };
        error
    };
    let error = end(vec![wall.clone(), ball.clone(), post]);
    assert!(error.to_string().contains("post is fixed, ball rides on wall, and they run into each other"), "{error}");
    assert!((error.time - 1.6).abs() < 1e-6 && error.trajectory.is_some());
}

/// A turntable of radius 1 that turns about z, and a ball that comes down on it at this distance from its centre.
fn turntable(spin: f64, r: f64, ball: Body) -> bryla::Scene {
    let table = Body::new("table", bryla::Cylinder::new(1.0, 0.05)).position([0.0, 0.0, -0.05]);
    let table = table.motion(Prescribed::turning([0.0, 0.0, spin])).response(Response::Stick);
    scene([table, ball.position([r, 0.0, 0.6]).velocity([0.0, 0.0, -1.0])])
}

#[test]
fn a_ball_that_sticks_to_a_turntable_rides_on_it() {
    // from the touch at t = 0.5 on: x = r (cos, sin), v = ω r; the blow takes ½ m |v − ω × r|² + ½ I ω² and m (v, ω r)
    let (w, r, m) = (3.0, 0.5, 2.0);
    let run = run(&turntable(w, r, Body::new("ball", Sphere::new(0.1)).mass(m)), 4.0);
    assert_eq!(run.events().len(), 1);
    let event = &run.events()[0];
    assert_eq!((event.kind, event.bodies), (EventKind::Stick, [0, 1]));
    assert!((event.time - 0.5).abs() < TIGHT);
    close(event.impulse, [0.0, m * w * r, m], TIGHT * m * w);
    close(event.velocity[1], [0.0, w * r, 0.0], TIGHT * w);
    close(event.angular_velocity[1], [0.0, 0.0, w], TIGHT * w);
    let inertia = 0.4 * m * 0.01;
    let lost = 0.5 * m * (1.0 + w * w * r * r) + 0.5 * inertia * w * w;
    assert!((event.energy_lost - lost).abs() < TIGHT * lost);

    for (sample, &t) in run.times().iter().enumerate().filter(|(_, t)| **t > 0.5) {
        let (angle, ball) = (w * (t - 0.5), run.motions(sample)[1]);
        close(ball.position, [r * angle.cos(), r * angle.sin(), 0.1], 1e-11);
        close(ball.velocity, [-w * r * angle.sin(), w * r * angle.cos(), 0.0], 1e-11);
        close(ball.angular_velocity, [0.0, 0.0, w], TIGHT * w);
    }
    // the table does the work that the ball gains and that is lost, at once, and none after it
    let energy = run.energy().unwrap();
    let gained = energy.kinetic[run.times().len() - 1] - energy.kinetic[0];
    assert!((energy.work[run.times().len() - 1] - gained - lost).abs() < TIGHT * lost);
    assert!(energy.drift() < TIGHT * lost, "{:e}", energy.drift());
    assert_eq!(run.report().met, Some(true));
}

#[test]
fn a_big_wheel_lifts_what_sticks_to_it_and_its_work_is_told() {
    // a plate turns about x through its origin under gravity, stands still from t = 2 on, and turns back from t = 3 on:
    // the height is that of the arm, and the work m g times its change
    let (w, g, m) = (0.8_f64, 10.0, 2.0);
    let plate = Body::new("plate", Cuboid::new([0.1, 2.0, 0.1])).position([0.0, 0.0, 0.0]);
    let plate = plate.motion(Prescribed::turning([w, 0.0, 0.0]).schedule([(0.4, 1.0), (2.0, 0.0), (3.0, -0.5)]));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(m).position([0.0, 1.5, 0.3]).response(Response::Stick);
    let mut scene = scene([plate, ball]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
    let run = run(&scene, 4.0);
    assert_eq!(run.events().len(), 1, "{:?}", run.events());
    assert!((run.events()[0].time - 0.02_f64.sqrt()).abs() < TIGHT);
    let angle = |t: f64| w * ((t - 0.4).clamp(0.0, 1.6) - 0.5 * (t - 3.0).max(0.0));
    for (sample, &t) in run.times().iter().enumerate().filter(|(_, t)| **t > 0.2) {
        let (s, c) = (angle(t).sin(), angle(t).cos());
        close(run.motions(sample)[1].position, [0.0, 1.5 * c - 0.2 * s, 1.5 * s + 0.2 * c], 1e-11);
    }
    // between the ends of the pieces of 1/32 rad in which it is booked the work is a cubic's: h⁴/384 of m g r
    assert!(
        run.energy().unwrap().drift() < 1.52 * m * g / 384.0 / 32.0_f64.powi(4),
        "{:e}",
        run.energy().unwrap().drift()
    );
}

#[test]
fn what_rides_comes_off_by_its_breaking_load_and_flies_off_along_the_tangent() {
    // a buoyant ball: m ω² r inwards and m g down pull at once, and stay
    let (w, r, m, g) = (3.0_f64, 0.5, 2.0, 0.5_f64);
    let ball = |f: f64| Body::new("ball", Sphere::new(0.1)).mass(m).breaking_load(BreakingLoad::new(f, f64::INFINITY));
    let carried = Vector3::new(-m * w * w * r, 0.0, -m * g);
    let [holds, parts] = [1.001, 0.999].map(|part| {
        let mut scene = turntable(w, r, ball(part * carried.norm()));
        scene.add_effect(UniformGravity::new([0.0, 0.0, g]));
        run(&scene, 2.0)
    });
    assert_eq!(holds.events().len(), 1);
    assert!(holds.energy().unwrap().drift() < 1e-10);
    let kinds: Vec<_> = parts.events().iter().map(|event| event.kind).collect();
    assert_eq!(kinds, [EventKind::Stick, EventKind::Break]);
    let (event, end) = (&parts.events()[1], last(&parts)[1]);
    assert!((event.time - 4.0 * (0.5 - 0.125_f64.sqrt())).abs() < TIGHT);
    close(event.force, carried, 1e-11);
    let left = 2.0 - event.time;
    close(end.velocity, [0.0, w * r, g * left], 1e-9);
    close(end.position, [r, w * r * left, 0.1 + 0.5 * g * left * left], 1e-9);
    assert!(parts.energy().unwrap().drift() < 1e-9);

    // the weight swings round in the plate's axes while it turns about the horizontal: here, straight up at first
    let (w, g, f) = (2.0_f64, 10.0, 21.0);
    let arm = 0.2;
    let plate = Body::new("plate", Cuboid::new([1.0, 1.0, 0.1])).motion(Prescribed::turning([w, 0.0, 0.0]));
    let drop = ball(f).position([0.0, 0.0, 0.2]).response(Response::Stick);
    let mut scene = scene([plate, drop]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
    let run = run(&scene, 1.4);
    let event = run.events().iter().find(|event| event.kind == EventKind::Break).unwrap();
    // force on the ball m g z − m ω² a e, e = (0, −sin, cos) of the turned angle φ = ω t
    let (weight, swing) = (m * g, m * w * w * arm);
    let cosine = (weight * weight + swing * swing - f * f) / (2.0 * weight * swing);
    // it lies on the plate at the start, and sticks as soon as that begins to turn
    let (begin, ride) = (run.events()[0].time, event.time - run.events()[0].time);
    assert!(begin < 1e-6 && (ride - cosine.acos() / w).abs() < 1e-11, "{begin} {ride} {}", cosine.acos() / w);
    assert!((event.force.norm() - f).abs() < 1e-10);
    let (s, c) = ((w * ride).sin(), (w * ride).cos());
    close(event.velocity[1], [0.0, -w * arm * c, -w * arm * s], 1e-10);
    close(event.force, [0.0, swing * s, weight - swing * c], 1e-9);
}

#[test]
fn a_saved_rider_goes_on_with_the_same_bits() {
    let table = Body::new("table", bryla::Cylinder::new(1.0, 0.05)).position([0.0, 0.0, -0.05]);
    let motion = Prescribed { velocity: [0.1, 0.0, 0.0], ..Prescribed::turning([0.0, 0.0, 3.0]) };
    let table = table.motion(motion.schedule([(0.0, 1.0), (1.0, 1.5)]));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([0.5, 0.0, 0.6]).velocity([0.0, 0.0, -1.0]);
    let ball = ball.response(Response::Stick).breaking_load(BreakingLoad::new(8.0, 1.0));
    let mut scene = scene([table, ball]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, 0.5]));
    for method in [bryla::Method::Exact, bryla::Method::Rk4] {
        let plan = scene.compile(&RunOptions::method(method).step(0.01)).unwrap();
        for at in [0.7, 1.2] {
            let mut whole = plan.start(0.0).unwrap();
            whole.advance(at).unwrap();
            let file = std::env::temp_dir().join(format!("bryla-rides-{}-{method}-{at}.bryla", std::process::id()));
            whole.save(&file).unwrap();
            let mut again = Simulation::resume(&file).unwrap();
            std::fs::remove_file(&file).unwrap();
            for simulation in [&mut whole, &mut again] {
                simulation.advance(2.0).unwrap();
            }
            let kinds: Vec<_> = whole.events().iter().map(|event| (event.kind, event.time)).collect();
            // m (1.5 ω)² r is more than the joint bears from t = 1 on
            assert_eq!(kinds[1], (EventKind::Break, 1.0));
            assert_eq!(whole.events(), again.events());
            assert_eq!(whole.motion("ball").unwrap(), again.motion("ball").unwrap());
        }
    }
}
