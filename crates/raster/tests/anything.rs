//! Whatever is in the scene and wherever the camera stands, overlays are drawn without a panic, and what they leave
//! is a valid premultiplied picture.

use catoptra_core::glam::DVec3;
use catoptra_core::scene::Scene;
use catoptra_core::{Camera, Kind, Light, Material, Rgb, Shape, Value, Values};
use catoptra_raster::{DepthField, Edge, End, Grip, Handle, Layer, Overlay, OverlayStyle};
use proptest::prelude::*;

/// Ordinary numbers, and ones that overflow, underflow or cancel.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -20.0..20.0,
        1 => prop::sample::select(vec![0.0, -0.0, 1e-300, -1e-12, 1e-3, 1e9, -1e18, 1e150, -1e300]),
    ]
}

fn vector() -> impl Strategy<Value = DVec3> {
    (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn angles() -> impl Strategy<Value = (f64, f64)> {
    let angle =
        || prop_oneof![4 => 0.0..6.2, 1 => prop::sample::select(vec![0.0, 1e-9, std::f64::consts::PI])];
    (angle(), angle()).prop_map(|(one, other): (f64, f64)| (one.min(other), one.max(other)))
}

fn part<T>(kind: Option<&'static Kind<T>>, given: &[(&'static str, Value)]) -> Option<T> {
    let values = given.iter().fold(Values::new(), |all, (name, value)| all.with(name, value.clone()));
    (kind?.make)(&values).ok()
}

fn scene(at: [DVec3; 4], (inner, outer): (f64, f64), falloff: f64, power: f64) -> Option<Scene> {
    let mut scene = Scene::new();
    let white = part(Material::kind_named("matte"), &[("color", Value::Color(Rgb::grey(1.0)))])?;
    let white = scene.add_material("white", white).ok()?;
    let power = Value::Color(Rgb::new(power, 0.0, power));
    let spot = [
        ("position", Value::Vector(at[0])),
        ("direction", Value::Vector(at[1])),
        ("intensity", power.clone()),
        ("inner", Value::Number(inner)),
        ("outer", Value::Number(outer)),
        ("falloff", Value::Number(falloff)),
    ];
    let sun = [("direction", Value::Vector(at[1])), ("irradiance", power.clone())];
    let bulb = [("position", Value::Vector(at[2])), ("intensity", power.clone())];
    let panel = [
        ("corner", Value::Vector(at[3])),
        ("edge-u", Value::Vector(at[1])),
        ("edge-v", Value::Vector(at[1].any_orthogonal_vector())),
        ("power", power.clone()),
    ];
    let round = [
        ("center", Value::Vector(at[2])),
        ("normal", Value::Vector(at[1])),
        ("radius", Value::Number(at[0].y.abs())),
        ("radiance", power.clone()),
        ("two-sided", Value::Flag(true)),
    ];
    let globe =
        [("center", Value::Vector(at[0])), ("radius", Value::Number(at[3].x.abs())), ("radiance", power)];
    // What the core refuses is not in the scene; the rest is drawn.
    let lights = [
        part(Light::kind_named("spot-light"), &spot),
        part(Light::kind_named("directional-light"), &sun),
        part(Light::kind_named("point-light"), &bulb),
        part(Light::kind_named("rectangle-light"), &panel),
        part(Light::kind_named("disk-light"), &round),
        part(Light::kind_named("sphere-light"), &globe),
    ];
    for (name, light) in ["spot", "sun", "bulb", "panel", "round", "globe"].into_iter().zip(lights) {
        light.map(|light| scene.add_light(name, light, None));
    }
    let ball = [("center", Value::Vector(at[3])), ("radius", Value::Number(at[0].x.abs()))];
    let floor = [("point", Value::Vector(at[2])), ("normal", Value::Vector(at[3]))];
    let shapes = [part(Shape::kind_named("sphere"), &ball), part(Shape::kind_named("plane"), &floor)];
    for (name, shape) in ["ball", "floor"].into_iter().zip(shapes) {
        shape.map(|shape| scene.add_shape(name, shape, white, None));
    }
    let camera = Camera::look_at(at[2], at[3], DVec3::Y, 1.0).ok();
    camera.map(|camera| scene.add_camera("camera", camera, None));
    Some(scene)
}

proptest! {
    #[test]
    fn anything_can_be_drawn(
        at in [vector(), vector(), vector(), vector()],
        eye in vector(),
        target in vector(),
        fov in prop_oneof![0.1..3.0, Just(1e-7), Just(3.1)],
        angles in angles(),
        (falloff, power) in (number(), number()),
        scale in prop_oneof![Just(1.0_f32), Just(2.5), Just(0.0), Just(f32::NAN), Just(f32::INFINITY)],
        size in (0_u32..90, 0_u32..70),
        metres in prop::collection::vec(prop_oneof![Just(f32::INFINITY), Just(f32::NAN), -1.0_f32..30.0], 64),
    ) {
        let scene = scene(at, angles, falloff.abs(), power.abs()).unwrap();
        let Ok(camera) = Camera::look_at(eye, target, DVec3::new(0.1, 1.0, 0.2), fov) else { return Ok(()) };
        let selection: Vec<_> = scene.entities().collect();
        let overlay = Overlay {
            scene: &scene,
            camera: &camera,
            width: size.0,
            height: size.1,
            depth: Some(DepthField { width: 8, height: 8, metres: &metres }),
            selection: &selection,
            style: OverlayStyle { scale, ..OverlayStyle::default() },
        };
        let mut layer = Layer::new();
        overlay.draw(&mut layer);
        layer.blend_over(&mut vec![0x0080_8080; (size.0 * size.1) as usize]);
        if let Some(pixmap) = layer.pixmap() {
            for pixel in pixmap.pixels() {
                let most = pixel.red().max(pixel.green()).max(pixel.blue());
                prop_assert!(most <= pixel.alpha());
            }
        }
        for (x, y) in [(0.0, 0.0), (f64::from(size.0) / 2.0, f64::from(size.1) / 2.0), (1e300, f64::NAN)] {
            overlay.mark_at(x, y);
            let mut grips: Vec<Grip> = overlay.grip_at(x, y).into_iter().collect();
            for light in scene.entities() {
                let side = Handle::Side { edge: Edge::V, end: End::Start, share: 0.2 };
                let handles = [side, Handle::Corner([End::Start, End::Far]), Handle::Rim { azimuth: 1.0 }, Handle::Outline];
                grips.extend(handles.map(|handle| Grip { light, handle }));
            }
            for grip in grips {
                // A light that core refuses is an answer too.
                if let Some(Ok(Light::SpotLight(spot))) = overlay.drag(grip, x, y) {
                    let range = 0.0..=std::f64::consts::TAU + 1e-9;
                    prop_assert!(range.contains(&spot.inner()) && range.contains(&spot.outer()));
                }
            }
        }
    }
}
