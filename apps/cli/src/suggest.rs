//! Which known word did the user probably mean?

use catoptra_scene::words::nearest;
use miette::{Report, miette};

/// The error for an unknown word: names the nearest known one, or all of them.
pub(crate) fn unknown(what: &str, word: &str, known: &[&str]) -> Report {
    let help = match (nearest(word, known.iter().copied()), known) {
        (Some(near), _) => format!("did you mean `{near}`?"),
        (None, []) => format!("there is no {what} to choose from"),
        (None, _) => format!("there is: {}", known.join(", ")),
    };
    miette!(help = help, "no {what} is named `{word}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_recognised() {
        let report = unknown("backend", "orcale", &["wide", "scalar", "oracle"]);
        assert_eq!(report.help().unwrap().to_string(), "did you mean `oracle`?");
    }

    #[test]
    fn a_strange_word_lists_what_there_is() {
        let report = unknown("backend", "gpu", &["wide", "oracle"]);
        assert_eq!(report.help().unwrap().to_string(), "there is: wide, oracle");
    }
}
