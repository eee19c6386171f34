//! Is what rays of the world meet told as it is, and what is no ray refused?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use catoptra_core::geometry::{Cuboid, Sphere};
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_core::light::SphereLight;
use catoptra_core::material::Matte;
use catoptra_core::{Edit, EntityId, Node, Placement, Rgb, Scene, TriangleMesh};

use catoptra_tracer::{Caster, InvalidRay, InvalidRays, Pool, RayColumns, SurfaceId, WorldRay};

fn pool() -> Pool {
    Pool::new(1).unwrap()
}

/// A ball of radius 1 at the origin and a box behind it, and their ids.
fn ball_and_box(away: DVec3) -> (Caster, [EntityId; 2]) {
    let mut scene = Scene::new();
    let grey = scene.add_material("grey", Matte::new(Rgb::grey(0.5)).unwrap()).unwrap();
    let ball = scene.add_shape("ball", Sphere::new(away, 1.0).unwrap(), grey, None).unwrap();
    let corner = away + DVec3::new(-1.0, -1.0, -5.0);
    let block = Cuboid::new(corner, corner + DVec3::new(2.0, 2.0, 1.0)).unwrap();
    let block = scene.add_shape("box", block, grey, None).unwrap();
    (Caster::from_scene(&scene).unwrap(), [ball, block])
}

#[test]
fn all_that_is_met_is_told_in_order() {
    for away in [DVec3::ZERO, DVec3::new(1e9, -3e9, 1e9)] {
        let (caster, [ball, block]) = ball_and_box(away);
        let ray = WorldRay::new(away + DVec3::Z * 4.0, DVec3::NEG_Z * 2.0).unwrap();
        let met: Vec<_> = caster.all(&ray).iter().map(|hit| (hit.entity, hit.t, hit.normal.z)).collect();
        assert_eq!(met, [(ball, 1.5, 1.0), (ball, 2.5, -1.0), (block, 4.0, 1.0), (block, 4.5, -1.0)]);
        assert_eq!(caster.count(&ray), 4);
        assert_eq!(caster.count(&ray.within([2.0, 4.0]).unwrap()), 2);
        let first = caster.nearest(&ray).unwrap();
        assert_eq!((first.entity, first.point), (ball, away + DVec3::Z));
        assert_eq!(Some(first.surface), caster.surface(ball, 0));
    }
}

#[test]
fn a_hit_that_is_known_is_told_as_one_that_is_found() {
    for away in [DVec3::ZERO, DVec3::new(1e9, -3e9, 1e9)] {
        let (caster, _) = ball_and_box(away);
        let ray = WorldRay::new(away + DVec3::Z * 4.0, DVec3::NEG_Z).unwrap();
        for hit in caster.all(&ray) {
            assert_eq!(caster.hit_on(&ray, hit.surface, hit.t), Some(hit));
        }
        assert_eq!(caster.hit_on(&ray, SurfaceId { prim: 2, facet: 0 }, 3.0), None);
    }
}

#[test]
fn texture_coordinates_of_a_lamp_turn_with_it() {
    let lamp = SphereLight::new(&Sphere::new(DVec3::ZERO, 1.0).unwrap(), Rgb::WHITE).unwrap();
    let mut scene = Scene::new();
    let id = scene.add_light("lamp", lamp, None).unwrap();
    let uv = |scene: &Scene, from: DVec3| {
        Caster::from_scene(scene).unwrap().nearest(&WorldRay::new(from, -from).unwrap()).unwrap().uv
    };
    let before = uv(&scene, DVec3::Z * 3.0);
    let quarter = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::Y, std::f64::consts::FRAC_PI_2).unwrap();
    scene.apply(Edit::Placement(id, quarter)).unwrap();
    assert!((uv(&scene, DVec3::X * 3.0) - before).length() < 1e-9);
    assert!((uv(&scene, DVec3::Z * 3.0) - before).length() > 0.1);
}

#[test]
fn a_mesh_stands_where_its_offset_says() {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let away = DVec3::new(0.1, 1e7, -3.0);
    let mesh = TriangleMesh::new(corners, vec![[0, 1, 2]], None, None).unwrap().with_offset(away);
    let caster = Caster::from_mesh(mesh).unwrap();
    let ray = WorldRay::new(away + DVec3::new(0.25, 0.25, 2.0), DVec3::NEG_Z).unwrap();
    assert_eq!(caster.nearest(&ray).map(|hit| hit.t), Some(2.0));
    assert!(!caster.any(&WorldRay::new(DVec3::new(0.25, 0.25, 2.0), DVec3::NEG_Z).unwrap()));
}

