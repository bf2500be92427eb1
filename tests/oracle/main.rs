//! bryla against numbers that it did not make: exact rational arithmetic, parry, independent formulas.

mod mass;
mod parry;
