//! How a body may move, and the few numbers that are then integrated.
//!
//! | freedom | coordinates | momenta | numbers |
//! |---|---|---|---|
//! | [`Freedom::Free`] | x, q (or R) | P, L | 13 (18) |
//! | [`Freedom::Planar`] | two of x, an angle | two of P, one of L | 6 |
//! | [`Freedom::Pivot`] | q (or R) | L about the pivot | 7 (12) |
//! | [`Freedom::Axle`] | an angle | L about the axle | 2 |
//!
//! A constraint removes coordinates instead of adding forces, so it cannot be violated. The forces
//! it would need are worked out where they are asked for ([`Chart::reaction`]).

use crate::effect::series::{SeriesBody, SeriesLoad};
use crate::error::{Error, Result};
use crate::math::series::Tape;
use crate::math::sum::two_sum;
use crate::math::{Matrix3, Quaternion, Vector3};
use crate::state::{BodyMotion, BodyState, Load};

mod axle;
mod free;
mod moser_veselov;
mod pivot;
mod planar;
pub mod prescribed;
pub(crate) mod riding;
pub(crate) mod spin;

pub use prescribed::Prescribed;
pub use riding::Riding;
pub(crate) use spin::Spin;
pub use spin::{Form, RotationSplit};

/// How a body may move.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Freedom {
    /// Any way: 6 degrees of freedom.
    #[default]
    Free,
    /// In a plane through its start: 3 degrees of freedom, rotation about the plane's normal.
    Planar(Planar),
    /// About a point that rests in the world: 3 degrees of freedom, a top.
    Pivot(Pivot),
    /// About an axis that rests in the world: 1 degree of freedom, a pendulum or a wheel.
    Axle(Axle),
}

/// Motion in a plane.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Planar {
    /// Normal of the plane, world axes; of any length but 0.
    pub normal: [f64; 3],
}

/// Motion about a point.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Pivot {
    /// The point that rests, body axes from the centre of mass [m].
    pub point_body: [f64; 3],
}

/// Motion about an axis.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Axle {
    /// A point of the axis, body axes from the centre of mass [m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub point_body: [f64; 3],
    /// Direction of the axis, body axes; of any length but 0.
    pub axis_body: [f64; 3],
}

impl Freedom {
    /// Motion in the plane with this normal (world axes).
    pub fn planar(normal: impl Into<[f64; 3]>) -> Self {
        Self::Planar(Planar { normal: normal.into() })
    }

    /// Motion about this point (body axes from the centre of mass [m]).
    pub fn pivot(point_body: impl Into<[f64; 3]>) -> Self {
        Self::Pivot(Pivot { point_body: point_body.into() })
    }

    /// Motion about the axis through this point (body axes from the centre of mass [m]).
    pub fn axle(point_body: impl Into<[f64; 3]>, axis_body: impl Into<[f64; 3]>) -> Self {
        Self::Axle(Axle { point_body: point_body.into(), axis_body: axis_body.into() })
    }

    /// The name that files and reports use.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Planar(_) => "planar",
            Self::Pivot(_) => "pivot",
            Self::Axle(_) => "axle",
        }
    }
}

/// What errors of a motion are measured by.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scales {
    /// Length that positions are measured by [m].
    pub length: f64,
    /// Time that the motion takes [s]. Momenta below `m length/time` and `I/time` do not matter to it:
    /// errors of smaller ones are measured by these.
    pub time: f64,
}

/// A body's coordinates: how its state is written as the numbers that are integrated, and back.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Chart {
    /// All coordinates.
    Free(free::Free),
    /// Two of the position, one angle.
    Planar(planar::Planar),
    /// The orientation.
    Pivot(pivot::Pivot),
    /// One angle.
    Axle(axle::Axle),
    /// None: the body rests.
    Fixed,
    /// None: the body is part of a compound.
    Riding(Riding),
}

/// Calls the variant's own method; a body that rests, or rides, has nothing to integrate.
macro_rules! dispatch {
    ($chart:expr, $inner:ident => $call:expr, $fixed:expr) => {
        match $chart {
            Chart::Free($inner) => $call,
            Chart::Planar($inner) => $call,
            Chart::Pivot($inner) => $call,
            Chart::Axle($inner) => $call,
            Chart::Fixed | Chart::Riding(_) => $fixed,
        }
    };
}

