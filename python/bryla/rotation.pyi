"""Rotations as matrices. Arguments may have leading axes, which the result keeps."""

import numpy as np
import numpy.typing as npt

__all__ = ["cross_matrix", "elementary_x", "elementary_y", "elementary_z", "orthogonality_error", "polar_factor"]

def elementary_x(angle: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Rotation by an angle [rad] about the x axis: array (..., 3, 3)."""

def elementary_y(angle: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Rotation by an angle [rad] about the y axis: array (..., 3, 3)."""

def elementary_z(angle: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Rotation by an angle [rad] about the z axis: array (..., 3, 3)."""

def cross_matrix(w: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The matrix Ω of a vector (..., 3), for which Ω(w) r = w × r: array (..., 3, 3)."""

def polar_factor(r: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The rotation nearest to a matrix (..., 3, 3), its orthogonal polar factor: array (..., 3, 3).

    Where the determinant is not positive there is none, and the answer is not finite.
    """

def orthogonality_error(r: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Distance of a matrix (..., 3, 3) from an orthogonal one, ‖RᵀR − 1‖ [-]: array (...)."""
