//! Bodies that stay together: merged, at the end of their bounces, at rest, sliding, rolling.

use bryla::contact::accumulation::{Accumulation, rest_speed};
use bryla::contact::anchor::Anchor;
use bryla::contact::cluster::{ClusterBody, ClusterError, Contact};
use bryla::contact::joint::BreakingLoad;
use bryla::contact::rest::{Acceleration, Hold, Rest, Support, rest};
use bryla::contact::stick::{merge, stick_to_driven};
use bryla::math::{Matrix3, Vector3, quaternion};
use bryla::{BodyMotion, Load};

use super::{TIGHT, answer, ball, body, close, corners, cube, upright, vector};

const G: f64 = 9.81;

/// The accelerations of bodies that only weigh, `g` along a vector.
fn weighing(bodies: &[ClusterBody], g: &Vector3) -> Vec<Acceleration> {
    let of = |b: &ClusterBody| {
        if b.mobility.is_none() {
            return Acceleration::zero();
        }
        Acceleration::free(b, &Load { force: b.motion.mass * g, torque: Vector3::zeros() })
    };
    bodies.iter().map(of).collect()
}

fn holding(bodies: &[ClusterBody], supports: &[Support], g: &Vector3) -> Rest {
    rest(bodies, &weighing(bodies, g), supports, 1e-9).expect("an answer")
}

/// Four corners of b on a, rubbing.
fn on_four(bodies: &[ClusterBody], a: usize, b: usize, points: [Vector3; 4], mu: f64) -> Vec<Support> {
    let corner = |p| Support::corner_of_b(Contact::new(a, b, p, Vector3::z()).friction(mu), bodies);
    points.map(corner).to_vec()
}

#[test]
fn merging_keeps_momentum_and_angular_momentum_and_loses_the_relative_energy() {
    // two point-like bodies a distance d apart, one passing with v: they turn about the common centre with
    // ω = v/d, and lose nothing; with moments I each: ω = μ v d/(2 I + μ d²), μ = m₁ m₂/(m₁ + m₂), and the
    // loss is ½ μ v² 2 I/(2 I + μ d²)
    let (m1, m2, d, v) = (2.0, 3.0, 0.8, 5.0);
    let reduced = m1 * m2 / (m1 + m2);
    for i in [1e-9, 0.3] {
        let a = upright(m1, [i; 3], Vector3::zeros(), Vector3::zeros()).motion;
        let b = upright(m2, [i; 3], vector(d, 0.0, 0.0), vector(0.0, v, 0.0)).motion;
        let merged = merge(&[a, b]).unwrap();
        close(&merged.motion.position, &vector(m2 * d / (m1 + m2), 0.0, 0.0), TIGHT * d);
        close(&merged.motion.velocity, &vector(0.0, m2 * v / (m1 + m2), 0.0), TIGHT * v);
        let total = 2.0 * i + reduced * d * d;
        close(&merged.motion.angular_velocity, &vector(0.0, 0.0, reduced * v * d / total), TIGHT * v / d);
        let lost = 0.5 * reduced * v * v * 2.0 * i / total;
        // far below the energies themselves where I is small: 1e-12 of the loss
        assert!((merged.energy_lost - lost).abs() < TIGHT * lost, "{:e} is not {lost:e}", merged.energy_lost);
    }
}