#[test]
fn a_ray_that_leaves_a_surface_meets_what_is_behind() {
    let (caster, [ball, block]) = ball_and_box(DVec3::ZERO);
    let left = caster.surface(ball, 0).unwrap();
    let ray = |direction: DVec3| WorldRay::new(direction, direction).unwrap().leaving(left);
    assert_eq!(caster.nearest(&ray(DVec3::NEG_Z)).unwrap().entity, block);
    assert!(!caster.any(&ray(DVec3::Z)) && caster.all(&ray(DVec3::X)).is_empty());
    let inwards = WorldRay::new(DVec3::Z, DVec3::NEG_Z).unwrap().leaving(left);
    assert_eq!(caster.nearest(&inwards).map(|hit| (hit.entity, hit.t)), Some((ball, 2.0)));
    assert_eq!(caster.surface(EntityId::from_index(9).unwrap(), 0), None);
}

#[test]
fn a_ray_that_leaves_an_entity_meets_it_nowhere() {
    for away in [DVec3::ZERO, DVec3::new(1e9, -3e9, 1e9)] {
        let (caster, [ball, block]) = ball_and_box(away);
        let ray = WorldRay::new(away + DVec3::Z * 4.0, DVec3::NEG_Z).unwrap();
        let met = |ray: &WorldRay| caster.all(ray).iter().map(|hit| hit.entity).collect::<Vec<_>>();
        assert_eq!(met(&ray.leaving_entity(ball)), [block; 2]);
        assert_eq!(met(&ray.leaving_entity(block)), [ball; 2]);
        assert_eq!(caster.nearest(&ray.leaving_entity(ball)).unwrap().t, 8.0);
        let beside = WorldRay::new(away + DVec3::Z * 4.0, DVec3::new(0.0, 0.2, -1.0)).unwrap();
        assert!(caster.any(&beside) && !caster.any(&beside.leaving_entity(ball)));

        let origins = vec![away + DVec3::Z * 4.0; 5000];
        let directions: Vec<_> = (0..5000).map(|i| DVec3::new(0.0, f64::from(i % 50) * 0.01, -1.0)).collect();
        let left: Vec<_> = (0..5000).map(|i| [Some(ball), Some(block), None][i % 3]).collect();
        let rays = RayColumns::new(&origins, &directions).unwrap().leaving_entities(&left).unwrap();
        let (hits, any) =
            (caster.nearest_many(&rays, &pool()).unwrap(), caster.any_many(&rays, &pool()).unwrap());
        for (at, hit) in hits.iter().enumerate() {
            let ray = rays.get(at).unwrap();
            let alone = caster.nearest(&ray);
            assert_eq!(ray.entity_left(), left[at]);
            assert_eq!(hit.map(|hit| hit.entity), alone.map(|hit| hit.entity), "{at}");
            assert!(hit.is_none() || hit.map(|hit| hit.entity) != left[at]);
            assert_eq!(any[at], alone.is_some(), "{at}");
        }
    }
}

#[test]
fn texture_coordinates_turn_with_the_shape() {
    let mut scene = Scene::new();
    let grey = scene.add_material("grey", Matte::new(Rgb::grey(0.5)).unwrap()).unwrap();
    let ball = Node::shape("ball", Sphere::new(DVec3::ZERO, 1.0).unwrap(), grey);
    let quarter = Placement::IDENTITY.turned(DVec3::ZERO, DVec3::Y, std::f64::consts::FRAC_PI_2).unwrap();
    let uv = |scene: &Scene| {
        let caster = Caster::from_scene(scene).unwrap();
        let hit = caster.nearest(&WorldRay::new(DVec3::X * 3.0, DVec3::NEG_X).unwrap()).unwrap();
        hit.uv
    };
    scene.apply(Edit::insert(ball)).unwrap();
    let before = uv(&scene);
    scene.apply(Edit::Placement(scene.entity_named("ball").unwrap(), quarter)).unwrap();
    assert!((uv(&scene).x - before.x).abs() > 0.2, "{before} {}", uv(&scene));
}

/// Two triangles that share an edge.
const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const HALVES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

#[test]
fn a_ray_through_a_shared_edge_meets_both_triangles() {
    let caster = Caster::from_triangles(&SQUARE, &HALVES).unwrap();
    let down = |x, y| WorldRay::new([x, y, 2.0], [0.0, 0.0, -1.0]).unwrap();
    let triangles = |ray: &WorldRay| caster.all(ray).iter().map(|hit| hit.triangle).collect::<Vec<_>>();
    assert_eq!(triangles(&down(0.5, 0.5)), [0, 1]);
    assert_eq!(triangles(&down(0.75, 0.5)), [0]);
    assert_eq!(caster.nearest(&down(0.25, 0.75)).unwrap().uv, DVec2::new(0.25, 0.5));
}