impl Chart {
    /// The coordinates of a body that starts with `motion`.
    ///
    /// # Errors
    /// A direction of length 0, and a velocity that the freedom does not allow.
    pub fn new(freedom: &Freedom, form: Form, motion: &BodyMotion, place: &str) -> Result<Self> {
        Ok(match freedom {
            Freedom::Free => Self::Free(free::Free::new(form, motion)),
            Freedom::Planar(data) => Self::Planar(planar::Planar::new(data, motion, place)?),
            Freedom::Pivot(data) => Self::Pivot(pivot::Pivot::new(data, form, motion, place)?),
            Freedom::Axle(data) => Self::Axle(axle::Axle::new(data, motion, place)?),
        })
    }

    /// How many numbers are integrated.
    pub fn dimension(&self) -> usize {
        dispatch!(self, c => c.dimension(), 0)
    }

    /// Writes a state as coordinates. Full turns do not show in a state: an angle becomes the one nearest to that
    /// which `y` holds.
    pub fn encode(&self, state: &BodyState, y: &mut [f64]) {
        dispatch!(self, c => c.encode(state, y), ());
    }

    /// Reads the motion from coordinates; mass and inertia of `motion` stay.
    #[inline(always)]
    pub fn decode(&self, y: &[f64], motion: &mut BodyMotion) {
        dispatch!(self, c => c.decode(y, motion), ());
    }

    /// `dY/dt` under a load, lecture (24); `motion` is what [`decode`](Self::decode) read from `y`.
    #[inline(always)]
    pub fn rate(&self, y: &[f64], motion: &BodyMotion, load: &Load, dy: &mut [f64]) {
        dispatch!(self, c => c.rate(y, motion, load, dy), ());
    }

    /// The same under a load that does not depend on the motion, of which only what is needed is read; `motion`
    /// is room to work in.
    #[inline(always)]
    pub fn rate_constant(&self, y: &[f64], motion: &mut BodyMotion, load: &Load, dy: &mut [f64]) {
        match self {
            Self::Free(c) => c.rate_constant(y, load, dy),
            Self::Pivot(c) => c.rate_constant(y, load, dy),
            Self::Planar(_) => self.rate(y, motion, load, dy),
            Self::Axle(_) => {
                self.decode(y, motion);
                self.rate(y, motion, load, dy);
            }
            Self::Fixed | Self::Riding(_) => {}
        }
    }

    /// `dY/dt` where nothing acts on the body: no load, and no motion to be read first. It is also
    /// the drift of a splitting, whose kick is the rest of [`rate`](Self::rate).
    #[inline(always)]
    pub fn rate_unloaded(&self, y: &[f64], dy: &mut [f64]) {
        dispatch!(self, c => c.rate_unloaded(y, dy), ());
    }

    /// Advances the motion without loads by `h` [s]: exactly, or with the rotation split; `rest` takes up
    /// what rounding drops.
    #[inline]
    pub fn flow(&self, y: &mut [f64], rest: &mut [f64], h: f64, split: RotationSplit) {
        match self {
            Self::Free(c) => c.flow(y, rest, h, split),
            Self::Pivot(c) => c.spin().flow(y, rest, h, split),
            Self::Planar(_) | Self::Axle(_) => {
                // straight lines: the rates without loads stay
                let mut dy = [0.0; 6];
                let n = self.dimension();
                self.rate_unloaded(y, &mut dy[..n]);
                for ((y, rest), dy) in y.iter_mut().zip(rest).zip(&dy) {
                    (*y, *rest) = two_sum(*y, h * dy + *rest);
                }
            }
            Self::Fixed | Self::Riding(_) => {}
        }
    }

    /// Where a chart that begins at `at` keeps orientation and angular momentum, if it does.
    #[inline(always)]
    pub(crate) fn spin_part(&self, at: usize) -> Option<(std::ops::Range<usize>, &Spin)> {
        match self {
            Self::Free(c) => Some((at + 6..at + self.dimension(), c.spin())),
            Self::Pivot(c) => Some((at..at + self.dimension(), c.spin())),
            Self::Planar(_) | Self::Axle(_) | Self::Fixed | Self::Riding(_) => None,
        }
    }

