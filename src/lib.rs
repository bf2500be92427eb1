//! Rigid bodies, simulated with an accuracy that you choose and that the library proves and prices.

#![forbid(unsafe_code)]

pub mod closest;
pub mod error;
pub mod math;
pub mod shape;
pub mod tolerance;

pub use error::{Error, Result};
