//! The guaranteed search: conservative advancement with a bound of second order.
//!
//! Along any unit direction n(t) the separation of the bodies is a lower bound of their signed distance,
//!
//! ```text
//! s(t) = min n·b − max n·a = n·Δ(t) − h_A(n) − h_B(−n)         Δ = c_B − c_A,  h the support from c
//! ```
//!
//! so from the closest features at t, whose normal n makes `s` the signed distance itself, the search looks
//! ahead: let n turn with a constant angular velocity Ω, and let every pair of vertices go on along its
//! tangent. The least of the tangents is concave in time, so it lies above the chord between its values
//! at 0 and h, and a bound K of all second derivatives gives
//!
//! ```text
//! s(t + τ) ≥ (1 − τ/h) s(t) + (τ/h) L(h) − ½ K τ²        0 ≤ τ ≤ h
//! L(h)     = (n + h Ω×n)·Δ + h n·Δ′ − h_A(n + h n×(ω_A − Ω)) − h_B(−n − h n×(ω_B − Ω))
//! ```
//!
//! L(h) costs two supports. The time up to which the right side stays above ½ ε is proved free, and the
//! search goes there. Close to contact the chord is the secant through the gap now and the gap to be, and
//! what it leaves is of second order: digits double in every round. Ω decides how good the tangent is:
//!
//! | closest features | Ω | because |
//! |---|---|---|
//! | a face | ω of its body | the face's plane separates, and turns with the body |
//! | edge, edge | such that n stays perpendicular to both | so does the common normal |
//! | edge, vertex | such that n stays perpendicular to the edge | |
//! | a side of a capsule, a cylinder, a cone | as an edge | it is straight along its ruling |
//! | any | 0 | far away, where n hardly matters |
//!
//! From there the search leaps on, where that can be proved from its far end backwards, with the same bound and
//! time reversed: to where the two features meet if they stay the closest, which is found on their poses alone
//! and is the impact then, or half as far again as the step. No query is made before the proof stands.
//!
//! For Ω = 0 a body's part of the bound may also be the plain one of Mirtich (1996), `τ |ω × n| r`, or
//! for fast spins the support of all that it sweeps: of a steady spin the solid of revolution, else the
//! ball of its radius. Whatever is least counts. Bodies that spin fast are looked at by `sweep` first.
//!
//! **What is proved.** `s` is proved positive on the whole way, so nothing is missed and nothing is late,
//! up to the rounding of poses and supports, which `ε` is kept above. Rotation is bounded by `r`, the
//! largest distance from the moving point.

use super::motion::Moving;
use super::side::{Part, Placed, Side};
use super::sweep::Sweeps;
use super::{Found, Outcome};
use crate::closest::{Accuracy, ClosestFeatures, Feature, PairCache, Piece};
use crate::error::Result;
use crate::math::Vector3;

/// The pair at an instant.
pub(super) struct Stand {
    pub(super) time: f64,
    pub(super) a: Placed,
    pub(super) b: Placed,
    /// From the moving point of A to that of B [m], and its rate [m/s].
    pub(super) between: Vector3,
    pub(super) approach: Vector3,
    /// Rounding of a separation [m].
    pub(super) error: f64,
    /// Largest speed of a point of one body as seen from the other [m/s].
    speed: f64,
    /// Whether time runs backwards: all velocities have the other sign.
    is_reversed: bool,
}

impl Stand {
    /// The same with time running the other way.
    fn reverse(&mut self) {
        self.is_reversed = !self.is_reversed;
        self.approach = -self.approach;
        for instant in [&mut self.a.instant, &mut self.b.instant] {
            (instant.velocity, instant.angular_velocity) = (-instant.velocity, -instant.angular_velocity);
        }
    }
}

/// A direction from A to B, and what it parts.
pub(super) struct Parting {
    pub(super) normal: Vector3,
    /// Supports of both along it [m].
    pub(super) heights: [f64; 2],
    /// Whether these are of all that is swept.
    pub(super) swept: [bool; 2],
}

/// The closest features at an instant, and what the bounds are worked out from.
struct Look {
    stand: Stand,
    closest: ClosestFeatures,
    parting: Parting,
    /// How fast the closest points approach along the normal [m/s].
    closing: f64,
}

