//! One query: where it starts, when it may stop, what it answers.

use bryla::closest::{Accuracy, ClosestFeatures, Feature, PairCache, Rung, State, closest_features as query};
use pyo3::prelude::*;
use pyo3::types::PyType;

use super::body::with_body;
use crate::convert::{self, Array, Reduced};
use crate::error::Result;
use crate::math::PyPose;

/// Where a pair's last answer was found, to start the next query of the same pair from.
///
/// Any content is legal, also from another pair or another time: it costs steps, never truth.
#[pyclass(name = "PairCache", module = "bryla")]
#[derive(Debug, Clone, Default)]
pub(crate) struct PyPairCache(PairCache);

#[pymethods]
impl PyPairCache {
    #[new]
    fn new() -> Self {
        Self::default()
    }
}

/// When a query may stop: `"exact"`, `"yes_no"`, or a fraction of the size.
pub(crate) struct Stop(pub(super) Accuracy);

impl<'py> FromPyObject<'_, 'py> for Stop {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(fraction) = obj.extract::<f64>() {
            if fraction > 0.0 && fraction < 1.0 {
                return Ok(Self(Accuracy::Relative(fraction)));
            }
        } else if let Ok(word) = obj.extract::<String>() {
            match word.as_str() {
                "exact" => return Ok(Self(Accuracy::Exact)),
                "yes_no" => return Ok(Self(Accuracy::YesNo)),
                _ => {}
            }
        }
        let error = bryla::Error::value(
            "closest features",
            "accuracy",
            "\"exact\", \"yes_no\" or a fraction between 0 and 1",
            obj.repr()?.to_string(),
        );
        Err(crate::error::Failure::from(error).into())
    }
}

/// The words of a state.
pub(super) fn state_name(state: State) -> &'static str {
    match state {
        State::Separated => "separated",
        State::Touching => "touching",
        State::Overlapping => "overlapping",
    }
}

/// The closest features of two bodies A and B, in world axes.
#[pyclass(name = "ClosestFeatures", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyClosestFeatures(pub(crate) ClosestFeatures);

#[pymethods]
impl PyClosestFeatures {
    /// Distance where positive, minus the depth where negative [m]: normal · (point_b − point_a).
    #[getter]
    fn signed_distance(&self) -> f64 {
        self.0.signed_distance
    }

    /// The true signed distance is not below this [m].
    #[getter]
    fn lower(&self) -> f64 {
        self.0.lower
    }

    /// The true signed distance is not above this [m].
    #[getter]
    fn upper(&self) -> f64 {
        self.0.upper
    }

    /// "separated", "touching" (the interval contains 0) or "overlapping".
    #[getter]
    fn state(&self) -> &'static str {
        state_name(self.0.state)
    }

    /// The closest or deepest point of A, world axes [m]: array (3,).
    #[getter]
    fn point_a<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.point_a)
    }

    /// The closest or deepest point of B, world axes [m]: array (3,).
    #[getter]
    fn point_b<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.point_b)
    }

    /// Unit normal from A to B, world axes; valid in every state: array (3,).
    #[getter]
    fn normal<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.normal)
    }

    /// The feature of A that carries point_a: "vertex", "edge", "face" or "surface" (curved), and its
    /// number.
    #[getter]
    fn feature_a(&self) -> (&'static str, u32) {
        named(self.0.feature_a)
    }

    /// The feature of B that carries point_b.
    #[getter]
    fn feature_b(&self) -> (&'static str, u32) {
        named(self.0.feature_b)
    }

    /// The piece of A that the feature belongs to, where A is a compound; else 0.
    #[getter]
    fn part_a(&self) -> u32 {
        self.0.part_a
    }

    /// The piece of B that the feature belongs to, where B is a compound; else 0.
    #[getter]
    fn part_b(&self) -> u32 {
        self.0.part_b
    }

    /// Rounds of the query.
    #[getter]
    fn steps(&self) -> u32 {
        self.0.steps
    }

    /// How far the query had to climb: "verified" (the cached features or their neighbours were the answer),
    /// "walked" (from the cached features), "searched" or "double_double".
    #[getter]
    fn rung(&self) -> &'static str {
        match self.0.rung {
            Rung::Verified => "verified",
            Rung::Walked => "walked",
            Rung::Searched => "searched",
            Rung::DoubleDouble => "double_double",
        }
    }

    /// Whether the interval is as narrow as was asked for. If not, it still contains the true value.
    #[getter]
    fn certified(&self) -> bool {
        self.0.certified
    }

    fn __repr__(&self) -> String {
        let ((kind_a, a), (kind_b, b)) = (self.feature_a(), self.feature_b());
        let (state, d) = (self.state(), self.0.signed_distance);
        format!("<ClosestFeatures {state}, signed distance {d:?} m, {kind_a} {a} to {kind_b} {b}>")
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

fn named(feature: Feature) -> (&'static str, u32) {
    (feature.kind(), feature.index())
}

/// Closest features of two bodies: one signed distance, with an interval that contains the true one.
///
/// Parameters
/// ----------
/// a, b : a shape, ConvexPolyhedron or Collider
///     The bodies; a shape is prepared at each call, a Collider once.
/// pose_a, pose_b : Pose
///     Where the shapes' own axes stand.
/// cache : PairCache, optional
///     A start, left with this answer: use one for each pair that is asked again and again.
/// accuracy : "exact", "yes_no" or float
///     When the query may stop: at an interval as narrow as rounding allows, as soon as the state is
///     known, or at this fraction of the size (both radii and the distance of the centres).
///
/// Returns
/// -------
/// ClosestFeatures
#[pyfunction]
#[pyo3(
    signature = (a, pose_a, b, pose_b, cache=None, accuracy=Stop(Accuracy::Exact)),
    text_signature = "(a, pose_a, b, pose_b, cache=None, accuracy=\"exact\")"
)]
pub(crate) fn closest_features(
    a: Bound<'_, PyAny>,
    pose_a: PyRef<'_, PyPose>,
    b: Bound<'_, PyAny>,
    pose_b: PyRef<'_, PyPose>,
    cache: Option<PyRefMut<'_, PyPairCache>>,
    accuracy: Stop,
) -> Result<PyClosestFeatures> {
    let mut cache = cache;
    let cache = cache.as_deref_mut().map(|c| &mut c.0);
    let found = with_body(&a, |a| with_body(&b, |b| Ok(query(a, &pose_a.0, b, &pose_b.0, cache, accuracy.0)?)))?;
    Ok(PyClosestFeatures(found))
}
