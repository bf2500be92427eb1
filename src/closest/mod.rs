//! Closest features of two bodies: one signed distance with a certificate (lecture §8).
//!
//! [`closest_features`] answers for bodies apart, touching and overlapping with the same quantity,
//!
//! ```text
//! s(n) = min n·b − max n·a      over b ∈ B, a ∈ A
//! signed distance = max s(n)    over unit n
//! ```
//!
//! positive: the distance; negative: the least translation that ends the overlap. It comes with an
//! interval that contains the true value for the given coordinates and the rotations `q/|q|`:
//!
//! ```text
//! lower = s(n) − error                      for the normal n of the answer
//! upper = |b − a| + error                   apart: of the two closest points
//!       = −(radius of a ball proved to be in the difference) + error      overlapping
//! ```
//!
//! The query climbs until the interval is narrow enough, and usually ends on the first rung:
//!
//! | rung | what is tried |
//! |---|---|
//! | [`Rung::Verified`] | the features of the last answer, each point still in the other's region; else its vertices, checked by one look around; apart, up to three are exchanged for what the looks come upon |
//! | [`Rung::Walked`] | the Lin–Canny walk from the last features, checked the same way |
//! | [`Rung::Searched`] | search in `f64`: distance by GJK, depth by a growing polytope, supports by climbing |
//! | [`Rung::DoubleDouble`] | the same in double-double |
//!
//! Every pair of shapes takes the same road. A ball is its centre and a radius, a capsule its axis and a
//! radius; subtracting radii is exact in every state. Curved bodies enter by their supports, and their
//! points are found as the search goes; a half space has a closed form. A compound's signed distance is
//! the least over its pieces: apart, the distance; overlapping, minus the largest depth of two pieces.
//!
//! Bodies of revolution whose axes are parallel may have a whole circle of ways out that are equally deep,
//! as coaxial cylinders have: their depth is found in the plane through the axis.
//!
//! **What is not certified**: a curved body overlapping so that ways out on a whole curve are all but
//! equally deep, though no common axis makes them so, such as cylinders at an angle of 1e-6. The interval
//! then is wider, about 1e-4 of the size, it still holds, and `certified` is false.
//!
//! **Known to fail**: solids thinner than some 16 ε of their length, which is less than the rounding of their own
//! coordinates. Answers about them may be uncertified, and of one pair, an ellipsoid 9e15 m long and 2 m thick beside a
//! cylinder of 3.5 m, two certified intervals miss each other by 1.6 ε of the size.
//!
//! Modules: [`planar`] is the lecture's own two-dimensional walk over Voronoi regions.

mod answer;
mod cache;
mod climb;
mod collider;
mod depth;
mod half_space;
mod meridian;
mod pair;
pub mod planar;
mod region;
mod rotation;
mod round;
mod round_pair;
mod search;
mod simplex;
mod support;
mod surface;
mod vector;
pub mod vertex_plane;
mod walk;

pub use answer::{Accuracy, ClosestFeatures, Feature, Rung, State};
pub use cache::PairCache;
pub use collider::{Collidable, Collider};
pub(crate) use support::Piece;

use crate::error::{Error, Result};
use crate::math::{Pose, Vector3, quaternion};
use crate::tolerance::COORDINATE_MAX;
use collider::{Core, Solid, View};

/// Rounding of the distance of two balls, as a fraction of the coordinates [-]: two rotations and the
/// sums stay below 100 u. Larger: more pieces are looked at.
const BALL_SLACK: f64 = 64.0 * f64::EPSILON;

/// Closest features of two posed bodies; see the [module](self).
///
/// Bodies are references to a [`Collider`] or to a
/// [`ConvexPolyhedron`](crate::shape::convex_polyhedron::ConvexPolyhedron). The poses are those of the
/// shapes' own axes and mean the rotations `q/|q|`. A cache, if given, is read as a start and left with
/// this answer.
///
/// # Errors
/// A pose that is not finite, or whose quaternion has no direction; two half spaces.
#[inline]
pub fn closest_features<'a, 'b>(
    a: impl Into<Collidable<'a>>,
    pose_a: &Pose,
    b: impl Into<Collidable<'b>>,
    pose_b: &Pose,
    cache: Option<&mut PairCache>,
    accuracy: Accuracy,
) -> Result<ClosestFeatures> {
    query(&a.into(), pose_a, &b.into(), pose_b, cache, accuracy)
}

fn query(
    a: &Collidable<'_>,
    pose_a: &Pose,
    b: &Collidable<'_>,
    pose_b: &Pose,
    cache: Option<&mut PairCache>,
    accuracy: Accuracy,
) -> Result<ClosestFeatures> {
    if !(places(pose_a) && places(pose_b)) {
        check(pose_a, "pose_a")?;
        check(pose_b, "pose_b")?;
    }
    if a.count() == 1 && b.count() == 1 {
        pieces((&a.part(0), pose_a), (&b.part(0), pose_b), cache, accuracy)
    } else {
        compounds(a, pose_a, b, pose_b, cache, accuracy)
    }
}

/// Squares of a quaternion's length that give a direction [-].
const LENGTHS: std::ops::RangeInclusive<f64> = 1e-20..=1e20;

/// Whether a pose places a body: its quaternion has a direction, its position is within bounds.
#[inline]
fn places(pose: &Pose) -> bool {
    let q = &pose.orientation;
    let is_within = |x: f64| x.abs() <= COORDINATE_MAX;
    let p = &pose.position;
    LENGTHS.contains(&((q.w * q.w + q.i * q.i) + (q.j * q.j + q.k * q.k)))
        & is_within(p.x)
        & is_within(p.y)
        & is_within(p.z)
}

