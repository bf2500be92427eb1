//! Rigid bodies, simulated with an accuracy that you choose and that the library estimates and prices.
//!
//! ```
//! use bryla::{Body, Cuboid, RunOptions, Scene, UniformGravity};
//!
//! let mut scene = Scene::new();
//! scene.add_effect(UniformGravity::new([0.0, 0.0, -9.81]));
//! let die = Body::new("die", Cuboid::new([0.01; 3])).density(1200.0).angular_velocity([20.0, 30.0, 10.0]);
//! let die = scene.add(die)?;
//! let run = scene.run(0.0..2.0, &RunOptions::tolerance(1e-9))?;
//! assert!((run.body(die).position(2.0)?.z + 0.5 * 9.81 * 4.0).abs() < 1e-9);
//! println!("{}", run.report());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The flow
//!
//! ```text
//! Scene ──compile──▶ Plan ──start──▶ Simulation ──step──▶ Trajectory ──▶ Report
//! plain data,        only what it    state + scratch      samples,       error estimate,
//! to/from file       calls for                            dense motion   cost, events
//! ```
//!
//! [`Scene`] is a description. [`Scene::compile`] checks it once and keeps only what it calls for;
//! [`Plan::explain`] says what that is. [`Scene::run`] makes a [`Trajectory`] with its [`Report`];
//! [`Plan::start`] gives a [`Simulation`] to be advanced by hand. [`Scene::compare`] shows what
//! accuracy costs.
//!
//! # What it does not do
//!
//! Bodies of fewer freedoms do not stick to others: such scenes are refused when they are compiled. Large piles are slow. Where
//! a contact cannot be followed, a named error carries the trajectory so far. Bodies are rigid.
//!
//! # Map
//!
//! - [`guide`]: the lecture with its equation numbers, what accuracy costs, the scene file
//! - [`shape`], [`mass`]: solids and their mass properties
//! - [`effect`], [`freedom`]: what acts on bodies, and how they may move
//! - [`integrator`]: the methods, one file each
//! - [`closest`], [`impact`], [`contact`]: where bodies meet, when, and what then
//! - [`math`], [`state`], [`mod@reference`]: rotations, the state Y, exact solutions
//!
//! SI units, right-handed axes, radians; quaternions are `(w, x, y, z)` and turn body into world axes.

#![forbid(unsafe_code)]

pub mod batch;
pub mod calibrate;
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
pub mod measure;
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

pub use batch::Batch;
pub use compare::{CompareOptions, ComparisonTable};
pub use contact::{BreakingLoad, Response};
pub use effect::{
    AnyEffect, Drag, Effect, Frame, PointGravity, Schedule, Spring, Switch, Thruster, UniformGravity, UserEffect,
    Wrench,
};
pub use error::{Error, Result};
pub use freedom::{Freedom, Prescribed};
pub use impact::Finder;
pub use integrator::Method;
pub use mass::MassProperties;
pub use math::Pose;
pub use math::roots::Passage;
pub use measure::{Measure, MeasureFunction};
pub use plan::Plan;
pub use plan::cost::CostTable;
pub use report::Report;
pub use scene::{Body, BodyId, Direction, Orientation, Record, RunOptions, Scene, Span, UserEvent};
pub use shape::{Capsule, Compound, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Mesh, Polyhedron, Shape, Sphere};
pub use simulation::{RunError, Simulation, SimulationError};
pub use state::{BodyMotion, BodyState, Load, Moment};
pub use trajectory::{Event, EventKind, Trajectory};
