//! Orientation and angular momentum, in each of the forms the library compares.

use super::{Scales, moser_veselov};
use crate::mass::MassProperties;
use crate::math::series::{Attitude, Node, Tape};
use crate::math::sum::two_sum;
use crate::math::{Matrix3, Quaternion, Vector3, quaternion, rotation};
use crate::state::Load;

/// How orientation and angular momentum are written as numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Form {
    /// The lecture's q and L in world axes: `dq/dt = ½ [0, ω] q`, `dL/dt = M`.
    WorldQuaternion,
    /// The lecture's R and L in world axes: `dR/dt = Ω R`, `dL/dt = M`.
    WorldMatrix,
    /// q and L in the body's principal axes: `dq/dt = ½ q [0, ω]`, `dL/dt = L × ω + M`, `ω_i = L_i/I_i`.
    ///
    /// A steady spin is an exact fixed point of this form, and the error of a large component of L
    /// never leaks into a small one.
    Body,
}

/// How the rotation of a body without torque is split into flows that are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotationSplit {
    /// A symmetric top, and a rotation about the axis that makes it one.
    Symmetric,
    /// Rotations about the three principal axes.
    Axes,
    /// One rotation, right to this order.
    MoserVeselov(u32),
}

/// Rotation about a point: orientation, then angular momentum about that point.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Spin {
    form: Form,
    /// Inverse of the inertia about the point, body axes [1/(kg·m²)].
    inv_inertia: Matrix3,
    /// Inverses of the principal moments about the point [1/(kg·m²)].
    inv_moments: Vector3,
    /// Half of them: what turns L into half the angular velocity.
    half_inv_moments: Vector3,
    /// `1/I_k − 1/I_j` of the axes i, j, k in their cycle [1/(kg·m²)].
    gaps: Vector3,
    /// From principal to body axes, where they differ.
    axes: Option<(Quaternion, Matrix3)>,
}

/// Reads three numbers as a vector.
#[inline]
pub(super) fn vector(y: &[f64]) -> Vector3 {
    Vector3::new(y[0], y[1], y[2])
}

/// Writes a vector as three numbers.
#[inline]
pub(super) fn put(y: &mut [f64], v: &Vector3) {
    y[..3].copy_from_slice(v.as_slice());
}

/// Adds a vector to three numbers.
#[inline]
fn add(y: &mut [f64], v: &Vector3) {
    for (y, v) in y.iter_mut().zip(v.iter()) {
        *y += v;
    }
}

#[inline]
fn quaternion_at(y: &[f64]) -> Quaternion {
    Quaternion::new(y[0], y[1], y[2], y[3])
}

#[inline]
fn put_quaternion(y: &mut [f64], q: &Quaternion) {
    y[..4].copy_from_slice(&[q.w, q.i, q.j, q.k]);
}

#[inline]
fn matrix_at(y: &[f64]) -> Matrix3 {
    Matrix3::from_row_slice(&y[..9])
}

fn put_matrix(y: &mut [f64], r: &Matrix3) {
    for row in 0..3 {
        for column in 0..3 {
            y[3 * row + column] = r[(row, column)];
        }
    }
}

impl Spin {
    /// Rotation of a body with this inertia about the point, body axes [kg·m²].
    pub(super) fn new(form: Form, inertia: Matrix3) -> Self {
        let off_diagonal = [inertia[(0, 1)], inertia[(0, 2)], inertia[(1, 2)]];
        let inv_inertia = super::inverse(&inertia);
        let (moments, axes) = if off_diagonal == [0.0; 3] {
            (inertia.diagonal(), None)
        } else {
            let principal = MassProperties { mass: 0.0, center_of_mass: Vector3::zeros(), inertia }.principal();
            (principal.moments, Some((quaternion::from_matrix(&principal.axes), principal.axes)))
        };
        let inv_moments = moments.map(|moment| 1.0 / moment);
        // no difference of inverses: nothing cancels where moments are close
        let gap = |j: usize, k: usize| (moments[j] - moments[k]) * inv_moments[j] * inv_moments[k];
        let gaps = Vector3::new(gap(1, 2), gap(2, 0), gap(0, 1));
        Self { form, inv_inertia, inv_moments, half_inv_moments: 0.5 * inv_moments, gaps, axes }
    }

    /// How orientation and angular momentum are written.
    #[inline(always)]
    pub(crate) fn form(&self) -> Form {
        self.form
    }

