//! The rotations of a pair, from the quaternions of their poses.
//!
//! With `q/|q| = f + r`, `f` of 26 binary places and `r` small,
//!
//! ```text
//! q_i q_j = f_i f_j + (q_i r_j + r_i f_j)
//! ```
//!
//! The first term is a multiple of 2⁻⁵², and so are its sums, which stay below 2: nothing of it is
//! rounded. The second is small, and its rounding as much below that of the sum. So every entry of the
//! matrix is rounded once. Both bodies go side by side.

use wide::f64x2;

use super::vector::Vec3;
use crate::math::Quaternion;
use crate::math::double_double::{DoubleDouble, Real};

/// How far from 1 the square of a quaternion's length may be for its second power to be nothing [-].
const UNIT_EXCESS: f64 = 1e-10;
/// The same for the rotation to be worked out in `f64` [-]: what is left out is then 1e-3 of a rounding.
/// Quaternions of three digits stay within; others take double-double.
const NEARLY_UNIT: f64 = 1e-3;
/// Added and taken away again, it leaves 26 binary places of a number up to 1.
const LEADING: f64 = 1.5 * 67108864.0;

/// The rotations from both bodies' axes to the world's, entry by entry next to each other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rotations<R>([[[R; 2]; 3]; 3]);

impl<R: Real> Rotations<R> {
    /// From the rows of both.
    pub(super) fn of(a: &[Vec3<R>; 3], b: &[Vec3<R>; 3]) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| [a[i].0[j], b[i].0[j]])))
    }

    /// `R v`, of the first body (0) or the second (1).
    #[inline]
    pub(super) fn rotate(&self, side: usize, v: &Vec3<R>) -> Vec3<R> {
        let [x, y, z] = v.0;
        Vec3(self.0.map(|row| row[0][side] * x + row[1][side] * y + row[2][side] * z))
    }

    /// `Rᵀ v`.
    #[inline]
    pub(super) fn rotate_back(&self, side: usize, v: &Vec3<R>) -> Vec3<R> {
        let ([x, y, z], [p, q, r]) = (v.0, &self.0);
        Vec3([0, 1, 2].map(|j| p[j][side] * x + q[j][side] * y + r[j][side] * z))
    }

    /// `R_Aᵀ v` and `R_Bᵀ v`.
    #[inline]
    pub(super) fn rotate_back_both(&self, v: &Vec3<R>) -> [Vec3<R>; 2] {
        let ([x, y, z], [p, q, r]) = (v.0, &self.0);
        let both: [[R; 2]; 3] = [0, 1, 2].map(|j| [0, 1].map(|s| p[j][s] * x + q[j][s] * y + r[j][s] * z));
        [Vec3(both.map(|x| x[0])), Vec3(both.map(|x| x[1]))]
    }
}

/// The rotations of two quaternions `q/|q|`; see the [module](self). As a call it passes its vectors through memory, and
/// a query of coherent motion takes 1.4 times as long.
#[inline(always)]
pub(super) fn rotations(a: &Quaternion, b: &Quaternion) -> Rotations<f64> {
    let (leading, one) = (f64x2::splat(LEADING), f64x2::splat(1.0));
    let q = [[a.w, b.w], [a.i, b.i], [a.j, b.j], [a.k, b.k]].map(f64x2::from);
    let f = q.map(|x| (x + leading) - leading);
    let rest = [q[0] - f[0], q[1] - f[1], q[2] - f[2], q[3] - f[3]];

    // |q|² = 1 + excess, and how much shorter q/|q| is
    let square = f.map(|x| x * x);
    let small = [0, 1, 2, 3].map(|i| (q[i] + f[i]) * rest[i]);
    let excess =
        (((square[0] + square[2]) + (square[1] + square[3])) - one) + ((small[0] + small[2]) + (small[1] + small[3]));
    let excesses = excess.to_array();
    let largest = excesses[0].abs().max(excesses[1].abs());
    if largest > NEARLY_UNIT {
        return Rotations::of(&rounded(a), &rounded(b));
    }
    let less =
        if largest > UNIT_EXCESS { f64x2::from(excesses.map(less_than_one)) } else { f64x2::splat(0.5) * excess };
    let r = [0, 1, 2, 3].map(|i| rest[i] - less * q[i]);
    let q = [0, 1, 2, 3].map(|i| f[i] + r[i]);

    // twice the products, each as what is exact and what is small
    let (f2, r2) = (f.map(|x| x + x), r.map(|x| x + x));
    let product = |i: usize, j: usize| (f2[i] * f[j], q[i] * r2[j] + r2[i] * f[j]);
    let ((wx, wx_), (wy, wy_), (wz, wz_)) = (product(0, 1), product(0, 2), product(0, 3));
    let ((xy, xy_), (xz, xz_), (yz, yz_)) = (product(1, 2), product(1, 3), product(2, 3));
    let ((xx, xx_), (yy, yy_), (zz, zz_)) = (product(1, 1), product(2, 2), product(3, 3));
    let entries = [
        [(one - (yy + zz)) - (yy_ + zz_), (xy - wz) + (xy_ - wz_), (xz + wy) + (xz_ + wy_)],
        [(xy + wz) + (xy_ + wz_), (one - (xx + zz)) - (xx_ + zz_), (yz - wx) + (yz_ - wx_)],
        [(xz - wy) + (xz_ - wy_), (yz + wx) + (yz_ + wx_), (one - (xx + yy)) - (xx_ + yy_)],
    ];
    Rotations(entries.map(|row| row.map(f64x2::to_array)))
}

