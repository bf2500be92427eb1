//! A running scene: state and scratch, advanced event by event.
//!
//! ```text
//! step → open a window → find near pairs → find their times of impact → respond → record
//! ```
//!
//! Flight groups do not wait for each other: each keeps its own flight and clock. Bodies that may meet are
//! joined by a queue of what is due (see `near`); an impact concerns its cluster only. A scene without
//! contact never meets any of that.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::contact::accumulation::Accumulation;
use crate::error::{Error, Result};
use crate::freedom::Chart;
use crate::integrator::{Control, Counts, Flight, FlightError, Method};
use crate::math::sum::Time;
use crate::plan::{Compound, FlightGroup, Plan};
use crate::scene::Span;
use crate::state::{BodyMotion, BodyState};
use crate::trajectory::{Event, Heat, Phase, Trajectory};
use lasting::Together;
use near::Near;

mod answer;
pub(crate) mod clock;
mod cluster;
pub(crate) mod estimate;
mod events;
mod joints;
mod lasting;
mod lead;
mod led;
mod merge;
mod moved;
mod near;
mod observe;
mod path;
mod predict;
mod riding;
mod run;
#[cfg(feature = "serde")]
mod save;
mod step;
mod switching;
mod turn;

pub use predict::Prediction;
pub use run::{Observer, Progress};

/// A run that cannot go on. Nothing computed is lost: `trajectory` ends where the run did.
#[derive(Debug, Clone, thiserror::Error)]
#[error("t = {time} s, {}: {kind}", bodies.join(", "))]
pub struct SimulationError {
    /// Where the run ended [s].
    pub time: f64,
    /// The bodies concerned.
    pub bodies: Vec<String>,
    /// Why it ended.
    pub kind: Failure,
    /// The run up to there; none where a simulation is advanced by hand.
    pub trajectory: Option<Box<Trajectory>>,
}

/// Why a run cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Failure {
    /// See [`FlightError`].
    #[error(transparent)]
    Flight(#[from] FlightError),
    /// Bounces follow each other without end.
    #[error("AccumulatingImpacts: bounces follow each other without end; {0}")]
    AccumulatingImpacts(String),
    /// Bodies stay in a contact that this version cannot follow; why.
    #[error("LastingContact: the bodies stay in contact, which cannot be followed further: {0}")]
    LastingContact(String),
    /// The bodies overlap where they must not.
    #[error("the bodies overlap by {0:e} m")]
    Overlap(f64),
    /// The time of an impact cannot be resolved to ε.
    #[error("Stalled: no instant with a gap in 0..=ε = {0:e} m can be told; give a larger eps")]
    Stalled(f64),
    /// The measure of a user's event gave up, or is not a number: the event, and why.
    #[error("event {0}: {1}")]
    UserEvent(String, String),
    /// The measure of a user's event is too rough for its roots to be told apart.
    #[error("UnresolvedEvent: event {0}: its measure must be a smooth function of the motion")]
    UnresolvedEvent(String),
    /// A user's event happens ever faster.
    #[error("AccumulatingEvents: event {0} happens again and again without end, ever faster")]
    AccumulatingEvents(String),
    /// The load of a joint is too rough a function of time for the instant to be told at which it breaks.
    #[error("UnresolvedBreak: the load of their joint must be a smooth function of time")]
    UnresolvedBreak,
    /// The scene cannot be set up.
    #[error("{0}")]
    Refused(String),
    /// The caller asked to stop.
    #[error("interrupted")]
    Interrupted,
}

impl Failure {
    /// Whether it is the caller's own doing, which no other step would mend.
    pub(crate) fn is_final(&self) -> bool {
        matches!(self, Self::Interrupted | Self::Flight(FlightError::UserEffect(_)) | Self::UserEvent(..))
    }
}

