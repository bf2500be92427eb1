//! Methods that advance Y′ = f(t, Y): one method, one file, one line in the list below.
//!
//! A method sees a [`Problem`], never bodies or effects. It takes steps, of a given length or as long
//! as an allowed error permits ([`Control`]). Where someone looks between the ends of a step, it
//! writes a [`Segment`]: a polynomial in time that **is** the motion there. Samples, events and
//! contacts all read that same polynomial.
//!
//! ```text
//! Problem ──method──▶ Segment, Segment, …     held by a Flight, which answers at(t)
//! ```

use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;

use crate::error::{Error, Result};
use crate::freedom::{Form, RotationSplit, Scales};
use crate::math::series::Tape;
use crate::math::sum::{Time, two_sum};
use crate::state::{BodyMotion, Moment};

mod axes2;
mod buss2;
mod cf4;
pub(crate) mod dmv;
mod dop853;
mod euler;
pub(crate) mod exact;
mod flight;
pub mod free_rotation;
mod heun;
mod radau5;
mod rk4;
mod segment;
mod semi_implicit_euler;
mod split2;
mod split4;
mod split6;
mod split8;
mod splitting;
mod stepper;
pub(crate) mod taylor;
mod tsit5;

pub use exact::{ClosedFlight, ClosedMotion};
pub use flight::{Counts, Flight, FlightError, Integration};
pub use segment::{Curve, Segment};

/// The numbers that are integrated. A fixed length lets the compiler unroll the step of a single
/// body; groups of bodies use a `Vec`.
pub trait StateVector: Clone + Debug + Send + AsRef<[f64]> + AsMut<[f64]> {
    /// `n` zeros.
    fn zeros(n: usize) -> Self;

    /// A vector of this length to work in, of any content: a `Vec` is taken from here, an array is new, so
    /// that the compiler can hold it in registers.
    #[must_use]
    fn lend(&mut self) -> Self;

    /// Takes back what was lent.
    fn take_back(&mut self, lent: Self);

    /// The numbers themselves, to work on until they are put back by an assignment: a `Vec` leaves an empty one, an
    /// array is copied, so that the compiler can hold it in registers.
    #[must_use]
    fn take(&mut self) -> Self;

    /// The numbers that change; the rate of the others is 0, and stands so in every vector of rates.
    #[inline(always)]
    fn moving(&self) -> [Range<usize>; 2] {
        [0..self.as_ref().len(), 0..0]
    }

    /// Takes over from `y` the numbers that do not change.
    #[inline(always)]
    fn set_steady(&mut self, _y: &Self) {}

    /// `self += a · k`
    #[inline]
    fn add_scaled(&mut self, a: f64, k: &Self) {
        for moving in self.moving() {
            for (y, k) in self.as_mut()[moving.clone()].iter_mut().zip(&k.as_ref()[moving]) {
                *y += a * k;
            }
        }
    }

    /// `self = y + a · k`
    #[inline(always)]
    fn set_sum(&mut self, y: &Self, a: f64, k: &Self) {
        self.set_steady(y);
        for moving in self.moving() {
            let terms = y.as_ref()[moving.clone()].iter().zip(&k.as_ref()[moving.clone()]);
            for (s, (y, k)) in self.as_mut()[moving].iter_mut().zip(terms) {
                *s = y + a * k;
            }
        }
    }

    /// `self = y + h Σ a_j k_j`
    #[inline(always)]
    fn set_combination<const N: usize>(&mut self, y: &Self, h: f64, terms: [(f64, &Self); N]) {
        let terms = terms.map(|(a, k)| (a, k.as_ref()));
        self.set_steady(y);
        for moving in self.moving() {
            for i in moving {
                let mut sum = terms[0].0 * terms[0].1[i];
                for (a, k) in &terms[1..] {
                    sum += a * k[i];
                }
                self.as_mut()[i] = y.as_ref()[i] + h * sum;
            }
        }
    }

    /// `self = h Σ a_j k_j`
    #[inline(always)]
    fn set_increment<const N: usize>(&mut self, h: f64, terms: [(f64, &Self); N]) {
        let terms = terms.map(|(a, k)| (a, k.as_ref()));
        for moving in self.moving() {
            for i in moving {
                let mut sum = terms[0].0 * terms[0].1[i];
                for (a, k) in &terms[1..] {
                    sum += a * k[i];
                }
                self.as_mut()[i] = h * sum;
            }
        }
    }

