//! Closest features: bodies prepared for queries, one query, many at once, and the plane.

use pyo3::prelude::*;

pub(crate) mod body;
pub(crate) mod many;
mod planar;
pub(crate) mod query;

/// Adds the classes and functions.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<body::PyConvexPolyhedron>()?;
    module.add_class::<body::PyCollider>()?;
    module.add_class::<query::PyPairCache>()?;
    module.add_class::<query::PyClosestFeatures>()?;
    module.add_class::<planar::PyConvexPolygon>()?;
    module.add_class::<planar::PyVoronoiRegion>()?;
    module.add_class::<planar::PyPlanarClosest>()?;
    module.add_function(wrap_pyfunction!(query::closest_features, module)?)?;
    module.add_function(wrap_pyfunction!(many::closest_features_many, module)?)?;
    module.add_function(wrap_pyfunction!(planar::closest_features_planar, module)?)?;
    module.add_function(wrap_pyfunction!(planar::voronoi_regions, module)?)
}
