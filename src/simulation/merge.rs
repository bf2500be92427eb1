//! Bodies that stick: to what is fixed, where they stop, or to each other, where they become one.
//!
//! ```text
//! unit       what flies on its own: a body, or the compound that it is part of
//! compound   a body behind those of the scene, with a lane of its own; its parts keep names, shapes and samples
//! ```
//!
//! Contacts and the search for impacts see the parts, impulses and loads act on units. Pairs that stick at one
//! instant are merged one after the other: momenta do not depend on the order.

use super::answer::ContactScales;
use super::cluster::{Cluster, in_words};
use super::led::Led;
use super::{Failure, Lane, Simulation, SimulationError};
use crate::closest::ClosestFeatures;
use crate::contact::stick::{Merged, merge, stick};
use crate::contact::{Answer, Response};
use crate::error::Result;
use crate::freedom::Riding;
use crate::math::Pose;
use crate::math::sum::Time;
use crate::plan::PlannedBody;
use crate::state::BodyMotion;
use crate::trajectory::{Event, EventKind, Phase, Trajectory};

/// A body that has stuck to something that does not move.
pub(super) struct Stuck {
    /// Both bodies, as places in the scene: what it sticks to, and itself.
    bodies: [usize; 2],
    answer: Answer,
    closest: ClosestFeatures,
    /// Where they touch, as places in the cluster's list.
    contacts: std::ops::Range<usize>,
}

/// The closest features seen from the other body.
pub(super) fn swapped(closest: &ClosestFeatures) -> ClosestFeatures {
    ClosestFeatures {
        point_a: closest.point_b,
        point_b: closest.point_a,
        normal: -closest.normal,
        feature_a: closest.feature_b,
        feature_b: closest.feature_a,
        part_a: closest.part_b,
        part_b: closest.part_a,
        ..*closest
    }
}

impl Simulation {
    /// A body of the scene, or a compound.
    pub(super) fn body(&self, body: usize) -> &PlannedBody {
        let bodies = self.plan.bodies();
        if body < bodies.len() { &bodies[body] } else { &self.compounds[body - bodies.len()].body }
    }

    /// What flies on its own: the body, or the compound that it is part of.
    pub(super) fn unit(&self, body: usize) -> usize {
        self.units[body]
    }

    /// The bodies of the scene that a unit is made of.
    pub(super) fn parts_of(&self, unit: usize, bodies: &mut Vec<usize>) {
        bodies.clear();
        match unit.checked_sub(self.plan.bodies().len()) {
            None => bodies.push(unit),
            Some(compound) => bodies.extend(self.compounds[compound].parts.iter().map(|part| part.body)),
        }
    }

    /// Where a body stands in its unit: centre of mass and axes, from those of the unit.
    fn pose_in_unit(&self, body: usize) -> Option<Pose> {
        let compound = self.unit(body).checked_sub(self.plan.bodies().len())?;
        self.compounds[compound].parts.iter().find(|part| part.body == body).map(|part| part.pose)
    }

    /// The motion of a body whose unit moves so.
    pub(super) fn part_motion(&self, body: usize, unit: &BodyMotion) -> BodyMotion {
        match self.pose_in_unit(body) {
            Some(pose) => Riding { pose }.motion(unit, &self.body(body).start),
            None => *unit,
        }
    }

    /// The motions of two bodies of a cluster whose units move so.
    pub(super) fn motions_of(
        &self,
        cluster: &Cluster,
        bodies: [usize; 2],
        motions: &[BodyMotion],
    ) -> Option<[BodyMotion; 2]> {
        let [a, b] = bodies.map(|i| Some(self.part_motion(i, &motions[cluster.place(self.unit(i))?])));
        Some([a?, b?])
    }

    /// Largest distance of a body's matter from the point whose motion is looked at [m]: its unit's centre of mass, or a
    /// point of it that rests.
    pub(super) fn reach_from_center(&self, body: usize) -> f64 {
        let arm = self.chart(body).map_or(0.0, |chart| chart.point_body().norm());
        self.body(body).radius + self.pose_in_unit(body).map_or(arm, |pose| pose.position.norm())
    }

    /// Whether two bodies of the scene may meet.
    pub(super) fn may_meet(&self, a: usize, b: usize) -> bool {
        self.unit(a) != self.unit(b) && self.plan.may_meet(a, b) && !self.ride_together(a, b)
    }

    /// Whether no force moves a body: it is fixed or moved, or has stuck to what is.
    pub(super) fn is_anchored(&self, body: usize) -> bool {
        self.body(body).fixed || self.is_driven(body)
    }

