//! What becomes of a model that is dropped on the window? A group in the open scene, where the view looks, in a size to be seen.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::glam::DVec3;
use catoptra_core::{Aabb, Camera, Placement};
use catoptra_scene::model::{self, Model};

use super::written;
use crate::latest::Latest;
use crate::viewer::Viewer;

/// How far away things are put where the view looks at nothing, in metres.
const FAR_ENOUGH: f64 = 5.0;

/// What came of reading a model.
pub(crate) struct Outcome {
    path: PathBuf,
    /// Of the scene that it is for: another may come in while it is read.
    latest: Arc<Latest>,
    /// The path as the scene names it and the model, or what is wrong.
    result: Result<(String, Model), String>,
}

/// Whether a file is a model, by its name or by how it begins.
pub(crate) fn is_model(path: &Path) -> bool {
    model::is_named_so(path) || model::begins_as_one(path)
}

/// Reads a model on a thread of its own, and hands the outcome to `done` there.
pub(crate) fn read(path: PathBuf, viewer: &Viewer, done: impl FnOnce(Outcome) + Send + 'static) {
    let (folder, latest) = (viewer.document.folder(), Arc::clone(&viewer.latest));
    std::thread::spawn(move || done(read_now(path, &folder, latest)));
}

fn read_now(path: PathBuf, folder: &Path, latest: Arc<Latest>) -> Outcome {
    let read = |written| model::read(&path).map(|model| (written, model)).map_err(|e| e.to_string());
    let result = written(&path, folder).and_then(read);
    Outcome { path, latest, result }
}

/// Puts a model into the scene, as one step to undo.
pub(crate) fn put(viewer: &mut Viewer, Outcome { path, latest, result }: Outcome) {
    let (written, model) = match result {
        Ok(read) => read,
        Err(problem) => return viewer.notify(problem),
    };
    if !Arc::ptr_eq(&latest, &viewer.latest) {
        return viewer.notify(format!("{}: the scene that it was for is gone", path.display()));
    }
    let (width, height) = viewer.size;
    let seen = viewer.pick(f64::from(width) / 2.0, f64::from(height) / 2.0).map(|hit| hit.point);
    let placement = match model.bounds() {
        Some(bounds) => place(&viewer.camera, seen, &bounds),
        None => Placement::IDENTITY,
    };
    let wish = path.file_stem().map_or_else(|| "model".into(), |stem| stem.to_string_lossy());
    let warnings = model.warnings.len();
    let added = viewer.document.model_edit((&written, Arc::new(model)), &wish, placement);
    let (edit, root) = match added {
        Ok(added) => added,
        Err(problem) => return viewer.notify(format!("{}: {problem}", path.display())),
    };
    let before = viewer.document.scene().revision();
    viewer.edit(edit);
    if viewer.document.scene().revision() != before {
        viewer.select(Some(root));
        let name = viewer.document.scene().name(root).unwrap_or_default();
        let left_out = match warnings {
            0 => String::new(),
            1 => "; one thing in it is left out".to_owned(),
            many => format!("; {many} things in it are left out"),
        };
        viewer.notify(format!("“{name}” was put into the scene{left_out}"));
    }
}

/// Stands a model on the point that is seen in the middle of the picture, or before the eye where nothing is; scaled by a power of
/// ten where it would fill the picture many times over or be a speck.
fn place(camera: &Camera, seen: Option<DVec3>, bounds: &Aabb) -> Placement {
    let at = seen.unwrap_or(camera.eye() + camera.forward() * FAR_ENOUGH);
    let size = (bounds.max - bounds.min).length();
    let distance = (at - camera.eye()).length();
    let scale = match (distance / (2.0 * size)).log10() {
        // As large as its distance down to a fiftieth of it: as it is.
        tens if (-0.3..=1.4).contains(&tens) || !tens.is_finite() => 1.0,
        tens => 10_f64.powf(tens.floor()),
    };
    let foot = bounds.min.midpoint(bounds.max).with_y(bounds.min.y);
    let placed = Placement::IDENTITY.scaled(scale).and_then(|p| p.moved(at - foot * scale));
    placed.unwrap_or(Placement::IDENTITY)
}

#[cfg(test)]
mod tests {
    use catoptra_core::scene::Role;
    use catoptra_tracer::Pool;

    use super::*;
    use crate::document::Document;
    use crate::loader::{self, Opened};

    const TEXT: &str = "camera \"eye\" { eye 0 0 10; target 0 0 0 }\nmatte \"m\" { color 0.5 }\n\
        sphere \"ball\" material=\"m\" { center 0 0 -1; radius 1 }\n";

