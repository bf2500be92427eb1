//! parry3d's nonlinear cast.

use super::families::Case;
use crate::parry_types::{pose, shape};
use bryla::impact::{Motion, Moving};
use parry3d_f64::math::Vector;
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

fn motion(motion: &Motion) -> NonlinearRigidMotion {
    let vector = |v: &bryla::math::Vector3| Vector::new(v.x, v.y, v.z);
    NonlinearRigidMotion::new(
        pose(&motion.at(0.0).pose),
        vector(&motion.center),
        vector(&motion.velocity),
        vector(&motion.angular_velocity),
    )
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
