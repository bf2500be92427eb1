//! Tsitouras' method of order 5 with error control (Tsitouras 2011, Comput. Math. Appl. 62:770).
//!
//! ```text
//! k_i = Y′(t + c_i h, Y + h Σ_j a_ij k_j),  i = 1 … 6        Y₁ = Y + h Σ b_i k_i
//! k₇  = Y′(t + h, Y₁)        e = h Σ (b_i − b̂_i) k_i          b̂ of order 4
//! ```
//!
//! Order 5 for 6 evaluations, and one more where a step's error is estimated. The motion within a step
//! is a polynomial of degree 4 from the same stages. Cheaper than order 8 down to tolerances of about
//! 1e-5. It keeps neither |L| nor the energy.

use super::{Problem, Segment, StateVector, Step};
use crate::freedom::Scales;
use crate::state::Moment;

pub(super) const ORDER: u32 = 5;
pub(super) const EVALUATIONS: u32 = 6;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 5.0;

#[derive(Debug)]
pub(super) struct Kernel<Y> {
    stage: Y,
    /// The start, and the slopes k₁ … k₇.
    at: Moment,
    k: [Y; 7],
    /// Coefficients of s, s² and s³.
    c: [Y; 3],
}

impl<Y: StateVector> super::Kernel<Y> for Kernel<Y> {
    const EVALUATIONS: u32 = EVALUATIONS;
    const ERROR_ORDER: f64 = ERROR_ORDER;

    fn new(n: usize) -> Self {
        let at = Moment { time: 0.0, since: 0.0 };
        Self {
            stage: Y::zeros(n),
            at,
            k: std::array::from_fn(|_| Y::zeros(n)),
            c: std::array::from_fn(|_| Y::zeros(n)),
        }
    }

    #[rustfmt::skip]
    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y) {
        let Self { stage, k, .. } = self;
        let [k1, k2, k3, k4, k5, k6, _] = k;
        k1.clone_from(k0);
        stage.set_combination(y, h, [(0.161, k1)]);
        problem.rate(at.after(0.161 * h), stage, k2);
        stage.set_combination(y, h, [(-0.008480655492356989, k1), (0.335480655492357, k2)]);
        problem.rate(at.after(0.327 * h), stage, k3);
        stage.set_combination(y, h, [(2.8971530571054935, k1), (-6.359448489975075, k2), (4.3622954328695815, k3)]);
        problem.rate(at.after(0.9 * h), stage, k4);
        stage.set_combination(y, h, [(5.325864828439257, k1), (-11.748883564062828, k2), (7.4955393428898365, k3), (-0.09249506636175525, k4)]);
        problem.rate(at.after(0.9800255409045097 * h), stage, k5);
        stage.set_combination(y, h, [(5.86145544294642, k1), (-12.92096931784711, k2), (8.159367898576159, k3), (-0.071584973281401, k4), (-0.028269050394068383, k5)]);
        problem.rate(at.after(h), stage, k6);
        dy.set_increment(h, [(0.09646076681806523, k1), (0.01, k2), (0.4798896504144996, k3), (1.379008574103742, k4), (-3.290069515436081, k5), (2.324710524099774, k6)]);
        self.at = at;
    }

    #[rustfmt::skip]
    fn error<P: Problem<Y = Y>>(&mut self, problem: &mut P, y0: &Y, y1: &Y, h: f64, scales: &Scales) -> f64 {
        let Self { stage, at, k, .. } = self;
        let [k1, k2, k3, k4, k5, k6, k7] = k;
        problem.rate(at.after(h), y1, k7);
        stage.set_increment(h, [(-0.00178001105222577714, k1), (-0.0008164344596567469, k2), (0.007880878010261995, k3), (-0.1447110071732629, k4), (0.5823571654525552, k5), (-0.45808210592918697, k6), (1.0 / 66.0, k7)]);
        problem.error_size(y0, y1, stage, scales)
    }

    #[rustfmt::skip]
    fn interpolate<P: Problem<Y = Y>>(&mut self, _problem: &mut P, step: &Step<'_, Y>, segment: &mut Segment) -> u32 {
        // y(s) = y₀ + h Σ_i b_i(s) k_i, by powers of s
        let Self { k: [k1, k2, k3, k4, k5, k6, _], c: [c1, c2, c3], .. } = self;
        let k7 = step.k1;
        c1.set_increment(step.h, [(1.0, k1)]);
        c2.set_increment(step.h, [(-2.763706197274826, k1), (0.1317, k2), (3.9302962368947516, k3), (-12.411077166933676, k4), (37.50931341651104, k5), (-27.896526289197286, k6), (1.5, k7)]);
        c3.set_increment(step.h, [(2.9132554618219126, k1), (-0.2234, k2), (-5.941033872131505, k3), (30.33818863028232, k4), (-88.1789048947664, k5), (65.09189467479366, k6), (-4.0, k7)]);

        // the polynomial ends where the step does, its projection included
        let [c1, c2, c3] = [&*c1, c2, c3].map(AsRef::as_ref);
        let (y0, y1) = (step.y0.as_ref(), step.y1.as_ref());
        let n = y0.len();
        let terms = segment.set_span(step.at, step.h, n, 5);
        for i in 0..n {
            terms[i] = y0[i];
            terms[n + i] = c1[i];
            terms[2 * n + i] = c2[i];
            terms[3 * n + i] = c3[i];
            terms[4 * n + i] = (y1[i] - y0[i]) - (c1[i] + c2[i] + c3[i]);
        }
        0
    }
}
