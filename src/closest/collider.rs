//! Shapes prepared for queries: built once, asked often.
//!
//! Every shape is a list of convex pieces, each with a core and a radius that rounds it off:
//!
//! | shape | core | rounding |
//! |---|---|---|
//! | cuboid, convex polyhedron, convex mesh | a polyhedron | 0 |
//! | sphere | its centre, a polyhedron of one vertex | its radius |
//! | capsule | its axis, a polyhedron of two vertices | its radius |
//! | cylinder, cone, ellipsoid | itself, by its support | 0 |
//! | half space | its plane | 0 |
//! | compound | those of its pieces, nested ones in order | |

use super::answer::Feature;
use super::half_space;
use super::pair::{Heights, Ids, Placement, Stand, feature};
use super::round::Round;
use super::vector::Vec3;
use crate::error::{Error, Result};
use crate::math::{Pose, Vector3, quaternion};
use crate::shape::convex_polyhedron::ConvexPolyhedron;
use crate::shape::{Ellipsoid, HalfSpace, Polyhedron, Shape};
use crate::tolerance::{COORDINATE_MAX, COORDINATE_MIN};

/// A shape prepared for [`closest_features`](super::closest_features).
#[derive(Debug, Clone, PartialEq)]
pub struct Collider {
    parts: Vec<Part>,
    /// The ball that holds the shape [m]; infinite for a half space.
    center: Vector3,
    reach: f64,
}

/// A convex piece.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    body: Body,
    rounding: f64,
    placement: Option<Placement>,
    /// The ball that holds the piece [m], shape axes.
    center: Vector3,
    reach: f64,
}

#[derive(Debug, Clone, PartialEq)]
enum Body {
    Polyhedron(ConvexPolyhedron),
    Ball(ConvexPolyhedron),
    Capsule(ConvexPolyhedron),
    Round(Round),
    HalfSpace(HalfSpace),
}

/// What supports are asked of.
#[derive(Debug, Clone, Copy)]
pub(super) enum Core<'a> {
    Polyhedron(&'a ConvexPolyhedron),
    Round(&'a Round),
}

/// Whether a core is a body of revolution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Revolution {
    /// It is not.
    No,
    /// About this unit vector, own axes, through its centre.
    About([f64; 3]),
    /// About every one: a point.
    AboutAnything,
}

impl Core<'_> {
    /// The point that it is centred about, own axes [m].
    pub(super) fn center(&self) -> [f64; 3] {
        match self {
            Self::Polyhedron(body) => body.center(),
            Self::Round(_) => [0.0; 3],
        }
    }

    /// Radius of the ball about that point that holds it [m].
    pub(super) fn reach(&self) -> f64 {
        match self {
            Self::Polyhedron(body) => body.radius(),
            Self::Round(round) => round.reach(),
        }
    }

    /// What it is of revolution about.
    pub(super) fn revolution(&self) -> Revolution {
        match self {
            Self::Polyhedron(body) => match body.vertices_about_center() {
                [_] => Revolution::AboutAnything,
                [_, _] => Revolution::About(body.edges()[0].direction),
                _ => Revolution::No,
            },
            Self::Round(round) => round.axis().map_or(Revolution::No, Revolution::About),
        }
    }

    /// A point farthest along `d`, about the centre, a bound of the height of all points, and of a
    /// polyhedron the vertex that it is; all in the body's axes.
    pub(super) fn farthest<R: Heights>(&self, d: &Vec3<R>, from: Option<u32>) -> (Vec3<R>, R, u32) {
        match self {
            Self::Polyhedron(body) => {
                let (i, height) = R::farthest(body, d, from);
                (R::vertex(body, i as usize), height, i)
            }
            Self::Round(round) => {
                let (point, height) = round.support(d);
                (point, height, 0)
            }
        }
    }

    /// The feature spanned by a polyhedron's vertices, or that a curved body turns along `outward`.
    pub(super) fn feature(&self, vertices: &[Ids], side: usize, outward: impl Fn() -> [f64; 3]) -> Feature {
        match self {
            Self::Polyhedron(body) => feature(body, vertices, side, outward),
            Self::Round(round) => round.feature(outward()),
        }
    }
}

/// A piece as a query sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) solid: Solid<'a>,
    pub(super) rounding: f64,
    pub(super) placement: Option<&'a Placement>,
    pub(super) names: Names,
}

impl<'a> View<'a> {
    /// Where it stands, for the pose of the whole.
    #[inline]
    pub(super) fn stand(&self, pose: &'a Pose) -> Stand<'a> {
        Stand { pose, piece: self.placement, rounding: self.rounding }
    }
}

/// A core, or all of space on one side of a plane.
#[derive(Debug, Clone, Copy)]
pub(super) enum Solid<'a> {
    Core(Core<'a>),
    HalfSpace(&'a HalfSpace),
}

/// How the features of a core are called on the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Names {
    /// As they are.
    Own,
    /// Around a centre.
    Ball,
    /// Around an axis.
    Capsule,
}

impl Names {
    #[inline]
    pub(super) fn name(self, feature: Feature) -> Feature {
        match (self, feature) {
            (Self::Own, feature) => feature,
            (Self::Capsule, Feature::Vertex(end)) => Feature::Surface(end),
            (Self::Capsule, _) => Feature::Surface(2),
            (Self::Ball, _) => Feature::Surface(0),
        }
    }
}

/// What a query takes: a reference to a [`ConvexPolyhedron`] or to a [`Collider`].
#[derive(Debug, Clone, Copy)]
pub struct Collidable<'a>(Kind<'a>);