    /// Amends a change `dy` of the numbers, of which rounding left `rest`, so that the orientation does not leave
    /// its sphere (or R the rotations), lecture §4; returns how far it had strayed: `||q| − 1|` or
    /// `‖RᵀR − I‖` [-].
    #[inline(always)]
    pub fn project(&self, y: &[f64], rest: &[f64], dy: &mut [f64]) -> f64 {
        match self.spin_part(0) {
            Some((part, spin)) => spin.project(&y[part.clone()], &rest[part.clone()], &mut dy[part]),
            None => 0.0,
        }
    }

    /// How far the orientation is off its sphere, as it stands [-].
    pub fn orientation_error(&self, y: &[f64]) -> f64 {
        match self.spin_part(0) {
            Some((part, spin)) => spin.orientation_error(&y[part]),
            None => 0.0,
        }
    }

    /// The body on a tape, its numbers from `at` on; none if it rests. Methods of series integrate in body axes.
    pub(crate) fn begin_series(&self, at: usize, motion: &BodyMotion, tape: &mut Tape) -> Option<SeriesBody> {
        dispatch!(self, c => Some(c.begin_series(at, motion, tape)), None)
    }

    /// How its momenta change under a load, on a tape.
    pub(crate) fn end_series(&self, body: &mut SeriesBody, load: SeriesLoad, tape: &mut Tape) {
        dispatch!(self, c => c.end_series(body, load, tape), ());
    }

    /// Size of an error `e` of a step from `y0` to `y1` [-]: of the position over a length, of
    /// the orientation in radians, of momenta over their own size.
    #[inline]
    pub fn error_size(&self, y0: &[f64], y1: &[f64], e: &[f64], scales: &Scales) -> f64 {
        dispatch!(self, c => c.error_size(y0, y1, e, scales), 0.0)
    }

    /// Force and torque about the centre of mass with which the constraint holds the body [N], [N·m]; nothing of a
    /// part, which its compound holds, not its freedom.
    pub fn reaction(&self, motion: &BodyMotion, load: &Load) -> Load {
        match self {
            Self::Free(_) | Self::Riding(_) => Load::zero(),
            Self::Planar(c) => c.reaction(motion, load),
            Self::Pivot(c) => c.reaction(motion, load),
            Self::Axle(c) => c.reaction(motion, load),
            Self::Fixed => Load { force: -load.force, torque: -load.torque },
        }
    }
}

/// A point of a body, whose motion is simple, in the numbers of a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Place {
    /// Three numbers, from this one on [m].
    Numbers(usize),
    /// Two numbers, from this one on [m], along two unit vectors from a point.
    Plane {
        /// The first of them.
        at: usize,
        /// Where both are 0, world axes [m].
        start: Vector3,
        /// The unit vectors, world axes.
        axes: [Vector3; 2],
    },
    /// It rests there, world axes [m].
    Rests(Vector3),
}

/// How a body turns, in the numbers of a chart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Turning {
    /// Four numbers, from this one on: a quaternion of any length, before `axes`.
    Quaternion {
        /// The first of them.
        at: usize,
        /// From the body's axes to those that the quaternion leads from.
        axes: Quaternion,
    },
    /// One number, an angle [rad].
    Angle {
        /// Its place.
        at: usize,
        /// What it turns about, world axes.
        axis: Vector3,
        /// The orientation where it is 0.
        start: Quaternion,
    },
}

impl Chart {
    /// How the point [`point_body`](Self::point_body) moves, of a chart whose numbers begin at `at`; none of a body
    /// that has no numbers.
    pub(crate) fn place(&self, at: usize) -> Option<Place> {
        match self {
            Self::Free(_) => Some(Place::Numbers(at)),
            Self::Planar(c) => Some(c.place(at)),
            Self::Pivot(c) => Some(Place::Rests(c.point())),
            Self::Axle(c) => Some(Place::Rests(c.point())),
            Self::Fixed | Self::Riding(_) => None,
        }
    }

