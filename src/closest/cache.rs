//! What a pair remembers from one query to the next.

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
    /// Vertices of two polyhedra; of an overlap those that enclose it.
    Vertices { pairs: [[u16; 2]; PairCache::CAPACITY], count: u8, inside: bool },
    /// The normal of a pair with a curved body, good for a start.
    Normal([f32; 3]),
}

impl PairCache {
    /// How many pairs of vertices are remembered: 4 of a simplex and what encloses a shallow overlap.
    pub(crate) const CAPACITY: usize = 14;

    /// An empty cache.
    pub fn new() -> Self {
        Self::default()
    }

    /// The remembered pairs that both bodies have vertices for, no two alike, and whether they enclosed an
    /// overlap.
    #[inline]
    pub(super) fn load(
        &self,
        a: &ConvexPolyhedron,
        b: &ConvexPolyhedron,
        into: &mut [Ids; Self::CAPACITY],
    ) -> (usize, bool) {
        let Memory::Vertices { pairs, count: stored, inside } = &self.memory else { return (0, false) };
        let mut count = 0;
        for pair in pairs.iter().take(usize::from(*stored)) {
            let ids = pair.map(u32::from);
            if (ids[0] as usize) < a.vertices().len() && (ids[1] as usize) < b.vertices().len() {
                into[count] = ids;
                count += 1;
            }
        }
        (count, *inside)
    }

    /// Remembers pairs, no two of which are alike; vertices beyond number 65,535 are not remembered.
    #[inline]
    pub(super) fn store(&mut self, ids: &[Ids], inside: bool) {
        if !matches!(self.memory, Memory::Vertices { .. }) {
            self.memory = Memory::Vertices { pairs: [[0; 2]; Self::CAPACITY], count: 0, inside };
        }
        let Memory::Vertices { pairs, count, inside: was_inside } = &mut self.memory else { return };
        (*count, *was_inside) = (0, inside);
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
    fn a_cache_is_at_most_64_bytes() {
        assert!(size_of::<PairCache>() <= 64, "{}", size_of::<PairCache>());
    }
}
