//! The lecture's acceleration (§7): the straight line through the gaps at both ends, and its crossing.
//!
//! The line aims at the middle of what is accepted, ½ ε. On a curved gap one end of the bracket would
//! stay for ever and the line stall, so every second round halves the bracket instead.

/// Where the line through both ends crosses ½ ε; in odd rounds the middle of the bracket.
pub(super) fn next([(a, gap_a), (b, gap_b)]: [(f64, f64); 2], eps: f64, round: u32) -> f64 {
    if round % 2 == 1 { 0.5 * (a + b) } else { a + (gap_a - 0.5 * eps) * (b - a) / (gap_a - gap_b) }
}
