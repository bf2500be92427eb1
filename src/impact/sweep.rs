//! Spinning bodies from afar: a look at what they sweep may prove many turns free at once, without a query.
//!
//! ```text
//! swept     A and B stay within solids of revolution about their own axes, and these move along Δ
//! circled   seen from A, which spins, B goes around A's axis: within a solid of revolution about that axis
//! ```
//!
//! The first serves while the solids are apart. A rod that spins askew sweeps a waisted solid, and what is inside
//! one of its funnels is inside the hull of either half, but not of what goes around: there the second serves,
//! along a direction that turns with A. The body that spins slower stands as it is in place of what it sweeps, and
//! its turning enters with the bound of [`Side::part`] or with its speed.

use super::guaranteed::{NEARLY, Parting, ROUNDS, Search, Stand, TRIALS, crossing};
use super::side::{SWEEPS, Side};
use super::swept::{Swept, parting};
use crate::math::Vector3;

/// When and how to look ahead by what the bodies sweep.
pub(super) struct Sweeps {
    /// Not before this time [s].
    after: f64,
    /// The direction that parted each pair of halves last.
    directions: [Option<Vector3>; 4],
    /// The direction that parted a spinning body from what goes around it.
    circled: Option<Vector3>,
}

impl Sweeps {
    pub(super) fn new(search: &Search<'_>, from: f64, to: f64) -> Self {
        let is_polyhedron = |side: &Side<'_>| side.piece.edge(0).is_some();
        let is_steady = |side: &Side<'_>| {
            let bounds = side.motion.bounds(from, to);
            bounds.angular_acceleration == 0.0 && (to - from) * bounds.angular_speed >= TURN
        };
        let may_sweep =
            is_polyhedron(&search.a) && is_polyhedron(&search.b) && (is_steady(&search.a) || is_steady(&search.b));
        let after = if may_sweep { from } else { f64::INFINITY };
        Self { after, directions: [None; 4], circled: None }
    }
}

