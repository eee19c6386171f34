//! Does every backend answer questions about single rays as the exhaustive one does, and refuse what is no ray?

use catoptra_core::geometry::{Cuboid, Disk, Mesh, Rectangle, Sphere, Tetrahedron, Triangle};
use catoptra_core::glam::DVec3;
use catoptra_core::material::Matte;
use catoptra_core::{
    Geometry, MaterialId, MeshSource, Placement, Ray, Rgb, Scene, Shape, Span, TriangleMesh,
};
use catoptra_tests::{parsed, shipped_scenes};
use catoptra_tracer::query::{HitList, RayList, find_nearest, find_occluded};
use catoptra_tracer::{Pool, Preset, Snapshot, SurfaceId, backend_named, backends};

/// Numbers from -1 to 1 that look random (xorshift, Marsaglia 2003).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

fn pool(threads: usize) -> Pool {
    Pool::new(threads).expect("a pool of threads")
}

fn random_rays(count: usize) -> RayList {
    let mut numbers = Numbers(88_172_645_463_325_252);
    let mut rays = RayList::new();
    for at in 0..count {
        let ray = Ray::new(numbers.vector() * 6.0, numbers.vector());
        let ends = match at % 3 {
            0 => [0.0, f64::INFINITY],
            1 => [0.0, 5.0 * numbers.next().abs()],
            _ => [3.0 * numbers.next().abs(), 9.0],
        };
        rays.push(&ray, ends, None);
    }
    rays
}

fn nearest(backend: &str, snapshot: &Snapshot, rays: &RayList) -> HitList {
    let mut hits = HitList::default();
    let backend = backend_named(backend).expect("a backend of that name");
    find_nearest(backend, snapshot, rays, &mut hits, &pool(2));
    hits
}

#[test]
fn every_backend_meets_what_the_oracle_meets() {
    let rays = random_rays(1000);
    for (name, scene) in shipped_scenes() {
        let snapshot = Snapshot::extract(&scene, &pool(2));
        let right = nearest("oracle", &snapshot, &rays);
        for backend in backends() {
            let found = nearest(backend.name(), &snapshot, &rays);
            let mut occluded = Vec::new();
            find_occluded(*backend, &snapshot, &rays, &mut occluded, &pool(2));
            for (at, &occluded) in occluded.iter().enumerate() {
                let (a, b) = (right.get(at), found.get(at));
                assert_eq!(a.map(|h| h.0), b.map(|h| h.0), "{name} {} ray {at}", backend.name());
                let (a, b) = (a.map_or(0.0, |h| h.1), b.map_or(0.0, |h| h.1));
                assert!((a - b).abs() <= 1e-12 * a.abs(), "{name} {} ray {at}: {a} {b}", backend.name());
                assert_eq!(right.get(at).is_some(), occluded, "{name} {} ray {at}", backend.name());
            }
        }
    }
}

const BALL: &str = "matte \"grey\" { color 0.5 0.5 0.5 }\nsphere \"ball\" material=\"grey\" { radius 1 }";

#[test]
fn both_ends_of_a_stretch_belong_to_it() {
    let snapshot = Snapshot::extract(&parsed(BALL), &pool(2));
    let mut rays = RayList::new();
    let ray = Ray::new(DVec3::Z * 3.0, -DVec3::Z);
    for ends in [[0.0, 2.0], [2.0, 2.0], [2.0, 9.0], [0.0, 1.999], [2.001, 9.0], [4.001, 9.0]] {
        rays.push(&ray, ends, None);
    }
    for backend in backends() {
        let hits = nearest(backend.name(), &snapshot, &rays);
        let t: Vec<f64> = (0..rays.len()).map(|at| hits.get(at).map_or(-1.0, |hit| hit.1)).collect();
        assert_eq!(t, [2.0, 2.0, 2.0, -1.0, 4.0, -1.0], "{}", backend.name());
    }
}

#[test]
fn a_surface_that_is_left_is_not_met_at_once() {
    let snapshot = Snapshot::extract(&parsed(BALL), &pool(2));
    let mut rays = RayList::new();
    rays.push(&Ray::new(DVec3::Z, DVec3::Z), [0.0, 9.0], Some(SurfaceId { prim: 0, facet: 0 }));
    rays.push(&Ray::new(DVec3::Z, -DVec3::Z), [0.0, 9.0], Some(SurfaceId { prim: 0, facet: 0 }));
    for backend in backends() {
        let hits = nearest(backend.name(), &snapshot, &rays);
        assert_eq!(hits.get(0), None, "{}", backend.name());
        assert_eq!(hits.get(1).unwrap().1, 2.0, "{}", backend.name());
    }
}

