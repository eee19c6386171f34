//! The lines and numbers of an IES file, each with its place. Text beside the numbers may be in any encoding.

use super::error::{Fault, Place};

/// The text of a file, and how far it has been read.
pub(super) struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    /// Where the current line begins.
    start: usize,
}

/// A number and where it stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Number {
    pub(super) value: f64,
    pub(super) place: Place,
}

impl<'a> Text<'a> {
    /// # Errors
    /// A file that is empty or is no text of single bytes.
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        if bytes.trim_ascii().is_empty() {
            return Err(Fault::file("is empty"));
        }
        if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
            return Err(Fault::file("is text in UTF-16: save it as plain text (ASCII or UTF-8)"));
        }
        if bytes.contains(&0) {
            return Err(Fault::file("is no IES file: it holds bytes that are no text"));
        }
        Ok(Self { bytes, at: 0, line: 1, start: 0 })
    }

    /// How many bytes are left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn place(&self) -> Place {
        Place { line: self.line, column: self.at - self.start + 1 }
    }

    /// Goes past a byte; a carriage return and a line feed end one line together.
    fn pass(&mut self) {
        let ends = |byte: u8, next: Option<&u8>| byte == b'\n' || (byte == b'\r' && next != Some(&b'\n'));
        let ended = ends(self.bytes[self.at], self.bytes.get(self.at + 1));
        self.at += 1;
        if ended {
            self.line += 1;
            self.start = self.at;
        }
    }

    /// The rest of the line, trimmed, and where it begins; nothing at the end of the file.
    pub(super) fn line(&mut self) -> Option<(Place, &'a [u8])> {
        if self.at == self.bytes.len() {
            return None;
        }
        let (place, from) = (self.place(), self.at);
        let length = self.bytes[from..].iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        self.at = length.map_or(self.bytes.len(), |length| from + length);
        let line = &self.bytes[from..self.at];
        if self.bytes[self.at..].starts_with(b"\r\n") {
            self.pass();
        }
        if self.at < self.bytes.len() {
            self.pass();
        }
        Some((place, line.trim_ascii()))
    }

    /// The next word, across lines: what stands between blanks and commas.
    pub(super) fn word(&mut self) -> Option<(Place, &'a [u8])> {
        // The byte 26 ends files of old systems.
        let separates = |byte: u8| byte.is_ascii_whitespace() || byte == b',' || byte == 26;
        while separates(*self.bytes.get(self.at)?) {
            self.pass();
        }
        let (place, from) = (self.place(), self.at);
        let length = self.bytes[from..].iter().position(|&byte| separates(byte));
        self.at = length.map_or(self.bytes.len(), |length| from + length);
        Some((place, &self.bytes[from..self.at]))
    }

    /// The next number, which `what` stands for in messages.
    pub(super) fn number(&mut self, what: &str) -> Result<Number, Fault> {
        let Some((place, word)) = self.word() else {
            return Err(Fault::at(self.place(), format!("the file ends before {what}")));
        };
        let value = parse(word).ok_or_else(|| {
            let word = String::from_utf8_lossy(word);
            Fault::at(place, format!("{what} must be a number, not \"{word}\""))
        })?;
        Ok(Number { value, place })
    }
}

/// A finite decimal number.
pub(super) fn parse(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    text.parse().ok().filter(|value: &f64| value.is_finite())
}
