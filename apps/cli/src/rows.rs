//! Which rows of numbers does a file hold, and where in it is what is wrong? Blank lines and remarks pass through to the answer.

use std::fmt::Write;
use std::io::Read;
use std::path::Path;

use catoptra_scene::printable;
use miette::{Report, Result, miette};

use crate::args::STANDARD;

/// What numbers stand for; else which of them is wrong, and what about it.
pub(crate) type Made<T> = Result<T, (usize, String)>;

/// How a row is written, and what it stands for.
pub(crate) struct Form<T> {
    /// Numbers in a row: the fewest and the most.
    pub(crate) numbers: [usize; 2],
    /// From which number on they may be infinite.
    pub(crate) finite: usize,
    /// How many they are, in words.
    pub(crate) says: &'static str,
    /// What they are, in words.
    pub(crate) help: &'static str,
    /// What they stand for.
    pub(crate) make: fn(&[f64]) -> Made<T>,
}

/// A file of rows, line by line.
pub(crate) struct Rows<T> {
    lines: Vec<Line<T>>,
}

enum Line<T> {
    /// Blank, or a remark: printed as it stands.
    Text(String),
    Row(T),
}

/// What is wrong in a line, and from which byte on.
struct Fault {
    at: usize,
    message: String,
}

impl<T> Rows<T> {
    /// Reads a file, or standard input.
    pub(crate) fn read(path: &Path, form: &Form<T>) -> Result<Self> {
        let (mut bytes, is_standard) = (Vec::new(), path == Path::new(STANDARD));
        let name = if is_standard { "<stdin>".to_owned() } else { path.display().to_string() };
        let read = if is_standard {
            std::io::stdin().lock().read_to_end(&mut bytes)
        } else {
            std::fs::File::open(path).and_then(|mut file| file.read_to_end(&mut bytes))
        };
        read.map_err(|error| miette!("{name} cannot be read: {error}"))?;
        Self::parse(&bytes, &name, form)
    }

    /// Reads the bytes of a file that `name` stands for in messages.
    pub(crate) fn parse(bytes: &[u8], name: &str, form: &Form<T>) -> Result<Self> {
        let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
        let bytes = bytes.strip_suffix(b"\n").unwrap_or(bytes);
        let mut lines = Vec::new();
        if bytes.is_empty() {
            return Ok(Self { lines });
        }
        for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
            let told = |column: usize, message: &str| -> Report {
                miette!(help = form.help, "{name}:{}:{column}: {}", number + 1, printable(message))
            };
            let text =
                str::from_utf8(line).map_err(|error| told(error.valid_up_to() + 1, "this is no text"))?;
            let read = line_of(text.trim_end_matches('\r'), form);
            lines.push(read.map_err(|fault| told(text[..fault.at].chars().count() + 1, &fault.message))?);
        }
        Ok(Self { lines })
    }

    /// All rows, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &T> {
        self.lines.iter().filter_map(|line| match line {
            Line::Row(row) => Some(row),
            Line::Text(_) => None,
        })
    }

    /// The text in which the next of these answers stands for each row.
    pub(crate) fn answered(&self, answers: impl IntoIterator<Item = String>) -> String {
        let (mut text, mut answers) = (String::new(), answers.into_iter());
        for line in &self.lines {
            let _ = match line {
                Line::Text(line) => writeln!(text, "{line}"),
                Line::Row(_) => writeln!(text, "{}", answers.next().unwrap_or_default()),
            };
        }
        text
    }
}

fn line_of<T>(text: &str, form: &Form<T>) -> Result<Line<T>, Fault> {
    if text.trim().is_empty() || text.trim_start().starts_with('#') {
        return Ok(Line::Text(text.to_owned()));
    }
    let [fewest, most] = form.numbers;
    let words: Vec<(usize, &str)> =
        text.split_whitespace().map(|word| (word.as_ptr() as usize - text.as_ptr() as usize, word)).collect();
    let count =
        |at| Fault { at, message: format!("{} are a line, and this one has {}", form.says, words.len()) };
    let mut numbers = Vec::with_capacity(most);
    for (i, (at, word)) in words.iter().enumerate() {
        let fault = |message: String| Fault { at: *at, message };
        let number = word.parse::<f64>().map_err(|_| fault(format!("`{word}` is no number")))?;
        if number.is_nan() || (i < form.finite && number.is_infinite()) {
            return Err(fault(format!("`{word}` is not finite")));
        }
        if i >= most {
            return Err(count(*at));
        }
        numbers.push(number);
    }
    if words.len() < fewest {
        return Err(count(text.trim_end().len()));
    }
    let made = (form.make)(&numbers);
    made.map(Line::Row).map_err(|(which, message)| Fault { at: words[which].0, message })
}
