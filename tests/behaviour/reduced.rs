//! Bodies of fewer freedoms that meet others, in whole runs against closed forms; each formula stands in its test.
//!
//! Tolerances are relative to the case's own speeds, sizes and times: 1e-12 of impulses, energies and momenta, 1e-9 of
//! what a run at a tolerance of 1e-9 is integrated to.

use super::meeting::{close, last, run, scene};
use bryla::math::{Matrix3, Vector3};
use bryla::{
    Body, Cuboid, Cylinder, EventKind, Freedom, HalfSpace, Orientation, RunOptions, Scene, Sphere, Thruster,
    Trajectory, UniformGravity,
};
use bryla::{Finder, Method, reference};

const TIGHT: f64 = 1e-12;
const CLOSE: f64 = 1e-9;
const PLANE: [f64; 3] = [0.0, 0.0, 1.0];

/// A wall whose free side is x < `x`.
fn wall(x: f64) -> Body {
    Body::new("wall", HalfSpace::new([-1.0, 0.0, 0.0], -x)).fixed()
}

/// Inertia about the centre of mass, world axes.
fn inertia(motion: &bryla::BodyMotion) -> Matrix3 {
    motion.rotation * motion.inertia_body * motion.rotation.transpose()
}

#[test]
fn a_hovercraft_hits_a_wall_off_centre() {
    // in the plane j = −(1 + e) u_n/(1/m + (r × n)²_z/I_zz), I_zz = z·R I Rᵀ z, also where z is no principal axis and
    // the corner is not in the plane of the centre of mass; gravity is held by the plane
    let (m, half) = (400.0, [2.0, 1.0, 0.4]);
    for (q, spin, e) in [
        ([0.9, 0.0, 0.0, 0.4358898943540674], 0.0, 1.0),
        ([0.9, 0.0, 0.0, 0.4358898943540674], 0.7, 0.5),
        ([0.8, 0.3, 0.4, 0.3316624790355], -0.4, 1.0),
        ([0.8, 0.3, 0.4, 0.3316624790355], 0.4, 0.0),
    ] {
        let hull = Body::new("hull", Cuboid::new(half)).mass(m).orientation(q).velocity([3.0, 0.5, 0.0]);
        let hull = hull.angular_velocity([0.0, 0.0, spin]).freedom(Freedom::planar(PLANE)).restitution(e);
        let mut scene = scene([wall(5.0), hull]);
        scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
        let run = run(&scene, 1.5);
        let event = &run.events()[0];
        let there = bryla::Trajectory::at(&run, event.time).unwrap()[1];
        let motion = run.plan().bodies()[1].motion(&there, event.time);
        let (n, r) = (event.normal, event.point - motion.position);
        close(n, [-1.0, 0.0, 0.0], TIGHT);
        let moment = inertia(&motion).m33;
        let u = (event.velocity[0] + event.angular_velocity[0].cross(&r)).dot(&n);
        let lever = r.cross(&n).z;
        let j = -(1.0 + e) * u / (1.0 / m + lever * lever / moment);
        close(event.impulse, j * n, TIGHT * j);
        close(event.velocity[1], event.velocity[0] + j / m * n, TIGHT * 3.0);
        close(event.angular_velocity[1], [0.0, 0.0, spin + j * lever / moment], TIGHT * 3.0);
        if spin == 0.0 {
            // the corner that is farthest along x starts so far from the wall
            let corners = (0..8).map(|k| [0, 1, 2].map(|i| if k >> i & 1 == 0 { -half[i] } else { half[i] }));
            let start = run.motions(0)[1];
            let reach = corners.map(|c| start.point(&Vector3::from(c)).x).fold(f64::NEG_INFINITY, f64::max);
            assert!((event.time - (5.0 - reach) / 3.0).abs() < 1e-11, "{}", event.time);
        }
        let end = last(&run)[1];
        assert!(end.position.z == 0.0 && end.velocity.z == 0.0, "it stays in its plane");
        assert!(run.energy().unwrap().drift() < TIGHT * 9.0 * m, "{:e}", run.energy().unwrap().drift());
        if e == 1.0 {
            assert!(event.energy_lost.abs() < TIGHT * 9.0 * m);
        }
    }
}

