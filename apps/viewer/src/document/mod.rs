//! Which scene is open, where is it kept, and how is it changed? Every change goes through the history.

mod steps;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::Placement;
use catoptra_core::scene::{Edit, EntityId, History, Scene};
use catoptra_scene::model::Model;
use catoptra_scene::{OnDisk, SceneFile};
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};

use crate::difference::{self, Line};
use crate::free_name::free_name;
use crate::keeping::Unsaved;
use crate::recovery::{Kept, Origin};

/// The scene shown when none is named.
const WELCOME: &str = include_str!("../../../../scenes/gallery/welcome.kdl");

/// What a new scene begins with: something to stand on, light, a sky and a view.
const EMPTY: &str = "settings { background 0.35 0.42 0.5 }
camera \"main\" { eye 3 2.5 6; target 0 0.5 0; fov 40 }
directional-light \"sun\" { direction -1 -2 -1.5; irradiance 2 }
ambient-light \"sky\" { radiance 0.25 }
matte \"grey\" { color 0.6 }
plane \"floor\" material=\"grey\"
";

/// The name of a new scene.
const NEW_NAME: &str = "untitled";

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
    /// Edits of an earlier run that it holds and that are not saved.
    recovered: Option<Kept>,
    /// It was begun anew, and has no name yet.
    is_new: bool,
}

impl Document {
    /// The built-in scene.
    ///
    /// # Errors
    /// A report of what is wrong in its text.
    pub(crate) fn welcome() -> Result<Self, String> {
        let (scene, file) = catoptra_scene::parse(WELCOME, "welcome.kdl", None).map_err(|e| report(&e))?;
        Ok(Self::new(scene, file))
    }

    fn new(scene: Scene, file: SceneFile) -> Self {
        Self { scene, history: History::new(), file, path: None, model: None, recovered: None, is_new: false }
    }

    /// The edits that an earlier run has kept, not saved.
    ///
    /// # Errors
    /// A report of why they cannot be read, for people.
    pub(crate) fn recover(kept: &Kept) -> Result<Self, String> {
        let place = kept.place.display();
        let text = kept.text().map_err(|e| format!("{place} cannot be read: {e}"))?;
        let base = match &kept.origin {
            Origin::File(path) => path.parent().unwrap_or(Path::new("")),
            Origin::Folder(folder) => folder,
        };
        let name = place.to_string();
        let (scene, file) = catoptra_scene::parse(&text, &name, Some(base)).map_err(|e| report(&e))?;
        let mut document = Self { recovered: Some(kept.clone()), ..Self::new(scene, file) };
        if let Origin::File(path) = &kept.origin {
            document.file = document.file.assigned_to(path);
            document.path = Some(path.clone());
        }
        Ok(document)
    }

    /// It with its edits, to be kept where they are not saved.
    pub(crate) fn unsaved(&self) -> Unsaved {
        let origin = match &self.path {
            Some(path) => Origin::File(path.clone()),
            None => Origin::Folder(self.folder()),
        };
        let (scene, file, holds) = (self.scene.clone(), self.file.clone(), self.recovered.clone());
        Unsaved { scene, file, origin, holds }
    }

    /// Its text with all edits.
    #[cfg(test)]
    pub(crate) fn text(&self) -> String {
        let Unsaved { scene, mut file, .. } = self.unsaved();
        file.update(&scene);
        file.text()
    }

    /// A scene to begin with.
    ///
    /// # Errors
    /// A report of what is wrong in its text.
    pub(crate) fn empty() -> Result<Self, String> {
        let (scene, file) = catoptra_scene::parse(EMPTY, "new scene", None).map_err(|e| report(&e))?;
        Ok(Self { is_new: true, ..Self::new(scene, file) })
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
        Ok(Self { path: kept, model, ..Self::new(scene, file) })
    }

    /// The scene as it is now.
    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// A short name for titles and file names.
    pub(crate) fn name(&self) -> String {
        let stem = self.path.as_deref().or(self.model.as_deref()).and_then(Path::file_stem);
        let unnamed = if self.is_new { NEW_NAME } else { WELCOME_NAME };
        stem.map_or_else(|| unnamed.to_owned(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Whether it is as it was when opened or last saved.
    pub(crate) fn is_saved(&self) -> bool {
        self.history.is_saved() && self.recovered.is_none()
    }

    /// Whether it has a file that it is saved to.
    pub(crate) fn has_place(&self) -> bool {
        self.path.is_some()
    }

    /// Where the scene is written: to where it is kept, or under a new name in the folder of its model or the current one.
    pub(crate) fn place(&self) -> PathBuf {
        let folder = self.model.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        self.path.clone().unwrap_or_else(|| free_name(folder, &self.name(), "kdl"))
    }

    /// The folder that the paths in the scene start from: it stays, wherever the scene is saved to.
    pub(crate) fn folder(&self) -> PathBuf {
        self.file.folder().to_owned()
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

    /// The file that it was read from: a scene, or a model.
    pub(crate) fn source(&self) -> Option<&Path> {
        self.path.as_deref().or(self.model.as_deref())
    }

    /// All files that it was read from.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let file = &self.file;
        let others = file.mesh_paths().chain(file.model_paths()).chain(file.image_paths());
        let source = self.source().map(Path::to_owned);
        source.into_iter().chain(others).chain(file.profile_paths()).collect()
    }

    /// Whether its file holds what was read from it or written to it last.
    pub(crate) fn is_same_on_disk(&self) -> bool {
        self.path.is_some() && self.on_disk() == OnDisk::Same
    }

    /// The edits of an earlier run that it holds need not be kept any longer: they are saved, given up or kept anew.
    pub(crate) fn settle(&mut self) {
        if let Some(kept) = self.recovered.take() {
            kept.forget();
        }
    }

    /// Whether someone else has changed the file in which the scene is kept.
    pub(crate) fn on_disk(&self) -> OnDisk {
        self.file.on_disk()
    }

    /// What differs between its file, as it is on the disk, and what saving would write there.
    pub(crate) fn difference(&mut self) -> Vec<Line> {
        self.file.update(&self.scene);
        let on_disk = std::fs::read(self.place()).unwrap_or_default();
        difference::between(&String::from_utf8_lossy(&on_disk), &self.file.text_for(&self.place()))
    }

    /// Writes the scene to its [place](Self::place), whatever stands there. Returns where.
    ///
    /// # Errors
    /// Why it could not be written, for people.
    pub(crate) fn save(&mut self) -> Result<PathBuf, String> {
        self.save_to(self.place())
    }

    /// Writes the scene to a file, whatever stands there, and keeps it there from then on. Returns where.
    ///
    /// # Errors
    /// Why it could not be written, for people.
    pub(crate) fn save_to(&mut self, path: PathBuf) -> Result<PathBuf, String> {
        self.file.save(&self.scene, &path).map_err(|e| format!("{} was not saved: {e}", path.display()))?;
        self.history.mark_saved();
        self.settle();
        self.path = Some(path.clone());
        Ok(path)
    }
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
}
