//! Torque-free rotation of any rigid body in closed form.
//!
//! The angular momentum L is constant in the world; seen from the body it runs along Poinsot's polhode.
//! Call p the principal axis that it circles, m the middle axis and c the third, turned so that
//! (c, m, p) is right-handed, `a = 1/I` and `n = L_body/|L|`. Euler's equations then have the solution
//!
//! ```text
//! n = (A_c cn u, A_m sn u, A_p dn u)      u = u₀ ± λ t      λ = |L| A_p √((a_c − a_p)(a_m − a_p))
//! ```
//!
//! with `+` where p has the largest moment. The orientation is written with the Cayley–Klein parameters
//! of the quaternion `w + xi + yj + zk` that takes (c, m, p) to world axes whose third is L:
//! `α = w + iz`, `ξ = x + iy`, so that `n_c + i n_m = 2i ξ ᾱ` and `n_p = |α|² − |ξ|²`. They are single
//! theta functions of the nome Q = q² (q the nome of the elliptic functions), up to a common real factor:
//!
//! ```text
//! α = e^(iμt) θ₄(v − iε | Q)      ξ = e^(iμt) θ₁(v − iε | Q)      v = π u/(2K)
//! e^(−2ε) ← (A_m − A_c)/(A_m + A_c)      e^(−2ε̃) ← (A_c/(1 + A_p))²      ε + ε̃ = π K′/(2K)
//! μ = ½ |L| [a_c A_c²/(1 + A_p) + a_p A_p] ∓ (dv/dt) Im θ₄′/θ₄(−iε)
//! ```
//!
//! where `←` is Landen's descent ([`Landen::decay`]). With f = e^(−ε), g = e^(−ε̃) the nome is q = (fg)², and
//! the harmonics have the amplitudes `q^(k(k−1)/2) gᵏ (e^(ikv) ∓ f^(2k) e^(−ikv))`. Nothing in this is
//! singular: for a symmetric body q = 0, one harmonic is left and the motion is trigonometric; for a
//! sphere λ = 0 too; a steady spin has g = 0. There is no branch for any of them. The product form of
//! (α, ξ) is the classical one (Jacobi 1849; Whittaker, Analytical Dynamics §69–72; Klein–Sommerfeld),
//! with both parameters brought to one nome by Landen's transformation.
//!
//! Near the separatrix q tends to 1. Beyond K′/K = ½ Jacobi's imaginary transformation gives
//!
//! ```text
//! α = e^(iψ) θ₂(x + iy | D)     ξ = −i e^(iψ) θ₁(x + iy | D)     y = π u/(4K′)   D = e^(−πK/2K′)
//! x = (π/4) η/K′     tan am(η) = √((a_m − a_p)/(a_c − a_m))     ψ = μ′t − 2x j     u → u − 2K j
//! ```
//!
//! whose leading terms are the hyperbolic functions of the separatrix itself (K = ∞, D = 0).
//!
//! **Digits.** The complement of the parameter comes from the inputs, `m₁ ∝ L² − 2E I_m`, in doubled
//! precision; differences of inverses of moments come from differences of moments; phases are
//! reduced from the exact product of rate and time. The error is a few ε per radian turned, times the
//! growth of the motion where it is unstable.
//!
//! The solution goes back to Jacobi; van Zon and Schofield (2007, J. Comput. Phys. 225:145) and
//! Celledoni, Fassò, Säfström, Zanna (2008, SIAM J. Sci. Comput. 30:2084) brought it to numerical use.
//! Both integrate an angle about L by a third theta function or Legendre's Π; the sign conventions
//! of published cases disagree, and none is taken over here.

use crate::math::elliptic::{Landen, SERIES_SWITCH, small_nome};
use crate::math::sum::{two_product, two_sum};
use crate::math::{Matrix3, Quaternion, Vector3, quaternion};

