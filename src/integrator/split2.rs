//! Symmetric top and rest (Touma, Wisdom 1994, Astron. J. 107:1189; Dullweber, Leimkuhler and others 1997,
//! J. Chem. Phys. 107:5840).
//!
//! ```text
//! H = ½ a |L|² + ½ (1/I_k − a) L_k²  +  ½ (1/I_i − a) L_i²        a = 1/I_j, |1/I_i − 1/I_j| least
//!     a symmetric top: two rotations     a rotation about axis i
//! ```
//!
//! Order 2; exact for a body with two equal moments. |L| is kept, the energy swings but does not drift.
//! Less accurate per digit than [`Dop853`](super::Method::Dop853) over short times; it wins over long ones.

use super::splitting::splitting_kernel;
use crate::freedom::RotationSplit;

pub(super) const ORDER: u32 = 2;
pub(super) const EVALUATIONS: u32 = 2;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 0.0;

splitting_kernel!(RotationSplit::Symmetric, &[1.0]);
