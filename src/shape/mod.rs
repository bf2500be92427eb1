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
pub mod convex_polygon;
pub mod convex_polyhedron;
mod cuboid;
mod cylinder;
mod ellipsoid;
mod half_space;
pub mod hull;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// One of each; the match keeps the list complete.
    fn one_of_each() -> Vec<Shape> {
        let tetrahedron = Polyhedron::new(
            [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]].map(Vec::from),
        );
        let all: Vec<Shape> = vec![
            Cuboid::new([1.0, 2.0, 3.0]).into(),
            Sphere::new(0.5).into(),
            Cylinder::new(0.5, 2.0).into(),
            Capsule::new(0.5, 2.0).into(),
            Cone::new(0.5, 2.0).into(),
            Ellipsoid::new([1.0, 2.0, 3.0]).into(),
            HalfSpace::new([0.0, 0.0, 1.0], -1.0).into(),
            tetrahedron.into(),
            Mesh::new("wrench.stl", 0.001).into(),
            Compound::new([Piece::new(Sphere::new(1.0)).position([0.0, 0.0, 2.0])]).into(),
        ];
        assert_eq!(all.iter().map(Shape::name).collect::<Vec<_>>(), Shape::NAMES, "a shape lacks its test");
        all
    }

    #[test]
    #[cfg(feature = "serde")]
    fn a_file_holds_each_shape_under_its_name_and_gives_it_back() {
        for shape in one_of_each() {
            let text = toml::to_string(&shape).unwrap();
            let value: toml::Table = toml::from_str(&text).unwrap();
            assert_eq!(value.keys().collect::<Vec<_>>(), [shape.name()]);
            assert_eq!(toml::from_str::<Shape>(&text).unwrap(), shape);
            assert_eq!(serde_json::from_str::<Shape>(&serde_json::to_string(&shape).unwrap()).unwrap(), shape);

            // a field that no shape has
            let mut value = value;
            value[shape.name()].as_table_mut().unwrap().insert("colour".into(), 1.into());
            let refusal = toml::from_str::<Shape>(&value.to_string()).unwrap_err().to_string();
            assert!(refusal.contains("unknown field `colour`"), "{refusal}");
        }
    }

    #[test]
    #[cfg(feature = "serde")]
    fn a_piece_and_a_mesh_may_leave_out_what_has_a_natural_value() {
        let text = "[[compound.pieces]]\nshape.sphere.radius = 1.0\n[[compound.pieces]]\nshape.mesh.path = 'a.obj'";
        let expected = Compound::new([Piece::new(Sphere::new(1.0)), Piece::new(Mesh::new("a.obj", 1.0))]);
        assert_eq!(toml::from_str::<Shape>(text).unwrap(), expected.into());
    }

    #[test]
    #[cfg(feature = "schema")]
    fn the_schema_names_every_shape() {
        let schema = serde_json::to_string(&schemars::schema_for!(Shape)).unwrap();
        for name in Shape::NAMES {
            assert!(schema.contains(&format!("\"required\":[\"{name}\"]")), "{name}: {schema}");
        }
    }

    #[test]
    fn sizes_that_no_shape_has_are_refused_by_name_and_value() {
        let refused: [(Shape, &str); 22] = [
            (
                Cuboid::new([1.0, 0.0, 1.0]).into(),
                "half_extents must be three positive finite lengths, got [1.0, 0.0, 1.0]",
            ),
            (Sphere::new(-1.0).into(), "radius must be positive and finite, got -1.0"),
            (Sphere::new(f64::NAN).into(), "radius must be positive and finite, got NaN"),
            (Sphere::new(f64::INFINITY).into(), "radius must be positive and finite, got inf"),
            (Cylinder::new(0.0, 1.0).into(), "radius must be positive and finite, got 0.0"),
            (Cylinder::new(1.0, 0.0).into(), "half_height must be positive and finite, got 0.0"),
            (Capsule::new(0.0, 1.0).into(), "radius must be positive and finite, got 0.0"),
            (Capsule::new(1.0, -0.5).into(), "half_height must be finite and not negative, got -0.5"),
            (Capsule::new(1.0, f64::NAN).into(), "half_height must be finite and not negative, got NaN"),
            (Cone::new(-2.0, 1.0).into(), "radius must be positive and finite, got -2.0"),
            (Cone::new(1.0, f64::NAN).into(), "half_height must be positive and finite, got NaN"),
            (
                Ellipsoid::new([1.0, 1.0, -1.0]).into(),
                "semi_axes must be three positive finite lengths, got [1.0, 1.0, -1.0]",
            ),
            (HalfSpace::new([0.0; 3], 0.0).into(), "normal must be a vector with a direction, got [0.0, 0.0, 0.0]"),
            (HalfSpace::new([0.0, f64::NAN, 1.0], 0.0).into(), "normal must be finite, got [0.0, NaN, 1.0]"),
            (HalfSpace::new([0.0, 0.0, 1.0], f64::NAN).into(), "offset must be finite, got NaN"),
            (Polyhedron::new([], []).into(), "has no faces"),
            (Compound::new([]).into(), "a compound needs at least one piece"),
            (
                Compound::new([Piece::new(Sphere::new(1.0)), Piece::new(Sphere::new(-1.0))]).into(),
                "radius must be positive and finite, got -1.0",
            ),
            (
                Compound::new([Piece::new(HalfSpace::new([0.0, 0.0, 1.0], 0.0))]).into(),
                "a half space is infinite and cannot be a piece",
            ),
            (
                Compound::new([Piece::new(Sphere::new(1.0)).position([0.0, f64::NAN, 0.0])]).into(),
                "position must be finite, got [0.0, NaN, 0.0]",
            ),
            (
                Compound::new([Piece::new(Sphere::new(1.0)).orientation([0.5, 0.0, 0.0, 0.0])]).into(),
                "orientation must be a unit quaternion (w, x, y, z), got [0.5, 0.0, 0.0, 0.0]",
            ),
            (
                Compound::new([Piece::new(Sphere::new(1.0)).orientation([f64::NAN, 0.0, 0.0, 0.0])]).into(),
                "orientation must be a unit quaternion (w, x, y, z), got [NaN, 0.0, 0.0, 0.0]",
            ),
        ];
        for (shape, reason) in refused {
            let place = match &shape {
                Shape::Compound(compound) if !compound.pieces.is_empty() => {
                    format!("body die, piece {}", compound.pieces.len() - 1)
                }
                _ => "body die".into(),
            };
            assert_eq!(shape.validate("body die").unwrap_err().to_string(), format!("{place}: {reason}"));
            assert!(shape.mass_properties(1.0).is_err(), "{shape:?}");
        }
    }

    #[test]
    fn densities_and_masses_out_of_range_are_refused() {
        for density in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let refusal = Sphere::new(1.0).mass_properties(density).unwrap_err().to_string();
            assert_eq!(refusal, format!("sphere: density must be positive and finite, got {density:?}"));
        }
        let floor = HalfSpace::new([0.0, 0.0, 1.0], 0.0).mass_properties(1.0).unwrap_err().to_string();
        assert_eq!(floor, "half_space: is infinite and has no mass; its body must be fixed");
        // a mass or a moment beyond f64
        let heavy = Sphere::new(1e150).mass_properties(1.0).unwrap_err().to_string();
        assert_eq!(heavy, "sphere: mass must be positive and finite, got inf");
        let light = Sphere::new(1e-150).mass_properties(1.0).unwrap_err().to_string();
        assert_eq!(light, "sphere: mass must be positive and finite, got 0.0");
        let wide = Sphere::new(1e80).mass_properties(1.0).unwrap_err().to_string();
        assert!(wide.starts_with("sphere: inertia must be finite, got "), "{wide}");
    }

    #[test]
    fn the_plane_of_a_half_space_is_where_its_condition_says() {
        for length in [1e-300, 1.0, 2.0, 1e300] {
            let (n, d) = HalfSpace::new([0.6 * length, 0.0, 0.8 * length], 3.0 * length).plane();
            assert!((n - Vector3::new(0.6, 0.0, 0.8)).amax() < 2.0 * f64::EPSILON, "{n}");
            assert!((d - 3.0).abs() < 8.0 * f64::EPSILON, "{d}");
        }
    }

    #[test]
    fn nothing_of_a_shape_lies_beyond_its_reach_and_something_lies_at_it() {
        // support points in many directions reach the farthest point to their spacing, squared
        let directions: Vec<Vector3> = (0..40)
            .flat_map(|i| (0..80).map(move |j| (f64::from(i) / 39.0, f64::from(j) / 80.0)))
            .map(|(u, v)| (std::f64::consts::PI * u, 2.0 * std::f64::consts::PI * v))
            .map(|(a, b)| Vector3::new(libm::sin(a) * libm::cos(b), libm::sin(a) * libm::sin(b), libm::cos(a)))
            .collect();
        let support = |shape: &Shape, d: &Vector3| -> Vector3 {
            let round = |r: f64| Vector3::new(d.x, d.y, 0.0).try_normalize(0.0).unwrap_or_default() * r;
            let level = |h: f64| Vector3::new(0.0, 0.0, h.copysign(d.z));
            match shape {
                Shape::Sphere(s) => s.radius * d,
                Shape::Cylinder(s) => round(s.radius) + level(s.half_height),
                Shape::Capsule(s) => s.radius * d + level(s.half_height),
                Shape::Cone(s) if d.z > 0.5 => level(s.half_height),
                Shape::Cone(s) => round(s.radius) - Vector3::z() * s.half_height,
                Shape::Ellipsoid(s) => {
                    let a = Vector3::from(s.semi_axes);
                    a.component_mul(&a.component_mul(d).normalize())
                }
                flat => *flat.vertices().unwrap().iter().max_by(|p, q| p.dot(d).total_cmp(&q.dot(d))).unwrap(),
            }
        };
        for shape in one_of_each() {
            if matches!(shape, Shape::HalfSpace(_) | Shape::Mesh(_)) {
                assert!(shape.bounding_radius(&Vector3::zeros()).is_infinite());
                continue;
            }
            let moved = if let Shape::Compound(c) = &shape { c.pieces[0].position.into() } else { Vector3::zeros() };
            let bare = if let Shape::Compound(c) = &shape { c.pieces[0].shape.clone() } else { shape.clone() };
            for about in [Vector3::zeros(), Vector3::new(0.3, -0.2, 0.9), Vector3::new(-5.0, 3.0, -1.0)] {
                let reach = shape.bounding_radius(&about);
                let farthest =
                    directions.iter().map(|d| (support(&bare, d) + moved - about).norm()).fold(0.0, f64::max);
                assert!(farthest <= reach * (1.0 + 4.0 * f64::EPSILON), "{shape:?} about {about}: {farthest} {reach}");
                let exact = !matches!(shape, Shape::Ellipsoid(_)) || about == Vector3::zeros();
                assert!(!exact || farthest > reach * 0.995, "{shape:?} about {about}: {farthest} {reach}");
            }
        }
    }

    #[test]
    fn vertices_are_the_corners_placed() {
        let corners = Cuboid::new([1.0, 2.0, 3.0]).vertices().unwrap();
        assert_eq!(corners[0], Vector3::new(-1.0, -2.0, -3.0));
        assert_eq!(corners[1], Vector3::new(1.0, -2.0, -3.0));
        assert_eq!(corners[6], Vector3::new(-1.0, 2.0, 3.0));
        assert_eq!(Sphere::new(1.0).vertices(), None);

        // a quarter turn about z takes x to y
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let piece = Piece::new(Cuboid::new([1.0, 2.0, 3.0])).position([10.0, 0.0, 0.0]);
        let placed = Compound::new([piece.orientation([half, 0.0, 0.0, half])]);
        let corner = placed.vertices().unwrap()[1];
        assert!((corner - Vector3::new(12.0, 1.0, -3.0)).amax() < 8.0 * f64::EPSILON, "{corner}");
        assert_eq!(Compound::new([Piece::new(Sphere::new(1.0))]).vertices(), None);
    }
}
