//! Orientation and angular momentum, in each of the forms the library compares.

use crate::math::{Matrix3, Quaternion, Vector3, quaternion, rotation};

/// How orientation and angular momentum are written as numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Form {
    /// The lecture's q and L in world axes: `dq/dt = ½ [0, ω] q`, `dL/dt = M`.
    WorldQuaternion,
    /// The lecture's R and L in world axes: `dR/dt = Ω R`, `dL/dt = M`.
    WorldMatrix,
    /// q and L in body axes: `dq/dt = ½ q [0, ω]`, `dL/dt = L × ω + M`.
    ///
    /// A steady spin is an exact fixed point of this form, and the error of a large component of L
    /// never leaks into a small one.
    Body,
}

/// Rotation about a point: orientation, then angular momentum about that point.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Spin {
    pub(super) form: Form,
    /// Inverse of the inertia about the point, body axes [1/(kg·m²)].
    pub(super) inv_inertia: Matrix3,
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
        let n = self.orientation_dimension();
        match self.form {
            Form::WorldMatrix => put_matrix(y, &quaternion::to_matrix(q)),
            _ => put_quaternion(y, q),
        }
        match self.form {
            Form::Body => put(&mut y[n..], &quaternion::to_matrix(q).tr_mul(momentum)),
            _ => put(&mut y[n..], momentum),
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
                (quaternion::normalized(&q), r, r * (self.inv_inertia * vector(&y[4..])))
            }
        }
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
            Form::Body => self.rate_body(y, &r.tr_mul(torque), dy),
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

    /// Euler's equations: torque in body axes.
    #[inline]
    fn rate_body(&self, y: &[f64], torque_body: &Vector3, dy: &mut [f64]) {
        let momentum = vector(&y[4..]);
        let w = self.inv_inertia * momentum;
        put_quaternion(dy, &quaternion::rate_body(&w, &quaternion_at(y)));
        put(&mut dy[4..], &(momentum.cross(&w) + torque_body));
    }

    /// One division by the length, or one polar factor; returns how far it had strayed.
    #[inline]
    pub(super) fn project(&self, y: &mut [f64]) -> f64 {
        if self.form == Form::WorldMatrix {
            let r = matrix_at(y);
            put_matrix(y, &rotation::polar_factor(&r));
            rotation::orthogonality_error(&r)
        } else {
            let q = quaternion_at(y);
            let length = q.norm_squared().sqrt();
            put_quaternion(y, &(q / length));
            (length - 1.0).abs()
        }
    }

    pub(super) fn orientation_error(&self, y: &[f64]) -> f64 {
        match self.form {
            Form::WorldMatrix => rotation::orthogonality_error(&matrix_at(y)),
            _ => (quaternion_at(y).norm() - 1.0).abs(),
        }
    }
}