/// Refuses a pose that places nothing.
#[cold]
fn check(pose: &Pose, field: &'static str) -> Result<()> {
    if places(pose) {
        return Ok(());
    }
    if pose.position.iter().all(|x| x.abs() <= COORDINATE_MAX) {
        let allowed = "a pose whose quaternion has a length";
        return Err(Error::value("closest features", field, allowed, pose.orientation));
    }
    Err(Error::value("closest features", field, "a position within ±1e30", pose.position))
}

/// Two convex pieces, each by its kind.
#[inline]
fn pieces(
    (a, pose_a): (&View<'_>, &Pose),
    (b, pose_b): (&View<'_>, &Pose),
    cache: Option<&mut PairCache>,
    accuracy: Accuracy,
) -> Result<ClosestFeatures> {
    match (a.solid, b.solid) {
        (Solid::Core(Core::Polyhedron(core_a)), Solid::Core(Core::Polyhedron(core_b))) => {
            Ok(climb::polyhedra((core_a, a, pose_a), (core_b, b, pose_b), cache, accuracy))
        }
        (Solid::Core(core_a), Solid::Core(core_b)) => {
            Ok(climb::curved((core_a, a, pose_a), (core_b, b, pose_b), cache, accuracy))
        }
        (Solid::HalfSpace(plane), Solid::Core(core)) => {
            Ok(half_space::below((plane, a, pose_a), (core, b, pose_b), accuracy))
        }
        (Solid::Core(core), Solid::HalfSpace(plane)) => {
            Ok(half_space::below((plane, b, pose_b), (core, a, pose_a), accuracy).exchanged())
        }
        (Solid::HalfSpace(_), Solid::HalfSpace(_)) => {
            Err(Error::refused("closest features", "two half spaces have no closest features"))
        }
    }
}

/// The pieces of least signed distance: first those of the last answer, then all whose balls could be
/// nearer.
fn compounds(
    a: &Collidable<'_>,
    pose_a: &Pose,
    b: &Collidable<'_>,
    pose_b: &Pose,
    mut cache: Option<&mut PairCache>,
    accuracy: Accuracy,
) -> Result<ClosestFeatures> {
    // the centres of A's balls, seen from B; a bound of the signed distance of two balls
    let unit = |pose: &Pose| Pose { orientation: quaternion::normalized(&pose.orientation), ..*pose };
    let (from_a, from_b) = (unit(pose_a), unit(pose_b));
    let seen = |center: &Vector3| from_b.inverse_point(&from_a.point(center));
    let apart = |(center_a, reach_a): (Vector3, f64), (center_b, reach_b): (Vector3, f64)| {
        let distance = (center_b - center_a).norm();
        let slack = BALL_SLACK * (distance + center_a.norm() + center_b.norm() + pose_b.position.norm());
        distance - slack - reach_a - reach_b
    };
    let ball_a = |i: usize| {
        let (center, reach) = a.ball_of(i);
        (seen(&center), reach)
    };

    // where to begin: what was closest last time, else the pair whose balls are nearest
    let [i, j] = cache.as_ref().map_or([usize::MAX; 2], |c| c.parts());
    let is_remembered = i < a.count() && j < b.count();
    let first = if is_remembered { [i, j] } else { nearest_balls(a, b, &ball_a, &apart) };
    let mut memory = cache.as_deref().copied().unwrap_or_default();
    let ask = |[i, j]: [usize; 2], memory: &mut PairCache| {
        let mut answer = pieces((&a.part(i), pose_a), (&b.part(j), pose_b), Some(memory), accuracy)?;
        answer.part_a = u32::try_from(i).unwrap_or(u32::MAX);
        answer.part_b = u32::try_from(j).unwrap_or(u32::MAX);
        Ok::<_, Error>(answer)
    };
    let mut best = ask(first, &mut memory)?;
    let (mut parts, mut lower, mut upper, mut steps) = (first, best.lower, best.upper, best.steps);
    let mut certified = best.certified;

    // whatever could be nearer
    let whole_b = b.ball();
    for i in 0..a.count() {
        let ball = ball_a(i);
        if apart(ball, whole_b) > upper {
            continue;
        }
        for j in 0..b.count() {
            if [i, j] == first || apart(ball, b.ball_of(j)) > upper {
                continue;
            }
            let mut other = PairCache::new();
            let answer = ask([i, j], &mut other)?;
            steps += answer.steps;
            certified &= answer.certified || answer.lower > upper;
            (lower, upper) = (lower.min(answer.lower), upper.min(answer.upper));
            if answer.signed_distance < best.signed_distance {
                (best, parts, memory) = (answer, [i, j], other);
            }
        }
    }

    memory.store_parts(parts);
    if let Some(cache) = cache.as_mut() {
        **cache = memory;
    }
    debug_assert!(lower <= best.signed_distance && best.signed_distance <= upper, "{best:?} in {lower}..{upper}");
    Ok(ClosestFeatures { lower, upper, steps, certified, state: climb::state(lower, upper), ..best })
}

/// The pieces whose balls are nearest.
fn nearest_balls(
    a: &Collidable<'_>,
    b: &Collidable<'_>,
    ball_a: &impl Fn(usize) -> (Vector3, f64),
    apart: &impl Fn((Vector3, f64), (Vector3, f64)) -> f64,
) -> [usize; 2] {
    let mut best = ([0; 2], f64::INFINITY);
    for i in 0..a.count() {
        let ball = ball_a(i);
        for j in 0..b.count() {
            let bound = apart(ball, b.ball_of(j));
            if bound < best.1 {
                best = ([i, j], bound);
            }
        }
    }
    best.0
}
