//! A body against a half space: the one direction that counts is the plane's.
//!
//! ```text
//! signed distance = n · (x_B − x_A) − d − h_B(−n)        n = R_A n₀,  half space n₀ · x ≤ d
//! ```
//!
//! with `h_B` the support of the body about its centre `x_B`: closed form, in every state.

use super::answer::{Accuracy, ClosestFeatures, Feature, Rung};
use super::climb::{is_certified, outward, state};
use super::collider::{Core, View};
use super::pair::{Heights, Measure, OFF_CENTER_UNITS, Stand, error_of_distance, from_to};
use super::rotation::{rotate, rotate_back};
use super::round_pair::ROUND_UNITS;
use super::vector::Vec3;
use crate::error::{Error, Result};
use crate::math::Pose;
use crate::shape::HalfSpace;
use crate::tolerance::{CERTIFICATE_SLACK, COORDINATE_MAX};

/// What the plane's own normal costs, in units `u` times the radius and the distance of the centres and
/// of the plane [-]: 4.5 for the division by its length, 5.5 for its rotation.
const PLANE_UNITS: f64 = 10.0;
/// Where the plane's origin is farther from the body than this many radii [-], the heights are taken in
/// double-double: their rounding would be that of the distance, not of the body.
const FAR: f64 = 16.0;

/// The same half space with a normal whose largest entry is about 1: scaled by a power of two, so that
/// nothing is rounded.
pub(super) fn scaled(half_space: &HalfSpace, place: &str) -> Result<HalfSpace> {
    let largest = half_space.normal.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let (_, exponent) = libm::frexp(largest);
    let scale = |x: f64| libm::scalbn(x, -exponent);
    let scaled = HalfSpace { normal: half_space.normal.map(scale), offset: scale(half_space.offset) };
    if scaled.offset.abs() > COORDINATE_MAX {
        return Err(Error::value(place, "offset", "within 1e30 m of the origin", half_space.offset));
    }
    Ok(scaled)
}

/// A body B against the half space A.
pub(super) fn below(
    (plane, view_a, pose_a): (&HalfSpace, &View<'_>, &Pose),
    (core, view_b, pose_b): (Core<'_>, &View<'_>, &Pose),
    accuracy: Accuracy,
) -> ClosestFeatures {
    let (at_a, at_b) = (view_a.stand(pose_a), view_b.stand(pose_b));
    let (between, remote) = from_to(&at_a, [0.0; 3], &at_b, core.center());
    let distance = Vec3(between.to_f64()).norm() + plane.offset.abs() / Vec3::<f64>(plane.normal).norm();
    if distance <= FAR * (core.reach() + view_b.rounding) {
        let between = Vec3(between.to_f64());
        answer(plane, &at_a, core, (view_b, &at_b), between, distance, remote, Rung::Searched, accuracy)
    } else {
        answer(plane, &at_a, core, (view_b, &at_b), between, distance, remote, Rung::DoubleDouble, accuracy)
    }
}

#[expect(clippy::too_many_arguments, reason = "one call in either precision")]
fn answer<R: Heights>(
    plane: &HalfSpace,
    at_a: &Stand<'_>,
    core: Core<'_>,
    (view_b, at_b): (&View<'_>, &Stand<'_>),
    between: Vec3<R>,
    distance: f64,
    remote: f64,
    rung: Rung,
    accuracy: Accuracy,
) -> ClosestFeatures {
    // the plane in the world
    let given = Vec3::<R>::new(plane.normal);
    let length = given.norm();
    let n = rotate(&at_a.rows(), &given.scaled(R::from(1.0) / length));
    let offset = R::from(plane.offset) / length;

    // the lowest point of B
    let rows = at_b.rows::<R>();
    let down = -rotate_back(&rows, &n);
    let (point, height, vertex) = core.farthest(&down, None);
    let rounding = R::from(view_b.rounding);
    let signed_distance = n.dot(&between) - offset - height - rounding;

    let Measure { size, error } =
        Measure::new(R::COST, core.reach(), distance, [at_a, at_b], ROUND_UNITS + OFF_CENTER_UNITS);
    let error = error + R::COST * PLANE_UNITS * (core.reach() + distance) + remote;
    let error = error + error_of_distance::<R>(signed_distance.to_f64());
    let (lower, upper) = outward(signed_distance - R::from(error), signed_distance + R::from(error));
    let signed_distance = signed_distance.to_f64();
    let normal = n.to_vector();
    let point_b = at_b.point(core.center()) + rotate(&rows, &point).to_vector() - view_b.rounding * normal;
    ClosestFeatures {
        signed_distance,
        lower,
        upper,
        state: state(lower, upper),
        point_a: point_b - signed_distance * normal,
        point_b,
        normal,
        feature_a: Feature::Face(0),
        feature_b: view_b.names.name(core.feature(&[[vertex; 2]], 1, || down.to_f64())),
        part_a: 0,
        part_b: 0,
        steps: 1,
        rung,
        certified: is_certified(lower, upper, accuracy, 2.0 * error + CERTIFICATE_SLACK * size, size),
    }
}
