//! Does light go through and between surfaces of all materials as theory says, by every backend?

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::fmt::Write;

use catoptra_core::glam::DVec3;
use catoptra_core::{Integrator, Scene};
use catoptra_tests::{assert_same_bits, camera_of, parsed, traced};
use catoptra_tracer::{
    Control, Film, Instructions, Pool, ProbeOptions, Receiver, Size, Snapshot, View, irradiance_at,
};

const BACKENDS: [&str; 3] = ["scalar", "oracle", "wide"];

fn whitted(scene: &Scene, size: Size) -> View {
    let view = View::of(scene, camera_of(scene), size);
    View { integrator: Integrator::Whitted, max_depth: 200, weight_cutoff: 0.0, ..view }
}

fn paths(scene: &Scene, size: Size, samples: u32) -> View {
    View { integrator: Integrator::Path, samples, ..View::of(scene, camera_of(scene), size) }
}

/// The mean of a picture's green channel.
fn mean(film: &Film, size: Size) -> f64 {
    let pixels = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
    pixels.map(|(x, y)| f64::from(film.radiance(x, y)[1])).sum::<f64>() / size.pixels() as f64
}

/// The reflectance of an interface, the mean of both polarisations (Fresnel 1823).
fn fresnel(cosine: f64, ior: f64) -> f64 {
    let sine = (1.0 - cosine * cosine).sqrt() / ior;
    let inner = (1.0 - sine * sine).sqrt();
    let across = (cosine - ior * inner) / (cosine + ior * inner);
    let along = (ior * cosine - inner) / (ior * cosine + inner);
    (across * across + along * along) / 2.0
}

/// A slab of glass before a surface that shines, seen under an angle in degrees.
fn slab(angle: f64, ior: f64) -> Scene {
    let (sine, cosine) = angle.to_radians().sin_cos();
    parsed(&format!(
        "camera \"c\" {{ eye {} 0 {}; target 0 0 0; fov 1 }}\nglass \"g\" {{ ior {ior} }}\nemissive \"e\" {{ radiance 1; two-sided #true }}\n\
         box \"slab\" material=\"g\" {{ min -500 -500 -1; max 500 500 0 }}\n\
         rectangle \"back\" material=\"e\" {{ corner -900 -900 -3; edge-u 1800 0 0; edge-v 0 1800 0 }}",
        sine * 9.0,
        cosine * 9.0
    ))
}

#[test]
fn a_slab_lets_through_what_fresnel_says() {
    let size = Size::new(1, 1);
    for angle in [0.0_f64, 30.0, 45.0, 60.0, 70.0, 80.0] {
        let scene = slab(angle, 1.52);
        let reflected = fresnel(angle.to_radians().cos(), 1.52);
        // Of all orders, as both faces send light to and fro.
        let expected = (1.0 - reflected) / (1.0 + reflected);
        for backend in BACKENDS {
            let found = mean(&traced(&scene, backend, &whitted(&scene, size), Film::new(size), 1), size);
            let limit = if backend == "wide" { 5e-6 } else { 1e-6 };
            assert!((found - expected).abs() < limit, "{backend}, {angle}°: {found} instead of {expected}");
        }
    }
}

#[test]
fn a_tinted_ball_keeps_back_what_beer_and_lambert_say() {
    let scene = parsed(
        "camera \"c\" { eye 0 0 9; target 0 0 0; fov 0.01 }\nglass \"g\" { ior 1; tint 0.9 0.5 0.1; tint-distance 2 }\n\
         sphere \"b\" material=\"g\" { center 0 0 0; radius 1.5 }\nsettings { background 1 }",
    );
    let size = Size::new(1, 1);
    for backend in BACKENDS {
        let film = traced(&scene, backend, &whitted(&scene, size), Film::new(size), 1);
        for (found, tint) in film.radiance(0, 0).into_iter().zip([0.9_f64, 0.5, 0.1]) {
            let expected = tint.powf(1.5);
            assert!((f64::from(found) - expected).abs() < 1e-6, "{backend}: {found} instead of {expected}");
        }
    }
}