impl Search<'_> {
    /// The time up to which what the bodies sweep from `t` on is apart, `to` at most [s].
    pub(super) fn sweep(&mut self, sweeps: &mut Sweeps, t: f64, to: f64, eps: f64) -> f64 {
        let mut t = t;
        for _ in 0..ROUNDS {
            if t < sweeps.after || !(self.a.has_corners() && self.b.has_corners()) {
                break;
            }
            let stand = self.stand(t);
            let [w_a, w_b] = [&stand.a, &stand.b].map(|placed| placed.instant.angular_velocity.norm());
            let fastest = w_a.max(w_b);
            if fastest * (to - t) < TURN {
                sweeps.after = f64::INFINITY;
                break;
            }

            // the slower body stands where it is, unless it is nearly as fast
            let swept = [w_a, w_b].map(|w| w >= ALSO * fastest);
            let changes = |side: &Side<'_>| side.motion.bounds(t, to).angular_acceleration != 0.0;
            if swept[0] && changes(&self.a) || swept[1] && changes(&self.b) {
                break;
            }
            let level = 0.5 * eps.max(self.rounding(&stand));
            let mut step = self.swept_step(sweeps, &stand, swept, level, to - t);
            if step * fastest < SWEEPS && step < to - t && swept != [true; 2] {
                step = step.max(self.circled_step(sweeps, &stand, level, to - t));
            }
            self.sweeps += 1;
            if step >= to - t {
                return to;
            }
            t += step;
            if step == 0.0 || step * fastest < SWEEPS {
                sweeps.after = t + PAUSE / fastest;
                break;
            }
        }
        t
    }

    fn swept_step(&mut self, sweeps: &mut Sweeps, stand: &Stand, swept: [bool; 2], level: f64, left: f64) -> f64 {
        let mut halves = [[None; 2]; 2];
        let sides = [(&mut self.a, &stand.a, swept[0]), (&mut self.b, &stand.b, swept[1])];
        for ((side, placed, swept), halves) in sides.into_iter().zip(&mut halves) {
            *halves = match if swept { side.swept(placed) } else { None } {
                Some(swept) => [0, 1].map(|half| swept.has(half).then_some(Some(half))),
                None => [Some(None), None],
            };
        }

        // every half is to stay apart from every half, by more than an approach takes for a rad
        let fastest = stand.a.instant.angular_velocity.norm().max(stand.b.instant.angular_velocity.norm());
        let least = stand.approach.norm() / fastest;
        let mut step = left;
        for (i, half_a) in halves[0].into_iter().enumerate().filter_map(|(i, half)| Some((i, half?))) {
            for (j, half_b) in halves[1].into_iter().enumerate().filter_map(|(j, half)| Some((j, half?))) {
                let direction = &mut sweeps.directions[2 * i + j];
                let way = self.parted_step(direction, stand, [half_a, half_b], [least, level], left);
                if way <= 0.0 {
                    return 0.0;
                }
                step = step.min(way);
            }
        }
        step
    }

    /// How long the body that spins faster stays apart from all that the other passes when, seen from it, it goes
    /// around [s]: a direction that turns with the spinning body, for many turns of it.
    fn circled_step(&mut self, sweeps: &mut Sweeps, stand: &Stand, level: f64, left: f64) -> f64 {
        let (w_a, w_b) = (stand.a.instant.angular_velocity, stand.b.instant.angular_velocity);
        let is_a = w_a.norm_squared() >= w_b.norm_squared();
        let (side, placed, w, sign) = if is_a { (&self.a, &stand.a, w_a, 1.0) } else { (&self.b, &stand.b, w_b, -1.0) };
        let (other, other_placed) = if is_a { (&self.b, &stand.b) } else { (&self.a, &stand.a) };
        let (between, approach) = (sign * stand.between, sign * stand.approach);
        let axis = w / w.norm();
        let corners = other.corners.iter().flatten().map(|v| between + other_placed.rotation * v);
        let circled = Swept::around(axis, corners);

        // the direction is kept as it was seen from the axis
        let first = sweeps.circled.unwrap_or_else(|| {
            let length = between.norm();
            if length > 0.0 { between / length } else { axis }
        });
        let mut lowest = |n: &Vector3| circled.farthest(0, &-n) - side.farthest(placed, None, n);
        let least = approach.norm() / w.norm();
        let found = parting(&first, least, &mut lowest);
        sweeps.circled = found;
        let Some(n) = found else { return 0.0 };

        // whatever its phase, the other comes nearer no faster than this
        let rounding = side.piece.rounding() + other.piece.rounding();
        let separation = -circled.height_of(0, &-n) - n.dot(&side.farthest(placed, None, &n)) - rounding;
        let along = n.dot(&axis);
        let from_axis = |v: &Vector3| v.cross(&axis).norm();
        let [bounds, other_bounds] = [side, other].map(|side| side.motion.bounds(stand.time, stand.time + left));
        let rate = along * approach.dot(&axis)
            - from_axis(&n) * from_axis(&approach)
            - other_bounds.angular_speed * other.radius;
        let bend = (other_bounds.acceleration - bounds.acceleration).norm() + bounds.deviation + other_bounds.deviation;
        crossing(separation - stand.error - level, rate, bend).min(left)
    }

    /// How long a half of what is swept, or a body where it stands, stays apart from another [s].
    fn parted_step(
        &mut self,
        direction: &mut Option<Vector3>,
        stand: &Stand,
        halves: [Option<usize>; 2],
        [least, level]: [f64; 2],
        left: f64,
    ) -> f64 {
        let (a, b) = (&self.a, &self.b);
        let first = direction.unwrap_or_else(|| {
            let length = stand.between.norm();
            if length > 0.0 { stand.between / length } else { Vector3::x() }
        });
        let found = parting(&first, least, &mut |n| {
            stand.between + b.farthest(&stand.b, halves[1], &-n) - a.farthest(&stand.a, halves[0], n)
        });
        let Some(n) = found else { return 0.0 };
        *direction = found;
        let heights = [self.a.height_of(&stand.a, halves[0], &n), self.b.height_of(&stand.b, halves[1], &-n)];
        let parting = Parting { normal: n, heights, swept: halves.map(|half| half.is_some()) };

        let (mut best, mut h) = (0.0_f64, left);
        for _ in 0..TRIALS {
            let proved = self.proved(stand, &parting, &Vector3::zeros(), level, h);
            best = best.max(proved);
            if proved >= NEARLY * h {
                break;
            }
            h = (2.0 * proved).max(h / 16.0);
        }
        best
    }
}

/// Angle left to turn from which on what is swept is looked at first [rad].
const TURN: f64 = std::f64::consts::PI;
/// A body is taken for all that it sweeps where it spins with this part of the faster one's rate [-].
const ALSO: f64 = 0.25;
/// Angle for which sweeps are not tried again after one that led nowhere [rad].
const PAUSE: f64 = std::f64::consts::PI;
