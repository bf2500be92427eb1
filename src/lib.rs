//! Rigid bodies, simulated with an accuracy that you choose and that the library proves and prices.

#![forbid(unsafe_code)]

pub mod error;
pub mod integrator;
pub mod math;
pub mod reference;
pub mod tolerance;

pub use error::{Error, Result};