    /// Stops the units that stick to what does not move.
    pub(super) fn stick(&mut self, cluster: &mut Cluster, small: f64) -> Vec<Stuck> {
        let mut stuck = Vec::new();
        for touching in &cluster.touching {
            let [a, b] = touching.bodies;
            let (bodies, closest) = match [a, b].map(|i| self.is_anchored(i)) {
                [true, false] => ([a, b], touching.closest),
                [false, true] => ([b, a], swapped(&touching.closest)),
                _ => continue,
            };
            let unit = self.unit(bodies[1]);
            if self.plan.material(a, b).response == Response::Stick
                && (!self.has_parted(bodies) || self.may_stick(cluster, touching, small))
                && let Some(place) = cluster.place(unit)
            {
                let answer = stick(&mut cluster.motions[place]);
                let contacts = touching.contacts.clone();
                stuck.push(Stuck { bodies, answer, closest, contacts });
                self.stuck.push(unit);
            }
        }
        stuck
    }

    /// Books that bodies have stuck to what does not move.
    pub(super) fn book_stuck(
        &mut self,
        cluster: &Cluster,
        before: &[BodyMotion],
        stuck: Vec<Stuck>,
        time: Time,
        iterations: u32,
    ) {
        for Stuck { bodies, answer, closest, contacts } in stuck {
            let Some([was_a, was_b]) = self.motions_of(cluster, bodies, before) else { continue };
            let Some([a, b]) = self.motions_of(cluster, bodies, &cluster.motions) else { continue };
            self.add_joint((bodies, &b), &closest, &cluster.contacts[contacts]);
            self.events.push(Event {
                point: closest.point_b,
                normal: closest.normal,
                impulse: answer.impulse,
                features: in_words(&closest),
                iterations,
                energy_lost: answer.energy_lost,
                ..Event::between(time.value, EventKind::Stick, bodies, [&was_a, &a], [&was_b, &b])
            });
        }
    }

    /// Ends the flight of a lane whose body becomes part of another; the number of the next one.
    pub(super) fn end_flight(
        &mut self,
        lane: usize,
        time: Time,
        record: &mut Option<&mut Trajectory>,
    ) -> std::result::Result<u64, SimulationError> {
        if let Some(slot) = self.lanes[lane].led.take() {
            self.end_together(slot, time);
        }
        self.cut_flight(lane, time, record)?;
        Ok(self.lanes[lane].number + 1)
    }

    /// The first pair of a cluster, among those that touch, whose bodies become one.
    pub(super) fn sticking(&self, cluster: &Cluster, scales: &ContactScales) -> Option<usize> {
        cluster.touching.iter().position(|touching| {
            let [a, b] = touching.bodies;
            self.plan.material(a, b).response == Response::Stick
                && ![a, b].iter().any(|&i| self.is_anchored(i))
                && self.may_stick(cluster, touching, scales.small)
        })
    }

    /// Makes one of the bodies of a pair that touches. Its flight begins with that of the cluster.
    pub(super) fn merge(
        &mut self,
        cluster: &Cluster,
        pair: usize,
        time: Time,
        iterations: u32,
        record: &mut Option<&mut Trajectory>,
    ) -> std::result::Result<(), SimulationError> {
        let touching = &cluster.touching[pair];
        let pair = touching.bodies;
        let units = pair.map(|i| self.unit(i));
        let [Some(a), Some(b)] = units.map(|unit| cluster.place(unit)) else { return Ok(()) };
        let Some(Merged { motion, members, energy_lost, .. }) = merge(&[cluster.motions[a], cluster.motions[b]]) else {
            return Ok(());
        };

        // where each part stands in the whole
        let (mut parts, mut bodies) = (Vec::new(), Vec::new());
        for (unit, member) in units.iter().zip(&members) {
            self.parts_of(*unit, &mut bodies);
            for &body in &bodies {
                let inner = self.pose_in_unit(body).unwrap_or_else(Pose::identity);
                let orientation = member.pose.orientation * inner.orientation;
                let pose = Pose { position: member.pose.point(&inner.position), orientation };
                parts.push((body, pose));
            }
        }

        // the flights so far end here
        let mut number = 0;
        for unit in units {
            let Some((lane, _)) = self.places[unit] else { continue };
            number = number.max(self.end_flight(lane, time, record)?);
        }
        let before = self.motions_of(cluster, pair, &cluster.motions);
        let watchers: Vec<_> = units.iter().filter_map(|&unit| self.places[unit]).collect();
        let watchers = watchers.into_iter().flat_map(|(lane, _)| self.lanes[lane].watchers.clone()).collect();
        if let Err(error) = self.join(&parts, false, time) {
            return Err(self.failure_of(&pair, time.value, Failure::Refused(error.to_string())));
        }

        // its lane stands here
        self.stand(&motion, time, number, watchers);
        let whole = self.lanes[self.lanes.len() - 1].motions[0];
        let after = pair.map(|i| self.part_motion(i, &whole));
        self.add_joint((pair, &after[1]), &touching.closest, &cluster.contacts[touching.contacts.clone()]);

        // one event, under the names of the two that touched
        if let Some([was_a, was_b]) = before {
            self.events.push(Event {
                point: touching.closest.point_b,
                normal: touching.closest.normal,
                impulse: members[1].impulse,
                features: in_words(&touching.closest),
                iterations,
                energy_lost,
                ..Event::between(time.value, EventKind::Stick, pair, [&was_a, &after[0]], [&was_b, &after[1]])
            });
        }
        Ok(())
    }

