//! How scene text is read: KDL nodes to an [`Outline`], by the lists of kinds and fields of the core.
//!
//! Everything that is wrong is noted and reading goes on, so that one look tells all.

mod meshes;
mod node;
mod placement;
mod value;

use kdl::KdlDocument;

use crate::outline::{Outline, Sort, Span};
use crate::report::Complaints;
use crate::scan;
pub(crate) use meshes::Meshes;
pub(crate) use node::MATERIAL;

/// Longer scene text is refused: the parser needs about a second for each megabyte.
pub(crate) const LONGEST: usize = 16 << 20;

/// What the text says; what is wrong with it goes to `complaints`.
pub(crate) fn read(text: &str, meshes: &mut Meshes, complaints: &mut Complaints) -> Outline {
    let mut outline = Outline::default();
    if text.len() > LONGEST {
        complaints.add(0..0, format!("the text is longer than {} MiB", LONGEST >> 20));
        return outline;
    }
    if let Some(at) = scan::too_deep(text) {
        let message = format!("blocks or comments lie more than {} deep inside each other", scan::DEEPEST);
        complaints.add(at..at + 1, message);
        return outline;
    }
    match KdlDocument::parse_v2(text) {
        Ok(document) => {
            let mut reader = Reader { text, meshes, complaints, outline: &mut outline };
            for node in document.nodes() {
                reader.read_node(node, None);
            }
        }
        Err(error) => syntax(text, &error, complaints),
    }
    outline
}

/// What reading needs at hand.
struct Reader<'a> {
    text: &'a str,
    meshes: &'a mut Meshes,
    complaints: &'a mut Complaints,
    outline: &'a mut Outline,
}

/// A place as the KDL library gives it.
fn span_of(span: miette::SourceSpan) -> Span {
    span.offset()..span.offset() + span.len()
}

/// Passes on what the KDL library complains about, with hints for slips that it does not know.
fn syntax(text: &str, error: &kdl::KdlError, complaints: &mut Complaints) {
    if let Some(at) = scan::unclosed_comment(text) {
        complaints.add_with(at..at + 2, "this comment is never closed", "close it with */");
        return;
    }
    for found in &error.diagnostics {
        let span = span_of(found.span);
        let message = found.message.clone().unwrap_or_else(|| "this is no valid KDL".to_owned());
        let word = text.get(span.clone()).unwrap_or_default().trim();
        let help = match word {
            "true" | "false" | "null" | "inf" | "-inf" | "nan" => Some(format!("write #{word}")),
            "}" if message.contains("end of document") => Some("there is no block to close here".to_owned()),
            _ => found.help.clone(),
        };
        match help {
            Some(help) => complaints.add_with(span, message, help),
            None => complaints.add(span, message),
        }
    }
    if error.diagnostics.is_empty() {
        complaints.add(0..0, "this is no valid KDL");
    }
}

/// The words that can stand as nodes at the top or, with `in_group`, in a group.
fn hint_for_word(word: &str, in_group: bool) -> String {
    crate::words::hint(word, &Sort::words(in_group), "known words")
}
