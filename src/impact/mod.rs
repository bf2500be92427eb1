//! The time of contact: when do two moving bodies first touch (lecture §7)?
//!
//! | finder | file | what it does |
//! |---|---|---|
//! | [`Finder::Bisection`] | `bisection` | the lecture's: halves the interval; sees what ends in overlap |
//! | [`Finder::Secant`] | `secant` | the lecture's acceleration, its bracket kept; sees the same |
//! | [`Finder::Guaranteed`] | `guaranteed` | proves every piece of the way free; misses nothing |
//!
//! The first two look at the ends of the interval: a pass-through leaves no change of sign there, and is
//! not seen. The guaranteed search works on any [`Moving`] body: one that tells its pose at any time and
//! bounds of its motion over any interval.
//!
//! Accepted is only a gap in (0, ε], never an overlap.

mod bisection;
mod ends;
mod guaranteed;
pub mod motion;
mod secant;
mod side;
mod sweep;
mod swept;

pub use ends::Found;
pub use motion::{Instant, Motion, MotionBounds, Moving};

use crate::closest::{Accuracy, ClosestFeatures, Collidable, PairCache, closest_features};
use crate::error::{Error, Result};
use crate::math::quaternion;
use crate::tolerance::IMPACT_GAP;

/// How the time of contact is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Finder {
    /// Halve the interval, keep the half with the change of sign.
    Bisection,
    /// The straight line through both ends, with halvings between so that it cannot stall.
    Secant,
    /// Advance only as far as no contact is proved.
    #[default]
    Guaranteed,
}

impl Finder {
    /// Every finder.
    pub const ALL: &'static [Self] = &[Self::Bisection, Self::Secant, Self::Guaranteed];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bisection => "bisection",
            Self::Secant => "secant",
            Self::Guaranteed => "guaranteed",
        }
    }
}

/// How a search for an impact ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Outcome {
    /// No impact: proved by the guaranteed search, not seen by the others.
    Clear,
    /// The gap is in (0, ε] and closes.
    At,
    /// The search starts with a gap within ε that closes, or that stays.
    AlreadyTouching,
    /// The search starts in overlap.
    Overlap,
    /// The gap came within (0, ε] and opens again, without ever being below −ε: whether the bodies
    /// touched is less than ε tells.
    Grazing,
    /// No instant with a gap in (0, ε] can be told: ε is below what rounding leaves.
    Stalled,
}

impl Outcome {
    /// The name that Python uses.
    pub fn name(self) -> &'static str {
        match self {
            Self::Clear => "clear",
            Self::At => "at",
            Self::AlreadyTouching => "already_touching",
            Self::Overlap => "overlap",
            Self::Grazing => "grazing",
            Self::Stalled => "stalled",
        }
    }
}

/// The end of a search, and what it cost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impact {
    /// How it ended.
    pub outcome: Outcome,
    /// When [s]: of the impact or graze; the end of the search where it is clear; how far it came where
    /// it stalled; else its start.
    pub time: f64,
    /// Rounds of the finder.
    pub iterations: u32,
    /// Queries of the closest features, or evaluations of the gap.
    pub queries: u32,
    /// The closest features at that time.
    pub closest: ClosestFeatures,
}

