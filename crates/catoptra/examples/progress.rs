//! A long render tells how far it is, is stopped half way, and done again to its end.

use std::time::Duration;

use catoptra::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::new();
    let white = scene.add_material("white", Matte::new(Rgb::grey(0.8))?)?;
    scene.add_shape("floor", Plane::new(DVec3::ZERO, DVec3::Y)?, white, None)?;
    scene.add_light("sky", EnvironmentLight::new(Rgb::WHITE)?, None)?;
    let camera = Camera::look_at(DVec3::Y * 2.0, DVec3::Z * -3.0, DVec3::Y, 0.9)?;

    let control = Control::default();
    let job = Render::new(&scene).camera(camera).integrator(Integrator::Path).control(&control);
    let stopped = std::thread::scope(|threads| {
        let long = job.clone().samples(256);
        let render = threads.spawn(|| long.run().map(|_| ()));
        std::thread::sleep(Duration::from_millis(50));
        println!("{:.0} % done, stopped here", 100.0 * control.progress());
        control.cancel();
        render.join()
    });
    println!("{}", stopped.map_err(|_| "the render panicked")?.err().ok_or("it was done too soon")?);
    control.reset();
    let film = job.size(160, 120).samples(4).run()?;
    println!("{:.0} % done: {:?}", 100.0 * control.progress(), film.size());
    Ok(())
}
