//! The error of a result, by comparing two runs of it.

use crate::math::quaternion;
use crate::state::BodyState;
use crate::trajectory::{Event, EventKind, Trajectory};

/// Two runs of one scene, one finer than the other.
///
/// ```text
/// error of the finer run ≈ |fine − coarse| / (gain − 1) + rounding        gain = coarse error/fine error (Richardson)
/// ```
///
/// The formula holds where both runs are fine enough for the error to fall as the gain says. Where
/// they are not, the difference is large and the formula errs on either side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Comparison {
    /// Largest estimated error over all samples and bodies [-].
    pub(super) worst: f64,
    /// The same over the samples up to the horizon.
    pub(super) within_horizon: f64,
    /// The last sample up to which the estimate is within the tolerance [s].
    pub(super) horizon: f64,
}

impl Comparison {
    pub(super) fn new(
        fine: &Trajectory,
        coarse: &Trajectory,
        gain: f64,
        rounding: f64,
        tolerance: Option<f64>,
    ) -> Self {
        let divisor = gain - 1.0;
        let tolerance = tolerance.unwrap_or(f64::INFINITY);
        let mut comparison = Self { worst: 0.0, within_horizon: 0.0, horizon: fine.end() };
        let until = first_mismatch(fine, coarse);
        let (mut pairs, complete) = common_samples(fine, coarse);
        let known = pairs.len();
        pairs.retain(|&(sample, _)| fine.times()[sample] < until);
        let complete = complete && pairs.len() == known;
        let mut lost = !complete;
        for &(sample, other) in &pairs {
            let error =
                difference(fine.states(sample), coarse.states(other), fine.report().length_scale) / divisor + rounding;
            comparison.worst = comparison.worst.max(error);
            if error > tolerance && !lost {
                lost = true;
                comparison.horizon = fine.times()[sample.saturating_sub(1)];
            } else if !lost || comparison.worst <= tolerance {
                comparison.within_horizon = comparison.worst;
            }
        }
        if !complete {
            comparison.worst = f64::INFINITY;
            let last = fine.times().get(pairs.len().saturating_sub(1)).copied();
            comparison.horizon = comparison.horizon.min(last.unwrap_or(f64::NEG_INFINITY));
        }
        comparison
    }

    /// What both comparisons of a run allow to be said.
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            worst: self.worst.max(other.worst),
            within_horizon: self.within_horizon.max(other.within_horizon),
            horizon: self.horizon.min(other.horizon),
        }
    }
}

/// The time from which on two runs tell different stories [s]: the first bounce of a pair that is not among
/// the bounces of that pair in the other run, or a pair that comes to rest in one only; infinity if there is none.
///
/// Bounces are counted pair by pair. The last and smallest of a series may be there in one run and not in the
/// other; they move no body farther than the comparison of the samples shows.
fn first_mismatch(fine: &Trajectory, coarse: &Trajectory) -> f64 {
    let jump = |event: &Event| {
        let [v, w] = [event.velocity, event.other_velocity].map(|v| (v[1] - v[0]).norm());
        v.max(w)
    };
    let largest = fine.events().iter().chain(coarse.events()).map(jump).fold(0.0, f64::max);
    let end = fine.end().min(coarse.end());
    let mut pairs: Vec<[usize; 2]> = fine.events().iter().chain(coarse.events()).map(|e| e.bodies).collect();
    pairs.sort_unstable();
    pairs.dedup();
    let mut first = f64::INFINITY;
    for pair in pairs {
        // what comes off in one run only
        let breaks = |run: &Trajectory| -> Vec<f64> {
            let own = run.events().iter().filter(|e| e.bodies == pair && e.kind == EventKind::Break && e.time <= end);
            own.map(|e| e.time).collect()
        };
        let (a, b) = (breaks(fine), breaks(coarse));
        first = a.get(b.len()).or(b.get(a.len())).map_or(first, |time| first.min(*time));

        let of = |run: &Trajectory| -> Vec<(f64, f64)> {
            let own = run.events().iter().filter(|e| e.bodies == pair && e.kind == EventKind::Bounce && e.time <= end);
            own.map(|e| (e.time, jump(e))).filter(|(_, jump)| *jump > SMALLEST * largest).collect()
        };
        let (a, b) = (of(fine), of(coarse));
        let (mut i, mut j) = (0, 0);
        while i < a.len() || j < b.len() {
            // two bounces go together where their jumps are alike
            let alike = |x: f64, y: f64| (x - y).abs() <= ALIKE * x.max(y);
            match (a.get(i), b.get(j)) {
                (Some(x), Some(y)) if alike(x.1, y.1) => (i, j) = (i + 1, j + 1),
                (Some(x), _) if x.1 < EDGE * SMALLEST * largest => i += 1,
                (_, Some(y)) if y.1 < EDGE * SMALLEST * largest => j += 1,
                (x, y) => {
                    first = [x, y].into_iter().flatten().map(|bounce| bounce.0).fold(first, f64::min);
                    break;
                }
            }
        }
    }
    first
}

/// Jump of a velocity below which a bounce is not looked for in the other run, as a part of the largest [-].
const SMALLEST: f64 = 1.0e-3;
/// How much larger a bounce must be to be missed in the other run [-]: at the limit it may be on either side.
const EDGE: f64 = 2.0;
/// How far the jumps of a bounce in two runs may differ for it to be the same [-].
const ALIKE: f64 = 0.1;

/// The samples that two runs have in common, and whether these are all. Where the same event ended both, the last
/// samples are those of the event, each at its own time: the error of that time is part of the error there.
fn common_samples(fine: &Trajectory, coarse: &Trajectory) -> (Vec<(usize, usize)>, bool) {
    let [n, m] = [fine, coarse].map(|run| run.times().len());
    let alike = fine.ended_by() == coarse.ended_by();
    if fine.ended_by().is_none() || !alike {
        let common = n.min(m) - usize::from(!alike).min(n.min(m));
        return ((0..common).map(|i| (i, i)).collect(), alike && common == n);
    }
    let before = (n - 1).min(m - 1);
    ((0..before).map(|i| (i, i)).chain([(n - 1, m - 1)]).collect(), true)
}

/// Largest difference between the states of a scene's bodies [-]: of positions over `scale` [m], of
/// orientations in radians.
pub(crate) fn difference(a: &[BodyState], b: &[BodyState], scale: f64) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| {
            let place = (a.position - b.position).norm() / scale;
            place.max(quaternion::angle_between(&a.orientation, &b.orientation))
        })
        .fold(0.0, f64::max)
}

/// The length that position errors are measured by [m]: the larger of the largest body and the
/// largest extent of a path, unless the options name one.
pub(crate) fn length_scale(run: &Trajectory) -> f64 {
    if let Some(given) = run.plan().options().length_scale {
        return given;
    }
    let mut scale = 0.0_f64;
    for (index, body) in run.plan().bodies().iter().enumerate().filter(|(_, body)| !body.fixed) {
        let start = body.start.position;
        let path = (0..run.times().len()).map(|s| (run.states(s)[index].position - start).norm());
        scale = path.fold(scale.max(body.radius), f64::max);
    }
    if scale > 0.0 { scale } else { 1.0 }
}
