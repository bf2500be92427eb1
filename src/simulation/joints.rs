//! What holds bodies together that have stuck, and when it breaks.
//!
//! ```text
//! |f|² = f_max²  or  |τ|² = τ_max²        searched for along the motion of every step; f, τ: see `contact::joint`
//! ```
//!
//! The joints of a compound form a tree: two of its parts that come to touch besides are no joint. A compound that has
//! stuck to something fixed hangs by one joint more. Where a joint breaks both sides go on as they move: momenta and
//! energy stay. The two still touch then; they stick again where they meet again at a speed.

use super::cluster::{Cluster, Touching, in_words};
use super::led::Led;
use super::near::{Due, What};
use super::observe::Watcher;
use super::{Failure, Simulation, SimulationError};
use crate::closest::ClosestFeatures;
use crate::contact::Response;
use crate::contact::cluster::{ClusterBody, Contact};
use crate::contact::joint::{Carried, carried};
use crate::contact::rest::Acceleration;
use crate::effect::AnyEffect;
use crate::error::Result;
use crate::freedom::Riding;
use crate::freedom::riding::{follow, gather};
use crate::integrator::FlightError;
use crate::math::roots::{NoRoots, Passage, Track, find_roots};
use crate::math::sum::Time;
use crate::math::{Pose, Vector3};
use crate::plan::Part;
use crate::state::{BodyMotion, Load, Moment};
use crate::trajectory::{Event, EventKind, Trajectory};

/// What holds two bodies together.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Joint {
    /// Both bodies, as places in the scene; of a body that has stuck to something fixed this comes first.
    pub(super) bodies: [usize; 2],
    /// Where, from the centre of mass of b in its axes [m], and the normal from a to b.
    point: Vector3,
    normal: Vector3,
    features: String,
}

