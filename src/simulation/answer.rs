//! What happens at an instant of contact: impact, merging with what is fixed or each other, and who stays together after it.
//!
//! ```text
//! u > v_rest      a bounce with the pairs' restitutions, also of pairs that the blow reaches only
//! u ≤ v_rest      no bounce: its height, and all that would follow it, is below REST_RISE of the size
//! v_rest = √(2 a REST_RISE size)        a: the loads' acceleration, and ω² r where something is not elastic
//! ```
//!
//! u is the fastest approach of the cluster. Bounces that accumulate end so; when they would have ended is told
//! by their series (`contact::accumulation`), and is the time of the event.

use super::cluster::{Cluster, in_words};
use super::lasting::{Part, shift_by};
use super::led::Led;
use super::near::{Due, What};
use super::{Failure, Simulation, SimulationError};
use crate::contact::accumulation::{Accumulation, rest_speed};
use crate::contact::cluster::{ClusterBody, ClusterError, Contact};
use crate::contact::collision::collide;
use crate::contact::rest::align;
use crate::error::Error;
use crate::freedom::Chart;
use crate::freedom::riding::follow;
use crate::math::Vector3;
use crate::math::sum::Time;
use crate::state::{BodyMotion, Load};
use crate::trajectory::{Event, EventKind, Heat, Trajectory};

/// Impacts of one body at one instant after which it is said to be caught [-]. Two planes that answer each
/// other with e < 1 are done to rounding after about 50.
const ROUNDS_AT_ONCE: u32 = 64;
/// Height of a bounce below which there is none, as a fraction of the pair's size [-]. Larger: bodies come to
/// rest earlier, by the time of the bounces that are left out. Smaller: more bounces, each half as high.
const REST_RISE: f64 = 1.0e-10;
/// Speed that counts as none, in the speed below which no body bounces, and in the fastest of the cluster [-];
/// solvers leave 1e-11 of the latter.
const SMALL: [f64; 2] = [1.0e-3, 1.0e-11];
/// Slip that counts as none, in the speed that the loads give over the pair's size [-]: the end of a slide is
/// located to some 1e-10 of it.
const SLIP: f64 = 1.0e-7;
/// Gap below which bodies that touch are lifted, in ε [-], to half of it.
const LIFT: f64 = 0.1;
/// Error of the time at which bounces end that is good enough, as a fraction of that time [-].
const END_ERROR: f64 = 1.0e-9;

/// The scales of a cluster: which speeds count as what.
pub(super) struct ContactScales {
    /// Largest acceleration that the loads give a body [m/s²].
    pub(super) pull: f64,
    /// Size of the smallest pair [m].
    pub(super) size: f64,
    /// Approach below which nothing bounces [m/s].
    pub(super) rest: f64,
    /// Speed that counts as none [m/s].
    pub(super) small: f64,
    /// Slip that counts as none [m/s].
    pub(super) slip: f64,
}

/// What a body does from now on.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Fly,
    Rest,
    Lead,
}

