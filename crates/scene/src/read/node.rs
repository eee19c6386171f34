//! How a node is read: its kind, its name, its fields, its placement and, for a group, its members.

use catoptra_core::{Field, FieldKind, Placement, Rows, Value, Values};
use kdl::{KdlEntry, KdlNode};

use super::placement::STEPS;
use super::value::{arity, fits_property, value_span};
use super::{Reader, hint_for_word, span_of};
use crate::outline::{FieldText, Item, Sort, Span, Word};
use crate::words;

/// The property that names the material of a shape.
pub(crate) const MATERIAL: &str = "material";

/// The word for the path of a model.
const FILE: &str = "file";

/// The word that leaves a part of a model out.
pub(crate) const REMOVE: &str = "remove";

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
                let help = self.complaints.hint(|| hint_for_word(word, in_group));
                self.complaints.add_with(word_span, format!("unknown word \"{word}\""), help);
                return;
            }
        };
        let mut item = self.new_item(node, sort, parent);
        let complaints = self.complaints.count();
        self.read_head(node, &mut item);
        let place = self.outline.items.len();
        let members = self.read_children(node, &mut item);
        if matches!(sort, Sort::Model) && item.model.is_none() && self.complaints.count() == complaints {
            let help = "write model \"some name\" { file \"path of a model file\" }";
            self.complaints.add_with(item.word.clone(), "this model needs a file", help);
        }
        if self.complaints.count() == complaints {
            self.make(&mut item);
        }
        self.outline.items.push(item);
        for member in members {
            self.read_node(member, Some(place));
        }
    }

    fn new_item(&self, node: &KdlNode, sort: Sort, parent: Option<usize>) -> Item {
        let span = span_of(node.span());
        let word = span_of(node.name().span());
        let last = node.entries().iter().map(|e| span_of(e.span()).end).max();
        Item {
            sort,
            span: span.start..span.start + self.text[span].trim_end().len(),
            head_end: last.unwrap_or(word.end),
            word,
            name: None,
            material: None,
            fields: Vec::new(),
            steps: Vec::new(),
            placement: Placement::IDENTITY,
            given: Values::new(),
            part: None,
            parent,
            model: None,
            removed: false,
        }
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
                Some(FILE) if matches!(item.sort, Sort::Model) => {
                    self.read_model(&[entry], span_of(entry.span()), item);
                }
                Some(REMOVE) if matches!(item.sort, Sort::Part) => {
                    self.read_remove(&[entry], span_of(entry.span()), item);
                }
                Some(property) => self.read_property(property, entry, item),
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
            } else if matches!((item.sort, word), (Sort::Model, FILE) | (Sort::Part, REMOVE)) {
                let entries = self.arguments(child);
                self.refuse_block(child);
                if word == FILE {
                    self.read_model(&entries, name_span, item);
                } else {
                    self.read_remove(&entries, name_span, item);
                }
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

    /// Reads the path of a model, and the model.
    fn read_model(&mut self, entries: &[&KdlEntry], span: Span, item: &mut Item) {
        let &[entry] = entries else {
            return self.complaints.add(span, "file takes one path in quotes");
        };
        if item.model.is_some() {
            return self.complaints.add(span, "file is given twice");
        }
        self.refuse_odd_quotes(entry);
        let Some(path) = entry.value().as_string() else {
            return self.complaints.add(value_span(entry), "file needs the path of a model in quotes");
        };
        match self.files.model(path) {
            Ok(model) => item.model = Some(model),
            Err(message) => {
                let help = "the path of a model is relative to the folder of the scene file";
                self.complaints.add_with(value_span(entry), message, help);
            }
        }
    }

    /// Reads whether a part is left out.
    fn read_remove(&mut self, entries: &[&KdlEntry], span: Span, item: &mut Item) {
        match entries.first().and_then(|entry| entry.value().as_bool()) {
            Some(removed) if entries.len() == 1 => item.removed = removed,
            _ => self.complaints.add(span, "remove takes #true or #false"),
        }
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

    /// Makes the part, or passes on why the core refuses it.
    fn make(&mut self, item: &mut Item) {
        match item.sort.make(&item.given) {
            Ok(part) => item.part = Some(part),
            Err(invalid) => {
                let written = item.fields.iter().find(|f| f.field.name == invalid.field());
                let span = written.map_or(item.word.clone(), |f| f.span.clone());
                if written.is_some() || !missing(item, invalid.field()) {
                    match invalid.hint() {
                        Some(hint) => self.complaints.add_with(span, invalid.to_string(), hint),
                        None => self.complaints.add(span, invalid.to_string()),
                    }
                } else {
                    let (word, field) = (item.sort.word(), invalid.field());
                    self.complaints.add_with(
                        span,
                        format!("this {word} needs {}", one(field)),
                        needs(item.sort, field),
                    );
                }
            }
        }
    }

    fn unknown(&mut self, name: &str, span: Span, sort: Sort) {
        let mut known: Vec<&str> = sort.fields().map(|f| f.name).collect();
        if matches!(sort, Sort::Shape(_)) {
            known.push(MATERIAL);
        }
        if sort.is_entity() {
            known.extend(STEPS.iter().map(|(step, ..)| *step));
        }
        let message = format!(
            "{} has no \"{name}\"{}",
            one(sort.word()),
            if name == MATERIAL { " in its block" } else { "" }
        );
        let help = match name {
            MATERIAL if matches!(sort, Sort::Shape(_)) => {
                format!("it stands before the block: {} … {MATERIAL}=\"name of a material\" {{", sort.word())
            }
            _ => self.complaints.hint(|| words::hint(name, &known, "what it has")),
        };
        self.complaints.add_with(span, message, help);
    }

    fn refuse_block(&mut self, node: &KdlNode) {
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

fn missing(item: &Item, field: &str) -> bool {
    item.sort.field(field).is_some_and(|f| f.default.is_none())
}

/// What has to be given, for hints.
fn needs(sort: Sort, missing: &str) -> String {
    let needed =
        |field: &&'static Field| field.default.is_none() && (!field.may_be_missing || field.name == missing);
    let required: Vec<&str> = sort.fields().filter(needed).map(|f| f.name).collect();
    format!("{} must be given {}", one(sort.word()), required.join(", "))
}

/// A word with its article; settings are many.
fn one(word: &str) -> String {
    match word.chars().next() {
        _ if word == Sort::Settings.word() => word.to_owned(),
        Some('a' | 'e' | 'i' | 'o' | 'u') => format!("an {word}"),
        _ => format!("a {word}"),
    }
}
