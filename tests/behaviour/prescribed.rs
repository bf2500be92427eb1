//! Bodies on prescribed motions, and what they do to others, against closed forms; each formula stands in its test.

use super::meeting::{close, last, run, scene};
use bryla::math::{Vector3, quaternion};
use bryla::{
    Body, Cuboid, EventKind, HalfSpace, Prescribed, Response, RunError, RunOptions, Simulation, Sphere, UniformGravity,
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
fn what_sticks_to_a_moved_body_ends_the_run_by_name() {
    let wall = Body::new("wall", Cuboid::new([0.1, 1.0, 1.0])).motion(Prescribed::moving([1.0, 0.0, 0.0]));
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([1.0, 0.0, 0.0]).response(Response::Stick);
    let error = scene([wall, ball]).run(0.0..1.0, &RunOptions::tolerance(1e-6)).unwrap_err();
    let RunError::Simulation(error) = error else { panic!("{error}") };
    assert!(error.to_string().contains("ball sticks to wall, which moves as prescribed"), "{error}");
    assert!((error.time - 0.8).abs() < 1e-6 && error.trajectory.is_some());
}
