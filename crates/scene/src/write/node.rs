//! The text of nodes that are new.

use catoptra_core::scene::{EntityId, Scene};
use catoptra_core::{Field, FieldKind, Value};

use super::layout::INDENT;
use super::placement;
use super::value::{number, paint, quoted, words};
use crate::build::Id;
use crate::flags;
use crate::instance::Instance;
use crate::outline::{Part, Sort};
use crate::read::{FILE, MATERIAL};
use crate::state::State;

/// The lines of a field: one for each row, or one in all; none where the value is what it is when the field is left out.
pub(super) fn lines_of(field: &Field, value: &Value, scene: &Scene) -> Vec<String> {
    if field.default.is_some_and(|default| default() == *value) {
        return Vec::new();
    }
    match value {
        Value::Rows(rows) => rows.iter().map(|row| row_line(field, row)).collect(),
        value => vec![whole_line(field, value, scene)],
    }
}

/// The line of a row.
pub(super) fn row_line(field: &Field, row: &[f64]) -> String {
    let words: Vec<String> = row.iter().copied().map(number).collect();
    format!("{} {}", field.name, words.join(" "))
}

/// The line of a field.
pub(super) fn whole_line(field: &Field, value: &Value, scene: &Scene) -> String {
    let mut words = words(field.kind, value, scene);
    if words.iter().all(|word| *word == words[0]) && field.kind == FieldKind::Pair {
        words.truncate(1);
    }
    let paint = match value {
        Value::Textured(textured) => paint(textured.by, scene),
        _ => String::new(),
    };
    format!("{} {}{paint}", field.name, words.join(" "))
}

/// New nodes: their lines, indented from nothing, and what they stand for.
#[derive(Debug)]
pub(super) struct Nodes<'a> {
    pub(super) lines: String,
    pub(super) ids: Vec<Id>,
    /// Groups that are models get nodes of these, whose blocks are filled when they stand in the text.
    models: &'a [Instance],
}

impl<'a> Nodes<'a> {
    /// None yet.
    pub(super) fn new(models: &'a [Instance]) -> Self {
        Self { lines: String::new(), ids: Vec::new(), models }
    }

    /// Adds settings, a texture or a material.
    pub(super) fn add(&mut self, scene: &Scene, id: Id) {
        self.add_at(scene, id, &|_| false, 0);
    }

    /// Adds an entity and, of its members, those for which `is_new` holds.
    pub(super) fn add_entity(&mut self, scene: &Scene, id: EntityId, is_new: &dyn Fn(EntityId) -> bool) {
        self.add_at(scene, Id::Entity(id), is_new, 0);
    }

    fn add_at(&mut self, scene: &Scene, id: Id, is_new: &dyn Fn(EntityId) -> bool, depth: usize) {
        let Some(state) = State::of(scene, id) else { return };
        self.ids.push(id);
        let outer = INDENT.repeat(depth);
        let model = self.models.iter().find(|model| model.root().map(Id::Entity) == Some(id));
        let mut lines = field_lines(&state.part, scene);
        lines.extend(model.map(|model| format!("{FILE} {}", quoted(model.path()))));
        lines.extend(placement::steps(&state.placement));
        lines.extend(flags::lines(&state.flags));
        let members: Vec<EntityId> = match id {
            Id::Entity(group) if model.is_none() => {
                scene.children(Some(group)).into_iter().filter(|&m| is_new(m)).collect()
            }
            _ => Vec::new(),
        };
        self.lines.push_str(&format!("{outer}{}", head(&state, model.is_some())));
        if lines.is_empty() && members.is_empty() {
            self.lines.push('\n');
            return;
        }
        self.lines.push_str(" {\n");
        for line in lines {
            self.lines.push_str(&format!("{outer}{INDENT}{line}\n"));
        }
        for member in members {
            self.add_at(scene, Id::Entity(member), is_new, depth + 1);
        }
        self.lines.push_str(&format!("{outer}}}\n"));
    }
}

/// The words of a node before its block.
fn head(state: &State, is_model: bool) -> String {
    let sort = if is_model { Sort::Model } else { state.part.sort() };
    let mut head = sort.word().to_owned();
    if !matches!(state.part, Part::Settings(_)) {
        head = format!("{head} {}", quoted(&state.name));
    }
    match &state.material {
        Some(material) => format!("{head} {MATERIAL}={}", quoted(material)),
        None => head,
    }
}

fn field_lines(part: &Part, scene: &Scene) -> Vec<String> {
    let values = part.values();
    let given = part.sort().fields().filter_map(|field| Some((field, values.get(field.name)?)));
    given.flat_map(|(field, value)| lines_of(field, value, scene)).collect()
}
