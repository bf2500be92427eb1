//! The time of contact of two moving bodies: one search, and many at once.

use bryla::closest::{ClosestFeatures, Collider};
use bryla::impact::{Finder, Impact, Motion, time_of_impact as search};
use bryla::math::{Pose, quaternion};
use numpy::{IxDyn, PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};

use crate::closest::body::with_body;
use crate::closest::many::add_columns;
use crate::closest::query::PyClosestFeatures;
use crate::convert::{self, Array, ArrayLike, Numbers, Reduced, array, items, named};
use crate::error::Result;

/// A uniform motion: a point of a body moves with constant velocity, and the body turns about it with
/// constant angular velocity.
///
/// x(t) = position + t velocity,  R(t) = exp(t [angular_velocity]) R(0)
///
/// Parameters
/// ----------
/// position : 3 numbers
///     Where the point `center` is at t = 0, world axes [m].
/// orientation : 4 numbers
///     Rotation from the shape's axes to the world's at t = 0, (w, x, y, z); it is divided by its length.
/// velocity : 3 numbers
///     Velocity of the point `center`, world axes [m/s].
/// angular_velocity : 3 numbers
///     Angular velocity, world axes [rad/s].
/// center : 3 numbers, optional
///     The point that moves uniformly, shape axes [m]: the shape's origin unless told otherwise.
#[pyclass(name = "Motion", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyMotion(Motion);

fn motion(x: [f64; 3], q: [f64; 4], v: [f64; 3], w: [f64; 3], center: [f64; 3]) -> Motion {
    Motion::new(Pose::new(x, q), v, w).about(center)
}

#[pymethods]
impl PyMotion {
    #[new]
    #[pyo3(
        signature = (position, orientation, velocity, angular_velocity, center=Numbers([0.0; 3])),
        text_signature = "(position, orientation, velocity, angular_velocity, center=(0.0, 0.0, 0.0))"
    )]
    fn new(
        position: Numbers<3>,
        orientation: Numbers<4>,
        velocity: Numbers<3>,
        angular_velocity: Numbers<3>,
        center: Numbers<3>,
    ) -> Self {
        Self(motion(position.0, orientation.0, velocity.0, angular_velocity.0, center.0))
    }

    /// Where the point `center` is at t = 0, world axes [m]: array (3,).
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.position)
    }

    /// Rotation from the shape's axes to the world's at t = 0, (w, x, y, z): array (4,).
    #[getter]
    fn orientation<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        array(py, &[4], quaternion::to_scalar_first(&self.0.orientation).to_vec())
    }

    /// Velocity of the point `center`, world axes [m/s]: array (3,).
    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.velocity)
    }

    /// Angular velocity, world axes [rad/s]: array (3,).
    #[getter]
    fn angular_velocity<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.angular_velocity)
    }

    /// The point that moves uniformly, shape axes [m]: array (3,).
    #[getter]
    fn center<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.center)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        use pyo3::IntoPyObjectExt;
        let Motion { position, orientation, velocity, angular_velocity, center } = &self.0;
        let fields = vec![
            ("position", Numbers((*position).into()).into_py_any(py)),
            ("orientation", Numbers(quaternion::to_scalar_first(orientation)).into_py_any(py)),
            ("velocity", Numbers((*velocity).into()).into_py_any(py)),
            ("angular_velocity", Numbers((*angular_velocity).into()).into_py_any(py)),
            ("center", Numbers((*center).into()).into_py_any(py)),
        ];
        convert::call_text(py, "Motion", fields)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

/// How a search for an impact ended, and what it cost.
#[pyclass(name = "Impact", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyImpact(Impact);

