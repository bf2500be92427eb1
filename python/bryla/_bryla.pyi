from collections.abc import Callable, Iterable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Final, Literal, SupportsFloat, SupportsIndex, TypeAlias, final

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure

from bryla import quaternion as quaternion
from bryla import rotation as rotation

_Array: TypeAlias = npt.NDArray[np.float64]
_Number: TypeAlias = SupportsFloat | SupportsIndex
_Numbers: TypeAlias = Iterable[_Number] | npt.NDArray[Any]
_Rows: TypeAlias = Iterable[_Numbers] | npt.NDArray[Any]
_Vector: TypeAlias = tuple[float, float, float]
_Quaternion: TypeAlias = tuple[float, float, float, float]
_Path: TypeAlias = str | PathLike[str]
_Shape: TypeAlias = Cuboid | Sphere | Cylinder | Capsule | Cone | Ellipsoid | HalfSpace | Polyhedron | Mesh | Compound
_Effect: TypeAlias = UniformGravity | PointGravity | Drag | Thruster | Wrench | Spring | UserEffect
_Freedom: TypeAlias = Literal["free"] | Planar | Pivot | Axle
_Method: TypeAlias = Literal[
    "auto",
    "euler",
    "heun",
    "semi_implicit_euler",
    "rk4",
    "tsit5",
    "dop853",
    "split2",
    "split4",
    "split6",
    "split8",
    "axes2",
    "cf4",
    "buss2",
    "radau5",
    "taylor",
    "dmv",
    "exact",
]
_Response: TypeAlias = Literal["bounce", "stick"]
_Frame: TypeAlias = Literal["world", "body"]
_Record: TypeAlias = Literal["dense", "samples", "end"]
_Orientation: TypeAlias = Literal["quaternion", "matrix"]
_Finder: TypeAlias = Literal["bisection", "secant", "guaranteed"]
_RestitutionLaw: TypeAlias = Literal["newton", "poisson", "stronge"]
_Format: TypeAlias = Literal["toml", "json"]
_Collidable: TypeAlias = _Shape | ConvexPolyhedron | Collider
_Accuracy: TypeAlias = Literal["exact", "yes_no"] | float
_State: TypeAlias = Literal["separated", "touching", "overlapping"]
_Feature: TypeAlias = tuple[str, int]
_Poses: TypeAlias = Pose | tuple[npt.ArrayLike, npt.ArrayLike]
_Motions: TypeAlias = (
    Motion
    | tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike, npt.ArrayLike]
    | tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike, npt.ArrayLike, npt.ArrayLike]
)
_Outcome: TypeAlias = Literal["clear", "at", "already_touching", "overlap", "grazing", "stalled"]
_Point2: TypeAlias = tuple[float, float]
_Bodies: TypeAlias = tuple[BodyMotion, ...]
_Pair: TypeAlias = tuple[_Numbers, _Numbers] | Sequence[_Numbers] | npt.NDArray[Any]
_Loads: TypeAlias = Callable[[float, _Bodies], _Pair] | Callable[[float, _Bodies], Iterable[_Pair]]
_Energy: TypeAlias = Callable[[float, _Bodies], float]
_Measure: TypeAlias = Callable[[float, _Bodies], _Number] | str | dict[str, Any]
_Direction: TypeAlias = Literal["rising", "falling", "both"]
__version__: Final[str]
METHODS: Final[tuple[str, ...]]