/// The rotation of one body on which no torque acts, at any time.
#[derive(Debug, Clone)]
pub struct FreeRotation {
    /// Columns: the axes c, m, p in body axes.
    axes: Matrix3,
    /// The linear map from the quaternion (c, m, p) → (·, ·, L) to that from body to world.
    to_world: [[f64; 4]; 4],
    /// |L| [kg m²/s].
    length: f64,
    /// dψ/dt, the common phase of α and ξ [rad/s].
    phase_rate: f64,
    /// dv/dt or dw/dt, signed [rad/s].
    rate: f64,
    series: Series,
}

/// The two forms of the theta series.
#[derive(Debug, Clone)]
enum Series {
    Circular(Circular),
    Hyperbolic(Hyperbolic),
}

/// α, ξ up to a common positive factor, and n up to another.
#[derive(Debug, Clone, Copy)]
struct Relative {
    alpha: [f64; 2],
    xi: [f64; 2],
    n: [f64; 3],
}

/// An instant as an unevaluated sum [s].
#[derive(Debug, Clone, Copy)]
struct Instant {
    high: f64,
    low: f64,
}

impl FreeRotation {
    /// The rotation of a body from its state at t = 0.
    ///
    /// - `principal_moments` [kg m²]: positive and finite, in any order;
    /// - `principal_axes`: their axes as columns, in body axes, orthonormal to rounding, of either handedness;
    /// - `orientation`: body to world, of which `q/|q|` is taken;
    /// - `angular_momentum_body`: L in body axes [kg m²/s]; zero is a body at rest.
    pub fn new(
        principal_moments: Vector3,
        principal_axes: Matrix3,
        orientation: Quaternion,
        angular_momentum_body: Vector3,
    ) -> Self {
        // the directions of a left-handed set reversed name the same axes
        let principal_axes = if principal_axes.determinant() < 0.0 { -principal_axes } else { principal_axes };

        // in units that are powers of two, so that squares neither overflow nor round
        let l = principal_axes.tr_mul(&angular_momentum_body);
        let i_unit = power_of_two_below(principal_moments.amax());
        let moments = principal_moments / i_unit;
        let (l, l_unit) = if l.amax() == 0.0 {
            (Vector3::z(), 0.0) // at rest: any direction, at no rate
        } else {
            let l_unit = power_of_two_below(l.amax());
            (l / l_unit, l_unit)
        };

        let polhode = Polhode::new(&moments, &l);
        let Polhode { inertia: [i_c, i_m, i_p], amplitude: [a_c, _, a_p], .. } = polhode;
        let sign = if i_p >= i_c { 1.0 } else { -1.0 };
        let total = l.norm();

        // λ, and the phase rate of α where L crosses the plane of c and p
        let unit = l_unit / i_unit;
        let lambda = a_p / i_p * ((i_p - i_c) / i_c * ((i_p - i_m) / i_m)).max(0.0).sqrt() * unit;
        let crossing = 0.5 * (a_c * a_c / ((total + a_p) * i_c) + a_p / i_p) * unit;

        let (series, rate, phase_rate) = if polhode.m1 >= SERIES_SWITCH {
            let (circular, stretch, slope) = Circular::new(&polhode, total);
            let rate = sign * (lambda / stretch);
            (Series::Circular(circular), rate, crossing - rate * slope)
        } else {
            let (hyperbolic, stretch, slope) = Hyperbolic::new(&polhode);
            let rate = sign * (lambda / stretch);
            (Series::Hyperbolic(hyperbolic), rate, crossing - 0.5 * rate * slope)
        };

        // orientation = to_world(X) with X at t = 0 known: one linear map for all times
        let axes = principal_axes * polhode.axes;
        let mut motion = Self { axes, to_world: [[0.0; 4]; 4], length: total * l_unit, phase_rate, rate, series };
        let start = match &motion.series {
            Series::Circular(series) => series.at(series.start, [1.0, 0.0]),
            Series::Hyperbolic(series) => series.at(rate, phase_rate, Instant { high: 0.0, low: 0.0 }),
        };
        let x0 = quaternion::normalized(&Quaternion::new(start.alpha[0], start.xi[0], start.xi[1], start.alpha[1]));
        let body = quaternion::from_matrix(&axes);
        let left = quaternion::normalized(&orientation) * body * x0.conjugate();
        let right = body.conjugate();
        let [w, x, y, z] = quaternion::to_scalar_first(&left);
        // left times 1, i, j, k
        let columns = [[w, x, y, z], [-x, w, z, -y], [-y, -z, w, x], [-z, y, -x, w]];
        let columns = columns.map(|c| quaternion::to_scalar_first(&(quaternion::from_scalar_first(c) * right)));
        motion.to_world = std::array::from_fn(|row| columns.map(|column| column[row]));
        motion
    }

