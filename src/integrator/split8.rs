//! [`Split2`](super::Method::Split2) composed to order 8 with the seventeen steps of Kahan and Li (1997, Math.
//! Comp. 66:1089; Hairer, Lubich, Wanner, Geometric Numerical Integration, §V.3). It needs loads that do not
//! depend on velocities.

use super::splitting::splitting_kernel;
use crate::freedom::RotationSplit;

pub(super) const ORDER: u32 = 8;
pub(super) const EVALUATIONS: u32 = 18;
pub(super) const BODY_AXES: bool = true;
pub(super) const ERROR_ORDER: f64 = 0.0;

splitting_kernel!(RotationSplit::Symmetric, &GAMMAS);

#[rustfmt::skip]
const GAMMAS: [f64; 17] = [
    0.13020248308889008087881763, 0.56116298177510838456196441, -0.38947496264484728640807860,
    0.15884190655515560089621075, -0.39590389413323757733623154, 0.18453964097831570709183254,
    0.25837438768632204729397911, 0.29501172360931029887096624, -0.60550853383003451169892108,
    0.29501172360931029887096624, 0.25837438768632204729397911, 0.18453964097831570709183254,
    -0.39590389413323757733623154, 0.15884190655515560089621075, -0.38947496264484728640807860,
    0.56116298177510838456196441, 0.13020248308889008087881763,
];
