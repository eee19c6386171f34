//! Do rays of the world meet what they must: by formulas, by brute force, at every corner and edge, and in hard cases?

use catoptra_core::glam::DVec3;
use catoptra_lab::adversary::Random;
use catoptra_lab::scenes::icosphere;
use catoptra_tests::parsed;
use catoptra_tracer::{Caster, Pool, RayColumns, WorldRay};

fn pool() -> Pool {
    Pool::new(2).expect("threads")
}

fn corner(positions: &[[f32; 3]], number: u32) -> DVec3 {
    DVec3::from(positions[number as usize].map(f64::from))
}

/// Points on all edges of triangles, each edge once, its corners first.
fn on_edges(positions: &[[f32; 3]], triangles: &[[u32; 3]], random: &mut Random) -> Vec<DVec3> {
    let mut points: Vec<DVec3> = (0..positions.len() as u32).map(|at| corner(positions, at)).collect();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)].into_iter().filter(|(from, to)| from < to) {
            let [from, to] = [from, to].map(|&at| corner(positions, at));
            points.extend([0.5, random.between(0.0, 1.0)].map(|share| from.lerp(to, share)));
        }
    }
    points
}

#[test]
fn no_ray_from_inside_slips_through_a_corner_or_an_edge() {
    let (positions, triangles) = icosphere(6);
    assert_eq!(triangles.len(), 81_920);
    let caster = Caster::from_triangles(&positions, &triangles).expect("a caster");
    let mut random = Random::new(7);
    let targets = on_edges(&positions, &triangles, &mut random);
    for eye in [DVec3::ZERO, DVec3::new(0.1, -0.2, 0.05), random.point(0.5)] {
        let origins = vec![eye; targets.len()];
        let directions: Vec<DVec3> = targets.iter().map(|&target| target - eye).collect();
        let rays = RayColumns::new(&origins, &directions).expect("columns");
        let hits = caster.nearest_many(&rays, &pool()).expect("rays");
        let met = caster.any_many(&rays, &pool()).expect("rays");
        let missed = (0..hits.len()).filter(|&at| hits.t(at).is_none() || !met[at]).count();
        assert_eq!(missed, 0, "of {} rays from {eye}", targets.len());
        let off = (0..hits.len()).filter_map(|at| hits.t(at)).map(|t| (t - 1.0).abs()).fold(0.0, f64::max);
        assert!(off < 1e-4, "{off}");
        // One by one it is another search, in `f64`.
        for at in (0..targets.len()).step_by(97) {
            let alone = caster.nearest(&rays.get(at).expect("a ray"));
            assert_eq!(alone.map(|hit| hit.surface), hits.surface(at), "ray {at} from {eye}");
            assert!(caster.count(&rays.get(at).expect("a ray")) >= 1);
        }
    }
}

/// Where a ray meets a triangle's plane within it, by Cramer's rule (Möller, Trumbore 1997).
fn brute_force(ray: (DVec3, DVec3), [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (origin, direction) = ray;
    let (to_b, to_c, from_a) = (b - a, c - a, origin - a);
    let across = direction.cross(to_c);
    let determinant = to_b.dot(across);
    let u = from_a.dot(across) / determinant;
    let v = direction.dot(from_a.cross(to_b)) / determinant;
    let t = to_c.dot(from_a.cross(to_b)) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Triangles in random places, some of them large.
fn crowd(random: &mut Random, count: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut positions = Vec::new();
    for _ in 0..count {
        let (place, size) = (random.point(1.0), random.between(0.05, 1.0));
        positions.extend((0..3).map(|_| (place + random.point(size)).as_vec3().as_dvec3().to_array()));
    }
    (positions, (0..count).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect())
}

#[test]
fn small_meshes_are_met_as_by_brute_force_near_and_far() {
    let mut random = Random::new(11);
    let (near, triangles) = crowd(&mut random, 60);
    // What is added is a multiple of what the corners are rounded to, so that they stay what they are.
    for away in [DVec3::ZERO, DVec3::new(4096.0, -8192.0, 1_048_576.0) * 1024.0] {
        let positions: Vec<[f64; 3]> = near.iter().map(|&p| (DVec3::from(p) + away).to_array()).collect();
        let caster = Caster::from_triangles(&positions, &triangles).expect("a caster");
        let corners: Vec<[DVec3; 3]> = triangles
            .iter()
            .map(|corners| corners.map(|at| DVec3::from(positions[at as usize]) - away))
            .collect();
        let mut met = 0;
        for _ in 0..2000 {
            let from = away + random.point(3.0);
            let ray = (from - away, random.point(1.0) + away - from);
            let asked = WorldRay::new(from, ray.1).expect("a ray");
            let mut right: Vec<(f64, u32)> = corners
                .iter()
                .zip(0..)
                .filter_map(|(corners, at)| Some((brute_force(ray, *corners)?, at)))
                .collect();
            right.sort_by(|a, b| a.0.total_cmp(&b.0));
            let all = caster.all(&asked);
            let numbers: Vec<u32> = all.iter().map(|hit| hit.triangle).collect();
            assert_eq!(numbers, right.iter().map(|(_, at)| *at).collect::<Vec<_>>(), "{asked:?}");
            assert_eq!(caster.nearest(&asked), all.first().copied());
            assert_eq!((caster.any(&asked), caster.count(&asked)), (!right.is_empty(), right.len()));
            met += right.len();
            let tolerance = 1e-9 * (1.0 + away.length() * 1e-6);
            for (hit, (t, _)) in all.iter().zip(&right) {
                assert!((hit.t - t).abs() < tolerance, "{} {t}", hit.t);
            }
        }
        assert!(met > 2000, "{met}");
    }
}

#[test]
fn the_faces_of_a_solid_look_out_of_it_however_they_are_asked() {
    let shell = parsed(
        "matte \"m\" { color 0.5 }\ndifference \"shell\" {\n    sphere \"out\" material=\"m\" { radius 2 }\n    \
         sphere \"in\" material=\"m\" { radius 1 }\n}\n",
    );
    let caster = Caster::from_scene(&shell).expect("a caster");
    let ray = WorldRay::new(DVec3::Z * 5.0, DVec3::NEG_Z).expect("a ray");
    let all = caster.all(&ray);
    let met: Vec<(f64, f64)> = all.iter().map(|hit| (hit.t, hit.normal.z)).collect();
    assert_eq!(met, [(3.0, 1.0), (4.0, -1.0), (6.0, 1.0), (7.0, -1.0)]);
    for hit in &all {
        assert_eq!(caster.hit_on(&ray, hit.surface, hit.t).as_ref(), Some(hit));
    }
}

#[test]
fn numbers_that_f32_does_not_hold_are_rounded_round_their_middle() {
    let away = DVec3::new(6_378_137.123, -0.1, 1e7 + 0.3);
    let triangle = [DVec3::ZERO, DVec3::X * 0.3, DVec3::Y * 0.3].map(|p| (p + away).to_array());
    let caster = Caster::from_triangles(&triangle, &[[0, 1, 2]]).expect("a caster");
    let inside = away + DVec3::new(0.1, 0.1, 2.0);
    let hit = caster.nearest(&WorldRay::new(inside, DVec3::NEG_Z).expect("a ray")).expect("a hit");
    assert!((hit.point - (inside - DVec3::Z * 2.0)).length() < 1e-8, "{}", hit.point - away);
}