/// Bad input, or a run that cannot go on.
#[derive(Debug, Clone, thiserror::Error)]
pub enum RunError {
    /// Bad input.
    #[error(transparent)]
    Input(#[from] Error),
    /// A run that cannot go on.
    #[error(transparent)]
    Simulation(#[from] Box<SimulationError>),
}

/// One flight group on its way.
#[derive(Debug)]
struct Lane {
    /// The group of the plan; of a compound's lane, that of its first part.
    group: usize,
    /// What flies.
    spec: Arc<FlightGroup>,
    /// The compound that flies, among all.
    compound: Option<usize>,
    flight: Box<dyn Flight>,
    /// How many flights it has begun.
    number: u64,
    /// The coordinates that the flight is written in.
    charts: Vec<Chart>,
    /// The switch ahead [s] of a step that was taken but is not yet recorded: an impact may cut it.
    pending: Option<f64>,
    /// Bodies that rest, as places in the scene.
    held: Vec<usize>,
    /// The part that the lane's body is led with, where it stays in contact and moves.
    led: Option<usize>,
    /// How many of its last steps in contact were short.
    short: u32,
    /// Work of flights that impacts have ended.
    earlier: Counts,
    /// Motions at the instant under consideration.
    motions: Vec<BodyMotion>,
    /// Where a load has a kink ahead, at which a step must end [s].
    kink: Option<f64>,
    /// How often its place has been corrected.
    corrections: u32,
    /// Ends of its steps, from the start on [s].
    nodes: Vec<f64>,
    /// Place of the lane's phase in the trajectory, and its next sample.
    phase: usize,
    cursor: usize,
    /// What is known of the user's events, in the order of the group's.
    watchers: Vec<observe::Watcher>,
    /// The loads that the state switches, in the order of the group's; where a step that was taken back must end;
    /// and the one that is due at a time [s].
    switched: Vec<switching::Switched>,
    ahead: Option<switching::Ahead>,
    due: Option<(usize, f64)>,
}

/// A running scene.
#[derive(Debug)]
pub struct Simulation {
    plan: Arc<Plan>,
    /// What decides the length of the steps, group by group.
    controls: Vec<Control>,
    time: f64,
    end: f64,
    /// One for each group of the plan, then one for each compound; those of its parts stand still.
    lanes: Vec<Lane>,
    /// Where each body flies: lane, and place in it; none of fixed bodies. Compounds stand behind the scene's bodies.
    places: Vec<Option<(usize, usize)>>,
    compounds: Vec<Compound>,
    /// What each body flies as: itself, or the compound that it is part of.
    units: Vec<usize>,
    /// Units that were made, or have come off, at the instant under consideration.
    joined: Vec<usize>,
    near: Near,
    /// Bodies that stay in contact and move, part by part.
    together: Vec<Option<Together>>,
    together_number: u64,
    /// Units that have stuck to what is fixed, for good.
    stuck: Vec<usize>,
    /// Units that ride, and the bodies on prescribed motions that they ride on.
    riders: Vec<(usize, usize)>,
    /// What holds bodies together that have stuck; and pairs that have come off and not stuck again, and when [s].
    joints: Vec<joints::Joint>,
    parted: Vec<([usize; 2], f64)>,
    /// Pairs that the laws of contact let go at the instant under consideration, and how fast they open [m/s].
    released: Vec<([usize; 2], f64)>,
    /// The last bounces of each pair, and when they would end [s].
    bounces: BTreeMap<[usize; 2], (Accumulation, Option<f64>)>,
    events: Vec<Event>,
    heat: Vec<Heat>,
    /// Work that bodies on prescribed motions do on others.
    work: Vec<Heat>,
    /// When a user's event ends the run [s], and which.
    ended: Option<(f64, String)>,
    iterations: u64,
    /// Impacts in whose cluster a point took part by `ε_touch` only.
    touch_impacts: u64,
    grain: Grain,
}

/// What a pass may do coarsely: passes that differ in it show what hangs on it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Grain {
    /// ε of contacts, in that of the options [-].
    eps: f64,
    /// Steps of contacts that last, in their own [-].
    step: f64,
    /// By how much the numbers of what is integrated and meets nothing are off at the start, as a part of each, and their
    /// changes in every step [-]: a motion may magnify roundings, also those that all passes have in common, such as
    /// those of moments of inertia.
    nudge: f64,
}

/// What numbers may be off by [-].
const NUDGE: f64 = 4.0 * f64::EPSILON;
/// The most by which a pass may be nudged more than the next finer one [-]: what methods of high order are trusted to
/// gain is more, and would stand out.
const MOST_GAIN: f64 = 64.0;
/// Steps of one body that are taken before someone who looks on is told [-]: at most some 0.1 ms of cheap ones. Larger: a
/// run that is stopped goes on for longer. Smaller: what a step costs beside the integrator shows.
const UNSEEN: f64 = 256.0;

impl Grain {
    /// What the options say.
    const FINE: Self = Self { eps: 1.0, step: 1.0, nudge: 0.0 };

