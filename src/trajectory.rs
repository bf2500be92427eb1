//! What a run leaves behind: samples, the motion of every step, and what happened on the way.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::freedom::Chart;
use crate::freedom::riding::follow;
use crate::integrator::{Problem, Segment};
use crate::math::sum::Time;
use crate::math::{Pose, Vector3};
use crate::plan::{Any, Binding, Group, Plan};
use crate::report::Report;
use crate::scene::{BodyId, Record};
use crate::state::{BodyMotion, BodyState, Load, Moment};

mod event;
mod heat;
#[cfg(feature = "serde")]
mod saved;

pub use event::{Event, EventKind};
pub(crate) use heat::Heat;

/// The motion of a group while its bodies keep their coordinates.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Phase {
    pub(crate) group: usize,
    pub(crate) start: f64,
    pub(crate) charts: Vec<Chart>,
    /// Effects that the state has turned off, as places in the scene.
    #[cfg_attr(feature = "serde", serde(default))]
    pub(crate) off: Vec<usize>,
    pub(crate) segments: Vec<Segment>,
    /// The motions it started with; they stay where there is nothing to integrate. Where the group's body is part
    /// of a compound, this stands before it, as in `charts`.
    pub(crate) motions: Vec<BodyMotion>,
}

impl Phase {
    /// Whether the group's body is part of a compound.
    pub(crate) fn has_parts(&self) -> bool {
        self.charts.iter().any(|chart| matches!(chart, Chart::Riding(_)))
    }

    /// The motions of the group's members at `t` [s], from a segment that holds it.
    fn read(&self, segment: &Segment, t: f64, motions: &mut Vec<BodyMotion>) {
        motions.clone_from(&self.motions);
        let mut y = vec![0.0; segment.dimension];
        segment.at(t, &mut y);
        decode(&self.charts, &y, motions);
        self.leave_compound(motions);
    }

    /// Of all motions those of the group's members.
    fn leave_compound(&self, motions: &mut Vec<BodyMotion>) {
        if self.has_parts() {
            motions.remove(0);
        }
    }

    /// The same at any time of the phase; the last state stays after its end.
    fn at(&self, t: f64, motions: &mut Vec<BodyMotion>) {
        let after = self.segments.partition_point(|segment| segment.end <= t);
        if let Some(segment) = self.segments.get(after).or(self.segments.last()) {
            return self.read(segment, t.clamp(segment.start, segment.end), motions);
        }
        motions.clone_from(&self.motions);
        self.leave_compound(motions);
    }
}

/// The states at `t` [s] of bodies that nothing integrates; those of the start of all others.
fn unmoved(plan: &Plan, t: f64) -> Vec<BodyState> {
    plan.bodies().iter().map(|body| body.motion_at(Time::new(t)).state()).collect()
}

/// Reads the motion of every body from the numbers.
pub(crate) fn decode(charts: &[Chart], y: &[f64], motions: &mut [BodyMotion]) {
    let mut at = 0;
    for (chart, motion) in charts.iter().zip(&mut *motions) {
        let n = chart.dimension();
        chart.decode(&y[at..at + n], motion);
        at += n;
    }
    follow(charts, motions);
}

/// Energy of the whole scene at every sample [J]; kinetic + potential + dissipated − work stays.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy {
    /// Kinetic energy [J].
    pub kinetic: Vec<f64>,
    /// Potential energy [J].
    pub potential: Vec<f64>,
    /// Energy turned into heat since the start, by drag, damping and impacts [J].
    pub dissipated: Vec<f64>,
    /// Work brought in from outside since the start [J].
    pub work: Vec<f64>,
}

impl Energy {
    /// Kinetic + potential + dissipated − work at a sample [J].
    pub fn balance(&self, sample: usize) -> f64 {
        self.kinetic[sample] + self.potential[sample] + self.dissipated[sample] - self.work[sample]
    }

    /// Largest change of the balance since the start [J]: the method's error in the energy.
    pub fn drift(&self) -> f64 {
        (0..self.kinetic.len()).map(|i| (self.balance(i) - self.balance(0)).abs()).fold(0.0, f64::max)
    }
}

