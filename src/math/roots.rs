//! Where a smooth function passes through 0 or touches it, on one interval after another.
//!
//! Signs at the ends of an interval show neither a double root nor two close ones. So what cannot hold a root
//! is excluded, by a polynomial whose range is known:
//!
//! ```text
//! g = p + r        p of degree n through Chebyshev's nodes;  |r| ≤ E = 2 Σ |c_k|, k = n + 1 … 2n, + rounding
//! p = Σ b_i B_i    Bernstein's form, so min b_i ≤ p ≤ max b_i
//!
//! |b_i| > E, all of one sign          no root
//! b_i rising or falling, faster than r can turn it, and both ends out of E      one passage
//! |b_i| ≤ 2E, all                     0 for all that can be told: a passage or a touch, by the signs around it
//! else                                halve; by de Casteljau while E is rounding, by new samples where it is more
//! ```
//!
//! Chebyshev's coefficients `c_k` come from 2n + 1 samples; that those beyond the polynomial also bound what lies
//! beyond the samples is true where they fall, as those of any smooth function do on a short interval. For a
//! polynomial of degree 8 and less p is g, and the exclusion a proof up to rounding. A feature narrower than the
//! distance of two samples, 1/17 of the interval, can be missed. A passage is then located on g itself (ITP,
//! Oliveira and Takahashi 2021, ACM Trans. Math. Softw. 47:5), a touch at the extreme of p.

use std::f64::consts::FRAC_1_SQRT_2;

/// What a function does at a root.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Passage {
    /// From below 0 to above.
    Rising,
    /// From above 0 to below.
    Falling,
    /// It comes to 0, and goes back.
    Touching,
}

impl Passage {
    /// The name that reports and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rising => "rising",
            Self::Falling => "falling",
            Self::Touching => "touching",
        }
    }
}

/// A root, and where it is in the interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Root {
    pub(crate) at: f64,
    pub(crate) passage: Passage,
}

/// What is known of a function where an interval ends, for the next.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Track {
    /// Whether it was above 0 where it last differed from it; none before it ever did: a root at the very start
    /// is none.
    above: Option<bool>,
    /// Where it is 0 since, for all that can be told: how far its extreme, or else its end, lies behind.
    open: Option<f64>,
    /// Whether it was 0 over a whole interval.
    rests: bool,
    /// Its largest value on the last interval: where two meet, both call the same values 0.
    scale: f64,
}

/// Why the roots of a function cannot be told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoRoots {
    /// It is not a finite number somewhere.
    NotFinite,
    /// The samples allowed do not tell them apart.
    Unresolved,
}

/// Degree of the polynomial [-].
const DEGREE: usize = 8;
/// Most samples on an interval [-].
const SAMPLES: u32 = 20_000;
/// Rounding of a sample, as a part of the size of what it is worked out from [-].
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Largest part of its size that may be noise of a function [-]: remainders above it are taken for features.
const NOISE: f64 = 1.0e-11;
/// Halvings by de Casteljau [-]: to the rounding of an interval.
const HALVINGS: u32 = 52;
/// Bound of the slope of a remainder, in units of its size on 0..1 [-]: Markov's inequality for degree 16.
const TURN: f64 = 512.0;

/// The roots of `g` on 0..`length`, in their order; `size` is what rounding of g is measured by beside g itself,
/// `resolution` the least distance that matters, `track` what the interval before has left.
///
/// # Errors
/// A value that is not finite; no end after [`SAMPLES`] samples.
pub(crate) fn find_roots(
    g: &mut dyn FnMut(f64) -> f64,
    length: f64,
    size: f64,
    resolution: f64,
    track: &mut Track,
) -> Result<Vec<Root>, NoRoots> {
    let (before, scale) = (track.scale, size);
    let mut search = Search { g, before, resolution, scale, samples: 0, pieces: Vec::new() };
    let ends = [search.sample(0.0)?, search.sample(length)?];
    search.cover([0.0, length], ends, f64::INFINITY)?;
    track.scale = search.scale;
    let pieces = std::mem::take(&mut search.pieces);
    Ok(search.walk(&pieces, length, track))
}

