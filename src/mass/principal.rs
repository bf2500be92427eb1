//! Principal moments and axes, by Jacobi's rotations.
//!
//! ```text
//! I = A diag(I₁, I₂, I₃) Aᵀ      I₁ ≤ I₂ ≤ I₃      det A = +1
//! ```
//!
//! A Jacobi rotation turns two axes so that one off-diagonal entry vanishes; sweeps over the three
//! entries converge quadratically (Golub and Van Loan, Matrix Computations §8.5). Entries already
//! below the rounding of their two diagonal entries are left alone, so a diagonal tensor keeps its
//! moments to the last bit, and a thin rod along a shape axis its small moment (Demmel and Veselić
//! 1992, SIAM J. Matrix Anal. 13:1204).
//!
//! The moments are then read off anew as Rayleigh quotients with 32 digits. Their error is of second
//! order in the axes' error, so each moment is right to the last digits **of its own size**, also
//! where the smallest is 1e-14 of the largest. What stays lost is what the tensor's own 16 digits do not
//! hold: entries of a slanted rod are rounded to 1e-16 of the largest moment.

use crate::mass::MassProperties;
use crate::math::double_double::DoubleDouble;
use crate::math::{Matrix3, Vector3};

/// Principal moments of inertia and the axes they belong to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalAxes {
    /// Moments, ascending [kg m²].
    pub moments: Vector3,
    /// The axes as columns, shape axes: a rotation from principal to shape axes. In the first two
    /// columns the entry of largest magnitude is positive (the first of equals); the third is their
    /// cross product. Where moments coincide, the axes among them are one choice of many.
    pub axes: Matrix3,
}

impl MassProperties {
    /// Principal moments and axes.
    pub fn principal(&self) -> PrincipalAxes {
        diagonalise(&self.inertia)
    }

    /// Principal moments, ascending [kg m²].
    pub fn principal_moments(&self) -> Vector3 {
        self.principal().moments
    }

    /// Principal axes as columns, shape axes; signs as in [`PrincipalAxes::axes`].
    pub fn principal_axes(&self) -> Matrix3 {
        self.principal().axes
    }
}

/// Bound on the sweeps [-]. Convergence is quadratic: of 1.8 million random and nearly degenerate
/// tensors none needed more than five, the last of which finds nothing to turn.
const SWEEPS: usize = 16;

/// Moments and axes of a symmetric tensor.
fn diagonalise(tensor: &Matrix3) -> PrincipalAxes {
    let (mut a, mut axes, mut sweeps) = (*tensor, Matrix3::identity(), 0);
    while sweeps < SWEEPS {
        let turned = [(0, 1), (0, 2), (1, 2)].map(|(p, q)| annihilate(&mut a, &mut axes, p, q));
        if turned == [false; 3] {
            break;
        }
        sweeps += 1;
    }

    // moments from the tensor itself, ascending; equal ones in the order found. Of axes that were not turned they are
    // the diagonal, to the last bit
    let moments = match sweeps {
        0 => tensor.diagonal().into(),
        _ => [0, 1, 2].map(|k| rayleigh_quotient(tensor, &axes.column(k).into())),
    };
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| moments[i].total_cmp(&moments[j]));

    // signs: two by their largest entries, the third by the right hand
    let [first, second, third] = order.map(|k| axes.column(k).into_owned());
    let (first, second) = (facing_forward(first), facing_forward(second));
    let third = if first.cross(&second).dot(&third) < 0.0 { -third } else { third };
    PrincipalAxes {
        moments: Vector3::from(order.map(|k| moments[k])),
        axes: Matrix3::from_columns(&[first, second, third]),
    }
}

/// Turns axes `p` and `q` so that `a[p, q]` vanishes; false where it already is below rounding.
fn annihilate(a: &mut Matrix3, axes: &mut Matrix3, p: usize, q: usize) -> bool {
    let (app, aqq, apq) = (a[(p, p)], a[(q, q)], a[(p, q)]);
    if apq.abs() <= 0.25 * f64::EPSILON * (app.abs().sqrt() * aqq.abs().sqrt()) {
        return false;
    }

    // the smaller of the two angles: t² + 2 t cot 2θ − 1 = 0
    let cot = (aqq - app) / (2.0 * apq);
    let t = 1.0f64.copysign(cot) / (cot.abs() + (1.0 + cot * cot).sqrt());
    let c = 1.0 / (1.0 + t * t).sqrt();
    let s = t * c;

    let r = 3 - p - q;
    let (arp, arq) = (a[(r, p)], a[(r, q)]);
    a[(p, p)] = app - t * apq;
    a[(q, q)] = aqq + t * apq;
    for (i, j, value) in [(p, q, 0.0), (r, p, c * arp - s * arq), (r, q, s * arp + c * arq)] {
        a[(i, j)] = value;
        a[(j, i)] = value;
    }
    let (u, v) = (axes.column(p).into_owned(), axes.column(q).into_owned());
    axes.set_column(p, &(c * u - s * v));
    axes.set_column(q, &(s * u + c * v));
    true
}

