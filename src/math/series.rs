//! Power series of a motion in time, found by recurrences (automatic differentiation; Moore 1966, Interval
//! Analysis; Jorba, Zou 2005, Exp. Math. 14:99).
//!
//! ```text
//! a(t + s) = Σ a_k s^k        (a b)_k = Σ_j a_j b_{k−j}        a′ = b:  a_{k+1} = b_k/(k + 1)
//! ```
//!
//! A [`Tape`] is a list of such recurrences between vectors, written once. Played order by order from the numbers of
//! a moment, it gives their series to any order, without differences and without allocating: order N costs some N²
//! products, so that doubling the digits of a step costs four times as much and makes it longer.

use std::iter::zip;

use crate::math::{Matrix3, Quaternion, Vector3, quaternion};

/// A vector on the tape; a number is one whose components are all that number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Node(usize);

/// A vector `(x, y, z)`, held as its two cyclic turns `(y, z, x)` and `(z, x, y)`: what cross products need, in one line
/// of the cache.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
struct Term([f64; 8]);

impl Term {
    #[inline(always)]
    fn new(x: f64, y: f64, z: f64) -> Self {
        Self([y, z, x, 0.0, z, x, y, 0.0])
    }

    /// The vector again.
    #[inline(always)]
    fn vector(&self) -> [f64; 3] {
        [self.0[2], self.0[0], self.0[1]]
    }
}

/// How the terms of a vector follow from those of others.
#[derive(Debug, Clone, Copy)]
enum Rule {
    /// `M a`
    Linear(usize, Matrix3),
    /// `d ∘ a`, component by component.
    Scaled(usize, Vector3),
    /// `α a + β b`
    Sum([f64; 2], [usize; 2]),
    /// `a b`, component by component.
    Product(usize, usize),
    /// `a·b`, as a number.
    Dot(usize, usize),
    /// `a × b`
    Cross(usize, usize),
    /// `a × (d ∘ a)`: products of different components of a only.
    Gyration(usize, Vector3),
    /// `a^α` of a number.
    Power(usize, f64),
    /// One of the vectors carried along by a body.
    Carried(usize),
}

/// A quaternion that turns with an angular velocity in its own axes, `q′ = ½ q [0, ω]`.
#[derive(Debug)]
struct Turning {
    /// Where it stands among the numbers.
    at: usize,
    rate: usize,
    /// Every term, and what ω₁, ω₂ and ω₃ multiply in it: `(−x, w, z, −y)`, `(−y, −z, w, x)`, `(−z, y, −x, w)`.
    terms: Vec<[[f64; 4]; 4]>,
}

/// A vector of a body's own axes, seen from the world: `q [0, v] q̄/|q|²`.
#[derive(Debug)]
struct Carried {
    turning: usize,
    v: usize,
    /// Its value, where it does not change.
    constant: Option<Vector3>,
    /// `q [0, v]`
    half: Vec<[f64; 4]>,
}

/// What body axes follow from.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Attitude {
    /// A quaternion among the numbers, from there on; its length does not matter.
    Quaternion(usize),
    /// An angle among the numbers, about a unit axis of the world, from a rotation at angle 0.
    Angle(usize, Vector3, Matrix3),
}

/// Where the series of a vector begins.
#[derive(Debug, Clone, Copy)]
enum Start {
    /// With so many of the numbers, from a place on; the other components are 0.
    Numbers(usize, usize),
    /// With one of the numbers, as a number.
    Number(usize),
    /// With a vector of the world seen from a body.
    Seen(Vector3, Attitude),
    /// With `(sin, cos, 0)` of `w t + φ`.
    Wave(f64, f64),
}

/// A list of recurrences.
#[derive(Debug)]
pub struct Tape {
    order: usize,
    /// The terms of every vector, order by order: `order + 1` places each.
    terms: Vec<Term>,
    /// The value of vectors that do not change.
    constants: Vec<Option<Vector3>>,
    rules: Vec<(usize, Rule)>,
    /// Vectors and their rates.
    integrals: Vec<(usize, usize)>,
    turnings: Vec<Turning>,
    carried: Vec<Carried>,
    starts: Vec<(usize, Start)>,
}