    /// Whether every number is finite. Their sum is, unless one is not, or the sum alone is too large; it is taken in
    /// two halves, which do not wait for each other.
    #[inline(always)]
    fn is_finite(&self) -> bool {
        let mut sums = [0.0; 2];
        let pairs = self.as_ref().chunks_exact(2);
        let last = pairs.remainder().first().copied().unwrap_or(0.0);
        pairs.for_each(|pair| (sums[0], sums[1]) = (sums[0] + pair[0], sums[1] + pair[1]));
        (sums[0] + sums[1] + last).is_finite() || self.as_ref().iter().all(|x| x.is_finite())
    }

    /// `self += dy`, where `rest` takes up what rounding drops and hands it to the next sum.
    #[inline(always)]
    fn add_compensated(&mut self, dy: &Self, rest: &mut Self) {
        for moving in self.moving() {
            let changes = dy.as_ref()[moving.clone()].iter().zip(&mut rest.as_mut()[moving.clone()]);
            for (y, (dy, rest)) in self.as_mut()[moving].iter_mut().zip(changes) {
                (*y, *rest) = two_sum(*y, dy + *rest);
            }
        }
    }
}

impl<const N: usize> StateVector for [f64; N] {
    fn zeros(n: usize) -> Self {
        debug_assert_eq!(n, N);
        [0.0; N]
    }

    #[inline(always)]
    fn lend(&mut self) -> Self {
        [0.0; N]
    }

    #[inline(always)]
    fn take_back(&mut self, _lent: Self) {}

    #[inline(always)]
    fn take(&mut self) -> Self {
        *self
    }
}

impl StateVector for Vec<f64> {
    fn zeros(n: usize) -> Self {
        vec![0.0; n]
    }

    fn lend(&mut self) -> Self {
        std::mem::take(self)
    }

    fn take_back(&mut self, lent: Self) {
        *self = lent;
    }

    fn take(&mut self) -> Self {
        std::mem::take(self)
    }
}

/// A differential equation Y′ = f(t, Y), and what a method may know about it beyond f.
pub trait Problem: Debug + Send {
    /// The numbers that are integrated.
    type Y: StateVector;

    /// Whether methods that integrate the angular momentum in world axes are used on it.
    const WORLD_AXES: bool = true;

    /// The same of methods in body axes.
    const BODY_AXES: bool = true;

    /// Whether only methods of [short steps](Method::has_short_steps) are used on it.
    const SHORT_STEPS: bool = false;

    /// How many numbers they are.
    fn dimension(&self) -> usize;

    /// How many bodies move.
    fn bodies(&self) -> usize;

    /// `dy = f(t, y)`
    fn rate(&mut self, at: Moment, y: &Self::Y, dy: &mut Self::Y);

    /// The part of f that is left when all loads are 0; `f − drift` is the kick of a splitting.
    fn drift(&mut self, y: &Self::Y, dy: &mut Self::Y);

    /// Whether anything acts on the bodies; else [`rate`](Self::rate) is [`drift`](Self::drift).
    fn is_loaded(&self) -> bool;

    /// Whether a load depends on velocities.
    fn depends_on_velocity(&self) -> bool;

    /// Advances the motion without loads by `h`, exactly or by a symmetric second-order split of the
    /// rotation; |L| is kept to rounding, of which `rest` takes up what is dropped.
    fn flow(&mut self, y: &mut Self::Y, rest: &mut Self::Y, h: f64, split: RotationSplit);

    /// Turns the rates of orientations in `k = f(t, y)` into angular velocities, in the axes of the
    /// form, the first three numbers of an orientation's place; the other numbers stay.
    fn to_generator(&self, y: &Self::Y, k: &mut Self::Y);

    /// `exp(h v)` on `y`: orientations turn by the angular velocities in `v`, other numbers move by `h v`.
    fn act(&self, y: &mut Self::Y, h: f64, v: &Self::Y);

    /// `a += c (a × b)` on the angular velocities in two generators.
    fn add_bracket(&self, c: f64, a: &mut Self::Y, b: &Self::Y);

    /// Amends a change `dy` of `y`, of which rounding left `rest`, so that orientations do not leave
    /// their sphere (lecture §4): what the steps before have strayed is taken away; returns how far that was [-].
    fn project(&mut self, y: &Self::Y, rest: &Self::Y, dy: &mut Self::Y) -> f64;

