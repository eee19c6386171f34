//! From where does one look? Through a camera of the scene, at a thing or at everything; and what stands under a pixel.

use catoptra_core::scene::EntityId;
use catoptra_core::{Aabb, Camera};
use catoptra_tracer::{Pick, Size, View, pick};

use crate::camera_control;
use crate::fly;
use crate::viewer::Viewer;

impl Viewer {
    /// Looks from elsewhere.
    pub(crate) fn look(&mut self, camera: Camera) {
        if camera != self.camera {
            self.camera = camera;
            self.stale.trace = true;
            self.stale.scene |= self.headlight;
            fly::follow(self);
        }
    }

    /// Looks through a camera of the scene; without one, at everything.
    pub(crate) fn adopt(&mut self, id: Option<EntityId>) {
        let scene = self.document.scene();
        let seen = id.and_then(|id| scene.world_camera(id));
        self.through = seen.as_ref().and(id);
        self.seen_through.clone_from(&seen);
        match seen {
            Some(camera) if camera.target_distance().is_none() => self.look(self.aimed(&camera)),
            Some(camera) => self.look(camera),
            None => self.frame(self.everything()),
        }
        self.stale.overlay = true;
    }

    /// Takes over what was changed about the camera that was looked through: if it stays where it is, so does the view, even
    /// where one has gone elsewhere.
    pub(crate) fn follow_camera(&mut self, id: Option<EntityId>) {
        let now = id.and_then(|id| self.document.scene().world_camera(id));
        let (Some(old), Some(new)) = (self.seen_through.take(), now) else { return self.adopt(id) };
        let stays = (old.eye(), old.aim(), old.up_hint()) == (new.eye(), new.aim(), new.up_hint());
        let view = self.camera.clone().with_lens(0.0, None).and_then(|view| view.with_extent(new.extent()));
        match view.and_then(|view| view.with_lens(new.lens_radius(), new.given_focus())) {
            Ok(view) if stays => {
                self.look(view);
                self.seen_through = Some(new);
            }
            _ => self.adopt(id),
        }
    }

    /// A camera that names no target is taken to look at the middle of what it sees in the middle of its picture.
    fn aimed(&self, camera: &Camera) -> Camera {
        let view = View::new(camera.clone(), Size::new(2, 2));
        let Some(hit) = pick(&self.latest.get(), &view, 1.0, 1.0) else { return camera.clone() };
        let bounds = self.document.scene().world_bounds(hit.entity);
        let depth = bounds.map_or(0.0, |bounds| (bounds.centre() - camera.eye()).dot(camera.forward()));
        camera_control::aimed(camera, depth.max(hit.distance))
    }

    /// The box round all bounded shapes.
    pub(crate) fn everything(&self) -> Aabb {
        let shapes = self.document.scene().world_shapes();
        shapes.iter().filter_map(|(shape, _)| shape.part.bounds()).fold(Aabb::EMPTY, Aabb::union)
    }

    /// Moves the camera so that `bounds` is seen; an empty box changes nothing.
    pub(crate) fn frame(&mut self, bounds: Aabb) {
        let aspect = f64::from(self.size.0.max(1)) / f64::from(self.size.1.max(1));
        self.look(camera_control::frame(&self.camera, bounds, aspect));
    }

    /// The tracer's view of the full picture.
    pub(crate) fn view(&self) -> View {
        View::of(self.document.scene(), self.camera.clone(), Size::new(self.size.0, self.size.1))
    }

    /// What the picture shows at a point, in pixels, as far as it is traced: what has been removed since is nothing.
    pub(crate) fn pick(&self, x: f64, y: f64) -> Option<Pick> {
        let hit = pick(&self.latest.get(), &self.view(), x, y);
        hit.filter(|hit| self.document.scene().contains(hit.entity))
    }
}

/// Where one looks from before any scene says better.
pub(crate) fn usual_camera() -> Camera {
    use catoptra_core::glam::DVec3;
    Camera::look_at(DVec3::new(4.0, 3.0, 8.0), DVec3::ZERO, DVec3::Y, std::f64::consts::FRAC_PI_4)
        .unwrap_or_else(|_| unreachable!("constants that a camera accepts"))
}
