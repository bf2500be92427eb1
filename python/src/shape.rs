//! Shapes.

use std::path::PathBuf;

use bryla::shape::{
    Capsule, Compound, Cone, Cuboid, Cylinder, Ellipsoid, HalfSpace, Mesh, Piece, Polyhedron, Shape, Sphere,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::convert::{Numbers, Plain, plain_class};
use crate::error::Result;
use crate::mass::PyMassProperties;

/// Any shape, as an argument or a value.
#[derive(Debug, Clone)]
pub(crate) struct AnyShape(pub(crate) Shape);

/// The list of shapes: the class of each, and the way from any object to a shape and back.
macro_rules! shapes {
    ($(
        $(#[$doc:meta])*
        class $name:tt $Class:ident($Core:ident) $signature:tt as $text:tt { $($fields:tt)* }
    )*) => {
        $(plain_class! {
            $(#[$doc])*
            class $name $Class($Core) $signature as $text { $($fields)* }

            /// Mass, centre of mass and inertia at a uniform density [kg/m³], in shape axes.
            #[pyo3(signature = (density))]
            fn mass_properties(&self, density: f64) -> Result<PyMassProperties> {
                Ok(PyMassProperties(self.0.mass_properties(density)?))
            }

            /// Distance [m] from a point of the shape's axes to the shape's farthest point, or more;
            /// infinite for a half space, and for a mesh, which is in its file.
            #[pyo3(signature = (about=Numbers([0.0; 3])), text_signature = "($self, about=(0.0, 0.0, 0.0))")]
            fn bounding_radius(&self, about: Numbers<3>) -> f64 {
                self.0.bounding_radius(&about.0.into())
            }
        })*

        impl<'py> FromPyObject<'_, 'py> for AnyShape {
            type Error = PyErr;

            fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
                $(if let Ok(shape) = obj.cast::<$Class>() {
                    return Ok(Self(shape.get().0.clone().into()));
                })*
                Err(PyTypeError::new_err(format!("a shape wanted, got {}", obj.repr()?)))
            }
        }

        impl<'py> IntoPyObject<'py> for AnyShape {
            type Target = PyAny;
            type Output = Bound<'py, PyAny>;
            type Error = PyErr;

            fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
                match self.0 {
                    $(Shape::$Core(shape) => Bound::new(py, $Class(shape)).map(Bound::into_any),)*
                    other => Err(PyTypeError::new_err(format!("shape {} has no class", other.name()))),
                }
            }
        }

        /// Adds the classes.
        pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(module.add_class::<$Class>()?;)*
            module.add_class::<PyPiece>()
        }
    };
}

