//! Which piece of a text is shown round a place that is complained about?
//!
//! The line of the place and its neighbours; of long lines only what is near. What is shown is [`printable`] and knows
//! where in the whole text it stands, so that line and column are those of the text.
//!
//! [`printable`]: crate::printable()

use std::ops::Range;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

use crate::printable::push_shown;

/// Lines of more characters are cut.
const WIDEST: usize = 120;

/// Characters shown before a place in a line that is cut.
const BEFORE: usize = 40;

/// Characters shown from a place on in a line that is cut.
const FROM: usize = 70;

/// A piece of a text.
#[derive(Debug, Clone)]
pub(crate) struct Excerpt {
    name: String,
    text: String,
    /// The place, in bytes of `text`.
    mark: Range<usize>,
    /// The line of the whole text, from 0, that `text` begins with.
    first: usize,
    /// Column of the place in the whole text, from 0.
    column: usize,
}

impl Excerpt {
    /// The piece of `text` round `span`, which stands at `line` and `column` (both from 1).
    pub(crate) fn new(name: &str, text: &str, span: Range<usize>, line: usize, column: usize) -> Self {
        let start = text[..span.start].rfind('\n').map_or(0, |newline| newline + 1);
        let end = text[span.start..].find('\n').map_or(text.len(), |newline| span.start + newline);
        let mut shown = String::new();
        if start > 0 {
            let before = text[..start - 1].rfind('\n').map_or(0, |newline| newline + 1);
            push_line(&mut shown, &text[before..start - 1]);
        }
        let here = text[start..end].trim_end_matches('\r');
        let span = span.start - start..span.end.min(start + here.len()).max(span.start) - start;
        let mark = push_marked(&mut shown, here, span.start.min(here.len())..span.end.min(here.len()));
        shown.push('\n');
        if end < text.len() {
            let after = text[end + 1..].find('\n').map_or(text.len(), |newline| end + 1 + newline);
            push_line(&mut shown, &text[end + 1..after]);
        }
        let first = line - 1 - usize::from(start > 0);
        Self { name: name.to_owned(), text: shown, mark, first, column: column - 1 }
    }

    /// The place within what is shown.
    pub(crate) fn mark(&self) -> SourceSpan {
        self.mark.clone().into()
    }
}

/// A neighbouring line, as far as it fits.
fn push_line(out: &mut String, line: &str) {
    push_marked(out, line.trim_end_matches('\r'), 0..0);
    out.push('\n');
}

/// What is near `span` of a line; answers with where that is in `out`.
fn push_marked(out: &mut String, line: &str, span: Range<usize>) -> Range<usize> {
    let short = line.chars().nth(WIDEST).is_none();
    let left = if short {
        0
    } else {
        line[..span.start].char_indices().rev().take(BEFORE).last().map_or(span.start, |(at, _)| at)
    };
    let rest = &line[span.start..];
    let right = if short {
        line.len()
    } else {
        rest.char_indices().nth(FROM).map_or(line.len(), |(at, _)| span.start + at)
    };
    if left > 0 {
        out.push('…');
    }
    let mut mark = out.len()..out.len();
    for (at, c) in line[left..right].char_indices() {
        if left + at == span.start {
            mark = out.len()..out.len();
        }
        if c == '\t' {
            out.push(c);
        } else {
            push_shown(out, c);
        }
        if (span.start..span.end).contains(&(left + at)) {
            mark.end = out.len();
        }
    }
    if span.start >= right {
        mark = out.len()..out.len();
    }
    if right < line.len() {
        out.push('…');
    }
    mark
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let piece = self.text.read_span(span, before, after)?;
        let is_place = before == 0 && span.offset() == self.mark.start;
        let column = if is_place { self.column } else { piece.column() };
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            piece.data(),
            *piece.span(),
            self.first + piece.line(),
            column,
            piece.line_count(),
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_line_only_what_is_near_is_shown() {
        let text = format!("first\n{}wrong {}\n{}", "a ".repeat(5000), "b ".repeat(5000), "c".repeat(9000));
        let at = text.find("wrong").unwrap();
        let excerpt = Excerpt::new("x.kdl", &text, at..at + 5, 2, at - 5);
        assert!(excerpt.text.len() < 400, "{}", excerpt.text);
        assert_eq!(&excerpt.text[excerpt.mark.clone()], "wrong");
        let contents = excerpt.read_span(&excerpt.mark(), 0, 0).unwrap();
        assert_eq!((contents.line(), contents.column()), (1, at - 6));
    }

    #[test]
    fn the_mark_stays_on_its_word_behind_escapes() {
        let text = "a \u{1b}[2J wrong";
        let at = text.find("wrong").unwrap();
        let excerpt = Excerpt::new("x.kdl", text, at..at + 5, 1, 8);
        assert_eq!(excerpt.text, "a \\u{1b}[2J wrong\n");
        assert_eq!(&excerpt.text[excerpt.mark], "wrong");
    }
}
