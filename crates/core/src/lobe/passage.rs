//! Light that goes straight on, as if no surface were there.

use glam::DVec3;

use super::local::{LocalLobe, LocalSample, Rays};
use crate::Rgb;

/// All light comes from straight behind the surface, as through a hole of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// Share of light that is seen, by channel.
    pub tint: Rgb,
}

impl LocalLobe for Passage {
    fn sample(&self, o: DVec3, _: f64, _: [f64; 2]) -> Option<LocalSample> {
        Some(LocalSample { direction: -o, delta: Some(self.tint), eta: 1.0 })
    }

    fn albedo(&self, _: DVec3) -> Rgb {
        self.tint
    }

    fn rays(&self, _: DVec3) -> Rays {
        Rays { straight: self.tint, ..Rays::default() }
    }

    fn ambient(&self, _: DVec3) -> Rgb {
        Rgb::BLACK
    }
}
