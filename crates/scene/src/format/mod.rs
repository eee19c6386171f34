//! How does scene text look when it is laid out by rule? Indentation, blanks and blank lines change, and nothing else: words, numbers,
//! comments and the choice between one line and several stay.

mod pieces;
mod print;

use kdl::KdlDocument;

use crate::outline::Span;
use crate::report::{Complaints, SceneTextError};
use crate::{read, scan, slip};

/// Columns that a block on one line may reach; a longer one is written on several.
const WIDTH: usize = 140;

/// The text laid out by rule; `name` stands for it in messages. Formatting it again changes nothing.
///
/// Any KDL document can be formatted: whether it is a valid scene is not asked, and no file that it names is read.
///
/// # Errors
/// Text that is no valid KDL, with all that is wrong in it.
pub fn format(text: &str, name: &str) -> Result<String, SceneTextError> {
    let document = parsed(text, name)?;
    let formatted = print::printed(&pieces::items_of(text), newline(text));
    // Whatever this file does not know of KDL, no text comes out that says something else.
    let is_same = parsed(&formatted, name).is_ok_and(|again| says(again) == says(document));
    if is_same && comments(text) == comments(&formatted) {
        return Ok(formatted);
    }
    Err(SceneTextError::unusable(
        std::path::Path::new(name),
        "cannot be formatted without changing it".to_owned(),
    ))
}

fn newline(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

fn parsed(text: &str, name: &str) -> Result<KdlDocument, SceneTextError> {
    let mut complaints = Complaints::new();
    match read::document(text, &mut complaints) {
        Some(document) => Ok(document),
        None => {
            if let Some(mended) = slip::mend(text) {
                complaints = Complaints::new();
                mended.tell(&mut complaints);
            }
            Err(complaints.into_error(name, text))
        }
    }
}

/// The document without its layout.
fn says(mut document: KdlDocument) -> KdlDocument {
    document.clear_format_recursive();
    document
}

/// All comments, without blanks at their ends, whatever ends their lines.
fn comments(text: &str) -> Vec<String> {
    let comment = |place: Span| text[place].trim_end().replace("\r\n", "\n");
    scan::comments(text, 0..text.len()).into_iter().map(comment).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formatted(text: &str) -> String {
        format(text, "text").unwrap()
    }

    #[test]
    fn blanks_and_blank_lines_follow_rules() {
        let text = "\n\n  sphere   \"a\"  material = \"m\" {center 0  1 0;radius 1}\n\n\n\nplane \"b\" {\n\n normal 0 1 0\n   point 0 0 0 ; hidden #true\n\n}";
        let wanted = "sphere \"a\" material=\"m\" { center 0 1 0; radius 1 }\n\nplane \"b\" {\n    normal 0 1 0\n    point 0 0 0; hidden #true\n}\n";
        assert_eq!(formatted(text), wanted);
        assert_eq!(formatted(wanted), wanted);
        assert_eq!(formatted(""), "");
        assert_eq!(formatted("a {}\nb { }\nc {\n}"), "a {}\nb {}\nc {}\n");
    }

    #[test]
    fn comments_stay_where_they_are() {
        let text = "// top\r\n/* long\n   one */\na   { // at a\n  b 1      // of b\n\n  // alone\n  /- c 2\n d /* in */ 3\n  }\n// end";
        let wanted = "// top\n/* long\n   one */\na {  // at a\n    b 1  // of b\n\n    // alone\n    /-c 2\n    d /* in */ 3\n}\n// end\n";
        assert_eq!(formatted(text).replace("\r\n", "\n"), wanted);
        assert_eq!(formatted(wanted), wanted);
    }

    #[test]
    fn long_blocks_are_broken_and_strings_are_whole() {
        let field = "length 1234567890; ".repeat(9);
        let text = format!(
            "a \"x  {{ y\" #\"raw \" {{\"# {{ {field} }}\nb \"\"\"\n  two\n    lines\n  \"\"\"\nc \\\n   1\n"
        );
        let out = formatted(&text);
        assert!(out.starts_with("a \"x  { y\" #\"raw \" {\"# {\n    length 1234567890\n    length"), "{out}");
        assert!(out.ends_with("}\nb \"\"\"\n  two\n    lines\n  \"\"\"\nc \\\n    1\n"), "{out}");
        assert_eq!(formatted(&out), out);
    }

    #[test]
    fn what_is_no_scene_text_is_told_with_its_place() {
        let error = format!("{:?}", miette::Report::new(format("a {\n b 1\n", "x.kdl").unwrap_err()));
        assert!(error.contains("x.kdl:1"), "{error}");
        assert!(format("a \"b", "x").is_err());
    }
}
