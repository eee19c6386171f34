//! Do samples show what filters and lenses say, with the same bits however they are traced?

use std::f64::consts::PI;

use catoptra_core::{Integrator, Scene};
use catoptra_tests::{assert_same_bits, assert_same_part, camera_of, load, parsed, traced};
use catoptra_tracer::{
    Control, Film, Filter, Instructions, Moments, Pattern, Pool, Region, Size, Skip, Snapshot, View,
    backend_named, backends, render,
};

/// A size that no tile divides.
const ODD: Size = Size::new(45, 29);

const SAMPLES: u32 = 7;

/// White where x < 0, 2 m ahead, and black elsewhere.
fn edge(camera: &str) -> Scene {
    parsed(&format!(
        r#"
        camera "eye" {{ eye 0 0 0; direction 0 0 -1; fov 53.13010235415598; {camera} }}
        matte "white" {{ color 1 1 1 }}
        rectangle "left" material="white" {{ corner -100 -100 -2; edge-u 100 0 0; edge-v 0 200 0 }}
        ambient-light "sky" {{ radiance 1 1 1 }}
        "#
    ))
}

/// Scenes with mirrors, meshes and lights, seen sharp and through a lens.
fn scenes() -> Vec<(&'static str, Scene)> {
    let blurred = r#"
        camera "eye" { eye 0 1.8 6; target 0 0.9 0; lens-radius 0.2 }
        mirror "chrome" { color 0.9 0.9 0.9 }
        checker "tiles" { scale 1; reflectiveness 0.2 }
        sphere "left" material="chrome" { center -1.1 1 0; radius 1 }
        box "right" material="tiles" { min 0.5 0 -0.5; max 1.5 1.2 0.5 }
        triangle "sail" material="chrome" { a 0 0 2; b 1 0 2.5; c 0 1 2 }
        plane "floor" material="tiles"
        point-light "lamp" { position 3 6 5; intensity 90 90 90 }
    "#;
    let seed = ["seed/material.kdl", "seed/tetra.kdl"].map(|name| (name, load(name)));
    seed.into_iter().chain([("through a lens", parsed(blurred))]).collect()
}

/// Every integrator, and patterns and filters with them.
fn views(scene: &Scene) -> Vec<View> {
    let ways = [
        (Integrator::Whitted, Pattern::Owen, Filter::Box),
        (Integrator::Whitted, Pattern::Sobol, Filter::Tent),
        (Integrator::Occlusion, Pattern::Owen, Filter::BlackmanHarris),
    ];
    let view = |(integrator, pattern, filter)| View {
        integrator,
        pattern,
        filter,
        samples: SAMPLES,
        moments: Moments::Luminance,
        ..View::of(scene, camera_of(scene), ODD)
    };
    ways.map(view).to_vec()
}

#[test]
fn a_film_that_goes_on_has_the_bits_of_one_traced_at_once() {
    for (name, scene) in scenes() {
        let pools = [1, 3].map(|threads| Pool::new(threads).expect("threads"));
        let snapshot = Snapshot::extract(&scene, &pools[0]);
        for view in views(&scene) {
            for backend in ["wide", "scalar"] {
                let whole = traced(&scene, backend, &view, Film::new(ODD), 2);
                let mut film = Film::with_tiles(ODD, 12);
                for (turn, range) in [0..1, 1..3, 3..SAMPLES].into_iter().enumerate() {
                    let instructions = Instructions::all()[turn % Instructions::all().len()];
                    let view = View { range: Some(range), instructions: Some(instructions), ..view.clone() };
                    let backend = backend_named(backend).expect("a backend");
                    let pool = &pools[turn % 2];
                    render(backend, &snapshot, &view, &mut film, pool, &Control::default()).expect("an end");
                }
                assert_same_bits(&whole, &film, &format!("{name} by {backend}, {:?}", view.pattern));
            }
        }
    }
}

#[test]
#[should_panic(expected = "the film holds the samples before number 3")]
fn a_film_without_the_samples_before_does_not_go_on() {
    let scene = edge("");
    let view = View { samples: 7, range: Some(3..7), ..View::of(&scene, camera_of(&scene), ODD) };
    traced(&scene, "wide", &view, Film::new(ODD), 1);
}

#[test]
fn no_way_of_sharing_out_samples_changes_a_bit() {
    let crop = Region::new(9, 5, Size::new(21, 17));
    for (name, scene) in scenes() {
        for view in views(&scene) {
            let what = format!("{name}, {:?} by {:?}", view.filter, view.pattern);
            let usual = traced(&scene, "wide", &view, Film::new(ODD), 2);
            for edge in [4, 20, 64] {
                let tiled = traced(&scene, "wide", &view, Film::with_tiles(ODD, edge), 1);
                assert_same_bits(&usual, &tiled, &format!("{what} in tiles of {edge}"));
            }
            for instructions in Instructions::all() {
                let view = View { instructions: Some(instructions), ..view.clone() };
                let forced = traced(&scene, "wide", &view, Film::new(ODD), 1);
                assert_same_bits(&usual, &forced, &format!("{what} with {instructions:?}"));
            }
            let long =
                traced(&scene, "wide", &View { skip: Skip::NOTHING, ..view.clone() }, Film::new(ODD), 1);
            assert_same_bits(&usual, &long, &format!("{what} with nothing left out"));
            let cropped = View { crop: Some(crop), ..view.clone() };
            let part = traced(&scene, "wide", &cropped, Film::of_region(crop, 8), 1);
            assert_same_part(&usual, &part, &format!("{what}, cropped"));
        }
    }
}

