//! Bodies that have stuck to one on a prescribed motion ride on it.
//!
//! ```text
//! x = c(t) + R(t) p        q = Q(t) q_p        v = ċ + ω × R p        the driver's c, R, Q, ω, and a part's place in it
//! W = ∫ Σ [m v·(ω × (ω × R p)) − F·v − M·ω] dt                       work of the driver: what its joint must bring in
//! ```
//!
//! A rider is a compound whose centre is the point c that the driver turns about. Between the times of the driver's
//! schedule this moves uniformly, so the flight is a closed form; at these times it begins anew.

use super::answer::ContactScales;
use super::cluster::{Cluster, in_words};
use super::merge::swapped;
use super::near::{Due, What};
use super::observe::Watcher;
use super::{Failure, Simulation, SimulationError};
use crate::contact::Response;
use crate::contact::stick::stick_to_driven;
use crate::error::Result;
use crate::math::sum::Time;
use crate::math::{Pose, Vector3, quaternion};
use crate::state::{BodyMotion, Moment};
use crate::trajectory::{Event, EventKind, GAUSS, Heat, Trajectory};

/// Angle that a driver turns, or a load swings, in a piece of the work that is booked [rad]: within it the work is read
/// from a cubic, to 3e-9 of what the driver moves to and fro.
const PIECE: f64 = 1.0 / 32.0;

impl Simulation {
    /// The body on a prescribed motion that a body rides on.
    pub(super) fn driver_of(&self, body: usize) -> Option<usize> {
        let unit = self.unit(body);
        self.riders.iter().find(|(rider, _)| *rider == unit).map(|(_, driver)| *driver)
    }

    /// Whether a body has stuck to something fixed or moved, so that no force moves it.
    pub(super) fn is_driven(&self, body: usize) -> bool {
        self.is_stuck(body) || self.driver_of(body).is_some()
    }

    /// Whether two bodies move with the same driver, or one is it.
    pub(super) fn ride_together(&self, a: usize, b: usize) -> bool {
        let driver = |i: usize| self.driver_of(i).or(self.body(i).motion.as_ref().map(|_| i));
        !self.riders.is_empty() && driver(a).is_some() && driver(a) == driver(b)
    }

    /// How the point that a driver turns about moves from an instant on, with the driver's axes.
    pub(super) fn carrier(&self, driver: usize, time: Time) -> BodyMotion {
        let planned = self.body(driver);
        let motion = planned.motion_at(time);
        let center = planned.motion.as_ref().map_or_else(Vector3::zeros, |prescribed| prescribed.center.into());
        let position = motion.point(&center);
        BodyMotion { position, velocity: motion.velocity_at(&position), ..motion }
    }

    /// The first pair of a cluster, among those that touch, of which one sticks to what is moved.
    pub(super) fn boarding(&self, cluster: &Cluster, scales: &ContactScales) -> Option<usize> {
        cluster.touching.iter().position(|touching| {
            let [a, b] = touching.bodies;
            let moved = |i: usize| self.body(i).motion.is_some() || self.driver_of(i).is_some();
            self.plan.material(a, b).response == Response::Stick
                && self.is_anchored(a) != self.is_anchored(b)
                && (moved(a) || moved(b))
                && (!self.has_parted([a, b]) || self.may_stick(cluster, touching, scales.small))
        })
    }

    /// Lets the free one of a pair that touches ride on the other.
    pub(super) fn board(
        &mut self,
        cluster: &Cluster,
        pair: usize,
        time: Time,
        iterations: u32,
        record: &mut Option<&mut Trajectory>,
    ) -> std::result::Result<(), SimulationError> {
        let touching = &cluster.touching[pair];
        let [a, b] = touching.bodies;
        let (bodies, closest) =
            if self.is_anchored(a) { ([a, b], touching.closest) } else { ([b, a], swapped(&touching.closest)) };
        let driver = self.driver_of(bodies[0]).unwrap_or(bodies[0]);
        let unit = self.unit(bodies[1]);
        let (Some(place), Some((lane, _))) = (cluster.place(unit), self.places[unit]) else { return Ok(()) };
        let was = cluster.motions[place];
        let mut now = was;
        let answer = stick_to_driven(&mut now, &self.motion_at(driver, time));
        let [was_b, now_b] = [was, now].map(|motion| self.part_motion(bodies[1], &motion));
        let other = self.motion_at(bodies[0], time);

        // where each part stands on the driver
        let carrier = self.carrier(driver, time);
        let into = carrier.orientation.conjugate();
        let (mut parts, mut own) = (Vec::new(), Vec::new());
        self.parts_of(unit, &mut own);
        for body in own {
            let motion = self.part_motion(body, &was);
            let position = quaternion::rotate(&into, &(motion.position - carrier.position));
            parts.push((body, Pose { position, orientation: quaternion::normalized(&(into * motion.orientation)) }));
        }

        // the flight so far ends here
        let going = (self.end_flight(lane, time, record)?, self.lanes[lane].watchers.clone());
        self.ride(&parts, driver, time, going)
            .map_err(|error| self.failure_of(&bodies, time.value, Failure::Refused(error.to_string())))?;

        // the blow: what it takes, and what the driver brings in
        let work = now.kinetic_energy() - was.kinetic_energy() + answer.energy_lost;
        if work != 0.0 {
            self.work.push(Heat::at(time.value, work));
        }
        self.add_joint((bodies, &now_b), &closest, &cluster.contacts[touching.contacts.clone()]);
        self.events.push(Event {
            point: closest.point_b,
            normal: closest.normal,
            impulse: answer.impulse,
            features: in_words(&closest),
            iterations,
            energy_lost: answer.energy_lost,
            ..Event::between(time.value, EventKind::Stick, bodies, [&other, &other], [&was_b, &now_b])
        });
        Ok(())
    }