    /// Makes a compound of these bodies of the scene, with a lane of its own in which nothing moves yet.
    pub(super) fn join(&mut self, parts: &[(usize, Pose)], rides: bool, time: Time) -> Result<()> {
        let (whole, at) = (self.places.len(), self.lanes.len());
        let compound = self.plan.compound(whole, parts, rides)?;
        let charts = self.plan.compound_charts(&compound, false)?;
        let others = compound.spec.members[1..].iter().map(|&i| self.body(i).start);
        let motions: Vec<BodyMotion> = std::iter::once(compound.body.start).chain(others).collect();
        let flight = Box::new(Led::new(charts.clone(), time, &motions));
        let group = compound.parts.first().map_or(0, |part| part.group);
        let lane = Lane::new(group, compound.flown(), flight, charts, motions, time.value);
        self.lanes.push(Lane { compound: Some(self.compounds.len()), ..lane });
        self.places.push(Some((at, 0)));
        self.units.push(whole);
        for part in &compound.parts {
            let place = compound.spec.members.iter().position(|&i| i == part.body);
            self.places[part.body] = place.map(|place| (at, place));
            self.units[part.body] = whole;
        }
        self.compounds.push(compound);
        self.joined.push(whole);
        Ok(())
    }

    /// Begins the phases of a lane that goes on with other coordinates.
    pub(super) fn begin_phases(&mut self, index: usize, time: f64, run: &mut Trajectory) {
        let lane = &self.lanes[index];
        let phase = |group: usize, charts: Vec<_>, motions: Vec<_>| {
            let (off, segments) = (Vec::new(), Vec::new());
            Phase { group, start: time, charts, off, segments, motions }
        };
        let Some(compound) = lane.compound else {
            run.phases.push(phase(lane.group, lane.charts.clone(), lane.motions.clone()));
            self.lanes[index].phase = run.phases.len() - 1;
            return;
        };
        for part in &self.compounds[compound].parts {
            let lane = &self.lanes[index];
            let of_group = |place: &usize| *place == 0 || part.members.contains(place);
            let places: Vec<usize> = (0..lane.charts.len()).filter(of_group).collect();
            let charts = places.iter().map(|&place| lane.charts[place].clone()).collect();
            run.phases.push(phase(part.group, charts, places.iter().map(|&place| lane.motions[place]).collect()));
            self.lanes[part.group].phase = run.phases.len() - 1;
        }
    }

    /// Records the last step of a compound's lane, part by part.
    pub(super) fn record_parts(&mut self, index: usize, run: &mut Trajectory) {
        let Some(compound) = self.lanes[index].compound else { return };
        let segment = self.lanes[index].flight.segment().clone();
        let (front, mut scratch) = (self.lanes[index].flight.front(), Vec::new());
        for part in &self.compounds[compound].parts {
            let lane = &mut self.lanes[part.group];
            lane.nodes.push(front);
            if run.looks_into(lane.cursor, front) {
                run.record(lane.phase, &segment, &mut lane.cursor, &mut scratch);
            }
        }
    }

    /// Keeps the samples from the front of a lane to the time `to` [s], where it ends.
    pub(super) fn record_rest(&mut self, index: usize, run: &mut Trajectory, to: f64) {
        let lane = &mut self.lanes[index];
        let (mut motions, to) = (lane.motions.clone(), to.min(lane.flight.front()));
        lane.flight.at(lane.flight.front(), &mut motions);
        let Some(compound) = lane.compound else {
            return run.record_rest(lane.phase, &motions, &mut lane.cursor, to);
        };
        for part in
            self.compounds[compound].parts.iter().filter(|part| self.places[part.body].map(|p| p.0) == Some(index))
        {
            let lane = &mut self.lanes[part.group];
            run.record_rest(lane.phase, &motions[part.members.clone()], &mut lane.cursor, to);
        }
    }
}
