//! Motion in closed form: no steps, no error but rounding.
//!
//! Free bodies on which no torque acts, in uniform gravity and in air that drags in proportion to the
//! speed; tops without weight; bodies in a plane or on an axle under constant loads. The motion is a
//! function of time since the flight began and is evaluated where someone looks.
//!
//! | | translation | rotation |
//! |---|---|---|
//! | free | `v′ = g − k (v − wind)` | [`FreeRotation`] |
//! | pivot | follows the rotation | [`FreeRotation`] about the pivot |
//! | planar, axle | `y + t y′ + ½ t² y″` | the same |

use std::sync::Arc;

use super::free_rotation::FreeRotation;
use super::{Control, Counts, Flight, FlightError, Front, Problem, Segment};
use crate::mass::MassProperties;
use crate::math::decay::decay_functions;
use crate::math::sum::Time;
use crate::math::{Matrix3, Quaternion, Vector3, quaternion};
use crate::state::BodyMotion;
use crate::tolerance::STEP_REMAINDER;

/// The order of a method without steps, for the list of methods.
pub(super) const ORDER: u32 = 0;

/// What acts on the translation of a free body: `v′ = g − k (v − wind)`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Pull {
    /// Constant acceleration g [m/s²].
    pub(crate) acceleration: Vector3,
    /// Drag per speed and mass k [1/s].
    pub(crate) drag: f64,
    /// Velocity of the air [m/s].
    pub(crate) wind: Vector3,
}

impl Pull {
    /// Position and velocity after `t` [s].
    ///
    /// ```text
    /// a = g − k (v₀ − wind)        v = v₀ + a t φ₁(kt)        x = x₀ + v₀ t + a t² φ₂(kt)
    /// ```
    fn after(&self, position: &Vector3, velocity: &Vector3, t: f64) -> (Vector3, Vector3) {
        let start = self.acceleration - self.drag * (velocity - self.wind);
        let (phi1, phi2) = decay_functions(self.drag * t);
        (position + t * (velocity + (t * phi2) * start), velocity + (t * phi1) * start)
    }
}

/// The motion of one body, as it starts.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub(crate) enum Start {
    /// It rests.
    Fixed,
    /// Numbers `[x, P, q, L]`, L in world axes.
    Free { motion: BodyMotion, pull: Pull },
    /// Numbers `[q, L about the pivot]`.
    Pivot { inertia: Matrix3, orientation: Quaternion, momentum: Vector3 },
    /// Numbers and their first and second derivatives, which stays.
    Line { y: Vec<f64>, slope: Vec<f64>, bend: Vec<f64> },
}

/// The motion of a group of bodies, as functions of the time since it began.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(from = "Saved", into = "Saved"))]
pub struct ClosedMotion {
    begin: Time,
    starts: Vec<Start>,
    /// The rotation of each body that has one.
    spins: Vec<Option<Spinning>>,
    /// The numbers of each body in a plane or on an axle as polynomials of the time: y, y′, ½ y″.
    lines: Vec<Vec<f64>>,
    dimension: usize,
}

/// A rotation without torque.
#[derive(Debug, Clone)]
struct Spinning {
    rotation: FreeRotation,
    /// Principal moments [kg m²].
    moments: Vector3,
    /// Inverse of the inertia, body axes [1/(kg m²)].
    inverse: Matrix3,
}

/// What of a closed motion is written to a file; the rest follows from it.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct Saved {
    begin: Time,
    starts: Vec<Start>,
}

#[cfg(feature = "serde")]
impl From<Saved> for ClosedMotion {
    fn from(saved: Saved) -> Self {
        Self::new(saved.begin, saved.starts)
    }
}

#[cfg(feature = "serde")]
impl From<ClosedMotion> for Saved {
    fn from(motion: ClosedMotion) -> Self {
        Self { begin: motion.begin, starts: motion.starts }
    }
}

impl PartialEq for ClosedMotion {
    fn eq(&self, other: &Self) -> bool {
        self.begin == other.begin && self.starts == other.starts
    }
}

impl ClosedMotion {
    pub(crate) fn new(begin: Time, starts: Vec<Start>) -> Self {
        let rotation = |inertia: Matrix3, orientation: Quaternion, momentum: &Vector3| {
            let principal = MassProperties { mass: 0.0, center_of_mass: Vector3::zeros(), inertia }.principal();
            let momentum_body = quaternion::rotate(&orientation.conjugate(), momentum);
            let rotation = FreeRotation::new(principal.moments, principal.axes, orientation, momentum_body);
            let inverse = inertia.try_inverse().unwrap_or_else(|| Matrix3::from_element(f64::NAN));
            Some(Spinning { rotation, moments: principal.moments, inverse })
        };
        let spins = starts.iter().map(|start| match start {
            Start::Free { motion, .. } => rotation(motion.inertia_body, motion.orientation, &motion.angular_momentum()),
            Start::Pivot { inertia, orientation, momentum } => rotation(*inertia, *orientation, momentum),
            Start::Fixed | Start::Line { .. } => None,
        });
        let dimension = starts.iter().map(|start| match start {
            Start::Fixed => 0,
            Start::Free { .. } => 13,
            Start::Pivot { .. } => 7,
            Start::Line { y, .. } => y.len(),
        });
        let lines = starts.iter().map(|start| match start {
            Start::Line { y, slope, bend } => {
                y.iter().chain(slope).copied().chain(bend.iter().map(|bend| 0.5 * bend)).collect()
            }
            _ => Vec::new(),
        });
        Self { begin, spins: spins.collect(), lines: lines.collect(), dimension: dimension.sum(), starts }
    }

