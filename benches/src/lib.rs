//! What the benches share: scenes, and how long is measured.

use std::path::{Path, PathBuf};
use std::time::Duration;

use catoptra_core::{Camera, Scene};
use criterion::Criterion;

/// Short times, so that all benches together take a minute or two; options on the command line lengthen them.
pub fn criterion() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .sample_size(20)
        .configure_from_args()
}

/// Where a shipped scene lies, by its path below `scenes/`.
pub fn scene_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name)
}

/// A shipped scene.
///
/// # Panics
/// When it cannot be read.
pub fn scene(name: &str) -> Scene {
    match catoptra_scene::load(&scene_file(name)) {
        Ok((scene, _)) => scene,
        Err(error) => panic!("{name}: {error:?}"),
    }
}

/// The first camera of a scene, in the world.
///
/// # Panics
/// When there is none.
pub fn camera(scene: &Scene) -> Camera {
    let id = scene.main_camera().expect("a scene with a camera");
    scene.world_camera(id).expect("a camera that can be placed")
}
