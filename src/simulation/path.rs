//! The motion of one body within one step of its flight, with proven bounds: what the search for impacts
//! looks at.
//!
//! ```text
//! polynomial   x(s), q(s):  v = x′, ω = 2 Im(q′ q̄)/|q|²     bounds from the derivatives' coefficients
//! closed form  x″ = g − k (v − wind),  ω = I⁻¹ L              bounds from E, L and Euler's equations
//! at rest      nothing moves
//! ```
//!
//! A polynomial's derivative of order j is bounded about the middle of an interval, `|y⁽ʲ⁾(s) − y⁽ʲ⁾(m)| ≤
//! ½ w Σ |c_k| k!/(k−j−1)! s_max^(k−j−1)`, w being the interval's width: proved, and tight where the
//! interval is short.

use crate::freedom::{Chart, Form, Riding, Spin};
use crate::impact::{Instant, Motion, MotionBounds, Moving};
use crate::integrator::exact::FreeBounds;
use crate::integrator::{ClosedMotion, Curve, Segment};
use crate::math::{Pose, Quaternion, Vector3, quaternion};
use crate::state::BodyMotion;

/// A body's motion from an instant on; its time counts from there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Path<'a> {
    kind: Kind<'a>,
    /// From the shape's origin to the point that moves, shape axes [m]: the centre of mass, of the body or of the
    /// compound that it is part of.
    center: Vector3,
    /// From the shape's axes to those that move, where they are others.
    turn: Option<Quaternion>,
}

#[derive(Debug, Clone, Copy)]
enum Kind<'a> {
    /// The body stays where it is.
    Resting { position: Vector3, orientation: Quaternion },
    /// The body is moved with constant velocities.
    Uniform(Motion),
    /// Polynomials of position, from `at`, and of the quaternion, from `at + 6`, which stands for the shape's axes
    /// after `turn`; `offset` from the piece's start [s].
    Polynomial { segment: &'a Segment, coefficients: &'a [f64], at: usize, turn: Quaternion, offset: f64 },
    /// The same with a rotation matrix, of whose turning nothing is proved.
    Matrix {
        segment: &'a Segment,
        coefficients: &'a [f64],
        at: usize,
        chart: &'a Chart,
        motion: &'a BodyMotion,
        offset: f64,
    },
    /// A closed form of this number among the group's; `offset` from its beginning [s].
    Closed { motion: &'a ClosedMotion, member: usize, offset: f64 },
}

impl<'a> Path<'a> {
    /// A body that rests.
    pub(super) fn resting(motion: &BodyMotion, center: Vector3) -> Self {
        let kind = Kind::Resting { position: motion.position, orientation: motion.orientation };
        Self { kind, center, turn: None }
    }

    /// A body that is moved.
    pub(super) fn uniform(motion: Motion) -> Self {
        Self { kind: Kind::Uniform(motion), center: motion.center, turn: None }
    }

    /// Member `member` of a group with these charts, from `offset` [s] after the start of a piece.
    pub(super) fn new(
        segment: &'a Segment,
        charts: &'a [Chart],
        motions: &'a [BodyMotion],
        member: usize,
        offset: f64,
        center: Vector3,
    ) -> Self {
        if let Chart::Riding(Riding { pose }) = &charts[member] {
            let center = center - pose.inverse_vector(&pose.position);
            return Self { turn: Some(pose.orientation), ..Self::new(segment, charts, motions, 0, offset, center) };
        }
        if matches!(charts[member], Chart::Fixed) || segment.dimension == 0 {
            return Self::resting(&motions[member], center);
        }
        let kind = match &segment.curve {
            Curve::Polynomial(coefficients) => {
                let at = charts[..member].iter().map(Chart::dimension).sum();
                let chart = &charts[member];
                let spin = chart.spin_part(at).map(|(_, spin)| spin);
                if spin.is_some_and(|spin| spin.form() == Form::WorldMatrix) {
                    Kind::Matrix { segment, coefficients, at, chart, motion: &motions[member], offset }
                } else {
                    let turn = spin.and_then(Spin::axes).map_or_else(Quaternion::identity, |axes| axes.conjugate());
                    Kind::Polynomial { segment, coefficients, at, turn, offset }
                }
            }
            Curve::Closed(motion, lead) => Kind::Closed { motion, member, offset: lead + offset },
        };
        Self { kind, center, turn: None }
    }

    fn instant(&self, center: Vector3, q: &Quaternion, velocity: Vector3, angular_velocity: Vector3) -> Instant {
        let orientation = quaternion::normalized(&self.turn.map_or(*q, |turn| q * turn));
        let position = center - quaternion::rotate(&orientation, &self.center);
        Instant { pose: Pose { position, orientation }, center, velocity, angular_velocity }
    }
}

/// Derivatives of order 0 to 3 of `N` polynomials at `s`, per unit of s.
fn derivatives<const N: usize>(c: &[f64], n: usize, at: usize, s: f64) -> [[f64; N]; 4] {
    let mut d = [[0.0; N]; 4];
    for term in c.chunks_exact(n).rev() {
        for i in 0..N {
            // Horner's scheme for a value and its derivatives, which are d[j]/j!
            d[3][i] = d[3][i] * s + d[2][i];
            d[2][i] = d[2][i] * s + d[1][i];
            d[1][i] = d[1][i] * s + d[0][i];
            d[0][i] = d[0][i] * s + term[at + i];
        }
    }
    let [value, first, second, third] = d;
    [value, first, second.map(|x| 2.0 * x), third.map(|x| 6.0 * x)]
}

