//! Bodies that stay together: which contacts last, and whether their bodies rest.
//!
//! ```text
//! settle   which contacts last and which open, by the laws of contact for accelerations (`contact::rest`)
//! rest     no speed, no acceleration, loads that do not change: frozen where they are
//! ```
//!
//! What lasts and does not rest is [led](super::lead).

use super::answer::ContactScales;
use super::cluster::Cluster;
use super::{Failure, Simulation, SimulationError};
use crate::contact::cluster::{ClusterBody, ClusterError, Contact};
use crate::contact::rest::{Acceleration, Hold, Rest, Support, align, rest_sliding};
use crate::effect::AnyEffect;
use crate::freedom::riding::{follow, gather};
use crate::math::sum::Time;
use crate::math::{Vector3, quaternion};
use crate::plan::FlightGroup;
use crate::state::{BodyMotion, Load, Moment};
use crate::trajectory::Heat;
use smallvec::SmallVec;

/// Acceleration that contact forces may leave of the loads' for an equilibrium [-]; solvers leave 1e-11.
const EQUILIBRIUM: f64 = 1.0e-9;

/// Bodies in contacts that last, moving together.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Together {
    /// The number of its step.
    pub(super) number: u64,
    /// As places in the scene.
    pub(super) bodies: Vec<usize>,
    /// Pairs that touch: no search looks at them.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Which contacts go on sliding, however slowly: their pair, point [m] and direction.
    pub(super) sliding: Vec<([usize; 2], Vector3, Vector3)>,
    /// Place of its heat among all, and of the work that bodies on prescribed motions do in it.
    pub(super) heat: Option<usize>,
    pub(super) work: Option<usize>,
}

/// A part of a cluster that stays together.
pub(super) struct Part {
    /// Its moving bodies, as places in the cluster.
    pub(super) places: Vec<usize>,
    /// Its contacts, as places in the cluster's list.
    pub(super) contacts: Vec<usize>,
    /// Where each of them slides, world axes.
    pub(super) slides: Vec<Option<Vector3>>,
    /// Whether it rests.
    pub(super) rests: bool,
}

/// The contacts of a part at an instant, and what the laws of contact say.
pub(super) struct Held {
    pub(super) contacts: Vec<Contact>,
    /// Velocity of b relative to a at each contact [m/s].
    pub(super) slips: Vec<Vector3>,
    pub(super) rest: Rest,
}

impl Simulation {
    /// The parts of a cluster that stay together; all other bodies fly. A contact that opens more slowly than
    /// what counts as a bounce, and that the loads would press shut again, lasts.
    pub(super) fn settle(
        &mut self,
        cluster: &mut Cluster,
        scales: &ContactScales,
        time: Time,
    ) -> Result<Vec<Part>, SimulationError> {
        let slow = scales.rest.max(scales.small);
        let near: Vec<usize> =
            (0..cluster.contacts.len()).filter(|&i| cluster.approach(&cluster.contacts[i]) >= -slow).collect();
        let rides = |i: &&usize| {
            let touched = [cluster.contacts[**i].a, cluster.contacts[**i].b].map(|place| cluster.bodies[place]);
            touched.iter().any(|&unit| self.driver_of(unit).is_some())
        };
        if let Some(&contact) = near.iter().find(rides) {
            let why = "one of them rides on a body that moves as prescribed";
            return Err(self.lasting(cluster, &cluster.contacts[contact], time, why));
        }
        let mut parts = Vec::new();
        for (places, contacts) in self.joined(cluster, &near) {
            let slides: Vec<Option<Vector3>> = contacts.iter().map(|&i| self.slide(cluster, scales, i)).collect();
            let held = self.held(cluster, &cluster.motions, &contacts, &slides, time)?;

            // what opens leaves; the rest may fall into several parts
            let carries = |k: &usize| held.rest.holds[*k] != Hold::Separate;
            let kept: Vec<usize> = (0..contacts.len()).filter(carries).collect();
            let kept_contacts: Vec<usize> = kept.iter().map(|&k| contacts[k]).collect();
            if let Some(&contact) = kept_contacts.first()
                && let Some(name) = places.iter().find_map(|&place| self.switched_load(cluster.bodies[place]))
            {
                let why = format!("{name} is switched by the state, which is not watched in a contact that lasts");
                return Err(self.lasting(cluster, &cluster.contacts[contact], time, &why));
            }
            let touched = kept_contacts.iter().flat_map(|&i| [cluster.contacts[i].a, cluster.contacts[i].b]);
            if let Some(&contact) = kept_contacts.first()
                && let Some(joint) = touched.map(|place| cluster.bodies[place]).find_map(|unit| self.weak_joint(unit))
            {
                let why = format!("{joint}, whose load is not watched in a contact that lasts");
                return Err(self.lasting(cluster, &cluster.contacts[contact], time, &why));
            }
            self.still_contacts(cluster, &places, &held, &kept, scales, time);
            let still = |&place: &usize| {
                let (motion, radius) = (&cluster.motions[place], self.body(cluster.bodies[place]).radius);
                let acceleration = &held.rest.accelerations[place];
                motion.velocity.norm() + motion.angular_velocity.norm() * radius <= scales.small
                    && acceleration.linear.norm() + acceleration.angular.norm() * radius <= EQUILIBRIUM * scales.pull
            };
            for (places, contacts) in self.joined(cluster, &kept_contacts) {
                let steady = places.iter().all(|&place| self.is_steady(cluster.bodies[place]));
                let way = |i: &usize| {
                    let k = kept[kept_contacts.iter().position(|c| c == i)?];
                    match held.rest.holds[k] {
                        Hold::Slide(way) => Some(way),
                        Hold::Stick | Hold::Separate => None,
                    }
                };
                let slides = contacts.iter().map(way).collect();
                let stands = |&i: &usize| {
                    let bodies = [cluster.contacts[i].a, cluster.contacts[i].b].map(|k| cluster.bodies[k]);
                    !bodies.iter().any(|&body| self.body(body).is_moved(time.value))
                };
                let rests = steady && places.iter().all(still) && contacts.iter().all(stands);
                parts.push(Part { places, contacts, slides, rests });
            }
        }
        Ok(parts)
    }