#[test]
fn glass_of_the_index_of_what_is_round_it_is_not_seen() {
    // Water in which a ball of the same index floats, of higher priority.
    let scene = |ball: &str| {
        parsed(&format!(
            "camera \"c\" {{ eye 0 0.3 5; target 0 0 0; fov 40 }}\nglass \"water\" {{ ior 1.33 }}\n\
             glass \"same\" {{ ior 1.33; priority 1 }}\nchecker \"tiles\" {{ scale 0.3 }}\n\
             box \"tank\" material=\"water\" {{ min -1 -1 -1; max 1 1 1 }}\n\
             plane \"wall\" material=\"tiles\" {{ point 0 0 -3; normal 0 0 1 }}\n\
             ambient-light \"a\" {{ radiance 1 }}\n{ball}"
        ))
    };
    let size = Size::new(60, 60);
    let [with, without] =
        ["sphere \"ball\" material=\"same\" { center 0.2 0 0.1; radius 0.6 }", ""].map(|ball| {
            let scene = scene(ball);
            traced(&scene, "scalar", &whitted(&scene, size), Film::new(size), 2)
        });
    let mut off = 0;
    for (x, y) in (0..60).flat_map(|y| (0..60).map(move |x| (x, y))) {
        off += u32::from((with.radiance(x, y)[0] - without.radiance(x, y)[0]).abs() > 1e-5);
    }
    // Where a ray meets an edge between tiles, rounding decides.
    assert!(off < 20, "{off} pixels differ");
}

#[test]
fn a_furnace_shows_what_it_is_lined_with() {
    // In a closed box of albedo 1/2 and emission 1/2 everything shows 1.
    let mut text = String::from(
        "camera \"c\" { eye 0.1 0.2 0.3; target 1 0.1 -0.2; fov 80 }\n\
         principled \"lining\" { base-color 0.5; roughness 1; specular 0; emission 0.5 }\n",
    );
    for (i, (corner, u, v)) in [
        ("-1 -1 -1", "0 2 0", "0 0 2"),
        ("1 -1 -1", "0 0 2", "0 2 0"),
        ("-1 -1 -1", "0 0 2", "2 0 0"),
        ("-1 1 -1", "2 0 0", "0 0 2"),
        ("-1 -1 -1", "2 0 0", "0 2 0"),
        ("-1 -1 1", "0 2 0", "2 0 0"),
    ]
    .into_iter()
    .enumerate()
    {
        let _ = writeln!(
            text,
            "rectangle \"r{i}\" material=\"lining\" {{ corner {corner}; edge-u {u}; edge-v {v} }}"
        );
    }
    let scene = parsed(&text);
    let size = Size::new(32, 32);
    for backend in ["scalar", "wide"] {
        let found = mean(&traced(&scene, backend, &paths(&scene, size, 256), Film::new(size), 2), size);
        assert!((found - 1.0).abs() < 2e-3, "{backend}: {found}");
    }
}

#[test]
fn a_white_room_holds_the_light_that_theory_says() {
    for albedo in [0.05, 0.5, 0.9, 0.95] {
        let scene = parsed(&format!(
            "camera \"c\" {{ eye 0 0 0; target 1 0 0 }}\nmatte \"m\" {{ color {albedo} }}\n\
             box \"room\" material=\"m\" {{ min -2 -2 -2; max 2 2 2 }}\npoint-light \"lamp\" {{ position 0 0 0; intensity {} }}",
            10_000.0 / (4.0 * std::f64::consts::PI)
        ));
        let pool = Pool::new(2).unwrap();
        let snapshot = Snapshot::extract(&scene, &pool);
        let cells =
            (0..12).flat_map(|i| (0..12).map(move |j| [i, j].map(|k| (f64::from(k) + 0.5) / 3.0 - 2.0)));
        let meters: Vec<_> =
            cells.map(|[x, z]| Receiver::new(DVec3::new(x, -2.0, z), DVec3::Y).unwrap()).collect();
        let mean = |integrator| {
            let options = ProbeOptions { rays: 512, integrator, ..ProbeOptions::default() };
            let found = irradiance_at(&snapshot, &meters, &options, &pool, &Control::default()).unwrap();
            found.iter().map(|found| found.mean.g).sum::<f64>() / meters.len() as f64
        };
        let (found, expected) =
            (mean(Integrator::Path) - mean(Integrator::Whitted), albedo * 10_000.0 / ((1.0 - albedo) * 96.0));
        assert!((found / expected - 1.0).abs() < 0.01, "{albedo}: {found} lx instead of {expected}");
    }
}

