//! Why a model file is refused, and where in it.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::printable::{brief, printable};

/// Of longer messages the middle is left out, in characters.
const LONGEST: usize = 300;

/// Where in a model file something stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line of a text file (or of a binary file's header), counted from 1.
    Line(usize),
    /// A byte of a binary file, counted from 0.
    Byte(usize),
}

/// A model file that cannot be used. Reads `bunny.ply:12: …` or `bunny.ply, byte 1024: …`.
#[derive(Debug, thiserror::Error)]
#[cfg_attr(feature = "text", derive(miette::Diagnostic), diagnostic(code(catoptra::model)))]
#[error("{}{}: {}", printable(&path.to_string_lossy()), place, brief(message, LONGEST))]
pub struct ModelError {
    path: PathBuf,
    place: Place,
    message: String,
}

impl ModelError {
    pub(super) fn new(path: &Path, fault: Fault) -> Self {
        Self { path: path.to_owned(), place: fault.place, message: fault.message }
    }

    pub(super) fn unreadable(path: &Path, cause: &std::io::Error) -> Self {
        Self::new(path, Fault::new(Place::File, format!("cannot be read: {cause}")))
    }

    /// The file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.path
    }

    /// Where in the file.
    #[must_use]
    pub fn place(&self) -> Place {
        self.place
    }

    /// The line, from 1, where the file is text.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        match self.place {
            Place::Line(line) => Some(line),
            Place::File | Place::Byte(_) => None,
        }
    }

    /// What is wrong, without the place; as the file spells it, controls included.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }
}

/// As it stands behind the name of the file.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(line) => write!(f, ":{line}"),
            Self::Byte(byte) => write!(f, ", byte {byte}"),
        }
    }
}

/// An error before it knows its file.
#[derive(Debug)]
pub(super) struct Fault {
    place: Place,
    message: String,
}

impl Fault {
    pub(super) fn new(place: Place, message: impl fmt::Display) -> Self {
        Self { place, message: message.to_string() }
    }
}
