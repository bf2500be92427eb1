//! Exact solutions: what tests, benches and examples measure against.
//!
//! | function | motion | solved by |
//! |---|---|---|
//! | [`closed_form`] | a whole scene of free bodies under gravity and linear drag | the rows below |
//! | [`symmetric_body`] | free rotation, two equal moments | two uniform rotations |
//! | [`free_fall`] | uniform acceleration | a parabola |
//! | [`linear_drag`] | drag proportional to speed, wind, gravity | exponentials |
//! | [`quadratic_drag_fall`] | vertical motion under quadratic drag | tan, tanh, ln cosh |
//! | [`spin_down`] | a wheel slowed in proportion to its speed | exponentials |
//! | [`damped_oscillator`] | spring and damper in one dimension | all three kinds in one form |
//! | [`Pendulum`] | a body on a horizontal axle | Jacobi's functions |
//! | [`SteadyPrecession`] | the regular precession of a symmetric heavy top | two uniform rotations |
//!
//! Free rotation of any body is [`FreeRotation`](FreeRotation).
//! Inputs are finite and inertial quantities positive; each item says what else it asks for.

use crate::effect::{AnyEffect, Drag};
use crate::freedom::Freedom;
use crate::integrator::free_rotation::FreeRotation;
use crate::mass::PrincipalAxes;
use crate::math::elliptic::{complete_k, incomplete_f, jacobi};
use crate::math::{Quaternion, Vector3, quaternion};
use crate::plan::Plan;
use crate::state::BodyState;

/// States of all bodies of a plan after `t` [s], where the scene has a closed form: every moving body is
/// free, flies alone, meets nothing, and nothing acts on it but uniform gravity and linear drag on its
/// translation.
pub fn closed_form(plan: &Plan, t: f64) -> Option<Vec<BodyState>> {
    let mut states: Vec<_> = plan.bodies().iter().map(|body| body.start.state()).collect();
    for group in plan.groups() {
        let &[index] = group.members.as_slice() else { return None };
        let body = &plan.bodies()[index];
        if body.freedom != Freedom::Free || !group.pairs.is_empty() {
            return None;
        }

        // translation: gravity adds up, and one drag may slow it
        let (mut g, mut rate, mut wind) = (Vector3::zeros(), 0.0, Vector3::zeros());
        for binding in &group.bindings {
            match &*binding.effect {
                AnyEffect::UniformGravity(gravity) => g += Vector3::from(gravity.acceleration),
                AnyEffect::Drag(Drag { linear, quadratic, angular_linear, angular_quadratic, wind: w, .. })
                    if rate == 0.0 && [*quadratic, *angular_linear, *angular_quadratic] == [0.0; 3] =>
                {
                    rate = linear / body.properties.mass;
                    wind = Vector3::from(*w);
                }
                _ => return None,
            }
        }
        let (x, v) = linear_drag(&body.start.position, &body.start.velocity, &g, &wind, rate, t);

        // rotation: free
        let PrincipalAxes { moments, axes } = body.properties.principal();
        let l_body = body.start.inertia_body * body.start.angular_velocity_body();
        let (q, _) = FreeRotation::new(moments, axes, body.start.orientation, l_body).at(t);
        states[index] = BodyState {
            position: x,
            orientation: q,
            linear_momentum: body.properties.mass * v,
            angular_momentum: body.start.angular_momentum(),
        };
    }
    Some(states)
}

