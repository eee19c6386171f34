//! Is the picture in the file the one that was asked for?

use std::path::Path;

use catoptra_scene::image::read_png;
use catoptra_tracer::{Film, Pool, Snapshot, backend_named, render};

use super::*;
use crate::document::Document;
use crate::guard::{Answer, Next, Question};
use crate::loader::{self, Opened};
use crate::pass::PASSES;

const TEXT: &str = "camera \"eye\" { eye 0 0 8; target 0 0 0 }\nambient-light \"sky\" { radiance 1 }\n\
    directional-light \"sun\" { direction -1 -2 -1; irradiance 1 }\nmatte \"m\" { color 0.5 0.3 0.2 }\n\
    sphere \"ball\" material=\"m\" { radius 2 }\n";

fn viewer(folder: &Path, more: &str) -> Viewer {
    let path = folder.join("ball.kdl");
    std::fs::write(&path, format!("{TEXT}{more}")).unwrap();
    let mut viewer = Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()));
    viewer.size = (40, 30);
    viewer
}

fn spec(viewer: &mut Viewer) -> Spec {
    viewer.ask_for_picture();
    match viewer.browser.take().unwrap().purpose {
        Purpose::Picture(spec) => spec,
        other => panic!("{other:?}"),
    }
}

/// Makes what is wanted, and tells the viewer.
fn made(viewer: &mut Viewer) -> PathBuf {
    let order = viewer.take_picture_order().unwrap();
    assert!(viewer.pictures.under_way().is_some());
    let (path, result) = (order.wish.path.clone(), make::make(&order, 2));
    viewer.picture_made(Outcome { path: path.clone(), result });
    path
}

/// The bytes that a picture of the scene has, traced as the command line traces it.
fn traced(viewer: &Viewer, size: Size, samples: u32) -> Vec<u8> {
    let (scene, pool) = (viewer.document.scene(), Pool::new(1).unwrap());
    let view = View::of(scene, viewer.camera.clone(), size).with_samples(samples);
    let mut film = Film::new(size);
    let snapshot = Snapshot::extract(scene, &pool);
    render(backend_named("wide").unwrap(), &snapshot, &view, &mut film, &pool, &Control::default()).unwrap();
    let mut bytes = vec![0; 3 * size.pixels()];
    for (y, row) in bytes.chunks_exact_mut(3 * size.width as usize).enumerate() {
        viewer.tone().rgb8_row(&film, y as u32, row);
    }
    bytes
}

#[test]
fn at_first_it_is_as_large_and_as_fine_as_what_is_seen_and_lies_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path(), "");
    std::fs::write(folder.path().join("ball.png"), "").unwrap();
    viewer.ask_for_picture();
    let browser = viewer.browser.take().unwrap();
    let wanted = Spec { width: 40, height: 30, samples: 16, colors: Colors::Light };
    assert_eq!((browser.purpose, browser.typed.as_str()), (Purpose::Picture(wanted), "ball-2.png"));
    assert_eq!(browser.folder.canonicalize().unwrap(), folder.path().canonicalize().unwrap());
}

#[test]
fn it_has_the_size_and_the_samples_that_were_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path(), "");
    let asked = Spec { width: 90, height: 50, samples: 9, ..spec(&mut viewer) };
    let path = folder.path().join("a.png");
    viewer.want_picture(path.clone(), asked);
    assert_eq!(made(&mut viewer), path);
    let picture = read_png(&path).unwrap();
    assert_eq!((picture.width(), picture.height()), (90, 50));
    assert_eq!(picture.bytes(), traced(&viewer, Size::new(90, 50), 9));
    assert_ne!(picture.bytes(), traced(&viewer, Size::new(90, 50), 1), "fewer samples are another picture");
    assert!(viewer.pictures.under_way().is_none() && viewer.comparison.typed.ends_with("a.png"));
}

#[test]
fn one_more_is_like_the_last_and_lies_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path(), "");
    let asked = Spec { width: 8, height: 6, samples: 2, ..spec(&mut viewer) };
    viewer.want_picture(folder.path().join("a.exr"), asked);
    made(&mut viewer);
    for name in ["a-2.exr", "a-3.exr"] {
        viewer.picture_again();
        assert_eq!(made(&mut viewer), folder.path().join(name));
    }
    let image = catoptra_scene::image::load(&folder.path().join("a-3.exr")).unwrap();
    assert_eq!((image.width(), image.height()), (8, 6));
    viewer.pictures.forget();
    viewer.picture_again();
    assert_eq!(made(&mut viewer), folder.path().join("ball.png"));
}

