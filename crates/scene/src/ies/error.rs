//! Why an IES file is refused, and where in it.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::printable::{brief, printable};

/// Of longer messages the middle is left out, in characters.
const LONGEST: usize = 300;

/// A place in a text file; both count from 1, columns in bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// The line.
    pub line: usize,
    /// The byte of that line.
    pub column: usize,
}

/// An IES file that cannot be used. Reads `lamp.ies:12:7: …`, or `lamp.ies: …` where the whole file is meant.
#[derive(Debug, thiserror::Error)]
#[cfg_attr(feature = "text", derive(miette::Diagnostic), diagnostic(code(catoptra::ies)))]
#[error("{}{}: {}", printable(&path.to_string_lossy()), at(*place), brief(message, LONGEST))]
pub struct ProfileError {
    path: PathBuf,
    place: Option<Place>,
    message: String,
}

impl ProfileError {
    pub(super) fn new(path: &Path, fault: Fault) -> Self {
        Self { path: path.to_owned(), place: fault.place, message: fault.message }
    }

    /// The file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.path
    }

    /// Where in the file; none where the whole of it is meant.
    #[must_use]
    pub fn place(&self) -> Option<Place> {
        self.place
    }

    /// What is wrong, without the place; as the file spells it, controls included.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }
}

fn at(place: Option<Place>) -> String {
    place.map_or_else(String::new, |place| format!(":{}:{}", place.line, place.column))
}

/// An error before it knows its file.
#[derive(Debug)]
pub(super) struct Fault {
    place: Option<Place>,
    message: String,
}

impl Fault {
    /// Something wrong at a place.
    pub(super) fn at(place: Place, message: impl fmt::Display) -> Self {
        Self { place: Some(place), message: message.to_string() }
    }

    /// Something wrong with the whole file.
    pub(super) fn file(message: impl fmt::Display) -> Self {
        Self { place: None, message: message.to_string() }
    }
}

impl Fault {
    /// The same, with more of what was being read.
    pub(super) fn within(self, what: impl fmt::Display) -> Self {
        Self { message: format!("{} ({what})", self.message), ..self }
    }
}
