//! What are the things of a file called in a scene, where every name stands once?

use super::limits::LONGEST_NAME;
use crate::model::names::Names;

/// A name like that of the file that nothing else has. `kind` stands for a name that is missing.
pub(super) fn unique(names: &mut Names, name: Option<&str>, kind: &str) -> String {
    names.unique(plain(name.unwrap_or_default()).as_deref().unwrap_or(kind))
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
        let mut unique = |name: &str| unique(&mut names, Some(name), "node");
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
