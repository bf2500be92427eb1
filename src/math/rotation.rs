//! Rotations as matrices (lecture §1 and §2).

use crate::math::{Matrix3, Vector3};

/// Rotation by `angle` [rad] about the x axis, lecture (2).
pub fn elementary_x(angle: f64) -> Matrix3 {
    let (s, c) = libm::sincos(angle);
    Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
}

/// Rotation by `angle` [rad] about the y axis, lecture (3).
pub fn elementary_y(angle: f64) -> Matrix3 {
    let (s, c) = libm::sincos(angle);
    Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
}

/// Rotation by `angle` [rad] about the z axis, lecture (4).
pub fn elementary_z(angle: f64) -> Matrix3 {
    let (s, c) = libm::sincos(angle);
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// The matrix Ω of a vector, lecture (8): `Ω(ω) r = ω × r`, so that `dR/dt = Ω R` (7).
pub fn cross_matrix(w: &Vector3) -> Matrix3 {
    Matrix3::new(0.0, -w.z, w.y, w.z, 0.0, -w.x, -w.y, w.x, 0.0)
}

/// Distance of `R` from an orthogonal matrix: `‖RᵀR − I‖` in the Frobenius norm [-].
pub fn orthogonality_error(r: &Matrix3) -> f64 {
    (r.tr_mul(r) - Matrix3::identity()).norm()
}

/// The rotation nearest to `R`: its orthogonal polar factor.
///
/// ```text
/// R ← ½ (R + R⁻ᵀ),  R⁻ᵀ = [r₂×r₃  r₃×r₁  r₁×r₂] / det R
/// ```
///
/// Newton's iteration converges quadratically from any matrix of positive determinant
/// (Higham 1986, SIAM J. Sci. Stat. Comput. 7:1160). Where the determinant is not positive there is
/// no nearest rotation to speak of, and the answer is not finite.
pub fn polar_factor(r: &Matrix3) -> Matrix3 {
    let mut q = *r;
    for _ in 0..POLAR_ROUNDS {
        let (a, b, c) = (q.column(0), q.column(1), q.column(2));
        let cofactors = Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)]);
        let det = a.dot(&cofactors.column(0));
        if det <= 0.0 {
            return Matrix3::from_element(f64::NAN);
        }
        let next = 0.5 * (q + cofactors / det);
        let change = (next - q).norm_squared();
        q = next;

        // the error is squared each round: a change below √ε leaves it below rounding
        if change <= f64::EPSILON {
            break;
        }
    }
    q
}

/// Rounds of Newton's iteration [-]. Matrices that a step has bent need 2 or 3; 60 halvings bring
/// down even a matrix 1e15 times too long.
const POLAR_ROUNDS: u32 = 64;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::quaternion;

    #[test]
    fn rotations_do_not_commute_and_the_commutator_is_of_second_order() {
        // lecture (5): for small angles the commutator is a b Ω(e₃) up to third order
        for (a, b) in [(1e-2, 2e-2), (1e-3, 2e-3), (1e-4, 2e-4)] {
            let commutator = elementary_x(a) * elementary_y(b) - elementary_y(b) * elementary_x(a);
            let second_order = cross_matrix(&Vector3::z()) * (a * b);
            assert!(commutator.norm() > 0.9 * 2f64.sqrt() * a * b);
            assert!((commutator - second_order).norm() < a * b * (a + b));
        }
    }

    #[test]
    fn elementary_rotations_turn_the_axes_right_handed() {
        let quarter = std::f64::consts::FRAC_PI_2;
        for (r, from, to) in [
            (elementary_x(quarter), Vector3::y(), Vector3::z()),
            (elementary_y(quarter), Vector3::z(), Vector3::x()),
            (elementary_z(quarter), Vector3::x(), Vector3::y()),
        ] {
            assert!((r * from - to).norm() < 4.0 * f64::EPSILON);
        }
    }

    #[test]
    fn cross_matrix_is_the_cross_product() {
        let (w, r) = (Vector3::new(1.0, -2.0, 3.0), Vector3::new(0.5, 0.25, -4.0));
        assert_eq!(cross_matrix(&w) * r, w.cross(&r));
    }

    #[test]
    fn polar_factor_is_orthogonal_and_leaves_rotations_alone() {
        let r = quaternion::to_matrix(&quaternion::exp(&Vector3::new(0.3, -1.2, 2.0)));
        assert!((polar_factor(&r) - r).norm() < 8.0 * f64::EPSILON);
        let bent = r + Matrix3::new(0.1, -0.2, 0.05, 0.0, 0.1, 0.1, -0.1, 0.0, 0.2);
        let q = polar_factor(&bent);
        assert!(orthogonality_error(&q) < 8.0 * f64::EPSILON);
        // Q is the polar factor exactly where QᵀB is symmetric and positive
        let stretch = q.tr_mul(&bent);
        assert!((stretch - stretch.transpose()).norm() < 16.0 * f64::EPSILON);
        assert!(polar_factor(&-r)[(0, 0)].is_nan());
    }
}