    /// How many numbers describe it.
    pub(super) fn dimension(&self) -> usize {
        self.dimension
    }

    /// The numbers at the time `t` since the beginning [s].
    pub(super) fn at(&self, t: f64, y: &mut [f64]) {
        let mut at = 0;
        for (start, spin) in self.starts.iter().zip(&self.spins) {
            match (start, spin) {
                (Start::Free { motion, pull }, Some(spin)) => {
                    let (position, velocity) = pull.after(&motion.position, &motion.velocity, t);
                    y[at..at + 3].copy_from_slice(position.as_slice());
                    y[at + 3..at + 6].copy_from_slice((motion.mass * velocity).as_slice());
                    y[at + 6..at + 10].copy_from_slice(&quaternion::to_scalar_first(&spin.rotation.at(t).0));
                    y[at + 10..at + 13].copy_from_slice(motion.angular_momentum().as_slice());
                    at += 13;
                }
                (Start::Pivot { momentum, .. }, Some(spin)) => {
                    y[at..at + 4].copy_from_slice(&quaternion::to_scalar_first(&spin.rotation.at(t).0));
                    y[at + 4..at + 7].copy_from_slice(momentum.as_slice());
                    at += 7;
                }
                (Start::Line { y: y0, slope, bend }, _) => {
                    for i in 0..y0.len() {
                        y[at + i] = y0[i] + t * (slope[i] + 0.5 * t * bend[i]);
                    }
                    at += y0.len();
                }
                _ => {}
            }
        }
    }
}

/// Bounds of a motion over an interval: `|x″ − a| ≤ δ`, `|ω| ≤ w`, `|ω′| ≤ w′`, world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FreeBounds {
    pub(crate) acceleration: Vector3,
    pub(crate) deviation: f64,
    pub(crate) angular_speed: f64,
    pub(crate) angular_acceleration: f64,
}

/// One body among those of a closed motion.
impl ClosedMotion {
    /// The numbers of a body in a plane or on an axle as polynomials of the time since the beginning [s], term by
    /// term; none of others.
    pub(crate) fn line(&self, body: usize) -> Option<&[f64]> {
        Some(self.lines[body].as_slice()).filter(|line| !line.is_empty())
    }

    /// Position [m], velocity [m/s], orientation and angular velocity [rad/s] of a free body, world axes, at
    /// the time `t` since the beginning [s]; of one that turns about a point, orientation and angular velocity.
    pub(crate) fn free_motion(&self, body: usize, t: f64) -> (Vector3, Vector3, Quaternion, Vector3) {
        let (mut position, mut velocity) = (Vector3::zeros(), Vector3::zeros());
        let Some(spin) = &self.spins[body] else { return (position, velocity, Quaternion::identity(), position) };
        if let Start::Free { motion, pull } = &self.starts[body] {
            (position, velocity) = pull.after(&motion.position, &motion.velocity, t);
        }
        let (q, momentum_body) = spin.rotation.at(t);
        (position, velocity, q, quaternion::rotate(&q, &(spin.inverse * momentum_body)))
    }

    /// Bounds of the motion of a free body, or of one that turns about a point, over `from..=to` [s] since the
    /// beginning; of the latter the point is what moves, or rather rests.
    ///
    /// ```text
    /// a(t) = a₀ e^(−kt)                             within |a₀| (e^(−k from) − e^(−k to))/2 of the middle
    /// |ω|² ≤ min(2 E/I_min, (|L|/I_min)²)
    /// ω′_i = κ_i ω_j ω_k,  |κ_i| ≤ κ = min(1, (I_max − I_min)/I_min)    |ω′| ≤ κ |ω|²/√3,  |ω″| ≤ 2 κ |ω| |ω′|
    /// ```
    ///
    /// ω′ is the same vector in body and in world axes, and ω″ differs by ω × ω′. So over a short interval
    /// ω′ is known by its value at the start.
    pub(crate) fn free_bounds(&self, body: usize, from: f64, to: f64) -> FreeBounds {
        let (mut acceleration, mut deviation) = (Vector3::zeros(), 0.0);
        let (spin, w, momentum) = match (&self.starts[body], &self.spins[body]) {
            (Start::Free { motion, pull }, Some(spin)) => {
                let start = pull.acceleration - pull.drag * (motion.velocity - pull.wind);
                let (first, last) = (libm::exp(-pull.drag * from), libm::exp(-pull.drag * to));
                (acceleration, deviation) = (0.5 * (first + last) * start, 0.5 * (first - last) * start.norm());
                let w = motion.angular_velocity_body();
                (spin, w, motion.inertia_body * w)
            }
            (Start::Pivot { orientation, momentum, .. }, Some(spin)) => {
                let momentum = quaternion::rotate(&orientation.conjugate(), momentum);
                (spin, spin.inverse * momentum, momentum)
            }
            _ => return FreeBounds { acceleration, deviation, angular_speed: 0.0, angular_acceleration: 0.0 },
        };

        let (least, most) = (spin.moments.min(), spin.moments.max());
        let angular_speed = (momentum.norm() / least).min((w.dot(&momentum) / least).sqrt()) * OUTWARD;
        let kappa = if most - least < SPHERE * most { 0.0 } else { ((most - least) / least).min(1.0) };
        let always = kappa * angular_speed * angular_speed / 3f64.sqrt();
        if always == 0.0 {
            return FreeBounds { acceleration, deviation, angular_speed, angular_acceleration: 0.0 };
        }
        let (_, momentum) = spin.rotation.at(from);
        let w = spin.inverse * momentum;
        let now = (spin.inverse * momentum.cross(&w)).norm();
        let change = (2.0 * kappa + 1.0) * angular_speed * always;
        FreeBounds {
            acceleration,
            deviation,
            angular_speed,
            angular_acceleration: always.min(OUTWARD * (now + (to - from) * change)),
        }
    }
}