@final
class Pose:
    """Position and orientation of a frame: its point p stands at R p + position in the world.

    Parameters
    ----------
    position : 3 numbers
        Where the frame's origin stands, world axes [m].
    orientation : 4 numbers
        Rotation from the frame's axes to the world's, (w, x, y, z); it is divided by its length.
    """

    def __new__(cls, position: _Numbers = (0.0, 0.0, 0.0), orientation: _Numbers = (1.0, 0.0, 0.0, 0.0)) -> Pose: ...
    @property
    def position(self) -> _Array:
        """Where the frame's origin stands, world axes [m]: array (3,)."""

    @property
    def orientation(self) -> _Array:
        """Rotation from the frame's axes to the world's, (w, x, y, z): array (4,)."""

    @property
    def rotation(self) -> _Array:
        """The same rotation as a matrix: array (3, 3)."""

    def point(self, body: npt.ArrayLike) -> _Array:
        """World coordinates of points given in the frame [m]: array (..., 3)."""

    def vector(self, body: npt.ArrayLike) -> _Array:
        """World components of vectors given in the frame: array (..., 3)."""

    def inverse_point(self, world: npt.ArrayLike) -> _Array:
        """Frame coordinates of points given in the world [m]: array (..., 3)."""

    def inverse_vector(self, world: npt.ArrayLike) -> _Array:
        """Frame components of vectors given in world axes: array (..., 3)."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class MassProperties:
    """Mass, centre of mass and inertia of a body, in the shape's own axes.

    Refused is what no body can have: a mass that is not positive, an inertia that is not symmetric,
    not positive definite, or whose largest principal moment exceeds the sum of the two others.

    Parameters
    ----------
    mass : float
        Mass [kg].
    center_of_mass : 3 numbers
        Centre of mass, shape axes [m].
    inertia : 3 rows of 3 numbers
        Inertia about the centre of mass, shape axes [kg m²]; off-diagonal entries with their minus,
        I₁₂ = −∫ x₁ x₂ dm.
    """

    def __new__(cls, mass: _Number, center_of_mass: _Numbers, inertia: _Rows) -> MassProperties: ...
    @staticmethod
    def combined(parts: Sequence[MassProperties]) -> MassProperties:
        """Several parts, given in common axes, as one rigid body."""

    @property
    def mass(self) -> float:
        """Mass [kg]."""

    @property
    def center_of_mass(self) -> _Array:
        """Centre of mass, shape axes [m]: array (3,)."""

    @property
    def inertia(self) -> _Array:
        """Inertia about the centre of mass, shape axes [kg m²]: array (3, 3)."""

    @property
    def principal_moments(self) -> _Array:
        """Principal moments of inertia, ascending [kg m²]: array (3,)."""

    @property
    def principal_axes(self) -> _Array:
        """Principal axes as columns, a rotation from principal to shape axes: array (3, 3)."""

    def about(self, point: _Numbers) -> _Array:
        """Inertia about another point [m] of the shape axes [kg m²]: array (3, 3)."""

    def moved(self, translation: _Numbers) -> MassProperties:
        """The same matter moved by a translation [m]."""

    def turned(self, orientation: _Numbers) -> MassProperties:
        """The same matter turned about the origin by a rotation (w, x, y, z)."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Cuboid:
    """A box with its centre in the origin and its edges along x, y and z.

    Parameters
    ----------
    half_extents : 3 numbers
        Half of each edge's length [m].
    """

    def __new__(cls, half_extents: _Numbers) -> Cuboid: ...
    @property
    def half_extents(self) -> _Vector:
        """Half of each edge's length [m]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Sphere:
    """A ball with its centre in the origin.

    Parameters
    ----------
    radius : float
        Radius [m].
    """

    def __new__(cls, radius: _Number) -> Sphere: ...
    @property
    def radius(self) -> float:
        """Radius [m]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Cylinder:
    """A circular cylinder with its centre in the origin and its axis along z.

    Parameters
    ----------
    radius : float
        Radius [m].
    half_height : float
        Half of its height [m].
    """

    def __new__(cls, radius: _Number, half_height: _Number) -> Cylinder: ...
    @property
    def radius(self) -> float:
        """Radius [m]."""

    @property
    def half_height(self) -> float:
        """Half of its height [m]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Capsule:
    """A cylinder along z with a half sphere on each end, its centre in the origin.

    Parameters
    ----------
    radius : float
        Radius of the cylinder and of the half spheres [m].
    half_height : float
        Half of the cylinder's height, without the half spheres [m]; 0 makes a ball.
    """

    def __new__(cls, radius: _Number, half_height: _Number) -> Capsule: ...
    @property
    def radius(self) -> float:
        """Radius of the cylinder and of the half spheres [m]."""

    @property
    def half_height(self) -> float:
        """Half of the cylinder's height, without the half spheres [m]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Cone:
    """A circular cone along z: its apex at z = half_height, its base at z = −half_height.

    The origin is half way up; the centre of mass lies lower, at z = −half_height/2.

    Parameters
    ----------
    radius : float
        Radius of the base [m].
    half_height : float
        Half of its height [m].
    """

    def __new__(cls, radius: _Number, half_height: _Number) -> Cone: ...
    @property
    def radius(self) -> float:
        """Radius of the base [m]."""

    @property
    def half_height(self) -> float:
        """Half of its height [m]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Ellipsoid:
    """The ellipsoid (x/a)² + (y/b)² + (z/c)² ≤ 1.

    Parameters
    ----------
    semi_axes : 3 numbers
        Its semi-axes a, b, c along x, y and z [m].
    """

    def __new__(cls, semi_axes: _Numbers) -> Ellipsoid: ...
    @property
    def semi_axes(self) -> _Vector:
        """Its semi-axes along x, y and z [m]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class HalfSpace:
    """All points with normal · x ≤ offset: a floor, a wall, a slope.

    The normal points out of the solid. It need not have unit length; the condition stands as
    written. A half space has no mass, so its body must be fixed.

    Parameters
    ----------
    normal : 3 numbers
        Normal of the surface, out of the solid [-]; not zero.
    offset : float
        Value of normal · x on the surface [m, for a normal of unit length].
    """

    def __new__(cls, normal: _Numbers, offset: _Number) -> HalfSpace: ...
    @property
    def normal(self) -> _Vector:
        """Normal of the surface, out of the solid [-]."""

    @property
    def offset(self) -> float:
        """Value of normal · x on the surface [m, for a normal of unit length]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Polyhedron:
    """A solid enclosed by flat faces; convex or not, of one part or several, cavities included.

    Parameters
    ----------
    vertices : (n, 3) numbers
        Vertices [m]; unused ones are allowed.
    faces : lists of vertex numbers
        Faces, each as three or more numbers of vertices (from 0), counterclockwise seen from
        outside.
    """

    def __new__(cls, vertices: _Rows, faces: Iterable[Iterable[SupportsIndex]] | npt.NDArray[Any]) -> Polyhedron: ...
    @property
    def vertices(self) -> list[_Vector]:
        """Vertices [m]."""

    @property
    def faces(self) -> list[list[int]]:
        """Faces, each as numbers of vertices (from 0), counterclockwise seen from outside."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Mesh:
    """A closed surface in an STL or OBJ file, in the file's own axes.

    The file is read where it is needed: by mass_properties, and by a scene's add, compile and run.

    Parameters
    ----------
    path : str or os.PathLike
        The file, ending in .stl or .obj.
    scale : float
        Metres per unit of the file [m]: 0.001 for millimetres.
    """

    def __new__(cls, path: _Path, scale: _Number = 1.0) -> Mesh: ...
    @property
    def path(self) -> PathLike[str]:
        """The file."""

    @property
    def scale(self) -> float:
        """Metres per unit of the file [m]."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Compound:
    """Several shapes, each placed in the compound's axes, joined into one rigid shape.

    Where pieces overlap, their matter counts twice.

    Parameters
    ----------
    pieces : list of Piece or shape
        The pieces; at least one. A bare shape stands in the compound's axes.
    """

    def __new__(cls, pieces: Iterable[Piece | _Shape]) -> Compound: ...
    @property
    def pieces(self) -> list[Piece]:
        """The pieces."""

    def mass_properties(self, density: _Number) -> MassProperties:
        """Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes."""

    def bounding_radius(self, about: _Numbers = (0.0, 0.0, 0.0)) -> float:
        """Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
        infinite for a half space, and for a mesh, which is in its file.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Piece:
    """One shape of a Compound and where it stands.

    Parameters
    ----------
    shape : a shape
        The shape, in its own axes.
    position : 3 numbers
        Where the origin of the shape's axes stands in the compound's [m].
    orientation : 4 numbers
        Rotation (w, x, y, z) from the shape's axes to the compound's; a unit quaternion.
    """

    def __new__(
        cls, shape: _Shape, position: _Numbers = (0.0, 0.0, 0.0), orientation: _Numbers = (1.0, 0.0, 0.0, 0.0)
    ) -> Piece: ...
    @property
    def shape(self) -> _Shape:
        """The shape, in its own axes."""

    @property
    def position(self) -> _Vector:
        """Where the origin of the shape's axes stands in the compound's [m]."""

    @property
    def orientation(self) -> _Quaternion:
        """Rotation (w, x, y, z) from the shape's axes to the compound's."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class UniformGravity:
    """Uniform gravity: the same acceleration everywhere.

        F = m g        M = 0        U = −m g·x

    Parameters
    ----------
    acceleration : 3 numbers
        Acceleration g, world axes [m/s²].
    bodies : list of str, optional
        The bodies it acts on; all if absent.
    """

    def __new__(cls, acceleration: _Numbers, bodies: Iterable[str] | None = None) -> UniformGravity: ...
    @property
    def acceleration(self) -> _Vector:
        """Acceleration, world axes [m/s²]."""

    @property
    def bodies(self) -> list[str] | None:
        """The bodies it acts on; None for all."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class PointGravity:
    """Attraction by a point, with the torque of its gradient on an extended body.

        r = x − center,  ρ = |r|,  J = R I Rᵀ
        U = −μ m/ρ − ½ μ (tr J/ρ³ − 3 r·J r/ρ⁵)        MacCullagh's formula
        M = 3 μ (r × J r)/ρ⁵

    Parameters
    ----------
    mu : float
        Gravitational parameter μ = G M [m³/s²].
    center : 3 numbers
        The attracting point, world axes [m].
    gradient_torque : bool
        Whether the second term, with the gradient's torque, is kept.
    bodies : list of str, optional
        The bodies it acts on; all if absent.
    """

    def __new__(
        cls,
        mu: _Number,
        center: _Numbers = (0.0, 0.0, 0.0),
        gradient_torque: bool = True,
        bodies: Iterable[str] | None = None,
    ) -> PointGravity: ...
    @property
    def mu(self) -> float:
        """Gravitational parameter μ = G M [m³/s²]."""

    @property
    def center(self) -> _Vector:
        """The attracting point, world axes [m]."""

    @property
    def gradient_torque(self) -> bool:
        """Whether the second term, with the gradient's torque, is kept."""

    @property
    def bodies(self) -> list[str] | None:
        """The bodies it acts on; None for all."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Drag:
    """Drag on translation and rotation, linear and quadratic.

        u = v − wind
        F = −(linear + quadratic |u|) u
        M = −(angular_linear + angular_quadratic |ω|) ω

    Parameters
    ----------
    linear : float
        Force per speed [N·s/m].
    quadratic : float
        Force per speed squared [N·s²/m²]; for air ½ ρ c_d A.
    angular_linear : float
        Torque per angular speed [N·m·s].
    angular_quadratic : float
        Torque per angular speed squared [N·m·s²].
    wind : 3 numbers
        Velocity of the medium, world axes [m/s].
    bodies : list of str, optional
        The bodies it acts on; all if absent.
    """

    def __new__(
        cls,
        linear: _Number = 0.0,
        quadratic: _Number = 0.0,
        angular_linear: _Number = 0.0,
        angular_quadratic: _Number = 0.0,
        wind: _Numbers = (0.0, 0.0, 0.0),
        bodies: Iterable[str] | None = None,
    ) -> Drag: ...
    @property
    def linear(self) -> float:
        """Force per speed [N·s/m]."""

    @property
    def quadratic(self) -> float:
        """Force per speed squared [N·s²/m²]."""

    @property
    def angular_linear(self) -> float:
        """Torque per angular speed [N·m·s]."""

    @property
    def angular_quadratic(self) -> float:
        """Torque per angular speed squared [N·m·s²]."""

    @property
    def wind(self) -> _Vector:
        """Velocity of the medium, world axes [m/s]."""

    @property
    def bodies(self) -> list[str] | None:
        """The bodies it acts on; None for all."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Thruster:
    """An engine: a force fixed in the body at a point fixed in the body.

        F = k R force_body        M = R (point_body × k force_body)        k the schedule's factor

    Parameters
    ----------
    body : str
        The body that carries the engine.
    point_body : 3 numbers
        Where the force acts, body axes from the centre of mass [m].
    force_body : 3 numbers
        The force at factor 1, body axes [N].
    schedule : list of (time, factor), optional
        Times [s] and the factor of the force from then on: 0 before the first time, held after the
        last, switched exactly at its times. Factor 1 always, if absent.
    switch : Switch, optional
        What turns it on and off by the state, whatever the factor; always on if absent.
    """

    def __new__(
        cls,
        body: str,
        point_body: _Numbers,
        force_body: _Numbers,
        schedule: _Rows | None = None,
        switch: Switch | None = None,
    ) -> Thruster: ...
    @property
    def body(self) -> str:
        """The body that carries the engine."""

    @property
    def point_body(self) -> _Vector:
        """Where the force acts, body axes from the centre of mass [m]."""

    @property
    def force_body(self) -> _Vector:
        """The force at factor 1, body axes [N]."""

    @property
    def schedule(self) -> list[tuple[float, float]] | None:
        """Pairs (time [s], factor), or None."""

    @property
    def switch(self) -> Switch | None:
        """What turns it on and off by the state, or None."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Wrench:
    """A force and a torque, constant, scheduled or oscillating.

        F = k s force        M = k s torque + (point − x) × F        s = sin(angular_frequency·t + phase), or 1

    Parameters
    ----------
    body : str
        The body it acts on.
    force : 3 numbers
        Force [N].
    torque : 3 numbers
        Torque about the centre of mass [N·m].
    frame : {"world", "body"}
        The axes of force, torque and point: the world's, or the body's from the centre of mass.
    point : 3 numbers, optional
        Where the force acts [m]; the centre of mass if absent.
    schedule : list of (time, factor), optional
        Times [s] and the factor k from then on; factor 1 always, if absent.
    angular_frequency : float, optional
        Angular frequency of the oscillation [rad/s]; none if absent.
    phase : float
        Phase of the oscillation at t = 0 [rad].
    """

    def __new__(
        cls,
        body: str,
        force: _Numbers = (0.0, 0.0, 0.0),
        torque: _Numbers = (0.0, 0.0, 0.0),
        frame: _Frame = "world",
        point: _Numbers | None = None,
        schedule: _Rows | None = None,
        angular_frequency: _Number | None = None,
        phase: _Number = 0.0,
    ) -> Wrench: ...
    @property
    def body(self) -> str:
        """The body it acts on."""

    @property
    def force(self) -> _Vector:
        """Force [N]."""

    @property
    def torque(self) -> _Vector:
        """Torque about the centre of mass [N·m]."""

    @property
    def frame(self) -> _Frame:
        """The axes of force, torque and point: "world" or "body"."""

    @property
    def point(self) -> _Vector | None:
        """Where the force acts [m]; None for the centre of mass."""

    @property
    def schedule(self) -> list[tuple[float, float]] | None:
        """Pairs (time [s], factor), or None."""

    @property
    def angular_frequency(self) -> float | None:
        """Angular frequency of the oscillation [rad/s], or None."""

    @property
    def phase(self) -> float:
        """Phase of the oscillation at t = 0 [rad]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Spring:
    """A damped spring between points of two bodies, or of a body and the world.

        d = p_b − p_a,  ℓ = |d|,  n = d/ℓ,  u = n·(v_b − v_a)
        F_a = (stiffness (ℓ − rest_length) + damping u) n        F_b = −F_a

    Parameters
    ----------
    a : str
        The first body.
    b : str, optional
        The second body; the world if absent.
    anchor_a : 3 numbers
        Where it holds on to a, body axes from the centre of mass [m].
    anchor_b : 3 numbers
        Where it holds on to b, its body axes from its centre of mass, or world axes [m].
    stiffness : float
        Force per length [N/m].
    damping : float
        Force per speed [N·s/m].
    rest_length : float
        Length without force [m].
    """

    def __new__(
        cls,
        a: str,
        b: str | None = None,
        anchor_a: _Numbers = (0.0, 0.0, 0.0),
        anchor_b: _Numbers = (0.0, 0.0, 0.0),
        *,
        stiffness: _Number,
        damping: _Number = 0.0,
        rest_length: _Number = 0.0,
    ) -> Spring: ...
    @property
    def a(self) -> str:
        """The first body."""

    @property
    def b(self) -> str | None:
        """The second body; None for the world."""

    @property
    def anchor_a(self) -> _Vector:
        """Where it holds on to a, body axes from the centre of mass [m]."""

    @property
    def anchor_b(self) -> _Vector:
        """Where it holds on to b, its body axes from its centre of mass, or world axes [m]."""

    @property
    def stiffness(self) -> float:
        """Force per length [N/m]."""

    @property
    def damping(self) -> float:
        """Force per speed [N·s/m]."""

    @property
    def rest_length(self) -> float:
        """Length without force [m]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class UserEffect:
    """A function of yours as an effect.

        (force, torque) = function(t, bodies)

    It acts on each body alone: bodies then holds the one, and a pair is returned. With couples it acts
    on these bodies together, and returns a list of one pair for each. World axes, the torque about
    the centre of mass. It is called several times a step, at any time within it, and must depend on
    nothing but its arguments. What it raises ends the run and becomes the cause of its SimulationError.

    It is code, so it can neither be written to a file nor pickled.

    Parameters
    ----------
    function : callable
        function(t, bodies) -> (force, torque) [N], [N·m], or a list of such pairs; bodies is a tuple
        of BodyMotion, t a time [s].
    couples : list of str, optional
        The bodies it acts on together, in this order.
    bodies : list of str, optional
        The bodies it acts on, each alone; all if neither is given.
    energy : callable, optional
        energy(t, bodies) -> potential energy [J]. With it the forces are taken to be conservative;
        without, what they do is booked as work.
    """

    def __new__(
        cls,
        function: _Loads,
        couples: Iterable[str] | None = None,
        bodies: Iterable[str] | None = None,
        energy: _Energy | None = None,
    ) -> UserEffect: ...
    @property
    def function(self) -> _Loads:
        """The function: function(t, bodies) -> (force, torque)."""

    @property
    def couples(self) -> list[str] | None:
        """The bodies it acts on together, or None."""

    @property
    def bodies(self) -> list[str] | None:
        """The bodies it acts on, each alone, or None."""

    @property
    def energy(self) -> _Energy | None:
        """The potential energy: energy(t, bodies) -> float, or None."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Switch:
    """Turns an engine on and off by a measure of its body, with hysteresis.

    With on < off it turns on once the measure has fallen to on, and off once it has risen to off; with
    on > off the other way round. Between the two it stays as it is. The step ends where the measure
    meets the value, so that methods keep their order. Every turn is an event of the run, of the kind
    "switch".

    Parameters
    ----------
    measure : callable, str or dict
        What decides, as in UserEvent; of one body.
    on : float
        The value at which it turns on.
    off : float
        The value at which it turns off; another one.
    starts_on : bool
        Whether it is on at the start, where the measure lies between the two.
    """

    def __new__(cls, measure: _Measure, on: _Number, off: _Number, starts_on: bool = False) -> Switch: ...
    @property
    def measure(self) -> _Measure:
        """What decides: a callable, a str or a dict."""

    @property
    def on(self) -> float:
        """The value at which it turns on, in the unit of the measure."""

    @property
    def off(self) -> float:
        """The value at which it turns off."""

    @property
    def starts_on(self) -> bool:
        """Whether it is on at the start, where the measure lies between the two."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Batch:
    """Free bodies that fly on their own, advanced together by the classical Runge–Kutta method.

    Nothing acts on them, so they do not know of each other; a body in a batch has the same bits as on its
    own. Arrays have one row for each body; one item is for all.

    Parameters
    ----------
    mass : float or array (bodies,)
        Masses [kg].
    inertia : array (3, 3) or (bodies, 3, 3)
        Inertia about the centre of mass, body axes [kg·m²].
    position, velocity, angular_velocity : array (3,) or (bodies, 3), optional
        Where the centre of mass is [m], its velocity [m/s], the angular velocity [rad/s], world axes; 0 if absent.
    orientation : array (4,) or (bodies, 4), optional
        Rotation from body to world axes (w, x, y, z), of which q/|q| is taken; none if absent.
    """

    def __new__(
        cls,
        mass: npt.ArrayLike,
        inertia: npt.ArrayLike,
        *,
        position: npt.ArrayLike | None = None,
        orientation: npt.ArrayLike | None = None,
        velocity: npt.ArrayLike | None = None,
        angular_velocity: npt.ArrayLike | None = None,
    ) -> Batch: ...
    def advance(self, step: _Number, steps: SupportsIndex, *, threads: SupportsIndex | None = None) -> None:
        """Takes steps, on as many threads as are asked for, by default as many as there are processors; the
        bits do not depend on them. Other Python threads go on meanwhile, and Ctrl-C ends it between pieces.

        Parameters
        ----------
        step : float
            Length of a step [s].
        steps : int
            How many.
        threads : int, optional
            How many threads.
        """

    @property
    def position(self) -> _Array:
        """Centres of mass [m]: array (bodies, 3)."""

    @property
    def orientation(self) -> _Array:
        """Rotations from body to world axes (w, x, y, z): array (bodies, 4)."""

    @property
    def velocity(self) -> _Array:
        """Velocities of the centres of mass, world axes [m/s]: array (bodies, 3)."""

    @property
    def angular_velocity(self) -> _Array:
        """Angular velocities, world axes [rad/s]: array (bodies, 3)."""

    @property
    def kinetic_energy(self) -> _Array:
        """Kinetic energies [J]: array (bodies,)."""

    def __len__(self) -> int: ...

@final
class UserEvent:
    """An event: a measure of the motion meets a value.

        g(t) = measure(t, bodies) − value = 0

    It is searched for along the motion of every step, and located to a few ulp of the time. Steps are
    excluded by bounds of g, not by the signs at their ends, so that double roots and close pairs are
    seen; a touch is told where g comes to 0 within its rounding and goes back. A zero at the very
    start is no event, nor is one that the run ends on before g is seen leaving. Bodies of one event
    share one integrator and one clock.

    With a function it is code, and can neither be written to a file nor pickled. What the function
    raises ends the run and becomes the cause of its SimulationError.

    Parameters
    ----------
    name : str
        A name that no other event of the run has.
    measure : callable, str or dict
        measure(t, bodies) -> float, a smooth function of a time [s] and a tuple of BodyMotion; or "speed",
        "angular_speed", "distance" (of two bodies), {"position": n}, {"velocity": n},
        {"angular_velocity": n}, {"angular_velocity_body": n} with a direction n of 3 numbers, or
        {"tilt": {"axis_body": a, "axis": n}}, (R a)·n.
    bodies : list of str
        The bodies that it is measured of, in this order.
    value : float
        The value that it shall meet.
    direction : {"both", "rising", "falling"}
        Which passages count; "both" (default) counts touches too.
    terminal : bool
        Whether the run ends there.
    """

    def __new__(
        cls,
        name: str,
        measure: _Measure,
        bodies: Iterable[str],
        value: _Number = 0.0,
        direction: _Direction = "both",
        terminal: bool = False,
    ) -> UserEvent: ...
    @property
    def name(self) -> str:
        """A name that no other event of the run has."""

    @property
    def measure(self) -> _Measure:
        """What is watched: a callable, a str or a dict."""

    @property
    def bodies(self) -> list[str]:
        """The bodies that it is measured of."""

    @property
    def value(self) -> float:
        """The value that it shall meet, in the unit of the measure."""

    @property
    def direction(self) -> str:
        """Which passages count: "rising", "falling" or "both"."""

    @property
    def terminal(self) -> bool:
        """Whether the run ends there."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Planar:
    """Motion in a plane through the body's start: 3 degrees of freedom.

    Parameters
    ----------
    normal : 3 numbers
        Normal of the plane, world axes; of any length but 0.
    """

    def __new__(cls, normal: _Numbers) -> Planar: ...
    @property
    def normal(self) -> _Vector:
        """Normal of the plane, world axes."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Pivot:
    """Motion about a point that rests in the world: 3 degrees of freedom, a top.

    Parameters
    ----------
    point_body : 3 numbers
        The point that rests, body axes from the centre of mass [m].
    """

    def __new__(cls, point_body: _Numbers) -> Pivot: ...
    @property
    def point_body(self) -> _Vector:
        """The point that rests, body axes from the centre of mass [m]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Axle:
    """Motion about an axis that rests in the world: 1 degree of freedom, a pendulum or a wheel.

    Parameters
    ----------
    point_body : 3 numbers
        A point of the axis, body axes from the centre of mass [m].
    axis_body : 3 numbers
        Direction of the axis, body axes; of any length but 0.
    """

    def __new__(cls, point_body: _Numbers, axis_body: _Numbers) -> Axle: ...
    @property
    def point_body(self) -> _Vector:
        """A point of the axis, body axes from the centre of mass [m]."""

    @property
    def axis_body(self) -> _Vector:
        """Direction of the axis, body axes."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Prescribed:
    """A motion that nothing disturbs: a turntable, a conveyor, a bat.

    The body point center moves with velocity, the body turns about it with angular_velocity, both times a factor
    that is constant between the times of the schedule. Position and orientation of the body are those at time 0.

    Parameters
    ----------
    velocity : 3 numbers
        Velocity of the point center, world axes [m/s].
    angular_velocity : 3 numbers
        Angular velocity, world axes [rad/s].
    center : 3 numbers
        The point that the body turns about, shape axes [m].
    schedule : list of (time, factor), optional
        Factor of both velocities: 0 before the first time [s], held after the last; 1 always, if absent.
    """

    def __new__(
        cls,
        *,
        velocity: _Numbers = (0.0, 0.0, 0.0),
        angular_velocity: _Numbers = (0.0, 0.0, 0.0),
        center: _Numbers = (0.0, 0.0, 0.0),
        schedule: _Rows | None = None,
    ) -> Prescribed: ...
    @property
    def velocity(self) -> _Vector:
        """Velocity of the point center, world axes [m/s]."""

    @property
    def angular_velocity(self) -> _Vector:
        """Angular velocity, world axes [rad/s]."""

    @property
    def center(self) -> _Vector:
        """The point that the body turns about, shape axes [m]."""

    @property
    def schedule(self) -> list[tuple[float, float]] | None:
        """Factor of both velocities: (time [s], factor), or None."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Body:
    """One body: shape, mass, start and material. SI units, angles in radians.

    What is wrong with a body is told when it is added to a scene.

    Parameters
    ----------
    name : str
        A name that no other body of the scene has.
    shape : a shape, optional
        The solid; without one, mass and inertia are given. Body axes are the shape's axes.
    density : float, optional
        Uniform density [kg/m³].
    mass : float, optional
        Mass [kg]; instead of the density, or beside inertia.
    inertia : 3 rows of 3 numbers, optional
        Inertia about the centre of mass, body axes [kg·m²]; instead of that of a uniform solid.
    position : 3 numbers, optional
        Where the centre of mass starts, world axes [m]; of a fixed body, the shape's origin.
    origin : 3 numbers, optional
        Where the origin of the shape's coordinates starts, world axes [m]; instead of position.
    orientation : 4 numbers
        Rotation from body to world axes, a unit quaternion (w, x, y, z).
    velocity : 3 numbers, optional
        Velocity of the centre of mass, world axes [m/s]; 0, or what the freedom asks, if absent.
    angular_velocity : 3 numbers, optional
        Angular velocity, world axes [rad/s].
    angular_velocity_body : 3 numbers, optional
        Angular velocity, body axes [rad/s]; instead of angular_velocity.
    friction : float
        Coefficient of friction [-]; a pair has the geometric mean of both.
    restitution : float
        Coefficient of restitution, 0 to 1 [-]; a pair has the larger of both.
    response : {"bounce", "stick"}
        What happens when it touches another body.
    breaking_load : (float or None, float or None), optional
        Force [N] and torque about the point of contact [N·m] under which what it sticks to, or what sticks to it,
        comes off; of a pair the weaker counts. None bears any.
    fixed : bool
        Whether it stays where it is.
    motion : Prescribed, optional
        The motion that it is moved along, whatever it meets.
    freedom : "free", Planar, Pivot or Axle
        How it may move.
    collides : bool
        Whether its shape meets other bodies; if not, it serves for the mass alone.
    """

    def __new__(
        cls,
        name: str,
        shape: _Shape | None = None,
        *,
        density: _Number | None = None,
        mass: _Number | None = None,
        inertia: _Rows | None = None,
        position: _Numbers | None = None,
        origin: _Numbers | None = None,
        orientation: _Numbers = (1.0, 0.0, 0.0, 0.0),
        velocity: _Numbers | None = None,
        angular_velocity: _Numbers | None = None,
        angular_velocity_body: _Numbers | None = None,
        friction: _Number = 0.0,
        restitution: _Number = 0.0,
        response: _Response = "bounce",
        breaking_load: tuple[float | None, float | None] | None = None,
        fixed: bool = False,
        motion: Prescribed | None = None,
        freedom: _Freedom = "free",
        collides: bool = True,
    ) -> Body: ...
    @property
    def name(self) -> str:
        """A name that no other body of the scene has."""

    @property
    def shape(self) -> _Shape | None:
        """The solid, or None."""

    @property
    def density(self) -> float | None:
        """Uniform density [kg/m³], or None."""

    @property
    def mass(self) -> float | None:
        """Mass [kg], or None."""

    @property
    def inertia(self) -> list[_Vector] | None:
        """Inertia about the centre of mass, body axes [kg·m²], or None."""

    @property
    def position(self) -> _Vector | None:
        """Where the centre of mass starts, world axes [m], or None."""

    @property
    def origin(self) -> _Vector | None:
        """Where the origin of the shape's coordinates starts, world axes [m], or None."""

    @property
    def orientation(self) -> _Quaternion:
        """Rotation from body to world axes, (w, x, y, z)."""

    @property
    def velocity(self) -> _Vector | None:
        """Velocity of the centre of mass, world axes [m/s], or None."""

    @property
    def angular_velocity(self) -> _Vector | None:
        """Angular velocity, world axes [rad/s], or None."""

    @property
    def angular_velocity_body(self) -> _Vector | None:
        """Angular velocity, body axes [rad/s], or None."""

    @property
    def friction(self) -> float:
        """Coefficient of friction [-]."""

    @property
    def restitution(self) -> float:
        """Coefficient of restitution [-]."""

    @property
    def response(self) -> _Response:
        """What happens when it touches another body: "bounce" or "stick"."""

    @property
    def breaking_load(self) -> tuple[float | None, float | None] | None:
        """Force [N] and torque [N·m] under which what has stuck comes off, or None."""

    @property
    def fixed(self) -> bool:
        """Whether it stays where it is."""

    @property
    def motion(self) -> Prescribed | None:
        """The motion that it is moved along, or None."""

    @property
    def freedom(self) -> _Freedom:
        """How it may move: "free", Planar, Pivot or Axle."""

    @property
    def collides(self) -> bool:
        """Whether its shape meets other bodies."""

    def mass_properties(self) -> MassProperties:
        """Mass, centre of mass (shape axes) and inertia of a body that moves."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class BodyMotion:
    """Motion of one body at an instant, as effects and simulations see it.

    World axes unless a name ends in _body; arrays are copies.
    """

    @property
    def mass(self) -> float:
        """Mass [kg]."""

    @property
    def inertia_body(self) -> _Array:
        """Inertia about the centre of mass, body axes [kg·m²]: array (3, 3)."""

    @property
    def position(self) -> _Array:
        """Centre of mass [m]: array (3,)."""

    @property
    def orientation(self) -> _Array:
        """Rotation from body to world axes, (w, x, y, z): array (4,)."""

    @property
    def rotation(self) -> _Array:
        """The same rotation as a matrix: array (3, 3)."""

    @property
    def velocity(self) -> _Array:
        """Velocity of the centre of mass [m/s]: array (3,)."""

    @property
    def angular_velocity(self) -> _Array:
        """Angular velocity [rad/s]: array (3,)."""

    @property
    def angular_velocity_body(self) -> _Array:
        """Angular velocity, body axes [rad/s]: array (3,)."""

    @property
    def linear_momentum(self) -> _Array:
        """Linear momentum m v [kg·m/s]: array (3,)."""

    @property
    def angular_momentum(self) -> _Array:
        """Angular momentum about the centre of mass [kg·m²/s]: array (3,)."""

    @property
    def kinetic_energy(self) -> float:
        """Kinetic energy [J]."""

    def point(self, p_body: _Numbers) -> _Array:
        """A body point (body axes, from the centre of mass) in the world [m]: array (3,)."""

    def velocity_at(self, p: _Numbers) -> _Array:
        """Velocity of the body at a world point [m/s]: array (3,)."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Scene:
    """Bodies, what acts on them, and how to run them.

    Nothing runs unasked: there is no gravity, no drag and no floor unless one is added.
    """

    def __new__(cls) -> Scene: ...
    def add(self, body: Body) -> str:
        """Adds a body, and returns its name.

        Raises Error if the name is taken, or a field of the body must not be as it is.
        """

    def add_effect(self, effect: _Effect) -> None:
        """Adds what acts on bodies. Its bodies need not be there yet: compiling the scene looks for them."""

    @property
    def bodies(self) -> list[Body]:
        """The bodies, in the order of the body axis of every array."""

    @property
    def effects(self) -> list[_Effect]:
        """What acts on them."""

    @property
    def run_options(self) -> dict[str, Any]:
        """How to run the scene where a call does not say otherwise: a dict of the options of `run`,
        `t_span` among them, without those that a scene file would leave out.
        """

    @run_options.setter
    def run_options(self, options: dict[str, Any]) -> None: ...
    def compile(
        self,
        *,
        tolerance: _Number | None = None,
        method: _Method | None = None,
        order: int | None = None,
        step: _Number | None = None,
        t_eval: _Numbers | None = None,
        estimate: bool | None = None,
        record: _Record | None = None,
        length_scale: _Number | None = None,
        orientation: _Orientation | None = None,
        projection: bool | None = None,
        finder: _Finder | None = None,
        eps: _Number | None = None,
        restitution_law: _RestitutionLaw | None = None,
        max_impacts: int | None = None,
        events: Iterable[UserEvent] | None = None,
    ) -> Plan:
        """Checks the scene and keeps what it calls for: a Plan. The options are those of `run`."""

    def explain(self) -> str:
        """The plan of the scene's own run options in words: what runs, what is left out, and why."""

    def run(
        self,
        t_span: tuple[_Number, _Number] | None = None,
        *,
        tolerance: _Number | None = None,
        method: _Method | None = None,
        order: int | None = None,
        step: _Number | None = None,
        t_eval: _Numbers | None = None,
        estimate: bool | None = None,
        record: _Record | None = None,
        length_scale: _Number | None = None,
        orientation: _Orientation | None = None,
        projection: bool | None = None,
        finder: _Finder | None = None,
        eps: _Number | None = None,
        restitution_law: _RestitutionLaw | None = None,
        max_impacts: int | None = None,
        events: Iterable[UserEvent] | None = None,
        progress: bool = False,
    ) -> Trajectory:
        """Runs the scene over a span, and returns its Trajectory.

        Give a tolerance, or a method with a step; with neither, the tolerance is 1e-6. An option that
        is None is what the scene's own run options say, else as told below.

        Other threads go on meanwhile, and Ctrl-C stops the run; the KeyboardInterrupt then has the
        SimulationError with the trajectory so far as its cause.

        Parameters
        ----------
        t_span : (float, float), optional
            Start and end [s].
        tolerance : float, optional
            Error that the result may have: of positions over length_scale, of orientations in radians [-].
        method : str, optional
            Method of integration, one of METHODS; "auto" (default) lets the plan choose.
        order : int, optional
            Order of the methods "taylor" (by default that which the tolerance calls for, 8 where the step is given)
            and "dmv" (10).
        step : float, optional
            Length of a step [s].
        t_eval : array of float, optional
            Times of the samples [s], rising; the ends and 201 uniform times by default.
        estimate : bool, optional
            Whether the error of the result is estimated (default).
        record : {"dense", "samples", "end"}, optional
            What is kept: the motion of every step (default), the samples, or the ends.
        length_scale : float, optional
            Length that position errors are measured by [m]; by default the larger of body and path.
        orientation : {"quaternion", "matrix"}, optional
            How methods in world axes write the orientation; "quaternion" by default.
        projection : bool, optional
            Whether orientations are put back on their sphere after each step (default).
        finder : {"guaranteed", "secant", "bisection"}, optional
            How the time of contact is found; "guaranteed" by default.
        eps : float, optional
            Gap at which a contact is accepted [m]; 1e-12 of the pair's size by default.
        restitution_law : {"newton", "poisson", "stronge"}, optional
            What comes back where friction couples normal and tangent: the impulse of compression (default),
            the normal velocity, or the work of compression.
        max_impacts : int, optional
            Impacts of one body after which the run ends as AccumulatingImpacts; 1,000,000 by default.
        events : list of UserEvent, optional
            What is watched for.
        progress : bool
            Whether a progress line is shown on a terminal.

        Raises
        ------
        Error
            Bad input.
        SimulationError
            The run cannot go on; its trajectory up to then is there.

        Warns
        -----
        AccuracyWarning
            The tolerance is not met over the whole span; report.horizon says up to when it is.
        """

    def compare(
        self,
        t_span: tuple[_Number, _Number] | None = None,
        *,
        methods: Iterable[_Method] | None = None,
        steps: _Numbers | None = None,
        tolerances: _Numbers | None = None,
        repeats: int = 5,
        order: int | None = None,
        length_scale: _Number | None = None,
        orientation: _Orientation | None = None,
        projection: bool | None = None,
        finder: _Finder | None = None,
        eps: _Number | None = None,
        restitution_law: _RestitutionLaw | None = None,
        max_impacts: int | None = None,
        progress: bool = False,
    ) -> ComparisonTable:
        """What accuracy costs: error against time for several methods, steps and tolerances, a ComparisonTable.

        Error and time come from the same run. The error is that of the end state.

        Parameters
        ----------
        t_span : (float, float), optional
            Start and end [s]; the scene's own by default.
        methods : list of str, optional
            Methods of integration; all by default.
        steps : list of float, optional
            Lengths of a step [s]; ten halvings from a first guess if neither steps nor tolerances are given.
        tolerances : list of float, optional
            Errors that the result may have [-], for the methods that choose their steps by them; the error is
            not estimated in these runs, which costs extra.
        repeats : int
            How often each run is timed; the least and the middle time are kept.
        order, length_scale, orientation, projection, finder, eps, restitution_law, max_impacts
            As in run.
        progress : bool
            Whether a progress line is shown on a terminal.
        """

    def save(self, path: _Path) -> None:
        """Writes the scene to a file, .toml or .json."""

    def to_text(self, format: _Format = "toml") -> str:
        """The scene as the text of a file, in "toml" or "json"."""

    @staticmethod
    def from_text(text: str, format: _Format = "toml") -> Scene:
        """The scene that a text holds, in "toml" or "json"."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Plan:
    """A scene after checking, with only what it calls for; made by Scene.compile."""

    @property
    def method(self) -> str:
        """The method of integration."""

    @property
    def bodies(self) -> list[Body]:
        """The bodies, in the order of the body axis of every array."""

    def explain(self) -> str:
        """What runs, what is left out, and why; and where the options name a span, what the run is predicted to
        take, by the user's own cost table if `calibrate` made one, else by the shipped one.
        """

    def start(self, t: _Number = 0.0) -> Simulation:
        """Starts the scene at time t [s], to be advanced by hand; the plan must have method and step."""

    def run(self, t_span: tuple[_Number, _Number] | None = None, *, progress: bool = False) -> Trajectory:
        """Runs the plan over a span [s], that of the scene's run options if none is given; see Scene.run."""

    def predict(self, t_span: tuple[_Number, _Number] | None = None) -> tuple[float, float, float] | None:
        """Steps and time [s] that a run over a span is predicted to take: (steps, run, estimate), by the same
        table as in explain. Where a function of the user is called, some steps are taken to time them. None where
        contacts cannot be foreseen, and where a step breaks off.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class Simulation:
    """A running scene, advanced by hand; made by Plan.start or resume."""

    @property
    def time(self) -> float:
        """The time to which it was advanced [s]."""

    @property
    def events(self) -> list[Event]:
        """What has happened so far, group by group."""

    @property
    def counts(self) -> Counts:
        """What has been done so far."""

    def advance(self, to: _Number) -> None:
        """Advances to a time [s]. Steps are never shortened for it, so that advancing in pieces gives the
        same bits as advancing at once. Other threads go on meanwhile, and Ctrl-C stops it between steps.
        """

    def state(self, name: str) -> BodyMotion:
        """Motion of a body at the time to which the simulation was advanced."""

    def save(self, path: _Path) -> None:
        """Writes the running state to a file, conventionally .bryla; resume goes on from it with the same
        bits.
        """

@final
class Trajectory:
    """What a run leaves behind: samples, the motion of every step, and what happened on the way.

    Arrays are worked out when they are asked for, and are yours. Their body axis has the order of
    names. At an impact a sample shows the state after it; events have both.

    run["die"] is one body, run.at(t) are other times than the samples; both are States.
    """

    @property
    def t(self) -> _Array:
        """Times of the samples [s]: array (samples,)."""

    @property
    def end(self) -> float:
        """How far the motion is known [s]."""

    @property
    def ended_by(self) -> str | None:
        """The name of the event that ended the run before its time, or None."""

    @property
    def names(self) -> list[str]:
        """Names of the bodies, in the order of the body axis."""

    @property
    def plan(self) -> Plan:
        """The plan that ran."""

    @property
    def position(self) -> _Array:
        """Centre of mass, world axes [m]: array (samples, bodies, 3)."""

    @property
    def orientation(self) -> _Array:
        """Rotation from body to world axes, (w, x, y, z): array (samples, bodies, 4)."""

    @property
    def velocity(self) -> _Array:
        """Velocity of the centre of mass, world axes [m/s]: array (samples, bodies, 3)."""

    @property
    def angular_velocity(self) -> _Array:
        """Angular velocity, world axes [rad/s]: array (samples, bodies, 3)."""

    @property
    def angular_velocity_body(self) -> _Array:
        """Angular velocity, body axes [rad/s]: array (samples, bodies, 3)."""

    @property
    def linear_momentum(self) -> _Array:
        """Linear momentum, world axes [kg·m/s]: array (samples, bodies, 3)."""

    @property
    def spin_angular_momentum(self) -> _Array:
        """Angular momentum about each centre of mass, world axes [kg·m²/s]: array (samples, bodies, 3)."""

    @property
    def angular_momentum_body(self) -> _Array:
        """Angular momentum about each centre of mass, body axes [kg·m²/s]: array (samples, bodies, 3)."""

    @property
    def reaction_force(self) -> _Array:
        """Force of the freedom against effects, world axes [N]: array (samples, bodies, 3)."""

    @property
    def reaction_torque(self) -> _Array:
        """Torque of the freedom against effects, about the centre of mass [N·m]: array (samples, bodies, 3)."""

    @property
    def events(self) -> list[Event]:
        """What happened, by time: a list of Event."""

    @property
    def report(self) -> Report:
        """What ran, what it cost, and how far it is to be trusted."""

    @property
    def energy(self) -> Energy:
        """Energies of the whole scene at every sample [J].

        Raises Error for a run that kept samples only, of a scene in which something dissipates or
        works.
        """

    def total(self, about: _Numbers = (0.0, 0.0, 0.0)) -> Total:
        """Momenta of the whole scene at every sample, the angular one about a world point [m]."""

    def at(self, t: _Number | _Numbers) -> States:
        """The states at any time [s] of the run, or at several; the body axis comes after the time axis.

        Raises Error for a time outside of the run, and for a run that kept samples only.
        """

    def pose(self, name: str, t: _Number) -> Pose:
        """Pose of a body's shape axes at a time [s] of the run."""

    def write(self, path: _Path) -> None:
        """Writes the samples to a file, .csv, .json or .npz, with the names that they have here."""

    def plot(self, bodies: Iterable[str] | None = None, figure: Figure | None = None) -> Figure:
        """Draws where the bodies are, how they turn, and where the energy goes, and returns the figure;
        needs matplotlib.

        Parameters
        ----------
        bodies : list of str, optional
            The bodies that are drawn; those that move by default.
        figure : matplotlib.figure.Figure, optional
            Where to draw; a new figure by default.
        """

    def __getitem__(self, name: str, /) -> States: ...
    def __len__(self) -> int: ...
    def __eq__(self, value: object, /) -> bool: ...

