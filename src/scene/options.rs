//! How to run a scene.

use std::ops::Range;

use super::event::UserEvent;
pub use crate::contact::collision::Law;
use crate::error::{Error, Result};
pub use crate::impact::Finder;
use crate::integrator::Method;

/// Start and end of a run [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Where it starts [s].
    pub start: f64,
    /// Where it ends [s].
    pub end: f64,
}

impl From<Range<f64>> for Span {
    fn from(range: Range<f64>) -> Self {
        Self { start: range.start, end: range.end }
    }
}

impl From<(f64, f64)> for Span {
    fn from((start, end): (f64, f64)) -> Self {
        Self { start, end }
    }
}

impl From<[f64; 2]> for Span {
    fn from([start, end]: [f64; 2]) -> Self {
        Self { start, end }
    }
}

/// How methods in world axes write the orientation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Orientation {
    /// As a quaternion q, 4 numbers.
    #[default]
    Quaternion,
    /// As a matrix R, 9 numbers.
    Matrix,
}

impl Orientation {
    /// Every way.
    pub const ALL: &'static [Self] = &[Self::Quaternion, Self::Matrix];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quaternion => "quaternion",
            Self::Matrix => "matrix",
        }
    }
}

/// What a run keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Record {
    /// The motion of every step: any time can be asked for afterwards.
    #[default]
    Dense,
    /// The samples at `t_eval`.
    Samples,
    /// The start and the end.
    End,
}

impl Record {
    /// Every choice.
    pub const ALL: &'static [Self] = &[Self::Dense, Self::Samples, Self::End];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dense => "dense",
            Self::Samples => "samples",
            Self::End => "end",
        }
    }
}

/// How to run a scene. Give a tolerance, or a method with a step; with neither, the tolerance is 1e-6.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields, default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunOptions {
    /// Start and end [s], where the call does not say.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub t_span: Option<[f64; 2]>,
    /// Error that the result may have: of positions over `length_scale`, of orientations in radians [-].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub tolerance: Option<f64>,
    /// Method of integration; `auto`, or none, lets the plan choose.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none", deserialize_with = "method_or_auto"))]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub method: Option<Method>,
    /// Order of the methods `taylor` (if absent, that which the tolerance calls for, 8 where the step is given) and
    /// `dmv` (10).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub order: Option<u32>,
    /// Length of a step [s].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub step: Option<f64>,
    /// Times of the samples [s]; the ends and 201 uniform times if absent.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub t_eval: Option<Vec<f64>>,
    /// Whether the error of the result is estimated.
    pub estimate: bool,
    /// What the run keeps.
    pub record: Record,
    /// Length that position errors are measured by [m]; the larger of body and path if absent.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub length_scale: Option<f64>,
    /// How methods in world axes write the orientation.
    pub orientation: Orientation,
    /// Whether orientations are put back on their sphere after each step (lecture §4).
    pub projection: bool,
    /// How the time of contact is found.
    pub finder: Finder,
    /// Gap at which a contact is accepted [m]; 1e-12 of the pair's size if absent.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub eps: Option<f64>,
    /// What restitution means where friction couples the normal and the tangent.
    pub restitution_law: Law,
    /// Impacts of one body, and breaks of its joints, after which the run ends as
    /// [`AccumulatingImpacts`](crate::Failure::AccumulatingImpacts) [-]: bounces may follow each other without end, at ever
    /// shorter times.
    pub max_impacts: u64,
    /// What is watched for.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub events: Vec<UserEvent>,
}

impl Default for RunOptions {
    fn default() -> Self {
        Self {
            t_span: None,
            tolerance: None,
            method: None,
            order: None,
            step: None,
            t_eval: None,
            estimate: true,
            record: Record::Dense,
            length_scale: None,
            orientation: Orientation::Quaternion,
            projection: true,
            finder: Finder::Guaranteed,
            eps: None,
            restitution_law: Law::default(),
            max_impacts: 1_000_000,
            events: Vec::new(),
        }
    }
}

/// `auto`, or the name of a method.
#[cfg(feature = "serde")]
fn method_or_auto<'de, D: serde::Deserializer<'de>>(deserializer: D) -> std::result::Result<Option<Method>, D::Error> {
    use serde::Deserialize;
    use serde::de::Error as _;

    let name = String::deserialize(deserializer)?;
    if name == "auto" {
        return Ok(None);
    }
    name.parse().map(Some).map_err(|_| {
        let names: Vec<_> = Method::ALL.iter().map(|method| format!("`{method}`")).collect();
        D::Error::custom(format!("unknown method `{name}`, expected one of `auto`, {}", names.join(", ")))
    })
}

impl RunOptions {
    /// A run whose result may be off by `tolerance`.
    pub fn tolerance(tolerance: f64) -> Self {
        Self { tolerance: Some(tolerance), ..Self::default() }
    }

    /// A run with this method; give it a step.
    pub fn method(method: Method) -> Self {
        Self { method: Some(method), ..Self::default() }
    }

    /// Order of the methods `taylor` and `dmv`.
    #[must_use]
    pub fn order(mut self, order: u32) -> Self {
        self.order = Some(order);
        self
    }

