//! Do pixels that outlines cross show what thousands of samples do, the same bits however the work is shared out?

use std::path::Path;

use catoptra_core::Scene;
use catoptra_core::glam::{DVec2, DVec3};
use catoptra_tests::{
    Comparison, Rates, assert_same_bits, assert_same_part, camera_of, is_by_chance, parsed, shipped_scenes,
    traced, triangles,
};
use catoptra_tracer::{Edges, Film, Instructions, Moments, Pattern, Region, Size, View, backends};

const SIZE: Size = Size::new(64, 48);

/// A camera and looks that the scenes share.
const LOOKS: &str = r#"
camera "eye" { eye 0.2 2.4 6; target 0 0.8 0; fov 45 }
matte "white" { color 0.8 }
matte "red" { color 0.8 0.2 0.1 }
checker "tiles" { scale 0.7 }
mirror "glass" { color 0.8 0.9 0.9 }
ambient-light "sky" { radiance 0.4 }
"#;

/// A scene, and how far from the mean of many samples its pixels may be: the root of the mean square, and one pixel.
type Case = (&'static str, &'static str, [f64; 2]);

const CASES: [Case; 7] = [
    (
        "shapes that meet",
        r#"
        plane "ground" material="white"
        sphere "ball" material="red" { center -0.4 0.7 0; radius 0.9 }
        sphere "other" material="white" { center 0.3 1.1 0.5; radius 0.6 }
        box "block" material="red" { min 1 0 -1; max 2 1.2 0.3 }
        tetrahedron "t" material="red" { a -2.5 -0.2 1; b -1.5 0 1.2; c -2 0 0; d -2 1.4 0.6 }
        disk "disk" material="white" { center 1.2 1.1 0; normal 0.3 1 0.4; radius 0.7 }
        triangle "leaf" material="white" { a -1 0.3 1; b 1 1.9 0.2; c 1.3 -0.2 0.7 }
        "#,
        [4e-4, 8e-3],
    ),
    (
        "thin things",
        r#"
        rectangle "blade" material="white" { corner -2 0.3 0; edge-u 4 0.3 0; edge-v -0.0012 0.016 0 }
        triangle "needle" material="white" { a -2 1.5 0.1; b 2.2 1.31 0.1; c 2.2 1.27 0.1 }
        sphere "mote" material="white" { center 0.61 2.13 0; radius 0.03 }
        disk "coin" material="red" { center -1.3 2.1 0; normal 0.1 1 0.4; radius 0.3 }
        "#,
        [1e-3, 2e-2],
    ),
    (
        "shadows",
        r#"
        plane "ground" material="white"
        box "block" material="red" { min 1 0.4 -1; max 2 1.2 0.3 }
        tetrahedron "t" material="red" { a -2.5 0 1; b -1.5 0 1.2; c -2 0 0; d -2 1.4 0.6 }
        disk "disk" material="white" { center 0.2 1.6 0.3; normal 0.3 1 0.2; radius 0.4 }
        rectangle "sheet" material="white" { corner -1.5 1.5 -1; edge-u 1.3 0.4 0; edge-v -0.140540541 0.456756757 0.6 }
        point-light "lamp" { position 3 6 4; intensity 60 55 50 }
        directional-light "sun" { direction 1 -2 -0.6; irradiance 1 }
        "#,
        [6e-4, 4e-2],
    ),
    (
        "the shadow of a ball",
        r#"
        plane "ground" material="white"
        sphere "ball" material="red" { center -0.4 0.9 0; radius 0.7 }
        point-light "lamp" { position 3 6 4; intensity 60 55 50 }
        directional-light "sun" { direction 1 -2 -0.6; irradiance 1 }
        "#,
        [4e-4, 8e-3],
    ),
    (
        "tiles",
        r#"
        plane "ground" material="tiles"
        box "block" material="tiles" { min 0.6 0 -1; max 1.9 1.2 0.3 }
        sphere "ball" material="red" { center -1.1 0.7 0; radius 0.7 }
        "#,
        [6e-3, 8e-2],
    ),
    (
        "a mirror",
        r#"
        plane "ground" material="tiles"
        rectangle "mirror" material="glass" { corner -2.5 0.2 -2; edge-u 4 0 -1; edge-v 0.047058824 2.5 0.18823529 }
        box "block" material="red" { min -0.6 0 -1; max 0.5 1 0.3 }
        triangle "leaf" material="white" { a 1 0.3 0; b 1.7 1.9 0.2; c 1.3 -0.2 0.7 }
        "#,
        [8e-3, 1.2e-1],
    ),
    (
        "round mirrors, and shadows on what is round",
        r#"
        plane "ground" material="white"
        sphere "chrome" material="glass" { center -1.1 0.8 0; radius 0.8 }
        sphere "ball" material="red" { center 0.9 0.6 0; radius 0.6 }
        sphere "small" material="red" { center 1.5 1.7 0.9; radius 0.3 }
        point-light "lamp" { position 3 6 4; intensity 60 55 50 }
        "#,
        [1e-2, 2e-1],
    ),
];

fn scene(things: &str) -> Scene {
    parsed(&format!("{LOOKS}{things}"))
}

fn view(scene: &Scene, size: Size) -> View {
    View { edges: Edges::Exact, samples: 1, ..View::of(scene, camera_of(scene), size) }
}

/// The root of the mean square of the differences, and the largest.
fn apart(a: &Film, b: &Film) -> [f64; 2] {
    let (a, b) = (a.radiances(), b.radiances());
    let differences: Vec<f64> =
        a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| f64::from(a - b).abs()).collect();
    let square = differences.iter().map(|d| d * d).sum::<f64>() / differences.len() as f64;
    [square.sqrt(), differences.iter().copied().fold(0.0, f64::max)]
}