    /// Takes away the speeds that are none: along the normals of what carries, and all of what sticks. It is the
    /// smallest impulse that does, and takes energy.
    fn still_contacts(
        &mut self,
        cluster: &mut Cluster,
        places: &[usize],
        held: &Held,
        kept: &[usize],
        scales: &ContactScales,
        time: Time,
    ) {
        let (mut rows, mut changes) = (Vec::new(), Vec::new());
        for &k in kept {
            let (n, slip) = (held.rest.normals[k], &held.slips[k]);
            let sticks = held.rest.holds[k] == Hold::Stick && across(slip, &n).norm() <= scales.slip;
            let [_, s, t] = tangents(&n);
            let ways = [Some(n), sticks.then_some(s), sticks.then_some(t)];
            for way in ways.into_iter().flatten() {
                rows.push((k, way));
                changes.push(-way.dot(slip));
            }
        }
        if changes.iter().all(|change| *change == 0.0) {
            return;
        }
        let energy = |motions: &[BodyMotion]| places.iter().map(|&p| motions[p].kinetic_energy()).sum::<f64>();
        let before = energy(&cluster.motions);
        let bodies = self.cluster_bodies(cluster, &cluster.motions);
        for (motion, change) in cluster.motions.iter_mut().zip(align(&bodies, &held.contacts, &rows, &changes)) {
            motion.velocity += change.linear;
            motion.angular_velocity += change.angular;
        }
        let lost = before - energy(&cluster.motions);
        if lost != 0.0 {
            self.heat.push(Heat::at(time.value, lost));
        }
    }

    /// The moving bodies that contacts join, part by part, with their contacts.
    fn joined(&self, cluster: &Cluster, contacts: &[usize]) -> Vec<(Vec<usize>, Vec<usize>)> {
        let moves =
            |place: usize| self.places[cluster.bodies[place]].is_some() && !self.is_driven(cluster.bodies[place]);
        let mut leader: Vec<usize> = (0..cluster.bodies.len()).collect();
        for &i in contacts {
            let (a, b) = (cluster.contacts[i].a, cluster.contacts[i].b);
            if moves(a) && moves(b) && leader[a] != leader[b] {
                let (first, second) = (leader[a].min(leader[b]), leader[a].max(leader[b]));
                leader.iter_mut().filter(|l| **l == second).for_each(|l| *l = first);
            }
        }
        let mut parts: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
        for first in 0..cluster.bodies.len() {
            let mine = |place: usize| moves(place) && leader[place] == first;
            let own: Vec<usize> = contacts
                .iter()
                .copied()
                .filter(|&i| mine(cluster.contacts[i].a) || mine(cluster.contacts[i].b))
                .collect();
            if !own.is_empty() {
                parts.push(((0..cluster.bodies.len()).filter(|&place| mine(place)).collect(), own));
            }
        }
        parts
    }

