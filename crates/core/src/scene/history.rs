//! How does a person take edits back, and do them again?

use std::collections::HashSet;

use super::{Edit, EntityId, MaterialId, Scene, SceneError, TextureId};

/// The steps that led to the present state of one scene, to undo and redo them.
///
/// A history belongs to one scene, and all edits to be undone go through it. Every state has a number of its own,
/// by which the history knows whether the present one was saved.
///
/// ```
/// use catoptra_core::{Edit, History, Rgb, Scene, Settings};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let (mut scene, mut history) = (Scene::new(), History::new());
/// history.apply(&mut scene, Edit::Settings(Settings::new(Rgb::WHITE, 3)?))?;
/// assert!(history.undo(&mut scene) && scene.settings().background() == Rgb::BLACK);
/// assert!(history.redo(&mut scene) && scene.settings().background() == Rgb::WHITE);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Default)]
pub struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
    /// States given so far.
    states: u64,
    /// The state last saved; 0 is the one before the first step.
    saved: u64,
    /// Whether an edit with this key still belongs to the last step.
    open: Option<u64>,
}

/// One thing that a person did.
#[derive(Debug, Clone)]
struct Step {
    /// What takes it back or, once undone, does it again: one after the other.
    edits: Vec<Edit>,
    /// The state after it.
    state: u64,
}

impl History {
    /// No steps; the present state counts as saved.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Does an edit, as one step. What was undone before can no longer be redone.
    ///
    /// # Errors
    /// As for [`Scene::apply`]; the history is then as it was.
    pub fn apply(&mut self, scene: &mut Scene, edit: Edit) -> Result<(), SceneError> {
        let inverse = scene.apply(edit)?;
        self.open = None;
        let state = self.new_state();
        self.done.push(Step { edits: vec![inverse], state });
        self.undone.clear();
        Ok(())
    }

    /// Does an edit as a part of the last step, if that step was made with the same `key` and nothing came after
    /// it; otherwise as a new step. A drag gives all its edits one key, so that it is undone at once; between two
    /// drags with one key comes [`Self::end_step`]. A step that sets the same values over and over takes no more
    /// room than one that sets them once.
    ///
    /// # Errors
    /// As for [`Scene::apply`]; the history is then as it was.
    pub fn apply_continuing(&mut self, scene: &mut Scene, edit: Edit, key: u64) -> Result<(), SceneError> {
        let Some(mut step) = self.done.pop_if(|_| self.open == Some(key)) else {
            self.apply(scene, edit)?;
            self.open = Some(key);
            return Ok(());
        };
        let outcome = scene.apply(edit);
        if let Ok(inverse) = outcome {
            step.state = self.new_state();
            step.take_back_first(inverse);
            self.done.push(step);
            Ok(())
        } else {
            self.done.push(step);
            outcome.map(|_| ())
        }
    }

    /// The next edit starts a new step, whatever its key.
    pub fn end_step(&mut self) {
        self.open = None;
    }

    /// Takes back the last step. `false` if there is none, or if the scene was changed past this history so that
    /// the step can no longer be taken back; scene and history are then as they were.
    pub fn undo(&mut self, scene: &mut Scene) -> bool {
        self.open = None;
        shift(&mut self.done, &mut self.undone, scene)
    }

    /// Does the last undone step again. `false` if there is none, or if the scene was changed past this history
    /// so that the step cannot be done; scene and history are then as they were.
    pub fn redo(&mut self, scene: &mut Scene) -> bool {
        self.open = None;
        shift(&mut self.undone, &mut self.done, scene)
    }

    /// Whether there is a step to take back.
    #[must_use]
    pub fn can_undo(&self) -> bool {
        !self.done.is_empty()
    }

    /// Whether there is an undone step.
    #[must_use]
    pub fn can_redo(&self) -> bool {
        !self.undone.is_empty()
    }

    /// Whether the scene is in the state last [marked](Self::mark_saved), or in the first one without a mark;
    /// undo and redo find back to it.
    #[must_use]
    pub fn is_saved(&self) -> bool {
        self.saved == self.state()
    }

    /// Remembers the present state as the saved one, and ends the step.
    pub fn mark_saved(&mut self) {
        self.open = None;
        self.saved = self.state();
    }

    fn state(&self) -> u64 {
        self.done.last().map_or(0, |step| step.state)
    }

    fn new_state(&mut self) -> u64 {
        self.states += 1;
        self.states
    }
}

