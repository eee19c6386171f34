//! What does the worker's thread do? It takes a request, traces it by steps that keep pace with the hand, refines it, and looks
//! up for a newer one between any two frames.

use std::sync::{Arc, PoisonError};
use std::time::{Duration, Instant};

use catoptra_tracer::Control;

use super::{Finished, SPARES, Shared, Tracing, UnderWay};
use crate::draft::Quality;
use crate::refine::{Pace, Step, reduced};

pub(super) fn keep<S>(spares: &mut Vec<S>, spare: S) {
    if spares.len() == SPARES {
        spares.remove(0);
    }
    spares.push(spare);
}

pub(super) fn work<T: Tracing>(shared: &Shared<T>, mut tracing: T, wake: &impl Fn()) {
    let mut pace = Pace::default();
    while let Some((generation, request)) = next(shared) {
        let job = tracing.prepare(request);
        if trace_steps(shared, &mut tracing, &job, generation, &mut pace, wake) && T::is_refined(&job) {
            refine(shared, &mut tracing, &job, generation, &mut pace, wake);
        }
    }
}

/// Traces a picture coarse to fine; `false` when that was abandoned.
fn trace_steps<T: Tracing>(
    shared: &Shared<T>,
    tracing: &mut T,
    job: &T::Job,
    generation: u64,
    pace: &mut Pace,
    wake: &impl Fn(),
) -> bool {
    let (width, height) = T::size(job);
    let steps = pace.steps((width, height), T::frame_time(job), T::has_drafts(job));
    for (i, &step) in steps.iter().enumerate() {
        let is_last = i + 1 == steps.len() && !T::is_refined(job);
        let took = attempt(shared, i == 0, |control, spares| {
            let frame = tracing.trace(job, step, control, spares)?;
            Some(Finished { frame, generation, step, refined: None, is_last, took: Duration::ZERO })
        });
        let Some(took) = took else {
            if i == 0 {
                pace.overran(step.quality);
            }
            return false;
        };
        let (w, h) = reduced(width, height, step.divisor);
        pace.record(step.quality, u64::from(w) * u64::from(h), took);
        wake();
    }
    true
}

/// Refines a picture until that is done or abandoned.
fn refine<T: Tracing>(
    shared: &Shared<T>,
    tracing: &mut T,
    job: &T::Job,
    generation: u64,
    pace: &mut Pace,
    wake: &impl Fn(),
) {
    let (mut is_last, mut traced) = (false, 0);
    while !is_last {
        let took = attempt(shared, false, |control, spares| {
            let (frame, refined) = tracing.refine(job, control, spares)?;
            (is_last, traced) = (refined.is_done(), refined.traced);
            let step = Step { divisor: 1, quality: refined.quality };
            let refined = Some(refined);
            Some(Finished { frame, generation, step, refined, is_last, took: Duration::ZERO })
        });
        let Some(took) = took else { return };
        pace.record(Quality::Full, traced, took);
        wake();
    }
}

/// Traces a frame and leaves it to be taken, and tells how long that took; `None` when it was not begun or was cancelled.
fn attempt<T: Tracing>(
    shared: &Shared<T>,
    first: bool,
    trace: impl FnOnce(&Control, &mut Vec<T::Spare>) -> Option<Finished<T::Frame>>,
) -> Option<Duration> {
    let (control, mut spares) = begin(shared, first)?;
    let since = Instant::now();
    let finished = trace(&control, &mut spares);
    let took = since.elapsed();
    let is_there = finished.is_some();
    end(shared, spares, finished.map(|finished| Finished { took, ..finished }));
    is_there.then_some(took)
}

/// Waits for a request; `None` at the end.
fn next<T: Tracing>(shared: &Shared<T>) -> Option<(u64, T::Request)> {
    let mut state = shared.lock();
    loop {
        if state.closing {
            return None;
        }
        if let Some(request) = state.waiting.take() {
            state.preparing = true;
            return Some((state.generation, request));
        }
        state = shared.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
    }
}

/// Notes that a frame is begun; `None` if it need not be, since it would only refine what is out of date.
fn begin<T: Tracing>(shared: &Shared<T>, first: bool) -> Option<(Arc<Control>, Vec<T::Spare>)> {
    let mut state = shared.lock();
    state.preparing = false;
    if state.closing || (!first && state.waiting.is_some()) {
        return None;
    }
    let control = Arc::new(Control::default());
    state.under_way = Some(UnderWay { control: Arc::clone(&control), first, since: Instant::now() });
    Some((control, std::mem::take(&mut state.spares)))
}

/// Notes that a frame is done with, and leaves it to be taken. One that was not taken in time is used again; after the last
/// one, with nothing to do, the room is given back.
fn end<T: Tracing>(shared: &Shared<T>, spares: Vec<T::Spare>, finished: Option<Finished<T::Frame>>) {
    let mut state = shared.lock();
    state.under_way = None;
    for spare in spares {
        keep(&mut state.spares, spare);
    }
    if finished.is_some()
        && let Some(missed) = std::mem::replace(&mut state.finished, finished)
    {
        keep(&mut state.spares, missed.frame.into());
    }
    if state.waiting.is_none() && state.finished.as_ref().is_some_and(|finished| finished.is_last) {
        state.spares = Vec::new();
    }
}
