//! Where is a `{` or a `}` missing?

use super::indent::is_left_of;
use super::structure::{Builder, Statement};
use crate::outline::Sort;

impl Builder<'_> {
    /// A node cannot stand in a block that has no members: the block was meant to end before it. So was one that lies
    /// deeper than the node, if more blocks are open than are closed.
    pub(super) fn close_what_was_left_open(&mut self, at: usize) {
        while self.missing > 0
            && let Some(&owner) = self.stack.last()
        {
            let statement = &self.out.statements[owner];
            let begins = self
                .current
                .first()
                .and_then(|token| Sort::named(self.text[token.span.clone()].split([':', '=', '(']).next()?));
            let ends = match (begins, statement.sort(self.text), statement.open) {
                (Some(_), Some(sort), Some(open)) => {
                    !sort.has_members() || is_left_of(self.text, at, statement.span.start, open)
                }
                _ => false,
            };
            if !ends {
                return;
            }
            self.missing -= 1;
            self.stack.pop();
            self.never_closed(owner, at, "};");
        }
    }

    pub(super) fn never_closed(&mut self, owner: usize, at: usize, new: &str) {
        let statement = &self.out.statements[owner];
        let Some(open) = statement.open else { return };
        let message = format!("the block of this {} is never closed", statement.word(self.text));
        self.alone(
            open..open + 1,
            (at..at, new.to_owned()),
            message,
            "close it with } behind its last field",
        );
    }

    /// A brace closes what a node has not opened: its fields stand behind it.
    pub(super) fn open_what_was_not_opened(&mut self) -> bool {
        let statements = &self.out.statements;
        let is_field = |sort: Sort, word: &str| sort.field(word).is_some();
        let tail = statements
            .iter()
            .rposition(|s| s.parent.is_none() && s.open.is_none() && s.sort(self.text).is_some());
        let Some((owner, sort)) = tail.and_then(|i| Some((i, statements[i].sort(self.text)?))) else {
            return false;
        };
        let inner = statements[owner]
            .tokens
            .iter()
            .skip(1)
            .find(|token| is_field(sort, &self.text[token.span.clone()]));
        let follow = &statements[owner + 1..];
        let at = match inner {
            Some(token) => token.span.start,
            None if !follow.is_empty()
                && follow.iter().all(|s| is_field(sort, s.word(self.text)) || s.parent.is_some()) =>
            {
                statements[owner].span.end
            }
            None => return false,
        };
        let within = inner.is_some();
        for statement in &mut self.out.statements[owner + 1..] {
            statement.parent = statement.parent.or(Some(owner));
        }
        if within {
            self.split(owner, at);
        }
        let message =
            format!("the block of this {} is never opened", self.out.statements[owner].word(self.text));
        let ended = self.text[at..]
            .find(|c: char| !c.is_whitespace())
            .filter(|i| self.text[at + i..].starts_with(';'));
        let edit = (at..ended.map_or(at, |i| at + i + 1), " { ".to_owned());
        self.alone(at..at, edit, message, "write { before its first field");
        self.out.statements[owner].open = Some(at);
        true
    }

    /// Makes two statements of one.
    fn split(&mut self, i: usize, at: usize) {
        let statement = &mut self.out.statements[i];
        let place = statement
            .tokens
            .iter()
            .position(|token| token.span.start >= at)
            .unwrap_or(statement.tokens.len());
        let tokens = statement.tokens.split_off(place);
        let span = at..statement.span.end;
        statement.span.end = statement.tokens.last().map_or(at, |token| token.span.end);
        for later in &mut self.out.statements[i + 1..] {
            later.parent = later.parent.map(|parent| parent + usize::from(parent > i));
        }
        self.out
            .statements
            .insert(i + 1, Statement { tokens, span, parent: Some(i), open: None, braced: false });
    }
}