/// Applies the last step of one stack and puts its inverse on the other.
fn shift(from: &mut Vec<Step>, to: &mut Vec<Step>, scene: &mut Scene) -> bool {
    let Some(step) = from.last() else { return false };
    let Ok(inverse) = scene.apply(Edit::Batch(step.edits.clone())) else { return false };
    let state = step.state;
    from.pop();
    to.push(Step { edits: vec![inverse], state });
    true
}

impl Step {
    /// Puts an inverse before the others, leaving out what they would overwrite.
    fn take_back_first(&mut self, inverse: Edit) {
        let (mut set, mut set_before) = (HashSet::new(), HashSet::new());
        let only_sets = self.edits.iter().all(|edit| slots_of(edit, &mut set_before));
        if only_sets && slots_of(&inverse, &mut set) {
            let mut new = Vec::new();
            keep_unset(inverse, &set_before, &mut new);
            self.edits.splice(0..0, new);
        } else {
            self.edits.insert(0, inverse);
        }
    }
}

/// A value of the scene that an edit can set whatever the other values are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Slot {
    Shape(EntityId),
    Light(EntityId),
    Camera(EntityId),
    Placement(EntityId),
    Flags(EntityId),
    MaterialOf(EntityId),
    Material(MaterialId),
    Finish(MaterialId),
    Texture(TextureId),
    Settings,
}

/// The slot that an edit sets, `None` if it does something else.
fn slot_of(edit: &Edit) -> Option<Slot> {
    match *edit {
        Edit::Shape(id, _) => Some(Slot::Shape(id)),
        Edit::Light(id, _) => Some(Slot::Light(id)),
        Edit::Camera(id, _) => Some(Slot::Camera(id)),
        Edit::Placement(id, _) => Some(Slot::Placement(id)),
        Edit::Flags(id, _) => Some(Slot::Flags(id)),
        Edit::MaterialOf(id, _) => Some(Slot::MaterialOf(id)),
        Edit::Material(id, _) => Some(Slot::Material(id)),
        Edit::Finish(id, _) => Some(Slot::Finish(id)),
        Edit::Texture(id, _) => Some(Slot::Texture(id)),
        Edit::Settings(_) => Some(Slot::Settings),
        _ => None,
    }
}

/// Adds the slots that an edit sets; `false` if it does anything else besides.
fn slots_of(edit: &Edit, slots: &mut HashSet<Slot>) -> bool {
    if let Edit::Batch(edits) = edit {
        return edits.iter().all(|edit| slots_of(edit, slots));
    }
    slot_of(edit).is_some_and(|slot| {
        slots.insert(slot);
        true
    })
}

