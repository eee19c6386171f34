//! Which statements is a text made of, and which brace or `;` is missing or one too many?

use super::lex::{Kind, Lexed, Token};
use super::{Help, Touch};
use crate::outline::{Sort, Span};

/// A word and what follows it up to the end of the line, a `;` or a brace.
#[derive(Debug)]
pub(super) struct Statement {
    pub(super) tokens: Vec<Token>,
    pub(super) span: Span,
    /// The statement in whose block it stands.
    pub(super) parent: Option<usize>,
    /// Where its block opens.
    pub(super) open: Option<usize>,
    /// Whether braces that are to be brackets stand among its tokens.
    pub(super) braced: bool,
}

impl Statement {
    /// Its first word without what was written at once behind it.
    pub(super) fn word<'t>(&self, text: &'t str) -> &'t str {
        let first = &text[self.tokens[0].span.clone()];
        let end = |c: char| "=:(<[,".contains(c);
        match self.tokens[0].kind {
            Kind::Text => first.trim_matches('"'),
            _ => first.split(end).next().unwrap_or(first),
        }
    }

    pub(super) fn sort(&self, text: &str) -> Option<Sort> {
        Sort::named(self.word(text))
    }
}

/// The statements of a text, and what is wrong between them.
#[derive(Debug, Default)]
pub(super) struct Built {
    pub(super) statements: Vec<Statement>,
    pub(super) touches: Vec<Touch>,
}

/// Stands where a word is missing.
const SOMETHING: &str = "something";

pub(super) fn build(text: &str, lexed: &Lexed) -> Built {
    let count = |kind: Kind| lexed.tokens.iter().filter(|token| token.kind == kind).count();
    let mut builder = Builder {
        text,
        tokens: &lexed.tokens,
        missing: count(Kind::Open).saturating_sub(count(Kind::Close)),
        current: Vec::new(),
        braced: false,
        stack: Vec::new(),
        last: None,
        indented: Vec::new(),
        after_close: false,
        out: Built::default(),
    };
    let mut i = 0;
    while i < lexed.tokens.len() {
        i = builder.step(i);
    }
    builder.end()
}

pub(super) struct Builder<'a> {
    pub(super) text: &'a str,
    pub(super) tokens: &'a [Token],
    /// How many more blocks are opened than closed.
    pub(super) missing: usize,
    pub(super) current: Vec<Token>,
    braced: bool,
    /// The statements whose blocks are open.
    pub(super) stack: Vec<usize>,
    /// The statement before, if no block of it was opened and nothing else came since.
    last: Option<usize>,
    /// How far the statements are indented whose blocks are told by nothing else, and how many blocks each lies in.
    pub(super) indented: Vec<(usize, usize)>,
    /// Whether a block was closed and neither line nor `;` has come since.
    after_close: bool,
    pub(super) out: Built,
}