/// Balls and slabs of all materials under lamps, a light and a picture-less sky, with cut-outs.
fn still_life(sky: &str) -> Scene {
    parsed(&format!(
        "camera \"c\" {{ eye 0 2.4 7; target 0 0.8 0; fov 42 }}\n{sky}\nmatte \"m\" {{ color 0.6 0.5 0.4 }}\nchecker \"t\" {{ scale 0.7 }}\n\
         glass \"clear\" {{ ior 1.5; tint 0.8 0.9 1; priority 2 }}\nglass \"frosted\" {{ roughness 0.3 }}\nmetal \"gold\" {{ preset \"gold\"; roughness 0.2 }}\n\
         plastic \"red\" {{ color 0.7 0.1 0.1 }}\nrubber \"black\" {{ color 0.1 }}\nmatte \"veil\" {{ color 0.9; opacity 0.4 }}\n\
         plane \"ground\" material=\"t\"\nsphere \"a\" material=\"clear\" {{ center -1.4 0.8 0; radius 0.8 }}\nsphere \"b\" material=\"frosted\" {{ center 0 0.6 1; radius 0.6 }}\n\
         sphere \"d\" material=\"gold\" {{ center 1.5 0.8 0; radius 0.8 }}\nbox \"e\" material=\"red\" {{ min -0.4 0 -1.6; max 0.5 1.4 -0.8 }}\n\
         sphere \"f\" material=\"black\" {{ center 1.2 0.3 1.6; radius 0.3 }}\nrectangle \"v\" material=\"veil\" {{ corner -2.4 0 1.4; edge-u 1.2 0 0; edge-v 0 1.2 0 }}\n\
         rectangle-light \"l\" {{ corner -1 4 -1; edge-u 2 0 0; edge-v 0 0 2; radiance 3 }}\npoint-light \"p\" {{ position 3 4 4; intensity 12 }}"
    ))
}

#[test]
fn bits_depend_on_neither_tiles_nor_threads_nor_instructions() {
    let size = Size::new(70, 50);
    for (sky, integrator) in
        [("", Integrator::Whitted), ("environment-light \"s\" { radiance 0.3 0.4 0.5 }", Integrator::Path)]
    {
        let scene = still_life(sky);
        let view = View { integrator, samples: 2, ..View::of(&scene, camera_of(&scene), size) };
        let reference = traced(&scene, "wide", &view, Film::new(size), 1);
        for (tile, threads) in [(8, 1), (64, 3)] {
            let film = traced(&scene, "wide", &view, Film::with_tiles(size, tile), threads);
            assert_same_bits(&reference, &film, &format!("{}, tiles of {tile}", integrator.name()));
        }
        for instructions in Instructions::all() {
            let view = View { instructions: Some(instructions), ..view.clone() };
            let film = traced(&scene, "wide", &view, Film::new(size), 2);
            assert_same_bits(&reference, &film, &format!("{}, {}", integrator.name(), instructions.name()));
        }
    }
}

#[test]
fn backends_show_the_same() {
    let (scene, size) = (still_life(""), Size::new(64, 48));
    let view = View { max_depth: 6, ..whitted(&scene, size) };
    let [scalar, wide] = ["scalar", "wide"].map(|backend| traced(&scene, backend, &view, Film::new(size), 2));
    let mut odd = 0;
    for (x, y) in (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))) {
        let apart = scalar.radiance(x, y).into_iter().zip(wide.radiance(x, y)).map(|(a, b)| (a - b).abs());
        odd += u32::from(apart.fold(0.0, f32::max) > 1e-4);
    }
    assert!(odd <= 8, "{odd} pixels differ");
}

