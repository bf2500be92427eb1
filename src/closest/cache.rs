//! What a pair remembers from one query to the next.

use super::Feature;
use super::pair::Ids;
use super::vector::Vec3;
use crate::shape::convex_polyhedron::ConvexPolyhedron;

/// Where a pair's last answer was found, to start the next query of the same pair from. Any content is
/// legal, also from another pair or another time: it costs steps, never truth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PairCache {
    memory: Memory,
    /// The pieces that were closest, where a body is a compound.
    parts: [u16; 2],
}

/// What is remembered of two convex bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Memory {
    #[default]
    Nothing,
    /// Features of two polyhedra apart, and the vertices that carried their closest points.
    Apart { features: [Feature; 2], pairs: [[u16; 2]; 3], count: u8 },
    /// Vertices of two polyhedra; of an overlap those that enclose it.
    Vertices { pairs: [[u16; 2]; PairCache::CAPACITY], count: u8 },
    /// What encloses an overlap, with its triangles.
    Surface(Packed),
    /// The normal of a pair with a curved body, good for a start.
    Normal([f32; 3]),
}

/// A closed surface of up to 12 points of the difference of bodies of up to 256 vertices: triangles
/// counterclockwise seen from outside, four bits to a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Packed {
    pairs: [[u8; 2]; Packed::POINTS],
    corners: [u8; Packed::TRIANGLES * 3 / 2],
    count: u8,
}

impl Packed {
    /// Most points, and the triangles of a closed surface of so many.
    pub(super) const POINTS: usize = 12;
    const TRIANGLES: usize = 2 * Self::POINTS - 4;

    /// Packs a surface, if it fits and is closed: every side of a triangle is one other's, the other way
    /// round. What rounding tore is not remembered.
    pub(super) fn of(ids: &[Ids], triangles: impl Iterator<Item = [u32; 3]>) -> Option<Self> {
        if ids.len() > Self::POINTS {
            return None;
        }
        let mut packed = Self { pairs: [[0; 2]; Self::POINTS], corners: [0; 30], count: 0 };
        for (pair, &[i, j]) in packed.pairs.iter_mut().zip(ids) {
            *pair = [u8::try_from(i).ok()?, u8::try_from(j).ok()?];
            packed.count += 1;
        }
        let (mut place, mut sides) = (0, [0u16; Self::POINTS]);
        for corners in triangles {
            for (k, corner) in (1..).zip(corners) {
                *packed.corners.get_mut(place / 2)? |= u8::try_from(corner).ok()? << (4 * (place % 2));
                place += 1;
                let side = 1 << corners[k % 3];
                if sides[corner as usize] & side != 0 {
                    return None;
                }
                sides[corner as usize] |= side;
            }
        }
        let has_opposite = |i: usize| (0..Self::POINTS).all(|j| sides[i] >> j & 1 == sides[j] >> i & 1);
        (place == 3 * packed.triangle_count() && (0..Self::POINTS).all(has_opposite)).then_some(packed)
    }

    /// The pairs of vertices, no two alike.
    #[inline]
    pub(super) fn ids(&self) -> impl Iterator<Item = Ids> {
        self.pairs.iter().take(usize::from(self.count)).map(|pair| pair.map(u32::from))
    }

    /// The triangles, by the places of their corners in the list of pairs.
    #[inline]
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let corner = |k: usize| u32::from(self.corners[k / 2] >> (4 * (k % 2)) & 15);
        (0..self.triangle_count()).map(move |t| [corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)])
    }

    fn triangle_count(&self) -> usize {
        (2 * usize::from(self.count)).saturating_sub(4)
    }
}

impl PairCache {
    /// How many pairs of vertices are remembered: 4 of a simplex and what encloses a shallow overlap.
    pub(crate) const CAPACITY: usize = 14;

    /// An empty cache.
    pub fn new() -> Self {
        Self::default()
    }

    /// The remembered pairs that both bodies have vertices for, no two alike: up to 3 that carried a distance,
    /// or more that enclosed an overlap.
    #[inline]
    pub(super) fn load(&self, a: &ConvexPolyhedron, b: &ConvexPolyhedron, into: &mut [Ids; Self::CAPACITY]) -> usize {
        let mut count = 0;
        let mut take = |ids: Ids| {
            if (ids[0] as usize) < a.vertices().len() && (ids[1] as usize) < b.vertices().len() {
                into[count] = ids;
                count += 1;
            }
        };
        match &self.memory {
            Memory::Apart { pairs, count: stored, .. } => {
                pairs.iter().take(usize::from(*stored)).for_each(|pair| take(pair.map(u32::from)));
            }
            Memory::Vertices { pairs, count: stored } => {
                pairs.iter().take(usize::from(*stored)).for_each(|pair| take(pair.map(u32::from)));
            }
            Memory::Surface(packed) => packed.ids().for_each(take),
            Memory::Nothing | Memory::Normal(_) => {}
        }
        count
    }

