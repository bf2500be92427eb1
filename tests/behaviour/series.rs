//! Power series: every load and every freedom, any order, and what has none.

use super::{distance, free_body, last, run};
use bryla::math::{Vector3, quaternion};
use bryla::{
    Body, Drag, Frame, Freedom, Method, PointGravity, Record, RunOptions, Scene, Spring, Thruster, UniformGravity,
    UserEffect, Wrench,
};

const FREEDOMS: [fn() -> Freedom; 4] = [
    || Freedom::Free,
    || Freedom::pivot([0.2, -0.1, 0.3]),
    || Freedom::planar([0.3, 0.5, -0.8]),
    || Freedom::axle([0.2, -0.1, 0.3], [0.5, -0.2, 0.4]),
];

/// A body whose principal axes are not those of its shape, turned and moving as its freedom allows.
fn slanted(freedom: Freedom) -> Scene {
    let q = quaternion::normalized(&quaternion::from_scalar_first([0.8, 0.1, -0.5, 0.3]));
    let inertia = [[1.3, 0.2, -0.1], [0.2, 0.9, 0.15], [-0.1, 0.15, 1.6]];
    let body = Body::with_inertia("body", 2.0, inertia).orientation(quaternion::to_scalar_first(&q));
    let world = |v: [f64; 3]| -> [f64; 3] { quaternion::rotate(&q, &v.into()).into() };
    let body = match &freedom {
        Freedom::Free => body.angular_velocity([1.1, -0.7, 0.9]).velocity([0.3, -0.2, 0.5]),
        Freedom::Planar(_) => body.angular_velocity([0.3, 0.5, -0.8]).velocity([0.5, -0.3, 0.0]),
        Freedom::Axle(axle) => body.angular_velocity(world(axle.axis_body).map(|w| 2.0 * w)),
        Freedom::Pivot(_) => body.angular_velocity([1.1, -0.7, 0.9]),
    };
    let mut scene = Scene::new();
    scene.add(body.position([0.4, 0.1, -0.2]).freedom(freedom)).unwrap();
    scene
}

