//! Are the bits of a film the same however the work is shared out?

use catoptra_core::EntityId;
use catoptra_tests::{camera_of, film, shipped_scenes, traced, triangles};
use catoptra_tracer::{Film, Size, Skip, View, backends};

/// Everything that a film knows of each pixel, colours and depths by their bits.
fn bits(film: &Film) -> Vec<([u32; 3], u32, Option<EntityId>)> {
    let Size { width, height } = film.size();
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    places
        .map(|(x, y)| (film.radiance(x, y).map(f32::to_bits), film.depth(x, y).to_bits(), film.surface(x, y)))
        .collect()
}

#[track_caller]
fn assert_same_bits(reference: &Film, test: &Film, what: &str) {
    let (reference, test) = (bits(reference), bits(test));
    let differing: Vec<usize> = (0..reference.len()).filter(|&i| reference[i] != test[i]).collect();
    if let Some(&first) = differing.first() {
        let (x, y) = (first % ODD.width as usize, first / ODD.width as usize);
        let (was, is) = (reference[first], test[first]);
        panic!("{what}: {} pixels differ, the first at {x},{y}: {was:x?} became {is:x?}", differing.len());
    }
}

/// A size that no tile divides, so that tiles at the border are cut.
const ODD: Size = Size::new(123, 77);

#[test]
fn one_two_and_three_threads_give_the_same_bits() {
    for (name, scene) in shipped_scenes() {
        for backend in backends() {
            if backend.name() == "oracle" && triangles(&scene) > 1_000 {
                continue;
            }
            let alone = film(&scene, backend.name(), ODD, 1);
            for threads in [2, 3] {
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
    for (name, scene) in shipped_scenes() {
        let view = View::of(&scene, camera_of(&scene), ODD);
        for backend in ["wide", "scalar"] {
            let usual = traced(&scene, backend, &view, Film::new(ODD), 2);
            for edge in [4, 20, 64, 1024] {
                let tiled = traced(&scene, backend, &view, Film::with_tiles(ODD, edge), 2);
                assert_same_bits(&usual, &tiled, &format!("{name} by {backend} in tiles of {edge}"));
            }
        }
    }
}

#[test]
fn a_second_render_gives_the_same_bits() {
    for (name, scene) in shipped_scenes() {
        let (first, second) = (film(&scene, "wide", ODD, 2), film(&scene, "wide", ODD, 2));
        assert_same_bits(&first, &second, &name);
    }
}

#[test]
fn work_left_out_changes_no_bit() {
    let skips =
        [Skip::NOTHING, Skip { hidden: true, ..Skip::NOTHING }, Skip { shafts: true, ..Skip::NOTHING }];
    for (name, scene) in shipped_scenes() {
        let view = View::of(&scene, camera_of(&scene), ODD);
        let usual = traced(&scene, "wide", &view, Film::new(ODD), 2);
        for skip in skips {
            let view = View { skip, ..view.clone() };
            let long = traced(&scene, "wide", &view, Film::new(ODD), 2);
            assert_same_bits(&usual, &long, &format!("{name} with {skip:?}"));
        }
    }
}
