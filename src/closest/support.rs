//! Convex pieces one by one: for those who bound separations over time, as the search for impacts does.

use super::answer::{Accuracy, ClosestFeatures, Feature};
use super::cache::PairCache;
use super::collider::{Collidable, Core, Names, Solid, View};
use super::rotation::rotate_back;
use super::vector::Vec3;
use crate::error::Result;
use crate::math::{Pose, Vector3};
use crate::shape::convex_polyhedron::{SCAN, top_of};

/// A convex piece of a body, in the axes of the whole.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece<'a> {
    view: View<'a>,
    /// Centre [m] and radius [m] of a ball that holds it; of a half space a point of its plane, and 0.
    pub(crate) center: Vector3,
    pub(crate) reach: f64,
}

impl<'a> Collidable<'a> {
    /// How many convex pieces it has.
    pub(crate) fn pieces(&self) -> usize {
        self.count()
    }

    /// Radius of the ball that holds it [m]; 0 of a half space, which gives a pair no size.
    pub(crate) fn size(&self) -> f64 {
        let (_, reach) = self.ball();
        if reach.is_finite() { reach } else { 0.0 }
    }

    /// The convex piece of this number.
    pub(crate) fn piece(&self, k: usize) -> Piece<'a> {
        let (view, (center, reach)) = (self.part(k), self.ball_of(k));
        let mut piece = Piece { view, center, reach };
        if let Some((normal, offset)) = piece.plane() {
            (piece.center, piece.reach) = (offset * normal, 0.0);
        }
        piece
    }
}

impl Piece<'_> {
    /// The plane of a half space: unit outward normal, and its distance from the origin [m].
    pub(crate) fn plane(&self) -> Option<(Vector3, f64)> {
        let Solid::HalfSpace(half_space) = self.view.solid else { return None };
        let given = Vector3::from(half_space.normal);
        let length = given.norm();
        Some((given / length, half_space.offset / length))
    }

    /// Largest `d · (p − center)` over the piece [m], `d` in the axes of the whole, without the rounding.
    /// `from` is where the last climb ended. Not for half spaces.
    #[inline]
    pub(crate) fn height(&self, d: &Vector3, from: &mut u32) -> f64 {
        let d = Vec3((*d).into());
        let d = self.view.placement.map_or(d, |placement| rotate_back(placement.turn(), &d));
        match self.view.solid {
            Solid::Core(Core::Polyhedron(body)) => {
                let vertices = body.vertices_about_center();
                if vertices.len() <= SCAN {
                    return top_of(body.blocks(), &d.0);
                }
                let start = if (*from as usize) < vertices.len() { *from as usize } else { 0 };
                let top = body.climb(start, &d.0);
                *from = u32::try_from(top).unwrap_or(0);
                Vec3(vertices[top]).dot(&d)
            }
            Solid::Core(Core::Round(round)) => round.support(&d).1,
            Solid::HalfSpace(_) => f64::INFINITY,
        }
    }

    /// Distance from the core within which a point belongs to the piece [m].
    pub(crate) fn rounding(&self) -> f64 {
        self.view.rounding
    }

    /// Direction of an edge, axes of the whole.
    pub(crate) fn edge(&self, edge: u32) -> Option<Vector3> {
        let Solid::Core(Core::Polyhedron(body)) = self.view.solid else { return None };
        Some(self.in_whole(body.edges().get(edge as usize)?.direction))
    }

    /// Direction of the straight line that the piece has where a feature faces along `outward`, axes of the whole: an
    /// edge, or a line on the side of a capsule, a cylinder or a cone.
    pub(crate) fn line(&self, feature: Feature, outward: &Vector3) -> Option<Vector3> {
        let Solid::Core(core) = self.view.solid else { return None };
        match (core, self.view.names, feature) {
            (Core::Polyhedron(_), Names::Own, Feature::Edge(edge)) => self.edge(edge),
            (Core::Polyhedron(_), Names::Capsule, Feature::Surface(2)) => self.edge(0),
            (Core::Round(round), Names::Own, Feature::Surface(_)) => {
                let outward = Vec3((*outward).into());
                let outward = self.view.placement.map_or(outward, |placement| rotate_back(placement.turn(), &outward));
                Some(self.in_whole(round.ruling(outward.0)?))
            }
            _ => None,
        }
    }

    /// A direction of the piece in the axes of the whole.
    fn in_whole(&self, direction: [f64; 3]) -> Vector3 {
        self.view.placement.map_or_else(|| direction.into(), |placement| placement.vector(direction))
    }

    /// The points whose hull, rounded off, is the piece: about its centre, axes of the whole; none of a
    /// curved one.
    pub(crate) fn corners(&self) -> Option<Vec<Vector3>> {
        let Solid::Core(Core::Polyhedron(body)) = self.view.solid else { return None };
        Some(body.vertices_about_center().iter().map(|v| self.in_whole(*v)).collect())
    }

    /// Closest features of two pieces; the poses are those of the wholes.
    pub(crate) fn closest(
        &self,
        pose: &Pose,
        other: &Self,
        other_pose: &Pose,
        cache: &mut PairCache,
        accuracy: Accuracy,
    ) -> Result<ClosestFeatures> {
        super::check(pose, "pose_a")?;
        super::check(other_pose, "pose_b")?;
        super::pieces((&self.view, pose), (&other.view, other_pose), Some(cache), accuracy)
    }
}
