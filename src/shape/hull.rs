//! Convex hulls of points, decided by exact signs.
//!
//! Every decision is the sign of a determinant of the given coordinates,
//!
//! ```text
//! side(a, b, c; p) = (b − a) × (c − a) · (p − a)
//! ```
//!
//! computed in `f64` where its error bound allows and exactly otherwise (Shewchuk 1997, Discrete
//! Comput. Geom. 18:305). So there is no thickness threshold: a plate of 1e-12 or a needle of aspect
//! 1e9 keeps all its vertices, and points on one plane, line or spot give a hull of rank 2, 1 or 0.
//! Points inside the hull, on a face or on an edge are no vertices.
//!
//! In space the hull grows by the farthest point of a facet's outside set (quickhull; Barber, Dobkin
//! and Huhdanpaa 1996, ACM TOMS 22:469). A facet is removed only if the point is strictly above it;
//! this is the hull of points drawn infinitesimally inwards, so the removed patch is a disc and no
//! flat triangle is ever made. Signs are exact while the coordinates stay between 1e-70 and 1e60.

use robust::{Coord, Coord3D};

/// The convex hull of a list of points.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hull {
    /// Dimension of the hull: 3 a solid, 2 a polygon, 1 a segment, 0 a point.
    pub rank: usize,
    /// Indices of the points that are vertices; of a polygon in order around it, else increasing.
    pub vertices: Vec<usize>,
    /// The surface of a solid: triangles of point indices, counterclockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
}

type Point = [f64; 3];

/// The side of the plane through `a, b, c` that `p` is on: positive where they turn counterclockwise
/// seen from `p`, zero exactly where the four lie on one plane. The size is six times the volume.
pub fn side(a: &Point, b: &Point, c: &Point, p: &Point) -> f64 {
    let [a, b, c, p] = [a, b, c, p].map(|v| Coord3D { x: v[0], y: v[1], z: v[2] });
    -robust::orient3d(a, b, c, p)
}

/// The turn from `a` over `b` to `c` in the plane: positive to the left, zero exactly on one line.
pub fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let [a, b, c] = [a, b, c].map(|v| Coord { x: v[0], y: v[1] });
    robust::orient2d(a, b, c)
}

/// The hull of points in the plane: indices of its vertices, counterclockwise (Andrew 1979, Inf.
/// Process. Lett. 9:216). Two points give both, equal points one.
pub fn planar_hull(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&i, &j| compare(&points[i], &points[j]).then(i.cmp(&j)));
    order.dedup_by(|i, j| compare(&points[*i], &points[*j]).is_eq());
    if order.len() < 3 {
        return order;
    }

    // the lower chain from left to right, then the upper chain back
    let mut chain: Vec<usize> = Vec::with_capacity(order.len() + 1);
    for upper in [false, true] {
        let start = chain.len().saturating_sub(1);
        let end = order.len();
        for k in 0..end {
            let i = if upper { order[end - 1 - k] } else { order[k] };
            if upper && k == 0 {
                continue; // the lower chain ends there
            }
            while chain.len() >= start + 2 {
                let [a, b] = [chain[chain.len() - 2], chain[chain.len() - 1]];
                if turn(points[a], points[b], points[i]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(i);
        }
    }
    chain.pop(); // the first point closed the upper chain
    chain
}

/// The hull of points in space; of none, none of rank 0.
pub fn hull(points: &[Point]) -> Hull {
    let mut distinct: Vec<usize> = (0..points.len()).collect();
    distinct.sort_by(|&i, &j| compare(&points[i], &points[j]).then(i.cmp(&j)));
    distinct.dedup_by(|i, j| compare(&points[*i], &points[*j]).is_eq());

    // four points that span as much as possible say the rank
    let Some((&first, &last)) = distinct.first().zip(distinct.last()) else {
        return Hull { rank: 0, vertices: Vec::new(), triangles: Vec::new() };
    };
    if first == last {
        return Hull { rank: 0, vertices: vec![first], triangles: Vec::new() };
    }
    let Some(third) = off_line(points, &distinct, first, last) else {
        return Hull { rank: 1, vertices: vec![first.min(last), first.max(last)], triangles: Vec::new() };
    };
    let Some(fourth) = off_plane(points, &distinct, [first, last, third]) else {
        return flat_hull(points, &distinct, [first, last, third]);
    };

    // what the first pass leaves on faces and edges is no vertex: a second pass without it
    let grown = grow(points, &distinct, [first, last, third, fourth]);
    let extreme = extreme_vertices(points, &grown);
    let triangles = if extreme.len() == count_vertices(&grown) {
        grown
    } else {
        let third = off_line(points, &extreme, first, last);
        let fourth = third.and_then(|k| off_plane(points, &extreme, [first, last, k]));
        match third.zip(fourth) {
            Some((third, fourth)) => grow(points, &extreme, [first, last, third, fourth]),
            None => grown,
        }
    };
    let mut vertices: Vec<usize> = triangles.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    Hull { rank: 3, vertices, triangles }
}

/// Order of points by their first differing coordinate.
fn compare<const N: usize>(a: &[f64; N], b: &[f64; N]) -> std::cmp::Ordering {
    a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal)
}

