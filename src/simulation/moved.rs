//! Bodies on prescribed motions: where they are, which windows they have, what work they do.
//!
//! They have no lane. Their motion is a function of time, uniform between the times of their schedules; windows
//! end there, so that a search sees one velocity.

use super::answer::ContactScales;
use super::cluster::Cluster;
use super::events::WINDOW;
use super::near::{Due, What};
use super::path::Path;
use super::{Failure, Simulation, SimulationError};
use crate::contact::broad_phase::Aabb;
use crate::contact::rest::Acceleration;
use crate::impact::Motion;
use crate::math::sum::Time;
use crate::math::{Pose, Vector3};
use crate::plan::EPS_ROUNDING;
use crate::state::BodyMotion;

impl Simulation {
    /// Refuses what cannot be followed of bodies that are moved, and of what rides on them: that they run into what no
    /// force moves.
    pub(super) fn check_moved(
        &self,
        cluster: &Cluster,
        scales: &ContactScales,
        time: Time,
    ) -> Result<(), SimulationError> {
        for touching in &cluster.touching {
            let [a, b] = touching.bodies;
            let mut contacts = cluster.contacts[touching.contacts.clone()].iter();
            if ![a, b].iter().all(|&i| self.is_anchored(i))
                || contacts.all(|contact| cluster.approach(contact) <= scales.small)
            {
                continue;
            }
            let does = |i: usize| match self.driver_of(i) {
                Some(driver) => format!("{} rides on {}", self.body(i).name, self.body(driver).name),
                None if self.body(i).motion.is_some() => format!("{} moves as prescribed", self.body(i).name),
                None if self.is_stuck(i) => format!("{} has stuck to a fixed body", self.body(i).name),
                None => format!("{} is fixed", self.body(i).name),
            };
            let why = format!("{}, {}, and they run into each other", does(a), does(b));
            return Err(self.failure_of(&[a, b], time.value, Failure::LastingContact(why)));
        }
        Ok(())
    }

    /// Wakes the bodies at rest near one whose velocity jumps at `now` [s].
    pub(super) fn wake_around(&mut self, body: usize, aabb: &Aabb, now: f64) {
        if !self.body(body).motion.as_ref().is_some_and(|motion| motion.switches().contains(&now)) {
            return;
        }
        let mut others = Vec::new();
        self.near.around(aabb, &mut others);
        for other in others {
            if self.may_meet(body, other) && self.is_held(other) && !self.is_stuck(other) {
                let number = self.flight_number(other);
                self.near.due.push(Due { time: Time::new(now), what: What::Wake { body: other, number } });
            }
        }
    }

    /// The motion of a body that nothing integrates, from `now` [s] on, as long as its velocity stays.
    pub(super) fn unmoved_path(&self, body: usize, now: f64) -> Path<'_> {
        let planned = self.body(body);
        let here = planned.motion_at(Time::new(now));
        let Some(motion) = planned.motion.as_ref().filter(|motion| motion.moves(now)) else {
            return Path::resting(&here, planned.properties.center_of_mass);
        };
        let (velocity, angular_velocity) = motion.velocities(now);
        let center = Vector3::from(motion.center);
        let pose = Pose { position: here.point(&center), orientation: here.orientation };
        Path::uniform(Motion::new(pose, velocity, angular_velocity).about(center))
    }

    /// Acceleration of a body that nothing integrates, at the instant of its motion.
    pub(super) fn unmoved_acceleration(&self, body: usize, motion: &BodyMotion) -> Acceleration {
        let Some(prescribed) = &self.body(body).motion else { return Acceleration::zero() };
        Acceleration { linear: prescribed.acceleration(motion), angular: Vector3::zeros() }
    }

    /// When the velocity of a body that is moved jumps next, behind `t` [s].
    pub(super) fn next_jump(&self, body: usize, t: f64) -> f64 {
        self.body(body).motion.as_ref().map_or(f64::INFINITY, |motion| motion.next_switch(t))
    }

    /// Opens the window at `now` [s] of a body that is moved; the box that it sweeps in it.
    pub(super) fn open_window_of_moved(&mut self, body: usize, now: f64) -> Option<Aabb> {
        let planned = self.body(body);
        let (motion, collider) = (planned.motion.as_ref()?, planned.collider.as_ref()?);
        let (ball, reach) = collider.bounding_ball();
        let center = Vector3::from(motion.center);
        let reach = reach + (ball - center).norm();
        let (velocity, _) = motion.velocities(now);
        let speed = velocity.norm();
        let jump = motion.next_switch(now).min(self.end);
        let swept = if speed > 0.0 { WINDOW * reach / speed } else { f64::INFINITY };
        let to = jump.min(now + swept);

        let here = planned.motion_at(Time::new(now)).point(&center);
        let way = if to.is_finite() { (to - now) * velocity } else { Vector3::zeros() };
        let ends = Aabb::of_ball(&here, reach).joined(&Aabb::of_ball(&(here + way), reach));
        let rounding = EPS_ROUNDING * (ends.low.amax() + ends.high.amax());
        let aabb = ends.grown(rounding + self.reach_of(reach));
        let number = self.near.open(body, to, Some(aabb));
        if to < self.end {
            self.near.due.push(Due { time: Time::new(to), what: What::Window { body, number } });
        }
        Some(aabb)
    }
}