    /// Orientation (body to world, of unit length) and angular momentum in body axes [kg m²/s] at the time
    /// `t` [s], positive or negative.
    pub fn at(&self, t: f64) -> (Quaternion, Vector3) {
        self.state(&self.relative(Instant { high: t, low: 0.0 }))
    }

    /// The states at the times `t0 + k dt`, k = 0, 1, …, `count − 1` [s].
    ///
    /// Times are exact, not rounded sums. Away from the separatrix the sines and cosines come from a
    /// table of 32 steps, turned once for each block; an entry is one complex product away from
    /// a direct evaluation, so that its error does not grow along the grid.
    pub fn uniform(&self, t0: f64, dt: f64, count: usize) -> Uniform<'_> {
        let table = match &self.series {
            Series::Circular(_) => (0..BLOCK.min(count))
                .map(|k| {
                    let step = instant(0.0, dt, k);
                    (turn(self.rate, step), turn(self.phase_rate, step))
                })
                .collect(),
            Series::Hyperbolic(_) => Vec::new(),
        };
        Uniform { motion: self, t0, dt, next: 0, count, table, anchor: ([1.0, 0.0], [1.0, 0.0]) }
    }

    fn relative(&self, t: Instant) -> Relative {
        match &self.series {
            Series::Circular(series) => series.at(product(series.start, turn(self.rate, t)), turn(self.phase_rate, t)),
            Series::Hyperbolic(series) => series.at(self.rate, self.phase_rate, t),
        }
    }

    #[inline]
    fn state(&self, relative: &Relative) -> (Quaternion, Vector3) {
        let x = [relative.alpha[0], relative.xi[0], relative.xi[1], relative.alpha[1]];
        let [w, i, j, k] = self.to_world.map(|m| m[0] * x[0] + m[1] * x[1] + m[2] * x[2] + m[3] * x[3]);
        let scale = 1.0 / (w * w + i * i + j * j + k * k).sqrt();
        let q = Quaternion::new(scale * w, scale * i, scale * j, scale * k);

        let n = self.axes * Vector3::from(relative.n);
        let l = n * (self.length / n.norm_squared().sqrt());
        (q, l)
    }
}

/// Steps between direct evaluations on a uniform grid [-]. More cost less time on long grids, but make
/// short ones dearer: filling the table takes as long as so many direct evaluations.
const BLOCK: usize = 32;

/// States on a uniform grid of times; see [`FreeRotation::uniform`].
#[derive(Debug, Clone)]
pub struct Uniform<'a> {
    motion: &'a FreeRotation,
    t0: f64,
    dt: f64,
    next: usize,
    count: usize,
    table: Vec<([f64; 2], [f64; 2])>,
    anchor: ([f64; 2], [f64; 2]),
}

