//! What a run shall watch for.

use crate::error::{Error, Result};
use crate::math::roots::Passage;
use crate::measure::{Measure, MeasureFunction};
use crate::state::BodyMotion;

/// Which passages through a value count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Direction {
    /// From below to above.
    Rising,
    /// From above to below.
    Falling,
    /// Either, and touches, where the value is met but not passed.
    #[default]
    Both,
}

impl Direction {
    /// Every direction.
    pub const ALL: &'static [Self] = &[Self::Rising, Self::Falling, Self::Both];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rising => "rising",
            Self::Falling => "falling",
            Self::Both => "both",
        }
    }

    /// Whether a passage counts.
    pub(crate) fn counts(self, passage: Passage) -> bool {
        match self {
            Self::Rising => passage == Passage::Rising,
            Self::Falling => passage == Passage::Falling,
            Self::Both => true,
        }
    }
}

/// An event: a measure of the motion meets a value.
///
/// ```text
/// g(t) = measure(t, bodies) − value = 0
/// ```
///
/// It is searched for along the motion of every step, and located to a few ulp of the time. Steps are excluded by
/// bounds of g, not by the signs at their ends, so that double roots and close pairs are seen; a touch is told where
/// g comes to 0 within its rounding and goes back. A zero at the very start is no event, nor is one that the run
/// ends on before g is seen leaving. Bodies of one event share one integrator and one clock.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UserEvent {
    /// A name that no other event of the run has.
    pub name: String,
    /// What is watched.
    pub measure: Measure,
    /// The bodies that it is measured of, in this order.
    pub bodies: Vec<String>,
    /// The value that it shall meet, in the unit of the measure.
    #[cfg_attr(feature = "serde", serde(default))]
    pub value: f64,
    /// Which passages count.
    #[cfg_attr(feature = "serde", serde(default))]
    pub direction: Direction,
    /// Whether the run ends there.
    #[cfg_attr(feature = "serde", serde(default))]
    pub terminal: bool,
}

impl UserEvent {
    /// An event of this name: `measure`, of these bodies, meets 0.
    pub fn new<S: Into<String>>(
        name: impl Into<String>,
        measure: impl Into<Measure>,
        bodies: impl IntoIterator<Item = S>,
    ) -> Self {
        Self {
            name: name.into(),
            measure: measure.into(),
            bodies: bodies.into_iter().map(Into::into).collect(),
            value: 0.0,
            direction: Direction::Both,
            terminal: false,
        }
    }

    /// The same of a function g(t, bodies).
    pub fn of_function<S: Into<String>>(
        name: impl Into<String>,
        function: impl Fn(f64, &[BodyMotion]) -> Result<f64, String> + Send + Sync + 'static,
        bodies: impl IntoIterator<Item = S>,
    ) -> Self {
        Self::new(name, MeasureFunction::new(function), bodies)
    }

    /// The value that the measure shall meet.
    #[must_use]
    pub fn value(mut self, value: f64) -> Self {
        self.value = value;
        self
    }

    /// Which passages count.
    #[must_use]
    pub fn direction(mut self, direction: Direction) -> Self {
        self.direction = direction;
        self
    }

    /// Whether the run ends there.
    #[must_use]
    pub fn terminal(mut self, terminal: bool) -> Self {
        self.terminal = terminal;
        self
    }

    /// How messages call it.
    pub(crate) fn place(&self) -> String {
        format!("event {}", self.name)
    }

    /// Refuses what means nothing.
    pub(crate) fn validate(&self) -> Result<()> {
        let place = self.place();
        if self.name.is_empty() {
            return Err(Error::value(place, "name", "a name", &self.name));
        }
        if !self.value.is_finite() {
            return Err(Error::value(place, "value", "a finite number", self.value));
        }
        let wanted = self.measure.bodies();
        if self.bodies.is_empty() || wanted.is_some_and(|n| n != self.bodies.len()) {
            let allowed = match wanted {
                None => "at least one name".to_owned(),
                Some(1) => format!("one name for {}", self.measure.name()),
                Some(n) => format!("{n} names for {}", self.measure.name()),
            };
            return Err(Error::value(place, "bodies", allowed, &self.bodies));
        }
        self.measure.validate(&place)
    }
}