const SOLIDS: &str = r#"
matte "grey" { color 0.5 0.5 0.5 }
tetrahedron "wedge" material="grey" { a 0 0 0; b 2 0.1 0; c 0.3 1.7 0; d 0.2 0.4 1.9 }
box "block" material="grey" { min 3 0 0; max 4 1 2 }
sphere "ball" material="grey" { center 0 4 0; radius 1 }
group "turned" {
    turn 33 1 2 -1 { about 3 3 1 }
    box "plank" material="grey" { min 2.2 2.6 0; max 3.8 3.4 0.1 }
    disk "lid" material="grey" { center 3 3 0.9; normal 0 0 1; radius 0.8 }
}
"#;

/// Rays that leave the surfaces that random rays meet, in any direction: also nearly along a flat face.
fn leaving_rays(snapshot: &Snapshot, count: usize) -> RayList {
    let mut numbers = Numbers(88_172_645_463_325_252);
    let mut rays = RayList::new();
    while rays.len() < count {
        let target = DVec3::new(2.0, 2.0, 1.0) + numbers.vector() * 2.5;
        let from = target + numbers.vector() * 9.0;
        let ray = Ray::new(from, target - from);
        let Some(hit) = snapshot.nearest_of_all_in_frame(&ray, Span::AHEAD, None) else { continue };
        let along = hit.crossing.normal.cross(numbers.vector());
        let directions = [
            numbers.vector(),
            along,
            along + hit.crossing.normal * numbers.next() * 1e-7,
            along + hit.crossing.normal * numbers.next() * 1e-16,
        ];
        for direction in directions {
            rays.push(&Ray::new(ray.at(hit.crossing.t), direction), [0.0, f64::INFINITY], Some(hit.surface));
        }
    }
    rays
}

#[test]
fn rays_that_leave_solids_meet_what_the_oracle_meets() {
    let snapshot = Snapshot::extract(&parsed(SOLIDS), &pool(2));
    let rays = leaving_rays(&snapshot, 4000);
    let right = nearest("oracle", &snapshot, &rays);
    let again = (0..rays.len()).filter(|&at| right.get(at).is_some()).count();
    assert!((400..3600).contains(&again), "{again} meet anything");
    for backend in backends() {
        let found = nearest(backend.name(), &snapshot, &rays);
        for at in 0..rays.len() {
            let (a, b) = (right.get(at).map(|hit| hit.0), found.get(at).map(|hit| hit.0));
            assert_eq!(a, b, "{} ray {at}", backend.name());
        }
    }
}

#[test]
fn what_is_no_ray_meets_nothing() {
    let snapshot = Snapshot::extract(&parsed(BALL), &pool(2));
    let mut rays = RayList::new();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        rays.push(&Ray::new(DVec3::new(bad, 0.0, 3.0), -DVec3::Z), [0.0, 9.0], None);
        rays.push(&Ray::new(DVec3::Z * 3.0, DVec3::new(0.0, bad, -1.0)), [0.0, 9.0], None);
    }
    rays.push(&Ray::new(DVec3::ZERO, DVec3::ZERO), [0.0, 9.0], None);
    for backend in backends() {
        let hits = nearest(backend.name(), &snapshot, &rays);
        assert!((0..rays.len()).all(|at| hits.get(at).is_none()), "{}", backend.name());
    }
}

#[test]
fn rays_of_extreme_length_meet_what_ordinary_ones_do() {
    let snapshot = Snapshot::extract(&parsed(BALL), &pool(2));
    for scale in [1e-38, 1e-100, 1e30, 1e100] {
        let mut rays = RayList::new();
        rays.push(&Ray::new(DVec3::Z * 3.0, -DVec3::Z * scale), [0.0, f64::INFINITY], None);
        for backend in backends().iter().filter(|b| b.name() == "wide") {
            let hit = nearest(backend.name(), &snapshot, &rays).get(0);
            assert!(hit.is_some_and(|(_, t)| (t * scale - 2.0).abs() < 1e-12), "{scale:e} {hit:?}");
        }
    }
}

