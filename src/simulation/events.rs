//! Impacts as they come: windows, times of impact, and the answer of a cluster.

use std::ops::ControlFlow;

use super::near::{Due, What};
use super::path::Path;
use super::{Failure, Simulation, SimulationError};
use crate::closest::{Accuracy, ClosestFeatures, Collidable, Collider, PairCache, closest_features};
use crate::contact::accumulation::rest_speed;
use crate::contact::broad_phase::Aabb;
use crate::contact::cluster::{ClusterBody, ClusterError, Contact, Velocity};
use crate::contact::collision::{Collision, Law, collide};
use crate::contact::manifold::{Surface, Touch, manifold};
use crate::contact::{Answer, Material, Response, stick};
use crate::effect::AnyEffect;
use crate::error::Error;
use crate::impact::{Found, Moving, Outcome, first_impact_by};
use crate::math::sum::Time;
use crate::math::{Pose, Vector3, quaternion};
use crate::plan::EPS_ROUNDING;
use crate::shape::Shape;
use crate::state::{BodyMotion, Load, Moment};
use crate::tolerance::{IMPACT_GAP, TOUCH_GAP};
use crate::trajectory::{Event, EventKind, Trajectory};

/// How far a body moves in a window, in its own radii [-]. Longer: more pairs are looked at; shorter: more
/// windows are opened. Results do not depend on it.
const WINDOW: f64 = 2.0;
/// Impacts of one body at one instant after which it is said to rest [-]. Two planes that answer each
/// other with e < 1 are done to rounding after about 50.
const ROUNDS_AT_ONCE: u32 = 64;
/// Height of the hops by which a lasting contact is carried, as a fraction of the pair's size [-]. Smaller:
/// sliding, rolling and rocking are closer to the limit of no hops, in proportion to the square root, at as
/// many more events. No hop is needed for what bounces or rests.
const HOP: f64 = 1.0e-5;
/// Height of a bounce below which bodies rest, in ε [-]: a search tells bounces of a few ε from rest.
const REST_GAP: f64 = 4.0;
/// Speed that a plastic impact may leave, as a fraction of the approach, for the motion to count as dying
/// with its bounces [-].
const DIES: f64 = 1.0;
/// Acceleration that contact forces may leave of the loads' for an equilibrium [-]; solvers leave 1e-11.
const EQUILIBRIUM: f64 = 1.0e-9;
/// Rounds over the contacts in which bodies are lifted off each other [-]: enough for a stack of some ten.
const LIFTS: u32 = 256;
/// Grazes of one pair in one search after which it is said to touch [-].
const GRAZES: u32 = 1000;

/// Two bodies that touch, and where.
struct Touching {
    bodies: [usize; 2],
    closest: ClosestFeatures,
    /// Places of its contacts in the cluster's list.
    contacts: std::ops::Range<usize>,
}

