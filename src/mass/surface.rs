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
    for (v, p) in vertices.iter().enumerate() {
        if !p.iter().all(|x| x.is_finite()) {
            return Err(Error::mesh(place, format!("vertex {v} must be finite, got {p:?}")));
        }
    }
    if faces.is_empty() {
        return Err(Error::mesh(place, "has no faces"));
    }
    for (f, face) in faces.iter().enumerate() {
        check_indices(f, face, vertices.len()).map_err(|reason| Error::mesh(place, reason))?;
    }
    check_edges(faces).map_err(|reason| Error::mesh(place, reason))?;
    check_planes(vertices, faces).map_err(|reason| Error::mesh(place, reason))?;

    let filled = polyhedron::filled_fraction(vertices, faces);
    if filled.abs() <= tolerance::VOLUME {
        return Err(Error::mesh(place, "encloses no volume"));
    }
    if filled < 0.0 {
        return Err(Error::mesh(place, "is inside out: list the vertices of every face the other way round"));
    }
    Ok(())
}

fn check_indices(f: usize, face: &[usize], vertices: usize) -> Result<(), String> {
    if face.len() < 3 {
        return Err(format!("face {f} has {} vertices, needs at least 3", face.len()));
    }
    if let Some(v) = face.iter().find(|&&v| v >= vertices) {
        return Err(format!("face {f} names vertex {v}, but there are {vertices} (numbered from 0)"));
    }
    let mut sorted = face.to_vec();
    sorted.sort_unstable();
    if let Some(k) = (1..sorted.len()).find(|&k| sorted[k - 1] == sorted[k]) {
        return Err(format!("face {f} names vertex {} twice", sorted[k]));
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
        let edge = format!("{}–{}", group[0].edge.0, group[0].edge.1);
        match group {
            [side] => open.push(format!("{edge} (face {})", side.face)),
            [a, b] if a.upward == b.upward => parallel.push(format!("{edge} (faces {} and {})", a.face, b.face)),
            [_, _] => {}
            more => crowded.push(format!("{edge} ({} faces)", more.len())),
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
    let first = used().next().unwrap_or_default();
    let size = 2.0 * used().fold(0.0, |most: f64, p| most.max((p - first).amax()));

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
