//! Are the bits of a film the same however the work is shared out?

use catoptra_core::geometry::{Plane, Sphere};
use catoptra_core::glam::DVec3;
use catoptra_core::light::PointLight;
use catoptra_core::material::Phong;
use catoptra_core::{Part, Rgb, Scene};
use catoptra_lab::scenes::{many_instances, placed_mesh};
use catoptra_tests::{
    assert_same_bits, assert_same_part, camera_of, film, parsed, shipped_scenes, traced, triangles,
};
use catoptra_tracer::{Film, Instructions, Moments, Pattern, Region, Size, Skip, View, backends};

/// Of two mirrors side by side, the left one shows, in a mirror beside the camera, the right one with darkness in it; the
/// right one itself shows a ball.
const MIRRORS: &str = r#"
settings { max-depth 4 }
camera "main" { eye 0 0 0; direction 0.1 0 -1; fov 40 }
depth "mirror" { color 0.2 0.4 0.6; range 30; reflectiveness 0.5 }
depth "red" { color 1 0 0; range 30 }
rectangle "left" material="mirror" { corner -0.445 -0.15 -5.038; edge-u 0.29 0 0.0765; edge-v 0 0.3 0 }
rectangle "right" material="mirror" { corner 0.155 -0.15 -4.962; edge-u 0.29 0 -0.0765; edge-v 0 0.3 0 }
rectangle "beside" material="mirror" { corner -1.583 -0.5 -1.724; edge-u -0.834 0 -0.552; edge-v 0 1 0 }
sphere "ball" material="red" { center 2 0 -2; radius 0.3 }
"#;

/// So many turned meshes in a box, among them a ball and over a floor, under a sun and a lamp that stands between them.
fn crowd(count: u32) -> Scene {
    let mut scene = many_instances(count, 12).expect("a scene");
    let shiny =
        Phong::new(Rgb::grey(0.3)).and_then(|phong| phong.with("reflectiveness", 0.4)).expect("a material");
    let shiny = scene.add_material("shiny", shiny).expect("a name");
    let floor = Plane::new(DVec3::Y * -6.0, DVec3::Y).expect("a plane");
    scene.add_shape("floor", floor, shiny, None).expect("a name");
    scene
        .add_shape("ball", Sphere::new(DVec3::new(0.3, 0.2, 0.1), 2.5).expect("a ball"), shiny, None)
        .expect("a name");
    let lamp = PointLight::new(DVec3::new(4.0, 3.0, 5.0), Rgb::grey(90.0)).expect("a light");
    scene.add_light("lamp", lamp, None).expect("a name");
    scene
}

/// The shipped scenes, mirrors, a mesh that is moved, turned and scaled, and many of them among other shapes.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = shipped_scenes();
    scenes.push(("mirrors".to_owned(), parsed(MIRRORS)));
    scenes.push(("a placed mesh".to_owned(), placed_mesh(20).expect("a scene")));
    scenes.extend([1, 27].map(|count| (format!("{count} meshes among others"), crowd(count))));
    scenes
}

/// What a scene's first camera sees by one sample a pixel, with reflections and their order in play.
fn view(scene: &Scene) -> View {
    View { moments: Moments::Luminance, samples: 1, ..View::of(scene, camera_of(scene), ODD) }
}

/// A size that no tile divides, so that tiles at the border are cut.
const ODD: Size = Size::new(123, 77);

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for (name, scene) in scenes() {
        for backend in backends() {
            if backend.name() == "oracle" && triangles(&scene) > 1_000 {
                continue;
            }
            let alone = film(&scene, backend.name(), ODD, 1);
            for threads in [2, 3, 7] {
                let shared = film(&scene, backend.name(), ODD, threads);
                assert_same_bits(
                    &alone,
                    &shared,
                    &format!("{name} by {} with {threads} threads", backend.name()),
                );
            }
        }
    }
}

#[test]
fn the_size_of_the_tiles_does_not_matter() {
    for (name, scene) in scenes() {
        let view = view(&scene);
        for backend in ["wide", "scalar"] {
            let usual = traced(&scene, backend, &view, Film::new(ODD), 2);
            for edge in [4, 8, 12, 16, 20, 36, 64, 1024] {
                let tiled = traced(&scene, backend, &view, Film::with_tiles(ODD, edge), 2);
                assert_same_bits(&usual, &tiled, &format!("{name} by {backend} in tiles of {edge}"));
            }
        }
    }
}

