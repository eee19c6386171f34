//! What does KDL take a word for: a number, a name, a keyword, a property?

use super::number::is_number;
use catoptra_core::srgb_decoded;

/// Words that need a `#` in KDL.
pub(super) const KEYWORDS: &[&str] = &["true", "false", "null", "nan", "inf", "-inf"];

/// Whether KDL takes the word for a property, or for the beginning of one.
pub(super) fn is_valid_property(word: &str) -> bool {
    word.split_once('=').is_some_and(|(key, value)| {
        is_identifier(key)
            && (value.is_empty() || is_number(value) || is_identifier(value) || is_keyword(value))
    })
}

/// `=value` behind a blank.
pub(super) fn is_value_of_property(word: &str) -> bool {
    word.strip_prefix('=').is_some_and(|value| {
        value.is_empty() || is_number(value) || is_identifier(value) || is_keyword(value)
    })
}

pub(super) fn is_keyword(word: &str) -> bool {
    word.strip_prefix('#').is_some_and(|name| KEYWORDS.contains(&name))
}

/// `(type)` or `(type)value`, which KDL has.
pub(super) fn is_annotation(word: &str) -> bool {
    word.strip_prefix('(').and_then(|rest| rest.split_once(')')).is_some_and(|(name, rest)| {
        is_identifier(name) && (rest.is_empty() || is_number(rest) || is_identifier(rest) || is_keyword(rest))
    })
}

/// Whether KDL takes the word for a string without quotes.
pub(super) fn is_identifier(word: &str) -> bool {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
    let digit = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    !word.is_empty()
        && !digit(unsigned)
        && !unsigned.strip_prefix('.').is_some_and(digit)
        && !word.contains(['\\', '/', '(', ')', '{', '}', '[', ']', ';', '"', '#', '='])
        && !KEYWORDS.contains(&word)
}

/// `#ff8000` or `#f80` as three numbers of linear light (IEC 61966-2-1).
pub(super) fn color(word: &str) -> Option<String> {
    let digits = word.strip_prefix('#').filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()))?;
    let width = match digits.len() {
        3 => 1,
        6 | 8 => 2,
        _ => return None,
    };
    let channel = |i: usize| {
        let value = u8::from_str_radix(&digits[i * width..(i + 1) * width], 16).ok()?;
        let encoded = f64::from(value) / if width == 1 { 15.0 } else { 255.0 };
        Some(crate::write::number((srgb_decoded(encoded) * 1000.0).round() / 1000.0))
    };
    Some([channel(0)?, channel(1)?, channel(2)?].join(" "))
}

/// As much of a word as fits into a message.
pub(super) fn shown(word: &str) -> &str {
    word.char_indices().nth(40).map_or(word, |(at, _)| &word[..at])
}
