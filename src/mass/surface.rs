//! When a list of faces encloses a solid.
//!
//! Faces list their vertices counterclockwise, seen from outside. Then each edge is run along twice,
//! once each way, by exactly two faces; every other count leaves the inside undefined and the volume
//! integrals without meaning. Nothing is repaired: the message names the edges or faces, and the user
//! knows what was meant.
//!
//! What is not looked for is a surface that passes through itself: overlapping parts count twice.
//! Several closed parts in one list are fine, and so are cavities (a part inside, facing inwards).

use crate::error::{Error, Result};
use crate::mass::polyhedron;
use crate::math::Vector3;
use crate::tolerance;

/// Refuses faces that do not enclose a solid.
///
/// # Errors
/// Names `place` and, by number from 0, the first few
/// - vertices that are not finite;
/// - faces of fewer than three vertices, with an index out of range, with a vertex twice, without an area
///   though of more than three vertices, or bent beyond [`tolerance::FACE_PLANARITY`];
/// - edges that belong to one face only, to more than two, or to two that run along them the same way;
///
/// and whole surfaces that are inside out or without volume ([`tolerance::VOLUME`]).
pub fn check(place: &str, vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> Result<()> {
    check_faces(place, vertices, faces)?;
    check_volume(place, polyhedron::filled_fraction(vertices, faces))
}

/// All of [`check`] but the volume.
pub(super) fn check_faces(place: &str, vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> Result<()> {
    for (v, p) in vertices.iter().enumerate() {
        if !p.iter().all(|x| x.is_finite()) {
            return Err(Error::mesh(place, format!("vertex {v} must be finite, got {p:?}")));
        }
    }
    if faces.is_empty() {
        return Err(Error::mesh(place, "has no faces"));
    }
    check_indices(vertices, faces)
        .and_then(|()| check_edges(faces))
        .and_then(|()| check_planes(vertices, faces))
        .map_err(|reason| Error::mesh(place, reason))
}

/// Refuses a surface that fills none of its bounding box, or a negative fraction.
pub(super) fn check_volume(place: &str, filled: f64) -> Result<()> {
    if filled.abs() <= tolerance::VOLUME {
        return Err(Error::mesh(place, "encloses no volume"));
    }
    if filled < 0.0 {
        return Err(Error::mesh(place, "is inside out: list the vertices of every face the other way round"));
    }
    Ok(())
}

fn check_indices(vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> Result<(), String> {
    let count = vertices.len();
    let mut sorted = Vec::new();
    for (f, face) in faces.iter().enumerate() {
        if face.len() < 3 {
            return Err(format!("face {f} has {} vertices, needs at least 3", face.len()));
        }
        if let Some(v) = face.iter().find(|&&v| v >= count) {
            return Err(format!("face {f} names vertex {v}, but there are {count} (numbered from 0)"));
        }
        sorted.clone_from(face);
        sorted.sort_unstable();
        if let Some(k) = (1..sorted.len()).find(|&k| sorted[k - 1] == sorted[k]) {
            return Err(format!("face {f} names vertex {} twice", sorted[k]));
        }
    }
    Ok(())
}

/// One passage of a face along an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    /// Its two vertices, the smaller number first.
    edge: (usize, usize),
    /// Whether the face runs from the smaller number to the larger.
    upward: bool,
    face: usize,
}

fn check_edges(faces: &[Vec<usize>]) -> Result<(), String> {
    // every passage, those along one edge next to each other
    let mut sides: Vec<Side> = Vec::with_capacity(faces.iter().map(Vec::len).sum());
    for (face, corners) in faces.iter().enumerate() {
        for (k, &from) in corners.iter().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            sides.push(Side { edge: (from.min(to), from.max(to)), upward: from < to, face });
        }
    }
    sides.sort_unstable();

    let (mut open, mut crowded, mut parallel) = (Vec::new(), Vec::new(), Vec::new());
    for group in sides.chunk_by(|a, b| a.edge == b.edge) {
        let (from, to) = group[0].edge;
        match group {
            [a, b] if a.upward != b.upward => {}
            [a] => open.push(format!("{from}–{to} (face {})", a.face)),
            [a, b] => parallel.push(format!("{from}–{to} (faces {} and {})", a.face, b.face)),
            more => crowded.push(format!("{from}–{to} ({} faces)", more.len())),
        }
    }
    for (edges, trouble) in [
        (open, "is not closed: only one face has edge"),
        (crowded, "is no surface: more than two faces share edge"),
        (parallel, "has faces that disagree on which side is out: both run the same way along edge"),
    ] {
        if !edges.is_empty() {
            return Err(format!("{trouble} {}", shortened(&edges)));
        }
    }
    Ok(())
}

fn check_planes(vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> Result<(), String> {
    if faces.iter().all(|face| face.len() == 3) {
        return Ok(());
    }
    let used = || faces.iter().flatten().map(|&v| Vector3::from(vertices[v]));
    let unbounded = Vector3::repeat(f64::INFINITY);
    let (low, high) = used().fold((unbounded, -unbounded), |(low, high), p| (low.inf(&p), high.sup(&p)));
    let size = (high - low).amax();

    let (mut bent, mut flat) = (Vec::new(), Vec::new());
    for (f, face) in faces.iter().enumerate().filter(|(_, face)| face.len() > 3) {
        // in units of the size, from the face's first vertex
        let corners: Vec<Vector3> =
            face.iter().map(|&v| (Vector3::from(vertices[v]) - Vector3::from(vertices[face[0]])) / size).collect();
        let middle = corners.iter().sum::<Vector3>() / corners.len() as f64;
        let area: Vector3 = corners[1..].windows(2).map(|edge| edge[0].cross(&edge[1])).sum();
        let length = area.norm();
        let off = corners.iter().map(|p| area.dot(&(p - middle)).abs()).fold(0.0, f64::max);
        if length == 0.0 {
            flat.push(format!("{f}"));
        } else if off > tolerance::FACE_PLANARITY * length {
            bent.push(format!("{f} (by {:.2e} m)", off / length * size));
        }
    }
    if !flat.is_empty() {
        return Err(format!("has no area in face {}", shortened(&flat)));
    }
    if !bent.is_empty() {
        return Err(format!("is not flat in face {}; split it into triangles", shortened(&bent)));
    }
    Ok(())
}

/// How many edges or faces a message names [-].
const NAMED: usize = 3;

fn shortened(items: &[String]) -> String {
    let named = items[..items.len().min(NAMED)].join(", ");
    if items.len() > NAMED { format!("{named} and {} more", items.len() - NAMED) } else { named }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cube of edge 2 with corners numbered by the bits of x, y, z.
    fn cube() -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
        let corner = |k: usize| [k & 1, k >> 1 & 1, k >> 2].map(|bit| if bit == 1 { 1.0 } else { -1.0 });
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        ((0..8).map(corner).collect(), faces.map(Vec::from).into())
    }

    fn refusal(vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> String {
        check("body die", vertices, faces).unwrap_err().to_string()
    }

    #[test]
    fn a_cube_is_fine_also_with_unused_vertices_and_a_cavity() {
        let (mut vertices, mut faces) = cube();
        check("body die", &vertices, &faces).unwrap();
        vertices.push([1e6, 0.0, 0.0]);
        check("body die", &vertices, &faces).unwrap();

        // a smaller cube inside, facing inwards
        let (inner, inner_faces) = cube();
        vertices.extend(inner.iter().map(|v| v.map(|x| 0.5 * x)));
        faces.extend(inner_faces.into_iter().map(|f| f.into_iter().rev().map(|v| v + 9).collect()));
        check("body die", &vertices, &faces).unwrap();
        assert!((polyhedron::filled_fraction(&vertices, &faces) - 7.0 / 8.0).abs() < 1e-15);
    }

    #[test]
    fn vertices_must_be_finite() {
        let (mut vertices, faces) = cube();
        vertices[3][1] = f64::NAN;
        assert_eq!(refusal(&vertices, &faces), "body die: vertex 3 must be finite, got [1.0, NaN, -1.0]");
    }

    #[test]
    fn faces_must_be_polygons_of_known_vertices() {
        let (vertices, faces) = cube();
        assert_eq!(refusal(&vertices, &[]), "body die: has no faces");
        let with = |face: &[usize]| [faces[..5].to_vec(), vec![face.to_vec()]].concat();
        assert_eq!(refusal(&vertices, &with(&[1, 3])), "body die: face 5 has 2 vertices, needs at least 3");
        assert_eq!(
            refusal(&vertices, &with(&[1, 3, 8, 5])),
            "body die: face 5 names vertex 8, but there are 8 (numbered from 0)"
        );
        assert_eq!(refusal(&vertices, &with(&[1, 3, 7, 3, 5])), "body die: face 5 names vertex 3 twice");
    }

    #[test]
    fn each_edge_must_have_two_faces_running_opposite_ways() {
        let (vertices, faces) = cube();
        assert_eq!(
            refusal(&vertices, &faces[..5]),
            "body die: is not closed: only one face has edge 1–3 (face 0), 1–5 (face 2), 3–7 (face 3) and 1 more"
        );
        let doubled = [faces.clone(), faces[5..].to_vec()].concat();
        assert_eq!(
            refusal(&vertices, &doubled),
            "body die: is no surface: more than two faces share edge 1–3 (3 faces), 1–5 (3 faces), 3–7 (3 faces) \
             and 1 more"
        );
        let mut turned = faces.clone();
        turned[5].reverse();
        assert_eq!(
            refusal(&vertices, &turned),
            "body die: has faces that disagree on which side is out: both run the same way along edge \
             1–3 (faces 0 and 5), 1–5 (faces 2 and 5), 3–7 (faces 3 and 5) and 1 more"
        );
    }

    #[test]
    fn polygons_must_be_flat_and_have_an_area() {
        let (mut vertices, mut faces) = cube();
        // z = 9/8 + (x + y + xy)/8 at the corners, so all are 1/8 / √(1 + 2/64) from the plane without xy
        vertices[7] = [1.0, 1.0, 1.5];
        assert_eq!(
            refusal(&vertices, &faces),
            "body die: is not flat in face 1 (by 1.23e-1 m); split it into triangles"
        );
        // a corner raised by h is h/4 off, and 1e-5 of 2 m are allowed
        vertices[7] = [1.0, 1.0, 1.0 + 7e-5];
        check("body die", &vertices, &faces).unwrap();
        vertices[7] = [1.0, 1.0, 1.0 + 9e-5];
        check("body die", &vertices, &faces).unwrap_err();

        // a pocket of four vertices on a line
        let (mut vertices, _) = cube();
        vertices.extend([[0.0, -1.0, -1.0], [0.5, -1.0, -1.0]]);
        faces[0] = vec![0, 2, 3, 1, 9, 8];
        faces.push(vec![0, 8, 9, 1]);
        assert_eq!(refusal(&vertices, &faces), "body die: has no area in face 6");
    }

    #[test]
    fn the_inside_must_be_in_and_not_empty() {
        let (vertices, mut faces) = cube();
        for face in &mut faces {
            face.reverse();
        }
        assert_eq!(
            refusal(&vertices, &faces),
            "body die: is inside out: list the vertices of every face the other way round"
        );
        for plate in [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0]] {
            let flat: Vec<_> = vertices.iter().map(|v| [0, 1, 2].map(|i| v[i] * plate[i])).collect();
            let triangles: Vec<Vec<usize>> =
                faces.iter().flat_map(|f| [vec![f[0], f[1], f[2]], vec![f[0], f[2], f[3]]]).collect();
            assert_eq!(refusal(&flat, &triangles), "body die: encloses no volume");
            // slanted, with 50 digits a coordinate that add exactly: the sum of 150 digits is only zero
            // to rounding
            let digits = |x: f64| libm::ldexp(libm::round(libm::ldexp(x, 50)), -50);
            let slanted: Vec<_> = flat
                .iter()
                .enumerate()
                .map(|(k, v)| [digits(0.1 * v[0] + 0.03 * k as f64), digits(0.7 * v[1])])
                .map(|[x, y]| [x, y, x + y])
                .collect();
            assert_eq!(refusal(&slanted, &triangles), "body die: encloses no volume");
        }
        // thin as it may be, a plate is a solid
        let (vertices, faces) = cube();
        let plate: Vec<_> = vertices.iter().map(|v| [v[0], v[1], 1e-15 * v[2]]).collect();
        check("body die", &plate, &faces).unwrap();
    }
}