/// Momentum of the whole scene, world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Total {
    /// Linear momentum [kg·m/s].
    pub linear_momentum: Vector3,
    /// Angular momentum about the point asked for [kg·m²/s].
    pub angular_momentum: Vector3,
}

/// What a run leaves behind.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    pub(crate) plan: Arc<Plan>,
    pub(crate) times: Vec<f64>,
    /// Samples × bodies.
    pub(crate) states: Vec<BodyState>,
    pub(crate) phases: Vec<Phase>,
    pub(crate) events: Vec<Event>,
    pub(crate) heat: Vec<Heat>,
    /// Work that bodies on prescribed motions do on others.
    pub(crate) work: Vec<Heat>,
    pub(crate) report: Report,
    /// How far the motion is known [s].
    pub(crate) end: f64,
    /// The event that ended the run before its time.
    pub(crate) ended_by: Option<String>,
}

impl Trajectory {
    /// An empty trajectory for samples at `times`.
    pub(crate) fn new(plan: Arc<Plan>, times: Vec<f64>) -> Self {
        let states = times.iter().flat_map(|&t| unmoved(&plan, t)).collect();
        let end = times.first().copied().unwrap_or_default();
        let report = Report::new(&plan);
        Self {
            plan,
            times,
            states,
            phases: Vec::new(),
            events: Vec::new(),
            heat: Vec::new(),
            work: Vec::new(),
            report,
            end,
            ended_by: None,
        }
    }

    /// Whether a step up to `end` [s] is looked into: its motion is kept, or holds the sample at `cursor`.
    pub(crate) fn looks_into(&self, cursor: usize, end: f64) -> bool {
        self.keeps_motion() || self.times.get(cursor).is_some_and(|&t| t < end)
    }

    /// The instant before which steps that end there need not be looked into [s].
    pub(crate) fn next_look(&self, cursor: usize) -> f64 {
        if self.keeps_motion() {
            return f64::NEG_INFINITY;
        }
        self.times.get(cursor).copied().unwrap_or(f64::INFINITY)
    }

    /// The place of the phase that goes on from `phase` at `start` [s] with these loads off: the same, or a new one.
    pub(crate) fn phase_with(&mut self, phase: usize, off: &[usize], start: f64) -> usize {
        if self.phases[phase].off == off {
            return phase;
        }
        if self.phases[phase].start >= start {
            self.phases[phase].off = off.to_vec();
            return phase;
        }
        let Phase { group, charts, motions, .. } = &self.phases[phase];
        let (group, charts, motions) = (*group, charts.clone(), motions.clone());
        self.phases.push(Phase { group, start, charts, off: off.to_vec(), segments: Vec::new(), motions });
        self.phases.len() - 1
    }

    /// Keeps the samples of one step, and its motion where that is asked for. `cursor` is the
    /// group's next sample.
    pub(crate) fn record(
        &mut self,
        phase: usize,
        segment: &Segment,
        cursor: &mut usize,
        scratch: &mut Vec<BodyMotion>,
    ) {
        while self.times.get(*cursor).is_some_and(|&t| t < segment.end) {
            self.phases[phase].read(segment, self.times[*cursor].max(segment.start), scratch);
            self.put_sample(*cursor, phase, scratch);
            *cursor += 1;
        }
        if self.keeps_motion() {
            self.phases[phase].segments.push(segment.clone());
        }
    }

    /// Whether the motion of every step is kept: where that is asked for, and where an event may end the run, until
    /// it has.
    fn keeps_motion(&self) -> bool {
        self.plan.options().record == Record::Dense || self.plan.options().may_end_early()
    }

    /// Keeps the motions as the samples from `cursor` to the time `to` [s].
    pub(crate) fn record_rest(&mut self, phase: usize, motions: &[BodyMotion], cursor: &mut usize, to: f64) {
        while self.times.get(*cursor).is_some_and(|&t| t <= to) {
            self.put_sample(*cursor, phase, motions);
            *cursor += 1;
        }
    }

    fn put_sample(&mut self, sample: usize, phase: usize, motions: &[BodyMotion]) {
        let bodies = self.plan.bodies().len();
        let group = &self.plan.groups()[self.phases[phase].group];
        for (&index, motion) in group.members.iter().zip(motions) {
            self.states[sample * bodies + index] = motion.state();
        }
    }

