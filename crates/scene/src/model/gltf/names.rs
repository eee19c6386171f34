//! What are the things of a file called in a scene, where every name stands once?

use std::collections::HashMap;

use super::limits::LONGEST_NAME;

/// The names that are taken, and how often each was asked for.
#[derive(Debug, Default)]
pub(super) struct Names {
    asked: HashMap<String, u32>,
}

impl Names {
    /// A name like that of the file that nothing else has: with a number behind it, if need be. `kind` stands for a name that
    /// is missing.
    pub(super) fn unique(&mut self, name: Option<&str>, kind: &str) -> String {
        let base = plain(name.unwrap_or_default()).unwrap_or_else(|| kind.to_owned());
        let mut number = self.asked.get(&base).copied().unwrap_or(0) + 1;
        let mut candidate = if number == 1 { base.clone() } else { format!("{base} {number}") };
        while number > 1 && self.asked.contains_key(&candidate) {
            number += 1;
            candidate = format!("{base} {number}");
        }
        self.asked.insert(base, number);
        if number > 1 {
            self.asked.insert(candidate.clone(), 1);
        }
        candidate
    }
}

/// A name without what no reader would see, and not too long; `None` where nothing is left.
fn plain(name: &str) -> Option<String> {
    let shown = |c: char| if c.is_control() { ' ' } else { c };
    let name: String = name.trim().chars().take(LONGEST_NAME).map(shown).collect();
    let name = name.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_stands_twice() {
        let mut names = Names::default();
        let mut unique = |name: &str| names.unique(Some(name), "node");
        assert_eq!(unique("car"), "car");
        assert_eq!(unique("car 2"), "car 2");
        assert_eq!(unique("car"), "car 3");
        assert_eq!(unique("car 2"), "car 2 2");
        assert_eq!(unique(" \n"), "node");
        assert_eq!(unique(""), "node 2");
        assert_eq!(unique("a\u{7}b"), "a b");
        assert_eq!(unique(&"x".repeat(1000)).len(), LONGEST_NAME);
    }
}