    fn viewer(folder: &Path) -> Viewer {
        let path = folder.join("ball.kdl");
        std::fs::write(&path, TEXT).unwrap();
        let mut viewer = Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()));
        viewer.size = (100, 100);
        viewer
    }

    /// A triangle of that size, 1 m to the right.
    fn triangle(folder: &Path, name: &str, size: f64) -> PathBuf {
        let path = folder.join(name);
        let text = format!("v 1 0 0\nv {} 0 0\nv 1 {size} 0\no Flag\nf 1 2 3\n", 1.0 + size);
        std::fs::write(&path, text).unwrap();
        path
    }

    fn drop_on(viewer: &mut Viewer, path: &Path) {
        let outcome = read_now(path.to_owned(), &viewer.document.folder(), Arc::clone(&viewer.latest));
        put(viewer, outcome);
    }

    fn told(viewer: &Viewer) -> &str {
        viewer.notice.as_ref().map_or("", |(text, _)| text)
    }

    #[test]
    fn models_are_told_by_name_and_by_content() {
        let folder = tempfile::tempdir().unwrap();
        for format in model::FORMATS {
            for ending in format.endings {
                assert!(is_model(Path::new(&format!("a.{}", ending.to_uppercase()))), "{ending}");
            }
        }
        assert!(!is_model(Path::new("a.kdl")) && !is_model(Path::new("a.png")));
        assert!(is_model(&triangle(folder.path(), "flag.txt", 1.0)));
    }

    #[test]
    fn a_model_stands_where_the_view_looks_and_is_one_step() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path());
        drop_on(&mut viewer, &triangle(folder.path(), "flag.obj", 1.0));
        let scene = viewer.document.scene();
        let root = scene.entity_named("flag").unwrap();
        assert_eq!((viewer.selection.ids(), scene.role(root)), (&[root][..], Some(Role::Group)));
        let bounds = scene.world_bounds(root).unwrap();
        // On the ball's nearest point, its foot in the middle.
        assert!((bounds.min - DVec3::new(-0.5, 0.0, 0.0)).length() < 1e-2, "{bounds:?}");
        assert_eq!(told(&viewer), "“flag” was put into the scene");
        let path = viewer.document.save().unwrap();
        let saved = std::fs::read_to_string(&path).unwrap();
        let node = saved.strip_prefix(TEXT).unwrap();
        assert!(node.starts_with("model \"flag\" {\n    file \"flag.obj\"\n    move "), "{node}");
        assert!(Document::open(&path).unwrap().scene().entity_named("flag/Flag").is_some());
        assert!(viewer.document.undo().is_some());
        assert_eq!(viewer.document.scene().entity_named("flag"), None);
        viewer.document.save().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), TEXT);
        assert!(viewer.document.redo().is_some());
        viewer.document.save().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), saved);
    }

    #[test]
    fn sizes_that_cannot_be_seen_are_scaled_by_tens() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path());
        for (size, low, high) in [(2.0, 2.0, 2.0), (1000.0, 0.5, 10.0), (0.001, 0.5, 10.0)] {
            drop_on(&mut viewer, &triangle(folder.path(), "flag.obj", size));
            let root = viewer.selection.active().unwrap();
            let bounds = viewer.document.scene().world_bounds(root).unwrap();
            let shown = bounds.max.y - bounds.min.y;
            assert!(shown >= low * 0.999 && shown <= high * 1.001, "{size}: {shown}");
            assert!(viewer.document.undo().is_some());
        }
    }

    #[test]
    fn names_are_free_and_what_is_broken_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path());
        let file = triangle(folder.path(), "ball.obj", 1.0);
        drop_on(&mut viewer, &file);
        drop_on(&mut viewer, &file);
        assert!(viewer.document.scene().entity_named("ball 2/Flag").is_some());
        assert!(viewer.document.scene().entity_named("ball 3/Flag").is_some());
        let revision = viewer.document.scene().revision();
        std::fs::write(folder.path().join("bad.ply"), "ply\n").unwrap();
        drop_on(&mut viewer, &folder.path().join("bad.ply"));
        assert!(told(&viewer).contains("bad.ply"), "{}", told(&viewer));
        let late = read_now(file, &viewer.document.folder(), Arc::clone(&viewer.latest));
        viewer.show(loader::welcome(&Pool::new(1).unwrap()).unwrap());
        put(&mut viewer, late);
        assert!(told(&viewer).ends_with("is gone") && viewer.document.scene().revision() != revision);
    }
}
