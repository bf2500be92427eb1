//! A given force and torque.

use super::series::{SeriesBody, SeriesLoad, add};
use super::{BodyMotion, Effect, Load, Moment, Schedule, Target, finite, power_of};
use crate::error::{Error, Result};
use crate::math::Vector3;
use crate::math::series::Tape;

/// The axes in which a wrench is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Frame {
    /// World axes, from the world's origin.
    #[default]
    World,
    /// Body axes, from the centre of mass.
    Body,
}

impl Frame {
    /// Every frame.
    pub const ALL: &'static [Self] = &[Self::World, Self::Body];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::World => "world",
            Self::Body => "body",
        }
    }
}

/// A force and a torque, constant, scheduled or oscillating.
///
/// ```text
/// F = k s F₀        M = k s M₀ + (p − x) × F        s = sin(angular_frequency · t + phase), or 1
/// ```
///
/// `F₀`, `M₀` and the point `p` are given in `frame`; without a point the force acts through the
/// centre of mass. `k` is the schedule's factor, `s` is 1 where no frequency is given.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Wrench {
    /// The body it acts on.
    pub body: String,
    /// Force F₀ [N].
    #[cfg_attr(feature = "serde", serde(default))]
    pub force: [f64; 3],
    /// Torque M₀ about the centre of mass [N·m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub torque: [f64; 3],
    /// The axes of force, torque and point.
    #[cfg_attr(feature = "serde", serde(default))]
    pub frame: Frame,
    /// Where the force acts [m]; the centre of mass if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub point: Option<[f64; 3]>,
    /// Times [s] and the factor from then on; factor 1 always, if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub schedule: Option<Schedule>,
    /// Angular frequency of the oscillation [rad/s]; none if absent.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub angular_frequency: Option<f64>,
    /// Phase of the oscillation at t = 0 [rad].
    #[cfg_attr(feature = "serde", serde(default))]
    pub phase: f64,
}

impl Wrench {
    /// A constant force [N] and torque [N·m] on `body`, world axes, through the centre of mass.
    pub fn new(body: impl Into<String>, force: impl Into<[f64; 3]>, torque: impl Into<[f64; 3]>) -> Self {
        Self {
            body: body.into(),
            force: force.into(),
            torque: torque.into(),
            frame: Frame::World,
            point: None,
            schedule: None,
            angular_frequency: None,
            phase: 0.0,
        }
    }

    /// The axes of force, torque and point.
    #[must_use]
    pub fn frame(mut self, frame: Frame) -> Self {
        self.frame = frame;
        self
    }

    /// Where the force acts, in the wrench's frame [m].
    #[must_use]
    pub fn point(mut self, point: impl Into<[f64; 3]>) -> Self {
        self.point = Some(point.into());
        self
    }

    /// Pairs of time [s] and factor.
    #[must_use]
    pub fn schedule(mut self, schedule: impl Into<Schedule>) -> Self {
        self.schedule = Some(schedule.into());
        self
    }

    /// Multiplies by `sin(angular_frequency · t + phase)` [rad/s], [rad].
    #[must_use]
    pub fn oscillating(mut self, angular_frequency: f64, phase: f64) -> Self {
        self.angular_frequency = Some(angular_frequency);
        self.phase = phase;
        self
    }
}

impl Effect for Wrench {
    fn validate(&self, place: &str) -> Result<()> {
        finite(place, "force", self.force)?;
        finite(place, "torque", self.torque)?;
        if let Some(point) = self.point {
            finite(place, "point", point)?;
        }
        if let Some(w) = self.angular_frequency.filter(|w| !w.is_finite()) {
            return Err(Error::value(place, "angular_frequency", "a finite number", w));
        }
        if !self.phase.is_finite() {
            return Err(Error::value(place, "phase", "a finite number", self.phase));
        }
        if self.angular_frequency.is_none() && self.phase != 0.0 {
            return Err(Error::value(place, "phase", "left out where no angular_frequency is given", self.phase));
        }
        Schedule::validate(self.schedule.as_ref(), place)
    }

    fn target(&self) -> Target {
        Target::Each(vec![self.body.clone()])
    }

    fn idle(&self) -> Option<&'static str> {
        (self.force == [0.0; 3] && self.torque == [0.0; 3]).then_some("its force and torque are 0")
    }

    fn switches(&self) -> Vec<f64> {
        Schedule::times(self.schedule.as_ref())
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    fn is_constant(&self) -> bool {
        let Self { frame, point, schedule, angular_frequency, .. } = self;
        *frame == Frame::World && point.is_none() && schedule.is_none() && angular_frequency.is_none()
    }

    fn has_series(&self) -> bool {
        true
    }

    fn add_series(&self, at: Moment, body: &mut SeriesBody, load: &mut SeriesLoad, tape: &mut Tape) {
        let factor = Schedule::factor_or_one(self.schedule.as_ref(), at.since);
        if factor == 0.0 {
            return;
        }
        let wave = self.angular_frequency.map(|w| tape.wave(w, self.phase));
        let swinging = |tape: &mut Tape, v: Vector3| {
            let v = tape.constant(factor * v);
            wave.filter(|_| tape.value(v) != Some(Vector3::zeros())).map_or(v, |wave| tape.product(wave, v))
        };
        let (force, torque) = (Vector3::from(self.force), Vector3::from(self.torque));
        let point = self.point.map(Vector3::from);
        match self.frame {
            Frame::World => {
                let [force, torque] = [force, torque].map(|v| swinging(tape, v));
                add(tape, &mut load.force, force);
                add(tape, &mut load.torque, torque);
                if let Some(point) = point {
                    // (p − x) × F
                    let offset = body.offset_own(tape, &point);
                    let force = body.own_of(tape, force);
                    let torque = tape.cross(force, offset);
                    add(tape, &mut load.torque_own, torque);
                }
            }
            Frame::Body => {
                let torque = torque + point.map_or_else(Vector3::zeros, |point| point.cross(&force));
                let [force, torque] = [force, torque].map(|v| swinging(tape, body.own(&v)));
                add(tape, &mut load.force_own, force);
                add(tape, &mut load.torque_own, torque);
            }
        }
    }

    fn add_to_one(&self, at: Moment, body: &BodyMotion, load: &mut Load) {
        let oscillation = self.angular_frequency.map_or(1.0, |w| libm::sin(w * at.time + self.phase));
        let factor = oscillation * Schedule::factor_or_one(self.schedule.as_ref(), at.since);
        if factor == 0.0 {
            return;
        }
        let (mut force, mut torque) = (factor * Vector3::from(self.force), factor * Vector3::from(self.torque));
        let mut point = self.point.map(Vector3::from);
        if self.frame == Frame::Body {
            force = body.rotation * force;
            torque = body.rotation * torque;
            point = point.map(|p| body.point(&p));
        }
        load.add_force_at(&force, &point.unwrap_or(body.position), body);
        load.torque += torque;
    }

    fn work_rate(&self, at: Moment, bodies: &[BodyMotion]) -> f64 {
        power_of(self, at, bodies)
    }
}
