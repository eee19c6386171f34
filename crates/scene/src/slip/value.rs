//! Which values were meant by what stands behind a word: numbers between commas or brackets, words without `#` or quotes?

use super::lex::{Kind, Token};
use super::number::{is_number, meant};
use super::statement::{Takes, takes};
use super::{Help, Touch};
use crate::outline::{Sort, Span};
use crate::read::{MATERIAL, STEPS};
use catoptra_core::FieldKind;

/// Marks that stand round numbers elsewhere.
const BRACKETS: &str = "[](){}<>";

/// What makes a vector, a colour or a number of numbers elsewhere, as part of its name.
const MAKERS: &[&str] =
    &["vec", "rgb", "color", "colour", "array", "float", "double", "int", "tuple", "list", "point", "xyz"];

/// Words that need a `#` in KDL.
const KEYWORDS: &[&str] = &["true", "false", "null", "nan", "inf", "-inf"];

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
            if token.kind == Kind::Word {
                i += match self.takes {
                    Takes::Head(sort) => self.property_or_name(&tokens[i..], sort),
                    Takes::Words => self.one_word(token.span.clone()),
                    Takes::Flag | Takes::Numbers(_) => self.numbers(&tokens[i..]),
                };
            }
            i += 1;
        }
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
        for (i, token) in tokens.iter().enumerate().filter(|(_, token)| token.kind == Kind::Word) {
            let (written, span) = (&self.text[token.span.clone()], &token.span);
            let apart = |edit: &Span| edit.end < span.start || edit.start > span.end;
            let legal = is_identifier(written)
                || is_annotation(written)
                || i > 0
                    && (is_number(written)
                        || is_keyword(written)
                        || is_valid_property(written)
                        || is_value_of_property(written));
            if !legal && covered.iter().all(apart) {
                let message = format!("{} cannot stand here", shown(written));
                let (new, help) = if i == 0 {
                    ("something ", "begin with a word")
                } else {
                    ("#null ", "leave it away, or write it in quotes")
                };
                self.push(span.clone(), new, message, Help::Unknown(help.to_owned()));
            }
        }
    }

    fn push(&mut self, at: Span, new: &str, message: String, help: Help) {
        self.touches.push(Touch { at: at.clone(), edit: (at, new.to_owned()), message, help });
    }

    fn bracket(&mut self, at: Span) {
        let message = "numbers stand without brackets round them".to_owned();
        self.push(at, " ", message, Help::Statement(""));
    }

    fn comma(&mut self, at: Span) {
        let message = "values stand without commas between them".to_owned();
        let help = match self.takes {
            Takes::Numbers(_) => "separate numbers by blanks: ",
            _ => "separate them by blanks: ",
        };
        self.push(at, " ", message, Help::Statement(help));
    }

    /// Looks at numbers; answers with how many tokens more than one were looked at.
    fn numbers(&mut self, tokens: &[Token]) -> usize {
        let written = &self.text[tokens[0].span.clone()];
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

    /// The word for another field: a `;` is missing before it.
    fn begins_field(&mut self, token: &Token) -> bool {
        let written = &self.text[token.span.clone()];
        let key = written.split(['=', ':']).next().unwrap_or(written);
        let Some(owner) = self.owner else { return false };
        let known = owner.fields().iter().any(|field| field.name == key)
            || (owner.is_entity() && STEPS.iter().any(|(step, ..)| *step == key));
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

    /// The name before a bracket.
    fn maker(&mut self, at: Span, call: &str) {
        let name = self.text[at.clone()].to_ascii_lowercase();
        if MAKERS.iter().any(|maker| name.contains(maker)) {
            let message = format!("{} is no number of scene text", shown(call));
            self.push(at, "", message, Help::Statement(""));
        } else {
            let message = format!("{} is not reckoned out", shown(call));
            self.unknown = Some((at, message, "write the number that it gives".to_owned()));
        }
    }

    /// One number, or what was meant to be one.
    fn part(&mut self, at: Span) {
        let written = &self.text[at.clone()];
        let flag = matches!(self.takes, Takes::Flag);
        if is_number(written)
            || self.keyword(at.clone(), flag)
            || is_identifier(written) && meant(written).is_none()
        {
            return;
        }
        if let Some(meant) = meant(written) {
            let help = Help::Says(format!("write {}", meant.number));
            self.push(at, &meant.number, meant.fault, help);
        } else if let Some(color) = color(written) {
            let help = Help::Says(format!("write {color} for that sRGB colour"));
            self.push(
                at,
                &color,
                format!("{written} is no colour of scene text, which takes linear light"),
                help,
            );
        } else {
            let message = format!("{} is no number", shown(written));
            self.unknown = Some((at, message, "write a number such as 0.5".to_owned()));
        }
    }

    /// A word that needs a `#`, or has it and is spelled otherwise; true if it is one.
    fn keyword(&mut self, at: Span, flag: bool) -> bool {
        let written = &self.text[at.clone()];
        let name = written.trim_start_matches('#').to_ascii_lowercase();
        let right = match name.as_str() {
            "yes" | "on" if flag => "#true",
            "no" | "off" if flag => "#false",
            "true" | "yes" | "on" => "#true",
            "false" | "no" | "off" => "#false",
            "null" | "none" => "#null",
            "nan" => "#nan",
            "inf" => "#inf",
            "-inf" => "#-inf",
            _ => return false,
        };
        if written == right {
            return true;
        }
        if !written.starts_with('#') && !KEYWORDS.contains(&written) {
            return false;
        }
        if flag && matches!(right, "#true" | "#false") {
            self.push(
                at,
                right,
                format!("{written} needs to be written {right}"),
                Help::Says(format!("write {right}")),
            );
        } else {
            let message = format!("{written} stands where a number or a word is needed");
            self.push(
                at,
                right,
                message,
                Help::Unknown(format!("write a value for {}, or leave it away", self.word)),
            );
        }
        true
    }

    /// A word or a path that needs quotes.
    fn one_word(&mut self, span: Span) -> usize {
        let written = &self.text[span.clone()];
        let bare = written.trim_matches(',');
        let start = span.start + (written.len() - written.trim_start_matches(',').len());
        if is_identifier(written) || is_number(bare) || is_keyword(bare) {
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

    fn quote(&mut self, at: Span) {
        let written = &self.text[at.clone()];
        let right = format!("\"{}\"", written.replace('\\', "/"));
        let message = format!("{} needs quotes", shown(written));
        self.push(at, &format!("{right} "), message, Help::Says(format!("write {right}")));
    }

    /// A name or a property before a block; answers with how many tokens more than one were looked at.
    fn property_or_name(&mut self, tokens: &[Token], sort: Option<Sort>) -> usize {
        let span = tokens[0].span.clone();
        let text = self.text;
        let written = text[span.clone()].trim_start_matches(',');
        let start = span.end - written.len();
        let ends_call = |bare: &&str| bare.ends_with(',') || (self.called && bare.ends_with(')'));
        let bare = if ends_call(&written) { written.trim_end_matches([',', ')']) } else { written };
        let end = start + bare.len();
        if start > span.start {
            self.comma(span.start..start);
        }
        if let Some(at) = bare
            .find(['=', ':'])
            .filter(|&at| at > 0 && is_property(&bare[..at], sort) || bare[at..].starts_with('='))
        {
            return self.property(tokens, start..end, at, sort);
        }
        if !bare.is_empty() && bare.bytes().all(|b| b == b':') {
            let message = "a block stands between { and }".to_owned();
            self.push(start..end, " ", message, Help::Statement(""));
            return 0;
        }
        if is_identifier(written) || is_annotation(written) || bare.is_empty() && written.is_empty() {
            return 0;
        }
        if end < span.end && self.text[end..span.end].contains(',') {
            self.comma(end..span.end);
        }
        if !(bare.is_empty() || bare == "=" || is_number(bare) || is_identifier(bare) || is_keyword(bare)) {
            self.quote(start..end);
        }
        0
    }

    /// `key=value` with the mark at `mark` bytes behind its start.
    fn property(&mut self, tokens: &[Token], span: Span, mark: usize, sort: Option<Sort>) -> usize {
        let text = self.text;
        let written = &text[span.clone()];
        let key = &written[..mark];
        let length = written[mark..].bytes().take_while(|b| b"=:>".contains(b)).count();
        let sign = span.start + mark..span.start + mark + length;
        if &text[sign.clone()] != "=" && !key.is_empty() {
            let message = format!("a property is written {key}=");
            self.push(sign.clone(), "=", message, Help::Statement(""));
        }
        let value = sign.end..span.end;
        if value.end < tokens[0].span.end {
            self.comma(value.end..tokens[0].span.end);
        }
        let opens = |text: &str| text.contains(['[', '(', '<', '{']);
        if opens(&text[value.clone()]) && !is_annotation(&text[value.clone()]) {
            return self.vector(tokens, span.start, key);
        }
        let field = sort.and_then(|sort| sort.fields().iter().find(|field| field.name == key));
        let inner = &text[value.clone()];
        let takes_words = key == MATERIAL
            || field.is_some_and(|f| matches!(f.kind, FieldKind::Mesh | FieldKind::Choice(_)));
        if inner.is_empty() || is_number(inner) || (is_identifier(inner) && !inner.contains(',')) {
            return 0;
        }
        if takes_words || field.is_none() {
            if !is_keyword(inner) {
                self.quote(value);
            }
            return 0;
        }
        let before = std::mem::replace(
            &mut self.takes,
            field.map_or(Takes::Flag, |f| takes(f.name, sort, None, false)),
        );
        self.numbers(&[Token { kind: Kind::Word, span: value }]);
        self.takes = before;
        if let Some((at, message, help)) = self.unknown.take() {
            self.push(at, "#null", message, Help::Unknown(help));
        }
        0
    }

    /// `center=[0, 1, 0]` before a block: numbers in brackets, which end some tokens later.
    fn vector(&mut self, tokens: &[Token], start: usize, key: &str) -> usize {
        let depth = |token: &Token| {
            let count = |marks: &[char]| self.text[token.span.clone()].matches(marks).count() as i64;
            count(&['[', '(', '<']) - count(&[']', ')', '>'])
        };
        let mut open = 0;
        let last = tokens.iter().position(|token| {
            open += depth(token);
            open <= 0
        });
        let last = last.unwrap_or(tokens.len() - 1);
        let at = start..tokens[last].span.end;
        let written = self.text[at.start + key.len() + 1..at.end]
            .replace(|c: char| BRACKETS.contains(c) || c == ',', " ");
        let numbers: Vec<String> = written
            .split_whitespace()
            .filter_map(|w| meant(w).map(|m| m.number).or_else(|| is_number(w).then(|| w.to_owned())))
            .collect();
        let help = format!("write it in the block: {} {{ {key} {} }}", self.word, numbers.join(" "));
        let message = format!("{key} takes several numbers, which stand in the block");
        self.push(at, &format!("{key}=#null "), message, Help::Unknown(help));
        last
    }
}

fn is_property(key: &str, sort: Option<Sort>) -> bool {
    key == MATERIAL || sort.is_some_and(|sort| sort.fields().iter().any(|field| field.name == key))
}

/// Whether KDL takes the word for a property, or for the beginning of one.
fn is_valid_property(word: &str) -> bool {
    word.split_once('=').is_some_and(|(key, value)| {
        is_identifier(key)
            && (value.is_empty() || is_number(value) || is_identifier(value) || is_keyword(value))
    })
}

/// `=value` behind a blank.
fn is_value_of_property(word: &str) -> bool {
    word.strip_prefix('=').is_some_and(|value| {
        value.is_empty() || is_number(value) || is_identifier(value) || is_keyword(value)
    })
}

fn is_keyword(word: &str) -> bool {
    word.strip_prefix('#').is_some_and(|name| KEYWORDS.contains(&name))
}

/// `(type)` or `(type)value`, which KDL has.
fn is_annotation(word: &str) -> bool {
    word.strip_prefix('(').and_then(|rest| rest.split_once(')')).is_some_and(|(name, rest)| {
        is_identifier(name) && (rest.is_empty() || is_number(rest) || is_identifier(rest) || is_keyword(rest))
    })
}

/// Whether KDL takes the word for a string without quotes.
fn is_identifier(word: &str) -> bool {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
    let digit = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    !word.is_empty()
        && !digit(unsigned)
        && !unsigned.strip_prefix('.').is_some_and(digit)
        && !word.contains(['\\', '/', '(', ')', '{', '}', '[', ']', ';', '"', '#', '='])
        && !KEYWORDS.contains(&word)
}

/// `#ff8000` or `#f80` as three numbers of linear light (IEC 61966-2-1).
fn color(word: &str) -> Option<String> {
    let digits = word.strip_prefix('#').filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()))?;
    let width = match digits.len() {
        3 => 1,
        6 | 8 => 2,
        _ => return None,
    };
    let channel = |i: usize| {
        let value = u8::from_str_radix(&digits[i * width..(i + 1) * width], 16).ok()?;
        let encoded = f64::from(value) / if width == 1 { 15.0 } else { 255.0 };
        let linear = if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
        Some(crate::write::number((linear * 1000.0).round() / 1000.0))
    };
    Some([channel(0)?, channel(1)?, channel(2)?].join(" "))
}

/// As much of a word as fits into a message.
fn shown(word: &str) -> &str {
    word.char_indices().nth(40).map_or(word, |(at, _)| &word[..at])
}
