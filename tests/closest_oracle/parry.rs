//! parry3d as a second opinion: its vectors are converted here.

use bryla::math::Pose;
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::ConvexPolyhedron as ParryPolyhedron;

/// What parry says.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Answer {
    /// 0 for overlapping bodies, by its contract.
    pub(crate) distance: f64,
    /// Signed; none where it found no contact.
    pub(crate) contact: Option<f64>,
}

fn shape(body: &ConvexPolyhedron) -> Option<ParryPolyhedron> {
    let points: Vec<Vector> = body.vertices().iter().map(|v| Vector::new(v[0], v[1], v[2])).collect();
    if body.rank() < 3 {
        return None;
    }
    // fans over the faces: its own hull drops vertices of thin bodies
    let index = |k: usize| u32::try_from(k).unwrap();
    let triangles: Vec<[u32; 3]> = (0..body.faces().len())
        .flat_map(|f| {
            let corners: Vec<usize> = body.face_vertices(f).collect();
            (2..corners.len())
                .map(|k| [index(corners[0]), index(corners[k - 1]), index(corners[k])])
                .collect::<Vec<_>>()
        })
        .collect();
    ParryPolyhedron::from_convex_mesh(points, &triangles)
}

fn pose(pose: &Pose) -> ParryPose {
    let (q, x) = (pose.orientation, pose.position);
    ParryPose { rotation: Rotation::from_xyzw(q.i, q.j, q.k, q.w), translation: Vector::new(x.x, x.y, x.z) }
}

/// parry's answers; none for bodies that it does not accept.
pub(crate) fn query(a: &ConvexPolyhedron, pose_a: &Pose, b: &ConvexPolyhedron, pose_b: &Pose) -> Option<Answer> {
    let (a, b, pose_a, pose_b) = (shape(a)?, shape(b)?, pose(pose_a), pose(pose_b));
    let distance = query::distance(&pose_a, &a, &pose_b, &b).ok()?.distance;
    let contact = query::contact(&pose_a, &a, &pose_b, &b, f64::MAX).ok()?.map(|c| c.dist);
    Some(Answer { distance, contact })
}