@final
class States:
    """States of bodies at times: of one body at all samples, run["die"], or at other times, run.at(t).

    The axes of the arrays: times, absent where one time was asked for; bodies, absent where one
    body was asked for; components.
    """

    @property
    def t(self) -> _Array | float:
        """The times [s]: array (times,), or a float where one time was asked for."""

    @property
    def names(self) -> list[str]:
        """Names of the bodies, in the order of the body axis."""

    @property
    def position(self) -> _Array:
        """Centre of mass, world axes [m]: array ([times,] [bodies,] 3)."""

    @property
    def orientation(self) -> _Array:
        """Rotation from body to world axes, (w, x, y, z): array ([times,] [bodies,] 4)."""

    @property
    def velocity(self) -> _Array:
        """Velocity of the centre of mass, world axes [m/s]: array ([times,] [bodies,] 3)."""

    @property
    def angular_velocity(self) -> _Array:
        """Angular velocity, world axes [rad/s]: array ([times,] [bodies,] 3)."""

    @property
    def angular_velocity_body(self) -> _Array:
        """Angular velocity, body axes [rad/s]: array ([times,] [bodies,] 3)."""

    @property
    def linear_momentum(self) -> _Array:
        """Linear momentum, world axes [kg·m/s]: array ([times,] [bodies,] 3)."""

    @property
    def spin_angular_momentum(self) -> _Array:
        """Angular momentum about each centre of mass, world axes [kg·m²/s]: array ([times,] [bodies,] 3)."""

    @property
    def angular_momentum_body(self) -> _Array:
        """Angular momentum about each centre of mass, body axes [kg·m²/s]: array ([times,] [bodies,] 3)."""

    @property
    def reaction_force(self) -> _Array:
        """Force of the freedom against effects, world axes [N]: array ([times,] [bodies,] 3)."""

    @property
    def reaction_torque(self) -> _Array:
        """Torque of the freedom against effects, about the centre of mass [N·m]: array ([times,] [bodies,] 3)."""

    def __getitem__(self, name: str, /) -> States: ...
    def __eq__(self, value: object, /) -> bool: ...