impl Iterator for Uniform<'_> {
    type Item = (Quaternion, Vector3);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        if self.next == self.count {
            return None;
        }
        let k = self.next;
        self.next += 1;
        let motion = self.motion;
        let relative = match &motion.series {
            Series::Circular(series) => {
                if k.is_multiple_of(BLOCK) {
                    let t = instant(self.t0, self.dt, k);
                    self.anchor = (product(series.start, turn(motion.rate, t)), turn(motion.phase_rate, t));
                }
                let (v, phase) = self.table[k % BLOCK];
                series.at(product(self.anchor.0, v), product(self.anchor.1, phase))
            }
            Series::Hyperbolic(series) => series.at(motion.rate, motion.phase_rate, instant(self.t0, self.dt, k)),
        };
        Some(motion.state(&relative))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.count - self.next, Some(self.count - self.next))
    }
}

impl ExactSizeIterator for Uniform<'_> {}

/// The way of L seen from the body, in (c, m, p).
struct Polhode {
    /// Columns: c, m, p in principal axes; a signed permutation.
    axes: Matrix3,
    inertia: [f64; 3],
    /// L (not normalised), with `n_c` ≥ 0 and `n_p` ≥ 0.
    n: [f64; 3],
    /// `A_c`, `A_m`, `A_p`, in the same unit.
    amplitude: [f64; 3],
    /// `(a_c − a_m)/(a_c − a_p)` and `(a_m − a_p)/(a_c − a_p)`; their sum is 1.
    kappa: [f64; 2],
    /// Parameter of the elliptic functions and its complement.
    m: f64,
    m1: f64,
}

impl Polhode {
    fn new(moments: &Vector3, l: &Vector3) -> Self {
        let (low, mid, high) = sorted(moments);

        // L² − 2E I_mid, times I_low I_high: its sign says which axis L circles
        let excess = separation(l[high], moments[low], moments[high], moments[mid]).minus(separation(
            l[low],
            moments[high],
            moments[mid],
            moments[low],
        ));
        let circles_high = if excess.high == 0.0 {
            // on the separatrix, or in the plane of two equal moments: the axis that is farther apart
            moments[high] - moments[mid] >= moments[mid] - moments[low]
        } else {
            excess.high > 0.0
        };
        // a spin about the middle axis circles that; what other momentum there is, is lost in squares
        let steady = l[low].abs().max(l[high].abs()) < STEADY_TILT;
        let (p, m, c) = match (steady, circles_high) {
            (true, _) => (mid, high, low),
            (false, true) => (high, mid, low),
            (false, false) => (low, mid, high),
        };

        // right-handed, and L between c and p
        let (mut e_p, mut e_c) = (Vector3::zeros(), Vector3::zeros());
        e_p[p] = 1f64.copysign(l[p]);
        e_c[c] = 1f64.copysign(l[c]);
        let axes = Matrix3::from_columns(&[e_c, e_p.cross(&e_c), e_p]);
        let n: [f64; 3] = axes.tr_mul(l).into();
        let inertia @ [i_c, i_m, i_p] = [moments[c], moments[m], moments[p]];

        // amplitudes: sums of squares
        let span = i_m * (i_p - i_c);
        let kappa @ [to_m, to_p] =
            if steady || span == 0.0 { [0.0, 1.0] } else { [i_p * (i_m - i_c) / span, i_c * (i_p - i_m) / span] };
        let squares = n.map(|x| x * x);
        let a_c2 = squares[0] + squares[1] * to_p;
        let a_p2 = squares[2] + squares[1] * to_m;
        let amplitude = [a_c2.sqrt(), (a_c2 / to_p).sqrt(), a_p2.sqrt()];

        // the parameter and its complement, neither as 1 less the other; no elliptic functions are needed
        // for two equal moments
        let (m, m1) = if to_m == 0.0 {
            (0.0, 1.0)
        } else {
            let m = a_c2 / a_p2 * to_m / to_p;
            (m.min(1.0), (excess.high.abs() / (i_c * (i_p - i_m).abs() * a_p2)).min(1.0))
        };
        Self { axes, inertia, n, amplitude, kappa, m, m1 }
    }

    /// The cosine and sine of the amplitude at t = 0, times a common factor.
    fn start(&self) -> (f64, f64) {
        (self.n[0], self.n[1] * self.kappa[1].sqrt())
    }
}

