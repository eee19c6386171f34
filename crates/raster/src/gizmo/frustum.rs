//! Where does a camera of the scene stand, and what does it look at? Its frustum, with a mark over its upper edge.

use super::Gizmo;
use crate::canvas::Canvas;
use crate::ink::Ink;
use crate::stage::{Stage, seen};
use crate::tint::Tint;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{EntityId, Role};
use catoptra_core::{Camera, Extent};

pub(super) const GIZMO: Gizmo = Gizmo { name: "camera", shown: |style| style.cameras, draw, marks };

/// Depth of the frustum drawn, in pixels.
const DEPTH: f64 = 70.0;
/// A camera this near to the eye, in metres, is the one looked through: not drawn.
const OWN: f64 = 1e-3;

fn draw(stage: &Stage<'_>, canvas: &mut Canvas<'_>) {
    for (id, camera) in cameras(stage) {
        let Some(pixel) = stage.view.metres_per_pixel(camera.eye()) else { continue };
        let depth = DEPTH * pixel * f64::from(stage.scale());
        let tint = if stage.is_selected(id) { Tint::ACCENT } else { Tint::QUIET };
        frustum(canvas, &camera, depth, Ink::new(tint));
    }
}

fn marks(stage: &Stage<'_>) -> Vec<(EntityId, DVec3)> {
    cameras(stage).map(|(id, camera)| (id, camera.eye())).collect()
}

fn frustum(canvas: &mut Canvas<'_>, camera: &Camera, depth: f64, ink: Ink) {
    // Parallel rays begin all over the picture's shape, in one size whatever they see.
    let (high, start) = match camera.extent() {
        Extent::Angle(fov) => ((0.5 * fov).tan(), 0.0),
        Extent::Height(_) => (0.5, 1.0),
    };
    let wide = high * canvas.view().width() / canvas.view().height();
    // A camera of any field of view gets a frustum of one size.
    let depth = depth / high.hypot(wide).max(1.0);
    let aside = |right: f64, up: f64| (camera.right() * (right * wide) + camera.up() * (up * high)) * depth;
    let at = |right: f64, up: f64| camera.eye() + camera.forward() * depth + aside(right, up);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    canvas.curve(&corners.map(|(right, up)| at(right, up)), ink);
    for &(right, up) in &corners[..4] {
        canvas.segment(camera.eye() + aside(right, up) * start, at(right, up), ink);
    }
    canvas.curve(&[at(-0.35, 1.12), at(0.0, 1.65), at(0.35, 1.12), at(-0.35, 1.12)], ink);
}

/// The scene's cameras in the world, but for the one the picture is seen from.
fn cameras<'a>(stage: &'a Stage<'_>) -> impl Iterator<Item = (EntityId, Camera)> + 'a {
    let ids = seen(stage.scene, Role::Camera);
    ids.filter_map(|id| {
        let camera = stage.scene.world_camera(id)?;
        let apart = camera.eye().distance(stage.view.stand());
        (apart > OWN).then_some((id, camera))
    })
}