/// What is known of g on a piece of the interval.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Known {
    /// Above 0, or below.
    Sign(bool),
    /// One root, with g above 0 behind it or before it.
    Passes(bool),
    /// 0 for all that can be told; where its extreme is, if it has one there.
    Vague(Option<f64>),
}

#[derive(Debug, Clone, Copy)]
struct Piece {
    span: [f64; 2],
    known: Known,
}

struct Search<'a> {
    g: &'a mut dyn FnMut(f64) -> f64,
    /// The scale of the interval before.
    before: f64,
    resolution: f64,
    /// What g is worked out from, or its largest sample: rounding is measured by it.
    scale: f64,
    samples: u32,
    pieces: Vec<Piece>,
}

impl Search<'_> {
    /// Covers a span, at whose ends g has these values, with pieces; a span of which this one is a part left a
    /// remainder of `before`.
    fn cover(&mut self, span: [f64; 2], ends: [f64; 2], before: f64) -> Result<(), NoRoots> {
        let [a, b] = span;
        let node = |j: usize| 0.5 * (a + b) + 0.5 * (b - a) * cosine(j);
        let mut samples = [0.0; 2 * DEGREE + 1];
        (samples[2 * DEGREE], samples[0]) = (ends[0], ends[1]);

        // half the samples and half the degree are enough for most spans
        for j in (2..2 * DEGREE).step_by(2) {
            samples[j] = self.sample(node(j))?;
        }
        let coarse: [f64; DEGREE + 1] = std::array::from_fn(|j| samples[2 * j]);
        let largest = coarse.iter().fold(0.0_f64, |m, g| m.max(g.abs()));
        self.scale = self.scale.max(largest);
        let floor = ROUNDING * self.scale.max(self.before);
        let (bernstein, rest) = fit(&coarse, DEGREE / 2);
        if let Some(above) = sign(&bernstein, 2.0 * rest + floor) {
            self.pieces.push(Piece { span, known: Known::Sign(above) });
            return Ok(());
        }

        // all samples; then the polynomial is cut up until every piece is known, or vague
        for j in (1..2 * DEGREE).step_by(2) {
            samples[j] = self.sample(node(j))?;
        }
        let (bernstein, rest) = fit(&samples, DEGREE);
        let error = 2.0 * rest + floor;
        let mut pieces = Vec::new();
        isolate(&bernstein, [0.0, 1.0], error, TURN * 2.0 * rest, HALVINGS, &mut pieces);

        // what is vague by more than rounding is sampled anew, unless that is noise, or there is no room for it
        let noise = rest > 0.25 * before && rest <= NOISE * self.scale;
        let narrow = b - a <= 8.0 * self.resolution;
        let fine = error <= 4.0 * floor || noise;
        let mut next = 0;
        while let Some(&(part, known)) = pieces.get(next) {
            next += 1;
            let place = |s: f64| if s >= 1.0 { b } else { a + (b - a) * s };
            let Some(known) = known else {
                // all vague pieces in a row
                let mut part = part;
                while let Some(&([_, end], None)) = pieces.get(next) {
                    part[1] = end;
                    next += 1;
                }
                let span = part.map(place);
                if fine || narrow {
                    // a jump as narrow as that has the sign of its ends
                    let ends = [self.sample(span[0])?, self.sample(span[1])?];
                    let known = if !fine && ends[0] * ends[1] > 0.0 {
                        Known::Sign(ends[0] > 0.0)
                    } else {
                        Known::Vague(extreme(&bernstein, part).map(place))
                    };
                    self.pieces.push(Piece { span, known });
                } else if part[1] - part[0] <= 0.5 {
                    let ends = [self.sample(span[0])?, self.sample(span[1])?];
                    self.cover(span, ends, rest)?;
                } else {
                    let middle = 0.5 * (span[0] + span[1]);
                    let [start, half, end] = [self.sample(span[0])?, self.sample(middle)?, self.sample(span[1])?];
                    self.cover([span[0], middle], [start, half], rest)?;
                    self.cover([middle, span[1]], [half, end], rest)?;
                }
                continue;
            };
            self.pieces.push(Piece { span: part.map(place), known });
        }
        Ok(())
    }

    fn sample(&mut self, at: f64) -> Result<f64, NoRoots> {
        self.samples += 1;
        if self.samples > SAMPLES {
            return Err(NoRoots::Unresolved);
        }
        let g = (self.g)(at);
        if g.is_finite() { Ok(g) } else { Err(NoRoots::NotFinite) }
    }

    /// Reads the roots off the pieces.
    fn walk(&mut self, pieces: &[Piece], length: f64, track: &mut Track) -> Vec<Root> {
        let mut roots = Vec::new();
        // the vague piece that the walk is in: where it began, and where it touches 0
        let (mut since, mut touch) = (0.0, track.open.map(|back| -back));
        for &Piece { span: [a, b], known } in pieces {
            let Known::Vague(extreme) = known else {
                let above = known == Known::Sign(true) || known == Known::Passes(false);
                match (track.above, touch) {
                    (Some(before), _) if before != above => {
                        roots.push(Root { at: self.locate([since, a], above), passage: passage(above) });
                    }
                    (Some(_), Some(at)) if !track.rests => roots.push(Root { at, passage: Passage::Touching }),
                    _ => {}
                }
                *track = Track { above: Some(above), open: None, rests: false, scale: track.scale };
                if let Known::Passes(rising) = known {
                    roots.push(Root { at: self.locate([a, b], rising), passage: passage(rising) });
                    track.above = Some(rising);
                }
                (since, touch) = (b, None);
                continue;
            };
            // at the start of the interval it may just be leaving a 0 that was seen before
            let begins = a == 0.0 && track.open.is_none();
            touch = touch.or(extreme).or_else(|| (!begins).then_some(0.5 * (since + b)));
            track.rests |= a == 0.0 && b == length;
            if b == length {
                track.open = touch.map(|at| length - at);
            }
        }
        roots
    }

    /// The root between two points, behind which g is above 0 if it `rises`; by ITP on g.
    fn locate(&mut self, [mut a, mut b]: [f64; 2], rises: bool) -> f64 {
        let sign = if rises { 1.0 } else { -1.0 };
        let (mut ga, mut gb) = (sign * (self.g)(a), sign * (self.g)(b));
        if ga >= 0.0 || gb <= 0.0 {
            // the signs are those of rounding: the root is at one end, as nearly as can be told
            return if ga.abs() < gb.abs() { a } else { b };
        }
        let (slope, least) = (0.2 / (b - a), 0.5 * self.resolution);
        let most = libm::ceil(libm::log2(((b - a) / (2.0 * least)).max(1.0))) + 1.0;
        let mut radius = least * libm::exp2(most);
        for _ in 0..ROUNDS {
            if b - a <= 2.0 * least {
                break;
            }
            // interpolate, truncate, project
            let (middle, secant) = (0.5 * (a + b), (gb * a - ga * b) / (gb - ga));
            let toward = if middle >= secant { 1.0 } else { -1.0 };
            let cut = slope * (b - a) * (b - a);
            let truncated = if cut <= (middle - secant).abs() { secant + toward * cut } else { middle };
            let allowed = (radius - 0.5 * (b - a)).max(0.0);
            let at = if (truncated - middle).abs() <= allowed { truncated } else { middle - toward * allowed };
            let at = if at > a && at < b { at } else { middle };
            let g = sign * (self.g)(at);
            if g > 0.0 {
                (b, gb) = (at, g);
            } else if g < 0.0 {
                (a, ga) = (at, g);
            } else {
                return at;
            }
            radius *= 0.5;
        }
        if -ga < gb { a } else { b }
    }
}

