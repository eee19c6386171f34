//! How long is it from a mesh to its tree, and from a scene to its snapshot?

use std::sync::Arc;

use catoptra_benches::{criterion, scene};
use catoptra_core::glam::DVec3;
use catoptra_core::{Edit, Placement, Rgb, Scene, geometry::Sphere, material::Matte};
use catoptra_lab::scenes::{placed_mesh, wavy_ball};
use catoptra_tracer::{Extraction, MeshTree, Pool, Preset, Snapshot};
use criterion::{BenchmarkId, Criterion, Throughput};

/// One thread for every core.
fn pool() -> Pool {
    Pool::new(0).expect("threads")
}

fn trees(c: &mut Criterion) {
    let pool = pool();
    let mut group = c.benchmark_group("tree");
    for rings in [32, 224] {
        let mesh = wavy_ball(rings);
        let triangles = mesh.triangles().len() as u64;
        group.throughput(Throughput::Elements(triangles));
        for preset in Preset::ALL {
            group.bench_with_input(BenchmarkId::new(preset.name(), triangles), &mesh, |b, mesh| {
                b.iter(|| MeshTree::build(&Arc::clone(mesh), *preset, &pool));
            });
        }
    }
    group.finish();
}

/// A cube of balls.
fn balls(side: u32) -> Scene {
    let mut scene = Scene::new();
    let matte = Matte::new(Rgb::WHITE).expect("white");
    let white = scene.add_material("white", matte).expect("a material");
    for number in 0..side.pow(3) {
        let place = [number % side, number / side % side, number / (side * side)].map(f64::from);
        let ball = Sphere::new(3.0 * DVec3::from_array(place), 1.0).expect("a ball");
        scene.add_shape(&format!("ball {number}"), ball, white, None).expect("a shape");
    }
    scene
}

fn extraction(c: &mut Criterion) {
    let pool = pool();
    let mut group = c.benchmark_group("extract");
    let scenes = [("seed many", scene("seed/many.kdl")), ("1000 spheres", balls(10))];
    for (name, scene) in &scenes {
        group.bench_with_input(BenchmarkId::from_parameter(name), scene, |b, scene| {
            b.iter(|| Snapshot::extract(scene, &pool));
        });
    }
    group.finish();
}

/// What an edit costs: the copy that the window makes, and the snapshot that follows on it, where no shape was touched and
/// where one was moved.
fn after_an_edit(c: &mut Criterion) {
    let pool = pool();
    let mut group = c.benchmark_group("extract after an edit");
    let meshes = placed_mesh(224).expect("a scene of meshes");
    for (name, mut scene) in [("a mesh of 100352 triangles, twice", meshes), ("1000 spheres", balls(10))] {
        group.bench_function(BenchmarkId::new(name, "copy"), |b| b.iter(|| Extraction::of(&scene)));
        let earlier = Snapshot::extract(&scene, &pool);
        group.bench_function(BenchmarkId::new(name, "no shape touched"), |b| {
            b.iter(|| Snapshot::after(&scene, &earlier, &pool));
        });
        let (first, ..) = scene.shapes()[0];
        let moved = Placement::IDENTITY.moved(DVec3::Y).expect("a metre up");
        scene.apply(Edit::Placement(first, moved)).expect("a shape that moves");
        group.bench_function(BenchmarkId::new(name, "a shape moved"), |b| {
            b.iter(|| Snapshot::after(&scene, &earlier, &pool));
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = criterion();
    trees(&mut criterion);
    extraction(&mut criterion);
    after_an_edit(&mut criterion);
    criterion.final_summary();
}
