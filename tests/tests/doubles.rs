//! Is what lies twice in one place met once, by every backend, as if it lay there once?

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::light::{AmbientLight, DirectionalLight};
use catoptra_core::material::Matte;
use catoptra_core::{Camera, Geometry, MeshSource, Placement, Ray, Rgb, Scene, TriangleMesh};
use catoptra_lab::scenes::ball_mesh;
use catoptra_tests::assert_same_bits;
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{Control, Film, Pool, Size, Snapshot, SurfaceId, View, backends, render};

fn pool() -> Pool {
    Pool::new(2).expect("a pool of threads")
}

/// A ball of triangles, once, and with every triangle twice more: backwards, and with its corners in another order.
fn balls() -> [Mesh; 2] {
    let ball = ball_mesh(8);
    let once = ball.triangles();
    let again = once.triangles().iter().rev().map(|[a, b, c]| [*c, *a, *b]);
    let turned = once.triangles().iter().map(|[a, b, c]| [*b, *a, *c]);
    let all = once.triangles().iter().copied().chain(again).chain(turned).collect();
    let thrice = TriangleMesh::new(once.positions().to_vec(), all, None, None).expect("a mesh");
    let source = |mesh: &TriangleMesh| MeshSource { path: String::new(), mesh: mesh.clone().into() };
    [
        source(
            &TriangleMesh::new(once.positions().to_vec(), once.triangles().to_vec(), None, None)
                .expect("a mesh"),
        ),
        source(&thrice),
    ]
    .map(Mesh::new)
}

fn scene_of(meshes: &[Mesh]) -> Scene {
    let mut scene = Scene::new();
    let clay = scene.add_material("clay", Matte::new(Rgb::grey(0.6)).expect("a matte")).expect("a material");
    for (mesh, number) in meshes.iter().zip(0..) {
        scene.add_shape(&format!("mesh {number}"), mesh.clone(), clay, None).expect("a shape");
    }
    scene.add_light("sky", AmbientLight::new(Rgb::grey(0.1)).expect("a light"), None).expect("a light");
    let sun = DirectionalLight::new(DVec3::new(-1.0, -2.0, -1.5), Rgb::grey(2.0)).expect("a light");
    scene.add_light("sun", sun, None).expect("a light");
    scene
}

/// Rays from within and without to every corner, to the middle of every edge and of every triangle; then those that leave the
/// triangles, each named `named` of the triangle's number.
fn rays(mesh: &Mesh, count: u32, named: impl Fn(u32) -> SurfaceId) -> RayList {
    let mut rays = RayList::new();
    for triangle in 0..count {
        let [a, b, c] = mesh.triangles().corners(triangle).map(|p| mesh.placement().point(p));
        let middle = (a + b + c) / 3.0;
        for at in [a, a.midpoint(b), middle] {
            for eye in [DVec3::ZERO, DVec3::new(0.1, 0.2, -0.1), DVec3::new(3.0, 1.0, 2.0)] {
                rays.push(&Ray::new(eye, at - eye), [0.0, f64::INFINITY], None);
            }
        }
        for way in [middle, -middle, DVec3::new(0.3, 1.0, 0.2)] {
            rays.push(&Ray::new(middle, way), [0.0, f64::INFINITY], Some(named(triangle)));
        }
    }
    rays
}

/// Every backend answers alike about the rays in both scenes.
fn assert_met_alike(once: (&Scene, &RayList), more: (&Scene, &RayList), what: &str) {
    let pool = pool();
    for backend in backends() {
        let answer = |(scene, rays): (&Scene, &RayList)| {
            let snapshot = Snapshot::extract(scene, &pool);
            let (mut hits, mut occluded) = (HitList::default(), Vec::new());
            find_nearest(*backend, &snapshot, rays, &mut hits, &pool);
            find_occluded(*backend, &snapshot, rays, &mut occluded, &pool);
            (hits, occluded)
        };
        let ((hits, occluded), (others, other_occluded)) = (answer(once), answer(more));
        for at in 0..once.1.len() {
            assert_eq!(hits.get(at), others.get(at), "{what}, {}: ray {at}", backend.name());
        }
        assert_eq!(occluded, other_occluded, "{what}, {}", backend.name());
    }
}

#[test]
fn repeated_triangles_are_met_once() {
    let turn = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::X, 0.7).expect("a turn");
    for placement in [Placement::IDENTITY, turn] {
        let [once, thrice] = balls().map(|ball| ball.placed(&placement));
        let count = once.pieces();
        let first = rays(&once, count, |facet| SurfaceId { prim: 0, facet });
        let last = rays(&once, count, |facet| SurfaceId { prim: 0, facet: 2 * count + facet });
        let [once, thrice] = [once, thrice].map(|mesh| scene_of(&[mesh]));
        assert_met_alike((&once, &first), (&thrice, &first), "leaving the first");
        assert_met_alike((&once, &first), (&thrice, &last), "leaving the last");
    }
}

#[test]
fn a_mesh_that_stands_twice_in_one_place_is_met_once() {
    let [ball, _] = balls();
    let count = ball.pieces();
    let [first, second] = [0, 1].map(|prim| rays(&ball, count, |facet| SurfaceId { prim, facet }));
    let (once, twice) = (scene_of(std::slice::from_ref(&ball)), scene_of(&[ball.clone(), ball]));
    assert_met_alike((&once, &first), (&twice, &first), "leaving the first");
    assert_met_alike((&once, &first), (&twice, &second), "leaving the second");
}

#[test]
fn pictures_of_what_lies_twice_are_those_of_one() {
    let [ball, thrice] = balls();
    let scenes = [&[ball.clone()][..], &[ball.clone(), ball], &[thrice]].map(scene_of);
    let camera = Camera::look_at(DVec3::new(0.0, 1.2, 4.0), DVec3::ZERO, DVec3::Y, 0.7).expect("a camera");
    let (view, pool) = (View::new(camera, Size::new(96, 64)), pool());
    for backend in backends() {
        let films = scenes.each_ref().map(|scene| {
            let mut film = Film::new(view.size);
            let snapshot = Snapshot::extract(scene, &pool);
            render(*backend, &snapshot, &view, &mut film, &pool, &Control::default()).expect("a picture");
            film
        });
        let [once, rest @ ..] = &films;
        assert!((0..96).any(|x| once.surface(x, 32).is_some()), "the ball is seen");
        for other in rest {
            assert_same_bits(once, other, backend.name());
        }
    }
}
