//! Every tolerance of the crate, with its unit, its reason and what follows from changing it.

/// How far a given quaternion's length may be from 1 [-]. Orientations are typed by people with a
/// few digits; what lies within is divided by its length, what lies outside is refused as a mistake.
pub const QUATERNION_LENGTH: f64 = 1.0e-3;

/// How far a velocity may leave the freedom of its body, relative to its size [-]. It allows for the
/// rounding of numbers worked out elsewhere; what lies within is dropped, what lies outside is refused.
pub const VELOCITY_FITS_FREEDOM: f64 = 1.0e-9;

/// How much longer than asked a step may be so that it ends on a hard stop [-]. Without it, rounding
/// leaves steps of 1e-16 s before stops that the steps should have met.
pub const STEP_REMAINDER: f64 = 1.0e-9;

/// Intervals that shrink one after the other before a user's event can be said to accumulate [-], and the last of
/// them as a part of the first [-]. Orbits that sink or oscillations that stiffen shorten theirs for thousands of
/// rounds, but not a million times. Larger: such a motion is stopped. Smaller: more steps are spent on a limit that
/// is never reached.
pub const EVENTS_SHRINKING: u32 = 16;
/// See [`EVENTS_SHRINKING`].
pub const EVENTS_ACCUMULATE: f64 = 1.0e-6;

/// How far a given inertia may be from symmetric, and how much its largest principal moment may
/// exceed the sum of the two others, as a fraction of the largest entry [-]. Turning a tensor leaves
/// 1e-15, a printout of ten digits 1e-10. What lies within is taken for rounding (the tensor is then
/// made symmetric by the mean); no mass distribution has what lies outside, and it is refused.
pub const INERTIA: f64 = 1.0e-9;

/// How far the vertices of a polygonal face may be from its plane, as a fraction of the
/// polyhedron's extent [-]. OBJ files printed to six digits stay within. The triangles from the
/// face's first vertex bound the solid, so a bent face moves the volume by that fraction at most;
/// what lies outside is refused, since then the fan's first vertex would matter.
pub const FACE_PLANARITY: f64 = 1.0e-5;

/// Volume, as a fraction of the bounding box's, below which a closed surface encloses none [-]. The
/// volume is summed to about 1e-30 of the box, so what lies above is not rounding.
pub const VOLUME: f64 = 1.0e-24;

/// ε of the impact search, as a fraction of the size of the body [-], never below the rounding of its
/// coordinates. Larger: bodies bounce early, by ε / speed. Smaller: the search ends as `Stalled`.
pub const IMPACT_GAP: f64 = 1.0e-12;

/// How far above the lowest a vertex may be to share its impact, as a fraction of the size of the body
/// [-]. It decides whether a landing counts as flat: a tilt below it does.
pub const TOUCH_GAP: f64 = 1.0e-9;

/// How far from one plane the vertices of a polygonal face may lie, as a fraction of the body's radius
/// [-]: the corners of a turned box, each rounded to `ε/2`, stray by a few ε. Larger: near-coplanar
/// facets become one face, and its features are reported for all of them. Smaller: a turned box falls
/// into triangles. Distances do not depend on it.
pub const FACE_FLATNESS: f64 = 8.0 * f64::EPSILON;

/// Largest coordinate of a polyhedron [m]: products of six coordinates stay far below overflow.
pub const COORDINATE_MAX: f64 = 1.0e30;

/// Smallest size of a polyhedron that is not a point [m]: exact signs of volumes stay above underflow.
pub const COORDINATE_MIN: f64 = 1.0e-30;

/// How far the bounds of an answer may be apart beyond what the rounding of the coordinates costs, as a
/// fraction of the pair's size [-]. Wider answers are repeated in double-double. Larger: fewer repeats,
/// wider intervals. Smaller: more repeats.
pub const CERTIFICATE_SLACK: f64 = 2.0 * f64::EPSILON;

/// Width of an interval, as a fraction of the pair's size [-], up to which an answer of the last rung counts as
/// certified: what is promised. A body 1e15 times as long as wide stops even the search in double-double a few ε
/// short of what its rounding would allow. Larger: more than promised passes. Smaller: such answers, which keep the
/// promise, are said not to.
pub const CERTIFICATE_WIDTH: f64 = 16.0 * f64::EPSILON;

/// The same where a body is curved [-], whose heights and points are rounded more: what `Accuracy::Exact` tells of
/// it. Larger and smaller: as there.
pub const CERTIFICATE_WIDTH_CURVED: f64 = 23.0 * f64::EPSILON;

/// Gap between the bounds of the distance at which the search in `f64` stops, as a fraction of the
/// pair's size [-]. Larger: earlier stops, wider intervals. Smaller: the search runs into rounding.
pub const SEARCH_GAP: f64 = 2.0 * f64::EPSILON;

/// How far a normal may be from that of a cap or a side for the answer to name the cap or the side, not
/// the rim between them [rad]. A search for the closest point of a curved body leaves its normal right
/// to about the square root of ε. Larger: tilted bodies are said to lie flat; distances do not depend
/// on it.
pub const FEATURE_ANGLE: f64 = 1.0e-7;
