//! How the meshes, profiles and pictures that a scene names are found and read, each once.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::{Image, ImageSource, IntensityProfile, MeshSource, ProfileSource, TriangleMesh, Value};

use crate::instance::{self, ModelSource};
use crate::watch::Watch;
use crate::{ies, image, model};

/// The files of one scene, by the path that the text names, and why some cannot be had.
#[derive(Debug, Clone, Default)]
pub(crate) struct Files {
    base: Option<PathBuf>,
    meshes: Known<TriangleMesh>,
    profiles: Known<IntensityProfile>,
    images: Known<Image>,
    models: Known<model::Model>,
    /// What of meshes is not shown as their files mean it.
    mesh_warnings: HashMap<String, Vec<model::Warning>>,
    /// Asked before each file is read.
    pub(crate) watch: Watch,
    /// Files that meshes name.
    mesh_files: BTreeSet<PathBuf>,
}

/// What is known of files of one kind.
type Known<T> = HashMap<String, Result<Arc<T>, String>>;

impl Files {
    /// Files whose relative paths start at `base`; without it only absolute paths are found.
    pub(crate) fn new(base: Option<&Path>) -> Self {
        Self { base: base.map(Path::to_owned), ..Self::default() }
    }

    /// The folder at which relative paths start.
    pub(crate) fn base(&self) -> &Path {
        self.base.as_deref().unwrap_or(Path::new(""))
    }

    /// The same files, read under somebody's eyes.
    pub(crate) fn watched(self, watch: &Watch) -> Self {
        Self { watch: watch.clone(), ..self }
    }

    /// The mesh at `path`, read now or before.
    pub(crate) fn mesh(&mut self, path: &str) -> Result<MeshSource, String> {
        if !self.meshes.contains_key(path)
            && let Some((file, name)) = self.divided(path)
        {
            let source = self.model(file)?;
            let found = instance::mesh_named(&source.model, name).map_err(|e| format!("{file}: {e}"))?;
            self.meshes.insert(path.to_owned(), Ok(found));
        }
        let (mut warnings, files) = (Vec::new(), &mut self.mesh_files);
        let mesh = get(&mut self.meshes, (self.base.as_deref(), &self.watch), path, |file| {
            let (mesh, found, named) = model::read_mesh_and_more(file)?;
            warnings = found;
            files.extend(named);
            Ok::<_, model::ModelError>(Arc::new(mesh))
        })?;
        if !warnings.is_empty() {
            self.mesh_warnings.insert(path.to_owned(), warnings);
        }
        Ok(MeshSource { path: path.to_owned(), mesh })
    }

    /// The intensity profile at `path`, read now or before.
    pub(crate) fn profile(&mut self, path: &str) -> Result<ProfileSource, String> {
        let profile = get(&mut self.profiles, (self.base.as_deref(), &self.watch), path, |file| {
            ies::read(file).map(Arc::new)
        })?;
        Ok(ProfileSource { path: path.to_owned(), profile })
    }

    /// The picture at `path`, read now or before.
    pub(crate) fn image(&mut self, path: &str) -> Result<ImageSource, String> {
        if !self.images.contains_key(path)
            && let Some((file, name)) = self.divided(path)
        {
            let source = self.model(file)?;
            let found = instance::image_named(&source.model, name).map_err(|e| format!("{file}: {e}"))?;
            self.images.insert(path.to_owned(), Ok(found));
        }
        let image = get(&mut self.images, (self.base.as_deref(), &self.watch), path, image::load)?;
        Ok(ImageSource { path: path.to_owned(), image })
    }

    /// The model at `path`, read now or before.
    pub(crate) fn model(&mut self, path: &str) -> Result<ModelSource, String> {
        let model = get(&mut self.models, (self.base.as_deref(), &self.watch), path, |file| {
            model::read(file).map(Arc::new)
        })?;
        Ok(ModelSource { path: path.to_owned(), model })
    }

    /// A path of the form `FILE#NAME` in its two parts, where no file is called so as a whole.
    fn divided<'p>(&self, path: &'p str) -> Option<(&'p str, &'p str)> {
        let is_model = |at: &usize| model::is_named_so(Path::new(&path[..*at]));
        let at = path.match_indices('#').map(|(at, _)| at).find(is_model)?;
        let is_file = place(self.base.as_deref(), path).is_some_and(|file| file.is_file());
        (!is_file).then(|| (&path[..at], &path[at + 1..]))
    }

    /// Where all models that are known lie.
    pub(crate) fn model_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.models.keys().filter_map(|path| place(self.base.as_deref(), path))
    }

    /// What of models and meshes is not shown as their files mean it, in the order of their paths.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let models =
            self.models.iter().filter_map(|(path, model)| Some((path, &model.as_ref().ok()?.warnings)));
        let mut read: Vec<_> = models.chain(&self.mesh_warnings).collect();
        read.sort_by_key(|(path, _)| *path);
        let told =
            |path: &str, warning: &model::Warning| format!("{path}{}: {}", warning.place, warning.message);
        let mut all: Vec<String> =
            read.into_iter().flat_map(|(path, list)| list.iter().map(move |w| told(path, w))).collect();
        // One file may be a model and a mesh.
        let mut seen = HashSet::new();
        all.retain(|line| seen.insert(line.clone()));
        all
    }

    /// Where the files lie that models and meshes name.
    pub(crate) fn companion_paths(&self) -> impl Iterator<Item = PathBuf> {
        let of_models = self.models.values().flatten().flat_map(|model| &model.files);
        of_models.chain(&self.mesh_files).cloned()
    }

    /// Takes a model as read.
    pub(crate) fn know_model(&mut self, path: &str, model: Arc<model::Model>) {
        self.models.insert(path.to_owned(), Ok(model));
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
    (base, watch): (Option<&Path>, &Watch),
    path: &str,
    read: impl FnOnce(&Path) -> Result<Arc<T>, E>,
) -> Result<Arc<T>, String> {
    if let Some(known) = known.get(path) {
        return known.clone();
    }
    let Some(file) = place(base, path) else {
        return Err(format!("{path}: the scene lies in no folder from which to find it"));
    };
    watch.check()?;
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