#[derive(Debug, Clone, Copy)]
enum Kind<'a> {
    One(&'a ConvexPolyhedron),
    Parts(&'a Collider),
}

impl<'a> From<&'a ConvexPolyhedron> for Collidable<'a> {
    #[inline]
    fn from(body: &'a ConvexPolyhedron) -> Self {
        Self(Kind::One(body))
    }
}

impl<'a> From<&'a Collider> for Collidable<'a> {
    #[inline]
    fn from(body: &'a Collider) -> Self {
        Self(Kind::Parts(body))
    }
}

impl<'a> Collidable<'a> {
    /// How many convex pieces it has.
    #[inline]
    pub(super) fn count(&self) -> usize {
        match self.0 {
            Kind::One(_) => 1,
            Kind::Parts(collider) => collider.parts.len(),
        }
    }

    #[inline]
    pub(super) fn part(&self, k: usize) -> View<'a> {
        let own = |solid| View { solid, rounding: 0.0, placement: None, names: Names::Own };
        match self.0 {
            Kind::One(body) => own(Solid::Core(Core::Polyhedron(body))),
            Kind::Parts(collider) => collider.parts[k].view(),
        }
    }

    /// The ball that holds a piece: centre [m], shape axes, and radius [m].
    pub(super) fn ball_of(&self, k: usize) -> (Vector3, f64) {
        match self.0 {
            Kind::One(body) => (body.center().into(), body.radius()),
            Kind::Parts(collider) => (collider.parts[k].center, collider.parts[k].reach),
        }
    }

    /// The ball that holds all: centre [m], shape axes, and radius [m].
    pub(super) fn ball(&self) -> (Vector3, f64) {
        match self.0 {
            Kind::One(body) => (body.center().into(), body.radius()),
            Kind::Parts(collider) => (collider.center, collider.reach),
        }
    }
}

impl Part {
    #[inline]
    fn view(&self) -> View<'_> {
        let (solid, names) = match &self.body {
            Body::Polyhedron(body) => (Solid::Core(Core::Polyhedron(body)), Names::Own),
            Body::Ball(core) => (Solid::Core(Core::Polyhedron(core)), Names::Ball),
            Body::Capsule(core) => (Solid::Core(Core::Polyhedron(core)), Names::Capsule),
            Body::Round(round) => (Solid::Core(Core::Round(round)), Names::Own),
            Body::HalfSpace(half_space) => (Solid::HalfSpace(half_space), Names::Own),
        };
        View { solid, rounding: self.rounding, placement: self.placement.as_ref(), names }
    }
}

impl From<ConvexPolyhedron> for Collider {
    fn from(body: ConvexPolyhedron) -> Self {
        let (center, reach) = (body.center().into(), body.radius());
        let part = Part { body: Body::Polyhedron(body), rounding: 0.0, placement: None, center, reach };
        Self { parts: vec![part], center, reach }
    }
}

impl Collider {
    /// Prepares a shape. Its poses in queries are those of the shape's own axes.
    ///
    /// # Errors
    /// What the shape's `validate` refuses; a solid that is not convex, naming a face (a compound of
    /// convex pieces collides); a mesh that is not [loaded](Shape::loaded); sizes beyond 1e±30 m.
    ///
    /// ```
    /// use bryla::closest::{Accuracy, Collider, Feature, closest_features};
    /// use bryla::math::Pose;
    /// use bryla::shape::{Cylinder, HalfSpace};
    ///
    /// let floor = Collider::new(&HalfSpace::new([0.0, 0.0, 1.0], 0.0).into())?;
    /// let can = Collider::new(&Cylinder::new(0.03, 0.06).into())?;
    /// let up = Pose::new([0.0, 0.0, 0.07], [1.0, 0.0, 0.0, 0.0]);
    /// let found = closest_features(&floor, &Pose::identity(), &can, &up, None, Accuracy::Exact)?;
    /// assert!((found.signed_distance - 0.01).abs() < 1e-16);
    /// assert_eq!(found.feature_b, Feature::Face(0));
    /// # Ok::<(), bryla::Error>(())
    /// ```
    pub fn new(shape: &Shape) -> Result<Self> {
        let mut parts = Vec::new();
        collect(shape, shape.name(), None, &mut parts)?;
        let mut collider = Self { center: Vector3::zeros(), reach: 0.0, parts };
        let count = collider.parts.len() as f64;
        collider.center = collider.parts.iter().fold(Vector3::zeros(), |sum, part| sum + part.center / count);
        let reach = |part: &Part| (part.center - collider.center).norm() + part.reach;
        collider.reach = collider.parts.iter().map(reach).fold(0.0, f64::max);
        Ok(collider)
    }

