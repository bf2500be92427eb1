//! Scenes.

use std::path::PathBuf;

use bryla::scene::file::Format;
use bryla::{CompareOptions, CostTable, RunOptions, Scene};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::body::PyBody;
use crate::compare::PyComparisonTable;
use crate::convert::{self, List, Reduced};
use crate::effect;
use crate::error::Result;
use crate::options::{method_named, run_options, span};
use crate::plan::PyPlan;
use crate::run::{run_watched, watched};
use crate::trajectory::PyTrajectory;

/// Bodies, what acts on them, and how to run them.
///
/// Nothing runs unasked: there is no gravity, no drag and no floor unless one is added.
#[pyclass(name = "Scene", module = "bryla", eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyScene(Scene);

/// The language of a text, from `toml` or `json`.
fn format(name: &str) -> Result<Format> {
    match name {
        "toml" => Ok(Format::Toml),
        "json" => Ok(Format::Json),
        _ => Err(bryla::Error::value("scene", "format", "one of toml, json", name).into()),
    }
}

#[pymethods]
impl PyScene {
    #[new]
    fn new() -> Self {
        Self(Scene::new())
    }

    /// Adds a body, and returns its name.
    ///
    /// Raises Error if the name is taken, or a field of the body must not be as it is.
    #[pyo3(signature = (body))]
    fn add(&mut self, body: &Bound<'_, PyBody>) -> Result<String> {
        let body = body.get().0.clone();
        let name = body.name.clone();
        self.0.add(body)?;
        Ok(name)
    }

    /// Adds what acts on bodies. Its bodies need not be there yet: compiling the scene looks for them.
    #[pyo3(signature = (effect))]
    fn add_effect(&mut self, effect: &Bound<'_, PyAny>) -> Result<()> {
        self.0.add_effect(effect::from_python(effect)?);
        Ok(())
    }

    /// The bodies, in the order of the body axis of every array.
    #[getter]
    fn bodies(&self) -> Vec<PyBody> {
        self.0.bodies.iter().cloned().map(PyBody).collect()
    }

