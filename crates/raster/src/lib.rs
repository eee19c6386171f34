//! What is drawn over a traced picture so that one sees what a picture alone does not show: light cones, marks and
//! outlines of lights, axes, the ground grid, bounds of the selection, cameras.
//!
//! An [`Overlay`] reads a scene and a camera and draws, antialiased, onto a [`Layer`]; the layer is blended over the
//! picture. Lines behind a traced surface, told by a [`DepthField`], are fainter and dashed; what is behind the eye
//! is cut off. What is drawn can be clicked ([`Overlay::mark_at`]) and dragged ([`Overlay::grip_at`],
//! [`Overlay::drag`]). A gizmo is one file under `gizmo/` and one line in its list.
#![cfg_attr(test, allow(clippy::unwrap_used, reason = "a test may stop at the first surprise"))]

mod canvas;
mod cone;
mod depth;
mod gizmo;
mod glow;
mod grip;
mod hair;
mod hull;
mod ink;
mod layer;
mod manipulator;
mod outline;
mod overlay;
mod pixel;
mod projection;
#[cfg(test)]
mod sample;
mod sight;
mod stage;
mod style;
mod tint;

pub use depth::DepthField;
pub use grip::{Edge, End, Grip, Handle, Ring};
pub use layer::{Layer, blend_over};
pub use manipulator::{Axis, Constraint, Manipulator, Motion, Tool};
pub use overlay::Overlay;
pub use projection::{Projected, Projection};
pub use style::OverlayStyle;
pub use tiny_skia::{IntRect, Pixmap};
