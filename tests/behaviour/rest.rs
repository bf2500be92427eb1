//! Bounces that end, and what rests: planes, slopes, boxes on boxes.

use bryla::math::Vector3;
use bryla::{
    Body, Cuboid, EventKind, HalfSpace, RunOptions, Scene, Sphere, Thruster, Trajectory, UniformGravity, Wrench,
};

const G: f64 = 10.0;

/// A floor at z = 0 under gravity that is turned by `slope` [rad] about y, so that the floor is a slope.
fn slope_and(slope: f64, friction: f64, bodies: impl IntoIterator<Item = Body>) -> Scene {
    let mut scene = Scene::new();
    scene.add(Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(friction)).unwrap();
    for body in bodies {
        scene.add(body.friction(friction)).unwrap();
    }
    scene.add_effect(UniformGravity::new([G * slope.sin(), 0.0, -G * slope.cos()]));
    scene
}

fn run(scene: &Scene, end: f64) -> Trajectory {
    match scene.run(0.0..end, &RunOptions::tolerance(1e-9).estimate(false)) {
        Ok(run) => run,
        Err(error) => panic!("{error}"),
    }
}

fn last(run: &Trajectory, body: usize) -> bryla::BodyMotion {
    run.motions(run.times().len() - 1)[body]
}

#[test]
fn the_bounces_of_a_ball_end_when_their_geometric_series_does() {
    // falls h in √(2h/g), then 2 √(2h/g) (e + e² + …): at rest at √(2h/g) (1 + e)/(1 − e)
    for e in [0.3, 0.5, 0.8] {
        let ball = Body::new("ball", Sphere::new(0.1)).mass(2.0).position([0.0, 0.0, 5.1]).restitution(e);
        let truth = (1.0 + e) / (1.0 - e);
        let run = run(&slope_and(0.0, 0.0, [ball]), truth + 1.0);
        let rest = run.events().last().unwrap();
        assert_eq!(rest.kind, EventKind::Rest);
        // the series ends where four bounces say, however small the last one
        assert!((rest.time - truth).abs() < 1e-9 * truth, "e = {e}: {} against {truth}", rest.time);
        let end = last(&run, 1);
        assert_eq!(end.velocity, Vector3::zeros());
        assert!((end.position.z - 0.1).abs() < 1e-11 && end.position.z > 0.1, "{:e}", end.position.z - 0.1);
        assert!(run.energy().unwrap().drift() < 1e-9 * 100.0, "{:e}", run.energy().unwrap().drift());
    }
}

#[test]
fn a_box_on_a_slope_stays_below_the_angle_of_friction_and_slides_above_it() {
    let slope: f64 = 0.3;
    let at_rest = |friction: f64| {
        let cube = Body::new("cube", Cuboid::new([0.1, 0.1, 0.05])).mass(1.0).position([0.0, 0.0, 0.05]);
        run(&slope_and(slope, friction, [cube]), 1.0)
    };
    let stays = at_rest(slope.tan() * (1.0 + 1e-6));
    assert!(last(&stays, 1).position.x.abs() < 1e-12, "{:e}", last(&stays, 1).position.x);

    // slides with a = g (sin − μ cos), also where that is a millionth of g sin
    for part in [0.0, 0.5, 1.0 - 1e-6] {
        let friction = part * slope.tan();
        let slides = at_rest(friction);
        let a = G * (slope.sin() - friction * slope.cos());
        let end = last(&slides, 1);
        assert!((end.position.x - 0.5 * a).abs() < 1e-9 * a, "{} against {}", end.position.x, 0.5 * a);
        assert!((end.velocity.x - a).abs() < 1e-9 * a && end.angular_velocity.norm() < 1e-12);
        assert!(slides.energy().unwrap().drift() < 1e-12 * G);
    }
}

#[test]
fn a_box_dropped_on_a_box_comes_to_rest_on_it() {
    let body = |name: &str, z: f64| {
        Body::new(name, Cuboid::new([0.1, 0.1, 0.1])).mass(1.0).position([0.0, 0.0, z]).restitution(0.4)
    };
    let run = run(&slope_and(0.0, 0.5, [body("lower", 0.1), body("upper", 0.5)]), 2.0);
    let (lower, upper) = (last(&run, 1), last(&run, 2));
    assert_eq!((lower.velocity, upper.velocity), (Vector3::zeros(), Vector3::zeros()));
    assert!((lower.position - Vector3::new(0.0, 0.0, 0.1)).norm() < 1e-9, "{lower:?}");
    assert!((upper.position - Vector3::new(0.0, 0.0, 0.3)).norm() < 1e-9, "{upper:?}");
    // flat all the way: no spin, ever
    assert!(run.events().iter().all(|event| event.angular_velocity[1].norm() < 1e-9));
}

#[test]
fn what_rests_wakes_where_its_load_jumps_and_when_it_is_hit() {
    // pushed from t = 0.5 on with F > μ m g: a = F/m − μ g
    let (mu, force) = (0.3, 5.0);
    let cube = || Body::new("cube", Cuboid::new([0.1, 0.1, 0.1])).mass(1.0).position([0.0, 0.0, 0.1]);
    let mut pushed = slope_and(0.0, mu, [cube()]);
    let push = Thruster::new("cube", [0.0, 0.0, -0.05], [force, 0.0, 0.0]);
    pushed.add_effect(push.schedule([(0.0, 0.1), (0.5, 1.0)]));
    let run_of = run(&pushed, 1.0);
    let a = force - mu * G;
    assert!((last(&run_of, 1).position.x - 0.5 * a * 0.25).abs() < 1e-9, "{}", last(&run_of, 1).position.x);
    assert!(run_of.at(0.5).unwrap()[1].position.x.abs() < 1e-14);

    // a load that swings below the limit of friction moves nothing; it is followed, not frozen
    let mut shaken = slope_and(0.0, mu, [cube()]);
    shaken.add_effect(Wrench::new("cube", [2.0, 0.0, 0.0], [0.0; 3]).oscillating(30.0, 0.0));
    assert!(last(&run(&shaken, 0.5), 1).position.x.abs() < 1e-12);

    // hit by an equal ball without friction: it takes the ball's speed and keeps it along the floor
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([-0.7, 0.0, 0.1]).velocity([1.0, 0.0, 0.0]);
    let hit = slope_and(0.0, 0.0, [cube().restitution(1.0), ball.restitution(0.0)]);
    let run_of = run(&hit, 1.0);
    assert!((last(&run_of, 1).velocity - Vector3::x()).norm() < 1e-12);
    assert!((last(&run_of, 1).position.x - 0.5).abs() < 1e-9 && last(&run_of, 2).velocity.norm() < 1e-12);
}
