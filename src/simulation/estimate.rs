//! The error of a result, by comparing two runs of it.

use crate::math::quaternion;
use crate::state::BodyState;
use crate::trajectory::Trajectory;

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
        let (pairs, complete) = common_samples(fine, coarse);
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
            comparison.horizon = comparison.horizon.min(fine.times()[pairs.len().saturating_sub(1)]);
        }
        comparison
    }
}

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
        let start = run.states(0)[index].position;
        let path = (0..run.times().len()).map(|s| (run.states(s)[index].position - start).norm());
        scale = path.fold(scale.max(body.radius), f64::max);
    }
    if scale > 0.0 { scale } else { 1.0 }
}