    /// What acts on them.
    #[getter]
    fn effects<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        self.0.effects.iter().map(|effect| effect::to_python(py, effect)).collect()
    }

    /// How to run the scene where a call does not say otherwise: a dict of the options of `run`,
    /// `t_span` among them, without those that a scene file would leave out.
    #[getter]
    fn run_options<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = serde_json::to_string(&self.0.run).map_err(to_value_error)?;
        py.import("json")?.call_method1("loads", (text,))
    }

    #[setter]
    fn set_run_options(&mut self, options: &Bound<'_, PyDict>) -> Result<()> {
        let text: String = options.py().import("json")?.call_method1("dumps", (options,))?.extract()?;
        let run = serde_json::from_str(&text);
        self.0.run = run.map_err(|error| bryla::Error::refused("run", error.to_string()))?;
        Ok(())
    }

    /// Checks the scene and keeps what it calls for: a Plan. The options are those of `run`.
    #[pyo3(
        signature = (**options),
        text_signature = "($self, *, tolerance=None, method=None, order=None, step=None, t_eval=None, estimate=None, record=None, length_scale=None, orientation=None, projection=None, finder=None, eps=None, restitution_law=None, max_impacts=None, events=None)"
    )]
    fn compile(&self, options: Option<&Bound<'_, PyDict>>) -> Result<PyPlan> {
        let options = run_options(&self.0.run, "compile", options)?;
        Ok(PyPlan::new(self.0.compile(&options)?))
    }

    /// The plan of the scene's own run options in words: what runs, what is left out, and why.
    #[pyo3(signature = ())]
    fn explain(&self) -> Result<String> {
        Ok(self.0.compile(&self.0.run)?.explain_priced(&CostTable::of_user()?))
    }

    /// Runs the scene over a span, and returns its Trajectory.
    ///
    /// Give a tolerance, or a method with a step; with neither, the tolerance is 1e-6. An option that
    /// is None is what the scene's own run options say, else as told below.
    ///
    /// Other threads go on meanwhile, and Ctrl-C stops the run; the KeyboardInterrupt then has the
    /// SimulationError with the trajectory so far as its cause.
    ///
    /// Parameters
    /// ----------
    /// t_span : (float, float), optional
    ///     Start and end [s].
    /// tolerance : float, optional
    ///     Error that the result may have: of positions over length_scale, of orientations in radians [-].
    /// method : str, optional
    ///     Method of integration, one of METHODS; "auto" (default) lets the plan choose.
    /// order : int, optional
    ///     Order of the methods "taylor" (by default that which the tolerance calls for, 8 where the step is given)
    ///     and "dmv" (10).
    /// step : float, optional
    ///     Length of a step [s].
    /// t_eval : array of float, optional
    ///     Times of the samples [s], rising; the ends and 201 uniform times by default.
    /// estimate : bool, optional
    ///     Whether the error of the result is estimated (default).
    /// record : {"dense", "samples", "end"}, optional
    ///     What is kept: the motion of every step (default), the samples, or the ends.
    /// length_scale : float, optional
    ///     Length that position errors are measured by [m]; by default the larger of body and path.
    /// orientation : {"quaternion", "matrix"}, optional
    ///     How methods in world axes write the orientation; "quaternion" by default.
    /// projection : bool, optional
    ///     Whether orientations are put back on their sphere after each step (default).
    /// finder : {"guaranteed", "secant", "bisection"}, optional
    ///     How the time of contact is found; "guaranteed" by default.
    /// eps : float, optional
    ///     Gap at which a contact is accepted [m]; 1e-12 of the pair's size by default.
    /// restitution_law : {"newton", "poisson", "stronge"}, optional
    ///     What comes back where friction couples normal and tangent: the impulse of compression (default),
    ///     the normal velocity, or the work of compression.
    /// max_impacts : int, optional
    ///     Impacts of one body after which the run ends as AccumulatingImpacts; 1,000,000 by default.
    /// events : list of UserEvent, optional
    ///     What is watched for.
    /// progress : bool
    ///     Whether a progress line is shown on a terminal.
    ///
    /// Raises
    /// ------
    /// Error
    ///     Bad input.
    /// SimulationError
    ///     The run cannot go on; its trajectory up to then is there.
    ///
    /// Warns
    /// -----
    /// AccuracyWarning
    ///     The tolerance is not met over the whole span; report.horizon says up to when it is.
    #[pyo3(
        signature = (t_span=None, *, progress=false, **options),
        text_signature = "($self, t_span=None, *, tolerance=None, method=None, order=None, step=None, t_eval=None, estimate=None, record=None, length_scale=None, orientation=None, projection=None, finder=None, eps=None, restitution_law=None, max_impacts=None, events=None, progress=False)"
    )]
    fn run(
        &self,
        py: Python<'_>,
        t_span: Option<(f64, f64)>,
        progress: bool,
        options: Option<&Bound<'_, PyDict>>,
    ) -> Result<PyTrajectory> {
        let options = run_options(&self.0.run, "run", options)?;
        let span = span(t_span, &self.0.run)?;
        run_watched(py, progress, |observer| self.0.run_observed(span, &options, observer))
    }

    /// What accuracy costs: error against time for several methods, steps and tolerances, a ComparisonTable.
    ///
    /// Error and time come from the same run. The error is that of the end state.
    ///
    /// Parameters
    /// ----------
    /// t_span : (float, float), optional
    ///     Start and end [s]; the scene's own by default.
    /// methods : list of str, optional
    ///     Methods of integration; all by default.
    /// steps : list of float, optional
    ///     Lengths of a step [s]; ten halvings from a first guess if neither steps nor tolerances are given.
    /// tolerances : list of float, optional
    ///     Errors that the result may have [-], for the methods that choose their steps by them; the error is
    ///     not estimated in these runs, which costs extra.
    /// repeats : int
    ///     How often each run is timed; the least and the middle time are kept.
    /// order, length_scale, orientation, projection, finder, eps, restitution_law, max_impacts
    ///     As in run.
    /// progress : bool
    ///     Whether a progress line is shown on a terminal.
    #[pyo3(
        signature = (t_span=None, *, methods=None, steps=None, tolerances=None, repeats=5, progress=false, **options),
        text_signature = "($self, t_span=None, *, methods=None, steps=None, tolerances=None, repeats=5, order=None, length_scale=None, orientation=None, projection=None, finder=None, eps=None, restitution_law=None, max_impacts=None, progress=False)"
    )]
    #[expect(clippy::too_many_arguments, reason = "those of the core, and two of Python")]
    fn compare(
        &self,
        py: Python<'_>,
        t_span: Option<(f64, f64)>,
        methods: Option<List<String>>,
        steps: Option<List<f64>>,
        tolerances: Option<List<f64>>,
        repeats: u32,
        progress: bool,
        options: Option<&Bound<'_, PyDict>>,
    ) -> Result<PyComparisonTable> {
        for name in ["tolerance", "method", "step", "t_eval", "estimate", "record", "events"] {
            if options.is_some_and(|options| options.contains(name).unwrap_or(false)) {
                let message = format!("compare() got an unexpected keyword argument '{name}'");
                return Err(PyTypeError::new_err(message).into());
            }
        }
        let run = run_options(&self.0.run, "compare", options)?;
        let methods = methods.map_or_else(Vec::new, |names| names.0);
        let options = CompareOptions {
            methods: methods.iter().map(|name| method_named(name)).collect::<Result<_>>()?,
            steps: steps.map_or_else(Vec::new, |steps| steps.0),
            tolerances: tolerances.map_or_else(Vec::new, |tolerances| tolerances.0),
            repeats,
            run: RunOptions { method: None, step: None, ..run },
        };
        let span = span(t_span, &self.0.run)?;
        let table = watched(py, progress, |observer| self.0.compare_observed(span, &options, observer))?;
        Ok(PyComparisonTable(table))
    }

    /// Writes the scene to a file, .toml or .json.
    #[pyo3(signature = (path))]
    fn save(&self, path: PathBuf) -> Result<()> {
        Ok(self.0.save(path)?)
    }

    /// The scene as the text of a file, in "toml" or "json".
    #[pyo3(signature = (format="toml"))]
    fn to_text(&self, format: &str) -> Result<String> {
        Ok(self.0.to_text(self::format(format)?)?)
    }

    /// The scene that a text holds, in "toml" or "json".
    #[staticmethod]
    #[pyo3(signature = (text, format="toml"))]
    fn from_text(text: &str, format: &str) -> Result<Self> {
        Ok(Self(Scene::from_text(text, self::format(format)?)?))
    }

    fn __repr__(&self) -> String {
        format!("<bryla.Scene: {} bodies, {} effects>", self.0.bodies.len(), self.0.effects.len())
    }

    /// Pickled as the text of a scene file; refused where there is a user effect, which is code.
    fn __reduce__<'py>(&self, py: Python<'py>) -> Result<Reduced<'py>> {
        let text = self.0.to_text(Format::Json)?;
        Ok(convert::reduce(&py.get_type::<Self>(), &text)?)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> Result<Self> {
        let text: String = convert::from_bytes(bytes)?;
        Self::from_text(&text, "json")
    }
}

fn to_value_error(error: impl ToString) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(error.to_string())
}

/// Reads a scene from a file, .toml or .json; meshes that it names are read too, relative paths
/// starting beside it.
#[pyfunction]
#[pyo3(signature = (path))]
pub(crate) fn load(path: PathBuf) -> Result<PyScene> {
    Ok(PyScene(Scene::load(path)?))
}

/// The JSON Schema of scene files, as JSON text.
#[pyfunction]
#[pyo3(signature = ())]
pub(crate) fn schema() -> String {
    format!("{:#}", Scene::schema())
}
