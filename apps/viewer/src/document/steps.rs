//! How is the scene changed, and how is that taken back? Step by step, through the history.

use catoptra_core::scene::{Edit, History, Scene, SceneError};

use super::Document;
use crate::deeds::{Before, Deed, Direction};

impl Document {
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

    /// Takes the last step back, and tells what it did; `None` if there is none.
    pub(crate) fn undo(&mut self) -> Option<Deed> {
        let before = Before::of(&self.scene);
        self.history.undo(&mut self.scene).then(|| before.deed(&self.scene, Direction::Back))
    }

    /// Makes the last undone step again, and tells what it does; `None` if there is none.
    pub(crate) fn redo(&mut self) -> Option<Deed> {
        let before = Before::of(&self.scene);
        self.history.redo(&mut self.scene).then(|| before.deed(&self.scene, Direction::Again))
    }

    /// The steps so far, to come [back to](Self::come_back_to).
    pub(crate) fn steps(&self) -> History {
        self.history.clone()
    }

    /// Takes back the only step since then as if it had never been made: what could be done again then, still can.
    pub(crate) fn come_back_to(&mut self, steps: History) {
        if self.history.undo(&mut self.scene) {
            self.history = steps;
        }
    }

    /// The scene as it was before the last step; `None` before the first.
    pub(crate) fn before_last_edit(&self) -> Option<Scene> {
        let (mut scene, mut history) = (self.scene.clone(), self.history.clone());
        history.undo(&mut scene).then_some(scene)
    }
}
