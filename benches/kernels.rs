//! How many rays a second are held against one shape of each kind, half of them hits?

use catoptra_benches::criterion;
use catoptra_core::glam::DVec3;
use catoptra_core::material::Matte;
use catoptra_core::{Ray, Rgb, Scene, Shape};
use catoptra_lab::scenes::ball_mesh;
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{Pool, Snapshot, backend_named};
use criterion::{BenchmarkId, Criterion, Throughput};

/// Rays of one measurement.
const RAYS: usize = 1 << 14;

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
"#;

/// Rays from a plane in front, through a square twice as wide as the shapes.
fn rays() -> RayList {
    let side = (RAYS as f64).sqrt() as usize;
    let mut rays = RayList::new();
    for at in 0..RAYS {
        let share = |k: usize| 2.8 * ((k as f64 + 0.5) / side as f64 - 0.5);
        let aim = DVec3::new(share(at % side), share(at / side), 0.0);
        let origin = DVec3::new(0.3, 0.2, 6.0);
        rays.push(&Ray::new(origin, aim - origin), [0.0, 1.5], None);
    }
    rays
}

fn alone(shape: Shape) -> Snapshot {
    let mut scene = Scene::new();
    let grey = Matte::new(Rgb::grey(0.5)).expect("grey");
    let grey = scene.add_material("grey", grey).expect("a material");
    scene.add_shape("shape", shape, grey, None).expect("a shape");
    Snapshot::extract(&scene)
}

fn shapes() -> Vec<(&'static str, Shape)> {
    let (samples, _) = catoptra_scene::parse(SHAPES, "shapes", None).expect("shapes");
    let shapes = samples.entities().filter_map(|id| samples.shape(id));
    let mut shapes: Vec<_> = shapes.map(|shape| (shape.kind_name(), shape)).collect();
    shapes.push(("mesh of 9800", ball_mesh(70).into()));
    shapes
}

fn kernels(c: &mut Criterion) {
    let (rays, pool) = (rays(), Pool::new(1).expect("a thread"));
    let backend = backend_named("wide").expect("the default backend");
    for (group, any) in [("nearest", false), ("occluded", true)] {
        let mut group = c.benchmark_group(group);
        group.throughput(Throughput::Elements(RAYS as u64));
        for (name, shape) in shapes() {
            let snapshot = alone(shape);
            let (mut hits, mut occluded) = (HitList::default(), Vec::new());
            group.bench_with_input(BenchmarkId::from_parameter(name), &(), |b, ()| {
                b.iter(|| {
                    if any {
                        find_occluded(backend, &snapshot, &rays, &mut occluded, &pool);
                    } else {
                        find_nearest(backend, &snapshot, &rays, &mut hits, &pool);
                    }
                });
            });
        }
        group.finish();
    }
}

fn main() {
    let mut criterion = criterion();
    kernels(&mut criterion);
    criterion.final_summary();
}
