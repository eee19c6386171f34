//! Shows the progress of a running render and cancels it, from any thread.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Progress and cancellation of one render; share it by reference or `Arc`.
#[derive(Debug, Default)]
pub struct Control {
    cancelled: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
    reached: Mutex<Option<Progress>>,
}

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
    /// Requests the render to stop after the tiles that are being traced.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether it has been requested to stop.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Share of the tiles that are done, 0..=1; with a target, of the pass under way.
    #[must_use]
    pub fn progress(&self) -> f32 {
        let total = self.total.load(Ordering::Relaxed);
        if total == 0 { 0.0 } else { self.done.load(Ordering::Relaxed) as f32 / total as f32 }
    }

    /// How far a render with a target had come after its last pass; `None` before the first has ended, and without one.
    #[must_use]
    pub fn reached(&self) -> Option<Progress> {
        self.reached.lock().map_or(None, |reached| *reached)
    }

    pub(crate) fn report(&self, progress: Progress) {
        if let Ok(mut reached) = self.reached.lock() {
            *reached = Some(progress);
        }
    }

    pub(crate) fn start(&self, total: usize) {
        self.done.store(0, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    pub(crate) fn advance(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }
}
