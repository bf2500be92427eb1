//! Coplanar triangles of a hull, merged into polygonal faces.

use std::collections::BTreeMap;

use super::vector::{area_vector, dot, norm, sub, unit};

/// Triangles merged into polygons where they lie on one plane to within `flatness` [m]: each region
/// grows from its largest triangle. A region that is not bounded by one simple loop, or holds a vertex inside,
/// stays in triangles.
pub(super) fn polygons(vertices: &[[f64; 3]], triangles: &[[u32; 3]], flatness: f64) -> Vec<Vec<u32>> {
    let at = |i: u32| &vertices[i as usize];
    let areas: Vec<[f64; 3]> = triangles.iter().map(|t| area_vector(at(t[0]), at(t[1]), at(t[2]))).collect();
    let owner: BTreeMap<(u32, u32), usize> =
        triangles.iter().enumerate().flat_map(|(f, t)| (0..3).map(move |k| ((t[k], t[(k + 1) % 3]), f))).collect();
    let mut largest_first: Vec<usize> = (0..triangles.len()).collect();
    largest_first.sort_by(|&f, &g| norm(&areas[g]).total_cmp(&norm(&areas[f])).then(f.cmp(&g)));

    let mut region = vec![usize::MAX; triangles.len()];
    let mut loops = Vec::new();
    for seed in largest_first {
        if region[seed] != usize::MAX {
            continue;
        }

        // the triangles around the seed that lie on its plane and face its way
        let (normal, origin) = (unit(&areas[seed]), at(triangles[seed][0]));
        let flat = |f: usize| triangles[f].iter().all(|&i| dot(&normal, &sub(at(i), origin)).abs() <= flatness);
        let mut members = vec![seed];
        region[seed] = seed;
        let mut k = 0;
        while k < members.len() {
            let t = triangles[members[k]];
            for side in 0..3 {
                let f = owner[&(t[(side + 1) % 3], t[side])];
                if region[f] == usize::MAX && dot(&normal, &areas[f]) > 0.0 && flat(f) {
                    region[f] = seed;
                    members.push(f);
                }
            }
            k += 1;
        }

        // the border: half-edges whose twin belongs to another region
        let sides = members.iter().flat_map(|&f| (0..3).map(move |k| (triangles[f][k], triangles[f][(k + 1) % 3])));
        let border: Vec<(u32, u32)> = sides.filter(|&(i, j)| region[owner[&(j, i)]] != seed).collect();
        let next: BTreeMap<u32, u32> = border.iter().copied().collect();
        let walk: Vec<u32> = match border.first() {
            Some(&(start, _)) => {
                let around = std::iter::successors(Some(start), |i| next.get(i).copied().filter(|&j| j != start));
                around.take(border.len()).collect()
            }
            None => Vec::new(),
        };
        // one loop, and no vertex inside it: of a body of aspect 1e15 everything looks flat
        let is_polygon = walk.len() >= 3 && members.len() == walk.len() - 2;
        if is_polygon && walk.len() == border.len() && next.len() == border.len() {
            loops.push(walk);
        } else {
            loops.extend(members.iter().map(|&f| triangles[f].to_vec()));
        }
    }
    loops
}
