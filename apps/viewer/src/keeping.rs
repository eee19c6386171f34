//! When are edits kept that are not saved? By themselves, some seconds after the first that is not kept yet, on a thread: a
//! window that is killed loses no more than those.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use catoptra_core::scene::Scene;
use catoptra_scene::SceneFile;

use crate::document::Document;
use crate::recovery::{Kept, Origin, Own};

/// How long an edit is not kept, at the most, but for a drag that goes on.
pub(crate) const AFTER: Duration = Duration::from_secs(4);

/// A scene with edits that are not saved.
pub(crate) struct Unsaved {
    pub(crate) scene: Scene,
    pub(crate) file: SceneFile,
    pub(crate) origin: Origin,
    /// Kept edits of an earlier run that it holds: they need not be kept beside it.
    pub(crate) holds: Option<Kept>,
}

impl Unsaved {
    /// Keeps it at a place of this window.
    fn keep(mut self, own: &Own) -> Result<(), String> {
        self.file.update(&self.scene);
        let text = match &self.origin {
            Origin::File(path) => self.file.text_for(path),
            Origin::Folder(_) => self.file.text(),
        };
        own.keep(&self.origin, &text).map_err(|e| e.to_string())?;
        if let Some(kept) = self.holds {
            kept.forget();
        }
        Ok(())
    }
}

/// What the thread is to do.
enum Job {
    Keep(Box<Unsaved>),
    Forget,
}

/// Keeps the edits of a window while they are not saved.
pub(crate) struct Keeper {
    jobs: Sender<Job>,
    thread: JoinHandle<Result<Option<PathBuf>, String>>,
    /// The revision of the scene that is kept.
    kept: Option<u64>,
    /// When edits are to be kept that are not.
    due: Option<Instant>,
}

impl Keeper {
    /// Keeps them in that folder. `failed` hears why they cannot be kept, each time that another reason keeps them from it.
    pub(crate) fn start(folder: Option<PathBuf>, failed: impl Fn(String) + Send + 'static) -> Self {
        let (jobs, todo) = channel();
        let thread = std::thread::spawn(move || work(&todo, folder.as_deref(), &failed));
        Self { jobs, thread, kept: None, due: None }
    }

    /// Keeps the edits if that is due and nothing is being dragged, and forgets them once they are saved.
    pub(crate) fn follow(&mut self, document: &Document, drags: bool, now: Instant) {
        let revision = document.scene().revision();
        if document.is_saved() {
            if self.kept.is_some() {
                self.forget();
            }
            self.due = None;
        } else if self.kept != Some(revision) && now >= *self.due.get_or_insert(now + AFTER) && !drags {
            self.send(Job::Keep(Box::new(document.unsaved())));
            (self.kept, self.due) = (Some(revision), None);
        }
    }

    /// When the next edits are to be kept, if that is still to come.
    pub(crate) fn due(&self, now: Instant) -> Option<Instant> {
        self.due.filter(|due| *due > now)
    }

    /// The edits are given up.
    pub(crate) fn forget(&mut self) {
        self.send(Job::Forget);
        (self.kept, self.due) = (None, None);
    }

    /// Keeps the last edits, or forgets all where there are none, and ends. Where they are kept then.
    ///
    /// # Errors
    /// Why they could not be kept, for people.
    pub(crate) fn end(self, unsaved: Option<Unsaved>) -> Result<Option<PathBuf>, String> {
        self.send(unsaved.map_or(Job::Forget, |unsaved| Job::Keep(Box::new(unsaved))));
        drop(self.jobs);
        // A panic there has been reported by its own thread.
        self.thread.join().unwrap_or_else(|_| Err("the thread that keeps them has ended".to_owned()))
    }

    fn send(&self, job: Job) {
        // A thread that has ended has reported why.
        let _ = self.jobs.send(job);
    }
}

/// Does what comes in, the newest of what waits. Answers with what the last came to.
fn work(
    todo: &Receiver<Job>,
    folder: Option<&Path>,
    failed: &impl Fn(String),
) -> Result<Option<PathBuf>, String> {
    let mut own: Option<Own> = None;
    let mut last = Ok(None);
    while let Ok(job) = todo.recv() {
        let before = last.as_ref().err().cloned();
        last = match todo.try_iter().last().unwrap_or(job) {
            Job::Forget => {
                own.take().into_iter().for_each(Own::forget);
                Ok(None)
            }
            Job::Keep(unsaved) => keep(*unsaved, folder, &mut own).map(Some),
        };
        if let Err(why) = &last
            && before.as_ref() != Some(why)
        {
            failed(why.clone());
        }
    }
    last
}

