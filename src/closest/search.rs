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

/// Rounds after which the search ends with what it has [-]: random pairs take 3 to 15.
const ROUNDS: u32 = 96;

/// What the search proved.
#[derive(Debug, Clone, Copy)]
pub(super) enum Found<R> {
    /// Bounds of the distance, to within the pair's error.
    Apart(Bounds<R>),
    /// The origin is in the simplex or on it, to rounding.
    Inside(Simplex<R>),
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
        let (ids, _) = pair.lowest(toward, None);
        simplex.push(ids, pair.difference(ids));
        hint = Some(ids);
    }

    let gap = R::from(gap);
    let noise = R::from(pair.error());
    let mut best: Option<Bounds<R>> = None;
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

        let (ids, height) = pair.lowest(&normal, hint.or(Some(simplex.ids[0])));
        hint = Some(ids);
        let one_over = R::from(1.0) / length;
        let found = Bounds { simplex, point, normal: normal.scaled(one_over), lower: height * one_over, upper };
        let closes = upper - found.lower <= gap;
        let is_enough = enough(&found);
        if is_enough || best.as_ref().is_none_or(|b| upper - found.lower < b.upper - b.lower) {
            best = Some(found);
        }
        if closes || is_enough || simplex.contains(ids) {
            break;
        }
        simplex.push(ids, pair.difference(ids));
    }
    best.map_or(Found::Inside(simplex), Found::Apart)
}

/// Bounds from the given points of the difference, if one look around shows that they still carry the
/// closest point.
#[inline]
pub(super) fn verify<R: Real>(
    pair: &impl Difference<R>,
    start: &[Ids],
    gap: f64,
    steps: &mut u32,
) -> Option<Bounds<R>> {
    *steps += 1;
    let mut simplex = pair.simplex(start);
    let Closest::At { point, normal } = simplex.reduce() else { return None };
    let (upper, length) = (point.norm(), normal.norm());
    if upper <= R::from(pair.error()) || length == R::from(0.0) {
        return None;
    }
    let (_, height) = pair.lowest(&normal, Some(simplex.ids[0]));
    let one_over = R::from(1.0) / length;
    let lower = height * one_over;
    (upper - lower <= R::from(gap)).then(|| Bounds { simplex, point, normal: normal.scaled(one_over), lower, upper })
}