@final
class Event:
    """Something that happened at an instant. World axes; the normal points from the first body to the
    second, and the impulse is that on the second.
    """

    @property
    def time(self) -> float:
        """When [s]."""

    @property
    def kind(self) -> str:
        """What: "bounce", "stick", "break" (what had stuck came off), "contact" (they stay in contact and move),
        "rest", "user" or "switch".
        """

    @property
    def name(self) -> str:
        """The name of a UserEvent, or which load was turned on or off; empty for impacts."""

    @property
    def passage(self) -> str | None:
        """How the measure behind a UserEvent or a switch met its value: "rising", "falling" or "touching"; None
        for impacts.
        """

    @property
    def bodies(self) -> tuple[str, str]:
        """Names of the two bodies; the first and the last of a UserEvent or a switch, to which nothing of the
        below applies.
        """

    @property
    def point(self) -> _Array:
        """Where the impulse acts [m]: array (3,); the point of contact, or the centroid of several; of a break the
        joint.
        """

    @property
    def normal(self) -> _Array:
        """Unit normal from the first body to the second: array (3,)."""

    @property
    def impulse(self) -> _Array:
        """Impulse on the second body [N·s]: array (3,)."""

    @property
    def force(self) -> _Array:
        """Force of the first body on the second that their joint carried when it broke [N]: array (3,)."""

    @property
    def torque(self) -> _Array:
        """Torque of the first body on the second about the joint when it broke [N·m]: array (3,)."""

    @property
    def features(self) -> str:
        """Which features of the two bodies touched, in words."""

    @property
    def iterations(self) -> int:
        """Rounds that the finder took to locate it."""

    @property
    def velocity(self) -> _Array:
        """Velocity of the second body's centre of mass before and after [m/s]: array (2, 3)."""

    @property
    def angular_velocity(self) -> _Array:
        """Angular velocity of the second body before and after [rad/s]: array (2, 3)."""

    @property
    def energy_lost(self) -> float:
        """Kinetic energy lost [J]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Energy:
    """Energies of the whole scene at every sample [J]; kinetic + potential + dissipated − work stays."""

    @property
    def kinetic(self) -> _Array:
        """Kinetic energy [J]: array (samples,)."""

    @property
    def potential(self) -> _Array:
        """Potential energy [J]: array (samples,)."""

    @property
    def dissipated(self) -> _Array:
        """Energy turned into heat since the start, by drag, damping and impacts [J]: array (samples,)."""

    @property
    def work(self) -> _Array:
        """Work brought in from outside since the start [J]: array (samples,)."""

    @property
    def balance(self) -> _Array:
        """Kinetic + potential + dissipated − work [J]: array (samples,)."""

    @property
    def drift(self) -> float:
        """Largest change of the balance since the start [J]: the method's error in the energy."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Total:
    """Momenta of the whole scene at every sample, world axes."""

    @property
    def linear_momentum(self) -> _Array:
        """Linear momentum [kg·m/s]: array (samples, 3)."""

    @property
    def angular_momentum(self) -> _Array:
        """Angular momentum about the point asked for [kg·m²/s]: array (samples, 3)."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Report:
    """What ran, what it cost, and how far the result is to be trusted; `print` shows it."""

    @property
    def method(self) -> str:
        """Method of integration."""

    @property
    def step(self) -> float:
        """Length of a step [s]; the mean one, where they differ."""

    @property
    def local_tolerance(self) -> float | None:
        """Largest error that a step was allowed [-], where that decided its length, or None."""

    @property
    def tolerance(self) -> float | None:
        """Tolerance asked for [-], or None."""

    @property
    def error_estimate(self) -> float | None:
        """Estimated error of the result [-], or None: the larger of position error over length_scale and
        orientation error in radians, over all samples and bodies up to the horizon.
        """

    @property
    def estimated_by(self) -> str:
        """How the error was estimated, in words."""

    @property
    def met(self) -> bool | None:
        """Whether the estimate is within the tolerance over the whole span; None if none was asked for."""

    @property
    def horizon(self) -> float:
        """Time up to which the estimate is within the tolerance [s]; the end, if none was asked for."""

    @property
    def length_scale(self) -> float:
        """Length that position errors are measured by [m]."""

    @property
    def counts(self) -> Counts:
        """Steps, evaluations, drift of the orientation."""

    @property
    def impacts(self) -> int:
        """Impacts answered."""

    @property
    def impact_iterations(self) -> int:
        """Rounds of the finder, over all impacts."""

    @property
    def touch_impacts(self) -> int:
        """Instants of impact at which a point took a blow only because its gap was below the touch gap.

        A landing that is flat to that angle, bodies that are hit together: with another touch gap, 1e-9 of the size,
        they come out differently.
        """

    @property
    def seconds(self) -> Seconds:
        """Processor time by stage [s]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Counts:
    """What has been done."""

    @property
    def steps(self) -> int:
        """Steps taken."""

    @property
    def rejected(self) -> int:
        """Steps refused by error control."""

    @property
    def evaluations(self) -> int:
        """Evaluations of the right-hand side of the equations of motion."""

    @property
    def orientation_drift(self) -> float:
        """Largest | |q| − 1 |, or ‖RᵀR − 1‖, before an orientation was put back on its sphere [-]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Seconds:
    """Processor time by stage [s]."""

    @property
    def compile(self) -> float:
        """Checking the scene and making the plan [s]."""

    @property
    def run(self) -> float:
        """The run whose result is kept [s]."""

    @property
    def estimate(self) -> float:
        """Other runs, from which its error is estimated [s]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Row:
    """One run of a comparison."""

    @property
    def method(self) -> str:
        """Method of integration."""

    @property
    def step(self) -> float:
        """Length of a step [s]; of the closed form, the whole span; under a tolerance, the mean of the run."""

    @property
    def tolerance(self) -> float | None:
        """Error that the result was allowed [-]; None where the step was given."""

    @property
    def error(self) -> float | None:
        """Error of the end state [-]: the larger of position error over the length scale and orientation
        error in radians, over all bodies; None where the run broke off.
        """

    @property
    def evaluations(self) -> int:
        """Evaluations of the right-hand side of the equations of motion."""

    @property
    def steps(self) -> int:
        """Steps."""

    @property
    def seconds_min(self) -> float:
        """Least processor time of the repeats [s]."""

    @property
    def seconds_median(self) -> float:
        """Middle processor time of the repeats [s]."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class ComparisonTable:
    """What accuracy costs in one scene; `print` shows the table."""

    @property
    def rows(self) -> list[Row]:
        """The runs, method by method: a list of Row."""

    @property
    def reference(self) -> str:
        """What the errors are measured against."""

    @property
    def reference_error(self) -> float:
        """Estimated error of the reference itself [-]; errors below are not told apart from it."""

    def to_csv(self) -> str:
        """The table as comma-separated values; a run that broke off has no error."""

    def plot(self, figure: Figure | None = None) -> Figure:
        """Draws error against processor time, both logarithmic, and returns the figure; needs matplotlib.

        Parameters
        ----------
        figure : matplotlib.figure.Figure, optional
            Where to draw; a new figure by default.
        """

    def __len__(self) -> int: ...
    def __eq__(self, value: object, /) -> bool: ...

def cli_main(args: Sequence[str]) -> int:
    """Runs the command line with these arguments, the first being its own name; returns the exit code."""

def calibrate(path: _Path | None = None) -> Path:
    """Measures what a step of each method costs on this machine, and writes the table, from which `explain` and
    `predict` tell how long a run will take; returns where. It takes a second or so.

    Parameters
    ----------
    path : path, optional
        Where the table goes; by default where `explain` looks for it, bryla/costs.toml in the user's folder for
        configuration.
    """

def load(path: _Path) -> Scene:
    """Reads a scene from a file, .toml or .json; meshes that it names are read too, relative paths
    starting beside it.
    """

def schema() -> str:
    """The JSON Schema of scene files, as JSON text."""

def resume(path: _Path) -> Simulation:
    """Loads a running state that Simulation.save wrote; it goes on with the same bits."""

@final
class ConvexPolyhedron:
    """The convex hull of points: vertices, edges, faces.

    Any number of points, repeated, on one plane, line or spot. No vertex is dropped, however thin the
    body.

    Parameters
    ----------
    points : (n, 3) numbers
        Points [m].
    """

    def __new__(cls, points: npt.ArrayLike) -> ConvexPolyhedron: ...
    @property
    def vertices(self) -> _Array:
        """The vertices [m]: array (n, 3)."""

    @property
    def sources(self) -> list[int]:
        """For each vertex the number of the point that it was given as."""

    @property
    def edges(self) -> list[tuple[int, int]]:
        """The two vertices of each edge."""

    @property
    def faces(self) -> list[list[int]]:
        """The vertices of each face, counterclockwise seen from outside; a polygon has two faces back to
        back.
        """

    @property
    def normals(self) -> _Array:
        """The outward unit normals of the faces: array (n, 3) [-]."""

    @property
    def rank(self) -> int:
        """Dimension: 3 a solid, 2 a polygon, 1 a segment, 0 a point."""

    def support(self, direction: _Numbers) -> int:
        """A vertex that lies farthest in a direction."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Collider:
    """A shape prepared for queries: build it once, ask often.

    Refused are a solid that is not convex (give a compound of convex pieces) and a mesh, which is in
    its file.

    Parameters
    ----------
    shape : a shape or ConvexPolyhedron
        The shape; poses in queries are those of its own axes.
    """

    def __new__(cls, shape: _Collidable) -> Collider: ...
    @property
    def part_count(self) -> int:
        """How many convex pieces it has: 1, unless it is a compound."""

    def polyhedron(self, part: int = 0) -> ConvexPolyhedron | None:
        """The polyhedron of a piece, in the piece's axes, which the numbers of its features count in; None
        where the piece is none.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class PairCache:
    """Where a pair's last answer was found, to start the next query of the same pair from.

    Any content is legal, also from another pair or another time: it costs steps, never truth.
    """

    def __new__(cls) -> PairCache: ...

@final
class ClosestFeatures:
    """The closest features of two bodies A and B, in world axes."""

    @property
    def signed_distance(self) -> float:
        """Distance where positive, minus the depth where negative [m]: normal · (point_b − point_a)."""

    @property
    def lower(self) -> float:
        """The true signed distance is not below this [m]."""

    @property
    def upper(self) -> float:
        """The true signed distance is not above this [m]."""

    @property
    def state(self) -> _State:
        """ "separated", "touching" (the interval contains 0) or "overlapping"."""

    @property
    def point_a(self) -> _Array:
        """The closest or deepest point of A, world axes [m]: array (3,)."""

    @property
    def point_b(self) -> _Array:
        """The closest or deepest point of B, world axes [m]: array (3,)."""

    @property
    def normal(self) -> _Array:
        """Unit normal from A to B, world axes; valid in every state: array (3,)."""

    @property
    def feature_a(self) -> _Feature:
        """The feature of A that carries point_a: "vertex", "edge", "face" or "surface" (curved), and its
        number.
        """

    @property
    def feature_b(self) -> _Feature:
        """The feature of B that carries point_b."""

    @property
    def part_a(self) -> int:
        """The piece of A that the feature belongs to, where A is a compound; else 0."""

    @property
    def part_b(self) -> int:
        """The piece of B that the feature belongs to, where B is a compound; else 0."""

    @property
    def steps(self) -> int:
        """Rounds of the query."""

    @property
    def rung(self) -> str:
        """How far the query had to climb: "verified" (the cached features or their neighbours were the answer),
        "walked" (from the cached features), "searched" or "double_double".
        """

    @property
    def certified(self) -> bool:
        """Whether the interval is as narrow as was asked for. If not, it still contains the true value."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class ConvexPolygon:
    """The convex hull of points in the plane.

    Parameters
    ----------
    points : (n, 2) numbers
        Points [m]; repeated or on one line.
    """

    def __new__(cls, points: npt.ArrayLike) -> ConvexPolygon: ...
    @property
    def vertices(self) -> _Array:
        """The vertices, counterclockwise [m]: array (n, 2). Edge k leaves vertex k."""

    def plot(self, figure: Figure | None = None) -> Figure:
        """Draws the polygon with its Voronoi regions, the lecture's figure 10, and returns the figure;
        needs matplotlib.

        Parameters
        ----------
        figure : matplotlib Figure, optional
            Where to draw.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class VoronoiRegion:
    """The outside points closer to a feature of a polygon than to any other: V(F) of the lecture."""

    @property
    def feature(self) -> _Feature:
        """Whose region it is: "vertex" or "edge", and its number."""

    @property
    def base(self) -> _Array:
        """Where its border starts: the vertex, or both ends of the edge [m]: array (1 or 2, 2)."""

    @property
    def rays(self) -> _Array:
        """Unit directions in which its border leaves the first and the last base point: array (2, 2), of a
        lone point, whose region is the plane, array (0, 2).
        """

    def contains(self, points: npt.ArrayLike) -> _Array:
        """Whether points (..., 2) [m] are in the region, its border included: array (...) of 1 and 0. On a
        border both neighbours say yes.
        """

    def __eq__(self, value: object, /) -> bool: ...

@final
class PlanarClosest:
    """The closest features of two polygons, with the walk that found them."""

    @property
    def signed_distance(self) -> float:
        """Distance where positive, minus the depth where negative [m]."""

    @property
    def lower(self) -> float:
        """The true signed distance is not below this [m]."""

    @property
    def upper(self) -> float:
        """The true signed distance is not above this [m]."""

    @property
    def state(self) -> _State:
        """ "separated", "touching" or "overlapping"."""

    @property
    def point_a(self) -> _Array:
        """The closest or deepest point of A [m]: array (2,)."""

    @property
    def point_b(self) -> _Array:
        """The closest or deepest point of B [m]: array (2,)."""

    @property
    def normal(self) -> _Array:
        """Unit normal from A to B: array (2,)."""

    @property
    def feature_a(self) -> _Feature:
        """The feature of A that carries point_a: "vertex" or "edge", and its number."""

    @property
    def feature_b(self) -> _Feature:
        """The feature of B that carries point_b."""

    @property
    def path(self) -> list[tuple[_Feature, _Feature, _Point2, _Point2]]:
        """The pairs of features that the walk visited, each with its closest points: tuples (feature_a,
        feature_b, (x, y) of a, (x, y) of b).
        """

    @property
    def certified(self) -> bool:
        """Whether the interval is as narrow as rounding allows."""

    @property
    def outlines(self) -> list[_Array]:
        """The corners of A and of B in the world [m]: two arrays (n, 2)."""

    def plot(self, figure: Figure | None = None) -> Figure:
        """Draws both polygons, the Voronoi regions of A, and the walk; returns the figure. Needs
        matplotlib.

        Parameters
        ----------
        figure : matplotlib Figure, optional
            Where to draw.
        """

def closest_features(
    a: _Collidable,
    pose_a: Pose,
    b: _Collidable,
    pose_b: Pose,
    cache: PairCache | None = None,
    accuracy: _Accuracy = "exact",
) -> ClosestFeatures:
    """Closest features of two bodies: one signed distance, with an interval that contains the true one.

    Parameters
    ----------
    a, b : a shape, ConvexPolyhedron or Collider
        The bodies; a shape is prepared at each call, a Collider once.
    pose_a, pose_b : Pose
        Where the shapes' own axes stand.
    cache : PairCache, optional
        A start, left with this answer: use one for each pair that is asked again and again.
    accuracy : "exact", "yes_no" or float
        When the query may stop: at an interval as narrow as rounding allows, as soon as the state is
        known, or at this fraction of the size (both radii and the distance of the centres).

    Returns
    -------
    ClosestFeatures
    """

def closest_features_many(
    a: _Collidable, poses_a: _Poses, b: _Collidable, poses_b: _Poses, accuracy: _Accuracy = "exact", warm: bool = True
) -> dict[str, npt.NDArray[Any]]:
    """Closest features for many poses of one pair, other threads running meanwhile.

    Each query starts from the one before it, so order the poses along the motion; poses that have nothing to do
    with each other are asked faster anew.

    Parameters
    ----------
    a, b : a shape, ConvexPolyhedron or Collider
        The bodies.
    poses_a, poses_b : Pose, or a pair of arrays
        One pose, or positions (..., 3) [m] and orientations (..., 4), which mean q/|q|.
    accuracy : "exact", "yes_no" or float
        As for closest_features.
    warm : bool
        Whether a query starts from the one before it. Anew, no answer's rounding depends on the other poses.

    Returns
    -------
    dict of arrays
        "signed_distance", "lower", "upper": (...) [m]; "point_a", "point_b", "normal": (..., 3), world
        axes; "state": (...), 1 separated, 0 touching, −1 overlapping; "certified": (...), 1 or 0.
    """

def closest_features_planar(
    a: ConvexPolygon,
    pose_a: _Numbers,
    b: ConvexPolygon,
    pose_b: _Numbers,
    start: tuple[_Feature, _Feature] | None = None,
) -> PlanarClosest:
    """Closest features of two convex polygons by the lecture's walk over Voronoi regions.

    Parameters
    ----------
    a, b : ConvexPolygon
        The polygons.
    pose_a, pose_b : 3 numbers
        Position x, y [m] of each polygon's origin, and its angle [rad], counterclockwise.
    start : pair of features, optional
        Where the walk begins, such as (("vertex", 0), ("edge", 2)); without it at the first vertices.

    Returns
    -------
    PlanarClosest
    """

@final
class Motion:
    """A uniform motion: a point of a body moves with constant velocity, and the body turns about it with
    constant angular velocity.

    x(t) = position + t velocity,  R(t) = exp(t [angular_velocity]) R(0)

    Parameters
    ----------
    position : 3 numbers
        Where the point `center` is at t = 0, world axes [m].
    orientation : 4 numbers
        Rotation from the shape's axes to the world's at t = 0, (w, x, y, z); it is divided by its length.
    velocity : 3 numbers
        Velocity of the point `center`, world axes [m/s].
    angular_velocity : 3 numbers
        Angular velocity, world axes [rad/s].
    center : 3 numbers, optional
        The point that moves uniformly, shape axes [m]: the shape's origin unless told otherwise.
    """

    def __new__(
        cls,
        position: _Numbers,
        orientation: _Numbers,
        velocity: _Numbers,
        angular_velocity: _Numbers,
        center: _Numbers = (0.0, 0.0, 0.0),
    ) -> Motion: ...
    @property
    def position(self) -> _Array:
        """Where the point `center` is at t = 0, world axes [m]: array (3,)."""

    @property
    def orientation(self) -> _Array:
        """Rotation from the shape's axes to the world's at t = 0, (w, x, y, z): array (4,)."""

    @property
    def velocity(self) -> _Array:
        """Velocity of the point `center`, world axes [m/s]: array (3,)."""

    @property
    def angular_velocity(self) -> _Array:
        """Angular velocity, world axes [rad/s]: array (3,)."""

    @property
    def center(self) -> _Array:
        """The point that moves uniformly, shape axes [m]: array (3,)."""

    def __eq__(self, value: object, /) -> bool: ...

@final
class Impact:
    """How a search for an impact ended, and what it cost."""

    @property
    def outcome(self) -> _Outcome:
        """ "clear": no impact, proved by the guaranteed search, not seen by the others. "at": the gap is in
        (0, eps] and closes. "already_touching": the search starts with a gap within eps that closes, or that
        stays. "overlap": it starts in overlap. "grazing": the gap came within (0, eps] and opens again.
        "stalled": eps is below what rounding leaves.
        """

    @property
    def time(self) -> float:
        """When [s]: of the impact or graze; the end of the search where it is clear; how far it came where it
        stalled; else its start.
        """

    @property
    def iterations(self) -> int:
        """Rounds of the finder."""

    @property
    def queries(self) -> int:
        """Queries of the closest features, or evaluations of the gap."""

    @property
    def closest(self) -> ClosestFeatures:
        """The closest features at that time."""

    def __eq__(self, value: object, /) -> bool: ...

def time_of_impact(
    a: _Collidable,
    motion_a: Motion,
    b: _Collidable,
    motion_b: Motion,
    t_max: float,
    eps: float | None = None,
    finder: _Finder = "guaranteed",
) -> Impact:
    """The first impact of two moving bodies in 0 to t_max, other threads running meanwhile.

    Accepted is only a gap in (0, eps], never an overlap. The guaranteed search proves the way free and misses
    nothing; bisection and secant are the lecture's, look at the ends of the time, and do not see what passes
    through between them. A pair that starts within eps and separates is searched on from where its gap exceeds
    eps, or from where its approach resumes.

    Parameters
    ----------
    a, b : a shape, ConvexPolyhedron or Collider
        The bodies; a shape is prepared at each call, a Collider once.
    motion_a, motion_b : Motion
        How they move.
    t_max : float
        Up to when is searched [s].
    eps : float, optional
        The gap at which contact is accepted [m]: without it 1e-12 of the pair's size (both radii). The guaranteed
        search takes no less than the rounding of the coordinates. A smaller one is found later by less than eps
        over the speed of approach.
    finder : "guaranteed", "secant" or "bisection"
        How the time is found.

    Returns
    -------
    Impact
    """

def time_of_impact_many(
    a: _Collidable,
    motions_a: _Motions,
    b: _Collidable,
    motions_b: _Motions,
    t_max: float,
    eps: float | None = None,
    finder: _Finder = "guaranteed",
) -> dict[str, npt.NDArray[Any]]:
    """Impacts for many motions of one pair, other threads running meanwhile.

    Parameters
    ----------
    a, b : a shape, ConvexPolyhedron or Collider
        The bodies.
    motions_a, motions_b : Motion, or a tuple of arrays
        One motion, or positions (..., 3) [m], orientations (..., 4), velocities (..., 3) [m/s], angular
        velocities (..., 3) [rad/s], and, where they are not 0, centers (..., 3) [m]: each may be a single one.
    t_max : float
        Up to when is searched [s].
    eps : float, optional
        As for time_of_impact.
    finder : "guaranteed", "secant" or "bisection"
        As for time_of_impact.

    Returns
    -------
    dict of arrays
        "outcome": (...), the words of Impact; "time": (...) [s]; "iterations", "queries": (...); and the closest
        features at that time, as closest_features_many gives them.
    """

def voronoi_regions(polygon: ConvexPolygon) -> list[VoronoiRegion]:
    """The Voronoi regions of a polygon's vertices and edges, counterclockwise from the first vertex.

    Parameters
    ----------
    polygon : ConvexPolygon
        The polygon.

    Returns
    -------
    list of VoronoiRegion
    """
