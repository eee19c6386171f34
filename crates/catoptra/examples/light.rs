//! How much light arrives at points of a desk, in lux, below a lamp that a plate hides in part.

use catoptra::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::new();
    let grey = scene.add_material("grey", Matte::new(Rgb::grey(0.5))?)?;
    // A square of 1 m that shines downwards with 1000 candela a square metre, 2 m above the desk.
    let square = Rectangle::new(DVec3::new(-0.5, 2.0, -0.5), DVec3::X, DVec3::Z)?;
    scene.add_light("lamp", RectangleLight::new(&square, Rgb::grey(1000.0))?, None)?;
    scene.add_shape("plate", Disk::new(DVec3::Y, DVec3::Y, 0.2)?, grey, None)?;

    let at = |x: f64| Receiver::new(DVec3::X * x, DVec3::Y);
    let meters = [at(0.0)?, at(0.4)?, at(0.8)?];
    let caster = Caster::from_scene(&scene)?;
    let options = ProbeOptions::default();
    let found = caster.irradiance_at(&meters, &options, Pool::shared()?, &Control::default())?;
    for (meter, light) in meters.iter().zip(&found) {
        // No rays are drawn at random here, so that the standard error is 0.
        println!("{:.1} m: {:.3} lux, off by {}", meter.point().x, light.mean.g, light.error.g);
    }
    Ok(())
}