/// Writing.
impl Tape {
    /// An empty tape for series to this order.
    pub(crate) fn new(order: usize) -> Self {
        Self {
            order,
            terms: Vec::new(),
            constants: Vec::new(),
            rules: Vec::new(),
            integrals: Vec::new(),
            turnings: Vec::new(),
            carried: Vec::new(),
            starts: Vec::new(),
        }
    }

    fn node(&mut self, constant: Option<Vector3>) -> usize {
        self.terms.resize(self.terms.len() + self.order + 1, Term::new(0.0, 0.0, 0.0));
        self.constants.push(constant);
        self.constants.len() - 1
    }

    fn rule(&mut self, rule: Rule) -> Node {
        let node = self.node(None);
        self.rules.push((node, rule));
        Node(node)
    }

    fn start(&mut self, start: Start) -> Node {
        let node = self.node(None);
        self.starts.push((node, start));
        Node(node)
    }

    /// The value of a vector that does not change.
    pub(crate) fn value(&self, node: Node) -> Option<Vector3> {
        self.constants[node.0]
    }

    /// A vector that does not change.
    pub(crate) fn constant(&mut self, v: Vector3) -> Node {
        let node = self.node(Some(v));
        self.terms[node * (self.order + 1)] = Term::new(v.x, v.y, v.z);
        Node(node)
    }

    /// `n` of the numbers from `at` on, as a vector whose rate is still to be said.
    pub(crate) fn numbers(&mut self, at: usize, n: usize) -> Node {
        self.start(Start::Numbers(at, n))
    }

    /// The number at `at`, whose rate is still to be said.
    pub(crate) fn number(&mut self, at: usize) -> Node {
        self.start(Start::Number(at))
    }

    /// The quaternion at `at`, which turns with `rate` in its own axes.
    pub(crate) fn turning(&mut self, at: usize, rate: Node) {
        self.turnings.push(Turning { at, rate: rate.0, terms: vec![[[0.0; 4]; 4]; self.order + 1] });
    }

    /// A vector of the world seen from a body of this attitude that turns with `rate`: `a′ = a × ω`.
    pub(crate) fn seen(&mut self, v: Vector3, attitude: Attitude, rate: Node) -> Node {
        let node = self.start(Start::Seen(v, attitude));
        let turned = self.cross(node, rate);
        self.integrate(node, turned);
        node
    }

    /// A vector in the own axes of a body with a quaternion at `at`, seen from the world; none if no quaternion is there.
    pub(crate) fn carried(&mut self, v: Node, at: usize) -> Option<Node> {
        let turning = self.turnings.iter().position(|turning| turning.at == at)?;
        let half = vec![[0.0; 4]; self.order + 1];
        self.carried.push(Carried { turning, v: v.0, constant: self.value(v), half });
        Some(self.rule(Rule::Carried(self.carried.len() - 1)))
    }

    /// `sin(w t + φ)`
    pub(crate) fn wave(&mut self, w: f64, phase: f64) -> Node {
        let both = self.start(Start::Wave(w, phase));
        let rate = self.linear(both, Matrix3::new(0.0, w, 0.0, -w, 0.0, 0.0, 0.0, 0.0, 0.0));
        self.integrate(both, rate);
        self.component(both, 0)
    }

    /// Says how a vector changes.
    pub(crate) fn integrate(&mut self, node: Node, rate: Node) {
        self.integrals.push((node.0, rate.0));
    }

    /// `M a`
    pub(crate) fn linear(&mut self, a: Node, m: Matrix3) -> Node {
        match self.value(a) {
            Some(v) => self.constant(m * v),
            None => self.rule(Rule::Linear(a.0, m)),
        }
    }

    /// `d ∘ a`, component by component.
    pub(crate) fn stretched(&mut self, a: Node, d: Vector3) -> Node {
        match self.value(a) {
            Some(v) => self.constant(d.component_mul(&v)),
            None => self.rule(Rule::Scaled(a.0, d)),
        }
    }

