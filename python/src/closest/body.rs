//! Bodies prepared for queries.

use bryla::closest::Collider;
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::convert::{Array, ArrayLike, Numbers, array, items};
use crate::error::Result;
use crate::shape::AnyShape;

/// The convex hull of points: vertices, edges, faces.
///
/// Any number of points, repeated, on one plane, line or spot. No vertex is dropped, however thin the
/// body.
///
/// Parameters
/// ----------
/// points : (n, 3) numbers
///     Points [m].
#[pyclass(name = "ConvexPolyhedron", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyConvexPolyhedron(ConvexPolyhedron);

/// Points as the rows of an array.
pub(super) fn rows_of<'py, const N: usize>(py: Python<'py>, points: &[[f64; N]]) -> PyResult<Array<'py>> {
    array(py, &[points.len(), N], points.as_flattened().to_vec())
}

pub(super) fn points_of<const N: usize>(given: &ArrayLike<'_>) -> PyResult<Vec<[f64; N]>> {
    let (leading, points) = items::<N>(given, &[N])?;
    if leading.len() == 1 {
        return Ok(points);
    }
    Err(PyTypeError::new_err(format!("points of shape (n, {N}) wanted, got {} axes", leading.len() + 1)))
}

#[pymethods]
impl PyConvexPolyhedron {
    #[new]
    #[pyo3(signature = (points))]
    fn new(points: ArrayLike<'_>) -> Result<Self> {
        Ok(Self(ConvexPolyhedron::from_points(&points_of(&points)?)?))
    }

    /// The vertices [m]: array (n, 3).
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        rows_of(py, self.0.vertices())
    }

    /// For each vertex the number of the point that it was given as.
    #[getter]
    fn sources(&self) -> Vec<u32> {
        self.0.sources().to_vec()
    }

    /// The two vertices of each edge.
    #[getter]
    fn edges(&self) -> Vec<(usize, usize)> {
        (0..self.0.edges().len()).map(|e| self.0.edge_vertices(e).into()).collect()
    }

    /// The vertices of each face, counterclockwise seen from outside; a polygon has two faces back to
    /// back.
    #[getter]
    fn faces(&self) -> Vec<Vec<usize>> {
        (0..self.0.faces().len()).map(|f| self.0.face_vertices(f).collect()).collect()
    }

    /// The outward unit normals of the faces: array (n, 3) [-].
    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        rows_of(py, &self.0.faces().iter().map(|f| f.normal).collect::<Vec<_>>())
    }

    /// Dimension: 3 a solid, 2 a polygon, 1 a segment, 0 a point.
    #[getter]
    fn rank(&self) -> usize {
        self.0.rank()
    }

    /// A vertex that lies farthest in a direction.
    #[pyo3(signature = (direction))]
    fn support(&self, direction: Numbers<3>) -> usize {
        self.0.support(direction.0)
    }

    fn __repr__(&self) -> String {
        format!("ConvexPolyhedron({:?})", self.0.vertices())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Array<'py>,))> {
        Ok((py.get_type::<Self>().into_any(), (self.vertices(py)?,)))
    }
}

/// A shape prepared for queries: build it once, ask often.
///
/// Refused are a solid that is not convex (give a compound of convex pieces) and a mesh, which is in
/// its file.
///
/// Parameters
/// ----------
/// shape : a shape or ConvexPolyhedron
///     The shape; poses in queries are those of its own axes.
#[pyclass(name = "Collider", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyCollider(Collider);

#[pymethods]
impl PyCollider {
    #[new]
    #[pyo3(signature = (shape))]
    fn new(shape: AnyBody) -> Self {
        Self(shape.0)
    }

    /// How many convex pieces it has: 1, unless it is a compound.
    #[getter]
    fn part_count(&self) -> usize {
        self.0.part_count()
    }

    /// The polyhedron of a piece, in the piece's axes, which the numbers of its features count in; None
    /// where the piece is none.
    #[pyo3(signature = (part=0))]
    fn polyhedron(&self, part: usize) -> Option<PyConvexPolyhedron> {
        self.0.polyhedron(part).cloned().map(PyConvexPolyhedron)
    }
}

/// Anything that collides, prepared.
pub(crate) struct AnyBody(pub(crate) Collider);

impl<'py> FromPyObject<'_, 'py> for AnyBody {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(collider) = obj.cast::<PyCollider>() {
            return Ok(Self(collider.get().0.clone()));
        }
        if let Ok(body) = obj.cast::<PyConvexPolyhedron>() {
            return Ok(Self(body.get().0.clone().into()));
        }
        let AnyShape(shape) = obj.extract::<AnyShape>()?;
        Ok(Self(Collider::new(&shape).map_err(crate::error::Failure::from)?))
    }
}

/// Hands over a body without copying one that is prepared.
pub(crate) fn with_body<T>(given: &Bound<'_, PyAny>, ask: impl FnOnce(&Collider) -> Result<T>) -> Result<T> {
    match given.cast::<PyCollider>() {
        Ok(collider) => ask(&collider.get().0),
        Err(_) => ask(&given.extract::<AnyBody>()?.0),
    }
}
