//! Is the building of trees watched, and stopped where it is told to?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::material::Matte;
use catoptra_core::{MeshSource, Rgb, Scene, TriangleMesh};
use catoptra_tracer::{Cancelled, Control, Pool, Preset, Snapshot};

/// A flight of steps of so many triangles.
fn steps(count: u32) -> Scene {
    let corner = |at: u32| [(at / 2) as f32, (at % 2) as f32, (at / 3) as f32];
    let positions = (0..count + 2).map(corner).collect();
    let mesh = TriangleMesh::new(positions, (0..count).map(|at| [at, at + 1, at + 2]).collect(), None, None);
    let source = MeshSource { path: String::new(), mesh: Arc::new(mesh.unwrap()) };
    let mut scene = Scene::new();
    let grey = scene.add_material("grey", Matte::new(Rgb::grey(0.5)).unwrap()).unwrap();
    scene.add_shape("one", Mesh::new(source.clone()), grey, None).unwrap();
    scene.add_shape("two", Mesh::new(source), grey, None).unwrap();
    scene
}

#[test]
fn all_triangles_are_told_by_the_end() {
    let pool = Pool::new(2).unwrap();
    for (count, preset) in [(5, Preset::Balanced), (300, Preset::Fast), (40_000, Preset::Balanced)] {
        let control = Control::default();
        Snapshot::extract_unless_cancelled(&steps(count), preset, &pool, &control).unwrap();
        assert_eq!(control.progress(), 1.0, "{count} triangles");
    }
}

#[test]
fn a_cancelled_build_says_so_until_its_control_is_reset() {
    let (scene, pool, control) = (steps(40_000), Pool::new(2).unwrap(), Control::default());
    let build = || Snapshot::extract_unless_cancelled(&scene, Preset::Best, &pool, &control);
    control.cancel();
    assert_eq!(build().err(), Some(Cancelled));
    control.reset();
    assert_eq!(build().unwrap().meshes().len(), 1);
    // Half way: whoever is told of the first triangles may stop the rest.
    control.reset();
    std::thread::scope(|threads| {
        threads.spawn(|| {
            while control.progress() == 0.0 {
                std::thread::yield_now();
            }
            control.cancel();
        });
        let _ = build();
    });
    assert!(control.is_cancelled());
}
