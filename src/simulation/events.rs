//! Impacts as they come: windows, and times of impact within them.

use std::ops::ControlFlow;

use super::near::{Due, What};
use super::path::Path;
use super::{Failure, Simulation, SimulationError};
use crate::closest::PairCache;
use crate::contact::broad_phase::Aabb;
use crate::error::Error;
use crate::impact::{Found, Moving, Outcome, first_impact_by};
use crate::math::Vector3;
use crate::math::sum::Time;
use crate::plan::EPS_ROUNDING;
use crate::shape::Shape;
use crate::state::BodyMotion;
use crate::tolerance::{IMPACT_GAP, TOUCH_GAP};
use crate::trajectory::Trajectory;

/// How far a body moves in a window, in its own radii [-]. Longer: more pairs are looked at; shorter: more
/// windows are opened. Results do not depend on it.
pub(super) const WINDOW: f64 = 2.0;
/// How many ε the loads would part bodies by while those that were let go are not looked at [-].
const LEAVES: f64 = 4.0;
/// Grazes of one pair in one search after which it is said to touch [-].
const GRAZES: u32 = 1000;

impl Simulation {
    /// Advances every body that may meet another to the time `to` [s]; `tell` is told the part that is done.
    pub(super) fn advance_meeting(
        &mut self,
        to: f64,
        record: &mut Option<&mut Trajectory>,
        tell: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), SimulationError> {
        if self.near.windows.is_empty() && !self.open_all(record)? {
            return Ok(());
        }
        let start = self.time;
        while let Some(&due) = self.near.due.peek() {
            let last = self.ended.as_ref().map_or(to, |(time, _)| time.min(to));
            if due.time.value > last {
                break;
            }
            self.near.due.pop();
            match due.what {
                What::Window { body, number } => {
                    if self.near.windows[body].is_some_and(|window| window.number == number) {
                        self.open_window(body, due.time.value, record)?;
                    }
                }
                What::Touch { bodies, flights, iterations } => {
                    if bodies.map(|i| self.flight_number(i)) == flights {
                        self.answer(&bodies, due.time, iterations, record)?;
                    }
                }
                What::Step { slot, number } => {
                    let part = self.together[slot].as_ref().filter(|part| part.number == number);
                    if let Some(part) = part.filter(|_| due.time.value < self.end) {
                        let bodies = part.bodies.clone();
                        self.answer(&bodies, due.time, 0, record)?;
                    }
                }
                What::Break { bodies, flight } => {
                    if self.flight_number(bodies[1]) == flight {
                        self.break_joint(bodies, due.time, record)?;
                    }
                }
                What::Wake { body, number } => {
                    if self.flight_number(body) == number {
                        self.jump(body, due.time);
                        self.answer(&[body], due.time, 0, record)?;
                    }
                }
            }
            if tell((due.time.value - start) / (to - start)).is_break() {
                return Err(self.failure_of(&[], due.time.value, Failure::Interrupted));
            }
        }
        Ok(())
    }

    /// Opens the window of every body that may meet another; whether there is one.
    fn open_all(&mut self, record: &mut Option<&mut Trajectory>) -> Result<bool, SimulationError> {
        let plan = self.plan.clone();
        if plan.groups().iter().all(|group| !group.meets) {
            return Ok(false);
        }
        self.near.windows = vec![None; plan.bodies().len()];
        for (i, body) in plan.bodies().iter().enumerate().filter(|(_, body)| body.fixed && body.motion.is_none()) {
            let Some(collider) = &body.collider else { continue };
            let (center, reach) = collider.bounding_ball();
            let center = body.start.point(&(center - body.properties.center_of_mass));
            let aabb = reach.is_finite().then(|| Aabb::of_ball(&center, reach));
            self.near.open(i, f64::INFINITY, aabb);
        }
        for (i, body) in plan.bodies().iter().enumerate().filter(|(_, body)| !body.fixed || body.motion.is_some()) {
            if body.collider.is_some() {
                self.open_window(i, self.time, record)?;
            }
        }
        Ok(true)
    }

