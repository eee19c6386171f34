//! How are nodes, blocks and comments written by rule?

use super::WIDTH;
use super::pieces::{Block, Item, Piece};
use crate::write::INDENT;

/// The text of items.
pub(super) fn printed(items: &[Item], newline: &str) -> String {
    let mut text = String::new();
    Printer { out: &mut text }.items(items, 0);
    if newline == "\n" { text } else { text.replace("\r\n", "\n").replace('\n', newline) }
}

struct Printer<'a> {
    out: &'a mut String,
}

impl Printer<'_> {
    /// Items on lines of their own, but for those that share one.
    fn items(&mut self, items: &[Item], depth: usize) {
        for (at, item) in items.iter().enumerate() {
            let is_first = at == 0;
            if item.joined && !is_first && !self.ends_with_comment() && !begins_block(item) {
                self.out.push_str("; ");
                self.pieces(&item.pieces, depth);
                continue;
            }
            if !is_first {
                self.out.push('\n');
            }
            if item.after_blank && !is_first {
                self.out.push('\n');
            }
            self.indent(depth);
            self.pieces(&item.pieces, depth);
        }
        if !items.is_empty() {
            self.out.push('\n');
        }
    }

    fn indent(&mut self, depth: usize) {
        self.out.push_str(&INDENT.repeat(depth));
    }

    /// Whether the line so far ends in a comment that would swallow what follows.
    fn ends_with_comment(&self) -> bool {
        let line = self.out.rsplit('\n').next().unwrap_or_default();
        crate::scan::comments(line, 0..line.len())
            .last()
            .is_some_and(|last| last.end == line.len() && line[last.clone()].starts_with("//"))
    }

    fn pieces(&mut self, pieces: &[Piece], depth: usize) {
        let mut glued = true;
        for piece in pieces {
            if !glued {
                self.out.push_str(if is_line_comment(piece) { "  " } else { " " });
            }
            glued = false;
            match piece {
                Piece::Word(text) | Piece::Comment(text) => self.out.push_str(text),
                Piece::Slashdash => {
                    self.out.push_str("/-");
                    glued = true;
                }
                Piece::Continued(comment) => {
                    self.out.push('\\');
                    comment.iter().for_each(|comment| {
                        self.out.push(' ');
                        self.out.push_str(comment);
                    });
                    self.out.push('\n');
                    self.indent(depth + 1);
                    glued = true;
                }
                Piece::Block(block) => self.block(block, depth),
            }
        }
    }

    fn block(&mut self, block: &Block, depth: usize) {
        if block.items.is_empty() {
            self.out.push_str("{}");
            return;
        }
        if block.is_one_line {
            let mut line = String::new();
            Printer { out: &mut line }.one_line(block);
            let before = self.out.rsplit('\n').next().unwrap_or_default().chars().count();
            if before + line.chars().count() <= WIDTH {
                self.out.push_str(&line);
                return;
            }
        }
        self.out.push('{');
        let (behind, rest) = behind_brace(&block.items);
        if let Some(comment) = behind {
            self.out.push_str("  ");
            self.out.push_str(comment);
        }
        self.out.push('\n');
        let apart: Vec<Item>;
        let items = if block.is_one_line {
            // What does not fit on one line has a line for each.
            apart = rest.iter().map(alone).collect();
            &apart
        } else {
            rest
        };
        self.items(items, depth + 1);
        self.indent(depth);
        self.out.push('}');
    }

    fn one_line(&mut self, block: &Block) {
        self.out.push_str("{ ");
        for (at, item) in block.items.iter().enumerate() {
            if at > 0 {
                self.out.push_str("; ");
            }
            self.pieces(&item.pieces, 0);
        }
        self.out.push_str(" }");
    }
}

/// The same item on a line of its own.
fn alone(item: &Item) -> Item {
    Item { pieces: item.pieces.clone(), ..Item::default() }
}

fn is_line_comment(piece: &Piece) -> bool {
    matches!(piece, Piece::Comment(text) if text.starts_with("//"))
}

/// Whether an item holds a block on several lines, beside which nothing else stands on its line.
fn begins_block(item: &Item) -> bool {
    item.pieces
        .iter()
        .any(|piece| matches!(piece, Piece::Block(block) if !block.is_one_line && !block.items.is_empty()))
}

/// A comment on the line of the opening brace, and what follows.
fn behind_brace(items: &[Item]) -> (Option<&str>, &[Item]) {
    match items.split_first() {
        Some((Item { pieces, joined: true, .. }, rest)) if pieces.len() == 1 => match &pieces[0] {
            Piece::Comment(comment) if comment.starts_with("//") => (Some(comment), rest),
            _ => (None, items),
        },
        _ => (None, items),
    }
}