    /// `α a`
    pub(crate) fn scaled(&mut self, alpha: f64, a: Node) -> Node {
        self.stretched(a, Vector3::repeat(alpha))
    }

    /// One of the components as a number.
    pub(crate) fn component(&mut self, a: Node, i: usize) -> Node {
        let mut m = Matrix3::zeros();
        m.set_column(i, &Vector3::repeat(1.0));
        self.linear(a, m)
    }

    /// A number along a vector that does not change, `v s`.
    pub(crate) fn along(&mut self, v: &Vector3, s: Node) -> Node {
        self.stretched(s, *v)
    }

    /// `a + β b`
    pub(crate) fn sum(&mut self, a: Node, beta: f64, b: Node) -> Node {
        match (self.value(a), self.value(b)) {
            (Some(v), Some(w)) => self.constant(v + beta * w),
            _ => self.rule(Rule::Sum([1.0, beta], [a.0, b.0])),
        }
    }

    /// `s a` of a number and a vector, or of two vectors component by component.
    pub(crate) fn product(&mut self, s: Node, a: Node) -> Node {
        match (self.value(s), self.value(a)) {
            (Some(v), _) => self.stretched(a, v),
            (_, Some(v)) => self.stretched(s, v),
            _ => self.rule(Rule::Product(s.0, a.0)),
        }
    }

    /// `a·b`
    pub(crate) fn dot(&mut self, a: Node, b: Node) -> Node {
        let along = |v: Vector3| Matrix3::from_rows(&[v.transpose(); 3]);
        match (self.value(a), self.value(b)) {
            (Some(v), _) => self.linear(b, along(v)),
            (_, Some(v)) => self.linear(a, along(v)),
            _ => self.rule(Rule::Dot(a.0, b.0)),
        }
    }

    /// `a × b`
    pub(crate) fn cross(&mut self, a: Node, b: Node) -> Node {
        match (self.value(a), self.value(b)) {
            (Some(v), _) => self.linear(b, v.cross_matrix()),
            (_, Some(v)) => self.linear(a, -v.cross_matrix()),
            _ => self.rule(Rule::Cross(a.0, b.0)),
        }
    }

    /// `a × (d ∘ a)`
    pub(crate) fn gyration(&mut self, a: Node, d: Vector3) -> Node {
        self.rule(Rule::Gyration(a.0, Vector3::new(d.z - d.y, d.x - d.z, d.y - d.x)))
    }

    /// `a^α` of a number that is positive.
    pub(crate) fn power(&mut self, a: Node, alpha: f64) -> Node {
        self.rule(Rule::Power(a.0, alpha))
    }
}

/// Playing.
impl Tape {
    /// Finds the series of all numbers from their values `y` at the time `t` [s].
    pub(crate) fn play(&mut self, t: f64, y: &[f64]) {
        let stride = self.order + 1;
        for &(node, start) in &self.starts {
            self.terms[node * stride] = start.at(t, y);
        }
        for turning in &mut self.turnings {
            let at = turning.at;
            turning.terms[0] = with_turns([y[at], y[at + 1], y[at + 2], y[at + 3]]);
        }
        for k in 0..self.order {
            for (node, rule) in &self.rules {
                self.terms[node * stride + k] = match *rule {
                    Rule::Carried(i) => self.carried[i].term(&self.turnings, &self.terms, stride, k),
                    _ => rule.term(&self.terms, stride, (*node, k)),
                };
            }
            let part = 1.0 / (k + 1) as f64;
            for &(node, rate) in &self.integrals {
                let rate = self.terms[rate * stride + k].0;
                self.terms[node * stride + k + 1] = Term(rate.map(|x| part * x));
            }
            for turning in &mut self.turnings {
                let rates = &self.terms[turning.rate * stride..][..=k];
                turning.terms[k + 1] = with_turns(turned(&turning.terms[..=k], rates).map(|x| 0.5 * part * x));
            }
        }
    }

