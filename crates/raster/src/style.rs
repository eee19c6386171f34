//! Which gizmos are shown, and how large?

use crate::manipulator::Manipulator;

/// Which gizmos are shown, and how large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverlayStyle {
    /// The ground grid at height 0.
    pub grid: bool,
    /// The axes of the world.
    pub axes: bool,
    /// Marks of lights, and the outlines of those that are surfaces.
    pub lights: bool,
    /// Cones of all spot lights. Without it selected ones show theirs while lights are shown.
    pub cones: bool,
    /// Cones are filled by a beam of light, and not lines alone.
    pub beams: bool,
    /// Bounds of what is selected.
    pub selection: bool,
    /// Frusta of the scene's cameras.
    pub cameras: bool,
    /// The handles by which things are moved, turned or scaled, if there are any.
    pub manipulator: Option<Manipulator>,
    /// Pixels in a pixel of an ordinary display: 2 doubles all widths and marks. Held to 0.25 to 16; NaN counts as 1.
    pub scale: f32,
}

impl Default for OverlayStyle {
    /// Everything that a scene has by itself, for a display of scale 1.
    fn default() -> Self {
        let all = Self::NONE;
        Self {
            grid: true,
            axes: true,
            lights: true,
            cones: true,
            beams: true,
            selection: true,
            cameras: true,
            ..all
        }
    }
}

impl OverlayStyle {
    /// Nothing at all; a start for `OverlayStyle { axes: true, ..OverlayStyle::NONE }`.
    pub const NONE: Self = Self {
        grid: false,
        axes: false,
        lights: false,
        cones: false,
        beams: false,
        selection: false,
        cameras: false,
        manipulator: None,
        scale: 1.0,
    };

    /// The scale within its range.
    pub(crate) fn scale(&self) -> f32 {
        if self.scale.is_nan() { 1.0 } else { self.scale.clamp(0.25, 16.0) }
    }
}