/// Rounds of ITP [-]: one more than bisection to the rounding of any interval takes.
const ROUNDS: u32 = 1100;

fn passage(rises: bool) -> Passage {
    if rises { Passage::Rising } else { Passage::Falling }
}

/// cos(π j/16)
fn cosine(j: usize) -> f64 {
    // cos(π j/16) for j = 0 … 8
    #[rustfmt::skip]
    const COSINES: [f64; 9] = [
        1.0, 0.9807852804032304491, 0.9238795325112867561, 0.8314696123025452371, FRAC_1_SQRT_2,
        0.5555702330196022247, 0.3826834323650897717, 0.1950903220161282678, 0.0,
    ];
    match j % 32 {
        j @ 0..=8 => COSINES[j],
        j @ 9..=16 => -COSINES[16 - j],
        j @ 17..=24 => -COSINES[j - 16],
        j => COSINES[32 - j],
    }
}

/// The polynomial of degree `n` in Bernstein's form, from samples at the 2n + 1 nodes `cos(π j/2n)`, and the sum of
/// the coefficients that it leaves out.
fn fit(samples: &[f64], n: usize) -> ([f64; DEGREE + 1], f64) {
    // Chebyshev's coefficients: c_k = (2/N) Σ″ g_j cos(π j k/N), N = 2n
    let last = 2 * n;
    let stride = 2 * DEGREE / last;
    let coefficient = |k: usize| {
        let inner: f64 = (1..last).map(|j| samples[j] * cosine(stride * (j * k))).sum();
        let ends = 0.5 * (samples[0] + samples[last] * if k.is_multiple_of(2) { 1.0 } else { -1.0 });
        let c = (ends + inner) / n as f64;
        if k == 0 || k == last { 0.5 * c } else { c }
    };
    let rest = (n + 1..=last).map(|k| coefficient(k).abs()).sum();
    let mut bernstein = [0.0; DEGREE + 1];
    for (k, row) in CHEBYSHEV.iter().enumerate().take(n + 1) {
        let c = coefficient(k);
        bernstein.iter_mut().zip(row).for_each(|(b, t)| *b += c * t);
    }
    (bernstein, rest)
}

