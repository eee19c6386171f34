//! How is a file called until it is complete, and what does it take over from the one that it replaces?

use std::fs::{self, File, Metadata, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// The name of a file that is removed unless it is [moved](Self::move_to) to its place.
pub(super) struct Passing(PathBuf);

impl Passing {
    /// Makes a file in the folder of `target`. Its name is short and its own, so that any name that the target may have
    /// will do; nobody else may read it while it stands in for a file that they perhaps may not read either.
    pub(super) fn beside(target: &Path, old: Option<&Metadata>) -> io::Result<(Self, File)> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        loop {
            let number = COUNT.fetch_add(1, Ordering::Relaxed);
            let path = target.with_file_name(format!(".catoptra-{}-{number}.part", std::process::id()));
            match options(old).open(&path) {
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                Err(e) => return Err(e),
                Ok(file) => return Ok((Self(path), file)),
            }
        }
    }

    /// Puts the file in its place.
    pub(super) fn move_to(mut self, target: &Path) -> io::Result<()> {
        fs::rename(&self.0, target)?;
        // The name stands for nothing any more.
        self.0 = PathBuf::new();
        Ok(())
    }
}

impl Drop for Passing {
    fn drop(&mut self) {
        if self.0.as_os_str().is_empty() {
            return;
        }
        // Whatever went wrong before is the error to tell; a file that cannot be removed either is left.
        let _ = fs::remove_file(&self.0);
    }
}

#[cfg(unix)]
fn options(old: Option<&Metadata>) -> OpenOptions {
    use std::os::unix::fs::OpenOptionsExt;

    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    if old.is_some() {
        options.mode(0o600);
    }
    options
}

#[cfg(not(unix))]
fn options(_old: Option<&Metadata>) -> OpenOptions {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    options
}

/// Gives a new file the owner and the permissions of the old one, as far as the system lets it. Where the owner or the
/// group cannot be kept, the new one gets no right to run as the old.
#[cfg(unix)]
pub(super) fn keep(old: &Metadata, file: &File) {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};

    let kept = |new: &Metadata| (new.uid(), new.gid()) == (old.uid(), old.gid());
    let Ok(new) = file.metadata() else { return };
    let kept = kept(&new)
        || fchown(file, Some(old.uid()), Some(old.gid())).is_ok()
        || (fchown(file, None, Some(old.gid())).is_ok() && new.uid() == old.uid());
    let mode = old.mode() & if kept { 0o7777 } else { 0o777 };
    let _ = file.set_permissions(fs::Permissions::from_mode(mode));
}

#[cfg(not(unix))]
pub(super) fn keep(old: &Metadata, file: &File) {
    let _ = file.set_permissions(old.permissions());
}
