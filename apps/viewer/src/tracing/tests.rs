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

/// The frames of a request that is refined to its end.
fn refined(tracing: &mut PoolTracing, job: &Job) -> Vec<(Frame, Refined)> {
    let (control, mut spares) = (Control::default(), Vec::new());
    tracing.trace(job, Step::FULL, &control, &mut spares).unwrap();
    let mut frames = Vec::new();
    while frames.last().is_none_or(|(_, refined): &(Frame, Refined)| !refined.is_done()) {
        frames.push(tracing.refine(job, &control, &mut spares).unwrap());
    }
    frames
}

#[test]
fn a_full_picture_is_refined_until_it_is_sure_and_then_nothing_is_kept() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let job = tracing.prepare(viewer.request());
    let frames = refined(&mut tracing, &job);
    let (last, told) = frames.last().unwrap();
    assert_eq!((told.settled, told.percent()), (64 * 48, 100));
    assert!((16..=64).contains(&told.samples), "{}", told.samples);
    assert!(tracing.resting.is_none(), "nothing is kept at rest");
    let view = job.request.view.clone().with_samples(256);
    let mut film = Film::new(view.size);
    render(job.request.backend, &job.snapshot, &view, &mut film, &tracing.pool, &Control::default()).unwrap();
    let mut exact = vec![0; 64 * 48];
    job.request.tone.encode(&film, &tracing.pool, &mut exact);
    let channel = |pixel: u32, shift: u32| f64::from(pixel >> shift & 255);
    let off = |shift| {
        let pairs = exact.iter().zip(&last.pixels.data);
        pairs.map(move |(a, b)| (channel(*a, shift) - channel(*b, shift)).abs()).fold(0.0, f64::max)
    };
    assert!([0, 8, 16].into_iter().all(|shift| off(shift) <= 16.0), "{:?}", [off(0), off(8), off(16)]);
}

#[test]
fn what_is_refined_is_the_same_by_any_threads_and_after_it_was_abandoned() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let job = tracing.prepare(viewer.request());
    let last = |tracing: &mut PoolTracing| refined(tracing, &job).pop().unwrap().0.pixels;
    let first = last(&mut tracing);
    let (control, mut spares) = (Control::default(), Vec::new());
    tracing.trace(&job, Step::FULL, &control, &mut spares).unwrap();
    control.cancel();
    assert!(tracing.refine(&job, &control, &mut spares).is_none());
    assert!(last(&mut tracing) == first, "after it was abandoned");
    assert!(last(&mut PoolTracing::new(Arc::new(Pool::new(3).unwrap()))) == first, "by three threads");
}

#[test]
fn tiles_in_full_take_the_place_of_a_draft() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let job = tracing.prepare(viewer.request());
    let (control, mut spares) = (Control::default(), Vec::new());
    let step = Step { divisor: 1, quality: Quality::Draft };
    tracing.trace(&job, step, &control, &mut spares).unwrap();
    let mut last = None;
    while last.as_ref().is_none_or(|(_, refined): &(Frame, Refined)| !refined.is_done()) {
        last = tracing.refine(&job, &control, &mut spares);
    }
    let (last, told) = last.unwrap();
    assert_eq!(told.quality, Quality::Full);
    // The first sample alone was traced by itself, which changes no bit of what comes after it.
    let (in_full, _) = refined(&mut tracing, &job).pop().unwrap();
    assert!(last.pixels == in_full.pixels);
}

#[test]
fn a_refined_picture_takes_on_another_tone() {
    let (mut viewer, mut tracing) = viewer_and_tracing();
    let job = tracing.prepare(viewer.request());
    let (mut frame, _) = refined(&mut tracing, &job).pop().unwrap();
    viewer.settings.exposure = viewer.settings.exposure.stepped(1.0);
    frame.encode(viewer.tone(), &tracing.pool);
    let brighter = Job { request: Request { tone: viewer.tone(), ..job.request }, snapshot: job.snapshot };
    // What is refined up to the same error is noisier by the factor of exposure at most.
    let (anew, _) = refined(&mut tracing, &brighter).pop().unwrap();
    let green = |pixels: &Pixels| pixels.data.iter().map(|pixel| u64::from(pixel >> 8 & 255)).sum::<u64>();
    let (as_told, as_traced) = (green(&frame.pixels), green(&anew.pixels));
    assert!(as_told.abs_diff(as_traced) * 200 < as_traced, "{as_told} {as_traced}");
}

#[test]
fn a_draft_is_coarser_in_light_and_has_the_same_depths() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let job = tracing.prepare(viewer.request());
    assert!(PoolTracing::has_drafts(&job));
    let mut depths = |quality| {
        let step = Step { divisor: 2, quality };
        let frame = tracing.trace(&job, step, &Control::default(), &mut Vec::new()).unwrap();
        (frame.film.depths(), frame.rays)
    };
    let (draft, full) = (depths(Quality::Draft), depths(Quality::Full));
    assert_eq!(draft.0, full.0);
    assert!(draft.1 < full.1, "fewer rays: {} {}", draft.1, full.1);
}

#[test]
fn a_cancelled_frame_leaves_its_room_to_the_next() {
    let (viewer, mut tracing) = viewer_and_tracing();
    let (job, mut spares) = (tracing.prepare(viewer.request()), Vec::new());
    let (control, half) = (Control::default(), Step { divisor: 2, quality: Quality::Full });
    control.cancel();
    for _ in 0..2 {
        assert!(tracing.trace(&job, half, &control, &mut spares).is_none());
        let sizes: Vec<Option<Size>> =
            spares.iter().map(|spare| spare.film.as_ref().map(Film::size)).collect();
        assert_eq!(sizes, [Some(Size::new(32, 24))]);
    }
    assert!(tracing.trace(&job, half, &Control::default(), &mut spares).is_some());
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
