//! Python bindings of bryla: one file per core module, whose methods forward and convert.

#![allow(clippy::doc_markdown, reason = "the docs are Python's docstrings, which show backticks as they are")]
#![allow(clippy::doc_link_with_quotes, reason = "the docs are Python's docstrings, in which run[\"die\"] is code")]
#![allow(clippy::unsafe_derive_deserialize, reason = "the unsafe code is pyo3's, and relies on nothing that is read")]
#![allow(clippy::needless_pass_by_value, reason = "Python's arguments are handed over by value")]

use pyo3::prelude::*;

mod batch;
mod body;
mod closest;
mod compare;
mod convert;
mod effect;
mod error;
mod event;
mod freedom;
mod impact;
mod mass;
mod math;
mod options;
mod plan;
mod report;
mod run;
mod scene;
mod shape;
mod simulation;
mod trajectory;

/// Runs the command line with these arguments, the first being its own name; returns the exit code.
#[pyfunction]
#[pyo3(signature = (args))]
fn cli_main(py: Python<'_>, args: Vec<std::ffi::OsString>) -> i32 {
    py.detach(|| bryla::cli::main(args))
}

/// Rigid bodies, simulated with an accuracy that you choose and that the library proves and prices.
#[pymodule]
fn _bryla(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("METHODS", pyo3::types::PyTuple::new(module.py(), options::method_names())?)?;
    math::register(module)?;
    module.add_class::<mass::PyMassProperties>()?;
    shape::register(module)?;
    closest::register(module)?;
    impact::register(module)?;
    effect::register(module)?;
    module.add_class::<batch::PyBatch>()?;
    module.add_class::<event::PyUserEvent>()?;
    module.add_class::<event::PySwitch>()?;
    freedom::register(module)?;
    module.add_class::<body::PyBody>()?;
    module.add_class::<body::PyBodyMotion>()?;
    module.add_class::<scene::PyScene>()?;
    module.add_class::<plan::PyPlan>()?;
    module.add_class::<simulation::PySimulation>()?;
    trajectory::register(module)?;
    module.add_class::<report::PyReport>()?;
    module.add_class::<report::PyCounts>()?;
    module.add_class::<report::PySeconds>()?;
    compare::register(module)?;
    module.add_function(wrap_pyfunction!(cli_main, module)?)?;
    module.add_function(wrap_pyfunction!(plan::calibrate, module)?)?;
    module.add_function(wrap_pyfunction!(scene::load, module)?)?;
    module.add_function(wrap_pyfunction!(scene::schema, module)?)?;
    module.add_function(wrap_pyfunction!(simulation::resume, module)?)?;

    // the package lists what is public
    module.delattr("__all__")
}