#[test]
fn a_disc_in_a_plane_grips_or_slips_at_a_wall() {
    // grip: j_t = u_t/(1/m + r²/I), I = ½ m r²; slip: j_t = μ j_n, against the slip of the rim u_t = v_y + ω r
    let (m, r, v, e) = (2.0, 0.3, [3.0, 1.0], 0.8);
    for (spin, friction) in [(4.0, 0.9), (4.0, 0.05), (-30.0, 0.9), (-30.0, 0.1)] {
        let disc = Body::new("disc", Cylinder::new(r, 0.05)).mass(m).velocity([v[0], v[1], 0.0]);
        let disc = disc.angular_velocity([0.0, 0.0, spin]).freedom(Freedom::planar(PLANE));
        let run = run(&scene([wall(1.0).friction(friction), disc.restitution(e).friction(friction)]), 0.5);
        let event = &run.events()[0];
        let normal = (1.0 + e) * m * v[0];
        let slip = v[1] + spin * r;
        let grip = slip / (1.0 / m + r * r / (0.5 * m * r * r));
        let rubbed = grip.abs().min(friction * normal).copysign(grip);
        close(event.impulse, [-normal, -rubbed, 0.0], TIGHT * normal);
        close(event.angular_velocity[1], [0.0, 0.0, spin - rubbed * r / (0.5 * m * r * r)], TIGHT * 30.0);
        assert!((event.time - (1.0 - r) / v[0]).abs() < 1e-11);
    }
}

#[test]
fn two_discs_in_a_plane_keep_momentum_and_energy() {
    // the normal of two balls is exact, that of other round bodies right to FEATURE_ANGLE
    let shapes = [(true, TIGHT), (false, bryla::tolerance::FEATURE_ANGLE)];
    for (friction, (is_ball, exact)) in [0.0, 0.3].into_iter().flat_map(|friction| shapes.map(|s| (friction, s))) {
        let disc = |name: &str, r: f64, m: f64| {
            let body = if is_ball { Body::new(name, Sphere::new(r)) } else { Body::new(name, Cylinder::new(r, 0.1)) };
            body.mass(m).freedom(Freedom::planar(PLANE)).restitution(1.0)
        };
        let a = disc("a", 0.2, 1.0).velocity([2.0, 0.1, 0.0]).angular_velocity([0.0, 0.0, 5.0]).friction(friction);
        let b = disc("b", 0.3, 2.5).position([1.5, 0.3, 0.0]).velocity([-1.0, 0.0, 0.0]).friction(friction);
        let run = run(&scene([a, b]), 1.5);
        let [event] = run.events() else { panic!("{} events", run.events().len()) };
        let total = |motions: &[bryla::BodyMotion]| {
            let p: Vector3 = motions.iter().map(|b| b.mass * b.velocity).sum();
            let l: f64 =
                motions.iter().map(|b| (b.angular_momentum() + b.position.cross(&(b.mass * b.velocity))).z).sum();
            let energy: f64 = motions.iter().map(bryla::BodyMotion::kinetic_energy).sum();
            (p, l, energy)
        };
        let ((p0, l0, e0), (p1, l1, e1)) = (total(&run.motions(0)), total(&last(&run)));
        close(p1, p0, TIGHT * p0.norm());
        assert!((l1 - l0).abs() < TIGHT * 2.0, "{:e}", l1 - l0);
        assert!((e1 + event.energy_lost - e0).abs() < TIGHT * e0, "{:e}", e1 + event.energy_lost - e0);
        assert!(run.energy().unwrap().drift() < TIGHT * e0);
        if friction == 0.0 {
            // along the line of centres velocities swap by their masses, across it they stay
            let [a, b] = [0, 1].map(|i| run.at(event.time).unwrap()[i].position);
            let (m, n) = ([1.0, 2.5], (b - a).normalize());
            let u = (event.velocity[0] - event.other_velocity[0]).dot(&n);
            let j = -2.0 * u / (1.0 / m[0] + 1.0 / m[1]);
            close(event.impulse, j * n, exact * j);
            assert!(event.energy_lost.abs() < TIGHT * e0);
            assert!(event.angular_velocity[1].norm() < exact * 10.0);
        }
    }
}

