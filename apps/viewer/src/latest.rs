//! Which snapshot of the open scene is the newest that is ready? The worker makes it, the window picks in it.

use std::sync::{Arc, Mutex, PoisonError};

use catoptra_tracer::{Extraction, Pool, Snapshot};

/// The newest finished snapshot of one document, shared by the window and the worker.
pub(crate) struct Latest {
    snapshot: Mutex<Arc<Snapshot>>,
}

impl Latest {
    /// The first snapshot of a document.
    pub(crate) fn new(snapshot: Snapshot) -> Self {
        Self { snapshot: Mutex::new(Arc::new(snapshot)) }
    }

    /// The snapshot; never waits for one that is being made.
    pub(crate) fn get(&self) -> Arc<Snapshot> {
        Arc::clone(&self.snapshot.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// The snapshot of a later state of the document, made on the threads of `pool` where it is not there yet.
    pub(crate) fn follow(&self, extraction: &Extraction, pool: &Pool) -> Arc<Snapshot> {
        let earlier = self.get();
        if earlier.revision() == extraction.revision() {
            return earlier;
        }
        let (snapshot, _) = extraction.after(&earlier, pool);
        let snapshot = Arc::new(snapshot);
        *self.snapshot.lock().unwrap_or_else(PoisonError::into_inner) = Arc::clone(&snapshot);
        snapshot
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::Edit;

    use super::*;
    use crate::document::Document;

    #[test]
    fn a_snapshot_is_made_once_for_each_state() {
        let (pool, mut document) = (Pool::new(1).unwrap(), Document::welcome().unwrap());
        let latest = Latest::new(Snapshot::extract(document.scene(), &pool));
        let first = latest.get();
        assert!(Arc::ptr_eq(&first, &latest.follow(&Extraction::of(document.scene()), &pool)));
        let floor = document.scene().entity_named("floor").unwrap();
        document.edit(Edit::Remove(floor)).unwrap();
        let second = latest.follow(&Extraction::of(document.scene()), &pool);
        assert!(!Arc::ptr_eq(&first, &second) && Arc::ptr_eq(&second, &latest.get()));
        assert!(!second.entities().contains(&floor));
    }
}
