//! Closest features of two convex bodies: one signed distance with a certificate (lecture §8).
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
//! | [`Rung::Verified`] | the vertices of the last answer, checked by one look around |
//! | [`Rung::Walked`] | the Lin–Canny walk from the last features, checked the same way |
//! | [`Rung::Searched`] | search in `f64`: distance by GJK, depth by a growing polytope, supports by climbing |
//! | [`Rung::DoubleDouble`] | the same in double-double |
//!
//! Modules: [`planar`] is the lecture's own two-dimensional walk over Voronoi regions.

mod depth;
mod pair;
pub mod planar;
mod search;
mod simplex;
mod vector;
pub mod vertex_plane;
mod walk;

use crate::error::{Error, Result};
use crate::math::double_double::{DoubleDouble, Real};
use crate::math::{Pose, Vector3};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
use crate::tolerance::{CERTIFICATE_SLACK, COORDINATE_MAX, SEARCH_GAP};
use depth::Core;
use pair::{Heights, Ids, Pair};
use search::{Bounds, Found};
use simplex::Simplex;
use vector::Vec3;

/// How two bodies stand to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// The lower bound of the signed distance is positive.
    Separated,
    /// The interval contains 0: closer than the rounding of the coordinates can tell.
    Touching,
    /// The upper bound of the signed distance is negative.
    Overlapping,
}

/// A part of a body's surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Feature {
    /// A vertex, by its index in [`ConvexPolyhedron::vertices`].
    Vertex(u32),
    /// An edge, by its index in [`ConvexPolyhedron::edges`].
    Edge(u32),
    /// A face, by its index in [`ConvexPolyhedron::faces`].
    Face(u32),
}

impl Feature {
    /// `vertex`, `edge` or `face`.
    pub fn kind(self) -> &'static str {
        match self {
            Self::Vertex(_) => "vertex",
            Self::Edge(_) => "edge",
            Self::Face(_) => "face",
        }
    }

    /// The index among the body's features of that kind.
    pub fn index(self) -> u32 {
        match self {
            Self::Vertex(k) | Self::Edge(k) | Self::Face(k) => k,
        }
    }
}

/// When a query may stop.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Accuracy {
    /// At an interval as narrow as rounding allows: `upper − lower ≤ 36 ε size`, mostly 10 to 28 ε size,
    /// where the size is both radii plus the distance of the centres.
    #[default]
    Exact,
    /// At an interval of this fraction of the size [-].
    Relative(f64),
    /// As soon as the state is known; the bounds hold, the points are not yet the closest.
    YesNo,
}

/// How far a query had to climb.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rung {
    /// The cached vertices still were the answer.
    Verified,
    /// The walk from the cached features.
    Walked,
    /// The search in `f64`.
    Searched,
    /// The search in double-double.
    DoubleDouble,
}

/// The closest features of two bodies A and B, in world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestFeatures {
    /// Distance where positive, minus the depth where negative [m]: `normal · (point_b − point_a)`.
    pub signed_distance: f64,
    /// The true signed distance is not below this [m].
    pub lower: f64,
    /// The true signed distance is not above this [m].
    pub upper: f64,
    /// What the interval says.
    pub state: State,
    /// The closest or deepest point of A, world axes [m].
    pub point_a: Vector3,
    /// The closest or deepest point of B, world axes [m].
    pub point_b: Vector3,
    /// Unit normal from A to B, world axes; valid in every state.
    pub normal: Vector3,
    /// The feature of A that carries `point_a`: the one of lowest dimension.
    pub feature_a: Feature,
    /// The feature of B that carries `point_b`.
    pub feature_b: Feature,
    /// Rounds of all rungs together.
    pub steps: u32,
    /// The rung that the answer comes from.
    pub rung: Rung,
    /// Whether the interval is as narrow as was asked for. If not, it still contains the true value.
    pub certified: bool,
}