    /// Cuts the samples that come after `end` [s], where a run broke off.
    pub(crate) fn cut(&mut self, end: f64) {
        self.end = end;
        let bodies = self.plan.bodies().len();
        let is_finite =
            |sample: usize| self.states[sample * bodies..(sample + 1) * bodies].iter().all(BodyState::is_finite);
        let kept = self.times.partition_point(|&t| t <= end);
        // of a step that broke off, a sample may be no number
        let kept = (0..kept).find(|&sample| !is_finite(sample)).unwrap_or(kept);
        self.times.truncate(kept);
        self.states.truncate(kept * bodies);
    }

    /// Ends the run where an event did, at `end` [s], with a sample there; or leaves it as it is.
    pub(crate) fn close(&mut self, ended: Option<(f64, String)>) {
        if let Some((end, name)) = ended {
            let last = self.motion_at(end);
            self.cut(end);
            self.events.retain(|event| event.time <= end);
            if self.times.last().is_none_or(|&t| t < end) {
                self.times.push(end);
                self.states.extend(last);
            }
            self.phases.retain(|phase| phase.start <= end);
            for phase in &mut self.phases {
                phase.segments.retain(|segment| segment.start < end);
                if let Some(segment) = phase.segments.last_mut() {
                    segment.end = segment.end.min(end);
                }
            }
            self.ended_by = Some(name);
        }
        if self.plan.options().record != Record::Dense {
            self.phases.iter_mut().for_each(|phase| phase.segments.clear());
        }
    }

    /// The name of the event that ended the run before its time, if one did.
    pub fn ended_by(&self) -> Option<&str> {
        self.ended_by.as_deref()
    }

    /// The plan that ran.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Times of the samples [s].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// How far the motion is known [s].
    pub fn end(&self) -> f64 {
        self.end
    }

    /// What happened, by time.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// What ran, what it cost, and how far it is to be trusted.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// State of every body at a sample, in the scene's order.
    pub fn states(&self, sample: usize) -> &[BodyState] {
        let n = self.plan.bodies().len();
        &self.states[sample * n..(sample + 1) * n]
    }

    /// Motion of every body at a sample, in the scene's order.
    pub fn motions(&self, sample: usize) -> Vec<BodyMotion> {
        let t = self.times[sample];
        self.plan.bodies().iter().zip(self.states(sample)).map(|(body, state)| body.motion(state, t)).collect()
    }

