//! How the value of a field is read from the values of a KDL node.

use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::{Field, FieldKind, Rgb, Rows, Value};
use kdl::{KdlEntry, KdlValue};

use super::{Files, Reader, span_of};
use crate::outline::{Span, Word};
use crate::{slip, words};

/// How many values a kind of field takes: the numbers allowed, and in words.
pub(crate) fn arity(kind: FieldKind) -> (&'static [usize], &'static str) {
    match kind {
        FieldKind::Point | FieldKind::Direction | FieldKind::Rows(3) => (&[3], "three numbers"),
        FieldKind::Rows(2) => (&[2], "two numbers"),
        FieldKind::Rows(_) => (&[4], "four numbers"),
        FieldKind::Color | FieldKind::Quantity => (&[3, 1], "three numbers (red green blue) or one (grey)"),
        FieldKind::Choice(_) => (&[1], "one word"),
        FieldKind::Mesh => (&[1], "the path of a mesh file"),
        FieldKind::Profile => (&[1], "the path of an IES file"),
        FieldKind::Image => (&[1], "the path of a picture"),
        FieldKind::Texture => (&[1], "the name of a texture"),
        FieldKind::Pair => (&[2, 1], "two numbers or one"),
        FieldKind::Flag => (&[1], "#true or #false"),
        FieldKind::Angle => (&[1], "one number (degrees)"),
        FieldKind::Number | FieldKind::Length | FieldKind::Count | FieldKind::Fraction => {
            (&[1], "one number")
        }
    }
}

/// Whether a value of that kind is a word or a path in quotes.
pub(crate) fn is_word(kind: FieldKind) -> bool {
    matches!(
        kind,
        FieldKind::Choice(_) | FieldKind::Mesh | FieldKind::Profile | FieldKind::Image | FieldKind::Texture
    )
}

/// Whether a field of that kind can be written as a property.
pub(super) fn fits_property(kind: FieldKind) -> bool {
    arity(kind).0.contains(&1)
}

/// The bytes of an entry's value, without the name of a property or a type annotation.
pub(super) fn value_span(entry: &KdlEntry) -> Span {
    let span = span_of(entry.span());
    let length = entry.format().map_or(span.len(), |format| format.value_repr.len());
    span.end.saturating_sub(length).max(span.start)..span.end
}