    /// Numbers of the orientation.
    #[inline]
    pub(super) fn orientation_dimension(&self) -> usize {
        if self.form == Form::WorldMatrix { 9 } else { 4 }
    }

    #[inline]
    pub(super) fn dimension(&self) -> usize {
        self.orientation_dimension() + 3
    }

    /// The quaternion from principal to body axes, where q is written in the former.
    pub(crate) fn axes(&self) -> Option<Quaternion> {
        self.axes.as_ref().filter(|_| self.form == Form::Body).map(|(axes, _)| *axes)
    }

    /// From the orientation and the angular momentum about the point, world axes.
    pub(super) fn encode(&self, q: &Quaternion, momentum: &Vector3, y: &mut [f64]) {
        match self.form {
            Form::WorldQuaternion => {
                put_quaternion(y, q);
                put(&mut y[4..], momentum);
            }
            Form::WorldMatrix => {
                put_matrix(y, &quaternion::to_matrix(q));
                put(&mut y[9..], momentum);
            }
            Form::Body => {
                let q = self.axes.as_ref().map_or(*q, |(axes, _)| q * axes);
                put_quaternion(y, &q);
                put(&mut y[4..], &quaternion::to_matrix(&q).tr_mul(momentum));
            }
        }
    }

    /// The rotation of `q/|q|`, or of R's polar factor, and the angular velocity, world axes.
    #[inline(always)]
    pub(super) fn decode(&self, y: &[f64]) -> (Quaternion, Matrix3, Vector3) {
        match self.form {
            Form::WorldQuaternion => {
                let q = quaternion::normalized(&quaternion_at(y));
                let r = quaternion::unit_to_matrix(&q);
                (q, r, self.angular_velocity(&r, &vector(&y[4..])))
            }
            Form::WorldMatrix => {
                let r = rotation::polar_factor(&matrix_at(y));
                (quaternion::from_matrix(&r), r, self.angular_velocity(&r, &vector(&y[9..])))
            }
            Form::Body => {
                let principal = quaternion::normalized(&quaternion_at(y));
                let w = self.inv_moments.component_mul(&vector(&y[4..]));
                let (q, w) = match &self.axes {
                    None => (principal, w),
                    Some((axes, matrix)) => (principal * axes.conjugate(), matrix * w),
                };
                let r = quaternion::unit_to_matrix(&q);
                (q, r, r * w)
            }
        }
    }

    /// Inverses of the principal moments about the point [1/(kg·m²)].
    pub(super) fn inv_moments(&self) -> &Vector3 {
        &self.inv_moments
    }

    /// `1/I_k − 1/I_j` of the principal axes i, j, k in their cycle [1/(kg·m²)].
    pub(super) fn gaps(&self) -> &Vector3 {
        &self.gaps
    }

    /// `I⁻¹ v`, body axes.
    pub(super) fn over_inertia(&self, v: &Vector3) -> Vector3 {
        self.inv_inertia * v
    }

    /// `ω = R I⁻¹ Rᵀ L`, lecture (20).
    #[inline(always)]
    fn angular_velocity(&self, r: &Matrix3, momentum: &Vector3) -> Vector3 {
        let momentum_body = r.tr_mul(momentum);
        match self.axes {
            None => r * self.inv_moments.component_mul(&momentum_body),
            Some(_) => r * (self.inv_inertia * momentum_body),
        }
    }

    /// `(dq/dt or dR/dt, dL/dt)` under a torque about the point, world axes; `r` and `w` as decoded.
    #[inline(always)]
    pub(super) fn rate(&self, y: &[f64], r: &Matrix3, w: &Vector3, torque: &Vector3, dy: &mut [f64]) {
        match self.form {
            Form::WorldQuaternion => {
                put_quaternion(dy, &quaternion::rate_world(w, &quaternion_at(y)));
                put(&mut dy[4..], torque);
            }
            Form::WorldMatrix => {
                put_matrix(dy, &(rotation::cross_matrix(w) * matrix_at(y)));
                put(&mut dy[9..], torque);
            }
            Form::Body => {
                let torque_body = r.tr_mul(torque);
                let torque = self.axes.as_ref().map_or(torque_body, |(_, axes)| axes.tr_mul(&torque_body));
                self.rate_body(y, dy);
                add(&mut dy[4..], &torque);
            }
        }
    }

    /// A vector of the body in the axes that the orientation leads from: the principal ones in the body form.
    pub(super) fn own_axes(&self, v: &Vector3) -> Vector3 {
        self.axes.as_ref().filter(|_| self.form == Form::Body).map_or(*v, |(_, axes)| axes.tr_mul(v))
    }