    /// How the body turns, of a chart whose numbers begin at `at`; none of a rotation matrix, and of a body that has no
    /// numbers.
    pub(crate) fn turning(&self, at: usize) -> Option<Turning> {
        match self {
            Self::Planar(c) => Some(c.turning(at)),
            Self::Axle(c) => Some(c.turning(at)),
            _ => {
                let (part, spin) = self.spin_part(at).filter(|(_, spin)| spin.form() != Form::WorldMatrix)?;
                let axes = spin.axes().map_or_else(Quaternion::identity, |axes| axes.conjugate());
                Some(Turning::Quaternion { at: part.start, axes })
            }
        }
    }

    /// From the centre of mass to the point whose motion is simple, body axes [m]: the point of the body that rests,
    /// where one does.
    pub(crate) fn point_body(&self) -> Vector3 {
        match self {
            Self::Pivot(c) => -c.arm_body(),
            Self::Axle(c) => -c.arm_body(),
            Self::Free(_) | Self::Planar(_) | Self::Fixed | Self::Riding(_) => Vector3::zeros(),
        }
    }

    /// Whether its body has fewer freedoms than a free one.
    pub(crate) fn is_reduced(&self) -> bool {
        matches!(self, Self::Planar(_) | Self::Pivot(_) | Self::Axle(_))
    }

    /// What the body is free to do, each a pair (v, ω) of its centre of mass in world axes; none of a body that is
    /// free to do anything, or has no numbers.
    pub(crate) fn freedoms(&self, motion: &BodyMotion) -> Option<Vec<(Vector3, Vector3)>> {
        let turn = |axis: Vector3| (axis.cross(&(motion.rotation * -self.point_body())), axis);
        match self {
            Self::Planar(c) => Some(c.freedoms().to_vec()),
            Self::Pivot(_) => Some([Vector3::x(), Vector3::y(), Vector3::z()].map(turn).to_vec()),
            Self::Axle(c) => Some(vec![turn(c.axis())]),
            Self::Free(_) | Self::Fixed | Self::Riding(_) => None,
        }
    }

    /// Acceleration of the centre of mass that its motion takes where the angular velocity stays, `ω × (ω × r)` about
    /// a point that rests [m/s²].
    pub(crate) fn centripetal(&self, motion: &BodyMotion) -> Vector3 {
        match self {
            Self::Pivot(_) | Self::Axle(_) => motion.angular_velocity.cross(&motion.velocity),
            Self::Free(_) | Self::Planar(_) | Self::Fixed | Self::Riding(_) => Vector3::zeros(),
        }
    }

    /// Moves the body on for `h` [s] by the rates that its numbers have where nothing acts on it, which keep its momenta.
    pub(crate) fn drift(&self, motion: &mut BodyMotion, h: f64) {
        let n = self.dimension();
        let (mut y, mut dy) = (vec![0.0; n], vec![0.0; n]);
        self.encode(&motion.state(), &mut y);
        self.rate_unloaded(&y, &mut dy);
        y.iter_mut().zip(&dy).for_each(|(y, dy)| *y += h * dy);
        self.decode(&y, motion);
    }
}

/// Of the angles that differ from this one by full turns the nearest to `near` [rad].
fn nearest_turn(angle: f64, near: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle + turn * ((near - angle) / turn).round()
}

/// What the constraint must add so that the centre of mass accelerates with `a` and the body turns
/// with the angular acceleration `alpha`: Newton's and Euler's equations solved for the load.
fn missing_load(motion: &BodyMotion, load: &Load, a: &Vector3, alpha: &Vector3) -> Load {
    let inertia = motion.rotation * motion.inertia_body * motion.rotation.transpose();
    let w = &motion.angular_velocity;
    Load { force: motion.mass * a - load.force, torque: inertia * alpha + w.cross(&(inertia * w)) - load.torque }
}

/// The direction of a vector given by the user.
fn direction(place: &str, field: &'static str, value: [f64; 3]) -> Result<Vector3> {
    let v = Vector3::from(value);
    let scale = v.amax();
    if !(scale.is_finite() && scale > 0.0) {
        return Err(Error::value(place, field, "a finite vector that is not 0", value));
    }
    let v = v / scale;
    Ok(v / v.norm())
}

