//! Whole runs with impacts and lasting contacts against closed forms; each formula stands in its test.
//!
//! Tolerances are relative to the case's own speeds, sizes and times: 1e-9 of a result, 1e-12 of energy and momentum of
//! elastic impacts, and 1e-12 of speed over size for a spin where none may be.

use super::meeting::{close, last, run, scene};
use bryla::math::Vector3;
use bryla::{Body, BodyMotion, Cuboid, EventKind, HalfSpace, RunError, RunOptions, Sphere, Trajectory, UniformGravity};

const TIGHT: f64 = 1e-12;
const CLOSE: f64 = 1e-9;

fn floor() -> Body {
    Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed()
}

fn first(run: &Trajectory) -> Vec<BodyMotion> {
    run.motions(0)
}

/// The corner of a cuboid that is lowest.
fn lowest(motion: &BodyMotion, half: [f64; 3]) -> Vector3 {
    let corners = (0..8).map(|k| [0, 1, 2].map(|i| if k >> i & 1 == 0 { -half[i] } else { half[i] }));
    let corners = corners.map(|c| motion.point(&Vector3::from(c)));
    corners.min_by(|a, b| a.z.total_cmp(&b.z)).unwrap()
}

#[test]
fn a_corner_hits_a_plane_off_centre() {
    // j = (1 + e) v/(1/m + |r × n|²/I), I = 2/3 m a² of a cube (Baraff 1997, impulse of one point)
    let (m, a, v) = (1.7, 0.1, 3.0);
    for e in [1.0, 0.5, 0.0] {
        let cube = Body::new("cube", Cuboid::new([a; 3])).mass(m).position([0.2, -0.1, 1.0]).velocity([0.5, 0.0, -v]);
        let cube = cube.orientation([0.8, 0.3, 0.4, 0.3316624790355]).restitution(e);
        let run = run(&scene([floor(), cube]), 0.5);
        let event = &run.events()[0];
        let start = first(&run)[1];
        let r = lowest(&start, [a; 3]) - start.position;
        let inertia = 2.0 / 3.0 * m * a * a;
        let j = (1.0 + e) * v / (1.0 / m + r.cross(&Vector3::z()).norm_squared() / inertia);
        assert!((event.time - (1.0 + r.z) / v).abs() < 1e-11, "{}", event.time);
        close(event.impulse, [0.0, 0.0, j], TIGHT * j);
        close(event.velocity[1], [0.5, 0.0, j / m - v], TIGHT * v);
        close(event.angular_velocity[1], r.cross(&Vector3::z()) * j / inertia, TIGHT * v / a);
        let after = event.velocity[1] + event.angular_velocity[1].cross(&r);
        assert!((after.z - e * v).abs() < TIGHT * v);
        if e == 1.0 {
            assert!(event.energy_lost.abs() < TIGHT * m * v * v);
        }
    }
}

#[test]
fn two_edges_cross_off_centre() {
    // edges along x and y, normal z: 1/W = 1/m₁ + 1/m₂ + x²/I₁ + y²/I₂ with the levers across the normal
    let (a, v, eighth) = (0.1, 2.0, std::f64::consts::FRAC_PI_8);
    let (m1, m2, x, y) = (1.0, 2.5, 0.04, 0.07);
    for e in [1.0, 0.5, 0.0] {
        let lower =
            Body::new("lower", Cuboid::new([a; 3])).mass(m1).orientation([eighth.cos(), eighth.sin(), 0.0, 0.0]);
        let upper =
            Body::new("upper", Cuboid::new([a; 3])).mass(m2).orientation([eighth.cos(), 0.0, eighth.sin(), 0.0]);
        let upper = upper.position([x, y, 0.5]).velocity([0.0, 0.0, -v]);
        let run = run(&scene([lower.restitution(e), upper.restitution(e)]), 0.5);
        let event = &run.events()[0];
        let inertia = |m: f64| 2.0 / 3.0 * m * a * a;
        let j = (1.0 + e) * v / (1.0 / m1 + 1.0 / m2 + x * x / inertia(m1) + y * y / inertia(m2));
        assert!((event.time - (0.5 - 2.0 * 2f64.sqrt() * a) / v).abs() < 1e-11);
        close(event.impulse, [0.0, 0.0, j], CLOSE * j);
        close(event.velocity[1], [0.0, 0.0, j / m2 - v], CLOSE * v);
        close(event.other_velocity[1], [0.0, 0.0, -j / m1], CLOSE * v);
        close(event.angular_velocity[1], [-y * j / inertia(m2), 0.0, 0.0], CLOSE * v / a);
        close(event.other_angular_velocity[1], [0.0, x * j / inertia(m1), 0.0], CLOSE * v / a);
    }
}

