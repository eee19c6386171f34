//! Why scene text is refused: what, where (file, line, column), and what to do about it.

use std::fmt;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use miette::{Diagnostic, LabeledSpan, Severity, SourceCode};

use crate::excerpt::Excerpt;
use crate::printable::{brief, printable};

/// More complaints about one text than this are counted, not told.
const MOST: usize = 50;

/// Of longer messages and hints the middle is left out, in characters.
const LONGEST: usize = 400;

/// One thing that is wrong in scene text.
#[derive(Debug, Clone)]
pub struct Complaint {
    message: String,
    help: Option<String>,
    span: Range<usize>,
    line: usize,
    column: usize,
    place: String,
    text: Arc<str>,
    excerpt: Excerpt,
}

impl Complaint {
    /// What is wrong, in one sentence.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }

    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// Line, from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        self.line
    }

    /// Column in characters, from 1.
    #[must_use]
    pub fn column(&self) -> usize {
        self.column
    }

    /// The bytes of the text that it is about.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// The line of the text that it is about, without its end.
    #[must_use]
    pub fn source_line(&self) -> &str {
        self.text.split('\n').nth(self.line - 1).unwrap_or_default().trim_end_matches('\r')
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.place, self.line, self.column, self.message)
    }
}

impl std::error::Error for Complaint {}

impl Diagnostic for Complaint {
    fn severity(&self) -> Option<Severity> {
        Some(Severity::Error)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.excerpt)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = LabeledSpan::new_with_span(Some("here".to_owned()), self.excerpt.mark());
        Some(Box::new(std::iter::once(label)))
    }
}

/// Scene text that cannot be used: every complaint about it, or why its file cannot be read.
///
/// Displays as the first complaint, `room.kdl:3:5: radius must be greater than 0, not -1`, and how many follow.
/// As a [`Diagnostic`] it shows the source lines, marks and hints of all of them.
#[derive(Debug)]
pub struct SceneTextError {
    name: String,
    complaints: Vec<Complaint>,
    untold: usize,
    /// Why the file cannot be read at all, and what to do about it; there are no complaints then.
    unreadable: Option<(String, Option<String>)>,
}

impl SceneTextError {
    pub(crate) fn unreadable(path: &Path, cause: &std::io::Error) -> Self {
        Self::unusable(path, format!("cannot be read: {cause}"))
    }

    pub(crate) fn unusable(path: &Path, message: String) -> Self {
        Self { unreadable: Some((message, None)), ..Self::named(path) }
    }

    /// The same, with a hint.
    pub(crate) fn with_help(mut self, help: String) -> Self {
        if let Some((_, hint)) = &mut self.unreadable {
            *hint = Some(help);
        }
        self
    }

    fn named(path: &Path) -> Self {
        Self { name: path.display().to_string(), complaints: Vec::new(), untold: 0, unreadable: None }
    }

    /// The file, or the name that the text was given.
    #[must_use]
    pub fn file(&self) -> &Path {
        Path::new(&self.name)
    }

    /// Line of the first complaint, from 1; `None` if the file could not be read.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        self.complaints.first().map(Complaint::line)
    }

    /// Column of the first complaint in characters, from 1; `None` if the file could not be read.
    #[must_use]
    pub fn column(&self) -> Option<usize> {
        self.complaints.first().map(Complaint::column)
    }

    /// What is wrong, in the order of the text.
    #[must_use]
    pub fn complaints(&self) -> &[Complaint] {
        &self.complaints
    }

    /// The first complaint's hint, or what to do about the file.
    #[must_use]
    pub fn hint(&self) -> Option<&str> {
        match &self.unreadable {
            Some((_, help)) => help.as_deref(),
            None => self.complaints.first().and_then(Complaint::hint),
        }
    }
}

impl fmt::Display for SceneTextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.unreadable, self.complaints.as_slice()) {
            (Some((message, _)), _) => write!(f, "{}: {message}", printable(&self.name)),
            (None, [first, rest @ ..]) => match rest.len() + self.untold {
                0 => write!(f, "{first}"),
                1 => write!(f, "{first} (and 1 more error)"),
                more => write!(f, "{first} (and {more} more errors)"),
            },
            (None, []) => write!(f, "{}: cannot be used", printable(&self.name)),
        }
    }
}

