//! Shows the progress of long work (reading, tree building, tracing) and cancels it, from any thread.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Progress and cancellation of one piece of work at a time; share it by reference or `Arc`.
///
/// ```
/// let control = catoptra_core::Control::default();
/// std::thread::scope(|threads| {
///     threads.spawn(|| control.cancel());
/// });
/// assert!(control.is_cancelled());
/// control.reset();
/// assert!(!control.is_cancelled() && control.progress() == 0.0);
/// ```
#[derive(Debug, Default)]
pub struct Control {
    cancelled: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
    reached: Mutex<Option<Progress>>,
}

/// Work was asked to stop before its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the work was cancelled")]
pub struct Cancelled;

/// How far a render with a target has come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Samples of a pixel so far, in the mean.
    pub samples: f64,
    /// The largest standard error of a pixel so far.
    pub error: f64,
    /// Seconds since it began.
    pub seconds: f64,
}

impl Control {
    /// Requests the work to stop after what is under way: the tiles of a render, a part of a tree, a file.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether it has been requested to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// [`Cancelled`] once it has been requested to stop.
    ///
    /// # Errors
    /// Just that.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// Takes back a request to stop, and begins anew at no progress. Work that is still running goes on.
    pub fn reset(&self) {
        self.cancelled.store(false, Ordering::Relaxed);
        self.start(0);
        if let Ok(mut reached) = self.reached.lock() {
            *reached = None;
        }
    }

    /// Share of the work that is done, 0..=1: of a render its tiles, with a target those of the pass under way; of trees the
    /// triangles; of reading the files.
    #[must_use]
    pub fn progress(&self) -> f32 {
        let total = self.total.load(Ordering::Relaxed);
        let done = self.done.load(Ordering::Relaxed).min(total);
        if total == 0 { 0.0 } else { done as f32 / total as f32 }
    }

    /// How far a render with a target had come after its last pass; `None` before the first has ended, and without one.
    #[must_use]
    pub fn reached(&self) -> Option<Progress> {
        self.reached.lock().map_or(None, |reached| *reached)
    }

    /// Tells how far a render with a target has come: for who does the work.
    pub fn report(&self, progress: Progress) {
        if let Ok(mut reached) = self.reached.lock() {
            *reached = Some(progress);
        }
    }

    /// Begins work of so many steps, none of them done: for who does it.
    pub fn start(&self, total: usize) {
        self.done.store(0, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// So many more steps are done: for who does the work.
    pub fn advance(&self, steps: usize) {
        self.done.fetch_add(steps, Ordering::Relaxed);
    }
}