/// A load, and what it is called.
type Named = (&'static str, fn(&mut Scene));

/// What has a series, apart and together.
fn loads() -> Vec<Named> {
    vec![
        ("nothing", |_| {}),
        ("gravity", |s| s.add_effect(UniformGravity::new([0.3, -1.0, -9.81]))),
        ("drag", |s| s.add_effect(Drag::new(0.7, 0.0).angular(0.4, 0.0).wind([0.5, -1.0, 0.2]))),
        ("engine", |s| {
            let schedule = [(0.0, 1.0), (0.7, -0.4), (1.3, 0.0)];
            s.add_effect(Thruster::new("body", [0.1, 0.4, -0.2], [0.8, 0.3, 0.5]).schedule(schedule));
        }),
        ("wrench of the world", |s| s.add_effect(Wrench::new("body", [0.4, -0.3, 0.6], [0.5, 0.2, -0.4]))),
        ("wrench at a point of the world, swinging", |s| {
            let wrench = Wrench::new("body", [0.4, -0.3, 0.6], [0.5, 0.2, -0.4]).point([0.1, 0.3, -0.2]);
            s.add_effect(wrench.oscillating(1.7, 0.3));
        }),
        ("wrench of the body, swinging", |s| {
            let wrench = Wrench::new("body", [0.4, -0.3, 0.6], [0.5, 0.2, -0.4]).point([0.1, 0.3, -0.2]);
            s.add_effect(wrench.frame(Frame::Body).oscillating(1.7, 0.3));
        }),
        ("attraction", |s| s.add_effect(PointGravity::new(20.0, [4.0, -3.0, 2.0]).gradient_torque(false))),
        ("attraction and its gradient", |s| s.add_effect(PointGravity::new(20.0, [4.0, -3.0, 2.0]))),
        ("all of it", |s| {
            for (_, load) in &loads()[..9] {
                load(s);
            }
        }),
    ]
}

#[test]
fn every_load_moves_every_freedom_as_stage_by_stage_integration_does() {
    for freedom in FREEDOMS {
        for (name, load) in loads() {
            let mut scene = slanted(freedom());
            load(&mut scene);
            // both are right to rounding: steps of 2⁻⁸ s, in which nothing turns by more than 0.02 rad
            let step = 1.0 / 256.0;
            let [a, b] = [Method::Taylor, Method::Dop853].map(|method| run(&scene, 2.0, method, step));
            for sample in [57, 100, 200] {
                let apart = distance(&a.states(sample)[0], &b.states(sample)[0]);
                // some ε for each of 512 steps, compensated, on numbers of size 10
                assert!(apart < 2e-13, "{name} on a {} body: {apart:.1e}", freedom().name());
            }
        }
    }
}

#[test]
fn the_order_is_the_one_asked_for() {
    let mut scene = slanted(Freedom::Free);
    loads()[6].1(&mut scene);
    let truth = last(&run(&scene, 4.0, Method::Dop853, 4.0 / 4096.0));
    for order in [3, 4, 6, 8, 12, 16, 20] {
        let error = |n: u32| {
            let options = RunOptions::method(Method::Taylor).order(order).step(4.0 / f64::from(n)).estimate(false);
            distance(&last(&scene.run(0.0..4.0, &options).unwrap()), &truth)
        };
        // steps in the ratios 3 : 4 and 2 : 3, between errors where neither the next order nor rounding shows
        let errors = (2..16).flat_map(|k| [1 << k, 3 << (k - 1)]).map(|n| (n, error(n)));
        let window: Vec<_> = errors.filter(|&(_, e)| e < 1e-3 && e > 1e-11).collect();
        let [(first, coarse), .., (last, fine)] = window[window.len() / 3..] else {
            panic!("{order}: too few errors in the window: {window:?}")
        };
        let slope = (coarse / fine).ln() / (f64::from(last) / f64::from(first)).ln();
        let slack = if order <= 4 { 0.1 } else { 0.3 };
        assert!(slope >= f64::from(order) - slack, "order {order}: {slope:.2} over {window:?}");
        // no other order: at 16 and 20 the window is too narrow to tell its slope from above
        assert!(order > 12 || slope <= f64::from(order) + 1.5, "order {order}: {slope:.2} over {window:?}");
    }
}

#[test]
fn a_tolerance_calls_for_an_order_and_is_kept_by_few_steps() {
    let mut scene = slanted(Freedom::pivot([0.2, -0.1, 0.3]));
    loads()[1].1(&mut scene);
    let truth = run(&scene, 3.0, Method::Dop853, 1e-3);
    for (tolerance, order) in [(1e-3, 5), (1e-6, 8), (1e-9, 12), (1e-12, 15)] {
        let options = RunOptions { method: Some(Method::Taylor), ..RunOptions::tolerance(tolerance) };
        // finer runs follow, or not
        assert_eq!(scene.compile(&options).unwrap().order(), order);
        assert_eq!(scene.compile(&options.clone().estimate(false)).unwrap().order(), order + 6);
        let kept = scene.run(0.0..3.0, &options).unwrap();
        let error = (0..=200).map(|i| distance(&kept.states(i)[0], &truth.states(i)[0])).fold(0.0, f64::max);
        assert!(kept.report().met == Some(true) && error <= tolerance, "{tolerance:e}: {error:e} {}", kept.report());
        // a step within a seventh of the radius of convergence turns by a fraction of a radian
        assert!(kept.report().counts.steps < 200, "{tolerance:e}: {}", kept.report());
    }
}

#[test]
fn the_motion_within_a_step_is_the_series_itself() {
    // long steps, looked into at many places
    let mut scene = slanted(Freedom::Free);
    loads()[8].1(&mut scene);
    let options = RunOptions { method: Some(Method::Taylor), estimate: false, ..RunOptions::tolerance(1e-12) };
    let series = scene.run(0.0..2.0, &options).unwrap();
    let truth = run(&scene, 2.0, Method::Dop853, 1e-3);
    assert!(series.report().counts.steps < 25, "{}", series.report());
    for i in 0..=200 {
        let apart = distance(&series.states(i)[0], &truth.states(i)[0]);
        assert!(apart < 1e-12, "sample {i}: {apart:.1e}");
        // read from the series, divided by its length
        let length = series.states(i)[0].orientation.norm();
        assert!((length - 1.0).abs() <= 4.0 * f64::EPSILON, "sample {i}: {length}");
    }
}

#[test]
fn what_has_no_series_is_refused_by_name() {
    let taylor = RunOptions::method(Method::Taylor);
    let cases: [Named; 4] = [
        ("drag", |s| s.add_effect(Drag::new(0.1, 0.2))),
        ("drag", |s| s.add_effect(Drag::new(0.1, 0.0).angular(0.0, 0.1))),
        ("spring", |s| s.add_effect(Spring::to_world("body", [0.0; 3], 1.0))),
        ("user_effect", |s| s.add_effect(UserEffect::new(|_, _| Ok(vec![(Vector3::zeros(), Vector3::zeros())])))),
    ];
    for (name, load) in cases {
        let mut scene = free_body();
        load(&mut scene);
        let error = scene.compile(&taylor).unwrap_err().to_string();
        assert!(
            error.starts_with(&format!("run: method: taylor: the load of {name} on body is no power series")),
            "{error}"
        );
    }

    let refusal = |options: RunOptions| free_body().compile(&options).unwrap_err().to_string();
    assert!(refusal(taylor.clone().order(2)).contains("order must be from 3 to 40, got 2"));
    assert!(refusal(RunOptions::method(Method::Dmv).order(5)).contains("order must be 2, 4, 6, 8 or 10, got 5"));
    let others = refusal(RunOptions::method(Method::Rk4).order(4).step(0.1));
    assert!(others.contains("an order needs the method taylor or dmv"), "{others}");
}

#[test]
fn the_discrete_rotation_has_every_order_and_refuses_what_costs_it() {
    let mut scene = slanted(Freedom::Free);
    scene.add_effect(UniformGravity::new([0.3, -1.0, -9.81]));
    let truth = last(&run(&scene, 4.0, Method::Exact, 4.0));
    for order in [2, 4, 6, 8, 10] {
        let error = |n: u32| {
            let options = RunOptions::method(Method::Dmv).order(order).step(4.0 / f64::from(n)).estimate(false);
            distance(&last(&scene.run(0.0..4.0, &options).unwrap()), &truth)
        };
        // the first halving that ends in small errors, and before rounding
        let (mut n, mut coarse) = (8, error(8));
        while coarse > 1e-4 {
            (n, coarse) = (2 * n, error(2 * n));
        }
        let slope = (coarse / error(2 * n)).log2();
        assert!(
            (-0.3..0.6).contains(&(slope - f64::from(order))),
            "order {order}: {slope:.2} from {coarse:.1e} at {n}"
        );
    }

    // with torque, and with drag, even where the motion has a closed form
    let refusal = |load: fn(&mut Scene)| {
        let mut scene = slanted(Freedom::Free);
        load(&mut scene);
        scene.compile(&RunOptions::method(Method::Dmv).step(0.1)).unwrap_err().to_string()
    };
    let said = refusal(|s| s.add_effect(Wrench::new("body", [0.0; 3], [0.1, 0.0, 0.0])));
    assert!(said.contains("dmv: wrench on body may turn it"), "{said}");
    let said = refusal(|s| s.add_effect(Drag::new(0.1, 0.0)));
    assert!(said.contains("dmv: the load of drag depends on velocities"), "{said}");
}

#[test]
fn a_run_can_stop_at_any_time_and_go_on_with_the_same_bits() {
    let mut scene = slanted(Freedom::Free);
    loads()[3].1(&mut scene);
    let options = RunOptions::method(Method::Taylor).step(0.25).estimate(false).record(Record::Dense);
    let plan = scene.compile(&options).unwrap();
    let mut whole = plan.start(0.0).unwrap();
    whole.advance(2.0).unwrap();
    let mut parts = plan.start(0.0).unwrap();
    for t in [0.1, 0.7, 0.71, 1.6, 2.0] {
        parts.advance(t).unwrap();
    }
    assert_eq!(whole.state("body").unwrap(), parts.state("body").unwrap());
}