/// Tilt from the middle axis that counts as none [-]. Its square would underflow; it would grow to
/// a visible size only after e^345-fold.
const STEADY_TILT: f64 = 1.0e-150;

/// The series in e^(iv), for nomes up to 0.208.
#[derive(Debug, Clone)]
struct Circular {
    /// e^(iv) at t = 0.
    start: [f64; 2],
    /// Harmonics in pairs (2j + 1, 2j + 2), of which `used` matter.
    pairs: [Pair; PAIRS],
    used: usize,
    /// The constant term of `n_p`.
    mean_p: f64,
}

/// Two harmonics: factors of the cosine and sine of the odd one in (Im ξ, Re ξ) and (`n_c`, `n_m`), of those of the
/// even one in (Re α, Im α), and of its cosine in `n_p`; eight numbers, so that they are summed abreast.
type Pair = [f64; 8];

/// Pairs of harmonics that the largest nome needs: q^(30) and q^(36) are below rounding [-].
const PAIRS: usize = 5;

impl Circular {
    /// The series, `2K/π`, and `Im θ₄′/θ₄(−iε)`.
    fn new(polhode: &Polhode, total: f64) -> (Self, f64, f64) {
        let Polhode { amplitude: [a_c, a_m, a_p], kappa: [to_m, to_p], m, m1, .. } = *polhode;
        let chain = Landen::new(m, m1);
        let (cos, sin) = polhode.start();
        let (sin, cos) = libm::sincos(chain.argument(cos, sin));

        // f² = e^(−2ε) from the moments, g² = e^(−2ε̃) from the momentum: the larger by descent, the
        // smaller from their product q
        let q = chain.nome();
        let f2_start = to_m / square(1.0 + to_p.sqrt());
        let g2_start = square(a_c / (total + a_p));
        let (f2, g2) = if f2_start == 0.0 && g2_start == 0.0 {
            (0.0, 0.0)
        } else if f2_start >= g2_start {
            let f2 = chain.decay(f2_start);
            (f2, q / f2)
        } else {
            let g2 = chain.decay(g2_start);
            (q / g2, g2)
        };
        let g = g2.sqrt();

        // harmonics k = 2j + 1 and 2j + 2; theta functions of q stand beside those of Q
        let mut pairs = [[0.0; 8]; PAIRS];
        let mut used = 0;
        let (mut q_k, mut e, mut f_k) = (q, g, f2); // qᵏ, q^(k(k−1)/2) gᵏ, f^(2k)
        let (mut odd, mut even, mut sign) = (1.0, 1.0, 1.0); // q^(j² + j), q^(j²), (−1)ʲ
        let (mut theta2, mut theta3, mut theta4) = (0.0, 1.0, 1.0);
        let (mut value, mut slope) = (1.0, 0.0);
        while used < PAIRS && odd > NEGLIGIBLE {
            let pair = &mut pairs[used];
            (pair[0], pair[1]) = (-sign * e * (1.0 - f_k), sign * e * (1.0 + f_k));
            (pair[2], pair[3]) = (odd, sign * odd);
            theta2 += odd;
            even *= q_k;
            e *= q_k * g;
            q_k *= q;
            f_k *= f2;

            (pair[4], pair[5]) = (-sign * e * (1.0 + f_k), -sign * e * (1.0 - f_k));
            pair[6] = 2.0 * even;
            theta3 += 2.0 * even;
            theta4 -= 2.0 * sign * even;
            odd *= q_k;
            e *= q_k * g;
            q_k *= q;
            f_k *= f2;

            used += 1;
            value += pair[4];
            slope += 2.0 * used as f64 * pair[5];
            sign = -sign;
        }

        // n = (A_c θ₄/θ₂ θ₂(v), A_m θ₃/θ₂ θ₁(v), A_p θ₄/θ₃ θ₃(v)) / θ₄(v), whose length needs no θ₄(v)
        let (to_c, to_mid, mean_p) = (a_c * theta4 / theta2, a_m * theta3 / theta2, a_p * theta4 / theta3);
        for pair in &mut pairs[..used] {
            pair[2] *= to_c;
            pair[3] *= to_mid;
            pair[6] *= mean_p;
        }
        (Self { start: [cos, sin], pairs, used, mean_p }, chain.stretch(), slope / value)
    }

