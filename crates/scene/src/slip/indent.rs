//! Which blocks are told by nothing but their indentation?

use super::lex::Kind;
use super::structure::Builder;
use super::{Help, Touch};

/// No line is indented by more bytes.
const WIDEST_INDENT: usize = 1000;

impl Builder<'_> {
    /// `camera:` opens a block where the next line is indented further.
    pub(super) fn open_indented(&mut self, statement: usize, line: usize) {
        let own = &self.out.statements[statement];
        let next = self.tokens[line..].iter().find(|token| token.kind != Kind::Line);
        let colon = own.tokens.last().is_some_and(|last| self.text[last.span.clone()].ends_with(':'));
        let (Some(next), true, Some(_)) = (next, colon, own.sort(self.text)) else { return };
        let (Some(here), Some(there)) =
            (indent(self.text, own.span.start), indent(self.text, next.span.start))
        else {
            return;
        };
        if here < there && matches!(next.kind, Kind::Word | Kind::Text) {
            let end = own.span.end;
            let message = "a block stands between { and }".to_owned();
            let edit = (end..end, " {".to_owned());
            self.out.touches.push(Touch { at: end - 1..end, edit, message, help: Help::Statement("") });
            self.out.statements[statement].open = Some(end);
            self.indented.push((here, self.stack.len()));
            self.stack.push(statement);
        }
    }

    /// Such a block ends where a line is indented no further than the statement that opened it.
    pub(super) fn close_indented(&mut self, at: usize) {
        while let Some(&(there, depth)) = self.indented.last()
            && indent(self.text, at).is_some_and(|here| here <= there)
        {
            self.indented.pop();
            self.stack.truncate(depth);
            self.silent(at, "};");
        }
    }
}

/// Whether what begins a line at `at` stands no further to the right than the node at `owner`, whose block opens on an
/// earlier line.
pub(super) fn is_left_of(text: &str, at: usize, owner: usize, open: usize) -> bool {
    match (indent(text, at), indent(text, owner)) {
        (Some(here), Some(there)) => here <= there && text[open..at].contains('\n'),
        _ => false,
    }
}

/// How far the line is indented that begins with what stands at `at`; `None` if something stands before it.
pub(super) fn indent(text: &str, at: usize) -> Option<usize> {
    let from = text.floor_char_boundary(at.saturating_sub(WIDEST_INDENT));
    let before = &text[from..at];
    let before = &before[before.rfind('\n').map_or(0, |newline| newline + 1)..];
    before.trim().is_empty().then(|| before.chars().count())
}