#[test]
fn a_thin_rod_lands_on_one_end() {
    // j = (1 + e) v/(1/m + x²/I), I = m (L² + b²)/3 across the rod, x the lever of its end
    let (l, b, m, v, angle) = (0.5, 0.005, 0.3, 4.0, 0.7_f64);
    for e in [1.0, 0.5, 0.0] {
        let q = [(0.5 * angle).cos(), 0.0, (0.5 * angle).sin(), 0.0];
        let rod = Body::new("rod", Cuboid::new([l, b, b])).mass(m).position([0.0, 0.0, 1.0]).velocity([0.0, 0.0, -v]);
        let run = run(&scene([floor(), rod.orientation(q).restitution(e)]), 0.2);
        let event = &run.events()[0];
        // turned about y, the end at +x goes down: its lower corner, seen from the centre
        let (sin, cos) = angle.sin_cos();
        let (x, z) = (l * cos - b * sin, -l * sin - b * cos);
        let inertia = m * (l * l + b * b) / 3.0;
        let j = (1.0 + e) * v / (1.0 / m + x * x / inertia);
        assert!((event.time - (1.0 + z) / v).abs() < 1e-11);
        close(event.impulse, [0.0, 0.0, j], CLOSE * j);
        close(event.velocity[1], [0.0, 0.0, j / m - v], CLOSE * v);
        close(event.angular_velocity[1], [0.0, -x * j / inertia, 0.0], CLOSE * v / l);
    }
}

#[test]
fn cubes_head_on_swap_their_velocities_and_do_not_spin() {
    let cube = |name: &str, x: f64, v: f64| {
        Body::new(name, Cuboid::new([0.1; 3]))
            .mass(1.0)
            .position([x, 0.0, 0.0])
            .velocity([v, 0.0, 0.0])
            .restitution(1.0)
    };
    let run = run(&scene([cube("a", -0.5, 2.0), cube("b", 0.5, -1.0)]), 1.0);
    let end = last(&run);
    close(end[0].velocity, [-1.0, 0.0, 0.0], TIGHT * 2.0);
    close(end[1].velocity, [2.0, 0.0, 0.0], TIGHT * 2.0);
    assert!(end.iter().all(|m| m.angular_velocity.norm() <= TIGHT * 2.0 / 0.1));
    // they meet after 0.8/3 s
    assert!((run.events()[0].time - 0.8 / 3.0).abs() < 1e-12);
    close(end[0].position, [-0.5 + 2.0 * 0.8 / 3.0 - (1.0 - 0.8 / 3.0), 0.0, 0.0], 1e-11);
}

#[test]
fn an_elastic_ball_and_a_flat_elastic_cube_rise_to_their_height_twenty_times() {
    // fall h, period 2 √(2h/g): apex k at k periods, height h, no spin, ever
    let (h, g) = (1.0, 10.0);
    let period = 2.0 * (2.0_f64 * h / g).sqrt();
    let ball = Body::new("body", Sphere::new(0.1)).mass(1.0).position([0.0, 0.0, 1.1]);
    let cube = Body::new("body", Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, 1.1]);
    for body in [ball, cube] {
        let mut scene = scene([floor(), body.restitution(1.0)]);
        scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
        let apexes: Vec<f64> = (0..=20).map(|k| f64::from(k) * period).collect();
        let run = scene.run(0.0..20.0 * period, &RunOptions::tolerance(1e-9).t_eval(apexes)).unwrap();
        for k in 0..=20 {
            let motion = run.motions(k)[1];
            assert!((motion.position.z - 1.1).abs() < CLOSE, "apex {k}: {:e}", motion.position.z - 1.1);
            assert!(motion.angular_velocity.norm() <= TIGHT * 4.5 / 0.1);
        }
        let bounces = run.events().iter().filter(|e| e.kind == EventKind::Bounce).count();
        assert_eq!(bounces, 20);
        assert!(run.energy().unwrap().drift() < 1e-11 * g);
    }
}