#[test]
fn tumbling_bodies_merge_in_any_pose_and_merge_again() {
    let turns = [[0.3, 0.8, -0.2, 0.5], [0.9, 0.1, 0.4, 0.0], [0.1, -0.5, 0.5, 0.7]];
    let bodies: Vec<BodyMotion> = (0..3)
        .map(|k: usize| {
            let s = k as f64;
            let (x, v) = (vector(s, 0.3 * s, -0.5), vector(1.0 - s, 0.4, s));
            body(1.0 + s, [0.2, 0.3, 0.4], x, v, vector(3.0, s, -1.0), turns[k]).motion
        })
        .collect();
    let sums = |bodies: &[BodyMotion]| {
        bodies.iter().fold((Vector3::zeros(), Vector3::zeros(), 0.0), |(p, l, e), b| {
            let own = b.mass * b.velocity;
            (p + own, l + b.position.cross(&own) + b.angular_momentum(), e + b.kinetic_energy())
        })
    };
    let at_once = merge(&bodies).unwrap();
    let first = merge(&bodies[..2]).unwrap();
    let twice = merge(&[first.motion, bodies[2]]).unwrap();
    let before = sums(&bodies);
    for (whole, lost) in
        [(&at_once.motion, at_once.energy_lost), (&twice.motion, first.energy_lost + twice.energy_lost)]
    {
        let after = sums(&[*whole]);
        close(&after.0, &before.0, TIGHT * 10.0);
        close(&after.1, &before.1, TIGHT * 10.0);
        assert!((before.2 - lost - after.2).abs() < TIGHT * before.2);
    }
    close(&twice.motion.angular_velocity, &at_once.motion.angular_velocity, TIGHT * 3.0);

    // each member goes on from its own place, and turned with the whole it keeps its place in it
    for (member, own) in at_once.members.iter().zip(&bodies) {
        let moved = member.motion(&at_once.motion, own.mass, own.inertia_body);
        close(&moved.position, &own.position, TIGHT);
        assert!(quaternion::angle_between(&moved.orientation, &own.orientation) < 1e-14);
        close(&moved.velocity, &at_once.motion.velocity_at(&own.position), TIGHT * 10.0);
        close(&(own.mass * own.velocity + member.impulse), &(own.mass * moved.velocity), TIGHT * 10.0);
        close(&(own.angular_momentum() + member.angular_impulse), &moved.angular_momentum(), TIGHT * 10.0);
    }
    let parts: Vec<BodyMotion> =
        at_once.members.iter().zip(&bodies).map(|(m, b)| m.motion(&at_once.motion, b.mass, b.inertia_body)).collect();
    let together = sums(&parts);
    close(&together.1, &before.1, TIGHT * 10.0);
    assert!((together.2 - at_once.motion.kinetic_energy()).abs() < TIGHT * before.2);
    assert!(merge(&[]).is_none());
}

#[test]
fn a_body_that_sticks_to_a_turntable_goes_round_with_it() {
    let mut table = BodyMotion::at_rest(1.0, Matrix3::identity());
    table.angular_velocity = vector(0.0, 0.0, 2.0);
    let mut fly = ball(0.1, 0.01, vector(0.5, 0.0, 0.0), vector(0.0, 3.0, 0.0)).motion;
    let stuck = stick_to_driven(&mut fly, &table);
    close(&fly.velocity, &vector(0.0, 1.0, 0.0), TIGHT);
    close(&fly.angular_velocity, &table.angular_velocity, TIGHT);
    close(&stuck.impulse, &vector(0.0, -0.2, 0.0), TIGHT);
    // ½ m 2² + ½ · 2/5 m R² 2²
    assert!((stuck.energy_lost - (0.2 + 0.5 * 4e-6 * 4.0)).abs() < TIGHT);
    let joint = BreakingLoad { force: 10.0, torque: 0.1 };
    assert!(!joint.is_exceeded(&vector(6.0, 8.0, 0.0), &Vector3::zeros()));
    assert!(joint.is_exceeded(&vector(6.0, 8.1, 0.0), &Vector3::zeros()));
    assert!(joint.is_exceeded(&Vector3::zeros(), &vector(0.0, 0.11, 0.0)));
}