/// A rod that hangs from the origin, turned by `angle` about y, and turns at `spin`; held as `freedom` says.
fn rod(half: [f64; 3], mass: f64, (angle, spin): (f64, f64), freedom: Freedom) -> Body {
    let center = [-half[2] * angle.sin(), 0.0, -half[2] * angle.cos()];
    let rod = Body::new("rod", Cuboid::new(half)).mass(mass).position(center);
    let rod = rod.orientation([(0.5 * angle).cos(), 0.0, (0.5 * angle).sin(), 0.0]);
    rod.angular_velocity([0.0, spin, 0.0]).freedom(freedom)
}

#[test]
fn a_swinging_rod_hits_a_ball_with_no_shock_to_its_axle_at_the_centre_of_percussion() {
    // I = M (L² + b²)/12 + M L²/4 about the end; at the depth d
    //   j = (1 + e) ω d/(1/m + d²/I)      ω⁺ = ω − j d/I      on the axle: R = j (1 − d M L/2 / I), 0 at d = I/(M L/2)
    let (half, mass, m, r, w) = ([0.02, 0.03, 0.5], 1.5, 0.4, 0.05, 3.0);
    let (length, thickness) = (2.0 * half[2], 2.0 * half[0]);
    let moment = mass * (length * length + thickness * thickness) / 12.0 + 0.25 * mass * length * length;
    let percussion = moment / (mass * half[2]);
    let held = [Freedom::axle([0.0, 0.0, half[2]], [0.0, 1.0, 0.0]), Freedom::pivot([0.0, 0.0, half[2]])];
    for freedom in held {
        for (depth, e) in [(percussion, 1.0), (percussion, 0.3), (0.4, 1.0), (0.95, 0.6)] {
            // it touches when it hangs straight down
            let angle = 0.3;
            let rod = rod(half, mass, (angle, -w), freedom.clone()).restitution(e);
            let ball = Body::new("ball", Sphere::new(r)).mass(m).position([half[0] + r, 0.0, -depth]);
            let run = run(&scene([rod, ball]), 0.3);
            let event = &run.events()[0];
            assert!((event.time - angle / w).abs() < 1e-11, "{}", event.time);
            let j = (1.0 + e) * w * depth / (1.0 / m + depth * depth / moment);
            close(event.impulse, [j, 0.0, 0.0], 1e-11 * j);
            close(event.velocity[1], [j / m, 0.0, 0.0], 1e-11 * j / m);
            close(event.other_angular_velocity[1], [0.0, -w + j * depth / moment, 0.0], 1e-11 * w);
            let shock = mass * (event.other_velocity[1] - event.other_velocity[0]) + event.impulse;
            close(shock, [j * (1.0 - depth * mass * half[2] / moment), 0.0, 0.0], 1e-11 * j);
            if depth == percussion {
                assert!(shock.norm() < 1e-11 * j, "{:e}", shock.norm());
            }
            let lost = 0.5 * (1.0 - e * e) * (w * depth) * (w * depth) / (1.0 / m + depth * depth / moment);
            assert!((event.energy_lost - lost).abs() < 1e-11 * mass * w * w);
            assert!(run.energy().unwrap().drift() < 1e-11 * mass * w * w);
        }
    }
}

