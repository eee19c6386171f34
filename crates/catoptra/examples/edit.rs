//! A scene is edited, seen again and put back: each picture takes over what has not changed.

use catoptra::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::new();
    let clay = scene.add_material("clay", Matte::new(Rgb::new(0.8, 0.5, 0.3))?)?;
    let ball = scene.add_shape("ball", Sphere::new(DVec3::ZERO, 1.0)?, clay, None)?;
    scene.add_light("sky", AmbientLight::new(Rgb::WHITE)?, None)?;
    let view = View::new(Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y, 0.8)?, Size::new(64, 48));

    let (pool, control, mut film) = (Pool::shared()?, Control::default(), Film::new(view.size));
    let mut shown = Snapshot::extract(&scene, pool);
    let mut middle = |snapshot: &Snapshot| -> Result<[f32; 3], Cancelled> {
        render(backends()[0], snapshot, &view, &mut film, pool, &control)?;
        Ok(film.radiance(32, 24))
    };
    println!("the ball in the middle: {:?}", middle(&shown)?);

    // Edits that go through a history can be undone; `Scene::move_by` alone answers with the edit that takes it back.
    let mut history = History::new();
    history.apply(&mut scene, Edit::Placement(ball, Placement::IDENTITY.moved(DVec3::X * 3.0)?))?;
    shown = Snapshot::after(&scene, &shown, pool).0;
    println!("moved aside: {:?}", middle(&shown)?);

    history.undo(&mut scene);
    println!("undone: {:?}", middle(&Snapshot::after(&scene, &shown, pool).0)?);
    Ok(())
}
