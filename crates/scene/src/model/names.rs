//! How do names of a file become names of a scene: text, and no two alike?

use std::collections::HashMap;

/// Longer names are cut, in characters.
const LONGEST: usize = 120;

/// Bytes as text, whatever their encoding: UTF-8, or else Latin-1. Without white space at the ends.
pub(super) fn text_of(bytes: &[u8]) -> String {
    let bytes = bytes.trim_ascii();
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// The same, cut where it is too long for a name.
pub(super) fn name_of(bytes: &[u8]) -> String {
    text_of(bytes).chars().take(LONGEST).collect()
}

/// Names that are taken.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// With the number that was last put behind each.
    taken: HashMap<String, u32>,
}

impl Names {
    /// The name, with a number behind it where it is taken.
    pub(super) fn unique(&mut self, name: &str) -> String {
        let mut number = self.taken.get(name).copied().unwrap_or(0);
        let mut unique = name.to_owned();
        while self.taken.contains_key(&unique) {
            number = number.max(1) + 1;
            unique = format!("{name} {number}");
        }
        if number > 0 {
            self.taken.insert(name.to_owned(), number);
        }
        self.taken.entry(unique.clone()).or_insert(0);
        unique
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_text_in_any_encoding() {
        assert_eq!(text_of("grün".as_bytes()), "grün");
        assert_eq!(text_of(b" gr\xfcn\r"), "grün");
        assert_eq!(name_of(&[0xfc; 1000]).chars().count(), LONGEST);
    }

    #[test]
    fn no_two_names_are_alike() {
        let mut names = Names::default();
        let given = ["a", "b", "a", "a 2", "a", "a", "b"];
        let unique: Vec<String> = given.iter().map(|name| names.unique(name)).collect();
        assert_eq!(unique, ["a", "b", "a 2", "a 2 2", "a 3", "a 4", "b 2"]);
    }
}