    /// One body.
    pub fn body(&self, id: BodyId) -> BodyTrajectory<'_> {
        BodyTrajectory { run: self, index: id.index() }
    }

    /// The body of this name.
    ///
    /// # Errors
    /// No body has it.
    pub fn named(&self, name: &str) -> Result<BodyTrajectory<'_>> {
        Ok(self.body(self.plan.scene().id(name)?))
    }

    /// State of every body at any time `t` [s] of the run, in the scene's order.
    ///
    /// # Errors
    /// A time outside of the run; a run that kept samples only.
    pub fn at(&self, t: f64) -> Result<Vec<BodyState>> {
        let start = self.times.first().copied().unwrap_or(self.end);
        if !(t >= start && t <= self.end) {
            return Err(Error::value("trajectory", "time", format!("within {start} to {}", self.end), t));
        }
        if let Some(sample) = self.times.iter().position(|&s| s == t) {
            return Ok(self.states(sample).to_vec());
        }
        self.need_dense()?;
        Ok(self.motion_at(t))
    }

    /// State of every body at any time [s] that the steps kept hold.
    fn motion_at(&self, t: f64) -> Vec<BodyState> {
        let mut states = unmoved(&self.plan, t);
        let mut motions = Vec::new();
        for (group, spec) in self.plan.groups().iter().enumerate() {
            let Some(phase) = self.phases.iter().rfind(|p| p.group == group && p.start <= t) else { continue };
            phase.at(t, &mut motions);
            for (&index, motion) in spec.members.iter().zip(&motions) {
                states[index] = motion.state();
            }
        }
        states
    }

    fn need_dense(&self) -> Result<()> {
        if self.plan.options().record == Record::Dense {
            return Ok(());
        }
        Err(Error::refused("trajectory", "the run kept samples only; run with record = dense to ask for any time"))
    }

    /// Pose of a body's shape axes at a time `t` [s] of the run.
    ///
    /// # Errors
    /// As [`at`](Self::at), and a name that no body has.
    pub fn pose(&self, name: &str, t: f64) -> Result<Pose> {
        let id = self.plan.scene().id(name)?;
        let state = self.at(t)?[id.index()];
        let body = &self.plan.bodies()[id.index()];
        let origin = Pose { position: state.position, orientation: state.orientation };
        Ok(Pose { position: origin.point(&-body.properties.center_of_mass), ..origin })
    }

    /// Linear and angular momentum of the whole scene at a sample, the latter about a world point [m].
    pub fn total(&self, sample: usize, about: impl Into<Vector3>) -> Total {
        let about = about.into();
        let mut total = Total { linear_momentum: Vector3::zeros(), angular_momentum: Vector3::zeros() };
        for state in self.states(sample) {
            total.linear_momentum += state.linear_momentum;
            total.angular_momentum += state.angular_momentum + (state.position - about).cross(&state.linear_momentum);
        }
        total
    }

    /// Energies of the whole scene at every sample. Heat and work are integrals over the motion of
    /// every step, by Gauss's rule with 5 points, exact to degree 9.
    ///
    /// # Errors
    /// A run that kept samples only, of a scene in which something dissipates or works.
    pub fn energy(&self) -> Result<Energy> {
        let n = self.times.len();
        let mut energy = Energy {
            kinetic: (0..n).map(|i| self.motions(i).iter().map(BodyMotion::kinetic_energy).sum()).collect(),
            potential: vec![0.0; n],
            dissipated: vec![0.0; n],
            work: vec![0.0; n],
        };
        for (index, group) in self.plan.groups().iter().enumerate() {
            for binding in &group.bindings {
                let effect = binding.effect.as_effect();
                for sample in 0..n {
                    let all = self.motions(sample);
                    let members: Vec<_> = group.members.iter().map(|&i| all[i]).collect();
                    let at = Moment { time: self.times[sample], since: self.times[sample] };
                    energy.potential[sample] += effect.potential_energy(at, &binding.seen(&members));
                }
            }
            self.add_heat_and_work(index, &mut energy)?;
        }
        for event in &self.events {
            let after = self.times.partition_point(|&t| t < event.time);
            energy.dissipated[after..].iter_mut().for_each(|d| *d += event.energy_lost);
        }

        self.add_passed(&self.heat, &mut energy.dissipated);
        self.add_passed(&self.work, &mut energy.work);
        Ok(energy)
    }

    /// Adds to every sample what has passed in contacts by then.
    fn add_passed(&self, all: &[Heat], samples: &mut [f64]) {
        let longest = all.iter().map(|heat| heat.to - heat.from).fold(0.0, f64::max);
        let (mut next, mut done) = (0, 0.0);
        for (sum, &t) in samples.iter_mut().zip(&self.times) {
            while let Some(heat) = all.get(next).filter(|heat| heat.to <= t) {
                done += heat.joules;
                next += 1;
            }
            let open = all[next..].iter().take_while(|heat| heat.to <= t + longest);
            let part = open.filter(|heat| heat.from < t).map(|heat| heat.until(t));
            *sum += done + part.sum::<f64>();
        }
    }

    /// Integrals of dissipated power and work over the motion of one group.
    fn add_heat_and_work(&self, group: usize, energy: &mut Energy) -> Result<()> {
        let bindings = &self.plan.groups()[group].bindings;
        let moving = |binding: &&Binding| !binding.effect.as_effect().conservative();
        if !bindings.iter().any(|binding| moving(&binding)) {
            return Ok(());
        }
        self.need_dense()?;
        let (mut heat, mut work) = (0.0, 0.0);
        let mut sample = 1.min(self.times.len());
        let mut motions = Vec::new();
        for phase in self.phases.iter().filter(|phase| phase.group == group) {
            let acting = || bindings.iter().filter(|b| moving(b) && !phase.off.contains(&b.effect_index));
            for segment in &phase.segments {
                // up to each sample within the segment, then to its end
                let mut from = segment.start;
                loop {
                    let next = self.times.get(sample).copied().filter(|&t| t <= segment.end);
                    let to = next.unwrap_or(segment.end);
                    for (node, weight) in GAUSS {
                        let t = from + (to - from) * node;
                        phase.read(segment, t, &mut motions);
                        for binding in acting() {
                            let seen = binding.seen(&motions);
                            let effect = binding.effect.as_effect();
                            heat += weight * (to - from) * effect.dissipated_power(segment.moment(t), &seen);
                            work += weight * (to - from) * effect.work_rate(segment.moment(t), &seen);
                        }
                    }
                    from = to;
                    if next.is_none() {
                        break;
                    }
                    energy.dissipated[sample] += heat;
                    energy.work[sample] += work;
                    sample += 1;
                }
            }
        }
        for rest in sample..self.times.len() {
            energy.dissipated[rest] += heat;
            energy.work[rest] += work;
        }
        Ok(())
    }

    /// Force and torque about the centre of mass with which its freedom holds each body at a sample against what effects do,
    /// in the scene's order [N], [N·m]. What contacts add while they last is not in it.
    pub fn reactions(&self, sample: usize) -> Vec<Load> {
        self.reactions_of(self.times[sample], &self.motions(sample))
    }

    /// The same at any time `t` [s] of the run.
    ///
    /// # Errors
    /// As [`at`](Self::at).
    pub fn reactions_at(&self, t: f64) -> Result<Vec<Load>> {
        let states = self.at(t)?;
        let motions: Vec<_> =
            self.plan.bodies().iter().zip(&states).map(|(body, state)| body.motion(state, t)).collect();
        Ok(self.reactions_of(t, &motions))
    }

    fn reactions_of(&self, time: f64, all: &[BodyMotion]) -> Vec<Load> {
        let mut reactions = vec![Load::zero(); self.plan.bodies().len()];
        for (index, spec) in self.plan.groups().iter().enumerate() {
            let Some(phase) = self.phases.iter().rfind(|p| p.group == index && p.start <= time) else { continue };
            if phase.has_parts() {
                continue; // what holds a part is its compound, not its freedom
            }
            let motions: Vec<_> = spec.members.iter().map(|&i| all[i]).collect();
            let mut group = Group::<Any>::new(phase.charts.clone(), motions, spec.bindings.clone());
            group.leave_out(&phase.off);
            for (&i, reaction) in spec.members.iter().zip(group.reactions(Moment { time, since: time })) {
                reactions[i] = reaction;
            }
        }
        reactions
    }
}