#[test]
fn bounces_of_a_ball_and_of_a_flat_cube_end_when_the_series_says() {
    // dropped from h: first touch √(2h/g), speeds eᵏ √(2gh), flights 2 eᵏ √(2h/g):
    // t* = √(2h/g) (1 + e)/(1 − e)
    let h = 0.7;
    let fall = (2.0 * h / G).sqrt();
    for e in [0.3, 0.5, 0.9] {
        let end = fall * (1.0 + e) / (1.0 - e);
        for cubical in [false, true] {
            let size = 0.05;
            let points = if cubical { corners(Vector3::zeros(), 2, size).to_vec() } else { vec![Vector3::zeros()] };
            let contacts: Vec<Contact> =
                points.iter().map(|p| Contact::new(0, 1, *p, Vector3::z()).restitution(e).friction(0.3)).collect();
            let (mut time, mut speed) = (fall, G * fall);
            let mut watch = Accumulation::new();
            let mut capture = None;
            for _ in 0..4 {
                capture = watch.book(time, 1e-9 * end);
                let down = vector(0.0, 0.0, -speed);
                let at = vector(0.0, 0.0, size);
                let falling = if cubical { cube(0.4, size, at, down) } else { ball(0.4, size, at, down) };
                let hit = answer(&[ClusterBody::fixed(), falling], &contacts);
                speed = hit.velocities[1].linear.z;
                time += 2.0 * speed / G;
            }
            let capture = capture.expect("four impacts of one ratio");
            assert!((capture.time - end).abs() < 1e-12 * end, "{} is not {end}", capture.time);
            assert!((capture.time - end).abs() < capture.error && capture.error < 1e-11 * end);
            assert!((capture.ratio - e).abs() < 1e-12);
        }
    }
    // what bounces below √(2 g ε) rises by less than ε
    let eps = 1e-13;
    let v = rest_speed(G, eps);
    assert!((v * v / (2.0 * G) - eps).abs() < 1e-15 * eps.sqrt());
}

#[test]
fn a_block_on_an_incline_sticks_below_the_angle_of_friction_and_slides_above() {
    // tan α < μ: friction m g sin α; above: a = g (sin α − μ cos α). The corners carry together m g cos α, and
    // the moment of friction about the centre is balanced by the lower ones
    let (mass, h, mu) = (1.3, 0.1, 0.4);
    for (tangent, sticks) in [(mu * (1.0 - 1e-6), true), (mu * (1.0 + 1e-6), false), (0.0, true), (1.0, false)] {
        let alpha = libm::atan(tangent);
        let (sin, cos) = libm::sincos(alpha);
        let bodies = [ClusterBody::fixed(), cube(mass, h, vector(0.0, 0.0, h), Vector3::zeros())];
        let supports = on_four(&bodies, 0, 1, corners(Vector3::zeros(), 2, h), mu);
        let held = holding(&bodies, &supports, &(G * vector(sin, 0.0, -cos)));
        let sum: Vector3 = held.forces.iter().sum();
        let slide = if sticks { 0.0 } else { G * (sin - mu * cos) };
        close(&held.accelerations[1].linear, &vector(slide, 0.0, 0.0), 1e-9 * G);
        assert!(held.accelerations[1].angular.norm() < 1e-9 * G / h);
        assert!((sum.z - mass * G * cos).abs() < 1e-9 * mass * G);
        assert!((sum.x + mass * (G * sin - slide)).abs() < 1e-9 * mass * G);
        for (hold, force) in held.holds.iter().zip(&held.forces) {
            match hold {
                Hold::Stick => assert!(sticks),
                Hold::Slide(way) => assert!(!sticks && (way - Vector3::x()).norm() < 1e-6),
                Hold::Separate => assert!(tangent == 1.0, "a corner lifts at {tangent}"),
            }
            assert!(libm::hypot(force.x, force.y) <= mu * force.z * (1.0 + 1e-12));
        }
    }
}

#[test]
fn what_slides_is_braked_and_what_turns_flat_on_the_floor_too() {
    // sliding along x with v: a = −μ g, whatever the slope of the pressure
    let (h, mu) = (0.1, 0.3);
    let sliding = cube(2.0, h, vector(0.0, 0.0, h), vector(0.5, 0.0, 0.0));
    let bodies = [ClusterBody::fixed(), sliding];
    let held = holding(&bodies, &on_four(&bodies, 0, 1, corners(Vector3::zeros(), 2, h), mu), &vector(0.0, 0.0, -G));
    close(&held.accelerations[1].linear, &vector(-mu * G, 0.0, 0.0), 1e-12 * G);
    assert!(held.holds.iter().all(|h| matches!(h, Hold::Slide(way) if (way - Vector3::x()).norm() < 1e-12)));

    // spinning on its four corners: each is braked against its own motion with μ N at the lever √2 h
    let mut spinning = cube(2.0, h, vector(0.0, 0.0, h), Vector3::zeros());
    spinning.motion.angular_velocity = vector(0.0, 0.0, 7.0);
    let bodies = [ClusterBody::fixed(), spinning];
    let held = holding(&bodies, &on_four(&bodies, 0, 1, corners(Vector3::zeros(), 2, h), mu), &vector(0.0, 0.0, -G));
    let moment = 2.0 * h * h / 1.5;
    let expected = -mu * 2.0 * G * 2f64.sqrt() * h / moment;
    close(&held.accelerations[1].angular, &vector(0.0, 0.0, expected), 1e-12 * expected.abs());
    close(&held.accelerations[1].linear, &Vector3::zeros(), 1e-12 * G);
}

