//! parry3d's nonlinear cast: its types are converted here.

use super::families::Case;
use bryla::impact::{Motion, Moving};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query::{NonlinearRigidMotion, ShapeCastStatus, cast_shapes_nonlinear};
use parry3d_f64::shape::ConvexPolyhedron as ParryPolyhedron;

/// A pair as parry holds it.
pub(crate) struct Pair {
    a: ParryPolyhedron,
    motion_a: NonlinearRigidMotion,
    b: ParryPolyhedron,
    motion_b: NonlinearRigidMotion,
}

/// What parry says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Answer {
    Clear,
    At(f64),
    Failed,
}

fn shape(body: &ConvexPolyhedron) -> Option<ParryPolyhedron> {
    let points: Vec<Vector> = body.vertices().iter().map(|v| Vector::new(v[0], v[1], v[2])).collect();
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

fn motion(motion: &Motion) -> NonlinearRigidMotion {
    let pose = motion.at(0.0).pose;
    let (q, x) = (pose.orientation, pose.position);
    let pose = ParryPose { rotation: Rotation::from_xyzw(q.i, q.j, q.k, q.w), translation: Vector::new(x.x, x.y, x.z) };
    let vector = |v: &bryla::math::Vector3| Vector::new(v.x, v.y, v.z);
    NonlinearRigidMotion::new(pose, vector(&motion.center), vector(&motion.velocity), vector(&motion.angular_velocity))
}

impl Pair {
    /// The pair; none where parry does not accept a body.
    pub(crate) fn new(case: &Case) -> Option<Self> {
        Some(Self {
            a: shape(&case.a)?,
            motion_a: motion(&case.motion_a),
            b: shape(&case.b)?,
            motion_b: motion(&case.motion_b),
        })
    }

    /// The first impact in 0..=1 s.
    pub(crate) fn cast(&self) -> Answer {
        match cast_shapes_nonlinear(&self.motion_a, &self.a, &self.motion_b, &self.b, 0.0, 1.0, true) {
            Ok(None) => Answer::Clear,
            Ok(Some(hit)) if hit.status == ShapeCastStatus::Failed => Answer::Failed,
            Ok(Some(hit)) => Answer::At(hit.time_of_impact),
            Err(_) => Answer::Failed,
        }
    }
}
