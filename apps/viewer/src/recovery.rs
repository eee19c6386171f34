//! What is kept of edits that are not saved, and how does the next start find it? Scene text in a folder of the person's, with
//! a first line that says whose edits they are.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::free_name::free_name;

/// How the first line begins where the edits are those of a file.
const OF_FILE: &str = "// unsaved edits of the file ";

/// How it begins where they are of a scene that has no file; paths in it start from this folder.
const IN_FOLDER: &str = "// unsaved edits in the folder ";

/// How the names of kept texts end.
const ENDING: &str = "kdl";

/// Whose edits they are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Origin {
    /// Of the scene in a file.
    File(PathBuf),
    /// Of a scene without a file, whose paths start from a folder.
    Folder(PathBuf),
}

/// Unsaved edits that were kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Kept {
    /// Where they are kept.
    pub(crate) place: PathBuf,
    /// Whose they are.
    pub(crate) origin: Origin,
}

impl Kept {
    /// The scene as it was.
    ///
    /// # Errors
    /// What kept it from being read.
    pub(crate) fn text(&self) -> io::Result<String> {
        let text = std::fs::read_to_string(&self.place)?;
        Ok(text.split_once('\n').map(|(_, rest)| rest.to_owned()).unwrap_or_default())
    }

    /// Forgets them.
    pub(crate) fn forget(&self) {
        remove(&self.place);
    }

    /// What a person calls the scene.
    pub(crate) fn name(&self) -> String {
        match &self.origin {
            Origin::File(path) => path.display().to_string(),
            Origin::Folder(folder) => format!("a scene without a file in {}", folder.display()),
        }
    }

    /// Whether the scene's file was written after the edits were kept.
    pub(crate) fn is_older_than_its_file(&self) -> bool {
        let time = |path: &Path| std::fs::metadata(path).and_then(|found| found.modified()).ok();
        match &self.origin {
            Origin::File(path) => time(path).zip(time(&self.place)).is_some_and(|(file, kept)| file > kept),
            Origin::Folder(_) => false,
        }
    }
}

/// Where the viewer keeps what it must remember: a folder of its own below that of the person's states.
pub(crate) fn state_folder() -> Option<PathBuf> {
    let ours = directories::ProjectDirs::from("", "", "catoptra")?;
    Some(ours.state_dir().unwrap_or_else(|| ours.data_local_dir()).to_owned())
}

/// The folder of kept edits.
pub(crate) fn folder() -> Option<PathBuf> {
    Some(state_folder()?.join("recovery"))
}

/// A place for the edits of this window, which no other window offers as long as this one lives.
pub(crate) struct Own {
    place: PathBuf,
    /// Locked; the system unlocks it when the window ends, however that is.
    _lock: File,
}

impl Own {
    /// A free place in that folder.
    ///
    /// # Errors
    /// What the disk refuses.
    pub(crate) fn claim(folder: &Path) -> io::Result<Self> {
        std::fs::create_dir_all(folder)?;
        loop {
            let place = free_name(folder, &format!("{}", std::process::id()), ENDING);
            let lock = File::options().create(true).truncate(false).write(true).open(lock_of(&place))?;
            match lock.try_lock() {
                // Another window had the same number, elsewhere, and was faster.
                Err(TryLockError::WouldBlock) => std::thread::sleep(Duration::from_millis(10)),
                // Where files cannot be locked, kept edits are offered while they are still edited: nothing is lost.
                Ok(()) | Err(TryLockError::Error(_)) => return Ok(Self { place, _lock: lock }),
            }
        }
    }

    /// Where the edits are kept.
    pub(crate) fn place(&self) -> &Path {
        &self.place
    }

    /// Keeps a text there.
    ///
    /// # Errors
    /// What the disk refuses, and paths that text cannot spell.
    pub(crate) fn keep(&self, origin: &Origin, text: &str) -> io::Result<()> {
        let (begins, path) = match origin {
            Origin::File(path) => (OF_FILE, path),
            Origin::Folder(path) => (IN_FOLDER, path),
        };
        let path = std::path::absolute(Path::new(".").join(path))?;
        let spelled =
            path.to_str().filter(|path| !path.contains(['\n', '\r'])).ok_or(io::ErrorKind::InvalidInput)?;
        let whole = format!("{begins}{spelled}\n{text}");
        catoptra_scene::atomic::write(&self.place, |out| io::Write::write_all(out, whole.as_bytes()))
    }

