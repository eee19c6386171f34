//! Which words, strings and braces is a text made of that may be no valid KDL?
//!
//! What KDL has no name for becomes part of a word, to be looked at later; comments, strings and controls are put right
//! here, as what follows can be told only then.

use super::{Help, Touch, quote};
use crate::outline::Span;

/// What a token is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Anything without blanks that is none of the others.
    Word,
    /// A string in quotes.
    Text,
    /// `{`
    Open,
    /// `}`
    Close,
    /// `;`
    Semicolon,
    /// The end of a line.
    Line,
}

/// A piece of the text.
#[derive(Debug, Clone)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) span: Span,
}

/// A text in tokens.
#[derive(Debug, Default)]
pub(super) struct Lexed {
    pub(super) tokens: Vec<Token>,
    pub(super) touches: Vec<Touch>,
}

/// Begin a comment elsewhere, where a statement could begin.
const COMMENTS: &[&str] = &["--", "%", "<!--", "/"];

/// Directives of POV-Ray and of C.
const DIRECTIVES: &[&str] = &[
    "#declare", "#local", "#include", "#version", "#macro", "#default", "#define", "#if", "#ifdef",
    "#ifndef", "#else", "#end", "#endif", "#while", "#for", "#switch", "#case", "#range", "#break", "#debug",
    "#undef",
];

/// Words behind a `#` that KDL has, and what others write for them.
const KEYWORDS: &[&str] = &["true", "false", "null", "nan", "inf", "yes", "no", "on", "off", "none"];

pub(super) fn lex(text: &str) -> Lexed {
    let mut lexer = Lexer { text, at: 0, line_end: None, out: Lexed::default() };
    while lexer.step() {}
    lexer.out
}

/// Where the text is being looked at.
pub(super) struct Lexer<'a> {
    pub(super) text: &'a str,
    pub(super) at: usize,
    /// Where the line ends that was looked at last.
    line_end: Option<usize>,
    pub(super) out: Lexed,
}

