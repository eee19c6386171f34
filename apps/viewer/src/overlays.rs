//! When are the overlays drawn anew? Only where something that they show has changed: they are kept, and laid over each
//! picture that is seen alike.

use catoptra_core::Camera;
use catoptra_core::scene::EntityId;
use catoptra_raster::{DepthField, Layer, Overlay, OverlayStyle};
use catoptra_tracer::{Film, Size};

/// All that the look of the overlays depends on.
#[derive(Debug, PartialEq)]
struct Look {
    revision: u64,
    /// The request that the picture answers: depths of films of one size for it are alike.
    generation: u64,
    /// The size of the film that tells what is hidden.
    film: Option<Size>,
    camera: Camera,
    size: (u32, u32),
    style: OverlayStyle,
    selection: Vec<EntityId>,
}

/// The overlays as they were last drawn.
#[derive(Debug, Default)]
pub(crate) struct Overlays {
    layer: Layer,
    drawn: Option<Look>,
}

impl Overlays {
    /// Draws the overlay if it does not look as it did. What `film`, traced for the request of that number, tells to be
    /// nearer hides what lies behind; without one nothing is hidden.
    pub(crate) fn follow(&mut self, overlay: Overlay<'_>, film: Option<&Film>, generation: u64) {
        let look = Look {
            revision: overlay.scene.revision(),
            generation,
            film: film.map(Film::size),
            camera: overlay.camera.clone(),
            size: (overlay.width, overlay.height),
            style: overlay.style,
            selection: overlay.selection.to_vec(),
        };
        if self.drawn.as_ref() != Some(&look) {
            self.draw(overlay, film);
            self.drawn = Some(look);
        }
    }

    /// Lays what was drawn last over a picture of its size.
    pub(crate) fn lay_over(&self, picture: &mut [u32]) {
        self.layer.blend_over(picture);
    }

    fn draw(&mut self, overlay: Overlay<'_>, film: Option<&Film>) {
        let metres = film.map(Film::depths).unwrap_or_default();
        let size = film.map_or(Size::new(0, 0), Film::size);
        let depth = DepthField { width: size.width, height: size.height, metres: &metres };
        Overlay { depth: Some(depth), ..overlay }.draw(&mut self.layer);
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::scene::{Edit, Role};
    use catoptra_tracer::Pool;

    use super::*;
    use crate::loader;
    use crate::viewer::Viewer;

    #[test]
    fn what_is_kept_is_what_would_be_drawn_and_a_change_is_seen() {
        let mut viewer = Viewer::new(loader::welcome(&Pool::new(1).unwrap()).unwrap());
        viewer.size = (160, 90);
        let mut kept = Overlays::default();
        let mut laid = |viewer: &Viewer, generation: u64| {
            let seen = |overlays: &mut Overlays| {
                let mut picture = vec![0; 160 * 90];
                overlays.follow(viewer.overlay(&viewer.camera), None, generation);
                overlays.lay_over(&mut picture);
                picture
            };
            let picture = seen(&mut kept);
            assert_eq!(picture, seen(&mut Overlays::default()), "as drawn anew");
            picture
        };
        let first = laid(&viewer, 1);
        assert_eq!(laid(&viewer, 1), first);
        viewer.settings.style.grid = true;
        let with_grid = laid(&viewer, 1);
        assert!(with_grid != first, "another style is another look");
        viewer.look(crate::camera_control::orbit(&viewer.camera, 0.3, 0.0));
        assert!(laid(&viewer, 2) != with_grid, "from elsewhere it looks otherwise");
        let scene = viewer.document.scene();
        let stands = |id: &EntityId| scene.light(*id).is_some_and(|light| light.position().is_some());
        let light = scene.entities_of(Role::Light).find(stands).unwrap();
        viewer.select(Some(light));
        let with_light = laid(&viewer, 2);
        viewer.edit(Edit::Remove(light));
        assert!(laid(&viewer, 2) != with_light, "what is gone is not seen");
    }
}