    /// Lets bodies, which stand so on a driver, ride on it.
    pub(super) fn ride(
        &mut self,
        parts: &[(usize, Pose)],
        driver: usize,
        time: Time,
        (number, watchers): (u64, Vec<Watcher>),
    ) -> Result<()> {
        let carrier = self.carrier(driver, time);
        self.join(parts, true, time)?;
        self.stand(&carrier, time, number, watchers);
        self.riders.push((self.units[parts[0].0], driver));
        Ok(())
    }

    /// Makes the next time at which the velocity of a rider jumps due.
    pub(super) fn wake_at_jump(&mut self, lane: usize, time: Time) {
        let Some(compound) = self.lanes[lane].compound else { return };
        let unit = self.plan.bodies().len() + compound;
        let Some(driver) = self.driver_of(unit) else { return };
        let jump = self.next_jump(driver, time.value);
        if jump < self.end {
            let number = self.lanes[lane].number;
            self.near.due.push(Due { time: Time::new(jump), what: What::Wake { body: unit, number } });
        }
    }

    /// The velocity of a rider jumps: its driver does the work.
    pub(super) fn jump(&mut self, unit: usize, time: Time) {
        let (Some(driver), Some((lane, _))) = (self.driver_of(unit), self.places[unit]) else { return };
        let before = self.motions_at(lane, time)[0];
        let energy = |motion: &BodyMotion| {
            let mut bodies = Vec::new();
            self.parts_of(unit, &mut bodies);
            bodies.iter().map(|&body| self.part_motion(body, motion).kinetic_energy()).sum::<f64>()
        };
        let work = energy(&self.carrier(driver, time)) - energy(&before);
        if work != 0.0 {
            self.work.push(Heat::at(time.value, work));
        }
        self.joined.push(unit);
    }

    /// Books the work that a driver does on its rider in the last step of a lane, up to its front.
    pub(super) fn book_ride(&mut self, index: usize) {
        let lane = &self.lanes[index];
        let Some(compound) = lane.compound else { return };
        if self.driver_of(self.plan.bodies().len() + compound).is_none() {
            return;
        }
        let segment = lane.flight.segment();
        let length = (segment.end - segment.start).max(0.0);
        let piece = if self.pace(index) > 0.0 { (PIECE / self.pace(index)).min(length) } else { length };
        let mut motions = lane.motions.clone();
        let mut power = |offset: f64| {
            lane.flight.at_offset(offset, &mut motions);
            let at = Moment { time: segment.start + offset, since: segment.since };
            let loads = self.loads_on(index, &motions, at);
            let (whole, w) = (motions[0], motions[0].angular_velocity);
            let parts = motions.iter().zip(&loads).skip(1);
            let own = parts.filter(|(part, _)| part.mass > 0.0).map(|(part, load)| {
                let centripetal = w.cross(&w.cross(&(part.position - whole.position)));
                part.mass * part.velocity.dot(&centripetal) - load.power(part)
            });
            own.sum::<f64>()
        };
        let mut booked = Vec::new();
        let mut from = 0.0;
        while from < length {
            let to = if from + piece < length { from + piece } else { length };
            let h = to - from;
            let joules = GAUSS.iter().map(|(node, weight)| weight * h * power(from + node * h)).sum();
            let ends = [power(from), power(to)];
            if joules != 0.0 || ends != [0.0; 2] {
                booked.push(Heat { from: segment.start + from, to: segment.start + to, joules, power: ends });
            }
            from = to;
        }
        self.work.extend(booked);
    }
}