    /// The change of all numbers in a time `h`: `h (c₁ + h (c₂ + …))`.
    pub(crate) fn change(&self, h: f64, dy: &mut [f64]) {
        for &(node, start) in &self.starts {
            let terms = &self.terms[node * (self.order + 1)..][1..=self.order];
            let sum = |sum: [f64; 4], Term(c): &Term| std::array::from_fn(|i| h * (sum[i] + c[i]));
            start.put(&terms.iter().rev().fold([0.0; 4], sum), dy);
        }
        for turning in &self.turnings {
            let sum = |sum: [f64; 4], c: &[[f64; 4]; 4]| std::array::from_fn(|i| h * (sum[i] + c[0][i]));
            let sum: [f64; 4] = turning.terms[1..].iter().rev().fold([0.0; 4], sum);
            dy[turning.at..turning.at + 4].copy_from_slice(&sum);
        }
    }

    /// Writes the terms of order `k` of all numbers.
    pub(crate) fn read(&self, k: usize, terms: &mut [f64]) {
        for &(node, start) in &self.starts {
            let [y, z, x, ..] = self.terms[node * (self.order + 1) + k].0;
            start.put(&[y, z, x, 0.0], terms);
        }
        for turning in &self.turnings {
            terms[turning.at..turning.at + 4].copy_from_slice(&turning.terms[k][0]);
        }
    }
}

impl Start {
    /// Writes the vector `[y, z, x]` to the numbers that it begins with, if it does.
    fn put(&self, [y, z, x, _]: &[f64; 4], numbers: &mut [f64]) {
        match *self {
            Self::Numbers(at, n) => numbers[at..at + n].copy_from_slice(&[*x, *y, *z][..n]),
            Self::Number(at) => numbers[at] = *x,
            Self::Seen(..) | Self::Wave(..) => {}
        }
    }

    fn at(&self, t: f64, y: &[f64]) -> Term {
        match *self {
            Self::Numbers(at, n) => {
                let part = |i: usize| if i < n { y[at + i] } else { 0.0 };
                Term::new(part(0), part(1), part(2))
            }
            Self::Number(at) => Term::new(y[at], y[at], y[at]),
            Self::Seen(v, attitude) => {
                let v = attitude.see(y, &v);
                Term::new(v.x, v.y, v.z)
            }
            Self::Wave(w, phase) => {
                let (sin, cos) = libm::sincos(w * t + phase);
                Term::new(sin, cos, 0.0)
            }
        }
    }
}

impl Attitude {
    /// A vector of the world, seen from the body.
    fn see(&self, y: &[f64], v: &Vector3) -> Vector3 {
        match *self {
            Self::Quaternion(at) => {
                let (scaled, n) =
                    quaternion::to_scaled_matrix(&Quaternion::new(y[at], y[at + 1], y[at + 2], y[at + 3]));
                scaled.tr_mul(v) / n
            }
            Self::Angle(at, axis, start) => {
                let turn = quaternion::from_axis_angle(&axis, -y[at]);
                start.tr_mul(&quaternion::rotate(&turn, v))
            }
        }
    }
}

impl Rule {
    /// The term of order `k`.
    #[inline(always)]
    fn term(&self, terms: &[Term], stride: usize, (own, k): (usize, usize)) -> Term {
        let series = |node: usize| &terms[node * stride..][..=k];
        match *self {
            Self::Linear(a, ref m) => {
                let [x, y, z] = terms[a * stride + k].vector();
                let row = |i: usize| m[(i, 0)] * x + m[(i, 1)] * y + m[(i, 2)] * z;
                Term::new(row(0), row(1), row(2))
            }
            Self::Scaled(a, ref d) => {
                let [x, y, z] = terms[a * stride + k].vector();
                Term::new(d.x * x, d.y * y, d.z * z)
            }
            Self::Sum([alpha, beta], [a, b]) => {
                let (a, b) = (&terms[a * stride + k].0, &terms[b * stride + k].0);
                Term(std::array::from_fn(|i| alpha * a[i] + beta * b[i]))
            }
            Self::Product(a, b) => {
                let [y, z, x, _] = products(series(a), series(b));
                Term::new(x, y, z)
            }
            Self::Dot(a, b) => {
                let [y, z, x, _] = products(series(a), series(b));
                let dot = x + y + z;
                Term::new(dot, dot, dot)
            }
            Self::Cross(a, b) => {
                let [x, y, z, _] =
                    convolved(series(a), series(b), |Term(a), Term(b), i| a[i] * b[i + 4] - a[i + 4] * b[i]);
                Term::new(x, y, z)
            }
            Self::Gyration(a, ref d) => {
                let [x, y, z, _]: [f64; 4] = convolved(series(a), series(a), |Term(a), Term(b), i| a[i] * b[i + 4]);
                Term::new(d.x * x, d.y * y, d.z * z)
            }
            Self::Power(a, alpha) => {
                let (base, power) = (series(a), series(own));
                if k == 0 {
                    let start = libm::pow(base[0].0[0], alpha);
                    return Term::new(start, start, start);
                }
                // p = aᵅ:  a p′ = α a′ p
                let mut sum = 0.0;
                for j in 1..=k {
                    sum += (alpha * j as f64 - (k - j) as f64) * (base[j].0[0] * power[k - j].0[0]);
                }
                let next = sum / (k as f64 * base[0].0[0]);
                Term::new(next, next, next)
            }
            Self::Carried(_) => unreachable!("found apart"),
        }
    }
}

