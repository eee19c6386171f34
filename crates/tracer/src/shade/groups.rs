//! The lanes of a packet, grouped by material.

use fearless_simd::Simd;

use crate::lanes::{M, MOST_LANES};

/// The lanes of a packet by the material at their hits: read and written in memory, element by element.
pub(crate) struct Groups {
    count: usize,
    lanes: [u64; MOST_LANES],
    materials: [u32; MOST_LANES],
}

impl Groups {
    /// No lanes.
    pub(crate) const NONE: Self = Self { count: 0, lanes: [0; MOST_LANES], materials: [0; MOST_LANES] };

    /// Removes all lanes.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }

    /// Adds lanes whose surfaces have a material.
    #[inline(always)]
    pub(crate) fn add(&mut self, lanes: u64, material: u32) {
        for group in 0..self.count {
            if self.materials[group] == material {
                self.lanes[group] |= lanes;
                return;
            }
        }
        (self.lanes[self.count], self.materials[self.count]) = (lanes, material);
        self.count += 1;
    }

    /// How many materials there are.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Lanes and material of a group.
    #[inline(always)]
    pub(crate) fn get<S: Simd>(&self, s: S, group: usize) -> (M<S>, usize) {
        (M::from_bits(s, self.lanes[group]), self.materials[group] as usize)
    }
}
