//! Is the light at points that of formulas, and do surfaces that hold a point leave it free?
#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::f64::consts::PI;

use catoptra_core::glam::DVec3;
use catoptra_core::scene::Scene;
use catoptra_core::{MeshSource, TriangleMesh, geometry::Mesh};
use catoptra_tests::{camera_of, film, parsed};
use catoptra_tracer::{
    Control, Irradiance, Pool, ProbeOptions, Receiver, Size, Snapshot, View, irradiance_at, pick,
};

fn measured(scene: &Scene, receivers: &[[DVec3; 2]], options: &ProbeOptions) -> Vec<Irradiance> {
    let pool = Pool::new(2).unwrap();
    let snapshot = Snapshot::extract(scene, &pool);
    let receivers: Vec<Receiver> =
        receivers.iter().map(|[point, normal]| Receiver::new(*point, *normal).unwrap()).collect();
    irradiance_at(&snapshot, &receivers, options, &pool, &Control::default()).unwrap()
}

/// The green light at one receiver, which must be certain.
fn certain(text: &str, point: [f64; 3], normal: [f64; 3]) -> f64 {
    let receiver = [DVec3::from(point), DVec3::from(normal)];
    let found = measured(&parsed(text), &[receiver], &ProbeOptions::default())[0];
    assert_eq!(found.error.to_array(), [0.0; 3]);
    found.mean.g
}

#[track_caller]
fn assert_near(found: f64, right: f64) {
    assert!((found - right).abs() <= 1e-12 * right.abs().max(1e-3), "{found} instead of {right}");
}

#[test]
fn lights_of_all_kinds_add_up() {
    let point = "point-light \"a\" { position 0 2 0; intensity 8 }";
    let sun = "directional-light \"b\" { direction 0 -3 4; irradiance 10 }";
    let sky = "ambient-light \"c\" { radiance 0.5 }";
    let ball = "sphere-light \"d\" { center 0 2 0; radius 0.5; radiance 1 }";
    let spot = "spot-light \"e\" { position 0 2 0; direction 0 1 0; intensity 8; inner 20; outer 40 }";
    let parts = [(point, 2.0), (sun, 6.0), (sky, 0.5 * PI), (ball, PI / 16.0), (spot, 0.0)];
    for (text, right) in parts {
        assert_near(certain(text, [0.0; 3], [0.0, 2.0, 0.0]), right);
    }
    // The bulb is a body and would hide the lamp within.
    let ball = ball.replace("radiance 1", "radiance 1; visible #false");
    let all = [point, sun, sky, &ball, spot].join("\n");
    assert_near(certain(&all, [0.0; 3], [0.0, 2.0, 0.0]), 8.0 + 0.5 * PI + PI / 16.0);
}

#[test]
fn bodies_block_light_from_points_and_directions() {
    let lights = "point-light \"a\" { position 0 2 0; intensity 8 }\ndirectional-light \"b\" { direction 0 -1 0; irradiance 10 }";
    let text = format!(
        "{lights}\nmatte \"m\" {{ color 0.5 }}\nsphere \"s\" material=\"m\" {{ center 0 1 0; radius 0.1 }}"
    );
    assert_eq!(certain(&text, [0.0; 3], [0.0, 1.0, 0.0]), 0.0);
    let shadowless = text.replace("intensity 8", "intensity 8; shadow #false");
    assert_near(certain(&shadowless, [0.0; 3], [0.0, 1.0, 0.0]), 2.0);
}

