//! How does a scene come in without stopping the window? Read and extracted on a thread of its own.

use std::sync::Arc;

use catoptra_tracer::{Extraction, Pool};

use crate::document::Document;
use crate::guard::Next;
use crate::latest::Latest;

/// A scene that is ready to be shown.
pub(crate) struct Opened {
    /// The scene.
    pub(crate) document: Document,
    /// The scene as the worker freezes it.
    pub(crate) extraction: Arc<Extraction>,
    /// The scene for the tracer.
    pub(crate) latest: Arc<Latest>,
}

impl Opened {
    /// Of a document.
    pub(crate) fn new(document: Document, pool: &Pool) -> Self {
        let extraction = Extraction::of(document.scene());
        let latest = Latest::new(extraction.snapshot(pool));
        Self { document, extraction: Arc::new(extraction), latest: Arc::new(latest) }
    }
}

/// What came of reading a scene.
pub(crate) struct Outcome {
    /// Which of those asked for this is; only the last one asked for counts.
    pub(crate) ticket: u64,
    /// What was read.
    pub(crate) next: Next,
    /// The scene, or a report of what is wrong.
    pub(crate) result: Result<Box<Opened>, String>,
}

/// The built-in scene.
///
/// # Errors
/// A report of what is wrong in its text.
pub(crate) fn welcome(pool: &Pool) -> Result<Opened, String> {
    Document::welcome().map(|document| Opened::new(document, pool))
}

/// Reads what comes next on a thread of its own, with the pool's help, and hands the outcome to `done` there.
pub(crate) fn open(next: Next, ticket: u64, pool: Arc<Pool>, done: impl FnOnce(Outcome) + Send + 'static) {
    std::thread::spawn(move || {
        let read = match &next {
            Next::Open(path) => Document::open(path),
            Next::Recover(kept) => Document::recover(kept),
            Next::New | Next::Close => Document::empty(),
        };
        let result = read.map(|document| Box::new(Opened::new(document, &pool)));
        done(Outcome { ticket, next, result });
    });
}
