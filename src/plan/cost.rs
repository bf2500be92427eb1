//! What a step costs.
//!
//! A table holds the time of one step of one body, by method and by what kind of body it is: the kinds are compiled
//! apart. The shipped one was measured on the machine that it names; `bryla calibrate` measures another. Costs only
//! tell how long a run will take. Which method a plan takes does not depend on them, so that a scene has the same
//! bits on every machine.

use crate::freedom::Freedom;
use crate::integrator::Method;

use super::{FlightGroup, PlannedBody};

/// Time of a step for each kind of body [s].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct StepCosts {
    /// A free body on which nothing acts.
    pub free: f64,
    /// A free body under an effect.
    pub loaded: f64,
    /// A top.
    pub pivot: f64,
    /// A body in a plane.
    pub planar: f64,
    /// One of several bodies that share a clock, or of any other kind.
    pub grouped: f64,
}

/// What the steps of a method cost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct MethodCosts {
    /// The method.
    pub method: Method,
    /// A step of which only the end is looked at.
    pub step: StepCosts,
    /// A step whose motion is kept.
    pub kept: StepCosts,
}

/// What the steps of all methods cost, on some machine.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct CostTable {
    /// The machine that it was measured on.
    pub machine: String,
    /// All methods that take steps.
    pub methods: Vec<MethodCosts>,
}

/// What kind of body a step is taken of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyKind {
    /// See [`StepCosts::free`].
    Free,
    /// See [`StepCosts::loaded`].
    Loaded,
    /// See [`StepCosts::pivot`].
    Pivot,
    /// See [`StepCosts::planar`].
    Planar,
    /// See [`StepCosts::grouped`].
    Grouped,
}

impl BodyKind {
    /// Every kind.
    pub const ALL: &'static [Self] = &[Self::Free, Self::Loaded, Self::Pivot, Self::Planar, Self::Grouped];

    /// The kind of a group's bodies.
    pub(crate) fn of(group: &FlightGroup, bodies: &[PlannedBody]) -> Self {
        match group.members.as_slice() {
            [only] => match (&bodies[*only].freedom, group.bindings.is_empty()) {
                (Freedom::Free, true) => Self::Free,
                (Freedom::Free, false) => Self::Loaded,
                (Freedom::Pivot(_), _) => Self::Pivot,
                (Freedom::Planar(_), _) => Self::Planar,
                (Freedom::Axle(_), _) => Self::Grouped,
            },
            _ => Self::Grouped,
        }
    }
}

impl StepCosts {
    /// Time of a step of a body of this kind [s].
    pub fn of(&self, kind: BodyKind) -> f64 {
        match kind {
            BodyKind::Free => self.free,
            BodyKind::Loaded => self.loaded,
            BodyKind::Pivot => self.pivot,
            BodyKind::Planar => self.planar,
            BodyKind::Grouped => self.grouped,
        }
    }
}

impl CostTable {
    /// The table that comes with the library.
    pub fn shipped() -> Self {
        let costs = |[free, loaded, pivot, planar, grouped]: [f64; 5]| {
            let ns = 1.0e-9;
            StepCosts {
                free: ns * free,
                loaded: ns * loaded,
                pivot: ns * pivot,
                planar: ns * planar,
                grouped: ns * grouped,
            }
        };
        let row = |&(method, step, kept): &(Method, [f64; 5], [f64; 5])| MethodCosts {
            method,
            step: costs(step),
            kept: costs(kept),
        };
        Self { machine: SHIPPED_MACHINE.to_owned(), methods: SHIPPED.iter().map(row).collect() }
    }

    /// Time of a step of a body [s], whose motion is kept or not; none for the closed form.
    pub fn step(&self, method: Method, kind: BodyKind, kept: bool) -> Option<f64> {
        let costs = self.methods.iter().find(|costs| costs.method == method)?;
        Some(if kept { costs.kept } else { costs.step }.of(kind))
    }
}

/// Where the shipped figures were measured: least of 225 repetitions of 200 steps in the thread's processor time,
/// optimised build.
const SHIPPED_MACHINE: &str = "Intel Xeon, x86_64, linux, two shared cores";

