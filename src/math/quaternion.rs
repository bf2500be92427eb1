//! Quaternions (lecture §5).
//!
//! A quaternion is written scalar first, `(w, x, y, z)`, in every argument, file and printout;
//! nalgebra's type keeps it `(x, y, z, w)` inside. Products (26) and the conjugate (29) are
//! nalgebra's `*` and `conjugate`. `q` and `−q` are the same rotation.

use wide::f64x2;

use crate::math::{Matrix3, Quaternion, Vector3};

/// The quaternion with the components `(w, x, y, z)`, scalar first.
pub fn from_scalar_first(wxyz: [f64; 4]) -> Quaternion {
    Quaternion::new(wxyz[0], wxyz[1], wxyz[2], wxyz[3])
}

/// The components `(w, x, y, z)`, scalar first.
pub fn to_scalar_first(q: &Quaternion) -> [f64; 4] {
    [q.w, q.i, q.j, q.k]
}

/// `q/|q|`, the rotation that a quaternion off the unit sphere stands for.
#[inline]
pub fn normalized(q: &Quaternion) -> Quaternion {
    q * (1.0 / q.norm_squared().sqrt())
}

/// Rotation by `angle` [rad] about the unit vector `axis`: `[cos(θ/2), sin(θ/2) u]`, lecture (25).
pub fn from_axis_angle(axis: &Vector3, angle: f64) -> Quaternion {
    let (s, c) = libm::sincos(0.5 * angle);
    Quaternion::from_parts(c, s * axis)
}

/// Exponential map: the rotation by the angle `|φ|` [rad] about the direction of `φ`.
pub fn exp(phi: &Vector3) -> Quaternion {
    let angle = phi.norm();
    if angle < SMALL_ANGLE {
        // sin(θ/2)/θ = ½ − θ²/48 + θ⁴/3840: the next term is below rounding
        let a2 = angle * angle;
        return Quaternion::from_parts(1.0 - a2 / 8.0 + a2 * a2 / 384.0, (0.5 - a2 / 48.0 + a2 * a2 / 3840.0) * phi);
    }
    let (s, c) = libm::sincos(0.5 * angle);
    Quaternion::from_parts(c, s / angle * phi)
}

/// Logarithm of a unit quaternion: the rotation vector `φ` [rad] with `|φ| ≤ π` and `exp(φ) = ±q`.
pub fn log(q: &Quaternion) -> Vector3 {
    let v = if q.w < 0.0 { -q.imag() } else { q.imag() };
    let s = v.norm();
    let half = libm::atan2(s, q.w.abs());
    if s < 1e-8 {
        // tan(θ/2) = θ/2 to rounding, and s² may underflow
        return 2.0 * v;
    }
    2.0 * half / s * v
}

/// Angle below which the series of the exponential map is exact to rounding [rad]: θ⁶ < 1e-16.
const SMALL_ANGLE: f64 = 2.0e-3;

/// `dq/dt = ½ [0, ω] q` with ω in world axes, lecture (27).
#[inline]
pub fn rate_world(w: &Vector3, q: &Quaternion) -> Quaternion {
    let (s, v, w) = (q.w, q.imag(), 0.5 * w);
    Quaternion::from_parts(-w.dot(&v), s * w + w.cross(&v))
}

/// `dq/dt = ½ q [0, ω]` with ω in body axes, lecture (27).
#[inline]
pub fn rate_body(w: &Vector3, q: &Quaternion) -> Quaternion {
    let w = 0.5 * w;
    let [s, i, j, k] = turned([q.w, q.i, q.j, q.k], [w.x, w.y, w.z]);
    Quaternion::new(s, i, j, k)
}

/// `q [0, v]`, q scalar first: the rate of a quaternion from half the angular velocity [rad/s], body axes, lecture (27).
/// In pairs of numbers, on which the processor works at once.
#[inline(always)]
pub(crate) fn turned([w, i, j, k]: [f64; 4], v: [f64; 3]) -> [f64; 4] {
    let [a, b, c] = v.map(f64x2::splat);
    let [wi, jk, iw, kj] = [[w, i], [j, k], [-i, w], [-k, j]].map(f64x2::from);
    let [wi, jk] = [a * iw - b * jk + c * kj, b * wi + c * iw - a * kj].map(f64x2::to_array);
    [wi[0], wi[1], jk[0], jk[1]]
}

