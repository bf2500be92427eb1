//! parry3d as a second opinion.

use bryla::math::Pose;
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use parry3d_f64::query;

use crate::parry_types::{pose, shape};

/// What parry says.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Answer {
    /// 0 for overlapping bodies, by its contract.
    pub(crate) distance: f64,
    /// Signed; none where it found no contact.
    pub(crate) contact: Option<f64>,
}

/// parry's answers; none for bodies that it does not accept.
pub(crate) fn query(a: &ConvexPolyhedron, pose_a: &Pose, b: &ConvexPolyhedron, pose_b: &Pose) -> Option<Answer> {
    let (a, b, pose_a, pose_b) = (shape(a)?, shape(b)?, pose(pose_a), pose(pose_b));
    let distance = query::distance(&pose_a, &a, &pose_b, &b).ok()?.distance;
    let contact = query::contact(&pose_a, &a, &pose_b, &b, f64::MAX).ok()?.map(|c| c.dist);
    Some(Answer { distance, contact })
}
