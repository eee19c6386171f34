//! What is kept of edits that were not saved when the viewer was told to end, and how does the next start find it? Scene
//! text in a folder of the person's, with a first line that says whose edits they are.

use std::io;
use std::path::{Path, PathBuf};

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
        // If it cannot be removed it is offered again; nothing is lost.
        let _ = std::fs::remove_file(&self.place);
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

/// Keeps a text in that folder.
///
/// # Errors
/// What the disk refuses, and paths that text cannot spell.
pub(crate) fn keep(folder: &Path, origin: &Origin, text: &str) -> io::Result<PathBuf> {
    let (begins, path) = match origin {
        Origin::File(path) => (OF_FILE, path),
        Origin::Folder(path) => (IN_FOLDER, path),
    };
    let path = std::path::absolute(path)?;
    let spelled =
        path.to_str().filter(|path| !path.contains(['\n', '\r'])).ok_or(io::ErrorKind::InvalidInput)?;
    std::fs::create_dir_all(folder)?;
    let place = crate::document::free_name(folder, &format!("{}", std::process::id()), ENDING);
    let whole = format!("{begins}{spelled}\n{text}");
    catoptra_scene::atomic::write(&place, |out| io::Write::write_all(out, whole.as_bytes()))?;
    Ok(place)
}

/// All edits that are kept in that folder, the latest last.
pub(crate) fn all(folder: &Path) -> Vec<Kept> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let files = entries.filter_map(Result::ok).map(|entry| entry.path());
    let ours = files.filter(|path| path.extension().is_some_and(|ending| ending == ENDING));
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

    #[test]
    fn what_is_kept_is_found_and_forgotten() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("state");
        assert!(all(&inner).is_empty());
        let origins = [Origin::File("/a/room.kdl".into()), Origin::Folder("/b".into())];
        for (origin, text) in origins.iter().zip(["one\ntwo\n", ""]) {
            keep(&inner, origin, text).unwrap();
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
        let place = keep(&state, &Origin::File(file.clone()), "").unwrap();
        let kept = &all(&state)[0];
        assert!(!kept.is_older_than_its_file(), "there is none");
        std::fs::write(&file, "").unwrap();
        let long_ago = std::time::SystemTime::UNIX_EPOCH;
        std::fs::File::options().write(true).open(&place).unwrap().set_modified(long_ago).unwrap();
        assert!(kept.is_older_than_its_file());
    }
}
