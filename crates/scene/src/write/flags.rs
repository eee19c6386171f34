//! How a node says whether something is hidden or locked, when that has changed.

use catoptra_core::scene::Flags;

use super::layout;
use super::splice::{Splice, without_space};
use crate::flags::FLAGS;
use crate::outline::Item;

/// Takes out the flags that are no longer so; answers with the lines of those that are new.
pub(super) fn edit(text: &str, item: &Item, now: &Flags, splices: &mut Vec<Splice>) -> Vec<String> {
    let mut lines = Vec::new();
    for flag in FLAGS.iter().filter(|flag| (flag.of)(now) != (flag.of)(&item.flags)) {
        let on = (flag.of)(now);
        match item.flag_texts.iter().find(|written| written.word == flag.word) {
            Some(written) if on => {
                let equals = if written.property { "=" } else { " " };
                splices.push(Splice::new(written.span.clone(), format!("{}{equals}#true", flag.word)));
            }
            Some(written) if written.property => splices.push(without_space(text, &written.span)),
            Some(written) => splices.push(Splice::new(layout::taken_out(text, &written.span), "")),
            None => lines.push(format!("{} #true", flag.word)),
        }
    }
    lines
}
