//! Every tolerance of the crate, with its unit, its reason and what follows from changing it.

/// How far a given quaternion's length may be from 1 [-]. Orientations are typed by people with a
/// few digits; what lies within is divided by its length, what lies outside is refused as a mistake.
pub const QUATERNION_LENGTH: f64 = 1.0e-3;