impl Simulation {
    /// Answers a touch of these bodies at `time`, together with all that touch them then.
    pub(super) fn answer(
        &mut self,
        seeds: &[usize],
        time: Time,
        iterations: u32,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        // bodies that stick to each other become one, and what sticks to what is moved rides on it, pair by pair
        let (mut seeds, mut iterations) = (seeds.to_vec(), iterations);
        let (mut cluster, scales) = loop {
            let mut cluster = self.whole_cluster(&seeds, time)?;
            self.lift(&mut cluster);
            let scales = self.scales(&cluster, time);
            self.check_moved(&cluster, &scales, time)?;
            self.check_joints(&cluster, time)?;
            if let Some(pair) = self.sticking(&cluster, &scales) {
                self.merge(&cluster, pair, time, iterations, record)?;
            } else if let Some(pair) = self.boarding(&cluster, &scales) {
                self.board(&cluster, pair, time, iterations, record)?;
            } else {
                break (cluster, scales);
            }
            self.iterations += u64::from(iterations);
            iterations = 0;
            seeds = self.bodies_of(&cluster);
        };
        let before = cluster.motions.clone();

        // those that stick to what is fixed stop; the others are answered all at once
        let stuck = self.stick(&mut cluster, scales.small);
        self.book_stuck(&cluster, &before, stuck, time, iterations);
        let bounced = self.collide(&mut cluster, &scales, time, iterations)?;
        if bounced {
            self.count_hits(&self.bodies_of(&cluster), &seeds, time)?;
        }
        self.iterations += u64::from(iterations);

        // who stays together, and who flies
        let parts = self.settle(&mut cluster, &scales, time)?;
        let mut modes = vec![Mode::Fly; cluster.bodies.len()];
        for part in &parts {
            for &place in &part.places {
                modes[place] = if part.rests { Mode::Rest } else { Mode::Lead };
            }
        }
        for part in parts.iter().filter(|part| part.rests) {
            self.lay_down(&mut cluster, part, time);
        }
        for part in parts.iter().filter(|part| !part.rests) {
            let begins = part.places.iter().any(|&p| !self.is_led(cluster.bodies[p]));
            if begins {
                self.book_part(&cluster, &before, part, time, EventKind::Contact);
            }
        }
        self.released.clear();
        for touching in &cluster.touching {
            let lasts = |i: usize| parts.iter().any(|part| part.contacts.contains(&i));
            if !touching.contacts.clone().any(lasts) {
                let opening = touching.contacts.clone().map(|i| -cluster.approach(&cluster.contacts[i]));
                self.released.push((touching.bodies, opening.fold(f64::INFINITY, f64::min)));
            }
        }
        self.go_on(&cluster, &before, &modes, &parts, &scales, time, record)
    }

    /// All that touches, with the whole of every part that is led.
    fn whole_cluster(&mut self, seeds: &[usize], time: Time) -> Result<Cluster, SimulationError> {
        let mut seeds = seeds.to_vec();
        loop {
            let cluster = self.cluster(&seeds, time)?;
            let led = cluster.bodies.iter().filter_map(|&body| self.slot(body));
            let all = led.filter_map(|slot| self.together[slot].as_ref()).flat_map(|t| &t.bodies);
            let missing: Vec<usize> = all.copied().filter(|&body| cluster.place(self.unit(body)).is_none()).collect();
            if missing.is_empty() {
                return Ok(cluster);
            }
            seeds.extend(missing);
            seeds.sort_unstable();
            seeds.dedup();
        }
    }

    /// Lifts bodies off each other whose gap rounding has used up.
    fn lift(&self, cluster: &mut Cluster) {
        let mut eps = vec![0.0; cluster.contacts.len()];
        for touching in &cluster.touching {
            eps[touching.contacts.clone()].fill(self.eps(touching.bodies[0], touching.bodies[1]));
        }
        if eps.iter().zip(&cluster.gaps).all(|(eps, gap)| *gap >= LIFT * eps) {
            return;
        }
        let normal = |c: &Contact| c.normals.iter().sum::<Vector3>().try_normalize(0.0);
        let rows: Vec<(usize, Vector3)> =
            cluster.contacts.iter().enumerate().filter_map(|(i, c)| Some((i, normal(c)?))).collect();
        // all points of a pair alike, which a shift can do however many they are
        let mut missing = vec![0.0_f64; cluster.contacts.len()];
        for touching in &cluster.touching {
            let range = touching.contacts.clone();
            let wanted = |i: usize| 0.5 * eps[i] - cluster.gaps[i];
            let most = range.clone().map(wanted).fold(0.0, f64::max);
            missing[range].fill(most);
        }
        let lifts: Vec<f64> = rows.iter().map(|(i, _)| missing[*i]).collect();
        let bodies = self.cluster_bodies(cluster, &cluster.motions);
        let shifts = align(&bodies, &cluster.contacts, &rows, &lifts);
        for (motion, shift) in cluster.motions.iter_mut().zip(shifts) {
            shift_by(motion, &shift.linear, &shift.angular);
        }
        for ((i, _), lift) in rows.iter().zip(&lifts) {
            cluster.gaps[*i] += lift;
        }
    }

