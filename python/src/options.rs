//! Options of a run, as keyword arguments.

use bryla::scene::options::RunOptions;
use bryla::{Error, Method};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::convert::{List, Plain};
use crate::error::Result;
use crate::event::events;

/// What the call says, and for the rest what the scene says.
///
/// A tolerance in the call takes the place of the scene's step, and a step that of its tolerance; a method that of
/// its order.
pub(crate) fn run_options(scene: &RunOptions, function: &str, given: Option<&Bound<'_, PyDict>>) -> Result<RunOptions> {
    let mut options = scene.clone();
    let Some(given) = given else { return Ok(options) };
    let said = |name: &str| given.get_item(name).map(|value| value.is_some_and(|value| !value.is_none()));
    match (said("tolerance")?, said("step")?) {
        (true, false) => options.step = None,
        (false, true) => options.tolerance = None,
        _ => {}
    }
    if said("method")? {
        options.order = None;
    }
    for (name, value) in given.iter().filter(|(_, value)| !value.is_none()) {
        let name: String = name.extract()?;
        match name.as_str() {
            "tolerance" => options.tolerance = Some(read(&name, &value)?),
            "method" => options.method = method(&read::<String>(&name, &value)?)?,
            "order" => options.order = Some(read(&name, &value)?),
            "step" => options.step = Some(read(&name, &value)?),
            "t_eval" => options.t_eval = Some(read::<List<f64>>(&name, &value)?.0),
            "estimate" => options.estimate = read(&name, &value)?,
            "record" => options.record = Plain::from_python(read(&name, &value)?)?,
            "length_scale" => options.length_scale = Some(read(&name, &value)?),
            "orientation" => options.orientation = Plain::from_python(read(&name, &value)?)?,
            "projection" => options.projection = read(&name, &value)?,
            "finder" => options.finder = Plain::from_python(read(&name, &value)?)?,
            "eps" => options.eps = Some(read(&name, &value)?),
            "restitution_law" => options.restitution_law = Plain::from_python(read(&name, &value)?)?,
            "max_impacts" => options.max_impacts = read(&name, &value)?,
            "events" => options.events = events(&value)?,
            _ => {
                let message = format!("{function}() got an unexpected keyword argument '{name}'");
                return Err(PyTypeError::new_err(message).into());
            }
        }
    }
    Ok(options)
}

/// The value of an argument; an error names it, as those of other arguments do.
fn read<T>(name: &str, value: &Bound<'_, PyAny>) -> Result<T>
where
    T: for<'a, 'py> FromPyObject<'a, 'py>,
{
    value.extract().map_err(|error: <T as FromPyObject<'_, '_>>::Error| {
        let error: PyErr = error.into();
        PyTypeError::new_err(format!("argument '{name}': {}", error.value(value.py()))).into()
    })
}

/// The method of this name; none for `auto`.
fn method(name: &str) -> Result<Option<Method>> {
    if name == AUTO { Ok(None) } else { method_named(name).map(Some) }
}

/// The method of this name.
pub(crate) fn method_named(name: &str) -> Result<Method> {
    Ok(name.parse()?)
}

const AUTO: &str = "auto";

/// The names that `method` takes.
pub(crate) fn method_names() -> Vec<&'static str> {
    std::iter::once(AUTO).chain(Method::ALL.iter().map(|method| method.name())).collect()
}

/// The span of a run: that of the call, else that of the scene.
pub(crate) fn span(given: Option<(f64, f64)>, scene: &RunOptions) -> Result<(f64, f64)> {
    let scene = scene.t_span.map(|[start, end]| (start, end));
    Ok(given.or(scene).ok_or_else(|| Error::refused("run", "t_span must be given, since the scene names none"))?)
}
