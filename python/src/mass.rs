//! Mass properties.

use bryla::MassProperties;
use bryla::math::{Matrix3, Vector3, quaternion};
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::convert::{self, Array, List, Numbers, Plain, Reduced};
use crate::error::Result;

/// Mass, centre of mass and inertia of a body, in the shape's own axes.
///
/// Refused is what no body can have: a mass that is not positive, an inertia that is not symmetric,
/// not positive definite, or whose largest principal moment exceeds the sum of the two others.
///
/// Parameters
/// ----------
/// mass : float
///     Mass [kg].
/// center_of_mass : 3 numbers
///     Centre of mass, shape axes [m].
/// inertia : 3 rows of 3 numbers
///     Inertia about the centre of mass, shape axes [kg m²]; off-diagonal entries with their minus,
///     I₁₂ = −∫ x₁ x₂ dm.
#[pyclass(name = "MassProperties", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyMassProperties(pub(crate) MassProperties);

#[pymethods]
impl PyMassProperties {
    #[new]
    fn new(mass: f64, center_of_mass: Numbers<3>, inertia: List<Numbers<3>>) -> Result<Self> {
        let rows = <[[f64; 3]; 3]>::from_python(inertia)?;
        let inertia = Matrix3::from_fn(|r, c| rows[r][c]);
        Ok(Self(MassProperties::new("mass properties", mass, center_of_mass.0, inertia)?))
    }

    /// Several parts, given in common axes, as one rigid body.
    #[staticmethod]
    #[pyo3(signature = (parts))]
    fn combined(parts: Vec<PyRef<'_, Self>>) -> Self {
        let parts: Vec<_> = parts.iter().map(|part| part.0).collect();
        Self(MassProperties::combined(&parts))
    }

    /// Mass [kg].
    #[getter]
    fn mass(&self) -> f64 {
        self.0.mass
    }

    /// Centre of mass, shape axes [m]: array (3,).
    #[getter]
    fn center_of_mass<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.center_of_mass)
    }

    /// Inertia about the centre of mass, shape axes [kg m²]: array (3, 3).
    #[getter]
    fn inertia<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::matrix(py, &self.0.inertia)
    }

    /// Principal moments of inertia, ascending [kg m²]: array (3,).
    #[getter]
    fn principal_moments<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::vector(py, &self.0.principal_moments())
    }

    /// Principal axes as columns, a rotation from principal to shape axes: array (3, 3).
    #[getter]
    fn principal_axes<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        convert::matrix(py, &self.0.principal_axes())
    }

    /// Inertia about another point [m] of the shape axes [kg m²]: array (3, 3).
    #[pyo3(signature = (point))]
    fn about<'py>(&self, py: Python<'py>, point: Numbers<3>) -> PyResult<Array<'py>> {
        convert::matrix(py, &self.0.about(point.0))
    }

    /// The same matter moved by a translation [m].
    #[pyo3(signature = (translation))]
    fn moved(&self, translation: Numbers<3>) -> Self {
        Self(self.0.moved(Vector3::from(translation.0)))
    }

    /// The same matter turned about the origin by a rotation (w, x, y, z).
    #[pyo3(signature = (orientation))]
    fn turned(&self, orientation: Numbers<4>) -> Self {
        Self(self.0.turned(&quaternion::from_scalar_first(orientation.0)))
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        use pyo3::IntoPyObjectExt;
        let inertia = [0, 1, 2].map(|r| [0, 1, 2].map(|c| self.0.inertia[(r, c)]));
        let fields = vec![
            ("mass", self.0.mass.into_py_any(py)),
            ("center_of_mass", Numbers(self.0.center_of_mass.into()).into_py_any(py)),
            ("inertia", inertia.to_python().into_py_any(py)),
        ];
        convert::call_text(py, "MassProperties", fields)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        convert::reduce(&py.get_type::<Self>(), &self.0)
    }

    #[classmethod]
    fn _from_bytes(_class: &Bound<'_, PyType>, bytes: &[u8]) -> PyResult<Self> {
        convert::from_bytes(bytes).map(Self)
    }
}