impl Look {
    fn features(&self) -> (Feature, Feature) {
        (self.closest.feature_a, self.closest.feature_b)
    }
}

/// The closest features of a look as they are at another time.
struct Carried {
    stand: Stand,
    parting: Parting,
    /// Separation of the two features [m], and of the bodies along the same direction [m], an error less.
    gap: f64,
    separation: f64,
}

/// What the search is about.
#[derive(Clone, Copy)]
enum Phase {
    /// The gap was above ε: it must not fall below ½ ε unseen.
    Free,
    /// The gap is within ε from the start and must not fall below this [m].
    Leaving(f64),
    /// The gap came within ε at this time [s] with next to no speed: does it open again?
    Grazing(f64),
}

/// A search for the first impact of two bodies.
pub(super) struct Search<'a> {
    pub(super) a: Side<'a>,
    pub(super) b: Side<'a>,
    cache: &'a mut PairCache,
    queries: u32,
    /// How often what is swept was looked at.
    pub(super) sweeps: u32,
    /// Where the search began [s], and how far from the origin the moving points were then, together [m].
    from: f64,
    start: f64,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        a: (Piece<'a>, &'a dyn Moving),
        b: (Piece<'a>, &'a dyn Moving),
        cache: &'a mut PairCache,
    ) -> Self {
        Self { a: Side::new(a.0, a.1), b: Side::new(b.0, b.1), cache, queries: 0, sweeps: 0, from: 0.0, start: 0.0 }
    }

    /// Searches `from..=to` [s] for the first gap in (0, `eps`] [m].
    pub(super) fn run(&mut self, from: f64, to: f64, eps: f64) -> Result<Found> {
        let stand = self.stand(from);
        self.from = from;
        self.start = stand.a.instant.center.norm() + stand.b.instant.center.norm();
        let mut sweeps = Sweeps::new(self, from, to);
        let begin = self.sweep(&mut sweeps, from, to, eps);
        if begin >= to {
            return Ok(self.found(Outcome::Clear, to, 0));
        }
        let stand = if begin > from { self.stand(begin) } else { stand };
        let mut look = self.look_at(stand)?;
        let mut eps_here = eps.max(self.rounding(&look.stand));
        let gap = look.closest.signed_distance;
        let mut phase = if gap > eps_here || begin > from {
            Phase::Free
        } else if gap < -eps_here {
            return Ok(self.found(Outcome::Overlap, from, 0));
        } else {
            // it may sink by what rounding hides, else not even the opening of the gap could be proved
            Phase::Leaving((0.5 * look.closest.lower).min(gap - LEAST_SINK * look.stand.error))
        };
        let mut stays = 0;

        for round in 0..ROUNDS {
            let gap = look.closest.signed_distance;
            let t = look.stand.time;
            match phase {
                Phase::Free if gap <= eps_here => {
                    if look.closest.lower <= 0.0 {
                        return Ok(self.found(Outcome::Stalled, t, round));
                    }
                    // what comes with speed is an impact; what hardly moves may be about to leave
                    let ahead = self.advance(&look, -eps_here, to - t, f64::INFINITY, TRIALS);
                    if !self.is_still(&look, ahead, to - t, SLOW * eps_here) {
                        return Ok(self.found(Outcome::At, t, round));
                    }
                    (phase, stays) = (Phase::Grazing(t), 0);
                }
                Phase::Leaving(_) if gap > eps_here => phase = Phase::Free,
                Phase::Grazing(since) if gap > eps_here => {
                    return Ok(Found { until: t, ..self.found(Outcome::Grazing, since, round) });
                }
                _ => {}
            }

            // as far as it is proved
            let level = match phase {
                Phase::Free => 0.5 * eps_here,
                Phase::Leaving(floor) => floor,
                Phase::Grazing(_) => -eps_here,
            };
            let (first, trials) = match phase {
                Phase::Free => (self.falls(&look), TRIALS),
                _ => (f64::INFINITY, TRIALS_WITHIN),
            };
            let step = self.advance(&look, level, to - t, first, trials);
            if !matches!(phase, Phase::Free) {
                stays += 1;
            }
            match phase {
                Phase::Leaving(_) if stays > STAYS || !self.is_still(&look, step, to - t, LEAST_STAY * eps_here) => {
                    let outcome =
                        if t > from && look.closest.lower > 0.0 { Outcome::At } else { Outcome::AlreadyTouching };
                    return Ok(self.found(outcome, t, round));
                }
                Phase::Grazing(since)
                    if stays > STAYS || !self.is_still(&look, step, to - t, LEAST_STAY * eps_here) =>
                {
                    return Ok(self.found(Outcome::At, since, round));
                }
                _ => {}
            }
            if step >= to - t {
                let outcome = if let Phase::Grazing(since) = phase {
                    return Ok(Found { until: to, ..self.found(Outcome::Grazing, since, round) });
                } else {
                    Outcome::Clear
                };
                return Ok(self.found(outcome, to, round));
            }
            // a leap over a small bounce would land where it began: half of it shows whether the gap opens
            let next = if matches!(phase, Phase::Leaving(_)) { t + 0.5 * step } else { t + step };
            if next <= t {
                return Ok(self.found(Outcome::Stalled, t, round));
            }
            let stand = if !matches!(phase, Phase::Free) {
                self.stand(next)
            } else if let Some(stand) = self.leap(&look, step, to - t, eps_here) {
                stand
            } else {
                let next = self.sweep(&mut sweeps, next, to, eps);
                self.stand(next)
            };
            if matches!(phase, Phase::Free) && stand.time >= to {
                return Ok(self.found(Outcome::Clear, to, round + 1));
            }
            look = self.look_at(stand)?;
            eps_here = eps.max(self.rounding(&look.stand));
        }
        Ok(self.found(Outcome::Stalled, look.stand.time, ROUNDS))
    }

    fn found(&self, outcome: Outcome, time: f64, rounds: u32) -> Found {
        Found { outcome, time, until: time, iterations: rounds + self.sweeps, queries: self.queries }
    }

    /// The pair at `t`.
    pub(super) fn stand(&self, t: f64) -> Stand {
        let (a, b) = (self.a.at(t), self.b.at(t));
        let between = b.instant.center - a.instant.center;
        let approach = b.instant.velocity - a.instant.velocity;
        let speed = approach.norm()
            + a.instant.angular_velocity.norm() * self.a.radius
            + b.instant.angular_velocity.norm() * self.b.radius;
        let error = SUPPORT_UNITS * f64::EPSILON * (between.norm() + self.a.radius + self.b.radius);
        Stand { time: t, a, b, between, approach, error, speed, is_reversed: false }
    }

    /// The closest features where the pair stands, and what the bounds need.
    fn look_at(&mut self, stand: Stand) -> Result<Look> {
        let (a, b) = (&stand.a.instant, &stand.b.instant);
        let closest = self.a.piece.closest(&a.pose, &self.b.piece, &b.pose, self.cache, Accuracy::Exact)?;
        self.queries += 1;
        let normal = closest.normal;
        let heights = [self.a.height(&stand.a, &normal), self.b.height(&stand.b, &-normal)];
        let closing = normal.dot(&(a.velocity_at(&closest.point_a) - b.velocity_at(&closest.point_b)));
        Ok(Look { stand, closest, parting: Parting { normal, heights, swept: [false; 2] }, closing })
    }

    /// Gap below which rounding decides [m].
    pub(super) fn rounding(&self, stand: &Stand) -> f64 {
        let (a, b) = (&stand.a.instant, &stand.b.instant);
        let turned = (stand.time - self.from)
            * (a.angular_velocity.norm() * self.a.radius + b.angular_velocity.norm() * self.b.radius);
        let near = stand.between.norm() + self.a.radius + self.b.radius;
        let far = a.center.norm() + b.center.norm() + self.start;
        f64::EPSILON * (NEAR_UNITS * near + FAR_UNITS * (far + turned))
    }

    /// Whether a proved step is longer than what comes with speed, or is driven, would take for this way [m].
    fn is_still(&self, look: &Look, step: f64, left: f64, way: f64) -> bool {
        let t = look.stand.time;
        let [a, b] = [&self.a, &self.b].map(|side| side.motion.bounds(t, t + step));
        let drive = (b.acceleration - a.acceleration).norm() + a.deviation + b.deviation;
        step >= left || step * (look.stand.speed + step * drive) >= way
    }

    /// About how long what turning does to the gap takes to close it [s].
    fn falls(&self, look: &Look) -> f64 {
        let bend = |side: &Side<'_>, placed: &Placed| side.radius * placed.instant.angular_velocity.norm_squared();
        let bends = bend(&self.a, &look.stand.a) + bend(&self.b, &look.stand.b);
        AHEAD * (look.closest.signed_distance / bends).sqrt()
    }

    /// The longest time from a look on, at most `left` [s], in which the separation is proved to stay
    /// above `level` [m]; `first` is how far ahead is tried first [s].
    fn advance(&mut self, look: &Look, level: f64, left: f64, first: f64, trials: u32) -> f64 {
        // the proposal: where the line through the gap meets the level; no bound reaches beyond it
        let proposed = if look.closing > 0.0 { (look.closest.signed_distance - level) / look.closing } else { left };
        let proposed = if proposed < left { proposed.max(0.0) } else { left };

        let mut best = 0.0_f64;
        for turning in self.turnings(&look.stand, look.features(), &look.parting.normal).into_iter().flatten() {
            let mut h = if first > 0.0 && first < proposed { first } else { proposed };
            for _ in 0..trials {
                let proved = self.proved(&look.stand, &look.parting, &turning, level, h);
                best = best.max(proved);
                if proved >= h && h < proposed {
                    h = (4.0 * h).min(proposed);
                    continue;
                }
                if proved >= NEARLY * h {
                    break;
                }
                h = (2.0 * proved).max(h / 16.0);
            }
            if best >= NEARLY * proposed {
                break;
            }
        }
        best
    }

    /// A time beyond a proved `step`, `left` at most [s], up to which the way is free too: where the features of the
    /// look, carried along, meet the level, or as far again as the step. It is proved from there backwards.
    fn leap(&mut self, look: &Look, step: f64, left: f64, eps: f64) -> Option<Stand> {
        let level = 0.5 * eps;
        let way = look.closest.signed_distance - AIM * eps;
        let line = if look.closing > 0.0 { way / look.closing } else { f64::INFINITY };
        let far = line.min(LEAP * step).min(left);
        if far < LEAST_LEAP * step {
            return None;
        }
        let mut there = self.carried(look, far)?;

        // the features meet if they stay the closest
        if far == line && (there.gap - there.separation).abs() <= 2.0 * there.stand.error {
            there = self.carried_root(look, far, there, AIM * eps, 0.25 * eps, left)?;
        }
        if there.separation <= level || there.gap < 0.0 {
            return None;
        }

        // what the step leaves
        let rest = there.stand.time - look.stand.time - step;
        let n = there.parting.normal;
        there.stand.reverse();
        let turnings = self.turnings(&there.stand, look.features(), &n);
        let is_free = rest <= 0.0
            || turnings
                .into_iter()
                .flatten()
                .any(|turning| self.proved(&there.stand, &there.parting, &turning, level, rest) >= rest);
        there.stand.reverse();
        is_free.then_some(there.stand)
    }

    /// The features of a look at the time `ahead` after it [s]; none where they have no direction.
    fn carried(&mut self, look: &Look, ahead: f64) -> Option<Carried> {
        let (old, new) = (&look.stand, self.stand(look.stand.time + ahead));
        let turned_a = |v: &Vector3| new.a.rotation * old.a.rotation.tr_mul(v);
        let turned_b = |v: &Vector3| new.b.rotation * old.b.rotation.tr_mul(v);
        let (n, radii) = (&look.parting.normal, [self.a.piece.rounding(), self.b.piece.rounding()]);
        let p = turned_a(&(look.closest.point_a - radii[0] * n - old.a.instant.center));
        let q = turned_b(&(look.closest.point_b + radii[1] * n - old.b.instant.center));
        let between = new.between + q - p;

        let across = |e: &Vector3| between - (between.dot(e) / e.norm_squared()) * e;
        let normal = match look.features() {
            (Feature::Face(_), _) => turned_a(n),
            (_, Feature::Face(_)) => turned_b(n),
            (Feature::Edge(i), Feature::Edge(j)) => {
                let across_old = self.a.edge(&old.a, i).cross(&self.b.edge(&old.b, j));
                let across_new = self.a.edge(&new.a, i).cross(&self.b.edge(&new.b, j));
                across_new * across_old.dot(n).signum()
            }
            (Feature::Edge(i), Feature::Vertex(_)) => across(&self.a.edge(&new.a, i)),
            (Feature::Vertex(_), Feature::Edge(j)) => across(&self.b.edge(&new.b, j)),
            (Feature::Vertex(_), Feature::Vertex(_)) => between,
            _ => return None,
        };
        let length = normal.norm();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let normal = normal / length;
        let rounding = radii[0] + radii[1];
        let heights = [self.a.height(&new.a, &normal), self.b.height(&new.b, &-normal)];
        let separation = normal.dot(&new.between) - heights[0] - heights[1] - rounding - new.error;
        let gap = normal.dot(&between) - rounding;
        Some(Carried { stand: new, parting: Parting { normal, heights, swept: [false; 2] }, gap, separation })
    }

    /// The features of a look where their gap is `aim`, but for `off` [m], by the secant; `first` is a guess.
    fn carried_root(
        &mut self,
        look: &Look,
        guess: f64,
        first: Carried,
        aim: f64,
        off: f64,
        left: f64,
    ) -> Option<Carried> {
        let (mut last, mut time, mut there) = ((0.0, look.closest.signed_distance), guess, first);

        // the first correction knows the rate at the look
        let (way, closing) = (last.1 - aim, look.closing);
        let bend = (there.gap - last.1 + closing * time) / (time * time);
        let root = closing * closing - 4.0 * bend * way;
        let mut next = if root >= 0.0 { 2.0 * way / (closing + root.sqrt()) } else { return None };
        for _ in 0..ROOT {
            if (there.gap - aim).abs() <= off {
                return Some(there);
            }
            if !(next > 0.0 && next < left) {
                return None;
            }
            last = (time, there.gap);
            time = next;
            there = self.carried(look, time)?;
            next = time - (there.gap - aim) * (time - last.0) / (there.gap - last.1);
        }
        None
    }

    /// The angular velocities that the direction may turn with.
    fn turnings(&self, stand: &Stand, features: (Feature, Feature), n: &Vector3) -> [Option<Vector3>; 2] {
        let (w_a, w_b) = (stand.a.instant.angular_velocity, stand.b.instant.angular_velocity);
        let zero = Vector3::zeros();

        // n′ = Ω × n with n′·e = −n·(ω × e), so that n stays perpendicular to a straight line e of a body turning with ω
        let along = |line: &Vector3, w: &Vector3| w.cross(n).dot(line);
        if self.a.is_plane || self.b.is_plane {
            return [Some(if self.a.is_plane { w_a } else { w_b }), None];
        }
        let natural = match features {
            (Feature::Face(_), _) => w_a,
            (_, Feature::Face(_)) => w_b,
            _ => match (self.a.line(&stand.a, features.0, n), self.b.line(&stand.b, features.1, &-n)) {
                (Some(e), Some(f)) => {
                    let (p, q) = (along(&e, &w_a), along(&f, &w_b));
                    let (c, s2) = (e.dot(&f), e.cross(&f).norm_squared());
                    n.cross(&(((p - c * q) / s2) * e + ((q - c * p) / s2) * f))
                }
                (Some(e), None) => n.cross(&(along(&e, &w_a) * e)),
                (None, Some(f)) => n.cross(&(along(&f, &w_b) * f)),
                (None, None) => zero,
            },
        };
        if natural == zero || !natural.norm_squared().is_finite() {
            return [Some(zero), None];
        }
        [Some(natural), Some(zero)]
    }

    /// How long from a look on, at most `h` [s], the bound with this Ω stays above `level` [m].
    pub(super) fn proved(&mut self, stand: &Stand, parting: &Parting, turning: &Vector3, level: f64, h: f64) -> f64 {
        let n = &parting.normal;
        let t = stand.time;
        let (from, to) = if stand.is_reversed { (t - h, t) } else { (t, t + h) };
        let [bounds_a, bounds_b] = [self.a.motion.bounds(from, to), self.b.motion.bounds(from, to)];

        // the moving points
        let acceleration = bounds_b.acceleration - bounds_a.acceleration;
        let (size, deviation) = (acceleration.norm(), bounds_a.deviation + bounds_b.deviation);
        let rate = turning.cross(n);
        let (turning_size, rate_size) = (turning.norm(), rate.norm());
        let fastest = stand.approach.norm() + h * (size + deviation);
        let farthest = stand.between.norm() + h * fastest;
        let mut start = n.dot(&stand.between) - self.a.piece.rounding() - self.b.piece.rounding();
        let mut end = start + h * (rate.dot(&stand.between) + n.dot(&stand.approach));
        let mut bend =
            rate_size * (turning_size * farthest + 2.0 * fastest + h * size) + deviation - n.dot(&acceleration);

        // each body's part
        let resting = turning_size == 0.0;
        for (side, placed, bounds, k, sign) in
            [(&mut self.a, &stand.a, &bounds_a, 0, 1.0), (&mut self.b, &stand.b, &bounds_b, 1, -1.0)]
        {
            let height = parting.heights[k];
            let part = if parting.swept[k] {
                Part { start: height, end: height, bend: 0.0 }
            } else {
                side.part(placed, bounds, &(sign * n), height, turning, resting, h)
            };
            start -= part.start;
            end -= part.end;
            bend += part.bend;
        }
        crossing(start - stand.error - level, (end - start) / h, bend).min(h)
    }
}

