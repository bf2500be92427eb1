//! The lecture's mathematics: rotations, quaternions, and sums that keep what rounding drops.
//!
//! | file | lecture | holds |
//! |---|---|---|
//! | [`rotation`] | (1)–(8) | elementary rotations, the matrix Ω(ω), the polar factor |
//! | [`quaternion`] | (25)–(29) | product, rate, matrix and back, exponential map |
//! | [`decay`] | – | functions of exponential decay |
//! | [`double_double`] | – | numbers of twice the digits, for sums that cancel |
//! | [`elliptic`] | – | elliptic integrals and functions of Jacobi |
//! | [`pose`] | §1 | where a body frame stands in the world |
//! | [`roots`] | – | where a smooth function passes through 0 or touches it |
//! | `series` | – | power series of a motion in time |
//! | [`sum`] | – | time and sums with their rounding error kept |

pub mod decay;
pub mod double_double;
pub mod elliptic;
pub mod pose;
pub mod quaternion;
pub mod roots;
pub mod rotation;
pub(crate) mod series;
pub mod sum;

pub use pose::Pose;

/// A vector of three `f64`.
pub type Vector3 = nalgebra::Vector3<f64>;
/// A 3×3 matrix of `f64`.
pub type Matrix3 = nalgebra::Matrix3<f64>;
/// A quaternion `[s, v]` of `f64`; only one of unit length is a rotation.
pub type Quaternion = nalgebra::Quaternion<f64>;