    /// The direction in which a contact slides, if it does.
    fn slide(&self, cluster: &Cluster, scales: &ContactScales, contact: usize) -> Option<Vector3> {
        let contact = &cluster.contacts[contact];
        let n = contact.normals.iter().sum::<Vector3>().try_normalize(0.0)?;
        let slip = across(&contact.slip(&cluster.motions), &n);
        let speed = slip.norm();
        if speed > scales.slip {
            return Some(slip / speed);
        }

        // what has begun to slide is slow at first
        let pair = [contact.a, contact.b].map(|k| cluster.bodies[k]);
        let parts = pair.iter().filter_map(|&body| self.together[self.slot(body)?].as_ref());
        let own = parts.flat_map(|part| &part.sliding).filter(|(other, ..)| *other == pair);
        let way = own.min_by(|(_, p, _), (_, q, _)| (p - contact.point).norm().total_cmp(&(q - contact.point).norm()));
        way.map(|(.., way)| *way)
    }

    /// The laws of contact for these motions of a cluster's bodies.
    pub(super) fn held(
        &self,
        cluster: &Cluster,
        motions: &[BodyMotion],
        contacts: &[usize],
        slides: &[Option<Vector3>],
        time: Time,
    ) -> Result<Held, SimulationError> {
        let bodies = self.cluster_bodies(cluster, motions);
        let mut supports = Vec::with_capacity(contacts.len());
        for &i in contacts {
            let contact = &cluster.contacts[i];
            let still = [contact.a, contact.b]
                .iter()
                .all(|&k| motions[k].velocity == Vector3::zeros() && motions[k].angular_velocity == Vector3::zeros());
            supports.push(match &cluster.anchors[i] {
                Some(anchor) => anchor.support(contact, motions),
                None if still => {
                    let [point_velocity, normal_rate] = [Vector3::zeros(); 2];
                    Support { contact: contact.clone(), point_velocity, normal_rate }
                }
                None => {
                    let why = "the surfaces roll on each other where no formula tells how their contact moves";
                    return Err(self.lasting(cluster, contact, time, why));
                }
            });
        }
        let mut free = Vec::with_capacity(bodies.len());
        for (&body, cluster_body) in cluster.bodies.iter().zip(&bodies) {
            free.push(match self.places[body] {
                Some((lane, _)) if !self.is_driven(body) => {
                    self.free_acceleration(body, lane, cluster_body, time.value)
                }
                Some(_) => Acceleration::zero(),
                None => self.unmoved_acceleration(body, &cluster_body.motion),
            });
        }
        let rest = rest_sliding(&bodies, &free, &supports, slides).map_err(|error| match error {
            ClusterError::Inconsistent { .. } => {
                let why = "no forces meet the laws of contact (Painlevé 1895)";
                self.lasting(cluster, &cluster.contacts[contacts[0]], time, why)
            }
            other => self.failure_of(&cluster.bodies, time.value, Failure::Refused(other.to_string())),
        })?;
        let contacts: Vec<Contact> = supports.into_iter().map(|support| support.contact).collect();
        Ok(Held { slips: contacts.iter().map(|c| c.slip(motions)).collect(), contacts, rest })
    }

    /// The bodies of a cluster as contacts meet them.
    pub(super) fn cluster_bodies(&self, cluster: &Cluster, motions: &[BodyMotion]) -> Vec<ClusterBody> {
        cluster.bodies.iter().zip(motions).map(|(&body, motion)| self.cluster_body(body, motion)).collect()
    }

    /// The load on the moving member of a lane that moves so.
    pub(super) fn load_on(&self, index: usize, motion: &BodyMotion, at: Moment) -> Load {
        let lane = &self.lanes[index];
        let moving = lane.spec.members.iter().position(|&i| !self.body(i).fixed).unwrap_or(0);
        let mut motions = SmallVec::<[BodyMotion; 1]>::from_slice(&lane.motions);
        motions[moving] = *motion;
        follow(&lane.charts, &mut motions);
        let mut total = self.loads_on(index, &motions, at);
        gather(&lane.charts, &motions, &mut total);
        total[moving]
    }