impl<'a> Lexer<'a> {
    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// The line from here on, without its end.
    pub(super) fn line(&mut self) -> &'a str {
        let end = match self.line_end {
            Some(end) if end >= self.at => end,
            _ => self.rest().find(is_newline).map_or(self.text.len(), |length| self.at + length),
        };
        self.line_end = Some(end);
        &self.text[self.at..end]
    }

    pub(super) fn push(&mut self, kind: Kind, length: usize) {
        self.out.tokens.push(Token { kind, span: self.at..self.at + length });
        self.at += length;
    }

    /// Notes a slip; `edit` is what is to be replaced.
    pub(super) fn touch(&mut self, at: Span, edit: (Span, String), message: String, help: Help) {
        self.out.touches.push(Touch { at, edit, message, help });
    }

    fn step(&mut self) -> bool {
        let rest = self.rest();
        let Some(c) = rest.chars().next() else { return false };
        match c {
            '\r' if rest.starts_with("\r\n") => self.push(Kind::Line, 2),
            c if is_newline(c) => self.push(Kind::Line, c.len_utf8()),
            '\u{feff}' if self.at == 0 => self.at += c.len_utf8(),
            c if is_forbidden(c) => self.controls(),
            c if is_space(c) => self.at += c.len_utf8(),
            '{' => self.push(Kind::Open, 1),
            '}' => self.push(Kind::Close, 1),
            ';' => self.push(Kind::Semicolon, 1),
            '"' => quote::string(self),
            '\\' if continues(rest) => self.at += continuation(rest),
            '#' => self.hash(),
            _ if rest.starts_with("//") => self.at += self.line().len(),
            _ if rest.starts_with("/*") => self.comment(),
            _ if rest.starts_with("/-") => self.slashdash(),
            _ if rest.starts_with("*/") => {
                let message = "there is no comment to close here".to_owned();
                let span = self.at..self.at + 2;
                self.touch(
                    span.clone(),
                    (span, "  ".to_owned()),
                    message,
                    Help::Alone("leave it away".to_owned()),
                );
                self.at += 2;
            }
            _ if self.begins() && COMMENTS.iter().any(|mark| rest.starts_with(mark)) => {
                self.foreign_comment();
            }
            c if quote::is_odd(c) && quote::odd(self) => {}
            _ => self.word(),
        }
        true
    }

    /// Whether a statement may begin here.
    fn begins(&self) -> bool {
        self.out.tokens.last().is_none_or(|last| !matches!(last.kind, Kind::Word | Kind::Text))
    }

    /// Goes past characters that KDL does not allow, with what is between them.
    fn controls(&mut self) {
        let start = self.at;
        let mut count = 0;
        let mut end = start;
        for (i, c) in self.rest().char_indices() {
            if is_forbidden(c) {
                count += 1;
                end = start + i + c.len_utf8();
            } else if is_newline(c) || start + i > end {
                break;
            }
        }
        let first = self.rest().chars().next().map_or(0, u32::from);
        quote::tell_controls(self, start..end, first, count);
        self.at = end;
    }

    /// `/-` leaves out what follows it, if anything does.
    fn slashdash(&mut self) {
        let after = self.rest()[2..].trim_start();
        if after.is_empty() || after.starts_with("/-") || after.starts_with(['}', ';']) {
            let span = self.at..self.at + 2;
            let message = "this /- leaves nothing out".to_owned();
            self.touch(
                span.clone(),
                (span, "  ".to_owned()),
                message,
                Help::Alone("leave it away".to_owned()),
            );
        }
        self.at += 2;
    }

    fn comment(&mut self) {
        let (mut depth, mut i) = (0_usize, 0);
        let rest = self.rest();
        while i < rest.len() {
            if rest.as_bytes()[i..].starts_with(b"/*") {
                depth += 1;
                i += 2;
            } else if rest.as_bytes()[i..].starts_with(b"*/") {
                depth -= 1;
                i += 2;
                if depth == 0 {
                    break;
                }
            } else {
                i += 1;
            }
        }
        if depth > 0 {
            let end = self.text.len();
            let help = Help::Alone("close it with */".to_owned());
            self.touch(
                self.at..self.at + 2,
                (end..end, "*/".repeat(depth)),
                "this comment is never closed".to_owned(),
                help,
            );
        }
        self.at += i;
    }

    /// A raw string, a keyword, a colour, a directive or what others begin a comment with.
    fn hash(&mut self) {
        let rest = self.rest();
        let hashes = rest.bytes().take_while(|&b| b == b'#').count();
        if rest[hashes..].starts_with('"') {
            return quote::raw(self, hashes);
        }
        let word = &rest
            [..rest.find(|c: char| is_newline(c) || is_space(c) || ";{}".contains(c)).unwrap_or(rest.len())];
        let name = word[1..].trim_start_matches('-').to_ascii_lowercase();
        let is_color =
            !self.begins() && matches!(name.len(), 3 | 6 | 8) && name.bytes().all(|b| b.is_ascii_hexdigit());
        if KEYWORDS.contains(&name.trim_end_matches(',')) || is_color {
            return self.word();
        }
        if self.begins() && DIRECTIVES.contains(&word) {
            let line = self.line().len();
            let span = self.at..self.at + word.len();
            let message = format!("scene text has no directives such as {word}");
            let help = Help::Alone("write every value where it is used; // begins a comment".to_owned());
            self.touch(span, (self.at..self.at + line, String::new()), message, help);
            self.at += line;
            return;
        }
        self.foreign_comment();
    }

    /// What is left of the line is a comment as other languages have them.
    fn foreign_comment(&mut self) {
        let line = self.line();
        // What closes a block of this line is no part of the comment.
        let before = self.out.tokens.iter().rev().take_while(|token| token.kind != Kind::Line);
        let open = before.fold(0, |open, token| {
            open + i32::from(token.kind == Kind::Open) - i32::from(token.kind == Kind::Close)
        });
        let line = match line.trim_end().strip_suffix('}') {
            Some(said) if open > 0 && !said.contains('{') => said.trim_end_matches([' ', '}']),
            _ => line,
        };
        let new = if line.len() < self.line().len() { "/**/" } else { "//" };
        let mark = ["<!--", "--", "##", "#", "%", "/"]
            .into_iter()
            .find(|mark| line.starts_with(mark))
            .unwrap_or("#");
        let span = self.at..self.at + mark.len();
        let said = line[mark.len()..].trim().trim_end_matches("-->").trim();
        let short: String = said.chars().take(40).collect();
        let more = if short.len() < said.len() { " …" } else { "" };
        let message = format!("{mark} begins no comment");
        let help = Help::Alone(match new {
            "//" => format!("write // {short}{more}"),
            _ => format!("write /* {short}{more} */"),
        });
        self.touch(span, (self.at..self.at + line.len(), new.to_owned()), message, help);
        self.at += line.len();
    }

    /// Everything up to a blank or a mark.
    fn word(&mut self) {
        let rest = self.rest();
        let mut length = 0;
        let mut before = '\0';
        for (i, c) in rest.char_indices() {
            let tail = &rest[i..];
            let ends = is_newline(c)
                || is_space(c)
                || is_forbidden(c)
                || "{};\"".contains(c)
                || (c == '\\' && continues(tail))
                || (i > 0
                    && (tail.starts_with("//") || tail.starts_with("/*"))
                    && !before.is_alphanumeric()
                    && before != ':')
                || (i > 0 && quote::is_odd(c) && "=([,:".contains(before));
            if ends {
                break;
            }
            before = c;
            length = i + c.len_utf8();
        }
        if length == 0 {
            length = rest.chars().next().map_or(1, char::len_utf8);
        }
        self.push(Kind::Word, length);
        if self.rest().starts_with('"') {
            quote::after_word(self);
        }
    }
}

/// Whether a `\` here leads on to the next line.
pub(super) fn continues(rest: &str) -> bool {
    let Some(after) = rest.strip_prefix('\\') else { return false };
    let after = after.trim_start_matches(is_space);
    after.is_empty() || after.starts_with(is_newline) || after.starts_with("//")
}

/// How long such a `\` is with the line end.
fn continuation(rest: &str) -> usize {
    match rest.find(is_newline) {
        Some(at) if rest[at..].starts_with("\r\n") => at + 2,
        Some(at) => at + rest[at..].chars().next().map_or(1, char::len_utf8),
        None => rest.len(),
    }
}

/// Line ends as KDL has them.
pub(super) fn is_newline(c: char) -> bool {
    matches!(c, '\n' | '\r' | '\u{85}' | '\u{b}' | '\u{c}' | '\u{2028}' | '\u{2029}')
}

/// Blanks as KDL has them.
pub(super) fn is_space(c: char) -> bool {
    matches!(
        c,
        '\t' | ' ' | '\u{a0}' | '\u{1680}' | '\u{2000}'..='\u{200a}' | '\u{202f}' | '\u{205f}' | '\u{3000}'
    )
}

/// What must not stand in KDL but as an escape.
pub(super) fn is_forbidden(c: char) -> bool {
    matches!(c, '\0'..='\u{8}' | '\u{e}'..='\u{1f}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}'
        | '\u{2066}'..='\u{2069}' | '\u{feff}')
}
