//! How the meshes that a scene names are found and read, each once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::{MeshSource, TriangleMesh};

use crate::mesh;

/// The meshes of one scene, by the path that the text names, and why some cannot be had.
#[derive(Debug, Clone, Default)]
pub(crate) struct Meshes {
    base: Option<PathBuf>,
    known: HashMap<String, Result<Arc<TriangleMesh>, String>>,
}

impl Meshes {
    /// Meshes whose relative paths start at `base`; without it only absolute paths are found.
    pub(crate) fn new(base: Option<&Path>) -> Self {
        Self { base: base.map(Path::to_owned), known: HashMap::new() }
    }

    /// The mesh at `path`, read now or before.
    pub(crate) fn get(&mut self, path: &str) -> Result<MeshSource, String> {
        if let Some(known) = self.known.get(path) {
            return known.clone().map(|mesh| MeshSource { path: path.to_owned(), mesh });
        }
        let Some(file) = self.place(path) else {
            return Err(format!("{path}: the scene lies in no folder from which to find it"));
        };
        let found = mesh::read(&file).map(Arc::new).map_err(|e| e.to_string());
        self.known.insert(path.to_owned(), found.clone());
        found.map(|mesh| MeshSource { path: path.to_owned(), mesh })
    }

    /// Where a mesh lies.
    fn place(&self, path: &str) -> Option<PathBuf> {
        match &self.base {
            Some(base) => Some(base.join(path)),
            None => Some(PathBuf::from(path)).filter(|path| path.is_absolute()),
        }
    }

    /// Where all that are known lie.
    pub(crate) fn paths(&self) -> impl Iterator<Item = PathBuf> {
        self.known.keys().filter_map(|path| self.place(path))
    }

    /// Takes a mesh as read.
    pub(crate) fn know(&mut self, source: &MeshSource) {
        self.known.insert(source.path.clone(), Ok(Arc::clone(&source.mesh)));
    }
}
