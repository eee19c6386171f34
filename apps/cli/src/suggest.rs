//! Which known word did the user probably mean?

use miette::{Report, miette};

/// The error for an unknown word: names the nearest known one, or all of them.
pub(crate) fn unknown(what: &str, word: &str, known: &[&str]) -> Report {
    let help = match (nearest(word, known), known) {
        (Some(near), _) => format!("did you mean `{near}`?"),
        (None, []) => format!("there is no {what} to choose from"),
        (None, _) => format!("there is: {}", known.join(", ")),
    };
    miette!(help = help, "no {what} is named `{word}`")
}

/// The most similar word, if one is similar at all.
fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    /// Jaro-Winkler similarity from which two words look alike; measured on misspelt names of scenes and backends.
    const ALIKE: f64 = 0.8;
    let scored =
        known.iter().map(|name| (strsim::jaro_winkler(&word.to_lowercase(), &name.to_lowercase()), *name));
    let best = scored.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 >= ALIKE).then_some(best.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_recognised() {
        assert_eq!(nearest("orcale", &["wide", "scalar", "oracle"]), Some("oracle"));
        assert_eq!(nearest("Wide", &["wide", "scalar", "oracle"]), Some("wide"));
    }

    #[test]
    fn a_strange_word_lists_what_there_is() {
        let report = unknown("backend", "gpu", &["wide", "oracle"]);
        assert_eq!(report.help().unwrap().to_string(), "there is: wide, oracle");
    }
}
