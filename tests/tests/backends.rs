//! Does every backend see what the exhaustive one sees, on every shipped scene?

use std::path::Path;

use catoptra_core::Scene;
use catoptra_tests::{Comparison, Rates, film, shipped_scenes, triangles};
use catoptra_tracer::{Size, backends};

/// One pixel in 10,000 may see another surface; where the surface is the same, so is the colour.
///
/// Colours have a rate too, since the edge of a shadow or of a reflection is a surface seen by a ray that the film does not keep.
const RATES: Rates = Rates { surfaces: 1e-4, colors: 1e-4 };

/// A size at which trying every triangle for every ray stays a matter of seconds.
fn affordable(scene: &Scene) -> Size {
    match triangles(scene) {
        0 => Size::new(450, 450),
        1..1_000 => Size::new(200, 150),
        _ => Size::new(128, 80),
    }
}

#[test]
fn every_backend_equals_the_oracle_on_every_shipped_scene() {
    let scenes = shipped_scenes();
    assert!(scenes.len() >= 11, "eight seed scenes and three of the gallery, not {}", scenes.len());
    let mut failures = Vec::new();
    for (name, scene) in &scenes {
        let size = affordable(scene);
        let reference = film(scene, "oracle", size, 0);
        for backend in backends().iter().filter(|backend| backend.name() != "oracle") {
            let test = film(scene, backend.name(), size, 0);
            let comparison = Comparison::new(format!("{name} by {}", backend.name()), &reference, &test);
            let (surfaces, colors) = comparison.counts();
            println!("{name} by {}: {surfaces} surfaces and {colors} colours differ", backend.name());
            failures.extend(comparison.within(RATES, Path::new(env!("CARGO_TARGET_TMPDIR"))).err());
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