#[test]
fn a_ball_pushes_a_door_open() {
    // j = (1 + e) v/(1/m + d²/I), I = M ((2a)² + (2b)²)/12 + M a² about the hinge; the free edge moves on with the door
    let (half, mass, m, r, v) = ([0.4, 0.02, 1.0], 20.0, 0.5, 0.1, 4.0);
    let moment = mass * (half[0] * half[0] + half[1] * half[1]) / 3.0 + mass * half[0] * half[0];
    for (d, z, e) in [(0.7, 0.0, 0.5), (0.2, 0.6, 1.0)] {
        let door = Body::new("door", Cuboid::new(half)).mass(mass).position([half[0], 0.0, 0.0]);
        let door = door.freedom(Freedom::axle([-half[0], 0.0, 0.0], PLANE));
        let ball = Body::new("ball", Sphere::new(r)).mass(m).position([d, 1.0, z]).velocity([0.0, -v, 0.0]);
        let run = run(&scene([door, ball.restitution(e)]), 0.5);
        let event = &run.events()[0];
        assert!((event.time - (1.0 - r - half[1]) / v).abs() < 1e-11);
        let j = (1.0 + e) * v / (1.0 / m + d * d / moment);
        close(event.impulse, [0.0, j, 0.0], TIGHT * j);
        close(event.other_angular_velocity[1], [0.0, 0.0, -j * d / moment], TIGHT * v);
        // it turns on, steadily
        let end = last(&run)[0];
        let angle = -j * d / moment * (0.5 - event.time);
        close(end.position, half[0] * Vector3::new(angle.cos(), angle.sin(), 0.0), 1e-11);
        assert!(run.energy().unwrap().drift() < TIGHT * m * v * v);
    }
}

#[test]
fn a_top_that_hits_a_ball_keeps_the_angular_momentum_about_its_point() {
    // its point bears any force, which has no moment there; three different moments of inertia, and friction
    for friction in [0.0, 0.4] {
        let (half, point) = ([0.1, 0.2, 0.4], [-0.1, 0.05, -0.4]);
        let turn = [0.9, 0.2, -0.3, 0.2449489742783178];
        let top = Body::new("top", Cuboid::new(half)).mass(3.0).freedom(Freedom::pivot(point)).friction(friction);
        let top = top.orientation(turn).angular_velocity([1.0, -2.0, 3.0]);
        // towards the middle of its lower half
        let pivot = bryla::math::quaternion::rotate(&bryla::math::quaternion::from_scalar_first(turn), &point.into());
        let start: Vector3 = 0.5 * pivot + Vector3::new(0.8, 0.1, 0.05);
        let ball = Body::new("ball", Sphere::new(0.1)).mass(0.7).position(start).friction(friction);
        let ball = ball.velocity([-4.0, -0.2, 0.1]).angular_velocity([5.0, 0.0, -9.0]).restitution(0.8);
        let run = run(&scene([top, ball]), 0.6);
        let event = &run.events()[0];
        let states = run.at(event.time).unwrap();
        let [top, ball] = [0, 1].map(|i| run.plan().bodies()[i].motion(&states[i], event.time));
        let about = |v: [Vector3; 2], w: [Vector3; 2]| -> Vector3 {
            let of = |(body, (v, w)): (&bryla::BodyMotion, (&Vector3, &Vector3))| {
                inertia(body) * w + (body.position - pivot).cross(&(body.mass * v))
            };
            [&top, &ball].into_iter().zip(v.iter().zip(&w)).map(of).sum()
        };
        let [before, after] = [0, 1].map(|i| {
            let v = [event.other_velocity[i], event.velocity[i]];
            about(v, [event.other_angular_velocity[i], event.angular_velocity[i]])
        });
        close(after, before, TIGHT * before.norm());
        // and the point rests
        let held = event.other_velocity[1] + event.other_angular_velocity[1].cross(&(pivot - top.position));
        assert!(held.norm() < TIGHT * 3.0, "{:e}", held.norm());
        assert!(event.impulse.norm() > 0.1 && run.energy().unwrap().drift() < 1e-9);
    }
}

