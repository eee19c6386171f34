//! How the nodes that are in the text already follow the scene: names, values, materials, placements.

use catoptra_core::scene::Scene;
use catoptra_core::{Field, FieldKind, Value};

use super::layout::{self, INDENT, Place};
use super::splice::{Splice, without_space};
use super::value::{number, quoted, words};
use super::{flags, node, paint, placement};
use crate::build::Id;
use crate::outline::{FieldText, Item, Outline, Part, Sort};
use crate::scan;
use crate::state::State;

/// The splices that make every node say what the scene holds; nodes of things that are gone are left alone.
pub(crate) fn edit(text: &str, outline: &Outline, ids: &[Id], scene: &Scene) -> Vec<Splice> {
    let mut splices = Vec::new();
    for (item, &id) in outline.items.iter().zip(ids) {
        if let Some(now) = State::of(scene, id) {
            let mut own = Vec::new();
            edit_item(text, item, &now, scene, &mut own);
            splices.append(&mut without_empty_block(text, item, own));
        }
        // Parts of models and what stands in repeats are no entities: of them only the names of materials follow here.
        if let (Some(old), Some(worn)) = (&item.material, id.named_material())
            && scene.find_material(worn).is_some()
            && scene.material_name(worn) != old.value
        {
            splices.push(Splice::new(old.span.clone(), quoted(scene.material_name(worn))));
        }
    }
    splices
}

fn edit_item(text: &str, item: &Item, now: &State, scene: &Scene, splices: &mut Vec<Splice>) {
    let word = now.part.sort().word();
    if word != item.sort.word() && !matches!(item.sort, Sort::Model | Sort::Repeat) {
        splices.push(Splice::new(item.word.clone(), word));
    }
    if let Some(name) = item.name.as_ref().filter(|name| name.value != now.name) {
        splices.push(Splice::new(name.span.clone(), quoted(&now.name)));
    }
    if let (Some(old), Some(new)) = (&item.material, &now.material)
        && old.value != *new
    {
        splices.push(Splice::new(old.span.clone(), quoted(new)));
    }
    let mut lines = edit_fields(text, item, &now.part, scene, splices);
    let mut steps = placement::edit(text, item, &now.placement, splices);
    steps.extend(flags::edit(text, item, &now.flags, splices));
    if now.part.sort().has_members() {
        put_at_start(text, item, &steps, splices);
    } else {
        lines.extend(steps);
    }
    put_at_end(text, item, &lines, splices);
}

/// Where splices would leave an empty block, the block goes as a whole.
fn without_empty_block(text: &str, item: &Item, mut splices: Vec<Splice>) -> Vec<Splice> {
    let Some(block) = scan::block_of(text, item.span.clone()) else { return splices };
    let is_inside = |splice: &Splice| block.start < splice.range.start && splice.range.end < block.end;
    if !splices.iter().any(is_inside) || splices.iter().any(|s| is_inside(s) && !s.text.is_empty()) {
        return splices;
    }
    let is_taken = |at: usize| splices.iter().any(|splice| splice.range.contains(&at));
    let mut left = text[block.start + 1..block.end - 1].char_indices();
    if left.any(|(at, c)| !(c.is_whitespace() || c == ';' || is_taken(block.start + 1 + at))) {
        return splices;
    }
    splices.retain(|splice| !is_inside(splice));
    let before = text[..block.start].trim_end_matches([' ', '\t']).len();
    splices.push(Splice::new(before..block.end, ""));
    splices
}

/// Changes and removes fields; answers with the lines of those that are new.
fn edit_fields(text: &str, item: &Item, now: &Part, scene: &Scene, splices: &mut Vec<Splice>) -> Vec<String> {
    let before = item.part.as_ref().map(Part::values).unwrap_or_default();
    let values = now.values();
    let sort = now.sort();
    for written in item.fields.iter().filter(|w| sort.field(w.field.name).is_none()) {
        splices.push(removal(text, written));
    }
    let mut lines = Vec::new();
    for field in sort.fields() {
        if let FieldKind::Rows(_) = field.kind {
            lines.extend(edit_rows(
                text,
                item,
                field,
                [before.get(field.name), values.get(field.name)],
                splices,
            ));
            continue;
        }
        let written = item.fields.iter().find(|w| w.field.name == field.name);
        match (written, values.get(field.name)) {
            (Some(written), None) => splices.push(removal(text, written)),
            (Some(written), Some(new))
                if before.get(field.name) == Some(new) && paint::is_named_so(written, new, scene) => {}
            (Some(written), Some(new)) => {
                let change = Change { written, old: before.get(field.name), new, scene };
                lines.extend(change.splice(text, splices));
            }
            (None, Some(new)) => lines.extend(node::lines_of(field, new, scene)),
            (None, None) => {}
        }
    }
    lines
}

