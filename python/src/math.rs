//! The lecture's mathematics: poses, rotations as matrices, quaternions.

use bryla::Pose;
use bryla::math::{Quaternion, Vector3, quaternion as q, rotation as r};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::convert::{self, Array, ArrayLike, Numbers, Reduced, from_rows, map, map_pairs, rows};

/// Axes of one item of an array.
const SCALAR: &[usize] = &[];
const VECTOR: &[usize] = &[3];
const QUATERNION: &[usize] = &[4];
const MATRIX: &[usize] = &[3, 3];

/// Position and orientation of a frame: its point p stands at R p + position in the world.
///
/// Parameters
/// ----------
/// position : 3 numbers
///     Where the frame's origin stands, world axes [m].
/// orientation : 4 numbers
///     Rotation from the frame's axes to the world's, (w, x, y, z); it is divided by its length.
#[pyclass(name = "Pose", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyPose(pub(crate) Pose);

impl PyPose {
    fn map<'py>(py: Python<'py>, given: &ArrayLike<'py>, f: impl Fn(&Vector3) -> Vector3) -> PyResult<Array<'py>> {
        map(py, given, [VECTOR, VECTOR], |v: [f64; 3]| f(&v.into()).into())
    }
}

#[pymethods]
impl PyPose {
    #[new]
    #[pyo3(
        signature = (position=Numbers([0.0; 3]), orientation=Numbers([1.0, 0.0, 0.0, 0.0])),
        text_signature = "(position=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0))"
    )]
    fn new(position: Numbers<3>, orientation: Numbers<4>) -> Self {
        Self(Pose::new(position.0, orientation.0))
    }

    /// Where the frame's origin stands, world axes [m]: array (3,).
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.position)
    }

    /// Rotation from the frame's axes to the world's, (w, x, y, z): array (4,).
    #[getter]
    fn orientation<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::array(py, QUATERNION, q::to_scalar_first(&self.0.orientation).to_vec())
    }

    /// The same rotation as a matrix: array (3, 3).
    #[getter]
    fn rotation<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::matrix(py, &q::to_matrix(&self.0.orientation))
    }

    /// World coordinates of points given in the frame [m]: array (..., 3).
    #[pyo3(signature = (body))]
    fn point<'py>(&self, py: Python<'py>, body: ArrayLike<'py>) -> PyResult<Array<'py>> {
        Self::map(py, &body, |v| self.0.point(v))
    }

    /// World components of vectors given in the frame: array (..., 3).
    #[pyo3(signature = (body))]
    fn vector<'py>(&self, py: Python<'py>, body: ArrayLike<'py>) -> PyResult<Array<'py>> {
        Self::map(py, &body, |v| self.0.vector(v))
    }

    /// Frame coordinates of points given in the world [m]: array (..., 3).
    #[pyo3(signature = (world))]
    fn inverse_point<'py>(&self, py: Python<'py>, world: ArrayLike<'py>) -> PyResult<Array<'py>> {
        Self::map(py, &world, |v| self.0.inverse_point(v))
    }

    /// Frame components of vectors given in world axes: array (..., 3).
    #[pyo3(signature = (world))]
    fn inverse_vector<'py>(&self, py: Python<'py>, world: ArrayLike<'py>) -> PyResult<Array<'py>> {
        Self::map(py, &world, |v| self.0.inverse_vector(v))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        use pyo3::IntoPyObjectExt;
        let fields = vec![
            ("position", Numbers(self.0.position.into()).into_py_any(py)),
            ("orientation", Numbers(q::to_scalar_first(&self.0.orientation)).into_py_any(py)),
        ];
        convert::call_text(py, "Pose", fields)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}

/// Rotations as matrices. Arguments may have leading axes, which the result keeps.
#[pymodule(name = "rotation", submodule)]
mod rotation {
    use super::{Array, ArrayLike, MATRIX, PyResult, Python, SCALAR, VECTOR, from_rows, map, pyfunction, r, rows};

    /// Rotation by an angle [rad] about the x axis: array (..., 3, 3).
    #[pyfunction]
    #[pyo3(signature = (angle))]
    fn elementary_x<'py>(py: Python<'py>, angle: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &angle, [SCALAR, MATRIX], |[angle]: [f64; 1]| rows(&r::elementary_x(angle)))
    }

    /// Rotation by an angle [rad] about the y axis: array (..., 3, 3).
    #[pyfunction]
    #[pyo3(signature = (angle))]
    fn elementary_y<'py>(py: Python<'py>, angle: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &angle, [SCALAR, MATRIX], |[angle]: [f64; 1]| rows(&r::elementary_y(angle)))
    }

    /// Rotation by an angle [rad] about the z axis: array (..., 3, 3).
    #[pyfunction]
    #[pyo3(signature = (angle))]
    fn elementary_z<'py>(py: Python<'py>, angle: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &angle, [SCALAR, MATRIX], |[angle]: [f64; 1]| rows(&r::elementary_z(angle)))
    }

    /// The matrix Ω of a vector (..., 3), for which Ω(w) r = w × r: array (..., 3, 3).
    #[pyfunction]
    #[pyo3(signature = (w))]
    fn cross_matrix<'py>(py: Python<'py>, w: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &w, [VECTOR, MATRIX], |w: [f64; 3]| rows(&r::cross_matrix(&w.into())))
    }

    /// The rotation nearest to a matrix (..., 3, 3), its orthogonal polar factor: array (..., 3, 3).
    ///
    /// Where the determinant is not positive there is none, and the answer is not finite.
    #[pyfunction]
    #[pyo3(signature = (r))]
    fn polar_factor<'py>(py: Python<'py>, r: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &r, [MATRIX, MATRIX], |m: [f64; 9]| rows(&super::r::polar_factor(&from_rows(m))))
    }

    /// Distance of a matrix (..., 3, 3) from an orthogonal one, ‖RᵀR − 1‖ [-]: array (...).
    #[pyfunction]
    #[pyo3(signature = (r))]
    fn orthogonality_error<'py>(py: Python<'py>, r: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &r, [MATRIX, SCALAR], |m: [f64; 9]| [super::r::orthogonality_error(&from_rows(m))])
    }
}

