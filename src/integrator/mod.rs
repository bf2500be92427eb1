//! Motions: closed forms where there is one.

pub mod free_rotation;
