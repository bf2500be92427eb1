//! Every effect under one audit: kinetic + potential + dissipated − work stays.

use super::free_body;
use bryla::{
    AnyEffect, Body, Drag, Frame, Freedom, Method, PointGravity, RunOptions, Scene, Spring, Thruster, UniformGravity,
    UserEffect, Wrench,
};

/// One or more of every effect, each acting on "body", with all of its parameters at work.
fn samples() -> Vec<AnyEffect> {
    vec![
        UniformGravity::new([0.3, -0.2, -9.81]).into(),
        PointGravity::new(30.0, [0.5, 9.0, -1.0]).into(),
        Drag::new(0.3, 0.2).angular(0.4, 0.1).wind([1.0, -0.5, 0.2]).into(),
        Thruster::new("body", [0.1, 0.4, -0.2], [0.8, 0.3, 0.5]).schedule([(0.5, 1.0), (1.3, -0.4)]).into(),
        Wrench::new("body", [0.4, -0.3, 0.6], [0.5, 0.2, -0.4]).point([0.1, 0.3, -0.2]).oscillating(2.0, 0.4).into(),
        Wrench::new("body", [0.4, -0.3, 0.6], [0.5, 0.2, -0.4])
            .frame(Frame::Body)
            .schedule([(0.0, 1.0), (0.9, 0.3)])
            .into(),
        Spring::to_world("body", [1.0, 0.5, 2.0], 5.0)
            .damping(0.4)
            .rest_length(0.7)
            .anchors([0.2, -0.1, 0.3], [1.0, 0.5, 2.0])
            .into(),
        Spring::between("body", "other", 6.0)
            .damping(0.3)
            .rest_length(0.5)
            .anchors([0.2, -0.1, 0.3], [0.1, 0.2, -0.2])
            .into(),
    ]
}

/// The free body and another, so that pairs have a partner.
fn two_bodies() -> Scene {
    let mut scene = free_body();
    let inertia = [[0.5, 0.02, 0.0], [0.02, 0.6, 0.01], [0.0, 0.01, 0.9]];
    scene
        .add(Body::with_inertia("other", 1.5, inertia).position([1.0, 1.2, -0.4]).angular_velocity([0.3, 0.8, -0.6]))
        .unwrap();
    scene
}

/// Largest change of the energy balance over 2 s with the method of order 4.
fn audit(scene: &Scene, step: f64) -> f64 {
    let options = RunOptions::method(Method::Rk4).step(step).estimate(false);
    scene.run(0.0..2.0, &options).unwrap().energy().unwrap().drift()
}

#[test]
fn every_effect_accounts_for_the_energy_it_moves() {
    let samples = samples();
    for name in AnyEffect::NAMES {
        assert!(samples.iter().any(|effect| effect.name() == *name), "no sample of {name}");
    }
    for effect in samples {
        let mut scene = two_bodies();
        let what = format!("{effect:?}");
        scene.add_effect(effect);
        // the balance is kept to the truncation of the method, h⁴, from some 1e-8 at h = 1e-2 down
        // and in the end to the rounding of 800 steps with energies up to 400 J
        let rounding = 800.0 * f64::EPSILON * 400.0;
        let (coarse, fine) = (audit(&scene, 1e-2), audit(&scene, 2.5e-3));
        assert!(coarse < 1e-6, "{what}: {coarse:e}");
        assert!(fine < coarse / 100.0 || fine < rounding, "{what}: {coarse:e} then {fine:e}");
    }
}

#[test]
fn a_user_effect_is_booked_like_the_one_it_imitates() {
    let g = bryla::math::Vector3::new(0.3, -0.2, -9.81);
    let gravity =
        move |_t: f64, bodies: &[bryla::BodyMotion]| Ok(vec![(bodies[0].mass * g, bryla::math::Vector3::zeros())]);
    let run = |effect: AnyEffect| {
        let mut scene = free_body();
        scene.add_effect(effect);
        super::run(&scene, 1.0, Method::Rk4, 1e-2)
    };
    let built_in = run(UniformGravity::new([0.3, -0.2, -9.81]).into());
    let as_work = run(UserEffect::new(gravity).into());
    let as_potential = run(UserEffect::new(gravity).energy(move |_, b| Ok(-b[0].mass * g.dot(&b[0].position))).into());
    assert_eq!(super::last(&built_in), super::last(&as_work));
    assert_eq!(super::last(&built_in), super::last(&as_potential));
    let n = built_in.times().len() - 1;
    let [a, b, c] = [&built_in, &as_work, &as_potential].map(|run| run.energy().unwrap());
    // sums of 100 steps of energies up to 60 J
    let rounding = 100.0 * f64::EPSILON * 60.0;
    assert!((a.potential[n] - a.potential[0] + b.work[n]).abs() < rounding);
    assert!((a.potential[n] - c.potential[n]).abs() < rounding && c.work[n] == 0.0);
}

