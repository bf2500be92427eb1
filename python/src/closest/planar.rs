//! The plane: polygons, their Voronoi regions, the lecture's walk.

use bryla::closest::planar::{PlanarClosest, PlanarPose, closest_features_planar as planar_query};
use bryla::shape::convex_polygon::{ConvexPolygon, PlanarFeature};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::body::{points_of, rows_of};
use super::query::state_name;
use crate::convert::{self, Array, ArrayLike, Numbers, array};
use crate::error::Result;

/// The convex hull of points in the plane.
///
/// Parameters
/// ----------
/// points : (n, 2) numbers
///     Points [m]; repeated or on one line.
#[pyclass(name = "ConvexPolygon", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyConvexPolygon(ConvexPolygon);

#[pymethods]
impl PyConvexPolygon {
    #[new]
    #[pyo3(signature = (points))]
    fn new(points: ArrayLike<'_>) -> Result<Self> {
        Ok(Self(ConvexPolygon::from_points(&points_of(&points)?)?))
    }

    /// The vertices, counterclockwise [m]: array (n, 2). Edge k leaves vertex k.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        rows_of(py, self.0.vertices())
    }

    /// Draws the polygon with its Voronoi regions, the lecture's figure 10, and returns the figure;
    /// needs matplotlib.
    ///
    /// Parameters
    /// ----------
    /// figure : matplotlib Figure, optional
    ///     Where to draw.
    #[pyo3(signature = (figure=None))]
    fn plot<'py>(slf: &Bound<'py, Self>, figure: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("bryla._plot")?.call_method1("voronoi_regions", (slf, figure))
    }

    fn __repr__(&self) -> String {
        format!("ConvexPolygon({:?})", self.0.vertices())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (Array<'py>,))> {
        Ok((py.get_type::<Self>().into_any(), (self.vertices(py)?,)))
    }
}

/// The outside points closer to a feature of a polygon than to any other: V(F) of the lecture.
#[pyclass(name = "VoronoiRegion", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyVoronoiRegion(bryla::shape::convex_polygon::VoronoiRegion);

#[pymethods]
impl PyVoronoiRegion {
    /// Whose region it is: "vertex" or "edge", and its number.
    #[getter]
    fn feature(&self) -> (&'static str, usize) {
        planar_named(self.0.feature)
    }

    /// Where its border starts: the vertex, or both ends of the edge [m]: array (1 or 2, 2).
    #[getter]
    fn base<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        rows_of(py, &self.0.base)
    }

    /// Unit directions in which its border leaves the first and the last base point: array (2, 2), of a
    /// lone point, whose region is the plane, array (0, 2).
    #[getter]
    fn rays<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        rows_of(py, &self.0.rays)
    }

    /// Whether points (..., 2) [m] are in the region, its border included: array (...) of 1 and 0. On a
    /// border both neighbours say yes.
    #[pyo3(signature = (points))]
    fn contains<'py>(&self, py: Python<'py>, points: ArrayLike<'py>) -> PyResult<Array<'py>> {
        convert::map(py, &points, [&[2], &[]], |p: [f64; 2]| [f64::from(u8::from(self.0.contains(p)))])
    }

    fn __repr__(&self) -> String {
        let (kind, k) = self.feature();
        format!("<VoronoiRegion of {kind} {k}>")
    }
}

fn planar_named(feature: PlanarFeature) -> (&'static str, usize) {
    match feature {
        PlanarFeature::Vertex(k) => ("vertex", k),
        PlanarFeature::Edge(k) => ("edge", k),
    }
}

/// The Voronoi regions of a polygon's vertices and edges, counterclockwise from the first vertex.
///
/// Parameters
/// ----------
/// polygon : ConvexPolygon
///     The polygon.
///
/// Returns
/// -------
/// list of VoronoiRegion
#[pyfunction]
#[pyo3(signature = (polygon))]
pub(crate) fn voronoi_regions(polygon: PyRef<'_, PyConvexPolygon>) -> Vec<PyVoronoiRegion> {
    polygon.0.voronoi_regions().into_iter().map(PyVoronoiRegion).collect()
}

/// The closest features of two polygons, with the walk that found them.
#[pyclass(name = "PlanarClosest", module = "bryla", frozen)]
#[derive(Debug, Clone)]
pub(crate) struct PyPlanarClosest {
    found: PlanarClosest,
    bodies: [(ConvexPolygon, PlanarPose); 2],
}

