//! How a file is written so that a reader, or a crash, never meets half of it.
//!
//! A file is written beside its place under a passing name and moved there when it is complete. A link stays a link and
//! leads to the new file; what was replaced leaves its permissions and, where the system allows it, its owner. Other
//! names of a replaced file (hard links) keep the old content, so nothing is lost. A file that nobody may write is
//! refused, as is a folder. What is no file, such as a device, a pipe or `/dev/stdout`, stays what it is and takes the
//! bytes as they come.

mod passing;
mod place;

use std::fs::{File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use passing::Passing;
use place::Place;
pub use place::{FileId, identity, is_descriptor};

/// Writes a file whole or not at all: if anything fails, what stood at `path` stands there still, and nothing is left
/// beside it. The bytes are on the disk when it returns. What is no file takes the bytes as they come.
///
/// # Errors
/// Whatever [`check`], the file system or `write` refuses.
pub fn write(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    match Place::of(path)? {
        Place::File { path, old } => replace(&path, old.as_ref(), write),
        Place::Sink(sink) => fill(sink.open()?, write).map(drop),
    }
}

/// Tries whether `path` can be written, and leaves everything as it is: a file is made beside it and removed again.
///
/// # Errors
/// A folder that is missing or may not be written, a file that is read-only, a name that is too long, links that go
/// round in a circle, and all else that can be known beforehand.
pub fn check(path: &Path) -> io::Result<()> {
    match Place::of(path)? {
        Place::File { path, old } => {
            place::check_file(&path, old.as_ref())?;
            Passing::beside(&path, old.as_ref()).map(drop).map_err(|cause| {
                let folder = place::folder_of(&path);
                io::Error::new(
                    cause.kind(),
                    format!("the folder {} takes no file: {cause}", folder.display()),
                )
            })
        }
        Place::Sink(sink) => sink.check(),
    }
}

/// Whether bytes for `path` go straight to a device, a pipe or an open descriptor, which may let the writer wait.
#[must_use]
pub fn is_straight(path: &Path) -> bool {
    matches!(Place::of(path), Ok(Place::Sink(_)))
}

fn replace(
    path: &Path,
    old: Option<&Metadata>,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    place::check_file(path, old)?;
    let (passing, file) = Passing::beside(path, old)?;
    let file = fill(file, write)?;
    if let Some(old) = old {
        passing::keep(old, &file);
    }
    file.sync_all()?;
    passing.move_to(path)
}

fn fill(file: File, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<File> {
    let mut out = BufWriter::new(file);
    let written = write(&mut out).and_then(|()| out.flush());
    // What a failed write has left in the buffer is not tried again.
    let (file, _) = out.into_parts();
    written.map(|()| file)
}

#[cfg(test)]
mod tests;
