//! What acts on bodies: one effect, one file, one line in the list below.
//!
//! An effect adds force and torque to the bodies it acts on, and accounts for the energy it moves,
//! so that one audit tests them all: kinetic + potential + dissipated − work = constant.

use std::fmt::Debug;

use crate::error::{Error, Result};
use crate::math::Vector3;
use crate::math::series::Tape;
pub use crate::state::{BodyMotion, Load, Moment};

pub mod drag;
pub mod point_gravity;
pub mod schedule;
pub(crate) mod series;
pub mod spring;
pub mod switch;
pub mod thruster;
pub mod uniform_gravity;
pub mod user;
pub mod wrench;

pub use drag::Drag;
pub use point_gravity::PointGravity;
pub use schedule::Schedule;
use series::{SeriesBody, SeriesLoad};
pub use spring::Spring;
pub use switch::Switch;
pub use thruster::Thruster;
pub use uniform_gravity::UniformGravity;
pub use user::UserEffect;
pub use wrench::{Frame, Wrench};

/// Which bodies an effect acts on.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// On every body alone.
    All,
    /// On each of the named bodies alone.
    Each(Vec<String>),
    /// On the named bodies together, in this order: they then share one integrator and one clock.
    Together(Vec<String>),
}

impl Target {
    /// Every body, or those of a list.
    pub(crate) fn each(bodies: Option<&Vec<String>>) -> Self {
        bodies.map_or(Self::All, |names| Self::Each(names.clone()))
    }
}

/// A cause of force and torque.
pub trait Effect: Debug + Send + Sync {
    /// Refuses values that mean nothing; `place` names the effect in the message.
    ///
    /// # Errors
    /// Names the field, its value and what is allowed.
    fn validate(&self, place: &str) -> Result<()>;

    /// The bodies it acts on.
    fn target(&self) -> Target;

    /// Why the effect would do nothing, if so: the plan then leaves it out.
    fn idle(&self) -> Option<&'static str> {
        None
    }

    /// Whether its load is that of its potential energy alone: no heat, and no work from outside.
    fn conservative(&self) -> bool {
        false
    }

    /// Whether the load depends on velocities; if not, a splitting's kick takes it as a whole.
    fn depends_on_velocity(&self) -> bool {
        true
    }

    /// Whether the load depends neither on time nor on the motion: it is worked out once.
    fn is_constant(&self) -> bool {
        false
    }

    /// Whether the load is a power series of time where the motion is one; a constant load is without being asked.
    fn has_series(&self) -> bool {
        false
    }

    /// Adds that series for one of its bodies, from the moment `at` on.
    fn add_series(&self, _at: Moment, _body: &mut SeriesBody, _load: &mut SeriesLoad, _tape: &mut Tape) {}

    /// Vectors at whose zeros the load has a kink, such as the speed of quadratic drag. Runs to a tolerance
    /// end a step where one turns round.
    fn kinks(&self, _body: &BodyMotion) -> [Option<Vector3>; 2] {
        [None, None]
    }

    /// Times at which the load jumps [s]; no step straddles one.
    fn switches(&self) -> Vec<f64> {
        Vec::new()
    }

    /// What turns it on and off by the state of its only body, if anything does.
    fn switch(&self) -> Option<&Switch> {
        None
    }

    /// Adds force [N] and torque about the centre of mass [N·m] of a body, world axes; of an effect that acts
    /// on every body by itself, this says all.
    fn add_to_one(&self, _at: Moment, _body: &BodyMotion, _load: &mut Load) {}

    /// Adds force [N] and torque about the centre of mass [N·m] of each body, world axes.
    fn add_to(&self, at: Moment, bodies: &[BodyMotion], loads: &mut [Load]) {
        for (body, load) in bodies.iter().zip(loads) {
            self.add_to_one(at, body, load);
        }
    }

    /// Potential energy U of the bodies [J].
    fn potential_energy(&self, _at: Moment, _bodies: &[BodyMotion]) -> f64 {
        0.0
    }

    /// Power turned into heat [W].
    fn dissipated_power(&self, _at: Moment, _bodies: &[BodyMotion]) -> f64 {
        0.0
    }

    /// Power brought in from outside [W].
    fn work_rate(&self, _at: Moment, _bodies: &[BodyMotion]) -> f64 {
        0.0
    }

    /// What went wrong inside a user's function, once; the run then ends with this message.
    fn take_failure(&self) -> Option<String> {
        None
    }
}

/// Power of the loads that an effect puts on bodies one by one [W].
fn power_of(effect: &impl Effect, at: Moment, bodies: &[BodyMotion]) -> f64 {
    let power = |body: &BodyMotion| {
        let mut load = Load::zero();
        effect.add_to_one(at, body, &mut load);
        load.power(body)
    };
    bodies.iter().map(power).sum()
}

/// Declares the effects: one line adds a variant, its name in files and its conversion.
macro_rules! effects {
    ($($(#[$doc:meta])* $variant:ident => $name:literal,)*) => {
        /// Any effect, as a scene holds it.
        #[derive(Debug, Clone, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        pub enum AnyEffect {
            $($(#[$doc])* $variant($variant),)*
            /// A function of the user; it cannot be written to a file.
            #[cfg_attr(feature = "serde", serde(skip))]
            User(UserEffect),
        }

        impl AnyEffect {
            /// The names that files use, in the order of the list.
            pub const NAMES: &'static [&'static str] = &[$($name,)*];

            /// The name that files and reports use.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $name,)*
                    Self::User(_) => "user_effect",
                }
            }

            /// The effect behind the variant.
            pub fn as_effect(&self) -> &dyn Effect {
                match self {
                    $(Self::$variant(effect) => effect,)*
                    Self::User(effect) => effect,
                }
            }
        }

        $(impl From<$variant> for AnyEffect {
            fn from(effect: $variant) -> Self {
                Self::$variant(effect)
            }
        })*

        impl From<UserEffect> for AnyEffect {
            fn from(effect: UserEffect) -> Self {
                Self::User(effect)
            }
        }
    };
}

effects! {
    /// The same acceleration everywhere.
    UniformGravity => "uniform_gravity",
    /// Attraction by a distant point, with its gradient's torque.
    PointGravity => "point_gravity",
    /// Resistance of a medium.
    Drag => "drag",
    /// An engine fixed to a body, with a schedule.
    Thruster => "thruster",
    /// A given force and torque, constant, scheduled or oscillating.
    Wrench => "wrench",
    /// A damped spring between two bodies, or a body and the world.
    Spring => "spring",
}

/// A vector that must be finite.
pub(crate) fn finite(place: &str, field: &'static str, value: [f64; 3]) -> Result<Vector3> {
    if value.iter().all(|x| x.is_finite()) {
        Ok(Vector3::from(value))
    } else {
        Err(Error::value(place, field, "three finite numbers", value))
    }
}

/// A number that must be finite and not negative.
pub(crate) fn not_negative(place: &str, field: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(Error::value(place, field, "a finite number ≥ 0", value))
    }
}
