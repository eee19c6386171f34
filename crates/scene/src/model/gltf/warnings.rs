//! What is passed over, each kind of thing once.

use std::cell::RefCell;
use std::collections::HashSet;

use crate::model::{Place, Warning};

/// More are not kept: one file may lack thousands of pictures.
const MOST: usize = 100;

/// The warnings of one file.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    known: RefCell<(HashSet<String>, Vec<Warning>)>,
}

impl Warnings {
    /// Notes that something is passed over, unless the same has been said.
    pub(super) fn add(&self, message: impl Into<String>) {
        let message = message.into();
        let mut known = self.known.borrow_mut();
        if known.1.len() < MOST && !known.0.contains(&message) {
            known.0.insert(message.clone());
            known.1.push(Warning { place: Place::File, message });
        }
    }

    /// All of them, in the order in which they came.
    pub(super) fn into_list(self) -> Vec<Warning> {
        self.known.into_inner().1
    }
}
