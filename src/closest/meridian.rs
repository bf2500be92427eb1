//! How deep two bodies of revolution overlap whose axes are parallel: a question of the plane.
//!
//! Their difference is of revolution too, about the line through `t` along the common axis `z`. The plane
//! through that line and the origin cuts it in a convex region, and the depth in space is that in the
//! plane: a point of the ball of radius `d` about the origin, turned about the line into the plane,
//! comes no farther from the origin, so where the disc of radius `d` lies in the region, the ball lies in
//! the difference. In space a whole circle of ways out may be equally deep, and no number of triangles
//! proves that; in the plane a few sides do. A ball has any axis.
//!
//! Axes that are parallel but for an angle `tilt` move a point of B by `tilt · ρ_B` at most; that is added
//! to the upper bound.

use super::pair::{Difference, Ids};
use super::search::Bounds;
use super::simplex::Closest;
use super::vector::Vec3;
use crate::math::double_double::Real;

/// Sides of the inner polygon [-]: straight profiles need 4 to 10, ellipsoids some 60.
const SIDES: usize = 256;
/// What rounding does to the plane, the axis and the coordinates in it, in units of it times the size [-]:
/// 5.5 for the axis, 4 for the plane about it, 6 for two coordinates. Beside it stands the pair's error, in
/// `f64` about as much; in double-double both are nothing.
const PLANE_UNITS: f64 = 16.0;
/// Centres so near to the common axis, as a fraction of the size [-], leave a circle of ways out that are
/// about as deep: the plane is asked first. Larger: more overlaps take double-double.
const NEARLY_COAXIAL: f64 = 0.01;

/// The common axis of two bodies of revolution.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis<R> {
    /// Unit vector, world axes.
    pub(super) along: Vec3<R>,
    /// How far points of B may be from where they would be, were the axes parallel [m].
    pub(super) off: f64,
    /// Whether a body has no axis of its own.
    pub(super) is_any: bool,
}

impl<R: Real> Axis<R> {
    /// Whether the question of the plane is asked before that of space.
    pub(super) fn comes_first(&self, pair: &impl Difference<R>) -> bool {
        let (_, aside) = across(&pair.between(), &self.along);
        !self.is_any || aside.to_f64() <= NEARLY_COAXIAL * pair.size()
    }
}

/// A corner of the polygon: its vertices, and where it is across and along the axis [m].
#[derive(Debug, Clone, Copy)]
struct Corner<R> {
    ids: Ids,
    at: [R; 2],
}

/// Bounds of the negative depth, as [`super::depth`] gives them; none where the origin is not inside, or
/// rounding leaves nothing to prove.
pub(super) fn depth<R: Real>(
    pair: &impl Difference<R>,
    axis: &Axis<R>,
    gap: R,
    steps: &mut u32,
    enough: impl Fn(&Bounds<R>) -> bool,
) -> Option<Bounds<R>> {
    let zero = R::from(0.0);
    let (across, _) = across(&pair.between(), &axis.along);
    let off = R::from(axis.off + R::UNIT * PLANE_UNITS * pair.size());
    let direction = |n: [R; 2]| across.scaled(n[0]) + axis.along.scaled(n[1]);
    let corner = |ids: Ids| {
        let w = pair.difference(ids);
        Corner { ids, at: [w.dot(&across), w.dot(&axis.along)] }
    };

    // counterclockwise: the farthest points to all four sides
    let mut corners: Vec<Corner<R>> = Vec::with_capacity(16);
    for n in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
        let (ids, _) = pair.lowest(&-direction(n.map(R::from)), None);
        if corners.iter().all(|c| c.ids != ids) {
            corners.push(corner(ids));
        }
    }

    let mut best: Option<Bounds<R>> = None;
    while (3..SIDES).contains(&corners.len()) {
        *steps += 1;

        // the side nearest to the origin; all are as far
        let sides = (0..corners.len()).filter_map(|k| {
            let (p, q) = (corners[k].at, corners[(k + 1) % corners.len()].at);
            let n = [q[1] - p[1], p[0] - q[0]];
            let length = (n[0] * n[0] + n[1] * n[1]).sqrt();
            let n = n.map(|x| x / length);
            let height = |c: [R; 2]| n[0] * c[0] + n[1] * c[1];
            let distance = if height(p) < height(q) { height(p) } else { height(q) };
            (length > zero).then_some((k, n, distance))
        });
        let (k, n, distance) = sides.reduce(|best, x| if x.2 < best.2 { x } else { best })?;
        if distance <= off {
            return None;
        }

        // how far the difference reaches beyond it; until both meet, the point is the deepest along the
        // best direction
        let normal = -unit(&direction(n));
        let (ids, lower) = pair.lowest(&normal, Some(corners[k].ids));
        let (upper, closes) = (off - distance, -lower - distance <= gap);
        if closes || best.as_ref().is_none_or(|b| lower > b.lower) {
            let ends = [corners[k].ids, corners[(k + 1) % corners.len()].ids];
            let mut simplex = pair.simplex(if closes { &ends } else { std::slice::from_ref(&ids) });
            let point = match simplex.reduce() {
                Closest::At { point, .. } => point,
                Closest::Inside => simplex.point(),
            };
            best = Some(Bounds { simplex, point, normal, lower, upper });
        }
        if let Some(b) = &mut best {
            b.upper = upper;
            if closes || enough(b) {
                break;
            }
        }
        if corners.iter().any(|c| c.ids == ids) {
            break;
        }
        corners.insert(k + 1, corner(ids));
    }
    best
}

/// The unit vector across the axis in whose plane with it the centres are, and how far they are apart
/// there.
fn across<R: Real>(between: &Vec3<R>, along: &Vec3<R>) -> (Vec3<R>, R) {
    // taken off twice, for what is left may be little but rounding
    let less_along = |v: &Vec3<R>| *v - along.scaled(v.dot(along));
    let aside = less_along(between);
    let distance = aside.norm();
    let any = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| along.cross(&Vec3::new(e)));
    let longest = any.into_iter().reduce(|a, b| if b.norm_squared() > a.norm_squared() { b } else { a });
    let candidates = [less_along(&aside), longest.unwrap_or(aside)];
    let is_known = candidates[0].norm_squared() > R::from(0.0);
    (unit(&less_along(&unit(&candidates[usize::from(!is_known)]))), distance)
}

/// The vector of length 1.
pub(super) fn unit<R: Real>(v: &Vec3<R>) -> Vec3<R> {
    v.scaled(R::from(1.0) / v.norm())
}
