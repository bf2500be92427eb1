//! What rolls and slides over the edge of a table; each formula stands in its test.

use super::meeting::{close, last, run, scene};
use bryla::math::Vector3;
use bryla::{Body, Capsule, Cuboid, Cylinder, Polyhedron, RunOptions, Scene, Sphere, UniformGravity};

const G: f64 = 10.0;
/// Where bodies start [m].
const FROM: f64 = -0.05;
/// Radius of what rolls [m].
const R: f64 = 0.1;
/// Of lengths and speeds of 0.1 to 1 in SI units; runs have a tolerance of 1e-9.
const CLOSE: f64 = 1e-9;
/// Friction that lets nothing slip but where the load is a millionth of what pulls along the surface: for some 1e-8 s
/// before it is 0, which moves speeds of 1 by 1e-7.
const ROUGH: f64 = 1e6;
const SLIPS: f64 = 1e-7;

/// The turn that lays the z axis along y.
const ACROSS: [f64; 4] = [std::f64::consts::FRAC_1_SQRT_2, -std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0];

/// A table whose top is z = 0 up to its edge, the y axis, and a body on it.
fn on_table(body: Body, friction: f64) -> Scene {
    let table = Body::new("table", Cuboid::new([0.5, 0.5, 0.2])).fixed().position([-0.5, 0.0, -0.2]);
    let mut scene = scene([table.friction(friction), body.mass(1.0).friction(friction)]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    scene
}

/// ∫ f from 0 to `end`, by Simpson's rule on 20,000 pieces, which leaves 1e-15.
fn integral(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let pieces = 20_000;
    let h = end / f64::from(pieces);
    let at = |k: i32, part: f64| f((f64::from(k) + part) * h);
    (0..pieces).map(|k| h / 6.0 * (at(k, 0.0) + 4.0 * at(k, 0.5) + at(k, 1.0))).sum()
}

/// A body whose centre turns about an edge, or the axis of a log, at the distance r by φ from the vertical, with j/2 m v²
/// of energy at the speed v, which at φ = 0 is v₀:
///
/// ```text
/// ½ j r² φ˙² = ½ j v₀² + g r (1 − cos φ)       energy
/// r φ˙² = g cos φ                              no force: it leaves
/// cos φ = (2 + j v₀²/(g r))/(2 + j)
/// ```
struct Pivot {
    inertia: f64,
    radius: f64,
    speed: f64,
}

impl Pivot {
    fn leaves_at(&self) -> f64 {
        libm::acos(((2.0 + self.inertia * self.speed * self.speed / (G * self.radius)) / (2.0 + self.inertia)).min(1.0))
    }

    fn rate(&self, angle: f64) -> f64 {
        (self.speed * self.speed + 2.0 * G * self.radius * (1.0 - libm::cos(angle)) / self.inertia).sqrt() / self.radius
    }

    fn time_to(&self, angle: f64) -> f64 {
        integral(angle, |angle| 1.0 / self.rate(angle))
    }

    /// Position, velocity and rate of turning at a time after it leaves.
    fn flying(&self, after: f64) -> (Vector3, Vector3, f64) {
        let angle = self.leaves_at();
        let (position, velocity) = flown(self.radius, angle, self.rate(angle), after);
        (position, velocity, self.rate(angle))
    }
}

/// Position and velocity, from what it turns about at this distance and rate, at a time after it leaves it at an angle.
fn flown(radius: f64, angle: f64, rate: f64, after: f64) -> (Vector3, Vector3) {
    let (sin, cos) = libm::sincos(angle);
    let v = radius * rate * Vector3::new(cos, 0.0, -sin);
    let fall = Vector3::new(0.0, 0.0, -G);
    (radius * Vector3::new(sin, 0.0, cos) + after * v + 0.5 * after * after * fall, v + after * fall)
}

/// Where a function of an angle from 0 to 1 that begins below 0 comes above it.
fn zero(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..53 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

#[test]
fn a_ball_slides_over_an_edge_and_leaves_it_where_it_weighs_nothing() {
    // without friction j = 1: cos φ = 2/3 + v²/(3 g R); along the edge the velocity stays, and so does the spin. From
    // v² = g R on it flies off at once
    for (speed, along) in [(0.3, 0.0), (0.7, 0.2), (1.2, 0.3)] {
        let pivot = Pivot { inertia: 1.0, radius: R, speed };
        let spin = Vector3::new(0.3, 2.0, -0.5);
        let ball = Body::new("ball", Sphere::new(R)).position([FROM, 0.0, R]);
        let ball = ball.velocity([speed, along, 0.0]).angular_velocity(spin);
        let (slides, flies) = (-FROM / speed, 0.05);
        let turns = if speed * speed < G * R { pivot.time_to(pivot.leaves_at()) } else { 0.0 };
        let end = slides + turns + flies;
        let run = run(&on_table(ball, 0.0), end);
        let (position, velocity, _) = pivot.flying(flies);
        let ball = last(&run)[1];
        close(ball.position, position + end * along * Vector3::y(), CLOSE);
        close(ball.velocity, velocity + along * Vector3::y(), 10.0 * CLOSE);
        close(ball.angular_velocity, spin, CLOSE);
        assert!(run.energy().unwrap().drift() < 1e-9, "{:e}", run.energy().unwrap().drift());
    }
}

#[test]
fn a_ball_rolls_over_an_edge_and_leaves_it_where_it_weighs_nothing() {
    // j = 7/5: cos φ = (10 + 7 v²/(g R))/17
    for speed in [0.3, 0.8] {
        let pivot = Pivot { inertia: 1.4, radius: R, speed };
        let ball = Body::new("ball", Sphere::new(R)).position([FROM, 0.0, R]);
        let ball = ball.velocity([speed, 0.0, 0.0]).angular_velocity([0.0, speed / R, 0.0]);
        let (rolls, turns, flies) = (-FROM / speed, pivot.time_to(pivot.leaves_at()), 0.05);
        let run = run(&on_table(ball, ROUGH), rolls + turns + flies);
        let (position, velocity, turning) = pivot.flying(flies);
        let ball = last(&run)[1];
        close(ball.position, position, SLIPS * flies);
        close(ball.velocity, velocity, SLIPS);
        close(ball.angular_velocity, [0.0, turning, 0.0], SLIPS / R);
        assert!(run.energy().unwrap().drift() < 1e-9, "{:e}", run.energy().unwrap().drift());

        // on its way about the edge
        for part in [0.1, 0.5, 0.99] {
            let angle = part * pivot.leaves_at();
            let (position, velocity) = flown(R, angle, pivot.rate(angle), 0.0);
            let ball = run.at(rolls + pivot.time_to(angle)).unwrap()[1];
            close(ball.position, position, CLOSE);
            close(ball.linear_momentum, velocity, 10.0 * CLOSE);
        }
    }
}

#[test]
fn what_rolls_slips_before_it_leaves_an_edge() {
    // it slips where (1 − 1/j) g sin φ = μ n, n = g cos φ − R φ˙², and then R φ¨ = g sin φ − μ n, ω˙ = μ n/((j − 1) R), up
    // to n = 0; over φ by Runge and Kutta's method of order 4, 2,000 steps of which leave 1e-14
    let (friction, speed) = (0.4, 0.3);
    let bodies =
        [(1.4, Body::new("ball", Sphere::new(R))), (1.5, Body::new("log", Cylinder::new(R, 0.2)).orientation(ACROSS))];
    for (inertia, body) in bodies {
        let pivot = Pivot { inertia, radius: R, speed };
        let weight = |angle: f64, rate: f64| G * libm::cos(angle) - R * rate * rate;
        let holds = |angle: f64| friction * weight(angle, pivot.rate(angle));
        let slips = zero(|angle| (1.0 - 1.0 / inertia) * G * libm::sin(angle) - holds(angle));
        let after = |angle: f64| {
            let rates = |phi: f64, [rate, _, _]: [f64; 3]| {
                let n = weight(phi, rate);
                let own = [(G * libm::sin(phi) - friction * n) / R, friction * n / ((inertia - 1.0) * R), 1.0];
                own.map(|own| own / rate)
            };
            let steps = 2_000;
            let h = (angle - slips) / f64::from(steps);
            let mut y = [pivot.rate(slips), pivot.rate(slips), pivot.time_to(slips)];
            for k in 0..steps {
                let phi = slips + f64::from(k) * h;
                let ahead = |k: [f64; 3], part: f64| std::array::from_fn(|i| y[i] + part * h * k[i]);
                let k1 = rates(phi, y);
                let k2 = rates(phi + 0.5 * h, ahead(k1, 0.5));
                let k3 = rates(phi + 0.5 * h, ahead(k2, 0.5));
                let k4 = rates(phi + h, ahead(k3, 1.0));
                y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
            }
            y
        };
        let leaves = slips + zero(|beyond| -weight(slips + beyond, after(slips + beyond)[0]));
        let [rate, spin, time] = after(leaves);
        assert!(slips < leaves - 0.1, "{slips} {leaves}");

        let flies = 0.05;
        let body = body.position([FROM, 0.0, R]).velocity([speed, 0.0, 0.0]).angular_velocity([0.0, speed / R, 0.0]);
        let run = run(&on_table(body, friction), -FROM / speed + time + flies);
        let (position, velocity) = flown(R, leaves, rate, flies);
        let body = last(&run)[1];
        close(body.position, position, CLOSE);
        close(body.velocity, velocity, 10.0 * CLOSE);
        close(body.angular_velocity, [0.0, spin, 0.0], 100.0 * CLOSE);
        assert!(run.energy().unwrap().drift() < 1e-9, "{:e}", run.energy().unwrap().drift());
    }
}

#[test]
fn a_cylinder_rolls_over_an_edge_along_its_axis() {
    // j = 3/2: cos φ = (4 + 3 v²/(g R))/7; shorter than the edge, and longer. At a tolerance of 1e-8, of which speeds have
    // a hundred times as much and rates of turning a thousand times
    for half_length in [0.2, 0.8] {
        let speed = 0.4;
        let pivot = Pivot { inertia: 1.5, radius: R, speed };
        let log = Body::new("log", Cylinder::new(R, half_length)).orientation(ACROSS).position([FROM, 0.0, R]);
        let log = log.velocity([speed, 0.0, 0.0]).angular_velocity([0.0, speed / R, 0.0]);
        let (rolls, turns, flies) = (-FROM / speed, pivot.time_to(pivot.leaves_at()), 0.05);
        let options = RunOptions::tolerance(1e-8).estimate(false);
        let run = on_table(log, ROUGH).run(0.0..rolls + turns + flies, &options).unwrap();
        let (position, velocity, turning) = pivot.flying(flies);
        let log = last(&run)[1];
        close(log.position, position, 1e-7);
        close(log.velocity, velocity, 1e-6);
        close(log.angular_velocity, [0.0, turning, 0.0], 1e-5);
    }
}

#[test]
fn a_box_slides_off_a_table_and_tips_about_its_edge() {
    // tilted by θ about the edge, which touches its face a way s behind its middle: with r = b n + s t from the edge to
    // its centre, n and t across and along the face, k = (a² + b²)/3, μ n the friction against the way it slides,
    // n = g cos θ − (2 s˙ + b θ˙) θ˙ − s θ¨,  (s² + k) θ¨ = g s cos θ − b s θ˙² − 2 s s˙ θ˙ + b μ n,
    // s¨ = s θ˙² + g sin θ − b θ¨ − μ n; it begins to tip at s = −μ b, where its weight and the friction on its face meet the edge;
    // by Runge and Kutta's method of order 4; 2,000 steps leave 1e-14
    let (a, b, speed) = (0.1, 0.05, 0.8);
    for (friction, lateral) in [(0.0, 0.0), (0.0, 0.1), (0.1, 0.0)] {
        let k = (a * a + b * b) / 3.0;
        let rates = |[s, ds, angle, w]: [f64; 4]| {
            let (sin, cos) = libm::sincos(angle);
            let (free, bound) = (G * cos - (2.0 * ds + b * w) * w, s * s + k + b * friction * s);
            let turning = (G * s * cos - b * s * w * w - 2.0 * s * ds * w + b * friction * free) / bound;
            let n = free - s * turning;
            [ds, s * w * w + G * sin - b * turning - friction * n, w, turning]
        };
        let brake = friction * G;
        let slides = -friction * b - FROM;
        let at_edge = (speed * speed - 2.0 * brake * slides).sqrt();
        let waits = 2.0 * slides / (speed + at_edge);
        let (steps, tips) = (2_000, 0.12);
        let h = tips / f64::from(steps);
        let mut y = [-friction * b, at_edge, 0.0, 0.0];
        for _ in 0..steps {
            let ahead = |k: [f64; 4], part: f64| std::array::from_fn(|i| y[i] + part * h * k[i]);
            let k1 = rates(y);
            let k2 = rates(ahead(k1, 0.5));
            let k3 = rates(ahead(k2, 0.5));
            let k4 = rates(ahead(k3, 1.0));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        }
        let [s, ds, angle, w] = y;
        let (sin, cos) = libm::sincos(angle);
        let (n, t) = (Vector3::new(sin, 0.0, cos), Vector3::new(cos, 0.0, -sin));

        let cuboid = Body::new("box", Cuboid::new([a, 0.07, b])).position([FROM, 0.0, b]);
        let run = run(&on_table(cuboid.velocity([speed, lateral, 0.0]), friction), waits + tips);
        let cuboid = last(&run)[1];
        close(cuboid.position, b * n + s * t + (waits + tips) * lateral * Vector3::y(), CLOSE);
        close(cuboid.velocity, (ds + b * w) * t - s * w * n + lateral * Vector3::y(), 10.0 * CLOSE);
        close(cuboid.rotation * Vector3::x(), t, 10.0 * CLOSE);
        close(cuboid.angular_velocity, [0.0, w, 0.0], 100.0 * CLOSE);
        assert!(angle > 0.2 && run.energy().unwrap().drift() < 1e-9, "{angle} {:e}", run.energy().unwrap().drift());
    }
}

#[test]
fn a_ball_rolls_over_a_ridge_and_down_the_other_side() {
    // up a slope of angle α and down with 5/7 g sin α; about the ridge as over an edge, from −α to α
    let (slope, speed, up, after) = (0.2, 0.8, 0.15, 0.3);
    let (sin, cos) = libm::sincos(slope);
    let pull = 5.0 / 7.0 * G * sin;
    let at_ridge = (speed * speed - 2.0 * pull * up).sqrt();
    let top = (at_ridge * at_ridge - 2.0 * G * R * (1.0 - cos) / 1.4).sqrt();
    let turns = 2.0 * Pivot { inertia: 1.4, radius: R, speed: top }.time_to(slope);
    let end = (speed - at_ridge) / pull + turns + after;
    let down = at_ridge * after + 0.5 * pull * after * after;
    assert!(at_ridge * at_ridge < G * R * cos && top > 0.3, "{at_ridge} {top}");

    let mut points = Vec::new();
    for y in [-0.7, 0.7] {
        points.extend([[0.0, y, 0.0], [-cos, y, -sin], [cos, y, -sin], [-1.0, y, -1.0], [1.0, y, -1.0]]);
    }
    let faces = [[0, 5, 6, 1], [0, 2, 7, 5], [1, 6, 8, 3], [2, 4, 9, 7], [3, 8, 9, 4]].map(|face| face.to_vec());
    let faces = [faces.to_vec(), vec![vec![0, 1, 3, 4, 2], vec![5, 7, 9, 8, 6]]].concat();
    let roof = Body::new("roof", Polyhedron::new(points, faces)).fixed().friction(1.0).origin([0.0; 3]);
    let ball = Body::new("ball", Sphere::new(R)).mass(1.0).friction(1.0);
    let ball = ball.position(up * Vector3::new(-cos, 0.0, -sin) + R * Vector3::new(-sin, 0.0, cos));
    let ball = ball.velocity(speed * Vector3::new(cos, 0.0, sin)).angular_velocity([0.0, speed / R, 0.0]);
    let mut scene = scene([roof, ball]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    let run = run(&scene, end);
    let ball = last(&run)[1];
    close(ball.position, down * Vector3::new(cos, 0.0, -sin) + R * Vector3::new(sin, 0.0, cos), CLOSE);
    let speed = at_ridge + pull * after;
    close(ball.velocity, speed * Vector3::new(cos, 0.0, -sin), 10.0 * CLOSE);
    close(ball.angular_velocity, [0.0, speed / R, 0.0], 100.0 * CLOSE);
    assert!(run.energy().unwrap().drift() < 1e-9, "{:e}", run.energy().unwrap().drift());
}

#[test]
fn a_ball_slides_past_the_end_of_an_edge_about_its_corner() {
    // without friction: about the edge, along which the velocity stays, to its end; there on a sphere about the corner,
    // r¨ = g − (v² + g·r)/R² r, by Runge and Kutta's method of order 4, 2,000 steps of which leave 1e-14
    let (speed, along, to_end, about) = (0.4, 0.5, 0.1, 0.03);
    let pivot = Pivot { inertia: 1.0, radius: R, speed };
    let slides = -FROM / speed;
    let turns = to_end / along - slides;
    let angle = zero(|angle| pivot.time_to(angle) - turns);
    assert!(turns > 0.0 && angle < pivot.leaves_at(), "{turns} {angle}");
    let (position, velocity) = flown(R, angle, pivot.rate(angle), 0.0);
    let fall = Vector3::new(0.0, 0.0, -G);
    let rates = |[r, v]: [Vector3; 2]| [v, fall - (v.norm_squared() + fall.dot(&r)) / (R * R) * r];
    let (mut y, steps) = ([position, velocity + along * Vector3::y()], 2_000);
    let h = about / f64::from(steps);
    for _ in 0..steps {
        let ahead = |k: [Vector3; 2], part: f64| std::array::from_fn(|i| y[i] + part * h * k[i]);
        let k1 = rates(y);
        let k2 = rates(ahead(k1, 0.5));
        let k3 = rates(ahead(k2, 0.5));
        let k4 = rates(ahead(k3, 1.0));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    let [r, v] = y;
    assert!(v.norm_squared() + fall.dot(&r) < 0.0, "it leaves the corner before");

    let ball = Body::new("ball", Sphere::new(R)).position([FROM, 0.5 - to_end, R]).velocity([speed, along, 0.0]);
    let run = run(&on_table(ball, 0.0), slides + turns + about);
    let ball = last(&run)[1];
    close(ball.position, r + 0.5 * Vector3::y(), CLOSE);
    close(ball.velocity, v, 10.0 * CLOSE);
}

#[test]
fn a_ball_slides_down_a_log() {
    // as about an edge, at the distance of both radii; along the log its velocity stays
    let (radius, speed, along, flies) = (0.2, 0.4, 0.3, 0.05);
    let pivot = Pivot { inertia: 1.0, radius: radius + R, speed };
    let log = Body::new("log", Cylinder::new(radius, 1.0)).fixed().orientation(ACROSS);
    let ball = Body::new("ball", Sphere::new(R)).mass(1.0).position([0.0, 0.0, radius + R]);
    let mut scene = scene([log, ball.velocity([speed, along, 0.0])]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    let end = pivot.time_to(pivot.leaves_at()) + flies;
    let run = run(&scene, end);
    let (position, velocity, _) = pivot.flying(flies);
    let ball = last(&run)[1];
    close(ball.position, position + end * along * Vector3::y(), CLOSE);
    close(ball.velocity, velocity + along * Vector3::y(), 10.0 * CLOSE);
}

#[test]
fn a_ball_slides_off_a_round_table() {
    // without friction: straight across the table, and about its rim, whose way off it takes, as about a straight edge
    let speed = 0.4;
    let pivot = Pivot { inertia: 1.0, radius: R, speed };
    let table = Body::new("table", Cylinder::new(0.5, 0.2)).fixed().position([-0.5, 0.0, -0.2]);
    let ball = Body::new("ball", Sphere::new(R)).mass(1.0).position([FROM, 0.0, R]).velocity([speed, 0.0, 0.0]);
    let mut scene = scene([table, ball]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    let flies = 0.05;
    let run = run(&scene, -FROM / speed + pivot.time_to(pivot.leaves_at()) + flies);
    let (position, velocity, _) = pivot.flying(flies);
    let ball = last(&run)[1];
    close(ball.position, position, CLOSE);
    close(ball.velocity, velocity, 10.0 * CLOSE);
}

#[test]
fn a_slip_that_ends_as_a_step_begins_leaves_no_step_too_short_for_the_clock() {
    // a capsule comes to lie on a table with e = 0 at 0.2494 s and rolls; at 0.2517 s a slip of rounding ends within 1e-27 s.
    // Nothing drives it: its energy does not rise, but for the run's tolerance, 1e-8, of what it starts with
    let table = Body::new("table", Cuboid::new([0.5, 0.5, 0.05])).fixed().restitution(0.0).friction(0.548259676612709);
    let capsule = Capsule::new(0.03747014897861786, 0.10765768760044475);
    let capsule = Body::new("capsule", capsule).density(1000.0).restitution(0.0).friction(0.548259676612709);
    let capsule = capsule.position([0.517835009363911, -0.0013852242500013157, 0.45721610934467605]);
    let turned = [-0.7742548475270249, -0.06120389269937715, 0.07314940768017938, -0.6256458093485366];
    let thrown = [-0.459145135437097, -0.11724817170044677, -0.37904179212952627];
    let spin = [4.612444775278542, 0.7457101218333069, -4.70371660132996];
    let capsule = capsule.orientation(turned).velocity(thrown).angular_velocity(spin);
    let mut scene = scene([table, capsule]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
    let times: Vec<f64> = (0..=30).map(|k| f64::from(k) * 0.05).collect();
    let run = scene.run(0.0..1.5, &RunOptions::tolerance(1e-8).t_eval(times)).unwrap();
    let energy = |sample: usize| {
        let capsule = &run.motions(sample)[1];
        capsule.kinetic_energy() + capsule.mass * 9.81 * capsule.position.z
    };
    let energies: Vec<f64> = (0..=30).map(energy).collect();
    assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] + 1e-8 * energies[0]), "{energies:?}");
}