#[pymethods]
impl PyImpact {
    /// "clear": no impact, proved by the guaranteed search, not seen by the others. "at": the gap is in
    /// (0, eps] and closes. "already_touching": the search starts with a gap within eps that closes, or that
    /// stays. "overlap": it starts in overlap. "grazing": the gap came within (0, eps] and opens again.
    /// "stalled": eps is below what rounding leaves.
    #[getter]
    fn outcome(&self) -> &'static str {
        self.0.outcome.name()
    }

    /// When [s]: of the impact or graze; the end of the search where it is clear; how far it came where it
    /// stalled; else its start.
    #[getter]
    fn time(&self) -> f64 {
        self.0.time
    }

    /// Rounds of the finder.
    #[getter]
    fn iterations(&self) -> u32 {
        self.0.iterations
    }

    /// Queries of the closest features, or evaluations of the gap.
    #[getter]
    fn queries(&self) -> u32 {
        self.0.queries
    }

    /// The closest features at that time.
    #[getter]
    fn closest(&self) -> PyClosestFeatures {
        PyClosestFeatures(self.0.closest)
    }

    fn __repr__(&self) -> String {
        let Impact { time, iterations, queries, .. } = self.0;
        format!("<Impact {}, t = {time:?} s, {iterations} iterations, {queries} queries>", self.outcome())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

fn finder_of(name: &str) -> Result<Finder> {
    named("time of impact", "finder", Finder::ALL, Finder::name, name)
}

/// The first impact of two moving bodies in 0 to t_max, other threads running meanwhile.
///
/// Accepted is only a gap in (0, eps], never an overlap. The guaranteed search proves the way free and misses
/// nothing; bisection and secant are the lecture's, look at the ends of the time, and do not see what passes
/// through between them. A pair that starts within eps and separates is searched on from where its gap exceeds
/// eps, or from where its approach resumes.
///
/// Parameters
/// ----------
/// a, b : a shape, ConvexPolyhedron or Collider
///     The bodies; a shape is prepared at each call, a Collider once.
/// motion_a, motion_b : Motion
///     How they move.
/// t_max : float
///     Up to when is searched [s].
/// eps : float, optional
///     The gap at which contact is accepted [m]: without it 1e-12 of the pair's size (both radii). The guaranteed
///     search takes no less than the rounding of the coordinates. A smaller one is found later by less than eps
///     over the speed of approach.
/// finder : "guaranteed", "secant" or "bisection"
///     How the time is found.
///
/// Returns
/// -------
/// Impact
#[pyfunction]
#[pyo3(signature = (a, motion_a, b, motion_b, t_max, eps=None, finder="guaranteed"))]
#[allow(clippy::too_many_arguments, reason = "those of the core")]
fn time_of_impact(
    py: Python<'_>,
    a: Bound<'_, PyAny>,
    motion_a: PyRef<'_, PyMotion>,
    b: Bound<'_, PyAny>,
    motion_b: PyRef<'_, PyMotion>,
    t_max: f64,
    eps: Option<f64>,
    finder: &str,
) -> Result<PyImpact> {
    let finder = finder_of(finder)?;
    let (x, y) = (motion_a.0, motion_b.0);
    let found = with_body(&a, |a| with_body(&b, |b| Ok(py.detach(|| search(a, &x, b, &y, t_max, eps, finder))?)))?;
    Ok(PyImpact(found))
}

/// Motions: one, or arrays of what it is made of; their leading axes, if there are arrays.
struct Motions(Vec<Motion>, Option<Vec<usize>>);

impl<'py> FromPyObject<'_, 'py> for Motions {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(motion) = obj.cast::<PyMotion>() {
            return Ok(Self(vec![motion.get().0], None));
        }
        let given = obj.cast::<PyTuple>().ok().filter(|given| (4..=5).contains(&given.len()));
        let Some(given) = given else {
            let wanted = "a Motion, or a tuple of arrays (positions, orientations, velocities, angular_velocities)";
            return Err(PyTypeError::new_err(format!("{wanted} wanted, perhaps with centers, got {}", obj.repr()?)));
        };
        let column = |k: usize| -> PyResult<ArrayLike<'py>> { given.get_item(k)?.extract() };
        let vectors = |k: usize| items::<3>(&column(k)?, &[3]);
        let (positions, orientations) = (vectors(0)?, items::<4>(&column(1)?, &[4])?);
        let (velocities, turns) = (vectors(2)?, vectors(3)?);
        let centers = if given.len() == 5 { vectors(4)? } else { (Vec::new(), vec![[0.0; 3]]) };

        // one of a kind stands for all
        let all = [&positions.0, &orientations.0, &velocities.0, &turns.0, &centers.0];
        let leading = all.into_iter().find(|axes| !axes.is_empty()).cloned().unwrap_or_default();
        if let Some(other) = all.into_iter().find(|axes| !axes.is_empty() && **axes != leading) {
            let message =
                format!("arrays of one motion must agree in their leading axes, got {leading:?} and {other:?}");
            return Err(PyValueError::new_err(message));
        }
        let of = |k: usize| {
            let (x, q) = (pick(&positions.1, k), pick(&orientations.1, k));
            motion(x, q, pick(&velocities.1, k), pick(&turns.1, k), pick(&centers.1, k))
        };
        Ok(Self((0..leading.iter().product()).map(of).collect(), Some(leading)))
    }
}

