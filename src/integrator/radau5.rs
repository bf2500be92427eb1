//! Radau IIA, order 5: the implicit method for stiff loads, such as strong drag (Ehle 1969; Hairer, Wanner,
//! Solving ODEs II, §IV.8).
//!
//! ```text
//! Z_i = h Σ_j a_ij Y′(t + c_j h, Y + Z_j),   i = 1, 2, 3,   c₃ = 1,   Y₁ = Y + Z₃
//! ```
//!
//! A load that wears off in a time τ far below the step does no harm: the method damps it as nature does
//! (it is stable for every h/τ, and forgets it at once where h/τ is large), so that the step follows what
//! is left of the motion. An explicit step would have to stay below some 3 τ for ever.
//!
//! The three stages are found by Newton's iteration with the Jacobian at the start of the step. In the
//! eigenvectors of A⁻¹ its system of 3 n equations falls apart into a real one of n and a complex one of
//! n, both factored once a step. Nothing is kept from step to step, so that a run that is saved and
//! resumed has the same bits. The motion within a step is the polynomial of the collocation, of order 3.

use super::{Problem, Segment, StateVector, Step};
use crate::freedom::Scales;
use crate::state::Moment;
use nalgebra::{Complex, ComplexField};

pub(super) const ORDER: u32 = 5;
/// Those of an iteration; the Jacobian takes one for every number.
pub(super) const EVALUATIONS: u32 = 3;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 4.0;

/// A kernel whose vectors all have the length of Y.
#[derive(Debug)]
pub(super) struct Kernel<Y> {
    /// Columns of ∂Y′/∂Y.
    jacobian: Vec<f64>,
    real: Factored<f64>,
    complex: Factored<Complex<f64>>,
    /// The stages less Y, and the rates there.
    z: [Y; 3],
    f: [Y; 3],
    /// The stages in eigenvectors of A⁻¹, and the right-hand sides of their systems.
    w: [Y; 3],
    right: Vec<f64>,
    right_pair: Vec<Complex<f64>>,
    stage: Y,
    k0: Y,
    at: Moment,
    evaluations: u32,
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;
    const ERROR_ORDER: f64 = ERROR_ORDER;

    fn new(n: usize) -> Self {
        let three = || std::array::from_fn(|_| Y::zeros(n));
        Self {
            jacobian: vec![0.0; n * n],
            real: Factored::new(n),
            complex: Factored::new(n),
            z: three(),
            f: three(),
            w: three(),
            right: vec![0.0; n],
            right_pair: vec![Complex::new(0.0, 0.0); n],
            stage: Y::zeros(n),
            k0: Y::zeros(n),
            at: Moment { time: 0.0, since: 0.0 },
            evaluations: 0,
        }
    }

    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        self.at = at;
        self.k0.clone_from(k0);
        self.evaluations = 1;
        self.linearise(problem, at, y, k0, h);
        let n = self.right.len();
        if !self.real.factor(n, &self.jacobian, REAL / h) || !self.complex.factor(n, &self.jacobian, PAIR / h) {
            // no step of this length: error control takes a shorter one
            return dy.as_mut().fill(f64::NAN);
        }
        for part in self.z.iter_mut().chain(&mut self.w) {
            part.as_mut().fill(0.0);
        }

        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let change = self.iterate(problem, at, y, h);
            // at rounding the changes stop shrinking
            if change == 0.0 || (change < CONVERGED && change > SETTLED * last) {
                dy.clone_from(&self.z[2]);
                return;
            }
            if change > DIVERGED * last || change.is_nan() {
                break;
            }
            last = change;
        }
        dy.as_mut().fill(f64::NAN);
    }

    /// Evaluations of f in the last step.
    fn evaluations(&self) -> u32 {
        self.evaluations
    }

    /// The embedded formula of order 3, filtered by `(γ/h − J)⁻¹` so that stiff parts do not blow it up.
    fn error<P: Problem<Y = Y>>(&mut self, problem: &mut P, y0: &Y, y1: &Y, h: f64, scales: &Scales) -> f64 {
        let n = self.right.len();
        let defect = |i: usize, z: &[Y; 3]| {
            (ERROR[0] * z[0].as_ref()[i] + ERROR[1] * z[1].as_ref()[i] + ERROR[2] * z[2].as_ref()[i]) / h
        };
        for i in 0..n {
            self.right[i] = defect(i, &self.z) + self.k0.as_ref()[i];
        }
        self.real.solve(&mut self.right);
        self.stage.as_mut().copy_from_slice(&self.right);
        let size = problem.error_size(y0, y1, &self.stage, scales);

        // once more, from where that error leads: right for stiff parts, and harmless for others
        for (s, y) in self.stage.as_mut().iter_mut().zip(y0.as_ref()) {
            *s += y;
        }
        problem.rate(self.at, &self.stage, &mut self.f[0]);
        self.evaluations += 1;
        for i in 0..n {
            self.right[i] = defect(i, &self.z) + self.f[0].as_ref()[i];
        }
        self.real.solve(&mut self.right);
        self.stage.as_mut().copy_from_slice(&self.right);
        size.min(problem.error_size(y0, y1, &self.stage, scales))
    }

    /// The polynomial through the start and the three stages.
    fn interpolate<P: Problem<Y = Y>>(&mut self, _problem: &mut P, step: &Step<'_, Y>, segment: &mut Segment) -> u32 {
        let n = step.y0.as_ref().len();
        let (c0, rest) = segment.set_span(step.at, step.h, n, 4).split_at_mut(n);
        let (c1, rest) = rest.split_at_mut(n);
        let (c2, c3) = rest.split_at_mut(n);
        for i in 0..n {
            // divided differences; the end is the front's own, projection included
            let end = step.y1.as_ref()[i] - step.y0.as_ref()[i];
            let (d1, d2, d3) = (self.z[0].as_ref()[i] / C[0], self.z[1].as_ref()[i] / C[1], end);
            let (d12, d23) = ((d2 - d1) / (C[1] - C[0]), (d3 - d2) / (1.0 - C[1]));
            let d123 = (d23 - d12) / (1.0 - C[0]);
            c0[i] = step.y0.as_ref()[i];
            c1[i] = d1 - d12 * C[0] + d123 * C[0] * C[1];
            c2[i] = d12 - d123 * (C[0] + C[1]);
            c3[i] = d123;
        }
        0
    }
}

