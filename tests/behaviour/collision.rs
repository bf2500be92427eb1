//! The lecture's first collision: bodies against half spaces.

use bryla::math::Vector3;
use bryla::simulation::Failure;
use bryla::{
    Body, Cuboid, Finder, Freedom, HalfSpace, Method, Polyhedron, Response, RunError, RunOptions, Scene, Sphere,
    Trajectory, UniformGravity,
};

/// A floor at z = 0 under gravity, and a body above it.
fn floor_and(body: Body) -> Scene {
    let mut scene = Scene::new();
    scene.add(Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed()).unwrap();
    scene.add(body).unwrap();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    scene
}

fn ball(restitution: f64) -> Body {
    Body::new("ball", Sphere::new(0.1)).mass(2.0).position([0.0, 0.0, 5.1]).restitution(restitution)
}

fn options() -> RunOptions {
    RunOptions::method(Method::Rk4).step(1e-2).estimate(false)
}

fn broken(scene: &Scene, end: f64) -> (Failure, Trajectory) {
    match scene.run(0.0..end, &options()).unwrap_err() {
        RunError::Simulation(error) => (error.kind.clone(), *error.trajectory.clone().unwrap()),
        RunError::Input(error) => panic!("{error}"),
    }
}

#[test]
fn a_ball_bounces_at_the_times_and_heights_of_free_fall() {
    // falls 5 m in 1 s to 10 m/s; each bounce leaves e times the speed, so bounce k comes 2 eᵏ s after bounce k−1
    let e = 0.8;
    for finder in [Finder::Bisection, Finder::Secant] {
        let run = floor_and(ball(e)).run(0.0..5.0, &options().finder(finder)).unwrap();
        let (mut time, mut speed) = (1.0, 10.0);
        assert_eq!(run.events().len(), 4);
        for event in run.events() {
            // the gap accepted is 1e-12 of the body's size: early by 1e-13 m / speed, and rounding of 5 m
            assert!((event.time - time).abs() < 1e-14 * 10.0, "{}: {} against {time}", finder.name(), event.time);
            assert!((event.velocity[1].z - e * speed).abs() < 1e-12 * speed);
            assert!((event.impulse.z - 2.0 * (1.0 + e) * speed).abs() < 1e-12 * 36.0);
            assert!((event.energy_lost - (1.0 - e * e) * speed * speed).abs() < 1e-12 * 100.0);
            assert_eq!(event.features, "face 0, surface 0");
            speed *= e;
            time += 2.0 * speed / 10.0;
        }
        assert!(run.energy().unwrap().drift() < 1e-11);
    }
}

#[test]
fn the_secant_takes_fewer_rounds_than_bisection() {
    let rounds = |finder| {
        let run = floor_and(ball(0.8)).run(0.0..5.0, &options().finder(finder)).unwrap();
        run.report().impact_iterations
    };
    let (bisection, secant) = (rounds(Finder::Bisection), rounds(Finder::Secant));
    assert!(2 * secant < bisection, "{secant} against {bisection}");
}

#[test]
fn a_cube_that_lands_flat_never_turns() {
    let cube = Body::new("cube", Cuboid::new([0.1; 3])).density(500.0).position([0.3, -0.2, 1.0]).restitution(1.0);
    let run = floor_and(cube).run(0.0..5.0, &options()).unwrap();
    assert!(run.events().len() > 4);
    for event in run.events() {
        // all four corners carry: the centroid of their impulses is below the centre
        assert!((event.point - Vector3::new(0.3, -0.2, 0.0)).norm() < 1e-9, "{:?}", event.point);
        assert!(event.angular_velocity[1].norm() < 1e-12 * 4.0 / 0.1);
    }
    assert!(run.energy().unwrap().drift() < 1e-11 * 40.0);
}

#[test]
fn a_polyhedron_bounces_as_the_cuboid_it_is() {
    let cuboid = Cuboid::new([0.1, 0.2, 0.15]);
    let (x, y, z) = (0.1, 0.2, 0.15);
    let vertices: Vec<[f64; 3]> = (0..8)
        .map(|i| [if i & 1 == 0 { -x } else { x }, if i & 2 == 0 { -y } else { y }, if i & 4 == 0 { -z } else { z }])
        .collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let polyhedron = Polyhedron::new(vertices, faces.map(|f| f.to_vec()));
    let run = |body: Body| {
        let body = body.density(500.0).position([0.0, 0.0, 1.0]).angular_velocity([1.0, 2.0, -0.5]).restitution(0.7);
        floor_and(body).run(0.0..0.8, &options()).unwrap()
    };
    let (a, b) = (run(Body::new("box", cuboid)), run(Body::new("box", polyhedron)));
    assert!(!a.events().is_empty());
    for (a, b) in a.events().iter().zip(b.events()) {
        assert_eq!(a.features, b.features);
        assert!((a.time - b.time).abs() < 1e-12 && (a.impulse - b.impulse).norm() < 1e-9 * a.impulse.norm());
    }
}

#[test]
fn an_elastic_tumbling_box_keeps_its_energy_through_many_bounces() {
    let body = Body::new("box", Cuboid::new([0.1, 0.2, 0.15])).density(500.0).position([0.0, 0.0, 1.5]);
    let scene = floor_and(body.angular_velocity([1.0, 2.0, -0.5]).restitution(1.0));
    let run = scene.run(0.0..5.0, &options().step(1e-3)).unwrap();
    assert!(run.events().len() >= 8, "{}", run.events().len());
    // truncation of the method between bounces, h = 1e-3 and ω of 20 rad/s: some 1e-9 of 90 J
    assert!(run.energy().unwrap().drift() < 1e-6, "{:e}", run.energy().unwrap().drift());
    // never below the floor by more than the accepted gap, at any sample
    for sample in 0..run.times().len() {
        let motion = run.motions(sample)[1];
        let lowest =
            Cuboid::new([0.1, 0.2, 0.15]).vertices().unwrap().iter().map(|v| motion.point(v).z).fold(9.0, f64::min);
        assert!(lowest > -1e-6, "{lowest:e} at {}", run.times()[sample]);
    }
}

