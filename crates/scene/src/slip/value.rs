//! Which values were meant by what stands behind a word: numbers between commas or brackets, words without `#` or quotes?

use super::lex::{Kind, Token};
use super::number::{is_number, meant};
use super::statement::{Takes, takes};
use super::word::{is_annotation, is_identifier, is_keyword, is_valid_property, is_value_of_property, shown};
use super::{Help, Touch};
use crate::outline::{Sort, Span};
use crate::read::{CHANNEL, STEPS, TEXTURE};

/// Marks that stand round numbers elsewhere.
pub(super) const BRACKETS: &str = "[](){}<>";

/// The values of a statement and what is wrong with them.
pub(super) struct Values<'a> {
    pub(super) text: &'a str,
    /// The word of the statement.
    pub(super) word: &'a str,
    /// What it is a field of.
    pub(super) owner: Option<Sort>,
    pub(super) takes: Takes,
    /// Whether the statement is written as a call.
    pub(super) called: bool,
    pub(super) touches: Vec<Touch>,
    /// Something of which nobody can tell what it was meant to be: where, what is wrong, and a hint.
    pub(super) unknown: Option<(Span, String, String)>,
}

impl<'a> Values<'a> {
    /// Looks at all values.
    pub(super) fn read(&mut self, tokens: &[Token], braced: bool) {
        if braced {
            for token in tokens.iter().filter(|token| matches!(token.kind, Kind::Open | Kind::Close)) {
                self.bracket(token.span.clone());
            }
        }
        let mut i = 0;
        while i < tokens.len() && self.unknown.is_none() {
            let token = &tokens[i];
            if token.kind == Kind::Word && !self.is_paint(token) {
                i += match self.takes {
                    Takes::Head(sort) => self.property_or_name(&tokens[i..], sort),
                    Takes::Words => self.one_word(token.span.clone()),
                    Takes::Flag | Takes::Numbers(_) => self.numbers(&tokens[i..]),
                };
            }
            i += 1;
        }
    }

    /// Whether a token begins `texture="wood"` or `channel="r"` behind the value of a field.
    fn is_paint(&self, token: &Token) -> bool {
        let of_material = matches!(self.owner, Some(Sort::Material(_)));
        let property = self.text[token.span.clone()].split_once('=').filter(|_| of_material);
        property.is_some_and(|(key, word)| {
            [TEXTURE, CHANNEL].contains(&key) && (word.is_empty() || is_identifier(word))
        })
    }

    /// Takes away the brackets of `sphere("ball")`: what opens at `open`, and what closes before `end`.
    pub(super) fn call(&mut self, open: usize, end: usize) {
        self.called = true;
        let (message, help) = (format!("{} is written without brackets", self.word), Help::Statement(""));
        let at = open..open + 1;
        self.touches.push(Touch {
            at: at.clone(),
            edit: (at, " ".to_owned()),
            message: message.clone(),
            help: help.clone(),
        });
        if end > open + 1 && self.text[..end].ends_with(')') {
            self.touches.push(Touch {
                at: end - 1..end,
                edit: (end - 1..end, " ".to_owned()),
                message,
                help,
            });
        }
    }

    /// Whatever KDL could not read and nothing has been said of: nothing else reaches its parser, which does not mind one
    /// error but calls itself for each.
    pub(super) fn refuse_the_rest(&mut self, tokens: &[Token]) {
        let covered: Vec<Span> = self.touches.iter().map(|touch| touch.edit.0.clone()).collect();
        for (i, token) in tokens.iter().enumerate() {
            let span = &token.span;
            let apart = |edit: &Span| edit.end < span.start || edit.start > span.end;
            if !self.is_legal(tokens, i) && covered.iter().all(apart) {
                let message = format!("{} cannot stand here", shown(&self.text[span.clone()]));
                let help = "leave it away, or write it in quotes with a blank before it";
                let new = if i == 0 { "something " } else { " #null " };
                self.push(span.clone(), new, message, Help::Unknown(help.to_owned()));
            }
        }
    }