/// Nodes and weights of Gauss's rule with 5 points on 0..1 (Abramowitz, Stegun 1964, table 25.4).
#[rustfmt::skip]
pub(crate) const GAUSS: [(f64, f64); 5] = [
    (0.046910077030668004, 0.118463442528094544),
    (0.230765344947158454, 0.239314335249683234),
    (0.5,                  0.284444444444444444),
    (0.769234655052841546, 0.239314335249683234),
    (0.953089922969331996, 0.118463442528094544),
];

/// One body of a trajectory.
#[derive(Debug, Clone, Copy)]
pub struct BodyTrajectory<'a> {
    run: &'a Trajectory,
    index: usize,
}

impl BodyTrajectory<'_> {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.run.plan.bodies()[self.index].name
    }

    /// Its states at the samples.
    pub fn states(&self) -> impl Iterator<Item = &BodyState> {
        self.run.states.iter().skip(self.index).step_by(self.run.plan.bodies().len())
    }

    /// Its motion at any time `t` [s] of the run.
    ///
    /// # Errors
    /// As [`Trajectory::at`].
    pub fn at(&self, t: f64) -> Result<BodyMotion> {
        Ok(self.run.plan.bodies()[self.index].motion(&self.run.at(t)?[self.index], t))
    }

    /// Its centre of mass at a time `t` [s] of the run [m].
    ///
    /// # Errors
    /// As [`Trajectory::at`].
    pub fn position(&self, t: f64) -> Result<Vector3> {
        Ok(self.at(t)?.position)
    }
}