/// The point farthest from the line through two points, none if all are exactly on it.
fn off_line(points: &[Point], among: &[usize], i: usize, j: usize) -> Option<usize> {
    let off = |k: usize| {
        PLANES
            .iter()
            .map(|&p| turn(drop(&points[i], p), drop(&points[j], p), drop(&points[k], p)).abs())
            .fold(0.0, f64::max)
    };
    farthest(among, off)
}

/// The point farthest from the plane through three points, none if all are exactly on it.
fn off_plane(points: &[Point], among: &[usize], [i, j, k]: [usize; 3]) -> Option<usize> {
    farthest(among, |p| side(&points[i], &points[j], &points[k], &points[p]).abs())
}

/// The index with the largest positive measure.
fn farthest(among: &[usize], measure: impl Fn(usize) -> f64) -> Option<usize> {
    let mut best = (0.0, None);
    for &k in among {
        let m = measure(k);
        if m > best.0 {
            best = (m, Some(k));
        }
    }
    best.1
}

/// The coordinate planes, by the axis that is dropped.
const PLANES: [usize; 3] = [0, 1, 2];

/// The projection along an axis, keeping the turning sense.
fn drop(p: &Point, axis: usize) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}

/// The hull of points on one plane, through the projection in which the triangle is widest.
fn flat_hull(points: &[Point], among: &[usize], [i, j, k]: [usize; 3]) -> Hull {
    let area = |p: usize| turn(drop(&points[i], p), drop(&points[j], p), drop(&points[k], p)).abs();
    let widest = PLANES.into_iter().fold(0, |best, p| if area(p) > area(best) { p } else { best });
    let shadow: Vec<[f64; 2]> = among.iter().map(|&p| drop(&points[p], widest)).collect();
    let vertices = planar_hull(&shadow).into_iter().map(|p| among[p]).collect();
    Hull { rank: 2, vertices, triangles: Vec::new() }
}

/// A triangle of the growing surface.
struct Facet {
    corners: [usize; 3],
    /// The facet across the edge from corner `k` to corner `k + 1`.
    across: [usize; 3],
    /// Points strictly above, each kept by one facet.
    outside: Vec<usize>,
    alive: bool,
}