    /// How far the worst orientation is off its sphere, as it stands [-].
    fn orientation_error(&self, y: &Self::Y) -> f64;

    /// Size of an error `e` of a step from `y0` to `y1` [-]: positions over a length, orientations in
    /// radians, momenta over their own size; the largest of all bodies.
    fn error_size(&self, y0: &Self::Y, y1: &Self::Y, e: &Self::Y, scales: &Scales) -> f64;

    /// The motion of every body, read from the numbers.
    fn decode(&self, y: &[f64], motions: &mut [BodyMotion]);

    /// Leaves out the effects at these places of the scene, and no others; whether that is a change.
    fn leave_out(&mut self, effects: &[usize]) -> bool;

    /// The recurrences of the motion's series to this order, as loads are from the moment on.
    fn tape(&self, at: Moment, order: usize) -> Tape;

    /// What a user's function complained about, once.
    fn take_failure(&mut self) -> Option<String>;
}

/// What decides the length of a step.
#[derive(Debug, Clone, PartialEq)]
pub enum Control {
    /// Every step is this long [s].
    Step(f64),
    /// Every step is as long as its error allows.
    Error(Limits),
    /// Steps as another run took them, cut into pieces.
    Mesh(Mesh),
}

/// The steps of another run.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// The start and the end of every step, rising [s].
    pub nodes: Arc<[f64]>,
    /// How many steps each of them becomes.
    pub pieces: u32,
}

impl Mesh {
    /// Where a step from `t` [s] ends: at the next node, or the next cut between two; after all, as far on as they
    /// were apart last.
    fn end_after(&self, t: f64) -> f64 {
        let next = self.nodes.partition_point(|&node| node <= t);
        if let ([.., a, b], true) = (&*self.nodes, next == self.nodes.len()) {
            return t + (b - a) / f64::from(self.pieces);
        }
        let (Some(&b), true) = (self.nodes.get(next), next > 0) else { return f64::INFINITY };
        let (a, pieces) = (self.nodes[next - 1], f64::from(self.pieces));
        let cut = |j: f64| if j < pieces { a + (b - a) * (j / pieces) } else { b };

        // the first cut after t; rounding may have put one on t itself
        let j = libm::floor((t - a) / (b - a) * pieces);
        [j, j + 1.0, j + 2.0].into_iter().map(cut).find(|&end| end > t).unwrap_or(b)
    }
}

/// How much error a step may make.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest error of a step [-].
    pub local: f64,
    /// What it is measured by.
    pub scales: Scales,
    /// Longest step [s].
    pub longest: f64,
}

/// Where an integration stands.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Front<Y> {
    /// The instant, with its rounding error kept.
    pub time: Time,
    /// Start of the interval without switches [s].
    pub since: f64,
    /// The numbers there.
    pub y: Y,
    /// What rounding dropped of them.
    pub rest: Y,
}

impl<Y> Front<Y> {
    /// The moment of the front.
    pub fn moment(&self) -> Moment {
        Moment { time: self.time.value, since: self.since }
    }
}

/// Advances a problem, a step at a call.
pub trait Integrator<P: Problem>: Debug + Send {
    /// Takes a step, and more while the front is before `to` [s]; none passes `limit` [s].
    ///
    /// # Errors
    /// No step is short enough for the error allowed, or the state is not finite any more.
    fn advance(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        span: (f64, f64),
        counts: &mut Counts,
    ) -> Result<(), FlightError>;

    /// Where the last step began.
    fn last_start(&self) -> Time;

    /// Writes the motion within the last step, which ended at `front`.
    fn interpolate(&mut self, problem: &mut P, front: &Front<P::Y>, segment: &mut Segment, counts: &mut Counts);

    /// Forgets what it knew of the path: the front has jumped.
    fn restart(&mut self);
}

