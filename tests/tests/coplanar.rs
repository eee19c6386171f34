//! Do triangles of a mesh that overlap in one plane look like that plane, to every backend, and is its order the same however it is
//! worked out?

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::light::{DirectionalLight, PointLight};
use catoptra_core::material::Matte;
use catoptra_core::{Camera, MeshSource, Ray, Rgb, Scene, TriangleMesh};
use catoptra_tests::{assert_same_bits, picture, traced};
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{Film, Pool, Size, Skip, Snapshot, SurfaceId, View, backends};

const SIZE: Size = Size::new(96, 64);

/// Along a tilted plane, and away from it: whole eighths, so that `f32` holds every corner and all lie in it exactly.
const ALONG: [DVec3; 2] = [DVec3::new(3.0, 1.0, 0.0), DVec3::new(-1.0, 2.0, 2.0)];
const AWAY: DVec3 = DVec3::new(2.0, -6.0, 7.0);

/// A point of the plane, 32 steps along it at most.
fn in_plane([x, y]: [i32; 2]) -> DVec3 {
    (ALONG[0] * f64::from(x) + ALONG[1] * f64::from(y)) / 8.0
}

/// Numbers below 2³², evenly spread (SplitMix64: Steele, Lea and Flood 2014).
fn random(state: &mut u64) -> u32 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ *state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (((z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb)) >> 32) as u32
}

/// So many triangles strewn over a square of two, which are the last, all in the plane.
fn mass(count: u32) -> Mesh {
    let mut state = 3;
    let mut step = |reach: i32| (random(&mut state) % (2 * reach as u32 + 1)) as i32 - reach;
    let mut places: Vec<[i32; 2]> = Vec::new();
    for _ in 0..count {
        let [x, y] = [step(24), step(24)];
        places.extend([[x, y], [x + step(8), y + step(8)], [x + step(8), y + step(8)]]);
    }
    let square = [[-32, -32], [32, -32], [32, 32], [-32, 32]];
    places.extend(square);
    let triangles = (0..count).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]);
    let halves = [[0, 1, 2], [0, 2, 3]].map(|half| half.map(|corner| 3 * count + corner));
    let positions = places.into_iter().map(|at| in_plane(at).as_vec3().to_array()).collect();
    let mesh = TriangleMesh::new(positions, triangles.chain(halves).collect(), None, None).expect("a mesh");
    Mesh::new(MeshSource { path: String::new(), mesh: mesh.into() })
}

/// A mass of triangles under a lamp and a sun.
fn scene(count: u32) -> Scene {
    let mut scene = Scene::new();
    let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.6)).expect("a matte")).expect("a material");
    scene.add_shape("mass", mass(count), clay, None).expect("a shape");
    let lamp = PointLight::new(AWAY + DVec3::X, Rgb::grey(60.0)).expect("a light");
    scene.add_light("lamp", lamp, None).expect("a light");
    let sun = DirectionalLight::new(-AWAY + ALONG[0], Rgb::grey(1.0)).expect("a light");
    scene.add_light("sun", sun, None).expect("a light");
    scene
}

fn view() -> View {
    let camera = Camera::look_at(AWAY * 1.5 + ALONG[1], DVec3::ZERO, DVec3::Y, 0.8).expect("a camera");
    View::new(camera, SIZE)
}

#[test]
fn a_mass_in_one_plane_looks_like_the_plane() {
    let (plane, mass) = (scene(0), scene(400));
    for backend in backends() {
        let [alone, strewn] =
            [&plane, &mass].map(|scene| picture(&traced(scene, backend.name(), &view(), Film::new(SIZE), 2)));
        assert!(alone.pixels().iter().filter(|pixel| pixel[0] > 0.0).count() > 2000);
        for (at, (one, all)) in alone.pixels().iter().zip(strewn.pixels()).enumerate() {
            let near = one.iter().zip(all).all(|(one, all)| (one - all).abs() <= 1e-3 * one);
            assert!(near, "{}: pixel {at} shows {all:?} and not {one:?}", backend.name());
        }
    }
}

/// Rays to the plane from both sides, steeply and flatly, and from points of its triangles in all directions.
fn rays(mesh: &Mesh) -> RayList {
    let (mut rays, mut state) = (RayList::new(), 5);
    let mut number = |reach: f64| reach * (f64::from(random(&mut state)) / f64::from(1_u32 << 31) - 1.0);
    let everywhere = [0.0, f64::INFINITY];
    for triangle in (0..mesh.triangles().triangles().len() as u32).cycle().take(1500) {
        let [a, b, c] = mesh.triangles().corners(triangle);
        let at = a + (b - a) * number(0.5).abs() + (c - a) * number(0.5).abs();
        let along = ALONG[0] * number(1.0) + ALONG[1] * number(1.0);
        for eye in [AWAY, -AWAY, AWAY * 0.01 + along] {
            rays.push(&Ray::new(eye, at - eye), everywhere, None);
        }
        let left = Some(SurfaceId { prim: 0, facet: triangle });
        for way in [AWAY, AWAY * 1e-6 - along, along - AWAY * 1e-15] {
            rays.push(&Ray::new(at, way), everywhere, left);
        }
    }
    rays
}

#[test]
fn every_backend_meets_the_same_of_a_mass_however_often_it_is_asked() {
    let pool = Pool::new(2).expect("a pool of threads");
    let (scene, rays) = (scene(400), rays(&mass(400)));
    let snapshot = Snapshot::extract(&scene, &pool);
    let ask = |backend| {
        let (mut hits, mut occluded) = (HitList::default(), Vec::new());
        find_nearest(backend, &snapshot, &rays, &mut hits, &pool);
        find_occluded(backend, &snapshot, &rays, &mut occluded, &pool);
        let hits: Vec<_> = (0..rays.len()).map(|at| hits.get(at)).collect();
        (hits, occluded)
    };
    let by_name = |name: &str| *backends().iter().find(|backend| backend.name() == name).expect("a backend");
    let surfaces = |hits: &[Option<(SurfaceId, f64)>]| -> Vec<Option<SurfaceId>> {
        hits.iter().map(|hit| hit.map(|(surface, _)| surface)).collect()
    };
    let first = ask(by_name("wide"));
    for name in ["scalar", "oracle"] {
        let other = ask(by_name(name));
        assert_eq!(surfaces(&first.0), surfaces(&other.0), "{name}");
        assert_eq!(first.1, other.1, "{name}");
    }
    for _ in 0..20 {
        assert!(first == ask(by_name("wide")));
    }
    for at in (0..rays.len()).filter(|at| at % 6 > 2) {
        assert_eq!(first.0[at], None, "what leaves the plane meets nothing else");
    }
}

#[test]
fn the_order_in_a_plane_is_the_same_where_its_number_is_not_known() {
    let scene = scene(3000);
    let usual = traced(&scene, "wide", &view(), Film::new(SIZE), 2);
    for skip in [Skip { planes: false, ..Skip::ALL }, Skip { planes: true, ..Skip::NOTHING }, Skip::NOTHING] {
        let long = traced(&scene, "wide", &View { skip, ..view() }, Film::new(SIZE), 2);
        assert_same_bits(&usual, &long, &format!("{skip:?}"));
    }
}