#[test]
fn every_kind_of_instructions_gives_the_same_bits() {
    for (name, scene) in scenes() {
        for (samples, pattern) in
            [(1, Pattern::Owen), (9, Pattern::Grid), (3, Pattern::Sobol), (3, Pattern::Owen)]
        {
            let view = View { samples, pattern, ..view(&scene) };
            let usual = traced(&scene, "wide", &view, Film::new(ODD), 2);
            for instructions in Instructions::all() {
                let view = View { instructions: Some(instructions), ..view.clone() };
                let forced = traced(&scene, "wide", &view, Film::with_tiles(ODD, 16), 2);
                assert_same_bits(
                    &usual,
                    &forced,
                    &format!("{name} with {instructions:?}, {samples} by {pattern:?}"),
                );
            }
        }
    }
}

#[test]
fn a_crop_has_the_bits_of_the_whole_picture() {
    let crops = [
        Region::new(0, 0, Size::new(5, 3)),
        Region::new(17, 11, Size::new(50, 41)),
        Region::new(101, 70, Size::new(900, 900)),
    ];
    for (name, scene) in scenes() {
        for backend in ["wide", "scalar"] {
            let view = View { samples: 7, ..view(&scene) };
            let whole = traced(&scene, backend, &view, Film::new(ODD), 2);
            for crop in crops {
                let view = View { crop: Some(crop), ..view.clone() };
                let part = traced(&scene, backend, &view, Film::of_region(view.region(), 24), 2);
                assert_same_part(&whole, &part, &format!("{name} by {backend} cropped to {crop:?}"));
            }
        }
    }
}

#[test]
fn a_second_render_gives_the_same_bits() {
    for (name, scene) in scenes() {
        let (first, second) = (film(&scene, "wide", ODD, 2), film(&scene, "wide", ODD, 2));
        assert_same_bits(&first, &second, &name);
    }
}

#[test]
fn a_film_that_is_traced_over_has_the_bits_of_a_new_one() {
    let ball = |background: &str, x: f64| {
        parsed(&format!(
            r#"
            settings {{ background {background} }}
            camera "main" {{ eye 0 0 0; direction 0 0 -1; fov 40 }}
            depth "red" {{ color 1 0 0; range 30 }}
            sphere "ball" material="red" {{ center {x} 0 -5; radius 0.5 }}
            "#
        ))
    };
    let small_tiles = || Film::with_tiles(ODD, 16);
    let mut film = small_tiles();
    let turns = [
        (ball("0 0 0", 0.0), "wide", 1),
        (ball("0 0 0", 1.0), "wide", 1),
        (ball("0.1 0.2 0.3", 1.0), "wide", 1),
        (ball("0.1 0.2 0.3", 1.0), "wide", 2),
        (ball("0.1 0.2 0.3", 0.0), "wide", 1),
        (ball("0 0 0", 0.0), "scalar", 1),
        (ball("0.1 0.2 0.3", 0.0), "wide", 1),
        (ball("0.1 0.2 0.3", -9.0), "wide", 1),
        (ball("0 0 0", -9.0), "wide", 1),
    ];
    for (turn, (scene, backend, samples)) in turns.iter().enumerate() {
        let view = View { samples: *samples, ..view(scene) };
        film = traced(scene, backend, &view, film, 2);
        let new = traced(scene, backend, &view, small_tiles(), 2);
        assert_same_bits(&new, &film, &format!("turn {turn}, by {backend}, {samples} samples"));
    }
}

#[test]
fn work_left_out_changes_no_bit() {
    let skips = [
        Skip::NOTHING,
        Skip { hidden: true, ..Skip::NOTHING },
        Skip { shafts: true, ..Skip::NOTHING },
        Skip { beams: true, ..Skip::NOTHING },
        Skip { unreached: true, ..Skip::NOTHING },
        Skip { hidden: true, blank: true, ..Skip::NOTHING },
        Skip { walks: true, ..Skip::NOTHING },
        Skip { walks: false, ..Skip::ALL },
    ];
    for (name, scene) in scenes() {
        for samples in [1, 4] {
            let view = View { samples, ..view(&scene) };
            let usual = traced(&scene, "wide", &view, Film::new(ODD), 2);
            for skip in skips {
                let view = View { skip, ..view.clone() };
                let long = traced(&scene, "wide", &view, Film::new(ODD), 2);
                assert_same_bits(&usual, &long, &format!("{name}, {samples} samples, with {skip:?}"));
            }
        }
    }
}
