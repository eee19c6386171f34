//! How a node is read: its kind, its name, its fields, its placement and, for a group, its members.

use catoptra_core::{FieldKind, Rows, Value};
use kdl::{KdlEntry, KdlNode};

use super::extra::extra;
use super::make::one;
use super::placement::STEPS;
use super::value::{arity, fits_property, value_span};
use super::{Reader, hint_for_word, span_of};
use crate::outline::{FieldText, Item, Sort, Word};

/// The property that names the material of a shape.
pub(crate) const MATERIAL: &str = "material";

impl Reader<'_> {
    /// Reads a node at the top or, with `parent`, in a group, and everything in it.
    pub(super) fn read_node(&mut self, node: &KdlNode, parent: Option<usize>) {
        self.refuse_annotations(node);
        let word = node.name().value();
        let word_span = span_of(node.name().span());
        let in_group = parent.is_some();
        let in_model = parent.is_some_and(|p| matches!(self.outline.items[p].sort, Sort::Model));
        let sort = match Sort::named(word) {
            Some(Sort::Part) if !in_model => {
                let help = "put it in the block of the model that it is a part of";
                self.complaints.add_with(word_span, "a part stands in a model", help);
                return;
            }
            Some(sort) if !in_group || sort.is_entity() => sort,
            Some(_) => {
                let help = "put it at the top, outside of any group";
                self.complaints.add_with(word_span, format!("{} cannot stand in a group", one(word)), help);
                return;
            }
            None => {
                let inside = parent.map(|p| self.outline.items[p].sort);
                let help = self.complaints.hint(|| hint_for_word(word, inside));
                self.complaints.add_with(word_span, format!("unknown word \"{word}\""), help);
                return;
            }
        };
        let mut item = self.new_item(node, sort, parent);
        let complaints = self.complaints.count();
        self.read_head(node, &mut item);
        let place = self.outline.items.len();
        let members = self.read_children(node, &mut item);
        // What seems to be missing may be there, misspelled.
        let misspelled = members.iter().any(|member| Sort::named(member.name().value()).is_none());
        if self.complaints.count() == complaints && !misspelled {
            self.check_extras(&item);
        }
        if self.complaints.count() == complaints {
            self.make(&mut item);
        }
        self.outline.items.push(item);
        for member in members {
            self.read_node(member, Some(place));
        }
    }

    pub(super) fn new_item(&self, node: &KdlNode, sort: Sort, parent: Option<usize>) -> Item {
        let span = span_of(node.span());
        let span = span.start..span.start + self.text[span].trim_end().len();
        let word = span_of(node.name().span());
        let last = node.entries().iter().map(|e| span_of(e.span()).end).max();
        let head_end = last.unwrap_or(word.end);
        Item::new(sort, span, word, head_end, parent)
    }

    /// Reads the name and the properties.
    fn read_head(&mut self, node: &KdlNode, item: &mut Item) {
        let complaints = self.complaints.count();
        for entry in node.entries() {
            match entry.name().map(kdl::KdlIdentifier::value) {
                None => self.read_name(entry, item),
                Some(MATERIAL) if matches!(item.sort, Sort::Shape(_) | Sort::Part) => {
                    self.read_material(entry, item);
                }
                Some(property) => match extra(item.sort, property) {
                    Some(extra) => self.read_property_extra(extra, entry, item),
                    None => self.read_property(property, entry, item),
                },
            }
        }
        if self.complaints.count() > complaints {
            // What seems to be missing may be there, misspelled.
            return;
        }
        let word = item.sort.word();
        if item.name.is_none() && !matches!(item.sort, Sort::Settings) {
            let help = format!("write {word} \"some name\" …");
            self.complaints.add_with(item.word.clone(), format!("this {word} needs a name"), help);
        }
        if item.material.is_none() && matches!(item.sort, Sort::Shape(_)) {
            let help = format!("write {word} … {MATERIAL}=\"name of a material\"");
            self.complaints.add_with(item.word.clone(), format!("this {word} needs a material"), help);
        }
    }

    fn read_name(&mut self, entry: &KdlEntry, item: &mut Item) {
        let span = value_span(entry);
        let word = item.sort.word();
        match entry.value().as_string() {
            _ if matches!(item.sort, Sort::Settings) => {
                self.complaints.add(span, "settings have no name, and their values stand in a block");
            }
            _ if item.name.is_some() => {
                let help = "numbers stand in the block of the node, after the word for what they are";
                self.complaints.add_with(
                    span,
                    format!("{} has only one name before its block", one(word)),
                    help,
                );
            }
            None => {
                let written = &self.text[span.clone()];
                let message = format!("the name of {} stands in quotes, {written} does not", one(word));
                self.complaints.add(span, message);
                item.name = Some(Word { value: String::new(), span: value_span(entry) });
            }
            Some(name) => {
                self.refuse_odd_quotes(entry);
                if name.trim().is_empty() {
                    self.complaints.add(span.clone(), "a name must not be empty");
                }
                item.name = Some(Word { value: name.to_owned(), span });
            }
        }
    }

    fn read_material(&mut self, entry: &KdlEntry, item: &mut Item) {
        let span = value_span(entry);
        let value = entry.value().as_string().unwrap_or_default().to_owned();
        self.refuse_odd_quotes(entry);
        if !entry.value().is_string() {
            self.complaints.add(span.clone(), "material needs the name of a material in quotes");
        } else if item.material.is_some() {
            self.complaints.add(span.clone(), "material is given twice");
        }
        item.material = Some(Word { value, span });
        item.worn = Some(span_of(entry.span()));
    }

    fn read_property(&mut self, name: &str, entry: &KdlEntry, item: &mut Item) {
        let span = span_of(entry.span());
        match item.sort.field(name) {
            None => self.unknown(name, entry.name().map_or(span, |n| span_of(n.span())), item.sort),
            Some(field) if !fits_property(field.kind) => {
                let (counts, numbers) = arity(field.kind);
                let letters = ["x", "y", "z", "d"];
                let letters = letters[..counts[0].min(letters.len())].join(" ");
                let help = format!("write it in the block of the node: {name} {letters}");
                self.complaints.add_with(span, format!("{name} takes {numbers}"), help);
            }
            Some(field) => {
                let written =
                    FieldText { field, span, values: Vec::new(), property: true, word: None, painted: None };
                self.read_field(written, &[entry], item);
            }
        }
    }

    /// Reads the fields and the steps of the block; answers with the members of a group, to be read later.
    fn read_children<'n>(&mut self, node: &'n KdlNode, item: &mut Item) -> Vec<&'n KdlNode> {
        let mut members = Vec::new();
        for child in node.children().map(kdl::KdlDocument::nodes).unwrap_or_default() {
            let word = child.name().value();
            let name_span = span_of(child.name().span());
            if let Some(field) = item.sort.field(word) {
                let span = span_of(child.span());
                let span = span.start..span.start + self.text[span].trim_end().len();
                let (entries, painted) = self.values_and_paint(child, field, item.sort);
                self.refuse_block(child);
                let written =
                    FieldText { field, span, values: Vec::new(), property: false, word: None, painted };
                self.read_field(written, &entries, item);
            } else if let Some(extra) = extra(item.sort, word) {
                self.read_extra(extra, child, item);
            } else if item.sort.is_entity() && STEPS.iter().any(|(step, ..)| *step == word) {
                self.read_step(child, item);
            } else if item.sort.has_members() {
                members.push(child);
            } else if Sort::named(word).is_some_and(Sort::is_entity) {
                let message = format!("{} cannot have members; only a group can", one(item.sort.word()));
                self.complaints.add(name_span, message);
            } else {
                self.unknown(word, name_span, item.sort);
            }
        }
        members
    }

    /// Reads the values of a field, `written` but for them.
    fn read_field(&mut self, mut written: FieldText, entries: &[&KdlEntry], item: &mut Item) {
        let field = written.field;
        let may_repeat = matches!(field.kind, FieldKind::Rows(_));
        if let Some(before) = item.fields.iter().find(|f| f.field.name == field.name && !may_repeat) {
            let first = before.span.start;
            self.complaints.add_again(written.span, format!("{} is given twice", field.name), first);
            return;
        }
        let value = self.read_value(field, entries, written.span.clone());
        let value = value.and_then(|value| match &written.painted {
            Some(painted) => self.paint(value, painted, field),
            None => Some(value),
        });
        match (value, item.given.get(field.name)) {
            (Some(Value::Rows(row)), Some(Value::Rows(rows))) => {
                let rows = row.iter().fold(rows.clone(), Rows::with);
                item.given.set(field.name, Value::Rows(rows));
            }
            (Some(value), _) => item.given.set(field.name, value),
            (None, _) => {}
        }
        if matches!(field.kind, FieldKind::Texture) {
            written.word = entries.first().and_then(|e| e.value().as_string()).map(str::to_owned);
        }
        written.values = entries.iter().map(|e| value_span(e)).collect();
        item.fields.push(written);
    }

    pub(super) fn refuse_block(&mut self, node: &KdlNode) {
        if let Some(first) = node.children().and_then(|c| c.nodes().first()) {
            let message = format!("{} has values, and no block", node.name().value());
            self.complaints.add(span_of(first.name().span()), message);
        }
    }

    pub(super) fn refuse_annotations(&mut self, node: &KdlNode) {
        let annotations = node.ty().into_iter().chain(node.entries().iter().filter_map(KdlEntry::ty));
        for annotation in annotations {
            let message = "type annotations in parentheses have no meaning in a scene";
            self.complaints.add_with(span_of(annotation.span()), message, "leave the parentheses away");
        }
    }
}
