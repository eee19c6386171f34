//! By which words is it said that something is hidden or locked?

use catoptra_core::scene::Flags;

/// One of the flags that any entity has.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flag {
    /// Its word.
    pub(crate) word: &'static str,
    /// Whether it is set.
    pub(crate) of: fn(&Flags) -> bool,
    /// Sets it or takes it back.
    pub(crate) set: fn(&mut Flags, bool),
}

/// All flags.
pub(crate) const FLAGS: [Flag; 2] = [
    Flag { word: "hidden", of: |flags| flags.hidden, set: |flags, on| flags.hidden = on },
    Flag { word: "locked", of: |flags| flags.locked, set: |flags, on| flags.locked = on },
];

/// The flag of that word.
pub(crate) fn named(word: &str) -> Option<Flag> {
    FLAGS.into_iter().find(|flag| flag.word == word)
}

/// The lines of the flags that are set.
pub(crate) fn lines(flags: &Flags) -> impl Iterator<Item = String> {
    FLAGS.into_iter().filter(|flag| (flag.of)(flags)).map(|flag| format!("{} #true", flag.word))
}