#[test]
fn paths_of_both_backends_agree_in_the_mean() {
    let (scene, size) = (still_life("environment-light \"s\" { radiance 0.3 0.4 0.5 }"), Size::new(32, 24));
    let view = paths(&scene, size, 64);
    let [scalar, wide] = ["scalar", "wide"].map(|backend| {
        let view = View { seed: u32::from(backend == "wide"), ..view.clone() };
        mean(&traced(&scene, backend, &view, Film::new(size), 2), size)
    });
    assert!((scalar / wide - 1.0).abs() < 0.02, "{scalar} {wide}");
}

#[test]
fn a_thousand_overlapping_solids_leave_every_pixel_finite() {
    let mut text =
        String::from("camera \"c\" { eye 0 0 12; target 0 0 0; fov 50 }\nsettings { background 1 }\n");
    for i in 0..8 {
        let _ = writeln!(
            text,
            "glass \"g{i}\" {{ ior {}; priority {}; tint 0.9 0.95 1 }}",
            1.1 + 0.1 * f64::from(i),
            i % 3
        );
    }
    let mut bits = 1_u64;
    let mut random = || {
        bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (bits >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    for i in 0..1000 {
        let [x, y, z] = [random() * 3.0, random() * 3.0, random() * 3.0];
        // Every third begins where the one before ends, but for one unit in the last place.
        let x = if i % 3 == 0 { x.next_up() } else { x };
        let _ = if i % 2 == 0 {
            writeln!(
                text,
                "sphere \"s{i}\" material=\"g{}\" {{ center {x} {y} {z}; radius {} }}",
                i % 8,
                0.3 + 0.2 * random()
            )
        } else {
            writeln!(
                text,
                "box \"s{i}\" material=\"g{}\" {{ min {x} {y} {z}; max {} {} {} }}",
                i % 8,
                x + 0.5,
                y + 0.4,
                z + 0.6
            )
        };
    }
    let (scene, size) = (parsed(&text), Size::new(32, 32));
    for view in [View { max_depth: 8, weight_cutoff: 0.01, ..whitted(&scene, size) }, paths(&scene, size, 4)]
    {
        let film = traced(&scene, "wide", &view, Film::new(size), 2);
        for (x, y) in (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y))) {
            assert!(film.radiance(x, y).iter().all(|v| v.is_finite() && *v >= 0.0), "({x}, {y})");
        }
        assert!(mean(&film, size) < 1.0 + 1e-6 && mean(&film, size) > 0.01, "{}", mean(&film, size));
    }
}

/// A square metre that is seen whole, under ambient light, with more in its scene.
fn painted(material: &str, place: &str, more: &str) -> Scene {
    parsed(&format!(
        "camera \"c\" {{ eye 0 0 5; target 0 0 0; fov 12 }}\nambient-light \"a\" {{ radiance 1 }}\nsettings {{ background 0.25 }}\n\
         checker-texture \"tiles\" {{ color 1; other 0.5; scale 2 1 }}\n{material}\n{more}\n\
         rectangle \"r\" material=\"m\" {{ corner -0.5 -0.5 0; edge-u 1 0 0; edge-v 0 1 0{place} }}"
    ))
}

/// What is seen left, right, above and below of the middle, by every backend.
fn seen_around(scene: &Scene) -> [f32; 4] {
    let size = Size::new(41, 41);
    let films = BACKENDS.map(|backend| traced(scene, backend, &whitted(scene, size), Film::new(size), 1));
    let at = [[12, 20], [28, 20], [20, 12], [20, 28]];
    let [scalar, oracle, wide] = films.map(|film| at.map(|[x, y]| film.radiance(x, y)[0]));
    assert_eq!((scalar, scalar), (oracle, wide));
    scalar
}

