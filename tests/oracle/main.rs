//! bryla against numbers that it did not make: exact rational arithmetic, parry, independent formulas.

#![allow(clippy::float_cmp, reason = "where numbers must be equal, they are compared for equality")]

mod mass;
mod parry;
