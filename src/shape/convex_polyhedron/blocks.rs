//! Vertices in fours, so that the machine works out their heights side by side.

use wide::f64x4;

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
    fn heights(&self, d: &[f64; 3]) -> f64x4 {
        let [x, y, z] = [self.x, self.y, self.z].map(f64x4::from);
        let [a, b, c] = d.map(f64x4::splat);
        x * a + y * b + z * c
    }

    /// The vertices at a height along `d` from `floor` on, and their heights.
    #[inline]
    pub(crate) fn at_least(&self, floor: f64, d: &[f64; 3]) -> impl Iterator<Item = (u32, f64)> {
        let heights = self.heights(d);
        let mut left = heights.simd_ge(f64x4::splat(floor)).to_bitmask();
        std::iter::from_fn(move || {
            let lane = left.trailing_zeros() as usize;
            left &= left.wrapping_sub(1);
            Some((*self.ids.get(lane)?, heights.to_array()[lane]))
        })
    }
}

/// Whether a vertex other than two is at a height along `d` from `floor` on.
#[inline]
pub(crate) fn others_reach(blocks: &[Block], floor: f64, d: &[f64; 3], two: [u32; 2]) -> bool {
    blocks.iter().any(|block| {
        let mut high = block.heights(d).simd_ge(f64x4::splat(floor)).to_bitmask();
        while high != 0 {
            let id = block.ids[high.trailing_zeros() as usize % 4];
            if id != two[0] && id != two[1] {
                return true;
            }
            high &= high - 1;
        }
        false
    })
}

/// The height of the highest vertex along `d`; of none `f64::MIN`.
#[inline]
pub(crate) fn top_of(blocks: &[Block], d: &[f64; 3]) -> f64 {
    let tops = blocks.iter().fold(f64x4::splat(f64::MIN), |tops, block| block.heights(d).fast_max(tops)).to_array();
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    larger(larger(tops[0], tops[2]), larger(tops[1], tops[3]))
}

/// The first of the highest vertices along `d`, and its height.
#[inline]
pub(crate) fn highest(blocks: &[Block], d: &[f64; 3]) -> (u32, f64) {
    let mut best = (0, f64::MIN);
    for block in blocks {
        for (k, h) in block.ids.iter().zip(block.heights(d).to_array()) {
            if h > best.1 {
                best = (*k, h);
            }
        }
    }
    best
}