/// A point of the plane as an array: (2,).
fn point2(py: Python<'_>, p: [f64; 2]) -> PyResult<Array<'_>> {
    array(py, &[2], p.to_vec())
}

#[pymethods]
impl PyPlanarClosest {
    /// Distance where positive, minus the depth where negative [m].
    #[getter]
    fn signed_distance(&self) -> f64 {
        self.found.signed_distance
    }

    /// The true signed distance is not below this [m].
    #[getter]
    fn lower(&self) -> f64 {
        self.found.lower
    }

    /// The true signed distance is not above this [m].
    #[getter]
    fn upper(&self) -> f64 {
        self.found.upper
    }

    /// "separated", "touching" or "overlapping".
    #[getter]
    fn state(&self) -> &'static str {
        state_name(self.found.state)
    }

    /// The closest or deepest point of A [m]: array (2,).
    #[getter]
    fn point_a<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        point2(py, self.found.point_a)
    }

    /// The closest or deepest point of B [m]: array (2,).
    #[getter]
    fn point_b<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        point2(py, self.found.point_b)
    }

    /// Unit normal from A to B: array (2,).
    #[getter]
    fn normal<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        point2(py, self.found.normal)
    }

    /// The feature of A that carries point_a: "vertex" or "edge", and its number.
    #[getter]
    fn feature_a(&self) -> (&'static str, usize) {
        planar_named(self.found.feature_a)
    }

    /// The feature of B that carries point_b.
    #[getter]
    fn feature_b(&self) -> (&'static str, usize) {
        planar_named(self.found.feature_b)
    }

    /// The pairs of features that the walk visited, each with its closest points: tuples (feature_a,
    /// feature_b, (x, y) of a, (x, y) of b).
    #[getter]
    fn path<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyTuple>>> {
        let step = |s: &bryla::closest::planar::WalkStep| {
            let points = (Numbers(s.point_a), Numbers(s.point_b));
            (planar_named(s.feature_a), planar_named(s.feature_b), points.0, points.1).into_pyobject(py)
        };
        self.found.path.iter().map(step).collect()
    }

    /// Whether the interval is as narrow as rounding allows.
    #[getter]
    fn certified(&self) -> bool {
        self.found.certified
    }

    /// The corners of A and of B in the world [m]: two arrays (n, 2).
    #[getter]
    fn outlines<'py>(&self, py: Python<'py>) -> PyResult<Vec<Array<'py>>> {
        let placed = |(shape, pose): &(ConvexPolygon, PlanarPose)| {
            let (s, c) = sine_and_cosine(pose.angle);
            let [x, y] = pose.position;
            let place = |v: &[f64; 2]| [x + c * v[0] - s * v[1], y + s * v[0] + c * v[1]];
            rows_of(py, &shape.vertices().iter().map(place).collect::<Vec<_>>())
        };
        self.bodies.iter().map(placed).collect()
    }

    /// Draws both polygons, the Voronoi regions of A, and the walk; returns the figure. Needs
    /// matplotlib.
    ///
    /// Parameters
    /// ----------
    /// figure : matplotlib Figure, optional
    ///     Where to draw.
    #[pyo3(signature = (figure=None))]
    fn plot<'py>(slf: &Bound<'py, Self>, figure: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("bryla._plot")?.call_method1("walk", (slf, figure))
    }

    fn __repr__(&self) -> String {
        let ((kind_a, a), (kind_b, b)) = (self.feature_a(), self.feature_b());
        let (state, d, n) = (self.state(), self.found.signed_distance, self.found.path.len());
        format!("<PlanarClosest {state}, signed distance {d:?} m, {kind_a} {a} to {kind_b} {b}, {n} steps>")
    }
}

/// Sine and cosine as the core has them.
fn sine_and_cosine(angle: f64) -> (f64, f64) {
    let turned = bryla::math::rotation::elementary_z(angle);
    (turned[(1, 0)], turned[(0, 0)])
}

/// Closest features of two convex polygons by the lecture's walk over Voronoi regions.
///
/// Parameters
/// ----------
/// a, b : ConvexPolygon
///     The polygons.
/// pose_a, pose_b : 3 numbers
///     Position x, y [m] of each polygon's origin, and its angle [rad], counterclockwise.
/// start : pair of features, optional
///     Where the walk begins, such as (("vertex", 0), ("edge", 2)); without it at the first vertices.
///
/// Returns
/// -------
/// PlanarClosest
#[pyfunction]
#[pyo3(signature = (a, pose_a, b, pose_b, start=None))]
pub(crate) fn closest_features_planar(
    a: PyRef<'_, PyConvexPolygon>,
    pose_a: Numbers<3>,
    b: PyRef<'_, PyConvexPolygon>,
    pose_b: Numbers<3>,
    start: Option<((String, usize), (String, usize))>,
) -> Result<PyPlanarClosest> {
    let pose = |Numbers([x, y, angle]): Numbers<3>| PlanarPose { position: [x, y], angle };
    let (pose_a, pose_b) = (pose(pose_a), pose(pose_b));
    let feature = |(kind, k): (String, usize)| match kind.as_str() {
        "vertex" => Ok(PlanarFeature::Vertex(k)),
        "edge" => Ok(PlanarFeature::Edge(k)),
        other => Err(bryla::Error::value("closest features", "start", "(\"vertex\" or \"edge\", number)", other)),
    };
    let start = start.map(|(f, g)| Ok::<_, bryla::Error>((feature(f)?, feature(g)?))).transpose()?;
    let found = planar_query(&a.0, &pose_a, &b.0, &pose_b, start)?;
    Ok(PyPlanarClosest { found, bodies: [(a.0.clone(), pose_a), (b.0.clone(), pose_b)] })
}
