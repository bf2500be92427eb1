//! A table of directions on a cube, and the vertex that is farthest along each: where climbs start.

use super::ConvexPolyhedron;

impl ConvexPolyhedron {
    /// For large bodies, the farthest vertex for a grid of directions on a cube.
    pub(super) fn seed(&mut self) {
        let cells = cells_per_side(self.about_center.len());
        let mut at = 0;
        let mut seeds = Vec::with_capacity(6 * cells * cells);
        for cell in 0..6 * cells * cells {
            at = self.climb(at, &cube_direction(cell, cells));
            seeds.push(u32::try_from(at).unwrap_or(0));
        }
        self.seeds = seeds;
    }
}

/// Cells along each side of the cube of directions; up to this many vertices a climb is short anyway.
pub(super) fn cells_per_side(vertices: usize) -> usize {
    match vertices {
        0..24 => 0,
        24..96 => 2,
        96..384 => 4,
        384..1536 => 8,
        _ => 12,
    }
}

/// The cell of the cube of directions that a direction points through.
#[inline]
pub(super) fn cube_cell(d: &[f64; 3], cells: usize) -> usize {
    let [x, y, z] = d.map(f64::abs);
    let axis = if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    };
    let scale = 0.5 * cells as f64 / d[axis].abs();
    // a direction of length zero or NaN has no cell; the cast makes it the first
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, then clamped")]
    let cell = |v: f64| ((v * scale + 0.5 * cells as f64) as usize).min(cells - 1);
    let side = 2 * axis + usize::from(d[axis] < 0.0);
    (side * cells + cell(d[(axis + 1) % 3])) * cells + cell(d[(axis + 2) % 3])
}

/// The direction through the middle of a cell.
fn cube_direction(cell: usize, cells: usize) -> [f64; 3] {
    let (side, u, v) = (cell / (cells * cells), cell / cells % cells, cell % cells);
    let middle = |k: usize| (2.0 * k as f64 + 1.0) / cells as f64 - 1.0;
    let axis = side / 2;
    let mut d = [0.0; 3];
    d[axis] = if side % 2 == 0 { 1.0 } else { -1.0 };
    d[(axis + 1) % 3] = middle(u);
    d[(axis + 2) % 3] = middle(v);
    d
}
