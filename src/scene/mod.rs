//! The description of what is there: plain data, to and from a file.
//!
//! Nothing runs unasked: there is no gravity, no drag and no floor unless one is added.

use std::path::Path;

use crate::effect::AnyEffect;
use crate::error::{Error, Result};

pub mod body;
pub mod event;
#[cfg(feature = "serde")]
pub mod file;
pub mod options;

pub use body::{Body, Response};
pub use event::{Direction, UserEvent};
pub use options::{Finder, Orientation, Record, RunOptions, Span};

/// Bodies, what acts on them, and how to run them.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Scene {
    /// The bodies, each with a name of its own.
    #[cfg_attr(feature = "serde", serde(default))]
    pub bodies: Vec<Body>,
    /// What acts on them.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub effects: Vec<AnyEffect>,
    /// How to run the scene, where a run does not say otherwise.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "RunOptions::is_default"))]
    pub run: RunOptions,
}

/// A body of a scene, as [`Scene::add`] returned it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BodyId(pub(crate) usize);

impl BodyId {
    /// The place of the body in the scene's list, and along the body axis of every array.
    pub fn index(self) -> usize {
        self.0
    }
}

impl Scene {
    /// An empty scene.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a body.
    ///
    /// # Errors
    /// A name that is taken, or a field of the body that must not be as it is.
    pub fn add(&mut self, body: Body) -> Result<BodyId> {
        body.validate()?;
        if self.bodies.iter().any(|other| other.name == body.name) {
            return Err(Error::value("scene", "body name", "one that no other body has", body.name));
        }
        self.bodies.push(body);
        Ok(BodyId(self.bodies.len() - 1))
    }

    /// Adds what acts on bodies. Its bodies need not be there yet: compiling the scene looks for them.
    pub fn add_effect(&mut self, effect: impl Into<AnyEffect>) {
        self.effects.push(effect.into());
    }

    /// The body of this name.
    ///
    /// # Errors
    /// No body has it.
    pub fn id(&self, name: &str) -> Result<BodyId> {
        self.find(name, "scene", "body name")
    }

    /// The body that a field of `place` names.
    pub(crate) fn find(&self, name: &str, place: &str, field: &'static str) -> Result<BodyId> {
        self.bodies.iter().position(|body| body.name == name).map(BodyId).ok_or_else(|| {
            let names: Vec<_> = self.bodies.iter().map(|body| body.name.as_str()).collect();
            let known = match names.len() {
                0 => "are no bodies".to_owned(),
                1 => format!("is {}", names[0]),
                _ => format!("are {}", names.join(", ")),
            };
            Error::UnknownName { place: place.to_owned(), field, name: name.to_owned(), known }
        })
    }

    /// The same scene with every mesh read from its file; relative paths start at `folder`.
    pub(crate) fn loaded(mut self, folder: &Path) -> Result<Self> {
        for shape in self.bodies.iter_mut().filter_map(|body| body.shape.as_mut()) {
            *shape = shape.loaded(folder)?;
        }
        Ok(self)
    }

    /// How messages call the effect at a place of the list.
    pub(crate) fn effect_place(&self, index: usize) -> String {
        format!("effect {} ({})", index + 1, self.effects[index].name())
    }
}
