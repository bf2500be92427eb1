//! Switching by the state: on and off at two values of a measure.

use crate::error::{Error, Result};
use crate::measure::Measure;
use crate::state::BodyMotion;

/// Turns an effect on and off by a measure of its body, with hysteresis.
///
/// ```text
/// on < off     on once the measure has fallen to `on`, off once it has risen to `off`: a heater
/// on > off     on once the measure has risen to `on`, off once it has fallen to `off`: a brake
/// ```
///
/// Between the two it stays as it is, at the start as `starts_on` says. The step ends where the measure meets the
/// value, to rounding, so that methods keep their order; a load that pushes the measure back at once would switch
/// for ever, which two different values prevent.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Switch {
    /// What decides; of one body.
    pub measure: Measure,
    /// The value at which the effect turns on, in the unit of the measure.
    pub on: f64,
    /// The value at which it turns off.
    pub off: f64,
    /// Whether it is on at the start, where the measure lies between the two.
    #[cfg_attr(feature = "serde", serde(default))]
    pub starts_on: bool,
}

impl Switch {
    /// Turns on and off at these values of a measure.
    pub fn new(measure: impl Into<Measure>, on: f64, off: f64) -> Self {
        Self { measure: measure.into(), on, off, starts_on: false }
    }

    /// Whether it is on at the start, where the measure lies between the two values.
    #[must_use]
    pub fn starts_on(mut self, starts_on: bool) -> Self {
        self.starts_on = starts_on;
        self
    }

    /// Refuses what means nothing; `place` names whose switch it is.
    pub(crate) fn validate(&self, place: &str) -> Result<()> {
        for (field, value) in [("on", self.on), ("off", self.off)] {
            if !value.is_finite() {
                return Err(Error::value(place, field, "a finite number", value));
            }
        }
        if self.on == self.off {
            return Err(Error::value(place, "off", "another value than on, or it would switch for ever", self.off));
        }
        if let Some(n) = self.measure.bodies().filter(|&n| n != 1) {
            let allowed = format!("of one body, not of {n} as {}", self.measure.name());
            return Err(Error::value(place, "switch measure", allowed, &self.measure));
        }
        self.measure.validate(place)
    }

    /// The value that turns it, as it stands, and whether the measure rises to it.
    pub(crate) fn next(&self, on: bool) -> (f64, bool) {
        if on { (self.off, self.off > self.on) } else { (self.on, self.on > self.off) }
    }

    /// Whether it is on at the start `t` [s].
    ///
    /// # Errors
    /// What a user's function complains about.
    pub(crate) fn begins(&self, t: f64, body: &BodyMotion) -> Result<bool, String> {
        let measured = self.measure.value(t, std::slice::from_ref(body))?;
        let past = |(value, rises): (f64, bool)| if rises { measured >= value } else { measured <= value };
        Ok(match (past(self.next(false)), past(self.next(true))) {
            (true, _) => true,
            (_, true) => false,
            _ => self.starts_on,
        })
    }
}
