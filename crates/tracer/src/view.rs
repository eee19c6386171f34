//! What is asked for: camera, size, and how far to go.

use catoptra_core::{Camera, Scene};

use crate::numeric::WEIGHT_CUTOFF;

/// Picture size in pixels; either may be zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
pub struct Size {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Size {
    /// `width` x `height` pixels.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// How many pixels.
    #[must_use]
    pub const fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// One picture that is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// How large.
    pub size: Size,
    /// How many reflections after one another, at most.
    pub max_depth: u32,
    /// Rays that could add no more than this share of what they meet are not traced; 0 traces them all.
    pub weight_cutoff: f32,
    /// Samples per pixel along each axis: 1 is the pixel's centre, n is an n x n grid.
    pub grid: u32,
    /// Which work that cannot matter is left out; the picture's bits do not depend on it.
    pub skip: Skip,
}

/// Work that is left out because it cannot matter. Switched off, the same bits are computed the long way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Skip {
    /// Shapes that no camera ray of a tile can see first are not tested for it.
    pub hidden: bool,
    /// Shapes that cannot stand between what a tile shows and a light are not tested for its shadows.
    pub shafts: bool,
}

impl Skip {
    /// Everything that can be left out is.
    pub const ALL: Self = Self { hidden: true, shafts: true };
    /// Nothing is left out.
    pub const NOTHING: Self = Self { hidden: false, shafts: false };
}

impl View {
    /// Through a pixel's centre, five reflections deep.
    #[must_use]
    pub const fn new(camera: Camera, size: Size) -> Self {
        Self { camera, size, max_depth: 5, weight_cutoff: WEIGHT_CUTOFF, grid: 1, skip: Skip::ALL }
    }

    /// As deep as the scene's settings say, from the given camera.
    #[must_use]
    pub fn of(scene: &Scene, camera: Camera, size: Size) -> Self {
        Self { max_depth: scene.settings().max_depth(), ..Self::new(camera, size) }
    }

    /// With at least `samples` samples a pixel, on a square grid.
    #[must_use]
    pub fn with_samples(self, samples: u32) -> Self {
        let grid = f64::from(samples).sqrt().ceil() as u32;
        Self { grid: grid.max(1), ..self }
    }

    /// Samples a pixel.
    #[must_use]
    pub const fn samples(&self) -> u32 {
        self.grid.saturating_mul(self.grid)
    }
}