/// Method, and time of a step in the order of [`BodyKind::ALL`]: only its end looked at; its motion kept [ns].
#[rustfmt::skip]
const SHIPPED: &[(Method, [f64; 5], [f64; 5])] = &[
    (Method::Euler, [48.1, 70.5, 98.5, 35.6, 124.0], [228.0, 239.0, 239.0, 145.0, 214.0]),
    (Method::Heun, [88.8, 144.0, 192.0, 65.4, 272.0], [335.0, 408.0, 455.0, 246.0, 470.0]),
    (Method::SemiImplicitEuler, [124.0, 162.0, 193.0, 77.1, 256.0], [392.0, 445.0, 284.0, 203.0, 266.0]),
    (Method::Rk4, [66.6, 175.0, 118.0, 111.0, 385.0], [241.0, 346.0, 339.0, 283.0, 672.0]),
    (Method::Tsit5, [218.0, 261.0, 248.0, 188.0, 918.0], [488.0, 531.0, 511.0, 379.0, 1320.0]),
    (Method::Dop853, [643.0, 707.0, 479.0, 412.0, 1260.0], [1190.0, 1270.0, 804.0, 700.0, 2380.0]),
    (Method::Split2, [281.0, 392.0, 410.0, 134.0, 673.0], [510.0, 627.0, 707.0, 345.0, 1060.0]),
    (Method::Split4, [1390.0, 1750.0, 1620.0, 382.0, 2420.0], [1720.0, 2110.0, 1940.0, 597.0, 2840.0]),
    (Method::Split6, [2460.0, 3030.0, 2830.0, 630.0, 4160.0], [2790.0, 2970.0, 2690.0, 722.0, 3750.0]),
    (Method::Split8, [4590.0, 5670.0, 5320.0, 1130.0, 5990.0], [4310.0, 5130.0, 4930.0, 1170.0, 6700.0]),
    (Method::Axes2, [341.0, 489.0, 423.0, 134.0, 709.0], [645.0, 837.0, 728.0, 351.0, 1080.0]),
    (Method::Cf4, [634.0, 655.0, 772.0, 141.0, 731.0], [924.0, 941.0, 1070.0, 322.0, 810.0]),
    (Method::Buss2, [303.0, 320.0, 379.0, 68.2, 352.0], [470.0, 488.0, 645.0, 233.0, 637.0]),
    (Method::Radau5, [14100.0, 12300.0, 5540.0, 2470.0, 30200.0], [14000.0, 13300.0, 7760.0, 3730.0, 31400.0]),
    (Method::Taylor, [457.0, 737.0, 850.0, 377.0, 439.0], [1060.0, 1510.0, 1490.0, 1210.0, 1440.0]),
    (Method::Dmv, [588.0, 809.0, 588.0, 228.0, 593.0], [959.0, 931.0, 754.0, 568.0, 747.0]),
];

#[cfg(feature = "serde")]
mod file {
    use std::path::{Path, PathBuf};

    use super::CostTable;
    use crate::error::{Error, Result};

    impl CostTable {
        /// Where the user's own table is kept: `bryla/costs.toml` in the folder for configuration. None where the
        /// system does not tell that folder.
        pub fn user_path() -> Option<PathBuf> {
            let folder = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
            let config = folder("XDG_CONFIG_HOME").or_else(|| folder("APPDATA"));
            let config = config.or_else(|| folder("HOME").map(|home| home.join(".config")))?;
            Some(config.join("bryla").join("costs.toml"))
        }

        /// The user's own table, else the shipped one.
        ///
        /// # Errors
        /// A file that is there, but is no table.
        pub fn of_user() -> Result<Self> {
            match Self::user_path().filter(|path| path.exists()) {
                Some(path) => Self::load(path),
                None => Ok(Self::shipped()),
            }
        }

        /// Reads a table from a file.
        ///
        /// # Errors
        /// A file that cannot be read, or is no table.
        pub fn load(path: impl AsRef<Path>) -> Result<Self> {
            let refused = |reason: String| Error::File { path: path.as_ref().display().to_string(), reason };
            let text = std::fs::read_to_string(path.as_ref()).map_err(|error| refused(error.to_string()))?;
            toml::from_str(&text).map_err(|error| refused(error.to_string().trim_end().to_owned()))
        }

        /// Writes the table to a file, for which folders are made.
        ///
        /// # Errors
        /// A file that cannot be written.
        pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
            let path = path.as_ref();
            let refused = |reason: String| Error::File { path: path.display().to_string(), reason };
            let text = toml::to_string(self).map_err(|error| refused(error.to_string()))?;
            if let Some(folder) = path.parent() {
                std::fs::create_dir_all(folder).map_err(|error| refused(error.to_string()))?;
            }
            std::fs::write(path, text).map_err(|error| refused(error.to_string()))
        }
    }
}
