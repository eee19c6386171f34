//! Pieces of text that are replaced, all at once.

use crate::build::Id;
use crate::outline::Span;

/// A piece of the text and what comes in its place.
#[derive(Debug, Clone)]
pub(crate) struct Splice {
    pub(crate) range: Span,
    pub(crate) text: String,
    /// What the nodes in the new text stand for, in their order.
    pub(crate) ids: Vec<Id>,
}

impl Splice {
    pub(crate) fn new(range: Span, text: impl Into<String>) -> Self {
        Self { range, text: text.into(), ids: Vec::new() }
    }
}

/// Takes out a property and the space before it.
pub(super) fn without_space(text: &str, property: &Span) -> Splice {
    let before = &text[..property.start];
    Splice::new(before.trim_end_matches([' ', '\t']).len()..property.end, "")
}

/// Applies splices. Answers with the new text, where each place of `kept` has gone (`None` if it was replaced), and the ids
/// of the new nodes with the places at which their text begins.
pub(crate) fn apply(
    text: &str,
    splices: Vec<Splice>,
    kept: &[usize],
) -> (String, Vec<Option<usize>>, Vec<Id>) {
    let (out, splices) = settle(text, splices);
    let moved = kept.iter().map(|&at| follow(&splices, at)).collect();
    (out, moved, splices.into_iter().flat_map(|s| s.ids).collect())
}

/// Applies splices, and answers with them in order and without overlaps. Neighbours that are taken out may both take what
/// stands between them; any other overlap would be a mistake of ours, and the earlier splice then stands.
fn settle(text: &str, mut splices: Vec<Splice>) -> (String, Vec<Splice>) {
    splices.sort_by_key(|s| (s.range.start, s.range.end));
    let mut settled: Vec<Splice> = Vec::with_capacity(splices.len());
    let mut out = String::with_capacity(text.len());
    let mut from = 0;
    for mut splice in splices {
        if splice.range.start < from {
            if splice.text.is_empty()
                && splice.range.end > from
                && let Some(last) = settled.last_mut()
            {
                from = splice.range.end;
                from += if opens(&out) { apart(&text[from..]) } else { 0 };
                last.range.end = from;
            }
            continue;
        }
        out.push_str(&text[from..splice.range.start]);
        if opens(&out) {
            splice.text.drain(..apart(&splice.text));
        }
        out.push_str(&splice.text);
        from = splice.range.end;
        settled.push(splice);
    }
    out.push_str(&text[from..]);
    (out, settled)
}

/// Whether a text ends where a block begins: what comes first in a block is set apart from nothing.
fn opens(text: &str) -> bool {
    text.trim_end_matches([' ', '\t']).ends_with('{')
}

/// How long what sets a node apart is, at the start of a text.
fn apart(text: &str) -> usize {
    let rest = text.trim_start_matches([' ', '\t']);
    rest.strip_prefix(';').map_or(0, |rest| text.len() - rest.trim_start_matches([' ', '\t']).len())
}

/// Where a place of the old text stands in the new.
fn follow(splices: &[Splice], at: usize) -> Option<usize> {
    let mut moved = at;
    for splice in splices.iter().take_while(|s| s.range.start <= at) {
        if splice.range.contains(&at) {
            // A node whose first word is replaced still begins where it began.
            return (splice.range.start == at && splice.ids.is_empty() && !splice.text.is_empty())
                .then_some(moved);
        }
        moved = moved + splice.text.len() - splice.range.len();
    }
    Some(moved)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_follow_the_text() {
        let splices = vec![Splice::new(6..8, "xyz"), Splice::new(0..1, ""), Splice::new(3..3, "--")];
        let (text, moved, _) = apply("0123456789", splices, &[0, 1, 3, 5, 7, 9]);
        assert_eq!(text, "12--345xyz89");
        let at = |c: char| text.find(c);
        assert_eq!(moved, [None, at('1'), at('3'), at('5'), None, at('9')]);
    }
}
