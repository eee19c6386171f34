//! By what handle is an entity, a material or a texture of a scene named, for as long as the scene lives?
//!
//! A handle is a small number that the scene gives out once and never again: after a removal the number stays
//! unused, except that undoing the removal brings the same thing back under the same number.

use std::fmt;
use std::num::NonZeroU32;

/// Names one entity (a shape, a light, a camera or a group) of a [`Scene`](super::Scene).
///
/// Ordered by creation. As the number is never 0, an `Option<EntityId>` takes no more room than the id itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EntityId(NonZeroU32);

/// Names one material of a [`Scene`](super::Scene). Ordered by creation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MaterialId(NonZeroU32);

/// Names one texture of a [`Scene`](super::Scene). Ordered by creation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TextureId(NonZeroU32);

impl EntityId {
    /// The id with this number, or `None` for 0. That the number came from [`Self::index`] of the same scene is
    /// the caller's to know; a scene refuses ids it has no entity for.
    #[must_use]
    pub fn from_index(index: u32) -> Option<Self> {
        NonZeroU32::new(index).map(Self)
    }

    /// The number, from 1 up.
    #[must_use]
    pub fn index(self) -> u32 {
        self.0.get()
    }
}

impl MaterialId {
    /// The id with this number, or `None` for 0. That the number came from [`Self::index`] of the same scene is
    /// the caller's to know; a scene refuses ids it has no material for.
    #[must_use]
    pub fn from_index(index: u32) -> Option<Self> {
        NonZeroU32::new(index).map(Self)
    }

    /// The number, from 1 up.
    #[must_use]
    pub fn index(self) -> u32 {
        self.0.get()
    }
}

impl TextureId {
    /// The id with this number, or `None` for 0. That the number came from [`Self::index`] of the same scene is
    /// the caller's to know; a scene refuses ids it has no texture for.
    #[must_use]
    pub fn from_index(index: u32) -> Option<Self> {
        NonZeroU32::new(index).map(Self)
    }

    /// The number, from 1 up.
    #[must_use]
    pub fn index(self) -> u32 {
        self.0.get()
    }
}

impl fmt::Display for EntityId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "entity {}", self.0)
    }
}

impl fmt::Display for MaterialId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "material {}", self.0)
    }
}

impl fmt::Display for TextureId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "texture {}", self.0)
    }
}

/// Gives out the numbers: each once, and above every number that came in from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counter {
    next: u64,
}

impl Counter {
    pub(super) const START: Self = Self { next: 1 };

    /// The number that the next [`Self::take`] gives; the largest of all once the numbers are used up.
    pub(super) fn peek(self) -> NonZeroU32 {
        u32::try_from(self.next).ok().and_then(NonZeroU32::new).unwrap_or(NonZeroU32::MAX)
    }

    /// Whether `count` more numbers are left.
    pub(super) fn has(self, count: usize) -> bool {
        u64::try_from(count).is_ok_and(|count| count <= (u64::from(u32::MAX) + 1).saturating_sub(self.next))
    }

    /// Never gives `used` or a number below it again.
    pub(super) fn skip_past(&mut self, used: u32) {
        self.next = self.next.max(u64::from(used) + 1);
    }

    /// A new number. That one [is left](Self::has) is the caller's to know.
    pub(super) fn take(&mut self) -> NonZeroU32 {
        let number = self.peek();
        self.next += 1;
        number
    }

    pub(super) fn take_entity(&mut self) -> EntityId {
        EntityId(self.take())
    }

    pub(super) fn peek_entity(self) -> EntityId {
        EntityId(self.peek())
    }

    pub(super) fn take_material(&mut self) -> MaterialId {
        MaterialId(self.take())
    }

    pub(super) fn peek_material(self) -> MaterialId {
        MaterialId(self.peek())
    }

    pub(super) fn take_texture(&mut self) -> TextureId {
        TextureId(self.take())
    }

    pub(super) fn peek_texture(self) -> TextureId {
        TextureId(self.peek())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_optional_id_is_as_small_as_an_id() {
        assert_eq!(size_of::<Option<EntityId>>(), size_of::<u32>());
    }

    #[test]
    fn numbers_start_at_one_and_skip_what_is_in_use() {
        let mut counter = Counter::START;
        assert_eq!(counter.take_entity().index(), 1);
        counter.skip_past(7);
        assert_eq!(counter.take_entity().index(), 8);
        counter.skip_past(3);
        assert_eq!(counter.take_entity().index(), 9);
    }

    #[test]
    fn the_last_number_is_given_once() {
        let mut counter = Counter::START;
        counter.skip_past(u32::MAX - 1);
        assert!(counter.has(1) && !counter.has(2));
        assert_eq!(counter.take_material().index(), u32::MAX);
        assert!(counter.has(0) && !counter.has(1));
    }
}
