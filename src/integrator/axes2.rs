//! Rotations about the three principal axes, one after another (Reich 1994, Physica D 76:375; Touma,
//! Wisdom 1994, Astron. J. 107:1189).
//!
//! ```text
//! H = L₁²/2I₁ + L₂²/2I₂ + L₃²/2I₃        flow(h) = φ₁(½h) φ₂(½h) φ₃(h) φ₂(½h) φ₁(½h)
//! ```
//!
//! Order 2, with the properties of [`Split2`](super::Method::Split2), but a larger error for bodies that are
//! almost symmetric, and one rotation more.

use super::splitting::splitting_kernel;
use crate::freedom::RotationSplit;

pub(super) const ORDER: u32 = 2;
pub(super) const EVALUATIONS: u32 = 2;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 0.0;

splitting_kernel!(RotationSplit::Axes, &[1.0]);