    /// Length of a step [s].
    #[must_use]
    pub fn step(mut self, step: f64) -> Self {
        self.step = Some(step);
        self
    }

    /// Times of the samples [s].
    #[must_use]
    pub fn t_eval(mut self, times: impl Into<Vec<f64>>) -> Self {
        self.t_eval = Some(times.into());
        self
    }

    /// Whether the error of the result is estimated.
    #[must_use]
    pub fn estimate(mut self, estimate: bool) -> Self {
        self.estimate = estimate;
        self
    }

    /// What the run keeps.
    #[must_use]
    pub fn record(mut self, record: Record) -> Self {
        self.record = record;
        self
    }

    /// How methods in world axes write the orientation.
    #[must_use]
    pub fn orientation(mut self, orientation: Orientation) -> Self {
        self.orientation = orientation;
        self
    }

    /// Whether orientations are put back on their sphere after each step.
    #[must_use]
    pub fn projection(mut self, projection: bool) -> Self {
        self.projection = projection;
        self
    }

    /// How the time of contact is found.
    #[must_use]
    pub fn finder(mut self, finder: Finder) -> Self {
        self.finder = finder;
        self
    }

    /// Gap at which a contact is accepted [m].
    #[must_use]
    pub fn eps(mut self, eps: f64) -> Self {
        self.eps = Some(eps);
        self
    }

    /// What restitution means where friction couples the normal and the tangent.
    #[must_use]
    pub fn restitution_law(mut self, law: Law) -> Self {
        self.restitution_law = law;
        self
    }

    /// Impacts of one body after which the run ends as `AccumulatingImpacts`.
    #[must_use]
    pub fn max_impacts(mut self, max_impacts: u64) -> Self {
        self.max_impacts = max_impacts;
        self
    }

    /// One more event that is watched for.
    #[must_use]
    pub fn event(mut self, event: UserEvent) -> Self {
        self.events.push(event);
        self
    }

    /// Whether an event may end the run.
    pub(crate) fn may_end_early(&self) -> bool {
        self.events.iter().any(|event| event.terminal)
    }

    /// Whether nothing is said.
    #[cfg(feature = "serde")]
    pub(crate) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Refuses values that mean nothing, and pairs that exclude each other.
    ///
    /// # Errors
    /// Names the field, its value and what is allowed.
    pub fn validate(&self) -> Result<()> {
        let positive = [
            ("tolerance", self.tolerance),
            ("step", self.step),
            ("length_scale", self.length_scale),
            ("eps", self.eps),
        ];
        for (field, value) in positive {
            if let Some(value) = value.filter(|x| !(x.is_finite() && *x > 0.0)) {
                return Err(Error::value("run", field, "a finite number > 0", value));
            }
        }
        if self.tolerance.is_some() && self.step.is_some() {
            return Err(Error::refused("run", "tolerance and step exclude each other"));
        }
        if self.step.is_some() && self.method.is_none() {
            return Err(Error::refused("run", "a step needs a method beside it"));
        }
        if let Some(order) = self.order {
            match self.method.and_then(|method| method.allows_order(order)) {
                None => {
                    let reason = "an order needs the method taylor or dmv beside it: others have their own";
                    return Err(Error::refused("run", reason));
                }
                Some((allowed, false)) => return Err(Error::value("run", "order", allowed, order)),
                Some(_) => {}
            }
        }
        if let Some(span) = self.t_span {
            self.times(span.into())?;
        }
        self.events.iter().try_for_each(UserEvent::validate)
    }

    /// Refuses options that have no text.
    #[cfg(feature = "serde")]
    pub(crate) fn check_writable(&self) -> Result<()> {
        match self.events.iter().find(|event| matches!(event.measure, crate::measure::Measure::Function(_))) {
            Some(event) => Err(Error::refused(event.place(), "a function is code and cannot be written to a file")),
            None => Ok(()),
        }
    }

    /// The times of the samples [s] of a run over `span`.
    pub(crate) fn times(&self, span: Span) -> Result<Vec<f64>> {
        let Span { start, end } = span;
        if !(start.is_finite() && end.is_finite() && end > start) {
            return Err(Error::value("run", "t_span", "two finite times, the second later", [start, end]));
        }
        if self.record == Record::End {
            return Ok(vec![start, end]);
        }
        let Some(times) = &self.t_eval else {
            return Ok((0..SAMPLES)
                .map(|i| if i + 1 == SAMPLES { end } else { start + (end - start) * i as f64 / (SAMPLES - 1) as f64 })
                .collect());
        };
        if times.is_empty() {
            return Err(Error::value("run", "t_eval", "at least one time", times));
        }
        if let Some(bad) = times.iter().find(|t| !(start..=end).contains(*t)) {
            return Err(Error::value("run", "t_eval", format!("within the span {start} to {end}"), bad));
        }
        if let Some(bad) = times.windows(2).find(|pair| pair[1] <= pair[0]) {
            return Err(Error::value("run", "t_eval", "sorted by rising time", (bad[0], bad[1])));
        }
        Ok(times.clone())
    }
}

/// Samples of a run that does not say [-].
const SAMPLES: usize = 201;
