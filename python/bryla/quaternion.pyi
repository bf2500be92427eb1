"""Quaternions (w, x, y, z). Arguments may have leading axes; of two arguments one may be single."""

import numpy as np
import numpy.typing as npt

__all__ = [
    "angle_between",
    "conjugate",
    "exp",
    "from_axis_angle",
    "from_matrix",
    "log",
    "product",
    "rotate",
    "to_matrix",
]

def from_axis_angle(axis: npt.ArrayLike, angle: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Rotation by an angle [rad] about a unit vector (..., 3), [cos(θ/2), sin(θ/2) u]: array (..., 4)."""

def exp(phi: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The rotation by the angle |phi| [rad] about the direction of phi (..., 3): array (..., 4)."""

def log(q: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The rotation vector [rad], |φ| ≤ π, of a unit quaternion (..., 4): array (..., 3)."""

def to_matrix(q: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The matrix of the rotation q/|q|, q being (..., 4): array (..., 3, 3)."""

def from_matrix(r: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The unit quaternion of a rotation matrix (..., 3, 3): array (..., 4)."""

def product(a: npt.ArrayLike, b: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The product a b: first the rotation b, then a: array (..., 4)."""

def conjugate(q: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The conjugate (w, −x, −y, −z), for a unit quaternion the rotation back: array (..., 4)."""

def rotate(q: npt.ArrayLike, v: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The vector v (..., 3) rotated by the unit quaternion q (..., 4), q v q*: array (..., 3)."""

def angle_between(a: npt.ArrayLike, b: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The angle [rad] of the rotation from a to b, 0 to π; q and −q are one rotation: array (...)."""
