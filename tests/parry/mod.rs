//! Bodies and poses as parry3d holds them.

use bryla::math::Pose;
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::shape::ConvexPolyhedron as ParryPolyhedron;

/// None where parry does not accept a body, such as one without thickness.
pub(crate) fn shape(body: &ConvexPolyhedron) -> Option<ParryPolyhedron> {
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

pub(crate) fn pose(pose: &Pose) -> ParryPose {
    let (q, x) = (pose.orientation, pose.position);
    ParryPose { rotation: Rotation::from_xyzw(q.i, q.j, q.k, q.w), translation: Vector::new(x.x, x.y, x.z) }
}