/// Quaternions (w, x, y, z). Arguments may have leading axes, which the result keeps; of two
/// arguments one may be single.
#[pymodule(name = "quaternion", submodule)]
mod quaternion {
    use super::{
        Array, ArrayLike, MATRIX, PyResult, Python, QUATERNION, SCALAR, VECTOR, from, from_rows, map, map_pairs,
        pyfunction, q, rows, to,
    };

    /// Rotation by an angle [rad] about a unit vector (..., 3), [cos(θ/2), sin(θ/2) u]: array (..., 4).
    #[pyfunction]
    #[pyo3(signature = (axis, angle))]
    fn from_axis_angle<'py>(py: Python<'py>, axis: ArrayLike<'py>, angle: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map_pairs(py, [&axis, &angle], [VECTOR, SCALAR, QUATERNION], |axis: [f64; 3], [angle]: [f64; 1]| {
            to(&q::from_axis_angle(&axis.into(), angle))
        })
    }

    /// The rotation by the angle |phi| [rad] about the direction of phi (..., 3): array (..., 4).
    #[pyfunction]
    #[pyo3(signature = (phi))]
    fn exp<'py>(py: Python<'py>, phi: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &phi, [VECTOR, QUATERNION], |phi: [f64; 3]| to(&q::exp(&phi.into())))
    }

    /// The rotation vector [rad], |φ| ≤ π, of a unit quaternion (..., 4): array (..., 3).
    #[pyfunction]
    #[pyo3(signature = (q))]
    fn log<'py>(py: Python<'py>, q: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &q, [QUATERNION, VECTOR], |a: [f64; 4]| super::q::log(&from(a)).into())
    }

    /// The matrix of the rotation q/|q|, q being (..., 4): array (..., 3, 3).
    #[pyfunction]
    #[pyo3(signature = (q))]
    fn to_matrix<'py>(py: Python<'py>, q: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &q, [QUATERNION, MATRIX], |a: [f64; 4]| rows(&super::q::to_matrix(&from(a))))
    }

    /// The unit quaternion of a rotation matrix (..., 3, 3): array (..., 4).
    #[pyfunction]
    #[pyo3(signature = (r))]
    fn from_matrix<'py>(py: Python<'py>, r: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &r, [MATRIX, QUATERNION], |m: [f64; 9]| to(&q::from_matrix(&from_rows(m))))
    }

    /// The product a b: first the rotation b, then a: array (..., 4).
    #[pyfunction]
    #[pyo3(signature = (a, b))]
    fn product<'py>(py: Python<'py>, a: ArrayLike<'py>, b: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map_pairs(py, [&a, &b], [QUATERNION; 3], |a: [f64; 4], b: [f64; 4]| to(&(from(a) * from(b))))
    }

    /// The conjugate (w, −x, −y, −z), for a unit quaternion the rotation back: array (..., 4).
    #[pyfunction]
    #[pyo3(signature = (q))]
    fn conjugate<'py>(py: Python<'py>, q: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map(py, &q, [QUATERNION, QUATERNION], |a: [f64; 4]| to(&from(a).conjugate()))
    }

    /// The vector v (..., 3) rotated by the unit quaternion q (..., 4), q v q*: array (..., 3).
    #[pyfunction]
    #[pyo3(signature = (q, v))]
    fn rotate<'py>(py: Python<'py>, q: ArrayLike<'py>, v: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map_pairs(py, [&q, &v], [QUATERNION, VECTOR, VECTOR], |a: [f64; 4], v: [f64; 3]| {
            super::q::rotate(&from(a), &v.into()).into()
        })
    }

    /// The angle [rad] of the rotation from a to b, 0 to π; q and −q are one rotation: array (...).
    #[pyfunction]
    #[pyo3(signature = (a, b))]
    fn angle_between<'py>(py: Python<'py>, a: ArrayLike<'py>, b: ArrayLike<'py>) -> PyResult<Array<'py>> {
        map_pairs(py, [&a, &b], [QUATERNION, QUATERNION, SCALAR], |a: [f64; 4], b: [f64; 4]| {
            [q::angle_between(&from(a), &from(b))]
        })
    }
}

fn from(wxyz: [f64; 4]) -> Quaternion {
    q::from_scalar_first(wxyz)
}

fn to(quaternion: &Quaternion) -> [f64; 4] {
    q::to_scalar_first(quaternion)
}

/// Adds the class, and the modules `bryla.rotation` and `bryla.quaternion`.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add_class::<PyPose>()?;
    let modules = py.import("sys")?.getattr("modules")?.cast_into::<PyDict>()?;
    for part in [pyo3::wrap_pymodule!(rotation)(py), pyo3::wrap_pymodule!(quaternion)(py)] {
        let part = part.into_bound(py);
        let name = part.name()?;
        let full_name = format!("bryla.{name}");
        part.setattr("__name__", &full_name)?;
        modules.set_item(&full_name, &part)?;
        module.add(name, &part)?;
    }
    Ok(())
}
