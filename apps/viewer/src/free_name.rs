//! Which name does a folder not hold yet?

use std::path::{Path, PathBuf};

/// The first of `name.ext`, `name-2.ext`, `name-3.ext`... that `folder` does not hold yet.
pub(crate) fn free_name(folder: &Path, name: &str, extension: &str) -> PathBuf {
    let mut path = folder.join(format!("{name}.{extension}"));
    let mut number = 2_u32;
    while path.exists() && number < u32::MAX {
        path = folder.join(format!("{name}-{number}.{extension}"));
        number += 1;
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_name_is_numbered_past_the_taken_ones() {
        let folder = tempfile::tempdir().unwrap();
        assert!(free_name(folder.path(), "a", "png").ends_with("a.png"));
        std::fs::write(folder.path().join("a.png"), "").unwrap();
        std::fs::write(folder.path().join("a-2.png"), "").unwrap();
        assert!(free_name(folder.path(), "a", "png").ends_with("a-3.png"));
    }
}
