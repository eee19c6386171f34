//! What did somebody mean who wrote scene text as another language has it? Slips with one complaint each, and a copy of
//! the text without them, so that what is wrong behind them can be found in the same look.
//!
//! What is none to the reader is none at all: text that can be read as it stands is left alone. The kinds of slips that are known, file by file:
//!
//! * `quote`: quotes that are missing or of another sort, `\` in paths;
//! * `lex`: comments and controls that KDL has not;
//! * `structure`, `brace`, `indent`: braces and `;` that are missing or too many;
//! * `statement`: `=`, `:` and calls between a word and its values;
//! * `value`, `part`, `property`: commas, brackets, quotes, words of other languages;
//! * `number`: `.5`, `5.`, `1e5f`, `50%`.

mod brace;
mod indent;
mod lex;
mod number;
mod part;
mod property;
mod quote;
mod statement;
mod structure;
mod value;
mod word;

use crate::outline::Span;
use crate::report::Complaints;
use crate::scan;
pub(crate) use quote::is_odd as is_odd_quote;
use structure::Statement;

/// One thing to be put right, and how.
#[derive(Debug, Clone)]
struct Touch {
    /// What is complained about.
    at: Span,
    /// What of the text is to be replaced, and with what: as many line ends as it has.
    edit: (Span, String),
    /// Empty where another complaint tells it.
    message: String,
    help: Help,
}

/// What the hint of a slip says.
#[derive(Debug, Clone)]
enum Help {
    /// This, and nothing of the statement that it stands in: it is a slip of its own.
    Alone(String),
    /// This, if nothing else in the statement is wrong, else the statement as it should be.
    Says(String),
    /// The statement as it should be, after these words.
    Statement(&'static str),
    /// This, whatever else is wrong: nobody can tell what the statement should be.
    Unknown(String),
}

/// A text without its slips.
#[derive(Debug)]
pub(crate) struct Mended {
    /// The text with every slip put right.
    pub(crate) text: String,
    /// What was replaced: where in the text as it was, and where in `text`; in order.
    edits: Vec<(Span, Span)>,
    slips: Vec<(Span, String, String)>,
    is_scene_text: bool,
}

/// With more slips nothing else is looked for.
const MANY: usize = 300;

/// A text of which more bytes are slips is no scene text by any reading. The parser calls itself for each of them.
const DOUBTFUL: usize = 1000;

/// Longer corrections are not shown whole.
const LONGEST_HELP: usize = 160;

/// Looks for slips; `None` if there are none, or if the text is too deep to be read whatever is done.
pub(crate) fn mend(text: &str) -> Option<Mended> {
    if scan::too_deep(text).is_some() {
        return None;
    }
    if let Some(slip) = foreign(text) {
        return Some(Mended {
            text: String::new(),
            edits: Vec::new(),
            slips: vec![slip],
            is_scene_text: false,
        });
    }
    let lexed = lex::lex(text);
    let built = structure::build(text, &lexed);
    let mut touches = lexed.touches;
    touches.extend(built.touches);
    for statement in &built.statements {
        touches.extend(statement::touch(text, statement, &built.statements));
    }
    // What is put before something comes before what is done to it, and changes come before those within them.
    touches.sort_by_key(|touch| {
        let span = &touch.edit.0;
        (span.start, !span.is_empty(), std::cmp::Reverse(span.end))
    });
    if touches.is_empty() {
        return None;
    }
    let slips = told(text, &touches, &built.statements);
    let (mended, edits) = apply(text, &touches);
    Some(Mended { text: mended, edits, slips, is_scene_text: true })
}

impl Mended {
    /// Where a byte of the mended text stands in the text as it was; `None` within what was put there instead.
    pub(crate) fn place(&self, at: usize) -> Option<usize> {
        let after = self.edits.partition_point(|(_, new)| new.end <= at);
        match (self.edits.get(after), after.checked_sub(1).map(|last| &self.edits[last])) {
            (Some((_, new)), _) if new.start <= at => None,
            (_, Some((old, new))) => Some(old.end + (at - new.end)),
            (_, None) => Some(at),
        }
    }

    /// Whether there are so few that the text may be tried as it is.
    pub(crate) fn is_doubtful(&self) -> bool {
        let changed: usize = self.edits.iter().map(|(old, new)| old.len().max(new.len())).sum();
        self.is_scene_text && changed <= DOUBTFUL
    }

    /// Whether it is worth while to look for what is wrong behind the slips: there are not more of them than can be told.
    pub(crate) fn is_to_be_read(&self) -> bool {
        self.is_scene_text && self.slips.len() <= MANY
    }

