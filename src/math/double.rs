//! Arithmetic with twice the digits of `f64`, for sums in which digits cancel.
//!
//! A value is an unevaluated sum `hi + lo` with `|lo| ≤ ½ ulp(hi)`: about 32 digits. The operations are
//! those of Dekker 1971 (Numer. Math. 18:224) in the versions whose error bounds Joldes, Muller and
//! Popescu proved (2017, ACM TOMS 44:15res): each is right to a few 1e-32 of its result. Products
//! are exact as long as no part of them overflows or falls below 1e-290: scale first.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use crate::math::sum::two_sum;

/// `a b` and the error of that product, exactly: `a b = product + error`.
///
/// Without a fused multiply-add, which is a slow call on machines that lack it; with it the numbers
/// would be the same.
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a1, a0), (b1, b0)) = (halves(a), halves(b));
    (product, ((a1 * b1 - product) + a1 * b0 + a0 * b1) + a0 * b0)
}

/// The upper and the lower half of the digits of `a`, exactly.
#[inline]
fn halves(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a; // 2²⁷ + 1
    let upper = shifted - (shifted - a);
    (upper, a - upper)
}

/// `a + b` and its error where `|a| ≥ |b|` or `a = 0`.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// A number of about 32 digits, `hi + lo`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Double {
    /// The value rounded to `f64`.
    pub hi: f64,
    /// What that rounding dropped.
    pub lo: f64,
}

impl Double {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// `a − b`, exactly.
    #[inline]
    pub fn difference(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, -b);
        Self { hi, lo }
    }

    /// The quotient of two values; the divisor is not zero.
    #[inline]
    #[must_use]
    pub fn divided_by(self, divisor: Self) -> Self {
        let first = self.hi / divisor.hi;
        let rest = self - divisor * Self::from(first);
        let (hi, lo) = quick_two_sum(first, rest.hi / divisor.hi);
        Self { hi, lo }
    }
}

impl From<f64> for Double {
    #[inline]
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Neg for Double {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for Double {
    type Output = Self;

    #[inline]
    fn add(self, b: Self) -> Self {
        let (s, s_error) = two_sum(self.hi, b.hi);
        let (t, t_error) = two_sum(self.lo, b.lo);
        let (s, rest) = quick_two_sum(s, s_error + t);
        let (hi, lo) = quick_two_sum(s, t_error + rest);
        Self { hi, lo }
    }
}

impl Sub for Double {
    type Output = Self;

    #[inline]
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Double {
    type Output = Self;

    #[inline]
    fn mul(self, b: Self) -> Self {
        let (product, error) = two_product(self.hi, b.hi);
        let (hi, lo) = quick_two_sum(product, error + (self.hi * b.lo + self.lo * b.hi));
        Self { hi, lo }
    }
}

impl AddAssign for Double {
    #[inline]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl Sum for Double {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_differences_are_exact() {
        // (1 + ε)² = 1 + 2ε + ε², whose last term a plain product drops
        let e = f64::EPSILON;
        assert_eq!(two_product(1.0 + e, 1.0 + e), (1.0 + 2.0 * e, e * e));
        assert_eq!(two_product(0.1, 3.0), (0.1 * 3.0, libm::fma(0.1, 3.0, -(0.1 * 3.0))));
        let d = Double::difference(1.0, 1e-20);
        assert_eq!((d.hi, d.lo), (1.0, -1e-20));
    }

    #[test]
    fn cancelled_digits_come_back() {
        let x = Double { hi: 1.0, lo: 3e-20 };
        assert_eq!(x - Double::from(1.0), Double::from(3e-20));
        // (1 + δ)(1 − δ) − 1 = −δ²
        let (a, b) = (Double { hi: 1.0, lo: 1e-17 }, Double { hi: 1.0, lo: -1e-17 });
        assert!((a * b - Double::from(1.0)).hi.abs() < 1e-31);
        // division undoes multiplication to 1e-31
        let third = Double::from(1.0).divided_by(Double::from(3.0));
        assert!((third * Double::from(3.0) - Double::from(1.0)).hi.abs() < 1e-31);
        assert!(third.lo != 0.0);
    }
}
