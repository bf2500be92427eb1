//! The distance of disjoint bodies: Gilbert, Johnson and Keerthi's search on the difference, with
//! supports by climbing (Gilbert et al. 1988, IEEE J. Robot. Autom. 4:193; Cameron 1997).
//!
//! ```text
//! upper = |p|,  p = Σ λ w  a point of the difference, λ ≥ 0, Σ λ = 1
//! lower = min n·w over the difference, n the unit normal of the simplex at p
//! ```
//!
//! The search ends when both meet to within the wanted gap. It falls strictly in `|p|`, so no simplex
//! returns; where rounding stops the fall, it ends with the best pair of bounds that it has proved.

use super::pair::{Difference, Ids};
use super::simplex::{Closest, Simplex};
use super::vector::Vec3;
use crate::math::double_double::Real;

/// Rounds after which the search ends with what it has [-]: random pairs take 3 to 15, the rims of parallel discs that
/// overlap by 1e-8 of their radii 112.
const ROUNDS: u32 = 512;
/// Vertices that a verification takes in before it gives the pair to the walk [-]: a step of coherent
/// motion changes one or two.
const EXCHANGES: u32 = 3;

/// What the search proved.
#[derive(Debug, Clone, Copy)]
pub(super) enum Found<R> {
    /// Bounds of the distance, to within the pair's error.
    Apart(Bounds<R>),
    /// The origin is in the simplex or on it, to rounding.
    Inside(Simplex<R>),
    /// Rounding stopped the search before either was proved: what was, and the last simplex.
    Open(Bounds<R>, Simplex<R>),
}

/// Bounds of the signed distance and where they come from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds<R> {
    /// The points that carry `point`.
    pub(super) simplex: Simplex<R>,
    /// `p`: from the closest point of A to that of B, world axes [m].
    pub(super) point: Vec3<R>,
    /// Unit normal from A to B, world axes.
    pub(super) normal: Vec3<R>,
    /// Bounds of the signed distance, but for the pair's error [m].
    pub(super) lower: R,
    pub(super) upper: R,
}

impl<R: Real> Bounds<R> {
    /// A simplex of which nothing is known yet.
    #[inline]
    pub(super) fn unknown(simplex: Simplex<R>) -> Self {
        let zero = R::from(0.0);
        Self { simplex, point: Vec3::zero(), normal: Vec3::zero(), lower: zero, upper: zero }
    }
}

/// Searches from the given points of the difference; without any, from the one against `toward`.
pub(super) fn search<R: Real>(
    pair: &impl Difference<R>,
    start: &[Ids],
    toward: &Vec3<R>,
    gap: f64,
    steps: &mut u32,
    enough: impl Fn(&Bounds<R>) -> bool,
) -> Found<R> {
    let mut simplex = pair.simplex(start);
    let mut hint = start.first().copied();
    if simplex.count == 0 {
        // where the centres coincide, any direction leads to the surface, and none to a point inside
        let toward = if *toward == Vec3::zero() { Vec3::new([1.0, 0.0, 0.0]) } else { *toward };
        let (ids, _) = pair.lowest(&toward, None);
        simplex.push(ids, pair.difference(ids));
        hint = Some(ids);
    }

    let gap = R::from(gap);
    let noise = R::from(pair.error(0.0));
    let mut best: Option<Bounds<R>> = None;
    let mut closed = false;
    let mut last: ([Ids; 4], usize) = Default::default();
    for _ in 0..ROUNDS {
        *steps += 1;
        let Closest::At { point, normal } = simplex.reduce() else {
            // rounding may see the origin inside four points of one plane; a proof of separation stands
            if best.as_ref().is_some_and(|b| b.lower > noise) {
                break;
            }
            return Found::Inside(simplex);
        };
        let (upper, length) = (point.norm(), normal.norm());
        if upper <= noise || length == R::from(0.0) {
            return Found::Inside(simplex);
        }
        if best.as_ref().is_some_and(|b| upper >= b.upper)
            && best.as_ref().is_some_and(|b| b.simplex.count >= simplex.count)
        {
            break; // rounding stopped the fall
        }
        if simplex.ids[..simplex.count] == last.0[..last.1] {
            break; // the last point was dropped again
        }
        last = (simplex.ids, simplex.count);

        let (ids, height) = pair.lowest(&normal, hint.or(Some(simplex.ids[0])));
        hint = Some(ids);
        let one_over = R::from(1.0) / length;
        let found = Bounds { simplex, point, normal: normal.scaled(one_over), lower: height * one_over, upper };
        let closes = upper - found.lower <= gap;
        let is_enough = enough(&found);
        if is_enough || best.as_ref().is_none_or(|b| upper - found.lower < b.upper - b.lower) {
            best = Some(found);
        }
        closed = closes || is_enough;
        if closed || simplex.contains(ids) {
            break;
        }
        simplex.push(ids, pair.difference(ids));
    }
    match best {
        Some(best) if closed || best.lower > noise => Found::Apart(best),
        Some(best) => Found::Open(best, simplex),
        None => Found::Inside(simplex),
    }
}

/// Whether the points of the simplex still carry the closest point, or others that the looks around come
/// upon do, after at most [`EXCHANGES`] of them. If so, the bounds are those of the answer.
#[inline]
pub(super) fn verify<R: Real>(pair: &impl Difference<R>, found: &mut Bounds<R>, gap: f64, steps: &mut u32) -> bool {
    let Bounds { simplex, .. } = found;
    for _ in 0..=EXCHANGES {
        *steps += 1;
        let Closest::At { point, normal } = simplex.reduce() else { return false };
        let (upper, length) = (point.norm(), normal.norm());
        if upper <= R::from(pair.error(0.0)) || length == R::from(0.0) {
            return false;
        }
        let (ids, height) = pair.lowest(&normal, Some(simplex.ids[0]));
        let one_over = R::from(1.0) / length;
        let lower = height * one_over;
        if upper - lower <= R::from(gap) {
            (found.point, found.normal) = (point, normal.scaled(one_over));
            (found.lower, found.upper) = (lower, upper);
            return true;
        }
        if simplex.contains(ids) {
            return false;
        }
        simplex.push(ids, pair.difference(ids));
    }
    false
}
