//! Mass, centre of mass and inertia: what a body's motion needs to know of its matter.
//!
//! | file | holds |
//! |---|---|
//! | [`MassProperties`] | the numbers, their checks, moving, turning, joining |
//! | [`PrincipalAxes`] | principal moments and axes |
//! | [`cuboid`], [`sphere`], [`cylinder`], [`capsule`], [`cone`], [`ellipsoid`] | closed forms, one solid a file |
//! | [`polyhedron`] | volume integrals of any solid with flat faces |
//! | [`surface`] | when a list of faces encloses a solid |
//!
//! # Why a tensor
//! A body that turns with ω has at `r` from its centre of mass the velocity `ω × r`, so its angular
//! momentum is, with `a × (b × c) = b (a·c) − c (a·b)`, lecture (22), (23):
//!
//! ```text
//! L = ∫ r × (ω × r) dm = ∫ (|r|² ω − r (r·ω)) dm = I ω                                  (20)
//!
//!     ⎡  ∫(x₂²+x₃²)dm   −∫ x₁ x₂ dm     −∫ x₁ x₃ dm   ⎤
//! I = ⎢ −∫ x₁ x₂ dm      ∫(x₁²+x₃²)dm   −∫ x₂ x₃ dm   ⎥                                 (21)
//!     ⎣ −∫ x₁ x₃ dm     −∫ x₂ x₃ dm      ∫(x₁²+x₂²)dm ⎦
//! ```
//!
//! `I` is symmetric and constant in axes fixed to the body; in the world it is `R I Rᵀ`, and its
//! inverse `R I⁻¹ Rᵀ`. Three directions at right angles, the principal axes, have no off-diagonal
//! entries; only a spin about one of them has L parallel to ω.
//!
//! The lecture's way there, (12)–(17), sums `L = ∑ mᵢ rᵢ vᵢ` over particles to the scalar
//! `L = ω ∫ r² dm`. That holds for rotation about a **fixed axis** with `r` the distance from it, and gives
//! the part of L along that axis, `n·I n ω`; a tumbling body needs (20).
//!
//! # What is lost
//! Bodies are rigid and of uniform density, unless given numbers say otherwise; parts of different
//! density make a [compound](MassProperties::combined). The formulas are exact; rounding costs a closed
//! form or a polyhedron a few units in the last digit of each number, at any offset from the origin.
//! The tensor itself holds 16 digits of its largest entry: of a slanted rod as thin as 1e-6 of its
//! length the small moment (1e-12) keeps four. Along a shape axis it keeps all.

mod compound;
mod principal;
mod properties;

pub mod capsule;
pub mod cone;
pub mod cuboid;
pub mod cylinder;
pub mod ellipsoid;
pub mod polyhedron;
pub mod sphere;
pub mod surface;

pub use principal::PrincipalAxes;
pub use properties::MassProperties;
