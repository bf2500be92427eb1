//! The motion within one step: a polynomial in time, or a closed form.

use std::sync::Arc;

use super::exact::ClosedMotion;
use crate::state::Moment;

/// A piece of the motion.
///
/// ```text
/// y(t) = Σ_k c_k s^k,   s = (t − start)/length,   0 ≤ s ≤ 1
/// ```
///
/// The polynomial is the motion; orientations are normalised where they are read from it. After an
/// impact within the step, the piece ends at `end`, before `start + length`.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Segment {
    /// Where the piece begins [s].
    pub start: f64,
    /// Length of the step [s].
    pub length: f64,
    /// Where the piece ends [s].
    pub end: f64,
    /// Start of the interval without switches that the piece lies in [s].
    pub since: f64,
    /// How many numbers are integrated.
    pub dimension: usize,
    /// The numbers as functions of time.
    pub curve: Curve,
}

/// How the numbers of a piece follow from time.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Curve {
    /// `c_k` for k = 0, 1, …, each of `dimension` numbers.
    Polynomial(Vec<f64>),
    /// A closed form, and the time from its beginning to that of the piece [s].
    Closed(#[cfg_attr(feature = "serde", serde(with = "shared"))] Arc<ClosedMotion>, f64),
}

impl Default for Curve {
    fn default() -> Self {
        Self::Polynomial(Vec::new())
    }
}

/// A shared motion in a file is the motion.
#[cfg(feature = "serde")]
mod shared {
    use super::{Arc, ClosedMotion};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(motion: &Arc<ClosedMotion>, to: S) -> Result<S::Ok, S::Error> {
        motion.as_ref().serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Arc<ClosedMotion>, D::Error> {
        ClosedMotion::deserialize(from).map(Arc::new)
    }
}

impl Segment {
    /// Whether every coefficient is finite; without branches, so that it costs a few nanoseconds.
    pub(super) fn is_finite(&self) -> bool {
        match &self.curve {
            Curve::Polynomial(coefficients) => coefficients.iter().fold(true, |finite, c| finite & c.is_finite()),
            Curve::Closed(..) => true,
        }
    }

    /// The cubic through states and slopes at both ends (Hermite):
    ///
    /// ```text
    /// c₀ = y₀,  c₁ = h y₀′,  c₂ = 3 Δ − h (2 y₀′ + y₁′),  c₃ = h (y₀′ + y₁′) − 2 Δ,   Δ = y₁ − y₀
    /// ```
    pub(crate) fn set_hermite(&mut self, at: Moment, h: f64, [y0, k0, y1, k1]: [&[f64]; 4]) {
        let n = y0.len();
        let (c0, rest) = self.set_span(at, h, n, 4).split_at_mut(n);
        let (c1, rest) = rest.split_at_mut(n);
        let (c2, c3) = rest.split_at_mut(n);
        for i in 0..n {
            let (delta, s0, s1) = (y1[i] - y0[i], h * k0[i], h * k1[i]);
            c0[i] = y0[i];
            c1[i] = s0;
            c2[i] = 3.0 * delta - (2.0 * s0 + s1);
            c3[i] = (s0 + s1) - 2.0 * delta;
        }
    }

    /// A segment from `at` to `at + h` for `n` polynomials with so many terms; their coefficients.
    pub(super) fn set_span(&mut self, at: Moment, h: f64, n: usize, terms: usize) -> &mut [f64] {
        self.start = at.time;
        self.length = h;
        self.end = at.time + h;
        self.since = at.since;
        self.dimension = n;
        if let Curve::Closed(..) = self.curve {
            self.curve = Curve::default();
        }
        let Curve::Polynomial(coefficients) = &mut self.curve else { return &mut [] };
        coefficients.resize(terms * n, 0.0);
        coefficients
    }

    /// A piece of a closed form from `start` on, `lead` after the form's beginning [s].
    pub(super) fn set_closed(&mut self, start: f64, since: f64, h: f64, lead: f64, motion: Arc<ClosedMotion>) {
        let dimension = motion.dimension();
        *self = Self { start, length: h, end: start + h, since, dimension, curve: Curve::Closed(motion, lead) };
    }

    /// The closed form that the piece is of.
    pub(super) fn closed_motion(&self) -> Option<&Arc<ClosedMotion>> {
        match &self.curve {
            Curve::Closed(motion, _) => Some(motion),
            Curve::Polynomial(_) => None,
        }
    }

    /// Whether the piece describes `n` numbers, as it should where it was read from a file.
    #[cfg(feature = "serde")]
    pub(crate) fn fits(&self, n: usize) -> bool {
        match &self.curve {
            Curve::Polynomial(c) => [0, n].contains(&self.dimension) && (self.dimension == 0 || c.len() % n == 0),
            Curve::Closed(motion, _) => motion.dimension() == self.dimension,
        }
    }

    /// The numbers at `t` [s].
    pub fn at(&self, t: f64, y: &mut [f64]) {
        self.at_offset(t - self.start, y);
    }

    /// The numbers at a time from the start [s].
    pub fn at_offset(&self, offset: f64, y: &mut [f64]) {
        let coefficients = match &self.curve {
            Curve::Polynomial(coefficients) => coefficients,
            Curve::Closed(motion, lead) => return motion.at(lead + offset, y),
        };
        let s = offset / self.length;
        let mut terms = coefficients.chunks_exact(self.dimension.max(1)).rev();
        match terms.next() {
            Some(highest) => y.copy_from_slice(highest),
            None => return,
        }
        for c in terms {
            for (y, c) in y.iter_mut().zip(c) {
                *y = *y * s + c;
            }
        }
    }

    /// The moment `t` [s] within the segment.
    pub fn moment(&self, t: f64) -> Moment {
        Moment { time: t, since: self.since }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hermite_is_exact_for_cubics() {
        let y = |t: f64| 1.0 - 2.0 * t + 0.5 * t * t + 3.0 * t * t * t;
        let k = |t: f64| -2.0 + t + 9.0 * t * t;
        let (t0, h) = (0.25, 0.5);
        let mut segment = Segment::default();
        let ends = [&[y(t0)][..], &[k(t0)], &[y(t0 + h)], &[k(t0 + h)]];
        segment.set_hermite(Moment { time: t0, since: 0.0 }, h, ends);
        for i in 0..=10 {
            let t = t0 + h * f64::from(i) / 10.0;
            let mut value = [0.0];
            segment.at(t, &mut value);
            // rounding of a handful of operations on numbers of size 3
            assert!((value[0] - y(t)).abs() < 16.0 * f64::EPSILON);
        }
    }
}