    /// The remembered surface, if both bodies have its vertices.
    #[inline]
    pub(super) fn surface(&self, a: &ConvexPolyhedron, b: &ConvexPolyhedron) -> Option<&Packed> {
        let Memory::Surface(packed) = &self.memory else { return None };
        let exists = |[i, j]: Ids| (i as usize) < a.vertices().len() && (j as usize) < b.vertices().len();
        packed.ids().all(exists).then_some(packed)
    }

    /// Remembers a surface.
    pub(super) fn store_surface(&mut self, packed: Packed) {
        self.memory = Memory::Surface(packed);
    }

    /// The remembered features of bodies that were apart.
    #[inline]
    pub(super) fn features(&self) -> Option<[Feature; 2]> {
        if let Memory::Apart { features, .. } = self.memory { Some(features) } else { None }
    }

    /// Remembers the features of bodies apart, and the up to three pairs of vertices that carry the points.
    #[inline]
    pub(super) fn store_apart(&mut self, ids: &[Ids], features: [Feature; 2]) {
        let mut pairs = [[0; 2]; 3];
        let mut count = 0;
        for ids in ids.iter().take(3) {
            let [Ok(i), Ok(j)] = ids.map(u16::try_from) else { continue };
            pairs[usize::from(count)] = [i, j];
            count += 1;
        }
        self.memory = Memory::Apart { features, pairs, count };
    }

    /// Remembers pairs, no two of which are alike; vertices beyond number 65,535 are not remembered.
    #[inline]
    pub(super) fn store(&mut self, ids: &[Ids]) {
        if !matches!(self.memory, Memory::Vertices { .. }) {
            self.memory = Memory::Vertices { pairs: [[0; 2]; Self::CAPACITY], count: 0 };
        }
        let Memory::Vertices { pairs, count } = &mut self.memory else { return };
        *count = 0;
        for &[i, j] in ids.iter().take(Self::CAPACITY) {
            let (Ok(i), Ok(j)) = (u16::try_from(i), u16::try_from(j)) else { continue };
            pairs[usize::from(*count)] = [i, j];
            *count += 1;
        }
    }

    /// The remembered normal.
    pub(super) fn normal(&self) -> Option<[f64; 3]> {
        if let Memory::Normal(n) = self.memory { Some(n.map(f64::from)) } else { None }
    }

    /// Remembers a normal.
    #[expect(clippy::cast_possible_truncation, reason = "a start needs few digits")]
    pub(super) fn store_normal(&mut self, normal: &Vec3<f64>) {
        self.memory = Memory::Normal(normal.0.map(|x| x as f32));
    }

    /// The remembered pieces.
    pub(super) fn parts(&self) -> [usize; 2] {
        self.parts.map(usize::from)
    }

    /// Remembers pieces, up to number 65,535.
    pub(super) fn store_parts(&mut self, parts: [usize; 2]) {
        self.parts = parts.map(|k| u16::try_from(k).unwrap_or(0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_closed_surfaces_are_packed() {
        let ids = [[7, 255], [1, 2], [9, 0], [3, 3]];
        let closed = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let packed = Packed::of(&ids, closed.into_iter()).unwrap();
        assert_eq!(
            (packed.ids().collect::<Vec<_>>(), packed.triangles().collect::<Vec<_>>()),
            (ids.into(), closed.into())
        );
        // a triangle the wrong way round, a triangle twice
        for last in [[0, 2, 3], [1, 2, 3]] {
            let torn = [closed[0], closed[1], closed[2], last];
            assert_eq!(Packed::of(&ids, torn.into_iter()), None, "{torn:?}");
        }
        assert_eq!(Packed::of(&[[256, 0]; 4], closed.into_iter()), None);
        assert_eq!(Packed::of(&ids, closed.into_iter().take(3)), None);
    }

    #[test]
    fn a_cache_is_at_most_64_bytes() {
        assert!(size_of::<PairCache>() <= 64, "{}", size_of::<PairCache>());
    }
}
