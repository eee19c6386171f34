//! Does a film say truly how sure its pixels are?

use catoptra_core::{Rgb, Scene};
use catoptra_tests::{assert_same_bits, camera_of, parsed, shipped_scenes, traced};
use catoptra_tracer::{Film, Moments, Region, Size, View, backends};

/// Every pixel sees the same, give or take a millimetre.
const SAME: Size = Size::new(24, 24);

const SAMPLES: u32 = 16;

/// With 16 samples a pixel and what they tell of its error.
fn view(scene: &Scene, size: Size) -> View {
    let view = View::of(scene, camera_of(scene), size);
    View { samples: SAMPLES, moments: Moments::Channels, ..view }
}

fn places(film: &Film) -> impl Iterator<Item = (u32, u32)> {
    let Size { width, height } = film.size();
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

/// The standard errors of all pixels.
fn errors(film: &Film) -> Vec<f64> {
    places(film).map(|(x, y)| f64::from(film.standard_error(x, y).expect("samples to tell from"))).collect()
}

fn mean_of(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// A floor that a camera looks at one point of, and what hides the sky from there.
fn floor(things: &str) -> Scene {
    parsed(&format!(
        r#"
        settings {{ integrator "occlusion" }}
        camera "eye" {{ eye 3 1.5 0.4; target 0 0 0; up 0.1 0.7 0.3; fov 0.005 }}
        matte "grey" {{ color 0.5 }}
        plane "floor" material="grey"
        {things}
        "#
    ))
}

#[test]
fn the_standard_error_of_a_share_of_the_sky_is_that_of_its_formula() {
    // Hides the square of its sine: see `occlusion.rs`.
    for (radius, height) in [(1.0, 1.25_f64), (1.0, 2.0)] {
        let ball = format!(r#"sphere "ball" material="grey" {{ center 0 {height:?} 0; radius {radius:?} }}"#);
        let scene = floor(&ball);
        let seen = 1.0 - (radius / height).powi(2);
        let n = f64::from(SAMPLES);
        for backend in backends() {
            let film = traced(&scene, backend.name(), &view(&scene, SAME), Film::new(SAME), 1);
            let found = mean_of(errors(&film).into_iter().map(|error| error * error));
            let share = found / (seen * (1.0 - seen) / n);
            println!("{} by {}: {share:.4} of p (1 - p) / n", ball, backend.name());
            // Samples that are spread evenly are worth up to n / (n - 1) of so many independent ones.
            assert!((0.97..n / (n - 1.0) * 1.03).contains(&share), "{share} by {}", backend.name());
        }
    }
}

/// A fence overhead of slats too fine for the evenness of the samples to count, so that these are as good as independent.
fn slats() -> Scene {
    let slat = |i: i32| {
        let x = f64::from(i) * 0.1;
        format!(
            r#"rectangle "slat {i}" material="grey" {{ corner {x:?} 1 -4.03; edge-u 0.05 0 0; edge-v 0 0 8.1 }}"#
        )
    };
    floor(&(-40..40).map(slat).collect::<Vec<_>>().join("\n"))
}

#[test]
fn pixels_spread_over_seeds_by_their_standard_errors() {
    let scene = slats();
    let seeds = 24;
    let films: Vec<Film> = (0..seeds)
        .map(|seed| {
            let view = View { seed, ..view(&scene, SAME) };
            traced(&scene, "wide", &view, Film::new(SAME), 2)
        })
        .collect();
    let predicted =
        mean_of(films.iter().map(|film| mean_of(errors(film).into_iter().map(|error| error * error))));
    let spread_of = |(x, y)| {
        let found: Vec<f64> = films.iter().map(|film| f64::from(film.radiance(x, y)[0])).collect();
        let mean = mean_of(found.iter().copied());
        found.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (f64::from(seeds) - 1.0)
    };
    let spreads: Vec<f64> = places(&films[0]).map(spread_of).collect();
    let spread = mean_of(spreads.into_iter());
    println!("a variance of {spread:.6} over seeds, {predicted:.6} by the films");
    assert!((0.85..1.05).contains(&(spread / predicted)), "{spread} over seeds, {predicted} by the films");
}

/// A mirror that reflects all light, in the dark against a sky that is the same all round: seen at once or in the mirror.
const MIRROR: &str = r#"
settings { background 0.25 0.5 0.125 }
camera "main" { eye 0 0 0; direction 0 0 -1; fov 40 }
mirror "glass" { color 1 1 1 }
sphere "ball" material="glass" { center 0 0 -3; radius 0.7 }
"#;

#[test]
fn samples_that_show_the_same_by_any_way_leave_no_error() {
    let size = Size::new(31, 23);
    for (name, scene) in [("an open floor", floor("")), ("a mirror in a fog", parsed(MIRROR))] {
        for backend in backends() {
            let film = traced(&scene, backend.name(), &view(&scene, size), Film::new(size), 1);
            let largest = errors(&film).into_iter().fold(0.0, f64::max);
            println!("{name} by {}: at most {largest:e}", backend.name());
            assert!(largest == 0.0, "{name} by {}: {largest}", backend.name());
        }
    }
}

#[test]
fn the_error_is_that_of_luminance() {
    // The ball's edge parts the samples of some pixels in two kinds.
    let scene = parsed(
        r#"
        settings { background 0.25 0.5 0.125 }
        camera "main" { eye 0 0 0; direction 0 0 -1; fov 40 }
        matte "black" { color 0 0 0 }
        sphere "ball" material="black" { center 0 0 -3; radius 0.7 }
        "#,
    );
    let (size, n) = (Size::new(31, 23), f64::from(SAMPLES));
    for backend in backends() {
        let film = traced(&scene, backend.name(), &view(&scene, size), Film::new(size), 1);
        let luminance = Rgb::new(0.25, 0.5, 0.125).luminance();
        let mut parted = 0;
        for (x, y) in places(&film) {
            let sky = f64::from(film.radiance(x, y)[0]) / 0.25;
            let expected = luminance * (sky * (1.0 - sky) / (n - 1.0)).sqrt();
            let found = f64::from(film.standard_error(x, y).expect("samples to tell from"));
            assert!((found - expected).abs() < 1e-6, "{x},{y} by {}: {found}, {expected}", backend.name());
            parted += u32::from(found > 0.0);
        }
        assert!(parted > 20, "{parted} pixels of the edge by {}", backend.name());
    }
}

#[test]
fn asking_for_errors_changes_no_bit_of_the_picture() {
    let size = Size::new(61, 39);
    for (name, scene) in shipped_scenes() {
        for samples in [1, 9] {
            let view = View { samples, ..view(&scene, size) };
            for backend in ["wide", "scalar"] {
                let [with, without] = [Moments::Channels, Moments::None].map(|moments| {
                    let view = View { moments, ..view.clone() };
                    traced(&scene, backend, &view, Film::new(size), 2)
                });
                let bits = |film: &Film| -> Vec<[u32; 3]> {
                    film.radiances().into_iter().map(|light| light.map(f32::to_bits)).collect()
                };
                assert_eq!(bits(&with), bits(&without), "{name} by {backend}");
                assert_eq!(with.depths(), without.depths(), "{name} by {backend}");
                assert!(places(&without).all(|(x, y)| without.standard_error(x, y).is_none()));
                assert_eq!(
                    with.standard_error(7, 7).is_some(),
                    samples > 1,
                    "{name} by {backend}, {samples}"
                );
            }
        }
    }
}

#[test]
fn merged_films_know_what_both_have_found() {
    let scene = slats();
    let seeded = |seed, crop| {
        let view = View { seed, crop, ..view(&scene, SAME) };
        traced(&scene, "wide", &view, Film::of_region(view.region(), 8), 1)
    };
    let (first, second) = (seeded(1, None), seeded(2, None));
    let mut both = first.clone();
    both.merge(&second);
    for (x, y) in places(&both) {
        let [a, b] = [&first, &second].map(|film| f64::from(film.radiance(x, y)[0]));
        let mean = f64::midpoint(a, b);
        assert!((f64::from(both.radiance(x, y)[0]) - mean).abs() < 1e-6);
        assert_eq!((both.samples(x, y), both.surface(x, y)), (32, first.surface(x, y)));
        // Of samples that are 0 or 1 the mean tells how they deviate.
        let expected = (mean * (1.0 - mean) / 31.0).sqrt();
        let [red, green, blue] = both.channel_errors(x, y).expect("errors");
        for error in [both.standard_error(x, y).expect("an error"), red, green, blue] {
            assert!((f64::from(error) - expected).abs() < 1e-6);
        }
    }
    let crop = Region::new(5, 9, Size::new(11, 6));
    let mut parted = first.clone();
    parted.merge(&seeded(2, Some(crop)));
    let inside = |x, y| (5..16).contains(&x) && (9..15).contains(&y);
    for (x, y) in places(&parted) {
        let of = if inside(x, y) { &both } else { &first };
        assert_eq!(parted.samples(x, y), if inside(x, y) { 32 } else { 16 });
        assert_eq!(parted.radiance(x, y), of.radiance(x, y));
        assert_eq!(parted.standard_error(x, y), of.standard_error(x, y));
        assert_eq!(parted.channel_errors(x, y), of.channel_errors(x, y));
    }
    let again = traced(&scene, "wide", &View { seed: 1, ..view(&scene, SAME) }, parted, 1);
    assert_same_bits(&first, &again, "a merged film traced over");
}

#[test]
fn a_film_without_errors_takes_those_of_another_away() {
    let scene = floor("");
    let films = [Moments::Channels, Moments::None].map(|moments| {
        let view = View { moments, ..view(&scene, SAME) };
        traced(&scene, "wide", &view, Film::new(SAME), 1)
    });
    for (one, other) in [(0, 1), (1, 0)] {
        let mut both = films[one].clone();
        both.merge(&films[other]);
        assert_eq!(
            (both.samples(3, 3), both.standard_error(3, 3), both.channel_errors(3, 3)),
            (32, None, None)
        );
    }
}
