//! Bisection (lecture §7): halve the interval, keep the half with the change of sign.
//!
//! One binary digit of the time a round, whatever the gap does in between.

/// The middle of the bracket.
pub(super) fn next([(a, _), (b, _)]: [(f64, f64); 2], _eps: f64, _round: u32) -> f64 {
    0.5 * (a + b)
}
