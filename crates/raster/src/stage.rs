//! What do gizmos see of the scene?

use crate::projection::Projection;
use crate::style::OverlayStyle;
use crate::tint::Tint;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{EntityId, Role, Scene};
use catoptra_core::{Aabb, Light, Ray, Rgb, Shape, Span};
use std::cell::OnceCell;

/// A light as it shines in the world.
pub(crate) struct PlacedLight {
    pub(crate) id: EntityId,
    pub(crate) light: Light,
    pub(crate) selected: bool,
    /// Intensity or irradiance on the axis, or radiance, in the unit of the light's kind.
    pub(crate) power: Rgb,
}

impl PlacedLight {
    /// The colour it is drawn in.
    pub(crate) fn tint(&self) -> Tint {
        Tint::of_light(self.power)
    }
}

/// The scene in one view, for the time of one drawing or one look under the pointer.
pub(crate) struct Stage<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) view: Projection,
    pub(crate) style: OverlayStyle,
    pub(crate) selection: &'a [EntityId],
    pub(crate) lights: Vec<PlacedLight>,
    walls: OnceCell<Vec<Shape>>,
    extent: OnceCell<Aabb>,
}

impl<'a> Stage<'a> {
    pub(crate) fn new(
        scene: &'a Scene,
        view: Projection,
        style: OverlayStyle,
        selection: &'a [EntityId],
    ) -> Self {
        let mut stage = Self {
            scene,
            view,
            style,
            selection,
            lights: Vec::new(),
            walls: OnceCell::new(),
            extent: OnceCell::new(),
        };
        stage.lights = seen(scene, Role::Light).filter_map(|id| stage.placed_light(id)).collect();
        stage
    }

    /// Pixels in a pixel of a display of scale 1.
    pub(crate) fn scale(&self) -> f32 {
        self.style.scale()
    }

    /// Whether an entity or a group it belongs to is selected.
    pub(crate) fn is_selected(&self, id: EntityId) -> bool {
        self.selection.iter().any(|&outer| self.scene.lies_in(id, outer))
    }

    /// Whether the cone of that light is shown, if it has one.
    pub(crate) fn shows_cone(&self, placed: &PlacedLight) -> bool {
        self.style.cones || (self.style.lights && placed.selected)
    }

    /// Metres to the first surface from a point along a unit direction. Meshes are left out: a walk over all their
    /// triangles is too slow for a gizmo.
    pub(crate) fn nearest_surface(&self, from: DVec3, direction: DVec3) -> Option<f64> {
        let walls = self.walls.get_or_init(|| self.find_walls());
        let ray = Ray::new(from, direction);
        let crossings = walls.iter().filter_map(|wall| wall.cross(&ray, Span::AHEAD, None));
        crossings.map(|crossing| crossing.t).min_by(f64::total_cmp)
    }

    /// Bounds of all bounded shapes; one metre about the origin when there is none.
    pub(crate) fn extent(&self) -> Aabb {
        *self.extent.get_or_init(|| {
            let bounds = seen(self.scene, Role::Shape).filter_map(|id| self.scene.world_bounds(id));
            let extent = bounds.fold(Aabb::EMPTY, Aabb::union);
            if extent.is_empty() { Aabb { min: DVec3::splat(-0.5), max: DVec3::splat(0.5) } } else { extent }
        })
    }

    fn find_walls(&self) -> Vec<Shape> {
        let shapes = seen(self.scene, Role::Shape).filter_map(|id| self.scene.world_shape(id));
        shapes.filter(|shape| shape.as_mesh().is_none()).collect()
    }

    fn placed_light(&self, id: EntityId) -> Option<PlacedLight> {
        let light = self.scene.world_light(id)?;
        let power = light.color().rgb();
        Some(PlacedLight { id, light, selected: self.is_selected(id), power })
    }
}

/// The entities of a role that are not hidden.
pub(crate) fn seen(scene: &Scene, role: Role) -> impl Iterator<Item = EntityId> + '_ {
    scene.entities_of(role).filter(|id| !scene.is_hidden(*id))
}