/// Inverse of an inertia tensor that has been found positive definite.
fn inverse(inertia: &Matrix3) -> Matrix3 {
    inertia.try_inverse().unwrap_or_else(|| Matrix3::from_element(f64::NAN))
}

/// `I + m (r·r 1 − r rᵀ)`: inertia about the point `−r` from the centre of mass, or `r` as well.
fn about_point(motion: &BodyMotion, r: &Vector3) -> Matrix3 {
    motion.inertia_body + motion.mass * (Matrix3::identity() * r.norm_squared() - r * r.transpose())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::quaternion;

    #[test]
    fn an_angle_is_written_next_to_the_one_before() {
        // states do not show full turns; q = exp(θ u) is the same for θ and θ + 2π
        let mut motion = BodyMotion::at_rest(2.0, Matrix3::identity());
        let (up, angle) = (Vector3::z(), 3.0);
        let held = [(Freedom::planar([0.0, 0.0, 1.0]), 2), (Freedom::axle([0.0; 3], [0.0, 0.0, 1.0]), 0)];
        for (freedom, place) in held {
            let chart = Chart::new(&freedom, Form::Body, &motion, "body").unwrap();
            motion.orientation = quaternion::from_axis_angle(&up, angle);
            for before in [0.0, 3.3, 9.5, -3.2, 100.0] {
                let mut y = vec![before; chart.dimension()];
                chart.encode(&motion.state(), &mut y);
                let turns = (y[place] - angle) / std::f64::consts::TAU;
                // rounding of a logarithm and of 16 turns
                assert!((turns - turns.round()).abs() < 1e-14 && (y[place] - before).abs() < 3.2, "{before}: {y:?}");
            }
            motion.orientation = Quaternion::identity();
        }
    }

    #[test]
    fn a_constant_load_changes_the_numbers_as_any_load_does() {
        // lopsided, so that body axes, principal axes and world axes all differ, and turned
        let inertia = Matrix3::new(1.3, 0.2, -0.1, 0.2, 0.9, 0.15, -0.1, 0.15, 1.6);
        let mut motion = BodyMotion::at_rest(2.0, inertia);
        motion.position = Vector3::new(0.3, -0.2, 0.5);
        motion.orientation = quaternion::exp(&Vector3::new(0.7, -1.1, 0.4));
        motion.rotation = quaternion::to_matrix(&motion.orientation);
        let force = Vector3::new(0.7, -1.9, 1.2);
        let freedoms =
            [Freedom::Free, Freedom::pivot([0.1, -0.2, 0.3]), Freedom::axle([0.1, -0.2, 0.3], [0.3, 0.5, -0.8])];
        for (freedom, form) in freedoms
            .iter()
            .flat_map(|freedom| [Form::WorldQuaternion, Form::WorldMatrix, Form::Body].map(|form| (freedom, form)))
        {
            let chart = Chart::new(freedom, form, &motion, "body").unwrap();
            let n = chart.dimension();
            let mut y = vec![0.0; n];
            chart.encode(&motion.state(), &mut y);
            // off the sphere by a hair, as within a step, and moving
            y.iter_mut().enumerate().for_each(|(i, y)| *y += 1e-3 * (1.0 + i as f64));
            for torque in [Vector3::zeros(), Vector3::new(0.4, 0.8, -0.6)] {
                let load = Load { force, torque };
                let (mut read, mut scratch) = (motion, motion);
                let (mut expected, mut dy) = (vec![0.0; n], vec![f64::NAN; n]);
                chart.decode(&y, &mut read);
                chart.rate(&y, &read, &load, &mut expected);
                chart.rate_constant(&y, &mut scratch, &load, &mut dy);
                for (dy, expected) in dy.iter().zip(&expected) {
                    // the same formula in another order: some ten roundings of numbers of size 2
                    assert!((dy - expected).abs() < 20.0 * f64::EPSILON, "{freedom:?} {form:?}: {dy} {expected}");
                }
            }
        }
    }
}
