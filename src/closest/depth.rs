//! How deep two bodies overlap: an inner polytope of their difference, grown from the inside.
//!
//! ```text
//! depth = min over directions n of max n·w over the difference
//! ```
//!
//! A closed surface of points of the difference around the origin, each of whose triangles is at least
//! `d` from the origin, proves that the ball of radius `d` lies in the difference: depth ≥ d. A
//! direction `n` proves depth ≤ max n·w. The triangle nearest to the origin is asked for the support
//! along its normal; either both numbers meet there, or the new point replaces the triangles that it
//! sees (the expanding polytope; van den Bergen 2001). So every answer is proved complete: no face and
//! no pair of edges can hide a smaller depth.
//!
//! Distances are taken as the least `n·w` over a triangle's corners, which bounds its distance whatever
//! rounding did to `n`. The surface is closed by construction, and where all its triangles face away
//! from the origin, their solid angles are positive and sum to a whole number of spheres: it goes
//! around the origin.

use super::cache::{Packed, PairCache};
use super::pair::{Difference, Ids};
use super::search::Bounds;
use super::simplex::{Closest, Simplex, triangle_normal};
use super::surface::{Core, Surface, Triangle, Workshop};
use super::vector::Vec3;
use crate::math::double_double::Real;

/// What encloses an overlap, to start the next query of the same pair from.
#[derive(Debug, Clone, Copy)]
pub(super) enum Enclosing {
    /// Nothing did.
    Nothing,
    /// What was remembered.
    AsBefore,
    /// Other vertices.
    Points(Core),
    /// Another surface.
    Surface(Packed),
}

/// Points that a remembered surface may need in addition before another is remembered in its place [-].
/// Larger: it ages, and each query finds them again; smaller: surfaces are made more often than used.
const ADDITIONS: usize = 4;

/// The depth from a simplex that holds the origin, or touches it. The bounds are those of the negative
/// depth; the upper one holds where it is below the pair's error, for then the surface encloses the
/// origin. The normal points from A to B, against the way out. Along with them the vertices to start
/// the next query of the same pair from.
pub(super) fn depth<R: Workshop>(
    pair: &impl Difference<R>,
    start: &Simplex<R>,
    gap: f64,
    steps: &mut u32,
    enough: impl Fn(&Bounds<R>) -> bool,
) -> (Bounds<R>, Enclosing) {
    let gap = R::from(gap);
    let mut corners = *start;
    let shallowest = match spanning(pair, &mut corners, gap) {
        Ok(shallowest) => shallowest,
        Err(flat) => return (flat, Enclosing::Nothing),
    };
    R::with_surface(|surface| {
        surface.begin(&corners);
        let bounds = grow(pair, surface, gap, steps, enough, Dents::Allowed);
        let bounds = bounds.unwrap_or_else(|last| flat_answer(start, pair, [shallowest, last]));
        let points = || Enclosing::Points(surface.core(PairCache::CAPACITY));
        (bounds, surface.pack().map_or_else(points, Enclosing::Surface))
    })
}

/// The depth from the surface of an earlier answer; none if the bodies are apart by now, or the surface is
/// dented or does not go around the origin any more.
pub(super) fn depth_on(
    pair: &impl Difference<f64>,
    packed: &Packed,
    gap: f64,
    steps: &mut u32,
    enough: impl Fn(&Bounds<f64>) -> bool,
) -> Option<(Bounds<f64>, Enclosing)> {
    f64::with_surface(|surface| {
        surface.restore(pair, packed);
        let known = surface.points.len();
        // what faces away all round may also have shrunk to a spot or to a line beside the origin, as bodies far off or
        // very thin ones do in rounding
        let is_beyond = |t: &Triangle<f64>| surface.points.iter().any(|p| t.normal.dot(p) < 0.0);
        let faces_away = |t: &Triangle<f64>| t.distance > 0.0 && !t.stuck;
        let is_around = surface.triangles.iter().all(faces_away) && surface.triangles.iter().any(is_beyond);
        let bounds = if is_around { grow(pair, surface, gap, steps, enough, Dents::End).ok()? } else { return None };
        let added = surface.points.len() - known;
        if added == 0 {
            return Some((bounds, Enclosing::AsBefore));
        }
        let enclosing = match surface.pack() {
            Some(packed) => Enclosing::Surface(packed),
            None if added <= ADDITIONS => Enclosing::AsBefore,
            None => anew(pair, surface),
        };
        Some((bounds, enclosing))
    })
}

