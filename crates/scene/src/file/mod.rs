//! How a scene and its text are held together: loading (`load`), following edits (`follow`), saving, also into other folders
//! (`relocated`).

mod follow;
mod load;
mod models;
mod relocated;

use std::path::{Path, PathBuf};

use catoptra_core::TextureId;
use catoptra_core::scene::{EntityId, MaterialId, Scene};

use crate::atomic;
use crate::build::Id;
use crate::disk::{self, OnDisk};
use crate::instance::Instance;
use crate::outline::Outline;
use crate::printable;
use crate::read::Files;
use crate::repeated::Repeated;
pub(crate) use load::parse_with;
pub use load::{LoadError, load, load_from, load_unless_cancelled, parse};

/// The text of a scene, kept so that saving changes only what has changed.
///
/// Belongs to the [`Scene`] it was loaded with (or made for), whose ids it remembers.
#[derive(Debug, Clone)]
pub struct SceneFile {
    path: Option<PathBuf>,
    /// What the file at `path` held when it was read or written last.
    stored: String,
    /// As it was read: each update begins there, so that edits which are undone leave no trace, saved or not.
    opened: Wording,
    /// As of the last update.
    now: Wording,
    files: Files,
    added: Option<String>,
}

/// A text and what it stands for.
#[derive(Debug, Clone, Default)]
struct Wording {
    text: String,
    outline: Outline,
    /// What every item of the outline stands for.
    ids: Vec<Id>,
    /// What came from model files and is as they and the text say.
    models: Vec<Instance>,
    /// What came from model files and is not there, or not so; an edit or one that is undone may bring it.
    resting: Vec<Instance>,
    /// Repeats that are as the text says.
    repeats: Vec<Repeated>,
}

/// A scene that could not be saved; what was on the disk before is there still.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("{}: cannot be written: {cause}", printable(&path.to_string_lossy()))]
#[diagnostic(code(catoptra::save))]
pub struct SaveError {
    path: PathBuf,
    cause: std::io::Error,
}

impl SceneFile {
    /// The same with a line about what was added to a model.
    pub(crate) fn with_added(self, added: Option<String>) -> Self {
        Self { added, ..self }
    }

    /// Of a text that was just read.
    fn of(wording: Wording, files: Files) -> Self {
        Self { path: None, stored: String::new(), opened: wording.clone(), now: wording, files, added: None }
    }

    /// Text for a scene that has none yet.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut file = Self::of(Wording::default(), Files::new(None));
        file.update(scene);
        file
    }

    /// The same as the text of the file at `path`, whatever that holds: what stands there now counts as known.
    #[must_use]
    pub fn assigned_to(self, path: &Path) -> Self {
        // A file that cannot be read holds something else than the nothing that is known then.
        let stored = std::fs::read_to_string(path).unwrap_or_default();
        Self { path: Some(path.to_owned()), stored, ..self }
    }

    /// The file it was loaded from or saved to last.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Whether that file still holds what was read from it or written to it last: to be asked before it is saved to
    /// again, since [`Self::save`] replaces whatever stands there.
    #[must_use]
    pub fn on_disk(&self) -> OnDisk {
        self.path.as_deref().map_or(OnDisk::Missing, |path| disk::compare(path, self.stored.as_bytes()))
    }

    /// Where the meshes lie that it names.
    pub fn mesh_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.mesh_paths()
    }

    /// Where the models lie that it names.
    pub fn model_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.model_paths()
    }

    /// Where the files lie that its models and meshes name: materials, pictures, buffers.
    pub fn companion_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.companion_paths()
    }

    /// What of the models is not shown as their files mean it: a line for each.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.files.warnings()
    }

    /// One line about what was added to a model that was loaded as a scene, if anything was.
    #[must_use]
    pub fn added(&self) -> Option<&str> {
        self.added.as_deref()
    }

    /// Where the intensity profiles lie that it names.
    pub fn profile_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.profile_paths()
    }

    /// Where the pictures lie that it names.
    pub fn image_paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.image_paths()
    }

    /// The folder at which the relative paths of the scene start, wherever it is saved to; empty for the current one.
    #[must_use]
    pub fn folder(&self) -> &Path {
        self.files.base()
    }

    /// The text, as of the last [`Self::update`], as it is to stand in a file at `path`: where that lies in another
    /// [folder](Self::folder), the paths of meshes, models, profiles and pictures lead from there to the same files.
    #[must_use]
    pub fn text_for(&self, path: &Path) -> String {
        let folder = path.parent().unwrap_or(Path::new(""));
        relocated::text(&self.now.text, &self.now.outline, self.folder(), folder)
    }

    /// The text, as of the last [`Self::update`].
    #[must_use]
    pub fn text(&self) -> String {
        self.now.text.clone()
    }

    /// The line of the text, counted from 1, on which an entity has a node of its own.
    #[must_use]
    pub fn line_of_entity(&self, id: EntityId) -> Option<usize> {
        self.line_of(Id::Entity(id))
    }

    /// The line of the text, counted from 1, on which a material has a node of its own; one of a model has none.
    #[must_use]
    pub fn line_of_material(&self, id: MaterialId) -> Option<usize> {
        self.line_of(Id::Material(id))
    }

    /// The line of the text, counted from 1, on which a texture has a node of its own; one of a model has none.
    #[must_use]
    pub fn line_of_texture(&self, id: TextureId) -> Option<usize> {
        self.line_of(Id::Texture(id))
    }

    fn line_of(&self, wanted: Id) -> Option<usize> {
        let place = self.now.ids.iter().position(|id| *id == wanted)?;
        let before = self.now.text.get(..self.now.outline.items.get(place)?.span.start)?;
        Some(1 + before.matches('\n').count())
    }

    /// Makes the text say what the scene holds, changing only what has changed since it was read. Comments, order, blank
    /// lines and the spelling of numbers that did not change stay; a node goes with its line and the comment behind it, and
    /// comes back with them.
    pub fn update(&mut self, scene: &Scene) {
        self.now = self.opened.clone();
        self.know_files(scene);
        self.write_out(scene);
        if self.follow(scene).is_none() {
            // No text that we wrote ourselves could be read again: begin anew rather than lose an edit.
            self.now = Wording::default();
            let _ = self.follow(scene);
        }
    }

    /// Updates the text and writes it to `path`, whole or not at all.
    ///
    /// Saved to another folder, the paths in the file lead from there, as [`Self::text_for`] says; in the scene they stay.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&mut self, scene: &Scene, path: &Path) -> Result<(), SaveError> {
        self.update(scene);
        let text = self.text_for(path);
        atomic::write(path, |out| std::io::Write::write_all(out, text.as_bytes()))
            .map_err(|cause| SaveError { path: path.to_owned(), cause })?;
        self.path = Some(path.to_owned());
        self.stored = text;
        Ok(())
    }
}
