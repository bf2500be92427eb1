//! Methods that advance Y′ = f(t, Y): one method, one file, one line in the list below.
//!
//! A method sees a [`Problem`], never bodies or effects. What it computes is a [`Segment`] a step:
//! a polynomial in time that **is** the motion between the step's ends. Samples, events and
//! contacts all read that same polynomial.
//!
//! ```text
//! Problem ──method──▶ Segment, Segment, …     held by a Flight, which answers at(t)
//! ```

use std::fmt::Debug;

use crate::error::{Error, Result};
use crate::freedom::Form;
use crate::math::sum::Time;
use crate::state::{BodyMotion, Moment};

mod euler;
mod fixed_step;
mod flight;
mod heun;
mod rk4;
mod segment;
mod semi_implicit_euler;

pub use flight::{Counts, Flight, FlightError, Integration};
pub use segment::Segment;

/// The numbers that are integrated. A fixed length lets the compiler unroll the step of a single
/// body; groups of bodies use a `Vec`.
pub trait StateVector: Clone + Debug + Send + AsRef<[f64]> + AsMut<[f64]> {
    /// `n` zeros.
    fn zeros(n: usize) -> Self;

    /// `self += a · k`
    #[inline]
    fn add_scaled(&mut self, a: f64, k: &Self) {
        for (y, k) in self.as_mut().iter_mut().zip(k.as_ref()) {
            *y += a * k;
        }
    }

    /// `self = y + a · k`
    #[inline]
    fn set_sum(&mut self, y: &Self, a: f64, k: &Self) {
        for ((s, y), k) in self.as_mut().iter_mut().zip(y.as_ref()).zip(k.as_ref()) {
            *s = y + a * k;
        }
    }
}

impl<const N: usize> StateVector for [f64; N] {
    fn zeros(n: usize) -> Self {
        debug_assert_eq!(n, N);
        [0.0; N]
    }
}

impl StateVector for Vec<f64> {
    fn zeros(n: usize) -> Self {
        vec![0.0; n]
    }
}

/// A differential equation Y′ = f(t, Y), and what a method may know about it beyond f.
pub trait Problem: Debug + Send {
    /// The numbers that are integrated.
    type Y: StateVector;

    /// How many numbers they are.
    fn dimension(&self) -> usize;

    /// How many bodies move.
    fn bodies(&self) -> usize;

    /// `dy = f(t, y)`
    fn rate(&mut self, at: Moment, y: &Self::Y, dy: &mut Self::Y);

    /// The part of f that is left when all loads are 0; `f − drift` is the kick of a splitting.
    fn drift(&mut self, y: &Self::Y, dy: &mut Self::Y);

    /// Puts orientations back on their sphere (lecture §4); returns how far the worst had strayed [-].
    fn project(&mut self, y: &mut Self::Y) -> f64;

    /// How far the worst orientation is off its sphere, as it stands [-].
    fn orientation_error(&self, y: &Self::Y) -> f64;

    /// The motion of every body, read from the numbers.
    fn decode(&self, y: &[f64], motions: &mut [BodyMotion]);

    /// What a user's function complained about, once.
    fn take_failure(&mut self) -> Option<String>;
}

/// Where an integration stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Front<Y> {
    /// The instant, with its rounding error kept.
    pub time: Time,
    /// Start of the interval without switches [s].
    pub since: f64,
    /// The numbers there.
    pub y: Y,
}

impl<Y> Front<Y> {
    /// The moment of the front.
    pub fn moment(&self) -> Moment {
        Moment { time: self.time.value, since: self.since }
    }
}

/// Advances a problem, a step at a call.
pub trait Integrator<P: Problem>: Debug + Send {
    /// Takes one step, which ends at `limit` or before it, and writes its motion into `segment`.
    fn advance(
        &mut self,
        problem: &mut P,
        front: &mut Front<P::Y>,
        limit: f64,
        segment: &mut Segment,
        counts: &mut Counts,
    );

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
        }

        impl Method {
            /// Every method, in the order of the list.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The name that files, reports and Python use.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($module),)*
                }
            }

            /// Order of accuracy: halving the step divides the error by two to this power.
            pub fn order(self) -> u32 {
                match self {
                    $(Self::$variant => $module::ORDER,)*
                }
            }

            /// Evaluations of f in one step.
            pub fn evaluations(self) -> u32 {
                match self {
                    $(Self::$variant => $module::EVALUATIONS,)*
                }
            }

            /// Whether it integrates the angular momentum in body axes; else in the lecture's world axes.
            pub fn in_body_axes(self) -> bool {
                match self {
                    $(Self::$variant => $module::BODY_AXES,)*
                }
            }

            /// The method for steps of `step` [s].
            pub(crate) fn integrator<P: Problem + 'static>(self, problem: &P, step: f64, projection: bool) -> Box<dyn Integrator<P>> {
                let n = problem.dimension();
                match self {
                    $(Self::$variant => Box::new(fixed_step::FixedStep::<P, $module::Kernel<P::Y>>::new(n, step, projection)),)*
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
}

impl Method {
    /// The form in which the method integrates orientation, for the form of orientation asked for.
    pub(crate) fn form(self, matrix: bool) -> Form {
        match (self.in_body_axes(), matrix) {
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

/// The step of a method with a fixed step; it owns the vectors it works with.
trait Kernel<Y: StateVector>: Debug + Send {
    /// Evaluations of f in one step.
    const EVALUATIONS: u32;

    fn new(n: usize) -> Self;

    /// Advances `y` by `h`; `k1 = f(t, y)` is known.
    fn step<P: Problem<Y = Y>>(&mut self, problem: &mut P, at: Moment, y: &mut Y, k1: &Y, h: f64);
}