/// The vertices of a pair's last answer, to start the next query of the same pair from. Any content is
/// legal, also from another pair or another time: it costs steps, never truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PairCache {
    pairs: [[u16; 2]; PairCache::CAPACITY],
    count: u8,
    inside: bool,
}

impl PairCache {
    /// How many pairs of vertices are remembered: 4 of a simplex and what encloses a shallow overlap.
    pub(crate) const CAPACITY: usize = 14;

    /// An empty cache.
    pub fn new() -> Self {
        Self::default()
    }

    /// The remembered pairs that both bodies have vertices for.
    fn load(&self, a: &ConvexPolyhedron, b: &ConvexPolyhedron, into: &mut [Ids; Self::CAPACITY]) -> usize {
        let mut count = 0;
        for pair in self.pairs.iter().take(usize::from(self.count)) {
            let ids = pair.map(u32::from);
            let exists = (ids[0] as usize) < a.vertices().len() && (ids[1] as usize) < b.vertices().len();
            if exists && !into[..count].contains(&ids) {
                into[count] = ids;
                count += 1;
            }
        }
        count
    }

    /// Remembers pairs; bodies of more than 65,536 vertices are not remembered.
    fn store(&mut self, ids: &[Ids], inside: bool) {
        (self.count, self.inside) = (0, inside);
        for &[i, j] in ids.iter().take(Self::CAPACITY) {
            let (Ok(i), Ok(j)) = (u16::try_from(i), u16::try_from(j)) else { continue };
            self.pairs[usize::from(self.count)] = [i, j];
            self.count += 1;
        }
    }
}

/// Closest features of two posed convex polyhedra; see the [module](self).
///
/// The poses are those of the shapes' own axes and mean the rotations `q/|q|`. A cache, if given, is
/// read as a start and left with this answer.
///
/// # Errors
/// A pose that is not finite, or whose quaternion has no direction.
pub fn closest_features(
    a: &ConvexPolyhedron,
    pose_a: &Pose,
    b: &ConvexPolyhedron,
    pose_b: &Pose,
    cache: Option<&mut PairCache>,
    accuracy: Accuracy,
) -> Result<ClosestFeatures> {
    check(pose_a, "pose_a")?;
    check(pose_b, "pose_b")?;
    let mut start = [[0; 2]; PairCache::CAPACITY];
    let count = cache.as_ref().map_or(0, |c| c.load(a, b, &mut start));
    let mut steps = 0;

    // in f64 first, in double-double where that proves too little
    let inside = cache.as_ref().is_some_and(|c| c.inside);
    let pair = Pair::new(a, pose_a, b, pose_b);
    let mut found = climb(&pair, &start[..count], inside, accuracy, &mut steps);
    let mut answer = describe(&pair, &found.bounds, pose_a, accuracy, steps, found.rung);
    if !answer.certified {
        let pair = Pair::precise(a, pose_a, b, pose_b);
        let precise = find(&pair, &[], SEARCH_GAP * DoubleDouble::UNIT / f64::UNIT, accuracy, &mut steps);
        let precise_answer = describe(&pair, &precise.bounds, pose_a, accuracy, steps, Rung::DoubleDouble);
        if precise_answer.certified || precise_answer.upper - precise_answer.lower <= answer.upper - answer.lower {
            (answer, found.core) = (precise_answer, precise.core);
        }
    }
    if let Some(cache) = cache {
        match found.core {
            Some((ids, count)) if count >= 4 => cache.store(&ids[..count], true),
            _ => cache.store(&found.bounds.simplex.ids[..found.bounds.simplex.count], false),
        }
    }

    debug_assert!(answer.lower <= answer.signed_distance && answer.signed_distance <= answer.upper, "{answer:?}");
    Ok(answer)
}

/// Refuses a pose that places nothing.
fn check(pose: &Pose, field: &'static str) -> Result<()> {
    let size = pose.orientation.norm_squared();
    if !(1e-20..=1e20).contains(&size) {
        return Err(Error::value("closest features", field, "a pose whose quaternion has a length", pose.orientation));
    }
    if !pose.position.iter().all(|x| x.abs() <= COORDINATE_MAX) {
        return Err(Error::value("closest features", field, "a position within ±1e30", pose.position));
    }
    Ok(())
}