/// Adds to `kept` the parts of an edit that set none of `slots`.
fn keep_unset(edit: Edit, slots: &HashSet<Slot>, kept: &mut Vec<Edit>) {
    match edit {
        Edit::Batch(edits) => edits.into_iter().for_each(|edit| keep_unset(edit, slots, kept)),
        edit if slot_of(&edit).is_some_and(|slot| slots.contains(&slot)) => {}
        edit => kept.push(edit),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Node;
    use super::super::fixture::{Room, light, matte, moved, sphere};
    use super::*;

    fn undo_all(history: &mut History, scene: &mut Scene) -> usize {
        std::iter::from_fn(|| history.undo(scene).then_some(())).count()
    }

    #[test]
    fn undo_and_redo_walk_through_the_states() {
        let mut r = Room::new();
        let mut history = History::new();
        let mut states = vec![r.scene.clone()];
        for edit in [
            Edit::Remove(r.lamps),
            Edit::Shape(r.ball, sphere(3.0)),
            Edit::insert(Node::light("star", light(2.0))),
            Edit::Name(r.ball, "lamp".into()),
        ] {
            history.apply(&mut r.scene, edit).unwrap();
            states.push(r.scene.clone());
        }
        for state in states.iter().rev().skip(1) {
            assert!(history.undo(&mut r.scene));
            assert_eq!(&r.scene, state);
        }
        assert!(!history.undo(&mut r.scene) && !history.can_undo());
        for state in states.iter().skip(1) {
            assert!(history.redo(&mut r.scene));
            assert_eq!(&r.scene, state);
        }
        assert!(!history.redo(&mut r.scene) && !history.can_redo());
    }

    #[test]
    fn a_new_step_ends_what_could_be_redone() {
        let mut r = Room::new();
        let mut history = History::new();
        history.apply(&mut r.scene, Edit::Remove(r.eye)).unwrap();
        history.undo(&mut r.scene);
        assert!(history.can_redo());
        history.apply(&mut r.scene, Edit::Remove(r.floor)).unwrap();
        assert!(!history.can_redo());
    }

    #[test]
    fn a_drag_is_one_step_of_fixed_size() {
        let mut r = Room::new();
        let mut history = History::new();
        let before = r.scene.clone();
        for x in 1..50 {
            let at = moved(f64::from(x), 0.0, 0.0);
            let both = vec![Edit::Placement(r.ball, at), Edit::Placement(r.lamp, at)];
            history.apply_continuing(&mut r.scene, Edit::Batch(both), 7).unwrap();
        }
        assert_eq!(history.done.len(), 1);
        assert_eq!(history.done[0].edits.len(), 1);
        let dragged = r.scene.clone();
        assert!(history.undo(&mut r.scene));
        assert_eq!(r.scene, before);
        assert!(history.redo(&mut r.scene));
        assert_eq!(r.scene, dragged);
    }

    #[test]
    fn another_key_or_an_end_starts_a_new_step() {
        let mut r = Room::new();
        let mut history = History::new();
        let edit = |x| Edit::Placement(r.ball, moved(x, 0.0, 0.0));
        history.apply_continuing(&mut r.scene, edit(1.0), 1).unwrap();
        history.apply_continuing(&mut r.scene, edit(2.0), 2).unwrap();
        history.end_step();
        history.apply_continuing(&mut r.scene, edit(3.0), 2).unwrap();
        history.apply(&mut r.scene, edit(4.0)).unwrap();
        history.apply_continuing(&mut r.scene, edit(5.0), 2).unwrap();
        history.apply_continuing(&mut r.scene, edit(6.0), 2).unwrap();
        assert_eq!(undo_all(&mut history, &mut r.scene), 5);
    }

    #[test]
    fn a_drag_that_touches_more_and_more_is_taken_back_whole() {
        let mut r = Room::new();
        let mut history = History::new();
        let before = r.scene.clone();
        let new = r.scene.next_material_id();
        for edit in [
            Edit::MaterialOf(r.ball, r.grey),
            Edit::Placement(r.ball, moved(1.0, 0.0, 0.0)),
            Edit::Batch(vec![
                Edit::AddMaterial { name: "red".into(), material: matte(0.0), id: None },
                Edit::MaterialOf(r.ball, new),
            ]),
            Edit::MaterialOf(r.ball, r.white),
            Edit::Material(new, matte(0.7)),
            Edit::RemoveMaterial(new),
        ] {
            history.apply_continuing(&mut r.scene, edit, 1).unwrap();
        }
        let after = r.scene.clone();
        assert!(history.undo(&mut r.scene));
        assert_eq!(r.scene, before);
        assert!(history.redo(&mut r.scene));
        assert_eq!(r.scene, after);
        assert_eq!(undo_all(&mut history, &mut r.scene), 1);
    }

    #[test]
    fn a_refused_edit_is_no_step() {
        let mut r = Room::new();
        let mut history = History::new();
        let good = Edit::Placement(r.ball, moved(1.0, 0.0, 0.0));
        history.apply_continuing(&mut r.scene, good.clone(), 1).unwrap();
        history.apply_continuing(&mut r.scene, Edit::RemoveMaterial(r.white), 1).unwrap_err();
        history.apply(&mut r.scene, Edit::RemoveMaterial(r.white)).unwrap_err();
        history.apply_continuing(&mut r.scene, good, 1).unwrap();
        assert_eq!(undo_all(&mut history, &mut r.scene), 1);
    }

    #[test]
    fn it_knows_the_saved_state_again() {
        let mut r = Room::new();
        let mut history = History::new();
        let edit = |x| Edit::Placement(r.ball, moved(x, 0.0, 0.0));
        assert!(history.is_saved());
        history.apply_continuing(&mut r.scene, edit(1.0), 1).unwrap();
        assert!(!history.is_saved());
        history.mark_saved();
        history.apply_continuing(&mut r.scene, edit(2.0), 1).unwrap();
        assert!(!history.is_saved());
        history.undo(&mut r.scene);
        assert!(history.is_saved());
        history.undo(&mut r.scene);
        assert!(!history.is_saved());
        history.redo(&mut r.scene);
        assert!(history.is_saved());
        history.undo(&mut r.scene);
        history.apply(&mut r.scene, edit(1.0)).unwrap();
        assert!(!history.is_saved());
    }

    #[test]
    fn a_step_that_no_longer_fits_the_scene_is_not_undone() {
        let mut r = Room::new();
        let mut history = History::new();
        history.apply(&mut r.scene, Edit::Remove(r.eye)).unwrap();
        r.scene.add_group("eye", None).unwrap();
        let before = r.scene.clone();
        assert!(!history.undo(&mut r.scene));
        assert_eq!(r.scene, before);
        assert!(history.can_undo() && !history.can_redo());
    }
}
