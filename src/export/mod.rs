//! Runs and tables for other programs: one format, one file.
//!
//! Every format writes the same list of [`arrays`], so that a name means the same in all of them.

use std::fs;
use std::path::Path;

use crate::error::{Error, Result};
use crate::trajectory::Trajectory;

mod csv;
#[cfg(feature = "figure")]
pub mod figure;
#[cfg(feature = "serde")]
mod json;
#[cfg(feature = "npz")]
mod npz;

/// One quantity at every sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Its name, the same as in Python.
    pub name: &'static str,
    /// Its shape: samples, or samples × bodies × components.
    pub shape: Vec<usize>,
    /// Names of the components; empty for a number.
    pub components: &'static [&'static str],
    /// The numbers, last index fastest.
    pub data: Vec<f64>,
}

/// Everything a run tells at its samples: time, state and rates of every body, energies of the scene.
///
/// # Errors
/// As [`Trajectory::energy`].
pub fn arrays(run: &Trajectory) -> Result<Vec<Array>> {
    const XYZ: &[&str] = &["x", "y", "z"];
    let (n, bodies) = (run.times().len(), run.plan().bodies().len());
    let mut columns: [Vec<f64>; 6] = Default::default();
    for sample in 0..n {
        for (motion, state) in run.motions(sample).iter().zip(run.states(sample)) {
            columns[0].extend(state.position.iter());
            columns[1].extend(crate::math::quaternion::to_scalar_first(&state.orientation));
            columns[2].extend(motion.velocity.iter());
            columns[3].extend(motion.angular_velocity.iter());
            columns[4].extend(state.linear_momentum.iter());
            columns[5].extend(state.angular_momentum.iter());
        }
    }
    let [position, orientation, velocity, angular_velocity, linear, angular] = columns;
    let vector = |name, data| Array { name, shape: vec![n, bodies, 3], components: XYZ, data };
    let number = |name, data| Array { name, shape: vec![n], components: &[], data };
    let energy = run.energy()?;
    Ok(vec![
        number("t", run.times().to_vec()),
        vector("position", position),
        Array { name: "orientation", shape: vec![n, bodies, 4], components: &["w", "x", "y", "z"], data: orientation },
        vector("velocity", velocity),
        vector("angular_velocity", angular_velocity),
        vector("linear_momentum", linear),
        vector("spin_angular_momentum", angular),
        number("kinetic_energy", energy.kinetic),
        number("potential_energy", energy.potential),
        number("dissipated_energy", energy.dissipated),
        number("work", energy.work),
    ])
}

impl Trajectory {
    /// The endings of file that [`write`](Self::write) knows in this build.
    pub const FORMATS: &'static [&'static str] = &[
        "csv",
        #[cfg(feature = "serde")]
        "json",
        #[cfg(feature = "npz")]
        "npz",
    ];

    /// Writes the samples to a file, in the format that its ending names.
    ///
    /// # Errors
    /// An ending that is not known, a file that cannot be written, and as [`Trajectory::energy`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let refused = |reason: String| Error::File { path: path.display().to_string(), reason };
        let bytes = match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => csv::write(self)?.into_bytes(),
            #[cfg(feature = "serde")]
            Some("json") => json::write(self)?.into_bytes(),
            #[cfg(feature = "npz")]
            Some("npz") => npz::write(self).map_err(|error| refused(error.to_string()))?,
            _ => {
                let endings = Self::FORMATS.iter().map(|f| format!(".{f}")).collect::<Vec<_>>().join(", ");
                return Err(refused(format!("a trajectory is written as one of {endings}")));
            }
        };
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder).map_err(|error| refused(error.to_string()))?;
        }
        fs::write(path, bytes).map_err(|error| refused(error.to_string()))
    }
}
