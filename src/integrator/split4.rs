//! [`Split2`](super::Method::Split2) composed to order 4 with Suzuki's five steps (1990, Phys. Lett. A 146:319).
//!
//! ```text
//! γ₁ = γ₂ = γ₄ = γ₅ = 1/(4 − 4^(1/3))        γ₃ = 1 − 4γ₁
//! ```

use super::splitting::splitting_kernel;
use crate::freedom::RotationSplit;

pub(super) const ORDER: u32 = 4;
pub(super) const EVALUATIONS: u32 = 6;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 0.0;

splitting_kernel!(RotationSplit::Symmetric, &GAMMAS);

#[rustfmt::skip]
const GAMMAS: [f64; 5] = [
    0.41449077179437573714, 0.41449077179437573714, -0.65796308717750294857, 0.41449077179437573714, 0.41449077179437573714,
];
