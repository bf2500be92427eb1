//! Sums that keep their rounding error (Knuth 1969; Kahan 1965).

use std::ops::{Add, AddAssign};

/// `a + b` and the error of that sum, exactly: `a + b = sum + error`.
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let bb = sum - a;
    (sum, (a - (sum - bb)) + (b - bb))
}

/// `a b` and the error of that product, exactly: `a b = product + error` (Dekker 1971, Veltkamp's split).
///
/// Exact for factors below 1e150 whose product is above 1e-290. A fused multiply-add would do it in two
/// operations, but is a slow call where the target lacks it.
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let (ah, al) = split(a);
    let (bh, bl) = split(b);
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}

/// Upper and lower half of the digits of `a`.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let c = 134217729.0 * a; // 2²⁷ + 1
    let high = c - (c - a);
    (high, a - high)
}

/// An instant [s] as an unevaluated sum of two `f64`: a million steps of 1 ms end at 1000 s to the
/// last digit, where a plain sum is off by 2e-8 s.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Time {
    /// The instant rounded to `f64` [s].
    pub value: f64,
    /// What the rounding dropped [s].
    pub rest: f64,
}

impl Time {
    /// An instant that is exactly `value` [s].
    pub fn new(value: f64) -> Self {
        Self { value, rest: 0.0 }
    }

    /// Time from this instant to `later` [s].
    pub fn until(self, later: f64) -> f64 {
        (later - self.value) - self.rest
    }
}

impl Add<f64> for Time {
    type Output = Self;

    fn add(self, h: f64) -> Self {
        let (sum, error) = two_sum(self.value, h);
        let (value, rest) = two_sum(sum, error + self.rest);
        Self { value, rest }
    }
}

impl AddAssign<f64> for Time {
    fn add_assign(&mut self, h: f64) {
        *self = *self + h;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_and_its_error_are_exact() {
        // (1 + 2⁻³⁰)² = 1 + 2⁻²⁹ + 2⁻⁶⁰, of which f64 holds the first two terms
        let e = 1.0 / 1073741824.0;
        assert_eq!(two_product(1.0 + e, 1.0 + e), (1.0 + 2.0 * e, e * e));
        assert_eq!(two_product(-1.0 - e, 3.0 * (1.0 + e)), (-3.0 - 6.0 * e, -3.0 * e * e));
    }

    #[test]
    fn a_million_steps_end_where_they_should() {
        let (mut kept, mut plain) = (Time::default(), 0.0);
        for _ in 0..1_000_000 {
            kept += 1e-3;
            plain += 1e-3;
        }
        // 1e-3 itself is off by at most ε/2 · 1e-3, a million times
        assert!((kept.value - 1e3).abs() <= 1e3 * f64::EPSILON);
        assert!(f64::abs(plain - 1e3) > 1e-9, "the plain sum is no longer the worse one");
    }
}
