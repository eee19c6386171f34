//! Do paths by chance hold the light that theory says, and do lanes and single paths agree about it?

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::PI;

use catoptra_core::{Integrator, Scene};
use catoptra_tests::{assert_same_bits, camera_of, parsed, traced};
use catoptra_tracer::{Film, Instructions, Size, View};

fn paths(scene: &Scene, size: Size, samples: u32) -> View {
    View { integrator: Integrator::Path, samples, ..View::of(scene, camera_of(scene), size) }
}

/// The means of a picture's channels.
fn means(film: &Film, size: Size) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for (x, y) in (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))) {
        for (sum, value) in sums.iter_mut().zip(film.radiance(x, y)) {
            *sum += f64::from(value) / size.pixels() as f64;
        }
    }
    sums
}

/// What lanes know: matte and checkered surfaces, some of them mirrors, one that shows distance, lamps of every kind, a sky.
fn plain_scene() -> Scene {
    parsed(
        "camera \"c\" { eye 0 2.2 7; target 0 0.8 0; fov 42 }\nenvironment-light \"sky\" { radiance 0.2 0.3 0.4 }\n\
         checker \"tiles\" { scale 0.7 }\nmatte \"m\" { color 0.6 0.5 0.4 }\nmatte \"glossy\" { color 0.3 0.6 0.3; reflectiveness 0.5 }\n\
         matte \"mirror\" { color 0; reflectiveness 0.9 }\ndepth \"far\" { color 0.5; range 20 }\nemissive \"glow\" { radiance 2 1 0.5 }\n\
         plane \"ground\" material=\"tiles\"\nsphere \"a\" material=\"mirror\" { center -1.4 0.8 0; radius 0.8 }\n\
         sphere \"b\" material=\"glossy\" { center 0.4 0.6 1; radius 0.6 }\nbox \"e\" material=\"m\" { min 0.9 0 -1.6; max 1.8 1.4 -0.8 }\n\
         sphere \"g\" material=\"glow\" { center 1.6 0.3 1.6; radius 0.3 }\ndisk \"d\" material=\"far\" { center -2.6 1 1; normal 1 0 1; radius 0.5 }\n\
         rectangle-light \"l\" { corner -1 4 -1; edge-u 2 0 0; edge-v 0 0 2; radiance 3 }\n\
         disk-light \"dl\" { center 3 3 -1; normal -1 -1 0; radius 0.5; radiance 4; two-sided #true }\n\
         point-light \"p\" { position 3 4 4; intensity 9 }\ndirectional-light \"sun\" { direction -1 -2 -1; irradiance 0.4 }",
    )
}

#[test]
fn bits_of_paths_in_lanes_depend_on_neither_tiles_nor_threads_nor_instructions() {
    let (scene, size) = (plain_scene(), Size::new(70, 50));
    let view = paths(&scene, size, 3);
    let reference = traced(&scene, "wide", &view, Film::new(size), 1);
    for (tile, threads) in [(8, 1), (64, 3)] {
        let film = traced(&scene, "wide", &view, Film::with_tiles(size, tile), threads);
        assert_same_bits(&reference, &film, &format!("tiles of {tile}"));
    }
    for instructions in Instructions::all() {
        let view = View { instructions: Some(instructions), ..view.clone() };
        let film = traced(&scene, "wide", &view, Film::new(size), 2);
        assert_same_bits(&reference, &film, instructions.name());
    }
}

/// Student's t for 30 degrees of freedom and a chance of 1 in 1,000 to be further off on either side.
const MOST_DEVIATIONS: f64 = 3.65;

