//! What becomes of a picture that is dropped on the window? A texture of the scene, on the selected shape. It is read on a
//! thread of its own. No window, no drawing.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptra_core::scene::{Edit, EntityId, TextureId};
use catoptra_core::{Field, FieldKind, ImageSource, Material, Rgb, Texture, TextureUse, Value, Values};

use super::written;
use crate::latest::Latest;
use crate::viewer::Viewer;

/// How the names of files end that are pictures.
const ENDINGS: &[&str] = &["png", "jpg", "jpeg", "exr", "hdr"];

/// What a picture is for.
pub(crate) struct Target {
    shape: EntityId,
    /// Of the scene that has the shape: another scene may come in while the picture is read.
    latest: Arc<Latest>,
    /// The folder from which the scene's paths start.
    folder: PathBuf,
}

/// What came of reading a picture.
pub(crate) struct Outcome {
    path: PathBuf,
    target: Target,
    /// The texture, or what is wrong.
    result: Result<Texture, String>,
}

/// Whether a file is a picture, by its name.
pub(crate) fn is_picture(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

/// What a picture is for that is dropped now; without a selected shape there is nothing, which is told.
pub(crate) fn target(viewer: &mut Viewer) -> Option<Target> {
    let scene = viewer.document.scene();
    let shape = viewer.selection.active().filter(|id| scene.material_of(*id).is_some());
    if shape.is_none() {
        viewer.notify("select a shape first: the picture becomes the texture of its material");
    }
    let folder = viewer.document.folder();
    shape.map(|shape| Target { shape, latest: Arc::clone(&viewer.latest), folder })
}

/// Reads a picture on a thread of its own, and hands the outcome to `done` there.
pub(crate) fn read(path: PathBuf, target: Target, done: impl FnOnce(Outcome) + Send + 'static) {
    std::thread::spawn(move || done(read_now(path, target)));
}

fn read_now(path: PathBuf, target: Target) -> Outcome {
    let result = texture(&path, &target.folder);
    Outcome { path, target, result }
}

fn texture(path: &Path, folder: &Path) -> Result<Texture, String> {
    let written = written(path, folder)?;
    let image = catoptra_scene::image::load(path).map_err(|e| e.to_string())?;
    let values = Values::new().with("file", Value::Image(ImageSource { path: written, image }));
    let kind = Texture::kind_named("image-texture").ok_or("there are no textures of pictures")?;
    (kind.make)(&values).map_err(|e| e.to_string())
}

/// Makes a picture a texture of the scene and puts it on what it is for, as one step to undo.
pub(crate) fn put(viewer: &mut Viewer, Outcome { path, target, result }: Outcome) {
    let texture = match result {
        Ok(texture) => texture,
        Err(problem) => return viewer.notify(problem),
    };
    let scene = viewer.document.scene();
    let same = Arc::ptr_eq(&target.latest, &viewer.latest);
    let Some(worn) = scene.material_of(target.shape).filter(|_| same) else {
        return viewer.notify(format!("{}: the shape that it was for is gone", path.display()));
    };
    let id = scene.next_texture_id();
    let material_name = scene.material_name(worn).to_owned();
    let Some((field, material)) = painted(scene.material(worn), id) else {
        let kind = scene.material(worn).kind_name();
        return viewer.notify(format!("no colour of “{material_name}” takes a texture: it is {kind}"));
    };
    let stem = path.file_stem().map_or_else(|| "picture".into(), |stem| stem.to_string_lossy());
    let name = scene.free_texture_name(&stem);
    let told = format!("“{name}” is the {field} of “{material_name}”");
    let before = scene.revision();
    let add = Edit::AddTexture { name, texture, id: None };
    viewer.edit(Edit::Batch(vec![add, Edit::Material(worn, material)]));
    if viewer.document.scene().revision() != before {
        viewer.texture = Some(id);
        viewer.notify(told);
    }
}

/// The material with the texture for the first of its colours that takes one, and the name of that. A reflectance becomes
/// white, so that the picture is seen as it is.
fn painted(material: &Material, texture: TextureId) -> Option<(&'static str, Material)> {
    let values = material.values();
    let paint = |field: &'static Field| {
        let base = match field.kind {
            FieldKind::Color => Value::Color(Rgb::WHITE),
            FieldKind::Quantity => values.get(field.name)?.clone(),
            _ => return None,
        };
        let painted = material.with(field.name, base.textured(TextureUse::of(texture)));
        painted.ok().map(|material| (field.name, material))
    };
    material.kind().fields.iter().find_map(paint)
}

#[cfg(test)]
mod tests {
    use catoptra_tracer::Pool;

    use super::*;
    use crate::document::Document;
    use crate::loader::{self, Opened};