/// Finds the first impact of two moving bodies in 0..=`t_max` [s].
///
/// `eps` [m] is the gap at which contact is accepted; without it 1e-12 of the pair's size (both radii),
/// and never less than the rounding of its coordinates. A smaller one is found later by less than
/// `eps` over the speed of approach, at one or two more rounds.
///
/// A pair that starts within ε and separates is searched on from where its gap exceeds ε, or from where
/// its approach resumes.
///
/// # Errors
/// A span or ε that is not positive and finite; motions that are not finite.
///
/// # Example
/// ```
/// # fn main() -> Result<(), bryla::Error> {
/// use bryla::impact::{Finder, Motion, Outcome, time_of_impact};
/// use bryla::{Pose, shape::convex_polyhedron::ConvexPolyhedron};
///
/// let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| [0, 1, 2].map(|i| if k >> i & 1 == 0 { -0.5 } else { 0.5 }));
/// let cube = ConvexPolyhedron::from_points(&corners)?;
/// let rests = Motion::resting(Pose::identity());
/// let comes = Motion::new(Pose::new([3.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]), [-4.0, 0.0, 0.0], [0.0; 3]);
/// let found = time_of_impact(&cube, &rests, &cube, &comes, 1.0, None, Finder::Guaranteed)?;
/// assert_eq!(found.outcome, Outcome::At);
/// assert!((found.time - 0.5).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
pub fn time_of_impact<'a, 'b>(
    a: impl Into<Collidable<'a>>,
    motion_a: &dyn Moving,
    b: impl Into<Collidable<'b>>,
    motion_b: &dyn Moving,
    t_max: f64,
    eps: Option<f64>,
    finder: Finder,
) -> Result<Impact> {
    let place = "time of impact";
    if !(t_max > 0.0 && t_max.is_finite()) {
        return Err(Error::value(place, "t_max", "positive and finite", t_max));
    }
    if let Some(eps) = eps.filter(|eps| !(*eps > 0.0 && eps.is_finite())) {
        return Err(Error::value(place, "eps", "positive and finite", eps));
    }
    check_finite("time of impact, motion_a", motion_a)?;
    check_finite("time of impact, motion_b", motion_b)?;
    let (a, b) = ((a.into(), motion_a), (b.into(), motion_b));
    let eps = eps.unwrap_or(IMPACT_GAP * (a.0.size() + b.0.size()));
    let mut cache = PairCache::new();
    let Found { outcome, time, iterations, queries, .. } = first_impact_by(finder, a, b, 0.0, t_max, eps, &mut cache)?;
    let closest = between(a, b, time, &mut cache)?;
    Ok(Impact { outcome, time, iterations, queries, closest })
}

/// Refuses a motion that is not finite where it starts.
fn check_finite(place: &str, motion: &dyn Moving) -> Result<()> {
    let (start, center) = (motion.at(0.0), motion.center());
    let turned = quaternion::to_scalar_first(&start.pose.orientation);
    // velocities first: where one is not finite, neither is what follows from it
    let fields = [
        ("velocity", start.velocity.as_slice()),
        ("angular_velocity", start.angular_velocity.as_slice()),
        ("center", center.as_slice()),
        ("orientation", &turned[..]),
        ("position", start.center.as_slice()),
    ];
    match fields.iter().find(|(_, numbers)| !numbers.iter().all(|x| x.is_finite())) {
        Some((field, numbers)) => Err(Error::value(place, field, "finite", numbers)),
        None => Ok(()),
    }
}