    /// Whether KDL can read a token between its neighbours.
    fn is_legal(&self, tokens: &[Token], i: usize) -> bool {
        let written = |token: &Token| &self.text[token.span.clone()];
        let (token, before) = (&tokens[i], i.checked_sub(1).map(|before| &tokens[before]));
        let word = written(token);
        let opens = |token: &Token| token.kind == Kind::Word && written(token).ends_with('=');
        let key = before.is_some_and(|before| before.kind == Kind::Text || is_identifier(written(before)));
        let touches = before.is_some_and(|before| before.span.end == token.span.start);
        let apart = !touches
            || before.is_some_and(|b| opens(b) || is_annotation(written(b)))
            || word.starts_with('=');
        let has_value =
            !opens(token) || tokens.get(i + 1).is_some_and(|next| !written(next).starts_with('='));
        apart
            && has_value
            && (token.kind == Kind::Text
                || is_identifier(word)
                || is_annotation(word)
                || i > 0 && (is_number(word) || is_keyword(word) || is_valid_property(word))
                || i > 1 && key && is_value_of_property(word))
    }

    pub(super) fn push(&mut self, at: Span, new: &str, message: String, help: Help) {
        self.touches.push(Touch { at: at.clone(), edit: (at, new.to_owned()), message, help });
    }

    fn bracket(&mut self, at: Span) {
        let message = "numbers stand without brackets round them".to_owned();
        self.push(at, " ", message, Help::Statement(""));
    }

    pub(super) fn comma(&mut self, at: Span) {
        let message = "values stand without commas between them".to_owned();
        let help = match self.takes {
            Takes::Numbers(_) => "separate numbers by blanks: ",
            _ => "separate them by blanks: ",
        };
        self.push(at, " ", message, Help::Statement(help));
    }

    /// Looks at numbers; answers with how many tokens more than one were looked at.
    pub(super) fn numbers(&mut self, tokens: &[Token]) -> usize {
        let written = &self.text[tokens[0].span.clone()];
        if self.are_named(tokens) {
            for token in tokens {
                self.named_number(token.span.clone());
            }
            return tokens.len();
        }
        if self.begins_field(&tokens[0]) || is_annotation(written) || is_valid_property(written) {
            return 0;
        }
        if self.are_decimal_commas(tokens) {
            for token in tokens {
                let written = &self.text[token.span.clone()];
                if let Some(comma) = written.find(',') {
                    let number = written.replace(',', ".");
                    let at = token.span.start + comma;
                    self.touches.push(Touch {
                        at: token.span.clone(),
                        edit: (at..at + 1, ".".to_owned()),
                        message: format!("{written} has a comma where a point belongs"),
                        help: Help::Says(format!("write {number}; separate numbers by blanks")),
                    });
                }
            }
            return tokens.len();
        }
        let is_maker =
            tokens.get(1).is_some_and(|next| self.text[next.span.clone()].starts_with(['<', '[', '(']));
        if is_maker && is_identifier(&self.text[tokens[0].span.clone()]) {
            self.bracket(tokens[0].span.clone());
            return 0;
        }
        self.parts(tokens);
        0
    }

    /// Whether three numbers are written `x=1 y=2 z=3`.
    fn are_named(&self, tokens: &[Token]) -> bool {
        let named = |token: &Token| {
            self.text[token.span.clone()].split_once(['=', ':']).is_some_and(|(key, number)| {
                ["x", "y", "z", "r", "g", "b"].contains(&key) && {
                    let number = number.trim_end_matches(',');
                    is_number(number) || meant(number).is_some()
                }
            })
        };
        tokens.len() == 3 && tokens.iter().all(named)
    }

    /// Of `x=1` the number alone is written.
    fn named_number(&mut self, at: Span) {
        let Some((key, number)) = self.text[at.clone()].split_once(['=', ':']) else { return };
        let number = number.trim_end_matches(',');
        let right = meant(number).map_or_else(|| number.to_owned(), |meant| meant.number);
        self.push(at, &right, format!("numbers stand without {key} before them"), Help::Statement(""));
    }

