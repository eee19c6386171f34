//! How does a line look?

use crate::tint::Tint;

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ink {
    pub(crate) tint: Tint,
    /// 0 to 1.
    pub(crate) opacity: f32,
    /// In pixels of a display of scale 1.
    pub(crate) width: f32,
    /// Opacity of the dark casing relative to the line's own; 0 for none.
    pub(crate) casing: f32,
}

impl Ink {
    /// A cased line of 1.8 pixels that is dashed where it is hidden.
    pub(crate) fn new(tint: Tint) -> Self {
        Self { tint, opacity: 1.0, width: 1.8, casing: 0.5 }
    }

    pub(crate) fn with_width(self, width: f32) -> Self {
        Self { width, ..self }
    }

    pub(crate) fn with_opacity(self, opacity: f32) -> Self {
        Self { opacity, ..self }
    }
}

/// Width of a casing beyond its line on either side, in pixels.
pub(crate) const CASING: f32 = 0.85;
