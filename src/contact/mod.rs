//! What happens where bodies touch: they bounce, or they stick (lecture §7), or they stay and carry each
//! other (beyond).
//!
//! ```text
//! closest features ──manifold──▶ points, normals ──contacts──▶ Contact ─┬─collide──▶ impulses, velocities
//!                                                                       ├─rest─────▶ forces, stick | slide | separate
//!                                                                       └─merge────▶ one compound
//! ```
//!
//! | module | answers |
//! |---|---|
//! | [`manifold`] | all points in which two bodies touch, and the cone of their normals |
//! | [`cluster`] | the bodies and contacts of one instant |
//! | [`collision`] | impact: every contact of the cluster at once, with restitution and friction |
//! | [`stick`] | merging bodies into one |
//! | [`joint`] | what holds them together, and how much it bears |
//! | [`accumulation`] | when bounces have no end but a last instant |
//! | [`rest`] | forces of contacts that last |
//! | [`anchor`] | where a contact that lasts goes when its bodies move |
//! | [`solver`] | the problems beneath, each answer with its residual |
//! | [`bounce`] | the formula of one point against a fixed plane |
//!
//! Everything here is a pure function of an instant. A run with events calls, at a located impact:
//!
//! 1. [`manifold::manifold`] for each touching pair of the cluster, with the `ε_touch` that is model data;
//! 2. [`collision::collide`] with the pairs' friction and restitution (or [`stick::merge`]);
//! 3. [`accumulation::Accumulation::book`] for each contact that was hit; a capture means that the contact
//!    rests from the captured time on;
//! 4. [`rest::rest`] for contacts whose normal velocity is 0: what separates is set free, what sticks or slides
//!    is held.

pub mod accumulation;
pub mod anchor;
pub mod bounce;
pub mod broad_phase;
pub mod cluster;
pub mod collision;
mod friction;
pub mod joint;
pub mod manifold;
mod patch;
mod problem;
mod reflection;
mod region;
pub mod rest;
pub mod solver;
pub mod stick;

pub use joint::BreakingLoad;

use crate::math::Vector3;

/// What a body does when it touches another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Response {
    /// It rebounds, with the pair's restitution.
    #[default]
    Bounce,
    /// It stays with the other body. A pair sticks if either body says so.
    Stick,
}

impl Response {
    /// Every response.
    pub const ALL: &'static [Self] = &[Self::Bounce, Self::Stick];

    /// The name that files and Python use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bounce => "bounce",
            Self::Stick => "stick",
        }
    }
}

/// What a pair of bodies does when they touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Coefficient of restitution e [-].
    pub restitution: f64,
    /// Coefficient of friction μ [-].
    pub friction: f64,
    /// Bounce or stick.
    pub response: Response,
}

impl Material {
    /// The material of a pair, each given by restitution, friction and response: the larger restitution, the
    /// geometric mean of the frictions, and sticking if either sticks.
    pub fn of_pair([a, b]: [(f64, f64, Response); 2]) -> Self {
        let sticks = a.2 == Response::Stick || b.2 == Response::Stick;
        Self {
            restitution: a.0.max(b.0),
            friction: (a.1 * b.1).sqrt(),
            response: if sticks { Response::Stick } else { Response::Bounce },
        }
    }
}

/// A touch that has been answered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Impulse on the body, along the normal [N·s].
    pub impulse: Vector3,
    /// Kinetic energy lost [J].
    pub energy_lost: f64,
}
