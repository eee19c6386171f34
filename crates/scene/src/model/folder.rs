//! Where does a model file find the files that it names: pictures, materials, buffers?

use std::path::{Component, Path, PathBuf};

/// The folder of a model file.
#[derive(Debug, Clone, Default)]
pub struct Folder {
    path: Option<PathBuf>,
}

impl Folder {
    /// The folder that a file lies in.
    #[must_use]
    pub fn of(file: &Path) -> Self {
        Self { path: Some(file.parent().unwrap_or(Path::new("")).to_owned()) }
    }

    /// No folder: nothing is found in it. For files that came as bytes.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// Where a file lies that is named relative to the folder. Backslashes, as Windows writes them, are as good as slashes.
    ///
    /// # Errors
    /// There is no folder.
    pub fn place(&self, name: &str) -> Result<PathBuf, String> {
        let Some(folder) = &self.path else {
            return Err(format!("{name} cannot be found: there is no folder"));
        };
        let name = PathBuf::from(name.replace('\\', "/"));
        let is_plain = !name.components().any(|part| matches!(part, Component::Prefix(_)));
        Ok(if is_plain { folder.join(name) } else { name })
    }

    /// The bytes of a file that is named relative to the folder.
    ///
    /// # Errors
    /// There is no folder, or the file cannot be read.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        std::fs::read(self.place(name)?).map_err(|cause| format!("{name} cannot be read: {cause}"))
    }
}