    /// At the argument v and the phase, each as cosine and sine.
    #[inline]
    fn at(&self, v: [f64; 2], phase: [f64; 2]) -> Relative {
        let mut odd = v;
        let twice = [(odd[0] - odd[1]) * (odd[0] + odd[1]), 2.0 * odd[0] * odd[1]];
        let mut even = twice;
        let mut sum: Pair = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, self.mean_p, 0.0];
        for pair in &self.pairs[..self.used] {
            let wave = [odd[0], odd[1], odd[0], odd[1], even[0], even[1], even[0], even[1]];
            for i in 0..8 {
                sum[i] += pair[i] * wave[i];
            }
            odd = product(odd, twice);
            even = product(even, twice);
        }
        let [xi_im, xi_re, n_c, n_m, alpha_re, alpha_im, n_p, _] = sum;
        let (alpha, xi, n) = ([alpha_re, alpha_im], [xi_re, xi_im], [n_c, n_m, n_p]);
        Relative { alpha: product(alpha, phase), xi: product(xi, phase), n }
    }
}

/// Power of the nome below which a pair of harmonics changes nothing [-].
const NEGLIGIBLE: f64 = 1.0e-17;

/// The series in e^w, w = 2y = πu/(2K′), for nomes above 0.208 up to the separatrix, where D = 0.
#[derive(Debug, Clone)]
struct Hyperbolic {
    /// Where u₀ is measured from.
    base: Base,
    /// w at t = 0, from the base [rad].
    start: f64,
    /// Advance of w in half a period, `−ln q′`; infinite on the separatrix.
    half_period: f64,
    /// D = √q′.
    nome: f64,
    /// x, half of the turn by which the phase jumps in half a period [rad].
    x: f64,
    /// D^(k²) (cos, sin) of (2k + 1) x, then the same with the sign (−1)ᵏ for ξ, k = 0…3.
    harmonics: [[f64; 4]; 4],
    /// Factors of `n_c`, `n_m`, `n_p`.
    scale: [f64; 3],
}

/// The point that times are measured from.
#[derive(Debug, Clone, Copy)]
enum Base {
    /// L crosses the plane of c and p at u = 0.
    Crossing,
    /// L is nearest to the middle axis at u = ±K, the side given by the sign. Starting from here keeps the
    /// digits of a small tilt, which the difference of u from K would not.
    Middle(f64),
}

