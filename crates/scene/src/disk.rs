//! Does a file still hold what was read from it, or written to it last?

use std::io::ErrorKind;
use std::path::Path;

/// How a scene's file compares with what was read from it, or written to it, last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OnDisk {
    /// It is the same, byte for byte, whatever its times say.
    Same,
    /// It holds something else, or can no longer be read.
    Changed,
    /// It is not there, or the scene has no file yet.
    Missing,
}

/// Compares the file at `path` with its last known content.
pub(crate) fn compare(path: &Path, known: &[u8]) -> OnDisk {
    match std::fs::metadata(path) {
        Err(e) if e.kind() == ErrorKind::NotFound => OnDisk::Missing,
        Ok(file) if file.is_file() && file.len() == known.len() as u64 => {
            if std::fs::read(path).is_ok_and(|bytes| bytes == known) { OnDisk::Same } else { OnDisk::Changed }
        }
        _ => OnDisk::Changed,
    }
}