#[test]
fn bounces_with_restitution_lose_their_share_and_end_when_their_series_does() {
    // speeds v eᵏ, heights h e²ᵏ; at rest at √(2h/g) (1 + e)/(1 − e)
    let (h, g, e) = (1.0, 10.0, 0.7);
    let fall = (2.0_f64 * h / g).sqrt();
    let truth = fall * (1.0 + e) / (1.0 - e);
    let ball = Body::new("body", Sphere::new(0.1)).mass(1.0).position([0.0, 0.0, 1.1]);
    let cube = Body::new("body", Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, 1.1]);
    for body in [ball, cube] {
        let mut scene = scene([floor(), body.restitution(e).friction(0.3)]);
        scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
        let run = run(&scene, truth + 1.0);
        for (k, event) in run.events().iter().filter(|e| e.kind == EventKind::Bounce).take(20).enumerate() {
            let speed = g * fall * e.powi(i32::try_from(k).unwrap() + 1);
            assert!((event.velocity[1].z - speed).abs() < CLOSE * g * fall);
            assert!(event.angular_velocity[1].norm() <= TIGHT * g * fall / 0.1);
        }
        let rest = run.events().last().unwrap();
        assert_eq!(rest.kind, EventKind::Rest);
        assert!((rest.time - truth).abs() < CLOSE * truth, "{} is not {truth}", rest.time);
        assert_eq!((last(&run)[1].velocity, last(&run)[1].angular_velocity), (Vector3::zeros(), Vector3::zeros()));
    }
}

#[test]
fn an_oblique_ball_grips_or_slips() {
    // slips: Δv = μ (1 + e) v_n, ω = 5/2 Δv/R;  grips where that is more than 2/7 v_t: v_t⁺ = 5/7 v_t, ω = v_t⁺/R
    let (m, radius, v_n, e) = (0.4, 0.05, 3.0, 0.6);
    for (v_t, mu) in [(1.0, 0.3), (6.0, 0.3), (6.0, 0.0)] {
        let ball = Body::new("ball", Sphere::new(radius)).mass(m).position([0.0, 0.0, 0.5]).velocity([v_t, 0.0, -v_n]);
        let run = run(&scene([floor().friction(mu), ball.restitution(e).friction(mu)]), 0.3);
        let event = &run.events()[0];
        let brake = (mu * (1.0 + e) * v_n).min(2.0 / 7.0 * v_t);
        close(event.velocity[1], [v_t - brake, 0.0, e * v_n], CLOSE * v_n);
        close(event.angular_velocity[1], [0.0, 2.5 * brake / radius, 0.0], CLOSE * v_n / radius);
        // the cone holds for all of the impulse
        assert!((event.impulse.x + m * brake).abs() < CLOSE * m * v_n);
        assert!(event.impulse.x.abs() <= mu * event.impulse.z * (1.0 + 1e-12));
    }
}

#[test]
fn a_cradle_hands_the_blow_through() {
    // n equal bodies that touch: the last one leaves with the speed of the first, the others stay
    let v = 1.5;
    let ball = |x: f64| Body::new(format!("{x}"), Sphere::new(0.1)).mass(1.0).position([x, 0.0, 0.0]).restitution(1.0);
    let cube =
        |x: f64| Body::new(format!("{x}"), Cuboid::new([0.1; 3])).mass(1.0).position([x, 0.0, 0.0]).restitution(1.0);
    let bodies: [Vec<Body>; 2] = [
        (0..5).map(|k| ball(0.2 * f64::from(k) - if k == 0 { 0.5 } else { 0.0 })).collect(),
        (0..5).map(|k| cube(0.2 * f64::from(k) - if k == 0 { 0.5 } else { 0.0 })).collect(),
    ];
    for mut row in bodies {
        row[0] = row[0].clone().velocity([v, 0.0, 0.0]);
        let run = run(&scene(row), 1.0);
        let end = last(&run);
        for motion in &end[..4] {
            assert!(motion.velocity.norm() < TIGHT * v, "{:?}", motion.velocity);
        }
        close(end[4].velocity, [v, 0.0, 0.0], TIGHT * v);
        assert!(end.iter().all(|m| m.angular_velocity.norm() <= TIGHT * v / 0.1));
    }
}

