//! How the meshes that a scene names are found and read, each once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::{MeshSource, TriangleMesh};

use crate::mesh;

/// The meshes of one scene, by the path that the text names.
#[derive(Debug, Clone, Default)]
pub(crate) struct Meshes {
    base: Option<PathBuf>,
    known: HashMap<String, Arc<TriangleMesh>>,
}

impl Meshes {
    /// Meshes whose relative paths start at `base`; without it only absolute paths are found.
    pub(crate) fn new(base: Option<&Path>) -> Self {
        Self { base: base.map(Path::to_owned), known: HashMap::new() }
    }

    /// The mesh at `path`, read now or before.
    pub(crate) fn get(&mut self, path: &str) -> Result<MeshSource, String> {
        if let Some(mesh) = self.known.get(path) {
            return Ok(MeshSource { path: path.to_owned(), mesh: Arc::clone(mesh) });
        }
        let file = match &self.base {
            Some(base) => base.join(path),
            None if Path::new(path).is_absolute() => PathBuf::from(path),
            None => return Err(format!("{path}: the scene lies in no folder from which to find it")),
        };
        let mesh = Arc::new(mesh::read(&file).map_err(|e| e.to_string())?);
        let source = MeshSource { path: path.to_owned(), mesh };
        self.know(&source);
        Ok(source)
    }

    /// Takes a mesh as read.
    pub(crate) fn know(&mut self, source: &MeshSource) {
        self.known.insert(source.path.clone(), Arc::clone(&source.mesh));
    }
}
