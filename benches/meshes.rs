//! What is hard about meshes: pictures of a fine one, with packets that walk it together and alone; the same mesh twice in one
//! place; triangles that lie in one plane over each other; rays to corners and points of edges. All on one thread.

use catoptra_benches::{camera, criterion};
use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::light::{DirectionalLight, PointLight};
use catoptra_core::material::Matte;
use catoptra_core::{Camera, Light, MeshSource, Ray, Rgb, Scene, Span, TriangleMesh};
use catoptra_lab::adversary::Random;
use catoptra_lab::scenes::icosphere;
use catoptra_tracer::query::{HitList, RayList, find_nearest};
use catoptra_tracer::{Caster, Control, Film, Pool, Size, Skip, Snapshot, View, backends, render};
use criterion::{Criterion, Throughput};

type Triangles = (Vec<[f32; 3]>, Vec<[u32; 3]>);

/// Meshes of triangles, each as often as it stands there, before a camera and under a light.
fn seen(meshes: &[(&Triangles, u32)], light: Light) -> Scene {
    let mut scene = Scene::new();
    let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.7)).expect("clay")).expect("a name");
    for (kind, ((positions, triangles), times)) in meshes.iter().enumerate() {
        let mesh = TriangleMesh::new(positions.clone(), triangles.clone(), None, None).expect("a mesh");
        let source = MeshSource { path: format!("{kind}.ply"), mesh: mesh.into() };
        for copy in 0..*times {
            let mesh = Mesh::new(source.clone());
            scene.add_shape(&format!("mesh {kind} {copy}"), mesh, clay, None).expect("a name");
        }
    }
    let camera = Camera::look_at(DVec3::new(1.2, 0.8, 2.6), DVec3::ZERO, DVec3::Y, 0.8).expect("a camera");
    scene.add_camera("eye", camera, None).expect("a name");
    scene.add_light("light", light, None).expect("a name");
    scene
}

fn lamp() -> Light {
    PointLight::new(DVec3::new(-1.6, 3.2, 2.4), Rgb::grey(40.0)).expect("a lamp").into()
}

fn sun() -> Light {
    DirectionalLight::new(DVec3::new(-0.3, -1.0, -0.2), Rgb::grey(3.0)).expect("a sun").into()
}

/// So many triangles of one size in one plane, in random places.
fn in_one_plane(count: u32, size: f32) -> Triangles {
    let (mut random, mut positions) = (Random::new(3), Vec::new());
    for _ in 0..count {
        let [x, y] = [0; 2].map(|_| random.between(-1.0, 1.0) as f32);
        positions.extend([[x, y, 0.0], [x + size, y, 0.0], [x, y + size, 0.0]]);
    }
    (positions, (0..count).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect())
}

fn frames(c: &mut Criterion, pool: &Pool) {
    let ball = icosphere(6);
    let (plane, same) = (in_one_plane(20_000, 0.05), in_one_plane(1, 1.5));
    let same = (same.0, vec![same.1[0]; 300_000]);
    let scenes = [
        ("ball under a lamp", seen(&[(&ball, 1)], lamp()), Skip::ALL),
        ("ball under a lamp, packets alone", seen(&[(&ball, 1)], lamp()), Skip { walks: false, ..Skip::ALL }),
        ("ball under the sun", seen(&[(&ball, 1)], sun()), Skip::ALL),
        ("ball twice in one place", seen(&[(&ball, 2)], lamp()), Skip::ALL),
        ("20,000 triangles in one plane", seen(&[(&plane, 1)], lamp()), Skip::ALL),
        ("one triangle 300,000 times", seen(&[(&same, 1)], lamp()), Skip::ALL),
    ];
    let mut group = c.benchmark_group("mesh frames");
    group.sample_size(10);
    for (name, scene, skip) in scenes {
        let snapshot = Snapshot::extract(&scene, pool);
        let view = View { skip, ..View::of(&scene, camera(&scene), Size::new(512, 512)) };
        let mut film = Film::new(view.size);
        group.bench_function(name, |b| {
            b.iter(|| render(backends()[0], &snapshot, &view, &mut film, pool, &Control::default()));
        });
    }
    group.finish();
}

/// Rays from inside a ball to its corners and to two points of each edge, and as many in other directions.
fn corners_and_edges(c: &mut Criterion, pool: &Pool) {
    let (positions, triangles) = icosphere(6);
    let corner = |at: u32| DVec3::from(positions[at as usize].map(f64::from));
    let mut targets: Vec<DVec3> = (0..positions.len() as u32).map(corner).collect();
    for [a, b, c] in &triangles {
        for (&from, &to) in [(a, b), (b, c), (c, a)].into_iter().filter(|(from, to)| from < to) {
            targets.extend([0.5, 0.25].map(|share| corner(from).lerp(corner(to), share)));
        }
    }
    let caster = Caster::from_triangles(&positions, &triangles).expect("a caster");
    let mut random = Random::new(5);
    let others: Vec<DVec3> =
        targets.iter().map(|target| (*target + random.point(0.01)).normalize()).collect();
    let mut group = c.benchmark_group("rays from inside a ball");
    group.throughput(Throughput::Elements(targets.len() as u64));
    group.sample_size(10);
    for (name, targets) in [("to corners and edges", targets), ("elsewhere", others)] {
        let mut rays = RayList::new();
        let span = [Span::AHEAD.min, Span::AHEAD.max];
        targets.iter().for_each(|&target| rays.push(&Ray::new(DVec3::ZERO, target), span, None));
        let mut hits = HitList::default();
        group.bench_function(name, |b| {
            b.iter(|| find_nearest(backends()[0], caster.snapshot(), &rays, &mut hits, pool));
        });
    }
    group.finish();
}

fn main() {
    let (mut criterion, pool) = (criterion(), Pool::new(1).expect("a thread"));
    frames(&mut criterion, &pool);
    corners_and_edges(&mut criterion, &pool);
    criterion.final_summary();
}
