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