/// Orientation (body to world) at time `t` [s] of a free body with the moments `(I₁, I₁, I₃)` [kg m²].
///
/// ```text
/// R(t) = exp(t L/I₁) R₀ exp(t (1 − I₃/I₁) ω₃ e₃)
/// ```
///
/// L [kg m²/s] in world axes is `R₀` times the given momentum in body axes; `e₃` is the third body axis and
/// ω₃ = L₃/I₃. The momentum in body axes follows as `R(t)ᵀ L`.
pub fn symmetric_body(
    i1: f64,
    i3: f64,
    orientation: &Quaternion,
    angular_momentum_body: &Vector3,
    t: f64,
) -> Quaternion {
    let q0 = quaternion::normalized(orientation);
    let l = quaternion::rotate(&q0, angular_momentum_body);
    // (1 − I₃/I₁) L₃/I₃ = L₃ (I₁ − I₃)/(I₁ I₃): the difference first
    let spin = angular_momentum_body.z * ((i1 - i3) / (i1 * i3));
    quaternion::exp(&(t / i1 * l)) * q0 * quaternion::from_axis_angle(&Vector3::z(), t * spin)
}

/// Position [m] and velocity [m/s] at time `t` [s] under a constant acceleration `g` [m/s²].
///
/// ```text
/// x = x₀ + v₀ t + ½ g t²        v = v₀ + g t
/// ```
pub fn free_fall(position: &Vector3, velocity: &Vector3, g: &Vector3, t: f64) -> (Vector3, Vector3) {
    (position + t * (velocity + 0.5 * t * g), velocity + t * g)
}

/// Position [m] and velocity [m/s] at time `t` [s] of a body that drag slows in proportion to its speed
/// through the air, `v′ = g − k (v − wind)`, with `k = linear/m` [1/s], zero included.
///
/// ```text
/// v = v₀ + (g − k (v₀ − wind)) t φ₁        x = x₀ + v₀ t + (g − k (v₀ − wind)) t² φ₂
/// φ₁ = (1 − e^(−kt))/(kt)                  φ₂ = (1 − φ₁)/(kt)
/// ```
///
/// In this form nothing cancels when drag is weak: φ₁ → 1, φ₂ → ½.
pub fn linear_drag(
    position: &Vector3,
    velocity: &Vector3,
    g: &Vector3,
    wind: &Vector3,
    k: f64,
    t: f64,
) -> (Vector3, Vector3) {
    let (phi1, phi2) = decay_functions(k * t);
    let start = g - k * (velocity - wind);
    (position + t * (velocity + t * phi2 * start), velocity + t * phi1 * start)
}

/// `φ₁(z) = (1 − e^(−z))/z` and `φ₂(z) = (1 − φ₁)/z = (z − 1 + e^(−z))/z²`.
fn decay_functions(z: f64) -> (f64, f64) {
    if z.abs() < 0.5 {
        // φ₂ = Σ (−z)ⁿ/(n + 2)!, to rounding after 15 terms; φ₁ = 1 − z φ₂
        let mut phi2 = 0.0;
        for n in (0..15).rev() {
            phi2 = (1.0 - z * phi2) / f64::from(n + 2);
        }
        return (1.0 - z * phi2, phi2);
    }
    let phi1 = -libm::expm1(-z) / z;
    (phi1, (1.0 - phi1) / z)
}

/// Distance fallen [m] and downward speed [m/s] after `t ≥ 0` [s], from the downward speed `v0` [m/s] (negative:
/// thrown upward), under gravity `g` > 0 [m/s²] and drag `k v|v|`, `k = quadratic/m` > 0 [1/m].
///
/// ```text
/// v′ = g − k v |v|        V = √(g/k)        s = t g/V
/// up:    v = −V tan(φ − s)                                 x = (V²/g) ln(cos φ/cos(φ − s))     φ = atan(−v₀/V)
/// down:  v = V (v₀ + V tanh s)/(V + v₀ tanh s)             x = (V²/g) ln(cosh s + v₀/V sinh s)
/// ```
///
/// A throw upward turns at `s = φ` and falls from rest.
pub fn quadratic_drag_fall(v0: f64, g: f64, k: f64, t: f64) -> (f64, f64) {
    let terminal = (g / k).sqrt();
    let (s, r) = (t * g / terminal, v0 / terminal);
    if v0 < 0.0 {
        let phi = libm::atan(-r);
        if s < phi {
            return (libm::log(libm::cos(phi) / libm::cos(phi - s)) / k, -terminal * libm::tan(phi - s));
        }
        let (fallen, v) = quadratic_drag_fall(0.0, g, k, (t - phi * terminal / g).max(0.0));
        return (fallen + libm::log(libm::cos(phi)) / k, v);
    }
    let tanh = libm::tanh(s);
    // ln(cosh s + r sinh s) = s + ln(1 + ½ (1 − r) (e^(−2s) − 1))
    let x = s + libm::log1p(0.5 * (1.0 - r) * libm::expm1(-2.0 * s));
    (x / k, terminal * (r + tanh) / (1.0 + r * tanh))
}

