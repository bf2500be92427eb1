//! A solid with flat faces.

use super::Solid;
use crate::error::Result;
use crate::mass::{MassProperties, polyhedron, surface};
use crate::math::Vector3;

/// A solid enclosed by flat faces; convex or not, of one part or several, cavities included.
///
/// Each face lists its vertices counterclockwise, seen from outside. What must hold for the faces to
/// enclose a solid is told by [`surface::check`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Polyhedron {
    /// Vertices [m]; unused ones are allowed.
    pub vertices: Vec<[f64; 3]>,
    /// Faces, each as three or more numbers of vertices (from 0).
    pub faces: Vec<Vec<usize>>,
}

impl Polyhedron {
    /// A solid from its vertices [m] and faces.
    pub fn new(vertices: impl Into<Vec<[f64; 3]>>, faces: impl Into<Vec<Vec<usize>>>) -> Self {
        Self { vertices: vertices.into(), faces: faces.into() }
    }
}

impl Solid for Polyhedron {
    fn validate(&self, place: &str) -> Result<()> {
        surface::check(place, &self.vertices, &self.faces)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        polyhedron::mass_properties(place, &self.vertices, &self.faces, density)
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        self.vertices.iter().map(|&v| (Vector3::from(v) - about).norm()).fold(0.0, f64::max)
    }

    /// All listed vertices, in their order.
    fn vertices(&self) -> Option<Vec<Vector3>> {
        Some(self.vertices.iter().map(|&v| v.into()).collect())
    }
}
