//! How does the viewer change its scene, and what follows from a change? Refusals are told; all that shows the scene is brought
//! up to it, once for all changes since the last time.

use catoptra_core::scene::{Edit, SceneError, Subject};

use crate::viewer::{Stale, Viewer};

impl Viewer {
    /// Gives the name that is being typed, if any, to whose it is to be.
    pub(crate) fn finish_name(&mut self) {
        let Some((owner, typed)) = self.typed_name.take() else { return };
        if let Some(edit) = owner.renamed(self.document.scene(), typed) {
            self.edit(edit);
        }
    }

    /// Changes the scene as one step to undo; `false` for a refusal, which is told.
    pub(crate) fn edit(&mut self, edit: Edit) -> bool {
        let outcome = self.document.edit(edit);
        let done = outcome.is_ok();
        self.after_edit(outcome);
        done
    }

    /// Changes the scene as a part of the step with that key; a refusal is told.
    pub(crate) fn edit_on(&mut self, edit: Edit, key: u64) {
        let outcome = self.document.edit_on(edit, key);
        self.after_edit(outcome);
    }

    fn after_edit(&mut self, outcome: Result<(), SceneError>) {
        match outcome {
            Ok(()) => self.notice = None,
            Err(refusal) => self.notify(refusal.to_string()),
        }
    }

    /// Brings everything up to what the scene has become; once for all that happened since the last time. The worker
    /// makes the snapshot.
    pub(crate) fn follow_scene(&mut self) {
        if self.document.scene().revision() != self.seen {
            self.follow_edits();
        }
        if std::mem::take(&mut self.stale.scene) {
            self.copy_scene();
        }
    }

    fn follow_edits(&mut self) {
        let scene = self.document.scene();
        let changes = scene.changes_since(self.seen);
        let moved = self.through.filter(|id| changes.iter().any(|c| c.subject == Subject::Entity(*id)));
        self.seen = scene.revision();
        self.selection = self.selection.without(|id| !scene.contains(id));
        self.lighting.keep_lights_of(scene);
        self.before = None;
        self.texture = self.texture.filter(|id| scene.find_texture(*id).is_some());
        // What is flown would go along.
        if moved.is_some() && self.flown.is_none() {
            self.follow_camera(moved);
        }
        self.stale = Stale { scene: true, trace: true, overlay: true, panel: true };
    }
}