#[test]
fn one_ray_a_piece_shows_what_thousands_of_samples_do() {
    for (name, things, most) in CASES {
        let scene = scene(things);
        let sampled =
            View { edges: Edges::Off, pattern: Pattern::Sobol, samples: 4096, ..view(&scene, SIZE) };
        let reference = traced(&scene, "wide", &sampled, Film::new(SIZE), 0);
        let plain = traced(&scene, "wide", &View { samples: 1, ..sampled }, Film::new(SIZE), 0);
        let [before, _] = apart(&plain, &reference);
        for backend in backends() {
            let found =
                apart(&traced(&scene, backend.name(), &view(&scene, SIZE), Film::new(SIZE), 0), &reference);
            println!("{name} by {}: {found:?}, one sample {before:.5}", backend.name());
            assert!(found[0] < most[0] && found[1] < most[1], "{name} by {}: {found:?}", backend.name());
            assert!(found[0] < before / 3.0, "{name} by {}: {found:?} for {before}", backend.name());
        }
    }
}

/// A triangle three thousandths of a pixel wide, which few samples meet.
#[test]
fn the_thinnest_of_things_is_seen() {
    let scene = scene(r#"triangle "hair" material="white" { a -3 0.5 0; b 3 1.7 0; c 3 1.7003 0 }"#);
    let film = traced(&scene, "wide", &view(&scene, SIZE), Film::new(SIZE), 1);
    let sum: f64 = film.radiances().iter().map(|light| f64::from(light[0])).sum();
    let camera = camera_of(&scene);
    let pixels = f64::from(SIZE.height) / 2.0 / (camera.fov() / 2.0).tan();
    let [a, b, c] = [[-3.0, 0.5], [3.0, 1.7], [3.0, 1.7003]].map(|[x, y]| {
        let way = DVec3::new(x, y, 0.0) - camera.eye();
        DVec2::new(way.dot(camera.right()), way.dot(camera.up())) * (pixels / way.dot(camera.forward()))
    });
    // A white of 0.8 under a sky of 0.4.
    let right = (b - a).perp_dot(c - a).abs() / 2.0 * 0.8 * 0.4;
    assert!((sum / right - 1.0).abs() < 1e-4, "{sum} {right}");
}

#[test]
fn pixels_that_no_outline_crosses_keep_their_bits() {
    let scene = scene(
        r#"plane "ground" material="white"; sphere "ball" material="red" { center 0 1 0; radius 0.5 }"#,
    );
    let exact = traced(&scene, "wide", &view(&scene, SIZE), Film::new(SIZE), 1);
    let plain = traced(&scene, "wide", &View { edges: Edges::Off, ..view(&scene, SIZE) }, Film::new(SIZE), 1);
    let mut changed = 0;
    for (x, y) in (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y))) {
        changed += u32::from(exact.radiance(x, y) != plain.radiance(x, y));
        assert_eq!(exact.surface(x, y), plain.surface(x, y));
        assert_eq!(exact.depth(x, y).to_bits(), plain.depth(x, y).to_bits());
    }
    assert!((60..250).contains(&changed), "{changed} pixels changed");
}

/// The cases, and shipped scenes that trees are walked for.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes: Vec<(String, Scene)> =
        CASES.iter().map(|(name, things, _)| ((*name).to_owned(), scene(things))).collect();
    scenes.extend(shipped_scenes().into_iter().filter(|(_, scene)| triangles(scene) < 1_000));
    scenes
}

/// A size that no tile divides.
const ODD: Size = Size::new(93, 57);

#[test]
fn bits_do_not_depend_on_how_the_work_is_shared_out() {
    for (name, scene) in scenes() {
        let view = View { moments: Moments::Luminance, ..view(&scene, ODD) };
        for backend in ["wide", "scalar"] {
            let usual = traced(&scene, backend, &view, Film::new(ODD), 1);
            for (edge, threads) in [(4, 2), (12, 3), (64, 1), (1024, 1)] {
                let tiled = traced(&scene, backend, &view, Film::with_tiles(ODD, edge), threads);
                assert_same_bits(&usual, &tiled, &format!("{name} by {backend} in tiles of {edge}"));
            }
            let crop = Region::new(17, 9, Size::new(41, 30));
            let part = View { crop: Some(crop), ..view.clone() };
            let film = traced(&scene, backend, &part, Film::of_region(crop, Film::TILE), 1);
            assert_same_part(&usual, &film, &format!("{name} by {backend}, a part"));
        }
        let usual = traced(&scene, "wide", &view, Film::new(ODD), 1);
        for instructions in Instructions::all() {
            let view = View { instructions: Some(instructions), ..view.clone() };
            let film = traced(&scene, "wide", &view, Film::new(ODD), 1);
            assert_same_bits(&usual, &film, &format!("{name} with {instructions:?}"));
        }
    }
}

#[test]
fn every_backend_shows_the_same() {
    let rates = Rates { surfaces: 1e-4, colors: 2e-3 };
    for (name, scene) in scenes() {
        let reference = traced(&scene, "oracle", &view(&scene, ODD), Film::new(ODD), 0);
        for backend in ["wide", "scalar"] {
            let film = traced(&scene, backend, &view(&scene, ODD), Film::new(ODD), 0);
            let comparison = Comparison::new(format!("{name} by {backend}"), &reference, &film);
            let within = if backend == "wide" && is_by_chance(&name) {
                comparison.agrees_in_the_mean(rates, 0.2)
            } else {
                comparison.within(rates, Path::new(env!("CARGO_TARGET_TMPDIR")))
            };
            assert!(within.is_ok(), "{}", within.err().unwrap_or_default());
        }
    }
}