shapes! {
    /// A box with its centre in the origin and its edges along x, y and z.
    ///
    /// Parameters
    /// ----------
    /// half_extents : 3 numbers
    ///     Half of each edge's length [m].
    class "Cuboid" PyCuboid(Cuboid) (half_extents) as "(half_extents)" {
        /// Half of each edge's length [m].
        half_extents: [f64; 3],
    }

    /// A ball with its centre in the origin.
    ///
    /// Parameters
    /// ----------
    /// radius : float
    ///     Radius [m].
    class "Sphere" PySphere(Sphere) (radius) as "(radius)" {
        /// Radius [m].
        radius: f64,
    }

    /// A circular cylinder with its centre in the origin and its axis along z.
    ///
    /// Parameters
    /// ----------
    /// radius : float
    ///     Radius [m].
    /// half_height : float
    ///     Half of its height [m].
    class "Cylinder" PyCylinder(Cylinder) (radius, half_height) as "(radius, half_height)" {
        /// Radius [m].
        radius: f64,
        /// Half of its height [m].
        half_height: f64,
    }

    /// A cylinder along z with a half sphere on each end, its centre in the origin.
    ///
    /// Parameters
    /// ----------
    /// radius : float
    ///     Radius of the cylinder and of the half spheres [m].
    /// half_height : float
    ///     Half of the cylinder's height, without the half spheres [m]; 0 makes a ball.
    class "Capsule" PyCapsule(Capsule) (radius, half_height) as "(radius, half_height)" {
        /// Radius of the cylinder and of the half spheres [m].
        radius: f64,
        /// Half of the cylinder's height, without the half spheres [m].
        half_height: f64,
    }

    /// A circular cone along z: its apex at z = half_height, its base at z = −half_height.
    ///
    /// The origin is half way up; the centre of mass lies lower, at z = −half_height/2.
    ///
    /// Parameters
    /// ----------
    /// radius : float
    ///     Radius of the base [m].
    /// half_height : float
    ///     Half of its height [m].
    class "Cone" PyCone(Cone) (radius, half_height) as "(radius, half_height)" {
        /// Radius of the base [m].
        radius: f64,
        /// Half of its height [m].
        half_height: f64,
    }

    /// The ellipsoid (x/a)² + (y/b)² + (z/c)² ≤ 1.
    ///
    /// Parameters
    /// ----------
    /// semi_axes : 3 numbers
    ///     Its semi-axes a, b, c along x, y and z [m].
    class "Ellipsoid" PyEllipsoid(Ellipsoid) (semi_axes) as "(semi_axes)" {
        /// Its semi-axes along x, y and z [m].
        semi_axes: [f64; 3],
    }

    /// All points with normal · x ≤ offset: a floor, a wall, a slope.
    ///
    /// The normal points out of the solid. It need not have unit length; the condition stands as
    /// written. A half space has no mass, so its body must be fixed.
    ///
    /// Parameters
    /// ----------
    /// normal : 3 numbers
    ///     Normal of the surface, out of the solid [-]; not zero.
    /// offset : float
    ///     Value of normal · x on the surface [m, for a normal of unit length].
    class "HalfSpace" PyHalfSpace(HalfSpace) (normal, offset) as "(normal, offset)" {
        /// Normal of the surface, out of the solid [-].
        normal: [f64; 3],
        /// Value of normal · x on the surface [m, for a normal of unit length].
        offset: f64,
    }

    /// A solid enclosed by flat faces; convex or not, of one part or several, cavities included.
    ///
    /// Parameters
    /// ----------
    /// vertices : (n, 3) numbers
    ///     Vertices [m]; unused ones are allowed.
    /// faces : lists of vertex numbers
    ///     Faces, each as three or more numbers of vertices (from 0), counterclockwise seen from
    ///     outside.
    class "Polyhedron" PyPolyhedron(Polyhedron) (vertices, faces) as "(vertices, faces)" {
        /// Vertices [m].
        vertices: Vec<[f64; 3]>,
        /// Faces, each as numbers of vertices (from 0), counterclockwise seen from outside.
        faces: Vec<Vec<usize>>,
    }

    /// A closed surface in an STL or OBJ file, in the file's own axes.
    ///
    /// The file is read where it is needed: by mass_properties, and by a scene's add, compile and run.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file, ending in .stl or .obj.
    /// scale : float
    ///     Metres per unit of the file [m]: 0.001 for millimetres.
    class "Mesh" PyMesh(Mesh) (path, scale=1.0) as "(path, scale=1.0)" {
        /// The file.
        path: PathBuf,
        /// Metres per unit of the file [m].
        scale: f64,
    }

    /// Several shapes, each placed in the compound's axes, joined into one rigid shape.
    ///
    /// Where pieces overlap, their matter counts twice.
    ///
    /// Parameters
    /// ----------
    /// pieces : list of Piece or shape
    ///     The pieces; at least one. A bare shape stands in the compound's axes.
    class "Compound" PyCompound(Compound) (pieces) as "(pieces)" {
        /// The pieces.
        pieces: Vec<Piece>,
    }
}

impl Plain for Shape {
    type Value = AnyShape;

    fn to_python(&self) -> AnyShape {
        AnyShape(self.clone())
    }

    fn from_python(value: AnyShape) -> Result<Self> {
        Ok(value.0)
    }
}

plain_class! {
    /// One shape of a Compound and where it stands.
    ///
    /// Parameters
    /// ----------
    /// shape : a shape
    ///     The shape, in its own axes.
    /// position : 3 numbers
    ///     Where the origin of the shape's axes stands in the compound's [m].
    /// orientation : 4 numbers
    ///     Rotation (w, x, y, z) from the shape's axes to the compound's; a unit quaternion.
    class "Piece" PyPiece(Piece)
    (shape, position=Numbers([0.0; 3]), orientation=Numbers([1.0, 0.0, 0.0, 0.0]))
    as "(shape, position=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0))"
    {
        /// The shape, in its own axes.
        shape: Shape,
        /// Where the origin of the shape's axes stands in the compound's [m].
        position: [f64; 3],
        /// Rotation (w, x, y, z) from the shape's axes to the compound's.
        orientation: [f64; 4],
    }
}

/// A piece, or a bare shape in the place of one.
#[derive(Debug, Clone)]
pub(crate) struct AnyPiece(Piece);

impl<'py> FromPyObject<'_, 'py> for AnyPiece {
    type Error = PyErr;

    fn extract(obj: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        match obj.cast::<PyPiece>() {
            Ok(piece) => Ok(Self(piece.get().0.clone())),
            Err(_) => Ok(Self(Piece::new(obj.extract::<AnyShape>()?.0))),
        }
    }
}

impl<'py> IntoPyObject<'py> for AnyPiece {
    type Target = PyPiece;
    type Output = Bound<'py, PyPiece>;
    type Error = PyErr;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Self::Output> {
        Bound::new(py, PyPiece(self.0))
    }
}

impl Plain for Piece {
    type Value = AnyPiece;

    fn to_python(&self) -> AnyPiece {
        AnyPiece(self.clone())
    }

    fn from_python(value: AnyPiece) -> Result<Self> {
        Ok(value.0)
    }
}
