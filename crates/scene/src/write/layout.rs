//! Where in the text nodes are put in and taken out, so that it looks as if a person had done it.

use crate::outline::{Item, Span};
use crate::scan;

/// What one level of blocks is indented by.
pub(crate) const INDENT: &str = "    ";

/// The start of the line on which `at` stands.
pub(crate) fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

/// White space at the start of the line on which `at` stands.
pub(crate) fn indent_at(text: &str, at: usize) -> &str {
    let line = &text[line_start(text, at)..at];
    &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
}

/// Whether only white space stands before `at` on its line.
pub(crate) fn begins_line(text: &str, at: usize) -> bool {
    text[line_start(text, at)..at].chars().all(|c| c == ' ' || c == '\t' || c == '\u{feff}')
}

/// The line end that the text uses.
pub(crate) fn newline(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

/// The end of the line on which `at` stands, past its line end.
fn line_end(text: &str, at: usize) -> usize {
    text[at..].find('\n').map_or(text.len(), |newline| at + newline + 1)
}

/// What goes when a node goes: with its line, its indentation and a comment after it on the line.
pub(crate) fn whole_node(text: &str, node: &Span) -> Span {
    let mut end = node.end + text[node.end..].len() - text[node.end..].trim_start_matches([' ', '\t']).len();
    if text[end..].starts_with(';') {
        end += 1;
    }
    let rest = text[end..line_end(text, end)].trim();
    if begins_line(text, node.start) && (rest.is_empty() || rest.starts_with("//")) {
        return line_start(text, node.start)..line_end(text, end);
    }
    end += text[end..].len() - text[end..].trim_start_matches([' ', '\t']).len();
    node.start..end
}

/// What goes when a line of a block goes: as [`whole_node`], but where others stand before it on the line, with the semicolon
/// that sets it apart from them.
pub(crate) fn taken_out(text: &str, node: &Span) -> Span {
    let before = text[line_start(text, node.start)..node.start].trim_end_matches([' ', '\t']);
    if before.ends_with(';') {
        return line_start(text, node.start) + before.len() - 1..node.end;
    }
    whole_node(text, node)
}

/// Where lines go into a block that has all it holds on the line of its braces: the place, and the text with what sets it
/// apart. `None` for other blocks, and for one that holds nothing.
pub(crate) fn in_one_line(text: &str, item: &Item, place: Place, lines: &str) -> Option<(usize, String)> {
    let block = scan::block_of(text, item.span.clone())?;
    let inside = &text[block.start + 1..block.end - 1];
    if inside.contains('\n') || inside.trim().is_empty() || inside.contains("//") {
        return None;
    }
    let lines = lines.lines().collect::<Vec<_>>().join("; ");
    Some(match place {
        Place::Start => (block.start + 1, format!(" {lines};")),
        Place::End => {
            let end = block.start + 1 + inside.trim_end().len();
            let closed = inside.trim_end().ends_with(';');
            (end, if closed { format!(" {lines};") } else { format!("; {lines}") })
        }
    })
}

/// Where in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    Start,
    End,
}

/// The end of the node's line if nothing but a comment follows it there, to put the next node after.
pub(crate) fn after_node(text: &str, node: &Span) -> Option<usize> {
    let end = line_end(text, node.end);
    let rest = text[node.end..end].trim();
    (rest.is_empty() || rest.starts_with("//") || rest == ";").then_some(end)
}

/// Where lines go in and how they are set apart from what is there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Gap {
    pub(crate) at: usize,
    before: String,
    pub(crate) indent: String,
    after: String,
}

impl Gap {
    /// At the start of a line, or the end of the text.
    pub(crate) fn at_line(text: &str, at: usize, indent: &str) -> Self {
        let broken = at == 0 || text[..at].ends_with('\n');
        let before = if broken { String::new() } else { newline(text).to_owned() };
        Self { at, before, indent: indent.to_owned(), after: newline(text).to_owned() }
    }

    /// Before `at` in the middle of a line.
    fn within_line(text: &str, at: usize, indent: &str, outer: &str) -> Self {
        let newline = newline(text);
        let after = format!("{newline}{outer}");
        Self { at, before: newline.to_owned(), indent: indent.to_owned(), after }
    }

    /// The text to put in, given lines that are indented from nothing.
    pub(crate) fn fill(&self, text: &str, lines: &str) -> String {
        let newline = newline(text);
        let indented: Vec<String> = lines
            .lines()
            .map(|line| if line.is_empty() { String::new() } else { format!("{}{line}", self.indent) })
            .collect();
        format!("{}{}{}", self.before, indented.join(newline), self.after)
    }
}

/// The gap after a node.
pub(crate) fn gap_after(text: &str, node: &Span) -> Gap {
    let indent = indent_at(text, node.start);
    match after_node(text, node) {
        Some(at) => Gap::at_line(text, at, indent),
        None => {
            let end = whole_node(text, node).end.max(node.end);
            Gap::within_line(text, end, indent, indent)
        }
    }
}

/// The gap before a node.
pub(crate) fn gap_before(text: &str, node: &Span) -> Gap {
    let indent = indent_at(text, node.start);
    if begins_line(text, node.start) {
        Gap::at_line(text, line_start(text, node.start), indent)
    } else {
        Gap::within_line(text, node.start, indent, indent)
    }
}

/// The gap at the end of an item's block; `None` if it has no block.
pub(crate) fn gap_at_end(text: &str, item: &Item) -> Option<Gap> {
    let block = scan::block_of(text, item.span.clone())?;
    let close = block.end - 1;
    let outer = indent_at(text, item.span.start);
    let indent = format!("{outer}{INDENT}");
    if begins_line(text, close) {
        Some(Gap::at_line(text, line_start(text, close), &indent))
    } else {
        Some(Gap::within_line(text, close, &indent, outer))
    }
}

/// The gap at the start of an item's block; `None` if it has no block.
pub(crate) fn gap_at_start(text: &str, item: &Item) -> Option<Gap> {
    let block = scan::block_of(text, item.span.clone())?;
    let outer = indent_at(text, item.span.start);
    let indent = format!("{outer}{INDENT}");
    let end = line_end(text, block.start);
    let rest = &text[block.start + 1..end.min(block.end)];
    if rest.trim().is_empty() && end < block.end {
        Some(Gap::at_line(text, end, &indent))
    } else {
        Some(Gap {
            after: format!("{}{indent}", newline(text)),
            ..Gap::within_line(text, block.start + 1, &indent, outer)
        })
    }
}