    /// Opens a body's window at `now` [s] and searches the pairs that it makes.
    pub(super) fn open_window(
        &mut self,
        body: usize,
        now: f64,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        if now >= self.end {
            return Ok(());
        }
        let Some((lane, _)) = self.places[body] else {
            let aabb = self.open_window_of_moved(body, now);
            let Some(aabb) = aabb else { return Ok(()) };
            self.wake_around(body, &aabb, now);
            return self.search_around(body, &aabb, now);
        };
        if !self.lanes[lane].is_led() {
            self.step_over(lane, now, record)?;
        }

        // as long as the body takes for some of its radii
        let front = self.lanes[lane].flight.front();
        let radius = self.reach_from_center(body);
        let (from, sag, ends) = {
            let path = self.path(body, now);
            let here = path.at(0.0);
            let (speed, left) = (here.velocity.norm(), front - now);
            let mut h = if speed * left > WINDOW * radius { WINDOW * radius / speed } else { left };
            let bounds = path.bounds(0.0, h);
            let bend = bounds.acceleration.norm() + bounds.deviation;
            if bend * h * h > 2.0 * WINDOW * radius {
                h = (2.0 * WINDOW * radius / bend).sqrt();
            }
            let ends = Aabb::of_ball(&here.center, radius).joined(&Aabb::of_ball(&path.at(h).center, radius));
            (now + h, 0.125 * bend * h * h, ends)
        };
        let rounding = EPS_ROUNDING * (ends.low.amax() + ends.high.amax());
        let to = if from > now { from.min(front) } else { front };
        let aabb = ends.grown(sag + rounding + self.reach_of(radius));
        let number = self.near.open(body, to, Some(aabb));
        if to < self.end && !(self.lanes[lane].is_led() && to >= front) {
            self.near.due.push(Due { time: Time::new(to), what: What::Window { body, number } });
        }

        self.search_around(body, &aabb, now)
    }

    /// Searches the pairs of a body with those that it may meet within its window.
    fn search_around(&mut self, body: usize, aabb: &Aabb, now: f64) -> Result<(), SimulationError> {
        let mut others = Vec::new();
        self.near.around(aabb, &mut others);
        for other in others {
            if self.may_meet(body, other) {
                self.search(body, other, now)?;
            }
        }
        Ok(())
    }

    /// Steps until the motion of a lane is known beyond `now` [s].
    pub(super) fn step_over(
        &mut self,
        lane: usize,
        now: f64,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        while now < self.end && (self.lanes[lane].pending.is_none() || self.lanes[lane].flight.front() <= now) {
            self.finish_step(lane, record)?;
            self.take_step(lane, record)?;
        }
        Ok(())
    }

