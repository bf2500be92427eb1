//! A running scene: state and scratch, advanced step by step.
//!
//! ```text
//! for each flight group:  step → find touching pairs → find the time of impact → respond → record
//! ```
//!
//! Groups do not wait for each other: each keeps its own flight and clock.

use std::sync::Arc;

use crate::contact::{Answer, Response, bounce, stick};
use crate::error::{Error, Result};
use crate::impact::{Outcome, find_impact};
use crate::integrator::{Control, Counts, Flight, FlightError};
use crate::math::Vector3;
use crate::plan::{EPS_ROUNDING, Pair, Plan};
use crate::scene::Span;
use crate::state::{BodyMotion, BodyState};
use crate::tolerance::{IMPACT_GAP, TOUCH_GAP};
use crate::trajectory::{Event, EventKind, Phase, Trajectory};

pub(crate) mod clock;
pub(crate) mod estimate;
mod observe;
mod predict;
mod run;
#[cfg(feature = "serde")]
mod save;
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
    /// Bounces follow each other ever faster, or the bodies rest on each other.
    #[error("AccumulatingImpacts: bounces follow each other without end, or the bodies rest on each other; {0}")]
    AccumulatingImpacts(String),
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
    group: usize,
    flight: Box<dyn Flight>,
    /// Bodies that stick to a fixed one, as places in the scene.
    held: Vec<usize>,
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
    lanes: Vec<Lane>,
    events: Vec<Event>,
    /// When a user's event ends the run [s], and which.
    ended: Option<(f64, String)>,
    iterations: u64,
}

/// Impulses at one instant after which a body is said to rest [-]. Two planes that answer each
/// other with e < 1 are done to rounding after about 50.
const ROUNDS_AT_ONCE: u32 = 64;

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
        )
    }
}

