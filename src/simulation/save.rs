//! A running state in a file: saved, loaded, and going on with the same bits.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use super::joints::Joint;
use super::lasting::Together;
use super::led::Led;
use super::near::{Due, Window};
use super::{Grain, Lane, Simulation};
use crate::contact::accumulation::Accumulation;
use crate::error::{Error, Result};
use crate::freedom::Chart;
use crate::integrator::{Control, Counts, Front, Segment};
use crate::math::Pose;
use crate::math::sum::Time;
use crate::plan::Compound;
use crate::scene::{RunOptions, Scene, Span};
use crate::state::BodyMotion;
use crate::trajectory::{Event, Heat};

/// What a saved state holds; JSON, in which every `f64` is written so that it reads back to the bit.
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Saved {
    bryla: String,
    scene: Scene,
    options: RunOptions,
    time: f64,
    lanes: Vec<SavedLane>,
    windows: Vec<Option<Window>>,
    due: Vec<Due>,
    together: Vec<Option<Together>>,
    together_number: u64,
    stuck: Vec<usize>,
    /// Compounds in the order of their making: whether they ride, their parts, and where these stand in them.
    compounds: Vec<(bool, Vec<(usize, Pose)>)>,
    /// What each body of the scene flies as.
    units: Vec<usize>,
    riders: Vec<(usize, usize)>,
    joints: Vec<Joint>,
    parted: Vec<([usize; 2], f64)>,
    bounces: Vec<([usize; 2], Accumulation, Option<f64>)>,
    events: Vec<Event>,
    heat: Vec<Heat>,
    work: Vec<Heat>,
    iterations: u64,
    touch_impacts: u64,
}

#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedLane {
    front: Front<Vec<f64>>,
    segment: Segment,
    counts: Counts,
    earlier: Counts,
    number: u64,
    pending: Option<f64>,
    held: Vec<usize>,
    led: Option<usize>,
    motions: Vec<BodyMotion>,
    #[serde(default)]
    watchers: Vec<super::observe::Watcher>,
    #[serde(default)]
    switched: Vec<super::switching::Switched>,
}

/// Version of the file's layout.
const VERSION: &str = "state 6";

impl Simulation {
    /// Writes the running state to a file, conventionally `.bryla`.
    ///
    /// # Errors
    /// A scene with user effects, and a file that cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        self.plan.check_writable()?;
        let lanes = self.lanes.iter().map(|lane| SavedLane {
            front: lane.flight.saved_front(),
            segment: lane.flight.segment().clone(),
            counts: *lane.flight.counts(),
            earlier: lane.earlier,
            number: lane.number,
            // a switch that never comes has no number in a file
            pending: lane.pending.map(|switch| switch.min(f64::MAX)),
            held: lane.held.clone(),
            led: lane.led,
            motions: lane.motions.clone(),
            watchers: lane.watchers.clone(),
            switched: lane.switched.clone(),
        });
        let compounds = self.compounds.iter();
        let parts = |compound: &Compound| compound.parts.iter().map(|part| (part.body, part.pose)).collect();
        let compounds = compounds.map(|compound| (compound.rides, parts(compound)));
        let saved = Saved {
            bryla: VERSION.to_owned(),
            scene: self.plan.scene().clone(),
            options: self.plan.options().clone(),
            time: self.time,
            lanes: lanes.collect(),
            windows: self.near.windows.clone(),
            due: self.near.due.clone().into_sorted_vec(),
            together: self.together.clone(),
            together_number: self.together_number,
            stuck: self.stuck.clone(),
            compounds: compounds.collect(),
            units: self.units[..self.plan.bodies().len()].to_vec(),
            riders: self.riders.clone(),
            joints: self.joints.clone(),
            parted: self.parted.clone(),
            bounces: self.bounces.iter().map(|(&pair, (times, end))| (pair, *times, *end)).collect(),
            events: self.events.clone(),
            heat: self.heat.clone(),
            work: self.work.clone(),
            iterations: self.iterations,
            touch_impacts: self.touch_impacts,
        };
        let path = path.as_ref();
        let text = serde_json::to_string(&saved).map_err(|error| file_error(path, &error))?;
        fs::write(path, text).map_err(|error| file_error(path, &error))
    }

    /// Loads a running state; it goes on with the same bits as the run that was saved.
    ///
    /// # Errors
    /// A file that cannot be read, or is no saved state.
    pub fn resume(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let text = fs::read_to_string(path).map_err(|error| file_error(path, &error))?;
        let saved: Saved = serde_json::from_str(&text).map_err(|error| file_error(path, &error))?;
        if saved.bryla != VERSION {
            return Err(file_error(path, &format!("not a saved state of this version ({VERSION}): {}", saved.bryla)));
        }
        let plan = Arc::new(saved.scene.compile(&saved.options)?);
        let step = saved.options.step.ok_or_else(|| file_error(path, &"no step in it"))?;
        let span = Span { start: saved.time, end: f64::INFINITY };
        let mut simulation = Self::new(plan.clone(), span, plan.controls(&Control::Step(step)), Grain::FINE)?;
        let belongs = || file_error(path, &"its state does not belong to its scene");
        for (rides, parts) in saved.compounds {
            if parts.len() < if rides { 1 } else { 2 }
                || parts.iter().any(|(body, _)| plan.bodies().get(*body).is_none_or(|body| body.fixed))
            {
                return Err(belongs());
            }
            simulation.join(&parts, rides, Time::new(saved.time))?;
        }
        simulation.joined.clear();
        simulation.return_units(&saved.units).ok_or_else(belongs)?;
        let knows = |body: &usize| *body < plan.bodies().len();
        if saved.riders.iter().any(|(unit, driver)| *unit >= simulation.places.len() || !knows(driver)) {
            return Err(belongs());
        }
        if !saved
            .joints
            .iter()
            .map(|joint| &joint.bodies)
            .chain(saved.parted.iter().map(|(pair, _)| pair))
            .flatten()
            .all(knows)
        {
            return Err(belongs());
        }
        if saved.lanes.len() != simulation.lanes.len() {
            return Err(belongs());
        }
        for (lane, saved) in saved.lanes.into_iter().enumerate() {
            simulation.lanes[lane].held.clone_from(&saved.held);
            let charts = simulation.charts_of(lane)?;
            simulation.lanes[lane].continue_from(&plan, charts, step, saved).ok_or_else(belongs)?;
        }
        simulation.near.restore(saved.windows, saved.due);
        simulation.together = saved.together;
        simulation.together_number = saved.together_number;
        simulation.stuck = saved.stuck;
        simulation.riders = saved.riders;
        simulation.joints = saved.joints;
        simulation.parted = saved.parted;
        simulation.bounces = saved.bounces.into_iter().map(|(pair, times, end)| (pair, (times, end))).collect();
        simulation.events = saved.events;
        simulation.heat = saved.heat;
        simulation.work = saved.work;
        simulation.iterations = saved.iterations;
        simulation.touch_impacts = saved.touch_impacts;
        Ok(simulation)
    }
}