#[test]
fn a_body_that_sticks_stays_where_it_touched() {
    let body =
        Body::new("dart", Cuboid::new([0.1, 0.05, 0.05])).mass(0.2).position([0.0, 0.0, 2.0]).velocity([1.0, 0.0, 0.0]);
    let scene = floor_and(body.angular_velocity([0.0, 3.0, 0.0]).response(Response::Stick));
    let run = scene.run(0.0..2.0, &options()).unwrap();
    let [event] = run.events() else { panic!("{} events", run.events().len()) };
    let last = run.motions(run.times().len() - 1)[1];
    assert_eq!((last.velocity, last.angular_velocity), (Vector3::zeros(), Vector3::zeros()));
    let at_touch = run.at(event.time).unwrap()[1];
    assert!((last.position - at_touch.position).norm() < 1e-15);
    // everything it had is lost: the balance of the run stays
    assert!((event.energy_lost - 0.5 * 0.2 * event.velocity[0].norm_squared()).abs() > 0.0);
    assert!(run.energy().unwrap().drift() < 1e-9, "{:e}", run.energy().unwrap().drift());
}

#[test]
fn a_body_that_starts_in_the_floor_is_refused_with_its_depth() {
    let (failure, _) = broken(&floor_and(ball(0.5).position([0.0, 0.0, 0.07])), 1.0);
    assert!(matches!(failure, Failure::Overlap(depth) if (depth - 0.03).abs() < 1e-15), "{failure}");
}

#[test]
fn contacts_that_cannot_be_answered_are_refused_before_running() {
    let refusal = |body: Body| floor_and(body).compile(&options()).unwrap_err().to_string();
    let cube = || Body::new("cube", Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, 1.0]);
    let planar = || cube().freedom(Freedom::planar([0.0, 1.0, 0.0]));
    assert_eq!(
        refusal(planar().response(Response::Stick)),
        "body cube: with freedom planar it cannot stick, as it would to floor; let both bounce, or where it never meets another, \
         say collides = false of it"
    );
    // the other one may say so, and who never meets it may be what it wants
    let mut sticky = floor_and(planar());
    assert!(sticky.compile(&options()).is_ok());
    sticky.bodies[0].response = Response::Stick;
    assert!(sticky.compile(&options()).unwrap_err().to_string().contains("cannot stick, as it would to floor"));
    assert!(floor_and(planar().response(Response::Stick).collides(false)).compile(&options()).is_ok());
}

#[test]
fn a_tilted_plane_is_a_plane() {
    // the same fall seen in turned axes: normal and gravity turn together
    let q = [0.8, 0.1, -0.5, 0.316227766016838];
    let turn = bryla::math::quaternion::normalized(&bryla::math::quaternion::from_scalar_first(q));
    let rotate = |v: Vector3| -> [f64; 3] { bryla::math::quaternion::rotate(&turn, &v).into() };
    let mut scene = Scene::new();
    // the offset is along the normal as given: (0, 0, 2) at 6 is a plane 3 up
    scene.add(Body::new("wall", HalfSpace::new([0.0, 0.0, 2.0], 6.0)).orientation(q).fixed()).unwrap();
    let ball =
        Body::new("ball", Sphere::new(0.1)).mass(2.0).position(rotate(Vector3::new(0.0, 0.0, 8.1))).restitution(0.8);
    scene.add(ball).unwrap();
    scene.add_effect(UniformGravity::new(rotate(Vector3::new(0.0, 0.0, -10.0))));
    let run = scene.run(0.0..2.0, &options()).unwrap();
    assert!((run.events()[0].time - 1.0).abs() < 1e-12);
}

#[test]
fn a_body_touches_where_its_vertices_are_whatever_numbers_it_is_integrated_in() {
    // a lopsided tetrahedron, whose principal axes are not those of its shape; in air, so that it has no closed form
    let vertices = [[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.1, 0.2, 0.0], [0.05, 0.1, 0.15]];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let body = Body::new("body", Polyhedron::new(vertices.to_vec(), faces.map(|f| f.to_vec()).to_vec())).density(500.0);
    let body = body.position([0.0, 0.0, 1.0]).angular_velocity([3.0, 4.0, -2.0]).restitution(0.8);
    let mut scene = floor_and(body);
    scene.add_effect(bryla::Drag::new(0.0, 0.05));
    let matrix = RunOptions::method(Method::Heun).step(1e-4).orientation(bryla::Orientation::Matrix);
    for options in [RunOptions::tolerance(1e-9), matrix.finder(Finder::Secant)] {
        let run = scene.run(0.0..0.6, &options).unwrap();
        let event = &run.events()[0];
        let pose = run.pose("body", event.time).unwrap();
        let heights = vertices.map(|v| pose.point(&Vector3::from(v)).z);
        let lowest = heights.into_iter().fold(f64::INFINITY, f64::min);
        // ε is 1e-12 of the body's size
        assert!((0.0..1e-12).contains(&lowest), "{lowest:e}");
        assert!((event.point.z - 0.5 * lowest).abs() < 1e-12);
    }
}
