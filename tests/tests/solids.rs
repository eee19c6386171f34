//! Are solids made of others met alike by every backend, and do they show what they should?

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::{PI, TAU};

use catoptra_core::glam::DVec3;
use catoptra_core::{Edit, Operation, Ray, Scene};
use catoptra_tests::{assert_same_bits, camera_of, parsed, parsed_in, scene_file, traced};
use catoptra_tracer::query::{RayList, find_nearest, find_occluded};
use catoptra_tracer::{Film, Hit, Instructions, Pool, Size, Snapshot, View, backends};

const SCENE: &str = "camera \"c\" { eye 0 3 8; target 0 0.7 0; fov 40 }\nchecker \"tiles\" { scale 0.7 }\n\
    matte \"red\" { color 0.8 0.2 0.15; reflectiveness 0.1 }\nmatte \"blue\" { color 0.2 0.3 0.8 }\nphong \"yellow\" { diffuse 0.7 0.6 0.1 }\n\
    plane \"floor\" material=\"tiles\"\n\
    difference \"die\" {\n intersection \"rounded\" {\n  box \"cube\" material=\"red\" { min -0.8 0 -0.8; max 0.8 1.6 0.8 }\n\
      sphere \"corners\" material=\"yellow\" { center 0 0.8 0; radius 1.12 }\n }\n\
     sphere \"pip\" material=\"blue\" { center 0 1.65 0; radius 0.45 }\n sphere \"pip 2\" material=\"blue\" { center 0 0.8 0.9; radius 0.4 }\n\
     turn 25 0 1 0\n move -1.6 0 0\n}\n\
    union \"steps\" {\n box \"s1\" material=\"blue\" { min 0 0 0; max 1 0.5 1 }\n box \"s2\" material=\"red\" { min 1 0 0; max 2 0.5 1 }\n\
     box \"s3\" material=\"red\" { min 1 0.5 0; max 2 1 1 }\n tetrahedron \"t\" material=\"yellow\" { a 0 0.5 0; b 1 0.5 0; c 0 0.5 1; d 0 1.5 0 }\n}\n\
    intersection \"dome\" {\n sphere \"ball\" material=\"yellow\" { center 3.2 0 -1; radius 0.9 }\n plane \"cut\" material=\"blue\" { point 0 0.6 0; normal 0 1 0 }\n}\n\
    point-light \"p\" { position 3 6 5; intensity 40 }\nambient-light \"a\" { radiance 0.2 }";

/// Members with several stretches on a ray: a ring, a star and a mesh.
const CONCAVE: &str = "difference \"bitten ring\" {\n torus \"ring\" material=\"blue\" { center 0 2 -2; major 1; minor 0.3 }\n\
     box \"bite\" material=\"red\" { min 0 1 -2; max 2 3 0 }\n}\n\
    intersection \"medal\" {\n prism \"star\" material=\"yellow\" { point 1 0; point 0.3 0.3; point 0 1; point -0.3 0.3; point -1 0; point -0.3 -0.3; \
      point 0 -1; point 0.3 -0.3; height 0.5; from -2 2 -2 }\n sphere \"round\" material=\"red\" { center -2 2 -2; radius 0.8 }\n}\n\
    difference \"cut knot\" {\n mesh \"knot\" material=\"red\" { file \"meshes/knot.ply\"; scale 0.5; move 0 2 2 }\n\
     plane \"halving\" material=\"blue\" { point 0 2 2; normal 1 1 0 }\n}\n";

/// Numbers from -1 to 1 that look random (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }

    /// A point of a coarse lattice, so that rays run along faces, through edges and corners.
    fn lattice(&mut self) -> DVec3 {
        (self.vector() * 8.0).round() / 2.0
    }
}

