//! How far are two pictures apart? The same scene with one sample a pixel, held against one with 64.

use catoptra::lab::{METRICS, Pair, Picture, Viewing};
use catoptra::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::new();
    let tiles = scene.add_material("tiles", Checker::new(Rgb::WHITE, Rgb::BLACK, 3.0)?)?;
    scene.add_shape("floor", Plane::new(DVec3::ZERO, DVec3::Y)?, tiles, None)?;
    scene.add_light("sky", AmbientLight::new(Rgb::WHITE)?, None)?;
    scene.add_camera("eye", Camera::look_at(DVec3::Y, DVec3::Z * -4.0, DVec3::Y, 0.8)?, None)?;

    let picture = |samples: u32| -> Result<Picture, Box<dyn std::error::Error>> {
        let film = Render::new(&scene).size(160, 120).samples(samples).run()?;
        Ok(Picture::try_from(&film)?)
    };
    let (fine, coarse) = (picture(64)?, picture(1)?);
    for metric in METRICS {
        let measured = (metric.measure)(Pair::new(&fine, &coarse)?, &Viewing::default());
        println!("{}: {measured:.4} ({})", metric.name, metric.doc);
    }
    Ok(())
}
