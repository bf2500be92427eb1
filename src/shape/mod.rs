//! Shapes as plain data: what a scene file holds, checked only when asked.
//!
//! One shape, one file. Each states its origin and its axes; body axes are shape axes. Lengths are in
//! metres. In a file a shape is a table under its name:
//!
//! ```toml
//! shape.cuboid.half_extents = [0.01, 0.01, 0.01]
//! ```
//!
//! A shape can tell its [mass properties](Shape::mass_properties), its
//! [reach](Shape::bounding_radius) and, where its faces are flat, its [vertices](Shape::vertices):
//!
//! ```
//! use bryla::shape::Cuboid;
//!
//! let die = Cuboid::new([0.01; 3]).mass_properties(1200.0)?;
//! assert!((die.mass - 0.0096).abs() < 1e-15);
//! assert_eq!(die.inertia[(0, 0)], die.principal_moments()[0]);
//! # Ok::<(), bryla::Error>(())
//! ```

mod capsule;
mod compound;
mod cone;
mod cuboid;
mod cylinder;
mod ellipsoid;
mod half_space;
mod mesh;
mod polyhedron;
mod sphere;

pub use compound::Piece;

use std::path::Path;

use crate::error::{Error, Result};
use crate::mass::MassProperties;
use crate::math::Vector3;

/// What every shape can tell.
trait Solid {
    /// Refuses what is no such shape.
    fn validate(&self, place: &str) -> Result<()>;

    /// Checks the shape and works out its mass properties at a checked density [kg/m³].
    fn matter(&self, place: &str, density: f64) -> Result<MassProperties>;

    /// Distance [m] from a point of the shape's axes to the farthest point, or more.
    fn bounding_radius(&self, about: &Vector3) -> f64;

    /// Vertices [m], where all faces are flat.
    fn vertices(&self) -> Option<Vec<Vector3>> {
        None
    }
}

/// The list of shapes. A line here, `mod` above and a file of that name make a shape; the file holds
/// the struct, its `new` and its [`Solid`].
macro_rules! shapes {
    ($($(#[$doc:meta])* $Shape:ident => $name:ident,)*) => {
        $(pub use $name::$Shape;)*

        /// Any shape.
        #[derive(Debug, Clone, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[non_exhaustive]
        pub enum Shape {
            $($(#[$doc])* $Shape($Shape),)*
        }

        impl Shape {
            /// The names of all shapes, as in files.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($name)),*];

            /// The shape's name, as in files.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$Shape(_) => stringify!($name),)*
                }
            }

            fn solid(&self) -> &dyn Solid {
                match self {
                    $(Self::$Shape(shape) => shape,)*
                }
            }
        }

        $(
            impl $Shape {
                /// The shape's name, as in files.
                pub fn name(&self) -> &'static str {
                    stringify!($name)
                }
            }

            impl From<$Shape> for Shape {
                fn from(shape: $Shape) -> Self {
                    Self::$Shape(shape)
                }
            }
        )*

        tells!(Shape, $($Shape),*);
    };
}

/// The methods that `Shape` and each of the shapes have.
macro_rules! tells {
    ($($Shape:ident),*) => {
        $(impl $Shape {
            /// Refuses what is no such shape: lengths that are not positive and finite, surfaces that
            /// enclose nothing, files that cannot be read.
            ///
            /// # Errors
            /// Names `place`, such as `body die`, the field and the value.
            pub fn validate(&self, place: &str) -> Result<()> {
                Solid::validate(self, place)
            }

            /// Mass, centre of mass and inertia at a uniform `density` [kg/m³], in shape axes.
            ///
            /// # Errors
            /// As `validate`; a density that is not positive and finite; a half space, which is
            /// infinite; sizes whose mass or moments leave the range of `f64`. The place named is the
            /// shape's name.
            pub fn mass_properties(&self, density: f64) -> Result<MassProperties> {
                require_positive(self.name(), "density", density)?;
                let found = self.matter(self.name(), density)?;
                found.validate(self.name())?;
                Ok(found)
            }

            /// Distance [m] from the point `about` [m], in shape axes, to the shape's farthest point,
            /// to rounding (4 ε); of an ellipsoid an upper bound. Infinite for a half space, and for a
            /// mesh that is not [loaded](Shape::loaded).
            pub fn bounding_radius(&self, about: &Vector3) -> f64 {
                Solid::bounding_radius(self, about)
            }

            /// The vertices [m] of a shape whose faces are flat, in shape axes; `None` for others and
            /// for a mesh that is not [loaded](Shape::loaded). A cuboid's corners: x runs fastest, then
            /// y, then z, each from its negative end.
            pub fn vertices(&self) -> Option<Vec<Vector3>> {
                Solid::vertices(self)
            }
        })*
    };
}

shapes! {
    /// A box.
    Cuboid => cuboid,
    /// A ball.
    Sphere => sphere,
    /// A circular cylinder.
    Cylinder => cylinder,
    /// A cylinder with a half sphere on each end.
    Capsule => capsule,
    /// A circular cone.
    Cone => cone,
    /// An ellipsoid.
    Ellipsoid => ellipsoid,
    /// All of space on one side of a plane, such as a floor.
    HalfSpace => half_space,
    /// A solid with flat faces, convex or not.
    Polyhedron => polyhedron,
    /// A polyhedron in a file.
    Mesh => mesh,
    /// Several shapes joined into one.
    Compound => compound,
}

impl Solid for Shape {
    fn validate(&self, place: &str) -> Result<()> {
        self.solid().validate(place)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.solid().matter(place, density)
    }

    fn bounding_radius(&self, about: &Vector3) -> f64 {
        self.solid().bounding_radius(about)
    }

    fn vertices(&self) -> Option<Vec<Vector3>> {
        self.solid().vertices()
    }
}

impl Shape {
    /// The same shape with every mesh, also within a compound, read from its file: what follows
    /// needs no files. Relative paths start at `folder`.
    ///
    /// # Errors
    /// [`Error::File`], naming the file.
    pub fn loaded(&self, folder: &Path) -> Result<Self> {
        match self {
            Self::Mesh(mesh) => Ok(mesh.read(folder)?.into()),
            Self::Compound(compound) => Ok(compound.loaded(folder)?.into()),
            other => Ok(other.clone()),
        }
    }
}

/// Refuses a length or density that is not positive and finite.
fn require_positive(place: &str, field: &'static str, value: f64) -> Result<()> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::value(place, field, "positive and finite", value))
}

/// Refuses three lengths that are not all positive and finite.
fn require_all_positive(place: &str, field: &'static str, values: [f64; 3]) -> Result<()> {
    if values.iter().all(|&x| x > 0.0 && x.is_finite()) {
        return Ok(());
    }
    Err(Error::value(place, field, "three positive finite lengths", values))
}

/// Refuses three coordinates that are not all finite.
fn require_finite(place: &str, field: &'static str, values: [f64; 3]) -> Result<()> {
    if values.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    Err(Error::value(place, field, "finite", values))
}

/// Distance [m] of a point from the z axis.
fn off_axis(p: &Vector3) -> f64 {
    libm::hypot(p.x, p.y)
}
