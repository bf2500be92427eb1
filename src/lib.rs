//! Rigid bodies, simulated with an accuracy that you choose and that the library proves and prices.

#![forbid(unsafe_code)]

pub mod error;
pub mod effect;
pub mod freedom;
pub mod integrator;
pub mod math;
pub mod state;
pub mod tolerance;

pub use error::{Error, Result};
