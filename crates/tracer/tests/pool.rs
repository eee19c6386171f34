//! Does everything that works with threads keep to the pool it is given?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::sync::Arc;

use catoptra_core::geometry::{Mesh, Sphere};
use catoptra_core::glam::DVec3;
use catoptra_core::material::Matte;
use catoptra_core::{Camera, MeshSource, Ray, Rgb, Scene, TriangleMesh};
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use catoptra_tracer::{Control, Film, Pool, Preset, Size, Snapshot, Tone, View, backends, render};

/// More triangles than one thread builds by itself.
fn hills(side: u32) -> TriangleMesh {
    let height = |x: u32, y: u32| (f64::from(x) * 0.7).sin() + (f64::from(y) * 0.3).cos();
    let places = (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y)));
    let positions = places.map(|(x, y)| [x as f32, height(x, y) as f32, y as f32]).collect();
    let corner = |x: u32, y: u32| y * (side + 1) + x;
    let squares = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let halves = squares.flat_map(|(x, y)| {
        let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)];
        [[a, b, c], [b, d, c]]
    });
    TriangleMesh::new(positions, halves.collect(), None, None).unwrap()
}

/// A large mesh, and more balls than one thread builds a tree over by itself.
fn scene() -> Scene {
    let mut scene = Scene::new();
    let white = scene.add_material("white", Matte::new(Rgb::WHITE).unwrap()).unwrap();
    let source = MeshSource { path: "hills.ply".into(), mesh: Arc::new(hills(100)) };
    scene.add_shape("hills", Mesh::new(source), white, None).unwrap();
    for number in 0..6000 {
        let ball = Sphere::new(DVec3::new(f64::from(number), 5.0, 0.0), 0.4).unwrap();
        scene.add_shape(&format!("ball {number}"), ball, white, None).unwrap();
    }
    scene
}

/// Rayon makes its global pool at the first parallel work outside any pool, and can be told how to make it until then.
#[test]
fn nothing_runs_on_the_threads_of_the_process() {
    let (scene, pool) = (scene(), Pool::new(2).unwrap());
    for preset in Preset::ALL {
        let snapshot = Snapshot::extract_with(&scene, *preset, &pool);
        assert_eq!(snapshot.meshes()[0].mesh().triangles().len(), 20_000);
    }
    let snapshot = Snapshot::extract(&scene, &pool);
    let camera = Camera::look_at(DVec3::new(50.0, 40.0, 150.0), DVec3::X * 50.0, DVec3::Y, 0.8).unwrap();
    let view = View::new(camera, Size::new(64, 48));
    let mut film = Film::new(view.size);
    let mut rays = RayList::new();
    rays.push(&Ray::new(DVec3::Y * 9.0, DVec3::new(0.1, -1.0, 0.1)), [0.0, f64::INFINITY], None);
    for backend in backends().iter().filter(|backend| backend.name() != "oracle") {
        render(*backend, &snapshot, &view, &mut film, &pool, &Control::default()).unwrap();
        find_nearest(*backend, &snapshot, &rays, &mut HitList::default(), &pool);
    }
    Tone::default().encode(&film, &pool, &mut vec![0; view.size.pixels()]);
    let unused = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    assert!(unused.is_ok(), "the global pool was made before: {unused:?}");
}
