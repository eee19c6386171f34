//! Does ambient occlusion show what formulas say it must, the same bits however the work is shared out, and no NaN?

use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

use catoptra_core::geometry::Mesh;
use catoptra_core::glam::DVec3;
use catoptra_core::material::Matte;
use catoptra_core::{Camera, Integrator, MeshSource, Rgb, Scene, TriangleMesh};
use catoptra_lab::scenes::placed_mesh;
use catoptra_tests::{
    Comparison, Rates, assert_same_bits, assert_same_part, camera_of, parsed, shipped_scenes, traced,
    triangles,
};
use catoptra_tracer::{Film, Instructions, Moments, Pattern, Region, Size, Skip, View, backends};

/// Pixels that all show the same point, give or take a millimetre: each asks the same question with numbers of its own.
const SAME: Size = Size::new(24, 24);

/// Every backend's pixels have this mean, to three of its standard errors, which are themselves small. Pixels that all agree
/// show it to a rounding of `f32`.
#[track_caller]
fn assert_sees(scene: &Scene, expected: f64, what: &str) {
    let view = View { pattern: Pattern::Sobol, samples: 16, ..View::of(scene, camera_of(scene), SAME) };
    assert_eq!(view.integrator, Integrator::Occlusion, "{what}");
    for backend in backends() {
        let film = traced(scene, backend.name(), &view, Film::new(SAME), 1);
        let pixels: Vec<f64> = film.radiances().iter().map(|light| f64::from(light[0])).collect();
        assert!(film.radiances().iter().all(|[r, g, b]| r == g && g == b), "{what} is grey");
        let count = pixels.len() as f64;
        let mean = pixels.iter().sum::<f64>() / count;
        let variance = pixels.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let error = (variance / count).sqrt();
        let off = (mean - expected).abs();
        let name = backend.name();
        println!("{what} by {name}: {mean:.5} ± {error:.5} for {expected:.5}");
        assert!(error < 0.004, "{what} by {name}: a standard error of {error}");
        assert!(off <= 3.0 * error + 1e-6, "{what} by {name}: {mean} ± {error} instead of {expected}");
    }
}

/// A scene of grey things whose first camera looks from one point closely at another.
fn scene(distance: Option<f64>, [eye, target]: [DVec3; 2], things: &str) -> Scene {
    let distance = distance.map_or(String::new(), |distance| format!("occlusion-distance {distance:?}"));
    let words = |v: DVec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);
    parsed(&format!(
        r#"
        settings {{ integrator "occlusion"; {distance} }}
        camera "eye" {{ eye {}; target {}; up 0.1 0.7 0.3; fov 0.005 }}
        matte "grey" {{ color 0.5 }}
        plane "floor" material="grey"
        {things}
        "#,
        words(eye),
        words(target)
    ))
}

/// From the right of a point of the floor.
fn beside(x: f64) -> [DVec3; 2] {
    [DVec3::new(x + 3.0, 1.5, 0.4), DVec3::new(x, 0.0, 0.0)]
}

const WALL: &str = r#"plane "wall" material="grey" { normal 1 0 0 }"#;

#[test]
fn an_open_floor_sees_the_whole_sky() {
    assert_sees(&scene(None, beside(0.0), ""), 1.0, "an open floor");
}

#[test]
fn a_hillside_sees_what_the_floor_below_leaves() {
    let normal = DVec3::new(0.3, 1.0, -0.2);
    let hill = r#"plane "hill" material="grey" { point 0 3 0; normal 0.3 1 -0.2 }"#;
    for place in [DVec3::ZERO, DVec3::new(1e5, 0.0, 1.5e5)] {
        let view = beside(0.0).map(|point| point + place + DVec3::Y * 4.0);
        // Behind a floor without an end lie the directions that go down: those behind its horizon.
        let expected = f64::midpoint(1.0, normal.normalize().y);
        assert_sees(&scene(None, view, hill), expected, &format!("a hillside at {place} m"));
    }
}

#[test]
fn a_wall_without_an_end_hides_half_of_the_sky_at_any_distance() {
    for x in [0.001, 0.5, 30.0] {
        assert_sees(&scene(None, beside(x), WALL), 0.5, &format!("{x} m from a wall without an end"));
    }
}

#[test]
fn a_wall_of_some_height_hides_what_lies_below_its_edge() {
    let wall = r#"rectangle "wall" material="grey" { corner 0 0 -1e6; edge-u 0 1 0; edge-v 0 0 2e6 }"#;
    for x in [0.001, 0.5, 1.0, 4.0_f64] {
        // Of an endless wall only the edge's slope counts: (1 + cos φ) / 2, φ how high it stands.
        let expected = f64::midpoint(1.0, x / x.hypot(1.0));
        assert_sees(&scene(None, beside(x), wall), expected, &format!("{x} m from a wall of 1 m"));
    }
}