/// Angle turned [rad] and rate [rad/s] after `t` [s] of a spin about a principal axis that drag slows:
/// `I ω′ = −d ω`, with `k = d/I` [1/s], zero included.
///
/// ```text
/// ω = ω₀ e^(−kt)        θ = ω₀ (1 − e^(−kt))/k
/// ```
pub fn spin_down(rate: f64, k: f64, t: f64) -> (f64, f64) {
    (rate * t * decay_functions(k * t).0, rate * libm::exp(-k * t))
}

/// Position [m] and velocity [m/s] after `t ≥ 0` [s] of `m x″ + c x′ + k x = 0`.
///
/// ```text
/// δ = c/2m      Ω² = k/m − δ²
/// x = e^(−δt) [x₀ C + (v₀ + δ x₀) t S]        C, S = cos Ωt, sin(Ωt)/(Ωt)      Ω² > 0, underdamped
/// v = e^(−δt) [v₀ C − (δ v₀ + k x₀/m) t S]           cosh |Ω|t, sinh(|Ω|t)/(|Ω|t)   Ω² < 0, overdamped
///                                                    1, 1                           Ω² = 0, critical
/// ```
pub fn damped_oscillator(m: f64, c: f64, k: f64, x0: f64, v0: f64, t: f64) -> (f64, f64) {
    let (delta, stiffness) = (0.5 * c / m, k / m);
    let omega2 = stiffness - delta * delta;
    let z = omega2 * t * t;
    let (cosine, sine) = if z.abs() < 1e-2 {
        // the series of both kinds in z = ±(Ωt)², to rounding after six terms
        let decay = libm::exp(-delta * t);
        let cosine = 1.0 - z / 2.0 * (1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0 * (1.0 - z / 90.0))));
        let sine = 1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0))));
        (decay * cosine, decay * sine)
    } else if z > 0.0 {
        let omega_t = z.sqrt();
        let (s, c) = libm::sincos(omega_t);
        let decay = libm::exp(-delta * t);
        (decay * c, decay * s / omega_t)
    } else {
        // e^(−δt) cosh and sinh from the two roots, the slow one without cancelling
        let omega = (-omega2).sqrt();
        let (slow, fast) = (libm::exp(-stiffness / (delta + omega) * t), libm::exp(-(delta + omega) * t));
        (0.5 * (slow + fast), 0.5 * (slow - fast) / (omega * t))
    };
    (x0 * cosine + (v0 + delta * x0) * t * sine, v0 * cosine - (delta * v0 + stiffness * x0) * t * sine)
}

/// A body on a horizontal axle: `θ″ = −Ω² sin θ`, `Ω² = m g d/I`, with θ from the lower rest.
///
/// ```text
/// k² = sin²(θ₀/2) + (θ₀′/2Ω)²
/// k < 1:  sin(θ/2) = k sn(Ωt + u₀ | k²)      θ′ = 2kΩ cn          swings, period 4K(k²)/Ω
/// k > 1:  θ/2 = am(kΩt + u₀ | 1/k²)          θ′ = ±2kΩ dn         turns over, period 2K(1/k²)/(kΩ)
/// ```
///
/// Close to k = 1 the complement `1 − k² = cos²(θ₀/2) − (θ₀′/2Ω)²` holds as many digits as the inputs give.
/// DLMF 22.19.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pendulum {
    frequency: f64,
    kind: Kind,
    /// u at t = 0.
    start: f64,
    /// θ at t = 0 less what the solution counts, whole turns [rad].
    turns: f64,
    m: f64,
    m1: f64,
}