fn keep(unsaved: Unsaved, folder: Option<&Path>, own: &mut Option<Own>) -> Result<PathBuf, String> {
    let folder = folder.ok_or("there is no folder to keep unsaved edits in")?;
    if own.is_none() {
        *own = Some(Own::claim(folder).map_err(|e| format!("{}: {e}", folder.display()))?);
    }
    let own = own.as_ref().ok_or("there is no place for them")?;
    unsaved.keep(own)?;
    Ok(own.place().to_owned())
}

#[cfg(test)]
mod tests {
    use catoptra_core::scene::Edit;

    use super::*;
    use crate::recovery;

    fn edited(document: &mut Document, name: &str) {
        let id = document.scene().entities().next().unwrap();
        document.edit(Edit::Name(id, name.to_owned())).unwrap();
    }

    fn kept(folder: &std::path::Path) -> Vec<String> {
        recovery::all(folder).iter().map(|kept| kept.text().unwrap()).collect()
    }

    #[test]
    fn edits_are_kept_after_some_seconds_and_only_once() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = Document::empty().unwrap();
        let mut keeper = Keeper::start(Some(folder.path().to_owned()), |why| panic!("{why}"));
        let start = Instant::now();
        keeper.follow(&document, false, start);
        assert_eq!(keeper.due(start), None, "there is nothing to keep");
        edited(&mut document, "first");
        keeper.follow(&document, false, start);
        edited(&mut document, "second");
        keeper.follow(&document, false, start + AFTER / 2);
        assert_eq!(keeper.due(start), Some(start + AFTER), "from the first edit on");
        keeper.follow(&document, true, start + AFTER);
        assert_eq!((keeper.due(start + AFTER), keeper.kept), (None, None), "not during a drag");
        keeper.follow(&document, false, start + AFTER);
        keeper.follow(&document, false, start + 3 * AFTER);
        assert_eq!((keeper.due, keeper.kept), (None, Some(document.scene().revision())));
        // As of a window that is killed.
        drop(keeper.jobs);
        keeper.thread.join().unwrap().unwrap();
        let kept = kept(folder.path());
        assert!(kept.len() == 1 && kept[0].contains("\"second\""), "{kept:?}");
    }

    #[test]
    fn what_is_saved_given_up_or_taken_back_is_not_kept() {
        let folder = tempfile::tempdir().unwrap();
        let mut document = Document::empty().unwrap();
        let state = folder.path().join("state");
        let mut keeper = Keeper::start(Some(state.clone()), |why| panic!("{why}"));
        let start = Instant::now();
        edited(&mut document, "first");
        for time in [start, start + AFTER] {
            keeper.follow(&document, false, time);
        }
        let files = || std::fs::read_dir(&state).map_or(0, Iterator::count);
        // The text, and what says that this window lives.
        while files() < 2 {
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(document.undo().is_some());
        keeper.follow(&document, false, start + AFTER);
        assert_eq!((keeper.due, keeper.kept), (None, None));
        assert_eq!(keeper.end(None), Ok(None));
        assert_eq!(files(), 0);
    }

    #[test]
    fn edits_that_were_brought_back_are_kept_once_with_what_came_since() {
        let folder = tempfile::tempdir().unwrap();
        let state = folder.path().join("state");
        let path = folder.path().join("a.kdl");
        std::fs::write(&path, "ambient-light \"sky\" { radiance 1 }\n").unwrap();
        let mut document = Document::open(&path).unwrap();
        edited(&mut document, "heaven");
        let end = |document: &Document| {
            let keeper = Keeper::start(Some(state.clone()), |why| panic!("{why}"));
            keeper.end(Some(document.unsaved())).unwrap().unwrap()
        };
        end(&document);
        let earlier = recovery::all(&state).pop().unwrap();
        let mut back = Document::recover(&earlier).unwrap();
        edited(&mut back, "blue");
        let place = end(&back);
        assert!(!back.is_saved() && place != earlier.place);
        let kept = recovery::all(&state);
        assert_eq!((kept.len(), &kept[0].place, &kept[0].origin), (1, &place, &Origin::File(path)));
        assert!(kept[0].text().unwrap().contains("\"blue\""));
    }

    #[test]
    fn what_cannot_be_kept_is_told_once() {
        let folder = tempfile::tempdir().unwrap();
        let state = folder.path().join("state");
        std::fs::write(&state, "in the way").unwrap();
        let (told, hears) = channel();
        let mut document = Document::empty().unwrap();
        let mut keeper = Keeper::start(Some(state), move |why| told.send(why).unwrap());
        let start = Instant::now();
        for (name, times) in [("first", [0, 1]), ("second", [2, 3])] {
            edited(&mut document, name);
            for time in times {
                keeper.follow(&document, false, start + time * AFTER);
            }
        }
        assert!(keeper.end(Some(document.unsaved())).is_err());
        assert_eq!(hears.iter().count(), 1);
    }
}