impl<Y: StateVector> Kernel<Y> {
    /// The Jacobian at the start, by differences.
    fn linearise<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64) {
        let n = self.right.len();
        let size = y.as_ref().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for j in 0..n {
            let (yj, kj) = (y.as_ref()[j], k0.as_ref()[j]);
            let width = f64::EPSILON.sqrt() * yj.abs().max((h * kj).abs()).max(SMALL * size);
            let width = if width > 0.0 { width } else { f64::EPSILON };
            self.stage.clone_from(y);
            self.stage.as_mut()[j] += width;
            let width = self.stage.as_ref()[j] - yj;
            problem.rate(at, &self.stage, &mut self.f[0]);
            for (i, (f, k)) in self.f[0].as_ref().iter().zip(k0.as_ref()).enumerate() {
                self.jacobian[i * n + j] = (f - k) / width;
            }
        }
        self.evaluations += u32::try_from(n).unwrap_or(u32::MAX);
    }

    /// One iteration; the largest change of a stage, over the size of the motion [-].
    fn iterate<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, h: f64) -> f64 {
        let Self { z, f, w, right, right_pair, stage, .. } = self;
        for (c, (z, f)) in C.into_iter().zip(z.iter().zip(f.iter_mut())) {
            stage.set_sum(y, 1.0, z);
            problem.rate(at.after(c * h), stage, f);
        }
        self.evaluations += 3;

        let (real, pair) = (REAL / h, PAIR / h);
        for (i, (r, p)) in right.iter_mut().zip(right_pair.iter_mut()).enumerate() {
            let [f1, f2, f3] = [0, 1, 2].map(|k| f[k].as_ref()[i]);
            let [g1, g2, g3] = INVERSE.map(|row| row[0] * f1 + row[1] * f2 + row[2] * f3);
            *r = g1 - real * w[0].as_ref()[i];
            *p = Complex::new(g2, g3) - pair * Complex::new(w[1].as_ref()[i], w[2].as_ref()[i]);
        }
        self.real.solve(right);
        self.complex.solve(right_pair);

        let (mut change, mut size) = (0.0_f64, 0.0_f64);
        for i in 0..right.len() {
            let step = [right[i], right_pair[i].re, right_pair[i].im];
            for (w, step) in w.iter_mut().zip(step) {
                w.as_mut()[i] += step;
            }
            let [w1, w2, w3] = [0, 1, 2].map(|k| w[k].as_ref()[i]);
            for (z, row) in z.iter_mut().zip(VECTORS) {
                z.as_mut()[i] = row[0] * w1 + row[1] * w2 + row[2] * w3;
            }
            let moved = VECTORS.map(|row| (row[0] * step[0] + row[1] * step[1] + row[2] * step[2]).abs());
            change = moved.into_iter().fold(change, f64::max);
            size = size.max(y.as_ref()[i].abs()).max(z[2].as_ref()[i].abs());
        }
        if size > 0.0 { change / size } else { change }
    }
}