#[test]
fn paths_in_lanes_and_single_ones_agree_in_the_mean() {
    let (scene, size) = (plain_scene(), Size::new(24, 18));
    let seeds = 16;
    let [scalar, wide] = ["scalar", "wide"].map(|backend| {
        let runs = (0..seeds).map(|seed| {
            let view = View { seed: 2 * seed + u32::from(backend == "wide"), ..paths(&scene, size, 16) };
            means(&traced(&scene, backend, &view, Film::new(size), 2), size)
        });
        runs.collect::<Vec<_>>()
    });
    let count = f64::from(seeds);
    for channel in 0..3 {
        let [(one, spread), (other, other_spread)] = [&scalar, &wide].map(|runs| {
            let mean = runs.iter().map(|run| run[channel]).sum::<f64>() / count;
            let square = runs.iter().map(|run| (run[channel] - mean).powi(2)).sum::<f64>() / (count - 1.0);
            (mean, square / count)
        });
        let deviation = (spread + other_spread).sqrt();
        assert!(deviation < 0.01 * one, "{deviation} is too much to tell anything");
        assert!(
            (one - other).abs() < MOST_DEVIATIONS * deviation,
            "{one} and {other}, give or take {deviation}"
        );
    }
}

#[test]
fn an_integrating_sphere_holds_what_its_walls_and_its_port_leave() {
    // A black disk closes off a cap of 1/10 of the sphere: of what a wall sends out, as much as that is lost.
    let port = 0.1_f64;
    let height = 1.0 - 2.0 * port;
    let radius = (1.0 - height * height).sqrt();
    let size = Size::new(64, 64);
    for albedo in [0.3, 0.5, 0.8] {
        let scene = parsed(&format!(
            "camera \"c\" {{ eye 0 0.01 0; direction 0 -1 0; up 0 0 1; fov 60 }}\nmatte \"wall\" {{ color {albedo} }}\nmatte \"black\" {{ color 0 }}\n\
             sphere \"s\" material=\"wall\" {{ center 0 0 0; radius 1 }}\n\
             disk \"port\" material=\"black\" {{ center 0 {height} 0; normal 0 1 0; radius {radius} }}\n\
             point-light \"lamp\" {{ position 0 0 0; intensity {PI} }}"
        ));
        let expected = albedo / (1.0 - albedo * (1.0 - port));
        for (backend, samples) in [("wide", 256), ("scalar", 16)] {
            let film = traced(&scene, backend, &paths(&scene, size, samples), Film::new(size), 2);
            let off = (means(&film, size)[1] / expected - 1.0).abs();
            let limit = if backend == "wide" { 5e-4 } else { 4e-3 };
            assert!(off < limit, "{backend}, albedo {albedo}: off by {off}");
        }
    }
}

#[test]
fn a_corridor_of_mirrors_dims_light_by_a_power() {
    // At a slope of 1/4 a ray meets a mirror every four metres, for the first time after two.
    let (size, share) = (Size::new(1, 1), 0.93_f64);
    for (length, bounces) in [(1.0, 0), (9.0, 2), (100.0, 25)] {
        let scene = parsed(&format!(
            "camera \"c\" {{ eye 0 0.5 0; direction 0 -0.25 -1; fov 0.001 }}\nmatte \"mirror\" {{ color 0; reflectiveness {share} }}\n\
             emissive \"e\" {{ radiance 1; two-sided #true }}\nplane \"floor\" material=\"mirror\"\n\
             plane \"ceiling\" material=\"mirror\" {{ point 0 1 0; normal 0 -1 0 }}\n\
             plane \"end\" material=\"e\" {{ point 0 0 -{length}; normal 0 0 1 }}"
        ));
        let expected = share.powi(bounces);
        for backend in ["scalar", "oracle", "wide"] {
            let limit = if backend == "wide" { 5e-6 } else { 1e-6 };
            for integrator in [Integrator::Whitted, Integrator::Path] {
                let samples = if integrator == Integrator::Path { 4096 } else { 1 };
                let view = View {
                    integrator,
                    max_depth: 200,
                    weight_cutoff: 0.0,
                    samples,
                    ..View::of(&scene, camera_of(&scene), size)
                };
                let found = means(&traced(&scene, backend, &view, Film::new(size), 1), size)[1];
                // Paths end by chance from three bounces on.
                let limit =
                    if integrator == Integrator::Path && bounces > 3 { 0.03 * expected } else { limit };
                assert!(
                    (found - expected).abs() < limit,
                    "{backend}, {}: {found} instead of {expected}",
                    integrator.name()
                );
            }
        }
    }
}

