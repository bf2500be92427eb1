//! The bodies that touch at an instant, one with another, and all points in which they do.

use super::{Failure, Simulation, SimulationError};
use crate::closest::{Accuracy, ClosestFeatures, Collidable, Collider, PairCache, closest_features};
use crate::contact::Material;
use crate::contact::anchor::{Anchor, Faced, Wall};
use crate::contact::broad_phase::Aabb;
use crate::contact::cluster::{ClusterBody, Contact};
use crate::contact::manifold::{Surface, Touch, manifold};
use crate::contact::rest::Acceleration;
use crate::freedom::Chart;
use crate::math::sum::Time;
use crate::math::{Pose, Vector3, quaternion};
use crate::shape::Shape;
use crate::state::BodyMotion;
use crate::tolerance::TOUCH_GAP;
use smallvec::SmallVec;

/// Two bodies that touch, and where.
pub(super) struct Touching {
    pub(super) bodies: [usize; 2],
    pub(super) closest: ClosestFeatures,
    /// Places of its contacts in the cluster's list.
    pub(super) contacts: std::ops::Range<usize>,
}

/// The bodies that touch at an instant, one with another.
#[derive(Default)]
pub(super) struct Cluster {
    /// As places in the scene.
    pub(super) bodies: Vec<usize>,
    pub(super) motions: Vec<BodyMotion>,
    pub(super) touching: Vec<Touching>,
    pub(super) contacts: Vec<Contact>,
    /// Gap of each contact [m], where it goes when its bodies move, and where it ends.
    pub(super) gaps: Vec<f64>,
    pub(super) anchors: Vec<Option<Anchor>>,
    pub(super) walls: Vec<Vec<Wall>>,
}

impl Cluster {
    /// Adds a body that flies on its own, if it is not in; its place.
    pub(super) fn add(&mut self, body: usize, motion: BodyMotion) -> usize {
        self.place(body).unwrap_or_else(|| {
            self.bodies.push(body);
            self.motions.push(motion);
            self.bodies.len() - 1
        })
    }

    /// The place of a body.
    pub(super) fn place(&self, body: usize) -> Option<usize> {
        self.bodies.iter().position(|&i| i == body)
    }

    /// The energy that each pair lost in an impact [J], after it: −½ j·(u⁻ + u⁺), summed over its points. Where
    /// one pair drives another, some of these sums are negative and others too large; then the positive ones share
    /// what all have lost, in proportion.
    pub(super) fn losses(&self, before: &[BodyMotion], impulses: &[Vector3]) -> Vec<f64> {
        let lost = |i: usize| {
            let contact = &self.contacts[i];
            -0.5 * impulses[i].dot(&(contact.slip(before) + contact.slip(&self.motions)))
        };
        let mut losses: Vec<f64> = self.touching.iter().map(|t| t.contacts.clone().map(lost).sum()).collect();
        if losses.iter().any(|loss| *loss < 0.0) {
            let (all, taken) = (losses.iter().sum::<f64>(), losses.iter().filter(|loss| **loss > 0.0).sum::<f64>());
            let part = if taken > 0.0 { (all / taken).max(0.0) } else { 0.0 };
            for loss in &mut losses {
                *loss = part * loss.max(0.0);
            }
        }
        losses
    }

    /// How fast the bodies of a contact approach at its point [m/s]; the fastest of its normals.
    pub(super) fn approach(&self, contact: &Contact) -> f64 {
        let [a, b] = [contact.a, contact.b].map(|k| self.motions[k].velocity_at(&contact.point));
        contact.normals.iter().map(|n| n.dot(&(a - b))).fold(f64::NEG_INFINITY, f64::max)
    }
}

