//! What follows from the rest of a value, made when first asked for.

use std::sync::OnceLock;

/// Such a thing. Values are the same whether it was asked for yet or not.
#[derive(Debug, Clone)]
pub(super) struct Derived<T>(OnceLock<T>);

impl<T> Default for Derived<T> {
    fn default() -> Self {
        Self(OnceLock::new())
    }
}

impl<T> PartialEq for Derived<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T> Derived<T> {
    /// It, made by `make` the first time.
    pub(super) fn get_or_make(&self, make: impl FnOnce() -> T) -> &T {
        self.0.get_or_init(make)
    }
}