/// What a rung found: bounds, and of an overlap the vertices that prove it.
struct Outcome<R> {
    bounds: Bounds<R>,
    core: Option<Core>,
    rung: Rung,
}

/// The rungs in `f64`: verify the cached vertices, walk from their features, search.
#[inline]
fn climb(pair: &Pair<'_, f64>, start: &[Ids], inside: bool, accuracy: Accuracy, steps: &mut u32) -> Outcome<f64> {
    let gap = gap_of(accuracy, SEARCH_GAP) * pair.size;
    if inside {
        if let Some((bounds, core)) = depth::depth_again(pair, start, gap, steps, is_known_inside(pair, accuracy)) {
            let rung = if *steps == 1 { Rung::Verified } else { Rung::Searched };
            return Outcome { bounds, core: Some(core), rung };
        }
    } else if (1..=3).contains(&start.len()) {
        if let Some(bounds) = search::verify(pair, start, gap, steps) {
            return Outcome { bounds, core: None, rung: Rung::Verified };
        }
        let mut simplex = Simplex::empty();
        for &ids in start {
            simplex.push(ids, Vec3::zero());
        }
        let features = [
            feature(pair.a, &simplex, 0, || pair.in_axes_of_a(&pair.between)),
            feature(pair.b, &simplex, 1, || -pair.in_axes_of_b(&pair.between)),
        ];
        if let Some(carriers) = walk::walk(pair, features, steps) {
            let carriers = &carriers.ids[..carriers.count];
            if let Some(bounds) = search::verify(pair, carriers, gap, steps) {
                return Outcome { bounds, core: None, rung: Rung::Walked };
            }
            return find(pair, carriers, SEARCH_GAP, accuracy, steps);
        }
    }
    find(pair, start, SEARCH_GAP, accuracy, steps)
}

/// Whether an overlap is all that was asked for, and proved.
fn is_known_inside<R: Heights>(pair: &Pair<'_, R>, accuracy: Accuracy) -> impl Fn(&Bounds<R>) -> bool {
    let (only_state, error) = (accuracy == Accuracy::YesNo, R::from(pair.error));
    move |found| only_state && (found.upper < -error || found.lower > error)
}

/// The gap at which a query may stop, as a fraction of the size.
fn gap_of(accuracy: Accuracy, finest: f64) -> f64 {
    if let Accuracy::Relative(r) = accuracy { r.max(finest) } else { finest }
}

/// The signed distance by distance search and, where the bodies meet, depth.
fn find<R: Heights>(pair: &Pair<'_, R>, start: &[Ids], gap: f64, accuracy: Accuracy, steps: &mut u32) -> Outcome<R> {
    let gap = gap_of(accuracy, gap) * pair.size;
    let (only_state, error) = (accuracy == Accuracy::YesNo, R::from(pair.error));
    let (bounds, core) = match search::search(pair, start, gap, steps, |found| only_state && found.lower > error) {
        Found::Apart(bounds) => (bounds, None),
        Found::Inside(simplex) => {
            let (bounds, core) = depth::depth(pair, &simplex, gap, steps, is_known_inside(pair, accuracy));
            (bounds, Some(core))
        }
    };
    Outcome { bounds, core, rung: Rung::Searched }
}

