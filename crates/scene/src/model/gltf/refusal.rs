//! Why is a glTF file refused, and in which part of it? The part is spelled as a path: `meshes[3].primitives[0].indices`.

use std::fmt::Display;

use catoptra_core::InvalidPart;

use crate::model::error::{Fault, Place};

/// A refusal that gets its path from the inside outwards.
#[derive(Debug)]
pub(super) struct Refusal {
    path: String,
    message: String,
}

impl Refusal {
    pub(super) fn new(message: impl Display) -> Self {
        Self { path: String::new(), message: message.to_string() }
    }

    /// Of a part that the refused one stands in.
    fn within(mut self, outer: &str) -> Self {
        if !self.path.is_empty() {
            self.path.insert(0, '.');
        }
        self.path.insert_str(0, outer);
        self
    }

    /// What is said of it: the path and the message.
    pub(super) fn text(&self) -> String {
        if self.path.is_empty() { self.message.clone() } else { format!("{}: {}", self.path, self.message) }
    }
}

impl From<Refusal> for Fault {
    fn from(refusal: Refusal) -> Self {
        Self::new(Place::File, refusal.text())
    }
}

/// Names the part of the file that something went wrong in.
pub(super) trait Within<T> {
    /// `part` is asked only where something did.
    fn within(self, part: impl FnOnce() -> String) -> Result<T, Refusal>;

    /// The path so far becomes a part of the message: what follows is the path of what refers to there.
    fn referred(self) -> Result<T, Refusal>;
}

impl<T> Within<T> for Result<T, Refusal> {
    fn within(self, part: impl FnOnce() -> String) -> Self {
        self.map_err(|refusal| refusal.within(&part()))
    }

    fn referred(self) -> Self {
        self.map_err(|refusal| Refusal::new(refusal.text()))
    }
}

impl From<InvalidPart> for Refusal {
    fn from(invalid: InvalidPart) -> Self {
        Self::new(invalid)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_grows_outwards() {
        let refused: Result<(), _> = Err(Refusal::new("is missing"));
        let refused =
            refused.within(|| "indices".to_owned()).within(|| "primitives[2]".to_owned()).unwrap_err();
        assert_eq!(refused.text(), "primitives[2].indices: is missing");
        let referred = Err::<(), _>(refused).referred().within(|| "nodes[1]".to_owned()).unwrap_err();
        assert_eq!(referred.text(), "nodes[1]: primitives[2].indices: is missing");
    }
}
