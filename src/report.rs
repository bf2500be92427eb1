//! What ran, what it cost, and how far the result is to be trusted.

use std::borrow::Cow;
use std::fmt;

use crate::integrator::{Counts, Method};
use crate::plan::Plan;
use crate::text::short;

/// Time spent by stage [s of the thread's clock].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Seconds {
    /// Checking the scene and making the plan.
    pub compile: f64,
    /// The run whose result is kept.
    pub run: f64,
    /// Other runs, from which its error is estimated.
    pub estimate: f64,
}

/// What ran, what it cost, and how far the result is to be trusted.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Report {
    /// Method of integration.
    pub method: Method,
    /// Length of a step [s]; the mean one, where they differ.
    pub step: f64,
    /// Largest error that a step was allowed [-], where that decided its length.
    pub local_tolerance: Option<f64>,
    /// Tolerance asked for [-].
    pub tolerance: Option<f64>,
    /// Estimated error of the result [-]: the larger of position error over `length_scale` and
    /// orientation error in radians, over all samples and bodies up to the horizon.
    pub error_estimate: Option<f64>,
    /// How the error was estimated.
    pub estimated_by: Cow<'static, str>,
    /// Whether the estimate is within the tolerance over the whole span.
    pub met: Option<bool>,
    /// Time up to which the estimate is within the tolerance [s]; the end, if none was asked for.
    pub horizon: f64,
    /// Length that position errors are measured by [m].
    pub length_scale: f64,
    /// Steps, evaluations, drift of the orientation.
    pub counts: Counts,
    /// Impacts answered.
    pub impacts: u64,
    /// Rounds of the finder, over all impacts.
    pub impact_iterations: u64,
    /// Instants of impact at which a point took a blow because its gap was below `ε_touch`
    /// ([`TOUCH_GAP`](crate::tolerance::TOUCH_GAP)), though above ε: a landing that is flat to that angle, bodies that
    /// are hit together. With another `ε_touch` they come out differently.
    pub touch_impacts: u64,
    /// Time spent by stage.
    pub seconds: Seconds,
}

impl Report {
    /// A report of nothing done yet.
    pub(crate) fn new(plan: &Plan) -> Self {
        Self {
            method: plan.method(),
            step: plan.options().step.unwrap_or_default(),
            local_tolerance: None,
            tolerance: plan.tolerance(),
            error_estimate: None,
            estimated_by: Cow::Borrowed("not estimated"),
            met: None,
            horizon: 0.0,
            length_scale: 0.0,
            counts: Counts::default(),
            impacts: 0,
            impact_iterations: 0,
            touch_impacts: 0,
            seconds: Seconds::default(),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Report: {}, h = {} s", self.method, short(self.step))?;
        match self.local_tolerance {
            Some(local) => writeln!(f, " in the mean, found for an error of {} a step", short(local))?,
            None => writeln!(f)?,
        }
        match self.error_estimate {
            Some(error) => write!(f, "  error      {} (estimate: {})", short(error), self.estimated_by)?,
            None => write!(f, "  error      {}", self.estimated_by)?,
        }
        match (self.tolerance, self.met) {
            (Some(tolerance), Some(true)) => writeln!(f, ", tolerance {} met", short(tolerance))?,
            (Some(tolerance), Some(false)) => {
                writeln!(f, ", tolerance {} NOT met after t = {} s", short(tolerance), short(self.horizon))?;
            }
            _ => writeln!(f)?,
        }
        writeln!(f, "  scale      positions over {} m, orientations in rad", short(self.length_scale))?;
        writeln!(
            f,
            "  drift      orientation {} off its sphere before projection",
            short(self.counts.orientation_drift)
        )?;
        write!(f, "  work       {} steps, {} evaluations", self.counts.steps, self.counts.evaluations)?;
        if self.counts.rejected > 0 {
            write!(f, ", {} steps refused", self.counts.rejected)?;
        }
        if self.impacts > 0 {
            write!(f, ", {} impacts ({} rounds of the finder)", self.impacts, self.impact_iterations)?;
            if self.touch_impacts > 0 {
                write!(f, ", {} of them hang on ε_touch", self.touch_impacts)?;
            }
        }
        writeln!(f)?;
        let Seconds { compile, run, estimate } = self.seconds;
        write!(f, "  time       {} s run, {} s estimate, {} s compile", short(run), short(estimate), short(compile))
    }
}
