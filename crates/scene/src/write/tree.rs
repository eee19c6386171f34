//! How the order of the nodes follows the scene: what is new goes in, what has moved goes to its place, what is gone
//! goes out.

use std::collections::{HashMap, HashSet};

use catoptra_core::scene::{EntityId, Scene, Settings};

use super::edit::new_block;
use super::layout::{self, Gap};
use super::node::Nodes;
use super::splice::Splice;
use crate::build::Id;
use crate::instance::Instance;
use crate::outline::{Item, Outline, Span};
use crate::state::State;

/// The splices that take out the nodes of what is gone.
pub(crate) fn remove(text: &str, outline: &Outline, ids: &[Id], scene: &Scene) -> Vec<Splice> {
    let mut splices: Vec<Splice> = Vec::new();
    for (item, &id) in outline.items.iter().zip(ids) {
        let inside = splices.last().is_some_and(|s| s.range.contains(&item.span.start));
        if !inside && !matches!(id, Id::Part(..) | Id::Repeated(_)) && State::of(scene, id).is_none() {
            splices.push(Splice::new(layout::whole_node(text, &item.span), ""));
        }
    }
    splices
}

/// Splices that bring the nodes nearer to the order of the scene; none when it is reached. What depends on another
/// change (a new member of a group that is to move) waits for the next call.
pub(crate) fn arrange(
    text: &str,
    outline: &Outline,
    ids: &[Id],
    scene: &Scene,
    Brought { models, hidden }: Brought<'_>,
) -> Vec<Splice> {
    let places = ids.iter().enumerate().map(|(i, &id)| (id, i)).collect();
    let mut arranging = Arranging {
        text,
        outline,
        ids,
        scene,
        models,
        hidden,
        places,
        splices: Vec::new(),
        moves: Vec::new(),
    };
    arranging.add_settings();
    arranging.add_shared(scene.textures().map(|(id, ..)| Id::Texture(id)), |id| matches!(id, Id::Texture(_)));
    arranging
        .add_shared(scene.materials().map(|(id, ..)| Id::Material(id)), |id| matches!(id, Id::Material(_)));
    arranging.arrange_members(None);
    for (i, &id) in ids.iter().enumerate() {
        if let Id::Entity(entity) | Id::Part(Some(entity), _) = id
            && scene.contains(entity)
        {
            arranging.arrange_members(Some((entity, i)));
        }
    }
    arranging.add_moves();
    arranging.splices
}

/// What models and repeats bring into the scene.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Brought<'a> {
    /// Models that have a node, or get one.
    pub(crate) models: &'a [Instance],
    /// Nothing is written of these.
    pub(crate) hidden: &'a HashSet<Id>,
}

struct Arranging<'a> {
    text: &'a str,
    outline: &'a Outline,
    ids: &'a [Id],
    scene: &'a Scene,
    models: &'a [Instance],
    hidden: &'a HashSet<Id>,
    /// Where in the outline everything stands.
    places: HashMap<Id, usize>,
    splices: Vec<Splice>,
    /// Items that are to go elsewhere, and where.
    moves: Vec<(usize, Gap)>,
}

