//! The motion of a body and its load as power series of time.
//!
//! Vectors stand in world axes, or in the body's own: those in which its coordinates turn. An effect writes its force
//! and torque in the axes in which they are simpler; what moves the body turns them where it needs them.

use crate::math::series::{Attitude, Node, Tape};
use crate::math::{Matrix3, Vector3};

/// A body on a tape.
#[derive(Debug)]
pub struct SeriesBody {
    pub(crate) mass: f64,
    /// Inertia about the centre of mass, own axes [kg·m²].
    pub(crate) inertia: Matrix3,
    /// From its own axes to body axes.
    pub(crate) axes: Matrix3,
    pub(crate) attitude: Attitude,
    /// Angular velocity, own axes.
    pub(crate) angular_velocity: Node,
    /// Angular momentum about the centre of mass or the point that rests, own axes; about an axis, as a number.
    pub(crate) spin: Node,
    /// Linear momentum, world axes; in a plane, along its axes.
    pub(crate) momentum: Option<Node>,
    pub(crate) place: Place,
    /// The world's axes seen from the body, where something has asked for them.
    pub(crate) seen: Option<[Node; 3]>,
}

/// Where the centre of mass is.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Place {
    /// Its position and velocity, world axes.
    Moving(Node, Node),
    /// From a point that rests in the world: so far, own axes.
    Arm(Vector3, Vector3),
}

/// Force and torque about the centre of mass, in world axes and in own axes; none is 0.
#[derive(Debug, Clone, Copy, Default)]
pub struct SeriesLoad {
    pub(crate) force: Option<Node>,
    pub(crate) force_own: Option<Node>,
    pub(crate) torque: Option<Node>,
    pub(crate) torque_own: Option<Node>,
}

/// `sum += v`, unless v is 0 for ever.
pub(crate) fn add(tape: &mut Tape, sum: &mut Option<Node>, v: Node) {
    if tape.value(v) == Some(Vector3::zeros()) {
        return;
    }
    *sum = Some(sum.map_or(v, |sum| tape.sum(sum, 1.0, v)));
}

impl SeriesBody {
    /// A vector in body axes as one in its own.
    pub(crate) fn own(&self, v_body: &Vector3) -> Vector3 {
        self.axes.tr_mul(v_body)
    }

    /// The world's axes seen from the body, `Rᵀ e_i`.
    fn seen(&mut self, tape: &mut Tape) -> [Node; 3] {
        let (attitude, rate) = (self.attitude, self.angular_velocity);
        *self.seen.get_or_insert_with(|| {
            [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| tape.seen(axis, attitude, rate))
        })
    }

    /// A vector of the world in own axes, `Rᵀ v`.
    pub(crate) fn own_of(&mut self, tape: &mut Tape, v: Node) -> Node {
        if let (Some(v), None) = (tape.value(v), self.seen) {
            return tape.seen(v, self.attitude, self.angular_velocity);
        }
        let axes = self.seen(tape);
        let parts = [0, 1, 2].map(|i| {
            let component = tape.component(v, i);
            tape.product(component, axes[i])
        });
        let sum = tape.sum(parts[0], 1.0, parts[1]);
        tape.sum(sum, 1.0, parts[2])
    }

    /// A vector in own axes in the world, `R v`.
    pub(crate) fn world_of(&mut self, tape: &mut Tape, v: Node) -> Node {
        if let Attitude::Quaternion(at) = self.attitude
            && let Some(carried) = tape.carried(v, at)
        {
            return carried;
        }
        let axes = self.seen(tape);
        let parts = [0, 1, 2].map(|i| {
            let along = tape.dot(axes[i], v);
            let mut place = Matrix3::zeros();
            place[(i, i)] = 1.0;
            tape.linear(along, place)
        });
        let sum = tape.sum(parts[0], 1.0, parts[1]);
        tape.sum(sum, 1.0, parts[2])
    }

    /// From a point of the world to the centre of mass, own axes.
    pub(crate) fn offset_own(&mut self, tape: &mut Tape, point: &Vector3) -> Node {
        match self.place {
            Place::Moving(position, _) => {
                let point = tape.constant(*point);
                let offset = tape.sum(position, -1.0, point);
                self.own_of(tape, offset)
            }
            Place::Arm(pivot, arm) => {
                let arm = tape.constant(arm);
                if pivot == *point {
                    return arm;
                }
                let offset = tape.constant(pivot - point);
                let offset = self.own_of(tape, offset);
                tape.sum(offset, 1.0, arm)
            }
        }
    }

    /// The sum of a vector in world axes and one in own axes, world axes.
    pub(crate) fn sum_world(&mut self, world: Option<Node>, own: Option<Node>, tape: &mut Tape) -> Option<Node> {
        let mut sum = world;
        if let Some(own) = own {
            let turned = self.world_of(tape, own);
            add(tape, &mut sum, turned);
        }
        sum
    }

    /// The sum of a vector in world axes and one in own axes, own axes.
    pub(crate) fn sum_own(&mut self, world: Option<Node>, own: Option<Node>, tape: &mut Tape) -> Option<Node> {
        let mut sum = own;
        if let Some(world) = world {
            let turned = self.own_of(tape, world);
            add(tape, &mut sum, turned);
        }
        sum
    }

    /// The torque of a load about the point that rests, own axes.
    pub(crate) fn torque_about_pivot(&mut self, load: SeriesLoad, tape: &mut Tape) -> Option<Node> {
        let mut sum = self.sum_own(load.torque, load.torque_own, tape);
        if let (Place::Arm(_, arm), Some(force)) = (self.place, self.sum_own(load.force, load.force_own, tape)) {
            let arm = tape.constant(arm);
            let torque = tape.cross(arm, force);
            add(tape, &mut sum, torque);
        }
        sum
    }
}