#[test]
fn a_floor_that_a_hovercraft_glides_over_in_its_plane_changes_nothing() {
    // what touches without an impulse that could move it is no contact, whatever its friction
    let hull = Body::new("hull", Cuboid::new([2.0, 1.0, 0.4])).mass(400.0).position([0.0, 0.0, 0.4]);
    let hull = hull.orientation([0.9, 0.0, 0.0, 0.4358898943540674]).velocity([3.0, 0.5, 0.0]);
    let hull = hull.freedom(Freedom::planar(PLANE)).restitution(0.5).friction(0.5);
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(0.5);
    let mut alone = scene([wall(5.0), hull]);
    alone.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    let mut above = alone.clone();
    above.add(floor).unwrap();
    let [alone, above] = [alone, above].map(|scene| quick(&scene, 4.0));
    let [a, b] = [&alone, &above].map(|run| last(run)[1]);
    close(a.position, b.position, CLOSE);
    close(a.angular_velocity, b.angular_velocity, CLOSE);
}

/// A bob at the end of a massless rod of length `l` from a point at the origin.
fn bob(l: f64, r: f64, angle: f64, freedom: Freedom) -> Body {
    let bob = Body::new("bob", Sphere::new(r)).mass(1.0).position([-l * angle.sin(), 0.0, -l * angle.cos()]);
    bob.orientation([(0.5 * angle).cos(), 0.0, (0.5 * angle).sin(), 0.0]).freedom(freedom)
}

#[test]
fn the_error_of_an_elastic_pendulum_at_a_wall_is_within_its_estimate() {
    // the wall stands where it hangs: what would be the other half of each swing is the mirror image, −|θ(t)|
    let (l, r, g, angle) = (1.0, 0.1, 9.81, 1.1);
    let moment: f64 = 0.4 * r * r + l * l;
    let truth = reference::Pendulum::new((g * l / moment).sqrt(), angle, 0.0);
    let held = [Freedom::axle([0.0, 0.0, l], [0.0, 1.0, 0.0]), Freedom::pivot([0.0, 0.0, l])];
    for freedom in held {
        let mut scene = scene([wall(r), bob(l, r, angle, freedom).restitution(1.0)]);
        scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
        for tolerance in [1e-6, 1e-9] {
            let times: Vec<f64> = (0..=40).map(|k| 0.25 * f64::from(k)).collect();
            let run = scene.run(0.0..10.0, &RunOptions::tolerance(tolerance).t_eval(times)).unwrap();
            assert_eq!(run.events().iter().filter(|e| e.kind == EventKind::Bounce).count(), 9);
            let error = |(k, t): (usize, &f64)| {
                let leans = truth.at(*t).0.abs();
                let place = l * Vector3::new(-leans.sin(), 0.0, -leans.cos());
                let bob = run.motions(k)[1];
                let turned = bryla::math::quaternion::from_axis_angle(&Vector3::y(), leans);
                let turned = bryla::math::quaternion::angle_between(&bob.orientation, &turned);
                ((bob.position - place).norm() / run.report().length_scale).max(turned)
            };
            let worst = run.times().iter().enumerate().map(error).fold(0.0, f64::max);
            let estimate = run.report().error_estimate.unwrap();
            assert!(run.report().met.unwrap(), "{estimate:e}");
            assert!(worst <= estimate && estimate <= tolerance, "{worst:e} against {estimate:e}");
        }
    }
}

