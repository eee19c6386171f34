//! Which nodes, blocks and comments is valid scene text made of? Words stay as they are spelt.

/// Something between two ends of lines or semicolons.
#[derive(Debug, Clone, Default)]
pub(super) struct Item {
    pub(super) pieces: Vec<Piece>,
    /// Whether a blank line stands before it.
    pub(super) after_blank: bool,
    /// Whether it stands on the line of the one before.
    pub(super) joined: bool,
}

/// A part of an item.
#[derive(Debug, Clone)]
pub(super) enum Piece {
    /// A word, a number, a string, or a property with its value.
    Word(String),
    /// `/* */` or `// `
    Comment(String),
    /// `/-`, which belongs to what follows.
    Slashdash,
    /// A line that goes on, with what stands behind the backslash.
    Continued(Option<String>),
    Block(Block),
}

/// What stands in braces.
#[derive(Debug, Clone)]
pub(super) struct Block {
    pub(super) items: Vec<Item>,
    /// Whether all of it stands on the line of its braces.
    pub(super) is_one_line: bool,
}

/// The items of a text that is valid.
pub(super) fn items_of(text: &str) -> Vec<Item> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    Reader { text, at: 0 }.items()
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

fn is_newline(c: char) -> bool {
    matches!(c, '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}')
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Takes so many bytes.
    fn take(&mut self, length: usize) -> &'a str {
        let taken = &self.rest()[..length];
        self.at += length;
        taken
    }

    /// Takes the end of a line, if one stands here.
    fn line_end(&mut self) -> bool {
        let length = match self.rest().chars().next() {
            Some('\r') if self.rest().starts_with("\r\n") => 2,
            Some(c) if is_newline(c) => c.len_utf8(),
            _ => return false,
        };
        self.take(length);
        true
    }

    /// The items up to the end of the text, or of the block.
    fn items(&mut self) -> Vec<Item> {
        let mut items: Vec<Item> = Vec::new();
        let (mut item, mut ends) = (Item { joined: true, ..Item::default() }, 0);
        while let Some(c) = self.rest().chars().next() {
            if self.line_end() {
                ends += 1;
                finish(&mut items, &mut item, ends);
                continue;
            }
            match c {
                '}' => break,
                ';' => {
                    self.take(1);
                    let joined = Item { joined: true, ..Item::default() };
                    finish_with(&mut items, &mut item, joined);
                }
                c if c.is_whitespace() => {
                    self.take(c.len_utf8());
                }
                _ => item.pieces.push(self.piece()),
            }
            if !matches!(c, ' ' | '\t') {
                ends = 0;
            }
        }
        finish_with(&mut items, &mut item, Item::default());
        items
    }

    fn piece(&mut self) -> Piece {
        let rest = self.rest();
        if rest.starts_with("//") {
            let end = rest.find(is_newline).unwrap_or(rest.len());
            return Piece::Comment(self.take(end).trim_end().to_owned());
        }
        if rest.starts_with("/*") {
            let end = comment_end(rest);
            return Piece::Comment(self.take(end).to_owned());
        }
        if rest.starts_with("/-") {
            self.take(2);
            // What it belongs to may stand on the next line.
            while self.line_end() || self.rest().starts_with([' ', '\t']) {
                if self.rest().starts_with([' ', '\t']) {
                    self.take(1);
                }
            }
            return Piece::Slashdash;
        }
        if rest.starts_with('\\') {
            return self.continuation();
        }
        if rest.starts_with('{') {
            return self.block();
        }
        self.word()
    }

    /// A backslash, blanks, perhaps a comment, and the end of the line.
    fn continuation(&mut self) -> Piece {
        self.take(1);
        let end = self.rest().find(is_newline).unwrap_or(self.rest().len());
        let behind = self.take(end).trim();
        let comment = (!behind.is_empty()).then(|| behind.to_owned());
        self.line_end();
        Piece::Continued(comment)
    }

    fn block(&mut self) -> Piece {
        self.take(1);
        let start = self.at;
        let items = self.items();
        let is_one_line = !self.text[start..self.at].contains(is_newline) && !has_line_comment(&items);
        if self.rest().starts_with('}') {
            self.take(1);
        }
        Piece::Block(Block { items, is_one_line })
    }

    /// A word with all that belongs to it: its type, an equals sign and a value.
    fn word(&mut self) -> Piece {
        let mut word = self.atom().to_owned();
        loop {
            let blanks = self.rest().len() - self.rest().trim_start_matches([' ', '\t']).len();
            let next = &self.rest()[blanks..];
            let goes_on = next.starts_with('=') || word.ends_with(['=', ')']) && !next.is_empty();
            if !goes_on || next.starts_with(is_newline) {
                return Piece::Word(word);
            }
            self.take(blanks);
            word.push_str(self.atom());
        }
    }

    /// Characters up to a blank or a brace; a string is whole.
    fn atom(&mut self) -> &'a str {
        let start = self.at;
        while let Some(c) = self.rest().chars().next() {
            match c {
                '"' => self.string(0),
                '#' => {
                    let hashes = self.rest().len() - self.rest().trim_start_matches('#').len();
                    self.take(hashes);
                    if self.rest().starts_with('"') {
                        self.string(hashes);
                    }
                }
                '=' if self.at == start => {
                    self.take(1);
                    break;
                }
                '{' | '}' | ';' | '\\' | '=' => break,
                c if c.is_whitespace() || is_newline(c) => break,
                _ if self.rest().starts_with("/*") || self.rest().starts_with("//") => break,
                c => {
                    self.take(c.len_utf8());
                }
            }
        }
        if self.at == start {
            // Nothing that is valid stands here; go on all the same.
            let length = self.rest().chars().next().map_or(0, char::len_utf8);
            self.take(length);
        }
        &self.text[start..self.at]
    }

    /// Goes past a string, given that a quote stands here, behind so many hashes.
    fn string(&mut self, hashes: usize) {
        let quotes = if self.rest().starts_with("\"\"\"") { 3 } else { 1 };
        let end = "\"".repeat(quotes) + &"#".repeat(hashes);
        self.take(quotes);
        while !self.rest().is_empty() && !self.rest().starts_with(&end) {
            let escaped = hashes == 0 && self.rest().starts_with('\\');
            self.take(self.rest().chars().take(1 + usize::from(escaped)).map(char::len_utf8).sum());
        }
        self.take(end.len().min(self.rest().len()));
    }
}

/// Ends an item at the end of a line, or begins anew after so many of them.
fn finish(items: &mut Vec<Item>, item: &mut Item, ends: u32) {
    let after_blank = ends > 1 || item.after_blank && item.pieces.is_empty();
    finish_with(items, item, Item { after_blank, ..Item::default() });
}

fn finish_with(items: &mut Vec<Item>, item: &mut Item, next: Item) {
    let done = std::mem::replace(item, next);
    if !done.pieces.is_empty() {
        items.push(done);
    } else if done.after_blank {
        item.after_blank = true;
    }
}

fn has_line_comment(items: &[Item]) -> bool {
    items.iter().flat_map(|item| &item.pieces).any(|piece| match piece {
        Piece::Comment(comment) => comment.starts_with("//"),
        Piece::Block(block) => has_line_comment(&block.items),
        _ => false,
    })
}

/// The bytes of a comment in stars, with those inside it.
fn comment_end(text: &str) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while at < text.len() {
        if text[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if text[at..].starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                break;
            }
        } else {
            at += text[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    at
}
