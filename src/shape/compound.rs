//! Several shapes joined into one.

use std::path::Path;

use super::{Shape, Solid, require_finite};
use crate::error::{Error, Result};
use crate::mass::MassProperties;
use crate::math::{Pose, Quaternion, Vector3, quaternion};
use crate::tolerance;

/// Several shapes, each placed in the compound's axes, joined into one rigid shape.
///
/// Where pieces overlap, their matter counts twice.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Compound {
    /// The pieces; at least one.
    pub pieces: Vec<Piece>,
}

/// One shape of a [`Compound`] and where it stands.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Piece {
    /// The shape, in its own axes.
    pub shape: Shape,
    /// Where the origin of the shape's axes stands in the compound's [m].
    #[cfg_attr(feature = "serde", serde(default))]
    pub position: [f64; 3],
    /// Rotation `(w, x, y, z)` from the shape's axes to the compound's.
    #[cfg_attr(feature = "serde", serde(default = "unturned"))]
    pub orientation: [f64; 4],
}

/// The rotation by nothing.
fn unturned() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

impl Piece {
    /// A shape whose axes are the compound's.
    pub fn new(shape: impl Into<Shape>) -> Self {
        Self { shape: shape.into(), position: [0.0; 3], orientation: unturned() }
    }

    /// The same piece with the origin of its axes at `position` [m].
    #[must_use]
    pub fn position(mut self, position: impl Into<[f64; 3]>) -> Self {
        self.position = position.into();
        self
    }

    /// The same piece turned by the unit quaternion `orientation`, `(w, x, y, z)`.
    #[must_use]
    pub fn orientation(mut self, orientation: impl Into<[f64; 4]>) -> Self {
        self.orientation = orientation.into();
        self
    }

    /// Where the shape's axes stand in the compound's.
    pub fn pose(&self) -> Pose {
        Pose::new(self.position, self.orientation)
    }

    fn validate(&self, place: &str) -> Result<()> {
        if matches!(self.shape, Shape::HalfSpace(_)) {
            return Err(Error::refused(place, "a half space is infinite and cannot be a piece"));
        }
        require_finite(place, "position", self.position)?;
        if (self.rotation().norm() - 1.0).abs() <= tolerance::QUATERNION_LENGTH {
            return self.shape.validate(place);
        }
        Err(Error::value(place, "orientation", "a unit quaternion (w, x, y, z)", self.orientation))
    }

    fn rotation(&self) -> Quaternion {
        quaternion::from_scalar_first(self.orientation)
    }
}

impl Compound {
    /// A shape joined from pieces.
    pub fn new(pieces: impl Into<Vec<Piece>>) -> Self {
        Self { pieces: pieces.into() }
    }

    /// The same compound with every mesh read from its file; see [`Shape::loaded`].
    pub(super) fn loaded(&self, folder: &Path) -> Result<Self> {
        let load = |piece: &Piece| Ok(Piece { shape: piece.shape.loaded(folder)?, ..piece.clone() });
        Ok(Self { pieces: self.pieces.iter().map(load).collect::<Result<_>>()? })
    }
}

impl Solid for Compound {
    fn validate(&self, place: &str) -> Result<()> {
        if self.pieces.is_empty() {
            return Err(Error::refused(place, "a compound needs at least one piece"));
        }
        self.pieces.iter().enumerate().try_for_each(|(i, piece)| piece.validate(&piece_name(place, i)))
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.validate(place)?;
        let of_piece = |(i, piece): (usize, &Piece)| {
            let own = piece.shape.matter(&piece_name(place, i), density)?;
            Ok(own.turned(&piece.rotation()).moved(piece.position))
        };
        let parts: Vec<_> = self.pieces.iter().enumerate().map(of_piece).collect::<Result<_>>()?;
        Ok(MassProperties::combined(&parts))
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        let reach = |piece: &Piece| piece.shape.bounding_radius(&piece.pose().inverse_point(about));
        self.pieces.iter().map(reach).fold(0.0, f64::max)
    }

    /// Those of all pieces, where all have some.
    fn vertices(&self) -> Option<Vec<Vector3>> {
        let mut all = Vec::new();
        for piece in &self.pieces {
            let pose = piece.pose();
            all.extend(piece.shape.vertices()?.iter().map(|v| pose.point(v)));
        }
        Some(all)
    }
}

/// How messages call the piece of number `i`.
fn piece_name(place: &str, i: usize) -> String {
    format!("{place}, piece {i}")
}