impl Builder<'_> {
    /// Takes the token, and answers with the place of the next.
    fn step(&mut self, i: usize) -> usize {
        let token = &self.tokens[i];
        match token.kind {
            Kind::Word | Kind::Text => self.take(token.clone()),
            Kind::Line if self.in_brackets(i) => {
                let at = token.span.start;
                let message = "numbers stand on one line, without brackets round them".to_owned();
                let edit = (at..at, " \\".to_owned());
                self.out.touches.push(Touch { at: at..at, edit, message, help: Help::Statement("") });
            }
            Kind::Line => {
                if let Some(statement) = self.finish() {
                    self.open_indented(statement, i);
                }
                self.after_close = false;
            }
            Kind::Semicolon => self.semicolon(token),
            Kind::Open => {
                if let Some(end) = self.numbers_in_braces(i) {
                    self.current.extend_from_slice(&self.tokens[i..=end]);
                    self.braced = true;
                    return end + 1;
                }
                self.open(token);
            }
            Kind::Close => self.close(token),
        }
        i + 1
    }

    fn take(&mut self, token: Token) {
        if self.current.is_empty() {
            if self.text[token.span.clone()].bytes().all(|b| b == b',') {
                let message = "a comma separates nothing here".to_owned();
                let new = if self.after_close { ";" } else { " " };
                self.alone(token.span.clone(), (token.span, new.to_owned()), message, "leave it away");
                self.after_close = false;
                return;
            }
            let at = token.span.start;
            if self.after_close {
                let message = "a node begins on the line on which a block ends".to_owned();
                self.alone(
                    token.span.clone(),
                    (at..at, ";".to_owned()),
                    message,
                    "begin a new line, or write ; after the }",
                );
            }
            self.after_close = false;
            self.close_indented(at);
            self.current.push(token);
            self.close_what_was_left_open(at);
            return;
        }
        self.current.push(token);
    }

    /// Ends the statement; answers with its place if there was one.
    fn finish(&mut self) -> Option<usize> {
        let tokens = std::mem::take(&mut self.current);
        let span = tokens.first()?.span.start..tokens.last()?.span.end;
        let parent = self.stack.last().copied();
        let braced = std::mem::take(&mut self.braced);
        self.out.statements.push(Statement { tokens, span, parent, open: None, braced });
        self.last = Some(self.out.statements.len() - 1);
        self.last
    }

    fn semicolon(&mut self, token: &Token) {
        if self.finish().is_none() && !self.after_close {
            let message = "a ; ends nothing here".to_owned();
            self.alone(token.span.clone(), (token.span.clone(), " ".to_owned()), message, "leave it away");
        }
        self.after_close = false;
    }

    fn open(&mut self, token: &Token) {
        let at = token.span.start;
        let statement = match (self.finish(), self.last) {
            (Some(statement), _) => statement,
            (None, Some(last)) if self.out.statements[last].open.is_none() => {
                self.join(last, at);
                last
            }
            (None, _) => {
                let message = "this block stands behind no word".to_owned();
                let help = "write what it is before it: sphere \"some name\" … {";
                self.alone(token.span.clone(), (at..at, format!("{SOMETHING} ")), message, help);
                let (tokens, parent) = (vec![token.clone()], self.stack.last().copied());
                self.out.statements.push(Statement {
                    tokens,
                    span: token.span.clone(),
                    parent,
                    open: None,
                    braced: false,
                });
                self.out.statements.len() - 1
            }
        };
        self.out.statements[statement].open = Some(at);
        self.stack.push(statement);
        self.last = None;
        self.after_close = false;
    }

    /// A brace on a line of its own belongs to the line before.
    fn join(&mut self, statement: usize, at: usize) {
        let end = self.out.statements[statement].span.end;
        let lines = self.text[end..at].matches('\n').count();
        let word = self.out.statements[statement].word(self.text);
        let message = format!("the {{ of {word} stands on another line, or behind a ;");
        let help =
            format!("put the {{ behind {}", short(&self.text[self.out.statements[statement].span.clone()]));
        self.alone(at..at + 1, (end..at, format!("{} ", " \\\n".repeat(lines))), message, &help);
    }

    fn close(&mut self, token: &Token) {
        self.finish();
        self.last = None;
        if self.stack.pop().is_some() {
            self.after_close = true;
            return;
        }
        if !self.open_what_was_not_opened() {
            let message = "there is no block to close here".to_owned();
            self.alone(token.span.clone(), (token.span.clone(), " ".to_owned()), message, "leave the } away");
            return;
        }
        self.after_close = true;
    }

    /// A change that goes with another one.
    pub(super) fn silent(&mut self, at: usize, new: &str) {
        let edit = (at..at, new.to_owned());
        self.out.touches.push(Touch { at: at..at, edit, message: String::new(), help: Help::Statement("") });
    }

    /// Whether an open bracket leads on to the next line, where more numbers stand.
    fn in_brackets(&self, line: usize) -> bool {
        let depth = |token: &Token| {
            let count = |marks: &str| self.text[token.span.clone()].matches(|c| marks.contains(c)).count();
            count("([") as i64 - count(")]") as i64
        };
        let open = self.current.iter().filter(|token| token.kind == Kind::Word).map(depth).sum::<i64>() > 0;
        let next = self.tokens[line + 1..].iter().find(|token| token.kind != Kind::Line);
        open && next.is_some_and(|token| {
            self.text[token.span.clone()].chars().all(|c| c.is_ascii_digit() || "+-.,eE()[]".contains(c))
        })
    }

    /// The place of the `}` that closes nothing but numbers, behind a word that is no kind of node.
    fn numbers_in_braces(&self, i: usize) -> Option<usize> {
        let [head] = self.current.as_slice() else { return None };
        if Sort::named(&self.text[head.span.clone()]).is_some() {
            return None;
        }
        let rest = &self.tokens[i + 1..];
        let end = rest.iter().take(12).position(|token| token.kind == Kind::Close)?;
        let numeric = |token: &Token| {
            token.kind == Kind::Word
                && self.text[token.span.clone()].chars().all(|c| c.is_ascii_digit() || "+-.,eE".contains(c))
        };
        (end > 0 && rest[..end].iter().all(numeric)).then_some(i + 1 + end)
    }

    pub(super) fn alone(&mut self, at: Span, edit: (Span, String), message: String, help: &str) {
        self.out.touches.push(Touch { at, edit, message, help: Help::Alone(help.to_owned()) });
    }

    fn end(mut self) -> Built {
        self.finish();
        let end = self.text.len();
        while let Some(owner) = self.stack.pop() {
            if self.indented.last().is_some_and(|(_, depth)| *depth == self.stack.len()) {
                self.indented.pop();
                self.silent(end, "\n}");
                continue;
            }
            self.never_closed(owner, end, "\n}");
        }
        self.out
    }
}

/// A statement, as far as it fits into a hint.
pub(super) fn short(statement: &str) -> String {
    let words = statement.split_whitespace().collect::<Vec<_>>().join(" ");
    match words.char_indices().nth(60) {
        Some((at, _)) => format!("{} …", &words[..at]),
        None => words,
    }
}
