//! Bounces that accumulate: infinitely many in a finite time.
//!
//! A ball that returns with e times its speed bounces after τ, r τ, r² τ, … with r = e, and is at rest after
//!
//! ```text
//! t* = t + τ r + τ r² + … = t + τ r/(1 − r)        τ: the last interval, r: the ratio of the last two
//! ```
//!
//! [`Accumulation`] watches the impacts of one contact and says when their intervals have become a geometric
//! sequence that is close enough to its end to be cut off there. Under a constant load a single point, a
//! body landing flat and a body rocking in two dimensions have exactly such intervals in the limit; where the
//! ratio still moves from interval to interval, its movement bounds the error of t*:
//!
//! ```text
//! r₁ = τ₂/τ₁,  r₂ = τ₃/τ₂        |δt*| ≈ τ₃ |r₂ − r₁|/(1 − r₂)² + 8 ε t/(1 − r₂)²
//! ```
//!
//! What happens after t* is rest ([`rest`](super::rest)): the normal velocity of the contact is 0 there. The
//! bounces that are cut off would have risen by at most `g τ₃²/8`.
//!
//! # When it fails
//! A contact whose intervals shrink without a ratio (a rolling polyhedron, a coin that wobbles to rest) is
//! never recognised; a floor under the normal velocity, [`rest_speed`], ends it.

/// The accumulation of a contact's impacts, recognised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capture {
    /// When the bounces end: t* [s].
    pub time: f64,
    /// Ratio r of one interval to the one before [-].
    pub ratio: f64,
    /// Estimated error of the time [s].
    pub error: f64,
}

/// The last impacts of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Accumulation {
    times: [f64; 4],
    count: usize,
}

/// Ratio of intervals above which a sequence counts as endless [-]: at 0.999 some 7000 bounces more bring the
/// speed to a thousandth, and t* depends on the fourth digit of every ratio.
const ENDLESS: f64 = 0.999;

/// What the rounding of four times leaves in the ratio of their differences, as a fraction of time over
/// interval [-].
const ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Accumulation {
    /// A contact without impacts so far.
    pub fn new() -> Self {
        Self::default()
    }

    /// Books an impact at `time` [s], later than those before; the answer tells whether the bounces can be
    /// cut off with an error of t* of at most `accuracy` [s].
    pub fn book(&mut self, time: f64, accuracy: f64) -> Option<Capture> {
        if self.count == 4 {
            self.times.rotate_left(1);
            self.times[3] = time;
        } else {
            self.times[self.count] = time;
            self.count += 1;
        }
        self.capture().filter(|capture| capture.error <= accuracy)
    }

    /// What the last four impacts tell.
    fn capture(&self) -> Option<Capture> {
        if self.count < 4 {
            return None;
        }
        let [t0, t1, t2, t3] = self.times;
        let [a, b, c] = [t1 - t0, t2 - t1, t3 - t2];
        if !(a > 0.0 && b > 0.0 && c > 0.0) {
            return None;
        }
        let (before, ratio) = (b / a, c / b);
        if ratio.max(before) >= ENDLESS {
            return None;
        }
        let rest = 1.0 - ratio;
        let rounding = ROUNDING * t3.abs();
        let error = (c * (ratio - before).abs() + rounding) / (rest * rest);
        Some(Capture { time: t3 + c * ratio / rest, ratio, error })
    }

    /// Forgets what was booked: after a capture, or when something else has hit the bodies.
    pub fn forget(&mut self) {
        self.count = 0;
    }
}

/// Normal speed [m/s] below which a contact under the acceleration `a` [m/s²] counts as resting: a bounce at
/// that speed rises by no more than the gap `eps` [m] within which bodies touch, `√(2 a ε)`.
pub fn rest_speed(a: f64, eps: f64) -> f64 {
    (2.0 * a * eps).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_impacts_give_the_end_of_a_geometric_sequence() {
        for ratio in [0.05, 0.5, 0.9, 0.99] {
            // impacts at 1, 1 + τ, 1 + τ + r τ, …: the end is 1 + τ/(1 − r)
            let tau = 0.3;
            let (mut t, mut step) = (1.0, tau);
            let mut watch = Accumulation::new();
            let mut found = None;
            for _ in 0..4 {
                found = watch.book(t, 1e-9);
                t += step;
                step *= ratio;
            }
            let found = found.unwrap();
            let end = 1.0 + tau / (1.0 - ratio);
            // the times are rounded to 2e-16, their ratios to that over the interval
            assert!((found.time - end).abs() <= found.error, "{ratio}: {found:?} against {end}");
            assert!(found.error <= 32.0 * f64::EPSILON * end / ((1.0 - ratio) * (1.0 - ratio)), "{found:?}");
        }
    }

    #[test]
    fn what_is_no_geometric_sequence_is_not_cut_off() {
        let run = |times: &[f64]| {
            let mut watch = Accumulation::new();
            times.iter().filter_map(|&t| watch.book(t, 1e-9)).count()
        };
        // elastic, growing, harmonic (which has no end), and too few
        assert_eq!(run(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0]), 0);
        assert_eq!(run(&[0.0, 1.0, 3.0, 7.0]), 0);
        assert_eq!(run(&[0.0, 1.0, 1.5, 1.8333, 2.0833]), 0);
        assert_eq!(run(&[0.0, 1.0, 1.5]), 0);
        assert_eq!(run(&[0.0, 1.0, 1.5, 1.75]), 1);
        // a repeated time is no interval
        assert_eq!(run(&[0.0, 1.0, 1.0, 1.0]), 0);
    }

    #[test]
    fn after_forgetting_it_starts_anew() {
        let mut watch = Accumulation::new();
        for t in [0.0, 1.0, 1.5] {
            watch.book(t, 1.0);
        }
        watch.forget();
        assert_eq!(watch.book(1.75, 1.0), None);
    }
}
