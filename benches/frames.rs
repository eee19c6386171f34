//! How long does a frame take? The seed scenes and three mesh scenes at 450x450 and 1920x1080, from snapshot to film, on
//! one thread.

use catoptra_benches::{criterion, frame, frame_of, scene};
use catoptra_lab::scenes::{placed_mesh, placed_mesh_under_the_sun};
use catoptra_tracer::Size;

const SEED: [&str; 8] = ["planes", "directional", "point", "spot", "many", "material", "depth", "tetra"];

/// A knot of some thousand triangles under three spots.
const MESH: &str = "gallery/knot.kdl";

fn main() {
    let mut criterion = criterion();
    let scenes = SEED.map(|name| (name, scene(&format!("seed/{name}.kdl"))));
    let meshes = [
        ("mesh", scene(MESH)),
        ("placed mesh", placed_mesh(60).expect("a scene")),
        ("mesh under the sun", placed_mesh_under_the_sun(60).expect("a scene")),
    ];
    for (name, scene) in scenes.iter().chain(&meshes) {
        frame(&mut criterion, "frame", name, scene);
        frame_of(&mut criterion, "frame 1080p", name, scene, Size::new(1920, 1080));
    }
    criterion.final_summary();
}
