//! What differs between two texts? Their lines, as far as they are not the same, with one line of what stands around.

use std::time::Duration;

use similar::{ChangeTag, TextDiff};

/// The most lines that are told.
const MOST_LINES: usize = 200;

/// The most characters of a line.
const MOST_CHARACTERS: usize = 160;

/// Lines of what is the same around what is not.
const AROUND: usize = 1;

/// The time after which a less telling difference will do.
const DEADLINE: Duration = Duration::from_millis(200);

/// Where a line stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// In both texts.
    Both,
    /// In the old one alone.
    Old,
    /// In the new one alone.
    New,
}

/// A line of either text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Line {
    pub(crate) side: Side,
    pub(crate) text: String,
}

/// The lines that differ.
pub(crate) fn between(old: &str, new: &str) -> Vec<Line> {
    let diff = TextDiff::configure().timeout(DEADLINE).diff_lines(old, new);
    let groups = diff.grouped_ops(AROUND);
    let changes = groups.iter().flatten().flat_map(|op| diff.iter_changes(op));
    let lines = changes.map(|change| Line {
        side: match change.tag() {
            ChangeTag::Equal => Side::Both,
            ChangeTag::Delete => Side::Old,
            ChangeTag::Insert => Side::New,
        },
        text: change.value().trim_end().chars().take(MOST_CHARACTERS).collect(),
    });
    lines.take(MOST_LINES).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_differs_is_told_and_its_neighbours() {
        let told = between("a\nb\nc\nd\ne\n", "a\nb\nC\nd\ne\n");
        let told: Vec<(Side, &str)> = told.iter().map(|line| (line.side, line.text.as_str())).collect();
        assert_eq!(told, [(Side::Both, "b"), (Side::Old, "c"), (Side::New, "C"), (Side::Both, "d")]);
        assert!(between("a\n", "a\n").is_empty());
    }

    #[test]
    fn long_texts_are_cut() {
        let old: String = (0..1000).map(|i| format!("{i}\n")).collect();
        assert_eq!(between(&old, "").len(), MOST_LINES);
        assert_eq!(between("", &"x".repeat(1000))[0].text.len(), MOST_CHARACTERS);
    }
}
