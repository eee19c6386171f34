//! How long does a frame take? The seed scenes and a mesh scene at 450x450, from snapshot to film, on one thread.

use catoptra_benches::{camera, criterion, scene};
use catoptra_core::Scene;
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};
use criterion::{BenchmarkId, Criterion, Throughput};

const SIZE: Size = Size::new(450, 450);

const SEED: [&str; 8] = ["planes", "directional", "point", "spot", "many", "material", "depth", "tetra"];

/// A knot of some thousand triangles under three spots.
const MESH: &str = "gallery/knot.kdl";

fn frame(c: &mut Criterion, group: &str, name: &str, scene: &Scene) {
    let backend = backend_named("wide").expect("the default backend");
    let snapshot = Snapshot::extract(scene);
    let view = View::of(scene, camera(scene), SIZE);
    let pool = Pool::new(1).expect("a thread");
    let mut film = Film::new(SIZE);
    let mut group = c.benchmark_group(group);
    group.throughput(Throughput::Elements(SIZE.pixels() as u64));
    group.bench_with_input(BenchmarkId::from_parameter(name), &(), |b, ()| {
        b.iter(|| render(backend, &snapshot, &view, &mut film, &pool, &Control::default()));
    });
    group.finish();
}

fn main() {
    let mut criterion = criterion();
    for name in SEED {
        frame(&mut criterion, "frame", name, &scene(&format!("seed/{name}.kdl")));
    }
    frame(&mut criterion, "frame", "mesh", &scene(MESH));
    criterion.final_summary();
}