/// A room of planes, rectangles, a turned box and a ball, under a lamp of each kind.
const ROOM: &str = r#"
camera "c" { eye 0.3 1.6 2.5; target 0 0.5 0; fov 80 }
matte "m" { color 0.5 }
plane "floor" material="m" { normal 0.1 1 0.2 }
rectangle "wall" material="m" { corner -1.3 -2 -1; edge-u 3 0 0; edge-v 0 5 0 }
rectangle "side" material="m" { corner -1.3 -2 -1; edge-u 0 0 3; edge-v 0 5 0 }
box "box" material="m" { min -0.2 0.2 -0.3; max 0.3 0.6 0.2; turn 33 1 2 3 }
sphere "ball" material="m" { center 0.8 0.35 0.3; radius 0.3 }
tetrahedron "solid" material="m" { a -0.9 0 0.9; b -0.4 0 0.9; c -0.6 0 1.4; d -0.6 0.4 1.1 }
"#;

const LAMPS: [&str; 3] = [
    "point-light \"l\" { position 0.5 2.5 0.7; intensity 8 }",
    "rectangle-light \"l\" { corner 0.2 2.5 0.2; edge-u 0.9 0 0; edge-v 0 0 0.9; radiance 3; visible #false }",
    "sphere-light \"l\" { center 0.5 2.5 0.7; radius 0.2; radiance 3; visible #false }",
];

