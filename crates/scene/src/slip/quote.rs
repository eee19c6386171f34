//! Where was a string meant to begin and end, and what was meant by a `\` in it?

use super::lex::{Kind, Lexer, continues, is_forbidden, is_newline, is_space};
use super::{Help, Touch};
use crate::outline::Span;

/// Marks that are no quotes in KDL, and what closes what they open.
const ODD: &[(char, &str)] = &[
    ('\'', "'’"),
    ('‘', "’‘"),
    ('’', "’"),
    ('“', "”“"),
    ('”', "”"),
    ('„', "“”"),
    ('«', "»"),
    ('»', "«"),
    ('`', "`'"),
];

/// Longer text between two marks was not meant to be in quotes.
const LONGEST_ODD: usize = 400;

/// Whether a mark is used as a quote elsewhere.
pub(crate) fn is_odd(c: char) -> bool {
    ODD.iter().any(|(mark, _)| *mark == c)
}

/// Whether something may follow a string at once, or is a mark that is looked at later.
fn may_follow(rest: &str) -> bool {
    let next = rest.chars().next();
    let is_mark = |c| is_newline(c) || is_space(c) || is_forbidden(c) || ";{}=,:)]>".contains(c);
    next.is_none_or(is_mark) || rest.starts_with("//") || rest.starts_with("/*") || continues(rest)
}

/// A string in quotes that begins here.
pub(super) fn string(lexer: &mut Lexer<'_>) {
    let rest = lexer.rest();
    if let Some(body) = rest.strip_prefix("\"\"\"") {
        if let Some(length) = long(body) {
            return lexer.push(Kind::Text, length + 6);
        }
        let line = &lexer.line()[3..];
        if let Some(end) = line.find("\"\"\"") {
            let span = lexer.at..lexer.at + end + 6;
            let right = format!("\"{}\"", line[..end].replace('"', "\\\""));
            let message = "text between three quotes begins on the next line".to_owned();
            lexer.touch(span.clone(), (span, right.clone()), message, Help::Says(format!("write {right}")));
            return lexer.push(Kind::Text, end + 6);
        }
    }
    let line = &lexer.line()[1..];
    match end_of(line) {
        Some(end) if may_follow(&line[end + 1..]) => {
            escapes(lexer, lexer.at..lexer.at + end + 2, end);
            lexer.push(Kind::Text, end + 2);
        }
        found => unclosed(lexer, line, found),
    }
}

/// The length of the rest of a string of several lines, without its closing quotes.
fn long(body: &str) -> Option<usize> {
    if !body.starts_with(is_newline) {
        return None;
    }
    let mut at = 0;
    while let Some(i) = body[at..].find(['\\', '"']) {
        at += i;
        if body[at..].starts_with("\"\"\"") {
            return Some(at);
        }
        let escape = body[at..].starts_with('\\');
        at += 1;
        if escape {
            at += body[at..].chars().next().map_or(0, char::len_utf8);
        }
    }
    None
}

/// The byte of the quote that closes a string of which `line` is left.
fn end_of(line: &str) -> Option<usize> {
    let mut escaped = false;
    for (i, c) in line.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return Some(i),
            _ => {}
        }
    }
    None
}