    /// So many times coarser, where halving the steps divides the error by `gain`: the nudges fall alike, so that the
    /// difference of two passes shows what the finer one would be off by.
    fn times(times: f64, gain: f64) -> Self {
        let coarser = libm::pow(gain.min(MOST_GAIN), libm::log2(times));
        Self { eps: times, step: times, nudge: (coarser - 1.0) * NUDGE }
    }
}

/// Moves each number of a motion by up to a `part` of itself, in a pattern without a rhythm, so that nothing cancels.
fn nudge(chart: &Chart, motion: &mut BodyMotion, part: f64) {
    let mut y = vec![0.0; chart.dimension()];
    chart.encode(&motion.state(), &mut y);
    for (i, y) in y.iter_mut().enumerate() {
        *y *= 1.0 + part * (2.0 * (i as f64 * GOLDEN).fract() - 1.0);
    }
    chart.decode(&y, motion);
}

/// The golden section, whose multiples spread evenly over a unit [-].
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Plan {
    /// Starts the scene at time `t` [s], to be advanced by hand.
    ///
    /// # Errors
    /// A plan without a step: a tolerance is a promise about a whole run.
    pub fn start(&self, t: f64) -> Result<Simulation> {
        let Some(step) = self.options().step else {
            return Err(Error::refused("run", "a simulation that is advanced by hand needs method and step"));
        };
        if !t.is_finite() {
            return Err(Error::value("run", "start", "a finite time", t));
        }
        if let Some(event) = self.options().events.iter().find(|event| event.terminal) {
            let reason = "terminal: a simulation that is advanced by hand is ended by hand; its events tell when";
            return Err(Error::refused(event.place(), reason));
        }
        Simulation::new(
            Arc::new(self.clone()),
            Span { start: t, end: f64::INFINITY },
            self.controls(&Control::Step(step)),
            Grain::FINE,
        )
    }
}

impl Simulation {
    fn new(plan: Arc<Plan>, span: Span, controls: Vec<Control>, grain: Grain) -> Result<Self> {
        let mut lanes = Vec::new();
        for (group, spec) in plan.groups().iter().enumerate() {
            let charts = plan.charts(group, &[]);
            let mut motions: Vec<_> = spec.members.iter().map(|&i| plan.bodies()[i].start).collect();
            let is_nudged = grain.nudge > 0.0 && !spec.meets && spec.method != Method::Exact;
            if is_nudged {
                charts.iter().zip(&mut motions).for_each(|(chart, motion)| nudge(chart, motion, grain.nudge));
            }
            let mut flight = plan.flight_for(group, span.start, &controls[group], &motions, &[]);
            if is_nudged {
                flight.add_noise(grain.nudge);
            }
            let switched = plan.switched(spec, span.start)?;
            let lane = Lane::new(group, spec.clone(), flight, charts, motions, span.start);
            lanes.push(Lane { switched, phase: group, ..lane });
        }
        let mut places = vec![None; plan.bodies().len()];
        for (lane, spec) in plan.groups().iter().enumerate() {
            for (member, &body) in spec.members.iter().enumerate().filter(|(_, body)| !plan.bodies()[**body].fixed) {
                places[body] = Some((lane, member));
            }
        }
        let near = Near::default();
        Ok(Self {
            units: (0..plan.bodies().len()).collect(),
            plan,
            controls,
            time: span.start,
            end: span.end,
            lanes,
            places,
            compounds: Vec::new(),
            joined: Vec::new(),
            near,
            together: Vec::new(),
            together_number: 0,
            stuck: Vec::new(),
            riders: Vec::new(),
            joints: Vec::new(),
            parted: Vec::new(),
            released: Vec::new(),
            bounces: BTreeMap::new(),
            events: Vec::new(),
            heat: Vec::new(),
            work: Vec::new(),
            ended: None,
            iterations: 0,
            touch_impacts: 0,
            grain,
        })
    }

