//! Which scene is open, where is it kept, and how is it changed? Every change goes through the history.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::Placement;
use catoptra_core::scene::{Edit, EntityId, History, Scene, SceneError};
use catoptra_scene::model::Model;
use catoptra_scene::{OnDisk, SceneFile};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};

/// The scene shown when none is named.
const WELCOME: &str = include_str!("../../../scenes/gallery/welcome.kdl");

/// The name under which the built-in scene is first saved.
const WELCOME_NAME: &str = "welcome";

/// A scene with its text and its history.
pub(crate) struct Document {
    scene: Scene,
    history: History,
    file: SceneFile,
    path: Option<PathBuf>,
    /// The model that the scene was made for.
    model: Option<PathBuf>,
}

impl Document {
    /// The built-in scene.
    ///
    /// # Errors
    /// A report of what is wrong in its text.
    pub(crate) fn welcome() -> Result<Self, String> {
        let (scene, file) = catoptra_scene::parse(WELCOME, "welcome.kdl", None).map_err(|e| report(&e))?;
        Ok(Self { scene, history: History::new(), file, path: None, model: None })
    }

    /// The scene in a file.
    ///
    /// # Errors
    /// A report of why it cannot be read, for people.
    pub(crate) fn open(path: &Path) -> Result<Self, String> {
        let (scene, file) = catoptra_scene::load(path).map_err(|e| report(&e))?;
        file.warnings()
            .iter()
            .for_each(|warning| eprintln!("warning: {}", catoptra_scene::printable(warning)));
        let kept = file.path().map(Path::to_owned);
        let model = kept.is_none().then(|| path.to_owned());
        Ok(Self { scene, history: History::new(), file, path: kept, model })
    }

    /// The scene as it is now.
    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// A short name for titles and file names.
    pub(crate) fn name(&self) -> String {
        let stem = self.path.as_deref().or(self.model.as_deref()).and_then(Path::file_stem);
        stem.map_or_else(|| WELCOME_NAME.to_owned(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Whether it is as it was when opened or last saved.
    pub(crate) fn is_saved(&self) -> bool {
        self.history.is_saved()
    }

    /// Changes the scene, as one step to undo.
    ///
    /// # Errors
    /// As for [`Scene::apply`].
    pub(crate) fn edit(&mut self, edit: Edit) -> Result<(), SceneError> {
        self.history.apply(&mut self.scene, edit)
    }

    /// Changes the scene as a part of the step with that key.
    ///
    /// # Errors
    /// As for [`Scene::apply`].
    pub(crate) fn edit_on(&mut self, edit: Edit, key: u64) -> Result<(), SceneError> {
        self.history.apply_continuing(&mut self.scene, edit, key)
    }

    /// Whatever comes next is a step of its own.
    pub(crate) fn end_step(&mut self) {
        self.history.end_step();
    }

    /// Takes the last step back; `false` if there is none.
    pub(crate) fn undo(&mut self) -> bool {
        self.history.undo(&mut self.scene)
    }

    /// Makes the last undone step again; `false` if there is none.
    pub(crate) fn redo(&mut self) -> bool {
        self.history.redo(&mut self.scene)
    }

    /// Where the scene is written: to where it is kept, or under a new name in the folder of its model or the current one.
    pub(crate) fn place(&self) -> PathBuf {
        let folder = self.model.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        self.path.clone().unwrap_or_else(|| free_name(folder, &self.name(), "kdl"))
    }

    /// The folder that the paths in the scene start from.
    pub(crate) fn folder(&self) -> PathBuf {
        self.place().parent().map_or_else(PathBuf::new, Path::to_owned)
    }

    /// The edit that puts a model into the scene, and the group that it becomes; see [`SceneFile::model_edit`].
    ///
    /// # Errors
    /// What the scene refuses, for people.
    pub(crate) fn model_edit(
        &mut self,
        file: (&str, Arc<Model>),
        wish: &str,
        placement: Placement,
    ) -> Result<(Edit, EntityId), String> {
        self.file.model_edit(&self.scene, file, wish, placement)
    }

    /// Whether someone else has changed the file in which the scene is kept.
    pub(crate) fn on_disk(&self) -> OnDisk {
        self.file.on_disk()
    }

    /// Writes the scene to its [place](Self::place), whatever stands there. Returns where.
    ///
    /// # Errors
    /// Why it could not be written, for people.
    pub(crate) fn save(&mut self) -> Result<PathBuf, String> {
        let path = self.place();
        self.file.save(&self.scene, &path).map_err(|e| format!("{} was not saved: {e}", path.display()))?;
        self.history.mark_saved();
        self.path = Some(path.clone());
        Ok(path)
    }
}

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

/// An error with its place in the source, as plain text.
fn report(error: &dyn Diagnostic) -> String {
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(96);
    let mut text = String::new();
    match handler.render_report(&mut text, error) {
        Ok(()) => text,
        Err(_) => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_scene_opens() {
        let document = Document::welcome().unwrap();
        assert!(document.scene().main_camera().is_some());
        assert!(document.is_saved());
    }

    #[test]
    fn a_missing_file_is_named_in_the_report() {
        let report = Document::open(Path::new("no-such-scene.kdl")).err().unwrap();
        assert!(report.contains("no-such-scene.kdl"), "{report}");
    }

    #[test]
    fn a_free_name_is_numbered_past_the_taken_ones() {
        let folder = tempfile::tempdir().unwrap();
        assert!(free_name(folder.path(), "a", "png").ends_with("a.png"));
        std::fs::write(folder.path().join("a.png"), "").unwrap();
        std::fs::write(folder.path().join("a-2.png"), "").unwrap();
        assert!(free_name(folder.path(), "a", "png").ends_with("a-3.png"));
    }
}
