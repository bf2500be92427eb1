//! Piecewise constant factors of time.

use crate::error::{Error, Result};

/// A factor that jumps at given times: 0 before the first, held after the last.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Schedule(pub Vec<(f64, f64)>);

impl Schedule {
    /// The factor that holds from the instant `since` on.
    pub fn factor(&self, since: f64) -> f64 {
        let after = self.0.partition_point(|&(time, _)| time <= since);
        if after == 0 { 0.0 } else { self.0[after - 1].1 }
    }

    /// The times of the jumps [s].
    pub(crate) fn times(schedule: Option<&Self>) -> Vec<f64> {
        schedule.map(|s| s.0.iter().map(|&(time, _)| time).collect()).unwrap_or_default()
    }

    /// The factor of a schedule that may be absent: then 1, always.
    pub(crate) fn factor_or_one(schedule: Option<&Self>, since: f64) -> f64 {
        schedule.map_or(1.0, |s| s.factor(since))
    }

    /// Refuses times that do not rise and numbers that are not finite.
    pub(crate) fn validate(schedule: Option<&Self>, place: &str) -> Result<()> {
        let Some(Self(pairs)) = schedule else { return Ok(()) };
        if pairs.is_empty() {
            return Err(Error::value(
                place,
                "schedule",
                "at least one (time, factor); leave it out for always on",
                pairs,
            ));
        }
        if let Some(bad) = pairs.iter().find(|(time, factor)| !time.is_finite() || !factor.is_finite()) {
            return Err(Error::value(place, "schedule", "pairs of finite numbers (time, factor)", bad));
        }
        if let Some(bad) = pairs.windows(2).find(|pair| pair[1].0 <= pair[0].0) {
            return Err(Error::value(place, "schedule", "sorted by rising time", (bad[0].0, bad[1].0)));
        }
        Ok(())
    }
}

impl<T: Into<Vec<(f64, f64)>>> From<T> for Schedule {
    fn from(pairs: T) -> Self {
        Self(pairs.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factor_is_zero_before_and_held_after() {
        let s = Schedule::from([(1.0, 0.5), (2.0, -1.0)]);
        assert_eq!([0.0, 1.0, 1.5, 2.0, 9.0].map(|t| s.factor(t)), [0.0, 0.5, 0.5, -1.0, -1.0]);
    }
}
