//! What is selected? Things in the order in which they were picked; the last is the active one, whose fields are shown.

use catoptra_core::scene::{EntityId, Scene};

/// How a click on a thing changes what is selected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Picking {
    /// The thing alone is selected.
    #[default]
    Only,
    /// The thing joins what is selected; if it is the active one, it leaves.
    Toggle,
}

/// Some entities of a scene, each once, in the order in which they were picked.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Selection {
    ids: Vec<EntityId>,
}

impl Selection {
    /// The one that was picked last.
    pub(crate) fn active(&self) -> Option<EntityId> {
        self.ids.last().copied()
    }

    /// All, the active one last.
    pub(crate) fn ids(&self) -> &[EntityId] {
        &self.ids
    }

    /// Whether nothing is selected.
    pub(crate) fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Whether that one is selected itself.
    pub(crate) fn contains(&self, id: EntityId) -> bool {
        self.ids.contains(&id)
    }

    /// Whether that one is selected, or lies in a group that is.
    pub(crate) fn covers(&self, scene: &Scene, id: EntityId) -> bool {
        self.ids.iter().any(|group| scene.lies_in(id, *group))
    }

    /// Those that lie in no other that is selected: what is done to these is done to all, once.
    pub(crate) fn tops(&self, scene: &Scene) -> Vec<EntityId> {
        let is_inner = |id: EntityId| self.ids.iter().any(|group| *group != id && scene.lies_in(id, *group));
        self.ids.iter().copied().filter(|id| !is_inner(*id)).collect()
    }

    /// With that thing too as the active one, or without it where it was that.
    pub(crate) fn toggled(&self, id: EntityId) -> Self {
        let others = self.without(|other| other == id);
        if self.active() == Some(id) { others } else { others.with([id]) }
    }

    /// With those picked last; any that were selected already are moved there.
    pub(crate) fn with(&self, ids: impl IntoIterator<Item = EntityId>) -> Self {
        let mut all = self.clone();
        for id in ids {
            all.ids.retain(|other| *other != id);
            all.ids.push(id);
        }
        all
    }

    /// Without those.
    pub(crate) fn without(&self, leaves: impl Fn(EntityId) -> bool) -> Self {
        Self { ids: self.ids.iter().copied().filter(|id| !leaves(*id)).collect() }
    }
}

impl FromIterator<EntityId> for Selection {
    fn from_iter<I: IntoIterator<Item = EntityId>>(ids: I) -> Self {
        Self::default().with(ids)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;

    fn ids(count: u32) -> Vec<EntityId> {
        (1..=count).filter_map(EntityId::from_index).collect()
    }

    #[test]
    fn a_toggling_click_adds_and_takes_away() {
        let [a, b] = ids(2)[..] else { panic!() };
        let two = Selection::from_iter([a]).toggled(b);
        assert_eq!((two.ids(), two.active()), (&[a, b][..], Some(b)));
        assert_eq!(two.toggled(a).ids(), [b, a], "it becomes the active one");
        assert_eq!(two.toggled(b).ids(), [a]);
    }

    #[test]
    fn members_of_a_selected_group_are_covered_and_are_no_tops() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.kdl");
        let text = "matte \"m\" { color 0.5 }\ngroup \"g\" { sphere \"in\" material=\"m\" { radius 1 } }\n\
            sphere \"out\" material=\"m\" { radius 1 }\n";
        std::fs::write(&path, text).unwrap();
        let document = Document::open(&path).unwrap();
        let scene = document.scene();
        let [g, inner, out] = ["g", "in", "out"].map(|name| scene.entity_named(name).unwrap());
        let group = Selection::from_iter([g]);
        assert!(group.covers(scene, inner) && group.covers(scene, g) && !group.covers(scene, out));
        assert_eq!(Selection::from_iter([inner, out, g]).tops(scene), [out, g]);
        assert_eq!(Selection::from_iter([inner, out]).tops(scene), [inner, out]);
    }
}
