//! Many queries of one pair at once.

use bryla::closest::{Accuracy, ClosestFeatures, Collider, PairCache, State, closest_features as query};
use bryla::math::{Pose, quaternion};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::body::with_body;
use super::query::Stop;
use crate::convert::{ArrayLike, array, items};
use crate::error::Result;
use crate::math::PyPose;

/// Poses: one, or arrays of positions and orientations.
pub(crate) struct Poses(Vec<Pose>, Option<Vec<usize>>);

impl<'py> FromPyObject<'_, 'py> for Poses {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(pose) = obj.cast::<PyPose>() {
            return Ok(Self(vec![pose.get().0], None));
        }
        let (positions, orientations): (ArrayLike<'_>, ArrayLike<'_>) = obj.extract()?;
        let ((shape, x), (shape_q, q)) = (items::<3>(&positions, &[3])?, items::<4>(&orientations, &[4])?);
        if shape != shape_q && !shape.is_empty() && !shape_q.is_empty() {
            let message = format!("as many positions as orientations wanted, got {shape:?} and {shape_q:?}");
            return Err(pyo3::exceptions::PyValueError::new_err(message));
        }
        let leading = if shape.is_empty() { shape_q } else { shape };
        let count = leading.iter().product();
        let pairs = x.iter().cycle().zip(q.iter().cycle()).take(count);
        let pose = |(&x, &q): (&[f64; 3], &[f64; 4])| Pose {
            position: x.into(),
            orientation: quaternion::from_scalar_first(q),
        };
        Ok(Self(pairs.map(pose).collect(), Some(leading)))
    }
}

/// One column of many answers.
type Get<T> = fn(&ClosestFeatures) -> T;

/// Closest features for many poses of one pair, other threads running meanwhile.
///
/// Each query starts from the one before it, so order the poses along the motion; poses that have nothing to do
/// with each other are asked faster anew.
///
/// Parameters
/// ----------
/// a, b : a shape, ConvexPolyhedron or Collider
///     The bodies.
/// poses_a, poses_b : Pose, or a pair of arrays
///     One pose, or positions (..., 3) [m] and orientations (..., 4), which mean q/|q|.
/// accuracy : "exact", "yes_no" or float
///     As for closest_features.
/// warm : bool
///     Whether a query starts from the one before it. Anew, no answer's rounding depends on the other poses.
///
/// Returns
/// -------
/// dict of arrays
///     "signed_distance", "lower", "upper": (...) [m]; "point_a", "point_b", "normal": (..., 3), world
///     axes; "state": (...), 1 separated, 0 touching, −1 overlapping; "certified": (...), 1 or 0.
#[pyfunction]
#[pyo3(
    signature = (a, poses_a, b, poses_b, accuracy=Stop(Accuracy::Exact), warm=true),
    text_signature = "(a, poses_a, b, poses_b, accuracy=\"exact\", warm=True)"
)]
pub(crate) fn closest_features_many<'py>(
    py: Python<'py>,
    a: Bound<'py, PyAny>,
    poses_a: Poses,
    b: Bound<'py, PyAny>,
    poses_b: Poses,
    accuracy: Stop,
    warm: bool,
) -> Result<Bound<'py, PyDict>> {
    let leading = match (&poses_a.1, &poses_b.1) {
        (Some(x), Some(y)) if x != y => {
            let message = format!("as many poses of A as of B wanted, got {x:?} and {y:?}");
            return Err(pyo3::exceptions::PyValueError::new_err(message).into());
        }
        (Some(x), _) | (None, Some(x)) => x.clone(),
        (None, None) => Vec::new(),
    };
    let count: usize = leading.iter().product();
    let pairs = poses_a.0.iter().cycle().zip(poses_b.0.iter().cycle()).take(count);
    let all = |a: &Collider, b: &Collider| -> bryla::Result<Vec<ClosestFeatures>> {
        let mut cache = PairCache::new();
        pairs.map(|(x, y)| query(a, x, b, y, warm.then_some(&mut cache), accuracy.0)).collect()
    };
    let found = with_body(&a, |a| with_body(&b, |b| Ok(py.detach(|| all(a, b))?)))?;

    let answer = PyDict::new(py);
    add_columns(&answer, &leading, &found)?;
    Ok(answer)
}

/// Adds the columns of answers whose leading axes are these.
pub(crate) fn add_columns(answer: &Bound<'_, PyDict>, leading: &[usize], found: &[ClosestFeatures]) -> PyResult<()> {
    let py = answer.py();
    let scalars: [(&str, Get<f64>); 3] =
        [("signed_distance", |f| f.signed_distance), ("lower", |f| f.lower), ("upper", |f| f.upper)];
    for (name, get) in scalars {
        answer.set_item(name, array(py, leading, found.iter().map(get).collect())?)?;
    }
    let vectors: [(&str, Get<[f64; 3]>); 3] =
        [("point_a", |f| f.point_a.into()), ("point_b", |f| f.point_b.into()), ("normal", |f| f.normal.into())];
    let mut shape = leading.to_vec();
    shape.push(3);
    for (name, get) in vectors {
        answer.set_item(name, array(py, &shape, found.iter().flat_map(get).collect())?)?;
    }
    let words: [(&str, Get<i8>); 2] = [
        ("state", |f| match f.state {
            State::Separated => 1,
            State::Touching => 0,
            State::Overlapping => -1,
        }),
        ("certified", |f| i8::from(f.certified)),
    ];
    for (name, get) in words {
        let numbers = PyArray1::from_vec(py, found.iter().map(get).collect());
        answer.set_item(name, numbers.reshape(numpy::IxDyn(leading))?)?;
    }
    Ok(())
}
