//! [`Split2`](super::Method::Split2) composed to order 6 with the nine steps of Kahan and Li (1997, Math.
//! Comp. 66:1089; Hairer, Lubich, Wanner, Geometric Numerical Integration, §V.3). It needs loads that do not
//! depend on velocities.

use super::splitting::splitting_kernel;
use crate::freedom::RotationSplit;

pub(super) const ORDER: u32 = 6;
pub(super) const EVALUATIONS: u32 = 10;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 0.0;

splitting_kernel!(RotationSplit::Symmetric, &GAMMAS);

#[rustfmt::skip]
const GAMMAS: [f64; 9] = [
    0.39216144400731413927925056, 0.33259913678935943859974864, -0.70624617255763935980996482,
    0.08221359629355080023149045, 0.79854399093482996339895035, 0.08221359629355080023149045,
    -0.70624617255763935980996482, 0.33259913678935943859974864, 0.39216144400731413927925056,
];