/// Room for the rounding of a bound [-].
const OUTWARD: f64 = 1.0 + 1.0e-12;
/// Difference of the moments of a sphere, as a fraction of them, that is taken for rounding [-].
const SPHERE: f64 = 16.0 * f64::EPSILON;

/// A flight in closed form. Its steps are only the pieces in which others look at it.
#[derive(Debug)]
pub struct ClosedFlight<P> {
    /// Reads motions from numbers.
    problem: P,
    motion: Arc<ClosedMotion>,
    control: Control,
    front: Time,
    since: f64,
    segment: Segment,
    counts: Counts,
}

impl<P: Problem> ClosedFlight<P> {
    pub(crate) fn new(problem: P, motion: ClosedMotion, control: Control) -> Self {
        let front = motion.begin;
        let (segment, counts) = (Segment::default(), Counts::default());
        Self { problem, motion: Arc::new(motion), control, front, since: front.value, segment, counts }
    }

    /// Time from the beginning to the front [s].
    fn elapsed(&self) -> f64 {
        -self.front.until(self.motion.begin.value) - self.motion.begin.rest
    }

    fn read(&self, t: f64, motions: &mut [BodyMotion]) {
        let mut y = vec![0.0; self.motion.dimension];
        self.motion.at(t, &mut y);
        self.problem.decode(&y, motions);
    }
}

impl<P: Problem> Flight for ClosedFlight<P> {
    fn front(&self) -> f64 {
        self.front.value
    }

    fn advance(&mut self, limit: f64) -> Result<(), FlightError> {
        let left = self.front.until(limit);
        let h = match &self.control {
            Control::Step(step) => *step,
            Control::Error(limits) => limits.longest,
            Control::Mesh(mesh) => self.front.until(mesh.end_after(self.front.value)),
        };
        let h = if h * (1.0 + STEP_REMAINDER) < left { h } else { left };
        self.segment.set_closed(self.front.value, self.since, h, self.elapsed(), self.motion.clone());
        self.front = if h < left { self.front + h } else { Time::new(limit) };
        self.counts.steps += 1;
        Ok(())
    }

    fn interpolate(&mut self) -> Result<(), FlightError> {
        Ok(())
    }

    fn segment(&self) -> &Segment {
        &self.segment
    }

    fn at(&self, t: f64, motions: &mut [BodyMotion]) {
        let t = if t >= self.front.value { self.elapsed() } else { t - self.motion.begin.value };
        self.read(t, motions);
    }

    fn at_offset(&self, offset: f64, motions: &mut [BodyMotion]) {
        let mut y = vec![0.0; self.motion.dimension];
        self.segment.at_offset(offset, &mut y);
        self.problem.decode(&y, motions);
    }

    fn cut(&mut self, offset: f64) {
        self.front = Time::new(self.segment.start) + offset;
        self.segment.end = self.front.value;
    }

    fn set_clock(&mut self, time: Time, since: f64) {
        // only a flight that has just begun is set: its motion begins there
        if self.counts.steps == 0 {
            Arc::make_mut(&mut self.motion).begin = time;
        }
        self.front = time;
        self.since = since;
    }

    fn pass_switch(&mut self) -> Result<(), FlightError> {
        self.since = self.front.value;
        Ok(())
    }

    fn counts(&self) -> &Counts {
        &self.counts
    }

    fn clock(&self) -> (Time, f64) {
        (self.front, self.since)
    }

    fn saved_front(&self) -> Front<Vec<f64>> {
        Front { time: self.front, since: self.since, y: Vec::new(), rest: Vec::new() }
    }

    fn resume(&mut self, front: &Front<Vec<f64>>, segment: Segment, counts: Counts) {
        if let Some(motion) = segment.closed_motion() {
            self.motion = motion.clone();
        }
        self.front = front.time;
        self.since = front.since;
        self.segment = segment;
        self.counts = counts;
    }
}