#[test]
fn an_unequal_chain_passes_speeds_on_one_by_one() {
    // v′ = (m₁ − m₂) v/(m₁ + m₂), 2 m₁ v/(m₁ + m₂), twice: masses 1, 2, 4: −1/3, −2/9, 4/9
    let ball =
        |m: f64, x: f64| Body::new(format!("{m}"), Sphere::new(0.1)).mass(m).position([x, 0.0, 0.0]).restitution(1.0);
    let run = run(&scene([ball(1.0, 0.0).velocity([1.0, 0.0, 0.0]), ball(2.0, 0.5), ball(4.0, 1.0)]), 3.0);
    let end = last(&run);
    for (motion, v) in end.iter().zip([-1.0 / 3.0, -2.0 / 9.0, 4.0 / 9.0]) {
        close(motion.velocity, [v, 0.0, 0.0], TIGHT);
    }
}

#[test]
fn a_ball_breaks_two_that_touch_symmetrically() {
    // e = 1, all at once: v₁ = −v/5, the others 2√3/5 v along the lines of centres, 30° to either side
    let (radius, v) = (0.1, 3.0);
    let s3 = 3f64.sqrt();
    let ball = |name: &str, x: f64, y: f64| {
        Body::new(name, Sphere::new(radius)).mass(1.0).position([x, y, 0.0]).restitution(1.0)
    };
    let gap = 1e-3 * radius;
    let bodies = [
        ball("cue", -1.0, 0.0).velocity([v, 0.0, 0.0]),
        ball("left", 0.0, radius + gap),
        ball("right", 0.0, -radius - gap),
    ];
    let run = run(&scene(bodies), 1.0);
    let end = last(&run);
    // the line of centres where they meet: sine (R + gap)/2R
    let sine = (radius + gap) / (2.0 * radius);
    let cosine = (1.0 - sine * sine).sqrt();
    let j = 2.0 * v * cosine / (1.0 + 2.0 * cosine * cosine);
    close(end[0].velocity, [v - 2.0 * j * cosine, 0.0, 0.0], CLOSE * v);
    close(end[1].velocity, [j * cosine, j * sine, 0.0], CLOSE * v);
    close(end[2].velocity, [j * cosine, -j * sine, 0.0], CLOSE * v);
    assert!((j - 2.0 * s3 / 5.0 * v).abs() < 2e-3 * v);
    let momentum: Vector3 = end.iter().map(|m| m.mass * m.velocity).sum();
    close(momentum, [v, 0.0, 0.0], TIGHT * v);
}

#[test]
fn an_elastic_cube_comes_straight_back_from_a_corner() {
    // three planes at once turn every component of the velocity round
    let wall = |name: &str, n: [f64; 3]| Body::new(name, HalfSpace::new(n, 0.0)).fixed();
    let cube =
        Body::new("cube", Cuboid::new([0.1; 3])).mass(1.0).position([1.1, 1.1, 1.1]).velocity([-2.0, -2.0, -2.0]);
    let walls = [wall("x", [1.0, 0.0, 0.0]), wall("y", [0.0, 1.0, 0.0]), wall("z", [0.0, 0.0, 1.0])];
    let run = run(&scene(walls.into_iter().chain([cube.restitution(1.0)])), 1.0);
    let end = last(&run)[3];
    close(end.velocity, [2.0, 2.0, 2.0], TIGHT * 4.0);
    assert!(end.angular_velocity.norm() <= TIGHT * 4.0 / 0.1);
    close(end.position, [1.1, 1.1, 1.1], 1e-11);
}