impl Arranging<'_> {
    fn add_settings(&mut self) {
        if self.places.contains_key(&Id::Settings) || *self.scene.settings() == Settings::default() {
            return;
        }
        let mut nodes = Nodes::new(self.models);
        nodes.add(self.scene, Id::Settings);
        self.put(&self.gap_at_top(), nodes);
    }

    /// Adds those of the textures or of the materials that are new, behind the last of their sort.
    fn add_shared(&mut self, all: impl Iterator<Item = Id>, is_such: impl Fn(&Id) -> bool) {
        let mut nodes = Nodes::new(self.models);
        for id in all.filter(|id| !self.places.contains_key(id) && !self.hidden.contains(id)) {
            nodes.add(self.scene, id);
        }
        let last = self.ids.iter().rposition(is_such);
        let gap = match last {
            Some(last) => layout::gap_after(self.text, &self.outline.items[last].span),
            None => self.gap_at_top(),
        };
        if !nodes.ids.is_empty() {
            self.put(&gap, nodes);
        }
    }

    /// Before the first node that is no settings, or at the end.
    fn gap_at_top(&self) -> Gap {
        let first = self.ids.iter().position(|id| *id != Id::Settings);
        match first {
            Some(first) => layout::gap_before(self.text, &self.outline.items[first].span),
            None => Gap::at_line(self.text, self.text.len(), ""),
        }
    }

    fn put(&mut self, gap: &Gap, nodes: Nodes<'_>) {
        let text = gap.fill(self.text, &nodes.lines);
        self.splices.push(Splice { range: gap.at..gap.at, text, ids: nodes.ids });
    }

    /// Puts new members of a group (or of the top) into the text, and notes those that have to move.
    fn arrange_members(&mut self, group: Option<(EntityId, usize)>) {
        let mut members = self.scene.children(group.map(|(id, _)| id));
        members.retain(|id| !self.hidden.contains(&Id::Entity(*id)));
        let group = group.map(|(_, place)| place);
        let place = |id: &EntityId| self.places.get(&Id::Entity(*id)).copied();
        let here = |p: &usize| self.outline.items[*p].parent == group;
        let staying = rising(&members.iter().filter_map(place).filter(here).collect::<Vec<_>>());
        if members.iter().all(|id| place(id).is_some_and(|p| staying.contains(&p))) {
            return;
        }
        let Some(mut gap) = self.first_gap(group, staying.first().copied()) else {
            return;
        };
        for &id in &members {
            match self.places.get(&Id::Entity(id)).copied() {
                Some(p) if staying.contains(&p) => {
                    gap = layout::gap_after(self.text, &self.outline.items[p].span);
                }
                Some(p) => self.moves.push((p, gap.clone())),
                None => {
                    let mut nodes = Nodes::new(self.models);
                    nodes
                        .add_entity(self.scene, id, &|member| !self.places.contains_key(&Id::Entity(member)));
                    self.put(&gap, nodes);
                }
            }
        }
    }

    /// Where the first member of a group goes: before the first that stays, else at the end. A group without a
    /// block gets one first.
    fn first_gap(&mut self, group: Option<usize>, staying: Option<usize>) -> Option<Gap> {
        if let Some(first) = staying {
            return Some(layout::gap_before(self.text, &self.outline.items[first].span));
        }
        let Some(group) = group.map(|place| &self.outline.items[place]) else {
            return Some(Gap::at_line(self.text, self.text.len(), ""));
        };
        let gap = layout::gap_at_end(self.text, group);
        if gap.is_none() {
            self.splices.push(new_block(self.text, group, ""));
        }
        gap
    }

    /// Adds those moves that do not touch each other.
    fn add_moves(&mut self) {
        let mut cuts: Vec<Span> = Vec::new();
        for (place, gap) in std::mem::take(&mut self.moves) {
            let item = &self.outline.items[place];
            let cut = layout::whole_node(self.text, &item.span);
            let within = |at: usize, cut: &Span| cut.start < at && at < cut.end;
            let blocked = within(gap.at, &cut)
                || self.splices.iter().any(|s| within(s.range.start, &cut))
                || cuts
                    .iter()
                    .any(|other| within(gap.at, other) || (other.start < cut.end && cut.start < other.end));
            if blocked {
                continue;
            }
            let text = gap.fill(self.text, &dedented(self.text, item, &cut));
            let inside = self.outline.inside(place);
            let ids = std::iter::once(place).chain(inside).map(|p| self.ids[p]).collect();
            self.splices.push(Splice { range: gap.at..gap.at, text, ids });
            self.splices.push(Splice::new(cut.clone(), ""));
            cuts.push(cut);
        }
    }
}

/// The lines of a node as if it stood at the start of its line.
fn dedented(text: &str, item: &Item, cut: &Span) -> String {
    let indent = layout::indent_at(text, item.span.start);
    let begins = layout::begins_line(text, item.span.start);
    let piece = if begins { &text[cut.clone()] } else { text[cut.clone()].trim() };
    let lines = piece.lines().map(|line| line.strip_prefix(indent).unwrap_or(line));
    lines.collect::<Vec<_>>().join("\n")
}

/// A longest rising subsequence: the members that can stay where they are.
fn rising(places: &[usize]) -> Vec<usize> {
    // For every length, the place at which a sequence of that length ends lowest; and what came before each place.
    let mut ends: Vec<usize> = Vec::new();
    let mut before: HashMap<usize, usize> = HashMap::new();
    for &place in places {
        let length = ends.partition_point(|&end| end < place);
        if length > 0 {
            before.insert(place, ends[length - 1]);
        }
        if length == ends.len() {
            ends.push(place);
        } else {
            ends[length] = place;
        }
    }
    let mut kept: Vec<usize> =
        std::iter::successors(ends.last().copied(), |place| before.get(place).copied()).collect();
    kept.reverse();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_longest_rising_sequence_is_kept() {
        assert_eq!(rising(&[1, 2, 3]), [1, 2, 3]);
        assert_eq!(rising(&[3, 1, 2]), [1, 2]);
        assert_eq!(rising(&[5, 1, 6, 2, 7, 3, 4]).len(), 4);
        assert!(rising(&[]).is_empty());
    }
}