    /// The scales of a cluster.
    fn scales(&self, cluster: &Cluster, time: Time) -> ContactScales {
        let pull = |(&body, motion): (&usize, &BodyMotion)| match self.places[body] {
            Some((lane, _)) => {
                let still = BodyMotion { velocity: Vector3::zeros(), angular_velocity: Vector3::zeros(), ..*motion };
                let Load { force, torque } = self.load_on(lane, &still, self.moment(lane, time.value));
                if let Some(freedoms) = self.chart(body).and_then(|chart| chart.freedoms(&still)) {
                    let pulled = ClusterBody::within(&still, &freedoms).mobility.times(&force, &torque);
                    return pulled.linear.norm() + pulled.angular.norm() * self.body(body).radius;
                }
                let inverse = self.body(body).properties.inv_inertia();
                let turning = (inverse * motion.rotation.tr_mul(&torque)).norm() * self.body(body).radius;
                (force / motion.mass).norm() + turning
            }
            None => 0.0,
        };
        let pull = cluster.bodies.iter().zip(&cluster.motions).map(pull).fold(0.0, f64::max);
        let size = cluster.touching.iter().map(|t| self.size(t.bodies[0], t.bodies[1])).fold(f64::INFINITY, f64::min);
        let size = if size.is_finite() { size } else { 0.0 };
        let speed = |(&body, motion): (&usize, &BodyMotion)| {
            motion.velocity.norm() + motion.angular_velocity.norm() * self.body(body).radius
        };
        let fastest = cluster.bodies.iter().zip(&cluster.motions).map(speed).fold(0.0, f64::max);
        // what loses speed in bounces comes to rest on what turns into it as on what is pulled there
        let spin = |(&body, motion): (&usize, &BodyMotion)| {
            if self.places[body].is_some() {
                motion.angular_velocity.norm_squared() * self.body(body).radius
            } else {
                0.0
            }
        };
        let spins = cluster.bodies.iter().zip(&cluster.motions).map(spin).fold(0.0, f64::max);
        let is_elastic = cluster.contacts.iter().all(|contact| contact.restitution == 1.0);
        let drive = if is_elastic { pull } else { pull + spins };
        let rest = rest_speed(drive, REST_RISE * size);
        let small = (SMALL[0] * rest).max(SMALL[1] * fastest);
        ContactScales { pull, size, rest, small, slip: (SLIP * (pull * size).sqrt()).max(SMALL[1] * fastest) }
    }

    /// The impact of a cluster, if anything approaches; whether anything did.
    fn collide(
        &mut self,
        cluster: &mut Cluster,
        scales: &ContactScales,
        time: Time,
        iterations: u32,
    ) -> Result<bool, SimulationError> {
        let approaches: Vec<f64> = cluster.contacts.iter().map(|c| cluster.approach(c)).collect();
        if approaches.iter().all(|&u| u <= scales.small) {
            return Ok(false);
        }
        let mut contacts = cluster.contacts.clone();
        if approaches.iter().all(|&u| u <= scales.rest) {
            for contact in &mut contacts {
                contact.restitution = 0.0;
            }
        }
        let bodies = self.cluster_bodies(cluster, &cluster.motions);
        let collision =
            collide(&bodies, &contacts, self.plan.options().restitution_law).map_err(|why: ClusterError| {
                let why = Failure::Refused(format!("the impact cannot be answered: {why}"));
                self.failure_of(&cluster.bodies, time.value, why)
            })?;
        let before = cluster.motions.clone();
        for (motion, velocity) in cluster.motions.iter_mut().zip(&collision.velocities) {
            (motion.velocity, motion.angular_velocity) = (velocity.linear, velocity.angular);
        }

        self.touch_impacts += u64::from(self.depends_on_touch(cluster, &collision.impulses));

        // one event for every pair that bounced; what others lose is heat
        let losses = cluster.losses(&before, &collision.impulses);
        let mut booked = 0.0;
        let mut iterations = iterations;
        for (k, &loss) in losses.iter().enumerate() {
            let range = cluster.touching[k].contacts.clone();
            let bounces = approaches[range.clone()].iter().any(|&u| u > scales.rest)
                || collision.impulses[range.clone()].iter().any(|j| {
                    let [a, b] = cluster.touching[k].bodies;
                    let mass = [a, b].map(|i| {
                        if self.places[i].is_some() { self.body(self.unit(i)).properties.mass } else { f64::INFINITY }
                    });
                    j.norm() > scales.rest * mass[0].min(mass[1])
                });
            if bounces {
                let impulses = &collision.impulses[range];
                booked += self.book_bounce(cluster, &before, impulses, (k, loss), time, iterations);
                iterations = 0; // the rounds belong to the pair that was searched, not to those that came along
            }
        }
        if collision.work != 0.0 {
            self.work.push(Heat::at(time.value, collision.work));
        }
        let heat = collision.energy_lost - booked;
        if heat != 0.0 {
            self.heat.push(Heat::at(time.value, heat));
        }
        Ok(true)
    }