/// The first root of `c + b τ − ½ k τ²`, for a positive start c; without one, infinity.
pub(super) fn crossing(c: f64, b: f64, k: f64) -> f64 {
    if c <= 0.0 || c.is_nan() {
        return 0.0;
    }
    let discriminant = b * b + 2.0 * k * c;
    if discriminant < 0.0 || (b > 0.0 && k <= 0.0) {
        return f64::INFINITY;
    }
    // of the two forms of the root the one that does not cancel
    let root = discriminant.sqrt();
    if b > 0.0 {
        return (b + root) / k;
    }
    if root > b { 2.0 * c / (root - b) } else { f64::INFINITY }
}

/// Rounds of a search [-]: a rod that turns 300 rad beside a wall takes some hundreds.
pub(super) const ROUNDS: u32 = 100_000;
/// Where a bound is tried first [-].
const AHEAD: f64 = 2.0;
/// How often a bound is tried with another look ahead [-].
pub(super) const TRIALS: u32 = 4;
/// The same within ε [-]: what touches may leave in one point while another comes from nearby, and the
/// look ahead must become short enough to tell them apart.
const TRIALS_WITHIN: u32 = 16;
/// A bound that proves so much of what it looked ahead is good enough [-].
pub(super) const NEARLY: f64 = 0.5;
/// Rounding of a separation from supports, in ε of the pair's size [-]: 29/2 of the radii and 10/2 of the
/// distance as in the closest features, once for each end of the chord.
const SUPPORT_UNITS: f64 = 32.0;
/// ε of the search is at least so many rounding units of the pair's size [-]: half of it must stay above
/// the error of a separation and the interval of an answer.
const NEAR_UNITS: f64 = 144.0;
/// The same of coordinates and of the way that turning takes [-]: a sum of positions, a product of rate
/// and time.
const FAR_UNITS: f64 = 8.0;
/// The gap that is aimed at, in ε [-]: between the level that is proved and what counts as contact.
const AIM: f64 = 0.75;
/// How far a leap reaches, in proved steps [-]: what bends the bound forwards does so backwards.
const LEAP: f64 = 1.6;
/// A leap that is shorter is not worth its while, in proved steps [-].
const LEAST_LEAP: f64 = 1.0;
/// Rounds of the secant for where features meet [-].
const ROOT: u32 = 8;
/// A step from within ε that is not longer than this many ε at the pair's speed ends in approach [-].
const LEAST_STAY: f64 = 10.0;
/// A pair that takes longer than this many ε at its speed to cross ε may be grazing [-].
const SLOW: f64 = 1.0e4;
/// How far a pair that touches to rounding may sink while it leaves, in errors of a separation [-].
const LEAST_SINK: f64 = 4.0;
/// Rounds within ε after which a pair is said to stay there [-].
const STAYS: u32 = 256;