#[test]
fn samples_lie_in_the_same_places_by_every_backend() {
    // Of 7 samples none may be seen on the other side of an edge: a seventh of the light.
    for (name, scene) in scenes() {
        for view in views(&scene) {
            let [wide, scalar] =
                ["wide", "scalar"].map(|backend| traced(&scene, backend, &view, Film::new(ODD), 2));
            let pairs = wide.radiances().into_iter().zip(scalar.radiances());
            let off =
                pairs.filter(|(a, b)| (0..3).any(|c| (a[c] - b[c]).abs() > 1e-3 * (1.0 + b[c]))).count();
            println!("{name}, {:?} by {:?}: {off} pixels differ", view.filter, view.pattern);
            assert!(off <= ODD.pixels() / 100, "{name}, {:?} by {:?}: {off}", view.filter, view.pattern);
        }
    }
}

#[test]
fn one_sample_is_the_pixel_s_centre_whatever_the_pattern_the_filter_and_the_lens() {
    for (name, scene) in scenes() {
        let view = View::of(&scene, camera_of(&scene), ODD);
        let sharp = view.camera.clone().with_lens(0.0, None).expect("a pinhole");
        let plain = traced(&scene, "wide", &View { camera: sharp, ..view.clone() }, Film::new(ODD), 1);
        for (pattern, filter) in Pattern::ALL.iter().zip(Filter::ALL) {
            let view = View { pattern: *pattern, filter: *filter, seed: 5, ..view.clone() };
            let film = traced(&scene, "wide", &view, Film::new(ODD), 1);
            assert_same_bits(&plain, &film, &format!("{name}, {filter:?} by {pattern:?}"));
        }
    }
}

#[test]
fn a_clamp_cuts_off_each_sample() {
    let scene = edge("");
    for (samples, backend) in [(1, "wide"), (1, "scalar"), (16, "wide"), (16, "scalar")] {
        let view = View { samples, ..View::of(&scene, camera_of(&scene), ODD) };
        let [all, cut] = [f32::INFINITY, 0.25].map(|clamp| {
            let view = View { clamp, ..view.clone() };
            traced(&scene, backend, &view, Film::new(ODD), 1).radiances()
        });
        for (all, cut) in all.iter().zip(cut) {
            assert!((all[0] * 0.25 - cut[0]).abs() < 1e-6, "{all:?} became {cut:?} by {backend}");
        }
    }
}

/// What share of a filter lies before `x` pixels from its middle.
fn share_before(filter: Filter, x: f64) -> f64 {
    let x = x.clamp(-filter.reach(), filter.reach());
    match filter {
        Filter::Box => x + 0.5,
        Filter::Tent => 0.5 + x - 0.5 * x * x.abs(),
        Filter::BlackmanHarris => {
            let wave = |share: f64, waves: f64| share / waves * (waves * PI * x / 1.5).sin() / PI;
            (0.35875 * x / 1.5 + wave(0.48829, 1.0) + wave(0.14128, 2.0) + wave(0.01168, 3.0))
                / (2.0 * 0.35875)
                + 0.5
        }
    }
}

#[test]
fn an_edge_is_as_soft_as_the_filter() {
    // Seen 40 pixels a metre, 0.3 pixels right of the middle of the picture.
    let size = Size::new(24, 40);
    let scene = edge("move 0.015 0 0");
    for (filter, backend) in
        Filter::ALL.iter().flat_map(|filter| backends().iter().map(move |b| (*filter, b)))
    {
        let view = View { filter, samples: 256, ..View::of(&scene, camera_of(&scene), size) };
        let film = traced(&scene, backend.name(), &view, Film::new(size), 2);
        for x in 0..size.width {
            let middle = f64::from(x) + 0.5 - 12.0 + 0.3;
            let expected = share_before(filter, -middle);
            let found = f64::from(film.radiance(x, 20)[0]);
            assert!(
                (found - expected).abs() < 0.01,
                "{filter:?} by {}, {x}: {found}, {expected}",
                backend.name()
            );
        }
    }
}

#[test]
fn what_is_out_of_focus_is_blurred_by_the_disk_of_the_lens() {
    let size = Size::new(40, 20);
    for (focus, backend) in
        [1.0, 2.0, 5.0].into_iter().flat_map(|focus| backends().iter().map(move |b| (focus, b)))
    {
        let scene = edge(&format!("lens-radius 0.2; focus {focus}"));
        let view = View { samples: 1024, ..View::of(&scene, camera_of(&scene), size) };
        let film = traced(&scene, backend.name(), &view, Film::new(size), 2);
        let metres = |x: f64| (x - 20.0) * 0.1;
        // How far the rays through one pixel are spread to either side where they meet the edge's plane.
        let spread = 0.2 * f64::abs(1.0 - 2.0 / focus);
        for x in 0..size.width {
            let share = |at: f64| {
                let t =
                    if spread > 0.0 { (-metres(at) / spread).clamp(-1.0, 1.0) } else { -metres(at).signum() };
                0.5 + (t * (1.0 - t * t).sqrt() + t.asin()) / PI
            };
            let steps = 100;
            let pixel = (0..steps).map(|i| share(f64::from(x) + (f64::from(i) + 0.5) / f64::from(steps)));
            let expected = pixel.sum::<f64>() / f64::from(steps);
            let found = f64::from(film.radiance(x, 7)[0]);
            let name = backend.name();
            assert!((found - expected).abs() < 0.015, "focus {focus} by {name}, {x}: {found}, {expected}");
        }
    }
}
