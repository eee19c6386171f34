//! Which points does a file name, and what is printed for them?

use std::fmt::Write;
use std::io::Read;
use std::path::Path;

use catoptra_core::Rgb;
use catoptra_core::glam::DVec3;
use catoptra_scene::printable;
use catoptra_tracer::{InvalidReceiver, Irradiance, Receiver};
use miette::{Report, Result, miette};
use serde_json::{Value, json};

use super::numbers::in_full;
use crate::args::STANDARD;

/// A file of points, line by line.
pub(super) struct Points {
    lines: Vec<Line>,
}

enum Line {
    /// Blank, or a remark: printed as it stands.
    Text(String),
    Point(Receiver),
}

/// What is wrong in a line, and from which byte on.
struct Fault {
    at: usize,
    message: String,
}

const HELP: &str = "a line is six numbers with spaces between: a point and a normal, x y z nx ny nz";

/// Reads a file, or standard input.
pub(super) fn read(path: &Path) -> Result<Points> {
    let (mut bytes, name) = (Vec::new(), place(path));
    let read = if path == Path::new(STANDARD) {
        std::io::stdin().lock().read_to_end(&mut bytes)
    } else {
        std::fs::File::open(path).and_then(|mut file| file.read_to_end(&mut bytes))
    };
    read.map_err(|error| miette!("{name} cannot be read: {error}"))?;
    parse(&bytes, &name)
}

fn place(path: &Path) -> String {
    if path == Path::new(STANDARD) { "<stdin>".to_owned() } else { path.display().to_string() }
}

fn parse(bytes: &[u8], name: &str) -> Result<Points> {
    let bytes = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes);
    let bytes = bytes.strip_suffix(b"\n").unwrap_or(bytes);
    let mut lines = Vec::new();
    if bytes.is_empty() {
        return Ok(Points { lines });
    }
    for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let told = |column: usize, message: &str| -> Report {
            miette!(help = HELP, "{name}:{}:{column}: {}", number + 1, printable(message))
        };
        let text = str::from_utf8(line).map_err(|error| told(error.valid_up_to() + 1, "this is no text"))?;
        let read = line_of(text.trim_end_matches('\r'));
        lines.push(read.map_err(|fault| told(text[..fault.at].chars().count() + 1, &fault.message))?);
    }
    Ok(Points { lines })
}

fn line_of(text: &str) -> Result<Line, Fault> {
    if text.trim().is_empty() || text.trim_start().starts_with('#') {
        return Ok(Line::Text(text.to_owned()));
    }
    let words: Vec<(usize, &str)> =
        text.split_whitespace().map(|word| (word.as_ptr() as usize - text.as_ptr() as usize, word)).collect();
    let mut numbers = [0.0; 6];
    for (i, (at, word)) in words.iter().enumerate() {
        let fault = |message: String| Fault { at: *at, message };
        let number = word.parse::<f64>().map_err(|_| fault(format!("`{word}` is no number")))?;
        if !number.is_finite() {
            return Err(fault(format!("`{word}` is not finite")));
        }
        match numbers.get_mut(i) {
            Some(place) => *place = number,
            None => return Err(fault(format!("six numbers are a line, and this one has {}", words.len()))),
        }
    }
    let [x, y, z, nx, ny, nz] = numbers;
    if words.len() < 6 {
        let message = format!("six numbers are a line, and this one has {}", words.len());
        return Err(Fault { at: text.trim_end().len(), message });
    }
    let receiver = Receiver::new(DVec3::new(x, y, z), DVec3::new(nx, ny, nz));
    receiver.map(Line::Point).map_err(|error| {
        let word = if error == InvalidReceiver::NoNormal { 3 } else { 0 };
        Fault { at: words[word].0, message: error.to_string() }
    })
}

impl Points {
    /// All points, in order.
    pub(super) fn receivers(&self) -> Vec<Receiver> {
        let points = self.lines.iter().filter_map(|line| match line {
            Line::Point(receiver) => Some(*receiver),
            Line::Text(_) => None,
        });
        points.collect()
    }

    /// A line for each line: irradiance and its standard error.
    pub(super) fn as_text(&self, found: &[Irradiance]) -> String {
        let (mut text, mut found) = (String::new(), found.iter());
        for line in &self.lines {
            let _ = match line {
                Line::Text(line) => writeln!(text, "{line}"),
                Line::Point(_) => {
                    let numbers = found.next().map(|found| [found.mean, found.error].map(Rgb::to_array));
                    let words: Vec<String> =
                        numbers.iter().flatten().flatten().map(|v| in_full(*v)).collect();
                    writeln!(text, "{}", words.join(" "))
                }
            };
        }
        text
    }
}

/// Points with what was found there.
pub(super) fn as_json(scene: &str, receivers: &[Receiver], found: &[Irradiance]) -> Value {
    let points: Vec<Value> = receivers
        .iter()
        .zip(found)
        .map(|(receiver, found)| {
            json!({
                "point": receiver.point().to_array(),
                "normal": receiver.normal().to_array(),
                "irradiance": found.mean.to_array(),
                "error": found.error.to_array(),
            })
        })
        .collect();
    json!({ "scene": scene, "points": points })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        parse(text.as_bytes(), "p").err().map_or_else(String::new, |error| error.to_string())
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let cases = [
            ("1 2 3 0 1 0\n\n1 2 x 0 1 0", "p:3:5: `x` is no number"),
            ("1 2 3 0 1", "p:1:10: six numbers are a line, and this one has 5"),
            ("1 2 3 0 1 0 7", "p:1:13: six numbers are a line, and this one has 7"),
            ("# é\n 1 2 3 0 -0 0", "p:2:8: the normal must not be zero"),
            ("1 NaN 3 0 1 0", "p:1:3: `NaN` is not finite"),
            ("1 2 1e999 0 1 0", "p:1:5: `1e999` is not finite"),
            ("1, 2, 3, 0, 1, 0", "p:1:1: `1,` is no number"),
        ];
        for (text, words) in cases {
            assert_eq!(fault(text), words, "{text}");
        }
        assert!(parse(b"1 2 3 0 1 0\n\xff", "p").is_err());
    }

    #[test]
    fn blank_lines_and_remarks_stay_where_they_are() {
        let read = parse("\u{feff}# a\r\n\n\t1 2\t3 0 9 0 \n #b\n".as_bytes(), "p").ok().unwrap();
        assert_eq!(read.receivers(), [Receiver::new(DVec3::new(1.0, 2.0, 3.0), DVec3::Y).unwrap()]);
        let grey = catoptra_core::Rgb::grey;
        let found = Irradiance { mean: grey(0.5), error: grey(0.0) };
        assert_eq!(read.as_text(&[found]), "# a\n\n0.5 0.5 0.5 0 0 0\n #b\n");
        assert_eq!(parse(b"", "p").ok().unwrap().as_text(&[]), "");
    }
}