/// Quickhull from four points that span space.
fn grow(points: &[Point], among: &[usize], start: [usize; 4]) -> Vec<[usize; 3]> {
    let above = |t: &[usize; 3], p: usize| side(&points[t[0]], &points[t[1]], &points[t[2]], &points[p]);

    // the first tetrahedron, its base facing away from its top
    let [a, mut b, mut c, d] = start;
    if above(&[a, b, c], d) > 0.0 {
        (b, c) = (c, b);
    }
    let corners = [[a, b, c], [a, c, d], [c, b, d], [b, a, d]];
    let across = [[3, 2, 1], [0, 2, 3], [0, 3, 1], [0, 1, 2]];
    let mut facets: Vec<Facet> =
        (0..4).map(|f| Facet { corners: corners[f], across: across[f], outside: Vec::new(), alive: true }).collect();
    share_out(&mut facets, 0, among.iter().copied().filter(|p| !start.contains(p)), &above);

    // each facet with points above it gives way to a fan from the farthest of them
    let mut next = 0;
    let mut visible_stamp: Vec<usize> = Vec::new();
    while next < facets.len() {
        if !facets[next].alive || facets[next].outside.is_empty() {
            next += 1;
            continue;
        }
        let Some(apex) = farthest(&facets[next].outside, |p| above(&facets[next].corners, p)) else { break };

        // the patch that the apex sees, from the first facet outwards
        visible_stamp.resize(facets.len(), usize::MAX);
        let mut patch = vec![next];
        visible_stamp[next] = apex;
        let mut horizon: Vec<(usize, usize, usize)> = Vec::new(); // (from, to, facet beyond)
        let mut k = 0;
        while k < patch.len() {
            let (corners, across) = (facets[patch[k]].corners, facets[patch[k]].across);
            for side in 0..3 {
                let beyond = across[side];
                if visible_stamp[beyond] == apex {
                    continue;
                }
                if above(&facets[beyond].corners, apex) > 0.0 {
                    visible_stamp[beyond] = apex;
                    patch.push(beyond);
                } else {
                    horizon.push((corners[side], corners[(side + 1) % 3], beyond));
                }
            }
            k += 1;
        }

        // the fan; its facets find each other through the vertices of the horizon
        let base = facets.len();
        horizon.sort_unstable();
        for &(from, to, beyond) in &horizon {
            let me = facets.len();
            let after = horizon.partition_point(|h| h.0 < to) + base;
            let before = horizon.iter().position(|h| h.1 == from).map_or(me, |h| h + base);
            facets.push(Facet {
                corners: [from, to, apex],
                across: [beyond, after, before],
                outside: Vec::new(),
                alive: true,
            });
            for side in 0..3 {
                if facets[beyond].corners[side] == to && facets[beyond].corners[(side + 1) % 3] == from {
                    facets[beyond].across[side] = me;
                }
            }
        }

        // points of the patch go to the fan, or are inside for good
        let mut orphans = Vec::new();
        for f in patch {
            facets[f].alive = false;
            orphans.append(&mut facets[f].outside);
        }
        share_out(&mut facets, base, orphans.into_iter().filter(|&p| p != apex), &above);
    }
    facets.into_iter().filter(|f| f.alive).map(|f| f.corners).collect()
}

/// Gives each point to the first facet from `base` on that it is strictly above.
fn share_out(
    facets: &mut [Facet],
    base: usize,
    points: impl Iterator<Item = usize>,
    above: &impl Fn(&[usize; 3], usize) -> f64,
) {
    for p in points {
        if let Some(f) = facets[base..].iter_mut().find(|f| above(&f.corners, p) > 0.0) {
            f.outside.push(p);
        }
    }
}

/// How many points the triangles touch.
fn count_vertices(triangles: &[[usize; 3]]) -> usize {
    2 + triangles.len() / 2 // Euler: V − E + F = 2 with 2 E = 3 F
}

