//! Motions that are hard to compute: what is asked for is kept, and nothing blows up.
//!
//! Truth is a formula that stands beside the test, or a motion recorded to 28 digits and more by a program that
//! shares nothing with the library (`tests/data/make_references.py`, `tests/data/make_free_rotation.py`).
#![cfg(feature = "serde")]
#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]
#![allow(clippy::disallowed_methods, reason = "no bits are promised of tests")]

mod driven;
mod flights;
mod free;
mod recorded;
mod tops;