impl Simulation {
    fn new(plan: Arc<Plan>, span: Span, controls: Vec<Control>) -> Result<Self> {
        let mut lanes = Vec::new();
        for (group, spec) in plan.groups().iter().enumerate() {
            let motions: Vec<_> = spec.members.iter().map(|&i| plan.bodies()[i].start).collect();
            let flight = plan.flight_for(group, span.start, &controls[group], &motions, &[])?;
            lanes.push(Lane {
                group,
                flight,
                held: Vec::new(),
                earlier: Counts::default(),
                motions,
                kink: None,
                corrections: 0,
                nodes: vec![span.start],
                phase: group,
                cursor: 0,
                watchers: vec![observe::Watcher::default(); spec.watches.len()],
                switched: plan.switched(spec, span.start)?,
                ahead: None,
                due: None,
            });
        }
        let (events, ended) = (Vec::new(), None);
        Ok(Self { plan, controls, time: span.start, end: span.end, lanes, events, ended, iterations: 0 })
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
        for lane in 0..self.lanes.len() {
            self.advance_lane(lane, to, &mut None).map_err(Box::new)?;
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
        for lane in &self.lanes {
            let members = &self.plan.groups()[lane.group].members;
            if let Some(place) = members.iter().position(|&i| i == index && !self.plan.bodies()[i].fixed) {
                let mut motions = lane.motions.clone();
                lane.flight.at(self.time, &mut motions);
                return Ok(motions[place]);
            }
        }
        Ok(self.plan.bodies()[index].start)
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

    /// Advances one lane until its motion is known at `to` [s].
    fn advance_lane(
        &mut self,
        lane: usize,
        to: f64,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        self.answer_touches(lane, 0, record)?;
        if record.is_none() {
            self.advance_unseen(lane, to)?;
        }
        while self.lanes[lane].flight.front() < to {
            self.step_lane(lane, record)?;
        }
        Ok(())
    }

    /// Takes the steps that nobody looks at at once: no samples, nothing to meet, and no switch on the way.
    fn advance_unseen(&mut self, index: usize, to: f64) -> Result<(), SimulationError> {
        let (plan, lane) = (&self.plan, &mut self.lanes[index]);
        let spec = &plan.groups()[lane.group];
        let front = lane.flight.front();
        let switch = spec.switches.iter().copied().find(|&s| s > front).unwrap_or(f64::INFINITY);
        if !spec.pairs.is_empty()
            || !spec.watches.is_empty()
            || !spec.toggles.is_empty()
            || plan.tolerance().is_some()
            || switch <= to
        {
            return Ok(());
        }
        let taken = lane.flight.advance_past(to, switch.min(self.end));
        taken.map_err(|error| self.failure(index, front, error.into()))
    }

    /// One step of one lane: step, find touching pairs, find the time of impact, respond, record.
    fn step_lane(&mut self, index: usize, record: &mut Option<&mut Trajectory>) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let lane = &mut self.lanes[index];
        let spec = &plan.groups()[lane.group];

        // a step ends at the next switch, at a kink, or at the end of the run
        let front = lane.flight.front();
        let switch = spec.switches.iter().copied().find(|&s| s > front).unwrap_or(f64::INFINITY);
        let begin = (plan.tolerance().is_some() && lane.corrections < turn::CORRECTIONS)
            .then(|| lane.kinks_at_front(spec))
            .flatten();
        let begun = lane.begin_switched(spec);
        let turn = lane.ahead.map_or(f64::INFINITY, |ahead| ahead.time);
        let limit = switch.min(self.end).min(lane.kink.unwrap_or(f64::INFINITY)).min(turn);
        if let Err(error) = lane.flight.advance(limit) {
            return Err(self.failure(index, front, error.into()));
        }
        if begin.is_some_and(|begin| lane.found_kink(spec, &begin)) {
            return Ok(());
        }
        if lane.kink.is_some_and(|kink| lane.flight.front() >= kink) {
            (lane.kink, lane.corrections) = (None, 0);
        }

        if let Some(begun) = begun
            && self.find_turn(index, &begun)?
        {
            return Ok(());
        }

        // the motion within the step, where someone looks at it
        let lane = &mut self.lanes[index];
        let looked_at = record.as_ref().is_some_and(|run| run.looks_into(lane.cursor, lane.flight.front()));
        if (looked_at || !spec.pairs.is_empty() || !spec.watches.is_empty())
            && let Err(error) = lane.flight.interpolate()
        {
            return Err(self.failure(index, front, error.into()));
        }

        // the first of the pairs that touch within the step cuts it
        let first = self.first_impact(index, &spec.pairs)?;
        let lane = &mut self.lanes[index];
        if let Some((offset, iterations)) = first {
            lane.flight.cut(offset);
            self.iterations += u64::from(iterations);
        }
        self.observe(index)?;
        let lane = &mut self.lanes[index];
        if record.is_some() {
            lane.nodes.push(lane.flight.front());
        }
        if let (Some(run), true) = (record.as_mut(), looked_at) {
            let off = lane.loads_off(spec);
            lane.phase = run.phase_with(lane.phase, &off, lane.flight.segment().start);
            let mut scratch = Vec::new();
            run.record(lane.phase, lane.flight.segment(), &mut lane.cursor, &mut scratch);
        }
        self.turn_due(index)?;
        if let Some((_, iterations)) = first {
            return self.answer_touches(index, iterations, record);
        }
        let lane = &mut self.lanes[index];
        if lane.flight.front() >= switch
            && let Err(error) = lane.flight.pass_switch()
        {
            return Err(self.failure(index, front, error.into()));
        }
        Ok(())
    }

    /// Gap at which a contact of the pair is accepted [m].
    fn eps(&self, pair: &Pair, motion: &BodyMotion) -> f64 {
        let coordinates = motion.position.amax() + pair.plane.offset.abs() + pair.size;
        self.plan.options().eps.unwrap_or(IMPACT_GAP * pair.size).max(EPS_ROUNDING * coordinates)
    }

    /// The earliest impact within the last step: time from the step's start [s], rounds of the finder.
    fn first_impact(&self, index: usize, pairs: &[Pair]) -> Result<Option<(f64, u32)>, SimulationError> {
        let lane = &self.lanes[index];
        let segment = lane.flight.segment();
        let mut motions = lane.motions.clone();
        let mut first: Option<(f64, u32)> = None;
        for pair in self.active(index, pairs) {
            let eps = self.eps(pair, &motions[pair.member]);
            let gap = |offset: f64| {
                lane.flight.at_offset(offset, &mut motions);
                pair.collider.gap(&motions[pair.member], &pair.plane)
            };
            let found = find_impact(gap, segment.length, eps, self.plan.options().finder);
            match found.outcome {
                Outcome::Clear => {}
                Outcome::At(t) => {
                    if first.is_none_or(|(earliest, _)| t < earliest) {
                        first = Some((t, found.iterations));
                    }
                }
                Outcome::AlreadyTouching => {
                    let why = format!("the gap stays within ε = {eps:e} m");
                    return Err(self.pair_failure(index, pair, segment.start, Failure::AccumulatingImpacts(why)));
                }
                Outcome::Overlap(depth) => {
                    return Err(self.pair_failure(index, pair, segment.start, Failure::Overlap(depth)));
                }
                Outcome::Stalled(t) => {
                    return Err(self.pair_failure(index, pair, segment.start + t, Failure::Stalled(eps)));
                }
            }
        }
        Ok(first)
    }

    /// The pairs whose body still moves.
    fn active<'a>(&self, index: usize, pairs: &'a [Pair]) -> impl Iterator<Item = &'a Pair> + use<'a, '_> {
        let lane = &self.lanes[index];
        let members = &self.plan.groups()[lane.group].members;
        pairs.iter().filter(move |pair| !lane.held.contains(&members[pair.member]))
    }

    /// Answers every pair that touches and approaches at the front, until none approaches.
    fn answer_touches(
        &mut self,
        index: usize,
        iterations: u32,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let pairs = &plan.groups()[self.lanes[index].group].pairs;
        if pairs.is_empty() {
            return Ok(());
        }
        for _ in 0..ROUNDS_AT_ONCE {
            let lane = &mut self.lanes[index];
            let time = lane.flight.front();
            let mut motions = lane.motions.clone();
            lane.flight.at(time, &mut motions);
            let Some((pair, touching)) = self.active(index, pairs).find_map(|pair| {
                let motion = &motions[pair.member];
                let gap = pair.collider.gap(motion, &pair.plane);
                let eps = self.eps(pair, motion);
                (gap <= eps)
                    .then(|| (pair, approaching(pair, motion, gap.max(0.0) + TOUCH_GAP * pair.size)))
                    .filter(|(_, touching)| !touching.is_empty())
            }) else {
                return Ok(());
            };
            self.answer(index, pair, &touching, &mut motions, iterations, record)?;
        }
        let why = format!("{ROUNDS_AT_ONCE} impulses at one instant");
        let pair = &pairs[0];
        Err(self.pair_failure(index, pair, self.lanes[index].flight.front(), Failure::AccumulatingImpacts(why)))
    }

    /// Answers one touch: bounce or stick, and books the event.
    fn answer(
        &mut self,
        index: usize,
        pair: &Pair,
        touching: &[(usize, Vector3)],
        motions: &mut [BodyMotion],
        iterations: u32,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let lane = &mut self.lanes[index];
        let body = plan.groups()[lane.group].members[pair.member];
        let time = lane.flight.front();
        let motion = &mut motions[pair.member];
        let before = *motion;
        let point = touching.iter().map(|(_, p)| p).sum::<Vector3>() / touching.len() as f64;

        let Answer { impulse, energy_lost } = match pair.material.response {
            Response::Bounce => {
                let inverse = plan.bodies()[body].properties.inv_inertia();
                bounce::bounce(motion, &inverse, &point, &pair.plane.normal, pair.material.restitution)
            }
            Response::Stick => stick::stick(motion),
        };
        let after = *motion;
        if pair.material.response == Response::Stick {
            lane.held.push(body);
        }

        // the flight goes on from the new motion; where bodies are held, with fewer coordinates
        lane.earlier.add(lane.flight.counts());
        let failed = |error: Error| SimulationError {
            time,
            bodies: vec![plan.bodies()[body].name.clone()],
            kind: Failure::Refused(error.to_string()),
            trajectory: None,
        };
        let (exact, since) = lane.flight.clock();
        lane.flight =
            plan.flight_for(lane.group, time, &self.controls[lane.group], motions, &lane.held).map_err(failed)?;
        lane.flight.set_clock(exact, since);
        lane.motions.copy_from_slice(motions);
        if let (Some(run), Response::Stick) = (record, pair.material.response) {
            lane.phase = run.phases.len();
            run.phases.push(plan.phase(lane.group, time, motions, &lane.held).map_err(failed)?);
        }

        let numbers: Vec<_> = touching.iter().map(|(i, _)| *i).collect();
        self.events.push(Event {
            time,
            kind: match pair.material.response {
                Response::Bounce => EventKind::Bounce,
                Response::Stick => EventKind::Stick,
            },
            name: String::new(),
            passage: None,
            bodies: [pair.obstacle, body],
            point,
            normal: pair.plane.normal,
            impulse,
            features: pair.collider.features(&numbers),
            iterations,
            velocity: [before.velocity, after.velocity],
            angular_velocity: [before.angular_velocity, after.angular_velocity],
            energy_lost,
        });
        Ok(())
    }

    fn pair_failure(&self, index: usize, pair: &Pair, time: f64, kind: Failure) -> SimulationError {
        let members = &self.plan.groups()[self.lanes[index].group].members;
        let bodies = [members[pair.member], pair.obstacle].map(|i| self.plan.bodies()[i].name.clone()).to_vec();
        SimulationError { time, bodies, kind, trajectory: None }
    }

    fn failure(&self, index: usize, time: f64, kind: Failure) -> SimulationError {
        let members = &self.plan.groups()[self.lanes[index].group].members;
        let bodies = members.iter().map(|&i| self.plan.bodies()[i].name.clone()).collect();
        SimulationError { time, bodies, kind, trajectory: None }
    }
}

/// The touching points of a pair that approach each other, within `reach` [m] of the plane.
fn approaching(pair: &Pair, motion: &BodyMotion, reach: f64) -> Vec<(usize, Vector3)> {
    let rounding = EPS_ROUNDING * (motion.velocity.norm() + motion.angular_velocity.norm() * pair.size);
    let mut touching = pair.collider.touching(motion, &pair.plane, reach);
    touching.retain(|(_, p)| pair.plane.normal.dot(&motion.velocity_at(p)) < -rounding);
    touching
}

impl Plan {
    /// The same control for every group.
    fn controls(&self, control: &Control) -> Vec<Control> {
        vec![control.clone(); self.groups().len()]
    }

    /// The phase of a group that begins at `t` [s] with these motions.
    fn phase(&self, group: usize, t: f64, motions: &[BodyMotion], held: &[usize]) -> Result<Phase> {
        Ok(Phase {
            group,
            start: t,
            charts: self.charts(group, held)?,
            off: Vec::new(),
            segments: Vec::new(),
            motions: motions.to_vec(),
        })
    }
}