#[test]
fn coupled_bodies_keep_momentum_and_angular_momentum() {
    let mut scene = two_bodies();
    scene.add_effect(Spring::between("body", "other", 6.0).damping(0.3).anchors([0.2, -0.1, 0.3], [0.1, 0.2, -0.2]));
    let run = super::run(&scene, 3.0, Method::Rk4, 1e-2);
    let (start, end) = (run.total(0, [0.3, 0.1, 0.0]), run.total(run.times().len() - 1, [0.3, 0.1, 0.0]));
    // linear momentum: rounding of 300 steps; angular momentum: truncation, measured 3e-9 at h = 1e-2
    assert!((start.linear_momentum - end.linear_momentum).norm() < 300.0 * f64::EPSILON * 4.0);
    assert!((start.angular_momentum - end.angular_momentum).norm() < 1e-7);
}

#[test]
fn a_users_mistake_ends_the_run_with_its_words() {
    let mut scene = free_body();
    scene.add_effect(UserEffect::new(|t, _| {
        if t > 0.5 { Err("the wind stopped".to_owned()) } else { Ok(vec![Default::default()]) }
    }));
    let error = scene.run(0.0..1.0, &RunOptions::method(Method::Heun).step(0.1).estimate(false)).unwrap_err();
    let bryla::RunError::Simulation(error) = error else { panic!("{error}") };
    assert!(error.to_string().ends_with("a user effect failed: the wind stopped"), "{error}");
    let run = error.trajectory.as_ref().unwrap();
    assert!(run.end() <= 0.5 && run.end() >= 0.4, "{}", run.end());
}

#[test]
fn what_does_nothing_is_left_out_and_said() {
    let mut scene = free_body();
    scene.add_effect(Drag::default());
    scene.add_effect(UniformGravity::new([0.0; 3]));
    let text = scene.explain().unwrap();
    assert!(text.contains("left out   effect 1 (drag): all its coefficients are 0"), "{text}");
    assert!(text.contains("effect 2 (uniform_gravity): its acceleration is 0"), "{text}");
    // and costs nothing: the same bits as the scene without
    assert_eq!(
        super::last(&super::run(&scene, 1.0, Method::Rk4, 1e-2)),
        super::last(&super::run(&free_body(), 1.0, Method::Rk4, 1e-2))
    );
}

#[test]
fn gravity_of_a_point_keeps_an_orbit_and_its_angular_momentum() {
    // a circular orbit of radius 10 with μ = 1000: v = 10, period 2π; the gradient term shifts it by 1e-3
    let mut scene = Scene::new();
    let inertia = [[0.8, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 2.1]];
    scene
        .add(
            Body::with_inertia("satellite", 20.0, inertia)
                .position([10.0, 0.0, 0.0])
                .velocity([0.0, 10.0, 0.0])
                .angular_velocity([0.1, 0.2, 1.0]),
        )
        .unwrap();
    scene.add_effect(PointGravity::new(1000.0, [0.0; 3]));
    let run = super::run(&scene, 6.0, Method::Rk4, 1e-3);
    let n = run.times().len() - 1;
    let (start, end) = (run.total(0, [0.0; 3]).angular_momentum, run.total(n, [0.0; 3]).angular_momentum);
    assert!((start - end).norm() < 1e-9 * start.norm(), "{:e}", (start - end).norm());
    assert!(run.energy().unwrap().drift() < 1e-9 * 1000.0);
}

#[test]
fn freedoms_leave_effects_alone() {
    // a pendulum on an axle: same audit as a free body
    let mut scene = Scene::new();
    let inertia = [[0.8, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, 2.1]];
    let body = Body::with_inertia("body", 2.0, inertia).freedom(Freedom::axle([0.1, 0.0, 0.5], [0.0, 1.0, 0.0]));
    scene.add(body.angular_velocity([0.0, 2.0, 0.0])).unwrap();
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    scene.add_effect(Drag::new(0.1, 0.05).angular(0.2, 0.1));
    let (coarse, fine) = (audit(&scene, 1e-2), audit(&scene, 2.5e-3));
    assert!(coarse < 1e-6 && fine < coarse / 100.0, "{coarse:e} then {fine:e}");
}