impl Hyperbolic {
    /// The series, `2K′/π`, and `θ₂′/θ₂(x)`.
    fn new(polhode: &Polhode) -> (Self, f64, f64) {
        let Polhode { n: [n_c, n_m, n_p], amplitude: [a_c, a_m, a_p], kappa: [to_m, to_p], m, m1, .. } = *polhode;
        let chain = Landen::new(m1, m);
        let q = small_nome(m1, m);
        let nome = q.sqrt();
        let x = 0.5 * chain.argument(to_m.sqrt(), to_p.sqrt());

        // the harmonics, and θ₂ with its slope at x
        let mut harmonics = [[0.0; 4]; 4];
        let (s1, c1) = libm::sincos(x);
        let twice = [(c1 - s1) * (c1 + s1), 2.0 * s1 * c1];
        let mut odd = [c1, s1];
        let (mut square, mut power, mut d_k, mut sign) = (1.0, 1.0, nome, 1.0); // D^(k²), D^(k² + k), D^(2k + 1)
        let (mut value, mut slope) = (0.0, 0.0);
        for (k, h) in harmonics.iter_mut().enumerate() {
            let (cos, sin) = (square * odd[0], square * odd[1]);
            *h = [cos, sin, sign * cos, sign * sin];
            value += power * odd[0];
            slope -= (2 * k + 1) as f64 * power * odd[1];
            square *= d_k;
            power *= d_k * nome;
            d_k *= q;
            odd = product(odd, twice);
            sign = -sign;
        }

        // n = (A_c θ₂/θ₄ θ₄(w), A_m θ₃/θ₄ θ₁(w), A_p θ₂/θ₃ θ₃(w)) / θ₂(w), nome q′, θ₁ and θ₂ without q′^¼
        let (first, second) = (2.0 * q, 2.0 * q * q * q * q);
        let (theta2, theta3, theta4) = (2.0 * (1.0 + q * q), 1.0 + first + second, 1.0 - first + second);
        let scale = [a_c * theta2 / theta4, a_m * theta3 / theta4, a_p * theta2 / theta3];

        // from sinh χ = sc(u) below K/2, else the same of K − u
        let (sn, cn, dn) = (n_m.abs() * to_p.sqrt() / a_c, n_c / a_c, n_p / a_p);
        let (base, start) = if dn * dn >= m1.sqrt() {
            let w = -0.5 * libm::log(chain.decay(self::square(cn / (1.0 + sn))));
            (Base::Crossing, w.copysign(n_m))
        } else {
            (Base::Middle(1f64.copysign(n_m)), -0.5 * libm::log(chain.decay(m1 * self::square(sn / (dn + cn)))))
        };
        (Self { base, start, half_period: -libm::log(q), nome, x, harmonics, scale }, chain.stretch(), slope / value)
    }

    fn at(&self, rate: f64, phase_rate: f64, t: Instant) -> Relative {
        // w from the base, within half a period, and the number of half periods
        let rate = if let Base::Middle(side) = self.base { -side * rate } else { rate };
        let (advance, rest) = angle(rate, t);
        let (w, error) = two_sum(self.start, advance);
        let periods = if self.half_period.is_finite() { libm::rint(w / self.half_period) } else { 0.0 };
        let (whole, whole_error) = if periods == 0.0 { (0.0, 0.0) } else { two_product(periods, self.half_period) };
        let w = (w - whole) + ((error + rest) - whole_error);

        // near = e^(−|w|) counted from u = 0, far = D/near the same from u = K
        let decay = libm::exp(-w.abs());
        let other = if self.nome == 0.0 { 0.0 } else { self.nome / decay };
        let (near, far, side, j) = match self.base {
            Base::Crossing => (decay, other, 1f64.copysign(w), periods),
            Base::Middle(side) if w >= 0.0 => (other, decay, side, -side * periods),
            Base::Middle(side) => (other, decay, -side, side * (1.0 - periods)),
        };

        // α = Σ D^(k² + k) [cos (2k+1)x cosh (2k+1)y − i sin (2k+1)x sinh (2k+1)y], all times e^(−|y|)
        let (mut alpha, mut xi) = ([0.0, 0.0], [0.0, 0.0]);
        let (mut rising, mut falling) = (1.0, near); // farᵏ, Dᵏ nearᵏ⁺¹
        for h in &self.harmonics {
            let (cosh, sinh) = (rising + falling, side * (rising - falling));
            alpha[0] += h[0] * cosh;
            alpha[1] -= h[1] * sinh;
            xi[0] += h[2] * sinh;
            xi[1] -= h[3] * cosh;
            rising *= far;
            falling *= self.nome * near;
        }

        // theta functions of q′ = D², times e^(−|w|)
        let (d2, f2, n2) = (self.nome * self.nome, far * far, near * near);
        let d4 = d2 * d2;
        let (first, second) = (f2 + d2 * n2, d4 * (f2 * f2 + d4 * n2 * n2));
        let theta4 = near * ((1.0 - first) + second);
        let theta3 = near * ((1.0 + first) + second);
        let theta1 = side * ((1.0 - n2) - (d2 * f2 - d4 * n2 * n2) + d4 * d4 * f2 * f2);
        let n = [self.scale[0] * theta4, self.scale[1] * theta1, self.scale[2] * theta3];

        // each half period turns (c, m) by a half turn and the phase by 2x
        let odd = if libm::fmod(j, 2.0) == 0.0 { 1.0 } else { -1.0 };
        let (psi, rest) = angle(phase_rate, t);
        let (jump, jump_error) = two_product(-2.0 * self.x, j);
        let (psi, error) = two_sum(psi, jump);
        let phase = cos_sin(psi, error + (rest + jump_error));
        Relative {
            alpha: product(alpha, phase),
            xi: product([odd * xi[0], odd * xi[1]], phase),
            n: [odd * n[0], odd * n[1], n[2]],
        }
    }
}

