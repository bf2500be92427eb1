//! Rigid bodies, simulated with an accuracy that you choose and that the library proves and prices.

#![forbid(unsafe_code)]

#[cfg(feature = "serde")]
pub mod catalogue;
#[cfg(feature = "cli")]
pub mod cli;
pub mod closest;
pub mod compare;
pub mod contact;
pub mod effect;
pub mod error;
pub mod export;
pub mod freedom;
pub mod guide;
pub mod impact;
pub mod integrator;
pub mod mass;
pub mod math;
pub mod plan;
pub mod reference;
pub mod report;
pub mod scene;
pub mod shape;
pub mod simulation;
pub mod state;
mod text;
pub mod tolerance;
pub mod trajectory;

pub use compare::{CompareOptions, ComparisonTable};
pub use contact::Response;
pub use effect::{
    AnyEffect, Drag, Effect, Frame, PointGravity, Schedule, Spring, Thruster, UniformGravity, UserEffect, Wrench,
};
pub use error::{Error, Result};
pub use freedom::Freedom;
pub use impact::Finder;
pub use integrator::Method;
pub use mass::MassProperties;
pub use math::Pose;
pub use plan::Plan;
pub use report::Report;
pub use scene::{Body, BodyId, Orientation, Record, RunOptions, Scene, Span};
pub use shape::{Capsule, Compound, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Mesh, Polyhedron, Shape, Sphere};
pub use simulation::{RunError, Simulation, SimulationError};
pub use state::{BodyMotion, BodyState, Load, Moment};
pub use trajectory::{Event, EventKind, Trajectory};
