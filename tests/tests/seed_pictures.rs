//! Do the seed scenes still look as the program looked that they come from?
//!
//! Its pictures are no part of this repository: the environment variable `CATOPTRA_SEED_PICTURES` names a folder with
//! `directional.png` and the others, 450x450, written without a display transform. Without it these tests say so and do nothing.

use std::path::PathBuf;

use catoptra_core::{Scene, Shape};
use catoptra_scene::image::{Rgb8Image, read_png};
use catoptra_tests::{film, scene_file};
use catoptra_tracer::{Film, Size};

const SIZE: Size = Size::new(450, 450);

/// The folder of reference pictures, if there is one.
fn folder() -> Option<PathBuf> {
    let folder =
        std::env::var_os("CATOPTRA_SEED_PICTURES").map(PathBuf::from).filter(|folder| folder.is_dir());
    if folder.is_none() {
        println!("skipped: CATOPTRA_SEED_PICTURES names no folder of reference pictures");
    }
    folder
}

fn reference(folder: &std::path::Path, name: &str) -> Rgb8Image {
    let image = read_png(&folder.join(format!("{name}.png"))).expect("a reference picture");
    assert_eq!((image.width(), image.height()), (SIZE.width, SIZE.height), "{name}");
    image
}

fn rendered(name: &str) -> Film {
    let (scene, _) = catoptra_scene::load(&scene_file(&format!("seed/{name}.kdl"))).expect("a seed scene");
    film(&scene, "wide", SIZE, 0)
}

/// A pixel as that program writes it: the linear value, clamped, times 255, cut off.
fn bytes(film: &Film, x: u32, y: u32) -> [i32; 3] {
    film.radiance(x, y).map(|value| (255.0 * value.clamp(0.0, 1.0)) as i32)
}

fn places() -> impl Iterator<Item = (u32, u32)> {
    (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
}

#[test]
fn rooms_match_to_a_step_on_99_of_100_pixels() {
    let Some(folder) = folder() else { return };
    let mut failures = Vec::new();
    for name in ["directional", "point", "spot", "many"] {
        let (image, film) = (reference(&folder, name), rendered(name));
        let (mut near, mut sum) = (0, 0);
        for (x, y) in places() {
            let wanted = image.pixel(x, y).expect("a pixel inside").map(i32::from);
            let found = bytes(&film, x, y);
            let differences = [0, 1, 2].map(|i| (wanted[i] - found[i]).abs());
            near += usize::from(differences.iter().all(|difference| *difference <= 1));
            sum += differences.iter().sum::<i32>();
        }
        let pixels = f64::from(SIZE.width * SIZE.height);
        let (share, mean) = (near as f64 / pixels, f64::from(sum) / (3.0 * pixels));
        let result = format!("{name}: {:.3} % within a step, mean difference {mean:.4}", 100.0 * share);
        println!("{result}");
        if !(share >= 0.99 && mean <= 0.5) {
            failures.push(result);
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// What a pixel shows of the scenes of two balls on a plane, or of a tetrahedron alone.
#[derive(Clone, Copy, PartialEq)]
enum Seen {
    Nothing,
    LeftBall,
    RightBall,
    Rest,
}

/// What the film of a scene has at a pixel: balls are told apart by where they stand.
fn seen_by(scene: &Scene, film: &Film, x: u32, y: u32) -> Seen {
    let Some(id) = film.surface(x, y) else { return Seen::Nothing };
    match (scene.shape(id), scene.world_bounds(id)) {
        (Some(Shape::Sphere(_)), Some(bounds)) if bounds.centre().x < 0.0 => Seen::LeftBall,
        (Some(Shape::Sphere(_)), _) => Seen::RightBall,
        _ => Seen::Rest,
    }
}

/// What the picture of red and blue balls on a grey plane shows: the plane reflects the balls, but pale.
fn seen_in(rgb: [u8; 3]) -> Seen {
    let [r, g, b] = rgb.map(u32::from);
    match (r.max(g).max(b), r.min(g).min(b)) {
        (0, _) => Seen::Nothing,
        (most, least) if most > 2 * least => {
            if r > b {
                Seen::LeftBall
            } else {
                Seen::RightBall
            }
        }
        _ => Seen::Rest,
    }
}

/// The share of pixels on which a scene and a picture agree about what is seen.
fn agreement(name: &str, image: &Rgb8Image, in_picture: fn([u8; 3]) -> Seen) -> f64 {
    let (scene, _) = catoptra_scene::load(&scene_file(&format!("seed/{name}.kdl"))).expect("a seed scene");
    let film = film(&scene, "wide", SIZE, 0);
    let agree =
        |&(x, y): &(u32, u32)| image.pixel(x, y).map(in_picture) == Some(seen_by(&scene, &film, x, y));
    let share = places().filter(agree).count() as f64 / places().count() as f64;
    println!("{name}: the same surface on {:.3} % of the pixels", 100.0 * share);
    share
}

#[test]
fn the_balls_have_the_same_silhouettes() {
    let Some(folder) = folder() else { return };
    // `material` has the geometry of `depth`, whose colours alone tell all surfaces apart.
    let image = reference(&folder, "depth");
    for name in ["depth", "material"] {
        assert!(agreement(name, &image, seen_in) >= 0.995, "{name}");
    }
}

#[test]
fn the_tetrahedron_has_the_same_silhouette() {
    let Some(folder) = folder() else { return };
    let lit = |rgb: [u8; 3]| if rgb == [0; 3] { Seen::Nothing } else { Seen::Rest };
    assert!(agreement("tetra", &reference(&folder, "tetra"), lit) >= 0.995);
}
