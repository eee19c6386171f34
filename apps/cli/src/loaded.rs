//! What stands in a scene file, and which files were read for it?

use std::path::Path;
use std::time::Instant;

use catoptra_core::Scene;
use catoptra_scene::{SceneFile, printable};
use miette::Result;

use crate::args::STANDARD;
use crate::console::{detail, say, warn};
use crate::destination::Input;
use crate::pool::milliseconds_since;

/// A scene that has been read.
pub(crate) struct Loaded {
    pub(crate) scene: Scene,
    /// The name of its file, without folders.
    pub(crate) name: String,
    pub(crate) text: String,
    /// All files that it was made from, its own first.
    pub(crate) inputs: Vec<Input>,
    /// How long reading took.
    pub(crate) milliseconds: f64,
}

impl Loaded {
    /// Reads a scene, and says what was added to it or passed over.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let started = Instant::now();
        let (scene, file) = load(path)?;
        let milliseconds = milliseconds_since(started);
        detail(&format!("read {} in {milliseconds:.1} ms", path.display()));
        let inputs = std::iter::once(scene_input(path)).chain(other_inputs(&file)).collect();
        Ok(Self { scene, name: file_name(path), text: file.text(), inputs, milliseconds })
    }
}

/// Reads a scene, and says what was added to it or passed over; the meshes of one from standard input lie in the current folder.
pub(crate) fn load(path: &Path) -> Result<(Scene, SceneFile)> {
    let (scene, file) = read(path)?;
    if let Some(added) = file.added() {
        say(&printable(added));
    }
    file.warnings().iter().for_each(|warning| warn(&printable(warning)));
    Ok((scene, file))
}

/// The same without a word about it.
pub(crate) fn read(path: &Path) -> Result<(Scene, SceneFile)> {
    Ok(if path == Path::new(STANDARD) {
        catoptra_scene::load_from(std::io::stdin().lock(), Path::new("<stdin>"), Path::new(""))?
    } else {
        catoptra_scene::load(path)?
    })
}

/// The file that a scene is read from.
pub(crate) fn scene_input(scene: &Path) -> Input {
    let scene = if scene == Path::new(STANDARD) { Path::new("/dev/stdin") } else { scene };
    ("the scene", scene.to_owned())
}

/// All other files that a scene was made from.
fn other_inputs(file: &SceneFile) -> impl Iterator<Item = Input> {
    let meshes = file.mesh_paths().chain(file.model_paths()).map(|path| ("the mesh", path));
    let profiles = file.profile_paths().map(|path| ("the profile", path));
    let pictures = file.image_paths().map(|path| ("the picture", path));
    let named = file.companion_paths().map(|path| ("a model's file", path));
    meshes.chain(profiles).chain(pictures).chain(named)
}

/// The last part of a path.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