/// A string that is not closed where it should be: it was meant to end before what can only follow it.
fn unclosed(lexer: &mut Lexer<'_>, line: &str, found: Option<usize>) {
    let (start, region) = (lexer.at + 1, &line[..found.unwrap_or(line.len())]);
    if found.is_none()
        && let Some(at) = region.find("\\\"")
        && may_follow(&region[at + 2..])
    {
        // A path ends with a \, which takes the quote for itself.
        let span = start - 1..start + at + 2;
        let path = region[..at].replace('\\', "/");
        let message = "a \\ before the quote keeps the string open".to_owned();
        let help = Help::Says(format!("write \"{path}/\""));
        lexer.touch(span.clone(), (span, format!("\"{path}/\"")), message, help);
        return lexer.push(Kind::Text, at + 3);
    }
    let cut = cut(region);
    match (cut, found) {
        (None, Some(end)) => {
            let next = start + end + 1;
            let message = "the string ends at this quote, and something follows it at once".to_owned();
            let help = "write \\\" for a quote within a name, or a blank behind the string";
            lexer.touch(
                next - 1..next,
                (next..next, " ".to_owned()),
                message,
                Help::Unknown(help.to_owned()),
            );
            lexer.push(Kind::Text, end + 2);
        }
        _ => {
            let end = cut.unwrap_or(region.len());
            let end = region[..end].trim_end().trim_end_matches(',').len();
            let name = &region[..end];
            let message = "this quote is never closed".to_owned();
            let help = Help::Says(format!("write \"{name}\""));
            lexer.touch(start - 1..start, (start + end..start + end, "\"".to_owned()), message, help);
            escapes(lexer, start - 1..start + end, end);
            lexer.push(Kind::Text, end + 1);
        }
    }
}

/// Where a string was meant to end at the latest: before a brace, a `;`, a comment, or a property.
fn cut(region: &str) -> Option<usize> {
    let marks = [" {", "{", " }", "}", ";", " //"].into_iter().filter_map(|mark| region.find(mark));
    let property = region.match_indices('=').find_map(|(at, _)| {
        let before = region[..at].trim_end();
        let name = before.rfind(is_space)?;
        before[name..].trim().chars().all(|c| c.is_ascii_lowercase() || c == '-').then_some(name)
    });
    marks.chain(property).min()
}

/// Text in quotes that KDL has not; false if nothing on the line closes it.
pub(super) fn odd(lexer: &mut Lexer<'_>) -> bool {
    let line = lexer.line();
    let Some(open) = line.chars().next() else { return false };
    let closers = ODD.iter().find(|(mark, _)| *mark == open).map_or("", |(_, closers)| closers);
    let body = &line[open.len_utf8()..];
    let body = &body[..body.floor_char_boundary(LONGEST_ODD)];
    let body = &body[..body.find('"').unwrap_or(body.len())];
    let found = body
        .char_indices()
        .find(|(i, c)| closers.contains(*c) && may_follow(&line[open.len_utf8() + i + c.len_utf8()..]));
    let Some((end, close)) = found else { return false };
    let right = format!("\"{}\"", body[..end].replace('\\', "/"));
    let length = open.len_utf8() + end + close.len_utf8();
    let span = lexer.at..lexer.at + length;
    let message = "names and paths stand in double quotes".to_owned();
    lexer.touch(span.clone(), (span, right.clone()), message, Help::Says(format!("write {right}")));
    lexer.push(Kind::Text, length);
    true
}

/// A quote directly behind a word: the one that opens its string is missing, unless the word may stand there.
pub(super) fn after_word(lexer: &mut Lexer<'_>) {
    let Some(word) = lexer.out.tokens.last().cloned() else { return };
    let written = &lexer.text[word.span.clone()];
    let annotates = written.starts_with('(') && written.ends_with(')');
    if annotates || written.ends_with(['=', '(', '[', '<', ',', ':']) {
        return;
    }
    let mut start = word.span.start + written.rfind(['=', ',', '(']).map_or(0, |at| at + 1);
    if start == word.span.start {
        start = with_words_before(lexer, start);
    }
    let close = lexer.at + 1;
    let name = &lexer.text[start..close - 1];
    let message = format!("no quote opens before {name}");
    let help = Help::Says(format!("write \"{name}\""));
    lexer.touch(start..close, (start..start, "\"".to_owned()), message, help);
    while lexer.out.tokens.last().is_some_and(|last| last.span.start >= start) {
        lexer.out.tokens.pop();
    }
    if start > word.span.start {
        lexer.at = word.span.start;
        lexer.push(Kind::Word, start - word.span.start);
    }
    lexer.at = start;
    lexer.push(Kind::Text, close - start);
}