/// The depth from the vertices of an earlier answer; none if the bodies are apart by now or the vertices
/// do not span space.
pub(super) fn depth_again(
    pair: &impl Difference<f64>,
    core: &[Ids],
    gap: f64,
    steps: &mut u32,
    enough: impl Fn(&Bounds<f64>) -> bool,
) -> Option<(Bounds<f64>, Enclosing)> {
    f64::with_surface(|surface| {
        build(pair, surface, core)?;
        let known = surface.points.len();
        let bounds = grow(pair, surface, gap, steps, enough, Dents::Allowed).ok()?;
        let enclosing = match surface.pack() {
            Some(packed) => Enclosing::Surface(packed),
            None if surface.points.len() == known => Enclosing::AsBefore,
            None => anew(pair, surface),
        };
        Some((bounds, enclosing))
    })
}

/// A smaller surface of the same bodies, to be remembered.
fn anew(pair: &impl Difference<f64>, surface: &mut Surface<f64>) -> Enclosing {
    let (core, count) = surface.core(Packed::POINTS);
    let small = build(pair, surface, &core[..count]).and_then(|()| surface.pack());
    small.map_or(Enclosing::Points((core, count)), Enclosing::Surface)
}

/// The surface of the given points, the first four of which span it; none if they do not.
fn build(pair: &impl Difference<f64>, surface: &mut Surface<f64>, points: &[Ids]) -> Option<()> {
    let (first, rest) = points.split_at_checked(4)?;
    let corners = pair.simplex(first);
    let p = &corners.points;
    let volume = triangle_normal(&p[0], &p[1], &p[2]).dot(&(p[3] - p[0])).abs();
    if volume <= SPANNING * pair.size() * pair.size() * pair.size() {
        return None;
    }
    surface.begin(&corners);
    rest.iter().all(|&ids| surface.take_in(ids, pair.difference(ids))).then_some(())
}

/// Smallest volume of a remembered tetrahedron to start from, as a fraction of the size cubed [-]: the
/// corners' rounding must not turn it inside out. Smaller ones are found anew.
const SPANNING: f64 = 1e-9;

/// What to do where a triangle of the surface lies below a corner of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Dents {
    /// It is rounding: the triangle is measured again.
    Allowed,
    /// The surface is out of shape.
    End,
}

/// Grows the surface until its nearest triangle and a direction bound the depth to within the gap; the direction along
/// which the origin is least deep if the bodies turn out to be apart, or the surface to be out of shape.
fn grow<R: Real>(
    pair: &impl Difference<R>,
    surface: &mut Surface<R>,
    gap: R,
    steps: &mut u32,
    enough: impl Fn(&Bounds<R>) -> bool,
    dents: Dents,
) -> Result<Bounds<R>, Option<Vec3<R>>> {
    let mut best: Option<Bounds<R>> = None;
    let mut ball = R::from(f64::NEG_INFINITY);
    while surface.points.len() < pair.most_points() {
        *steps += 1;
        let Some(nearest) = surface.nearest() else { break };
        let Triangle { normal, distance, corners, stuck, .. } = surface.triangles[nearest];
        if normal == Vec3::zero() {
            break; // a triangle on one line through the origin says nothing
        }
        let (ids, low) = pair.lowest(&-normal, Some(surface.ids[corners[0] as usize]));
        if low > R::from(pair.error(0.0)) {
            return Err(Some(-normal));
        }

        if -low - distance <= gap {
            let (simplex, point) = surface.nearest_witness(nearest, gap);
            return Ok(Bounds { simplex, point, normal: -normal, lower: low, upper: -distance });
        }

        // the largest ball so far and the best direction so far bound the depth; until they meet, the point is the
        // deepest along that direction
        ball = if distance > ball { distance } else { ball };
        if best.as_ref().is_none_or(|b| low > b.lower) {
            let mut simplex = Simplex::empty();
            simplex.push(ids, pair.difference(ids));
            let _ = simplex.reduce();
            best = Some(Bounds { simplex, point: simplex.points[0], normal: -normal, lower: low, upper: -ball });
        }
        if let Some(b) = &mut best {
            b.upper = -ball;
            if enough(b) {
                break;
            }
        }

        if !surface.ids.contains(&ids) {
            if !surface.expand(nearest, ids, pair.difference(ids)) {
                if dents == Dents::End {
                    return Err(None);
                }
                break;
            }
        } else if dents == Dents::End {
            return Err(None);
        } else if stuck {
            break;
        } else {
            surface.measure_closely(nearest);
        }
    }
    // bounds that cross say that rounding turned the surface inside out: nothing is proved
    let Some(mut best) = best else { return Err(None) };
    if best.lower > best.upper + R::from(pair.error(best.lower.to_f64())) {
        return Err(Some(best.normal));
    }

    // where no ball is proved, a point near the origin is an upper bound
    if ball <= R::from(pair.error(0.0))
        && let Some(nearest) = surface.nearest()
    {
        let (simplex, point) = surface.nearest_witness(nearest, gap);
        if point.norm_squared() < best.point.norm_squared() {
            (best.simplex, best.point) = (simplex, point);
        }
    }
    Ok(best)
}

