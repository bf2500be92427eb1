//! Vectors of three numbers, as polyhedra store them.

use crate::math::double_double::{DoubleDouble, Real};

#[inline]
pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn sub(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn add(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The length, also where the squares would underflow.
pub(super) fn norm(a: &[f64; 3]) -> f64 {
    let square = dot(a, a);
    if square >= f64::MIN_POSITIVE / f64::EPSILON {
        return square.sqrt();
    }
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    let scaled = a.map(|x| x / largest);
    largest * dot(&scaled, &scaled).sqrt()
}

/// Twice the area of a triangle along its normal. The corners are taken apart in double-double: of a
/// sliver, whose sides are all but parallel, the product in `f64` would lose the normal.
pub(super) fn area_vector(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> [f64; 3] {
    let (u, v) = (from_to(a, b), from_to(a, c));
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        (u[i] * v[j] - u[j] * v[i]).to_f64()
    })
}

fn from_to(a: &[f64; 3], b: &[f64; 3]) -> [DoubleDouble; 3] {
    std::array::from_fn(|k| DoubleDouble::sum(b[k], -a[k]))
}

/// The unit vector along `a`; of the zero vector the z axis.
pub(super) fn unit(a: &[f64; 3]) -> [f64; 3] {
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let scaled = a.map(|x| x / largest); // areas of tiny triangles would underflow when squared
    let length = norm(&scaled);
    scaled.map(|x| x / length)
}
