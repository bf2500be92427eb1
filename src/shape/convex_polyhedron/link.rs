//! How vertices, half-edges and faces hang together, and the walls between their Voronoi regions.

use std::collections::BTreeMap;

use super::vector::{add, area_vector, cross, dot, norm, sub, unit};
use super::{Block, ConvexPolyhedron, Edge, Face, HalfEdge, NONE};

impl ConvexPolyhedron {
    /// Rings, half-edges, faces and the walls of the Voronoi regions.
    pub(super) fn link(&mut self, triangles: &[[u32; 3]], loops: &[Vec<u32>]) {
        let count = self.about_center.len();
        let sides = |corners: &[u32]| {
            let n = corners.len();
            (0..n).map(|k| (corners[k], corners[(k + 1) % n])).collect::<Vec<_>>()
        };

        // rings: along the triangles of a solid, around a polygon, from end to end of a segment
        let mut pairs: Vec<(u32, u32)> = match self.rank {
            3 => triangles.iter().flat_map(|t| sides(t)).collect(),
            2 => loops.iter().flat_map(|l| sides(l)).collect(),
            1 => vec![(0, 1), (1, 0)],
            _ => Vec::new(),
        };
        pairs.sort_unstable();
        pairs.dedup();
        (self.ring_start, self.ring) = grouped(count, &pairs);
        let all: Vec<u32> = (0..).take(count).collect();
        self.blocks = Block::of(&self.about_center, &all);
        self.ring_block_start.push(0);
        for vertex in 0..count {
            let ring = Block::of(&self.about_center, self.ring(vertex));
            self.ring_blocks.extend(ring);
            self.ring_block_start.push(u32::try_from(self.ring_blocks.len()).unwrap_or(NONE));
        }

        // half-edges, the twins next to each other
        let mut half_edge_of: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let unlinked = HalfEdge { origin: NONE, next: NONE, face: None, inward: [0.0; 3] };
        let mut make = |half_edges: &mut Vec<HalfEdge>, from: u32, to: u32| {
            if let Some(&h) = half_edge_of.get(&(from, to)) {
                return h;
            }
            let h = u32::try_from(half_edges.len()).unwrap_or(NONE);
            half_edges.extend([from, to].map(|origin| HalfEdge { origin, ..unlinked }));
            half_edge_of.extend([((from, to), h), ((to, from), h + 1)]);
            h
        };
        if self.rank == 1 {
            let h = make(&mut self.half_edges, 0, 1) as usize;
            (self.half_edges[h].next, self.half_edges[h + 1].next) = (1, 0);
        }
        for (f, corners) in (0..).zip(loops) {
            let around: Vec<u32> = sides(corners).iter().map(|&(i, j)| make(&mut self.half_edges, i, j)).collect();
            for (&h, &next) in around.iter().zip(around.iter().cycle().skip(1)) {
                self.half_edges[h as usize].next = next;
                self.half_edges[h as usize].face = Some(f);
            }
            self.faces.push(self.face(corners, around[0]));
        }

        // walls: along each edge, and inwards from each half-edge
        for e in 0..self.half_edges.len() / 2 {
            let [i, j] = self.edge_vertices(e);
            let along = sub(&self.about_center[j], &self.about_center[i]);
            let length = norm(&along);
            self.edges.push(Edge { direction: along.map(|x| x / length), length });
        }
        for h in 0..self.half_edges.len() {
            let u = self.edges[h / 2].direction;
            let u = if h % 2 == 0 { u } else { u.map(|x| -x) };
            if let Some(f) = self.half_edges[h].face {
                self.half_edges[h].inward = unit(&cross(&self.faces[f as usize].normal, &u));
            }
        }

        // what meets in each vertex
        let mut meeting: Vec<(u32, u32)> = (0..).zip(loops).flat_map(|(f, l)| l.iter().map(move |&v| (v, f))).collect();
        meeting.sort_unstable();
        (self.faces_at_start, self.faces_at) = grouped(count, &meeting);
        let mut leaving: Vec<(u32, u32)> = self.half_edges.iter().zip(0..).map(|(h, k)| (h.origin, k)).collect();
        leaving.sort_unstable();
        (self.leaving_start, self.leaving) = grouped(count, &leaving);
        self.leaving_to = self.leaving.iter().map(|&h| self.half_edges[(h ^ 1) as usize].origin).collect();
    }

    /// The plane of a loop of vertices: its area vector (Newell), moved out to hold the whole body.
    fn face(&self, corners: &[u32], half_edge: u32) -> Face {
        let at = |k: usize| &self.about_center[corners[k] as usize];
        let area = (2..corners.len()).fold([0.0; 3], |sum, k| add(&sum, &area_vector(at(0), at(k - 1), at(k))));
        let normal = unit(&area);
        let height = |v: &[f64; 3]| dot(&normal, v);
        let offset = self.about_center.iter().map(height).fold(f64::MIN, f64::max);
        let lowest = corners.iter().map(|&k| height(&self.about_center[k as usize])).fold(f64::MAX, f64::min);
        Face {
            normal,
            offset,
            fit_error: offset - lowest,
            half_edge,
            sides: u32::try_from(corners.len()).unwrap_or(NONE),
        }
    }
}

/// Sorted pairs as a table: where each first member's entries start, and the second members.
fn grouped(count: usize, pairs: &[(u32, u32)]) -> (Vec<u32>, Vec<u32>) {
    let starts = (0..=count).map(|i| pairs.partition_point(|p| (p.0 as usize) < i));
    (starts.map(|k| u32::try_from(k).unwrap_or(NONE)).collect(), pairs.iter().map(|p| p.1).collect())
}
