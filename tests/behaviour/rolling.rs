//! What rolls on a plane without being a ball: eggs, coins, cones; each formula stands in its test.

use super::meeting::{close, last, run, scene};
use bryla::math::Vector3;
use bryla::{Body, Cone, Cylinder, Ellipsoid, EventKind, HalfSpace, Scene, UniformGravity};

const G: f64 = 10.0;
/// Of lengths and speeds of 0.1 to 1 in SI units; runs have a tolerance of 1e-9.
const CLOSE: f64 = 1e-9;

/// A body on a floor on which nothing slips.
fn on_floor(body: Body) -> Scene {
    let floor = Body::new("floor", HalfSpace::new([0.0, 0.0, 1.0], 0.0)).fixed().friction(2.0);
    let mut scene = scene([floor, body.mass(1.0).friction(2.0)]);
    scene.add_effect(UniformGravity::new([0.0, 0.0, -G]));
    scene
}

/// The turn by an angle [rad] about y.
fn about_y(angle: f64) -> [f64; 4] {
    let (sin, cos) = libm::sincos(0.5 * angle);
    [cos, 0.0, sin, 0.0]
}

#[test]
fn an_egg_rocks() {
    // tilted by φ its centre is at h = √(a² sin² φ + c² cos² φ), turning about the point of contact, h and h' away:
    // (I + m (h² + h'²)) φ¨ + m h' (h + h'') φ˙² + m g h' = 0,  x˙ = h φ˙,  I = m (a² + c²)/5
    let (a, c, start) = (0.15, 0.1, 0.4);
    let rate = |[phi, speed, _]: [f64; 3]| {
        let (sin, cos) = libm::sincos(phi);
        let excess = a * a - c * c;
        let h = (c * c + excess * sin * sin).sqrt();
        let h1 = excess * sin * cos / h;
        let h2 = (excess * (cos * cos - sin * sin) - h1 * h1) / h;
        let inertia = (a * a + c * c) / 5.0 + h * h + h1 * h1;
        [speed, -(h1 * (h + h2) * speed * speed + G * h1) / inertia, h * speed]
    };
    // by Runge and Kutta's method of order 4; 20,000 steps leave 1e-15
    let (steps, end) = (20_000, 1.5);
    let dt = end / f64::from(steps);
    let mut y = [start, 0.0, 0.0];
    for _ in 0..steps {
        let ahead = |k: [f64; 3], part: f64| std::array::from_fn(|i| y[i] + part * dt * k[i]);
        let k1 = rate(y);
        let k2 = rate(ahead(k1, 0.5));
        let k3 = rate(ahead(k2, 0.5));
        let k4 = rate(ahead(k3, 1.0));
        y = std::array::from_fn(|i| y[i] + dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }

    let height = |phi: f64| libm::hypot(a * libm::sin(phi), c * libm::cos(phi));
    let egg = Body::new("egg", Ellipsoid::new([a, c, c])).position([0.0, 0.0, height(start)]);
    let run = run(&on_floor(egg.orientation(about_y(start))), end);
    let egg = last(&run)[1];
    close(egg.position, [y[2], 0.0, height(y[0])], CLOSE);
    close(egg.angular_velocity, [0.0, y[1], 0.0], 10.0 * CLOSE);
    close(egg.rotation * Vector3::x(), [libm::cos(y[0]), 0.0, -libm::sin(y[0])], 10.0 * CLOSE);
    assert!(run.energy().unwrap().drift() < 1e-9, "{:e}", run.energy().unwrap().drift());
}

#[test]
fn a_coin_rolls_in_a_circle() {
    // it leans inwards by the angle α of its plane to the floor; d points down the slope of its face to the floor, e along
    // its axis, its lowest point ρ = r d − b e from the centre, which goes round at the distance R with Ω:
    // Ω² (I₃ σ sin α − I₁ sin α cos α + m R ρ_z) = −m g ρ_x,  ω = Ω z + s e,  s = −Ω (R + ρ_x)/r,  Ω σ = ω·e
    let (r, b, alpha, distance) = (0.1, 0.005, 1.2, 0.4);
    let (sin, cos) = libm::sincos(alpha);
    let (d, e) = (Vector3::new(cos, 0.0, -sin), Vector3::new(sin, 0.0, cos));
    let rho = r * d - b * e;
    let (i1, i3) = (r * r / 4.0 + b * b / 3.0, r * r / 2.0);
    let sigma = cos - (distance + rho.x) / r;
    let turning = (-G * rho.x / (i3 * sigma * sin - i1 * sin * cos + distance * rho.z)).sqrt();
    let spin = turning * Vector3::z() - turning * (distance + rho.x) / r * e;

    let coin = Body::new("coin", Cylinder::new(r, b)).position([distance, 0.0, -rho.z]).orientation(about_y(alpha));
    let coin = coin.velocity([0.0, turning * distance, 0.0]).angular_velocity(spin);
    let end = 1.0;
    let run = run(&on_floor(coin), end);
    let (s, c) = libm::sincos(turning * end);
    let coin = last(&run)[1];
    close(coin.position, [distance * c, distance * s, -rho.z], CLOSE);
    close(coin.velocity, [-turning * distance * s, turning * distance * c, 0.0], 10.0 * CLOSE);
    close(coin.rotation * Vector3::z(), [sin * c, sin * s, cos], 10.0 * CLOSE);
    assert!(turning > 2.0, "{turning}");
}

#[test]
fn a_cone_rolls_about_its_apex() {
    // on its side, whose line on the floor is at rest: ω = −Ω cot α along it, α half of the opening angle; the centre of
    // mass is ¾ of the height from the apex
    let (r, height, turning, end) = (0.1, 0.3, 1.0, 1.0);
    let slant = libm::hypot(r, height);
    let (sin, cos) = (r / slant, height / slant);
    let center = 0.75 * height;
    let cone = Body::new("cone", Cone::new(r, 0.5 * height))
        .position([center * cos, 0.0, center * sin])
        .orientation(about_y(-std::f64::consts::FRAC_PI_2 - libm::asin(sin)))
        .velocity([0.0, turning * center * cos, 0.0])
        .angular_velocity([-turning * cos / sin, 0.0, 0.0]);
    let run = run(&on_floor(cone), end);
    let (s, c) = libm::sincos(turning * end);
    let cone = last(&run)[1];
    close(cone.position, [center * cos * c, center * cos * s, center * sin], CLOSE);
    close(cone.rotation * Vector3::z(), [-cos * c, -cos * s, -sin], 10.0 * CLOSE);
    close(cone.angular_velocity, [-turning * cos / sin * c, -turning * cos / sin * s, 0.0], 10.0 * CLOSE);
}

#[test]
fn an_egg_that_is_dropped_bounces_and_goes_on_rolling() {
    let egg = Body::new("egg", Ellipsoid::new([0.1, 0.1, 0.15])).position([0.0, 0.0, 0.3]).restitution(0.5);
    let run = run(&on_floor(egg.orientation([0.9, 0.3, 0.1, 0.3])), 4.0);
    let bounces = run.events().iter().filter(|e| e.kind == EventKind::Bounce).count();
    assert!(bounces > 3, "{bounces}");
    assert_eq!(run.end(), 4.0);
    // on the floor and moving: as high as the foremost point of an ellipsoid, √(n·Q n), and no speed there
    let egg = last(&run)[1];
    let n = egg.rotation.transpose() * Vector3::z();
    let scaled = Vector3::new(0.1, 0.1, 0.15).component_mul(&n);
    let lowest = egg.rotation * Vector3::new(0.1, 0.1, 0.15).component_mul(&scaled) / scaled.norm();
    assert!((egg.position.z - scaled.norm()).abs() < CLOSE, "{}", egg.position.z);
    let slip = egg.velocity - egg.angular_velocity.cross(&lowest);
    assert!(slip.norm() < CLOSE && egg.angular_velocity.norm() > 0.1, "{slip}");
    let energy = run.energy().unwrap();
    assert!(energy.drift() < 1e-9, "{:e}", energy.drift());
}

#[test]
fn a_log_rocks_across_a_log_and_rolls_along_it() {
    // the upper one, a straight line on a circle of radius ρ, tilted by θ, touches it ρ θ from its middle, h above the line:
    // (I + m (ρ² θ² + h²)) θ¨ + m ρ² θ θ˙² + m g (ρ θ cos θ − h sin θ) = 0, its middle at ρ n + h n − ρ θ t; it keeps
    // rolling along the top of the lower one, ω = v/h about its own axis, where it does not rock
    let (rho, h, half_length, tilt, end) = (0.25, 0.1, 0.4, 0.3, 0.8);
    let inertia = h * h / 4.0 + half_length * half_length / 3.0;
    let rate = |[angle, w]: [f64; 2]| {
        let (sin, cos) = libm::sincos(angle);
        let pull = rho * rho * angle * w * w + G * (rho * angle * cos - h * sin);
        [w, -pull / (inertia + rho * rho * angle * angle + h * h)]
    };
    // by Runge and Kutta's method of order 4; 20,000 steps leave 1e-15
    let steps = 20_000;
    let dt = end / f64::from(steps);
    let mut y = [tilt, 0.0];
    for _ in 0..steps {
        let ahead = |k: [f64; 2], part: f64| std::array::from_fn(|i| y[i] + part * dt * k[i]);
        let k1 = rate(y);
        let k2 = rate(ahead(k1, 0.5));
        let k3 = rate(ahead(k2, 0.5));
        let k4 = rate(ahead(k3, 1.0));
        y = std::array::from_fn(|i| y[i] + dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    let place = |angle: f64| {
        let (sin, cos) = libm::sincos(angle);
        let (n, t) = (Vector3::new(sin, 0.0, cos), Vector3::new(cos, 0.0, -sin));
        (rho * n + h * n - rho * angle * t, t)
    };
    // the lower one along y, the upper one along x, tilted about y
    let lower = || Body::new("lower", Cylinder::new(rho, 2.0)).orientation(along_y()).fixed().friction(2.0);
    let upper = |angle: f64| {
        let upper = Body::new("upper", Cylinder::new(h, half_length)).mass(1.0).friction(2.0);
        upper.position(place(angle).0).orientation(about_y(std::f64::consts::FRAC_PI_2 + angle))
    };
    let weight = UniformGravity::new([0.0, 0.0, -G]);
    let mut rocks = scene([lower(), upper(tilt)]);
    rocks.add_effect(weight.clone());
    let rocks = run(&rocks, end);
    let log = last(&rocks)[1];
    let (position, t) = place(y[0]);
    close(log.position, position, CLOSE);
    close(log.rotation * Vector3::z(), t, 10.0 * CLOSE);
    close(log.angular_velocity, [0.0, y[1], 0.0], 10.0 * CLOSE);
    assert!(rocks.energy().unwrap().drift() < 1e-9, "{:e}", rocks.energy().unwrap().drift());

    let speed = 0.7;
    let rolls = upper(0.0).velocity([0.0, speed, 0.0]).angular_velocity([-speed / h, 0.0, 0.0]);
    let mut rolling = scene([lower(), rolls]);
    rolling.add_effect(weight);
    let log = last(&run(&rolling, end))[1];
    close(log.position, [0.0, speed * end, rho + h], CLOSE);
    close(log.velocity, [0.0, speed, 0.0], 10.0 * CLOSE);
}

/// The turn that lays the z axis along −y.
fn along_y() -> [f64; 4] {
    [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0]
}

#[test]
fn a_coin_that_turns_into_a_wall_stops_bouncing() {
    // nothing pulls it, but its spin presses its rim to the wall as a load would: bounces with e = 0.3 are below 1e-10
    // of its size after ln(1e-10)/(2 ln 0.3) = 10 of them, one of which may be cut off before or after
    let wall = Body::new("wall", HalfSpace::new([-1.0, 0.0, 0.0], -3.0)).fixed().friction(0.6).restitution(0.3);
    let coin = Body::new("coin", Cylinder::new(0.25, 0.05))
        .mass(4.0)
        .position([1.5, -1.5, -1.5])
        .orientation([-0.0848, -0.6646, -0.1427, 0.7286])
        .velocity([2.16, 2.39, 5.96])
        .angular_velocity([1.25, -5.08, -1.84])
        .friction(0.2);
    let run = run(&scene([wall, coin]), 0.7);
    let bounces = run.events().iter().filter(|event| event.kind == EventKind::Bounce).count();
    assert!((3..=16).contains(&bounces), "{bounces}");
    let energy = run.energy().unwrap();
    assert!(energy.drift() < CLOSE * energy.kinetic[0], "{:e}", energy.drift());
}