    /// The same under a load of which the force acts at `arm` from the point, [own axes](Self::own_axes). In the body
    /// form the torque is `arm × Rᵀ F + Rᵀ M`: nothing of the motion is read but what turns F and M.
    #[inline(always)]
    pub(super) fn rate_constant(&self, y: &[f64], arm: &Vector3, load: &Load, dy: &mut [f64]) {
        if self.form == Form::Body {
            let q = quaternion_at(y);
            let (force, n) = quaternion::turned_back(&q, &load.force);
            let mut torque = arm.cross(&force);
            if load.torque != Vector3::zeros() {
                torque += quaternion::turned_back(&q, &load.torque).0;
            }
            self.rate_body(y, dy);
            add(&mut dy[4..], &(torque * (1.0 / n)));
        } else {
            let (_, r, w) = self.decode(y);
            self.rate(y, &r, &w, &(load.torque + (r * arm).cross(&load.force)), dy);
        }
    }

    /// The same without a torque.
    #[inline(always)]
    pub(super) fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        match self.form {
            Form::Body => self.rate_body(y, dy),
            Form::WorldMatrix => {
                let (_, r, w) = self.decode(y);
                self.rate(y, &r, &w, &Vector3::zeros(), dy);
            }
            Form::WorldQuaternion => {
                // ω in body axes, I⁻¹ Rᵀ L with |q|² R in the place of R: the division waits for nothing
                let q = quaternion_at(y);
                let (r, n) = quaternion::to_scaled_matrix(&q);
                let momentum = r.tr_mul(&vector(&y[4..]));
                let w = match self.axes {
                    None => (self.inv_moments * (1.0 / n)).component_mul(&momentum),
                    Some(_) => (self.inv_inertia * momentum) * (1.0 / n),
                };
                put_quaternion(dy, &quaternion::rate_body(&w, &q));
                put(&mut dy[4..], &Vector3::zeros());
            }
        }
    }

    /// Euler's equations without torque, principal axes: `dL_i/dt = (1/I_k − 1/I_j) L_j L_k`.
    #[inline(always)]
    fn rate_body(&self, y: &[f64], dy: &mut [f64]) {
        let [a, b, c] = [y[4], y[5], y[6]];
        let half = &self.half_inv_moments;
        let dq = quaternion::turned([y[0], y[1], y[2], y[3]], [half.x * a, half.y * b, half.z * c]);
        dy[..4].copy_from_slice(&dq);
        put(&mut dy[4..], &self.gaps.component_mul(&Vector3::new(b * c, c * a, a * b)));
    }

    /// The rotation on a tape, its numbers from `at` on: attitude, angular momentum and angular velocity in principal
    /// axes, and the matrix from these to body axes.
    pub(super) fn begin_series(&self, at: usize, tape: &mut Tape) -> (Attitude, Node, Node, Matrix3) {
        let momentum = tape.numbers(at + 4, 3);
        let w = tape.stretched(momentum, self.inv_moments);
        tape.turning(at, w);
        let axes = self.axes.as_ref().map_or_else(Matrix3::identity, |(_, axes)| *axes);
        (Attitude::Quaternion(at), momentum, w, axes)
    }

    /// Euler's equations on a tape: torque in principal axes.
    pub(super) fn end_series(&self, momentum: Node, torque: Option<Node>, tape: &mut Tape) {
        let mut rate = tape.gyration(momentum, self.inv_moments);
        if let Some(torque) = torque {
            rate = tape.sum(rate, 1.0, torque);
        }
        tape.integrate(momentum, rate);
    }

    /// Advances the rotation without torque by `h`, principal axes; `rest` takes up what rounding drops.
    #[inline]
    pub(super) fn flow(&self, y: &mut [f64], rest: &mut [f64], h: f64, split: RotationSplit) {
        let mut turn = Turn { y, rest };
        let a = &self.inv_moments;
        match split {
            RotationSplit::Axes => {
                turn.about_axis(0, 0.5 * h * a[0]);
                turn.about_axis(1, 0.5 * h * a[1]);
                turn.about_axis(2, h * a[2]);
                turn.about_axis(1, 0.5 * h * a[1]);
                turn.about_axis(0, 0.5 * h * a[0]);
            }
            RotationSplit::MoserVeselov(order) => {
                let (c, e) = moser_veselov::rotation(&vector(&turn.y[4..]), a, h, order);
                turn.turn_all(c, &e);
            }
            RotationSplit::Symmetric => {
                // i and j are the axes with the closest moments, k is the axis of the top
                let gap = |i: usize, j: usize| (a[i] - a[j]).abs();
                let (i, j, k) = if gap(0, 1) <= gap(1, 2) { (0, 1, 2) } else { (1, 2, 0) };
                let (i, j, k) = if gap(0, 2) < gap(i, j) { (0, 2, 1) } else { (i, j, k) };
                turn.about_axis(i, 0.5 * h * (a[i] - a[j]));
                turn.about_momentum(h * a[j]);
                turn.about_axis(k, h * (a[k] - a[j]));
                turn.about_axis(i, 0.5 * h * (a[i] - a[j]));
            }
        }
    }

    /// Turns the rate of the orientation into the angular velocity, in the first three numbers.
    pub(crate) fn to_generator(&self, y: &[f64], k: &mut [f64]) {
        let w = match self.form {
            // dR/dt Rᵀ is Ω, up to its symmetric part where R is off the rotations
            Form::WorldMatrix => {
                let s = matrix_at(k) * rotation::polar_factor(&matrix_at(y)).transpose();
                0.5 * Vector3::new(s[(2, 1)] - s[(1, 2)], s[(0, 2)] - s[(2, 0)], s[(1, 0)] - s[(0, 1)])
            }
            form => {
                let (q, dq) = (quaternion_at(y), quaternion_at(k));
                let product = if form == Form::Body { q.conjugate() * dq } else { dq * q.conjugate() };
                2.0 / q.norm_squared() * product.imag()
            }
        };
        put(k, &w);
        k[3..self.orientation_dimension()].fill(0.0);
    }

    /// `exp(h v)` on orientation and angular momentum.
    pub(crate) fn act(&self, y: &mut [f64], h: f64, v: &[f64]) {
        let n = self.orientation_dimension();
        let turn = quaternion::exp(&(h * vector(v)));
        match self.form {
            Form::WorldMatrix => put_matrix(y, &(quaternion::to_matrix(&turn) * matrix_at(y))),
            Form::WorldQuaternion => put_quaternion(y, &(turn * quaternion_at(y))),
            Form::Body => put_quaternion(y, &(quaternion_at(y) * turn)),
        }
        for i in n..n + 3 {
            y[i] += h * v[i];
        }
    }

    /// `a += c (a × b)` on the angular velocities of two generators.
    #[expect(clippy::unused_self, reason = "the place of the angular velocity is the form's")]
    pub(crate) fn add_bracket(&self, c: f64, a: &mut [f64], b: &[f64]) {
        let sum = vector(a) + c * vector(a).cross(&vector(b));
        put(a, &sum);
    }

    /// Amends the change `dy` so that the orientation does not leave its sphere: one division by the length, or one
    /// polar factor; returns how far it had strayed.
    ///
    /// ```text
    /// q + dq  ←  (1 + c)(q + dq),   c = 1/|q| − 1 = −e/2 + 3e²/8 − 5e³/16 + 35e⁴/128 − …,   e = |q|² − 1
    /// ```
    ///
    /// The length is that before the step, and the stray of the step itself is for the next to take away. The rates
    /// are proportional to |q|, so that the rotation is the same, and the length is known before the step has ended.
    /// The small correction joins the change before it is added, so that no digit of it is rounded off.
    #[inline(always)]
    pub(super) fn project(&self, y: &[f64], rest: &[f64], dy: &mut [f64]) -> f64 {
        if self.form == Form::WorldMatrix {
            let r = matrix_at(y) + (matrix_at(dy) + matrix_at(rest));
            put_matrix(dy, &((rotation::polar_factor(&r) - matrix_at(y)) - matrix_at(rest)));
            return rotation::orthogonality_error(&r);
        }
        let e = (y[0] * y[0] + y[1] * y[1]) + (y[2] * y[2] + y[3] * y[3]) - 1.0;
        let (c, strayed) = if e.abs() < SMALL_STRAY {
            (small_correction(e), e.abs() * (0.5 - 0.125 * e))
        } else {
            (large_correction(e), ((1.0 + e).sqrt() - 1.0).abs())
        };
        for (dy, y) in dy[..4].iter_mut().zip(y) {
            *dy = (1.0 + c) * *dy + c * y;
        }
        strayed
    }

    pub(super) fn orientation_error(&self, y: &[f64]) -> f64 {
        match self.form {
            Form::WorldMatrix => rotation::orthogonality_error(&matrix_at(y)),
            _ => (quaternion_at(y).norm_squared().sqrt() - 1.0).abs(),
        }
    }

    /// Size of an error: of the orientation in radians, of L over its own size, or over `I/time`.
    #[inline]
    pub(super) fn error_size(&self, y0: &[f64], y1: &[f64], e: &[f64], scales: &Scales) -> f64 {
        let n = self.orientation_dimension();
        let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();

        // a rotation by δ changes q by δ/2, and R by √2 δ
        let angle = length(&e[..n]) * if n == 9 { std::f64::consts::FRAC_1_SQRT_2 } else { 2.0 };
        let least = 1.0 / (self.inv_moments.amax() * scales.time);
        let momentum = length(&y0[n..n + 3]).max(length(&y1[n..n + 3])).max(least);
        angle.max(length(&e[n..n + 3]) / momentum)
    }
}

