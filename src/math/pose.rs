//! Where a body frame stands in the world.

use crate::math::{Quaternion, Vector3, quaternion};

/// Position and orientation of a frame: a point `p₀` of it is found at `R p₀ + x` (lecture §1).
///
/// The orientation is a unit quaternion; [`Pose::new`] divides by its length.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Where the frame's origin stands, world axes [m].
    pub position: Vector3,
    /// Rotation from the frame's axes to the world's; of unit length.
    pub orientation: Quaternion,
}

impl Pose {
    /// A pose from a position [m] and an orientation `(w, x, y, z)`, of which `q/|q|` is taken.
    pub fn new(position: impl Into<Vector3>, orientation: [f64; 4]) -> Self {
        Self {
            position: position.into(),
            orientation: quaternion::normalized(&quaternion::from_scalar_first(orientation)),
        }
    }

    /// The frame of the world.
    pub fn identity() -> Self {
        Self { position: Vector3::zeros(), orientation: Quaternion::identity() }
    }

    /// World coordinates of a point given in the frame [m].
    pub fn point(&self, body: &Vector3) -> Vector3 {
        quaternion::rotate(&self.orientation, body) + self.position
    }

    /// World components of a vector given in the frame, lecture (1).
    pub fn vector(&self, body: &Vector3) -> Vector3 {
        quaternion::rotate(&self.orientation, body)
    }

    /// Frame coordinates of a point given in the world [m].
    pub fn inverse_point(&self, world: &Vector3) -> Vector3 {
        quaternion::rotate(&self.orientation.conjugate(), &(world - self.position))
    }

    /// Frame components of a vector given in world axes.
    pub fn inverse_vector(&self, world: &Vector3) -> Vector3 {
        quaternion::rotate(&self.orientation.conjugate(), world)
    }
}
