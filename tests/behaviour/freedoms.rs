//! Reduced coordinates tell the same motion with fewer numbers.

use super::{distance, last, run};
use bryla::math::Vector3;
use bryla::{Body, Cuboid, Drag, Freedom, Method, Scene, Thruster, UniformGravity};

/// The hovercraft of the catalogue, in a plane or free.
fn hovercraft(freedom: Freedom) -> Scene {
    let mut scene = bryla::catalogue::hovercraft().unwrap();
    scene.bodies[0].freedom = freedom;
    scene
}

#[test]
fn planar_and_full_hovercraft_differ_by_truncation_only() {
    let (planar, full) = (hovercraft(Freedom::planar([0.0, 0.0, 1.0])), hovercraft(Freedom::Free));
    for &method in Method::ALL {
        let apart = |step| distance(&last(&run(&planar, 20.0, method, step)), &last(&run(&full, 20.0, method, step)));
        let (coarse, fine) = (apart(0.04), apart(0.02));
        let rounding = 1e-9;
        let order = f64::from(method.order());
        assert!(fine < rounding || (coarse / fine).log2() > order - 0.5, "{method}: {coarse:e} then {fine:e}");
    }
}

#[test]
fn planar_hovercraft_costs_fewer_numbers() {
    let numbers = |freedom| hovercraft(freedom).explain().unwrap();
    assert!(numbers(Freedom::planar([0.0, 0.0, 1.0])).contains("planar, 6 numbers"));
    assert!(numbers(Freedom::Free).contains("free, 13 numbers"));
}

#[test]
fn a_plane_at_any_angle_is_as_good() {
    // the same motion, turned: position and orientation turn with it
    let q = [0.8, 0.1, -0.5, 0.316227766016838];
    let turn = bryla::math::quaternion::normalized(&bryla::math::quaternion::from_scalar_first(q));
    let rotate = |v: [f64; 3]| -> [f64; 3] { bryla::math::quaternion::rotate(&turn, &v.into()).into() };
    let scene = |turned: bool| {
        let mut scene = Scene::new();
        let body = Body::new("hull", Cuboid::new([2.0, 1.0, 0.4])).mass(400.0);
        let body = if turned {
            body.orientation(q).freedom(Freedom::planar(rotate([0.0, 0.0, 1.0])))
        } else {
            body.freedom(Freedom::planar([0.0, 0.0, 1.0]))
        };
        scene.add(body).unwrap();
        scene.add_effect(Thruster::new("hull", [1.0, 0.5, 0.0], [300.0, 200.0, 0.0]));
        scene.add_effect(Drag::new(30.0, 2.0).angular(40.0, 3.0));
        last(&run(&scene, 3.0, Method::Rk4, 1e-2))
    };
    let (flat, tilted) = (scene(false), scene(true));
    let expected: Vector3 = rotate(flat.position.into()).into();
    assert!((tilted.position - expected).norm() < 1e-12 * expected.norm());
    assert!(bryla::math::quaternion::angle_between(&tilted.orientation, &(turn * flat.orientation)) < 1e-12);
}

#[test]
fn the_plane_reports_the_torque_that_holds_a_body_off_its_principal_axes() {
    // a hull turning about z with products of inertia: M = ω × I ω = ω² (−I_yz, I_xz, 0) must come from outside
    let inertia = [[2.0, 0.0, 0.3], [0.0, 3.0, -0.2], [0.3, -0.2, 4.0]];
    let mut scene = Scene::new();
    scene
        .add(
            Body::with_inertia("hull", 5.0, inertia)
                .freedom(Freedom::planar([0.0, 0.0, 1.0]))
                .angular_velocity([0.0, 0.0, 2.0]),
        )
        .unwrap();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    let run = run(&scene, 1.0, Method::Rk4, 1e-2);
    let reaction = run.reactions(0)[0];
    assert!((reaction.force - Vector3::new(0.0, 0.0, 5.0 * 9.81)).norm() < 1e-12);
    assert!((reaction.torque - 4.0 * Vector3::new(0.2, 0.3, 0.0)).norm() < 1e-12, "{}", reaction.torque);
}

#[test]
fn a_swinging_pendulum_pulls_on_its_pivot_with_weight_and_centripetal_force() {
    // at the lowest point: N = m g + m ω² l, upwards; pivot and axle agree
    let (m, l, g, w) = (2.0, 0.7, 9.81, 1.3);
    for freedom in [Freedom::pivot([0.0, 0.0, l]), Freedom::axle([0.0, 0.0, l], [0.0, 1.0, 0.0])] {
        let mut scene = Scene::new();
        let body = Body::new("bob", Cuboid::new([0.05, 0.08, 0.1])).mass(m).freedom(freedom.clone());
        scene.add(body.angular_velocity([0.0, w, 0.0])).unwrap();
        scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
        let run = run(&scene, 1.0, Method::Rk4, 1e-2);
        let reaction = run.reactions(0)[0];
        assert!((reaction.force - Vector3::new(0.0, 0.0, m * g + m * w * w * l)).norm() < 1e-12, "{}", freedom.name());
        // the velocity that the file left out is that of the rotation
        assert!((run.motions(0)[0].velocity - Vector3::new(-w * l, 0.0, 0.0)).norm() < 1e-15);
    }
}

#[test]
fn reactions_make_the_motion_obey_newton_anywhere_on_its_way() {
    // m a = F + reaction, with a from the motion itself by a central difference, truncation h²
    let mut scene = bryla::catalogue::heavy_top().unwrap();
    scene.run = bryla::RunOptions::default();
    let times = vec![0.0, 0.05, 0.1, 0.15];
    let options = bryla::RunOptions::method(Method::Rk4).step(1e-5).estimate(false).t_eval(times.clone());
    let run = scene.run(0.0..0.2, &options).unwrap();
    let m = run.plan().bodies()[0].properties.mass;
    for (sample, t) in times.iter().enumerate().skip(1) {
        let h = 2e-5;
        let v = |t: f64| run.named("top").unwrap().at(t).unwrap().velocity;
        let a = (v(t + h) - v(t - h)) / (2.0 * h);
        let force = run.reactions(sample)[0].force + m * Vector3::new(0.0, 0.0, -9.81);
        assert!((m * a - force).norm() < 1e-5 * force.norm().max(m * 9.81), "{t}: {} against {force}", m * a);
    }
}

#[test]
fn axle_and_pivot_and_plane_agree_on_a_pendulum() {
    let inertia = [[0.8, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 2.1]];
    let end = |freedom: Freedom| {
        let mut scene = Scene::new();
        let body = Body::with_inertia("body", 2.0, inertia).freedom(freedom).angular_velocity([0.0, 2.0, 0.0]);
        scene.add(body).unwrap();
        scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
        last(&run(&scene, 2.0, Method::Rk4, 5e-4))
    };
    let (axle, pivot) = (end(Freedom::axle([0.0, 0.0, 0.5], [0.0, 3.0, 0.0])), end(Freedom::pivot([0.0, 0.0, 0.5])));
    // truncation of the method at h = 5e-4, ω about 6: h⁴ω⁵t/120
    assert!(distance(&axle, &pivot) < 1e-9, "{:e}", distance(&axle, &pivot));
}