#[test]
fn a_box_on_a_box_carries_its_weight_down() {
    // up to 1 : 1e6 (where rounding, 1e-16 times the ratio, still leaves 1e-9); each floor corner carries a quarter of both weights, each upper one a quarter of one
    let h = 0.1;
    for (low, high) in [(1.0, 1.0), (1.0, 1e4), (1.0, 1e6), (1e6, 1.0)] {
        let bodies = [
            ClusterBody::fixed(),
            cube(low, h, vector(0.0, 0.0, h), Vector3::zeros()),
            cube(high, h, vector(0.0, 0.0, 3.0 * h), Vector3::zeros()),
        ];
        let mut supports = on_four(&bodies, 0, 1, corners(Vector3::zeros(), 2, h), 0.5);
        supports.extend(on_four(&bodies, 1, 2, corners(vector(0.0, 0.0, 2.0 * h), 2, h), 0.5));
        let held = holding(&bodies, &supports, &vector(0.0, 0.0, -G));
        for k in 1..3 {
            assert!(held.accelerations[k].linear.norm() < 1e-9 * G, "{:?}", held.accelerations[k]);
            assert!(held.accelerations[k].angular.norm() < 1e-9 * G / h);
        }
        for k in 0..4 {
            assert!((held.forces[k].z - 0.25 * (low + high) * G).abs() < 1e-9 * (low + high) * G);
            assert!((held.forces[4 + k].z - 0.25 * high * G).abs() < 1e-9 * (low + high) * G);
        }
        assert!(held.holds.iter().all(|h| *h == Hold::Stick));
    }
}

#[test]
fn a_ball_rolls_down_an_incline_and_slips_where_it_is_too_steep() {
    // rolling: a = 5/7 g sin α while tan α ≤ 7/2 μ; slipping: a = g (sin α − μ cos α)
    let (radius, mu) = (0.05, 0.2);
    for (tangent, rolls) in [(0.3, true), (0.699, true), (0.701, false), (1.5, false)] {
        let (sin, cos) = libm::sincos(libm::atan(tangent));
        let mut rolling = ball(0.3, radius, vector(0.0, 0.0, radius), vector(0.8, 0.0, 0.0));
        rolling.motion.angular_velocity = vector(0.0, 0.8 / radius, 0.0);
        let bodies = [ClusterBody::fixed(), rolling];
        let contact = Contact::new(0, 1, Vector3::zeros(), Vector3::z()).friction(mu);
        let held = holding(&bodies, &[Support::ball_on_face(contact, &bodies, radius)], &(G * vector(sin, 0.0, -cos)));
        let expected = if rolls { 5.0 / 7.0 * G * sin } else { G * (sin - mu * cos) };
        close(&held.accelerations[1].linear, &vector(expected, 0.0, 0.0), 1e-12 * G);
        assert_eq!(held.holds[0] == Hold::Stick, rolls);
    }
}

#[test]
fn a_ball_leaves_a_ball_at_the_known_angle() {
    // a small ball slides without friction down a fixed one: at the angle θ from the top with the speed
    // v² = 2 g R (1 − cos θ), R the distance of the centres, the force is m g (3 cos θ − 2): it leaves at
    // cos θ = 2/3
    let (r1, r2, m) = (0.6, 0.2, 0.5);
    let big = r1 + r2;
    for cos in [0.99f64, 0.8, 0.667, 0.666, 0.5] {
        let sin = (1.0 - cos * cos).sqrt();
        let v = (2.0 * G * big * (1.0 - cos)).sqrt();
        let n = vector(sin, 0.0, cos);
        let bodies = [ClusterBody::fixed(), ball(m, r2, big * n, v * vector(cos, 0.0, -sin))];
        let contact = Contact::new(0, 1, r1 * n, n);
        let held = holding(&bodies, &[Support::ball_on_ball(contact, &bodies, r1, r2)], &vector(0.0, 0.0, -G));
        let force = (m * G * (3.0 * cos - 2.0)).max(0.0);
        assert!((n.dot(&held.forces[0]) - force).abs() < 1e-12 * m * G, "{:?} at {cos}", held.forces[0]);
        assert_eq!(held.holds[0] == Hold::Separate, cos < 2.0 / 3.0);
    }
}

