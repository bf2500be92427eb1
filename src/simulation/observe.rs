//! Events of the user: measures of the motion, watched along every step.
//!
//! A step is looked at once its end is settled, before it is recorded. Events do not touch the motion; one that ends
//! the run leaves the step whole, and what lies behind it is cut off in the end.

use super::{Failure, Simulation, SimulationError};
use crate::math::roots::{NoRoots, Track, find_roots};
use crate::tolerance::{EVENTS_ACCUMULATE, EVENTS_SHRINKING};
use crate::trajectory::{Event, EventKind};

/// What is known of one event up to the front.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Watcher {
    track: Track,
    rhythm: Rhythm,
}

/// How fast instants follow each other.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Rhythm {
    /// The last instant [s].
    last: Option<f64>,
    /// The last interval [s], the longest of those that shrank down to it, and how many they are.
    interval: f64,
    longest: f64,
    shrinking: u32,
    /// How many instants are the same.
    at_once: u32,
}

impl Rhythm {
    /// How many of the last instants are one.
    pub(super) fn at_once(&self) -> u32 {
        self.at_once
    }

    /// Whether the instants run up to a limit, this one being the next.
    pub(super) fn accumulates(&mut self, time: f64) -> bool {
        let Some(last) = self.last.replace(time) else { return false };
        let interval = time - last;
        self.at_once = if interval > 0.0 { 0 } else { self.at_once + 1 };
        if self.longest > 0.0 && interval <= self.interval {
            self.shrinking += 1;
        } else {
            (self.longest, self.shrinking) = (interval, 0);
        }
        self.interval = interval;
        self.shrinking >= EVENTS_SHRINKING && interval <= EVENTS_ACCUMULATE * self.longest
    }
}

impl Simulation {
    /// Looks for the user's events in the last step of a lane, up to its front.
    pub(super) fn observe(&mut self, index: usize) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let lane = &mut self.lanes[index];
        let spec = lane.spec.clone();
        if spec.watches.is_empty() {
            return Ok(());
        }
        let segment = lane.flight.segment();
        let whole = segment.end >= segment.start + segment.length;
        let length = if whole { segment.length } else { segment.end - segment.start };
        let (start, end) = (segment.start, segment.end);
        let resolution = f64::EPSILON * start.abs().max(end.abs());
        let mut motions = lane.motions.clone();
        let mut broken = None;
        for (watch, watcher) in spec.watches.iter().zip(&mut lane.watchers) {
            let event = &plan.options().events[watch.event];
            let seen = |motions: &[_]| watch.members.iter().map(|&i| motions[i]).collect::<Vec<_>>();
            lane.flight.at_offset(0.0, &mut motions);
            let size = event.measure.size(&seen(&motions)) + event.value.abs();
            let mut complaint = None;
            let mut g = |offset: f64| {
                lane.flight.at_offset(offset, &mut motions);
                match event.measure.value(start + offset, &seen(&motions)) {
                    Ok(measured) => measured - event.value,
                    Err(message) => {
                        complaint.get_or_insert(message);
                        f64::NAN
                    }
                }
            };

            let name = || event.name.clone();
            let roots = match find_roots(&mut g, length, size, resolution, &mut watcher.track) {
                Ok(roots) => roots,
                Err(NoRoots::NotFinite) => {
                    let reason = complaint.unwrap_or_else(|| "its measure is not a finite number".to_owned());
                    broken = Some((start, Failure::UserEvent(name(), reason)));
                    break;
                }
                Err(NoRoots::Unresolved) => {
                    broken = Some((start, Failure::UnresolvedEvent(name())));
                    break;
                }
            };
            let bodies =
                [watch.members.first(), watch.members.last()].map(|member| spec.members[*member.unwrap_or(&0)]);
            for root in roots.into_iter().filter(|root| event.direction.counts(root.passage)) {
                let time = start + root.at;
                self.events.push(Event::watched(time, EventKind::User, name(), root.passage, bodies));
                if event.terminal && self.ended.as_ref().is_none_or(|(ended, _)| time < *ended) {
                    self.ended = Some((time, name()));
                }
                if watcher.rhythm.accumulates(time) {
                    broken = Some((time, Failure::AccumulatingEvents(name())));
                    break;
                }
            }
        }
        // what lies behind the end of the run breaks nothing
        match broken {
            Some((time, kind)) if self.ended.as_ref().is_none_or(|(ended, _)| time < *ended) => {
                Err(self.failure(index, time, kind))
            }
            _ => Ok(()),
        }
    }
}