    /// The word for another field: a `;` is missing before it.
    fn begins_field(&mut self, token: &Token) -> bool {
        let written = &self.text[token.span.clone()];
        let key = written.split(['=', ':']).next().unwrap_or(written);
        let Some(owner) = self.owner.filter(|_| !matches!(self.takes, Takes::Numbers(&[]))) else {
            return false;
        };
        let known =
            owner.field(key).is_some() || (owner.is_entity() && STEPS.iter().any(|(step, ..)| *step == key));
        if !known {
            return false;
        }
        let at = token.span.start..token.span.start + key.len();
        let before = match self.touches.last_mut() {
            // The comma before it is what stands for the `;`.
            Some(comma)
                if self.text[comma.edit.0.clone()] == *","
                    && self.text[comma.edit.0.end..at.start].trim().is_empty() =>
            {
                comma.edit.1 = ";".to_owned();
                comma.message = "fields end with ; or with the line, not with a comma".to_owned();
                comma.help = Help::Statement("");
                true
            }
            _ => false,
        };
        if !before {
            let message = format!("{key} begins on the line of another field without a ; between them");
            self.touches.push(Touch {
                at: at.clone(),
                edit: (at.start..at.start, "; ".to_owned()),
                message,
                help: Help::Statement(""),
            });
        }
        self.takes = takes(key, self.owner, None, false);
        if key.len() < written.len() {
            let mark = at.end..at.end + 1;
            self.push(
                mark,
                " ",
                format!("{key} is followed by its value, without a mark between them"),
                Help::Statement(""),
            );
            let rest = Token { kind: Kind::Word, span: at.end + 1..token.span.end };
            if !rest.span.is_empty() {
                self.parts(&[rest]);
            }
        }
        true
    }

    /// Whether commas between digits are decimal points: then, and only then, there are as many numbers as there should be.
    fn are_decimal_commas(&self, tokens: &[Token]) -> bool {
        let Takes::Numbers(counts) = self.takes else { return false };
        let words: Vec<&str> = tokens.iter().map(|token| &self.text[token.span.clone()]).collect();
        let split: usize =
            words.iter().map(|word| word.split(',').filter(|part| !part.is_empty()).count()).sum();
        let decimal = |word: &&str| {
            let number = word.replacen(',', ".", 1);
            is_number(&number) && !(word.ends_with(',') || word.starts_with(','))
        };
        !counts.contains(&split)
            && counts.contains(&words.len())
            && words.iter().all(decimal)
            && words.iter().any(|w| w.contains(','))
    }

    /// The numbers of one token, between commas and brackets.
    fn parts(&mut self, tokens: &[Token]) {
        let span = tokens[0].span.clone();
        let text = self.text;
        let written = &text[span.clone()];
        let mut start = 0;
        for (i, c) in written.char_indices().chain([(written.len(), ' ')]) {
            let ends = i == written.len() || c == ',' || BRACKETS.contains(c);
            if !ends {
                continue;
            }
            if start < i {
                let part = span.start + start..span.start + i;
                if i < written.len() && "([<".contains(c) {
                    self.maker(part, &text[span.start + start..span.end]);
                } else {
                    self.part(part);
                }
            }
            start = i + c.len_utf8();
            let mark = span.start + i..span.start + start;
            match c {
                ',' => self.comma(mark),
                _ if i < written.len() => self.bracket(mark),
                _ => {}
            }
        }
    }

    /// A word or a path that needs quotes.
    fn one_word(&mut self, span: Span) -> usize {
        let written = &self.text[span.clone()];
        let bare = written.trim_matches(',');
        let start = span.start + (written.len() - written.trim_start_matches(',').len());
        if !bare.is_empty() && (is_identifier(written) || is_number(bare) || is_keyword(bare)) {
            return 0;
        }
        if bare.is_empty() || !is_identifier(bare) {
            self.commas_round(&span, start, bare);
        }
        if !bare.is_empty() && !is_identifier(bare) {
            self.quote(start..start + bare.len());
        }
        0
    }

    fn commas_round(&mut self, span: &Span, start: usize, bare: &str) {
        for part in [span.start..start, start + bare.len()..span.end] {
            if !part.is_empty() {
                self.comma(part);
            }
        }
    }

    pub(super) fn quote(&mut self, at: Span) {
        let written = &self.text[at.clone()];
        let right = format!("\"{}\"", written.replace('\\', "/"));
        let message = format!("{} needs quotes", shown(written));
        let blank =
            if self.text[..at.start].ends_with(|c: char| c.is_whitespace() || c == '=') { "" } else { " " };
        self.push(at, &format!("{blank}{right} "), message, Help::Says(format!("write {right}")));
    }
}