/// Bound of the derivative of this order of `N` polynomials for |s| ≤ `s_max`.
fn bound<const N: usize>(c: &[f64], n: usize, at: usize, order: usize, s_max: f64) -> f64 {
    let mut sum = 0.0;
    let mut power = 1.0;
    for (k, term) in c.chunks_exact(n).enumerate().skip(order) {
        let falling = ((k + 1 - order)..=k).fold(1.0, |product, j| product * j as f64);
        let size = (0..N).map(|i| term[at + i] * term[at + i]).sum::<f64>().sqrt();
        sum += falling * size * power;
        power *= s_max;
    }
    sum
}

impl Moving for Path<'_> {
    fn center(&self) -> Vector3 {
        self.center
    }

    fn at(&self, t: f64) -> Instant {
        match self.kind {
            Kind::Resting { position, orientation } => {
                self.instant(position, &orientation, Vector3::zeros(), Vector3::zeros())
            }
            Kind::Uniform(motion) => motion.at(t),
            Kind::Matrix { segment, at, chart, motion, offset, .. } => {
                let mut motion = *motion;
                let mut y = vec![0.0; segment.dimension];
                segment.at_offset(offset + t, &mut y);
                chart.decode(&y[at..at + chart.dimension()], &mut motion);
                self.instant(motion.position, &motion.orientation, motion.velocity, motion.angular_velocity)
            }
            Kind::Polynomial { segment, coefficients, at, turn, offset } => {
                let (n, h) = (segment.dimension, segment.length);
                let s = (offset + t) / h;
                let [x, dx, ..] = derivatives::<3>(coefficients, n, at, s);
                let [q, dq, ..] = derivatives::<4>(coefficients, n, at + 6, s);
                let [q, dq] = [q, dq].map(quaternion::from_scalar_first);
                let spin = 2.0 / (h * q.norm_squared()) * (dq * q.conjugate()).imag();
                self.instant(x.into(), &(q * turn), Vector3::from(dx) / h, spin)
            }
            Kind::Closed { motion, member, offset } => {
                let (position, velocity, q, spin) = motion.free_motion(member, offset + t);
                self.instant(position, &q, velocity, spin)
            }
        }
    }

    fn bounds(&self, from: f64, to: f64) -> MotionBounds {
        match self.kind {
            Kind::Resting { .. } => MotionBounds::uniform(0.0),
            Kind::Uniform(motion) => motion.bounds(from, to),
            Kind::Matrix { segment, coefficients: c, at, offset, .. }
            | Kind::Polynomial { segment, coefficients: c, at, offset, .. } => {
                let (n, h) = (segment.dimension, segment.length);
                let (a, b) = ((offset + from) / h, (offset + to) / h);
                let (middle, half, s_max) = (0.5 * (a + b), 0.5 * (b - a), a.abs().max(b.abs()));
                let [_, _, ddx, _] = derivatives::<3>(c, n, at, middle);
                let acceleration = Vector3::from(ddx) / (h * h);
                let deviation = half * bound::<3>(c, n, at, 3, s_max) / (h * h);

                let unknown = MotionBounds {
                    acceleration,
                    deviation,
                    angular_speed: f64::INFINITY,
                    angular_acceleration: f64::INFINITY,
                };
                if matches!(self.kind, Kind::Matrix { .. }) {
                    return unknown;
                }

                // q′, q″ by their values in the middle and what they may stray from them
                let [q, dq, ddq, _] = derivatives::<4>(c, n, at + 6, middle).map(quaternion::from_scalar_first);
                let third = bound::<4>(c, n, at + 6, 3, s_max);
                let second = (ddq.norm() + half * third).min(bound::<4>(c, n, at + 6, 2, s_max));
                let first = dq.norm() + half * second;
                let (least, most) = (q.norm() - half * first, q.norm() + half * first);
                if least <= 0.0 {
                    return unknown;
                }
                let least2 = least * least;

                // ω = 2 Im(q′ q̄)/|q|²;  ω′ = 2 Im(q″ q̄)/|q|² − ω 2 (q·q′)/|q|²
                let spin = (dq * q.conjugate()).imag().norm() + half * second * most;
                let angular_speed = 2.0 * spin.min(first * most) / (h * least2);
                let bend = (ddq * q.conjugate()).imag().norm() + half * (third * most + second * first);
                let radial = q.coords.dot(&dq.coords).abs() + half * (first * first + most * second);
                let angular_acceleration = 2.0 * (bend / h + angular_speed * radial) / (h * least2);
                MotionBounds { acceleration, deviation, angular_speed, angular_acceleration }
            }
            Kind::Closed { motion, member, offset } => {
                let FreeBounds { acceleration, deviation, angular_speed, angular_acceleration } =
                    motion.free_bounds(member, offset + from, offset + to);
                MotionBounds { acceleration, deviation, angular_speed, angular_acceleration }
            }
        }
    }
}