    /// Counts an impact of those of the bodies that move, or a break of their joint; an error where one has had too many.
    pub(super) fn count_hits(
        &mut self,
        bodies: &[usize],
        between: &[usize],
        time: Time,
    ) -> Result<(), SimulationError> {
        let most = self.plan.options().max_impacts;
        for &body in bodies.iter().filter(|&&body| self.places[body].is_some()) {
            let hits = self.near.count_hit(body, time.value);
            let why = if hits.at_once > ROUNDS_AT_ONCE {
                format!("{ROUNDS_AT_ONCE} impacts at one instant")
            } else if hits.in_all > most {
                format!("max_impacts = {most} of {} are used up", self.body(body).name)
            } else {
                continue;
            };
            return Err(self.failure_of(between, time.value, Failure::AccumulatingImpacts(why)));
        }
        Ok(())
    }

    /// Books the bounce of a pair, its impulses and the energy lost in it [J]; what was booked of the latter.
    fn book_bounce(
        &mut self,
        cluster: &Cluster,
        before: &[BodyMotion],
        impulses: &[Vector3],
        (pair, energy_lost): (usize, f64),
        time: Time,
        iterations: u32,
    ) -> f64 {
        let touching = &cluster.touching[pair];
        let range = touching.contacts.clone();
        let impulse: Vector3 = impulses.iter().sum();
        if impulse == Vector3::zeros() {
            return 0.0;
        }
        let weight: f64 = impulses.iter().map(Vector3::norm).sum();
        let contacts = &cluster.contacts[range];
        let point = contacts.iter().zip(impulses).map(|(c, j)| j.norm() / weight * c.point).sum();
        let [was, after] = [before, &cluster.motions].map(|motions| self.motions_of(cluster, touching.bodies, motions));
        let (Some([was_a, was_b]), Some([a, b])) = (was, after) else { return 0.0 };

        let normal = touching.closest.normal;
        let event = Event::between(time.value, EventKind::Bounce, touching.bodies, [&was_a, &a], [&was_b, &b]);
        let features = in_words(&touching.closest);
        self.watch(touching.bodies, time.value);
        self.events.push(Event { point, normal, impulse, features, iterations, energy_lost, ..event });
        energy_lost
    }

    /// Keeps the time of a pair's bounce; a pair that has hit others in between is told by its own times only.
    fn watch(&mut self, pair: [usize; 2], time: f64) {
        let (times, end) = self.bounces.entry(pair).or_insert_with(|| (Accumulation::new(), None));
        *end = times.book(time, END_ERROR * time.abs()).map(|capture| capture.time);
    }

    /// When the bounces of a pair that rests from now on would have ended [s].
    fn end_of_bounces(&mut self, pair: [usize; 2], now: f64) -> f64 {
        let end = self.bounces.remove(&pair).and_then(|(_, end)| end);
        end.map_or(now, |end| end.max(now))
    }