impl Simulation {
    /// Lets every body fly as what it was saved as: itself, or a compound that it has become part of; none where this
    /// cannot be.
    fn return_units(&mut self, units: &[usize]) -> Option<()> {
        let bodies = self.plan.bodies().len();
        if units.len() != bodies {
            return None;
        }
        for (body, &unit) in units.iter().enumerate() {
            let lane = match unit.checked_sub(bodies) {
                None if unit == body => self.plan.groups().iter().position(|group| group.members.contains(&body)),
                None => return None,
                Some(compound) => {
                    let is_part = self.compounds.get(compound)?.parts.iter().any(|part| part.body == body);
                    Some(self.places.get(unit).copied().flatten()?.0).filter(|_| is_part)
                }
            };
            self.units[body] = unit;
            if self.places[body].is_some() {
                let lane = lane?;
                let place = self.lanes[lane].spec.members.iter().position(|&member| member == body)?;
                self.places[body] = Some((lane, place));
            }
        }
        Some(())
    }
}

impl Lane {
    /// Takes over a saved lane; none where its numbers do not fit.
    fn continue_from(
        &mut self,
        plan: &crate::plan::Plan,
        charts: Vec<Chart>,
        step: f64,
        saved: SavedLane,
    ) -> Option<()> {
        let fits = saved.motions.len() == self.motions.len()
            && saved.watchers.len() == self.watchers.len()
            && saved.switched.len() == self.switched.len();
        if !fits {
            return None;
        }
        let (t, motions) = (saved.front.time, &saved.motions);
        self.flight = if saved.led.is_some() {
            Box::new(Led::new(charts.clone(), t, motions))
        } else {
            plan.flight_of(&self.spec, t.value, &Control::Step(step), charts.clone(), motions)
        };
        self.charts = charts;
        let n = self.flight.saved_front().y.len();
        if saved.front.y.len() != n || saved.front.rest.len() != n || !saved.segment.fits(n) {
            return None;
        }
        self.flight.resume(&saved.front, saved.segment, saved.counts);
        self.earlier = saved.earlier;
        (self.number, self.pending) = (saved.number, saved.pending);
        (self.held, self.led) = (saved.held, saved.led);
        self.motions = saved.motions;
        self.watchers = saved.watchers;
        self.switched = saved.switched;
        Some(())
    }
}

fn file_error(path: &Path, reason: &dyn ToString) -> Error {
    Error::File { path: path.display().to_string(), reason: reason.to_string() }
}