/// A mesh of triangles in random places of random sizes, many of them without area or in one place.
fn crowd(numbers: &mut Numbers, count: u32) -> TriangleMesh {
    let mut positions: Vec<[f32; 3]> = Vec::new();
    for id in 0..count {
        let (size, place) = (numbers.next().powi(2), numbers.vector());
        for corner in 0..3 {
            let own = if id % 7 == 0 { place } else { place + numbers.vector() * size };
            let shared = positions.len() > 9 && id % 3 == 0 && corner < 2;
            positions.push(if shared {
                positions[positions.len() - 5]
            } else {
                own.to_array().map(|v| v as f32)
            });
        }
    }
    let triangles = (0..count).map(|id| [3 * id, 3 * id + 1, 3 * id + 2]).collect();
    TriangleMesh::new(positions, triangles, None, None).expect("a mesh")
}

/// Long thin triangles across each other: trees that cut space have them in many leaves.
fn thicket(numbers: &mut Numbers, count: u32) -> TriangleMesh {
    let mut positions: Vec<[f32; 3]> = Vec::new();
    for _ in 0..count {
        let (a, b) = (numbers.vector(), numbers.vector());
        positions.extend([a, b, b + numbers.vector() * 0.02].map(|p| p.to_array().map(|v| v as f32)));
    }
    let triangles = (0..count).map(|id| [3 * id, 3 * id + 1, 3 * id + 2]).collect();
    TriangleMesh::new(positions, triangles, None, None).expect("a mesh")
}

/// Rays from one point, to one point, side by side, and without order; a third of them through corners, a third through edges.
fn aimed_rays(numbers: &mut Numbers, mesh: &Mesh, count: usize) -> RayList {
    let mut rays = RayList::new();
    let placed = |point: DVec3| mesh.placement().point(point);
    let [eye, lamp] = [DVec3::new(0.3, 0.5, 4.0), DVec3::new(-2.0, 3.0, 0.25)].map(placed);
    let sunwards = mesh.placement().vector(DVec3::new(0.4, -1.0, 0.3));
    let triangles = mesh.triangles();
    for at in 0..count {
        // Rays of a group meet neighbouring triangles, so that they stay together.
        let facet = (at / 40 * 7 % triangles.triangles().len()) as u32;
        let [a, b, c] = triangles.corners(facet).map(placed);
        let target = match at % 3 {
            0 => [a, b, c][at % 2],
            1 => a.lerp(b, numbers.next().abs()),
            _ => a + numbers.vector() * 0.1,
        };
        match at / 320 % 4 {
            0 => rays.push(&Ray::new(eye, target - eye), [0.0, f64::INFINITY], None),
            1 => rays.push(&Ray::new(target + numbers.vector() * 0.1, lamp - target), [0.0, 1.0], None),
            2 => {
                let ends = [0.2 * numbers.next().max(0.0), [1.0, f64::INFINITY][at % 2]];
                rays.push(&Ray::new(target - sunwards * numbers.next(), sunwards), ends, None);
            }
            _ => {
                let from = placed(numbers.vector() * 3.0);
                rays.push(&Ray::new(from, target - from), [0.1, 2.0], None);
            }
        }
    }
    rays
}

#[test]
fn meshes_of_any_kind_are_met_where_the_oracle_meets_them() {
    let mut numbers = Numbers(88_172_645_463_325_252);
    for mesh in [crowd(&mut numbers, 400), thicket(&mut numbers, 300)] {
        let source = MeshSource { path: String::new(), mesh: mesh.into() };
        all_meet_what_the_oracle_meets(&mut numbers, &source);
    }
}

/// From every preset's tree, placed and not.
fn all_meet_what_the_oracle_meets(numbers: &mut Numbers, source: &MeshSource) {
    let turned = Placement::IDENTITY.turned(DVec3::X, DVec3::new(0.3, 0.2, 0.1), 1.0).expect("a turn");
    let turned = turned.scaled(1.5).expect("a scale");
    for placement in [Placement::IDENTITY, turned] {
        let mesh = Mesh::new(source.clone()).placed(&placement);
        let rays = aimed_rays(numbers, &mesh, 5000);
        let mut scene = Scene::new();
        let grey = add_grey(&mut scene);
        scene.add_shape("mesh", mesh, grey, None).expect("a shape");
        for preset in Preset::ALL {
            let snapshot = Snapshot::extract_with(&scene, *preset, &pool(2));
            assert_met_as_by_the_oracle(&snapshot, &rays, preset.name());
        }
    }
}

fn add_grey(scene: &mut Scene) -> MaterialId {
    scene.add_material("grey", Matte::new(Rgb::grey(0.5)).expect("a colour")).expect("a material")
}

