//! What was meant by `radius = 1`, `center: [0, 1, 0]` or `sphere("ball")`: a word with a mark between it and its values?

use super::lex::{Kind, Token};
use super::number::{is_number, meant};
use super::structure::Statement;
use super::value::Values;
use super::word::{is_annotation, is_identifier, shown};
use super::{Help, Touch};
use crate::outline::Sort;
use crate::read::{ABOUT, MATERIAL, STEPS, arity, is_word};
use catoptra_core::FieldKind;

/// What stands behind the word of a statement.
#[derive(Debug, Clone, Copy)]
pub(super) enum Takes {
    /// A name, and properties of that sort.
    Head(Option<Sort>),
    /// Numbers, so many; any number of them where the word is unknown.
    Numbers(&'static [usize]),
    /// A word or a path.
    Words,
    /// `#true` or `#false`.
    Flag,
}

/// What is wrong between the words of a statement.
pub(super) fn touch(text: &str, statement: &Statement, all: &[Statement]) -> Vec<Touch> {
    let first = &statement.tokens[0];
    let written = &text[first.span.clone()];
    if first.kind == Kind::Open {
        return Vec::new();
    }
    if first.kind == Kind::Word && is_value(written) {
        let message = "a value stands here without the word for what it is".to_owned();
        let help = Help::Unknown("write that word before it, as in center 0 1 0".to_owned());
        let edit = (statement.span.clone(), "something".to_owned());
        return vec![Touch { at: statement.span.clone(), edit, message, help }];
    }
    if first.kind == Kind::Word && !is_annotation(written) && !is_identifier(statement.word(text)) {
        let message = format!("{} begins no statement", shown(written));
        let help = Help::Unknown("begin with a word, as in radius 1".to_owned());
        let edit = (statement.span.clone(), "something".to_owned());
        return vec![Touch { at: first.span.clone(), edit, message, help }];
    }
    let owner = statement.parent.map(|parent| &all[parent]);
    let sort = owner.and_then(|owner| owner.sort(text));
    let word = statement.word(text);
    let named =
        statement.open.is_some() || statement.tokens[1..].iter().any(|token| token.kind == Kind::Text);
    let takes = takes(word, sort, owner.map(|owner| owner.word(text)), named);
    let mut values =
        Values { text, word, owner: sort, takes, called: false, touches: Vec::new(), unknown: None };
    let rest = head(statement, &mut values);
    values.read(&rest, statement.braced);
    if let (Some((at, ..)), Takes::Numbers(&[]) | Takes::Head(None)) = (&values.unknown, takes) {
        // The word itself is complained about, and what follows it is anybody's guess.
        let edit = (first.span.start + word.len()..statement.span.end, String::new());
        return vec![Touch { at: at.clone(), edit, message: String::new(), help: Help::Statement("") }];
    }
    if let Some((at, message, help)) = values.unknown {
        let edit = (statement.span.clone(), format!("{word} #null"));
        return vec![Touch { at, edit, message, help: Help::Unknown(help) }];
    }
    values.refuse_the_rest(&statement.tokens);
    values.touches
}

/// Whether a statement that begins so begins with a value.
fn is_value(written: &str) -> bool {
    let word = written.trim_matches(',');
    let annotates =
        || written.find(')').is_some_and(|end| end + 1 < written.len() && !written[1..end].contains(','));
    is_number(word)
        || meant(word).is_some()
        || written.starts_with(['<', '[', '=', ':', ')', ']'])
        || (written.starts_with('(') && !annotates())
}

/// What `word` takes in a block of that sort, or of the word `within`; an unknown one may be a node.
pub(super) fn takes(word: &str, sort: Option<Sort>, within: Option<&str>, is_node: bool) -> Takes {
    // A field may be called as a node is: the planes of a polyhedron.
    if let Some(field) = sort.and_then(|sort| sort.field(word)) {
        return match field.kind {
            kind if is_word(kind) => Takes::Words,
            FieldKind::Flag => Takes::Flag,
            kind => Takes::Numbers(arity(kind).0),
        };
    }
    if let Some(own) = Sort::named(word) {
        return Takes::Head(Some(own));
    }
    if word == MATERIAL && matches!(sort, Some(Sort::Shape(_))) {
        return Takes::Words;
    }
    if within == Some("turn") && word == ABOUT {
        return Takes::Numbers(&[3]);
    }
    match STEPS.iter().find(|(step, ..)| *step == word && sort.is_some()) {
        Some((_, 1, _)) => Takes::Numbers(&[1]),
        Some((_, 2, _)) => Takes::Numbers(&[2]),
        Some((_, 3, _)) => Takes::Numbers(&[3]),
        Some((_, 4, _)) => Takes::Numbers(&[4]),
        _ if is_node => Takes::Head(None),
        _ => Takes::Numbers(&[]),
    }
}

/// Looks at the first word and the mark behind it; answers with what follows both.
fn head(statement: &Statement, values: &mut Values<'_>) -> Vec<Token> {
    let first = &statement.tokens[0];
    let mut rest: Vec<Token> = statement.tokens[1..].to_vec();
    if first.kind == Kind::Word {
        let start = first.span.start + values.word.len();
        if start < first.span.end {
            rest.insert(0, Token { kind: Kind::Word, span: start..first.span.end });
        }
    }
    let Some(next) = rest.first().cloned().filter(|next| next.kind == Kind::Word) else { return rest };
    let written = &values.text[next.span.clone()];
    let mark = mark(written);
    if mark == 0 {
        if written.starts_with('(')
            && next.span.start == first.span.end.min(next.span.start)
            && touches_word(first, &next)
        {
            values.call(next.span.start, rest.last().map_or(next.span.end, |last| last.span.end));
            rest[0].span.start += 1;
            rest.retain(|token| !token.span.is_empty());
        }
        return rest;
    }
    let span = next.span.start..next.span.start + mark;
    rest[0].span.start += mark;
    rest.retain(|token| !token.span.is_empty());
    let (word, sign) = (values.word, &values.text[span.clone()]);
    if rest.is_empty() && statement.open.is_none() && !matches!(values.takes, Takes::Head(_)) {
        let help = format!("write {word} and its value");
        values.unknown = Some((statement.span.clone(), format!("no value follows {word}{sign}"), help));
        return rest;
    }
    let end = rest.last().map_or(span.end, |last| last.span.end);
    let message = if rest.is_empty() {
        format!("the block of {word} stands between {{ and }}")
    } else {
        format!("{word} is followed by its value, without {sign} between them")
    };
    let at = statement.span.start..end.max(span.end);
    if first.kind == Kind::Text {
        // `"radius": 1` is written `radius 1`.
        let edit = (first.span.clone(), word.to_owned());
        values.touches.push(Touch {
            at: at.clone(),
            edit,
            message: message.clone(),
            help: Help::Statement(""),
        });
    }
    values.touches.push(Touch { at, edit: (span, " ".to_owned()), message, help: Help::Statement("") });
    rest
}

fn touches_word(first: &Token, next: &Token) -> bool {
    next.span.start <= first.span.end
}

/// The length of `=`, `:`, `:=`, `=>` or `->` at the beginning of a word.
fn mark(written: &str) -> usize {
    match written.bytes().next() {
        Some(b'=' | b':') => written.bytes().take_while(|b| b"=:>".contains(b)).count(),
        Some(b'-') if written.starts_with("->") => 2,
        _ => 0,
    }
}