/// `|q|² Rᵀ v` and `|q|²`, for a formula that divides later.
///
/// ```text
/// q = [w, u]     q* [0, v] q = (w² − u·u) v + 2 ((u·v) u − w u × v)
/// ```
#[inline(always)]
pub(crate) fn turned_back(q: &Quaternion, v: &Vector3) -> (Vector3, f64) {
    let (w, u) = (q.w, q.imag());
    let (ww, uu) = (w * w, u.norm_squared());
    ((ww - uu) * v + 2.0 * (u.dot(v) * u - w * u.cross(v)), ww + uu)
}

/// The matrix of the rotation `q/|q|`, lecture §5.
///
/// ```text
/// ⎡ 1−2(y²+z²)   2(xy−wz)    2(xz+wy)  ⎤
/// ⎢ 2(xy+wz)     1−2(x²+z²)  2(yz−wx)  ⎥
/// ⎣ 2(xz−wy)     2(yz+wx)    1−2(x²+y²)⎦     for |q| = 1
/// ```
///
/// The sign at (1,3) is misprinted in the lecture. Off the unit sphere 2 becomes `2/|q|²`, which
/// needs no square root.
#[inline]
pub fn to_matrix(q: &Quaternion) -> Matrix3 {
    let (w, x, y, z) = (q.w, q.i, q.j, q.k);
    matrix_with(q, 2.0 / (w * w + x * x + y * y + z * z))
}

/// The same for `|q| = 1`.
#[inline]
pub fn unit_to_matrix(q: &Quaternion) -> Matrix3 {
    matrix_with(q, 2.0)
}

/// The matrix of the lecture with `k` in the place of 2.
#[inline(always)]
fn matrix_with(q: &Quaternion, k: f64) -> Matrix3 {
    let (w, x, y, z) = (q.w, q.i, q.j, q.k);
    let (kx, ky, kz) = (k * x, k * y, k * z);
    let (xx, yy, zz) = (kx * x, ky * y, kz * z);
    let (xy, xz, yz) = (kx * y, kx * z, ky * z);
    let (wx, wy, wz) = (kx * w, ky * w, kz * w);
    Matrix3::new(
        1.0 - (yy + zz),
        xy - wz,
        xz + wy, //
        xy + wz,
        1.0 - (xx + zz),
        yz - wx, //
        xz - wy,
        yz + wx,
        1.0 - (xx + yy),
    )
}

/// `|q|² R` and `|q|²`, for a formula that divides later.
#[inline(always)]
pub fn to_scaled_matrix(q: &Quaternion) -> (Matrix3, f64) {
    let (w, x, y, z) = (q.w, q.i, q.j, q.k);
    let (ww, xx, yy, zz) = (w * w, x * x, y * y, z * z);
    let (xy, xz, yz, wx, wy, wz) = (x * y, x * z, y * z, w * x, w * y, w * z);
    let (wpx, ypz, wmx, ymz) = (ww + xx, yy + zz, ww - xx, yy - zz);
    let r = Matrix3::new(
        wpx - ypz,
        2.0 * (xy - wz),
        2.0 * (xz + wy), //
        2.0 * (xy + wz),
        wmx + ymz,
        2.0 * (yz - wx), //
        2.0 * (xz - wy),
        2.0 * (yz + wx),
        wmx - ymz,
    );
    (r, wpx + ypz)
}