impl Reader<'_> {
    /// Reads the value of a field from its entries; `span` stands for the field as a whole.
    pub(super) fn read_value(&mut self, field: &Field, entries: &[&KdlEntry], span: Span) -> Option<Value> {
        let (counts, words) = arity(field.kind);
        if !counts.contains(&entries.len()) {
            let found = entries.len();
            self.complaints
                .add(span, format!("{} takes {words}, not {found} value{}", field.name, plural(found)));
            return None;
        }
        if is_word(field.kind) {
            self.refuse_odd_quotes(entries[0]);
        }
        match field.kind {
            FieldKind::Flag => self.read_flag(field, entries[0]),
            FieldKind::Choice(choices) => self.read_choice(field, choices, entries[0]),
            FieldKind::Mesh => {
                self.read_file(field, entries[0], "mesh", |files, path| files.mesh(path).map(Value::Mesh))
            }
            FieldKind::Profile => self.read_file(field, entries[0], "profile", |files, path| {
                files.profile(path).map(Value::Profile)
            }),
            FieldKind::Image => self
                .read_file(field, entries[0], "picture", |files, path| files.image(path).map(Value::Image)),
            FieldKind::Texture => self.read_texture(field, entries[0]),
            FieldKind::Pair => {
                let x = self.read_number(field.name, entries[0])?;
                let y = entries.get(1).map_or(Some(x), |entry| self.read_number(field.name, entry))?;
                Some(Value::Pair(DVec2::new(x, y)))
            }
            FieldKind::Point | FieldKind::Direction => {
                let [x, y, z] = self.read_three(field.name, entries)?;
                Some(Value::Vector(DVec3::new(x, y, z)))
            }
            FieldKind::Rows(_) => {
                let numbers = self.read_numbers(field.name, entries)?;
                Some(Value::Rows(Rows::default().with(&numbers)))
            }
            FieldKind::Color | FieldKind::Quantity if entries.len() == 1 => {
                self.read_number(field.name, entries[0]).map(|v| Value::Color(Rgb::grey(v)))
            }
            FieldKind::Color | FieldKind::Quantity => {
                let [r, g, b] = self.read_three(field.name, entries)?;
                Some(Value::Color(Rgb::new(r, g, b)))
            }
            FieldKind::Angle => {
                self.read_number(field.name, entries[0]).map(|v| Value::Number(v.to_radians()))
            }
            FieldKind::Number | FieldKind::Length | FieldKind::Count | FieldKind::Fraction => {
                self.read_number(field.name, entries[0]).map(Value::Number)
            }
        }
    }

    /// Three numbers; every one of them that is wrong is complained about.
    pub(super) fn read_three(&mut self, name: &str, entries: &[&KdlEntry]) -> Option<[f64; 3]> {
        self.read_numbers(name, entries)?.try_into().ok()
    }

    /// A number for each entry; every one of them that is wrong is complained about.
    fn read_numbers(&mut self, name: &str, entries: &[&KdlEntry]) -> Option<Vec<f64>> {
        let numbers: Vec<Option<f64>> = entries.iter().map(|entry| self.read_number(name, entry)).collect();
        numbers.into_iter().collect()
    }

    /// A finite number.
    pub(super) fn read_number(&mut self, name: &str, entry: &KdlEntry) -> Option<f64> {
        let value = match entry.value() {
            KdlValue::Integer(v) => *v as f64,
            KdlValue::Float(v) => *v,
            KdlValue::String(_) | KdlValue::Bool(_) | KdlValue::Null => {
                self.expect("a number", name, entry);
                return None;
            }
        };
        if value.is_finite() {
            return Some(value);
        }
        let span = value_span(entry);
        let written = &self.text[span.clone()];
        self.complaints.add(span, format!("{name} needs finite numbers, not {written}"));
        None
    }

    fn read_flag(&mut self, field: &Field, entry: &KdlEntry) -> Option<Value> {
        let flag = entry.value().as_bool();
        if flag.is_none() {
            self.expect("#true or #false", field.name, entry);
        }
        flag.map(Value::Flag)
    }

    fn read_choice(&mut self, field: &Field, choices: &[&str], entry: &KdlEntry) -> Option<Value> {
        let Some(word) = entry.value().as_string() else {
            self.expect("a word", field.name, entry);
            return None;
        };
        if choices.contains(&word) {
            return Some(Value::Word(word.to_owned()));
        }
        let message = format!("{} is one of {}, not \"{word}\"", field.name, choices.join(", "));
        self.complaints.add_with(value_span(entry), message, words::hint(word, choices, "choices"));
        None
    }

    /// Reads a path, and by `get` the file that lies there: a `sort` of file.
    fn read_file(
        &mut self,
        field: &Field,
        entry: &KdlEntry,
        sort: &str,
        get: fn(&mut Files, &str) -> Result<Value, String>,
    ) -> Option<Value> {
        let Some(path) = entry.value().as_string() else {
            self.expect("a path in quotes", field.name, entry);
            return None;
        };
        match get(self.files, path) {
            Ok(value) => Some(value),
            Err(message) => {
                let span = value_span(entry);
                let escaped =
                    self.text[span.clone()].starts_with('"') && self.text[span.clone()].contains('\\');
                let help = if escaped {
                    let slashed = self.text[span.clone()].replace("\\\\", "\\").replace('\\', "/");
                    format!("a \\ in quotes must be written \\\\ or /: write {slashed}")
                } else {
                    format!("the path of a {sort} is relative to the folder of the scene file")
                };
                self.complaints.add_with(span, message, help);
                None
            }
        }
    }

    fn read_texture(&mut self, field: &Field, entry: &KdlEntry) -> Option<Value> {
        let Some(name) = entry.value().as_string() else {
            self.expect("the name of a texture in quotes", field.name, entry);
            return None;
        };
        let name = Word { value: name.to_owned(), span: value_span(entry) };
        self.texture_of(&name).map(Value::Texture)
    }

    fn expect(&mut self, what: &str, name: &str, entry: &KdlEntry) {
        let span = value_span(entry);
        let written = &self.text[span.clone()];
        let message = format!("{name} needs {what}, not {written}");
        match meant(what, written) {
            Some(word) => self.complaints.add_with(span, message, format!("write {word}")),
            None => self.complaints.add(span, message),
        }
    }

    /// Complains of a word without quotes that begins with a mark used for one elsewhere.
    pub(super) fn refuse_odd_quotes(&mut self, entry: &KdlEntry) {
        let span = value_span(entry);
        if self.text[span.clone()].starts_with(slip::is_odd_quote) {
            let help = "write it as in \"white\"";
            self.complaints.add_with(span, "names and paths stand in double quotes", help);
        }
    }
}

/// What scene text has for a word of another language.
fn meant(what: &str, written: &str) -> Option<String> {
    let word = written.trim_matches('"').trim_start_matches('#').to_ascii_lowercase();
    if what.starts_with("#true") {
        return match word.as_str() {
            "true" | "yes" | "on" | "1" => Some("#true".to_owned()),
            "false" | "no" | "off" | "0" => Some("#false".to_owned()),
            _ => None,
        };
    }
    let number = written.trim_matches('"');
    (what == "a number" && number != written && number.parse::<f64>().is_ok_and(f64::is_finite))
        .then(|| format!("{number} without quotes"))
}

pub(super) fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}