    /// Notes the slips.
    pub(crate) fn tell(&self, complaints: &mut Complaints) {
        for (at, message, help) in &self.slips {
            complaints.add_with(at.clone(), message.as_str(), help.as_str());
        }
    }
}

/// The only complaint about a text that is no scene text from its first word on.
fn foreign(text: &str) -> Option<(Span, String, String)> {
    let nul = text.bytes().filter(|b| *b == 0).count();
    if nul > 8 && nul > text.len() / 4 {
        let at = text.find('\0').unwrap_or(0);
        let message = "every other byte is 0: this looks like UTF-16 text".to_owned();
        return Some((at..at + 1, message, "save the file as UTF-8".to_owned()));
    }
    let rest = text.trim_start_matches('\u{feff}').trim_start();
    let inner = rest.strip_prefix(['{', '[']).map(str::trim_start);
    let is_tag = |tag: &str| {
        tag.starts_with(|c: char| c == '?' || c.is_ascii_alphabetic()) || tag.starts_with("!DOCTYPE")
    };
    let language = if inner.is_some_and(|inner| inner.starts_with(['"', '{', '[', '}', ']'])) {
        "JSON"
    } else if rest.strip_prefix('<').is_some_and(is_tag) {
        "XML"
    } else {
        return None;
    };
    let at = text.len() - rest.len();
    let help = "scene text is written: sphere \"ball\" material=\"white\" { center 0 1 0; radius 1 }";
    Some((at..at + 1, format!("this is {language}, not scene text"), help.to_owned()))
}

/// The text with every change made, but for those within others.
fn apply(text: &str, touches: &[Touch]) -> (String, Vec<(Span, Span)>) {
    let mut out = String::with_capacity(text.len() + 64);
    let mut edits = Vec::with_capacity(touches.len());
    let mut at = 0;
    for Touch { edit: (span, new), .. } in touches {
        if span.start < at {
            continue;
        }
        out.push_str(&text[at..span.start]);
        edits.push((span.clone(), out.len()..out.len() + new.len()));
        out.push_str(new);
        at = span.end;
    }
    out.push_str(&text[at..]);
    (out, edits)
}

/// What is told: one complaint for all that is wrong between the words of one statement, and one for each slip of its
/// own.
fn told(text: &str, touches: &[Touch], statements: &[Statement]) -> Vec<(Span, String, String)> {
    let mut slips = Vec::new();
    let mut groups: Vec<(Option<usize>, Vec<&Touch>)> = Vec::new();
    for touch in touches.iter().filter(|touch| !touch.message.is_empty()) {
        if let Help::Alone(help) = &touch.help {
            slips.push((touch.at.clone(), touch.message.clone(), help.clone()));
            continue;
        }
        let statement = statements.partition_point(|statement| statement.span.start <= touch.at.start);
        let statement = statement.checked_sub(1).filter(|&i| statements[i].span.end >= touch.at.start);
        match groups.last_mut() {
            Some((last, group)) if *last == statement && statement.is_some() => group.push(touch),
            _ => groups.push((statement, vec![touch])),
        }
    }
    for (statement, group) in groups {
        let first = group.iter().copied().min_by_key(|touch| touch.at.start);
        let Some(first) = first else { continue };
        let end = group.iter().map(|touch| touch.at.end).max().unwrap_or(first.at.end);
        let span = statement.map_or(first.at.clone(), |i| statements[i].span.clone());
        slips.push((first.at.start..end, first.message.clone(), help_for(text, &group, first, span)));
    }
    slips
}

fn help_for(text: &str, group: &[&Touch], first: &Touch, statement: Span) -> String {
    if let Some(Help::Unknown(help)) =
        group.iter().map(|touch| &touch.help).find(|h| matches!(h, Help::Unknown(_)))
    {
        return help.clone();
    }
    let before = match &first.help {
        Help::Says(help) if group.len() == 1 => return help.clone(),
        Help::Statement(before) => before,
        _ => "",
    };
    let start = statement.start.min(first.edit.0.start);
    let mut corrected = String::new();
    let mut at = start;
    for Touch { edit: (span, new), .. } in group.iter().copied() {
        if span.start < at {
            continue;
        }
        corrected.push_str(text.get(at..span.start).unwrap_or_default());
        corrected.push_str(new);
        at = span.end;
    }
    corrected.push_str(text.get(at..statement.end).unwrap_or_default());
    let corrected = corrected.split_whitespace().filter(|word| *word != "\\").collect::<Vec<_>>().join(" ");
    if corrected.len() > LONGEST_HELP {
        let end = corrected.floor_char_boundary(LONGEST_HELP);
        return format!("{before}write {} …", &corrected[..end]);
    }
    format!("{before}write {corrected}")
}