#[test]
fn a_wall_is_hidden_from_beyond_the_distance() {
    for (x, distance) in [(0.5, 0.6_f64), (0.5, 1.0), (0.5, 8.0), (0.5, 0.4)] {
        // Seen from above, directions that meet the wall within the distance are a segment of the unit disk.
        let angle = (x / distance).min(1.0).acos();
        let expected = 1.0 - (angle - angle.sin() * angle.cos()) / PI;
        let what = format!("{x} m from a wall, up to {distance} m");
        assert_sees(&scene(Some(distance), beside(x), WALL), expected, &what);
    }
}

#[test]
fn a_ball_overhead_hides_the_square_of_its_sine() {
    for (radius, height) in [(1.0, 1.25_f64), (1.0, 2.0), (0.3, 3.0)] {
        let ball = format!(r#"sphere "ball" material="grey" {{ center 0 {height:?} 0; radius {radius:?} }}"#);
        let expected = 1.0 - (radius / height).powi(2);
        assert_sees(&scene(None, beside(0.0), &ball), expected, &format!("under a ball {height} m up"));
    }
}

#[test]
fn a_ceiling_counts_up_to_the_distance() {
    let ceiling = r#"plane "ceiling" material="grey" { point 0 2 0; normal 0 -1 0 }"#;
    for distance in [1.9_f64, 2.5, 4.0, 20.0] {
        // Met where h / cos θ is at most D; the share of directions below such a slope is (h / D)².
        let expected = (2.0 / distance).powi(2).min(1.0);
        assert_sees(
            &scene(Some(distance), beside(0.0), ceiling),
            expected,
            &format!("below a ceiling, up to {distance} m"),
        );
    }
    assert_sees(&scene(None, beside(0.0), ceiling), 0.0, "below a ceiling");
}

#[test]
fn either_side_of_a_surface_sees_its_own_sky() {
    let sheet = r#"rectangle "sheet" material="grey" { corner -50 1 -50; edge-u 100 0 0; edge-v 0 0 100 }"#;
    let up = [DVec3::new(0.2, 0.5, 0.1), DVec3::new(0.0, 1.0, 0.0)];
    let down = [DVec3::new(0.2, 1.5, 0.1), DVec3::new(0.0, 1.0, 0.0)];
    assert_sees(&scene(None, up, sheet), 0.0, "a sheet from below");
    assert_sees(&scene(None, down, sheet), 1.0, "a sheet from above");
}

/// One triangle, flat, whose corners all have a normal that leans by an angle.
fn leaning(angle: f64) -> Scene {
    let normal = [angle.sin() as f32, angle.cos() as f32, 0.0];
    let corners = vec![[-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [0.0, 0.0, -9.0]];
    let mesh = TriangleMesh::new(corners, vec![[0, 1, 2]], Some(vec![normal; 3]), None).expect("a triangle");
    let mut scene = Scene::new();
    let grey = scene.add_material("grey", Matte::new(Rgb::grey(0.5)).expect("a grey")).expect("a material");
    let source = MeshSource { path: "triangle.ply".into(), mesh: Arc::new(mesh) };
    scene.add_shape("sheet", Mesh::new(source), grey, None).expect("a shape");
    let [eye, target] = beside(0.0);
    let camera = Camera::look_at(eye, target, DVec3::Y, 1e-4).expect("a camera");
    scene.add_camera("eye", camera, None).expect("a camera");
    let settings = scene.settings().with_integrator(Integrator::Occlusion);
    scene.apply(catoptra_core::Edit::Settings(settings)).expect("settings");
    scene
}

#[test]
fn what_a_smooth_normal_sends_below_the_surface_is_hidden() {
    for degrees in [0.0_f64, 20.0, 60.0] {
        let angle = degrees.to_radians();
        // The directions about the normal that the surface's own plane cuts off are those behind a wall that stands over.
        let expected = f64::midpoint(1.0, angle.cos());
        assert_sees(&leaning(angle), expected, &format!("a normal that leans by {degrees} degrees"));
    }
}

#[test]
fn where_the_camera_meets_nothing_nothing_hides_the_sky() {
    let up = [DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.1, 3.0, 0.0)];
    let scene = scene(None, up, "");
    assert_sees(&scene, 1.0, "the sky");
    let view = View::of(&scene, camera_of(&scene), SAME);
    let film = traced(&scene, "wide", &view, Film::new(SAME), 1);
    assert_eq!((film.depth(3, 3), film.surface(3, 3)), (f32::INFINITY, None));
}

/// A size that no tile divides.
const ODD: Size = Size::new(61, 39);

/// The shipped scenes, and a mesh that is moved, turned and scaled.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = shipped_scenes();
    scenes.push(("a placed mesh".to_owned(), placed_mesh(20).expect("a scene")));
    scenes
}

