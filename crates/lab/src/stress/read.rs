//! How case files and answer files are read.

use std::collections::HashMap;
use std::str::FromStr;

use super::{Acceptable, Case, Cases, Duty, Expected, Primitive, Question, Stage};

/// What is wrong with a file, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct StressError {
    /// Line, counted from 1.
    pub line: usize,
    /// What was expected and what was found.
    pub message: String,
}

/// The words of a line, taken one by one.
pub(super) struct Words<'a> {
    line: usize,
    words: std::str::SplitWhitespace<'a>,
}

impl<'a> Words<'a> {
    pub(super) fn error(&self, message: impl Into<String>) -> StressError {
        StressError { line: self.line, message: message.into() }
    }

    pub(super) fn word(&mut self, what: &str) -> Result<&'a str, StressError> {
        self.words.next().ok_or_else(|| self.error(format!("{what} is missing")))
    }

    pub(super) fn next(&mut self) -> Option<&'a str> {
        self.words.next()
    }

    pub(super) fn number<T: FromStr>(&mut self, what: &str) -> Result<T, StressError> {
        let word = self.word(what)?;
        word.parse().map_err(|_| self.error(format!("{what} must be a number, not {word}")))
    }

    fn bits(&mut self, what: &str) -> Result<f32, StressError> {
        let word = self.word(what)?;
        let bits = u32::from_str_radix(word, 16).ok().filter(|_| word.len() == 8);
        bits.map(f32::from_bits)
            .ok_or_else(|| self.error(format!("{what} must be eight hex digits, not {word}")))
    }

    fn point(&mut self, what: &str) -> Result<[f32; 3], StressError> {
        Ok([self.bits(what)?, self.bits(what)?, self.bits(what)?])
    }

    pub(super) fn end(&mut self) -> Result<(), StressError> {
        match self.next() {
            None => Ok(()),
            Some(word) => Err(self.error(format!("nothing more is expected before {word}"))),
        }
    }
}

/// The lines of a text that hold anything, with their words.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Words<'_>> {
    let lines = text.lines().zip(1..).filter(|(text, _)| !text.trim().is_empty());
    lines.map(|(text, line)| Words { line, words: text.split_whitespace() })
}

/// Reads a case file.
///
/// # Errors
/// The first line that is not as the format says.
pub fn read_cases(text: &str) -> Result<Cases, StressError> {
    let mut lines = lines(text);
    expect_head(lines.next(), "STRESS")?;
    let mut cases = Cases::default();
    let mut stages = HashMap::new();
    for mut words in lines {
        match words.word("a record")? {
            "S" => {
                stages.insert(words.number::<u64>("the scene's number")?, cases.stages.len());
                cases.stages.push(read_stage(&mut words)?);
            }
            kind @ ("R" | "W" | "C" | "G") => {
                let case = read_case(kind, &mut words, &stages)?;
                cases.cases.push(case);
            }
            kind => {
                let primitive = read_primitive(kind, &mut words)?;
                let missing = words.error("a primitive belongs to a scene: S is missing");
                cases.stages.last_mut().ok_or(missing)?.primitives.push(primitive);
            }
        }
        words.end()?;
    }
    Ok(cases)
}

fn expect_head(head: Option<Words<'_>>, name: &str) -> Result<(), StressError> {
    let missing = StressError { line: 1, message: format!("must begin with {name} 1") };
    let mut words = head.ok_or_else(|| missing.clone())?;
    if (words.next(), words.next()) == (Some(name), Some("1")) { words.end() } else { Err(missing) }
}

fn read_stage(words: &mut Words<'_>) -> Result<Stage, StressError> {
    words.number::<usize>("how many primitives there are")?;
    match words.word("closed or open")? {
        "closed" => Ok(Stage { closed: true, ..Stage::default() }),
        "open" => Ok(Stage::default()),
        word => Err(words.error(format!("must be closed or open, not {word}"))),
    }
}

fn read_primitive(kind: &str, words: &mut Words<'_>) -> Result<Primitive, StressError> {
    Ok(match kind {
        "T" => Primitive::Triangle([
            words.point("a corner")?,
            words.point("a corner")?,
            words.point("a corner")?,
        ]),
        "O" => Primitive::Sphere(words.point("the centre")?, words.bits("the radius")?),
        "P" => Primitive::Plane(words.point("a point")?, words.point("the normal")?),
        "B" => Primitive::Volume(words.point("the low corner")?, words.point("the high corner")?),
        "X" => Primitive::Box(words.point("the low corner")?, words.point("the high corner")?),
        word => return Err(words.error(format!("no record is named {word}"))),
    })
}

fn read_case(kind: &str, words: &mut Words<'_>, stages: &HashMap<u64, usize>) -> Result<Case, StressError> {
    let (id, group) = (words.number("the case's number")?, words.word("the group")?.to_owned());
    let stage: u64 = words.number("the scene's number")?;
    let stage =
        *stages.get(&stage).ok_or_else(|| words.error(format!("there is no scene {stage} before")))?;
    let (origin, direction) = (words.point("the origin")?, words.point("the direction")?);
    let question = match kind {
        "R" => Question::Nearest { min: words.bits("tmin")?, max: words.bits("tmax")? },
        "W" => Question::Shadow(words.point("the light")?),
        "C" => Question::Mirrors(words.number("how many mirrors")?),
        _ => Question::Glass(words.number("how many surfaces")?, words.bits("the index of refraction")?),
    };
    Ok(Case { id, group, stage, origin, direction, question })
}

/// Reads an answer file: the right answer by the number of the case.
///
/// # Errors
/// The first line that is not as the format says.
pub fn read_answers(text: &str) -> Result<HashMap<u64, Expected>, StressError> {
    let mut lines = lines(text);
    expect_head(lines.next(), "STRESS-ANSWERS")?;
    let mut answers = HashMap::new();
    for mut words in lines {
        if words.word("a record")? != "A" {
            return Err(words.error("an answer begins with A"));
        }
        let id = words.number("the case's number")?;
        words.word("the group")?;
        let answer = match words.word("R, W or C")? {
            "R" => read_nearest(&mut words)?,
            "W" => Expected::Occluded(words.word("V or O")? == "O"),
            "C" | "G" => Expected::Path {
                primitive: words.number("the primitive")?,
                point: [words.number("the point")?, words.number("the point")?, words.number("the point")?],
                length: words.number("the length")?,
                amplification: words.number("the conditioning")?,
            },
            word => return Err(words.error(format!("must be R, W or C, not {word}"))),
        };
        answers.insert(id, answer);
    }
    Ok(answers)
}

fn read_nearest(words: &mut Words<'_>) -> Result<Expected, StressError> {
    let duty = match words.word("H, M or E")? {
        "H" => Duty::Hit,
        "M" => Duty::Miss,
        "E" => Duty::Either,
        word => return Err(words.error(format!("must be H, M or E, not {word}"))),
    };
    let pairs = match words.word("the acceptable hits")? {
        "-" => Vec::new(),
        list => list.split(',').map(|pair| read_pair(pair, words)).collect::<Result<_, _>>()?,
    };
    Ok(Expected::Nearest(duty, pairs))
}

fn read_pair(pair: &str, words: &Words<'_>) -> Result<Acceptable, StressError> {
    let wrong = || words.error(format!("must be primitive:t, not {pair}"));
    let (primitive, t) = pair.split_once(':').ok_or_else(wrong)?;
    let primitive = match primitive {
        "-2" => None,
        number => Some(number.parse().map_err(|_| wrong())?),
    };
    Ok((primitive, if t == "any" { None } else { Some(t.parse().map_err(|_| wrong())?) }))
}
