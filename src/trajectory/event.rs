//! What happens at an instant of a run: impacts, what sticks and comes off, rest, and what the run watches for.

use crate::math::Vector3;
use crate::math::roots::Passage;
use crate::state::BodyMotion;

/// What kind of event it was.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum EventKind {
    /// A body rebounded.
    Bounce,
    /// A body stuck to another: to a fixed one, where it stops, to one on a prescribed motion, with which it moves, or
    /// to a free one, and both are one body from here on.
    Stick,
    /// What had stuck came off: its joint carried more than the pair's breaking load. Each piece goes on with the
    /// motion that it has.
    Break,
    /// Bodies stay in contact from here on: they slide, roll or tip on each other.
    Contact,
    /// Bodies rest on each other from here on, in equilibrium, until something hits them or a load changes.
    Rest,
    /// A measure that the run watched met its value.
    User,
    /// The state turned a load on or off.
    Switch,
}

impl EventKind {
    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bounce => "bounce",
            Self::Stick => "stick",
            Self::Break => "break",
            Self::Contact => "contact",
            Self::Rest => "rest",
            Self::User => "user",
            Self::Switch => "switch",
        }
    }
}

/// Something that happened at an instant. World axes.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Event {
    /// When [s].
    pub time: f64,
    /// What.
    pub kind: EventKind,
    /// The name of a user's event, or which load was turned on or off; empty for impacts.
    pub name: String,
    /// How the measure behind a user's event or a switch met its value.
    pub passage: Option<Passage>,
    /// The two bodies a and b, as places in the scene; the first and the last of a user's event or a switch, to
    /// which nothing of the below applies.
    pub bodies: [usize; 2],
    /// Where the impulse acts [m]: the point of contact, or the centroid of several, weighted by their impulses; of a
    /// break the joint, the mean of the points in which they touched.
    pub point: Vector3,
    /// Unit normal from a to b; of a break, as it was when they stuck, turned with b.
    pub normal: Vector3,
    /// Impulse on b [N·s]; −1 times that on a.
    pub impulse: Vector3,
    /// Force of a on b that the joint carried when it broke [N].
    pub force: Vector3,
    /// Torque of a on b about the joint when it broke [N·m].
    pub torque: Vector3,
    /// Which features of a and b touched, in words.
    pub features: String,
    /// Rounds that the finder took to locate it.
    pub iterations: u32,
    /// Velocity of b's centre of mass before and after [m/s].
    pub velocity: [Vector3; 2],
    /// Angular velocity of b before and after [rad/s].
    pub angular_velocity: [Vector3; 2],
    /// Velocity of a's centre of mass before and after [m/s].
    pub other_velocity: [Vector3; 2],
    /// Angular velocity of a before and after [rad/s].
    pub other_angular_velocity: [Vector3; 2],
    /// Kinetic energy lost [J].
    pub energy_lost: f64,
}

impl Event {
    /// An event at `time` [s] between two bodies a and b, with their motions before and after; the rest is nothing.
    pub(crate) fn between(
        time: f64,
        kind: EventKind,
        bodies: [usize; 2],
        a: [&BodyMotion; 2],
        b: [&BodyMotion; 2],
    ) -> Self {
        Self {
            passage: None,
            velocity: b.map(|b| b.velocity),
            angular_velocity: b.map(|b| b.angular_velocity),
            other_velocity: a.map(|a| a.velocity),
            other_angular_velocity: a.map(|a| a.angular_velocity),
            ..Self::watched(time, kind, String::new(), Passage::Rising, bodies)
        }
    }

    /// An event at `time` [s] that is no impact, of these two bodies.
    pub(crate) fn watched(time: f64, kind: EventKind, name: String, passage: Passage, bodies: [usize; 2]) -> Self {
        let nothing = Vector3::zeros();
        Self {
            time,
            kind,
            name,
            passage: Some(passage),
            bodies,
            point: nothing,
            normal: nothing,
            impulse: nothing,
            force: nothing,
            torque: nothing,
            features: String::new(),
            iterations: 0,
            velocity: [nothing; 2],
            angular_velocity: [nothing; 2],
            other_velocity: [nothing; 2],
            other_angular_velocity: [nothing; 2],
            energy_lost: 0.0,
        }
    }
}