/// The item of this number, or the only one.
fn pick<const N: usize>(items: &[[f64; N]], k: usize) -> [f64; N] {
    items[k % items.len()]
}

/// Impacts for many motions of one pair, other threads running meanwhile.
///
/// Parameters
/// ----------
/// a, b : a shape, ConvexPolyhedron or Collider
///     The bodies.
/// motions_a, motions_b : Motion, or a tuple of arrays
///     One motion, or positions (..., 3) [m], orientations (..., 4), velocities (..., 3) [m/s], angular
///     velocities (..., 3) [rad/s], and, where they are not 0, centers (..., 3) [m]: each may be a single one.
/// t_max : float
///     Up to when is searched [s].
/// eps : float, optional
///     As for time_of_impact.
/// finder : "guaranteed", "secant" or "bisection"
///     As for time_of_impact.
///
/// Returns
/// -------
/// dict of arrays
///     "outcome": (...), the words of Impact; "time": (...) [s]; "iterations", "queries": (...); and the closest
///     features at that time, as closest_features_many gives them.
#[pyfunction]
#[pyo3(signature = (a, motions_a, b, motions_b, t_max, eps=None, finder="guaranteed"))]
#[allow(clippy::too_many_arguments, reason = "those of the core")]
fn time_of_impact_many<'py>(
    py: Python<'py>,
    a: Bound<'py, PyAny>,
    motions_a: Motions,
    b: Bound<'py, PyAny>,
    motions_b: Motions,
    t_max: f64,
    eps: Option<f64>,
    finder: &str,
) -> Result<Bound<'py, PyDict>> {
    let finder = finder_of(finder)?;
    let leading = match (&motions_a.1, &motions_b.1) {
        (Some(x), Some(y)) if x != y => {
            let message = format!("as many motions of A as of B wanted, got {x:?} and {y:?}");
            return Err(PyValueError::new_err(message).into());
        }
        (Some(x), _) | (None, Some(x)) => x.clone(),
        (None, None) => Vec::new(),
    };
    let count: usize = leading.iter().product();
    let pairs = motions_a.0.iter().cycle().zip(motions_b.0.iter().cycle()).take(count);
    let all = |a: &Collider, b: &Collider| -> bryla::Result<Vec<Impact>> {
        pairs.map(|(x, y)| search(a, x, b, y, t_max, eps, finder)).collect()
    };
    let found = with_body(&a, |a| with_body(&b, |b| Ok(py.detach(|| all(a, b))?)))?;

    let answer = PyDict::new(py);
    let words: Vec<_> = found.iter().map(|impact| impact.outcome.name()).collect();
    let words = py.import("numpy")?.call_method1("array", (words, "U16"))?;
    answer.set_item("outcome", words.call_method1("reshape", (PyTuple::new(py, &leading)?,))?)?;
    answer.set_item("time", array(py, &leading, found.iter().map(|impact| impact.time).collect())?)?;
    let iterations: Vec<u32> = found.iter().map(|impact| impact.iterations).collect();
    let queries: Vec<u32> = found.iter().map(|impact| impact.queries).collect();
    for (name, counts) in [("iterations", iterations), ("queries", queries)] {
        let numbers = PyArray1::from_vec(py, counts);
        answer.set_item(name, numbers.reshape(IxDyn(&leading))?)?;
    }
    let closest: Vec<ClosestFeatures> = found.iter().map(|impact| impact.closest).collect();
    add_columns(&answer, &leading, &closest)?;
    Ok(answer)
}

/// Adds the classes and functions.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyMotion>()?;
    module.add_class::<PyImpact>()?;
    module.add_function(wrap_pyfunction!(time_of_impact, module)?)?;
    module.add_function(wrap_pyfunction!(time_of_impact_many, module)?)
}
