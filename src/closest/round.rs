//! Curved convex bodies by their supports: how far each reaches along a direction, and where.
//!
//! ```text
//! cylinder   h(d) = r √(d_x² + d_y²) + h |d_z|
//! cone       h(d) = max( h d_z,  r √(d_x² + d_y²) − h d_z )       apex, rim
//! ellipsoid  h(d) = √( (a d_x)² + (b d_y)² + (c d_z)² )
//! ```
//!
//! In the shape's axes, origin in its middle; `d` need not be of unit length. Each point given lies on
//! the body to `4 u` of its radius, each height is right to `5 u` of it (`u = ε/2`).

use super::answer::Feature;
use super::vector::Vec3;
use crate::math::double_double::Real;
use crate::tolerance::FEATURE_ANGLE;

/// A curved body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Round {
    Cylinder { radius: f64, half_height: f64 },
    Cone { radius: f64, half_height: f64 },
    Ellipsoid { semi_axes: [f64; 3] },
}

impl Round {
    /// Radius of the ball about the origin that holds the body [m].
    pub(super) fn reach(&self) -> f64 {
        match *self {
            Self::Cylinder { radius, half_height } | Self::Cone { radius, half_height } => {
                libm::hypot(radius, half_height)
            }
            Self::Ellipsoid { semi_axes: [a, b, c] } => a.max(b).max(c),
        }
    }

    /// The unit vector that it is of revolution about, if it is.
    pub(super) fn axis(&self) -> Option<[f64; 3]> {
        match *self {
            Self::Cylinder { .. } | Self::Cone { .. } => Some([0.0, 0.0, 1.0]),
            Self::Ellipsoid { semi_axes: [a, b, _] } if a == b => Some([0.0, 0.0, 1.0]),
            Self::Ellipsoid { semi_axes: [a, _, c] } if a == c => Some([0.0, 1.0, 0.0]),
            Self::Ellipsoid { semi_axes: [_, b, c] } if b == c => Some([1.0, 0.0, 0.0]),
            Self::Ellipsoid { .. } => None,
        }
    }

    /// A point farthest along `d` and how far it reaches, `d · p`.
    pub(super) fn support<R: Real>(&self, d: &Vec3<R>) -> (Vec3<R>, R) {
        let (zero, one) = (R::from(0.0), R::from(1.0));
        let Vec3([x, y, z]) = *d;
        match *self {
            Self::Cylinder { radius, half_height } => {
                let (r, h) = (R::from(radius), R::from(half_height));
                let (across, rim) = rim(r, x, y);
                let (level, rise) = if z < zero { (-h, -z) } else { (h, z) };
                (Vec3([rim[0], rim[1], level]), r * across + h * rise)
            }
            Self::Cone { radius, half_height } => {
                let (r, h) = (R::from(radius), R::from(half_height));
                let (across, rim) = rim(r, x, y);
                let (top, bottom) = (h * z, r * across - h * z);
                if top > bottom { (Vec3([zero, zero, h]), top) } else { (Vec3([rim[0], rim[1], -h]), bottom) }
            }
            Self::Ellipsoid { semi_axes } => {
                let axes = semi_axes.map(R::from);
                let scaled = [axes[0] * x, axes[1] * y, axes[2] * z];
                let reach = Vec3(scaled).norm();
                if reach == zero {
                    return (Vec3([zero; 3]), zero);
                }
                let k = one / reach;
                (Vec3([0, 1, 2].map(|i| axes[i] * (scaled[i] * k))), reach)
            }
        }
    }

    /// Direction of the straight line on the side that faces along `d`; none of an ellipsoid.
    pub(super) fn ruling(&self, d: [f64; 3]) -> Option<[f64; 3]> {
        match *self {
            Self::Cylinder { .. } => Some([0.0, 0.0, 1.0]),
            Self::Cone { radius, half_height } => {
                let (across, length) = (libm::hypot(d[0], d[1]), libm::hypot(radius, 2.0 * half_height));
                let inward = -radius / (across * length);
                (across > 0.0).then_some([inward * d[0], inward * d[1], 2.0 * half_height / length])
            }
            Self::Ellipsoid { .. } => None,
        }
    }

    /// The feature whose outward normals point along the unit vector `d`.
    pub(super) fn feature(&self, d: [f64; 3]) -> Feature {
        let across = libm::hypot(d[0], d[1]);
        match *self {
            Self::Cylinder { .. } if across <= FEATURE_ANGLE => Feature::Face(u32::from(d[2] > 0.0)),
            Self::Cylinder { .. } if d[2].abs() <= FEATURE_ANGLE => Feature::Surface(0),
            Self::Cylinder { .. } => Feature::Edge(u32::from(d[2] > 0.0)),
            Self::Cone { .. } if across <= FEATURE_ANGLE && d[2] < 0.0 => Feature::Face(0),
            Self::Cone { radius, half_height } => {
                // the side's normal stands across the line from rim to apex
                let (up, out) = (2.0 * half_height, radius);
                let side = (up * d[2] - out * across) / libm::hypot(up, out);
                if side > FEATURE_ANGLE {
                    Feature::Vertex(0)
                } else if side < -FEATURE_ANGLE {
                    Feature::Edge(0)
                } else {
                    Feature::Surface(0)
                }
            }
            Self::Ellipsoid { .. } => Feature::Surface(0),
        }
    }
}

