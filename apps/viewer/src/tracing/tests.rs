//! Does a request come to its picture, whole, batch by batch, and after it was given up?

use catoptra_core::Edit;

use super::*;
use crate::loader;
use crate::viewer::Viewer;

fn viewer_and_tracing() -> (Viewer, PoolTracing) {
    let pool = Arc::new(Pool::new(1).unwrap());
    let mut viewer = Viewer::new(loader::welcome(&pool).unwrap());
    viewer.size = (64, 48);
    (viewer, PoolTracing::new(pool))
}

#[test]
fn batches_come_to_the_picture_of_all_samples_at_once() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let job = tracing.prepare(viewer.request());
    let (control, mut spares) = (Control::default(), Vec::new());
    let mut last = None;
    for batch in PoolTracing::batches(&job) {
        let frame = tracing.add(&job, batch, &control, &mut spares).unwrap();
        assert_eq!(frame.film.samples(5, 5), batch.to);
        last = Some(frame);
    }
    let samples = job.request.at_rest;
    assert!(samples >= 16, "{samples}");
    let view = job.request.view.clone().with_samples(samples);
    let mut film = Film::new(view.size);
    render(job.request.backend, &job.snapshot, &view, &mut film, &tracing.pool, &control).unwrap();
    assert_eq!(last.unwrap().film.radiances(), film.radiances());
    assert!(tracing.growing.is_none(), "nothing is kept at rest");
}

#[test]
fn a_picture_larger_than_any_display_is_not_refined() {
    let (mut viewer, mut tracing) = viewer_and_tracing();
    for (size, refined) in [((3840, 2160), true), ((7000, 5000), false)] {
        viewer.size = size;
        let job = tracing.prepare(viewer.request());
        assert_eq!(!PoolTracing::batches(&job).is_empty(), refined, "{size:?}");
    }
}

#[test]
fn an_abandoned_batch_begins_anew() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let job = tracing.prepare(viewer.request());
    let (control, mut spares) = (Control::default(), Vec::new());
    let batches = PoolTracing::batches(&job);
    assert!(tracing.add(&job, batches[0], &control, &mut spares).is_some());
    control.cancel();
    assert!(tracing.add(&job, batches[1], &control, &mut spares).is_none());
    let first = tracing.add(&job, batches[0], &Control::default(), &mut spares).unwrap();
    assert_eq!(first.film.samples(5, 5), batches[0].to);
}

#[test]
fn a_cancelled_frame_leaves_its_room_to_the_next() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let (job, mut spares) = (tracing.prepare(viewer.request()), Vec::new());
    let control = Control::default();
    control.cancel();
    for _ in 0..2 {
        assert!(tracing.trace(&job, 2, &control, &mut spares).is_none());
        let sizes: Vec<Size> = spares.iter().map(|spare| spare.film.size()).collect();
        assert_eq!(sizes, [Size::new(32, 24)]);
    }
    assert!(tracing.trace(&job, 2, &Control::default(), &mut spares).is_some());
    assert!(spares.is_empty());
}

#[test]
fn the_scene_is_frozen_when_its_turn_comes() {
    let (mut viewer, mut tracing) = viewer_and_tracing();
    let before = viewer.latest.get();
    let floor = viewer.document.scene().entity_named("floor").unwrap();
    viewer.edit(Edit::Remove(floor));
    viewer.follow_scene();
    assert!(Arc::ptr_eq(&before, &viewer.latest.get()));
    let job = tracing.prepare(viewer.request());
    assert!(!job.snapshot.entities().contains(&floor));
    assert!(Arc::ptr_eq(&job.snapshot, &viewer.latest.get()));
}