/// Chebyshev's polynomials `T_k(2s − 1)` in Bernstein's form of degree 8: in that of degree k they are
/// `(−1)^(k−i) C(2k, 2i)/C(k, i)`, and raising the degree takes means of neighbours.
const CHEBYSHEV: [[f64; DEGREE + 1]; DEGREE + 1] = {
    let mut rows = [[0.0; DEGREE + 1]; DEGREE + 1];
    let mut k = 0;
    while k <= DEGREE {
        let mut i = 0;
        while i <= k {
            let sign = if (k - i) % 2 == 0 { 1.0 } else { -1.0 };
            rows[k][i] = sign * binomial(2 * k, 2 * i) / binomial(k, i);
            i += 1;
        }
        let mut degree = k + 1;
        while degree <= DEGREE {
            let mut i = degree;
            while i > 0 {
                let part = i as f64 / degree as f64;
                rows[k][i] = part * rows[k][i - 1] + (1.0 - part) * rows[k][i];
                i -= 1;
            }
            degree += 1;
        }
        k += 1;
    }
    rows
};

const fn binomial(n: usize, k: usize) -> f64 {
    let (mut product, mut i) = (1.0, 0);
    while i < k {
        product = product * (n - i) as f64 / (i + 1) as f64;
        i += 1;
    }
    product
}

/// The sign that all numbers have beyond `error`.
fn sign(numbers: &[f64; DEGREE + 1], error: f64) -> Option<bool> {
    match (numbers.iter().all(|&b| b > error), numbers.iter().all(|&b| b < -error)) {
        (false, false) => None,
        (above, _) => Some(above),
    }
}

