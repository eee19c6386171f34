//! Which overlays are drawn over a traced picture, and what of them stands under the pointer?

use crate::canvas::Canvas;
use crate::depth::DepthField;
use crate::gizmo::GIZMOS;
use crate::grip::{self, RingGrip};
use crate::layer::Layer;
use crate::projection::Projection;
use crate::sight::Sight;
use crate::stage::Stage;
use catoptra_core::Camera;
use catoptra_core::scene::{EntityId, Scene};

/// Which gizmos are shown, and how large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverlayStyle {
    /// The ground grid at height 0.
    pub grid: bool,
    /// The axes of the world.
    pub axes: bool,
    /// Marks of point, spot and directional lights.
    pub lights: bool,
    /// Cones of spot lights.
    pub cones: bool,
    /// Bounds of what is selected.
    pub selection: bool,
    /// Frusta of the scene's cameras.
    pub cameras: bool,
    /// Pixels in a pixel of an ordinary display: 2 doubles all widths and marks. Held to 0.25 to 16; NaN counts as 1.
    pub scale: f32,
}

impl Default for OverlayStyle {
    /// Everything, for a display of scale 1.
    fn default() -> Self {
        Self { grid: true, axes: true, lights: true, cones: true, selection: true, cameras: true, scale: 1.0 }
    }
}

impl OverlayStyle {
    /// Nothing at all; a start for `OverlayStyle { axes: true, ..OverlayStyle::NONE }`.
    pub const NONE: Self = Self {
        grid: false,
        axes: false,
        lights: false,
        cones: false,
        selection: false,
        cameras: false,
        scale: 1.0,
    };

    /// The scale within its range.
    pub(crate) fn scale(&self) -> f32 {
        if self.scale.is_nan() { 1.0 } else { self.scale.clamp(0.25, 16.0) }
    }
}

/// All that is drawn over one traced picture; what it shows can be clicked and dragged where it shows it.
#[derive(Debug, Clone, Copy)]
pub struct Overlay<'a> {
    /// The scene the gizmos speak of.
    pub scene: &'a Scene,
    /// The camera the picture is seen from; it need not be one of the scene's.
    pub camera: &'a Camera,
    /// Width of the picture in pixels; may be zero.
    pub width: u32,
    /// Height of the picture in pixels; may be zero.
    pub height: u32,
    /// How far each pixel sees; without it nothing is hidden.
    pub depth: Option<DepthField<'a>>,
    /// What is selected; members of a selected group count as selected, and ids the scene lacks are passed over.
    pub selection: &'a [EntityId],
    /// What is shown.
    pub style: OverlayStyle,
}

/// Pixels about a mark within which it is clicked, on a display of scale 1.
const MARK_REACH: f64 = 12.0;

impl Overlay<'_> {
    /// Draws the overlay onto `layer`, which takes on the overlay's size and loses what it held.
    pub fn draw(&self, layer: &mut Layer) {
        let stage = self.stage();
        let Some(ground) = layer.begin(self.width, self.height) else { return };
        let mut canvas =
            Canvas::new(Sight { view: &stage.view, depth: self.depth, scale: stage.scale() }, ground);
        for gizmo in GIZMOS.iter().filter(|gizmo| (gizmo.shown)(&self.style)) {
            (gizmo.draw)(&stage, &mut canvas);
            canvas.flush();
        }
    }

    /// The light or camera whose mark stands under the pixel (`x`, `y`): of those within 12 pixels (times the
    /// scale), the nearest in the picture.
    pub fn mark_at(&self, x: f64, y: f64) -> Option<EntityId> {
        let stage = self.stage();
        let stage = &stage;
        let marks =
            GIZMOS.iter().filter(|gizmo| (gizmo.shown)(&self.style)).flat_map(|gizmo| (gizmo.marks)(stage));
        let near = marks.filter_map(|(id, point)| {
            let mark = stage.view.project(point)?;
            let off = (mark.x - x).hypot(mark.y - y);
            (off <= MARK_REACH * f64::from(stage.scale())).then_some((id, off))
        });
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| id)
    }

    /// The ring of a spot light's cone under the pixel (`x`, `y`), within 6 pixels (times the scale); rings of
    /// selected lights come before others, nearer ones before farther ones. `None` while cones are not shown.
    pub fn ring_at(&self, x: f64, y: f64) -> Option<RingGrip> {
        if self.style.cones { grip::ring_at(&self.stage(), x, y) } else { None }
    }

    /// The full angle, in radians, that brings the gripped ring under the pixel (`x`, `y`).
    ///
    /// The ring's point follows the pointer along the meridian it was gripped on. An inner angle is held between
    /// just over zero and the outer one, an outer angle between the inner one and pi (or what it is, if that is
    /// more). `None` when the light is gone, is no spot light any more, or its cone is behind the eye.
    pub fn drag_ring(&self, grip: RingGrip, x: f64, y: f64) -> Option<f64> {
        grip::drag_ring(&self.stage(), grip, x, y)
    }

    fn stage(&self) -> Stage<'_> {
        let view = Projection::new(self.camera, self.width, self.height);
        Stage::new(self.scene, view, self.style, self.selection)
    }
}
