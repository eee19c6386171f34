//! How much time is spent on a mesh's tree.

/// How carefully a tree is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preset {
    /// Few bins: for meshes that change.
    Fast,
    /// As many bins as pay off within a few frames.
    #[default]
    Balanced,
    /// For meshes that are traced for long.
    Best,
}

impl Preset {
    /// Every preset, the quickest to build first.
    pub const ALL: &[Self] = &[Self::Fast, Self::Balanced, Self::Best];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Balanced => "balanced",
            Self::Best => "best",
        }
    }

    /// The preset of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|preset| preset.name() == name)
    }

    /// Bins along an axis for a set of so many triangles.
    pub(super) fn bins(self, count: usize) -> usize {
        let (most, few) = match self {
            Self::Fast => (8, 4),
            Self::Balanced => (16, 4),
            Self::Best => (32, 16),
        };
        (few + count / 8).min(most)
    }
}
