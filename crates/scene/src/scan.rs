//! Where do blocks open and close in scene text, strings and comments aside?
//!
//! The KDL parser calls itself for every nested block and comment, so text is looked over here first, and refused
//! before it can exhaust the stack. The same look finds the braces of a node when text is put into it.

use std::borrow::Cow;
use std::ops::Range;

/// Blocks and comments may lie this deep inside each other: the groups of a scene, with room for their fields.
pub(crate) const DEEPEST: usize = catoptra_core::scene::Scene::MAX_DEPTH + 4;

/// A mark that shapes the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// `{`
    Open,
    /// `}`
    Close,
    /// `/-`
    Slashdash,
    /// `/*`, or `//` for who asks for it, told only where it begins; all up to its end is passed over.
    Comment {
        /// How deep comments lie inside it, itself included.
        depth: usize,
        /// The byte behind it.
        end: usize,
    },
}

/// The marks of a text from some byte on, with their places.
pub(crate) struct Marks<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether comments to the end of the line are told too.
    line_comments: bool,
}

impl<'a> Marks<'a> {
    pub(crate) fn from(text: &'a str, at: usize) -> Self {
        Self { bytes: text.as_bytes(), at, line_comments: false }
    }

    /// The same, which tells comments to the end of the line as well.
    fn with_line_comments(self) -> Self {
        Self { line_comments: true, ..self }
    }

    fn starts_with(&self, word: &[u8]) -> bool {
        self.bytes[self.at..].starts_with(word)
    }

    /// Goes past the next `word`, or to the end.
    fn skip_past(&mut self, word: &[u8]) {
        let rest = &self.bytes[self.at..];
        self.at += rest.windows(word.len()).position(|w| w == word).map_or(rest.len(), |i| i + word.len());
    }

    /// Goes to the end of the line, by any of the line ends that KDL knows.
    fn skip_line(&mut self) {
        while self.at < self.bytes.len() && !self.at_line_end() {
            self.at += 1;
        }
    }

    fn at_line_end(&self) -> bool {
        match self.bytes[self.at] {
            b'\n' | b'\r' | 0x0b | 0x0c => true,
            0xc2 => self.starts_with("\u{85}".as_bytes()),
            0xe2 => self.starts_with("\u{2028}".as_bytes()) || self.starts_with("\u{2029}".as_bytes()),
            _ => false,
        }
    }

    fn skip_comment(&mut self) -> Mark {
        let (mut depth, mut deepest) = (0_usize, 0);
        while self.at < self.bytes.len() {
            if self.starts_with(b"/*") {
                depth += 1;
                deepest = deepest.max(depth);
                self.at += 2;
            } else if self.starts_with(b"*/") {
                depth -= 1;
                self.at += 2;
                if depth == 0 {
                    break;
                }
            } else {
                self.at += 1;
            }
        }
        Mark::Comment { depth: deepest, end: self.at }
    }

    /// Goes past a string, given that a quote stands here; one that is not closed ends with its line.
    fn skip_string(&mut self) {
        let long = self.starts_with(b"\"\"\"");
        let quote: &[u8] = if long { b"\"\"\"" } else { b"\"" };
        self.at += quote.len();
        while self.at < self.bytes.len() && !self.starts_with(quote) {
            if !long && self.at_line_end() {
                return;
            }
            self.at += if self.bytes[self.at] == b'\\' { 2 } else { 1 };
        }
        self.at = (self.at + quote.len()).min(self.bytes.len());
    }

    /// Goes past a raw string `#"…"#` or a word such as `#true`, given that a `#` stands here.
    fn skip_hashes(&mut self) {
        let hashes = self.bytes[self.at..].iter().take_while(|&&b| b == b'#').count();
        self.at += hashes;
        if self.starts_with(b"\"") {
            let quotes = if self.starts_with(b"\"\"\"") { 3 } else { 1 };
            self.at += quotes;
            let mut end = vec![b'"'; quotes];
            end.resize(quotes + hashes, b'#');
            self.skip_past(&end);
        }
    }
}

impl Iterator for Marks<'_> {
    type Item = (usize, Mark);

    fn next(&mut self) -> Option<Self::Item> {
        while self.at < self.bytes.len() {
            let here = self.at;
            match self.bytes[here] {
                b'"' => self.skip_string(),
                b'#' => self.skip_hashes(),
                b'/' if self.starts_with(b"//") => {
                    self.skip_line();
                    if self.line_comments {
                        return Some((here, Mark::Comment { depth: 1, end: self.at }));
                    }
                }
                b'/' if self.starts_with(b"/*") => {
                    let mark = self.skip_comment();
                    return Some((here, mark));
                }
                byte => {
                    let mark = match byte {
                        b'{' => Some(Mark::Open),
                        b'}' => Some(Mark::Close),
                        b'/' if self.starts_with(b"/-") => Some(Mark::Slashdash),
                        _ => None,
                    };
                    self.at += if mark == Some(Mark::Slashdash) { 2 } else { 1 };
                    if let Some(mark) = mark {
                        return Some((here, mark));
                    }
                }
            }
        }
        None
    }
}

