//! Which files were opened lately? A line for each in a file of the viewer's own folder, the latest first.

use std::path::{Path, PathBuf};

/// As many as are remembered.
const MOST: usize = 12;

/// The name of the list.
const NAME: &str = "recent";

/// The files that were opened lately and are still there, the latest first.
pub(crate) fn files(state: &Path) -> Vec<PathBuf> {
    let text = std::fs::read_to_string(state.join(NAME)).unwrap_or_default();
    text.lines().map(PathBuf::from).filter(|path| path.is_file()).take(MOST).collect()
}

/// Remembers a file. What cannot be written is not remembered.
pub(crate) fn remember(state: &Path, file: &Path) {
    let Ok(file) = std::path::absolute(file) else { return };
    let others = files(state).into_iter().filter(|other| *other != file);
    let lines: Vec<String> = std::iter::once(file.clone())
        .chain(others)
        .filter_map(|path| path.to_str().filter(|path| !path.contains('\n')).map(|path| format!("{path}\n")))
        .take(MOST)
        .collect();
    if std::fs::create_dir_all(state).is_ok() {
        let written = catoptra_scene::atomic::write(&state.join(NAME), |out| {
            std::io::Write::write_all(out, lines.concat().as_bytes())
        });
        // A list that cannot be written is the old one.
        drop(written);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_latest_file_comes_first_and_once() {
        let folder = tempfile::tempdir().unwrap();
        let state = folder.path().join("state");
        let file = |i: usize| {
            let path = folder.path().join(format!("{i}.kdl"));
            std::fs::write(&path, "").unwrap();
            path
        };
        assert!(files(&state).is_empty());
        for i in [1, 2, 1] {
            remember(&state, &file(i));
        }
        assert_eq!(files(&state), [file(1), file(2)]);
        std::fs::remove_file(file(1)).unwrap();
        assert_eq!(files(&state), [folder.path().join("2.kdl")], "what is gone is not listed");
        (0..20).for_each(|i| remember(&state, &file(i)));
        assert_eq!(files(&state).len(), MOST);
    }
}
