//! Where does a model file find the files that it names: pictures, materials, buffers?

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex};

/// The folder of a model file.
#[derive(Debug, Clone, Default)]
pub struct Folder {
    path: Option<PathBuf>,
    is_bare: bool,
    /// All files that were asked for; its clones share it.
    asked: Arc<Mutex<BTreeSet<PathBuf>>>,
}

impl Folder {
    /// The folder that a file lies in.
    #[must_use]
    pub fn of(file: &Path) -> Self {
        Self { path: Some(file.parent().unwrap_or(Path::new("")).to_owned()), ..Self::default() }
    }

    /// No folder: nothing is found in it. For files that came as bytes.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// The same for someone who wants shapes alone, for whom materials and pictures need not be read.
    #[must_use]
    pub fn for_shapes_alone(self) -> Self {
        Self { is_bare: true, ..self }
    }

    /// Whether materials and pictures are wanted.
    #[must_use]
    pub fn wants_materials(&self) -> bool {
        !self.is_bare
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
        Ok(self.noted(if is_plain { folder.join(name) } else { name }))
    }

    /// Where all files lie that were asked for so far.
    pub(super) fn asked(&self) -> Vec<PathBuf> {
        self.asked.lock().map_or_else(|_| Vec::new(), |asked| asked.iter().cloned().collect())
    }

    fn noted(&self, place: PathBuf) -> PathBuf {
        if let Ok(mut asked) = self.asked.lock() {
            asked.insert(place.clone());
        }
        place
    }

    /// Where a file lies that may have been named on another machine: as it is named, or else in other case, or else by its
    /// last name alone in the folder itself.
    ///
    /// # Errors
    /// There is no such file.
    pub fn find(&self, name: &str) -> Result<PathBuf, String> {
        let place = self.place(name)?;
        if place.is_file() {
            return Ok(place);
        }
        let folder = self.path.clone().unwrap_or_default();
        let name_parts = name.split(['/', '\\']).filter(|part| !part.is_empty());
        let last = name_parts.clone().next_back().into_iter().collect();
        let found = in_any_case(&folder, name_parts.collect()).or_else(|| in_any_case(&folder, last));
        found.map(|place| self.noted(place)).ok_or_else(|| format!("{name} is not there"))
    }

    /// The bytes of a file that is named relative to the folder.
    ///
    /// # Errors
    /// There is no folder, or the file cannot be read or is none: a folder, a pipe, a device.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        let place = self.place(name)?;
        if place.exists() && !place.is_file() {
            return Err(format!("{name} is no file"));
        }
        std::fs::read(place).map_err(|cause| format!("{name} cannot be read: {cause}"))
    }
}

/// A file below a folder, by names whose case need not be right.
fn in_any_case(folder: &Path, names: Vec<&str>) -> Option<PathBuf> {
    let mut place = folder.to_owned();
    for name in names {
        let next = place.join(name);
        place = if matches!(name, "." | "..") || next.exists() {
            next
        } else {
            let here = if place.as_os_str().is_empty() { Path::new(".") } else { &place };
            let entries = std::fs::read_dir(here).ok()?;
            let alike = |entry: &std::fs::DirEntry| {
                entry.file_name().to_string_lossy().to_lowercase() == name.to_lowercase()
            };
            entries.filter_map(Result::ok).find(alike)?.path()
        };
    }
    place.is_file().then_some(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_named_on_other_machines_are_found() {
        let outer = tempfile::tempdir().unwrap();
        let inner = outer.path().join("Maps");
        std::fs::create_dir(&inner).unwrap();
        std::fs::write(inner.join("Wood.PNG"), "a").unwrap();
        std::fs::write(outer.path().join("stone.png"), "b").unwrap();
        let folder = Folder::of(&outer.path().join("a.obj"));
        let wood = Ok(inner.join("Wood.PNG"));
        for name in ["Maps/Wood.PNG", "maps\\wood.png", "./MAPS/wood.png"] {
            assert_eq!(folder.find(name), wood, "{name}");
        }
        let stone = Ok(outer.path().join("stone.png"));
        for name in ["stone.png", "C:\\Users\\someone\\Stone.png", "/home/someone/stone.png"] {
            assert_eq!(folder.find(name), stone, "{name}");
        }
        for name in ["wood.png", "", "maps", "."] {
            assert!(folder.find(name).is_err(), "{name}");
        }
        assert!(Folder::none().find("stone.png").is_err());
        assert!(folder.asked().contains(&inner.join("Wood.PNG")), "{:?}", folder.asked());
    }

    #[test]
    fn what_is_no_file_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let folder = Folder::of(&folder.path().join("a.obj"));
        assert_eq!(folder.read("."), Err(". is no file".to_owned()));
        assert!(folder.read("a.mtl").is_err_and(|message| message.contains("cannot be read")));
    }
}