#[test]
fn a_corridor_of_glass_lets_through_what_fresnel_says_of_all_orders() {
    // At normal incidence; each of n plates has two faces of reflectance F, and 2n of them let (1 - F) / (1 + (2n - 1) F) through.
    let (ior, plates) = (1.52_f64, 3);
    let reflected = ((ior - 1.0) / (ior + 1.0)).powi(2);
    let plate =
        |i: i32| format!("box \"p{i}\" material=\"g\" {{ min -9 -9 {}; max 9 9 {} }}\n", -2 * i - 1, -2 * i);
    let scene = parsed(&format!(
        "camera \"c\" {{ eye 0 0 5; target 0 0 0; fov 0.0001 }}\nglass \"g\" {{ ior {ior} }}\n\
         emissive \"e\" {{ radiance 1 }}\nplane \"back\" material=\"e\" {{ point 0 0 -20; normal 0 0 1 }}\n{}",
        (0..plates).map(plate).collect::<String>()
    ));
    let expected = (1.0 - reflected) / (1.0 + f64::from(2 * plates - 1) * reflected);
    let one = Size::new(1, 1);
    for backend in ["scalar", "oracle", "wide"] {
        let view = View { max_depth: 100, weight_cutoff: 1e-9, ..View::of(&scene, camera_of(&scene), one) };
        let found = means(&traced(&scene, backend, &view, Film::new(one), 1), one)[1];
        let limit = if backend == "wide" { 5e-6 } else { 1e-6 };
        assert!((found - expected).abs() < limit, "{backend}: {found} instead of {expected}");
    }
    let size = Size::new(64, 64);
    let found = means(&traced(&scene, "wide", &paths(&scene, size, 256), Film::new(size), 2), size)[1];
    assert!((found / expected - 1.0).abs() < 2.5e-3, "paths: {found} instead of {expected}");
}

#[test]
fn of_many_lamps_paths_pick_some_and_lose_none() {
    let lamp = |i: u32| {
        let (x, z) = (i % 10, i / 10);
        format!(
            "sphere-light \"l{i}\" {{ center {} {} {}; radius 0.04; radiance {}; visible #false }}\n",
            f64::from(x) - 4.5,
            1.0 + 0.05 * f64::from(i % 7),
            f64::from(z) - 5.0,
            1 + i % 5
        )
    };
    let scene = parsed(&format!(
        "camera \"c\" {{ eye 0 6 6; target 0 0 0; fov 60 }}\nmatte \"m\" {{ color 0.7 }}\nplane \"floor\" material=\"m\"\n\
         sphere \"s\" material=\"m\" {{ center 0.2 0.5 0.1; radius 0.5 }}\n{}",
        (0..100).map(lamp).collect::<String>()
    ));
    let size = Size::new(32, 24);
    let direct = View { max_depth: 0, samples: 16, ..View::of(&scene, camera_of(&scene), size) };
    let exact = means(&traced(&scene, "wide", &direct, Film::new(size), 2), size)[1];
    for backend in ["scalar", "wide"] {
        let view = View { path_depth: 0, ..paths(&scene, size, 256) };
        let found = means(&traced(&scene, backend, &view, Film::new(size), 2), size)[1];
        assert!((found / exact - 1.0).abs() < 0.01, "{backend}: {found} instead of {exact}");
    }
}

#[test]
fn between_white_walls_paths_end_nevertheless() {
    let scene = parsed(
        "camera \"c\" { eye 0 0 0; target 1 0.2 0; fov 60 }\nmatte \"white\" { color 1 }\n\
         box \"room\" material=\"white\" { min -1 -1 -1; max 1 1 1 }",
    );
    let size = Size::new(8, 8);
    for backend in ["scalar", "wide"] {
        let found = means(&traced(&scene, backend, &paths(&scene, size, 2), Film::new(size), 1), size);
        assert_eq!(found, [0.0; 3], "{backend}");
    }
}