impl Simulation {
    /// All that touches at `time`, starting from these bodies.
    pub(super) fn cluster(&self, seeds: &[usize], time: Time) -> Result<Cluster, SimulationError> {
        let mut cluster = Cluster::default();
        for &body in seeds {
            let unit = self.unit(body);
            cluster.add(unit, self.motion_at(unit, time));
        }
        let (mut next, mut bodies, mut others) = (0, Vec::new(), Vec::new());
        while next < cluster.bodies.len() {
            self.parts_of(cluster.bodies[next], &mut bodies);
            let unit = cluster.motions[next];
            next += 1;
            for &body in &bodies {
                let center = self.part_motion(body, &unit).position;
                self.add_touching(&mut cluster, (body, center), time, &mut others)?;
            }
        }
        Ok(cluster)
    }

    /// Adds what touches a body of the scene, whose centre of mass is there.
    fn add_touching(
        &self,
        cluster: &mut Cluster,
        (body, center): (usize, Vector3),
        time: Time,
        others: &mut Vec<usize>,
    ) -> Result<(), SimulationError> {
        let plan = &self.plan;
        if plan.bodies()[body].fixed {
            return Ok(());
        }
        let radius = plan.bodies()[body].radius;
        self.near.around(&Aabb::of_ball(&center, radius + self.reach_of(radius)), others);
        for &other in others.iter().filter(|&&other| self.may_meet(body, other)) {
            let pair = if plan.bodies()[other].fixed || other < body { [other, body] } else { [body, other] };
            if cluster.touching.iter().any(|touching| touching.bodies == pair) {
                continue;
            }
            let closest = self.closest(pair[0], pair[1], time)?;
            let reach = self.eps(pair[0], pair[1]) + TOUCH_GAP * self.size(pair[0], pair[1]);
            if closest.signed_distance > reach {
                continue;
            }
            let places = pair.map(|i| cluster.add(self.unit(i), self.motion_at(self.unit(i), time)));
            let first = cluster.contacts.len();
            self.add_contacts(cluster, pair, time, places, reach)?;
            let contacts = first..cluster.contacts.len();
            cluster.touching.push(Touching { bodies: pair, closest, contacts });
        }
        Ok(())
    }

    /// Whether a point took part in an impact that only `ε_touch` counts as touching: its gap is above ε.
    pub(super) fn depends_on_touch(&self, cluster: &Cluster, impulses: &[Vector3]) -> bool {
        cluster.touching.iter().any(|touching| {
            let eps = self.eps(touching.bodies[0], touching.bodies[1]);
            touching.contacts.clone().any(|i| cluster.gaps[i] > eps && impulses[i] != Vector3::zeros())
        })
    }

