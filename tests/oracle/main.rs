//! bryla against numbers that it did not make: exact rational arithmetic, parry, independent formulas.

#![allow(clippy::unwrap_used, reason = "a test that cannot set itself up has failed")]
#![allow(clippy::disallowed_methods, reason = "no bits are promised of tests")]
#![allow(clippy::float_cmp, reason = "where numbers must be equal, they are compared for equality")]

mod mass;
mod parry;