    const TEXT: &str = "matte \"grey\" { color 0.5 0.4 0.3 }\nglass \"clear\"\nemissive \"glow\" { radiance 2 3 4 }\n\
        sphere \"ball\" material=\"grey\" { radius 1 }\nsphere \"lens\" material=\"clear\" { radius 1 }\n\
        sphere \"lamp\" material=\"glow\" { radius 1 }\n";

    fn viewer(folder: &Path) -> Viewer {
        let path = folder.join("balls.kdl");
        std::fs::write(&path, TEXT).unwrap();
        Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()))
    }

    fn picture(folder: &Path, name: &str) -> PathBuf {
        let path = folder.join(name);
        catoptra_scene::image::write_png(&path, 2, 1, &[255, 0, 0, 0, 0, 255]).unwrap();
        path
    }

    /// Drops a picture while that shape is selected.
    fn drop_on(viewer: &mut Viewer, shape: &str, path: &Path) {
        let id = viewer.document.scene().entity_named(shape);
        viewer.select(id);
        let target = target(viewer).unwrap();
        put(viewer, read_now(path.to_owned(), target));
    }

    fn told(viewer: &Viewer) -> &str {
        viewer.notice.as_ref().map_or("", |(text, _)| text)
    }

    #[test]
    fn pictures_are_told_from_scenes_by_their_names() {
        for name in ["a.png", "b.JPG", "c.jpeg", "d.exr", "e.Hdr"] {
            assert!(is_picture(Path::new(name)), "{name}");
        }
        for name in ["a.kdl", "png", ".png", "a.png.kdl"] {
            assert!(!is_picture(Path::new(name)), "{name}");
        }
    }

    #[test]
    fn a_picture_goes_on_the_selected_shape_as_one_step() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path());
        let worn = viewer.document.scene().material_named("grey").unwrap();
        let before = viewer.document.scene().material(worn).clone();
        let file = picture(folder.path(), "wood.png");
        drop_on(&mut viewer, "ball", &file);
        let scene = viewer.document.scene();
        let id = scene.texture_named("wood").unwrap();
        let white = Value::Color(Rgb::WHITE).textured(TextureUse::of(id));
        assert_eq!(scene.material(worn).values().get("color"), Some(&white));
        assert_eq!((viewer.texture, told(&viewer)), (Some(id), "“wood” is the color of “grey”"));
        drop_on(&mut viewer, "lamp", &file);
        assert!(viewer.document.scene().texture_named("wood 2").is_some());
        for _ in 0..2 {
            assert!(viewer.document.undo().is_some());
        }
        let scene = viewer.document.scene();
        assert_eq!((scene.textures().count(), scene.material(worn)), (0, &before));
        assert!(viewer.document.is_saved());
    }

    #[test]
    fn a_saved_scene_finds_its_pictures_again() {
        let folder = tempfile::tempdir().unwrap();
        let elsewhere = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path());
        std::fs::create_dir(folder.path().join("maps")).unwrap();
        drop_on(&mut viewer, "ball", &picture(folder.path(), "maps/near.png"));
        drop_on(&mut viewer, "lamp", &picture(elsewhere.path(), "far.png"));
        let path = viewer.document.save().unwrap();
        assert!(std::fs::read_to_string(&path).unwrap().contains("\"maps/near.png\""));
        let again = Document::open(&path).unwrap();
        let names: Vec<&str> = again.scene().textures().map(|(_, name, _)| name).collect();
        assert_eq!(names, ["near", "far"]);
    }

    #[test]
    fn what_cannot_be_done_is_told_and_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path());
        assert!(target(&mut viewer).is_none());
        assert!(told(&viewer).starts_with("select a shape first"));
        let broken = folder.path().join("broken.png");
        std::fs::write(&broken, "no picture").unwrap();
        drop_on(&mut viewer, "ball", &broken);
        assert!(told(&viewer).contains("broken.png"), "{}", told(&viewer));
        let ball = viewer.document.scene().entity_named("ball").unwrap();
        let target = target(&mut viewer).unwrap();
        viewer.edit(Edit::Remove(ball));
        let revision = viewer.document.scene().revision();
        put(&mut viewer, read_now(picture(folder.path(), "late.png"), target));
        assert!(told(&viewer).ends_with("is gone"), "{}", told(&viewer));
        assert_eq!(viewer.document.scene().revision(), revision);
    }

    #[test]
    fn a_picture_for_a_scene_that_went_is_dropped() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = viewer(folder.path());
        let ball = viewer.document.scene().entity_named("ball");
        viewer.select(ball);
        let target = target(&mut viewer).unwrap();
        viewer.show(loader::welcome(&Pool::new(1).unwrap()).unwrap());
        put(&mut viewer, read_now(picture(folder.path(), "late.png"), target));
        assert_eq!(viewer.document.scene().textures().count(), 0);
    }
}