/// The place at which blocks or comments lie deeper than [`DEEPEST`] inside each other, if there is one.
pub(crate) fn too_deep(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, mark) in Marks::from(text, 0) {
        match mark {
            Mark::Open => depth += 1,
            Mark::Close => depth = depth.saturating_sub(1),
            Mark::Comment { depth, .. } if depth > DEEPEST => return Some(at),
            Mark::Comment { .. } | Mark::Slashdash => {}
        }
        if depth > DEEPEST {
            return Some(at);
        }
    }
    None
}

/// The text with blanks for what stands between `/*` and `*/`, byte by byte: the parser calls itself for every `*` and
/// `/` in there.
pub(crate) fn without_comments(text: &str) -> Cow<'_, str> {
    let comments: Vec<Range<usize>> = Marks::from(text, 0)
        .filter_map(|(at, mark)| match mark {
            Mark::Comment { end, .. } if text[at..end].ends_with("*/") => Some(at..end),
            _ => None,
        })
        .collect();
    if comments.is_empty() {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    for comment in comments {
        out.push_str(&text[out.len()..comment.start]);
        out.extend(std::iter::repeat_n(' ', comment.len()));
    }
    out.push_str(&text[out.len()..]);
    Cow::Owned(out)
}

/// All comments in a piece of the text, but for nodes that are commented out.
pub(crate) fn comments(text: &str, piece: Range<usize>) -> Vec<Range<usize>> {
    let marks = Marks::from(&text[..piece.end], piece.start).with_line_comments();
    let comment = |(at, mark)| if let Mark::Comment { end, .. } = mark { Some(at..end) } else { None };
    marks.filter_map(comment).collect()
}

/// The block of a node whose text is `node` in `text`: from its `{` to past its `}`. Blocks that are commented out
/// with a slashdash are no blocks of the node.
pub(crate) fn block_of(text: &str, node: Range<usize>) -> Option<Range<usize>> {
    let mut depth = 0_usize;
    let mut open = None;
    let mut slashed = false;
    let mut skipping = false;
    for (at, mark) in Marks::from(&text[..node.end], node.start) {
        match mark {
            Mark::Slashdash => slashed = depth == 0,
            Mark::Open => {
                if depth == 0 {
                    skipping = slashed && text[..at].trim_end().ends_with("/-");
                    open = Some(at);
                }
                depth += 1;
            }
            Mark::Close => {
                depth = depth.saturating_sub(1);
                if depth == 0 && !skipping {
                    return open.map(|open| open..at + 1);
                }
            }
            Mark::Comment { .. } => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braces_in_strings_and_comments_are_no_blocks() {
        let text = "a \"{\\\"{\" #\"{\"{\"# /* { /* { */ { */ // {\n\"\"\"{\n\"{\"\n\"\"\" b { c }";
        let marks: Vec<_> =
            Marks::from(text, 0).filter(|(_, m)| !matches!(m, Mark::Comment { depth: 2, .. })).collect();
        assert_eq!(marks, [(text.len() - 5, Mark::Open), (text.len() - 1, Mark::Close)]);
    }

    #[test]
    fn depth_is_found_where_it_goes_too_far() {
        assert_eq!(too_deep(&"a {".repeat(DEEPEST)), None);
        assert_eq!(too_deep(&"a {".repeat(DEEPEST + 1)), Some(3 * DEEPEST + 2));
        assert!(too_deep(&"/*".repeat(100_000)).is_some());
        assert_eq!(too_deep(&"a { }".repeat(1000)), None);
    }

    #[test]
    fn comments_are_blanked_byte_by_byte() {
        let text = "a \"/* b */\" /* ü\n/* x */ */ c // /* d\n/* e";
        let blanked = without_comments(text);
        assert_eq!(blanked.len(), text.len());
        assert_eq!(blanked.replace("  ", ""), "a \"/* b */\"c // /* d\n/* e");
    }

    #[test]
    fn a_block_commented_out_is_not_the_block() {
        let text = "a 1 /-{ x } { y }";
        assert_eq!(block_of(text, 0..text.len()).map(|r| &text[r]), Some("{ y }"));
        assert_eq!(block_of("a 1", 0..3), None);
    }
}