/// Stray of `|q|²` below which four terms of the series are exact to rounding [-]: e⁵/4 < 1e-18.
pub(crate) const SMALL_STRAY: f64 = 3.0e-4;

/// The correction `c = 1/|q| − 1` for a stray `e = |q|² − 1` below [`SMALL_STRAY`].
#[inline(always)]
pub(crate) fn small_correction(e: f64) -> f64 {
    e * ((-0.5 + e * 0.375) + e * e * (-0.3125 + e * 0.2734375))
}

/// The same for any stray.
#[inline(always)]
pub(crate) fn large_correction(e: f64) -> f64 {
    let length = (1.0 + e).sqrt();
    (1.0 - length) / length
}

/// A body that is turned by known rotations: q and L in its own axes, as seven numbers, each with its rest.
///
/// Rotations are added as changes, `(cos − 1) v + sin …` with `cos − 1 = −2 sin²` of half the angle, so that
/// the rests keep the digits that many small rotations would round off.
struct Turn<'a> {
    y: &'a mut [f64],
    rest: &'a mut [f64],
}

impl Turn<'_> {
    #[inline]
    fn change(&mut self, i: usize, by: f64) {
        (self.y[i], self.rest[i]) = two_sum(self.y[i], by + self.rest[i]);
    }

    /// `q ← q (1 + [c, v])`
    #[inline]
    fn turn(&mut self, c: f64, v: &Vector3) {
        let (w, u) = (self.y[0], vector(&self.y[1..]));
        let by = c * u + w * v + u.cross(v);
        self.change(0, c * w - u.dot(v));
        for i in 0..3 {
            self.change(1 + i, by[i]);
        }
    }

    /// The same, and L seen from the body turns the other way, `L ← L − 2 (1 + c) v × L + 2 v × (v × L)`.
    fn turn_all(&mut self, c: f64, v: &Vector3) {
        self.turn(c, v);
        let across = v.cross(&vector(&self.y[4..]));
        let by = 2.0 * (v.cross(&across) - (1.0 + c) * across);
        for i in 0..3 {
            self.change(4 + i, by[i]);
        }
    }

    /// The flow of `½ r L_i²` for a unit of time: a rotation about the axis i by the angle `r L_i`.
    #[inline]
    fn about_axis(&mut self, i: usize, r: f64) {
        let (s4, c4) = libm::sincos(0.25 * r * self.y[4 + i]);
        let (s, c) = (2.0 * s4 * c4, 1.0 - 2.0 * s4 * s4);
        let mut axis = Vector3::zeros();
        axis[i] = s;
        self.turn(-2.0 * s4 * s4, &axis);

        // L seen from the body turns the other way, by the whole angle
        let (j, k) = (4 + (i + 1) % 3, 4 + (i + 2) % 3);
        let (sin, less) = (2.0 * s * c, -2.0 * s * s);
        let (lj, lk) = (self.y[j], self.y[k]);
        self.change(j, less * lj + sin * lk);
        self.change(k, less * lk - sin * lj);
    }

    /// The flow of `½ a |L|²` for a unit of time: a rotation about L, which stays.
    #[inline]
    fn about_momentum(&mut self, a: f64) {
        let momentum = vector(&self.y[4..]);
        let length = momentum.norm();
        if length > 0.0 {
            let (s4, c4) = libm::sincos(0.25 * a * length);
            self.turn(-2.0 * s4 * s4, &(2.0 * s4 * c4 / length * momentum));
        }
    }
}
