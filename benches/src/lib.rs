//! What the benches share: scenes, and how long is measured.

use std::path::{Path, PathBuf};
use std::time::Duration;

use catoptra_core::glam::DVec3;
use catoptra_core::material::Matte;
use catoptra_core::{Camera, Ray, Rgb, Scene, Shape};
use catoptra_lab::scenes::ball_mesh;
use catoptra_tracer::query::RayList;
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};
use criterion::{BenchmarkId, Criterion, Throughput};

/// One of each kind, about as large as seen from the rays' origins.
const SHAPES: &str = r#"
matte "grey" { color 0.5 0.5 0.5 }
sphere "sphere" material="grey" { radius 1 }
plane "plane" material="grey"
triangle "triangle" material="grey" { a -1 -1 0; b 1 -1 0; c 0 1 0 }
tetrahedron "tetrahedron" material="grey" { a -1 -1 0; b 1 -1 0; c 0 1 0; d 0 0 1 }
rectangle "rectangle" material="grey" { corner -1 -1 0; edge-u 2 0 0; edge-v 0 2 0 }
disk "disk" material="grey" { center 0 0 0; normal 0 0 1; radius 1 }
box "box" material="grey" { min -1 -1 -1; max 1 1 1 }
cylinder "cylinder" material="grey" { from -0.6 -0.8 0; to 0.6 0.8 0.3; radius 0.7 }
cone "cone" material="grey" { from -0.6 -0.8 0; to 0.6 0.8 0.3; radius 1; top-radius 0.3 }
capsule "capsule" material="grey" { from -0.6 -0.8 0; to 0.6 0.8 0.3; radius 0.6 }
torus "torus" material="grey" { center 0 0 0; axis 0.2 0.5 1; major 0.8; minor 0.3 }
"#;

/// So many rays from a point in front, through a square twice as wide as the shapes.
pub fn rays(count: usize) -> RayList {
    let side = (count as f64).sqrt() as usize;
    let mut rays = RayList::new();
    for at in 0..count {
        let share = |k: usize| 2.8 * ((k as f64 + 0.5) / side as f64 - 0.5);
        let aim = DVec3::new(share(at % side), share(at / side), 0.0);
        let origin = DVec3::new(0.3, 0.2, 6.0);
        rays.push(&Ray::new(origin, aim - origin), [0.0, 1.5], None);
    }
    rays
}

/// A scene of one shape.
///
/// # Panics
/// When the shape cannot stand in a scene.
pub fn alone(shape: Shape) -> Snapshot {
    let mut scene = Scene::new();
    let grey = Matte::new(Rgb::grey(0.5)).expect("grey");
    let grey = scene.add_material("grey", grey).expect("a material");
    scene.add_shape("shape", shape, grey, None).expect("a shape");
    Snapshot::extract(&scene, &Pool::new(1).expect("a thread"))
}

/// A shape of each kind with its name, and a mesh.
///
/// # Panics
/// When the text of the shapes is wrong.
pub fn shapes() -> Vec<(&'static str, Shape)> {
    let (samples, _) = catoptra_scene::parse(SHAPES, "shapes", None).expect("shapes");
    let shapes = samples.entities().filter_map(|id| samples.shape(id));
    let mut shapes: Vec<_> = shapes.map(|shape| (shape.kind_name(), shape)).collect();
    shapes.push(("mesh of 9800", ball_mesh(70).into()));
    shapes
}

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
    let pool = Pool::new(1).expect("a thread");
    let snapshot = Snapshot::extract(scene, &pool);
    let view = View::of(scene, camera(scene), size);
    let mut film = Film::new(size);
    let mut group = c.benchmark_group(group);
    group.throughput(Throughput::Elements(size.pixels() as u64));
    group.bench_with_input(BenchmarkId::from_parameter(name), &(), |b, ()| {
        b.iter(|| render(backend, &snapshot, &view, &mut film, &pool, &Control::default()));
    });
    group.finish();
}
