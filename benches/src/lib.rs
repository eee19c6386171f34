//! What the benches share: scenes, and how long is measured.

use std::path::{Path, PathBuf};
use std::time::Duration;

use catoptra_core::{Camera, Scene};
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};
use criterion::{BenchmarkId, Criterion, Throughput};

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

/// Measures a frame of a scene at 450x450, from snapshot to film, by backend `wide` on one thread.
///
/// # Panics
/// When the scene has no camera or there is no thread.
pub fn frame(c: &mut Criterion, group: &str, name: &str, scene: &Scene) {
    frame_of(c, group, name, scene, Size::new(450, 450));
}

/// As [`frame`], of another size.
///
/// # Panics
/// As [`frame`].
pub fn frame_of(c: &mut Criterion, group: &str, name: &str, scene: &Scene, size: Size) {
    let backend = backend_named("wide").expect("the default backend");
    let snapshot = Snapshot::extract(scene);
    let view = View::of(scene, camera(scene), size);
    let pool = Pool::new(1).expect("a thread");
    let mut film = Film::new(size);
    let mut group = c.benchmark_group(group);
    group.throughput(Throughput::Elements(size.pixels() as u64));
    group.bench_with_input(BenchmarkId::from_parameter(name), &(), |b, ()| {
        b.iter(|| render(backend, &snapshot, &view, &mut film, &pool, &Control::default()));
    });
    group.finish();
}