/// The answer in the world, with its interval.
#[inline]
fn describe<R: Heights>(
    pair: &Pair<'_, R>,
    found: &Bounds<R>,
    pose_a: &Pose,
    accuracy: Accuracy,
    steps: u32,
    rung: Rung,
) -> ClosestFeatures {
    // the interval; a ball around the origin is proved only where its radius exceeds the error
    let error = R::from(pair.error);
    let length = found.point.norm();
    let upper = if found.upper < -error { found.upper } else { length };
    let (lower, upper) = outward(found.lower - error, upper + error);
    let (state, decided) = if lower > 0.0 {
        (State::Separated, true)
    } else if upper < 0.0 {
        (State::Overlapping, true)
    } else {
        (State::Touching, false)
    };
    let floor = 2.0 * pair.error + CERTIFICATE_SLACK * pair.size;
    let certified = match accuracy {
        Accuracy::Exact => upper - lower <= floor,
        Accuracy::Relative(r) => upper - lower <= floor.max(r * pair.size),
        Accuracy::YesNo => decided || upper - lower <= floor,
    };

    // both points, joined by the same vector that the distance is taken from
    let simplex = &found.simplex;
    let first = simplex.ids[0][0];
    let on_a = if simplex.ids[..simplex.count].iter().all(|ids| ids[0] == first) {
        pair.point_a(first)
    } else {
        let weighted = |k: usize| pair.point_a(simplex.ids[k][0]).scaled(simplex.weights[k]);
        (1..simplex.count).fold(weighted(0), |sum, k| sum + weighted(k))
    };
    let center = if pair.a.is_about_origin() { pose_a.position } else { pose_a.point(&pair.a.center().into()) };
    let point_a = center + on_a.to_vector();
    let point_b = point_a + found.point.to_vector();
    ClosestFeatures {
        signed_distance: found.normal.dot(&found.point).to_f64(),
        lower,
        upper,
        state,
        point_a,
        point_b,
        normal: found.normal.to_vector(),
        feature_a: feature(pair.a, simplex, 0, || pair.in_axes_of_a(&found.normal)),
        feature_b: feature(pair.b, simplex, 1, || -pair.in_axes_of_b(&found.normal)),
        steps,
        rung,
        certified,
    }
}

/// Both bounds as `f64`, rounded outwards.
#[inline]
fn outward<R: Real>(lower: R, upper: R) -> (f64, f64) {
    let (l, u) = (lower.to_f64(), upper.to_f64());
    (if R::from(l) > lower { l.next_down() } else { l }, if R::from(u) < upper { u.next_up() } else { u })
}

/// The feature spanned by a body's vertices in a simplex; of several faces the one that faces outward.
#[inline]
fn feature<R: Real>(
    body: &ConvexPolyhedron,
    simplex: &Simplex<R>,
    side: usize,
    outward: impl Fn() -> Vec3<R>,
) -> Feature {
    let mut distinct = [0; 4];
    let mut count = 0;
    for ids in &simplex.ids[..simplex.count] {
        if !distinct[..count].contains(&ids[side]) {
            distinct[count] = ids[side];
            count += 1;
        }
    }
    if count == 1 {
        return Feature::Vertex(distinct[0]);
    }
    if count == 2
        && let Some(e) = body.edge_between(distinct[0] as usize, distinct[1] as usize)
    {
        return Feature::Edge(u32::try_from(e).unwrap_or(u32::MAX));
    }
    let holds_all = |f: &u32| distinct[1..count].iter().all(|&v| body.faces_at(v as usize).contains(f));
    let mut candidates = body.faces_at(distinct[0] as usize).iter().copied().filter(holds_all);
    let first = candidates.next();
    if body.rank() == 3
        && let Some(f) = first
    {
        return Feature::Face(f);
    }

    // a polygon's two faces hold the same vertices; and rounding may have put them on no common face
    let d: Vec3<f64> = Vec3(outward().to_f64());
    let facing = |&f: &u32| d.dot(&Vec3(body.faces()[f as usize].normal));
    let all = body.faces_at(distinct[0] as usize).iter().copied();
    all.max_by(|f, g| facing(f).total_cmp(&facing(g))).map_or(Feature::Vertex(distinct[0]), Feature::Face)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cache_is_at_most_64_bytes() {
        assert!(size_of::<PairCache>() <= 64, "{}", size_of::<PairCache>());
    }
}