    /// Books that a part stays together from now on, one event a pair.
    fn book_part(&mut self, cluster: &Cluster, before: &[BodyMotion], part: &Part, time: Time, kind: EventKind) {
        for touching in cluster.touching.iter().filter(|t| part.contacts.iter().any(|i| t.contacts.contains(i))) {
            let [was, after] =
                [before, &cluster.motions].map(|motions| self.motions_of(cluster, touching.bodies, motions));
            let (Some([was_a, was_b]), Some([a, b])) = (was, after) else { continue };
            let time = self.end_of_bounces(touching.bodies, time.value);
            self.events.push(Event {
                point: touching.closest.point_b,
                normal: touching.closest.normal,
                features: in_words(&touching.closest),
                ..Event::between(time, kind, touching.bodies, [&was_a, &a], [&was_b, &b])
            });
        }
    }

    /// Brings the bodies of a part to rest where they are.
    fn lay_down(&mut self, cluster: &mut Cluster, part: &Part, time: Time) {
        let before = cluster.motions.clone();
        let mut left = 0.0;
        for &place in &part.places {
            let motion = &mut cluster.motions[place];
            left += motion.kinetic_energy();
            (motion.velocity, motion.angular_velocity) = (Vector3::zeros(), Vector3::zeros());
        }
        if left != 0.0 {
            self.heat.push(Heat::at(time.value, left));
        }
        if part.places.iter().any(|&place| !self.is_held(cluster.bodies[place])) {
            self.book_part(cluster, &before, part, time, EventKind::Rest);
        }
    }

    /// Begins the flights, the rest and the steps that follow, and searches on from there.
    #[expect(clippy::too_many_arguments, reason = "all that an instant has come to")]
    fn go_on(
        &mut self,
        cluster: &Cluster,
        before: &[BodyMotion],
        modes: &[Mode],
        parts: &[Part],
        scales: &ContactScales,
        time: Time,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        // parts that were led are led anew
        let slots: Vec<usize> = cluster.bodies.iter().filter_map(|&body| self.slot(body)).collect();
        for slot in slots {
            self.end_together(slot, time);
        }
        let mut lanes: Vec<usize> = Vec::new();
        for (place, &body) in cluster.bodies.iter().enumerate() {
            let Some((lane, _)) = self.places[body] else { continue };
            let stuck = self.is_stuck(body);
            let (was_held, was_led) = (self.is_held(body), self.lanes[lane].is_led());
            let holds = stuck || modes[place] == Mode::Rest;
            let is_changed = before[place] != cluster.motions[place]
                || was_held != holds
                || was_led
                || modes[place] == Mode::Lead
                || self.joined.contains(&body)
                || self.released.iter().any(|(pair, _)| pair.iter().any(|&i| self.unit(i) == body)) && !holds;
            self.lanes[lane].held.retain(|held| *held != body);
            if holds {
                self.lanes[lane].held.push(body);
            }
            if is_changed && !lanes.contains(&lane) {
                lanes.push(lane);
            }
        }
        lanes.sort_unstable();
        for &lane in &lanes {
            let leads = self.lanes[lane].spec.members.iter().any(|&body| {
                cluster.place(body).is_some_and(|place| modes[place] == Mode::Lead && !self.is_driven(body))
            });
            self.begin_flight(lane, time, cluster, leads, record)?;
        }
        for part in parts.iter().filter(|part| !part.rests) {
            // what breaks within a step leaves the motion known up to where the step begins
            self.lead(cluster, part, scales, time).map_err(|error| SimulationError { time: time.value, ..error })?;
        }
        for &lane in &lanes {
            if !self.lanes[lane].is_led() {
                self.step_over(lane, time.value, record)?;
            }
        }
        for &lane in &lanes {
            for &body in &self.lanes[lane].spec.clone().members {
                if self.body(body).collider.is_some() && self.places[body].is_some() {
                    self.open_window(body, time.value, record)?;
                }
            }
            self.wake_at_switch(lane, time);
            self.wake_at_jump(lane, time);
        }
        self.released.clear();
        self.joined.clear();
        Ok(())
    }