    /// Searches a pair from `now` [s] to where the first of its windows ends.
    fn search(&mut self, a: usize, b: usize, now: f64) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let [a, b] = if plan.bodies()[b].fixed || (!plan.bodies()[a].fixed && b < a) { [b, a] } else { [a, b] };
        let [Some(window_a), Some(window_b)] = [a, b].map(|i| self.near.windows[i]) else { return Ok(()) };
        let [Some(shape_a), Some(shape_b)] = [a, b].map(|i| plan.bodies()[i].collider.as_deref()) else {
            return Ok(());
        };
        let stands = |i: usize| if self.places[i].is_some() { self.is_held(i) } else { !self.body(i).is_moved(now) };
        if stands(a) && stands(b) {
            return Ok(());
        }
        let until = window_a.to.min(window_b.to).min(self.end) - now;
        if until <= 0.0 || self.is_beyond(a, b) || self.are_together([a, b]) {
            return Ok(());
        }
        let eps = self.eps(a, b);
        let leaving = self.leaving(a, b, now, eps);
        let (mut from, mut iterations) = (0.0, 0);
        for _ in 0..GRAZES {
            let found = {
                let (path_a, path_b) = (self.path(a, now), self.path(b, now));
                let pair = ((shape_a.into(), &path_a as &dyn Moving), (shape_b.into(), &path_b as &dyn Moving));
                first_impact_by(self.plan.options().finder, pair.0, pair.1, from, until, eps, &mut PairCache::new())
            };
            let refused = |error: Error| self.failure_of(&[a, b], now, Failure::Refused(error.to_string()));
            let Found { outcome, time, iterations: rounds, until: searched, .. } = found.map_err(refused)?;
            iterations += rounds;
            match outcome {
                // what the laws of contact have just let go opens too slowly to be told from what stays
                Outcome::AlreadyTouching if from == 0.0 && time == 0.0 && leaving > 0.0 => {
                    from = leaving;
                    if from >= until {
                        return Ok(());
                    }
                }
                Outcome::At | Outcome::AlreadyTouching => {
                    let flights = [a, b].map(|i| self.flight_number(i));
                    let what = What::Touch { bodies: [a, b], flights, iterations };
                    self.near.due.push(Due { time: Time::new(now) + time, what });
                    return Ok(());
                }
                Outcome::Grazing if searched > from && searched < until => from = searched,
                Outcome::Clear | Outcome::Grazing => return Ok(()),
                Outcome::Overlap => {
                    let depth = -self.closest(a, b, Time::new(now) + time)?.signed_distance;
                    return Err(self.failure_of(&[a, b], now + time, Failure::Overlap(depth)));
                }
                Outcome::Stalled => return Err(self.failure_of(&[a, b], now + time, Failure::Stalled(eps))),
            }
        }
        let why = format!("{GRAZES} grazes in one search");
        Err(self.failure_of(&[a, b], now, Failure::AccumulatingImpacts(why)))
    }

    /// Whether two bodies are led together, touching: their steps look after their gap.
    fn are_together(&self, pair: [usize; 2]) -> bool {
        let slot = pair.iter().find_map(|&body| self.slot(body));
        let part = slot.and_then(|slot| self.together[slot].as_ref());
        part.is_some_and(|part| part.pairs.contains(&pair))
    }

    /// A time [s] in which bodies that were let go at this instant come apart by some ε: by the speed with which
    /// they open, or by what their loads do. No point moves farther meanwhile than the points of a contact may
    /// lie apart. Of other bodies it is 0.
    fn leaving(&self, a: usize, b: usize, now: f64, eps: f64) -> f64 {
        let Some((_, opening)) = self.released.iter().find(|(pair, _)| *pair == [a, b]) else { return 0.0 };
        let parting = if self.parts_at([a, b], now) { self.parting(a, b, now) } else { 0.0 };
        let (mut acceleration, mut speed) = (Vector3::zeros(), 0.0);
        for (body, sign) in [(a, -1.0), (b, 1.0)] {
            let unit = self.unit(body);
            let Some((lane, member)) = self.places[unit] else {
                if self.body(body).motion.is_some() {
                    let motion = self.body(body).motion_at(Time::new(now));
                    let other = self.motion_at(if body == a { b } else { a }, Time::new(now)).position;
                    let (w, arm) = (motion.angular_velocity, other - motion.position);
                    let own = self.unmoved_acceleration(body, &motion).linear;
                    acceleration += sign * (own + w.cross(&w.cross(&arm)));
                    speed += motion.velocity_at(&other).norm();
                }
                continue;
            };
            let motion = self.lanes[lane].motions[member];
            let front = self.lanes[lane].flight.front();
            acceleration += match self.chart(unit).filter(|chart| chart.is_reduced()) {
                Some(_) => sign * self.free_acceleration(unit, lane, &self.cluster_body(unit, &motion), front).linear,
                None => sign / motion.mass * self.load_on(lane, &motion, self.moment(lane, front)).force,
            };
            speed += motion.velocity.norm() + motion.angular_velocity.norm() * self.body(unit).radius;
        }
        let by_speed = if *opening > 0.0 { LEAVES * eps / opening } else { f64::INFINITY };
        let pull = if parting > 0.0 { parting } else { acceleration.norm() };
        let by_load = if pull > 0.0 { (2.0 * LEAVES * eps / pull).sqrt() } else { f64::INFINITY };
        let longest = if speed > 0.0 { TOUCH_GAP * self.size(a, b) / speed } else { f64::INFINITY };
        let time = by_speed.min(by_load);
        if time.is_finite() { time.min(longest) } else { 0.0 }
    }

    /// Whether the box of b, which moves, is beyond the plane of a half space a.
    fn is_beyond(&self, a: usize, b: usize) -> bool {
        let (body, aabb) = (&self.plan.bodies()[a], self.near.windows[b].and_then(|window| window.aabb));
        let Some(Shape::HalfSpace(plane)) = &self.plan.scene().bodies[a].shape else { return false };
        let Some(aabb) = aabb else { return false };
        let given = Vector3::from(plane.normal);
        let normal = body.start.rotation * (given / given.norm());
        let offset = plane.offset / given.norm() + normal.dot(&body.start.position);
        let lowest: f64 = (0..3).map(|i| (normal[i] * aabb.low[i]).min(normal[i] * aabb.high[i])).sum();
        lowest - offset > EPS_ROUNDING * (offset.abs() + aabb.low.amax() + aabb.high.amax())
    }

    /// The motion of a body from `now` [s] on, within its open step.
    fn path(&self, body: usize, now: f64) -> Path<'_> {
        let planned = &self.plan.bodies()[body];
        let center = planned.properties.center_of_mass;
        let Some((lane, member)) = self.places[body] else { return self.unmoved_path(body, now) };
        let lane = &self.lanes[lane];
        let segment = lane.flight.segment();
        Path::new(segment, &lane.charts, &lane.motions, member, now - segment.start, center)
    }

    /// The motion of a body at an instant within its open step.
    pub(super) fn motion_at(&self, body: usize, time: Time) -> BodyMotion {
        let Some((lane, member)) = self.places[body] else { return self.body(body).motion_at(time) };
        if let Some(driver) = self.driver_of(body) {
            let whole = &self.lanes[lane].motions[0];
            let carrier =
                BodyMotion { mass: whole.mass, inertia_body: whole.inertia_body, ..self.carrier(driver, time) };
            return self.part_motion(body, &carrier);
        }
        self.motions_at(lane, time)[member]
    }

    /// The motions of the members of a lane at an instant within its open step.
    pub(super) fn motions_at(&self, lane: usize, time: Time) -> Vec<BodyMotion> {
        let lane = &self.lanes[lane];
        let mut motions = lane.motions.clone();
        if lane.pending.is_some() {
            lane.flight.at_offset((time.value - lane.flight.segment().start) + time.rest, &mut motions);
        } else {
            lane.flight.at(time.value, &mut motions);
        }
        motions
    }

    /// How many flights the body has begun.
    pub(super) fn flight_number(&self, body: usize) -> u64 {
        self.places[body].map_or(0, |(lane, _)| self.lanes[lane].number)
    }

    /// Whether a body is held where it is.
    pub(super) fn is_held(&self, body: usize) -> bool {
        let unit = self.unit(body);
        self.places[unit].is_some_and(|(lane, _)| self.lanes[lane].held.contains(&unit))
    }

    /// The gap asked for, as this pass takes it [m].
    pub(super) fn eps_given(&self) -> Option<f64> {
        self.plan.options().eps.map(|eps| self.grain.eps * eps)
    }

    /// Gap at which a contact of two bodies is accepted [m]; the search keeps it above rounding.
    pub(super) fn eps(&self, a: usize, b: usize) -> f64 {
        self.eps_given().unwrap_or(self.grain.eps * IMPACT_GAP * self.size(a, b))
    }

    pub(super) fn failure_of(&self, bodies: &[usize], time: f64, kind: Failure) -> SimulationError {
        let bodies = bodies.iter().map(|&i| self.body(i).name.clone()).collect();
        SimulationError { time, bodies, kind, trajectory: None }
    }
}