    /// The plan that runs.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The time to which it was advanced [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// What has happened so far, group by group.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Advances to the time `to` [s]. Steps are never shortened for it: the state at `to` is read
    /// from the motion of the step that holds it, so that advancing in pieces gives the same bits as
    /// advancing at once.
    ///
    /// # Errors
    /// Bad input, and a run that cannot go on.
    pub fn advance(&mut self, to: f64) -> Result<(), RunError> {
        if !(to >= self.time && to.is_finite()) {
            return Err(Error::value("simulation", "to", format!("a time not before {}", self.time), to).into());
        }
        self.advance_meeting(to, &mut None, &mut |_| std::ops::ControlFlow::Continue(())).map_err(Box::new)?;
        for lane in self.lanes_alone() {
            self.advance_unseen(lane, to).map_err(Box::new)?;
            while self.lanes[lane].flight.front() < to {
                self.step_lane(lane, &mut None).map_err(Box::new)?;
            }
            if let Err(error) = self.lanes[lane].flight.interpolate() {
                return Err(Box::new(self.failure(lane, self.time, error.into())).into());
            }
        }
        self.time = to;
        Ok(())
    }

    /// State of a body at the time to which the simulation was advanced.
    ///
    /// # Errors
    /// A name that no body has.
    pub fn state(&self, name: &str) -> Result<BodyState> {
        Ok(self.motion(name)?.state())
    }

    /// Motion of a body at the time to which the simulation was advanced.
    ///
    /// # Errors
    /// A name that no body has.
    pub fn motion(&self, name: &str) -> Result<BodyMotion> {
        let index = self.plan.scene().id(name)?.index();
        let Some((lane, place)) = self.places[index] else {
            return Ok(self.plan.bodies()[index].motion_at(Time::new(self.time)));
        };
        let lane = &self.lanes[lane];
        let mut motions = lane.motions.clone();
        lane.flight.at(self.time, &mut motions);
        Ok(motions[place])
    }

