//! Does every backend see what the exhaustive one sees, on every shipped scene?

use std::path::Path;

use catoptra_core::{Role, Scene};
use catoptra_lab::scenes::placed_mesh_under_the_sun;
use catoptra_tests::{Comparison, Rates, film, is_by_chance, parsed, shipped_scenes, triangles};
use catoptra_tracer::{Size, backends};

/// One pixel in 10,000 may see another surface; where the surface is the same, so is the colour.
///
/// Colours have a rate too, since the edge of a shadow or of a reflection is a surface seen by a ray that the film does not keep.
const RATES: Rates = Rates { surfaces: 1e-4, colors: 1e-4 };

/// By how much the means of pictures may differ whose paths lanes choose by chance in a way of their own.
const MEANS_APART: f64 = 0.03;

/// A size at which trying every shape and triangle for every ray stays a matter of seconds.
fn affordable(scene: &Scene) -> Size {
    match triangles(scene) + scene.entities_of(Role::Shape).count() {
        ..100 => Size::new(450, 450),
        100..1_000 => Size::new(200, 150),
        _ => Size::new(128, 80),
    }
}

/// An eye within a tetrahedron of mirrors, with a lamp and a small tetrahedron and a ball that are seen from outside.
const INSIDE: &str = r#"
settings { max-depth 4 }
camera "main" { eye 0 0.5 0; direction 0.3 -0.1 -1; fov 100 }
phong "glass" { diffuse 0.4 0.5 0.6; specular 1 1 1; shininess 20; reflectiveness 0.5 }
tetrahedron "room" material="glass" { a -4 -2 -4; b 5 -2 -3; c 0 -2 6; d 0.5 6 0.5 }
tetrahedron "pebble" material="glass" { a -1 -1 -1.5; b 0 -1 -2; c -0.5 0 -2; d -1 -1 -2.5 }
sphere "ball" material="glass" { center 1 -0.5 -2; radius 0.7 }
point-light "lamp" { position 0.2 2 0.3; intensity 20 }
"#;

/// An eye within a box whose walls mirror, with boxes and disks that are turned or as thin as a sheet, some of which touch,
/// under a lamp and under suns that shine along an axis and almost so.
const ROOM: &str = r#"
settings { max-depth 4 }
camera "main" { eye 0.2 1.1 3; direction -0.1 -0.1 -1; fov 80 }
phong "glossy" { diffuse 0.5 0.5 0.4; specular 1 1 1; shininess 30; reflectiveness 0.4 }
matte "chalk" { color 0.8 0.7 0.6 }
box "walls" material="glossy" { min -3 -0.5 -4; max 3 4 4 }
box "block" material="glossy" { min -1.5 -0.5 -2; max -0.5 0.5 -1 }
disk "lid" material="chalk" { center -1 0.50001 -1.5; normal 0 1 0; radius 0.6 }
box "sheet" material="chalk" { min 0.2 0 -1.5; max 1.4 1.5 -1.4999999 }
group "turned" {
    turn 31 0.2 1 -0.4 { about 1 0.5 0 }
    box "brick" material="glossy" { min 0.7 0.3 -0.2; max 1.3 0.7 0.2 }
    disk "plate" material="glossy" { center 1 1.1 0; normal 0.1 1 0.3; radius 0.5 }
    rectangle "card" material="chalk" { corner 0.5 0.2 0.5; edge-u 0.5 0 0; edge-v 0 0.4 0.1 }
}
point-light "lamp" { position 0.3 3 0.4; intensity 12 }
directional-light "noon" { direction 0 -1 0; irradiance 1 }
directional-light "morning" { direction -1 -0.00000001 0; irradiance 0.5 }
"#;

/// How a picture of a scene by every backend differs from the oracle's beyond the rates.
fn failures(name: &str, scene: &Scene) -> Vec<String> {
    let size = affordable(scene);
    let reference = film(scene, "oracle", size, 0);
    let mut failures = Vec::new();
    for backend in backends().iter().filter(|backend| backend.name() != "oracle") {
        let test = film(scene, backend.name(), size, 0);
        let comparison = Comparison::new(format!("{name} by {}", backend.name()), &reference, &test);
        let (surfaces, colors) = comparison.counts();
        if backend.name() == "wide" && is_by_chance(name) {
            failures.extend(comparison.agrees_in_the_mean(RATES, MEANS_APART).err());
            continue;
        }
        println!("{name} by {}: {surfaces} surfaces and {colors} colours differ", backend.name());
        failures.extend(comparison.within(RATES, Path::new(env!("CARGO_TARGET_TMPDIR"))).err());
    }
    failures
}

#[test]
fn every_backend_equals_the_oracle_on_every_shipped_scene() {
    let scenes = shipped_scenes();
    assert!(scenes.len() >= 20, "eight seed scenes and twelve of the gallery, not {}", scenes.len());
    let failures: Vec<_> = scenes.iter().flat_map(|(name, scene)| failures(name, scene)).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_backend_equals_the_oracle_within_a_solid_of_mirrors() {
    let failures = failures("inside", &parsed(INSIDE));
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_backend_equals_the_oracle_among_boxes_and_disks() {
    let inside = failures("room", &parsed(ROOM));
    // Without the walls, which keep the suns out.
    let outside = ROOM.lines().filter(|line| !line.contains("\"walls\"")).collect::<Vec<_>>().join("\n");
    let outside = failures("boxes and disks", &parsed(&outside));
    assert!(inside.is_empty() && outside.is_empty(), "{}", [inside, outside].concat().join("\n"));
}

#[test]
fn every_backend_equals_the_oracle_on_placed_meshes_under_lamps_and_the_sun() {
    let failures = failures("placed meshes", &placed_mesh_under_the_sun(12).expect("a scene"));
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