#[test]
fn textures_lie_on_shapes_and_move_with_them() {
    let [left, right, ..] = seen_around(&painted("matte \"m\" { color 1 texture=\"tiles\" }", "", ""));
    assert!((left - 0.5).abs() < 1e-6 && (right - 1.0).abs() < 1e-6, "{left} {right}");
    let turned = painted("matte \"m\" { color 1 texture=\"tiles\" }", "; turn 90 0 0 1", "");
    let [.., above, below] = seen_around(&turned);
    assert!((below - 0.5).abs() < 1e-6 && (above - 1.0).abs() < 1e-6, "{above} {below}");
    let channels = painted(
        "phong \"m\" { ambient 1; diffuse 0; reflectiveness 0.4 texture=\"tiles\" channel=\"g\" }",
        "",
        "",
    );
    // The rest is a mirror of the background.
    let [left, right, ..] = seen_around(&channels);
    assert!(
        (left - (0.8 + 0.2 * 0.25)).abs() < 1e-6 && (right - (0.6 + 0.4 * 0.25)).abs() < 1e-6,
        "{left} {right}"
    );
}

#[test]
fn what_is_not_opaque_shows_what_is_behind_and_lets_light_through() {
    let back = "matte \"b\" { color 0.75 }\nrectangle \"back\" material=\"b\" { corner -2 -2 -1; edge-u 4 0 0; edge-v 0 4 0 }";
    let veil = seen_around(&painted("matte \"m\" { color 1; opacity 0.4 }", "", back));
    assert!(veil.iter().all(|seen| (seen - (0.4 + 0.6 * 0.75)).abs() < 1e-6), "{veil:?}");
    let holes = painted("matte \"m\" { color 1; opacity 1 texture=\"tiles\"; alpha-cutoff 0.7 }", "", back);
    let [left, right, ..] = seen_around(&holes);
    assert!((left - 0.75).abs() < 1e-6 && (right - 1.0).abs() < 1e-6, "{left} {right}");
    let from_behind = painted("matte \"m\" { color 1; sides \"single\" }", "; turn 180 0 1 0", back);
    assert!(seen_around(&from_behind).iter().all(|seen| (seen - 0.75).abs() < 1e-6));
    // A light behind the veil, its shadow on a floor.
    let text = |veil: &str| {
        format!(
            "camera \"c\" {{ eye 0 2 0; direction 0 -1 0; up 0 0 -1; fov 5 }}\nmatte \"f\" {{ color 1 }}\nmatte \"m\" {{ color 1{veil} }}\n\
             plane \"floor\" material=\"f\"\nrectangle \"r\" material=\"m\" {{ corner 0.5 1 -1; edge-u 2 0 0; edge-v 0 0 2 }}\n\
             point-light \"l\" {{ position 3 2.5 0; intensity 10 }}"
        )
    };
    let size = Size::new(1, 1);
    let light = |veil: &str| {
        let scene = parsed(&text(veil));
        mean(&traced(&scene, "wide", &whitted(&scene, size), Film::new(size), 1), size)
    };
    let (whole, half, none) = (light("; opacity 0"), light("; opacity 0.3"), light(""));
    assert!(whole > 0.1 && none == 0.0 && (half / whole - 0.7).abs() < 1e-6, "{whole} {half} {none}");
}

#[test]
fn paths_choose_anew_at_every_veil() {
    let veil = |i: u32| {
        format!("rectangle \"v{i}\" material=\"m\" {{ corner -2 -2 -{i}; edge-u 4 0 0; edge-v 0 4 0 }}\n")
    };
    let scene = parsed(&format!(
        "camera \"c\" {{ eye 0 0 5; target 0 0 0; fov 10 }}\nsettings {{ background 1 }}\nmatte \"m\" {{ color 0; opacity 0.5 }}\n{}",
        (0..3).map(veil).collect::<String>()
    ));
    let size = Size::new(24, 24);
    for backend in ["scalar", "wide"] {
        let found = mean(&traced(&scene, backend, &paths(&scene, size, 64), Film::new(size), 2), size);
        assert!((found - 0.125).abs() < 0.01, "{backend}: {found}");
    }
}