#[test]
fn the_lectures_finders_see_what_the_guaranteed_one_sees() {
    let gravity = UniformGravity::new([0.0, 0.0, -9.81]);
    let held = [
        Freedom::axle([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
        Freedom::pivot([0.0, 0.0, 1.0]),
        Freedom::planar([0.0, 1.0, 0.0]),
    ];
    for freedom in held {
        let mut scene = scene([wall(0.1), bob(1.0, 0.1, 0.8, freedom).restitution(0.7)]);
        scene.add_effect(gravity.clone());
        if scene.bodies[1].freedom == Freedom::planar([0.0, 1.0, 0.0]) {
            scene.bodies[1].velocity = Some([1.0, 0.0, 0.0]);
        }
        let end = |options: RunOptions| last(&scene.run(0.0..1.5, &options.estimate(false)).unwrap())[1];
        let truth = end(RunOptions::tolerance(1e-11));
        for orientation in [Orientation::Quaternion, Orientation::Matrix] {
            for finder in [Finder::Bisection, Finder::Secant] {
                let options = RunOptions::method(Method::Heun).step(1e-3).finder(finder).orientation(orientation);
                // truncation of Heun's method: the square of 1e-3 s times a few m/s²
                close(end(options).position, truth.position, 1e-5);
            }
        }
    }
}

/// Runs without an estimate.
fn quick(scene: &Scene, end: f64) -> Trajectory {
    match scene.run(0.0..end, &RunOptions::tolerance(1e-9).estimate(false)) {
        Ok(run) => run,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn a_block_in_a_plane_slides_and_rests_as_a_free_one() {
    // a = g (sin − μ cos) down the slope where it slides; below the angle of friction it does not move
    let (g, slope) = (10.0, 0.3_f64);
    for part in [0.0, 0.5, 1.5] {
        let friction = part * slope.tan();
        let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(friction);
        let block = Body::new("block", Cuboid::new([0.1, 0.1, 0.05])).mass(1.0).position([0.0, 0.0, 0.05]);
        let block = block.friction(friction).freedom(Freedom::planar([0.0, 1.0, 0.0]));
        let mut scene = scene([floor, block]);
        scene.add_effect(UniformGravity::new([g * slope.sin(), 0.0, -g * slope.cos()]));
        let run = quick(&scene, 1.0);
        let a = if part < 1.0 { g * (slope.sin() - friction * slope.cos()) } else { 0.0 };
        let end = last(&run)[1];
        close(end.position, [0.5 * a, 0.0, 0.05], CLOSE);
        close(end.velocity, [a, 0.0, 0.0], CLOSE * g);
        assert!(run.energy().unwrap().drift() < TIGHT * g, "{:e}", run.energy().unwrap().drift());
    }
}

#[test]
fn a_ball_in_a_plane_rolls_down_a_slope_turn_after_turn() {
    // a = 5/7 g sin, and it has turned by the way over its radius, also between the steps
    let (g, slope, r) = (10.0, 0.2_f64, 0.1);
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(0.5);
    let ball = Body::new("ball", Sphere::new(r)).mass(1.0).position([0.0, 0.0, r]).friction(0.5);
    let mut scene = scene([floor, ball.freedom(Freedom::planar([0.0, 1.0, 0.0]))]);
    scene.add_effect(UniformGravity::new([g * slope.sin(), 0.0, -g * slope.cos()]));
    let run = quick(&scene, 2.0);
    for t in (0..=20_000).map(|k| 1e-4 * f64::from(k)) {
        let (way, ball) = (0.5 * 5.0 / 7.0 * g * slope.sin() * t * t, run.at(t).unwrap()[1]);
        close(ball.position, [way, 0.0, r], 1e-8);
        let turned = bryla::math::quaternion::from_axis_angle(&Vector3::y(), way / r);
        assert!(bryla::math::quaternion::angle_between(&ball.orientation, &turned) < 1e-7, "t = {t}");
    }
    assert!(last(&run)[1].position.x / r > 2.0 * std::f64::consts::TAU);
}

#[test]
fn a_pushed_hovercraft_slides_along_a_wall_to_where_friction_stops_it() {
    // pushed against the wall by F its friction is μ F: it stops after v²/(2 μ F/m), at t = v m/(μ F), and rests
    let (m, v, friction, push) = (2.0, 1.5, 0.4, 5.0);
    let hull = Body::new("hull", Cuboid::new([0.2, 0.1, 0.1])).mass(m).position([0.8, 0.0, 0.0]);
    let hull = hull.velocity([0.0, v, 0.0]).friction(friction).freedom(Freedom::planar(PLANE));
    let mut scene = scene([wall(1.0).friction(friction), hull]);
    scene.add_effect(Thruster::new("hull", [0.0, 0.0, 0.0], [push, 0.0, 0.0]));
    let run = quick(&scene, 2.0);
    let stop = v * m / (friction * push);
    let rest = run.events().iter().find(|event| event.kind == EventKind::Rest).unwrap();
    assert!((rest.time - stop).abs() < 1e-8, "{} against {stop}", rest.time);
    close(last(&run)[1].position, [0.8, 0.5 * v * stop, 0.0], 1e-8);
    assert!(run.energy().unwrap().drift() < CLOSE * m * v * v);
}

#[test]
fn a_pendulum_comes_to_rest_on_a_wall_that_it_leans_on() {
    let (l, r, g) = (1.0, 0.1, 9.81);
    let held = [Freedom::axle([0.0, 0.0, l], [0.0, 1.0, 0.0]), Freedom::pivot([0.0, 0.0, l])];
    for freedom in held {
        // it hangs at x = −0.2 m with its bob on the wall
        let mut scene = scene([wall(r - 0.2), bob(l, r, 0.9, freedom).restitution(0.4)]);
        scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
        let run = quick(&scene, 5.0);
        assert_eq!(run.events().last().unwrap().kind, EventKind::Rest);
        let end = last(&run)[1];
        assert_eq!((end.velocity, end.angular_velocity), (Vector3::zeros(), Vector3::zeros()));
        close(end.position, [-0.2, 0.0, -(l * l - 0.04_f64).sqrt()], 1e-9);
        assert!(run.energy().unwrap().drift() < CLOSE * g, "{:e}", run.energy().unwrap().drift());
    }
}

#[test]
fn a_seesaw_tips_with_the_box_on_it() {
    // while the box sticks both turn as one: ω² = 2 m g (h₀ − h)/(I + I_box + m (d² + h₀²)), h that of the box
    let (half, mass, side, m, d, g) = ([1.0, 0.2, 0.05], 6.0, 0.1, 2.0, 0.5, 9.81);
    let plank = Body::new("plank", Cuboid::new(half)).mass(mass).friction(1.0);
    let plank = plank.freedom(Freedom::axle([0.0; 3], [0.0, 1.0, 0.0]));
    let high = half[2] + side;
    let load = Body::new("box", Cuboid::new([side; 3])).mass(m).position([d, 0.0, high]).friction(1.0);
    let mut scene = scene([plank, load]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
    let run = quick(&scene, 0.4);
    let [plank, load] = last(&run)[..] else { panic!() };
    let angle = bryla::math::quaternion::log(&plank.orientation).y;
    assert!(angle > 0.2, "{angle}");
    close(load.position, [d * angle.cos() + high * angle.sin(), 0.0, high * angle.cos() - d * angle.sin()], 1e-9);
    let moment = mass * (half[0] * half[0] + half[2] * half[2]) / 3.0;
    let moment = moment + m * (2.0 / 3.0 * side * side + d * d + high * high);
    let w = (2.0 * m * g * (high - load.position.z) / moment).sqrt();
    close(plank.angular_velocity, [0.0, w, 0.0], 1e-7 * w);
    close(load.angular_velocity, [0.0, w, 0.0], 1e-7 * w);

    // two boxes that balance rest
    scene.add(Body::new("other", Cuboid::new([side; 3])).mass(m).position([-d, 0.0, high]).friction(1.0)).unwrap();
    let run = quick(&scene, 0.4);
    assert!(last(&run).iter().all(|body| body.velocity == Vector3::zeros()));
    assert_eq!(run.events().last().unwrap().kind, EventKind::Rest);
}

#[test]
fn a_ball_on_a_string_circles_on_a_smooth_floor() {
    // about a pivot at the height h above the ball's centre the ball slides round at ω while ω² < g/h, and the floor
    // carries the rest
    let (h, rho, r, g, w) = (0.4, 0.3, 0.1, 9.81, 3.0);
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed();
    let ball = Body::new("ball", Sphere::new(r)).mass(1.0).position([rho, 0.0, r]).angular_velocity([0.0, 0.0, w]);
    let mut scene = scene([floor, ball.freedom(Freedom::pivot([-rho, 0.0, h]))]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
    let run = quick(&scene, 3.0);
    let end = last(&run)[1];
    // steps of order 4 of 0.04 in the turning: 1e-7 of the way round
    close(end.position, [rho * (w * 3.0).cos(), rho * (w * 3.0).sin(), r], 1e-6);
    close(end.angular_velocity, [0.0, 0.0, w], 1e-6 * w);
    assert!(run.energy().unwrap().drift() < 1e-6);
}

#[test]
fn the_hovercraft_in_its_arena_moves_as_a_free_one_that_nothing_tips() {
    let planar = bryla::catalogue::hovercraft_walls().unwrap();
    let mut free = planar.clone();
    free.bodies.last_mut().unwrap().freedom = Freedom::Free;
    let options = RunOptions::tolerance(1e-9);
    let [planar, free] = [planar, free].map(|scene| scene.run(0.0..20.0, &options).unwrap());
    let [hull, other] = [&planar, &free].map(|run| *last(run).last().unwrap());
    let bounces = |run: &Trajectory| run.events().iter().filter(|event| event.kind == EventKind::Bounce).count();
    assert!(bounces(&planar) >= 3 && bounces(&planar) == bounces(&free));
    // both are off by as much as they say
    let apart = planar.report().error_estimate.unwrap() + free.report().error_estimate.unwrap();
    close(hull.position, other.position, apart * planar.report().length_scale);
    assert!(bryla::math::quaternion::angle_between(&hull.orientation, &other.orientation) <= apart);
    assert!(planar.report().met.unwrap() && planar.energy().unwrap().drift() < 1e-6);
}

#[test]
fn a_run_that_ends_within_the_step_of_a_contact_ends_where_the_step_begins() {
    // a top whose rim digs in: no forces meet the laws of contact (Painlevé 1895) in the step that the blow begins
    let floor = Body::new("floor", HalfSpace::new(PLANE, -3.0)).fixed().friction(0.2).restitution(1.0);
    let top = Body::new("top", Cylinder::new(0.20594646981027695, 0.379829544612236)).mass(1.72).friction(0.2);
    let top = top.position([-1.5, 0.0, -1.5]).angular_velocity([3.207237, 2.553554, 2.052431]);
    let top = top.orientation([-0.6780660440505177, -0.006410501777162615, -0.08498806558317475, -0.7300427207232988]);
    let point = [0.03436994479728672, -0.018516085427670248, -0.5787183022104724];
    let mut scene = scene([floor, top.freedom(Freedom::pivot(point))]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    let broken = scene.run(0.0..1.0, &RunOptions::tolerance(1e-9).estimate(false)).unwrap_err();
    let bryla::RunError::Simulation(error) = broken else { panic!("{broken}") };
    let run = error.trajectory.unwrap();
    assert!(error.kind.to_string().contains("Painlevé"));
    assert_eq!((run.events()[0].kind, run.events()[1].kind), (EventKind::Bounce, EventKind::Contact));
    assert_eq!(error.time, run.events()[1].time);
    assert!(run.energy().unwrap().drift() < 1e-6);
}
