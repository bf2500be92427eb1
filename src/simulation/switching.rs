//! Loads that the state turns on and off.
//!
//! The instant is told from the motion of the step that holds it; then the step is taken back, and taken again up to
//! that instant. What the measure lacks there corrects it, so that the instant is as good as the method, not only as
//! the motion between steps. Then the load is turned, and the method starts anew.

use super::{Failure, Lane, Simulation, SimulationError};
use crate::error::{Error, Result};
use crate::integrator::{Front, Segment};
use crate::math::roots::{NoRoots, Passage, Track, find_roots};
use crate::plan::{FlightGroup, Plan, Toggle};
use crate::simulation::observe::Rhythm;
use crate::state::BodyMotion;
use crate::trajectory::{Event, EventKind};

/// A load that the state switches, as it stands.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Switched {
    on: bool,
    track: Track,
    rhythm: Rhythm,
}

/// Where a step that was taken back must end when it is taken again, and what is turned there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ahead {
    which: usize,
    /// When [s].
    pub(super) time: f64,
    corrections: u32,
}

/// A front that a step can be taken back to.
pub(super) struct Begun(Front<Vec<f64>>);

/// Most corrections of one instant [-]: each leaves the square of the error before.
const CORRECTIONS: u32 = 4;
/// Rounding of a measure at the front, as a part of what it is worked out from [-].
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Part of a step over which the slope of a measure is taken [-].
const SLOPE: f64 = 1.0e-3;
/// Turns at one instant after which loads are said to turn each other for ever [-].
const TURNS_AT_ONCE: u32 = 64;

impl Plan {
    /// The switched loads of a group at the start `t` [s].
    pub(super) fn switched(&self, group: &FlightGroup, t: f64) -> Result<Vec<Switched>> {
        let begin = |toggle: &Toggle| {
            let body = &self.bodies()[group.members[toggle.member]];
            let on = toggle.switch.begins(t, &body.start).map_err(|why| Error::refused(&toggle.name, why))?;
            Ok(Switched { on, track: Track::default(), rhythm: Rhythm::default() })
        };
        group.toggles.iter().map(begin).collect()
    }
}

impl Lane {
    /// The effects that are off, as places in the scene.
    pub(super) fn loads_off(&self, spec: &FlightGroup) -> Vec<usize> {
        let off = spec.toggles.iter().zip(&self.switched).filter(|(_, state)| !state.on);
        off.map(|(toggle, _)| toggle.effect).collect()
    }

    /// Begins a step of a lane whose loads are switched: the flight may be a new one since the last.
    pub(super) fn begin_switched(&mut self, spec: &FlightGroup) -> Option<Begun> {
        if spec.toggles.is_empty() {
            return None;
        }
        let off = self.loads_off(spec);
        self.flight.leave_out(&off);
        Some(Begun(self.flight.saved_front()))
    }

    /// Takes the last step back.
    fn take_back(&mut self, begun: &Begun) {
        let mut counts = *self.flight.counts();
        counts.steps -= 1;
        counts.rejected += 1;
        self.flight.resume(&begun.0, Segment::default(), counts);
    }

    /// A measure less the value that turns its load, at a time from the start of the last step [s].
    fn lack(&self, toggle: &Toggle, on: bool, offset: f64, motions: &mut [BodyMotion]) -> Result<f64, String> {
        self.flight.at_offset(offset, motions);
        let body = std::slice::from_ref(&motions[toggle.member]);
        let time = self.flight.segment().start + offset;
        toggle.switch.measure.value(time, body).map(|measured| measured - toggle.switch.next(on).0)
    }
}

