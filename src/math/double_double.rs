//! Numbers of twice the digits, for sums that cancel and the rare question that `f64` cannot decide.
//!
//! A [`DoubleDouble`] is the unevaluated sum `hi + lo` of two `f64` with `|lo| ≤ ½ ulp(hi)`: 106 bits,
//! a relative rounding of about 2⁻¹⁰⁴ for each operation (Dekker 1971, Numer. Math. 18:224; Li et al.
//! 2002, ACM TOMS 28:152). No fused multiply-add is used, so the bits are the same on every machine.
//! Products are exact while no operand exceeds 1e290 and no product falls below 1e-270.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use crate::math::sum::two_sum;

/// An unevaluated sum `hi + lo` of two `f64`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DoubleDouble {
    /// The number rounded to `f64`.
    pub hi: f64,
    /// What the rounding dropped.
    pub lo: f64,
}

/// A number that the geometric queries can be carried out in: `f64` or [`DoubleDouble`].
pub(crate) trait Real:
    Copy
    + Debug
    + PartialEq
    + PartialOrd
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Bound of the relative error of one operation [-].
    const UNIT: f64;
    /// The nearest `f64`.
    fn to_f64(self) -> f64;
    /// The square root; of a negative number 0.
    fn sqrt(self) -> Self;
}

impl Real for f64 {
    const UNIT: f64 = 0.5 * f64::EPSILON;

    #[inline]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline]
    fn sqrt(self) -> f64 {
        f64::sqrt(self.max(0.0))
    }
}

impl Real for DoubleDouble {
    const UNIT: f64 = f64::EPSILON * f64::EPSILON;

    fn to_f64(self) -> f64 {
        self.hi
    }

    fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::default();
        }

        // one Newton step doubles the 53 bits of the first guess
        let guess = f64::sqrt(self.hi);
        let rest = self - Self::product(guess, guess);
        Self::quick(guess, rest.hi / (2.0 * guess))
    }
}

impl DoubleDouble {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// `a + b` where `|a| ≥ |b|`.
    #[inline]
    fn quick(a: f64, b: f64) -> Self {
        let hi = a + b;
        Self { hi, lo: b - (hi - a) }
    }

    /// `a · b` without rounding (Dekker).
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let hi = a * b;
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        Self { hi, lo: ((ah * bh - hi) + ah * bl + al * bh) + al * bl }
    }

    /// `a + b` without rounding.
    #[inline]
    pub fn sum(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, b);
        Self { hi, lo }
    }
}

/// The upper and the lower 26 bits of a number (Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134217729.0; // 2²⁷ + 1
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

impl From<f64> for DoubleDouble {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.hi.partial_cmp(&other.hi) {
            Some(Ordering::Equal) => self.lo.partial_cmp(&other.lo),
            order => order,
        }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, other.hi);
        let (t, f) = two_sum(self.lo, other.lo);
        let first = Self::quick(s, e + t);
        Self::quick(first.hi, first.lo + f)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let p = Self::product(self.hi, other.hi);
        Self::quick(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - other * Self::from(first);
        let second = rest.hi / other.hi;
        let rest = rest - other * Self::from(second);
        Self::quick(first, second) + Self::from(rest.hi / other.hi)
    }
}

impl AddAssign for DoubleDouble {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sum for DoubleDouble {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu::rational::RBig;
    use proptest::prelude::*;

    /// The number as an exact fraction.
    fn exact(x: DoubleDouble) -> RBig {
        RBig::try_from(x.hi).unwrap() + RBig::try_from(x.lo).unwrap()
    }

    /// `|got − want| ≤ bound · |want|`, in exact fractions.
    fn is_within(got: DoubleDouble, want: &RBig, bound: f64) -> bool {
        let error = exact(got) - want.clone();
        let (error, allowed) = (error.clone() * error, want.clone() * want.clone());
        error <= allowed * RBig::try_from(bound * bound).unwrap()
    }

    #[test]
    fn cancelled_digits_come_back() {
        assert_eq!(DoubleDouble::sum(1.0, -1e-20), DoubleDouble { hi: 1.0, lo: -1e-20 });
        // (1 + δ)(1 − δ) − 1 = −δ², and what the sum of many terms drops is kept
        let (a, b) = (DoubleDouble { hi: 1.0, lo: 1e-17 }, DoubleDouble { hi: 1.0, lo: -1e-17 });
        assert!((a * b - DoubleDouble::from(1.0)).hi.abs() < 1e-31);
        let sum: DoubleDouble = [1.0, 1e-20, -1.0].map(DoubleDouble::from).into_iter().sum();
        assert_eq!(sum, DoubleDouble::from(1e-20));
    }

    proptest! {
        #[test]
        fn each_operation_is_right_to_its_unit(a in -1e3..1e3, b in -1e-14..1e-14, c in 0.1..1e3, d in -1e-15..1e-15) {
            let (x, y) = (DoubleDouble::sum(a, b), DoubleDouble::sum(c, d));
            let (ex, ey) = (exact(x), exact(y));
            let unit = DoubleDouble::UNIT;
            prop_assert!(is_within(x + y, &(ex.clone() + ey.clone()), unit));
            prop_assert!(is_within(x - y, &(ex.clone() - ey.clone()), unit));
            prop_assert!(is_within(x * y, &(ex.clone() * ey.clone()), unit));
            prop_assert!(is_within(x / y, &(ex / ey.clone()), unit));
            let root = y.sqrt();
            prop_assert!(is_within(root * root, &ey, 4.0 * unit));
        }
    }
}