#[test]
fn a_bullet_hits_a_thin_free_plate_and_does_not_pass() {
    // off-centre on a plate 1 mm thin: j = 2 v/(1/m + 1/M + d²/I), I = M (b² + c²)/3
    let (m, plate, d) = (0.01, 0.5, 0.2);
    let (b, c) = (0.3, 5e-4);
    for v in [1e3, 1e4, 1e5] {
        let bullet = Body::new("bullet", Sphere::new(0.005)).mass(m).position([d, 0.0, 10.0]).velocity([0.0, 0.0, -v]);
        let target = Body::new("plate", Cuboid::new([b, b, c])).mass(plate);
        let run = run(&scene([target.restitution(1.0), bullet.restitution(1.0)]), 30.0 / v);
        assert_eq!(run.events().len(), 1);
        let event = &run.events()[0];
        let inertia = plate * (b * b + c * c) / 3.0;
        let j = 2.0 * v / (1.0 / m + 1.0 / plate + d * d / inertia);
        assert!((event.time - (10.0 - 0.005 - c) / v).abs() < 1e-11 / v * 10.0);
        close(event.velocity[1], [0.0, 0.0, j / m - v], CLOSE * v);
        close(event.other_velocity[1], [0.0, 0.0, -j / plate], CLOSE * v);
        close(event.other_angular_velocity[1], [0.0, d * j / inertia, 0.0], CLOSE * v / b);
        let end = last(&run);
        let momentum: Vector3 = end.iter().map(|m| m.mass * m.velocity).sum();
        close(momentum, [0.0, 0.0, -m * v], TIGHT * m * v);
        let energy: f64 = end.iter().map(BodyMotion::kinetic_energy).sum();
        assert!((energy - 0.5 * m * v * v).abs() < TIGHT * m * v * v);
        assert!(end[1].position.z > 0.0, "it passed through");
    }
}

#[test]
fn a_rod_that_spins_a_thousand_radians_a_second_meets_the_wall_when_its_tip_does() {
    // d − v t = L |cos ωt| + b |sin ωt|, the first root by bisection between samples far finer than a turn
    let (l, b, w, v, d) = (0.5, 0.01, 1000.0, 1.0, 0.9);
    let gap = |t: f64| d - v * t - l * (w * t).cos().abs() - b * (w * t).sin().abs();
    let mut t = 0.0;
    while gap(t) > 0.0 {
        t += 1e-7;
    }
    let (mut low, mut high) = (t - 1e-7, t);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if gap(middle) > 0.0 { low = middle } else { high = middle }
    }
    let wall = Body::new("wall", HalfSpace::new([-1.0, 0.0, 0.0], 0.0)).fixed();
    let rod = Body::new("rod", Cuboid::new([l, b, b])).mass(1.0).position([-d, 0.0, 0.0]).velocity([v, 0.0, 0.0]);
    let scene = scene([wall, rod.angular_velocity([0.0, 0.0, w]).restitution(1.0)]);
    let run = scene.run(0.0..0.45, &RunOptions::tolerance(1e-9).estimate(false)).unwrap();
    // ε is 1e-12 of the rod; the tip comes with 60 m/s at least
    assert!((run.events()[0].time - low).abs() < 1e-10 * low, "{} is not {low}", run.events()[0].time);
}

#[test]
fn elastic_motion_turned_round_comes_back() {
    let wall = |name: &str, n: [f64; 3]| Body::new(name, HalfSpace::new(n, -0.6)).fixed();
    let walls = [
        wall("-x", [1.0, 0.0, 0.0]),
        wall("+x", [-1.0, 0.0, 0.0]),
        wall("-y", [0.0, 1.0, 0.0]),
        wall("+y", [0.0, -1.0, 0.0]),
        wall("-z", [0.0, 0.0, 1.0]),
        wall("+z", [0.0, 0.0, -1.0]),
    ];
    let body = |name: &str, half: [f64; 3]| Body::new(name, Cuboid::new(half)).mass(1.0).restitution(1.0);
    let bodies = [
        body("a", [0.1, 0.12, 0.15])
            .position([-0.3, 0.0, 0.1])
            .velocity([2.0, 0.3, 0.1])
            .angular_velocity([1.0, 2.0, 0.5]),
        body("b", [0.1, 0.2, 0.1])
            .position([0.3, 0.05, 0.0])
            .velocity([-1.0, 0.2, -0.3])
            .angular_velocity([0.0, -1.0, 1.5]),
    ];
    let forth = run(&scene(walls.clone().into_iter().chain(bodies.clone())), 0.6);
    assert!(forth.events().len() >= 4, "{} impacts", forth.events().len());
    let end = last(&forth);
    let turned = bodies.into_iter().zip(&end[6..]).map(|(body, m)| {
        let q = m.orientation;
        body.position(m.position)
            .orientation([q.w, q.i, q.j, q.k])
            .velocity(-m.velocity)
            .angular_velocity(-m.angular_velocity)
    });
    let back = run(&scene(walls.into_iter().chain(turned)), 0.6);
    for (a, b) in first(&forth)[6..].iter().zip(&last(&back)[6..]) {
        close(b.position, a.position, CLOSE);
        close(b.velocity, -a.velocity, CLOSE * 2.0);
        close(b.angular_velocity, -a.angular_velocity, CLOSE * 20.0);
    }
    let energy = |motions: &[BodyMotion]| motions.iter().map(BodyMotion::kinetic_energy).sum::<f64>();
    let (before, after) = (energy(&first(&forth)[6..]), energy(&end[6..]));
    assert!((before - after).abs() < TIGHT * before, "{:e}", after - before);
}