/// The corners of a triangulated hull where at least three edges are not flat; the others lie within
/// a face or an edge.
fn extreme_vertices(points: &[Point], triangles: &[[usize; 3]]) -> Vec<usize> {
    let mut far_corner = std::collections::BTreeMap::new();
    for t in triangles {
        for k in 0..3 {
            far_corner.insert((t[k], t[(k + 1) % 3]), t[(k + 2) % 3]);
        }
    }
    let mut sharp = std::collections::BTreeMap::new();
    for (&(i, j), &k) in &far_corner {
        let count = sharp.entry(i).or_insert(0);
        if far_corner.get(&(j, i)).is_some_and(|&l| side(&points[i], &points[j], &points[k], &points[l]) != 0.0) {
            *count += 1;
        }
    }
    sharp.into_iter().filter(|&(_, count)| count >= 3).map(|(i, _)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every point is on the inner side of every facet, and the surface is closed.
    fn assert_is_hull(points: &[Point], hull: &Hull) {
        assert_eq!(hull.triangles.len(), 2 * hull.vertices.len() - 4, "Euler's formula");
        let mut edges = std::collections::BTreeSet::new();
        for t in &hull.triangles {
            for p in points {
                assert!(side(&points[t[0]], &points[t[1]], &points[t[2]], p) <= 0.0, "a point is outside");
            }
            for k in 0..3 {
                assert!(edges.insert((t[k], t[(k + 1) % 3])), "an edge is used twice");
            }
        }
        assert!(edges.iter().all(|&(i, j)| edges.contains(&(j, i))), "the surface has a hole");
    }

    fn box_corners(h: Point) -> Vec<Point> {
        (0..8).map(|k| std::array::from_fn(|i| if k >> i & 1 == 0 { -h[i] } else { h[i] })).collect()
    }

    #[test]
    fn plates_needles_and_boxes_keep_their_eight_corners() {
        for h in
            [[1.0; 3], [1.0, 1.0, 1e-6], [84.0, 0.001, 84.0], [1e-9, 1.0, 1.0], [1e-9, 1.0, 1e-9], [1e6, 1.0, 1e-6]]
        {
            let points = box_corners(h);
            let hull = hull(&points);
            assert_eq!((hull.rank, hull.vertices.len()), (3, 8), "{h:?}");
            assert_is_hull(&points, &hull);
        }
    }

    #[test]
    fn points_on_faces_and_edges_are_no_vertices() {
        let mut points = Vec::new();
        for i in 0..5 {
            for j in 0..5 {
                for k in 0..5 {
                    points.push([f64::from(i), f64::from(j), f64::from(k)]);
                }
            }
        }
        let hull = hull(&points);
        assert_eq!(hull.vertices.len(), 8);
        assert_is_hull(&points, &hull);
    }

    #[test]
    fn the_rank_is_decided_exactly() {
        let p = [0.1, 0.2, 0.3];
        assert_eq!(hull(&[p, p, p]).rank, 0);
        assert_eq!(hull(&[p, [0.0; 3], [0.2, 0.4, 0.6]]).vertices, [1, 2]);
        let square =
            [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.5, 0.0, 1.0], [1.0, 1.0, 1.0], [0.5, 0.5, 1.0], [0.0, 1.0, 1.0]];
        let flat = hull(&square);
        assert_eq!((flat.rank, flat.vertices), (2, vec![0, 1, 3, 5]));
        let mut lifted = square;
        lifted[4][2] = 1.0 + f64::EPSILON;
        assert_eq!(hull(&lifted).rank, 3, "one unit in the last place is a thickness");
        assert!(hull(&[]).vertices.is_empty());
    }

    #[test]
    fn the_planar_hull_leaves_out_points_on_its_edges() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0], [0.0, 1.0], [0.0, 0.0]];
        assert_eq!(planar_hull(&points), [0, 2, 3, 5]);
        assert_eq!(planar_hull(&points[..3]), [0, 2]);
        assert!(planar_hull(&[]).is_empty());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn random_and_degenerate_clouds_give_closed_convex_surfaces(
            cloud in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 4..60),
            steps in prop::collection::vec(prop::array::uniform3(-3i8..4), 8..60),
            thin in prop::sample::select(vec![1.0, 1e-6, 1e-12]),
        ) {
            let cloud: Vec<Point> = cloud.into_iter().map(|p| [p[0], p[1], thin * p[2]]).collect();
            assert_is_hull(&cloud, &hull(&cloud));
            // a cloud on a lattice is full of points on one plane, one line, one spot
            let lattice: Vec<Point> = steps.into_iter().map(|p| p.map(|x| 0.1 * f64::from(x))).collect();
            let h = hull(&lattice);
            if h.rank == 3 {
                assert_is_hull(&lattice, &h);
            }
        }
    }
}
