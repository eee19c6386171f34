//! What has been answered: results as text and back.

use std::collections::HashMap;
use std::fmt::Write;

use super::read::lines;
use super::{Case, Question, StressError};

/// An answer that is to be scored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reply {
    /// To [`Question::Nearest`]: which primitive at which `t`.
    Nearest(Option<(u32, f64)>),
    /// To [`Question::Shadow`]: whether the light is hidden.
    Occluded(bool),
    /// To [`Question::Mirrors`] and [`Question::Glass`]: point, length and last primitive; `None` for a path that was lost.
    Path(Option<([f64; 3], f64, u32)>),
}

/// The text of a results file.
#[must_use]
pub fn results_text(replies: impl IntoIterator<Item = (u64, Reply)>) -> String {
    let mut text = String::new();
    for (id, reply) in replies {
        // Writing to a string does not fail.
        let _ = match reply {
            Reply::Nearest(None) => writeln!(text, "{id} 0"),
            Reply::Nearest(Some((primitive, t))) => writeln!(text, "{id} 1 {primitive} {t:e}"),
            Reply::Occluded(hidden) => writeln!(text, "{id} {}", u8::from(hidden)),
            Reply::Path(None) => writeln!(text, "{id}"),
            Reply::Path(Some(([x, y, z], length, primitive))) => {
                writeln!(text, "{id} {x:e} {y:e} {z:e} {length:e} {primitive}")
            }
        };
    }
    text
}

/// Reads a results file: replies by the number of their case. Numbers that no case has are left out.
///
/// # Errors
/// The first line that does not answer its case's question.
pub fn read_results(text: &str, cases: &[Case]) -> Result<HashMap<u64, Reply>, StressError> {
    let questions: HashMap<u64, Question> = cases.iter().map(|case| (case.id, case.question)).collect();
    let mut replies = HashMap::new();
    for mut words in lines(text) {
        let id = words.number("the case's number")?;
        let Some(question) = questions.get(&id) else { continue };
        let reply = match question {
            Question::Nearest { .. } => match words.number("0 or 1")? {
                0 => Reply::Nearest(None),
                1 => Reply::Nearest(Some((words.number("the primitive")?, words.number("t")?))),
                other => return Err(words.error(format!("must be 0 or 1, not {other}"))),
            },
            Question::Shadow(_) => Reply::Occluded(words.number::<u8>("0 or 1")? == 1),
            Question::Mirrors(_) | Question::Glass(..) => match words.next() {
                None => Reply::Path(None),
                Some(x) => {
                    let x = x.parse().map_err(|_| words.error(format!("x must be a number, not {x}")))?;
                    let point = [x, words.number("y")?, words.number("z")?];
                    Reply::Path(Some((point, words.number("the length")?, words.number("the primitive")?)))
                }
            },
        };
        words.end()?;
        replies.insert(id, reply);
    }
    Ok(replies)
}
