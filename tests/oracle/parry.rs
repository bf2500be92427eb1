//! parry3d-f64 0.31 in bryla's terms: its vectors are glam's. The only file that names them.

use bryla::math::{Matrix3, Vector3};
use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector;

/// A vector for parry.
pub(crate) fn vector(v: impl Into<[f64; 3]>) -> Vector {
    Vector::from_array(v.into())
}

/// A vector from parry.
pub(crate) fn from_vector(v: Vector) -> Vector3 {
    Vector3::from(v.to_array())
}

/// Mass [kg], centre of mass [m], and inertia about it [kg m²] from parry.
pub(crate) fn mass_properties(p: &MassProperties) -> (f64, Vector3, Matrix3) {
    let inertia = p.reconstruct_inertia_matrix().to_cols_array_2d();
    (p.mass(), from_vector(p.local_com), Matrix3::from(inertia))
}
