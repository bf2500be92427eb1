//! What bad input is told.

/// A refusal of bad input: it names the place, the field, the value and what is allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A field holds a value that it must not.
    #[error("{place}: {field} must be {allowed}, got {value}")]
    Value {
        /// What the field belongs to, such as `body die`.
        place: String,
        /// The field's name.
        field: &'static str,
        /// What would be accepted.
        allowed: String,
        /// What was given.
        value: String,
    },
    /// A name refers to nothing.
    #[error("{place}: {field} names {name:?}, which is not in the scene; there {known}")]
    UnknownName {
        /// Who refers.
        place: String,
        /// The field that refers.
        field: &'static str,
        /// The name that was not found.
        name: String,
        /// The names there are, as a phrase such as `are floor, die`.
        known: String,
    },
    /// A request that contradicts another, or something this version cannot do.
    #[error("{place}: {reason}")]
    Refused {
        /// What the request belongs to.
        place: String,
        /// Why it cannot be done, and what can.
        reason: String,
    },
    /// A surface that encloses no solid.
    #[error("{place}: {reason}")]
    Mesh {
        /// What the surface belongs to.
        place: String,
        /// What is wrong with it, naming edges or faces.
        reason: String,
    },
    /// A file that cannot be read or written.
    #[error("{path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// What went wrong; for a syntax error the line with a caret.
        reason: String,
    },
}

/// A result whose error is a refusal of bad input.
pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    /// A field of `place` that must be `allowed` but is `value`.
    pub fn value(
        place: impl Into<String>,
        field: &'static str,
        allowed: impl Into<String>,
        value: impl std::fmt::Debug,
    ) -> Self {
        Self::Value { place: place.into(), field, allowed: allowed.into(), value: format!("{value:?}") }
    }

    /// A request of `place` that cannot be granted, because of `reason`.
    pub fn refused(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Refused { place: place.into(), reason: reason.into() }
    }

    /// A surface of `place` that encloses no solid, because of `reason`.
    pub fn mesh(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Mesh { place: place.into(), reason: reason.into() }
    }
}
