//! Every tolerance of the crate, with its unit, its reason and what follows from changing it.

/// How far a given quaternion's length may be from 1 [-]. Orientations are typed by people with a
/// few digits; what lies within is divided by its length, what lies outside is refused as a mistake.
pub const QUATERNION_LENGTH: f64 = 1.0e-3;

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
pub const CERTIFICATE_SLACK: f64 = 6.0 * f64::EPSILON;

/// Gap between the bounds of the distance at which the search in `f64` stops, as a fraction of the
/// pair's size [-]. Larger: earlier stops, wider intervals. Smaller: the search runs into rounding.
pub const SEARCH_GAP: f64 = 2.0 * f64::EPSILON;
