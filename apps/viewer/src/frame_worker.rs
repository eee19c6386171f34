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
use crate::refine::{Step, USUAL_FRAME};
use work::{keep, work};

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

mod work;

#[cfg(test)]
mod tests;
