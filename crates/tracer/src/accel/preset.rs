//! Presets: how much time is spent on building a mesh's tree.

/// How carefully a tree is built. All answers are the same.
///
/// Measured on one thread of a Zen 4 (building, and single rays that bounce): a building of 66,000 triangles takes 15 ms
/// `Balanced` and 215 ms `Best`, with 15 % more rays a second; a scan of 871,000 takes 267 ms and 1.3 s, with 6 % more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preset {
    /// Few bins: for meshes that change.
    Fast,
    /// As many bins as pay off within a few frames.
    #[default]
    Balanced,
    /// For meshes that are traced for long: more bins, and space is cut where triangles overlap (Stich, Friedrich and
    /// Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009), so that some stand in several leaves. At
    /// most 30 % are added so; those two meshes take 6 and 1 % more room.
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

    /// Bins along an axis for a set of `count` triangles.
    pub(super) fn bins(self, count: usize) -> usize {
        let (most, few) = match self {
            Self::Fast => (8, 4),
            Self::Balanced => (16, 4),
            Self::Best => (32, 16),
        };
        (few + count / 8).min(most)
    }

    /// How many triangles spatial splits may add to `count` triangles.
    pub(super) fn room(self, count: usize) -> usize {
        match self {
            Self::Fast | Self::Balanced => 0,
            Self::Best => count / 10 * 3,
        }
    }
}
