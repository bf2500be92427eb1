//! The motion of one body within one step of its flight, with proven bounds: what the search for impacts
//! looks at.
//!
//! ```text
//! polynomial   x(s), q(s):  v = x′, ω = 2 Im(q′ q̄)/|q|²     bounds from the derivatives' coefficients
//! in a plane   x₀ + u(s) e₁ + w(s) e₂,  exp(θ(s) n) q₀:  ω = θ′ n            the same
//! closed form  x″ = g − k (v − wind),  ω = I⁻¹ L              bounds from E, L and Euler's equations
//! at rest      nothing moves
//! ```
//!
//! A polynomial's derivative of order j is bounded about the middle of an interval, `|y⁽ʲ⁾(s) − y⁽ʲ⁾(m)| ≤
//! ½ w Σ |c_k| k!/(k−j−1)! s_max^(k−j−1)`, w being the interval's width: proved, and tight where the
//! interval is short. What turns about a point or an axle is looked at from there: the point rests.

use crate::freedom::{Chart, Place, Riding, Turning};
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
    /// compound that it is part of, or a point of the body that rests.
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
    /// Polynomials of a time, which is 1 at `length` [s], from `offset` [s] on: `n` of them, of which some tell the
    /// place and others the turning.
    Polynomial { coefficients: &'a [f64], n: usize, length: f64, place: Place, turning: Turning, offset: f64 },
    /// The same with a rotation matrix, of whose turning nothing is proved.
    Matrix {
        segment: &'a Segment,
        coefficients: &'a [f64],
        place: Place,
        at: usize,
        chart: &'a Chart,
        motion: &'a BodyMotion,
        offset: f64,
    },
    /// A closed form of this number among the group's; `offset` from its beginning [s]. `place` tells of a body that
    /// turns about a point where this is.
    Closed { motion: &'a ClosedMotion, member: usize, place: Place, offset: f64 },
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
        let (chart, motion) = (&charts[member], &motions[member]);
        let at = charts[..member].iter().map(Chart::dimension).sum();
        let Some(place) = chart.place(at).filter(|_| segment.dimension > 0) else {
            return Self::resting(motion, center);
        };
        let kind = match &segment.curve {
            Curve::Polynomial(coefficients) => match chart.turning(at) {
                Some(turning) => {
                    let (n, length) = (segment.dimension, segment.length);
                    Kind::Polynomial { coefficients, n, length, place, turning, offset }
                }
                None => Kind::Matrix { segment, coefficients, place, at, chart, motion, offset },
            },
            Curve::Closed(motion, lead) => {
                let offset = lead + offset;
                match (motion.line(member), chart.place(0), chart.turning(0)) {
                    (Some(coefficients), Some(place), Some(turning)) => {
                        let (n, length) = (chart.dimension(), 1.0);
                        Kind::Polynomial { coefficients, n, length, place, turning, offset }
                    }
                    _ => Kind::Closed { motion, member, place, offset },
                }
            }
        };
        Self { kind, center: center + chart.point_body(), turn: None }
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
            Kind::Matrix { segment, place, at, chart, motion, offset, .. } => {
                let mut motion = *motion;
                let mut y = vec![0.0; segment.dimension];
                segment.at_offset(offset + t, &mut y);
                chart.decode(&y[at..at + chart.dimension()], &mut motion);
                let (center, velocity) = match place {
                    Place::Rests(point) => (point, Vector3::zeros()),
                    Place::Numbers(_) | Place::Plane { .. } => (motion.position, motion.velocity),
                };
                self.instant(center, &motion.orientation, velocity, motion.angular_velocity)
            }
            Kind::Polynomial { coefficients: c, n, length: h, place, turning, offset } => {
                let s = (offset + t) / h;
                let (center, velocity) = match place {
                    Place::Numbers(at) => {
                        let [x, dx, ..] = derivatives::<3>(c, n, at, s);
                        (x.into(), Vector3::from(dx) / h)
                    }
                    Place::Plane { at, start, axes: [e1, e2] } => {
                        let [x, dx, ..] = derivatives::<2>(c, n, at, s);
                        (start + x[0] * e1 + x[1] * e2, (dx[0] * e1 + dx[1] * e2) / h)
                    }
                    Place::Rests(point) => (point, Vector3::zeros()),
                };
                match turning {
                    Turning::Quaternion { at, axes } => {
                        let [q, dq, ..] = derivatives::<4>(c, n, at, s);
                        let [q, dq] = [q, dq].map(quaternion::from_scalar_first);
                        let spin = 2.0 / (h * q.norm_squared()) * (dq * q.conjugate()).imag();
                        self.instant(center, &(q * axes), velocity, spin)
                    }
                    Turning::Angle { at, axis, start } => {
                        let [angle, rate, ..] = derivatives::<1>(c, n, at, s);
                        let q = quaternion::from_axis_angle(&axis, angle[0]) * start;
                        self.instant(center, &q, velocity, rate[0] / h * axis)
                    }
                }
            }
            Kind::Closed { motion, member, place, offset } => {
                let (position, velocity, q, spin) = motion.free_motion(member, offset + t);
                let center = if let Place::Rests(point) = place { point } else { position };
                self.instant(center, &q, velocity, spin)
            }
        }
    }

    fn bounds(&self, from: f64, to: f64) -> MotionBounds {
        match self.kind {
            Kind::Resting { .. } => MotionBounds::uniform(0.0),
            Kind::Uniform(motion) => motion.bounds(from, to),
            Kind::Matrix { segment, coefficients, place, offset, .. } => {
                let piece = Piece::new((coefficients, segment.dimension, segment.length), offset + from, offset + to);
                let (acceleration, deviation) = piece.acceleration(place);
                let [angular_speed, angular_acceleration] = [f64::INFINITY; 2];
                MotionBounds { acceleration, deviation, angular_speed, angular_acceleration }
            }
            Kind::Polynomial { coefficients, n, length, place, turning, offset } => {
                let piece = Piece::new((coefficients, n, length), offset + from, offset + to);
                let (acceleration, deviation) = piece.acceleration(place);
                let [angular_speed, angular_acceleration] = piece.turning(turning);
                MotionBounds { acceleration, deviation, angular_speed, angular_acceleration }
            }
            Kind::Closed { motion, member, offset, .. } => {
                let FreeBounds { acceleration, deviation, angular_speed, angular_acceleration } =
                    motion.free_bounds(member, offset + from, offset + to);
                MotionBounds { acceleration, deviation, angular_speed, angular_acceleration }
            }
        }
    }
}