    /// What acts on a lane: also on what rides, though it does not feel it.
    pub(super) fn spec_of(&self, lane: usize) -> &FlightGroup {
        let lane = &self.lanes[lane];
        lane.compound.map_or(&lane.spec, |compound| &self.compounds[compound].spec)
    }

    /// The loads of all effects on the members of a lane that move so.
    pub(super) fn loads_on(&self, lane: usize, motions: &[BodyMotion], at: Moment) -> SmallVec<[Load; 1]> {
        let spec = self.spec_of(lane);
        let lane = &self.lanes[lane];
        let mut total = SmallVec::<[Load; 1]>::from_elem(Load::zero(), motions.len());
        let off = lane.loads_off(spec);
        for binding in spec.bindings.iter().filter(|binding| !off.contains(&binding.effect_index)) {
            let seen = binding.seen(motions);
            let mut loads = SmallVec::<[Load; 1]>::from_elem(Load::zero(), seen.len());
            binding.effect.as_effect().add_to(at, &seen, &mut loads);
            for (&member, own) in binding.members.iter().zip(&loads) {
                total[member].force += own.force;
                total[member].torque += own.torque;
            }
        }
        total
    }

    /// The moment `t` [s] of a lane, behind the last switch.
    pub(super) fn moment(&self, lane: usize, t: f64) -> Moment {
        let (_, since) = self.lanes[lane].flight.clock();
        let switches = &self.lanes[lane].spec.switches;
        Moment { time: t, since: switches.iter().copied().filter(|&s| s <= t).fold(since, f64::max) }
    }

    /// Whether the loads of a body at rest stay what they are between switches.
    fn is_steady(&self, body: usize) -> bool {
        let Some((lane, _)) = self.places[body] else { return true };
        self.lanes[lane].spec.bindings.iter().all(|binding| match &*binding.effect {
            AnyEffect::UniformGravity(_) | AnyEffect::Drag(_) | AnyEffect::PointGravity(_) | AnyEffect::Thruster(_) => {
                true
            }
            AnyEffect::Wrench(wrench) => wrench.angular_frequency.is_none_or(|w| w == 0.0),
            _ => false,
        })
    }

    /// The name of a load on the body that the state turns on and off.
    fn switched_load(&self, body: usize) -> Option<String> {
        let (lane, _) = self.places[body]?;
        self.lanes[lane].spec.toggles.first().map(|toggle| toggle.name.clone())
    }

    /// The named end of a run at a contact that this version cannot follow.
    pub(super) fn lasting(&self, cluster: &Cluster, contact: &Contact, time: Time, why: &str) -> SimulationError {
        let bodies = [contact.a, contact.b].map(|k| cluster.bodies[k]);
        self.failure_of(&bodies, time.value, Failure::LastingContact(why.to_owned()))
    }
}

impl Held {
    /// Power that bodies on prescribed motions bring in through the contacts [W].
    pub(super) fn drive(&self, motions: &[BodyMotion], is_driver: impl Fn(usize) -> bool) -> f64 {
        let power = |(contact, force): (&Contact, &Vector3)| {
            let of = |k: usize, sign: f64| sign * force.dot(&motions[k].velocity_at(&contact.point));
            let ends = [(contact.a, 1.0), (contact.b, -1.0)].into_iter();
            ends.filter(|(k, _)| is_driver(*k)).map(|(k, sign)| of(k, sign)).sum::<f64>()
        };
        self.contacts.iter().zip(&self.rest.forces).map(power).sum()
    }

    /// Power of friction turned into heat [W].
    pub(super) fn heat(&self) -> f64 {
        -self.rest.forces.iter().zip(&self.slips).map(|(f, u)| f.dot(u)).sum::<f64>()
    }
}

/// Moves a body by small displacements.
pub(super) fn shift_by(motion: &mut BodyMotion, shift: &Vector3, turn: &Vector3) {
    motion.position += shift;
    if *turn != Vector3::zeros() {
        motion.orientation = quaternion::normalized(&(quaternion::exp(turn) * motion.orientation));
        motion.rotation = quaternion::to_matrix(&motion.orientation);
    }
}

/// The part of a vector across a unit normal.
pub(super) fn across(v: &Vector3, n: &Vector3) -> Vector3 {
    v - n.dot(v) * n
}

/// A normal and two tangents.
pub(super) fn tangents(n: &Vector3) -> [Vector3; 3] {
    let mut axis = Vector3::zeros();
    axis[n.iamin()] = 1.0;
    let first = n.cross(&axis).normalize();
    [*n, first, n.cross(&first)]
}