/// `t0 + k dt`.
fn instant(t0: f64, dt: f64, k: usize) -> Instant {
    let (p, e) = two_product(dt, k as f64);
    let (high, low) = two_sum(t0, p);
    Instant { high, low: low + e }
}

/// The angle `rate t` as a rounded value and the rest [rad].
#[inline]
fn angle(rate: f64, t: Instant) -> (f64, f64) {
    let (value, rest) = two_product(rate, t.high);
    (value, rest + rate * t.low)
}

/// Cosine and sine of an angle given with its rest [rad].
#[inline]
fn cos_sin(angle: f64, rest: f64) -> [f64; 2] {
    let (s, c) = libm::sincos(angle);
    // the rest is an ulp of the angle: a series will do up to 1e12 rad
    let (s_rest, c_rest) = if rest.abs() < 1e-4 {
        let half = 0.5 * rest * rest;
        (rest - rest * half / 3.0, 1.0 - half)
    } else {
        libm::sincos(rest)
    };
    [c * c_rest - s * s_rest, s * c_rest + c * s_rest]
}

/// Cosine and sine of `rate t`.
#[inline]
fn turn(rate: f64, t: Instant) -> [f64; 2] {
    let (value, rest) = angle(rate, t);
    cos_sin(value, rest)
}

/// The product of two complex numbers.
#[inline]
fn product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

#[inline]
fn square(x: f64) -> f64 {
    x * x
}

/// Indices of the smallest, the middle and the largest component.
fn sorted(v: &Vector3) -> (usize, usize, usize) {
    let (mut low, mut mid, mut high) = (0, 1, 2);
    if v[low] > v[mid] {
        (low, mid) = (mid, low);
    }
    if v[mid] > v[high] {
        (mid, high) = (high, mid);
    }
    if v[low] > v[mid] {
        (low, mid) = (mid, low);
    }
    (low, mid, high)
}

/// The power of two at or below x > 0, or the smallest normal one.
fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000).max(f64::MIN_POSITIVE)
}

/// An unevaluated sum of two `f64`, for the one difference that decides everything.
#[derive(Debug, Clone, Copy)]
struct Double {
    high: f64,
    low: f64,
}

impl Double {
    fn times(self, b: Self) -> Self {
        let (p, e) = two_product(self.high, b.high);
        let (high, low) = two_sum(p, e + (self.high * b.low + self.low * b.high));
        Self { high, low }
    }

    fn minus(self, b: Self) -> Self {
        let (d, e) = two_sum(self.high, -b.high);
        let (high, low) = two_sum(d, e + (self.low - b.low));
        Self { high, low }
    }
}

/// `l² i (upper − lower)` to twice the digits of `f64`.
fn separation(l: f64, i: f64, upper: f64, lower: f64) -> Double {
    let (high, low) = two_product(l, l);
    let (difference, rest) = two_sum(upper, -lower);
    Double { high, low }.times(Double { high: i, low: 0.0 }).times(Double { high: difference, low: rest })
}