/// Cuts a part of 0..1, on which a polynomial has these coefficients, into pieces that are known, or vague (none).
/// A slope below `turn` could be turned by the remainder.
fn isolate(
    b: &[f64; DEGREE + 1],
    part: [f64; 2],
    error: f64,
    turn: f64,
    halvings: u32,
    pieces: &mut Vec<([f64; 2], Option<Known>)>,
) {
    if let Some(above) = sign(b, error) {
        return pieces.push((part, Some(Known::Sign(above))));
    }
    if halvings == 0 || b.iter().all(|b| b.abs() <= 2.0 * error) {
        return pieces.push((part, None));
    }
    let steepness = |pair: &[f64]| DEGREE as f64 * (pair[1] - pair[0]) / (part[1] - part[0]);
    let rises = b.windows(2).all(|pair| steepness(pair) > turn);
    let falls = b.windows(2).all(|pair| steepness(pair) < -turn);
    if (rises || falls) && b[0].abs() > error && b[DEGREE].abs() > error {
        return pieces.push((part, Some(Known::Passes(rises))));
    }

    // de Casteljau at one half
    let (mut left, mut right) = (*b, *b);
    for (level, first) in left.iter_mut().enumerate().skip(1) {
        for i in 0..=DEGREE - level {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
        *first = right[0];
    }
    let middle = 0.5 * (part[0] + part[1]);
    isolate(&left, [part[0], middle], error, turn, halvings - 1, pieces);
    isolate(&right, [middle, part[1]], error, turn, halvings - 1, pieces);
}

/// Where the polynomial has its extreme, in a part of 0..1 or as near to it as the part is wide.
fn extreme(b: &[f64; DEGREE + 1], [start, end]: [f64; 2]) -> Option<f64> {
    let slope = |s: f64| {
        let mut d: [f64; DEGREE] = std::array::from_fn(|i| b[i + 1] - b[i]);
        for level in 1..DEGREE {
            for i in 0..DEGREE - level {
                d[i] = (1.0 - s) * d[i] + s * d[i + 1];
            }
        }
        d[0]
    };
    let reach = end - start;
    let (mut low, mut high) = ((start - reach).max(0.0), (end + reach).min(1.0));
    let rises = slope(low) > 0.0;
    if rises == (slope(high) > 0.0) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if (slope(middle) > 0.0) == rises {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roots_of(mut g: impl FnMut(f64) -> f64, length: f64) -> Vec<Root> {
        find_roots(&mut g, length, 0.0, f64::EPSILON * length, &mut Track::default()).unwrap()
    }

    /// A uniform number in 0..1 (Marsaglia's xorshift, 2003).
    fn random(state: &mut u64) -> f64 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        (*state >> 11) as f64 / (1_u64 << 53) as f64
    }

    #[test]
    fn passages_are_found_to_a_few_ulp() {
        // the roots of sin 3t − 1/2 on 0..6 in closed form
        let found = roots_of(|t| libm::sin(3.0 * t) - 0.5, 6.0);
        let turn = std::f64::consts::TAU / 3.0;
        let first = std::f64::consts::PI / 18.0;
        let exact: Vec<_> =
            (0..3).flat_map(|k| [first + f64::from(k) * turn, 5.0 * first + f64::from(k) * turn]).collect();
        assert_eq!(found.len(), 6);
        for (i, (root, exact)) in found.iter().zip(&exact).enumerate() {
            assert_eq!(root.passage, if i % 2 == 0 { Passage::Rising } else { Passage::Falling });
            // rounding of sin 3t by its slope there: 2 ε 3t/2.6; and the resolution asked for
            assert!((root.at - exact).abs() <= 4.0 * f64::EPSILON * 6.0, "{} {exact}", root.at);
        }
    }

    #[test]
    fn a_touch_is_no_passage_and_a_near_miss_is_nothing() {
        let parabola = |gap: f64| move |t: f64| (t - 0.3) * (t - 0.3) + gap;
        let [touch] = roots_of(parabola(0.0), 1.0)[..] else { panic!() };
        // the derivative of a fit with rounding ε has an error of some 100 ε
        assert!(touch.passage == Passage::Touching && (touch.at - 0.3).abs() < 1e-13, "{touch:?}");
        assert_eq!(roots_of(parabola(1e-13), 1.0), []);
        let [down, up] = roots_of(parabola(-1e-13), 1.0)[..] else { panic!() };
        // half the distance of the roots is the square root of the depth
        assert!((up.at - down.at - 2.0 * 1e-13_f64.sqrt()).abs() < 1e-8);
        assert_eq!([down.passage, up.passage], [Passage::Falling, Passage::Rising]);
    }

    #[test]
    fn every_double_root_of_random_parabolas_is_found_wherever_steps_end() {
        let mut state = 2026;
        for n in 0..20_000 {
            let (at, curve) = (random(&mut state), libm::exp(4.0 * random(&mut state) - 2.0));
            let mut g = |t: f64| curve * (t - at) * (t - at) * (1.0 + 0.2 * libm::sin(3.0 * t));
            // two intervals; in one of four runs the touch is where they meet, in another near it
            let cut = match n % 4 {
                0 => at,
                1 => at + 1e-9 * (random(&mut state) - 0.5),
                _ => 0.5,
            };
            let mut track = Track::default();
            let mut found = find_roots(&mut g, cut, 0.0, f64::EPSILON, &mut track).unwrap();
            let mut later = |t: f64| g(cut + t);
            let second = find_roots(&mut later, 1.0 - cut, 0.0, f64::EPSILON, &mut track).unwrap();
            found.extend(second.into_iter().map(|root| Root { at: cut + root.at, ..root }));
            let [root] = found[..] else { panic!("{n}: at {at}, cut {cut}: {found:?}") };
            assert_eq!(root.passage, Passage::Touching, "{n}");
            // where it touches 0 within rounding: the square root of that by the curve
            assert!((root.at - at).abs() < 1e-7, "{n}: {} {at}", root.at);
        }
    }

    #[test]
    fn roots_where_intervals_meet_are_found_once() {
        let mut g = |t: f64| t - 1.0;
        let mut track = Track::default();
        assert_eq!(find_roots(&mut g, 1.0, 0.0, 1e-16, &mut track).unwrap(), []);
        let found = find_roots(&mut |t| g(1.0 + t), 1.0, 0.0, 1e-16, &mut track).unwrap();
        assert_eq!(found, [Root { at: 0.0, passage: Passage::Rising }]);
        // the start is no event, and a jump between intervals is one
        let mut track = Track::default();
        assert_eq!(find_roots(&mut |t| t, 1.0, 0.0, 1e-16, &mut track).unwrap(), []);
        let found = find_roots(&mut |_| -1.0, 1.0, 0.0, 1e-16, &mut track).unwrap();
        assert_eq!(found, [Root { at: 0.0, passage: Passage::Falling }]);
    }

    #[test]
    fn what_is_not_smooth_ends_too() {
        // a kink that touches, one that does not, a jump over 0, a jump above it
        let [touch] = roots_of(|t| (t - 0.3).abs(), 1.0)[..] else { panic!() };
        assert!(touch.passage == Passage::Touching && (touch.at - 0.3).abs() < 10.0 * NOISE);
        assert_eq!(roots_of(|t| (t - 0.3).abs() + 1e-9, 1.0), []);
        let [jump] = roots_of(|t| if t < 0.3 { -1.0 } else { 2.0 }, 1.0)[..] else { panic!() };
        assert!(jump.passage == Passage::Rising && (jump.at - 0.3).abs() < 1e-15);
        assert_eq!(roots_of(|t| if t < 0.3 { 0.1 } else { 2.0 }, 1.0), []);
        // 0 all the way is no event; noise has no roots that could be told; NaN is named
        assert_eq!(roots_of(|_| 0.0, 1.0), []);
        let mut state = 7;
        let noise = find_roots(&mut |_| random(&mut state) - 0.5, 1.0, 0.0, 1e-16, &mut Track::default());
        assert_eq!(noise, Err(NoRoots::Unresolved));
        let nan = find_roots(&mut |t| libm::sqrt(0.5 - t), 1.0, 0.0, 1e-16, &mut Track::default());
        assert_eq!(nan, Err(NoRoots::NotFinite));
    }

    #[test]
    fn an_interval_without_roots_takes_nine_samples_and_a_touch_not_many_more() {
        let counted = |g: fn(f64) -> f64| {
            let mut calls = 0;
            let found = roots_of(
                |t| {
                    calls += 1;
                    g(t)
                },
                1.0,
            );
            (found.len(), calls)
        };
        assert_eq!(counted(|t| 2.0 + libm::sin(t)), (0, 9));
        // 17 on the whole, 17 nearer to it, and the ends; the more so where its digits are noise
        assert_eq!(counted(|t| 1.0 - libm::cos(3.0 * (t - 0.3))), (1, 36));
        assert_eq!(counted(|t| (1e3 + (t - 0.3) * (t - 0.3)) - 1e3), (1, 36));
    }
}