/// The unit quaternion of a rotation matrix, with `w ≥ 0` where w leads (Shepperd 1978,
/// J. Guidance Control 1:223).
///
/// Of the four ways to begin, the one that divides by the largest component is taken, so that no
/// digits cancel.
pub fn from_matrix(r: &Matrix3) -> Quaternion {
    let (d0, d1, d2) = (r[(0, 0)], r[(1, 1)], r[(2, 2)]);
    let trace = d0 + d1 + d2;
    let q = if trace >= d0 && trace >= d1 && trace >= d2 {
        Quaternion::new(1.0 + trace, r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)])
    } else if d0 >= d1 && d0 >= d2 {
        Quaternion::new(r[(2, 1)] - r[(1, 2)], 1.0 + d0 - d1 - d2, r[(0, 1)] + r[(1, 0)], r[(0, 2)] + r[(2, 0)])
    } else if d1 >= d2 {
        Quaternion::new(r[(0, 2)] - r[(2, 0)], r[(0, 1)] + r[(1, 0)], 1.0 + d1 - d2 - d0, r[(1, 2)] + r[(2, 1)])
    } else {
        Quaternion::new(r[(1, 0)] - r[(0, 1)], r[(0, 2)] + r[(2, 0)], r[(1, 2)] + r[(2, 1)], 1.0 + d2 - d0 - d1)
    };
    normalized(&q)
}

/// Rotates a vector from body to world, `v′ = q v q*`, lecture (28); `q` of unit length.
#[inline]
pub fn rotate(q: &Quaternion, v: &Vector3) -> Vector3 {
    // v + 2 w (u × v) + 2 u × (u × v) with u the vector part
    let u = q.imag();
    let t = 2.0 * u.cross(v);
    v + q.w * t + u.cross(&t)
}