#[test]
fn a_rod_that_falls_from_standing_pushes_the_floor_by_the_textbook_force() {
    // a thin rod (length 2 l) pivots about its lower end without slipping, released at rest at the angle θ from
    // the vertical: α = 3 g sin θ/(4 l), N = m g (1 − ¾ sin² θ), F = ¾ m g sin θ cos θ. With the spin ω it
    // turns towards the floor: N falls by m l ω² cos θ.
    let (m, l, theta) = (0.8, 0.7, 0.5);
    let (sin, cos) = libm::sincos(theta);
    for w in [0.0, 1.5] {
        let i = m * l * l / 3.0;
        let mut rod = upright(m, [i, i, 1e-9], l * vector(sin, 0.0, cos), l * w * vector(cos, 0.0, -sin));
        rod.motion.angular_velocity = vector(0.0, w, 0.0);
        let bodies = [ClusterBody::fixed(), rod];
        let foot = Contact::new(0, 1, Vector3::zeros(), Vector3::z()).friction(2.0);
        let held = holding(&bodies, &[Support::corner_of_b(foot, &bodies)], &vector(0.0, 0.0, -G));
        let alpha = 0.75 * G * sin / l;
        close(&held.accelerations[1].angular, &vector(0.0, alpha, 0.0), 1e-10 * G / l);
        let push =
            m * vector(0.75 * G * sin * cos - l * w * w * sin, 0.0, G * (1.0 - 0.75 * sin * sin) - l * w * w * cos);
        close(&held.forces[0], &push, 1e-10 * m * G);
        assert_eq!(held.holds[0], Hold::Stick);
    }
}

#[test]
fn painleve_s_rod_has_no_forces_and_says_so() {
    // a rod pushed over the floor leaning forward, 1 − 3 cos θ (μ sin θ − cos θ) < 0 with θ from the floor: the
    // normal force would have to be negative, since friction turns the rod into the floor (Painlevé 1895;
    // Stewart 2000). cos θ = 0.4, μ = 2: 1 + 3·0.16 − 3·2·0.4·0.917 < 0
    let (m, l, mu, cos) = (1.0, 0.5, 2.0, 0.4f64);
    let sin = (1.0 - cos * cos).sqrt();
    assert!(1.0 + 3.0 * cos * cos - 3.0 * mu * cos * sin < 0.0);
    let i = m * l * l / 3.0;
    let attempt = |w: f64, mu: f64| {
        // the foot slides along +x, the rod above it leaning back
        let mut rod = upright(m, [i, i, 1e-9], l * vector(-cos, 0.0, sin), vector(3.0, 0.0, 0.0));
        rod.motion.angular_velocity = vector(0.0, w, 0.0);
        // the foot does not leave or enter the floor
        rod.motion.velocity.z = -w * l * cos;
        let bodies = [ClusterBody::fixed(), rod];
        let foot = Contact::new(0, 1, Vector3::zeros(), Vector3::z()).friction(mu);
        let support = Support::corner_of_b(foot, &bodies);
        rest(&bodies, &weighing(&bodies, &vector(0.0, 0.0, -G)), &[support], 1e-9)
    };
    let answers = [attempt(0.0, mu), attempt(0.0, 0.3)];
    assert!(matches!(answers[0], Err(ClusterError::Inconsistent { .. })), "{:?}", answers[0]);
    assert!(answers[1].is_ok());
}

/// A gap [m] as a function of time [s].
type Gap<'a> = Box<dyn Fn(f64) -> f64 + 'a>;

