//! How scene text is read: KDL nodes to an [`Outline`], by the lists of kinds and fields of the core.
//!
//! Everything that is wrong is noted and reading goes on, so that one look tells all.

mod extra;
mod files;
mod make;
mod node;
mod paint;
mod placement;
mod value;

use std::collections::HashMap;

use catoptra_core::TextureId;
use kdl::KdlDocument;

use crate::outline::{Outline, Sort, Span};
use crate::report::Complaints;
use crate::scan;
pub(crate) use extra::{FILE, REMOVE, next};
pub(crate) use files::Files;
pub(crate) use node::MATERIAL;
pub(crate) use paint::{CHANNEL, TEXTURE};
pub(crate) use placement::{ABOUT, STEPS};
pub(crate) use value::{arity, is_word};

/// Longer scene text is refused: the parser needs about a second for each megabyte.
pub(crate) const LONGEST: usize = 16 << 20;

/// Bytes of stack for the parser; the system gives memory for what is used of it.
const DEEP_STACK: usize = 256 << 20;

/// What the text says; what is wrong with it goes to `complaints`. The names of textures stand for `textures`, where the
/// scene is there already, else for new ones.
pub(crate) fn read(
    text: &str,
    textures: Option<HashMap<String, TextureId>>,
    files: &mut Files,
    complaints: &mut Complaints,
) -> Outline {
    let mut outline = Outline::default();
    if let Some(document) = document(text, complaints) {
        let textures = textures.unwrap_or_else(|| paint::textures_of(&document, files));
        outline.textures.clone_from(&textures);
        let watch = files.watch.clone();
        watch.start(text.len());
        let mut reader = Reader { text, files, complaints, textures: &textures, outline: &mut outline };
        for node in document.nodes() {
            reader.read_node(node, None);
            watch.advance(node.span().len());
        }
    }
    outline
}

/// The text as nodes, whatever they say; what is wrong with it goes to `complaints`.
pub(crate) fn document(text: &str, complaints: &mut Complaints) -> Option<KdlDocument> {
    if text.len() > LONGEST {
        complaints.add(0..0, format!("the text is longer than {} MiB", LONGEST >> 20));
        return None;
    }
    if let Some(at) = scan::too_deep(text) {
        let message = format!("blocks or comments lie more than {} deep inside each other", scan::DEEPEST);
        complaints.add(at..at + 1, message);
        return None;
    }
    match parse_kdl(&scan::without_comments(text)) {
        Ok(document) => Some(document),
        Err(error) => {
            syntax(text, &error, complaints);
            None
        }
    }
}

/// Parses on a stack of its own where there is room for one: the parser calls itself for every error that it meets.
fn parse_kdl(text: &str) -> Result<KdlDocument, kdl::KdlError> {
    std::thread::scope(|scope| {
        let deep = std::thread::Builder::new().stack_size(DEEP_STACK);
        match deep.spawn_scoped(scope, || KdlDocument::parse_v2(text)) {
            Ok(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(_) => KdlDocument::parse_v2(text),
        }
    })
}

/// What reading needs at hand.
struct Reader<'a> {
    text: &'a str,
    files: &'a mut Files,
    complaints: &'a mut Complaints,
    textures: &'a HashMap<String, TextureId>,
    outline: &'a mut Outline,
}

/// A place as the KDL library gives it.
fn span_of(span: miette::SourceSpan) -> Span {
    span.offset()..span.offset() + span.len()
}

/// Passes on the first thing that the KDL library complains about: the others follow from it.
fn syntax(text: &str, error: &kdl::KdlError, complaints: &mut Complaints) {
    let form = "a node is written: word \"name\" { field value; field value }";
    let Some(found) = error.diagnostics.first() else {
        return complaints.add_with(0..0, "this is no scene text", form);
    };
    let span = span_of(found.span);
    let line = text.get(span.clone()).unwrap_or_default().split('\n').next().unwrap_or_default();
    let end = span.start + line.len();
    let what = found.message.as_deref().unwrap_or("no valid KDL");
    complaints.add_with(span.start..end, format!("this cannot be read as scene text ({what})"), form);
}

/// The words that can stand as nodes at the top or in what is `inside`.
fn hint_for_word(word: &str, inside: Option<Sort>) -> String {
    let mut known = Sort::words(inside.is_some());
    known.extend(inside.into_iter().flat_map(extra::words_for));
    crate::words::hint(word, &known, "known words")
}
