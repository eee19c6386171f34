//! A scene with something for every gizmo, for tests.

use crate::manipulator::{Manipulator, Tool};
use crate::overlay::Overlay;
use crate::projection::Projection;
use crate::stage::Stage;
use crate::style::OverlayStyle;
use catoptra_core::glam::DVec3;
use catoptra_core::scene::{Edit, EntityId, Scene};
use catoptra_core::{Camera, Kind, Light, Material, Placement, Rgb, Shape, Value, Values};

pub(crate) const WIDTH: u32 = 320;
pub(crate) const HEIGHT: u32 = 240;

pub(crate) fn part<T>(kind: Option<&'static Kind<T>>, given: &[(&'static str, Value)]) -> T {
    let values = given.iter().fold(Values::new(), |all, (name, value)| all.with(name, value.clone()));
    (kind.unwrap().make)(&values).unwrap()
}

/// A white spot light of 16 W/sr: its rings stand 4 metres away. Angles in degrees.
pub(crate) fn spot(position: DVec3, direction: DVec3, inner: f64, outer: f64) -> Light {
    let values = [
        ("position", Value::Vector(position)),
        ("direction", Value::Vector(direction)),
        ("intensity", Value::Color(Rgb::grey(16.0))),
        ("inner", Value::Number(inner.to_radians())),
        ("outer", Value::Number(outer.to_radians())),
    ];
    part(Light::kind_named("spot-light"), &values)
}

pub(crate) fn point(position: DVec3) -> Light {
    let values = [("position", Value::Vector(position)), ("intensity", Value::Color(Rgb::grey(1.0)))];
    part(Light::kind_named("point-light"), &values)
}

/// A reddish panel of 2 by 1 metres that shines downwards.
pub(crate) fn panel() -> Light {
    let values = [
        ("corner", Value::Vector(DVec3::new(-1.0, 1.0, -0.5))),
        ("edge-u", Value::Vector(DVec3::X * 2.0)),
        ("edge-v", Value::Vector(DVec3::Z)),
        ("radiance", Value::Color(Rgb::new(2.0, 1.0, 1.0))),
    ];
    part(Light::kind_named("rectangle-light"), &values)
}

/// A disk of half a metre that shines forwards and upwards, given by its power.
pub(crate) fn round_panel() -> Light {
    let values = [
        ("center", Value::Vector(DVec3::new(0.0, 1.0, 0.0))),
        ("normal", Value::Vector(DVec3::new(0.2, 0.5, 1.0))),
        ("radius", Value::Number(0.5)),
        ("power", Value::Color(Rgb::grey(3.0))),
    ];
    part(Light::kind_named("disk-light"), &values)
}

/// A ball of light of half a metre.
pub(crate) fn globe() -> Light {
    let values = [
        ("center", Value::Vector(DVec3::new(0.5, 1.0, 0.0))),
        ("radius", Value::Number(0.5)),
        ("radiance", Value::Color(Rgb::grey(1.0))),
    ];
    part(Light::kind_named("sphere-light"), &values)
}

/// A light in a group that is turned, moved and half as large again, in view of [`camera`].
pub(crate) fn placed_in_group(light: Light) -> (Scene, EntityId) {
    let mut scene = Scene::new();
    let group = scene.add_group("group", None).unwrap();
    let placement = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::new(1.0, 0.4, 0.2), 0.7).unwrap();
    let placement = placement.scaled(1.5).unwrap().moved(DVec3::new(0.3, 0.6, -1.0)).unwrap();
    scene.apply(Edit::Placement(group, placement)).unwrap();
    let id = scene.add_light("light", light, Some(group)).unwrap();
    (scene, id)
}

/// A scene as [`camera`] sees it.
pub(crate) fn stage_of<'a>(scene: &'a Scene, selection: &'a [EntityId]) -> Stage<'a> {
    Stage::new(scene, Projection::new(&camera(), WIDTH, HEIGHT), OverlayStyle::default(), selection)
}

/// A scene with one light.
pub(crate) fn lit_by(light: Light) -> (Scene, EntityId) {
    let mut scene = Scene::new();
    let id = scene.add_light("light", light, None).unwrap();
    (scene, id)
}

/// A sphere, one light of every kind that has a mark, and a camera; all in view of [`camera`].
pub(crate) fn scene() -> Scene {
    let mut scene = Scene::new();
    let white = part(Material::kind_named("matte"), &[("color", Value::Color(Rgb::grey(1.0)))]);
    let white = scene.add_material("white", white).unwrap();
    let ball = [("center", Value::Vector(DVec3::Y)), ("radius", Value::Number(1.0))];
    scene.add_shape("ball", part(Shape::kind_named("sphere"), &ball), white, None).unwrap();
    scene.add_light("spot", spot(DVec3::new(2.0, 3.0, 0.0), DVec3::NEG_Y, 20.0, 60.0), None).unwrap();
    scene.add_light("bulb", point(DVec3::new(-2.0, 2.0, 0.0)), None).unwrap();
    let sun =
        [("direction", Value::Vector(DVec3::NEG_Y)), ("irradiance", Value::Color(Rgb::new(1.0, 0.5, 0.0)))];
    scene.add_light("sun", part(Light::kind_named("directional-light"), &sun), None).unwrap();
    scene.add_light("panel", panel(), None).unwrap();
    scene.add_light("round panel", round_panel(), None).unwrap();
    scene.add_light("globe", globe(), None).unwrap();
    let moved = |x, y| Placement::IDENTITY.moved(DVec3::new(x, y, 0.0)).unwrap();
    for (name, placement) in
        [("panel", moved(0.0, 3.0)), ("round panel", moved(-3.0, 2.5)), ("globe", moved(3.0, -1.0))]
    {
        let id = scene.entity_named(name).unwrap();
        scene.apply(Edit::Placement(id, placement)).unwrap();
    }
    let side = Camera::look_at(DVec3::new(-3.0, 1.0, -1.0), DVec3::ZERO, DVec3::Y, 0.8).unwrap();
    scene.add_camera("side", side, None).unwrap();
    scene
}

/// Arrows at the ball of [`scene`].
pub(crate) fn manipulator() -> Manipulator {
    Manipulator { tool: Tool::Move, pivot: DVec3::Y, axes: Manipulator::WORLD }
}

/// Ten metres before the origin, two up, looking level along -z.
pub(crate) fn camera() -> Camera {
    Camera::looking(DVec3::new(0.0, 2.0, 10.0), DVec3::NEG_Z, DVec3::Y, 50_f64.to_radians()).unwrap()
}

pub(crate) fn overlay<'a>(scene: &'a Scene, camera: &'a Camera, style: OverlayStyle) -> Overlay<'a> {
    Overlay { scene, camera, width: WIDTH, height: HEIGHT, depth: None, selection: &[], style }
}
