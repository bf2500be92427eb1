//! Scenes in files: TOML and JSON, one model.

use std::fs;
use std::path::Path;

use super::Scene;
use crate::effect::AnyEffect;
use crate::error::{Error, Result};

/// The two languages of scene files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// TOML, the one for people.
    Toml,
    /// JSON, the one for programs.
    Json,
}

impl Format {
    /// The format that a file's ending names.
    ///
    /// # Errors
    /// The ending is neither `.toml` nor `.json`.
    pub fn of(path: &Path) -> Result<Self> {
        match path.extension().and_then(|e| e.to_str()) {
            Some("toml") => Ok(Self::Toml),
            Some("json") => Ok(Self::Json),
            _ => Err(file_error(path, "a scene file ends in .toml or .json")),
        }
    }
}

fn file_error(path: &Path, reason: impl Into<String>) -> Error {
    Error::File { path: path.display().to_string(), reason: reason.into() }
}

impl Scene {
    /// Reads a scene from text.
    ///
    /// # Errors
    /// Syntax and unknown names, with the line, a caret and the names that are allowed.
    pub fn from_text(text: &str, format: Format) -> Result<Self> {
        let reason = match format {
            Format::Toml => match toml::from_str(text) {
                Ok(scene) => return Ok(scene),
                Err(error) => error.to_string().trim_end().to_owned(),
            },
            Format::Json => match serde_json::from_str(text) {
                Ok(scene) => return Ok(scene),
                Err(error) => with_caret(text, &error),
            },
        };
        Err(Error::File { path: "scene".to_owned(), reason })
    }

    /// Writes the scene as text.
    ///
    /// # Errors
    /// A user effect, which is code and has no text.
    pub fn to_text(&self, format: Format) -> Result<String> {
        self.check_writable()?;
        match format {
            Format::Toml => toml::to_string(self).map_err(|error| Error::refused("scene", error.to_string())),
            Format::Json => {
                serde_json::to_string_pretty(self).map_err(|error| Error::refused("scene", error.to_string()))
            }
        }
    }

    /// Refuses a scene that has no text.
    pub(crate) fn check_writable(&self) -> Result<()> {
        match self.effects.iter().position(|effect| matches!(effect, AnyEffect::User(_))) {
            Some(index) => {
                Err(Error::refused(self.effect_place(index), "a user effect is code and cannot be written to a file"))
            }
            None => self.run.check_writable(),
        }
    }

    /// Reads a scene from a file; meshes that it names are read too, relative paths
    /// starting beside it.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text), and a file that cannot be read.
    pub fn load(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let format = Format::of(path)?;
        let text = fs::read_to_string(path).map_err(|error| file_error(path, error.to_string()))?;
        let scene = Self::from_text(&text, format).map_err(|error| match error {
            Error::File { reason, .. } => file_error(path, reason),
            other => other,
        })?;
        scene.loaded(path.parent().unwrap_or(Path::new("")))
    }

    /// Writes the scene to a file.
    ///
    /// # Errors
    /// As [`to_text`](Self::to_text), and a file that cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let text = self.to_text(Format::of(path)?)?;
        fs::write(path, text).map_err(|error| file_error(path, error.to_string()))
    }

    /// The JSON Schema of scene files.
    #[cfg(feature = "schema")]
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(Self).to_value()
    }
}

/// A JSON error with the line it is in and a caret under the place, as TOML's errors have them.
fn with_caret(text: &str, error: &serde_json::Error) -> String {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or(&message);
    let source = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
    let margin = " ".repeat(line.to_string().len());
    let caret = " ".repeat(column.saturating_sub(1));
    format!(
        "JSON parse error at line {line}, column {column}\n{margin} |\n{line} | {source}\n{margin} | {caret}^\n{message}"
    )
}
