//! Who traces while the window stays awake? One thread that takes the newest request, prepares its scene, traces it coarse
//! to fine, refines it then until it need not be finer, and leaves each finished frame where the window picks it up.
//!
//! A newer request takes the place of one that still waits. It abandons refinement under way at once; a first, coarse
//! frame is let finish (else a fast hand would never see one) unless it has overrun its time, and so is the preparation,
//! as the next one builds on it. Without a request the thread sleeps.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use catoptra_tracer::Control;

use crate::draft::Quality;
use crate::refine::{Pace, Step, USUAL_FRAME, reduced};

/// How long a first frame may take before a newer request abandons it.
const OVERDUE: Duration = Duration::from_millis(60);

/// How many used frames are kept to be filled again.
const SPARES: usize = 4;

/// What can trace requests into frames.
pub(crate) trait Tracing: Send + 'static {
    /// What is asked for.
    type Request: Send + 'static;
    /// A request with all that its frames have in common.
    type Job;
    /// What comes of it.
    type Frame: Send + Into<Self::Spare> + 'static;
    /// What of a used frame can be filled again.
    type Spare: Send + 'static;

    /// Does what has to be done once, before the first frame.
    fn prepare(&mut self, request: Self::Request) -> Self::Job;

    /// Width and height in pixels that a request asks for.
    fn size(job: &Self::Job) -> (u32, u32);

    /// Traces with each pixel standing for as many as the step says, into one of `spares` if one fits.
    /// `None` when it was cancelled; what it was traced into is then among the spares.
    fn trace(
        &mut self,
        job: &Self::Job,
        step: Step,
        control: &Control,
        spares: &mut Vec<Self::Spare>,
    ) -> Option<Self::Frame>;

    /// What the first frame of a request may take from the hand to the eye, in milliseconds.
    fn frame_time(_: &Self::Job) -> f64 {
        USUAL_FRAME
    }

    /// Whether a request has drafts; what they show is then refined.
    fn has_drafts(_: &Self::Job) -> bool {
        false
    }

    /// Whether the last frame is refined.
    fn is_refined(_: &Self::Job) -> bool {
        false
    }

    /// Refines the frame that was traced last for a while; `None` when it was cancelled. What is used up goes to the
    /// spares.
    fn refine(
        &mut self,
        _: &Self::Job,
        _: &Control,
        _: &mut Vec<Self::Spare>,
    ) -> Option<(Self::Frame, Refined)> {
        None
    }
}

/// How far a picture is refined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Refined {
    /// Pixels that are as sure as they have to be.
    pub(crate) settled: u64,
    /// Pixels of the picture.
    pub(crate) pixels: u64,
    /// The most samples that a pixel has.
    pub(crate) samples: u32,
    /// Samples of pixels that were traced for this frame.
    pub(crate) traced: u64,
    /// How well the pixels are traced that are so worst.
    pub(crate) quality: Quality,
}

impl Refined {
    /// Whether nothing is left to refine.
    pub(crate) fn is_done(self) -> bool {
        self.settled >= self.pixels
    }

    /// How much is settled, in whole percent: 100 only where all is.
    pub(crate) fn percent(self) -> u64 {
        (100 * self.settled).checked_div(self.pixels).unwrap_or(100)
    }
}

/// A frame with what is known about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Finished<F> {
    /// The frame.
    pub(crate) frame: F,
    /// Which request it answers: the number that [`FrameWorker::submit`] gave.
    pub(crate) generation: u64,
    /// How fine it is.
    pub(crate) step: Step,
    /// How far it is refined, once it is.
    pub(crate) refined: Option<Refined>,
    /// Nothing finer follows.
    pub(crate) is_last: bool,
    /// How long it took.
    pub(crate) took: Duration,
}

struct UnderWay {
    control: Arc<Control>,
    first: bool,
    since: Instant,
}

struct State<T: Tracing> {
    generation: u64,
    waiting: Option<T::Request>,
    preparing: bool,
    under_way: Option<UnderWay>,
    finished: Option<Finished<T::Frame>>,
    spares: Vec<T::Spare>,
    closing: bool,
}

struct Shared<T: Tracing> {
    state: Mutex<State<T>>,
    changed: Condvar,
}

impl<T: Tracing> Shared<T> {
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The thread, and what it shares with the window. Dropping it abandons the frame under way and waits for the end, but
/// for a preparation, which cannot be abandoned and ends by itself.
pub(crate) struct FrameWorker<T: Tracing> {
    shared: Arc<Shared<T>>,
    thread: Option<JoinHandle<()>>,
}

impl<T: Tracing> FrameWorker<T> {
    /// Starts the thread; `wake` is called on it after each finished frame.
    pub(crate) fn start(tracing: T, wake: impl Fn() + Send + 'static) -> Self {
        let state = State {
            generation: 0,
            waiting: None,
            preparing: false,
            under_way: None,
            finished: None,
            spares: Vec::new(),
            closing: false,
        };
        let shared = Arc::new(Shared { state: Mutex::new(state), changed: Condvar::new() });
        let theirs = Arc::clone(&shared);
        let thread = std::thread::spawn(move || work(&theirs, tracing, &wake));
        Self { shared, thread: Some(thread) }
    }

    /// Asks for a picture instead of all that was asked before; never waits. Returns the request's number.
    pub(crate) fn submit(&self, request: T::Request) -> u64 {
        let mut state = self.shared.lock();
        state.generation += 1;
        state.waiting = Some(request);
        if let Some(frame) = &state.under_way
            && (!frame.first || frame.since.elapsed() > OVERDUE)
        {
            frame.control.cancel();
        }
        self.shared.changed.notify_one();
        state.generation
    }

    /// The newest finished frame that was not taken yet.
    pub(crate) fn take(&self) -> Option<Finished<T::Frame>> {
        self.shared.lock().finished.take()
    }

    /// Gives a used frame back to be filled again; at rest nothing is kept.
    pub(crate) fn give_back(&self, frame: T::Frame) {
        let mut state = self.shared.lock();
        if state.under_way.is_some() || state.waiting.is_some() {
            keep(&mut state.spares, frame.into());
        }
    }
}

impl<T: Tracing> Drop for FrameWorker<T> {
    fn drop(&mut self) {
        let mut state = self.shared.lock();
        state.closing = true;
        if let Some(frame) = &state.under_way {
            frame.control.cancel();
        }
        let preparing = state.preparing;
        drop(state);
        self.shared.changed.notify_one();
        if let Some(thread) = self.thread.take()
            && !preparing
        {
            // A panic there has been reported by its own thread.
            let _ = thread.join();
        }
    }
}

fn keep<S>(spares: &mut Vec<S>, spare: S) {
    if spares.len() == SPARES {
        spares.remove(0);
    }
    spares.push(spare);
}

fn work<T: Tracing>(shared: &Shared<T>, mut tracing: T, wake: &impl Fn()) {
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

#[cfg(test)]
mod tests;