/// Four samples a pixel, up to 3 metres.
fn view(scene: &Scene) -> View {
    View {
        integrator: Integrator::Occlusion,
        occlusion_distance: 3.0,
        samples: 4,
        moments: Moments::Luminance,
        ..View::of(scene, camera_of(scene), ODD)
    }
}

#[test]
fn no_way_of_sharing_out_the_work_changes_a_bit() {
    let instructions = Instructions::all().into_iter().map(Some);
    for (name, scene) in scenes() {
        let view = view(&scene);
        for backend in ["wide", "scalar"] {
            let usual = traced(&scene, backend, &view, Film::new(ODD), 1);
            for (edge, threads) in [(32, 3), (4, 2), (12, 2), (64, 1)] {
                let tiled = traced(&scene, backend, &view, Film::with_tiles(ODD, edge), threads);
                assert_same_bits(
                    &usual,
                    &tiled,
                    &format!("{name} by {backend}, {threads} threads, tiles of {edge}"),
                );
            }
            let again = traced(&scene, backend, &view, usual.clone(), 2);
            assert_same_bits(&usual, &again, &format!("{name} by {backend} traced over"));
        }
        let usual = traced(&scene, "wide", &view, Film::new(ODD), 2);
        for instructions in instructions.clone() {
            let forced = View { instructions, ..view.clone() };
            let forced = traced(&scene, "wide", &forced, Film::with_tiles(ODD, 16), 2);
            assert_same_bits(&usual, &forced, &format!("{name} with {instructions:?}"));
        }
        let long = traced(&scene, "wide", &View { skip: Skip::NOTHING, ..view }, Film::new(ODD), 2);
        assert_same_bits(&usual, &long, &format!("{name} with nothing left out"));
    }
}

#[test]
fn a_crop_has_the_bits_of_the_whole_picture() {
    for (name, scene) in scenes() {
        let view = view(&scene);
        for backend in ["wide", "scalar"] {
            let whole = traced(&scene, backend, &view, Film::new(ODD), 2);
            for crop in [Region::new(0, 0, Size::new(5, 3)), Region::new(17, 11, Size::new(900, 20))] {
                let view = View { crop: Some(crop), ..view.clone() };
                let part = traced(&scene, backend, &view, Film::of_region(view.region(), 24), 2);
                assert_same_part(&whole, &part, &format!("{name} by {backend} cropped to {crop:?}"));
            }
        }
    }
}

/// One pixel in a thousand may see another surface, one in a hundred another sky: where a row of samples lies exactly where
/// a wall stands on the floor, as in `directional.kdl`, the last bit of a point decides what hides the sky from it.
const RATES: Rates = Rates { surfaces: 1e-3, colors: 1e-2 };

#[test]
fn every_backend_shows_shares_of_the_sky_and_those_of_the_oracle_on_every_scene() {
    for (name, scene) in scenes() {
        let view =
            View { size: if triangles(&scene) > 1_000 { Size::new(40, 30) } else { ODD }, ..view(&scene) };
        let film = |backend: &str| traced(&scene, backend, &view, Film::new(view.size), 0);
        let reference = film("oracle");
        for backend in backends() {
            let film = film(backend.name());
            for light in film.radiances().into_iter().flatten() {
                assert!((0.0..=1.0).contains(&light), "{name} by {}: {light}", backend.name());
            }
            let comparison =
                Comparison::new(format!("occlusion of {name} by {}", backend.name()), &reference, &film);
            println!("{name} by {}: {:?} pixels differ", backend.name(), comparison.counts());
            comparison.within(RATES, Path::new(env!("CARGO_TARGET_TMPDIR"))).expect("the oracle's sky");
        }
    }
}

#[test]
fn another_seed_makes_other_choices() {
    let scene = scene(None, beside(0.5), WALL);
    let view = View::of(&scene, camera_of(&scene), SAME);
    let seeded =
        |seed| traced(&scene, "wide", &View { seed, ..view.clone() }, Film::new(SAME), 1).radiances();
    let [first, second] = [0, 1].map(seeded);
    let differing = first.iter().zip(&second).filter(|(a, b)| a != b).count();
    // Of independent halves every other one differs.
    assert!((200..380).contains(&differing), "{differing} of {}", first.len());
}