/// The two ways a pendulum moves.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// k of the swing.
    Swings(f64),
    /// ±k of the turning over, with the sign of the rate.
    TurnsOver(f64),
}

impl Pendulum {
    /// The pendulum of small-swing frequency `frequency` Ω [rad/s] from an angle [rad] and a rate [rad/s].
    pub fn new(frequency: f64, angle: f64, rate: f64) -> Self {
        let (s, c) = libm::sincos(0.5 * angle);
        let w = 0.5 * rate / frequency;
        let (k2, k1) = (s * s + w * w, (c - w) * (c + w));
        if k1 > 0.0 {
            // (sn, cn) at the start are (sin(θ/2), w)/k; cos(θ/2) ≥ 0 is dn, its sign a whole turn
            let k = k2.sqrt();
            let (sn, cn) = if k == 0.0 { (0.0, 1.0) } else { (s.copysign(s * c) / k, w / k) };
            let start = incomplete_f(cn, sn, k2, k1);
            let own = 2.0 * libm::atan2(s.copysign(s * c), c.abs());
            return Self { frequency, kind: Kind::Swings(k), start, turns: angle - own, m: k2, m1: k1 };
        }
        // am at the start is θ/2, taken the way the body turns
        let sign = 1f64.copysign(rate);
        let half = libm::atan2(sign * s.copysign(s * c), c.abs());
        let (sin, cos) = libm::sincos(half);
        let (m, m1) = (1.0 / k2, -k1 / k2);
        let start = incomplete_f(cos, sin, m, m1);
        Self { frequency, kind: Kind::TurnsOver(sign * k2.sqrt()), start, turns: angle - 2.0 * sign * half, m, m1 }
    }

    /// Time of one whole swing, or of one turn over the top [s]; infinite between the two.
    pub fn period(&self) -> f64 {
        let k = complete_k(self.m, self.m1);
        match self.kind {
            Kind::Swings(_) => 4.0 * k / self.frequency,
            Kind::TurnsOver(modulus) => 2.0 * k / (modulus.abs() * self.frequency),
        }
    }

    /// Angle [rad], counted through all turns, and rate [rad/s] at time `t` [s].
    pub fn at(&self, t: f64) -> (f64, f64) {
        match self.kind {
            Kind::Swings(k) => {
                let f = jacobi(self.start + self.frequency * t, self.m, self.m1);
                (self.turns + 2.0 * libm::atan2(k * f.sn, f.dn), 2.0 * k * self.frequency * f.cn)
            }
            Kind::TurnsOver(k) => {
                let f = jacobi(self.start + k.abs() * self.frequency * t, self.m, self.m1);
                (self.turns + (2.0 * f.am).copysign(k * f.am), 2.0 * k * self.frequency * f.dn)
            }
        }
    }
}

/// The regular precession of a symmetric top: its axis circles the vertical at a constant tilt.
///
/// ```text
/// I₁ Ω² cos θ − I₃ ω₃ Ω + m g c = 0        R(t) = Rz(Ωt) Rx(θ) Rz((ω₃ − Ω cos θ) t)
/// ```
///
/// Moments are about the fixed point; the centre of mass lies at `c e₃` from it, gravity points along −z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyPrecession {
    /// Moments about the fixed point, across and along the axis [kg m²].
    pub moments: [f64; 2],
    /// m g c, positive where the centre of mass is above the fixed point when upright [N m].
    pub weight: f64,
    /// θ, from the upright vertical [rad].
    pub tilt: f64,
    /// Ω, of the axis about the vertical [rad/s]; not zero.
    pub precession: f64,
}