#[test]
fn a_box_slides_to_a_stop_and_a_ball_from_sliding_to_rolling() {
    // box: v²/(2 μ g) after v/(μ g). Ball: rolls with 5/7 v from 2 v/(7 μ g) on (Routh 1905)
    let (v, mu, g) = (2.0, 0.3, 10.0);
    let weight = UniformGravity::new([0.0, 0.0, -g]);
    let cube = Body::new("box", Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, 0.1]).velocity([v, 0.0, 0.0]);
    let mut slide = scene([floor().friction(mu), cube.friction(mu)]);
    slide.add_effect(weight.clone());
    let slid = run(&slide, 1.0);
    close(last(&slid)[1].position, [v * v / (2.0 * mu * g), 0.0, 0.1], CLOSE);
    assert_eq!(last(&slid)[1].velocity, Vector3::zeros());
    let rest = slid.events().last().unwrap();
    assert!(rest.kind == EventKind::Rest && (rest.time - v / (mu * g)).abs() < CLOSE);
    assert!(slid.energy().unwrap().drift() < 1e-9 * 0.5 * v * v);

    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([0.0, 0.0, 0.1]).velocity([v, 0.0, 0.0]);
    let mut roll = scene([floor().friction(mu), ball.friction(mu)]);
    roll.add_effect(weight);
    let rolled = run(&roll, 1.0);
    let (grips, rolls) = (2.0 * v / (7.0 * mu * g), 5.0 / 7.0 * v);
    let x = v * grips - 0.5 * mu * g * grips * grips + rolls * (1.0 - grips);
    close(last(&rolled)[1].velocity, [rolls, 0.0, 0.0], CLOSE * v);
    close(last(&rolled)[1].angular_velocity, [0.0, rolls / 0.1, 0.0], CLOSE * v / 0.1);
    close(last(&rolled)[1].position, [x, 0.0, 0.1], CLOSE);
}

#[test]
fn a_block_that_tips_over_its_edge_turns_as_a_pendulum() {
    // about the edge: I = 8/3 m a², ½ I ω² = m g √2 a (cos φ₀ − cos φ), φ from the top; it lands at φ = π/4
    let (a, g, tilt) = (0.1, 10.0, 0.6_f64);
    let q = [(0.5 * tilt).cos(), 0.0, (0.5 * tilt).sin(), 0.0];
    let z = a * (tilt.cos() + tilt.sin());
    let cube = Body::new("cube", Cuboid::new([a; 3])).mass(1.0).position([0.0, 0.0, z]).orientation(q);
    let mut scene = scene([floor().friction(0.9), cube.friction(0.9)]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -g]));
    let run = run(&scene, 0.5);
    let bounce = run.events().iter().find(|e| e.kind == EventKind::Bounce).unwrap();
    let fallen = std::f64::consts::FRAC_PI_4 - tilt;
    let square =
        2.0 * g * 2f64.sqrt() * a * (fallen.abs().cos() - std::f64::consts::FRAC_PI_4.cos()) / (8.0 / 3.0 * a * a);
    let w = bounce.angular_velocity[0].norm();
    assert!((w - square.sqrt()).abs() < CLOSE * w, "{w} is not {}", square.sqrt());
    // e = 0: the other edge takes the blow, ω⁺ = (1 − 3/2 sin² π/4) ω = ω/4 (Housner 1963)
    assert!((bounce.angular_velocity[1].norm() / w - 0.25).abs() < CLOSE);
}