/// Metres from the origin to what is far from all else.
const FAR: [f64; 4] = [1e6, 1e9, 1e11, 1e13];

/// Turned, and moved so far.
fn far_placement(away: f64) -> Placement {
    let turned = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::new(0.3, 0.2, 0.1), 1.0).expect("a turn");
    turned.moved(DVec3::new(away, -0.7 * away, 0.3 * away)).expect("a move")
}

#[test]
fn meshes_far_from_all_else_are_met_where_the_oracle_meets_them() {
    let mut numbers = Numbers(88_172_645_463_325_252);
    let mesh = MeshSource { path: String::new(), mesh: thicket(&mut numbers, 300).into() };
    for away in FAR {
        let far = Mesh::new(mesh.clone()).placed(&far_placement(away));
        let rays = aimed_rays(&mut numbers, &far, 5000);
        let mut scene = Scene::new();
        let grey = add_grey(&mut scene);
        scene.add_shape("here", Mesh::new(mesh.clone()), grey, None).expect("a shape");
        scene.add_shape("there", far, grey, None).expect("a shape");
        assert_met_as_by_the_oracle(
            &Snapshot::extract(&scene, &pool(2)),
            &rays,
            &format!("{away:e} m away,"),
        );
    }
}

/// One of each other bounded kind, with a point within it.
fn shapes_apart() -> Vec<(DVec3, Shape)> {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let sphere = Sphere::new(x * 3.0, 1.0).expect("a sphere");
    let cuboid = Cuboid::new(x * -4.0, x * -3.0 + y + z).expect("a box");
    let tetrahedron = Tetrahedron::new(y * 3.0, y * 3.0 + x, y * 4.0, y * 3.0 + z).expect("a tetrahedron");
    let triangle = Triangle::new(y * -3.0, y * -3.0 + x, y * -3.0 + z).expect("a triangle");
    let rectangle = Rectangle::new(z * 3.0, x, y).expect("a rectangle");
    let disk = Disk::new(z * -3.0, z + x * 0.2, 1.0).expect("a disk");
    vec![
        (x * 3.0, sphere.into()),
        (x * -3.5 + (y + z) * 0.5, cuboid.into()),
        (y * 3.25 + (x + z) * 0.25, tetrahedron.into()),
        (y * -3.0 + (x + z) * 0.3, triangle.into()),
        (z * 3.0 + (x + y) * 0.5, rectangle.into()),
        (z * -3.0, disk.into()),
    ]
}

#[test]
fn shapes_far_from_all_else_are_met_where_the_oracle_meets_them() {
    let mut numbers = Numbers(88_172_645_463_325_252);
    let shapes = shapes_apart();
    for away in FAR {
        let far = far_placement(away);
        let mut scene = Scene::new();
        let grey = add_grey(&mut scene);
        scene
            .add_shape("here", Sphere::new(DVec3::ZERO, 1.0).expect("a sphere"), grey, None)
            .expect("a shape");
        for (at, (_, shape)) in shapes.iter().enumerate() {
            scene.add_shape(&format!("there {at}"), shape.placed(&far), grey, None).expect("a shape");
        }
        let mut rays = RayList::new();
        for at in 0..6000 {
            let from = far.point(numbers.vector() * 8.0);
            let to = far.point(shapes[at % shapes.len()].0 + numbers.vector());
            let ends = [[0.0, f64::INFINITY], [0.0, 1.0], [0.5, 2.0]][at / shapes.len() % 3];
            rays.push(&Ray::new(from, to - from), ends, None);
        }
        assert_met_as_by_the_oracle(
            &Snapshot::extract(&scene, &pool(2)),
            &rays,
            &format!("{away:e} m away,"),
        );
    }
}

/// By both other backends, first or at all.
fn assert_met_as_by_the_oracle(snapshot: &Snapshot, rays: &RayList, what: &str) {
    let right = nearest("oracle", snapshot, rays);
    for backend in ["scalar", "wide"] {
        let found = nearest(backend, snapshot, rays);
        let mut occluded = Vec::new();
        let tracing = backend_named(backend).expect("a backend of that name");
        find_occluded(tracing, snapshot, rays, &mut occluded, &pool(1));
        for (at, &occluded) in occluded.iter().enumerate() {
            let (a, b) = (right.get(at).map(|hit| hit.0), found.get(at).map(|hit| hit.0));
            assert_eq!(a, b, "{backend} {what} ray {at}");
            assert_eq!(a.is_some(), occluded, "{backend} {what} ray {at}");
        }
    }
}