/// Declares the methods: one line adds a variant, its name, its facts and its step.
macro_rules! methods {
    ($($(#[$doc:meta])* $variant:ident => $module:ident,)*) => {
        /// A method of integration.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        pub enum Method {
            $($(#[$doc])* $variant,)*
            /// The power series of the motion, of any order, with error control; loads that are series too.
            Taylor,
            /// The preprocessed discrete Moser–Veselov method, order 4 to 10: keeps |L| and energy where no torque acts.
            Dmv,
            /// The closed form, where there is one: no torque and no force but gravity and linear drag.
            Exact,
        }

        impl Method {
            /// Every method, in the order of the list.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)* Self::Taylor, Self::Dmv, Self::Exact];

            /// The name that files, reports and Python use.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($module),)*
                    Self::Taylor => "taylor",
                    Self::Dmv => "dmv",
                    Self::Exact => "exact",
                }
            }

            /// Order of accuracy: halving the step divides the error by two to this power; 0 for the
            /// closed form, which has no step, and for power series and `Dmv` that where none is asked for.
            pub fn order(self) -> u32 {
                match self {
                    $(Self::$variant => $module::ORDER,)*
                    Self::Taylor => taylor::ORDER,
                    Self::Dmv => dmv::ORDER,
                    Self::Exact => exact::ORDER,
                }
            }

            /// Evaluations of f in one step; of the implicit method in one iteration; a power series is one.
            pub fn evaluations(self) -> u32 {
                match self {
                    $(Self::$variant => $module::EVALUATIONS,)*
                    Self::Taylor => taylor::EVALUATIONS,
                    Self::Dmv => dmv::EVALUATIONS,
                    Self::Exact => 0,
                }
            }

            /// Whether it keeps its order only under loads that do not depend on velocities.
            pub fn needs_positional_loads(self) -> bool {
                matches!(self, Self::Split6 | Self::Split8)
            }

            /// Whether it integrates the angular momentum in body axes; else in the lecture's world axes.
            pub fn in_body_axes(self) -> bool {
                match self {
                    $(Self::$variant => $module::BODY_AXES,)*
                    Self::Taylor => taylor::BODY_AXES,
                    Self::Dmv => dmv::BODY_AXES,
                    Self::Exact => false,
                }
            }

            /// Whether its steps are so short that a call shows in them: at most four evaluations of f, at
            /// lengths that are given.
            pub fn has_short_steps(self) -> bool {
                match self {
                    $(Self::$variant => $module::EVALUATIONS <= 4 && $module::ERROR_ORDER == 0.0,)*
                    Self::Taylor | Self::Dmv | Self::Exact => false,
                }
            }

            /// Whether it estimates the error of a step, so that [`Control::Error`] can choose the length,
            /// or makes none.
            pub fn controls_error(self) -> bool {
                match self {
                    $(Self::$variant => $module::ERROR_ORDER > 0.0,)*
                    Self::Dmv => false,
                    Self::Taylor | Self::Exact => true,
                }
            }

            /// The method on a problem; none for the closed form and for power series, which are made apart, and
            /// none for methods that the problem is not written for.
            pub fn integrator<P: Problem + 'static>(
                self,
                problem: &P,
                control: Control,
                projection: bool,
            ) -> Option<Box<dyn Integrator<P>>> {
                let n = problem.dimension();
                match self {
                    $(Self::$variant
                        if (if $module::BODY_AXES { P::BODY_AXES } else { P::WORLD_AXES })
                            && (!P::SHORT_STEPS || $module::EVALUATIONS <= 4 && $module::ERROR_ORDER == 0.0) =>
                    {
                        Some(Box::new(stepper::Stepper::<P, $module::Kernel<P::Y>>::new(n, control, projection)))
                    })*
                    _ => None,
                }
            }
        }
    };
}

methods! {
    /// Euler's method, order 1: the lecture's first step, and its warning.
    Euler => euler,
    /// Heun's method, order 2.
    Heun => heun,
    /// Semi-implicit Euler, order 1: the new velocity moves the body (lecture §6).
    SemiImplicitEuler => semi_implicit_euler,
    /// The classical Runge–Kutta method, order 4, with the angular momentum in body axes.
    Rk4 => rk4,
    /// Tsitouras' method, order 5, with error control.
    Tsit5 => tsit5,
    /// Dormand's and Prince's method, order 8, with error control.
    Dop853 => dop853,
    /// Symmetric top and rest, order 2: keeps |L|, and the energy within bounds.
    Split2 => split2,
    /// The same composed to order 4.
    Split4 => split4,
    /// The same composed to order 6.
    Split6 => split6,
    /// The same composed to order 8.
    Split8 => split8,
    /// Rotations about the three axes, order 2: the simplest splitting.
    Axes2 => axes2,
    /// Commutator-free Lie-group method, order 4, on the lecture's q and L.
    Cf4 => cf4,
    /// Buss's augmented method, order 2, as games use it.
    Buss2 => buss2,
    /// Radau IIA, order 5, with error control: implicit, for stiff loads such as strong drag.
    Radau5 => radau5,
}

