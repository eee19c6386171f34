//! How is text from a file or a name shown, so that it cannot steer a terminal or hide what it says?

use std::borrow::Cow;

/// The text with everything that no reader would see, or that a terminal would obey, spelled as escapes: control
/// characters (`\n`, `\u{1b}`), marks that turn the direction of writing, and marks of no width.
#[must_use]
pub fn printable(text: &str) -> Cow<'_, str> {
    if !text.chars().any(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        push_shown(&mut out, c);
    }
    Cow::Owned(out)
}

/// The same, and of a long text only so many characters from both ends.
pub(crate) fn brief(text: &str, most: usize) -> String {
    let length = text.chars().count();
    if length <= most {
        return printable(text).into_owned();
    }
    let tail = most / 4;
    let head: String = text.chars().take(most - tail).collect();
    let tail: String = text.chars().skip(length - tail).collect();
    format!("{}…{}", printable(&head), printable(&tail))
}

/// Adds a character, or its escape.
pub(crate) fn push_shown(out: &mut String, c: char) {
    if is_hidden(c) {
        out.extend(c.escape_default());
    } else {
        out.push(c);
    }
}

/// Whether a character is escaped: controls, line ends of every sort, directions (UAX #9), marks of no width.
pub(crate) fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{61c}' | '\u{ad}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_text_both_ends_are_shown() {
        let text = format!("begins{}ends", "x".repeat(1_000_000));
        let brief = brief(&text, 80);
        assert!(
            brief.chars().count() <= 81 && brief.starts_with("begins") && brief.ends_with("ends"),
            "{brief}"
        );
    }

    #[test]
    fn what_steers_a_terminal_is_spelled_out() {
        assert_eq!(printable("a\u{1b}[31mb\r\n\0"), "a\\u{1b}[31mb\\r\\n\\u{0}");
        assert_eq!(printable("\u{202e}gpj.\u{9b}2J"), "\\u{202e}gpj.\\u{9b}2J");
        assert!(matches!(printable("Übersicht 日本 'x'"), Cow::Borrowed(_)));
    }
}
