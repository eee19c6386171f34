//! How a scene and its text are held together: loading (`load`), following edits (`follow`), saving.

mod follow;
mod load;
mod models;

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
pub use load::{load, load_from, parse};

/// The text of a scene, kept so that saving changes only what has changed.
///
/// Belongs to the [`Scene`] it was loaded with (or made for), whose ids it remembers.
#[derive(Debug, Clone)]
pub struct SceneFile {
    path: Option<PathBuf>,
    /// What the file at `path` held when it was read or written last.
    stored: String,
    text: String,
    outline: Outline,
    /// What every item of the outline stands for.
    ids: Vec<Id>,
    files: Files,
    /// What came from model files and is as they and the text say.
    models: Vec<Instance>,
    /// What came from model files and is not there any more, or not so; an undone edit may bring it back.
    resting: Vec<Instance>,
    /// Repeats that are as the text says.
    repeats: Vec<Repeated>,
    added: Option<String>,
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

    /// Text for a scene that has none yet.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let mut file = Self {
            path: None,
            stored: String::new(),
            text: String::new(),
            outline: Outline::default(),
            ids: Vec::new(),
            files: Files::new(None),
            models: Vec::new(),
            resting: Vec::new(),
            repeats: Vec::new(),
            added: None,
        };
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

    /// The text, as of the last [`Self::update`].
    #[must_use]
    pub fn text(&self) -> String {
        self.text.clone()
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
        let place = self.ids.iter().position(|id| *id == wanted)?;
        let before = self.text.get(..self.outline.items.get(place)?.span.start)?;
        Some(1 + before.matches('\n').count())
    }

    /// Makes the text say what the scene holds, changing only what has changed. Comments, order, blank lines and the
    /// spelling of numbers that did not change stay; a node goes with its line and the comment behind it.
    pub fn update(&mut self, scene: &Scene) {
        self.know_files(scene);
        self.write_out(scene);
        if self.follow(scene).is_none() {
            // No text that we wrote ourselves could be read again: begin anew rather than lose an edit.
            self.text.clear();
            self.outline = Outline::default();
            self.ids.clear();
            self.models.clear();
            self.resting.clear();
            self.repeats.clear();
            let _ = self.follow(scene);
        }
    }

    /// Updates the text and writes it to `path`, whole or not at all.
    ///
    /// Paths of meshes and profiles are written as they are in the scene: saved to another folder, the scene needs them
    /// there.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&mut self, scene: &Scene, path: &Path) -> Result<(), SaveError> {
        self.update(scene);
        atomic::write(path, |out| std::io::Write::write_all(out, self.text.as_bytes()))
            .map_err(|cause| SaveError { path: path.to_owned(), cause })?;
        self.path = Some(path.to_owned());
        self.stored.clone_from(&self.text);
        Ok(())
    }
}