/// Polynomials over an interval, about whose middle they are bounded.
struct Piece<'a> {
    coefficients: &'a [f64],
    /// How many polynomials.
    n: usize,
    /// The time that is 1 to them [s].
    h: f64,
    /// Middle and half width of the interval, and the end that is farther from 0, per `h`.
    middle: f64,
    half: f64,
    s_max: f64,
}

impl<'a> Piece<'a> {
    /// Over `from..=to` [s].
    fn new((coefficients, n, h): (&'a [f64], usize, f64), from: f64, to: f64) -> Self {
        let (a, b) = (from / h, to / h);
        let (middle, half, s_max) = (0.5 * (a + b), 0.5 * (b - a), a.abs().max(b.abs()));
        Self { coefficients, n, h, middle, half, s_max }
    }

    fn derivatives<const N: usize>(&self, at: usize) -> [[f64; N]; 4] {
        derivatives::<N>(self.coefficients, self.n, at, self.middle)
    }

    fn bound<const N: usize>(&self, at: usize, order: usize) -> f64 {
        bound::<N>(self.coefficients, self.n, at, order, self.s_max)
    }

    /// The acceleration of the point that moves, and what it may stray from there [m/s²].
    fn acceleration(&self, place: Place) -> (Vector3, f64) {
        let (h, half) = (self.h, self.half);
        match place {
            Place::Numbers(at) => {
                let [_, _, ddx, _] = self.derivatives::<3>(at);
                (Vector3::from(ddx) / (h * h), half * self.bound::<3>(at, 3) / (h * h))
            }
            Place::Plane { at, axes: [e1, e2], .. } => {
                let [_, _, ddx, _] = self.derivatives::<2>(at);
                ((ddx[0] * e1 + ddx[1] * e2) / (h * h), half * self.bound::<2>(at, 3) / (h * h))
            }
            Place::Rests(_) => (Vector3::zeros(), 0.0),
        }
    }

    /// Bounds of the angular speed [rad/s] and acceleration [rad/s²].
    fn turning(&self, turning: Turning) -> [f64; 2] {
        let (h, half) = (self.h, self.half);
        let at = match turning {
            Turning::Quaternion { at, .. } => at,
            Turning::Angle { at, .. } => {
                let [_, rate, bend, _] = self.derivatives::<1>(at);
                let bend = (bend[0].abs() + half * self.bound::<1>(at, 3)).min(self.bound::<1>(at, 2));
                return [(rate[0].abs() + half * bend) / h, bend / (h * h)];
            }
        };

        // q′, q″ by their values in the middle and what they may stray from them
        let [q, dq, ddq, _] = self.derivatives::<4>(at).map(quaternion::from_scalar_first);
        let third = self.bound::<4>(at, 3);
        let second = (ddq.norm() + half * third).min(self.bound::<4>(at, 2));
        let first = dq.norm() + half * second;
        let (least, most) = (q.norm() - half * first, q.norm() + half * first);
        if least <= 0.0 {
            return [f64::INFINITY; 2];
        }
        let least2 = least * least;

        // ω = 2 Im(q′ q̄)/|q|²;  ω′ = 2 Im(q″ q̄)/|q|² − ω 2 (q·q′)/|q|²
        let spin = (dq * q.conjugate()).imag().norm() + half * second * most;
        let angular_speed = 2.0 * spin.min(first * most) / (h * least2);
        let bend = (ddq * q.conjugate()).imag().norm() + half * (third * most + second * first);
        let radial = q.coords.dot(&dq.coords).abs() + half * (first * first + most * second);
        [angular_speed, 2.0 * (bend / h + angular_speed * radial) / (h * least2)]
    }
}
