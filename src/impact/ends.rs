//! What bisection and secant share: a bracket whose ends show a change of sign (lecture §7).
//!
//! Both see a collision only where the interval ends in overlap. A pass-through leaves no change of
//! sign, and is not seen.

use super::Outcome;

/// How a search over a gap ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// How it ended.
    pub outcome: Outcome,
    /// When: the impact, or the end of what was searched [s].
    pub time: f64,
    /// Up to when nothing else is to be found [s]: of a graze where the gap has opened again, else `time`.
    pub until: f64,
    /// Rounds of the finder.
    pub iterations: u32,
    /// Evaluations of the gap.
    pub queries: u32,
}

/// A time within the bracket `[a, b]`, whose gaps are given, at which to look next; `round` counts from 0.
pub(super) type Next = fn(bracket: [(f64, f64); 2], eps: f64, round: u32) -> f64;

/// Finds the impact in 0..=`h` [s], given the gap [m] as a function of time from the start. Accepted
/// is only a gap in 0..=`eps` [m], never an overlap.
pub(super) fn find(gap: &mut dyn FnMut(f64) -> f64, h: f64, eps: f64, next: Next) -> Found {
    let mut found = Found { outcome: Outcome::Clear, time: h, until: h, iterations: 0, queries: 0 };
    let mut queries = 0;
    let mut look = |t: f64| {
        queries += 1;
        gap(t)
    };
    (found.outcome, found.time) = search(&mut look, h, eps, next, &mut found.iterations);
    (found.queries, found.until) = (queries, found.time);
    found
}

fn search(gap: &mut impl FnMut(f64) -> f64, h: f64, eps: f64, next: Next, iterations: &mut u32) -> (Outcome, f64) {
    // the state of affairs at both ends
    let mut a = (0.0, gap(0.0));
    let mut b = (h, gap(h));
    if a.1 < -eps {
        return (Outcome::Overlap, 0.0);
    }
    if b.1 > eps {
        return (Outcome::Clear, h);
    }

    // a body that has just bounced starts within ε: the search begins where it has left
    if a.1 <= eps {
        let mut t = h / SHORTEST_STAY;
        a = (t, gap(t));
        while a.1 <= eps && t < h {
            t *= 2.0;
            a = (t, gap(t));
        }
        if a.1 <= eps {
            return if b.1 >= 0.0 { (Outcome::Clear, h) } else { (Outcome::AlreadyTouching, 0.0) };
        }
    }
    if b.1 >= 0.0 {
        return (Outcome::At, h);
    }

    // the root stays in the bracket
    for round in 0..ROUNDS {
        *iterations = round + 1;
        let t = next([a, b], eps, round);
        if t <= a.0 || t >= b.0 {
            break;
        }
        let gap_t = gap(t);
        if (0.0..=eps).contains(&gap_t) {
            return (Outcome::At, t);
        }
        if gap_t > 0.0 {
            a = (t, gap_t);
        } else {
            b = (t, gap_t);
        }
    }
    (Outcome::Stalled, a.0)
}

/// A bounce is looked for from this part of a step on, doubling [-]: a body that leaves ε and is back
/// within the same doubling counts as touching.
const SHORTEST_STAY: f64 = (1_u64 << 40) as f64;
/// Rounds of a finder [-]: bisection from 1 to the smallest subnormal needs 1074, from a step to its
/// last bit 53, and the secant halves in every second round.
const ROUNDS: u32 = 128;

#[cfg(test)]
mod tests {
    use super::super::{bisection, secant};
    use super::*;

    const EPS: f64 = 1e-12;

    #[test]
    fn a_falling_point_is_found_by_both_and_never_below_the_plane() {
        // gap = 1 − t − 5 t²: root t = (√21 − 1)/10; the time may be early by ε/speed
        let root = (21f64.sqrt() - 1.0) / 10.0;
        for next in [bisection::next as Next, secant::next] {
            let gap = |t: f64| 1.0 - t - 5.0 * t * t;
            let found = find(&mut { gap }, 1.0, EPS, next);
            assert_eq!(found.outcome, Outcome::At);
            assert!((0.0..=EPS).contains(&gap(found.time)));
            assert!((found.time - root).abs() <= EPS);
        }
    }

    #[test]
    fn the_secant_is_the_faster_one() {
        let mut gap = |t: f64| 1.0 - t - 5.0 * t * t;
        let bisection = find(&mut gap, 1.0, EPS, bisection::next).iterations;
        let secant = find(&mut gap, 1.0, EPS, secant::next).iterations;
        // bisection gains a digit in 3.3 rounds: 1e-12 of 1 takes about 40
        assert!((36..=44).contains(&bisection), "{bisection}");
        assert!(secant < bisection / 2, "{secant}");
    }

    #[test]
    fn every_way_to_end_has_its_name() {
        let end = |mut gap: fn(f64) -> f64| find(&mut gap, 1.0, EPS, secant::next).outcome;
        assert_eq!(end(|_| 1.0), Outcome::Clear);
        assert_eq!(end(|t| t - 0.5), Outcome::Overlap);
        assert_eq!(end(|t| -t), Outcome::AlreadyTouching);
        assert_eq!(end(|t| 1.0 - t), Outcome::At);
        // a jump over the band leaves no gap to accept
        let mut jump = |t: f64| if t < 0.3 { 1.0 } else { -1.0 };
        let found = find(&mut jump, 1.0, EPS, secant::next);
        assert_eq!(found.outcome, Outcome::Stalled);
        assert!((found.time - 0.3).abs() < 1e-15);
    }

    #[test]
    fn a_body_that_has_just_bounced_is_found_again_where_it_lands() {
        // up from the plane with 1, down with 5 t²: back at t = 1/5
        let found = find(&mut |t: f64| t - 5.0 * t * t, 0.3, EPS, secant::next);
        assert_eq!(found.outcome, Outcome::At);
        assert!((found.time - 0.2).abs() <= EPS);
    }
}