/// The search over `from..=to` [s] by any finder; the cache is left with its last query.
pub(crate) fn first_impact_by(
    finder: Finder,
    a: (Collidable<'_>, &dyn Moving),
    b: (Collidable<'_>, &dyn Moving),
    from: f64,
    to: f64,
    eps: f64,
    cache: &mut PairCache,
) -> Result<Found> {
    if finder == Finder::Guaranteed {
        return first_impact(a, b, from, to, eps, cache);
    }
    // the first pose that cannot be queried is remembered: the finders see numbers only
    let mut refused = None;
    let gap = |t: f64| match between(a, b, from + t, cache) {
        Ok(closest) => closest.signed_distance,
        Err(error) => {
            refused.get_or_insert(error);
            f64::NAN
        }
    };
    let found = find_impact(gap, to - from, eps, finder);
    match refused {
        Some(error) => Err(error),
        None => Ok(Found { time: from + found.time, until: from + found.until, ..found }),
    }
}

/// The guaranteed search over `from..=to` [s]: of bodies of several pieces, the earliest impact of two.
pub(crate) fn first_impact(
    (a, motion_a): (Collidable<'_>, &dyn Moving),
    (b, motion_b): (Collidable<'_>, &dyn Moving),
    from: f64,
    to: f64,
    eps: f64,
    cache: &mut PairCache,
) -> Result<Found> {
    let mut first = Found { outcome: Outcome::Clear, time: to, until: to, iterations: 0, queries: 0 };
    for i in 0..a.pieces() {
        for j in 0..b.pieces() {
            *cache = PairCache::new();
            let mut search = guaranteed::Search::new((a.piece(i), motion_a), (b.piece(j), motion_b), cache);
            let found = search.run(from, first.time, eps)?;
            first.iterations += found.iterations;
            first.queries += found.queries;
            if found.outcome != Outcome::Clear && (first.outcome == Outcome::Clear || found.time < first.time) {
                (first.outcome, first.time, first.until) = (found.outcome, found.time, found.until);
            }
            if first.time <= from {
                return Ok(first);
            }
        }
    }
    Ok(first)
}

/// The closest features at `t` [s].
fn between(
    (a, motion_a): (Collidable<'_>, &dyn Moving),
    (b, motion_b): (Collidable<'_>, &dyn Moving),
    t: f64,
    cache: &mut PairCache,
) -> Result<ClosestFeatures> {
    closest_features(a, &motion_a.at(t).pose, b, &motion_b.at(t).pose, Some(cache), Accuracy::Exact)
}

/// Finds the impact in 0..=`h` [s] as the lecture does, given the gap [m] as a function of time from the
/// start: by the secant, or by bisection where that is asked for.
pub fn find_impact(mut gap: impl FnMut(f64) -> f64, h: f64, eps: f64, finder: Finder) -> Found {
    let next = if finder == Finder::Bisection { bisection::next } else { secant::next };
    ends::find(&mut gap, h, eps, next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Pose, Vector3};
    use crate::shape::convex_polyhedron::ConvexPolyhedron;

    fn cuboid(h: [f64; 3]) -> ConvexPolyhedron {
        let corner = |k: usize| std::array::from_fn(|i| if (k >> i) & 1 == 0 { -h[i] } else { h[i] });
        ConvexPolyhedron::from_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    fn at(x: f64, y: f64, z: f64) -> Pose {
        Pose::new([x, y, z], [1.0, 0.0, 0.0, 0.0])
    }

    fn guaranteed(a: &ConvexPolyhedron, m: &Motion, b: &ConvexPolyhedron, n: &Motion, to: f64) -> Impact {
        time_of_impact(a, m, b, n, to, None, Finder::Guaranteed).unwrap()
    }

    #[test]
    fn a_capsule_that_turns_comes_down_on_a_rim_as_it_would_on_an_edge() {
        // its side 1e-10 m above the rim, which it meets at 1e-5 m/s while it turns about its centre: a gap of
        // (r + 1e-10 − 1e-5 t) cos ωt − r, to be closed to 1e-12 of the pair's size, 1 m, and known to the rounding of that
        // size; a normal that did not turn along would be lost by ω times the half height, 1e4 times as fast
        use crate::closest::Collider;
        use crate::shape::{Capsule, Cylinder};
        let table = Collider::new(&Cylinder::new(0.5, 0.05).into()).unwrap();
        let capsule = Collider::new(&Capsule::new(0.03, 0.1).into()).unwrap();
        let n = Vector3::new(0.6, 0.0, 0.8);
        // its axis lies in the plane of n and the rim's axis, across n, and turns in that plane
        let across = crate::math::quaternion::from_axis_angle(&Vector3::y(), libm::atan2(0.8, -0.6));
        let position = Vector3::new(0.5, 0.0, 0.05) + (0.03 + 1e-10) * n;
        let pose = Pose { position, orientation: across };
        let comes = Motion::new(pose, -1e-5 * n, [0.0, 1.0, 0.0]);
        let rests = Motion::resting(Pose::identity());
        let found = time_of_impact(&table, &rests, &capsule, &comes, 1.0, None, Finder::Guaranteed).unwrap();
        assert_eq!(found.outcome, Outcome::At);
        let gap = (1e-10 - 1e-5 * found.time) - 0.03 * (1.0 - libm::cos(found.time));
        assert!(gap <= 1e-12 && (gap - found.closest.signed_distance).abs() <= 4.0 * f64::EPSILON, "{found:?}");
        assert!(found.iterations <= 20, "{found:?}");
    }

    #[test]
    fn a_bullet_meets_a_thin_plate_at_any_speed() {
        // faces at −1e-6 and from 3 − 0.01 on: t = (2.99 − 1e-6)/v, early by ε/v at most
        let (plate, bullet) = (cuboid([0.5, 0.5, 1e-6]), cuboid([0.01; 3]));
        for speed in [1e3, 1e4, 1e5] {
            for &finder in Finder::ALL {
                let flies = Motion::new(at(0.1, 0.2, 3.0), [0.0, 0.0, -speed], [0.0; 3]);
                let rests = Motion::resting(Pose::identity());
                let found = time_of_impact(&plate, &rests, &bullet, &flies, 0.1, None, finder).unwrap();
                if finder == Finder::Guaranteed {
                    let truth = (2.99 - 1e-6) / speed;
                    assert_eq!(found.outcome, Outcome::At);
                    // ε of both radii, 0.73 m, and the rounding of 3 m to a few ε
                    assert!((found.time - truth).abs() * speed < 2e-12, "{:e}", (found.time - truth) * speed);
                } else {
                    // the lecture's finders look at the ends, and there is nothing to be seen
                    assert_eq!(found.outcome, Outcome::Clear, "{finder:?}");
                }
            }
        }
    }

    #[test]
    fn a_rod_spinning_at_1000_rad_per_second_meets_a_wall_with_its_tip() {
        // gap = 1.5 − v t − |cos ω t|; the first root lies in the first half turn whose end of rod is out far enough
        let (v, w) = (0.8, 1000.0);
        let gap = |t: f64| 1.5 - v * t - libm::cos(w * t).abs();
        let half_turn = std::f64::consts::PI / w;
        let near = (1..1000).map(|k| f64::from(k) * half_turn).find(|t| gap(*t) < 0.0).unwrap();
        let (mut a, mut b) = (near - 0.5 * half_turn, near);
        for _ in 0..100 {
            let middle = 0.5 * (a + b);
            *(if gap(middle) > 0.0 { &mut a } else { &mut b }) = middle;
        }

        let rod = ConvexPolyhedron::from_points(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]).unwrap();
        let spins = Motion::new(at(-1.5, 0.0, 0.0), [v, 0.0, 0.0], [0.0, 0.0, w]);
        let wall = Motion::resting(at(1.0, 0.0, 0.0));
        let found = guaranteed(&rod, &spins, &cuboid([1.0, 5.0, 5.0]), &wall, 2.0);
        assert_eq!(found.outcome, Outcome::At);
        // ε = 1e-12 · 8.1 m and the rounding of an angle of 625 rad, at an approach of some 70 m/s
        assert!((found.time - a).abs() < 1e-12, "{:e}", found.time - a);
        assert!(found.iterations < 2000, "{}", found.iterations);
    }

    #[test]
    fn a_corner_that_passes_a_wall_hits_clears_or_grazes_by_its_distance() {
        // a cube turns in place; its edge is at most √½ from the axis, at φ = π/4
        let (cube, wall) = (cuboid([0.5; 3]), cuboid([1.0, 5.0, 5.0]));
        let turns = Motion::new(at(0.0, 0.0, 0.0), [0.0; 3], [0.0, 0.0, 1.0]);
        let reach = 0.5f64.sqrt();
        let end = |distance: f64| {
            let rests = Motion::resting(at(1.0 + reach + distance, 0.0, 0.0));
            guaranteed(&cube, &turns, &wall, &rests, 1.2)
        };
        // ε is 1e-12 of both radii, 8.0e-12
        assert_eq!(end(1e-10).outcome, Outcome::Clear);
        let grazes = end(4e-12);
        assert_eq!(grazes.outcome, Outcome::Grazing);
        assert!(grazes.closest.lower > 0.0 && grazes.closest.signed_distance <= 8.1e-12);
        let hits = end(-1e-6);
        let truth = std::f64::consts::FRAC_PI_4 - libm::acos(1.0 - 1e-6 / reach);
        assert_eq!(hits.outcome, Outcome::At);
        // ε over the speed √½ sin(acos(1 − 1e-6/√½))
        assert!((hits.time - truth).abs() < 1e-8, "{:e}", hits.time - truth);
        assert!(hits.closest.lower > 0.0);
    }

    #[test]
    fn what_starts_touching_is_told_from_what_leaves_and_what_overlaps() {
        let cube = cuboid([0.5; 3]);
        let rests = Motion::resting(Pose::identity());
        let end = |gap: f64, velocity: [f64; 3], spin: [f64; 3]| {
            let moves = Motion::new(at(0.0, 0.0, 1.0 + gap), velocity, spin);
            guaranteed(&cube, &rests, &cube, &moves, 1.0).outcome
        };
        for gap in [0.0, 1e-13, 1e-12] {
            assert_eq!(end(gap, [0.0, 0.0, 2.0], [0.1, 0.2, 0.3]), Outcome::Clear, "{gap:e}");
            assert_eq!(end(gap, [0.0, 0.0, -2.0], [0.0; 3]), Outcome::AlreadyTouching, "{gap:e}");
            // one edge leaves, the other comes
            assert_eq!(end(gap, [0.0; 3], [1.0, 0.0, 0.0]), Outcome::AlreadyTouching, "{gap:e}");
            // sliding: the gap stays
            assert_eq!(end(gap, [0.3, 0.1, 0.0], [0.0; 3]), Outcome::Clear, "{gap:e}");
        }
        assert_eq!(end(-0.1, [0.0, 0.0, 2.0], [0.0; 3]), Outcome::Overlap);
    }

    /// Rises as `t³ (1 − t)` along z, without turning.
    struct Rises(Vector3);

    impl Moving for Rises {
        fn center(&self) -> Vector3 {
            Vector3::zeros()
        }

        fn at(&self, t: f64) -> Instant {
            let pose = at(self.0.x, self.0.y, self.0.z + t * t * t * (1.0 - t));
            let velocity = Vector3::z() * (t * t * (3.0 - 4.0 * t));
            Instant { pose, center: pose.position, velocity, angular_velocity: Vector3::zeros() }
        }

        fn bounds(&self, from: f64, to: f64) -> MotionBounds {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let third = (6.0 - 24.0 * from).abs().max((6.0 - 24.0 * to).abs());
            let acceleration = Vector3::z() * (middle * (6.0 - 12.0 * middle));
            MotionBounds { acceleration, deviation: half * third, ..MotionBounds::uniform(0.0) }
        }
    }

    #[test]
    fn bodies_that_part_with_the_third_derivative_alone_are_followed_to_where_they_meet_again() {
        // gap = t³ (1 − t): neither a speed nor an acceleration opens it, and it closes at t = 1 with speed 1
        let (cube, rests) = (cuboid([0.5; 3]), Motion::resting(Pose::identity()));
        for gap in [0.0, 1e-13, 1e-12] {
            let rises = Rises(Vector3::new(0.1, 0.2, 1.0 + gap));
            let found = time_of_impact(&cube, &rests, &cube, &rises, 1.5, None, Finder::Guaranteed).unwrap();
            assert_eq!(found.outcome, Outcome::At, "{gap:e}: {found:?}");
            // ε of both radii is 1.7e-12 m, at 1 m/s
            assert!((found.time - 1.0).abs() < 4e-12, "{gap:e}: {:e}", found.time - 1.0);
        }
    }

    #[test]
    fn a_rod_that_spins_beside_a_body_is_proved_free_for_many_turns_at_once() {
        // the rod sweeps the cone |z| = √(x² + y²) up to z = √½, give or take its thickness
        let rod = cuboid([1.0, 0.02, 0.02]);
        let tilt = quaternion::exp(&Vector3::new(0.0, -std::f64::consts::FRAC_PI_4, 0.0));
        let spins = Motion::new(Pose { position: Vector3::zeros(), orientation: tilt }, [0.0; 3], [0.0, 0.0, 300.0]);
        let end = |center: [f64; 3], velocity: [f64; 3], spin: [f64; 3]| {
            let cube = cuboid([0.1; 3]);
            let passes = Motion::new(at(center[0], center[1], center[2]), velocity, spin);
            guaranteed(&rod, &spins, &cube, &passes, 1.0)
        };
        // in the funnel, beside the waist, and above all
        for (center, velocity) in [
            ([0.05, 0.0, 0.6], [-0.1, 0.0, 0.0]),
            ([0.5, 0.05, 0.0], [0.0, -0.1, 0.0]),
            ([-0.3, 0.0, 1.0], [0.6, 0.0, 0.0]),
        ] {
            let found = end(center, velocity, [0.0, 0.0, 0.4]);
            assert_eq!(found.outcome, Outcome::Clear, "{center:?}");
            assert!(found.queries <= 4, "{center:?}: {} queries", found.queries);
        }
        // down into the funnel: the cube's edge meets the rod near where its lower corners reach the cone
        let found = end([0.0, 0.0, 0.6], [0.0, 0.0, -0.5], [0.0; 3]);
        assert_eq!(found.outcome, Outcome::At);
        let corner = 0.6 - 0.1 - 0.5 * found.time;
        assert!((0.02..0.2).contains(&corner), "{corner}");
        assert!(found.closest.lower > 0.0);
    }

    #[test]
    fn bad_input_is_refused_by_name() {
        let (cube, rests) = (cuboid([0.5; 3]), Motion::resting(Pose::identity()));
        let with = |t_max, eps| time_of_impact(&cube, &rests, &cube, &rests, t_max, eps, Finder::Guaranteed);
        assert!(with(f64::NAN, None).unwrap_err().to_string().contains("t_max"));
        assert!(with(0.0, None).unwrap_err().to_string().contains("t_max"));
        assert!(with(1.0, Some(-1.0)).unwrap_err().to_string().contains("eps"));
        let lost = Motion::new(Pose { position: Vector3::repeat(f64::NAN), ..Pose::identity() }, [0.0; 3], [0.0; 3]);
        assert!(time_of_impact(&cube, &rests, &cube, &lost, 1.0, None, Finder::Secant).is_err());
        assert!(time_of_impact(&cube, &rests, &cube, &lost, 1.0, None, Finder::Guaranteed).is_err());
    }
}
