//! How are lines, words and numbers found in a model file that is text, whoever wrote it and on whatever system?

use std::borrow::Cow;

/// The bytes of a text that may be UTF-16, as UTF-8; without a byte order mark.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, [u8]> {
    let wide = |rest: &[u8], unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = rest.as_chunks().0.iter().map(|&pair| unit(pair)).collect();
        Cow::Owned(String::from_utf16_lossy(&units).into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => wide(rest, u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

/// The statements of a text: its lines, of which a backslash at the end joins one to the next. Lines end with LF, CR LF or CR
/// alone; a line that begins with control-Z ends the text, as under DOS.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    line: usize,
    joined: Vec<u8>,
}

impl<'a> Lines<'a> {
    /// Of bytes as UTF-8 or any encoding that has ASCII in it.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, line: 0, joined: Vec::new() }
    }

    /// The number of the next statement's first line, from 1, and the statement without white space at its ends. Never empty,
    /// never a comment.
    pub(super) fn next(&mut self) -> Option<(usize, &[u8])> {
        loop {
            let line = self.next_line()?;
            let number = self.line;
            match line {
                [0x1a, ..] => return None,
                [] | [b'#', ..] => {}
                [.., b'\\'] => {
                    self.join(line);
                    return Some((number, self.joined.trim_ascii()));
                }
                line => return Some((number, line)),
            }
        }
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.line += 1;
        let end = self.rest.iter().position(|&byte| byte == b'\n' || byte == b'\r');
        let (line, rest) = match end {
            Some(end) if self.rest[end..].starts_with(b"\r\n") => (&self.rest[..end], &self.rest[end + 2..]),
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &self.rest[self.rest.len()..]),
        };
        self.rest = rest;
        Some(trimmed(line))
    }

    fn join(&mut self, first: &[u8]) {
        self.joined.clear();
        let mut line = first;
        while let Some(start) = line.strip_suffix(b"\\") {
            self.joined.extend_from_slice(start);
            self.joined.push(b' ');
            line = self.next_line().unwrap_or_default();
        }
        self.joined.extend_from_slice(line);
    }
}

/// Without white space at its ends, nor the zeros that files are padded with.
fn trimmed(mut line: &[u8]) -> &[u8] {
    while let [first, rest @ ..] = line
        && is_blank(*first)
    {
        line = rest;
    }
    while let [rest @ .., last] = line
        && is_blank(*last)
    {
        line = rest;
    }
    line
}

fn is_blank(byte: u8) -> bool {
    byte == 0 || byte.is_ascii_whitespace()
}

/// The first word of a statement, and what follows it.
pub(super) fn split_word(statement: &[u8]) -> (&[u8], &[u8]) {
    let end = statement.iter().position(u8::is_ascii_whitespace).unwrap_or(statement.len());
    let (word, rest) = statement.split_at(end);
    (word, rest.trim_ascii_start())
}

/// The words of a statement up to a comment.
pub(super) fn words(statement: &[u8]) -> impl Iterator<Item = &[u8]> {
    let words = statement.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words.take_while(|word| word[0] != b'#')
}

/// A number; what programs write for none (`nan`, `-nan(ind)`, `1.#QNAN`) and beyond all (`inf`, `1.#INF`) is one too.
///
/// # Errors
/// What it is instead, as a message.
pub(super) fn number(word: &[u8]) -> Result<f64, String> {
    if let Some(value) = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok()) {
        return Ok(value);
    }
    let lower = word.to_ascii_lowercase();
    let digits = lower.trim_ascii().strip_prefix(b"-").unwrap_or(&lower);
    if digits.starts_with(b"nan(") || digits.starts_with(b"1.#") {
        return Ok(if digits.starts_with(b"1.#inf") { f64::INFINITY } else { f64::NAN });
    }
    let shown = super::names::name_of(word);
    let comma = shown.replacen(',', ".", 1).parse::<f64>().is_ok();
    Err(if comma {
        format!("\"{shown}\" is no number: write a point for the comma")
    } else {
        format!("\"{shown}\" is no number")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statements(text: &[u8]) -> Vec<(usize, String)> {
        let mut lines = Lines::new(text);
        let mut out = Vec::new();
        while let Some((line, statement)) = lines.next() {
            out.push((line, String::from_utf8_lossy(statement).into_owned()));
        }
        out
    }

    #[test]
    fn lines_end_in_any_way() {
        let expected = [(1, "a b".to_owned()), (3, "c".to_owned())];
        for end in ["\n", "\r", "\r\n"] {
            let text = format!("a b {end}# no{end}\tc\0\0{end}\0\0");
            assert_eq!(statements(text.as_bytes()), expected, "{end:?}");
        }
        assert_eq!(statements(b"a b\n\nc\n\x1a\nd"), expected);
    }

    #[test]
    fn backslashes_join_lines_but_not_those_of_comments() {
        let text = b"f 1 \\\r\n 2\\\n3\n# in C:\\\nv\nx\\";
        let expected = [(1, "f 1  2 3".to_owned()), (5, "v".to_owned()), (6, "x".to_owned())];
        assert_eq!(statements(text), expected);
    }

    #[test]
    fn marks_of_encodings_are_passed_over() {
        let wide =
            |unit: fn(u16) -> [u8; 2]| "\u{feff}v 1 ü".encode_utf16().flat_map(unit).collect::<Vec<u8>>();
        for bytes in [
            &b"v 1 \xc3\xbc"[..],
            b"\xef\xbb\xbfv 1 \xc3\xbc",
            &wide(u16::to_le_bytes),
            &wide(u16::to_be_bytes),
        ] {
            assert_eq!(&*decoded(bytes), "v 1 ü".as_bytes());
        }
    }

    #[test]
    fn numbers_may_be_none() {
        assert_eq!(number(b"-1.5e2"), Ok(-150.0));
        for none in ["nan", "NaN", "-nan(ind)", "1.#QNAN", "-1.#IND00"] {
            assert!(number(none.as_bytes()).is_ok_and(f64::is_nan), "{none}");
        }
        assert!(number(b"1.#INF").is_ok_and(f64::is_infinite));
        assert!(number(b"0,5").is_err_and(|message| message.contains("comma")));
        assert_eq!(number(b"\xfc"), Err("\"ü\" is no number".to_owned()));
    }
}
