//! Closest features: bodies prepared for queries, one query, many at once, and the plane.

use bryla::closest::planar::{PlanarClosest, PlanarPose, closest_features_planar as planar_query};
use bryla::closest::{Accuracy, ClosestFeatures, Collider, Feature, PairCache, Rung, State, closest_features as query};
use bryla::math::{Pose, quaternion};
use bryla::shape::convex_polygon::{ConvexPolygon, PlanarFeature};
use bryla::shape::convex_polyhedron::ConvexPolyhedron;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::convert::{self, Array, ArrayLike, Numbers, array, items};
use crate::error::Result;
use crate::math::PyPose;
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
fn rows_of<'py, const N: usize>(py: Python<'py>, points: &[[f64; N]]) -> PyResult<Array<'py>> {
    array(py, &[points.len(), N], points.as_flattened().to_vec())
}

fn points_of<const N: usize>(given: &ArrayLike<'_>) -> PyResult<Vec<[f64; N]>> {
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
pub(crate) struct AnyBody(Collider);

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
pub(crate) struct Stop(Accuracy);

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
fn state_name(state: State) -> &'static str {
    match state {
        State::Separated => "separated",
        State::Touching => "touching",
        State::Overlapping => "overlapping",
    }
}

/// The closest features of two bodies A and B, in world axes.
#[pyclass(name = "ClosestFeatures", module = "bryla", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PyClosestFeatures(ClosestFeatures);

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

    /// How far the query had to climb: "verified" (the cached vertices still were the answer), "walked"
    /// (from the cached features), "searched" or "double_double".
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

/// Hands over a body without copying one that is prepared.
fn with_body<T>(given: &Bound<'_, PyAny>, ask: impl FnOnce(&Collider) -> Result<T>) -> Result<T> {
    match given.cast::<PyCollider>() {
        Ok(collider) => ask(&collider.get().0),
        Err(_) => ask(&given.extract::<AnyBody>()?.0),
    }
}

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
/// Each query starts from the one before it, so order the poses along the motion.
///
/// Parameters
/// ----------
/// a, b : a shape, ConvexPolyhedron or Collider
///     The bodies.
/// poses_a, poses_b : Pose, or a pair of arrays
///     One pose, or positions (..., 3) [m] and orientations (..., 4), which mean q/|q|.
/// accuracy : "exact", "yes_no" or float
///     As for closest_features.
///
/// Returns
/// -------
/// dict of arrays
///     "signed_distance", "lower", "upper": (...) [m]; "point_a", "point_b", "normal": (..., 3), world
///     axes; "state": (...), 1 separated, 0 touching, −1 overlapping; "certified": (...), 1 or 0.
#[pyfunction]
#[pyo3(
    signature = (a, poses_a, b, poses_b, accuracy=Stop(Accuracy::Exact)),
    text_signature = "(a, poses_a, b, poses_b, accuracy=\"exact\")"
)]
pub(crate) fn closest_features_many(
    py: Python<'_>,
    a: AnyBody,
    poses_a: Poses,
    b: AnyBody,
    poses_b: Poses,
    accuracy: Stop,
) -> Result<Bound<'_, PyDict>> {
    let leading = match (&poses_a.1, &poses_b.1) {
        (Some(x), Some(y)) if x != y => {
            let message = format!("as many poses of A as of B wanted, got {x:?} and {y:?}");
            return Err(pyo3::exceptions::PyValueError::new_err(message).into());
        }
        (Some(x), _) | (None, Some(x)) => x.clone(),
        (None, None) => Vec::new(),
    };
    let count: usize = leading.iter().product();
    let found = py.detach(|| -> bryla::Result<Vec<ClosestFeatures>> {
        let mut cache = PairCache::new();
        let pairs = poses_a.0.iter().cycle().zip(poses_b.0.iter().cycle()).take(count);
        pairs.map(|(x, y)| query(&a.0, x, &b.0, y, Some(&mut cache), accuracy.0)).collect()
    })?;

    let answer = PyDict::new(py);
    let scalars: [(&str, Get<f64>); 3] =
        [("signed_distance", |f| f.signed_distance), ("lower", |f| f.lower), ("upper", |f| f.upper)];
    for (name, get) in scalars {
        answer.set_item(name, array(py, &leading, found.iter().map(get).collect())?)?;
    }
    let vectors: [(&str, Get<[f64; 3]>); 3] =
        [("point_a", |f| f.point_a.into()), ("point_b", |f| f.point_b.into()), ("normal", |f| f.normal.into())];
    let mut shape = leading.clone();
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
        answer.set_item(name, numbers.reshape(numpy::IxDyn(&leading))?)?;
    }
    Ok(answer)
}

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

/// Adds the classes and functions.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyConvexPolyhedron>()?;
    module.add_class::<PyCollider>()?;
    module.add_class::<PyPairCache>()?;
    module.add_class::<PyClosestFeatures>()?;
    module.add_class::<PyConvexPolygon>()?;
    module.add_class::<PyVoronoiRegion>()?;
    module.add_class::<PyPlanarClosest>()?;
    module.add_function(wrap_pyfunction!(closest_features, module)?)?;
    module.add_function(wrap_pyfunction!(closest_features_many, module)?)?;
    module.add_function(wrap_pyfunction!(closest_features_planar, module)?)?;
    module.add_function(wrap_pyfunction!(voronoi_regions, module)?)
}
