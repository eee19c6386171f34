//! Does moving a scene and its camera together change nothing but roundings?

use std::path::Path;

use catoptra_core::glam::DVec3;
use catoptra_core::{Edit, Integrator, Light, Material, Placement, Scene};
use catoptra_tests::{Comparison, Rates, film, is_by_chance, shipped_scenes, triangles};
use catoptra_tracer::Size;

/// Silhouettes and shadow edges may move over the centre of one pixel in a thousand.
const RATES: Rates = Rates { surfaces: 1e-3, colors: 1e-3 };

/// Odd enough that no pixel's centre falls exactly on an edge of the seed's scenes, where rounding decides what is seen.
const SIZE: Size = Size::new(122, 91);

/// Whether a material's colour depends on where in the world the surface is, or how it is turned.
fn is_tied_to_the_world(material: &Material) -> bool {
    ["checker", "depth"].contains(&material.kind_name())
}

/// Whether what is seen depends on random directions, which turn with the surfaces in a way of their own.
fn is_seen_by_chance(scene: &Scene) -> bool {
    let is_environment = |light: &Light| light.kind_name() == "environment-light";
    scene.settings().integrator() == Integrator::Path
        || scene.entities().filter_map(|id| scene.light(id)).any(|light| is_environment(&light))
}

/// Moves everything at the top of a scene, and with it all there is.
fn move_all(scene: &mut Scene, motion: &Placement) {
    let edits = scene
        .children(None)
        .into_iter()
        .filter_map(|id| scene.placement(id).map(|placement| Edit::Placement(id, placement.then(motion))));
    let edits = edits.collect();
    scene.apply(Edit::Batch(edits)).expect("a motion that can be applied");
}

/// Films of all scenes that chance plays no part in and whose materials are not tied to the world, before and after a motion.
fn assert_invariant(name: &str, motion: &Placement) {
    let mut failures = Vec::new();
    let mut tried = 0;
    for (scene_name, mut scene) in shipped_scenes() {
        if scene.materials().any(|(_, _, material)| is_tied_to_the_world(material))
            || is_seen_by_chance(&scene)
            || is_by_chance(&scene_name)
            || triangles(&scene) > 100_000
        {
            continue;
        }
        tried += 1;
        let before = film(&scene, "wide", SIZE, 0);
        move_all(&mut scene, motion);
        let after = film(&scene, "wide", SIZE, 0);
        let comparison = Comparison::new(format!("{scene_name} {name}"), &before, &after);
        println!("{scene_name} {name}: {:?} surfaces and colours differ", comparison.counts());
        failures.extend(comparison.within(RATES, Path::new(env!("CARGO_TARGET_TMPDIR"))).err());
    }
    assert!(tried >= 6, "only {tried} scenes have no material that is tied to the world");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn turning_the_world_changes_nothing() {
    let turned = Placement::IDENTITY.turned(DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, -1.0, 0.5), 2.1);
    assert_invariant("turned", &turned.expect("a turn"));
}

#[test]
fn moving_the_world_a_kilometre_changes_nothing() {
    let moved = Placement::IDENTITY.moved(DVec3::new(1000.0, -500.0, 750.0));
    assert_invariant("moved", &moved.expect("a move"));
}
