//! What of a file is not shown as the file means it: each kind of thing once, and not without end.

use std::cell::RefCell;

use super::{Place, Warning};

/// So many kinds of things are named; of what follows only the number is told.
const MOST: usize = 30;

/// Warnings while a file is read. Whoever reads it adds to them, so they change behind shared references.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    told: RefCell<Told>,
}

#[derive(Debug, Default)]
struct Told {
    list: Vec<Warning>,
    /// Where the first stands that is not named, and how many there are.
    unnamed: Option<(Place, usize)>,
}

impl Warnings {
    /// Adds a warning, unless there is one of the same words.
    pub(super) fn add(&self, place: Place, message: impl Into<String>) {
        let message = message.into();
        let mut told = self.told.borrow_mut();
        if told.list.iter().any(|warning| warning.message == message) {
            return;
        }
        if told.list.len() < MOST {
            told.list.push(Warning { place, message });
        } else {
            told.unnamed.get_or_insert((place, 0)).1 += 1;
        }
    }

    /// Adds a warning about the file as a whole.
    pub(super) fn add_of_file(&self, message: impl Into<String>) {
        self.add(Place::File, message);
    }

    /// Adds others behind these.
    pub(super) fn append(&self, others: Self) {
        for warning in others.into_list() {
            self.add(warning.place, warning.message);
        }
    }

    /// All of them, in the order in which they came.
    pub(super) fn into_list(self) -> Vec<Warning> {
        let mut told = self.told.into_inner();
        if let Some((place, count)) = told.unnamed {
            told.list.push(Warning { place, message: format!("{count} more things are passed over") });
        }
        told.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_thing_is_named_once_and_not_without_end() {
        let warnings = Warnings::default();
        for line in 1..=100 {
            warnings.add(Place::Line(line), format!("\"{}\" is passed over", line / 2));
        }
        let list = warnings.into_list();
        assert_eq!(list[1], Warning { place: Place::Line(2), message: "\"1\" is passed over".into() });
        assert_eq!(list.len(), MOST + 1);
        // 51 kinds, 21 of them unnamed, each but the first and the last met twice.
        let last = Warning { place: Place::Line(60), message: "41 more things are passed over".into() };
        assert_eq!(list[MOST], last);
    }
}
