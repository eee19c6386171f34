//! Why a value is no valid part of a scene.

use std::fmt;

/// A value that a part refuses: which field, what is required of it, and what it was.
///
/// Reads as a sentence: `radius must be greater than 0, not -1`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{field} {requirement}, not {found}")]
#[non_exhaustive]
pub struct InvalidPart {
    field: &'static str,
    requirement: String,
    found: String,
    hint: Option<String>,
}

impl InvalidPart {
    /// States that `field` does not meet `requirement` (a phrase that starts with "must"), being `found`.
    pub fn new(field: &'static str, requirement: impl Into<String>, found: impl fmt::Display) -> Self {
        Self { field, requirement: requirement.into(), found: found.to_string(), hint: None }
    }

    /// The same, with what to do about it.
    #[must_use]
    pub fn with_hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }

    /// Name of the refused field, as it is spelled in scene text.
    #[must_use]
    pub fn field(&self) -> &'static str {
        self.field
    }

    /// What is required of the field: a phrase that starts with "must".
    #[must_use]
    pub fn requirement(&self) -> &str {
        &self.requirement
    }

    /// What to do about it, as it would be written in scene text.
    #[must_use]
    pub fn hint(&self) -> Option<&str> {
        self.hint.as_deref()
    }
}
