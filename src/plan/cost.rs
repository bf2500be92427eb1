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

/// Where the shipped figures were measured: least of 25 repetitions of 400 steps in the thread's processor time,
/// optimised build.
const SHIPPED_MACHINE: &str = "Intel Xeon, x86_64, linux, two shared cores";

/// Method, and time of a step in the order of [`BodyKind::ALL`]: only its end looked at; its motion kept [ns].
#[rustfmt::skip]
const SHIPPED: &[(Method, [f64; 5], [f64; 5])] = &[
    (Method::Euler, [71.0, 120.0, 112.0, 117.0, 108.0], [240.0, 268.0, 271.0, 243.0, 213.0]),
    (Method::Heun, [114.0, 191.0, 208.0, 231.0, 179.0], [258.0, 371.0, 372.0, 327.0, 293.0]),
    (Method::SemiImplicitEuler, [131.0, 165.0, 185.0, 124.0, 158.0], [294.0, 328.0, 348.0, 266.0, 265.0]),
    (Method::Rk4, [107.0, 362.0, 351.0, 388.0, 347.0], [260.0, 499.0, 519.0, 471.0, 464.0]),
    (Method::Tsit5, [223.0, 535.0, 539.0, 526.0, 543.0], [466.0, 772.0, 736.0, 669.0, 913.0]),
    (Method::Dop853, [467.0, 1087.0, 1166.0, 1061.0, 1541.0], [1065.0, 2306.0, 1578.0, 1449.0, 2238.0]),
    (Method::Split2, [273.0, 463.0, 430.0, 251.0, 442.0], [470.0, 727.0, 682.0, 529.0, 1019.0]),
    (Method::Split4, [1311.0, 1603.0, 1541.0, 849.0, 1639.0], [1675.0, 1824.0, 2379.0, 1079.0, 2043.0]),
    (Method::Split6, [1902.0, 3351.0, 2619.0, 1224.0, 2913.0], [2200.0, 3072.0, 3138.0, 1480.0, 3146.0]),
    (Method::Split8, [3583.0, 4714.0, 4893.0, 2240.0, 5337.0], [3814.0, 5088.0, 5196.0, 2348.0, 5644.0]),
    (Method::Axes2, [288.0, 478.0, 476.0, 243.0, 468.0], [478.0, 726.0, 729.0, 506.0, 683.0]),
    (Method::Cf4, [621.0, 730.0, 725.0, 344.0, 564.0], [782.0, 926.0, 859.0, 474.0, 655.0]),
    (Method::Buss2, [322.0, 358.0, 362.0, 210.0, 271.0], [461.0, 521.0, 639.0, 320.0, 375.0]),
    (Method::Radau5, [12500.0, 13180.0, 7285.0, 3295.0, 28380.0], [15310.0, 13550.0, 7148.0, 3454.0, 25855.0]),
    (Method::Taylor, [421.0, 413.0, 500.0, 282.0, 343.0], [1023.0, 847.0, 757.0, 651.0, 801.0]),
    (Method::Dmv, [424.0, 503.0, 463.0, 143.0, 442.0], [582.0, 699.0, 587.0, 241.0, 561.0]),
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