/// The stages' times, in steps.
const C: [f64; 3] = [0.15505102572168219018, 0.64494897427831780982, 1.0];
/// The real eigenvalue of A⁻¹, and the pair.
const REAL: f64 = 3.6378342527444957322;
/// See [`REAL`].
const PAIR: Complex<f64> = Complex::new(2.6810828736277521339, 3.0504301992474105694);
/// Its eigenvectors T: real, and real and imaginary part of the pair's.
const VECTORS: [[f64; 3]; 3] = [
    [9.1232394870892942792e-2, -0.14125529502095420843, -3.0029194105147424492e-2],
    [0.24171793270710701896, 0.20412935229379993199, 0.38294211275726193779],
    [0.96604818261509293619, 1.0, 0.0],
];
/// T⁻¹
const INVERSE: [[f64; 3]; 3] = [
    [4.3255798900631553510, 0.33919925181580986954, 0.54177053993587487119],
    [-4.1787185915519047273, -0.32768282076106238708, 0.47662355450055045196],
    [-0.50287263494578687595, 2.5719269498556054292, -0.59603920482822492497],
];
/// Weights of the stages in the embedded formula.
const ERROR: [f64; 3] = [-10.048809399827415562, 1.3821427331607488958, -0.33333333333333333333];

/// Most iterations of a step [-]: at a contraction of 0.7, from the size of the motion to rounding.
const ITERATIONS: u32 = 100;
/// Changes that shrink less than this have come to rounding [-].
const SETTLED: f64 = 0.5;
/// An iteration whose changes grow more than this leads nowhere [-].
const DIVERGED: f64 = 2.0;
/// Change below which an iteration that shrinks no more is at rounding [-].
const CONVERGED: f64 = 1.0e-12;
/// Least width of a difference, as a part of the largest number [-].
const SMALL: f64 = 1.0e-6;

/// `γ − J` in triangular factors, with rows exchanged; it keeps its memory from step to step.
#[derive(Debug)]
struct Factored<T> {
    rows: Vec<T>,
    pivots: Vec<usize>,
}

impl<T: ComplexField<RealField = f64> + Copy> Factored<T> {
    fn new(n: usize) -> Self {
        Self { rows: vec![T::zero(); n * n], pivots: vec![0; n] }
    }

    /// Factors `shift − J`; whether it could.
    fn factor(&mut self, n: usize, jacobian: &[f64], shift: T) -> bool {
        for (a, j) in self.rows.iter_mut().zip(jacobian) {
            *a = T::from_real(-j);
        }
        for i in 0..n {
            self.rows[i * n + i] += shift;
        }
        for k in 0..n {
            let best =
                (k..n).fold(
                    k,
                    |best, i| {
                        if self.rows[i * n + k].norm1() > self.rows[best * n + k].norm1() { i } else { best }
                    },
                );
            self.pivots[k] = best;
            for j in 0..n {
                self.rows.swap(k * n + j, best * n + j);
            }
            let pivot = self.rows[k * n + k];
            let size = pivot.norm1();
            if !(size > 0.0 && size.is_finite()) {
                return false;
            }
            for i in k + 1..n {
                let factor = self.rows[i * n + k] / pivot;
                self.rows[i * n + k] = factor;
                for j in k + 1..n {
                    let above = self.rows[k * n + j];
                    self.rows[i * n + j] -= factor * above;
                }
            }
        }
        true
    }

    fn solve(&self, b: &mut [T]) {
        let n = b.len();
        for k in 0..n {
            b.swap(k, self.pivots[k]);
        }
        for i in 0..n {
            for j in 0..i {
                let known = b[j];
                b[i] -= self.rows[i * n + j] * known;
            }
        }
        for i in (0..n).rev() {
            for j in i + 1..n {
                let known = b[j];
                b[i] -= self.rows[i * n + j] * known;
            }
            b[i] /= self.rows[i * n + i];
        }
    }
}