    /// Keeps nothing any longer.
    pub(crate) fn forget(self) {
        remove(&self.place);
    }
}

/// Takes away what is kept at a place.
fn remove(place: &Path) {
    // If it cannot be removed it is offered again; nothing is lost.
    let _ = std::fs::remove_file(place);
    let _ = std::fs::remove_file(lock_of(place));
}

/// The file that is locked while a window keeps its edits at a place.
fn lock_of(place: &Path) -> PathBuf {
    place.with_extension("lock")
}

/// Whether the window that keeps its edits at a place still lives.
fn is_alive(place: &Path) -> bool {
    let lock = File::options().write(true).open(lock_of(place));
    lock.is_ok_and(|lock| matches!(lock.try_lock(), Err(TryLockError::WouldBlock)))
}

/// All edits that are kept in that folder and not of windows that still live, the latest last.
pub(crate) fn all(folder: &Path) -> Vec<Kept> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let files = entries.filter_map(Result::ok).map(|entry| entry.path());
    let ours =
        files.filter(|path| path.extension().is_some_and(|ending| ending == ENDING) && !is_alive(path));
    let mut kept: Vec<Kept> =
        ours.filter_map(|place| Some(Kept { origin: origin(&place)?, place })).collect();
    kept.sort_by_key(|kept| std::fs::metadata(&kept.place).and_then(|found| found.modified()).ok());
    kept
}

fn origin(place: &Path) -> Option<Origin> {
    let text = std::fs::read_to_string(place).ok()?;
    let line = text.lines().next()?;
    match (line.strip_prefix(OF_FILE), line.strip_prefix(IN_FOLDER)) {
        (Some(path), _) => Some(Origin::File(path.into())),
        (_, Some(path)) => Some(Origin::Folder(path.into())),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keeps a text as a window does that ends then.
    fn keep(folder: &Path, origin: &Origin, text: &str) -> PathBuf {
        let own = Own::claim(folder).unwrap();
        own.keep(origin, text).unwrap();
        own.place().to_owned()
    }

    #[test]
    fn what_a_living_window_keeps_is_not_offered() {
        let folder = tempfile::tempdir().unwrap();
        let own = Own::claim(folder.path()).unwrap();
        own.keep(&Origin::Folder("/b".into()), "one").unwrap();
        own.keep(&Origin::Folder("/b".into()), "two").unwrap();
        assert!(all(folder.path()).is_empty());
        let place = own.place().to_owned();
        drop(own);
        let kept = all(folder.path());
        assert_eq!((kept.len(), kept[0].text().unwrap().as_str()), (1, "two"));
        assert_eq!(kept[0].place, place);
        let other = Own::claim(folder.path()).unwrap();
        assert_ne!(other.place(), place, "what is there is not written over");
        other.forget();
        kept[0].forget();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn what_is_kept_is_found_and_forgotten() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("state");
        assert!(all(&inner).is_empty());
        let origins = [Origin::File("/a/room.kdl".into()), Origin::Folder("/b".into())];
        for (origin, text) in origins.iter().zip(["one\ntwo\n", ""]) {
            keep(&inner, origin, text);
        }
        std::fs::write(inner.join("other.kdl"), "// something else\n").unwrap();
        let kept = all(&inner);
        assert_eq!(kept.len(), 2);
        let first = kept.iter().find(|kept| kept.origin == origins[0]).unwrap();
        assert_eq!(first.text().unwrap(), "one\ntwo\n");
        assert!(kept.iter().any(|kept| kept.origin == origins[1]));
        kept.iter().for_each(Kept::forget);
        assert!(all(&inner).is_empty());
    }

    #[test]
    fn a_file_that_was_written_later_is_newer() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("room.kdl");
        let state = folder.path().join("state");
        let place = keep(&state, &Origin::File(file.clone()), "");
        let kept = &all(&state)[0];
        assert!(!kept.is_older_than_its_file(), "there is none");
        std::fs::write(&file, "").unwrap();
        let long_ago = std::time::SystemTime::UNIX_EPOCH;
        std::fs::File::options().write(true).open(&place).unwrap().set_modified(long_ago).unwrap();
        assert!(kept.is_older_than_its_file());
    }
}
