//! A polyhedron in a file: STL or OBJ.

use std::path::{Path, PathBuf};

use super::{Polyhedron, Solid, require_positive};
use crate::error::{Error, Result};
use crate::mass::MassProperties;
use crate::math::Vector3;

/// A closed surface in an STL or OBJ file, in the file's own axes.
///
/// Vertices of equal coordinates are one vertex: STL repeats them for every triangle, OBJ for every
/// object. Nothing else is repaired; see [`Polyhedron`] for what a surface must be. STL holds 24 binary
/// digits (`f32`), which is how accurate its solid is. Reading needs the feature `mesh`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Mesh {
    /// The file, ending in `.stl` or `.obj`.
    pub path: PathBuf,
    /// Metres per unit of the file [m]: 0.001 for millimetres.
    #[cfg_attr(feature = "serde", serde(default = "metres"))]
    pub scale: f64,
}

/// One metre a unit.
#[cfg(feature = "serde")]
fn metres() -> f64 {
    1.0
}

impl Mesh {
    /// The surface in the file at `path`, of `scale` metres a unit.
    pub fn new(path: impl Into<PathBuf>, scale: f64) -> Self {
        Self { path: path.into(), scale }
    }

    /// Reads the file; a relative path starts at `folder`. The surface is not checked yet.
    ///
    /// # Errors
    /// [`Error::File`], naming the file; a scale that is not positive and finite.
    pub fn read(&self, folder: &Path) -> Result<Polyhedron> {
        let path = folder.join(&self.path);
        let shown = path.display().to_string();
        require_positive(&shown, "scale", self.scale)?;
        let surface = file::read(&path).map_err(|reason| Error::File { path: shown, reason })?;
        Ok(Polyhedron { vertices: surface.vertices.iter().map(|v| v.map(|x| self.scale * x)).collect(), ..surface })
    }
}

impl Solid for Mesh {
    /// Reads the file, a relative path starting at the working folder.
    fn validate(&self, place: &str) -> Result<()> {
        self.read(Path::new(""))?.validate(place)
    }

    fn matter(&self, place: &str, density: f64) -> Result<MassProperties> {
        self.read(Path::new(""))?.matter(place, density)
    }

    fn bounding_radius(&self, _about: &Vector3) -> f64 {
        f64::INFINITY
    }
}

/// Without the feature `mesh` no file can be read.
#[cfg(not(feature = "mesh"))]
mod file {
    use super::{Path, Polyhedron};

    pub(super) fn read(_path: &Path) -> Result<Polyhedron, String> {
        Err("reading meshes needs the feature mesh of bryla".into())
    }
}

#[cfg(feature = "mesh")]
mod file {
    use std::collections::HashMap;
    use std::fs::File;
    use std::io::BufReader;

    use super::{Path, Polyhedron};

    /// The surface in a file, in its own unit.
    pub(super) fn read(path: &Path) -> Result<Polyhedron, String> {
        let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
        let surface = match ending.as_str() {
            "stl" => read_stl(path)?,
            "obj" => read_obj(path)?,
            _ => return Err("a mesh file must end in .stl or .obj".into()),
        };
        if surface.faces.is_empty() {
            return Err("holds no faces".into());
        }
        Ok(surface)
    }

    fn read_stl(path: &Path) -> Result<Polyhedron, String> {
        let file = File::open(path).map_err(|e| e.to_string())?;
        let mesh = stl_io::read_stl(&mut BufReader::new(file)).map_err(|e| e.to_string())?;
        let mut surface = Welded::default();
        for triangle in mesh.faces {
            surface.add_face(triangle.vertices.map(|v| mesh.vertices[v].0.map(f64::from)));
        }
        Ok(surface.polyhedron)
    }

    fn read_obj(path: &Path) -> Result<Polyhedron, String> {
        let file = File::open(path).map_err(|e| e.to_string())?;
        let options = tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..Default::default() };
        // materials say nothing about the shape
        let no_materials = |_: &Path| Ok(Default::default());
        let (objects, _) =
            tobj::load_obj_buf(&mut BufReader::new(file), &options, no_materials).map_err(|e| e.to_string())?;

        let mut surface = Welded::default();
        for mesh in objects.iter().map(|object| &object.mesh) {
            let (points, _) = mesh.positions.as_chunks::<3>();
            let mut corners = mesh.indices.iter().map(|&v| points[v as usize]);
            let triangles = vec![3; mesh.indices.len() / 3];
            let arities = if mesh.face_arities.is_empty() { &triangles } else { &mesh.face_arities };
            for &arity in arities {
                surface.add_face(corners.by_ref().take(arity as usize));
            }
        }
        Ok(surface.polyhedron)
    }

    /// A surface under construction, in which points of equal coordinates are one vertex.
    struct Welded {
        polyhedron: Polyhedron,
        numbers: HashMap<[u64; 3], usize>,
    }

    impl Default for Welded {
        fn default() -> Self {
            Self { polyhedron: Polyhedron::new([], []), numbers: HashMap::new() }
        }
    }

    impl Welded {
        fn add_face(&mut self, corners: impl IntoIterator<Item = [f64; 3]>) {
            let vertices = &mut self.polyhedron.vertices;
            let mut number = |corner: [f64; 3]| {
                // −0 is 0
                let point = corner.map(|x| x + 0.0);
                *self.numbers.entry(point.map(f64::to_bits)).or_insert_with(|| {
                    vertices.push(point);
                    vertices.len() - 1
                })
            };
            let face = corners.into_iter().map(&mut number).collect();
            self.polyhedron.faces.push(face);
        }
    }
}