#[test]
fn what_a_ray_starts_on_it_does_not_meet() {
    let caster = Caster::from_triangles(&SQUARE, &HALVES).unwrap();
    let (origins, down) = ([[0.75, 0.5, 0.0]; 20], [[0.0, 0.0, -1.0]; 20]);
    let rays = RayColumns::new(&origins, &down).unwrap();
    assert_eq!(caster.nearest(&rays.get(0).unwrap()), None);
    let hits = caster.nearest_many(&rays, &pool()).unwrap();
    assert!((0..rays.len()).all(|at| hits.t(at).is_none()));
    assert_eq!(caster.any_many(&rays, &pool()).unwrap(), [false; 20]);
}

#[test]
fn bad_triangles_and_bad_rays_are_refused() {
    let none: [[u32; 3]; 0] = [];
    assert!(Caster::from_triangles(&SQUARE, &none).is_err());
    assert!(Caster::from_triangles(&SQUARE, &[[0, 1, 4]]).is_err());
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        assert!(
            Caster::from_triangles(&[[bad, 0.0, 0.0], [0.0; 3], [1.0; 3]], &[[0, 1, 2]]).is_err(),
            "{bad}"
        );
    }
    assert!(matches!(WorldRay::new([f64::NAN, 0.0, 0.0], DVec3::X), Err(InvalidRay::NotFinite)));
    assert!(matches!(WorldRay::new(DVec3::ZERO, DVec3::ZERO), Err(InvalidRay::NoDirection)));
    let ray = WorldRay::new(DVec3::ZERO, DVec3::X).unwrap();
    for ends in [[1.0, 0.5], [f64::NAN, 1.0], [0.0, f64::NAN], [-2.0, -1.0]] {
        assert!(matches!(ray.within(ends), Err(InvalidRay::Ends(..))), "{ends:?}");
    }
}

#[test]
fn of_many_rays_the_first_wrong_one_is_told() {
    let caster = Caster::from_triangles(&SQUARE, &HALVES).unwrap();
    let mut origins = vec![[0.5, 0.25, 1.0]; 5000];
    let down = vec![[0.0, 0.0, -1.0]; 5000];
    (origins[4990][0], origins[3000][2]) = (f64::NAN, f64::INFINITY);
    let rays = RayColumns::new(&origins, &down).unwrap();
    let wrong = InvalidRays::Ray { at: 3000, cause: InvalidRay::NotFinite };
    assert_eq!(caster.nearest_many(&rays, &pool()).err(), Some(wrong));
    assert_eq!(caster.any_many(&rays, &pool()), Err(wrong));
    let short = RayColumns::new(&origins, &down[1..]).err();
    assert_eq!(short, Some(InvalidRays::Lengths { origins: 5000, what: "directions", others: 4999 }));
    assert!(rays.within(&[[0.0, 1.0]]).is_err() && rays.leaving(&[None]).is_err());
}

#[test]
fn many_rays_are_answered_as_each_by_itself() {
    let (caster, [ball, _]) = ball_and_box(DVec3::ZERO);
    let left = caster.surface(ball, 0);
    // One in eleven starts on the ball and leaves it.
    let origin = |i: i32| match DVec3::new(f64::from(i % 60) * 0.05 - 1.5, 0.1, 3.0) {
        beside if i % 11 == 0 => beside.normalize(),
        beside => beside,
    };
    let origins: Vec<DVec3> = (0..3000).map(origin).collect();
    let directions: Vec<DVec3> = (0..3000).map(|i| DVec3::new(0.0, f64::from(i / 60) * 1e-2, -1.0)).collect();
    let ends: Vec<[f64; 2]> = (0..3000).map(|i| [0.0, 2.0 + f64::from(i % 7)]).collect();
    let leaving: Vec<_> = (0..3000).map(|i| left.filter(|_| i % 11 == 0)).collect();
    let rays = RayColumns::new(&origins, &directions).unwrap().within(&ends).unwrap();
    let rays = rays.leaving(&leaving).unwrap();
    let (hits, met) =
        (caster.nearest_many(&rays, &pool()).unwrap(), caster.any_many(&rays, &pool()).unwrap());
    for (at, hit) in hits.iter().enumerate() {
        let alone = caster.nearest(&rays.get(at).unwrap());
        assert_eq!(hit.map(|hit| hit.surface), alone.map(|hit| hit.surface), "ray {at}");
        assert_eq!(met[at], alone.is_some());
        let (Some(a), Some(b)) = (hit, alone) else { continue };
        assert!((a.t - b.t).abs() < 1e-14 && a.point.distance(b.point) < 1e-13);
        assert!(a.normal.distance(b.normal) < 1e-13 && a.uv.distance(b.uv) < 1e-13);
    }
    assert!(met.iter().any(|met| *met) && !met.iter().all(|met| *met));
}
