//! Does an orthographic camera show what parallel rays see, by every backend and integrator alike, with the same bits however
//! they are traced?

use catoptra_core::{Integrator, Scene};
use catoptra_tests::{assert_same_bits, camera_of, film, load, parsed, traced};
use catoptra_tracer::{Film, Instructions, Size, Skip, View, backends};

/// A size that no tile divides.
const ODD: Size = Size::new(45, 29);

/// Things with mirrors, glass, patterns, a mesh and a lamp, seen from the side by parallel rays.
fn scenes() -> Vec<(&'static str, Scene)> {
    let mixed = r#"
        camera "plan" { eye 0 1.8 6; target 0 0.9 0; projection "orthographic"; height 4 }
        mirror "chrome" { color 0.9 0.9 0.9 }
        checker "tiles" { scale 1; reflectiveness 0.2 }
        glass "clear" { tint 0.5 0.9 0.9 }
        sphere "left" material="chrome" { center -1.1 1 0; radius 1 }
        box "right" material="tiles" { min 0.5 0 -0.5; max 1.5 1.2 0.5 }
        sphere "drop" material="clear" { center 0.4 1.5 1.5; radius 0.4 }
        sphere "round the window" material="clear" { center 1.2 2.2 6; radius 0.7 }
        triangle "sail" material="chrome" { a 0 0 2; b 1 0 2.5; c 0 1 2 }
        plane "floor" material="tiles"
        point-light "lamp" { position 3 6 5; intensity 90 90 90 }
        rectangle-light "window" { corner -2 3 2; edge-u 1 0 0; edge-v 0 0 1; radiance 4 4 4 }
    "#;
    let mut seed = load("seed/material.kdl");
    let main = seed.main_camera().expect("a camera");
    let camera = seed.camera(main).expect("a camera");
    let height = catoptra_core::Extent::Height(6.0);
    let parallel = camera.with_extent(height).expect("a height");
    seed.apply(catoptra_core::Edit::Camera(main, parallel)).expect("a camera of the scene");
    vec![("mixed", parsed(mixed)), ("seed/material", seed)]
}

/// Every integrator, by one sample a pixel and by several.
fn views(scene: &Scene) -> Vec<View> {
    let ways = [
        (Integrator::Whitted, 1),
        (Integrator::Whitted, 5),
        (Integrator::Occlusion, 3),
        (Integrator::Path, 3),
    ];
    let view = |(integrator, samples)| View { integrator, samples, ..View::of(scene, camera_of(scene), ODD) };
    ways.map(view).to_vec()
}

/// Balls of one size at any distance are disks of that size; what is behind the camera is not seen.
#[test]
fn balls_are_disks_of_their_own_size_however_far_away() {
    let scene = parsed(
        r#"
        camera "front" { eye 0 0 5; direction 0 0 -1; projection "orthographic"; height 4 }
        matte "white" { color 1 1 1 }
        sphere "near" material="white" { center -1.7 0.3 2; radius 1 }
        sphere "far" material="white" { center 1.7 -0.2 -4000; radius 1 }
        sphere "behind" material="white" { center 0 0 7; radius 1.5 }
        ambient-light "sky" { radiance 1 1 1 }
        "#,
    );
    let size = Size::new(160, 80);
    for backend in backends() {
        let film = film(&scene, backend.name(), size, 2);
        let radiances = film.radiances();
        for (i, found) in radiances.iter().enumerate() {
            let (column, row) = (i % 160, i / 160);
            let (x, y) = ((column as f64 + 0.5) / 20.0 - 4.0, 2.0 - (row as f64 + 0.5) / 20.0);
            let gap = |[cx, cy]: [f64; 2]| (x - cx).hypot(y - cy) - 1.0;
            let gaps = [gap([-1.7, 0.3]), gap([1.7, -0.2])];
            if gaps.iter().any(|gap| gap.abs() < 1e-6) {
                continue;
            }
            let wanted = if gaps.iter().any(|gap| *gap < 0.0) { 1.0 } else { 0.0 };
            assert!((found[0] - wanted).abs() < 1e-6, "{} at {x} {y}: {found:?}", backend.name());
        }
    }
}

/// A window half in tinted matter that bends no light: each ray is dimmed by its own way out of it.
#[test]
fn every_ray_knows_what_it_begins_in() {
    let scene = parsed(
        r#"
        camera "inside" { eye 0 0 0; direction 0 0 -1; projection "orthographic"; height 4 }
        glass "fog" { ior 1; tint 0.5 0.25 1 }
        sphere "cloud" material="fog" { center 0.5 0 0; radius 1 }
        environment-light "sky" { radiance 1 1 1 }
        "#,
    );
    let size = Size::new(40, 40);
    let view = View { integrator: Integrator::Path, samples: 1, ..View::of(&scene, camera_of(&scene), size) };
    for backend in backends() {
        let film = traced(&scene, backend.name(), &view, Film::new(size), 1);
        for (i, found) in film.radiances().iter().enumerate() {
            let (x, y) = ((i % 40) as f64 / 10.0 - 1.95, 1.95 - (i / 40) as f64 / 10.0);
            let inside = (1.0 - (x - 0.5) * (x - 0.5) - y * y).max(0.0).sqrt();
            let wanted = [0.5_f64.powf(inside), 0.25_f64.powf(inside), 1.0];
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((f64::from(*found) - wanted).abs() < 1e-5, "{} at {x} {y}: {found}", backend.name());
            }
        }
    }
}

#[test]
fn no_way_of_sharing_out_the_work_changes_a_bit() {
    for (name, scene) in scenes() {
        for view in views(&scene) {
            let what = format!("{name} by {:?}, {} samples", view.integrator, view.samples);
            let usual = traced(&scene, "wide", &view, Film::new(ODD), 2);
            for (threads, edge) in [(1, 4), (3, 20)] {
                let tiled = traced(&scene, "wide", &view, Film::with_tiles(ODD, edge), threads);
                assert_same_bits(&usual, &tiled, &format!("{what} in tiles of {edge}"));
            }
            for instructions in Instructions::all() {
                let view = View { instructions: Some(instructions), ..view.clone() };
                let forced = traced(&scene, "wide", &view, Film::new(ODD), 1);
                assert_same_bits(&usual, &forced, &format!("{what} with {instructions:?}"));
            }
            let long = View { skip: Skip::NOTHING, ..view.clone() };
            let long = traced(&scene, "wide", &long, Film::new(ODD), 1);
            assert_same_bits(&usual, &long, &format!("{what} with nothing left out"));
        }
    }
}

#[test]
fn every_backend_sees_the_same() {
    for (name, scene) in scenes() {
        for view in views(&scene) {
            let oracle = traced(&scene, "oracle", &view, Film::new(ODD), 2).radiances();
            for backend in ["wide", "scalar"] {
                let found = traced(&scene, backend, &view, Film::new(ODD), 2).radiances();
                let pairs = found.iter().zip(&oracle);
                let off =
                    pairs.filter(|(a, b)| (0..3).any(|c| (a[c] - b[c]).abs() > 1e-3 * (1.0 + b[c]))).count();
                let what = format!("{name} by {backend}, {:?}, {} samples", view.integrator, view.samples);
                assert!(off <= ODD.pixels() / 100, "{what}: {off} pixels differ");
            }
        }
    }
}