#[test]
fn the_acceleration_of_the_gap_is_its_second_derivative() {
    // two bodies that fly and turn (equal moments, so ω stays); the gap as geometry sees it, its second
    // difference over h = 1e-4: truncation h² ω⁴ and rounding ε/h² leave 1e-6 of |ω|² · size. Pulled on towards a
    // with 90 m/s² the contact carries f = −u̇_n/W, which gives u̇_n back
    let fly = |x: Vector3, v: Vector3, w: Vector3| body(1.0, [1.0; 3], x, v, w, [1.0, 0.0, 0.0, 0.0]);
    let a = fly(vector(0.1, 0.2, -0.6), vector(0.3, -0.4, 0.2), vector(0.5, 1.0, -0.7));
    let b = fly(vector(-0.2, 0.1, 0.5), vector(-0.5, 0.6, 0.1), vector(-1.0, 0.4, 0.9));
    let bodies = [a, b];
    let turn = |k: usize, t: f64| quaternion::exp(&(t * bodies[k].motion.angular_velocity));
    let carried = |k: usize, p: &Vector3, t: f64| {
        let m = &bodies[k].motion;
        m.position + t * m.velocity + quaternion::rotate(&turn(k, t), &(p - m.position))
    };
    let direction = |k: usize, d: &Vector3, t: f64| quaternion::rotate(&turn(k, t), d);

    let p = vector(0.05, -0.1, 0.02);
    let n = vector(0.2, -0.3, 1.0).normalize();
    let (edge_a, edge_b) = (n.cross(&Vector3::x()), n.cross(&Vector3::y()));
    let (ra, rb) = (0.3, 0.2);
    let contact = || Contact::new(0, 1, p, n);
    let side = edge_a.cross(&edge_b).dot(&n).signum();
    let cases: [(&str, Support, Gap<'_>); 5] = [
        ("corner of b", Support::corner_of_b(contact(), &bodies), {
            Box::new(move |t| direction(0, &n, t).dot(&(carried(1, &p, t) - carried(0, &p, t))))
        }),
        ("corner of a", Support::corner_of_a(contact(), &bodies), {
            Box::new(move |t| direction(1, &n, t).dot(&(carried(1, &p, t) - carried(0, &p, t))))
        }),
        ("ball on face", Support::ball_on_face(contact(), &bodies, rb), {
            Box::new(move |t| direction(0, &n, t).dot(&(carried(1, &(p + rb * n), t) - carried(0, &p, t))) - rb)
        }),
        ("ball on ball", Support::ball_on_ball(contact(), &bodies, ra, rb), {
            Box::new(move |t| (carried(1, &(p + rb * n), t) - carried(0, &(p - ra * n), t)).norm() - ra - rb)
        }),
        ("edge on edge", Support::line_on_line(contact(), &bodies, [&edge_a, &edge_b], [0.0; 2]), {
            Box::new(move |t| {
                let across = side * direction(0, &edge_a, t).cross(&direction(1, &edge_b, t));
                across.normalize().dot(&(carried(1, &p, t) - carried(0, &p, t)))
            })
        }),
    ];
    let pull = 90.0;
    for (name, support, gap) in cases {
        let h = 1e-4;
        let second = (gap(h) - 2.0 * gap(0.0) + gap(-h)) / (h * h);
        let free = [Acceleration::zero(), Acceleration { linear: -pull * n, angular: Vector3::zeros() }];
        let held = rest(&bodies, &free, &[support], 1e-9).expect("an answer");
        let w: f64 = bodies.iter().map(|b| 1.0 + (p - b.motion.position).cross(&n).norm_squared()).sum();
        let found = pull - n.dot(&held.forces[0]) * w;
        assert!(second.abs() > 0.05 && (found - second).abs() < 1e-5, "{name}: {found} is not {second}");
    }
}

#[test]
fn the_acceleration_of_an_anchor_s_gap_is_its_second_derivative() {
    // as above, for features of bodies that fly and turn; radii are such that they touch
    let fly = |x: Vector3, v: Vector3, w: Vector3, turn: [f64; 4]| body(1.0, [1.0; 3], x, v, w, turn);
    let a = fly(vector(0.1, 0.2, -0.6), vector(0.3, -0.4, 0.2), vector(0.5, 1.0, -0.7), [0.9, 0.2, -0.1, 0.3]);
    let b = fly(vector(-0.2, 0.1, 0.5), vector(-0.5, 0.6, 0.1), vector(-1.0, 0.4, 0.9), [0.8, -0.3, 0.2, 0.1]);
    let bodies = [a, b];
    let at = |k: usize, t: f64| {
        let mut motion = bodies[k].motion;
        motion.position += t * motion.velocity;
        motion.orientation = quaternion::exp(&(t * motion.angular_velocity)) * motion.orientation;
        motion.rotation = quaternion::to_matrix(&motion.orientation);
        motion
    };
    let gap = |anchor: &Anchor, t: f64| anchor.gap(&at(0, t), &at(1, t));
    let (p, q) = (vector(0.1, -0.05, 0.3), vector(-0.1, 0.2, -0.15));
    let (e, f) = (vector(0.9, 0.3, -0.2).normalize(), vector(-0.2, 0.8, 0.1).normalize());
    let on_line = |of_b: bool, r: f64| {
        let (center, foot, along) = if of_b { (q, p, e) } else { (p, q, f) };
        Anchor::OnLine { of_b, center, foot, along, radii: [0.1, r] }
    };
    let balls = |r: f64| Anchor::Balls { centers: [p, q], radii: [0.1, r] };
    let lines = |r: f64| Anchor::Lines { points: [p, q], along: [e, f], radii: [0.1, r], side: 1.0 };
    let swapped = |r: f64| Anchor::Lines { points: [p, q], along: [e, f], radii: [0.1, r], side: -1.0 };
    let crossed =
        if gap(&lines(0.0), 0.0) > 0.0 { lines(gap(&lines(0.0), 0.0)) } else { swapped(gap(&swapped(0.0), 0.0)) };
    let on_rim = |of_b: bool, radius: f64| {
        let (center, middle, axis) = if of_b { (q, p, e) } else { (p, q, f) };
        Anchor::OnRim { of_b, center, radius, middle, axis, rim: 0.2 }
    };
    let anchors = [
        ("ball of b on a rim", on_rim(true, gap(&on_rim(true, 0.0), 0.0))),
        ("ball of a on a rim", on_rim(false, gap(&on_rim(false, 0.0), 0.0))),
        ("ball of b on a line", on_line(true, gap(&on_line(true, 0.0), 0.0))),
        ("ball of a on a line", on_line(false, gap(&on_line(false, 0.0), 0.0))),
        ("balls", balls(gap(&balls(0.0), 0.0))),
        ("lines", crossed),
    ];
    let pull = 90.0;
    for (name, anchor) in anchors {
        assert!(gap(&anchor, 0.0).abs() < 1e-15);
        let contact = Contact::new(0, 1, Vector3::zeros(), Vector3::z());
        let support = anchor.support(&contact, &bodies.map(|body| body.motion));
        let (point, n) = (support.contact.point, support.contact.normals[0]);
        let h = 1e-4;

        // the normal turns as it says, and the point runs so
        let moved = |t: f64| {
            let contact = anchor.support(&contact, &[0, 1].map(|k| at(k, t))).contact;
            (contact.point, contact.normals[0])
        };
        close(&((moved(h).0 - moved(-h).0) / (2.0 * h)), &support.point_velocity, 1e-6);
        close(&((moved(h).1 - moved(-h).1) / (2.0 * h)), &support.normal_rate, 1e-6);

        let second = (gap(&anchor, h) - 2.0 * gap(&anchor, 0.0) + gap(&anchor, -h)) / (h * h);
        let free = [Acceleration::zero(), Acceleration { linear: -pull * n, angular: Vector3::zeros() }];
        let held = rest(&bodies, &free, &[support], 1e-9).expect("an answer");
        let w: f64 = bodies.iter().map(|b| 1.0 + (point - b.motion.position).cross(&n).norm_squared()).sum();
        let found = pull - n.dot(&held.forces[0]) * w;
        assert!(second.abs() > 0.05 && (found - second).abs() < 1e-5, "{name}: {found} is not {second}");
    }
}
