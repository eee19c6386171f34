//! How the meshes, profiles and pictures that a scene names are found and read, each once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::{Image, ImageSource, IntensityProfile, MeshSource, ProfileSource, TriangleMesh, Value};

use crate::{ies, image, model};

/// The files of one scene, by the path that the text names, and why some cannot be had.
#[derive(Debug, Clone, Default)]
pub(crate) struct Files {
    base: Option<PathBuf>,
    meshes: Known<TriangleMesh>,
    profiles: Known<IntensityProfile>,
    images: Known<Image>,
}

/// What is known of files of one kind.
type Known<T> = HashMap<String, Result<Arc<T>, String>>;

impl Files {
    /// Files whose relative paths start at `base`; without it only absolute paths are found.
    pub(crate) fn new(base: Option<&Path>) -> Self {
        Self { base: base.map(Path::to_owned), ..Self::default() }
    }

    /// The mesh at `path`, read now or before.
    pub(crate) fn mesh(&mut self, path: &str) -> Result<MeshSource, String> {
        let mesh =
            get(&mut self.meshes, self.base.as_deref(), path, |file| model::read_mesh(file).map(Arc::new))?;
        Ok(MeshSource { path: path.to_owned(), mesh })
    }

    /// The intensity profile at `path`, read now or before.
    pub(crate) fn profile(&mut self, path: &str) -> Result<ProfileSource, String> {
        let profile =
            get(&mut self.profiles, self.base.as_deref(), path, |file| ies::read(file).map(Arc::new))?;
        Ok(ProfileSource { path: path.to_owned(), profile })
    }

    /// The picture at `path`, read now or before.
    pub(crate) fn image(&mut self, path: &str) -> Result<ImageSource, String> {
        let image = get(&mut self.images, self.base.as_deref(), path, image::load)?;
        Ok(ImageSource { path: path.to_owned(), image })
    }

    /// Where all pictures that are known lie.
    pub(crate) fn image_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.images.keys().filter_map(|path| place(self.base.as_deref(), path))
    }

    /// Where all meshes that are known lie.
    pub(crate) fn mesh_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.meshes.keys().filter_map(|path| place(self.base.as_deref(), path))
    }

    /// Where all profiles that are known lie.
    pub(crate) fn profile_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.profiles.keys().filter_map(|path| place(self.base.as_deref(), path))
    }

    /// Takes the file behind a value, if there is one, as read.
    pub(crate) fn know(&mut self, value: &Value) {
        match value {
            Value::Mesh(source) => {
                self.meshes.insert(source.path.clone(), Ok(Arc::clone(&source.mesh)));
            }
            Value::Profile(source) => {
                self.profiles.insert(source.path.clone(), Ok(Arc::clone(&source.profile)));
            }
            Value::Image(source) => {
                self.images.insert(source.path.clone(), Ok(Arc::clone(&source.image)));
            }
            _ => {}
        }
    }
}

fn get<T, E: ToString>(
    known: &mut Known<T>,
    base: Option<&Path>,
    path: &str,
    read: impl Fn(&Path) -> Result<Arc<T>, E>,
) -> Result<Arc<T>, String> {
    if let Some(known) = known.get(path) {
        return known.clone();
    }
    let Some(file) = place(base, path) else {
        return Err(format!("{path}: the scene lies in no folder from which to find it"));
    };
    let found = read(&file).map_err(|e| e.to_string());
    known.insert(path.to_owned(), found.clone());
    found
}

/// Where a file lies.
fn place(base: Option<&Path>, path: &str) -> Option<PathBuf> {
    match base {
        Some(base) => Some(base.join(path)),
        None => Some(PathBuf::from(path)).filter(|path| path.is_absolute()),
    }
}
