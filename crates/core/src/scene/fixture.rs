//! A small scene that the tests of this module edit.

use glam::DVec3;

use super::{Edit, EntityId, MaterialId, Scene, SceneError};
use crate::geometry::{Plane, Sphere};
use crate::{Camera, Light, Material, Placement, Rgb, Shape, Value, Values};

/// `floor` and `things` at the top; in `things` a `ball`, then `lamps`; in `lamps` a `lamp`; at the end an `eye`.
pub(super) struct Room {
    pub(super) scene: Scene,
    pub(super) white: MaterialId,
    pub(super) grey: MaterialId,
    pub(super) floor: EntityId,
    pub(super) things: EntityId,
    pub(super) ball: EntityId,
    pub(super) lamps: EntityId,
    pub(super) lamp: EntityId,
    pub(super) eye: EntityId,
}

impl Room {
    pub(super) fn new() -> Self {
        let mut scene = Scene::new();
        let white = scene.add_material("white", matte(1.0)).unwrap();
        let grey = scene.add_material("grey", matte(0.5)).unwrap();
        let floor = scene.add_shape("floor", plane(), white, None).unwrap();
        let things = scene.add_group("things", None).unwrap();
        let ball = scene.add_shape("ball", sphere(1.0), white, Some(things)).unwrap();
        let lamps = scene.add_group("lamps", Some(things)).unwrap();
        let lamp = scene.add_light("lamp", light(3.0), Some(lamps)).unwrap();
        let eye = scene.add_camera("eye", camera(1.0), None).unwrap();
        Self { scene, white, grey, floor, things, ball, lamps, lamp, eye }
    }

    /// Does an edit and takes it back; the scene between, for a look at what it did.
    pub(super) fn there_and_back(&self, edit: Edit) -> Scene {
        let mut scene = self.scene.clone();
        let inverse = scene.apply(edit).unwrap();
        let changed = scene.clone();
        scene.apply(inverse).unwrap();
        assert_eq!(scene, self.scene);
        changed
    }

    /// Why an edit is refused, after a look whether it left anything behind.
    pub(super) fn refusal(&self, edit: Edit) -> SceneError {
        let mut scene = self.scene.clone();
        let error = scene.apply(edit).unwrap_err();
        assert_eq!(scene, self.scene);
        assert_eq!(scene.revision(), self.scene.revision());
        assert_eq!(scene.changes_since(0), self.scene.changes_since(0));
        assert_eq!(scene.next_entity_id(), self.scene.next_entity_id());
        assert_eq!(scene.next_material_id(), self.scene.next_material_id());
        error
    }
}

pub(super) fn matte(reflectance: f64) -> Material {
    let kind = Material::kind_named("matte").unwrap();
    (kind.make)(&Values::new().with("color", Value::Color(Rgb::grey(reflectance)))).unwrap()
}

pub(super) fn light(intensity: f64) -> Light {
    let kind = Light::kind_named("point-light").unwrap();
    let values = Values::new()
        .with("position", Value::Vector(DVec3::ZERO))
        .with("intensity", Value::Color(Rgb::grey(intensity)));
    (kind.make)(&values).unwrap()
}

pub(super) fn camera(fov: f64) -> Camera {
    Camera::look_at(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, fov).unwrap()
}

pub(super) fn plane() -> Shape {
    Plane::new(DVec3::ZERO, DVec3::Y).unwrap().into()
}

pub(super) fn sphere(radius: f64) -> Shape {
    Sphere::new(DVec3::ZERO, radius).unwrap().into()
}

pub(super) fn moved(x: f64, y: f64, z: f64) -> Placement {
    Placement::IDENTITY.moved(DVec3::new(x, y, z)).unwrap()
}