/// Changes and removes the rows of a field, one by one, given what they were and what they are; answers with the lines of
/// those that are new.
fn edit_rows(
    text: &str,
    item: &Item,
    field: &Field,
    [old, new]: [Option<&Value>; 2],
    splices: &mut Vec<Splice>,
) -> Vec<String> {
    let rows = |value: Option<&'_ Value>| match value {
        Some(Value::Rows(rows)) => rows.iter().map(<[f64]>::to_vec).collect(),
        _ => Vec::new(),
    };
    let (old, new): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (rows(old), rows(new));
    let written: Vec<&FieldText> = item.fields.iter().filter(|w| w.field.name == field.name).collect();
    for (i, written) in written.iter().enumerate() {
        let Some(row) = new.get(i) else {
            splices.push(removal(text, written));
            continue;
        };
        for (k, (now, span)) in row.iter().zip(&written.values).enumerate() {
            if old.get(i).and_then(|row| row.get(k)) != Some(now) {
                splices.push(Splice::new(span.clone(), number(*now)));
            }
        }
    }
    new.iter().skip(written.len()).map(|row| node::row_line(field, row)).collect()
}

/// A field that is written otherwise than it should be now.
struct Change<'a> {
    written: &'a FieldText,
    /// What the text says.
    old: Option<&'a Value>,
    /// What the scene has.
    new: &'a Value,
    scene: &'a Scene,
}

impl Change<'_> {
    /// Replaces the words that differ. A grey given by one number that is no grey any more needs three; where those do not
    /// fit (a property), nor does a texture, the field becomes a new line.
    fn splice(&self, text: &str, splices: &mut Vec<Splice>) -> Option<String> {
        let (written, field, scene) = (self.written, self.written.field, self.scene);
        let by = match self.new {
            Value::Textured(textured) => Some(textured.by),
            _ => None,
        };
        let mut after = words(field.kind, self.new, scene);
        if written.values.len() == 1 && after.iter().all(|word| *word == after[0]) {
            after.truncate(1);
        }
        let fits = after.len() == written.values.len();
        if written.property && (!fits || by.is_some()) {
            splices.push(removal(text, written));
            return Some(node::whole_line(field, self.new, scene));
        }
        paint::edit(text, written, by, scene, splices);
        if !fits {
            let (first, last) = (written.values.first()?, written.values.last()?);
            splices.push(Splice::new(first.start..last.end, after.join(" ")));
            return None;
        }
        let named = written.word.as_ref().map(|word| vec![quoted(word)]);
        let before = named.or(self.old.map(|old| words(field.kind, old, scene))).unwrap_or_default();
        for (i, (word, span)) in after.iter().zip(&written.values).enumerate() {
            if before.get(i) != Some(word) {
                splices.push(Splice::new(span.clone(), word.as_str()));
            }
        }
        None
    }
}

fn removal(text: &str, written: &FieldText) -> Splice {
    if written.property {
        without_space(text, &written.span)
    } else {
        Splice::new(layout::taken_out(text, &written.span), "")
    }
}

pub(super) fn put_at_start(text: &str, item: &Item, lines: &[String], splices: &mut Vec<Splice>) {
    if lines.is_empty() {
        return;
    }
    if let Some((at, lines)) = layout::in_one_line(text, item, Place::Start, &lines.join("\n")) {
        return splices.push(Splice::new(at..at, lines));
    }
    match layout::gap_at_start(text, item) {
        Some(gap) => splices.push(Splice::new(gap.at..gap.at, gap.fill(text, &lines.join("\n")))),
        None => put_at_end(text, item, lines, splices),
    }
}

pub(super) fn put_at_end(text: &str, item: &Item, lines: &[String], splices: &mut Vec<Splice>) {
    if lines.is_empty() {
        return;
    }
    let lines = lines.join("\n");
    if let Some((at, lines)) = layout::in_one_line(text, item, Place::End, &lines) {
        return splices.push(Splice::new(at..at, lines));
    }
    match layout::gap_at_end(text, item) {
        Some(gap) => splices.push(Splice::new(gap.at..gap.at, gap.fill(text, &lines))),
        None => splices.push(new_block(text, item, &lines)),
    }
}

/// A block for a node that has none, with lines in it.
pub(super) fn new_block(text: &str, item: &Item, lines: &str) -> Splice {
    debug_assert!(scan::block_of(text, item.span.clone()).is_none(), "a node has one block");
    let newline = layout::newline(text);
    let outer = layout::indent_at(text, item.span.start);
    let inner: String = lines.lines().map(|line| format!("{outer}{INDENT}{line}{newline}")).collect();
    Splice::new(item.head_end..item.head_end, format!(" {{{newline}{inner}{outer}}}"))
}