/// `vᵀ I v / vᵀ v`, with 32 digits until the end.
fn rayleigh_quotient(tensor: &Matrix3, v: &Vector3) -> f64 {
    // powers of two keep the products in range
    let scale = power_of_two_above(tensor.amax());
    let v = [0, 1, 2].map(|i| DoubleDouble::from(v[i]));
    let image = |i: usize| (0..3).map(|j| DoubleDouble::from(tensor[(i, j)] / scale) * v[j]).sum::<DoubleDouble>();
    let numerator: DoubleDouble = (0..3).map(|i| v[i] * image(i)).sum();
    let denominator: DoubleDouble = v.iter().map(|&x| x * x).sum();
    (numerator / denominator).hi * scale
}

/// The power of two in `(x, 2x]` for a normal `x > 0` below 2¹⁰²³; 1 for others.
pub(super) fn power_of_two_above(x: f64) -> f64 {
    if !x.is_normal() || x >= 8.98846567431158e307 {
        return 1.0;
    }
    libm::ldexp(1.0, libm::ilogb(x) + 1)
}

/// The axis or its opposite, such that its entry of largest magnitude is positive.
fn facing_forward(axis: Vector3) -> Vector3 {
    if axis[axis.iamax()] < 0.0 { -axis } else { axis }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::quaternion;

    fn turned(moments: [f64; 3], angle: [f64; 3]) -> Matrix3 {
        let r = quaternion::to_matrix(&quaternion::exp(&Vector3::from(angle)));
        let i = r * Matrix3::from_diagonal(&Vector3::from(moments)) * r.transpose();
        0.5 * (i + i.transpose())
    }

    #[test]
    fn a_diagonal_tensor_keeps_its_moments_to_the_last_bit() {
        let p = diagonalise(&Matrix3::from_diagonal(&Vector3::new(0.3, 0.1, 0.2)));
        assert_eq!(p.moments, Vector3::new(0.1, 0.2, 0.3));
        assert_eq!(p.axes, Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0));
        let p = diagonalise(&Matrix3::from_diagonal(&Vector3::new(0.7, 0.7, 0.7)));
        assert_eq!((p.moments, p.axes), (Vector3::repeat(0.7), Matrix3::identity()));
    }

    #[test]
    fn axes_diagonalise_and_are_a_rotation_with_fixed_signs() {
        for moments in [[1.0, 2.0, 2.5], [2.5, 1.0, 2.0], [1.0, 1.0, 1.9], [1.0, 1.9, 1.9], [1.0, 1.0 + 1e-9, 1.5]] {
            for k in 0..40 {
                let t = f64::from(k);
                let i = turned(moments, [0.31 * t, 1.7 - 0.2 * t, 0.05 * t * t]);
                let p = diagonalise(&i);
                // a rotation turns by few ε: products of a dozen Jacobi rotations
                assert!((p.axes.tr_mul(&p.axes) - Matrix3::identity()).amax() < 16.0 * f64::EPSILON);
                assert!(p.axes.determinant() > 0.0);
                let back = p.axes * Matrix3::from_diagonal(&p.moments) * p.axes.transpose();
                assert!((back - i).amax() < 32.0 * f64::EPSILON * i.amax());
                let mut expected = moments;
                expected.sort_by(f64::total_cmp);
                assert!((p.moments - Vector3::from(expected)).amax() < 16.0 * f64::EPSILON * 2.5);
                for c in 0..2 {
                    let axis: Vector3 = p.axes.column(c).into();
                    assert!(axis[axis.iamax()] > 0.0);
                }
            }
        }
    }

    #[test]
    fn the_small_moment_of_a_slanted_rod_is_right_to_its_own_digits() {
        // the tensor as stored, not the one that rounding took it from: I₁ = det I / (I₂ I₃)
        let exact_determinant = |i: &Matrix3| {
            let e = |r: usize, c: usize| DoubleDouble::from(i[(r, c)]);
            let minor = |r: usize, s: usize| e(r, 1) * e(s, 2) - e(r, 2) * e(s, 1);
            (e(0, 0) * minor(1, 2) - e(1, 0) * minor(0, 2) + e(2, 0) * minor(0, 1)).hi
        };
        for small in [1e-3, 1e-6, 1e-9, 1e-12, 1e-14] {
            for k in 0..40 {
                let t = f64::from(k);
                let i = turned([small, 1.0, 1.0 + 0.5 * small], [0.3 + 0.31 * t, 1.7 - 0.2 * t, 0.05 * t * t]);
                let p = diagonalise(&i);
                let expected = exact_determinant(&i) / (p.moments[1] * p.moments[2]);
                assert!(
                    (p.moments[0] - expected).abs() <= 4.0 * f64::EPSILON * expected,
                    "{small:e} {k}: {}",
                    p.moments
                );
                assert!((p.moments.sum() - i.trace()).abs() <= 4.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn size_does_not_matter() {
        for scale in [1e-290, 1e-100, 1e100, 1e290] {
            let p = diagonalise(&(turned([1.0, 2.0, 2.5], [0.4, 0.5, 0.6]) * scale));
            assert!((p.moments / scale - Vector3::new(1.0, 2.0, 2.5)).amax() < 16.0 * f64::EPSILON);
        }
    }
}