    /// What has been done so far.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for lane in &self.lanes {
            counts.add(&lane.earlier);
            counts.add(lane.flight.counts());
        }
        counts
    }

    /// The lanes whose bodies meet nobody.
    fn lanes_alone(&self) -> Vec<usize> {
        (0..self.lanes.len()).filter(|&lane| !self.lanes[lane].spec.meets).collect()
    }

    /// Takes the steps that nobody looks at at once: no samples, nothing to meet, and no switch on the way.
    fn advance_unseen(&mut self, index: usize, to: f64) -> Result<(), SimulationError> {
        let (plan, lane) = (&self.plan, &mut self.lanes[index]);
        let spec = lane.spec.clone();
        let front = lane.flight.front();
        let switch = spec.switches.iter().copied().find(|&s| s > front).unwrap_or(f64::INFINITY);
        if spec.meets
            || !spec.watches.is_empty()
            || !spec.toggles.is_empty()
            || plan.tolerance().is_some()
            || switch <= to
        {
            return Ok(());
        }
        let taken = lane.flight.advance_past(to, switch.min(self.end));
        taken.map_err(|error| self.failure(index, self.lanes[index].flight.front(), error.into()))
    }

    /// The same before the next sample and the time `end` [s], and no more steps than someone who looks on can wait for.
    fn skip_unseen(&mut self, index: usize, run: &Trajectory, end: f64) -> Result<(), SimulationError> {
        let Some(step) = self.plan.options().step else { return Ok(()) };
        // a pass that estimates the error takes steps twice as long
        let (lane, longest) = (&self.lanes[index], 2.0 * step);
        let front = lane.flight.front();
        let most = UNSEEN / lane.spec.members.len() as f64 * step;
        let to = (run.next_look(lane.cursor).min(end) - 2.0 * longest).min(front + most);
        if to > front { self.advance_unseen(index, to) } else { Ok(()) }
    }

    /// One step of a lane that meets nobody: step, record.
    fn step_lane(&mut self, index: usize, record: &mut Option<&mut Trajectory>) -> Result<(), SimulationError> {
        self.take_step(index, record)?;
        self.finish_step(index, record)
    }

    /// Takes one step of one lane, up to the next switch, kink, or the end of the run, so that its motion is
    /// known where someone looks at it.
    fn take_step(&mut self, index: usize, record: &Option<&mut Trajectory>) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let watched = self.watch_limit(index);
        let lane = &mut self.lanes[index];
        let spec = lane.spec.clone();
        let front = lane.flight.front();
        let switch = spec.switches.iter().copied().find(|&s| s > front).unwrap_or(f64::INFINITY);
        // a step over a kink, or over the instant that turns a load, is taken back and again, at most so many times
        loop {
            let lane = &mut self.lanes[index];
            let begin = (plan.tolerance().is_some() && lane.corrections < turn::CORRECTIONS)
                .then(|| lane.kinks_at_front(&spec))
                .flatten();
            let begun = lane.begin_switched(&spec);
            let turn = lane.ahead.map_or(f64::INFINITY, |ahead| ahead.time);
            let limit = switch.min(self.end).min(lane.kink.unwrap_or(f64::INFINITY)).min(turn).min(watched);
            if let Err(error) = lane.flight.advance(limit) {
                return Err(self.failure(index, front, error.into()));
            }
            if begin.is_some_and(|begin| lane.found_kink(&spec, &begin)) {
                continue;
            }
            if lane.kink.is_some_and(|kink| lane.flight.front() >= kink) {
                (lane.kink, lane.corrections) = (None, 0);
            }
            if !begun.map_or(Ok(false), |begun| self.find_turn(index, &begun))? {
                break;
            }
        }
        let lane = &mut self.lanes[index];
        let looked_at = record.as_ref().is_some_and(|run| run.looks_into(lane.cursor, lane.flight.front()));
        if (looked_at || spec.meets || !spec.watches.is_empty())
            && let Err(error) = lane.flight.interpolate()
        {
            return Err(self.failure(index, front, error.into()));
        }
        self.lanes[index].pending = Some(switch);
        self.find_break(index)
    }

    /// Records the step that was taken, up to where an impact may have cut it.
    fn finish_step(&mut self, index: usize, record: &mut Option<&mut Trajectory>) -> Result<(), SimulationError> {
        let Some(switch) = self.lanes[index].pending.take() else { return Ok(()) };
        self.observe(index)?;
        self.book_ride(index);
        let lane = &mut self.lanes[index];
        let front = lane.flight.front();
        if let Some(run) = record.as_mut() {
            lane.nodes.push(front);
            if lane.compound.is_some() {
                self.record_parts(index, run);
            } else if run.looks_into(lane.cursor, front) {
                let off = lane.loads_off(&lane.spec);
                lane.phase = run.phase_with(lane.phase, &off, lane.flight.segment().start);
                let mut scratch = Vec::new();
                run.record(lane.phase, lane.flight.segment(), &mut lane.cursor, &mut scratch);
            }
        }
        self.turn_due(index)?;
        let lane = &mut self.lanes[index];
        if front >= switch
            && let Err(error) = lane.flight.pass_switch()
        {
            return Err(self.failure(index, front, error.into()));
        }
        Ok(())
    }

    fn failure(&self, index: usize, time: f64, kind: Failure) -> SimulationError {
        let members = self.lanes[index].spec.members.iter().copied();
        let members: Vec<usize> = members.filter(|&i| i < self.plan.bodies().len()).collect();
        self.failure_of(&members, time, kind)
    }
}

impl Lane {
    /// A group that stands at `t` [s] with these motions, at the beginning of its flight.
    fn new(
        group: usize,
        spec: Arc<FlightGroup>,
        flight: Box<dyn Flight>,
        charts: Vec<Chart>,
        motions: Vec<BodyMotion>,
        t: f64,
    ) -> Self {
        let watchers = vec![observe::Watcher::default(); spec.watches.len()];
        Self {
            group,
            spec,
            compound: None,
            flight,
            number: 0,
            charts,
            pending: None,
            held: Vec::new(),
            led: None,
            short: 0,
            earlier: Counts::default(),
            motions,
            kink: None,
            corrections: 0,
            nodes: vec![t],
            phase: 0,
            cursor: 0,
            watchers,
            switched: Vec::new(),
            ahead: None,
            due: None,
        }
    }
}

impl Plan {
    /// The same control for every group.
    fn controls(&self, control: &Control) -> Vec<Control> {
        vec![control.clone(); self.groups().len()]
    }

    /// The phase of a group that begins at `t` [s] with these motions.
    fn phase(&self, group: usize, t: f64, motions: &[BodyMotion], held: &[usize]) -> Phase {
        Phase {
            group,
            start: t,
            charts: self.charts(group, held),
            off: Vec::new(),
            segments: Vec::new(),
            motions: motions.to_vec(),
        }
    }
}