/// The length of `(x, y)`, and the point at distance `r` along it; of nothing the middle.
fn rim<R: Real>(r: R, x: R, y: R) -> (R, [R; 2]) {
    let across = (x * x + y * y).sqrt();
    if across == R::from(0.0) {
        return (across, [across; 2]);
    }
    let k = r / across;
    (across, [x * k, y * k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::double_double::DoubleDouble;

    const ALL: [Round; 3] = [
        Round::Cylinder { radius: 0.7, half_height: 1.3 },
        Round::Cone { radius: 0.7, half_height: 1.3 },
        Round::Ellipsoid { semi_axes: [0.3, 1.1, 0.8] },
    ];

    fn directions() -> impl Iterator<Item = [f64; 3]> {
        let grid = |k: i32| f64::from(k) / 4.0;
        (-4..=4).flat_map(move |i| (-4..=4).flat_map(move |j| (-4..=4).map(move |k| [grid(i), grid(j), grid(k)])))
    }

    #[test]
    fn the_support_lies_on_the_body_and_no_other_point_reaches_farther() {
        let points: Vec<[Vec3<f64>; 3]> = directions().map(|d| ALL.map(|body| body.support(&Vec3(d)).0)).collect();
        for d in directions() {
            for (k, body) in ALL.iter().enumerate() {
                let (p, height) = body.support(&Vec3(d));
                assert!((p.dot(&Vec3(d)) - height).abs() <= 8.0 * f64::EPSILON * body.reach(), "{body:?} {d:?}");
                let [x, y, z] = p.0;
                let inside = match *body {
                    Round::Cylinder { radius, half_height } => (libm::hypot(x, y) - radius).max(z.abs() - half_height),
                    Round::Cone { radius, half_height } => {
                        (libm::hypot(x, y) - radius * (0.5 - 0.5 * z / half_height)).max(z.abs() - half_height)
                    }
                    Round::Ellipsoid { semi_axes: [a, b, c] } => {
                        libm::sqrt((x / a) * (x / a) + (y / b) * (y / b) + (z / c) * (z / c)) - 1.0
                    }
                };
                assert!(inside <= 4.0 * f64::EPSILON, "{body:?} {d:?} {p:?} {inside:e}");
                for other in &points {
                    assert!(other[k].dot(&Vec3(d)) <= height + 8.0 * f64::EPSILON, "{body:?} {d:?}");
                }
                let (_, precise) = body.support(&Vec3::<DoubleDouble>::new(d));
                assert!((precise.to_f64() - height).abs() <= 2.5 * f64::EPSILON * body.reach() * 1.8, "{body:?} {d:?}");
            }
        }
    }

    #[test]
    fn a_ruling_lies_on_the_side_and_across_its_normal() {
        let [cylinder, cone, ellipsoid] = ALL;
        assert_eq!(cylinder.ruling([0.6, 0.8, 0.0]), Some([0.0, 0.0, 1.0]));
        assert_eq!(ellipsoid.ruling([0.6, 0.8, 0.0]), None);
        assert_eq!(cone.ruling([0.0, 0.0, 1.0]), None);
        // from the rim at (0.7, 0, −1.3) to the apex at (0, 0, 1.3); the side's normal stands across it
        let length = libm::hypot(2.6, 0.7);
        let line = cone.ruling([2.6 / length, 0.0, 0.7 / length]).unwrap();
        assert!((Vec3(line) - Vec3([-0.7 / length, 0.0, 2.6 / length])).norm() <= 2.0 * f64::EPSILON, "{line:?}");
        assert!(Vec3(line).dot(&Vec3([2.6 / length, 0.0, 0.7 / length])).abs() <= 2.0 * f64::EPSILON);
    }

    #[test]
    fn features_follow_the_normal() {
        let [cylinder, cone, _] = ALL;
        assert_eq!(cylinder.feature([0.0, 0.0, 1.0]), Feature::Face(1));
        assert_eq!(cylinder.feature([0.0, 0.0, -1.0]), Feature::Face(0));
        assert_eq!(cylinder.feature([0.6, 0.8, 0.0]), Feature::Surface(0));
        assert_eq!(cylinder.feature([0.6, 0.0, -0.8]), Feature::Edge(0));
        assert_eq!(cone.feature([0.0, 0.0, 1.0]), Feature::Vertex(0));
        assert_eq!(cone.feature([0.0, 0.0, -1.0]), Feature::Face(0));
        assert_eq!(cone.feature([0.8, 0.0, -0.6]), Feature::Edge(0));
        let length = libm::hypot(2.6, 0.7);
        assert_eq!(cone.feature([2.6 / length, 0.0, 0.7 / length]), Feature::Surface(0));
    }
}
