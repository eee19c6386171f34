//! How long does a frame take? The seed scenes and three mesh scenes at 450x450 and 1920x1080, from snapshot to film, on
//! one thread.

use catoptra_benches::{criterion, frame, frame_of, scene};
use catoptra_core::glam::DVec3;
use catoptra_core::light::DirectionalLight;
use catoptra_core::{Rgb, Scene};
use catoptra_lab::scenes::placed_mesh;
use catoptra_tracer::Size;

const SEED: [&str; 8] = ["planes", "directional", "point", "spot", "many", "material", "depth", "tetra"];

/// A knot of some thousand triangles under three spots.
const MESH: &str = "gallery/knot.kdl";

/// The scene with one more light.
fn under_the_sun(mut scene: Scene) -> Scene {
    let sun = DirectionalLight::new(DVec3::new(0.5, -1.0, -0.6), Rgb::grey(2.0)).expect("a light");
    scene.add_light("sun", sun, None).expect("a scene");
    scene
}

fn main() {
    let mut criterion = criterion();
    let scenes = SEED.map(|name| (name, scene(&format!("seed/{name}.kdl"))));
    let placed = || placed_mesh(60).expect("a scene");
    let meshes =
        [("mesh", scene(MESH)), ("placed mesh", placed()), ("mesh under the sun", under_the_sun(placed()))];
    for (name, scene) in scenes.iter().chain(&meshes) {
        frame(&mut criterion, "frame", name, scene);
        frame_of(&mut criterion, "frame 1080p", name, scene, Size::new(1920, 1080));
    }
    criterion.final_summary();
}
