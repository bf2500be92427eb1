//! What a query is asked and what it answers.

use crate::math::Vector3;

/// How two bodies stand to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum State {
    /// The lower bound of the signed distance is positive.
    Separated,
    /// The interval contains 0: closer than the rounding of the coordinates can tell.
    Touching,
    /// The upper bound of the signed distance is negative.
    Overlapping,
}

/// A part of a body's surface.
///
/// | body | vertex | edge | face | surface |
/// |---|---|---|---|---|
/// | polyhedron, cuboid | as listed | as listed | as listed | |
/// | sphere, ellipsoid | | | | 0 |
/// | capsule | | | | lower end 0, upper end 1, side 2 |
/// | cylinder | | lower rim 0, upper rim 1 | lower cap 0, upper cap 1 | side 0 |
/// | cone | apex 0 | rim 0 | base 0 | side 0 |
/// | half space | | | 0 | |
///
/// The lists are those of the [`ConvexPolyhedron`](crate::shape::convex_polyhedron::ConvexPolyhedron);
/// ends and sides are named along z of the shape's axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Feature {
    /// A corner.
    Vertex(u32),
    /// An edge, straight or a rim.
    Edge(u32),
    /// A flat face.
    Face(u32),
    /// A curved part of the surface.
    Surface(u32),
}

impl Feature {
    /// `vertex`, `edge`, `face` or `surface`.
    pub fn kind(self) -> &'static str {
        match self {
            Self::Vertex(_) => "vertex",
            Self::Edge(_) => "edge",
            Self::Face(_) => "face",
            Self::Surface(_) => "surface",
        }
    }

    /// The index among the body's features of that kind.
    pub fn index(self) -> u32 {
        match self {
            Self::Vertex(k) | Self::Edge(k) | Self::Face(k) | Self::Surface(k) => k,
        }
    }
}

/// When a query may stop.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Accuracy {
    /// At an interval as narrow as rounding allows. Of the size, which is both radii plus the distance of
    /// the centres, it is at most 16 ε for polyhedra, balls and capsules, mostly 9 to 13, and up to 19 ε
    /// for an overlap about as deep as both radii; 23 ε for curved bodies and pieces of compounds, 36 ε with
    /// half spaces.
    #[default]
    Exact,
    /// At an interval of this fraction of the size [-].
    Relative(f64),
    /// As soon as the state is known; the bounds hold, the points are not yet the closest.
    YesNo,
}

/// How far a query had to climb.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Rung {
    /// The cached features or vertices still were the answer, or up to three others that the looks around came upon.
    Verified,
    /// The walk from the cached features.
    Walked,
    /// The search in `f64`.
    Searched,
    /// The search in double-double.
    DoubleDouble,
}

/// The closest features of two bodies A and B, in world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClosestFeatures {
    /// Distance where positive, minus the depth where negative [m]: `normal · (point_b − point_a)`.
    pub signed_distance: f64,
    /// The true signed distance is not below this [m].
    pub lower: f64,
    /// The true signed distance is not above this [m].
    pub upper: f64,
    /// What the interval says.
    pub state: State,
    /// The closest or deepest point of A, world axes [m].
    pub point_a: Vector3,
    /// The closest or deepest point of B, world axes [m].
    pub point_b: Vector3,
    /// Unit normal from A to B, world axes; valid in every state.
    pub normal: Vector3,
    /// The feature of A that carries `point_a`: the one of lowest dimension.
    pub feature_a: Feature,
    /// The feature of B that carries `point_b`.
    pub feature_b: Feature,
    /// The piece of A that the feature belongs to, where A is a compound; else 0.
    pub part_a: u32,
    /// The piece of B that the feature belongs to, where B is a compound; else 0.
    pub part_b: u32,
    /// Rounds of all rungs together.
    pub steps: u32,
    /// The rung that the answer comes from.
    pub rung: Rung,
    /// Whether the interval is as narrow as was asked for. If not, it still contains the true value.
    pub certified: bool,
}

impl ClosestFeatures {
    /// The same answer with the bodies' names exchanged.
    pub(super) fn exchanged(self) -> Self {
        Self {
            point_a: self.point_b,
            point_b: self.point_a,
            normal: -self.normal,
            feature_a: self.feature_b,
            feature_b: self.feature_a,
            part_a: self.part_b,
            part_b: self.part_a,
            ..self
        }
    }
}