impl Carried {
    /// The term of order `k`.
    #[inline(always)]
    fn term(&mut self, turnings: &[Turning], terms: &[Term], stride: usize, k: usize) -> Term {
        let q = &turnings[self.turning].terms[..=k];
        self.half[k] = match &self.constant {
            Some(v) => std::array::from_fn(|i| (q[k][1][i] * v.x + q[k][2][i] * v.y) + q[k][3][i] * v.z),
            None => turned(q, &terms[self.v * stride..][..=k]),
        };

        // times q̄, of which only the vector is wanted, with the signs put in at the end
        let s: [f64; 12] = convolved(q, &self.half[..=k], |q, half, i| q[1 + i / 4][i % 4] * half[i % 4]);
        let [w, x, y, z] = q[0][0];
        let part = 1.0 / ((w * w + x * x) + (y * y + z * z));
        Term::new(
            part * ((s[0] + s[1]) - (s[2] + s[3])),
            part * ((s[4] - s[5]) + (s[6] - s[7])),
            part * ((s[8] - s[9]) - (s[10] - s[11])),
        )
    }
}

/// `Σ_j f(a_j, b_{k−j})`, where both end at the order k. The terms found last come last, so that the others are summed
/// while these are still on their way.
#[inline(always)]
fn convolved<A, B, const N: usize>(a: &[A], b: &[B], f: impl Fn(&A, &B, usize) -> f64) -> [f64; N] {
    let mut sum = [0.0; N];
    let ([a0, a @ ..], [b0, b @ ..]) = (a, b) else { return sum };
    let ([a @ .., ak], [b @ .., bk]) = (a, b) else { return std::array::from_fn(|i| f(a0, b0, i)) };
    for (a, b) in zip(a, b.iter().rev()) {
        for (i, sum) in sum.iter_mut().enumerate() {
            *sum += f(a, b, i);
        }
    }
    for (i, sum) in sum.iter_mut().enumerate() {
        *sum += f(a0, bk, i) + f(ak, b0, i);
    }
    sum
}

/// The products of two vectors component by component, in the order y, z, x.
#[inline(always)]
fn products(a: &[Term], b: &[Term]) -> [f64; 4] {
    convolved(a, b, |Term(a), Term(b), i| a[i] * b[i])
}

/// A quaternion, and what the components of an angular velocity multiply in `q [0, ω]`.
#[inline(always)]
fn with_turns([w, x, y, z]: [f64; 4]) -> [[f64; 4]; 4] {
    [[w, x, y, z], [-x, w, z, -y], [-y, -z, w, x], [-z, y, -x, w]]
}

/// `(q [0, ω])_k`
#[inline(always)]
fn turned(q: &[[[f64; 4]; 4]], rates: &[Term]) -> [f64; 4] {
    convolved(q, rates, |[_, a, b, c], Term(w), i| (a[i] * w[2] + b[i] * w[0]) + c[i] * w[1])
}
