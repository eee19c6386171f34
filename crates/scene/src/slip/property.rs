//! What was meant by the name and the properties before a block: `'ball'`, `material: "w"`, `center=[0, 1, 0]`?

use super::Help;
use super::lex::{Kind, Token};
use super::number::{is_number, meant};
use super::statement::{Takes, takes};
use super::value::{BRACKETS, Values};
use super::word::{is_annotation, is_identifier, is_keyword};
use crate::outline::{Sort, Span};
use crate::read::{MATERIAL, is_word};

impl Values<'_> {
    /// A name or a property before a block; answers with how many tokens more than one were looked at.
    pub(super) fn property_or_name(&mut self, tokens: &[Token], sort: Option<Sort>) -> usize {
        let span = tokens[0].span.clone();
        let text = self.text;
        let next = Sort::named(&text[span.clone()])
            .filter(|_| tokens.get(1).is_some_and(|next| next.kind == Kind::Text));
        if let Some(next) = next {
            let message =
                format!("{} begins on the line of another node without a ; between them", next.word());
            self.push(span.start..span.start, "; ", message, Help::Statement(""));
            self.takes = Takes::Head(Some(next));
            return 0;
        }
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
        let field = sort.and_then(|sort| sort.field(key));
        let inner = &text[value.clone()];
        let takes_words = key == MATERIAL || field.is_some_and(|field| is_word(field.kind));
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
    key == MATERIAL || sort.is_some_and(|sort| sort.field(key).is_some())
}
