//! Every gizmo over a plainly shaded scene: `cargo run -p catoptra-raster --example gizmos -- DIRECTORY` writes one
//! picture over a dark and one over a bright backdrop, and says how long drawing and blending took.
//!
//! The picture under the overlay is made by trying every shape for every pixel, which is all an overlay asks for:
//! pixels, and how far each one sees.

use catoptra_core::glam::DVec3;
use catoptra_core::scene::Scene;
use catoptra_core::{Camera, Light, Material, Rgb, Shape, Span, Value, Values};
use catoptra_raster::{DepthField, Layer, Overlay, OverlayStyle, Pixmap};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 720;

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    let scene = scene()?;
    let views = [
        ("above", vector(13.0, 9.0, 17.0), vector(0.0, 3.0, -2.0)),
        ("level", vector(-3.0, 3.0, 20.0), vector(0.0, 3.0, -2.0)),
        ("inside", vector(-4.0, 7.4, 3.6), vector(1.0, 0.0, -3.0)),
    ];
    for (view, eye, target) in views {
        let camera = Camera::look_at(eye, target, DVec3::Y, 50_f64.to_radians())?;
        for (backdrop, brightness) in [("dark", 0.22), ("bright", 0.97)] {
            let (mut picture, metres) = shade(&scene, &camera, brightness);
            overlay(&scene, &camera, &metres, &mut picture);
            save(&picture, &directory.join(format!("{view}-{backdrop}.png")))?;
        }
    }
    Ok(())
}

/// Draws the overlay over the picture, twice: the second time is the one that counts.
fn overlay(scene: &Scene, camera: &Camera, metres: &[f32], picture: &mut [u32]) {
    let selection: Vec<_> =
        ["red spot", "small"].iter().filter_map(|name| scene.entity_named(name)).collect();
    let overlay = Overlay {
        scene,
        camera,
        width: WIDTH,
        height: HEIGHT,
        depth: Some(DepthField { width: WIDTH, height: HEIGHT, metres }),
        selection: &selection,
        style: OverlayStyle::default(),
    };
    let mut layer = Layer::new();
    overlay.draw(&mut layer);
    let start = Instant::now();
    overlay.draw(&mut layer);
    let drawn = start.elapsed();
    layer.blend_over(picture);
    println!("drawn in {drawn:?}, blended in {:?}", start.elapsed() - drawn);
}

fn scene() -> Result<Scene, Box<dyn Error>> {
    let mut scene = Scene::new();
    let white = scene.add_material(
        "white",
        part(Material::kind_named("matte"), &[("color", Value::Color(Rgb::grey(0.8)))])?,
    )?;
    let mut sphere = |name: &str, center: DVec3, radius: f64| -> Result<(), Box<dyn Error>> {
        let values = [("center", Value::Vector(center)), ("radius", Value::Number(radius))];
        scene.add_shape(name, part(Shape::kind_named("sphere"), &values)?, white, None)?;
        Ok(())
    };
    sphere("large", vector(0.0, 3.0, -4.0), 3.0)?;
    sphere("small", vector(4.5, 1.2, 1.0), 1.2)?;
    scene.add_shape("floor", part(Shape::kind_named("plane"), &[])?, white, None)?;
    let mut spot =
        |name: &str, at: DVec3, towards: DVec3, color: Rgb, falloff: f64| -> Result<(), Box<dyn Error>> {
            let values = [
                ("position", Value::Vector(at)),
                ("direction", Value::Vector(towards - at)),
                ("intensity", Value::Color(color * 60.0)),
                ("inner", Value::Number(20_f64.to_radians())),
                ("outer", Value::Number(60_f64.to_radians())),
                ("falloff", Value::Number(falloff)),
            ];
            scene.add_light(name, part(Light::kind_named("spot-light"), &values)?, None)?;
            Ok(())
        };
    spot("red spot", vector(-4.0, 7.0, 3.0), vector(0.0, 0.0, 0.5), Rgb::new(1.0, 0.12, 0.06), 1.0)?;
    spot("blue spot", vector(7.0, 6.0, -4.0), vector(5.5, 0.0, -3.0), Rgb::new(0.05, 0.1, 1.0), 3.0)?;
    let bulb = [
        ("position", Value::Vector(vector(1.5, 7.5, 1.0))),
        ("intensity", Value::Color(Rgb::new(40.0, 30.0, 16.0))),
    ];
    scene.add_light("bulb", part(Light::kind_named("point-light"), &bulb)?, None)?;
    let sun = [
        ("direction", Value::Vector(vector(0.5, -1.0, -0.6))),
        ("irradiance", Value::Color(Rgb::new(1.0, 0.95, 0.8))),
    ];
    scene.add_light("sun", part(Light::kind_named("directional-light"), &sun)?, None)?;
    let side = Camera::look_at(vector(-9.0, 3.0, 4.0), vector(0.0, 2.0, -2.0), DVec3::Y, 0.8)?;
    scene.add_camera("side", side, None)?;
    Ok(scene)
}

fn vector(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A part of a kind from some of its values; the others take their defaults.
fn part<T>(
    kind: Option<&'static catoptra_core::Kind<T>>,
    given: &[(&'static str, Value)],
) -> Result<T, Box<dyn Error>> {
    let kind = kind.ok_or("no such kind")?;
    let values = given.iter().fold(Values::new(), |values, (name, value)| values.with(name, value.clone()));
    Ok((kind.make)(&values)?)
}

/// The scene lit from over the camera's shoulder, as 0x00RRGGBB, and how far each pixel sees.
fn shade(scene: &Scene, camera: &Camera, brightness: f64) -> (Vec<u32>, Vec<f32>) {
    let shapes: Vec<Shape> = scene.entities().filter_map(|id| scene.world_shape(id)).collect();
    let towards = (camera.up() + camera.right() * 0.5 - camera.forward()).normalize();
    let mut picture = Vec::new();
    let mut metres = Vec::new();
    for pixel in 0..WIDTH * HEIGHT {
        let (x, y) = (f64::from(pixel % WIDTH) + 0.5, f64::from(pixel / WIDTH) + 0.5);
        let ray = camera.ray(x, y, WIDTH, HEIGHT);
        let crossings = shapes.iter().filter_map(|shape| shape.cross(&ray, Span::AHEAD, None));
        let nearest = crossings.min_by(|a, b| a.t.total_cmp(&b.t));
        let level = nearest.map_or(0.55, |hit| 0.45 + 0.55 * hit.normal.dot(towards).abs());
        picture.push((255.0 * brightness * level) as u32 * 0x01_01_01);
        metres.push(nearest.map_or(f32::INFINITY, |hit| (hit.t * ray.direction.length()) as f32));
    }
    (picture, metres)
}

fn save(picture: &[u32], path: &Path) -> Result<(), Box<dyn Error>> {
    let mut pixmap = Pixmap::new(WIDTH, HEIGHT).ok_or("an empty picture")?;
    for (bytes, pixel) in pixmap.data_mut().chunks_exact_mut(4).zip(picture) {
        let [_, red, green, blue] = pixel.to_be_bytes();
        bytes.copy_from_slice(&[red, green, blue, 255]);
    }
    pixmap.save_png(path)?;
    println!("{}", path.display());
    Ok(())
}