/// The bodies that touch at an instant, one with another.
struct Cluster {
    /// As places in the scene.
    bodies: Vec<usize>,
    motions: Vec<BodyMotion>,
    touching: Vec<Touching>,
    contacts: Vec<Contact>,
    /// Bodies that rest from here on.
    resting: Vec<usize>,
    /// Whether bodies that rest stay where they are, since nothing comes with speed.
    is_gentle: bool,
}

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
        while let Some(&due) = self.near.due.peek().filter(|due| due.time.value <= to) {
            self.near.due.pop();
            match due.what {
                What::Window { body, number } => {
                    if self.near.windows[body].is_some_and(|window| window.number == number) {
                        self.open_window(body, due.time.value, record)?;
                    }
                }
                What::Touch { bodies, flights, iterations } => {
                    if bodies.map(|i| self.flight_number(i)) == flights {
                        self.answer(bodies, due.time, iterations, record)?;
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
        for (i, body) in plan.bodies().iter().enumerate().filter(|(_, body)| body.fixed) {
            let Some(collider) = &body.collider else { continue };
            let (center, reach) = collider.bounding_ball();
            let center = body.start.point(&(center - body.properties.center_of_mass));
            let aabb = reach.is_finite().then(|| Aabb::of_ball(&center, reach));
            self.near.open(i, f64::INFINITY, aabb);
        }
        for (i, body) in plan.bodies().iter().enumerate().filter(|(_, body)| !body.fixed) {
            if body.collider.is_some() {
                self.open_window(i, self.time, record)?;
            }
        }
        Ok(true)
    }

    /// Opens a body's window at `now` [s] and searches the pairs that it makes.
    fn open_window(
        &mut self,
        body: usize,
        now: f64,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let Some((lane, _)) = self.places[body] else { return Ok(()) };
        if now >= self.end {
            return Ok(());
        }
        self.step_over(lane, now, record)?;

        // as long as the body takes for some of its radii
        let front = self.lanes[lane].flight.front();
        let radius = plan.bodies()[body].radius;
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
        if to < self.end {
            self.near.due.push(Due { time: Time::new(to), what: What::Window { body, number } });
        }

        // who may be met within it
        let mut others = Vec::new();
        self.near.around(&aabb, &mut others);
        for other in others {
            if other != body && plan.may_meet(body, other) {
                self.search(body, other, now)?;
            }
        }
        Ok(())
    }

    /// Steps until the motion of a lane is known beyond `now` [s].
    fn step_over(
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
        if [a, b].iter().all(|&i| self.places[i].is_none() || self.is_held(i)) {
            return Ok(());
        }
        let until = window_a.to.min(window_b.to).min(self.end) - now;
        if until <= 0.0 || self.is_beyond(a, b) {
            return Ok(());
        }
        let eps = self.eps(a, b);
        let (mut from, mut iterations) = (0.0, 0);
        for _ in 0..GRAZES {
            let found = {
                let (path_a, path_b) = (self.path(a, now), self.path(b, now));
                let pair = ((shape_a.into(), &path_a as &dyn Moving), (shape_b.into(), &path_b as &dyn Moving));
                first_impact_by(self.plan.options().finder, pair.0, pair.1, from, until, eps)
            };
            let refused = |error: Error| self.failure_of(&[a, b], now, Failure::Refused(error.to_string()));
            let Found { outcome, time, iterations: rounds, until: searched, .. } = found.map_err(refused)?;
            iterations += rounds;
            match outcome {
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

    /// Answers a touch of two bodies at `time`, together with all that touch them then.
    fn answer(
        &mut self,
        bodies: [usize; 2],
        time: Time,
        iterations: u32,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let mut cluster = self.cluster(bodies, time)?;
        for &body in cluster.bodies.iter().filter(|&&i| self.places[i].is_some()) {
            if self.near.count_hit(body, time.value) > ROUNDS_AT_ONCE {
                let why = format!("{ROUNDS_AT_ONCE} impacts at one instant");
                return Err(self.failure_of(&bodies, time.value, Failure::AccumulatingImpacts(why)));
            }
        }

        // bodies that stick to a fixed one stop; the others are answered all at once
        let before = cluster.motions.clone();
        let mut stuck: Vec<(usize, Answer, ClosestFeatures, usize)> = Vec::new();
        for touching in &cluster.touching {
            let [a, b] = touching.bodies;
            if plan.material(a, b).response != Response::Stick || !plan.bodies()[a].fixed {
                continue;
            }
            let Some(place) = cluster.place(b) else { continue };
            if self.is_held(b) || stuck.iter().any(|(body, ..)| *body == b) {
                continue;
            }
            let answer = stick::stick(&mut cluster.motions[place]);
            stuck.push((b, answer, touching.closest, a));
        }
        if stuck.is_empty() {
            self.respond(&mut cluster, &before, time, iterations)?;
        }
        for (body, answer, closest, obstacle) in &stuck {
            let (Some(place), group) = (cluster.place(*body), self.places[*body]) else { continue };
            if let Some((lane, _)) = group {
                self.lanes[lane].held.push(*body);
            }
            self.events.push(Event {
                time: time.value,
                kind: EventKind::Stick,
                bodies: [*obstacle, *body],
                point: closest.point_b,
                normal: closest.normal,
                impulse: answer.impulse,
                features: in_words(closest),
                iterations,
                velocity: [before[place].velocity, Vector3::zeros()],
                angular_velocity: [before[place].angular_velocity, Vector3::zeros()],
                other_velocity: [Vector3::zeros(); 2],
                other_angular_velocity: [Vector3::zeros(); 2],
                energy_lost: answer.energy_lost,
            });
        }
        self.iterations += u64::from(iterations);

        // those whose velocity has changed begin another flight, and those that rested on them
        let moved = |place: usize| {
            before[place].velocity != cluster.motions[place].velocity
                || before[place].angular_velocity != cluster.motions[place].angular_velocity
        };
        let any = (0..cluster.bodies.len()).any(moved);
        let mut lanes: Vec<usize> = Vec::new();
        for (place, &body) in cluster.bodies.iter().enumerate() {
            let Some((lane, _)) = self.places[body] else { continue };
            let rests = cluster.resting.contains(&body);
            let woken = any
                && !cluster.is_gentle
                && self.is_held(body)
                && !rests
                && plan.scene().bodies[body].response == Response::Bounce;
            if woken {
                self.lanes[lane].held.retain(|held| *held != body);
            }
            if (moved(place) || woken || rests) && !lanes.contains(&lane) {
                lanes.push(lane);
            }
        }
        lanes.sort_unstable();
        for &lane in &lanes {
            self.begin_flight(lane, time, &cluster, record)?;
            self.step_over(lane, time.value, record)?;
        }
        for &lane in &lanes {
            for &body in &plan.groups()[self.lanes[lane].group].members {
                if plan.bodies()[body].collider.is_some() && self.places[body].is_some() {
                    self.open_window(body, time.value, record)?;
                }
            }
        }
        if lanes.is_empty() && stuck.is_empty() {
            let why = "bodies rest on each other: no impact moves them, and something presses them together";
            return Err(self.failure_of(&bodies, time.value, Failure::AccumulatingImpacts(why.to_owned())));
        }
        Ok(())
    }

    /// All that touches at `time`, starting from two bodies that do.
    fn cluster(&self, [a, b]: [usize; 2], time: Time) -> Result<Cluster, SimulationError> {
        let plan = &self.plan;
        let mut cluster = Cluster {
            bodies: Vec::new(),
            motions: Vec::new(),
            touching: Vec::new(),
            contacts: Vec::new(),
            resting: Vec::new(),
            is_gentle: false,
        };
        for body in [a, b] {
            cluster.add(body, self.motion_at(body, time));
        }
        let (mut next, mut others) = (0, Vec::new());
        while next < cluster.bodies.len() {
            let (body, motion) = (cluster.bodies[next], cluster.motions[next]);
            next += 1;
            if plan.bodies()[body].fixed {
                continue;
            }
            let radius = plan.bodies()[body].radius;
            self.near.around(&Aabb::of_ball(&motion.position, radius + self.reach_of(radius)), &mut others);
            for &other in others.iter().filter(|&&other| other != body && plan.may_meet(body, other)) {
                let pair = if plan.bodies()[other].fixed || other < body { [other, body] } else { [body, other] };
                if cluster.touching.iter().any(|touching| touching.bodies == pair) {
                    continue;
                }
                let closest = self.closest(pair[0], pair[1], time)?;
                let reach = self.eps(pair[0], pair[1]) + TOUCH_GAP * self.size(pair[0], pair[1]);
                if closest.signed_distance > reach {
                    continue;
                }
                let places = [pair[0], pair[1]].map(|i| cluster.add(i, self.motion_at(i, time)));
                let material = plan.material(pair[0], pair[1]);
                let first = cluster.contacts.len();
                cluster.contacts.extend(self.contacts_of(pair, time, places, &material, reach)?);
                let contacts = first..cluster.contacts.len();
                cluster.touching.push(Touching { bodies: pair, closest, contacts });
            }
        }
        Ok(cluster)
    }

    /// The points in which two bodies touch: of every two pieces within `reach` [m] all that carry.
    fn contacts_of(
        &self,
        pair: [usize; 2],
        time: Time,
        places: [usize; 2],
        material: &Material,
        reach: f64,
    ) -> Result<Vec<Contact>, SimulationError> {
        let mut contacts = Vec::new();
        let [Some(a), Some(b)] = pair.map(|i| self.plan.bodies()[i].collider.as_deref()) else { return Ok(contacts) };
        let [shape_a, shape_b] = pair.map(|i| self.plan.scene().bodies[i].shape.as_ref());
        let [pose_a, pose_b] = pair.map(|i| self.pose_at(i, time));
        let (whole_a, whole_b) = (Collidable::from(a), Collidable::from(b));
        for i in 0..whole_a.pieces() {
            for j in 0..whole_b.pieces() {
                let (piece_a, piece_b) = (whole_a.piece(i), whole_b.piece(j));
                let closest = piece_a
                    .closest(&pose_a, &piece_b, &pose_b, &mut PairCache::new(), Accuracy::Exact)
                    .map_err(|error| self.failure_of(&pair, time.value, Failure::Refused(error.to_string())))?;
                if closest.signed_distance > reach {
                    continue;
                }
                let surfaces = (surface(shape_a, a, i), surface(shape_b, b, j));
                let (Some((surface_a, at_a)), Some((surface_b, at_b))) = surfaces else { continue };
                let (at_a, at_b) = (placed(&pose_a, &at_a), placed(&pose_b, &at_b));
                let found = manifold(&surface_a, &at_a, &surface_b, &at_b, &Touch::from(&closest), reach);
                contacts.extend(found.contacts(places[0], places[1], material.friction, material.restitution));
            }
        }
        Ok(contacts)
    }

    /// Answers the impact of a cluster: a bounce, a hop of bodies that stay in contact, or rest.
    ///
    /// ```text
    /// u ≥ v_hop                                      a bounce
    /// u < v_hop, a plastic impact leaves motion      a hop: with e = 1, and never slower than v_hop/2
    /// u < v_hop, a plastic impact leaves none        a bounce, down to v_rest; then rest, if there is
    ///                                                equilibrium, else a hop
    /// v_hop = √(2 a HOP size)        v_rest = √(2 a ε)        a: the loads' acceleration
    /// ```
    ///
    /// u is the fastest approach of the cluster. Below `v_hop` bodies that rest already count as fixed, unless
    /// the equilibrium fails. Hops carry a lasting contact: their impulses in the mean are
    /// its forces, friction included, with an error of first order in `v_hop`.
    fn respond(
        &mut self,
        cluster: &mut Cluster,
        before: &[BodyMotion],
        time: Time,
        iterations: u32,
    ) -> Result<(), SimulationError> {
        let refused = |this: &Self, bodies: &[usize], why: ClusterError| {
            let why = Failure::Refused(format!("the impact cannot be answered: {why}"));
            this.failure_of(bodies, time.value, why)
        };
        let pulls: Vec<(Vector3, Vector3)> =
            cluster.bodies.iter().zip(before).map(|(&body, motion)| self.pull(body, motion, time)).collect();
        let pull = pulls.iter().map(|(a, _)| a.norm()).fold(0.0, f64::max);
        let size = cluster.touching.iter().map(|t| self.size(t.bodies[0], t.bodies[1])).fold(f64::INFINITY, f64::min);
        let (hop, rest) = ((2.0 * pull * HOP * size).sqrt(), rest_speed(pull, REST_GAP * self.eps_of(size)));
        let approach = cluster.contacts.iter().map(|c| cluster.approach(c)).fold(0.0, f64::max);

        let mut kind = EventKind::Bounce;
        let mut contacts = cluster.contacts.clone();
        if approach < hop {
            cluster.is_gentle = true;
            let plastic: Vec<Contact> = contacts.iter().map(|c| c.clone().restitution(0.0)).collect();
            let after = self.collide(cluster, &cluster.motions, &plastic);
            let after = after.map_err(|why| refused(self, &cluster.bodies, why))?;
            let left = self.fastest(cluster, &after);
            let dies = left <= DIES * approach.max(rest);
            if dies && approach <= rest {
                cluster.is_gentle = false;
                if self.may_rest(cluster, &pulls).map_err(|why| refused(self, &cluster.bodies, why))? {
                    self.lay_down(cluster, before, &after, time, iterations);
                    return Ok(());
                }
            }
            if !dies || approach <= rest {
                kind = EventKind::Hop;
                for contact in &mut contacts {
                    contact.restitution = 1.0;
                }
            }
        }

        let collision = self.collide(cluster, &cluster.motions, &contacts);
        let collision = collision.map_err(|why| refused(self, &cluster.bodies, why))?;
        for (motion, velocity) in cluster.motions.iter_mut().zip(&collision.velocities) {
            (motion.velocity, motion.angular_velocity) = (velocity.linear, velocity.angular);
        }
        if kind == EventKind::Hop && approach < 0.5 * hop {
            self.lift(cluster, 0.5 * hop);
        }
        self.book(cluster, before, &collision, time, iterations, kind);
        Ok(())
    }

    /// The velocities after the impact of a cluster.
    fn collide(
        &self,
        cluster: &Cluster,
        motions: &[BodyMotion],
        contacts: &[Contact],
    ) -> Result<Collision, ClusterError> {
        let body = |(&body, motion): (&usize, &BodyMotion)| {
            if self.places[body].is_none() || (cluster.is_gentle && self.is_held(body)) {
                ClusterBody::driven(motion)
            } else {
                ClusterBody::free(motion, &self.plan.bodies()[body].properties.inv_inertia())
            }
        };
        let bodies: Vec<ClusterBody> = cluster.bodies.iter().zip(motions).map(body).collect();
        collide(&bodies, contacts, Law::default())
    }

    /// The largest speed of a point of a moving body after an impact [m/s].
    fn fastest(&self, cluster: &Cluster, after: &Collision) -> f64 {
        let speed = |(&body, v): (&usize, &Velocity)| {
            if self.places[body].is_none() {
                return 0.0;
            }
            v.linear.norm() + v.angular.norm() * self.plan.bodies()[body].radius
        };
        cluster.bodies.iter().zip(&after.velocities).map(speed).fold(0.0, f64::max)
    }

    /// Acceleration [m/s²] and angular acceleration [rad/s²] that the effects give a body at rest.
    fn pull(&self, body: usize, motion: &BodyMotion, time: Time) -> (Vector3, Vector3) {
        let none = (Vector3::zeros(), Vector3::zeros());
        let Some((lane, member)) = self.places[body] else { return none };
        let spec = &self.plan.groups()[self.lanes[lane].group];
        let still = BodyMotion { velocity: Vector3::zeros(), angular_velocity: Vector3::zeros(), ..*motion };
        let mut load = [Load::zero()];
        for binding in spec.bindings.iter().filter(|binding| binding.members == [member]) {
            let at = Moment { time: time.value, since: time.value };
            binding.effect.as_effect().add_to(at, &[still], &mut load);
        }
        let inverse = motion.rotation * self.plan.bodies()[body].properties.inv_inertia() * motion.rotation.transpose();
        (load[0].force / motion.mass, inverse * load[0].torque)
    }

    /// Whether the loads of a cluster's bodies, all of them at rest, are in equilibrium with forces in their
    /// contacts: whether a plastic impact undoes what the loads would add to the velocities.
    fn may_rest(&self, cluster: &Cluster, pulls: &[(Vector3, Vector3)]) -> Result<bool, ClusterError> {
        // what changes with time, or comes from other bodies, is not known to stay
        let steady = |&body: &usize| {
            let Some((lane, _)) = self.places[body] else { return true };
            let spec = &self.plan.groups()[self.lanes[lane].group];
            spec.members.len() == 1
                && spec.bindings.iter().all(|binding| {
                    matches!(
                        *binding.effect,
                        AnyEffect::UniformGravity(_) | AnyEffect::Drag(_) | AnyEffect::PointGravity(_)
                    )
                })
        };
        if !cluster.bodies.iter().all(steady) {
            return Ok(false);
        }
        let mut pulled = cluster.motions.clone();
        for (motion, (a, alpha)) in pulled.iter_mut().zip(pulls) {
            (motion.velocity, motion.angular_velocity) = (*a, *alpha);
        }
        let contacts: Vec<Contact> = cluster.contacts.iter().map(|c| c.clone().restitution(0.0)).collect();
        let after = self.collide(cluster, &pulled, &contacts)?;
        let pull = pulls.iter().map(|(a, _)| a.norm()).fold(0.0, f64::max);
        Ok(self.fastest(cluster, &after) <= EQUILIBRIUM * pull)
    }

    /// Brings the moving bodies of a cluster to rest where they are.
    fn lay_down(
        &mut self,
        cluster: &mut Cluster,
        before: &[BodyMotion],
        plastic: &Collision,
        time: Time,
        iterations: u32,
    ) {
        for (motion, &body) in cluster.motions.iter_mut().zip(&cluster.bodies) {
            let Some((lane, _)) = self.places[body] else { continue };
            (motion.velocity, motion.angular_velocity) = (Vector3::zeros(), Vector3::zeros());
            cluster.resting.push(body);
            if !self.lanes[lane].held.contains(&body) {
                self.lanes[lane].held.push(body);
            }
        }
        self.book(cluster, before, plastic, time, iterations, EventKind::Rest);
    }

    /// Lets the bodies of every contact of a cluster part with at least this speed [m/s], by shifting
    /// velocities without turning them; two moving bodies share it so that their momentum stays.
    fn lift(&self, cluster: &mut Cluster, speed: f64) {
        let mass = |place: usize| {
            let body = cluster.bodies[place];
            let stays = self.places[body].is_none() || (cluster.is_gentle && self.is_held(body));
            if stays { f64::INFINITY } else { cluster.motions[place].mass }
        };
        let masses: Vec<f64> = (0..cluster.bodies.len()).map(mass).collect();
        for _ in 0..LIFTS {
            let mut parted = true;
            for contact in &cluster.contacts {
                let (a, b) = (contact.a, contact.b);
                let Some(n) = contact.normals.iter().sum::<Vector3>().try_normalize(0.0) else { continue };
                let [v_a, v_b] = [a, b].map(|k| cluster.motions[k].velocity_at(&contact.point));
                let missing = speed - n.dot(&(v_b - v_a));
                if missing <= 1e-3 * speed {
                    continue;
                }
                if masses[a].is_infinite() && masses[b].is_infinite() {
                    continue;
                }
                parted = false;
                let share = if masses[a].is_infinite() { 1.0 } else { 1.0 / (1.0 + masses[b] / masses[a]) };
                cluster.motions[b].velocity += missing * share * n;
                cluster.motions[a].velocity -= missing * (1.0 - share) * n;
            }
            if parted {
                return;
            }
        }
    }

    /// Books one event for every pair that took an impulse.
    fn book(
        &mut self,
        cluster: &Cluster,
        before: &[BodyMotion],
        collision: &Collision,
        time: Time,
        mut iterations: u32,
        kind: EventKind,
    ) {
        // what comes to rest loses all that it had
        let mut at_rest: f64 = cluster
            .bodies
            .iter()
            .zip(before)
            .filter(|(i, _)| cluster.resting.contains(i))
            .map(|(_, m)| m.kinetic_energy())
            .sum();
        for touching in &cluster.touching {
            let range = touching.contacts.clone();
            let impulses = &collision.impulses[range.clone()];
            let impulse: Vector3 = impulses.iter().sum();
            if impulse == Vector3::zeros() && kind != EventKind::Rest {
                continue;
            }
            let weight: f64 = impulses.iter().map(Vector3::norm).sum();
            let contacts = &cluster.contacts[range];
            let part = |j: &Vector3| if weight > 0.0 { j.norm() / weight } else { 1.0 / contacts.len() as f64 };
            let point = contacts.iter().zip(impulses).map(|(c, j)| part(j) * c.point).sum();
            let [Some(a), Some(b)] = touching.bodies.map(|i| cluster.place(i)) else { continue };
            let after = &cluster.motions;

            // what the contact took: −½ j·(u⁻ + u⁺), summed over its points
            let speed = |motions: &[BodyMotion], p: &Vector3| motions[b].velocity_at(p) - motions[a].velocity_at(p);
            let lost = |(c, j): (&Contact, &Vector3)| -0.5 * j.dot(&(speed(before, &c.point) + speed(after, &c.point)));
            self.events.push(Event {
                time: time.value,
                kind,
                bodies: touching.bodies,
                point,
                normal: touching.closest.normal,
                impulse,
                features: in_words(&touching.closest),
                iterations,
                velocity: [before[b].velocity, after[b].velocity],
                angular_velocity: [before[b].angular_velocity, after[b].angular_velocity],
                other_velocity: [before[a].velocity, after[a].velocity],
                other_angular_velocity: [before[a].angular_velocity, after[a].angular_velocity],
                energy_lost: if kind == EventKind::Rest {
                    std::mem::take(&mut at_rest)
                } else {
                    contacts.iter().zip(impulses).map(lost).sum()
                },
            });
            iterations = 0; // the rounds belong to the pair that was searched, not to those that came along
        }
    }

    /// Cuts a lane's flight at `time` and begins another from the cluster's motions.
    fn begin_flight(
        &mut self,
        index: usize,
        time: Time,
        cluster: &Cluster,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let plan = self.plan.clone();
        let members = &plan.groups()[self.lanes[index].group].members;
        let mut motions = self.lanes[index].motions.clone();
        for (motion, &member) in motions.iter_mut().zip(members) {
            *motion =
                cluster.place(member).map_or_else(|| self.motion_at(member, time), |place| cluster.motions[place]);
        }
        let lane = &mut self.lanes[index];
        if lane.pending.is_some() {
            let offset = (time.value - lane.flight.segment().start) + time.rest;
            if offset < lane.flight.segment().length {
                lane.flight.cut(offset);
            }
        }
        self.finish_step(index, record)?;

        let lane = &mut self.lanes[index];
        lane.earlier.add(lane.flight.counts());
        let (_, since) = lane.flight.clock();
        let begun = plan
            .flight_for(lane.group, time.value, &self.controls[lane.group], &motions, &lane.held)
            .and_then(|flight| Ok((flight, plan.charts(lane.group, &lane.held)?)))
            .and_then(|(flight, charts)| {
                if let (Some(run), true) = (record.as_mut(), charts != lane.charts) {
                    lane.phase = run.phases.len();
                    run.phases.push(plan.phase(lane.group, time.value, &motions, &lane.held)?);
                }
                Ok((flight, charts))
            });
        match begun {
            Ok((flight, charts)) => {
                lane.flight = flight;
                lane.flight.set_clock(time, since);
                (lane.charts, lane.motions, lane.number) = (charts, motions, lane.number + 1);
                Ok(())
            }
            Err(error) => Err(self.failure(index, time.value, Failure::Refused(error.to_string()))),
        }
    }

    /// The motion of a body from `now` [s] on, within its open step.
    fn path(&self, body: usize, now: f64) -> Path<'_> {
        let planned = &self.plan.bodies()[body];
        let center = planned.properties.center_of_mass;
        let Some((lane, member)) = self.places[body] else { return Path::resting(&planned.start, center) };
        let lane = &self.lanes[lane];
        let segment = lane.flight.segment();
        Path::new(segment, &lane.charts, &lane.motions, member, now - segment.start, center)
    }

    /// The motion of a body at an instant within its open step.
    fn motion_at(&self, body: usize, time: Time) -> BodyMotion {
        let Some((lane, member)) = self.places[body] else { return self.plan.bodies()[body].start };
        let lane = &self.lanes[lane];
        let mut motions = lane.motions.clone();
        if lane.pending.is_some() {
            lane.flight.at_offset((time.value - lane.flight.segment().start) + time.rest, &mut motions);
        } else {
            lane.flight.at(time.value, &mut motions);
        }
        motions[member]
    }

    /// Where the axes of a body's shape stand at an instant.
    fn pose_at(&self, body: usize, time: Time) -> Pose {
        let motion = self.motion_at(body, time);
        let center = self.plan.bodies()[body].properties.center_of_mass;
        Pose { position: motion.point(&-center), orientation: motion.orientation }
    }

    /// The closest features of two bodies at an instant.
    fn closest(&self, a: usize, b: usize, time: Time) -> Result<ClosestFeatures, SimulationError> {
        let [Some(shape_a), Some(shape_b)] = [a, b].map(|i| self.plan.bodies()[i].collider.as_deref()) else {
            return Err(self.failure_of(&[a, b], time.value, Failure::Refused("no shape".to_owned())));
        };
        let [pose_a, pose_b] = [a, b].map(|i| self.pose_at(i, time));
        let mut cache = PairCache::new();
        closest_features(shape_a, &pose_a, shape_b, &pose_b, Some(&mut cache), Accuracy::Exact)
            .map_err(|error| self.failure_of(&[a, b], time.value, Failure::Refused(error.to_string())))
    }

    /// How many flights the body has begun.
    fn flight_number(&self, body: usize) -> u64 {
        self.places[body].map_or(0, |(lane, _)| self.lanes[lane].number)
    }

    /// Whether a body is held where it is.
    fn is_held(&self, body: usize) -> bool {
        self.places[body].is_some_and(|(lane, _)| self.lanes[lane].held.contains(&body))
    }

    /// Size of a pair [m], by which its tolerances are measured: both radii; a fixed body counts as the other.
    fn size(&self, a: usize, b: usize) -> f64 {
        self.plan.bodies()[a].radius + self.plan.bodies()[b].radius
    }

    /// How much farther than its box a body's neighbours are looked for [m].
    fn reach_of(&self, radius: f64) -> f64 {
        self.plan.options().eps.unwrap_or(0.0) + 2.0 * TOUCH_GAP * radius
    }

    /// Gap at which a contact of two bodies is accepted [m]; the search keeps it above rounding.
    fn eps(&self, a: usize, b: usize) -> f64 {
        self.eps_of(self.size(a, b))
    }

    /// The same for a pair of this size [m].
    fn eps_of(&self, size: f64) -> f64 {
        self.plan.options().eps.unwrap_or(IMPACT_GAP * size)
    }

    fn failure_of(&self, bodies: &[usize], time: f64, kind: Failure) -> SimulationError {
        let bodies = bodies.iter().map(|&i| self.plan.bodies()[i].name.clone()).collect();
        SimulationError { time, bodies, kind, trajectory: None }
    }
}

impl Cluster {
    /// Adds a body, if it is not in; its place.
    fn add(&mut self, body: usize, motion: BodyMotion) -> usize {
        self.place(body).unwrap_or_else(|| {
            self.bodies.push(body);
            self.motions.push(motion);
            self.bodies.len() - 1
        })
    }

    /// How fast the bodies of a contact approach at its point [m/s]; the fastest of its normals.
    fn approach(&self, contact: &Contact) -> f64 {
        let [a, b] = [contact.a, contact.b].map(|k| self.motions[k].velocity_at(&contact.point));
        contact.normals.iter().map(|n| n.dot(&(a - b))).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The place of a body.
    fn place(&self, body: usize) -> Option<usize> {
        self.bodies.iter().position(|&i| i == body)
    }
}

/// Which features touch, in words: of a, then of b.
fn in_words(closest: &ClosestFeatures) -> String {
    let name = |feature: crate::closest::Feature| format!("{} {}", feature.kind(), feature.index());
    format!("{}, {}", name(closest.feature_a), name(closest.feature_b))
}

/// The surface of a body's piece, and where it stands in the body's shape.
fn surface<'a>(shape: Option<&'a Shape>, collider: &'a Collider, piece: usize) -> Option<(Surface<'a>, Pose)> {
    let (shape, pose) = piece_of(shape?, piece, Pose::identity()).ok()?;
    let surface = match shape {
        Shape::HalfSpace(shape) => Surface::HalfSpace(shape),
        Shape::Sphere(shape) => Surface::Sphere(shape),
        Shape::Cylinder(shape) => Surface::Cylinder(shape),
        Shape::Capsule(shape) => Surface::Capsule(shape),
        Shape::Cone(shape) => Surface::Cone(shape),
        Shape::Ellipsoid(shape) => Surface::Ellipsoid(shape),
        _ => Surface::Polyhedron(collider.polyhedron(piece)?),
    };
    Some((surface, pose))
}

/// The convex piece of this number, nested ones in order; else how many there are.
fn piece_of(shape: &Shape, number: usize, pose: Pose) -> Result<(&Shape, Pose), usize> {
    let Shape::Compound(compound) = shape else {
        return if number == 0 { Ok((shape, pose)) } else { Err(1) };
    };
    let mut before = 0;
    for piece in &compound.pieces {
        let inner = Pose::new(piece.position, piece.orientation);
        match piece_of(&piece.shape, number - before, placed(&pose, &inner)) {
            Ok(found) => return Ok(found),
            Err(count) => before += count,
        }
    }
    Err(before)
}

/// A frame given in another.
fn placed(outer: &Pose, inner: &Pose) -> Pose {
    Pose {
        position: outer.point(&inner.position),
        orientation: quaternion::normalized(&(outer.orientation * inner.orientation)),
    }
}