#[test]
fn points_on_surfaces_have_the_light_of_points_just_above_them() {
    for lamp in LAMPS {
        let scene = parsed(&format!("{ROOM}{lamp}"));
        let pool = Pool::new(1).unwrap();
        let snapshot = Snapshot::extract(&scene, &pool);
        let view = View::of(&scene, camera_of(&scene), Size::new(40, 30));
        let seen = (0..30).flat_map(|y| (0..40).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
        let picks = seen.filter_map(|(x, y)| pick(&snapshot, &view, x, y));
        let (on, above): (Vec<_>, Vec<_>) =
            picks.map(|p| ([p.point, p.normal], [p.point + p.normal * 1e-7, p.normal])).unzip();
        assert!(on.len() > 1000);
        let [on, above] = [on, above].map(|points| measured(&scene, &points, &ProbeOptions::default()));
        let differ = |(on, above): &(Irradiance, Irradiance)| (on.mean.g - above.mean.g).abs() > 1e-5;
        let odd = on.iter().copied().zip(above).filter(differ).count();
        // Where a shadow's edge runs between the two.
        assert!(odd <= 2, "{odd} differ under {lamp}");
    }
}

#[test]
fn a_corner_lies_on_all_that_meet_there() {
    let lamps = [
        "rectangle-light \"l\" { corner 0.4 2 0.4; edge-u 1 0 0; edge-v 0 0 1; radiance 3; visible #false }",
        "point-light \"l\" { position 0.9 2 0.9; intensity 3 }",
        "directional-light \"l\" { direction -1 -2 -1; irradiance 3 }",
    ];
    let walls = [
        "plane \"x\" material=\"m\" { point 0.1 0 0; normal 1 0 0 }\nplane \"z\" material=\"m\" { point 0 0 0.1; normal 0 0 1 }",
        "rectangle \"x\" material=\"m\" { corner 0.1 -1 0.1; edge-u 0 0 3; edge-v 0 4 0 }\nrectangle \"z\" material=\"m\" { corner 0.1 -1 0.1; edge-u 3 0 0; edge-v 0 4 0 }",
        "box \"x\" material=\"m\" { min -1 -1 -1; max 0.1 4 4 }\nbox \"z\" material=\"m\" { min -1 -1 -1; max 4 4 0.1 }",
    ];
    for lamp in lamps {
        let open = certain(lamp, [0.1, 0.7, 0.1], [0.0, 1.0, 0.0]);
        for walls in walls {
            let text = format!("matte \"m\" {{ color 0.5 }}\n{lamp}\n{walls}");
            for nudge in [0.0, 1e-16, -1e-16, 3e-13] {
                let at = [0.1 - nudge, 0.7, 0.1 + nudge];
                let found = certain(&text, at, [0.0, 1.0, 0.0]);
                assert!((found - open).abs() < 1e-9, "{found} of {open}: {text}");
            }
        }
    }
}

#[test]
fn a_ball_hides_what_lies_behind_the_plane_that_touches_it() {
    let ball = "matte \"m\" { color 0.5 }\nsphere \"b\" material=\"m\" { center 0 0 0; radius 1 }";
    let lamp = "disk-light \"l\" { center 0 5 0; normal 0 -1 0; radius 2; radiance 1 }";
    let text = format!("{ball}\n{lamp}");
    let top = PI * 4.0 / (16.0 + 4.0);
    assert_near(certain(&text, [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]), top);
    assert_eq!(certain(&text, [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]), 0.0);
    // On the side, half of the lamp lies behind.
    let side = certain(&text, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let wall = "matte \"m\" { color 0.5 }\nrectangle \"w\" material=\"m\" { corner 0.999999999 -9 -9; edge-u 0 18 0; edge-v 0 0 18 }";
    let beside = certain(&format!("{wall}\n{lamp}"), [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    assert!((side - beside).abs() < 1e-6 && side > 0.05, "{side} {beside}");
}

/// The scene with a closed mesh in the shape of a cube of half edge 1 about (0, 1, 0), and one beside it.
fn with_mesh(text: &str) -> Scene {
    let mut scene = parsed(text);
    let corners: Vec<[f32; 3]> =
        (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 })).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let mesh = std::sync::Arc::new(TriangleMesh::new(corners, triangles, None, None).unwrap());
    let grey = scene.material_named("m").unwrap();
    let mesh = Mesh::new(MeshSource { path: "cube".to_owned(), mesh });
    let cube = scene.add_shape("cube", mesh, grey, None).unwrap();
    let up = catoptra_core::Placement::IDENTITY.moved(DVec3::Y).unwrap();
    scene.apply(catoptra_core::Edit::Placement(cube, up)).unwrap();
    scene
}

const LAMP: &str = "matte \"m\" { color 0.5 }\nrectangle-light \"l\" { corner -1 4 -1; edge-u 2 0 0; edge-v 0 0 2; radiance 2 1 0.5 }";

#[test]
fn behind_a_mesh_the_standard_error_says_how_far_the_mean_may_be_off() {
    let cube = "box \"b\" material=\"m\" { min -1 0 -1; max 1 2 1 }";
    let points: Vec<[DVec3; 2]> =
        (0..400).map(|i| [DVec3::new(1.2 + f64::from(i) * 0.004, 0.0, 0.3), DVec3::Y]).collect();
    let right = measured(&parsed(&format!("{LAMP}\n{cube}")), &points, &ProbeOptions::default());
    let scene = with_mesh(LAMP);
    for (rays, most) in [(32, 0.2), (1024, 0.02)] {
        let (mut covered, mut sampled) = (0, 0);
        for seed in 0..4 {
            let found = measured(&scene, &points, &ProbeOptions { rays, seed, ..ProbeOptions::default() });
            for (found, right) in found.iter().zip(&right) {
                let (off, error) = ((found.mean.g - right.mean.g).abs(), found.error.g);
                assert!(error < most && found.error.r == 2.0 * error, "{error}");
                if right.mean.g > 0.0 {
                    sampled += 1;
                    covered += u32::from(off <= 1.96 * error);
                }
            }
        }
        let share = f64::from(covered) / f64::from(sampled);
        assert!((0.92..0.985).contains(&share), "{rays} rays: {share} of {sampled} are covered");
    }
}

#[test]
fn rays_go_on_until_the_error_is_as_small_as_asked() {
    let scene = with_mesh(LAMP);
    let points = [[DVec3::new(2.0, 0.0, 0.3), DVec3::Y]];
    let options = ProbeOptions { rays: 1, max_error: Some(1e-4), seed: 3, ..ProbeOptions::default() };
    let found = measured(&scene, &points, &options)[0];
    assert!(found.error.max_channel() <= 1e-4 && found.error.max_channel() > 1e-6, "{found:?}");
    let cube = "box \"b\" material=\"m\" { min -1 0 -1; max 1 2 1 }";
    let right = measured(&parsed(&format!("{LAMP}\n{cube}")), &points, &ProbeOptions::default())[0];
    assert!((found.mean.g - right.mean.g).abs() < 4e-4, "{found:?} {right:?}");
}

#[test]
fn a_mesh_that_holds_the_point_leaves_it_free() {
    let scene = with_mesh(LAMP);
    // Within a face, on an edge between two triangles, on an edge of the cube and at its corner.
    for at in [[0.3, 2.0, 0.1], [0.5, 2.0, 0.5], [1.0, 2.0, 0.3], [1.0, 2.0, 1.0]] {
        let point = [DVec3::from(at), DVec3::Y];
        let found = measured(&scene, &[point], &ProbeOptions::default())[0];
        let open = measured(&parsed(LAMP), &[point], &ProbeOptions::default())[0];
        assert!((found.mean.g - open.mean.g).abs() < 1e-12, "{at:?}: {found:?} {open:?}");
        let below = measured(&scene, &[[point[0], DVec3::NEG_Y]], &ProbeOptions::default())[0];
        assert_eq!(below.mean.g, 0.0);
    }
}

#[test]
fn many_lamps_are_picked_and_the_error_says_how_well() {
    let lamp = |i: i32| {
        format!(
            "sphere-light \"l{i}\" {{ center {} {} 2; radius 0.02; radiance 50; visible #false }}\n",
            f64::from(i % 40) * 0.1 - 2.0,
            f64::from(i / 40) * 0.1 - 1.5
        )
    };
    let text: String = (0..1200).map(lamp).collect();
    let points = [[DVec3::ZERO, DVec3::Z]];
    let found =
        measured(&parsed(&text), &points, &ProbeOptions { rays: 1 << 14, ..ProbeOptions::default() })[0];
    let center = |i: i32| DVec3::new(f64::from(i % 40) * 0.1 - 2.0, f64::from(i / 40) * 0.1 - 1.5, 2.0);
    let right: f64 = (0..1200).map(|i| 50.0 * PI * 0.02 * 0.02 * 2.0 / center(i).length().powi(3)).sum();
    assert!(found.error.g > 0.0 && found.error.g < 0.01 * right, "{found:?}");
    assert!((found.mean.g - right).abs() < 4.0 * found.error.g, "{found:?} {right}");
}

#[test]
fn where_walls_meet_pixels_are_lit_by_every_backend() {
    let room = r#"
camera "c" { eye 0 0 3.9; target 0 0 0; fov 39.3077 }
matte "m" { color 0.5 }
rectangle-light "lamp" { corner -0.23 0.99 -0.18; edge-u 0.46 0 0; edge-v 0 0 0.38; radiance 18 }
rectangle "floor" material="m" { corner -1 -1 -1; edge-u 2 0 0; edge-v 0 0 2 }
rectangle "ceiling" material="m" { corner -1 1 -1; edge-u 2 0 0; edge-v 0 0 2 }
rectangle "back" material="m" { corner -1 -1 -1; edge-u 2 0 0; edge-v 0 2 0 }
rectangle "right" material="m" { corner 1 -1 -1; edge-u 0 2 0; edge-v 0 0 2 }
rectangle "left" material="m" { corner -1 -1 -1; edge-u 0 2 0; edge-v 0 0 2 }
"#;
    let size = Size::new(128, 128);
    for backend in ["oracle", "wide"] {
        let film = film(&parsed(room), backend, size, 0);
        for i in (70..124).flat_map(|y| [(y, y), (127 - y, y)]) {
            // Where the floor meets a side wall, and neighbours within the floor.
            let [here, beside] = [film.radiance(i.0, i.1)[0], film.radiance(64, i.1)[0]];
            assert!(here > 0.05 * beside, "{backend} {i:?}: {here} beside {beside}");
        }
    }
}
