//! Vertices in fours, so that the machine works out their heights side by side.

use super::vector::dot;

/// Four vertices about the centre, body axes [m]; where fewer are left, the first of them again.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Block {
    x: [f64; 4],
    y: [f64; 4],
    z: [f64; 4],
    ids: [u32; 4],
}

impl Block {
    /// Blocks of the listed vertices.
    pub(super) fn of(vertices: &[[f64; 3]], list: &[u32]) -> Vec<Self> {
        let block = |four: &[u32]| {
            let ids: [u32; 4] = std::array::from_fn(|k| four.get(k).copied().unwrap_or(four[0]));
            let [x, y, z] = [0, 1, 2].map(|i| ids.map(|v| vertices[v as usize][i]));
            Self { x, y, z, ids }
        };
        list.chunks(4).map(block).collect()
    }

    /// The height of each along `d`.
    #[inline]
    pub(crate) fn heights(&self, d: &[f64; 3]) -> [f64; 4] {
        std::array::from_fn(|k| dot(&[self.x[k], self.y[k], self.z[k]], d))
    }

    /// Which vertices they are.
    #[inline]
    pub(crate) fn ids(&self) -> &[u32; 4] {
        &self.ids
    }
}

/// The larger number; the second where one is none.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The largest of four heights.
#[inline]
pub(crate) fn highest_of(h: &[f64; 4]) -> f64 {
    larger(larger(h[0], h[2]), larger(h[1], h[3]))
}

/// The height of the highest vertex along `d`; of none `f64::MIN`.
#[inline]
pub(crate) fn top_of(blocks: &[Block], d: &[f64; 3]) -> f64 {
    let mut tops = [f64::MIN; 4];
    for block in blocks {
        let h = block.heights(d);
        tops = std::array::from_fn(|k| larger(h[k], tops[k]));
    }
    highest_of(&tops)
}

/// The first of the highest vertices along `d`, and its height.
#[inline]
pub(crate) fn highest(blocks: &[Block], d: &[f64; 3]) -> (u32, f64) {
    let mut best = (0, f64::MIN);
    for block in blocks {
        for (k, h) in block.ids.iter().zip(block.heights(d)) {
            if h > best.1 {
                best = (*k, h);
            }
        }
    }
    best
}