/// Adds points of the difference to the given ones until four span space. Returns the direction looked along in which the
/// origin is least deep; or the answer, where a direction is met in which the difference lies to one side of the origin,
/// or rounding leaves it no extent.
fn spanning<R: Real>(
    pair: &impl Difference<R>,
    simplex: &mut Simplex<R>,
    gap: R,
) -> Result<Option<Vec3<R>>, Bounds<R>> {
    let mut shallowest: Option<(R, Vec3<R>)> = None;
    while simplex.count < 4 {
        // directions in which the simplex has no extent
        let p = simplex.points;
        let candidates: [Vec3<R>; 3] = match simplex.count {
            1 => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::new),
            2 => {
                let e = p[1] - p[0];
                let axis = smallest_axis(&e);
                let (u, v) = (e.cross(&axis), e.cross(&e.cross(&axis)));
                [u, v, u + v]
            }
            _ => [triangle_normal(&p[0], &p[1], &p[2]); 3],
        };

        // the farthest point on either side of what there is
        let mut farthest: Option<(R, Ids, Vec3<R>)> = None;
        for candidate in candidates {
            let length = candidate.norm();
            if length == R::from(0.0) {
                continue;
            }
            let unit = candidate.scaled(R::from(1.0) / length);
            for n in [unit, -unit] {
                let (ids, height) = pair.lowest(&n, Some(simplex.ids[0]));
                let extent = n.dot(&p[0]) - n.dot(&pair.difference(ids));
                if height >= -gap {
                    return Err(flat_answer(simplex, pair, [Some(n)]));
                }
                if shallowest.is_none_or(|(least, _)| height > least) {
                    shallowest = Some((height, n));
                }
                let w = pair.difference(ids);
                let measure = match simplex.count {
                    2 => (w - p[0]).cross(&(p[1] - p[0])).norm(),
                    _ => extent,
                };
                if !simplex.contains(ids) && farthest.as_ref().is_none_or(|f| measure > f.0) {
                    farthest = Some((measure, ids, w));
                }
            }
        }
        let Some((_, ids, w)) = farthest else {
            return Err(flat_answer(simplex, pair, [shallowest.map(|(_, n)| n)]));
        };
        simplex.push(ids, w);
    }
    Ok(shallowest.map(|(_, n)| n))
}

/// The coordinate axis farthest from a direction.
fn smallest_axis<R: Real>(e: &Vec3<R>) -> Vec3<R> {
    let size = e.to_f64().map(f64::abs);
    let k = (0..3).fold(0, |best, k| if size[k] < size[best] { k } else { best });
    let mut axis = [0.0; 3];
    axis[k] = 1.0;
    Vec3::new(axis)
}

/// The answer that the best of some directions gives, where one separates the bodies to rounding or no surface encloses
/// the origin.
fn flat_answer<R: Real, const N: usize>(
    simplex: &Simplex<R>,
    pair: &impl Difference<R>,
    directions: [Option<Vec3<R>>; N],
) -> Bounds<R> {
    let mut simplex = *simplex;
    simplex.count = simplex.count.min(3);
    let along = |n: Vec3<R>| (pair.lowest(&n, Some(simplex.ids[0])).1, n);
    let known = directions.into_iter().flatten().map(along);
    let best = known.reduce(|best, next| if next.0 > best.0 { next } else { best });
    let (lower, normal) = best.unwrap_or_else(|| along(Vec3::new([0.0, 0.0, 1.0])));
    let point = match simplex.reduce() {
        Closest::At { point, .. } => point,
        Closest::Inside => simplex.points[0],
    };
    Bounds { simplex, point, normal, lower, upper: point.norm() }
}
