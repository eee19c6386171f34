//! What becomes of a file that is dropped on the window, other than that it is opened: a picture is put on the selected shape, a
//! model into the scene. Both are read on threads of their own.

pub(crate) mod model;
pub(crate) mod picture;

use std::path::{MAIN_SEPARATOR_STR, Path};

/// A path as the scene names it: relative to its folder if it lies there, else whole.
pub(crate) fn written(path: &Path, folder: &Path) -> Result<String, String> {
    let whole = |path: &Path| std::path::absolute(path).map_err(|e| format!("{}: {e}", path.display()));
    let (file, folder) = (whole(path)?, whole(&Path::new(".").join(folder))?);
    let text = file.strip_prefix(&folder).unwrap_or(&file).to_str();
    let text = text.ok_or_else(|| format!("{}: scene text cannot spell this name", path.display()))?;
    Ok(text.replace(MAIN_SEPARATOR_STR, "/"))
}