impl SteadyPrecession {
    /// ω₃, the component along the axis of the angular velocity that this precession needs [rad/s].
    pub fn spin(&self) -> f64 {
        let [i1, i3] = self.moments;
        (i1 * self.precession * libm::cos(self.tilt) + self.weight / self.precession) / i3
    }

    /// The slow and the fast precession Ω [rad/s] of a top with spin `ω₃` [rad/s], or none if it spins too slowly.
    ///
    /// `Ω = 2 m g c/(I₃ω₃ ± √(I₃²ω₃² − 4 I₁ m g c cos θ))`; with a level axis the fast one is infinite.
    pub fn rates(moments: [f64; 2], weight: f64, tilt: f64, spin: f64) -> Option<(f64, f64)> {
        let [i1, i3] = moments;
        let l3 = i3 * spin;
        let lever = i1 * libm::cos(tilt);
        let discriminant = l3 * l3 - 4.0 * lever * weight;
        if discriminant < 0.0 {
            return None;
        }
        // the larger root of I₁ cos θ Ω² − I₃ω₃ Ω + mgc by the sum, the smaller by the product
        let sum = l3 + discriminant.sqrt().copysign(l3);
        Some((2.0 * weight / sum, 0.5 * sum / lever))
    }

    /// Orientation (body to world) and momentum about the fixed point in body axes [kg m²/s] at time `t` [s].
    pub fn at(&self, t: f64) -> (Quaternion, Vector3) {
        let [i1, i3] = self.moments;
        let (sin, cos) = libm::sincos(self.tilt);
        let spin = self.spin();
        let own = (spin - self.precession * cos) * t;
        let q = quaternion::from_axis_angle(&Vector3::z(), self.precession * t)
            * quaternion::from_axis_angle(&Vector3::x(), self.tilt)
            * quaternion::from_axis_angle(&Vector3::z(), own);
        let (s, c) = libm::sincos(own);
        let across = i1 * self.precession * sin;
        (q, Vector3::new(across * s, across * c, i3 * spin))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::integrator::free_rotation::FreeRotation;
    use crate::math::Matrix3;

    /// The classical Runge–Kutta method in many short steps: truncation ~ t h⁴/100 below 1e-13 for the problems
    /// here, rounding `√steps ε`; solutions are compared to 2e-12 of their size.
    fn integrate<const N: usize>(f: impl Fn(&[f64; N]) -> [f64; N], start: [f64; N], t: f64) -> [f64; N] {
        let steps = 20_000;
        let h = t / f64::from(steps);
        let add = |y: &[f64; N], k: &[f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
        let mut y = start;
        for _ in 0..steps {
            let k1 = f(&y);
            let k2 = f(&add(&y, &k1, 0.5 * h));
            let k3 = f(&add(&y, &k2, 0.5 * h));
            let k4 = f(&add(&y, &k3, h));
            for i in 0..N {
                y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
            }
        }
        y
    }

    const TRUNCATION: f64 = 2e-12;

    fn close(a: f64, b: f64, what: &str) {
        assert!((a - b).abs() <= TRUNCATION * (1.0 + b.abs()), "{what}: {a} {b}");
    }

    #[test]
    fn a_symmetric_body_is_the_general_solution_of_two_equal_moments() {
        // two formulas of one motion, each good to a few ε per radian
        let q = Quaternion::new(0.5, -0.5, 0.5, 0.5);
        for (i1, i3) in [(1.0, 2.0), (1.0, 0.3), (0.7, 0.7), (1.0, 1e-6)] {
            let l = Vector3::new(0.3, -0.4, if i3 < 1e-3 { 1e-6 } else { 1.7 * i3 });
            let general = FreeRotation::new(Vector3::new(i1, i1, i3), Matrix3::identity(), q, l);
            for t in [-30.0, 0.0, 0.4, 100.0] {
                let mine = symmetric_body(i1, i3, &q, &l, t);
                let turned = t.abs() * (l.norm() / i1 + (l.z / i3).abs());
                assert!(quaternion::angle_between(&mine, &general.at(t).0) < 8.0 * f64::EPSILON * (1.0 + turned));
            }
        }
    }

    #[test]
    fn projectiles_solve_their_equations() {
        let (x0, v0, g) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(5.0, -3.0, 10.0), Vector3::new(0.0, 0.0, -9.81));
        let wind = Vector3::new(-2.0, 1.0, 0.0);
        for k in [0.0, 1e-9, 1e-3, 0.24, 0.26, 2.0, 40.0] {
            for t in [0.5, 2.0] {
                let (x, v) = linear_drag(&x0, &v0, &g, &wind, k, t);
                for i in 0..3 {
                    let [a, b] = integrate(|y| [y[1], g[i] - k * (y[1] - wind[i])], [x0[i], v0[i]], t);
                    close(x[i], a, "x");
                    close(v[i], b, "v");
                }
                if k == 0.0 {
                    let (fall_x, fall_v) = free_fall(&x0, &v0, &g, t);
                    assert!((fall_x - x).norm() + (fall_v - v).norm() < 16.0 * f64::EPSILON * x.norm());
                }
            }
        }
    }

    #[test]
    fn the_two_forms_of_the_decay_functions_meet() {
        let (below, above) = (decay_functions(0.5 - 1e-16), decay_functions(0.5));
        assert!((below.0 - above.0).abs() < 2.0 * f64::EPSILON && (below.1 - above.1).abs() < 4.0 * f64::EPSILON);
    }

    #[test]
    fn quadratic_drag_solves_its_equation_up_over_the_top_and_down() {
        for v0 in [-30.0, -1.0, 0.0, 3.0, 20.0, 80.0] {
            for k in [1e-3, 0.024, 0.2] {
                for t in [0.1, 1.0, 4.0] {
                    // the right side has a kink in its second derivative at rest: stop there, if it comes
                    let terminal = (9.81f64 / k).sqrt();
                    let top = libm::atan(-v0 / terminal) * terminal / 9.81;
                    let slope = |y: &[f64; 2]| [y[1], 9.81 - k * y[1] * y[1].abs()];
                    let truth = if v0 < 0.0 && top < t {
                        let [x, _] = integrate(slope, [0.0, v0], top);
                        integrate(slope, [x, 0.0], t - top)
                    } else {
                        integrate(slope, [0.0, v0], t)
                    };
                    let (x, v) = quadratic_drag_fall(v0, 9.81, k, t);
                    close(x, truth[0], "x");
                    close(v, truth[1], "v");
                }
            }
        }
    }

    #[test]
    fn a_wheel_spins_down() {
        for k in [0.0, 1e-7, 0.3, 4.0] {
            let (angle, rate) = spin_down(7.0, k, 3.0);
            let truth = integrate(|y| [y[1], -k * y[1]], [0.0, 7.0], 3.0);
            close(angle, truth[0], "angle");
            close(rate, truth[1], "rate");
        }
    }

    #[test]
    fn the_oscillator_solves_its_equation_on_both_sides_of_critical_damping() {
        for c in [0.0, 0.1, 3.9, 3.999_999_999, 4.0, 4.000_000_001, 4.1, 9.0, 60.0] {
            for t in [0.0, 0.3, 2.0, 10.0] {
                let (x, v) = damped_oscillator(1.0, c, 4.0, 0.7, -1.5, t);
                let truth = integrate(|y| [y[1], -c * y[1] - 4.0 * y[0]], [0.7, -1.5], t);
                close(x, truth[0], "x");
                close(v, truth[1], "v");
            }
        }
        // e^(−δt) and cosh |Ω|t would overflow apart from each other
        assert!(damped_oscillator(1.0, 1e4, 1.0, 1.0, 0.0, 10.0).0.is_finite());
    }

    #[test]
    fn the_pendulum_solves_its_equation_swinging_and_turning_over() {
        for (angle, rate) in [
            (0.0, 0.0),
            (1e-6, 0.0),
            (0.4, -0.3),
            (-2.0, 1.0),
            (3.0, 0.0),
            (3.1, 0.1),
            (0.0, 3.99),
            (0.0, 4.01),
            (0.0, -4.5),
            (2.5, 3.0),
            (-2.5, -9.0),
            (7.0, 0.5),
            (-5.0, -6.0),
            (PI, 1.0),
        ] {
            let pendulum = Pendulum::new(2.0, angle, rate);
            for t in [-1.0, 0.0, 0.1, 1.0, 3.0] {
                let mine = pendulum.at(t);
                let truth = integrate(|y| [y[1], -4.0 * libm::sin(y[0])], [angle, rate], t);
                // errors near the top grow by e^(Ωt)
                let tolerance = TRUNCATION * 10.0;
                assert!((mine.0 - truth[0]).abs() < tolerance, "{angle} {rate} {t}: {mine:?} {truth:?}");
                assert!((mine.1 - truth[1]).abs() < tolerance, "{angle} {rate} {t}: {mine:?} {truth:?}");
            }
        }
    }

    #[test]
    fn the_period_of_the_pendulum_brings_it_back() {
        for (angle, rate) in [(0.3, 0.0), (0.0, 3.9), (0.0, 4.1), (1.0, -5.0)] {
            let pendulum = Pendulum::new(2.0, angle, rate);
            let (after, speed) = pendulum.at(pendulum.period());
            let whole = if rate.abs() > 4.0 { 2.0 * PI.copysign(rate) } else { 0.0 };
            assert!((after - angle - whole).abs() < 64.0 * f64::EPSILON, "{angle} {rate}: {after}");
            assert!((speed - rate).abs() < 64.0 * f64::EPSILON);
        }
        // Huygens: small swings take 2π/Ω, longer by the factor 1 + θ²/16
        assert!((Pendulum::new(2.0, 1e-3, 0.0).period() / PI - 1.0 - 1e-6 / 16.0).abs() < 1e-13);
    }

    #[test]
    fn steady_precession_solves_the_equations_of_the_heavy_top() {
        for (tilt, precession) in [(0.4, 2.0), (0.4, -2.0), (1.2, 9.0), (2.5, 0.7)] {
            let top = SteadyPrecession { moments: [0.3, 0.1], weight: 1.3, tilt, precession };
            let (q0, l0) = top.at(0.0);
            let start = [q0.w, q0.i, q0.j, q0.k, l0.x, l0.y, l0.z];
            let slope = |y: &[f64; 7]| {
                let q = Quaternion::new(y[0], y[1], y[2], y[3]);
                let l = Vector3::new(y[4], y[5], y[6]);
                let w = Vector3::new(l.x / 0.3, l.y / 0.3, l.z / 0.1);
                let up = quaternion::rotate(&q.conjugate(), &Vector3::z());
                let dq = quaternion::rate_body(&w, &q);
                let dl = l.cross(&w) - 1.3 * Vector3::z().cross(&up);
                [dq.w, dq.i, dq.j, dq.k, dl.x, dl.y, dl.z]
            };
            let y = integrate(slope, start, 3.0);
            let (q, l) = top.at(3.0);
            // 30 times the plain tolerance: fast spins of up to 40 rad/s
            let tolerance = 30.0 * TRUNCATION;
            assert!(quaternion::angle_between(&q, &Quaternion::new(y[0], y[1], y[2], y[3])) < tolerance);
            assert!((l - Vector3::new(y[4], y[5], y[6])).norm() < tolerance);

            // the rate is one of the two that its spin allows
            let (slow, fast) = SteadyPrecession::rates(top.moments, top.weight, tilt, top.spin()).unwrap();
            let miss = (slow - precession).abs().min((fast - precession).abs());
            assert!(miss < 64.0 * f64::EPSILON * precession.abs(), "{slow} {fast} {precession}");
        }
        assert_eq!(SteadyPrecession::rates([0.3, 0.1], 1.3, 0.4, 1.0), None);
    }
}