/// The angle [rad] of the rotation that takes `a` to `b`, in 0..=π. It knows that q and −q agree,
/// and keeps its relative accuracy down to the smallest angles.
pub fn angle_between(a: &Quaternion, b: &Quaternion) -> f64 {
    let d = a.conjugate() * b;
    2.0 * libm::atan2(d.imag().norm(), d.w.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rotation::{cross_matrix, elementary_x, elementary_y, elementary_z, orthogonality_error};

    const ROUNDING: f64 = 16.0 * f64::EPSILON;

    fn samples() -> Vec<Quaternion> {
        // every branch of `from_matrix`, signs of every component, and turns of exactly π
        let mut all = Vec::new();
        for w in [-1.0, -0.3, 0.0, 0.1, 2.0] {
            for x in [-0.7, 0.0, 1.0] {
                for y in [-0.2, 0.0, 1.5] {
                    for z in [-1.1, 0.0, 0.4] {
                        let q = Quaternion::new(w, x, y, z);
                        if q.norm() > 0.0 {
                            all.push(normalized(&q));
                        }
                    }
                }
            }
        }
        all
    }

    #[test]
    fn units_multiply_as_hamilton_carved_them() {
        let one = Quaternion::new(1.0, 0.0, 0.0, 0.0);
        let (i, j, k) = (
            Quaternion::new(0.0, 1.0, 0.0, 0.0),
            Quaternion::new(0.0, 0.0, 1.0, 0.0),
            Quaternion::new(0.0, 0.0, 0.0, 1.0),
        );
        for product in [i * i, j * j, k * k, i * j * k] {
            assert_eq!(product, -one);
        }
        assert_eq!((i * j, j * k, k * i), (k, i, j));
        assert_eq!((j * i, k * j, i * k), (-k, -i, -j));
    }

    #[test]
    fn product_is_lecture_26() {
        let (a, b) = (Quaternion::new(0.3, -1.0, 2.0, 0.5), Quaternion::new(-0.7, 0.25, 1.0, -3.0));
        let (s1, v1, s2, v2) = (a.w, a.imag(), b.w, b.imag());
        let expected = Quaternion::from_parts(s1 * s2 - v1.dot(&v2), s1 * v2 + s2 * v1 + v1.cross(&v2));
        assert!((a * b - expected).norm() < ROUNDING * a.norm() * b.norm());
    }

    #[test]
    fn matrix_and_back_is_the_same_rotation_on_every_branch() {
        for q in samples() {
            let r = to_matrix(&q);
            assert!(orthogonality_error(&r) < ROUNDING);
            assert!((r.determinant() - 1.0).abs() < ROUNDING);
            assert!(angle_between(&q, &from_matrix(&r)) < ROUNDING, "{q}");
        }
    }

    #[test]
    fn q_and_minus_q_are_one_rotation() {
        for q in samples() {
            assert_eq!(to_matrix(&q), to_matrix(&-q));
            assert!(angle_between(&q, &-q) < ROUNDING);
        }
    }

    #[test]
    fn a_quaternion_off_the_sphere_stands_for_its_direction() {
        for q in samples() {
            assert!((to_matrix(&(3.7 * q)) - to_matrix(&q)).norm() < ROUNDING);
        }
    }

    #[test]
    fn rotating_is_the_sandwich_28_and_the_matrix() {
        let v = Vector3::new(1.0, -2.0, 0.5);
        for q in samples() {
            let sandwich = (q * Quaternion::from_imag(v) * q.conjugate()).imag();
            assert!((rotate(&q, &v) - sandwich).norm() < ROUNDING * v.norm());
            assert!((to_matrix(&q) * v - sandwich).norm() < ROUNDING * v.norm());
        }
    }

    #[test]
    fn elementary_rotations_are_quaternions_about_the_axes() {
        for angle in [-3.0, -0.4, 1e-9, 0.7, 3.1] {
            for (axis, r) in [
                (Vector3::x(), elementary_x(angle)),
                (Vector3::y(), elementary_y(angle)),
                (Vector3::z(), elementary_z(angle)),
            ] {
                assert!((to_matrix(&from_axis_angle(&axis, angle)) - r).norm() < ROUNDING);
                assert!((to_matrix(&exp(&(angle * axis))) - r).norm() < ROUNDING);
            }
        }
    }

    #[test]
    fn log_undoes_exp_from_tiny_angles_to_a_half_turn() {
        let u = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        for angle in [0.0, 1e-300, 1e-12, 1e-4, 1.9e-3, 2.1e-3, 0.5, 3.0, 3.13] {
            let q = exp(&(angle * u));
            assert!((q.norm() - 1.0).abs() < ROUNDING);
            assert!((log(&q) - angle * u).norm() <= ROUNDING * angle.max(f64::MIN_POSITIVE), "{angle}");
        }
    }

    #[test]
    fn both_forms_of_27_and_7_agree() {
        // dR/dt = Ω R against the derivative of the matrix of q, by the product rule on (28)
        let q = normalized(&Quaternion::new(0.3, -1.0, 2.0, 0.5));
        let w = Vector3::new(0.2, 1.5, -0.7);
        let r = to_matrix(&q);
        assert!((rate_world(&w, &q) - rate_body(&(r.transpose() * w), &q)).norm() < ROUNDING);
        let dq = rate_world(&w, &q);
        let from_q = Matrix3::from_columns(&[Vector3::x(), Vector3::y(), Vector3::z()].map(|e| {
            let e = Quaternion::from_imag(e);
            (dq * e * q.conjugate() + q * e * dq.conjugate()).imag()
        }));
        assert!((from_q - cross_matrix(&w) * r).norm() < ROUNDING);
    }

    #[test]
    fn r_from_q_follows_r_from_7() {
        // a constant ω: exp(t ω) q₀ solves (27), and R = matrix of exp(t ω) R₀ solves (7)
        let (w, q0) = (Vector3::new(0.4, -0.3, 0.8), normalized(&Quaternion::new(1.0, 2.0, 3.0, 4.0)));
        let at = |t: f64| to_matrix(&(exp(&(t * w)) * q0));
        // central difference of fourth order: truncation ω⁵ h⁴/30 < 1e-13, rounding ε/h
        let (t, h) = (0.7, 1e-3);
        let slope = (8.0 * (at(t + h) - at(t - h)) - (at(t + 2.0 * h) - at(t - 2.0 * h))) / (12.0 * h);
        assert!((slope - cross_matrix(&w) * at(t)).norm() < 2e-12);
    }
}
