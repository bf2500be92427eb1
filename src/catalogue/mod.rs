//! Ready scenes: the same files as in `examples/scenes`, one line each in the list below.

use crate::error::Result;
use crate::scene::Scene;
use crate::scene::file::Format;

/// Declares the scenes: one line adds one, its name being that of the file.
macro_rules! catalogue {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// The names of the scenes.
        pub const NAMES: &[&str] = &[$(stringify!($name),)*];

        /// The text of a scene's file.
        pub fn text(name: &str) -> Option<&'static str> {
            match name {
                $(stringify!($name) => Some(include_str!(concat!("../../examples/scenes/", stringify!($name), ".toml"))),)*
                _ => None,
            }
        }

        $(
            $(#[$doc])*
            ///
            /// # Errors
            /// None, unless the file was changed into something that is no scene.
            pub fn $name() -> Result<Scene> {
                Scene::from_text(include_str!(concat!("../../examples/scenes/", stringify!($name), ".toml")), Format::Toml)
            }
        )*

        /// The scene of this name, if there is one.
        pub fn scene(name: &str) -> Option<Result<Scene>> {
            match name {
                $(stringify!($name) => Some($name()),)*
                _ => None,
            }
        }
    };
}

catalogue! {
    /// The lecture's hovercraft (§6): three engines with a schedule that drives turns, and drag, in a plane.
    hovercraft,
    /// The same hovercraft in an arena with four walls: it bounces off them, in its plane.
    hovercraft_walls,
    /// A book thrown spinning about its middle axis: it flips, though nothing pushes it.
    spinning_book,
    /// A cone on its tip: it precesses and nods.
    heavy_top,
    /// A ball against the air: quadratic drag and a cross wind.
    thrown_ball,
    /// A lander that falls on its engine: a switch holds its speed until it touches the ground, where the run ends.
    lander,
    /// A die thrown on a table; the span ends before its bounces accumulate.
    bouncing_die,
    /// Five dice thrown on a table with walls: they hit each other, roll out, and come to rest.
    dice,
}
