//! When two bodies first touch, by subdivision of time and nothing else.
//!
//! ```text
//! |s(t) − s(t′)| ≤ V |t − t′|        V = |v_B − v_A| + |ω_A| r_A + |ω_B| r_B
//! ```
//!
//! for the signed distance s, since no point of one body is faster than V seen from the other. So an
//! interval is free where the lower bound of s in its middle exceeds V times half its length; otherwise
//! it is cut in two, the earlier half first. The query starts without a cache, and its own truth is
//! tested against brute force in `tests/closest_oracle`.

use super::families::Case;
use bryla::closest::{Accuracy, PairCache, closest_features};
use bryla::impact::{Motion, Moving};
use bryla::math::Vector3;
use bryla::shape::convex_polyhedron::ConvexPolyhedron;

/// What subdivision proves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Verdict {
    /// The signed distance is positive everywhere.
    Free,
    /// The bodies overlap at this time.
    Overlap(f64),
    /// Not proved free around this time within the pieces allowed.
    Undecided(f64),
}

/// Signed distance and its bounds at `t`.
pub(crate) fn gap(case: &Case, t: f64) -> (f64, f64, f64) {
    let (pose_a, pose_b) = (case.motion_a.at(t).pose, case.motion_b.at(t).pose);
    let mut cache = PairCache::new();
    let found = closest_features(&case.a, &pose_a, &case.b, &pose_b, Some(&mut cache), Accuracy::Exact).unwrap();
    (found.signed_distance, found.lower, found.upper)
}

/// Largest speed of a point of one body as seen from the other.
pub(crate) fn speed(case: &Case) -> f64 {
    let radius = |body: &ConvexPolyhedron, motion: &Motion| {
        (Vector3::from(body.center()) - motion.center).norm() + body.radius()
    };
    (case.motion_b.velocity - case.motion_a.velocity).norm()
        + case.motion_a.angular_velocity.norm() * radius(&case.a, &case.motion_a)
        + case.motion_b.angular_velocity.norm() * radius(&case.b, &case.motion_b)
}

/// Whether the bodies are apart all over `0..=to`, with at most `pieces` looks.
pub(crate) fn is_free(case: &Case, to: f64, pieces: usize) -> Verdict {
    let v = speed(case) * (1.0 + 1e-12);
    let mut stack = vec![(0.0, to)];
    for _ in 0..pieces {
        let Some((from, to)) = stack.pop() else { return Verdict::Free };
        let middle = 0.5 * (from + to);
        let (_, lower, upper) = gap(case, middle);
        if upper < 0.0 {
            return Verdict::Overlap(middle);
        }
        if lower > v * (0.5 * (to - from)) {
            continue;
        }
        if middle <= from || middle >= to {
            return Verdict::Undecided(middle);
        }
        stack.push((middle, to));
        stack.push((from, middle));
    }
    Verdict::Undecided(stack.last().map_or(to, |piece| piece.0))
}
