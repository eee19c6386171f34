//! Which scenes are tested, and what is in them?

use std::path::{Path, PathBuf};

use catoptra_core::{Camera, Scene, Shape};

/// The folder `scenes/` of the repository.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

/// A scene file by its path below `scenes/`, such as `seed/spot.kdl`.
pub fn scene_file(name: &str) -> PathBuf {
    folder().join(name)
}

/// Every scene file below `scenes/`, with its path below that folder as its name, sorted.
///
/// # Panics
/// When the folder cannot be read.
pub fn shipped_scenes() -> Vec<(String, Scene)> {
    let mut files = Vec::new();
    let mut folders = vec![folder()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("the folder of scenes") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "kdl") {
                files.push(path);
            }
        }
    }
    files.sort();
    files.iter().map(|path| (name_of(path), read(path))).collect()
}

fn name_of(path: &Path) -> String {
    path.strip_prefix(folder()).unwrap_or(path).display().to_string()
}

/// A shipped scene by its path below `scenes/`.
///
/// # Panics
/// When it cannot be read.
pub fn load(name: &str) -> Scene {
    read(&scene_file(name))
}

fn read(path: &Path) -> Scene {
    match catoptra_scene::load(path) {
        Ok((scene, _)) => scene,
        Err(error) => panic!("{}: {error:?}", path.display()),
    }
}

/// Scenes whose pictures lanes make by random choices of their own: of paths, and of rays to lamps that have no closed form behind
/// shapes such as prisms and tori or in highlights, which lanes share between the pixels of a block.
const BY_CHANCE: [&str; 6] = ["cornell", "cone", "platonic", "polyhedron", "prism", "torus"];

/// Whether backends agree on a shipped scene no better than random choices do.
#[must_use]
pub fn is_by_chance(name: &str) -> bool {
    let name = name.strip_prefix("gallery/").and_then(|name| name.strip_suffix(".kdl"));
    name.is_some_and(|name| BY_CHANCE.contains(&name))
}

/// A scene written in a test.
///
/// # Panics
/// When the text is no scene.
pub fn parsed(text: &str) -> Scene {
    parsed_in(None, text)
}

/// A scene written in a test, whose files lie in a folder.
///
/// # Panics
/// When the text is no scene.
pub fn parsed_in(folder: Option<&Path>, text: &str) -> Scene {
    match catoptra_scene::parse(text, "test", folder) {
        Ok((scene, _)) => scene,
        Err(error) => panic!("{error:?}"),
    }
}

/// The first camera of a scene, in the world.
///
/// # Panics
/// When there is none.
pub fn camera_of(scene: &Scene) -> Camera {
    let id = scene.main_camera().expect("a scene with a camera");
    scene.world_camera(id).expect("a camera that can be placed")
}

/// How many triangles all meshes of a scene have.
pub fn triangles(scene: &Scene) -> usize {
    let of = |shape: Shape| shape.as_mesh().map_or(0, |mesh| mesh.triangles().triangles().len());
    scene.entities().filter_map(|id| scene.shape(id)).map(of).sum()
}
