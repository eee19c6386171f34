//! What a node makes of its values, and what is said where it cannot or where it has no such value.

use catoptra_core::Field;

use super::Reader;
use super::node::MATERIAL;
use super::placement::STEPS;
use crate::flags::FLAGS;
use crate::outline::{Item, Sort, Span};
use crate::words;

impl Reader<'_> {
    /// Makes the part, or passes on why the core refuses it.
    pub(super) fn make(&mut self, item: &mut Item) {
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

    pub(super) fn unknown(&mut self, name: &str, span: Span, sort: Sort) {
        let mut known: Vec<&str> = sort.fields().map(|f| f.name).collect();
        if matches!(sort, Sort::Shape(_)) {
            known.push(MATERIAL);
        }
        if sort.is_entity() {
            known.extend(STEPS.iter().map(|(step, ..)| *step));
            known.extend(FLAGS.iter().map(|flag| flag.word));
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
pub(super) fn one(word: &str) -> String {
    match word.chars().next() {
        _ if word == Sort::Settings.word() => word.to_owned(),
        Some('a' | 'e' | 'i' | 'o' | 'u') => format!("an {word}"),
        _ => format!("a {word}"),
    }
}