impl Simulation {
    /// Looks whether a load is turned within the last step. If so the step is taken back, to end there when it is
    /// taken again; true then.
    pub(super) fn find_turn(&mut self, index: usize, begun: &Begun) -> Result<bool, SimulationError> {
        let lane = &mut self.lanes[index];
        let spec = lane.spec.clone();
        let arrived = lane.ahead.take().filter(|ahead| lane.flight.front() >= ahead.time);
        if let Err(error) = lane.flight.interpolate() {
            let time = begun.0.time.value;
            return Err(self.failure(index, time, error.into()));
        }
        let (start, length) = (lane.flight.segment().start, lane.flight.segment().length);
        let resolution = f64::EPSILON * start.abs().max(lane.flight.front().abs());
        let mut motions = lane.motions.clone();

        // the first of the loads that are turned; the one that the step was to end at is not searched for
        let mut first: Option<(usize, f64)> = None;
        let mut tracks = Vec::new();
        for (which, toggle) in spec.toggles.iter().enumerate() {
            let Switched { on, mut track, .. } = lane.switched[which];
            if arrived.is_some_and(|ahead| ahead.which == which) {
                tracks.push(track);
                continue;
            }
            lane.flight.at_offset(0.0, &mut motions);
            let (value, rises) = toggle.switch.next(on);
            let body = std::slice::from_ref(&motions[toggle.member]);
            let size = toggle.switch.measure.size(body) + value.abs();
            let mut complaint = None;
            let mut g = |offset: f64| {
                lane.lack(toggle, on, offset, &mut motions).unwrap_or_else(|message| {
                    complaint.get_or_insert(message);
                    f64::NAN
                })
            };
            let roots = match find_roots(&mut g, length, size, resolution, &mut track) {
                Ok(roots) => roots,
                Err(why) => {
                    let name = toggle.name.clone();
                    let not_finite = || "its measure is not a finite number".to_owned();
                    let kind = match why {
                        NoRoots::NotFinite => Failure::UserEvent(name, complaint.unwrap_or_else(not_finite)),
                        NoRoots::Unresolved => Failure::UnresolvedEvent(name),
                    };
                    return Err(self.failure(index, start, kind));
                }
            };
            // a touch counts: another load that is turned at the same instant may turn the motion back
            let against = if rises { Passage::Falling } else { Passage::Rising };
            if let Some(root) = roots.iter().find(|root| root.passage != against)
                && first.is_none_or(|(_, earliest)| root.at < earliest)
            {
                first = Some((which, root.at));
            }
            tracks.push(track);
        }
        if let Some((which, offset)) = first {
            lane.take_back(begun);
            if offset <= 4.0 * resolution {
                // an impact or another load has put the measure beyond its value
                self.turn(index, which)?;
            } else {
                lane.ahead = Some(Ahead { which, time: start + offset, corrections: 0 });
            }
            return Ok(true);
        }

        // where the step was to end, the measure must have its value; else what it lacks tells where it has
        if let Some(Ahead { which, time, corrections }) = arrived {
            let (toggle, on) = (&spec.toggles[which], lane.switched[which].on);
            let ends = [1.0 - SLOPE, 1.0].map(|part| lane.lack(toggle, on, part * length, &mut motions));
            if let [Ok(before), Ok(lack)] = ends {
                lane.flight.at(lane.flight.front(), &mut motions);
                let size = toggle.switch.measure.size(std::slice::from_ref(&motions[toggle.member]));
                let by = -lack * SLOPE * length / (lack - before);
                let lacking = lack.abs() > ROUNDING * (size + toggle.switch.next(on).0.abs());
                let near = by.abs() < 0.5 * length && by.abs() > resolution;
                if lacking && near && corrections < CORRECTIONS {
                    lane.take_back(begun);
                    lane.ahead = Some(Ahead { which, time: time + by, corrections: corrections + 1 });
                    return Ok(true);
                }
            }
            lane.due = Some((which, time));
        }
        for (state, track) in lane.switched.iter_mut().zip(tracks) {
            state.track = track;
        }
        Ok(false)
    }

    /// Turns the load that is due at the front, unless an impact has cut the step before.
    pub(super) fn turn_due(&mut self, index: usize) -> Result<(), SimulationError> {
        let lane = &mut self.lanes[index];
        match lane.due.take() {
            Some((which, time)) if lane.flight.front() >= time => self.turn(index, which),
            _ => Ok(()),
        }
    }

    /// Turns a load at the front.
    fn turn(&mut self, index: usize, which: usize) -> Result<(), SimulationError> {
        let lane = &mut self.lanes[index];
        let spec = lane.spec.clone();
        let (toggle, state) = (&spec.toggles[which], &mut lane.switched[which]);
        let time = lane.flight.front();
        let passage = if toggle.switch.next(state.on).1 { Passage::Rising } else { Passage::Falling };
        (state.on, state.track) = (!state.on, Track::default());
        let on = if state.on { "on" } else { "off" };
        let accumulates = state.rhythm.accumulates(time) || state.rhythm.at_once() >= TURNS_AT_ONCE;
        let bodies = [spec.members[toggle.member]; 2];
        self.events.push(Event::watched(time, EventKind::Switch, format!("{} {on}", toggle.name), passage, bodies));
        if accumulates {
            return Err(self.failure(index, time, Failure::AccumulatingEvents(toggle.name.clone())));
        }
        Ok(())
    }
}
