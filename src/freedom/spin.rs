//! Orientation and angular momentum, in each of the forms the library compares.

use super::Scales;
use crate::mass::MassProperties;
use crate::math::{Matrix3, Quaternion, Vector3, quaternion, rotation};

/// How orientation and angular momentum are written as numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
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

/// Rotation about a point: orientation, then angular momentum about that point.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Spin {
    form: Form,
    /// Inverse of the inertia about the point, body axes [1/(kg·m²)].
    inv_inertia: Matrix3,
    /// Inverses of the principal moments about the point [1/(kg·m²)].
    inv_moments: Vector3,
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
        if off_diagonal == [0.0; 3] {
            let inv_moments = inertia.diagonal().map(|moment| 1.0 / moment);
            return Self { form, inv_inertia, inv_moments, axes: None };
        }
        let principal = MassProperties { mass: 0.0, center_of_mass: Vector3::zeros(), inertia }.principal();
        let axes = Some((quaternion::from_matrix(&principal.axes), principal.axes));
        Self { form, inv_inertia, inv_moments: principal.moments.map(|moment| 1.0 / moment), axes }
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
    #[inline]
    pub(super) fn decode(&self, y: &[f64]) -> (Quaternion, Matrix3, Vector3) {
        match self.form {
            Form::WorldQuaternion => {
                let q = quaternion_at(y);
                let r = quaternion::to_matrix(&q);
                (quaternion::normalized(&q), r, self.angular_velocity(&r, &vector(&y[4..])))
            }
            Form::WorldMatrix => {
                let r = rotation::polar_factor(&matrix_at(y));
                (quaternion::from_matrix(&r), r, self.angular_velocity(&r, &vector(&y[9..])))
            }
            Form::Body => {
                let q = quaternion_at(y);
                let r = quaternion::to_matrix(&q);
                let w = r * self.inv_moments.component_mul(&vector(&y[4..]));
                match &self.axes {
                    None => (quaternion::normalized(&q), r, w),
                    Some((axes, matrix)) => (quaternion::normalized(&q) * axes.conjugate(), r * matrix.transpose(), w),
                }
            }
        }
    }

    /// `I⁻¹ v`, body axes.
    pub(super) fn over_inertia(&self, v: &Vector3) -> Vector3 {
        self.inv_inertia * v
    }

    /// `ω = R I⁻¹ Rᵀ L`, lecture (20).
    #[inline]
    fn angular_velocity(&self, r: &Matrix3, momentum: &Vector3) -> Vector3 {
        r * (self.inv_inertia * r.tr_mul(momentum))
    }

    /// `(dq/dt or dR/dt, dL/dt)` under a torque about the point, world axes; `r` and `w` as decoded.
    #[inline]
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
                self.rate_body(y, &torque, dy);
            }
        }
    }

    /// The same without a torque.
    #[inline]
    pub(super) fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        if self.form == Form::Body {
            self.rate_body(y, &Vector3::zeros(), dy);
        } else {
            let (_, r, w) = self.decode(y);
            self.rate(y, &r, &w, &Vector3::zeros(), dy);
        }
    }

    /// Euler's equations: torque in principal axes.
    #[inline]
    fn rate_body(&self, y: &[f64], torque: &Vector3, dy: &mut [f64]) {
        let momentum = vector(&y[4..]);
        let w = self.inv_moments.component_mul(&momentum);
        put_quaternion(dy, &quaternion::rate_body(&w, &quaternion_at(y)));
        put(&mut dy[4..], &(momentum.cross(&w) + torque));
    }

    /// What leads the orientation back to its sphere; returns how far it has strayed.
    ///
    /// ```text
    /// Δq = q (1 − |q|)/|q|        ΔR = polar factor of R − R
    /// ```
    #[inline]
    pub(super) fn correction(&self, y: &[f64], dy: &mut [f64]) -> f64 {
        if self.form == Form::WorldMatrix {
            let r = matrix_at(y);
            put_matrix(dy, &(rotation::polar_factor(&r) - r));
            dy[9..12].fill(0.0);
            rotation::orthogonality_error(&r)
        } else {
            let q = quaternion_at(y);
            let length = q.norm_squared().sqrt();
            put_quaternion(dy, &(q * ((1.0 - length) / length)));
            dy[4..7].fill(0.0);
            (length - 1.0).abs()
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