#[test]
fn every_backend_meets_what_the_search_without_trees_meets() {
    let pool = Pool::new(2).unwrap();
    let scene = parsed_in(Some(&scene_file("gallery")), &format!("{SCENE}\n{CONCAVE}"));
    let snapshot = Snapshot::extract(&scene, &pool);
    let (mut numbers, mut rays, mut list) = (Numbers(1), Vec::new(), RayList::new());
    for at in 0..50_000 {
        let ray = match at % 2 {
            0 => Ray::new(numbers.vector() * 4.0, numbers.vector()),
            _ => Ray::new(numbers.lattice(), numbers.lattice()),
        };
        if ray.direction != DVec3::ZERO {
            list.push(&ray, [0.0, f64::INFINITY], None);
            rays.push(ray);
        }
    }
    let span = catoptra_core::Span::FROM_ORIGIN;
    let right: Vec<Option<Hit>> =
        rays.iter().map(|ray| snapshot.nearest_of_all_in_frame(&snapshot.own_ray(ray), span, None)).collect();
    assert!(right.iter().flatten().count() > 12_000);
    for backend in backends() {
        let (mut hits, mut occluded) = (Default::default(), Vec::new());
        find_nearest(*backend, &snapshot, &list, &mut hits, &pool);
        find_occluded(*backend, &snapshot, &list, &mut occluded, &pool);
        for (at, right) in right.iter().enumerate() {
            let found = hits.get(at).map(|hit| hit.0);
            assert_eq!(found, right.map(|hit| hit.surface), "{} {:?}", backend.name(), rays[at]);
            assert_eq!(occluded[at], right.is_some(), "{} {:?}", backend.name(), rays[at]);
        }
    }
}

#[test]
fn bits_depend_on_neither_tiles_nor_threads_nor_instructions() {
    let (scene, size) = (parsed(SCENE), Size::new(70, 50));
    let view = View { samples: 2, ..View::of(&scene, camera_of(&scene), size) };
    let reference = traced(&scene, "wide", &view, Film::new(size), 1);
    for (tile, threads) in [(8, 1), (64, 3)] {
        let film = traced(&scene, "wide", &view, Film::with_tiles(size, tile), threads);
        assert_same_bits(&reference, &film, &format!("tiles of {tile}"));
    }
    for instructions in Instructions::all() {
        let view = View { instructions: Some(instructions), ..view.clone() };
        assert_same_bits(&reference, &traced(&scene, "wide", &view, Film::new(size), 2), instructions.name());
    }
}

/// What is seen straight down on a place of the floor plan.
fn seen_at(scene: &Scene, x: f64, z: f64) -> [f32; 3] {
    let text = format!("camera \"down\" {{ eye {x} 5 {z}; direction 0 -1 0; up 0 0 -1; fov 0.01 }}");
    let camera = camera_of(&parsed(&text));
    let size = Size::new(1, 1);
    traced(scene, "wide", &View::of(scene, camera, size), Film::new(size), 1).radiance(0, 0)
}

#[test]
fn solids_made_of_glass_are_filled_like_whole_ones() {
    // A ball cut in half and put together again, of glass that tints and does not bend.
    let scene = |ball: &str| {
        parsed(&format!(
            "glass \"g\" {{ ior 1; tint 0.5 0.25 1; tint-distance 1 }}\nemissive \"e\" {{ radiance 1 }}\nplane \"floor\" material=\"e\" {{ point 0 -3 0 }}\n{ball}"
        ))
    };
    let whole = scene("sphere \"s\" material=\"g\" { center 0 0 0; radius 1 }");
    let halves = scene(
        "union \"u\" {\n difference \"left\" {\n  sphere \"a\" material=\"g\" { center 0 0 0; radius 1 }\n  plane \"p\" material=\"g\" { normal -1 0 0 }\n }\n\
         difference \"right\" {\n  sphere \"b\" material=\"g\" { center 0 0 0; radius 1 }\n  plane \"q\" material=\"g\" { normal 1 0 0 }\n }\n}",
    );
    for (x, z) in [(0.3, 0.2), (-0.4, 0.1), (0.7, -0.3), (1.2, 0.0)] {
        let [one, other] = [&whole, &halves].map(|scene| seen_at(scene, x, z));
        assert!(one.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-5), "{x} {z}: {one:?} {other:?}");
    }
}

