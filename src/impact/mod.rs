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

pub use ends::Found;
pub use motion::{Instant, Motion, MotionBounds, Moving};

use crate::closest::{Accuracy, ClosestFeatures, PairCache, closest_features};
use crate::error::{Error, Result};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
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
pub fn time_of_impact(
    a: &ConvexPolyhedron,
    motion_a: &dyn Moving,
    b: &ConvexPolyhedron,
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
    let eps = eps.unwrap_or(IMPACT_GAP * (a.radius() + b.radius()));
    let mut cache = PairCache::new();
    if finder == Finder::Guaranteed {
        let (found, mut closest) =
            guaranteed::Search::new((a, motion_a), (b, motion_b), &mut cache).run(0.0, t_max, eps)?;
        if found.outcome == Outcome::Clear || found.outcome == Outcome::Grazing {
            closest = between(a, motion_a, b, motion_b, found.time, &mut cache)?;
        }
        let Found { outcome, time, iterations, queries } = found;
        return Ok(Impact { outcome, time, iterations, queries, closest });
    }

    // the first pose that cannot be queried is remembered: the finders see numbers only
    let mut refused = None;
    let mut gap = |t: f64| match between(a, motion_a, b, motion_b, t, &mut cache) {
        Ok(closest) => closest.signed_distance,
        Err(error) => {
            refused.get_or_insert(error);
            f64::NAN
        }
    };
    let next = if finder == Finder::Bisection { bisection::next } else { secant::next };
    let Found { outcome, time, iterations, queries } = ends::find(&mut gap, t_max, eps, next);
    if let Some(error) = refused {
        return Err(error);
    }
    let closest = between(a, motion_a, b, motion_b, time, &mut cache)?;
    Ok(Impact { outcome, time, iterations, queries, closest })
}

/// The closest features at `t` [s].
fn between(
    a: &ConvexPolyhedron,
    motion_a: &dyn Moving,
    b: &ConvexPolyhedron,
    motion_b: &dyn Moving,
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