#[test]
fn the_report_counts_the_impacts_that_hang_on_what_counts_as_touching() {
    // ε is 1e-12 of the size, ε_touch 1e-9: a cube tilted by less than the first lands flat, by less than the second
    // it lands flat because ε_touch says so, else on an edge
    for (tilt, hang, turns) in [(0.0, 0, false), (1e-10, 1, false), (1e-7, 0, true)] {
        let cube =
            Body::new("cube", Cuboid::new([0.1; 3])).mass(1.0).position([0.0, 0.0, 1.0]).velocity([0.0, 0.0, -1.0]);
        let cube = cube.orientation([1.0, 0.5 * tilt, 0.0, 0.0]).restitution(1.0);
        let run = run(&scene([floor(), cube]), 1.0);
        let spin = run.events()[0].angular_velocity[1].norm();
        assert_eq!((run.report().touch_impacts, spin > 1.0), (hang, turns), "{tilt}: {spin}");
        assert_eq!(run.report().to_string().contains("1 of them hang on ε_touch"), hang == 1);
    }
}

#[test]
fn losses_of_pairs_that_are_hit_at_once_are_never_negative_and_sum_up() {
    // a ball hits the first of three that touch: the blow runs through, and drives the last pair apart
    let ball = |name: &str, x: f64| Body::new(name, Sphere::new(0.1)).mass(1.0).position([x, 0.0, 0.0]);
    for e in [1.0, 0.6] {
        let row = [ball("a", -1.0).velocity([2.0, 0.0, 0.0]), ball("b", 0.0), ball("c", 0.2), ball("d", 0.4)];
        let run = run(&scene(row.map(|ball| ball.restitution(e))), 0.6);
        let losses: Vec<f64> = run.events().iter().map(|event| event.energy_lost).collect();
        assert!(losses.len() >= 3 && losses.iter().all(|loss| *loss >= 0.0), "{losses:?}");
        let energy = |motions: Vec<BodyMotion>| motions.iter().map(BodyMotion::kinetic_energy).sum::<f64>();
        let lost = energy(first(&run)) - energy(last(&run));
        assert!((losses.iter().sum::<f64>() - lost).abs() < TIGHT * 2.0, "{losses:?} {lost}");
        assert_eq!(e < 1.0, lost > 0.1);
    }
}

#[test]
fn a_contact_that_cannot_be_followed_ends_the_run_by_name_with_all_that_was_computed() {
    // an egg that spins on an egg
    let egg = |name: &str, z: f64| Body::new(name, bryla::Ellipsoid::new([0.1, 0.1, 0.15])).position([0.0, 0.0, z]);
    let floor = egg("floor", -0.15).fixed().friction(0.5);
    let mut scene = scene([floor, egg("egg", 0.5).mass(1.0).angular_velocity([0.0, 0.0, 1.0]).friction(0.5)]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    let RunError::Simulation(error) = scene.run(0.0..2.0, &RunOptions::tolerance(1e-9)).unwrap_err() else { panic!() };
    assert!(matches!(error.kind, bryla::simulation::Failure::LastingContact(_)), "{error}");
    assert_eq!(error.bodies, ["floor", "egg"]);
    let trajectory = error.trajectory.unwrap();
    assert!(trajectory.end() == error.time && trajectory.events().len() == 1);
}

#[test]
fn impacts_beyond_those_allowed_end_the_run_by_name_with_all_that_was_computed() {
    // an elastic ball falls by 0.45 m and meets the floor at 0.3, 0.9, 1.5 and 2.1 s
    let ball = Body::new("ball", Sphere::new(0.1)).mass(1.0).position([0.0, 0.0, 0.55]).restitution(1.0);
    let mut scene = scene([floor(), ball]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -10.0]));
    let options = |most: u64| RunOptions::tolerance(1e-9).max_impacts(most);
    assert_eq!(scene.run(0.0..2.0, &options(3)).unwrap().events().len(), 3);
    for (most, bounces) in [(0, 1), (2, 3)] {
        let RunError::Simulation(error) = scene.run(0.0..2.0, &options(most)).unwrap_err() else { panic!() };
        let told = format!("max_impacts = {most} of ball are used up");
        assert_eq!(error.kind, bryla::simulation::Failure::AccumulatingImpacts(told));
        assert_eq!(error.bodies, ["floor", "ball"]);
        let trajectory = error.trajectory.unwrap();
        assert!((error.time - (0.3 + 0.6 * most as f64)).abs() < CLOSE, "{}", error.time);
        assert!(trajectory.end() == error.time && trajectory.events().len() == bounces);
    }
}