#[test]
fn the_scenes_error_ends_it_before_the_samples_do() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path(), "settings { samples 4096; max-error 0.5 }\n");
    let asked = spec(&mut viewer);
    assert_eq!(asked.samples, 4096);
    viewer.want_picture(folder.path().join("a.png"), asked);
    let order = viewer.take_picture_order().unwrap();
    assert_eq!(order.max_error, Some(0.5));
    make::make(&order, 2).unwrap();
    let reached = order.control.reached().unwrap();
    assert!(reached.samples < 100.0, "{reached:?}");
}

#[test]
fn what_is_cancelled_or_cannot_be_written_leaves_nothing_and_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path(), "");
    let asked = spec(&mut viewer);
    let path = folder.path().join("a.png");
    viewer.want_picture(path.clone(), asked);
    let order = viewer.take_picture_order().unwrap();
    viewer.pictures.cancel();
    let result = make::make(&order, 1);
    assert_eq!(result, Err(Unfinished::Cancelled));
    viewer.picture_made(Outcome { path: path.clone(), result });
    assert!(!path.exists() && viewer.failure.is_none());
    viewer.want_picture(folder.path().join("none/a.png"), asked);
    made(&mut viewer);
    assert!(viewer.failure.take().is_some_and(|told| told.contains("none/a.png was not written")));
    viewer.want_picture(path.clone(), Spec { width: LARGEST_SIDE, height: LARGEST_SIDE, ..asked });
    let order = viewer.take_picture_order().unwrap();
    if catoptra_scene::memory::free_bytes().is_some_and(|free| free < 64 << 30) {
        let told = make::make(&order, 1).unwrap_err();
        assert!(matches!(told, Unfinished::Failed(why) if why.contains("GiB of memory")));
    }
}

#[test]
fn false_colours_go_into_a_png_as_they_are_seen() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path(), "");
    viewer.show_pass(PASSES.iter().find(|pass| pass.name == "depth").unwrap());
    let asked = spec(&mut viewer);
    assert_eq!((asked.samples, asked.colors), (1, Colors::False));
    assert!(asked.problem(Path::new("a.exr")).is_some() && asked.problem(Path::new("a.png")).is_none());
    assert!(asked.problem(Path::new("a.jpg")).is_some() && asked.problem(Path::new("a")).is_some());
    viewer.want_picture(folder.path().join("a.png"), asked);
    viewer.follow_scene();
    let picture = read_png(&made(&mut viewer)).unwrap();
    assert_ne!(picture.bytes(), traced(&viewer, Size::new(40, 30), 1));
}

#[test]
fn without_a_file_it_goes_to_the_persons_pictures() {
    let viewer = Viewer::new(loader::welcome(&Pool::new(1).unwrap()).unwrap());
    let place = viewer.picture_place();
    assert_eq!(place.parent().map(Path::to_owned), pictures_folder());
    assert!(place.file_name().unwrap().to_string_lossy().starts_with("welcome"));
}

#[test]
fn closing_asks_while_a_picture_is_made() {
    let folder = tempfile::tempdir().unwrap();
    let mut viewer = viewer(folder.path(), "");
    let (spec, path) = (spec(&mut viewer), folder.path().join("a.png"));
    viewer.want_picture(path.clone(), spec);
    let order = viewer.take_picture_order().unwrap();
    viewer.leave(Next::Close);
    assert_eq!(viewer.take_next(), None);
    assert_eq!(viewer.guard.question(), Some(&Question::Picture(path)));
    viewer.answer(Answer::Cancel);
    assert_eq!((viewer.take_next(), viewer.guard.question()), (None, None));
    viewer.leave(Next::Close);
    assert_eq!(viewer.take_next(), None);
    viewer.answer(Answer::GiveUp);
    assert_eq!(viewer.take_next(), Some(Next::Close));
    assert!(make::make(&order, 1).is_err() && !folder.path().join("a.png").exists());
}
