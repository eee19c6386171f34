//! How long does it take to draw the gizmos over a frame, and to find what is under the pointer?

use catoptra_benches::{camera, criterion, scene};
use catoptra_raster::{DepthField, Layer, Overlay, OverlayStyle};
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, View, backend_named, render};
use criterion::{BenchmarkId, Criterion};

const SIZE: Size = Size::new(1280, 720);

fn main() {
    let mut criterion: Criterion = criterion();
    let mut group = criterion.benchmark_group("overlay");
    for name in ["spot", "many"] {
        let scene = scene(&format!("seed/{name}.kdl"));
        let camera = camera(&scene);
        let depths = depths(&scene);
        let selection: Vec<_> = scene.entities().collect();
        let overlay = Overlay {
            scene: &scene,
            camera: &camera,
            width: SIZE.width,
            height: SIZE.height,
            depth: Some(DepthField { width: SIZE.width, height: SIZE.height, metres: &depths }),
            selection: &selection,
            style: OverlayStyle::default(),
        };
        let mut layer = Layer::new();
        group.bench_function(BenchmarkId::new("draw", name), |b| b.iter(|| overlay.draw(&mut layer)));
        let mut picture = vec![0; SIZE.pixels()];
        group.bench_function(BenchmarkId::new("blend", name), |b| b.iter(|| layer.blend_over(&mut picture)));
        group.bench_function(BenchmarkId::new("pointer", name), |b| {
            b.iter(|| (overlay.mark_at(640.0, 360.0), overlay.grip_at(640.0, 360.0)));
        });
    }
    group.finish();
    criterion.final_summary();
}

/// How far each pixel of the frame sees.
fn depths(scene: &catoptra_core::Scene) -> Vec<f32> {
    let backend = backend_named("wide").expect("the default backend");
    let pool = Pool::new(0).expect("threads");
    let view = View::of(scene, camera(scene), SIZE);
    let mut film = Film::new(SIZE);
    render(backend, &Snapshot::extract(scene, &pool), &view, &mut film, &pool, &Control::default())
        .expect("nobody cancels");
    film.depths()
}
