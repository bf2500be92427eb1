//! An engine fixed to a body.

use super::series::{SeriesBody, SeriesLoad, add};
use super::{BodyMotion, Effect, Load, Moment, Schedule, Switch, Target, finite, power_of};
use crate::error::Result;
use crate::math::Vector3;
use crate::math::series::Tape;

/// An engine: a force fixed in the body at a point fixed in the body (lecture (33)–(37)).
///
/// ```text
/// F = k R F_body        M = R (r_body × k F_body)        k the schedule's factor
/// ```
///
/// The factor is piecewise constant, 0 before the first time and held after the last; the switch
/// happens exactly at its time, and no step straddles it. With a [`Switch`] the state turns the engine on and off,
/// whatever the factor.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Thruster {
    /// The body that carries the engine.
    pub body: String,
    /// Where the force acts, body axes from the centre of mass [m].
    pub point_body: [f64; 3],
    /// The force at factor 1, body axes [N].
    pub force_body: [f64; 3],
    /// Times [s] and the factor of the force from then on; factor 1 always, if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub schedule: Option<Schedule>,
    /// What turns it on and off by the state; always on if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub switch: Option<Switch>,
}

impl Thruster {
    /// An engine on `body` at `point_body` [m] with `force_body` [N], always on.
    pub fn new(body: impl Into<String>, point_body: impl Into<[f64; 3]>, force_body: impl Into<[f64; 3]>) -> Self {
        let (point_body, force_body) = (point_body.into(), force_body.into());
        Self { body: body.into(), point_body, force_body, schedule: None, switch: None }
    }

    /// What turns it on and off by the state.
    #[must_use]
    pub fn switch(mut self, switch: Switch) -> Self {
        self.switch = Some(switch);
        self
    }

    /// Pairs of time [s] and factor.
    #[must_use]
    pub fn schedule(mut self, schedule: impl Into<Schedule>) -> Self {
        self.schedule = Some(schedule.into());
        self
    }
}

impl Effect for Thruster {
    fn validate(&self, place: &str) -> Result<()> {
        finite(place, "point_body", self.point_body)?;
        finite(place, "force_body", self.force_body)?;
        if let Some(switch) = &self.switch {
            switch.validate(place)?;
        }
        Schedule::validate(self.schedule.as_ref(), place)
    }

    fn target(&self) -> Target {
        Target::Each(vec![self.body.clone()])
    }

    fn idle(&self) -> Option<&'static str> {
        (self.force_body == [0.0; 3]).then_some("its force is 0")
    }

    fn switches(&self) -> Vec<f64> {
        Schedule::times(self.schedule.as_ref())
    }

    fn switch(&self) -> Option<&Switch> {
        self.switch.as_ref()
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn has_series(&self) -> bool {
        true
    }

    fn add_series(&self, at: Moment, body: &mut SeriesBody, load: &mut SeriesLoad, tape: &mut Tape) {
        let factor = Schedule::factor_or_one(self.schedule.as_ref(), at.since);
        if factor != 0.0 {
            let force_body = factor * Vector3::from(self.force_body);
            let force = tape.constant(body.own(&force_body));
            add(tape, &mut load.force_own, force);
            let torque = tape.constant(body.own(&Vector3::from(self.point_body).cross(&force_body)));
            add(tape, &mut load.torque_own, torque);
        }
    }

    fn add_to_one(&self, at: Moment, body: &BodyMotion, load: &mut Load) {
        let factor = Schedule::factor_or_one(self.schedule.as_ref(), at.since);
        if factor != 0.0 {
            let force = factor * Vector3::from(self.force_body);
            load.force += body.rotation * force;
            load.torque += body.rotation * Vector3::from(self.point_body).cross(&force);
        }
    }

    fn work_rate(&self, at: Moment, bodies: &[BodyMotion]) -> f64 {
        power_of(self, at, bodies)
    }
}