    /// The points in which two bodies touch: of every two pieces within `reach` [m] all that carry.
    fn add_contacts(
        &self,
        cluster: &mut Cluster,
        pair: [usize; 2],
        time: Time,
        places: [usize; 2],
        reach: f64,
    ) -> Result<(), SimulationError> {
        let [Some(a), Some(b)] = pair.map(|i| self.plan.bodies()[i].collider.as_deref()) else { return Ok(()) };
        let [shape_a, shape_b] = pair.map(|i| self.plan.scene().bodies[i].shape.as_ref());
        let [pose_a, pose_b] = pair.map(|i| self.pose_at(i, time));
        let Material { friction, restitution, .. } = self.plan.material(pair[0], pair[1]);
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
                let motions = places.map(|place| cluster.motions[place]);
                let faced_a = Faced { surface: surface_a, pose: at_a, motion: &motions[0] };
                let faced_b = Faced { surface: surface_b, pose: at_b, motion: &motions[1] };
                let slack = self.eps(pair[0], pair[1]);
                let contacts = found.contacts(places[0], places[1], friction, restitution);
                for (point, mut contact) in found.points.iter().zip(contacts) {
                    let (anchor, walls) = Anchor::new(&faced_a, &faced_b, &found, point, slack).unzip();
                    if let Some(anchor) = &anchor {
                        contact.normals = SmallVec::from_buf([anchor.normal(&motions[0], &motions[1])]);
                    }
                    cluster.gaps.push(anchor.map_or(point.gap, |anchor| anchor.gap(&motions[0], &motions[1])));
                    cluster.contacts.push(contact);
                    cluster.anchors.push(anchor);
                    cluster.walls.push(walls.unwrap_or_default());
                }
            }
        }
        Ok(())
    }

    /// A body of a cluster as contacts meet it.
    pub(super) fn cluster_body(&self, body: usize, motion: &BodyMotion) -> ClusterBody {
        if self.places[body].is_none() || self.is_driven(body) {
            return ClusterBody::driven(motion);
        }
        match self.chart(body).and_then(|chart| chart.freedoms(motion)) {
            Some(freedoms) => ClusterBody::within(motion, &freedoms),
            None => ClusterBody::free(motion, &self.body(body).properties.inv_inertia()),
        }
    }

    /// The coordinates that the freedom of a body gives it, also where it is held; none of a compound, and of a body
    /// that does not fly.
    pub(super) fn chart(&self, body: usize) -> Option<&Chart> {
        let (lane, member) = self.places[body]?;
        let lane = &self.lanes[lane];
        if lane.compound.is_some() { None } else { self.plan.chart(lane.group, member) }
    }

    /// The acceleration of a body that flies in a lane, under its loads and without contacts.
    pub(super) fn free_acceleration(&self, body: usize, lane: usize, met: &ClusterBody, time: f64) -> Acceleration {
        let load = self.load_on(lane, &met.motion, self.moment(lane, time));
        match self.chart(body).filter(|chart| chart.is_reduced()) {
            Some(chart) => Acceleration::within(met, &load, &chart.centripetal(&met.motion)),
            None => Acceleration::free(met, &load),
        }
    }

    /// Where the axes of a body's shape stand at an instant.
    fn pose_at(&self, body: usize, time: Time) -> Pose {
        self.pose_of(body, &self.motion_at(body, time))
    }

    /// The same where the body moves so.
    pub(super) fn pose_of(&self, body: usize, motion: &BodyMotion) -> Pose {
        let center = self.plan.bodies()[body].properties.center_of_mass;
        Pose { position: motion.point(&-center), orientation: motion.orientation }
    }

    /// The closest features of two bodies at an instant.
    pub(super) fn closest(&self, a: usize, b: usize, time: Time) -> Result<ClosestFeatures, SimulationError> {
        self.closest_at([a, b], [a, b].map(|i| self.pose_at(i, time)), time.value)
    }

    /// The same at these poses.
    pub(super) fn closest_at(
        &self,
        [a, b]: [usize; 2],
        [pose_a, pose_b]: [Pose; 2],
        time: f64,
    ) -> Result<ClosestFeatures, SimulationError> {
        let [Some(shape_a), Some(shape_b)] = [a, b].map(|i| self.plan.bodies()[i].collider.as_deref()) else {
            return Err(self.failure_of(&[a, b], time, Failure::Refused("no shape".to_owned())));
        };
        let mut cache = PairCache::new();
        closest_features(shape_a, &pose_a, shape_b, &pose_b, Some(&mut cache), Accuracy::Exact)
            .map_err(|error| self.failure_of(&[a, b], time, Failure::Refused(error.to_string())))
    }

    /// Size of a pair [m], by which its tolerances are measured: both radii; a fixed body counts as the other.
    pub(super) fn size(&self, a: usize, b: usize) -> f64 {
        self.plan.bodies()[a].radius + self.plan.bodies()[b].radius
    }

    /// How much farther than its box a body's neighbours are looked for [m].
    pub(super) fn reach_of(&self, radius: f64) -> f64 {
        self.eps_given().unwrap_or(0.0) + 2.0 * TOUCH_GAP * radius
    }
}

/// Which features touch, in words: of a, then of b.
pub(super) fn in_words(closest: &ClosestFeatures) -> String {
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