impl std::error::Error for SceneTextError {}

impl Diagnostic for SceneTextError {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new("catoptra::scene"))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.hint().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.complaints.first().and_then(Diagnostic::source_code)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.complaints.first().and_then(Diagnostic::labels)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        let rest = self.complaints.get(1..).filter(|rest| !rest.is_empty())?;
        Some(Box::new(rest.iter().map(|complaint| complaint as &dyn Diagnostic)))
    }
}

/// One complaint before its line is known.
#[derive(Debug)]
struct Found {
    span: Range<usize>,
    message: String,
    help: Option<Help>,
}

/// What to do about a complaint.
#[derive(Debug)]
enum Help {
    Says(String),
    /// The first of two stands at this byte.
    FirstAt(usize),
}

/// Collects complaints about one text.
#[derive(Debug)]
pub(crate) struct Complaints {
    found: Vec<Found>,
}

impl Complaints {
    pub(crate) fn new() -> Self {
        Self { found: Vec::new() }
    }

    /// Notes that something is wrong with `span` of the text.
    pub(crate) fn add(&mut self, span: Range<usize>, message: impl Into<String>) {
        self.found.push(Found { span, message: message.into(), help: None });
    }

    /// The same, with a hint.
    pub(crate) fn add_with(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.found.push(Found { span, message: message.into(), help: Some(Help::Says(help.into())) });
    }

    /// Notes that what stands at `span` is there already, at the byte `first`.
    pub(crate) fn add_again(&mut self, span: Range<usize>, message: impl Into<String>, first: usize) {
        self.found.push(Found { span, message: message.into(), help: Some(Help::FirstAt(first)) });
    }

    /// A hint that takes time to find; none is sought for what will not be told anyway.
    pub(crate) fn hint(&self, find: impl FnOnce() -> String) -> String {
        if self.found.len() < 20 * MOST { find() } else { String::new() }
    }

    pub(crate) fn count(&self) -> usize {
        self.found.len()
    }

    /// Takes over complaints about a changed copy of the text: `place` tells where a byte of it stands in this text,
    /// `None` if a complaint that begins there is not to be told.
    pub(crate) fn take_over(&mut self, others: Self, place: impl Fn(usize) -> Option<usize>) {
        for mut found in others.found {
            let Some(start) = place(found.span.start) else { continue };
            let end = place(found.span.end).unwrap_or(start).max(start);
            if let Some(Help::FirstAt(first)) = &mut found.help {
                *first = place(*first).unwrap_or(start);
            }
            self.found.push(Found { span: start..end, ..found });
        }
    }

    /// All of them in the order of the text, with their lines and columns.
    pub(crate) fn into_error(mut self, name: &str, text: &str) -> SceneTextError {
        self.found.sort_by_key(|found| found.span.start);
        let untold = self.found.len().saturating_sub(MOST);
        let whole: Arc<str> = text.into();
        let place = printable(name).into_owned();
        let complaints = self.found.into_iter().take(MOST).map(|found| {
            let start = floor(text, found.span.start);
            let span = start..floor(text, found.span.end.max(start));
            let (line, column) = line_and_column(text, start);
            let help = found.help.map(|help| match help {
                Help::Says(help) => brief(&help, LONGEST),
                Help::FirstAt(first) => {
                    format!("the first stands in line {}", line_and_column(text, first).0)
                }
            });
            Complaint {
                message: brief(&found.message, LONGEST),
                help,
                excerpt: Excerpt::new(&place, text, span.clone(), line, column),
                span,
                line,
                column,
                place: place.clone(),
                text: Arc::clone(&whole),
            }
        });
        SceneTextError { complaints: complaints.collect(), name: name.to_owned(), untold, unreadable: None }
    }
}

fn floor(text: &str, at: usize) -> usize {
    text.floor_char_boundary(at.min(text.len()))
}

/// Line and column (in characters), both from 1, of a byte of the text.
fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..floor(text, at)];
    let line = before.matches('\n').count() + 1;
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (line, before[start..].chars().count() + 1)
}