#[test]
fn a_changed_part_changes_the_whole_solid() {
    let mut scene = parsed(SCENE);
    let pool = Pool::new(2).unwrap();
    let earlier = Snapshot::extract(&scene, &pool);
    let die = scene.entity_named("die").unwrap();
    assert_eq!(scene.operation(die), Some(Operation::Difference));
    let back = scene.apply(Edit::Operation(die, Operation::Union)).unwrap();
    let (later, diff) = Snapshot::after(&scene, &earlier, &pool);
    let members = ["cube", "corners", "pip", "pip 2"].map(|name| scene.entity_named(name).unwrap());
    assert_eq!(diff.shapes.iter().map(|shape| shape.entity).collect::<Vec<_>>(), members);
    let ray = Ray::new(DVec3::new(-1.6, 9.0, 0.0), DVec3::NEG_Y);
    let span = catoptra_core::Span::AHEAD;
    let [cut, whole] =
        [&earlier, &later].map(|snapshot| snapshot.nearest_in_frame(&ray, span, None).unwrap().crossing.t);
    assert!((cut - 7.8).abs() < 1e-12 && (whole - 6.9).abs() < 1e-12, "{cut} {whole}");
    scene.apply(back).unwrap();
    let open = catoptra_core::geometry::Disk::new(DVec3::ZERO, DVec3::Y, 1.0).unwrap();
    let refused = scene.apply(Edit::Shape(members[2], open.into())).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "\"pip\" cannot be a part of the solid \"die\": only planes, closed shapes and other solids can"
    );
}

#[test]
fn the_edge_of_shade_is_round_on_a_mesh_that_is_subdivided() {
    // The largest step from pixel to pixel where a ball of few triangles turns from the light.
    let step = |levels: u32| {
        let text = format!(
            "camera \"c\" {{ eye 0 0 6; target 0 0 0; fov 20 }}\nmatte \"m\" {{ color 1 1 1 }}\n\
             mesh \"ball\" material=\"m\" {{ file \"ball.obj\"; subdivision {levels} }}\ndirectional-light \"sun\" {{ direction -1 -0.3 0; irradiance 3 }}"
        );
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("ball.obj"), ball()).unwrap();
        let scene = parsed_in(Some(folder.path()), &text);
        let size = Size::new(96, 96);
        let film = traced(&scene, "wide", &View::of(&scene, camera_of(&scene), size), Film::new(size), 1);
        let light = |x: u32, y: u32| f64::from(film.radiance(x, y)[0]);
        let inside = |x: u32, y: u32| (f64::from(x) - 47.5).hypot(f64::from(y) - 47.5) < 20.0;
        let pixels = (0..95).flat_map(|y| (0..95).map(move |x| (x, y))).filter(|&(x, y)| inside(x, y));
        pixels.map(|(x, y)| (light(x + 1, y) - light(x, y)).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (step(0), step(4));
    println!("{coarse} {fine}");
    assert!(coarse > 0.05 && fine < coarse / 2.0, "{coarse} {fine}");
}

/// A ball of 144 triangles with normals, as OBJ.
fn ball() -> String {
    let (rows, columns) = (7, 12);
    let corner = |row: u32, column: u32| {
        let (polar, around) =
            (PI * f64::from(row) / f64::from(rows), TAU * f64::from(column) / f64::from(columns));
        DVec3::new(polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin())
    };
    let corners = (0..=rows).flat_map(|row| (0..columns).map(move |column| corner(row, column)));
    let line = |p: DVec3| format!("v {} {} {}\nvn {} {} {}\n", p.x, p.y, p.z, p.x, p.y, p.z);
    let number = |row: u32, column: u32| row * columns + column % columns + 1;
    let faces = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let face = |(row, column): (u32, u32)| {
        let [a, b, c, d] = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
            .map(|(row, column)| number(row, column));
        format!("f {a}//{a} {b}//{b} {c}//{c}\nf {a}//{a} {c}//{c} {d}//{d}\n")
    };
    corners.map(line).chain(faces.map(face)).collect()
}