/// The methods whose order can be asked for, on a problem: their work does not grow less where its kind is known.
pub(crate) fn of_order<P: Problem + 'static>(
    method: Method,
    problem: &P,
    order: u32,
    control: Control,
    projection: bool,
) -> Option<Box<dyn Integrator<P>>> {
    let n = problem.dimension();
    match method {
        Method::Taylor => Some(Box::new(taylor::Taylor::new(order, n, control, projection))),
        Method::Dmv => {
            let kernel = dmv::Kernel::of_order(n, order);
            Some(Box::new(stepper::Stepper::with(kernel, n, control, projection)))
        }
        _ => None,
    }
}

impl Method {
    /// The orders that can be asked for, in words, and whether one of them was.
    pub(crate) fn allows_order(self, order: u32) -> Option<(String, bool)> {
        match self {
            Self::Taylor => {
                let (least, most) = (taylor::ORDERS.start(), taylor::ORDERS.end());
                Some((format!("from {least} to {most}"), taylor::ORDERS.contains(&order)))
            }
            Self::Dmv => Some(("2, 4, 6, 8 or 10".to_owned(), dmv::ORDERS.contains(&order))),
            _ => None,
        }
    }

    /// The form in which the method integrates orientation, for the form of orientation asked for.
    pub(crate) fn form(self, matrix: bool) -> Form {
        match (self.in_body_axes(), matrix && self != Self::Exact) {
            (true, _) => Form::Body,
            (false, true) => Form::WorldMatrix,
            (false, false) => Form::WorldQuaternion,
        }
    }
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Method {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        Self::ALL.iter().copied().find(|method| method.name() == name).ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|method| method.name()).collect();
            Error::value("run", "method", format!("one of {}", names.join(", ")), name)
        })
    }
}

/// A step that was taken: its start and length, and state and slope at both ends.
#[derive(Debug)]
struct Step<'a, Y> {
    at: Moment,
    h: f64,
    y0: &'a Y,
    k0: &'a Y,
    y1: &'a Y,
    k1: &'a Y,
}

/// What makes one method different from another; it owns the vectors it works with.
trait Kernel<Y: StateVector>: Debug + Send {
    /// Evaluations of f in one step, that of `k0` included where it is needed.
    const EVALUATIONS: u32;

    /// The power of h with which the estimate of a step's error falls; 0 where there is none.
    const ERROR_ORDER: f64 = 0.0;

    /// Whether there is such an estimate; of a method without one, no code to follow it is compiled.
    const ESTIMATES_ERROR: bool = Self::ERROR_ORDER > 0.0;

    /// Whether a step needs the slope at its start; else `k0` is not worked out for it.
    const NEEDS_SLOPE: bool = true;

    fn new(n: usize) -> Self;

    /// The change of `y` in a step of length `h`; `k0 = f(t, y)` is known.
    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &Y, k0: &Y, h: f64, dy: &mut Y);

    /// Evaluations of f that the last step took, that of `k0` included where it is needed.
    fn evaluations(&self) -> u32 {
        Self::EVALUATIONS
    }

    /// Estimate of the error of the step just taken, from `y0` to `y1`, as a size [-].
    fn error<P: Problem<Y = Y>>(&mut self, _problem: &mut P, _y0: &Y, _y1: &Y, _h: f64, _scales: &Scales) -> f64 {
        0.0
    }

    /// The motion within the step just taken; returns the evaluations of f it took beyond those given.
    fn interpolate<P: Problem<Y = Y>>(&mut self, _problem: &mut P, step: &Step<'_, Y>, segment: &mut Segment) -> u32 {
        segment.set_hermite(step.at, step.h, [step.y0, step.k0, step.y1, step.k1].map(AsRef::as_ref));
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finite_numbers_are_told_from_others_wherever_they_stand() {
        // also where the sum alone overflows, and where infinities of both signs meet in it
        assert!([1e308; 7].is_finite() && vec![f64::MAX; 2].is_finite() && Vec::new().is_finite());
        for other in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for place in 0..7 {
                let mut y = [1.0; 7];
                y[place] = other;
                assert!(!y.is_finite(), "{other} at {place}");
                y[(place + 2) % 7] = f64::NEG_INFINITY;
                assert!(!y.is_finite(), "{other} at {place}");
            }
        }
    }
}
