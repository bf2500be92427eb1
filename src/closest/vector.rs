//! Vectors of three numbers of either precision.

use std::ops::{Add, Neg, Sub};

use crate::math::Vector3;
use crate::math::double_double::Real;

/// Three components, world or body axes as the name of the value says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vec3<R>(pub(super) [R; 3]);

impl<R: Real> Vec3<R> {
    #[inline]
    pub(super) fn new(v: [f64; 3]) -> Self {
        Self(v.map(R::from))
    }

    pub(super) fn zero() -> Self {
        Self::new([0.0; 3])
    }

    #[inline]
    pub(super) fn dot(&self, o: &Self) -> R {
        self.0[0] * o.0[0] + self.0[1] * o.0[1] + self.0[2] * o.0[2]
    }

    #[inline]
    pub(super) fn cross(&self, o: &Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, o.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    #[inline]
    pub(super) fn scaled(&self, k: R) -> Self {
        Self([self.0[0] * k, self.0[1] * k, self.0[2] * k])
    }

    #[inline]
    pub(super) fn norm_squared(&self) -> R {
        self.dot(self)
    }

    #[inline]
    pub(super) fn norm(&self) -> R {
        self.norm_squared().sqrt()
    }

    #[inline]
    pub(super) fn to_f64(self) -> [f64; 3] {
        self.0.map(R::to_f64)
    }

    pub(super) fn to_vector(self) -> Vector3 {
        self.to_f64().into()
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;

    #[inline]
    fn add(self, o: Self) -> Self {
        Self([self.0[0] + o.0[0], self.0[1] + o.0[1], self.0[2] + o.0[2]])
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;

    #[inline]
    fn sub(self, o: Self) -> Self {
        Self([self.0[0] - o.0[0], self.0[1] - o.0[1], self.0[2] - o.0[2]])
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self([-self.0[0], -self.0[1], -self.0[2]])
    }
}
