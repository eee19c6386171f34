//! Were the files changed that the scene was read from? A thread looks at their times and sizes once in a while.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

/// How often is looked: soon enough for who saves in an editor and looks up, and nothing to a processor.
const EVERY: Duration = Duration::from_millis(700);

/// What tells that a file was written: when, and how long it is. Nothing where there is no file.
type Stamp = Option<(SystemTime, u64)>;

/// Files with their stamps.
type Stamped = Vec<(PathBuf, Stamp)>;

/// The files that are watched.
pub(crate) struct Watch {
    files: Arc<Mutex<Stamped>>,
}

impl Watch {
    /// Watches nothing yet; `changed` hears of files that were changed, on a thread of its own, until it says that nobody
    /// listens any more.
    pub(crate) fn start(changed: impl Fn(Vec<PathBuf>) -> bool + Send + 'static) -> Self {
        let files: Arc<Mutex<Stamped>> = Arc::default();
        let watched = Arc::clone(&files);
        std::thread::spawn(move || {
            loop {
                std::thread::sleep(EVERY);
                let found = news(&mut watched.lock().unwrap_or_else(PoisonError::into_inner));
                if !found.is_empty() && !changed(found) {
                    return;
                }
            }
        });
        Self { files }
    }

    /// Watches these from now on, and no others. What has happened to those that were watched before is still told.
    pub(crate) fn set(&self, files: impl IntoIterator<Item = PathBuf>) {
        let mut watched = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        let mut stamped: Stamped = Vec::new();
        for path in files {
            if !stamped.iter().any(|(known, _)| *known == path) {
                let known = watched.iter().find(|(known, _)| *known == path).map(|(_, stamp)| *stamp);
                let stamp = known.unwrap_or_else(|| stamp(&path));
                stamped.push((path, stamp));
            }
        }
        *watched = stamped;
    }
}

/// The files that were changed since the last look. One that is away for a moment, as while it is being replaced, is
/// told of when it is there again.
fn news(files: &mut Stamped) -> Vec<PathBuf> {
    let mut changed = Vec::new();
    for (path, known) in files {
        let now = stamp(path);
        if now.is_some() && now != *known {
            *known = now;
            changed.push(path.clone());
        }
    }
    changed
}

fn stamp(path: &Path) -> Stamp {
    let found = std::fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_was_written_is_told_of_once() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        std::fs::write(&a, "1").unwrap();
        let mut files = vec![(a.clone(), stamp(&a)), (b.clone(), stamp(&b))];
        assert!(news(&mut files).is_empty());
        std::fs::write(&a, "12").unwrap();
        assert_eq!(news(&mut files), std::slice::from_ref(&a));
        assert!(news(&mut files).is_empty());
        std::fs::remove_file(&a).unwrap();
        assert!(news(&mut files).is_empty(), "it may come again");
        std::fs::write(&a, "123").unwrap();
        std::fs::write(&b, "").unwrap();
        assert_eq!(news(&mut files), [a, b]);
    }

    #[test]
    fn the_thread_tells() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "1").unwrap();
        let (send, receive) = std::sync::mpsc::channel();
        let watch = Watch::start(move |changed| send.send(changed).is_ok());
        watch.set([path.clone(), path.clone()]);
        std::fs::write(&path, "12").unwrap();
        assert_eq!(receive.recv_timeout(Duration::from_secs(30)), Ok(vec![path]));
    }
}