/// The rotation of `q/|q|` as rows, rounded once.
pub(super) fn rotation(q: &Quaternion) -> [Vec3<f64>; 3] {
    rotations(q, q).0.map(|row| Vec3(row.map(|both| both[0])))
}

/// The same by way of double-double.
fn rounded(q: &Quaternion) -> [Vec3<f64>; 3] {
    precise_rotation(q).map(|row| Vec3(row.to_f64()))
}

/// `1 − 1/√(1 + excess)` to a relative rounding.
fn less_than_one(excess: f64) -> f64 {
    let root = f64::sqrt(1.0 + excess);
    excess / (root * (root + 1.0))
}

/// The rotation of `q/|q|` as rows, in double-double.
pub(super) fn precise_rotation(q: &Quaternion) -> [Vec3<DoubleDouble>; 3] {
    let [w, x, y, z] = [q.w, q.i, q.j, q.k].map(DoubleDouble::from);
    let (one, two) = (DoubleDouble::from(1.0), DoubleDouble::from(2.0));
    let k = two / ((w * w + x * x) + (y * y + z * z));
    let (kx, ky, kz) = (k * x, k * y, k * z);
    let (xx, yy, zz) = (kx * x, ky * y, kz * z);
    let (xy, xz, yz) = (kx * y, kx * z, ky * z);
    let (wx, wy, wz) = (kx * w, ky * w, kz * w);
    [
        Vec3([one - (yy + zz), xy - wz, xz + wy]),
        Vec3([xy + wz, one - (xx + zz), yz - wx]),
        Vec3([xz - wy, yz + wx, one - (xx + yy)]),
    ]
}

/// `R v` from the rows of `R`.
#[inline]
pub(super) fn rotate<R: Real>(rows: &[Vec3<R>; 3], v: &Vec3<R>) -> Vec3<R> {
    Vec3([rows[0].dot(v), rows[1].dot(v), rows[2].dot(v)])
}

/// `Rᵀ v` from the rows of `R`.
#[inline]
pub(super) fn rotate_back<R: Real>(rows: &[Vec3<R>; 3], v: &Vec3<R>) -> Vec3<R> {
    rows[0].scaled(v.0[0]) + rows[1].scaled(v.0[1]) + rows[2].scaled(v.0[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// The truth is the same rotation in double-double. Each entry may be off by the one rounding, u
        /// times its size, and by 1e-3 of u for what is left out.
        #[test]
        fn entries_are_rounded_once(
            q in prop::array::uniform4(-1.0..1.0f64),
            off in prop::sample::select(vec![0.0, 1e-16, 1e-12, 1e-9, 1e-6, 4e-4, 0.1, 1e6]),
        ) {
            prop_assume!(q.iter().map(|x| x * x).sum::<f64>() > 1e-2);
            let a = Quaternion::new(q[0], q[1], q[2], q[3]);
            let a = a / a.norm() * (1.0 + off);
            let b = Quaternion::new(1.0, 0.0, 0.0, 0.0);
            let (found, truth) = (rotations(&a, &b), precise_rotation(&a));
            for (row, precise) in found.0.iter().zip(truth) {
                for (entry, precise) in row.iter().zip(precise.0) {
                    let error = (DoubleDouble::from(entry[0]) - precise).to_f64().abs();
                    prop_assert!(error <= f64::UNIT * (precise.to_f64().abs() + 2e-3), "{error:e} of {precise:?}");
                }
            }
            prop_assert_eq!(found.0.map(|row| row.map(|x| x[1])), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        }
    }
}
