//! A scene in code becomes a picture: `picture.png` in the current folder.

use catoptra::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::new();
    let red = scene.add_material("red", Phong::new(Rgb::new(0.7, 0.1, 0.1))?.with("reflectiveness", 0.2)?)?;
    let tiles = scene.add_material("tiles", Checker::new(Rgb::grey(0.8), Rgb::grey(0.2), 1.0)?)?;
    scene.add_shape("ball", Sphere::new(DVec3::Y, 1.0)?, red, None)?;
    scene.add_shape("floor", Plane::new(DVec3::ZERO, DVec3::Y)?, tiles, None)?;

    // A shining rectangle, 2 m x 2 m: its shadow is soft, and exact.
    let panel = Rectangle::new(DVec3::new(-3.0, 4.0, 1.0), DVec3::X * 2.0, DVec3::Z * 2.0)?;
    scene.add_light("panel", RectangleLight::new(&panel, Rgb::grey(12.0))?, None)?;
    scene.add_light("sky", AmbientLight::new(Rgb::new(0.05, 0.06, 0.08))?, None)?;
    let (eye, target) = (DVec3::new(2.0, 2.0, 5.0), DVec3::Y * 0.8);
    scene.add_camera("eye", Camera::look_at(eye, target, DVec3::Y, 0.7)?, None)?;

    let film = Render::new(&scene).size(320, 240).samples(4).run()?;
    film.save_png("picture.png")?;
    println!("picture.png: 320 x 240 pixels, 4 samples each");
    Ok(())
}
