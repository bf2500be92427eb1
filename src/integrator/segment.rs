//! The motion within one step: a polynomial in time.

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
    /// `c_k` for k = 0, 1, …, each of `dimension` numbers.
    pub coefficients: Vec<f64>,
}

impl Segment {
    /// The cubic through states and slopes at both ends (Hermite):
    ///
    /// ```text
    /// c₀ = y₀,  c₁ = h y₀′,  c₂ = 3 Δ − h (2 y₀′ + y₁′),  c₃ = h (y₀′ + y₁′) − 2 Δ,   Δ = y₁ − y₀
    /// ```
    pub(super) fn set_hermite(&mut self, at: Moment, h: f64, [y0, k0, y1, k1]: [&[f64]; 4]) {
        let n = y0.len();
        self.set_span(at, h, n, 4);
        let (c0, rest) = self.coefficients.split_at_mut(n);
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

    /// A segment from `at` to `at + h` for `n` polynomials with so many terms.
    pub(super) fn set_span(&mut self, at: Moment, h: f64, n: usize, terms: usize) {
        self.start = at.time;
        self.length = h;
        self.end = at.time + h;
        self.since = at.since;
        self.dimension = n;
        self.coefficients.resize(terms * n, 0.0);
    }

    /// The polynomial of the number `i`, term by term.
    pub(super) fn set_terms<const TERMS: usize>(&mut self, i: usize, terms: [f64; TERMS]) {
        for (k, c) in terms.into_iter().enumerate() {
            self.coefficients[k * self.dimension + i] = c;
        }
    }

    /// The polynomial of the number `i` from the nested form of the dense outputs of Hairer, Nørsett
    /// and Wanner:
    ///
    /// ```text
    /// r₀ + s (r₁ + u (r₂ + s (r₃ + u (r₄ + …)))),   u = 1 − s
    /// ```
    pub(super) fn set_alternating<const TERMS: usize>(&mut self, i: usize, r: [f64; TERMS]) {
        let mut c = [0.0; TERMS];
        c[0] = r[TERMS - 1];
        for k in (0..TERMS - 1).rev() {
            // times s, or times 1 − s, and the next r
            for power in (1..TERMS - k).rev() {
                c[power] = if k % 2 == 0 { c[power - 1] } else { c[power] - c[power - 1] };
            }
            c[0] = if k % 2 == 0 { r[k] } else { c[0] + r[k] };
        }
        self.set_terms(i, c);
    }

    /// The numbers at `t` [s].
    pub fn at(&self, t: f64, y: &mut [f64]) {
        self.at_offset(t - self.start, y);
    }

    /// The numbers at a time from the start [s].
    pub fn at_offset(&self, offset: f64, y: &mut [f64]) {
        let s = offset / self.length;
        let mut terms = self.coefficients.chunks_exact(self.dimension.max(1)).rev();
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
