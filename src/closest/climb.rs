//! Two convex pieces: the rungs of a query, from the cached features to double-double.

use super::answer::{Accuracy, ClosestFeatures, Rung, State};
use super::cache::{Packed, PairCache};
use super::collider::{Core, View};
use super::depth::{self, Enclosing};
use super::meridian;
use super::pair::{Difference, Ids, Pair, feature};
use super::region::{self, Joined};
use super::round_pair::RoundPair;
use super::search::{self, Bounds, Found};
use super::simplex::Simplex;
use super::surface::Workshop;
use super::vector::Vec3;
use super::walk;
use crate::math::double_double::{DoubleDouble, Real};
use crate::math::{Pose, Vector3};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
use crate::tolerance::{CERTIFICATE_SLACK, SEARCH_GAP};

/// Gap at which a search in double-double stops that runs over curved bodies, as a fraction of the
/// pair's size [-]. Its points close in on the closest one without ever reaching it; this is a quarter
/// of the rounding of the answer.
const CURVED_GAP: f64 = 0.125 * f64::EPSILON;
/// A depth whose interval in `f64` is wider than this fraction of the size [-] has a whole curve of ways
/// out; more digits do not narrow it.
const HOPELESS: f64 = 1e-9;

/// Two polyhedra, or what is within a distance of them.
#[inline]
pub(super) fn polyhedra(
    (a, view_a, pose_a): (&ConvexPolyhedron, &View<'_>, &Pose),
    (b, view_b, pose_b): (&ConvexPolyhedron, &View<'_>, &Pose),
    cache: Option<&mut PairCache>,
    accuracy: Accuracy,
) -> ClosestFeatures {
    let (at_a, at_b) = (view_a.stand(pose_a), view_b.stand(pose_b));
    let (views, center) = ([view_a, view_b], at_a.point(a.center()));
    let pair = Pair::new(a, &at_a, b, &at_b);

    // the features of the last answer, each point still in the other's region
    let last = cache.as_ref().and_then(|c| c.features());
    if let Some(found) = last.and_then(|features| region::joined(&pair, features)) {
        let answer = describe(&pair, &found, views, &center, accuracy, 1, Rung::Verified);
        if answer.certified {
            return answer;
        }
    }

    // its vertices, where the bodies were apart
    let mut start = [[0; 2]; PairCache::CAPACITY];
    let count = cache.as_ref().map_or(0, |c| c.load(a, b, &mut start));
    let start = &start[..count];
    let mut steps = 0;
    let was_apart = (1..=3).contains(&count);
    if was_apart {
        let gap = gap_of(accuracy, SEARCH_GAP) * pair.size;
        let mut found = Bounds::unknown(pair.simplex(start));
        if search::verify(&pair, &mut found, gap, &mut steps) {
            let joined = join(&pair, &found);
            let answer = describe(&pair, &joined, views, &center, accuracy, steps, Rung::Verified);
            if answer.certified {
                if let Some(cache) = cache {
                    cache.store_apart(&found.simplex.ids[..found.simplex.count], joined.features);
                }
                return answer;
            }
        }
    }

    // in f64 first, in double-double where that proves too little
    let mut found = if was_apart {
        walk(&pair, start, radii(views), accuracy, &mut steps)
    } else {
        let surface = cache.as_ref().and_then(|c| c.surface(a, b));
        climb(&pair, start, surface, radii(views), accuracy, &mut steps)
    };
    let joined = join(&pair, &found.bounds);
    let mut answer = describe(&pair, &joined, views, &center, accuracy, steps, found.rung);
    if !answer.certified {
        let pair = Pair::precise(a, &at_a, b, &at_b);
        let gap = SEARCH_GAP * DoubleDouble::UNIT / f64::UNIT;
        let precise = find(&pair, &[], &pair.between, radii(views), gap, accuracy, &mut steps);
        let better =
            describe(&pair, &join(&pair, &precise.bounds), views, &center, accuracy, steps, Rung::DoubleDouble);
        if better.certified || better.upper - better.lower <= answer.upper - answer.lower {
            (answer, found.core) = (better, precise.core);
        }
    }
    if let Some(cache) = cache {
        match found.core {
            Enclosing::Surface(packed) => cache.store_surface(packed),
            Enclosing::Points((ids, count)) if count >= 4 => cache.store(&ids[..count]),
            Enclosing::AsBefore => {}
            _ => {
                let simplex = &found.bounds.simplex;
                let ids = &simplex.ids[..simplex.count];
                if ids.len() < 4 { cache.store_apart(ids, joined.features) } else { cache.store(ids) }
            }
        }
    }
    answer
}

/// Two bodies of which one at least is curved.
pub(super) fn curved(
    (a, view_a, pose_a): (Core<'_>, &View<'_>, &Pose),
    (b, view_b, pose_b): (Core<'_>, &View<'_>, &Pose),
    cache: Option<&mut PairCache>,
    accuracy: Accuracy,
) -> ClosestFeatures {
    let (at_a, at_b) = (view_a.stand(pose_a), view_b.stand(pose_b));
    let (views, center) = ([view_a, view_b], at_a.point(a.center()));
    let mut steps = 0;

    // from the last normal, or along the line of centres
    let pair = RoundPair::new(a, &at_a, b, &at_b);
    let toward = cache.as_ref().and_then(|c| c.normal()).map_or_else(|| pair.between(), Vec3);
    let found = find(&pair, &[], &toward, radii(views), SEARCH_GAP, accuracy, &mut steps);
    let mut answer = describe(&pair, &join(&pair, &found.bounds), views, &center, accuracy, steps, found.rung);
    let is_hopeless = answer.state == State::Overlapping && answer.upper - answer.lower > HOPELESS * pair.size();
    if !answer.certified && !is_hopeless {
        let pair = RoundPair::precise(a, &at_a, b, &at_b);
        let toward = found.bounds.normal.0.map(DoubleDouble::from);
        let precise = find(&pair, &[], &Vec3(toward), radii(views), CURVED_GAP, accuracy, &mut steps);
        let better =
            describe(&pair, &join(&pair, &precise.bounds), views, &center, accuracy, steps, Rung::DoubleDouble);
        if better.certified || better.upper - better.lower <= answer.upper - answer.lower {
            answer = better;
        }
    }
    if let Some(cache) = cache {
        cache.store_normal(&Vec3(answer.normal.into()));
    }
    answer
}

/// What the bodies are rounded by [m], together.
#[inline]
fn radii<R: Real>(views: [&View<'_>; 2]) -> R {
    R::from(views[0].rounding) + R::from(views[1].rounding)
}

/// What a rung found: bounds, and of an overlap the vertices that prove it.
struct Outcome<R> {
    bounds: Bounds<R>,
    core: Enclosing,
    rung: Rung,
}

/// The walk from the features of the last answer, and the search where it leads nowhere.
#[inline(never)]
fn walk(pair: &Pair<'_, f64>, start: &[Ids], rounding: f64, accuracy: Accuracy, steps: &mut u32) -> Outcome<f64> {
    let features = [
        feature(pair.a, start, 0, || pair.in_axes_of_a(&pair.between).to_f64()),
        feature(pair.b, start, 1, || (-pair.in_axes_of_b(&pair.between)).to_f64()),
    ];
    let Some(carriers) = walk::walk(pair, features, steps) else {
        return find(pair, start, &pair.between, rounding, SEARCH_GAP, accuracy, steps);
    };
    let mut bounds = Bounds::unknown(carriers);
    if search::verify(pair, &mut bounds, gap_of(accuracy, SEARCH_GAP) * pair.size, steps) {
        return Outcome { bounds, core: Enclosing::Nothing, rung: Rung::Walked };
    }
    find(pair, &carriers.ids[..carriers.count], &pair.between, rounding, SEARCH_GAP, accuracy, steps)
}

/// The rungs in `f64` of bodies that were not apart: what enclosed the overlap, and the search.
#[inline(never)]
fn climb(
    pair: &Pair<'_, f64>,
    start: &[Ids],
    surface: Option<&Packed>,
    rounding: f64,
    accuracy: Accuracy,
    steps: &mut u32,
) -> Outcome<f64> {
    let (gap, enough) = (gap_of(accuracy, SEARCH_GAP) * pair.size, is_known_inside(pair, accuracy));
    let mut again = surface.and_then(|packed| depth::depth_on(pair, packed, gap, steps, &enough));
    if again.is_none() {
        again = depth::depth_again(pair, start, gap, steps, &enough);
    }
    // what was remembered serves where it proves enough
    let error = |bounds: &Bounds<f64>| 2.0 * pair.error(bounds.lower);
    let proves =
        |bounds: &Bounds<f64>| enough(bounds) || upper_bound(pair, bounds) - bounds.lower <= gap + error(bounds);
    if let Some((bounds, core)) = again.filter(|(bounds, _)| proves(bounds)) {
        let rung = if *steps == 1 { Rung::Verified } else { Rung::Searched };
        return Outcome { bounds, core, rung };
    }
    find(pair, start, &pair.between, rounding, SEARCH_GAP, accuracy, steps)
}

/// Whether the cores' distance is known to be above or below the rounding, and that is all that was asked
/// for.
fn is_known_apart<R: Real>(pair: &impl Difference<R>, rounding: R, accuracy: Accuracy) -> impl Fn(&Bounds<R>) -> bool {
    let (only_state, error) = (accuracy == Accuracy::YesNo, R::from(pair.error(0.0)));
    move |found| only_state && (found.upper < rounding - error || found.lower > rounding + error)
}

/// The same for a depth: what encloses the origin has a negative upper bound.
fn is_known_inside<R: Real>(pair: &impl Difference<R>, accuracy: Accuracy) -> impl Fn(&Bounds<R>) -> bool {
    is_known_apart(pair, R::from(0.0), accuracy)
}

/// The gap at which a query may stop, as a fraction of the size.
fn gap_of(accuracy: Accuracy, finest: f64) -> f64 {
    if let Accuracy::Relative(r) = accuracy { r.max(finest) } else { finest }
}

/// The signed distance of the cores by distance search and, where they meet, depth.
fn find<R: Workshop>(
    pair: &impl Difference<R>,
    start: &[Ids],
    toward: &Vec3<R>,
    rounding: R,
    gap: f64,
    accuracy: Accuracy,
    steps: &mut u32,
) -> Outcome<R> {
    let gap = gap_of(accuracy, gap) * pair.size();
    let found = search::search(pair, start, toward, gap, steps, is_known_apart(pair, rounding, accuracy));
    let (apart, simplex) = match found {
        Found::Apart(bounds) => return Outcome { bounds, core: Enclosing::Nothing, rung: Rung::Searched },
        Found::Open(bounds, simplex) => (Some(bounds), simplex),
        Found::Inside(simplex) => (None, simplex),
    };
    let width = |b: &Bounds<R>| upper_bound(pair, b) - b.lower;
    let (deep, core) = overlap(pair, &simplex, gap, steps, accuracy);
    match apart {
        Some(bounds) if width(&bounds) <= width(&deep) => {
            Outcome { bounds, core: Enclosing::Nothing, rung: Rung::Searched }
        }
        _ => Outcome { bounds: deep, core, rung: Rung::Searched },
    }
}

/// The depth of the cores: of bodies of revolution about one axis in the plane, of others in space.
fn overlap<R: Workshop>(
    pair: &impl Difference<R>,
    simplex: &Simplex<R>,
    gap: f64,
    steps: &mut u32,
    accuracy: Accuracy,
) -> (Bounds<R>, Enclosing) {
    let (axis, enough) = (pair.axis(), is_known_inside(pair, accuracy));
    if let Some(axis) = axis.filter(|axis| axis.comes_first(pair))
        && let Some(bounds) = meridian::depth(pair, &axis, R::from(gap), steps, &enough)
    {
        return (bounds, Enclosing::Nothing);
    }
    depth::depth(pair, simplex, gap, steps, enough)
}

/// The upper bound that holds, but for the pair's error: a ball around the origin is proved only where its
/// radius exceeds the error.
#[inline]
fn upper_bound<R: Real>(pair: &impl Difference<R>, found: &Bounds<R>) -> R {
    if found.upper < -R::from(pair.error(0.0)) { found.upper } else { found.point.norm() }
}

/// What a rung proved of the cores, as points and features.
fn join<R: Real>(pair: &impl Difference<R>, found: &Bounds<R>) -> Joined<R> {
    let simplex = &found.simplex;
    let first = simplex.ids[0][0];
    let on_a = if simplex.ids[..simplex.count].iter().all(|ids| ids[0] == first) {
        pair.point_a(first)
    } else {
        let weighted = |k: usize| pair.point_a(simplex.ids[k][0]).scaled(simplex.weights[k]);
        (1..simplex.count).fold(weighted(0), |sum, k| sum + weighted(k))
    };
    Joined {
        on_a,
        point: found.point,
        normal: found.normal,
        lower: found.lower,
        upper: upper_bound(pair, found),
        features: pair.features(simplex, &found.normal),
    }
}

/// The answer in the world, with its interval.
#[inline]
fn describe<R: Real>(
    pair: &impl Difference<R>,
    found: &Joined<R>,
    views: [&View<'_>; 2],
    center: &Vector3,
    accuracy: Accuracy,
    steps: u32,
    rung: Rung,
) -> ClosestFeatures {
    // the interval of the cores
    let upper = found.upper;
    let bound = pair.error(if found.lower > R::from(0.0) { upper } else { found.lower }.to_f64());
    let error = R::from(bound);
    let rounding: R = radii(views);
    let (lower, upper) = outward(found.lower - rounding - error, upper - rounding + error);
    let floor = 2.0 * bound + CERTIFICATE_SLACK * pair.size();
    // what a rung could do better leads to the next; the last is held to what is promised, and what it sees within
    // rounding of one place, as points that meet far from the origin, to the rounding of that on either side
    let floor = if rung == Rung::DoubleDouble { floor.max(pair.promise()).max(4.0 * bound) } else { floor };
    let certified = is_certified(lower, upper, accuracy, floor, pair.size());

    // both points, joined by the same vector that the distance is taken from
    let normal = found.normal.to_vector();
    let core_a = center + found.on_a.to_vector();
    let core_b = core_a + found.point.to_vector();
    let [feature_a, feature_b] = found.features;

    // the points are right to the gap at which a search ends, and the interval may be narrower
    let along = (found.normal.dot(&found.point) - rounding).to_f64();
    let signed_distance = along.max(lower).min(upper);
    let off = (along - signed_distance).abs();
    debug_assert!(off <= SEARCH_GAP * pair.size(), "{along:e} in {lower:e}..{upper:e}");
    ClosestFeatures {
        signed_distance,
        lower,
        upper,
        state: state(lower, upper),
        point_a: if views[0].rounding > 0.0 { core_a + views[0].rounding * normal } else { core_a },
        point_b: if views[1].rounding > 0.0 { core_b - views[1].rounding * normal } else { core_b },
        normal,
        feature_a: views[0].names.name(feature_a),
        feature_b: views[1].names.name(feature_b),
        part_a: 0,
        part_b: 0,
        steps,
        rung,
        certified,
    }
}

/// What an interval says.
#[inline]
pub(super) fn state(lower: f64, upper: f64) -> State {
    if lower > 0.0 {
        State::Separated
    } else if upper < 0.0 {
        State::Overlapping
    } else {
        State::Touching
    }
}

/// Whether an interval is as narrow as was asked for; `floor` is the width that counts as exact [m].
#[inline]
pub(super) fn is_certified(lower: f64, upper: f64, accuracy: Accuracy, floor: f64, size: f64) -> bool {
    match accuracy {
        Accuracy::Exact => upper - lower <= floor,
        Accuracy::Relative(r) => upper - lower <= floor.max(r * size),
        Accuracy::YesNo => state(lower, upper) != State::Touching || upper - lower <= floor,
    }
}

/// Both bounds as `f64`, rounded outwards.
#[inline]
pub(super) fn outward<R: Real>(lower: R, upper: R) -> (f64, f64) {
    let (l, u) = (lower.to_f64(), upper.to_f64());
    (if R::from(l) > lower { l.next_down() } else { l }, if R::from(u) < upper { u.next_up() } else { u })
}