/// The words before a word on its line, but for the one that names the node, if there are any.
fn with_words_before(lexer: &Lexer<'_>, mut start: usize) -> usize {
    let tokens = &lexer.out.tokens;
    for pair in tokens.windows(2).rev().skip(1) {
        let plain = |word: &str| word.chars().all(|c| c.is_alphanumeric() || "-_.".contains(c));
        if pair[0].kind != Kind::Word
            || pair[1].kind != Kind::Word
            || !plain(&lexer.text[pair[1].span.clone()])
        {
            break;
        }
        start = pair[1].span.start;
    }
    start
}

/// A raw string `#"…"#`, given the number of its hashes; one that is not closed ends with its line.
pub(super) fn raw(lexer: &mut Lexer<'_>, hashes: usize) {
    let rest = lexer.rest();
    let quotes = if rest[hashes..].starts_with("\"\"\"") { 3 } else { 1 };
    let end = format!("{}{}", "\"".repeat(quotes), "#".repeat(hashes));
    let body = if quotes == 3 { rest } else { lexer.line() };
    if let Some(length) = body[hashes + quotes..].find(&end) {
        return lexer.push(Kind::Text, hashes + quotes + length + end.len());
    }
    let line = lexer.line().len();
    let span = lexer.at..lexer.at + line;
    let message = format!("this string is never closed with {end}");
    lexer.touch(
        span.clone(),
        (span, "\"\"".to_owned()),
        message,
        Help::Unknown(format!("close it with {end}")),
    );
    lexer.push(Kind::Text, line);
}

/// Puts right what stands in a string, which is so many bytes long without its quotes: a `\` that begins no escape, and characters that only escapes can stand for.
fn escapes(lexer: &mut Lexer<'_>, whole: Span, length: usize) {
    let inside = whole.start + 1..whole.start + 1 + length;
    let written = &lexer.text[inside.clone()];
    let mut chars = written.char_indices();
    let mut wrong = None;
    while let Some((i, c)) = chars.next() {
        if is_forbidden(c) {
            let at = inside.start + i;
            tell_controls(lexer, at..at + c.len_utf8(), u32::from(c), 1);
        }
        if c == '\\' {
            let after = &written[i + 1..];
            let unicode = || {
                let digits = after.strip_prefix("u{")?.split_once('}')?.0;
                u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() <= 6).and_then(char::from_u32)
            };
            let fine =
                after.starts_with(|c: char| "\\\"bfnrts".contains(c) || is_space(c)) || unicode().is_some();
            if !fine && wrong.is_none() {
                wrong = Some((i, after.chars().next()));
            }
            chars.next();
        }
    }
    if let Some((i, next)) = wrong {
        let escape = format!("\\{}", next.map(String::from).unwrap_or_default());
        let path = written.replace("\\\\", "\\");
        let (slashed, doubled) = (path.replace('\\', "/"), path.replace('\\', "\\\\"));
        let at = inside.start + i;
        lexer.out.touches.push(Touch {
            at: at..at + escape.len(),
            edit: (whole.clone(), format!("\"{slashed}{}", &lexer.text[inside.end..whole.end])),
            message: format!("{escape} stands for nothing: a \\ in quotes must be written \\\\ or /"),
            help: Help::Says(format!("write \"{slashed}\" or \"{doubled}\"")),
        });
    }
}

/// Notes characters that must not stand in a text.
pub(super) fn tell_controls(lexer: &mut Lexer<'_>, span: Span, first: u32, count: usize) {
    let what = match first {
        0xfeff => "a byte order mark".to_owned(),
        0x200e.. => format!("the invisible mark U+{first:04X}, which turns the direction of writing,"),
        _ => format!("the control character U+{first:04X}"),
    };
    let more = if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
    let help = if count > 20 && first == 0 {
        "save the file as UTF-8 text; this looks like UTF-16".to_owned()
    } else {
        format!("take it out; in quotes it may be written \\u{{{first:x}}}")
    };
    let blank = " ".to_owned();
    lexer.touch(
        span.clone(),
        (span, blank),
        format!("{what}{more} cannot stand in scene text"),
        Help::Alone(help),
    );
}