    /// Wakes the body that rests in a lane where its load jumps.
    fn wake_at_switch(&mut self, lane: usize, time: Time) {
        let spec = &self.lanes[lane].spec;
        let Some(&body) = self.lanes[lane].held.first() else { return };
        if let Some(&switch) = spec.switches.iter().find(|&&s| s > time.value)
            && !self.is_stuck(body)
            && switch < self.end
        {
            let number = self.lanes[lane].number;
            self.near.due.push(Due { time: Time::new(switch), what: What::Wake { body, number } });
        }
    }

    /// Cuts a lane's flight at `time` and begins another from the cluster's motions.
    fn begin_flight(
        &mut self,
        index: usize,
        time: Time,
        cluster: &Cluster,
        leads: bool,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let spec = self.lanes[index].spec.clone();
        let mut motions = self.lanes[index].motions.clone();
        for (motion, &member) in motions.iter_mut().zip(&spec.members) {
            *motion =
                cluster.place(member).map_or_else(|| self.motion_at(member, time), |place| cluster.motions[place]);
        }
        self.cut_flight(index, time, record)?;

        let since = self.moment(index, time.value).since;
        let charts = self
            .charts_of(index)
            .map_err(|error| self.failure(index, time.value, Failure::Refused(error.to_string())))?;
        follow(&charts, &mut motions);
        let joined = self.joined.contains(spec.members.first().unwrap_or(&usize::MAX));
        let lane = &mut self.lanes[index];
        lane.earlier.add(lane.flight.counts());
        lane.led = None;
        lane.flight = if leads {
            Box::new(Led::new(charts.clone(), time, &motions))
        } else {
            plan.flight_of(&spec, time.value, &self.controls[lane.group], charts.clone(), &motions)
        };
        lane.flight.set_clock(time, since);
        let is_new = joined || charts != lane.charts;
        (lane.charts, lane.motions, lane.number) = (charts, motions, lane.number + 1);
        if let (Some(run), true) = (record.as_mut(), is_new) {
            self.begin_phases(index, time.value, run);
        }
        Ok(())
    }

    /// Ends a lane's flight at `time`, and records it.
    pub(super) fn cut_flight(
        &mut self,
        index: usize,
        time: Time,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let lane = &mut self.lanes[index];
        if lane.pending.is_some() {
            let offset = (time.value - lane.flight.segment().start) + time.rest;
            if offset < lane.flight.segment().length {
                lane.flight.cut(offset);
            }
        }
        self.finish_step(index, record)
    }

    /// Ends a step of bodies that are led, with its heat till then.
    pub(super) fn end_together(&mut self, slot: usize, time: Time) {
        let Some(part) = self.together[slot].take() else { return };
        for (list, at) in [(&mut self.heat, part.heat), (&mut self.work, part.work)] {
            let passed = at.and_then(|at| list.get_mut(at));
            if let Some(passed) = passed.filter(|passed| passed.to > time.value && passed.from < time.value) {
                passed.cut(time.value);
            }
        }
    }

    /// The coordinates of a lane's bodies, some of which may be held.
    pub(super) fn charts_of(&self, index: usize) -> Result<Vec<Chart>, Error> {
        let lane = &self.lanes[index];
        match lane.compound {
            Some(compound) => self.plan.compound_charts(&self.compounds[compound], !lane.held.is_empty()),
            None => Ok(self.plan.charts(lane.group, &lane.held)),
        }
    }

    /// The bodies of the scene in a cluster.
    fn bodies_of(&self, cluster: &Cluster) -> Vec<usize> {
        let (mut all, mut bodies) = (Vec::new(), Vec::new());
        for &unit in &cluster.bodies {
            self.parts_of(unit, &mut bodies);
            all.extend(&bodies);
        }
        all
    }

    /// The part that a body is led with.
    pub(super) fn slot(&self, body: usize) -> Option<usize> {
        self.places[body].and_then(|(lane, _)| self.lanes[lane].led)
    }

    fn is_led(&self, body: usize) -> bool {
        self.slot(body).is_some()
    }

    /// Whether a body has stuck to what is fixed, for good.
    pub(super) fn is_stuck(&self, body: usize) -> bool {
        !self.stuck.is_empty() && self.stuck.contains(&self.unit(body))
    }
}