    /// How many convex pieces it has: 1, unless it is a compound.
    pub fn part_count(&self) -> usize {
        self.parts.len()
    }

    /// The polyhedron of a piece, in the piece's axes, where it is one: what its features count in.
    pub fn polyhedron(&self, part: usize) -> Option<&ConvexPolyhedron> {
        match self.parts.get(part).map(|part| &part.body) {
            Some(Body::Polyhedron(body)) => Some(body),
            _ => None,
        }
    }

    /// A ball that holds the shape: centre [m], shape axes, and radius [m], infinite for a half space.
    pub fn bounding_ball(&self) -> (Vector3, f64) {
        (self.center, self.reach)
    }
}

/// Adds the convex pieces of a shape that stands at `pose` in the whole.
fn collect(shape: &Shape, place: &str, pose: Option<Pose>, parts: &mut Vec<Part>) -> Result<()> {
    let core = |points: &[[f64; 3]]| ConvexPolyhedron::from_points(points);
    let (body, rounding) = match shape {
        Shape::Mesh(_) => return Err(Error::refused(place, "a mesh must be loaded before it can collide")),
        Shape::Compound(compound) => {
            compound.validate(place)?;
            for (k, piece) in compound.pieces.iter().enumerate() {
                let orientation = quaternion::from_scalar_first(piece.orientation);
                let inner = Pose { position: piece.position.into(), orientation };
                let pose = pose.map_or(inner, |outer| Pose {
                    position: outer.point(&inner.position),
                    orientation: quaternion::normalized(&(outer.orientation * inner.orientation)),
                });
                collect(&piece.shape, &format!("{place}, piece {k}"), Some(pose), parts)?;
            }
            return Ok(());
        }
        other => {
            other.validate(place)?;
            match other {
                Shape::Sphere(s) => (Body::Ball(core(&[[0.0; 3]])?), s.radius),
                Shape::Capsule(s) => {
                    (Body::Capsule(core(&[[0.0, 0.0, -s.half_height], [0.0, 0.0, s.half_height]])?), s.radius)
                }
                Shape::Cylinder(s) => (Round::Cylinder { radius: s.radius, half_height: s.half_height }.into(), 0.0),
                Shape::Cone(s) => (Round::Cone { radius: s.radius, half_height: s.half_height }.into(), 0.0),
                Shape::Ellipsoid(Ellipsoid { semi_axes: [a, b, c] }) if a == b && b == c => {
                    (Body::Ball(core(&[[0.0; 3]])?), *a)
                }
                Shape::Ellipsoid(s) => (Round::Ellipsoid { semi_axes: s.semi_axes }.into(), 0.0),
                Shape::HalfSpace(s) => (Body::HalfSpace(half_space::scaled(s, place)?), 0.0),
                Shape::Polyhedron(s) => (Body::Polyhedron(convex(s)?), 0.0),
                flat => {
                    let corners: Vec<[f64; 3]> =
                        flat.vertices().unwrap_or_default().iter().map(|&v| v.into()).collect();
                    (Body::Polyhedron(core(&corners)?), 0.0)
                }
            }
        }
    };

    // where it is, and how far it reaches
    let placement = pose.as_ref().map(Placement::new);
    let (own_center, own_reach) = match &body {
        Body::Polyhedron(body) | Body::Ball(body) | Body::Capsule(body) => (body.center(), body.radius()),
        Body::Round(round) => ([0.0; 3], round.reach()),
        Body::HalfSpace(_) => ([0.0; 3], f64::INFINITY),
    };
    let center = placement.as_ref().map_or_else(|| own_center.into(), |p| p.point(own_center));
    let reach = own_reach + rounding;
    let is_finite = matches!(body, Body::HalfSpace(_)) || (COORDINATE_MIN..=COORDINATE_MAX).contains(&reach);
    if !is_finite || center.amax() > COORDINATE_MAX {
        return Err(Error::value(place, "size", "between 1e-30 and 1e30 m", reach));
    }
    parts.push(Part { body, rounding, placement, center, reach });
    Ok(())
}

impl From<Round> for Body {
    fn from(round: Round) -> Self {
        Self::Round(round)
    }
}

/// The polyhedron of a closed surface, if it is convex; vertices that no face uses are left out.
fn convex(solid: &Polyhedron) -> Result<ConvexPolyhedron> {
    let mut place_of = vec![usize::MAX; solid.vertices.len()];
    let mut used = Vec::new();
    let faces: Vec<Vec<usize>> = solid
        .faces
        .iter()
        .map(|face| {
            let mut number = |&k: &usize| {
                if place_of[k] == usize::MAX {
                    place_of[k] = used.len();
                    used.push(k);
                }
                place_of[k]
            };
            face.iter().map(&mut number).collect()
        })
        .collect();
    // in the order given, so that vertices keep their numbers where all are used
    if used.len() == solid.vertices.len() {
        return ConvexPolyhedron::from_faces(&solid.vertices, &solid.faces);
    }
    let vertices: Vec<[f64; 3]> = used.iter().map(|&k| solid.vertices[k]).collect();
    ConvexPolyhedron::from_faces(&vertices, &faces)
}