/// Angle that a compound turns, or a load swings, in a step whose loads are watched [rad]. Longer: the search halves it.
const STEP: f64 = 1.0;
/// Rounding of a load, as a part of what it is worked out from [-].
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Simulation {
    /// Joins two bodies of a cluster that have stuck, b moving so.
    pub(super) fn add_joint(
        &mut self,
        (bodies, b): ([usize; 2], &BodyMotion),
        closest: &ClosestFeatures,
        contacts: &[Contact],
    ) {
        let sum: Vector3 = contacts.iter().map(|contact| contact.point).sum();
        let point = if contacts.is_empty() { closest.point_b } else { sum / contacts.len() as f64 };
        self.parted.retain(|(pair, _)| !is_pair(*pair, bodies));
        self.joints.push(Joint {
            bodies,
            point: b.rotation.tr_mul(&(point - b.position)),
            normal: b.rotation.tr_mul(&closest.normal),
            features: in_words(closest),
        });
    }

    /// Whether a pair that touches may stick: it does at once, but where it has come off it must meet again.
    pub(super) fn may_stick(&self, cluster: &Cluster, touching: &Touching, small: f64) -> bool {
        let least = if self.has_parted(touching.bodies) { small } else { -small };
        let mut contacts = cluster.contacts[touching.contacts.clone()].iter();
        contacts.any(|contact| cluster.approach(contact) >= least)
    }

    /// Whether a pair has stuck and come off, and not stuck again since.
    pub(super) fn has_parted(&self, bodies: [usize; 2]) -> bool {
        self.parted.iter().any(|(pair, _)| is_pair(*pair, bodies))
    }

    /// Whether a pair has come off at this very instant [s].
    pub(super) fn parts_at(&self, bodies: [usize; 2], now: f64) -> bool {
        self.parted.iter().any(|(pair, time)| is_pair(*pair, bodies) && *time == now)
    }

    /// The joints within a unit, and that by which it hangs; of those that may break.
    fn breakable(&self, unit: usize) -> impl Iterator<Item = usize> {
        let own = move |joint: &Joint| {
            self.unit(joint.bodies[1]) == unit && self.plan.breaking_load(joint.bodies).is_finite()
        };
        self.joints.iter().enumerate().filter(move |(_, joint)| own(joint)).map(|(k, _)| k)
    }

    /// A joint of a unit that may break, in words.
    pub(super) fn weak_joint(&self, unit: usize) -> Option<String> {
        let joint = &self.joints[self.breakable(unit).next()?];
        let [a, b] = joint.bodies.map(|i| &self.body(i).name);
        Some(format!("{b} may come off {a}"))
    }

    /// Refuses what cannot be followed of joints that may break: that others stick to what hangs by them.
    pub(super) fn check_joints(&self, cluster: &Cluster, time: Time) -> Result<(), SimulationError> {
        for touching in cluster.touching.iter().filter(|_| !self.joints.is_empty()) {
            let [a, b] = touching.bodies;
            if self.plan.material(a, b).response != Response::Stick || self.has_parted([a, b]) {
                continue;
            }
            for (hangs, other) in [(a, b), (b, a)] {
                if self.is_driven(hangs)
                    && !self.is_driven(other)
                    && !self.body(other).fixed
                    && let Some(joint) = self.weak_joint(self.unit(hangs))
                {
                    let other = &self.body(other).name;
                    let why = format!("{other} sticks to what has stuck to something fixed or moved, and {joint}");
                    return Err(self.failure_of(&[a, b], time.value, Failure::LastingContact(why)));
                }
            }
        }
        Ok(())
    }

    /// The parts of the unit of a joint that hang together on the side of one of its bodies.
    fn side_of(&self, joint: &Joint, body: usize) -> Vec<usize> {
        let unit = self.unit(joint.bodies[1]);
        let mut side = vec![body];
        let mut next = 0;
        while next < side.len() {
            for other in self.joints.iter().filter(|other| other.bodies != joint.bodies) {
                let [a, b] = other.bodies;
                for (from, to) in [(a, b), (b, a)] {
                    if from == side[next] && self.unit(to) == unit && !side.contains(&to) {
                        side.push(to);
                    }
                }
            }
            next += 1;
        }
        side
    }

    /// The part by which a unit hangs on something fixed.
    fn hanger(&self, unit: usize) -> Option<usize> {
        let hangs = |joint: &&Joint| self.unit(joint.bodies[1]) == unit && self.unit(joint.bodies[0]) != unit;
        self.joints.iter().find(hangs).map(|joint| joint.bodies[1])
    }

    /// What a joint of a lane exerts on the bodies of one side, which are these.
    fn carried(&self, index: usize, joint: &Joint, side: &[usize], motions: &[BodyMotion], at: Moment) -> Carried {
        let mut loads = self.loads_on(index, motions, at);
        let of = |i: &usize| self.places[*i].map(|(_, place)| place);
        let sides: Vec<(usize, Load)> = side.iter().filter_map(of).map(|place| (place, loads[place])).collect();
        let unit = self.unit(joint.bodies[1]);
        let (whole, acceleration) = if self.is_driven(unit) {
            let single = of(&joint.bodies[1]).filter(|_| self.lanes[index].compound.is_none());
            (motions[single.unwrap_or(0)], Acceleration::zero())
        } else {
            gather(&self.lanes[index].charts, motions, &mut loads);
            let body = ClusterBody::free(&motions[0], &self.body(unit).properties.inv_inertia());
            (motions[0], Acceleration::free(&body, &loads[0]))
        };
        let b = of(&joint.bodies[1]).map_or(whole, |place| motions[place]);
        let side = sides.iter().map(|(place, load)| (&motions[*place], load));
        carried(&whole, &acceleration, side, &b.point(&joint.point))
    }

    /// The bodies of a joint that it holds, and whether that is the side of b: where the unit hangs on something
    /// fixed, the side that does not.
    fn held_by(&self, joint: &Joint) -> (Vec<usize>, bool) {
        let side = self.side_of(joint, joint.bodies[1]);
        let unit = self.unit(joint.bodies[1]);
        let is_inner = self.unit(joint.bodies[0]) == unit;
        if is_inner && self.hanger(unit).is_some_and(|hanger| side.contains(&hanger)) {
            return (self.side_of(joint, joint.bodies[0]), false);
        }
        (side, true)
    }

    /// The units of a lane that something holds together.
    fn units_of(&self, index: usize) -> Vec<usize> {
        let lane = &self.lanes[index];
        match lane.compound {
            Some(compound) => vec![self.plan.bodies().len() + compound],
            None => lane.held.clone(),
        }
    }

    /// Where a step of a lane must end for its loads to be watched [s].
    pub(super) fn watch_limit(&self, index: usize) -> f64 {
        let is_watched = |&unit: &usize| self.driver_of(unit).is_some() || self.breakable(unit).next().is_some();
        if self.joints.is_empty() || !self.units_of(index).iter().any(is_watched) {
            return f64::INFINITY;
        }
        let pace = self.pace(index);
        let calls_user = self.spec_of(index).bindings.iter().any(|b| matches!(*b.effect, AnyEffect::User(_)));
        let watched = calls_user && self.end.is_finite();
        let longest = if watched { self.plan.first_step(self.end - self.time) } else { f64::INFINITY };
        self.lanes[index].flight.front() + longest.min(if pace > 0.0 { STEP / pace } else { f64::INFINITY })
    }

    /// How fast the bodies of a lane turn, or a load on them swings [rad/s].
    pub(super) fn pace(&self, index: usize) -> f64 {
        let lane = &self.lanes[index];
        let mut motions = lane.motions.clone();
        lane.flight.at(lane.flight.front(), &mut motions);
        let turns = motions.iter().map(|motion| motion.angular_velocity.norm());
        let swings = self.spec_of(index).bindings.iter().filter_map(|binding| match &*binding.effect {
            AnyEffect::Wrench(wrench) => wrench.angular_frequency.map(f64::abs),
            _ => None,
        });
        turns.chain(swings).fold(0.0, f64::max)
    }

    /// Looks in the last step of a lane for the first instant at which a joint carries more than it bears, and makes
    /// it due.
    pub(super) fn find_break(&mut self, index: usize) -> Result<(), SimulationError> {
        if self.joints.is_empty() {
            return Ok(());
        }
        let lane = &self.lanes[index];
        let segment = lane.flight.segment();
        let (start, length) = (segment.start, segment.length);
        let resolution = f64::EPSILON * start.abs().max(lane.flight.front().abs());
        let mut first: Option<(f64, [usize; 2])> = None;
        for unit in self.units_of(index) {
            for joint in self.breakable(unit).map(|k| &self.joints[k]) {
                let bears = self.plan.breaking_load(joint.bodies);
                let (side, _) = self.held_by(joint);
                let mut motions = lane.motions.clone();
                let mut at = |offset: f64| {
                    lane.flight.at_offset(offset, &mut motions);
                    self.carried(index, joint, &side, &motions, segment.moment(start + offset))
                };
                for which in 0..2 {
                    let most = [bears.force, bears.torque][which];
                    if most.is_infinite() {
                        continue;
                    }
                    let ends = [0.0, length].map(&mut at);
                    let most_used = ends.iter().map(|end| end.size[which] / most).fold(1.0, f64::max);
                    let size = most_used * most_used;
                    let mut g = |offset: f64| {
                        let load = at(offset).load;
                        ([load.force, load.torque][which] / most).norm_squared() - 1.0
                    };
                    let [before, after] = [0.0, length].map(&mut g);
                    let found = first_excess(&mut g, length, size, resolution, [before, after]).map_err(|why| {
                        let kind = match why {
                            NoRoots::NotFinite => Failure::Flight(FlightError::NotFinite),
                            NoRoots::Unresolved => Failure::UnresolvedBreak,
                        };
                        self.failure_of(&joint.bodies, start, kind)
                    })?;
                    if let Some(offset) = found
                        && first.is_none_or(|(earliest, _)| offset < earliest)
                    {
                        first = Some((offset, joint.bodies));
                    }
                }
            }
        }
        if let Some((offset, bodies)) = first {
            let what = What::Break { bodies, flight: lane.number };
            self.near.due.push(Due { time: Time::new(start) + offset, what });
        }
        Ok(())
    }

    /// Breaks the joint of a pair: what it held goes on as it moves.
    pub(super) fn break_joint(
        &mut self,
        pair: [usize; 2],
        time: Time,
        record: &mut Option<&mut Trajectory>,
    ) -> Result<(), SimulationError> {
        let unit = self.unit(pair[1]);
        let Some(place) = self.joints.iter().position(|joint| joint.bodies == pair) else { return Ok(()) };
        let Some((index, _)) = self.places[unit] else { return Ok(()) };
        self.count_hits(&pair, &pair, time)?;

        // one event, with what the joint carried
        let joint = self.joints[place].clone();
        let (side, is_of_b) = self.held_by(&joint);
        let motions = self.motions_at(index, time);
        let at = self.lanes[index].flight.segment().moment(time.value);
        let Carried { load, .. } = self.carried(index, &joint, &side, &motions, at);
        let sign = if is_of_b { 1.0 } else { -1.0 };
        let [a, b] = pair.map(|i| self.motion_at(i, time));
        self.events.push(Event {
            point: b.point(&joint.point),
            normal: b.rotation * joint.normal,
            force: sign * load.force,
            torque: sign * load.torque,
            features: joint.features.clone(),
            ..Event::between(time.value, EventKind::Break, pair, [&a, &a], [&b, &b])
        });

        let mut seeds = Vec::new();
        self.parts_of(unit, &mut seeds);
        let hanger = self.hanger(unit);
        self.joints.remove(place);
        self.parted.push((pair, time.value));
        if self.unit(pair[0]) == unit {
            self.cut_flight(index, time, record)?;
            self.split(index, &side, hanger, &motions[0], time)
                .map_err(|error| self.failure_of(&pair, time.value, Failure::Refused(error.to_string())))?;
        } else if self.driver_of(unit).is_some() {
            self.cut_flight(index, time, record)?;
            self.split(index, &seeds, None, &motions[0], time)
                .map_err(|error| self.failure_of(&pair, time.value, Failure::Refused(error.to_string())))?;
        } else {
            self.stuck.retain(|&stuck| stuck != unit);
            self.lanes[index].held.retain(|&held| held != unit);
            self.joined.push(unit);
        }
        self.answer(&seeds, time, 0, record)
    }

    /// Makes two units of a compound, one of them of these bodies; that which hangs on something fixed or moved stays
    /// there.
    fn split(
        &mut self,
        index: usize,
        side: &[usize],
        hanger: Option<usize>,
        whole: &BodyMotion,
        time: Time,
    ) -> Result<()> {
        let Some(compound) = self.lanes[index].compound else { return Ok(()) };
        let parts = self.compounds[compound].parts.clone();
        let unit = self.plan.bodies().len() + compound;
        let (was_stuck, driver) = (self.is_stuck(unit), self.driver_of(unit));
        self.stuck.retain(|&stuck| stuck != unit);
        self.riders.retain(|(rider, _)| *rider != unit);

        // what is known of the user's events goes with the parts that they are measured of
        let mut watchers = self.lanes[index].watchers.clone().into_iter();
        let count = |part: &Part| self.plan.groups()[part.group].watches.len();
        let watched: Vec<Vec<Watcher>> =
            parts.iter().map(|part| watchers.by_ref().take(count(part)).collect()).collect();
        for is_side in [false, true] {
            let own = || parts.iter().zip(&watched).filter(|(part, _)| side.contains(&part.body) == is_side);
            let watchers: Vec<Watcher> = own().flat_map(|(_, watched)| watched.clone()).collect();
            let number = self.lanes[index].number + 1;
            let own: Vec<Part> = own().map(|(part, _)| part.clone()).collect();
            let Some(first) = own.first() else { continue };
            if let Some(driver) = driver
                && own.iter().any(|part| Some(part.body) == hanger)
            {
                let parts: Vec<_> = own.iter().map(|part| (part.body, part.pose)).collect();
                self.ride(&parts, driver, time, (number, watchers))?;
                continue;
            }
            self.let_go(&own, whole, time, (number, watchers))?;
            if was_stuck && own.iter().any(|part| Some(part.body) == hanger) {
                self.stuck.push(self.unit(first.body));
            }
        }
        Ok(())
    }

    /// Lets parts of a compound, which moves so, go on by themselves.
    fn let_go(
        &mut self,
        parts: &[Part],
        whole: &BodyMotion,
        time: Time,
        (number, watchers): (u64, Vec<Watcher>),
    ) -> Result<()> {
        if let [Part { body, pose, group, .. }] = parts {
            let charts = self.plan.charts(*group, &[]);
            let motion = Riding { pose: *pose }.motion(whole, &self.body(*body).start);
            let spec = self.lanes[*group].spec.clone();
            let lane = &mut self.lanes[*group];
            let place = spec.members.iter().position(|member| member == body);
            if let Some(place) = place {
                lane.motions[place] = motion;
            }
            lane.earlier.add(lane.flight.counts());
            lane.flight = Box::new(Led::new(charts.clone(), time, &lane.motions));
            lane.held.clear();
            (lane.charts, lane.number, lane.watchers) = (charts, number, watchers);
            self.places[*body] = place.map(|place| (*group, place));
            self.units[*body] = *body;
            self.joined.push(*body);
            return Ok(());
        }

        // about their own centre of mass, in the axes that they had
        let mass: f64 = parts.iter().map(|part| self.body(part.body).properties.mass).sum();
        let weighted = |part: &Part| self.body(part.body).properties.mass / mass * part.pose.position;
        let center: Vector3 = parts.iter().map(weighted).sum();
        let moved = |part: &Part| (part.body, Pose { position: part.pose.position - center, ..part.pose });
        let parts: Vec<_> = parts.iter().map(moved).collect();
        self.join(&parts, false, time)?;
        let position = whole.point(&center);
        let motion = BodyMotion { position, velocity: whole.velocity_at(&position), ..*whole };
        self.stand(&motion, time, number, watchers);
        Ok(())
    }

    /// Lets the compound made last stand so.
    pub(super) fn stand(&mut self, whole: &BodyMotion, time: Time, number: u64, watchers: Vec<Watcher>) {
        let Some(lane) = self.lanes.last_mut() else { return };
        let template = &mut lane.motions[0];
        *template = BodyMotion { mass: template.mass, inertia_body: template.inertia_body, ..*whole };
        follow(&lane.charts, &mut lane.motions);
        lane.flight = Box::new(Led::new(lane.charts.clone(), time, &lane.motions));
        (lane.number, lane.watchers) = (number, watchers);
    }

    /// How fast the gap of a pair that has come off at this instant begins to open [m/s²]: both sides move on freely,
    /// and no point of either slips on the other yet.
    pub(super) fn parting(&self, a: usize, b: usize, now: f64) -> f64 {
        let Ok(closest) = self.closest(a, b, Time::new(now)) else { return 0.0 };
        let acceleration = |body: usize| {
            let unit = self.unit(body);
            let motion = self.motion_at(unit, Time::new(now));
            let free = match self.places[unit].filter(|_| !self.is_driven(body)) {
                None => self.unmoved_acceleration(unit, &motion),
                Some((lane, _)) => {
                    let body = ClusterBody::free(&motion, &self.body(unit).properties.inv_inertia());
                    Acceleration::free(&body, &self.load_on(lane, &motion, self.moment(lane, now)))
                }
            };
            let (w, arm) = (motion.angular_velocity, closest.point_b - motion.position);
            free.linear + free.angular.cross(&arm) + w.cross(&w.cross(&arm))
        };
        closest.normal.dot(&(acceleration(b) - acceleration(a)))
    }
}

/// Whether these are the same two.
fn is_pair(pair: [usize; 2], bodies: [usize; 2]) -> bool {
    pair == bodies || pair == [bodies[1], bodies[0]]
}

/// The first instant of 0..`length` at which g rises above 0, or is there; g is given at both `ends`.
fn first_excess(
    g: &mut dyn FnMut(f64) -> f64,
    length: f64,
    size: f64,
    resolution: f64,
    ends: [f64; 2],
) -> Result<Option<f64>, NoRoots> {
    let rounding = ROUNDING * size;
    if ends[0] > rounding {
        return Ok(Some(0.0));
    }
    let roots = find_roots(g, length, size, resolution, &mut Track::default())?;
    // a rise that begins at 0 is no root of the search; what comes down again, or is up in the end, has risen
    let rises = |passage| passage == Passage::Rising;
    Ok(match roots.iter().find(|root| root.passage != Passage::Touching) {
        Some(root) if rises(root.passage) => Some(root.at),
        Some(_) => Some(0.0),
        None if ends[1] > rounding => Some(0.0),
        None => None,
    })
}
