//! What must be asked before work is lost? Edits that are not saved when the window closes or another scene comes in,
//! and what someone else has written into the file that is to be saved. No window, no drawing.

use std::path::{Path, PathBuf};

use catoptra_scene::OnDisk;

use crate::document::Document;

/// What ends the work on the open scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Next {
    /// The window closes.
    Close,
    /// The scene in that file is shown instead.
    Open(PathBuf),
}

/// What the person is asked; until it is answered nothing else can be done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Question {
    /// There are edits that are not saved, and this comes next.
    Unsaved(Next),
    /// The file to be saved holds something else than it did; this was to come after saving.
    Changed(Option<Next>),
}

/// What the person may answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Answer {
    /// Write the scene, whatever stands in its file.
    Write,
    /// Give the edits up: go on without saving, or show the file as it is now.
    GiveUp,
    /// Leave all as it is, and forget what was to come next.
    Cancel,
}

/// The question, and what follows from its answer.
#[derive(Debug, Clone, Default)]
pub(crate) struct Guard {
    question: Option<Question>,
    problem: Option<String>,
    due: Option<Next>,
}

impl Guard {
    /// What is asked now.
    pub(crate) fn question(&self) -> Option<&Question> {
        self.question.as_ref()
    }

    /// Why the last answer to the question could not be followed.
    pub(crate) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// What is to be done now, once.
    pub(crate) fn take_due(&mut self) -> Option<Next> {
        self.due.take()
    }

    /// Goes on to what comes next, or asks first whether the edits are to be saved. A wish takes the place of the one
    /// before.
    pub(crate) fn leave(&mut self, next: Next, document: &Document) {
        self.forget();
        if document.is_saved() {
            self.due = Some(next);
        } else {
            self.question = Some(Question::Unsaved(next));
        }
    }

    /// Whether a scene that was read may be shown now. Edits later than the revision at which it was wished for are
    /// asked about first, unless something is asked already: that was wished for later.
    pub(crate) fn lets_in(&mut self, file: &Path, wished_at: u64, document: &Document) -> bool {
        let lets_in = document.is_saved() || document.scene().revision() == wished_at;
        if !lets_in && self.question.is_none() {
            self.question = Some(Question::Unsaved(Next::Open(file.to_owned())));
        }
        lets_in
    }

    /// Saves the scene, or asks first what is to become of a file that someone else has changed. Returns what there is
    /// to tell.
    pub(crate) fn save(&mut self, document: &mut Document) -> Option<String> {
        self.forget();
        self.save_unless_changed(document, None)
    }

    /// Takes in the answer to the question. Returns what there is to tell.
    pub(crate) fn answer(&mut self, answer: Answer, document: &mut Document) -> Option<String> {
        let question = self.question.clone()?;
        self.problem = None;
        match (question, answer) {
            (Question::Unsaved(next), Answer::Write) => self.save_unless_changed(document, Some(next)),
            (Question::Changed(next), Answer::Write) => self.write(document, next),
            (Question::Unsaved(next), Answer::GiveUp) => self.go(Some(next)),
            (Question::Changed(_), Answer::GiveUp) => self.go(Some(Next::Open(document.place()))),
            (_, Answer::Cancel) => self.go(None),
        }
    }

    /// Nothing is asked any more, as when another scene is shown.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }

    fn save_unless_changed(&mut self, document: &mut Document, next: Option<Next>) -> Option<String> {
        if document.on_disk() == OnDisk::Changed {
            self.question = Some(Question::Changed(next));
            return None;
        }
        self.write(document, next)
    }

    /// Writes the scene. If that fails, a question that was asked stays, with the reason.
    fn write(&mut self, document: &mut Document, next: Option<Next>) -> Option<String> {
        match document.save() {
            Ok(path) => {
                self.go(next);
                Some(format!("saved {}", path.display()))
            }
            Err(problem) if self.question.is_some() => {
                self.problem = Some(problem);
                None
            }
            Err(problem) => Some(problem),
        }
    }

    fn go(&mut self, next: Option<Next>) -> Option<String> {
        self.question = None;
        self.due = next;
        None
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::scene::Edit;

    use super::*;

    const TEXT: &str =
        "matte \"grey\" { color 0.5 0.5 0.5 }\nsphere \"ball\" material=\"grey\" { radius 1 }\n";

    /// A scene in a file of that folder, with an edit.
    fn edited(folder: &Path) -> (PathBuf, Document) {
        let path = folder.join("ball.kdl");
        std::fs::write(&path, TEXT).unwrap();
        let mut document = Document::open(&path).unwrap();
        let ball = document.scene().entity_named("ball").unwrap();
        document.edit(Edit::Name(ball, "globe".to_owned())).unwrap();
        (path, document)
    }

    fn text(path: &Path) -> String {
        std::fs::read_to_string(path).unwrap()
    }

    /// What is asked and what is due.
    fn state(guard: &mut Guard) -> (Option<Question>, Option<Next>) {
        (guard.question().cloned(), guard.take_due())
    }

    #[test]
    fn without_edits_nothing_is_asked() {
        let mut guard = Guard::default();
        guard.leave(Next::Close, &Document::welcome().unwrap());
        assert_eq!(state(&mut guard), (None, Some(Next::Close)));
        assert_eq!(guard.take_due(), None, "what is due is done once");
    }

    #[test]
    fn edits_are_saved_first_or_given_up_or_kept() {
        let next = Next::Open("other.kdl".into());
        for (answer, due, written) in [
            (Answer::Write, Some(next.clone()), true),
            (Answer::GiveUp, Some(next.clone()), false),
            (Answer::Cancel, None, false),
        ] {
            let folder = tempfile::tempdir().unwrap();
            let (path, mut document) = edited(folder.path());
            let mut guard = Guard::default();
            guard.leave(next.clone(), &document);
            assert_eq!(state(&mut guard), (Some(Question::Unsaved(next.clone())), None));
            guard.answer(answer, &mut document);
            assert_eq!(state(&mut guard), (None, due), "{answer:?}");
            assert_eq!(
                (document.is_saved(), text(&path).contains("globe")),
                (written, written),
                "{answer:?}"
            );
        }
    }

    #[test]
    fn the_newest_wish_counts() {
        let folder = tempfile::tempdir().unwrap();
        let (_, mut document) = edited(folder.path());
        let mut guard = Guard::default();
        guard.leave(Next::Open("other.kdl".into()), &document);
        guard.leave(Next::Close, &document);
        guard.answer(Answer::Write, &mut document);
        assert_eq!(guard.take_due(), Some(Next::Close));
    }

    #[test]
    fn edits_made_while_a_file_is_read_are_asked_about() {
        let folder = tempfile::tempdir().unwrap();
        let (_, mut document) = edited(folder.path());
        let (mut guard, file) = (Guard::default(), Path::new("other.kdl"));
        let wished_at = document.scene().revision();
        assert!(guard.lets_in(file, wished_at, &document), "those edits were given up");
        let globe = document.scene().entity_named("globe").unwrap();
        document.edit(Edit::Remove(globe)).unwrap();
        assert!(!guard.lets_in(file, wished_at, &document));
        assert_eq!(guard.question(), Some(&Question::Unsaved(Next::Open(file.to_owned()))));
        guard.leave(Next::Close, &document);
        assert!(!guard.lets_in(file, wished_at, &document));
        assert_eq!(guard.question(), Some(&Question::Unsaved(Next::Close)), "asked later");
        document.save().unwrap();
        assert!(guard.lets_in(file, wished_at, &document));
    }

    #[test]
    fn a_failed_save_keeps_the_question_and_tells_why() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        let (_, mut document) = edited(&inner);
        std::fs::remove_dir_all(&inner).unwrap();
        let mut guard = Guard::default();
        guard.leave(Next::Close, &document);
        guard.answer(Answer::Write, &mut document);
        assert_eq!(state(&mut guard), (Some(Question::Unsaved(Next::Close)), None));
        assert!(guard.problem().unwrap().contains("was not saved"), "{:?}", guard.problem());
        assert!(!document.is_saved());
        guard.answer(Answer::GiveUp, &mut document);
        assert_eq!((guard.problem().is_none(), guard.take_due()), (true, Some(Next::Close)));
    }

    #[test]
    fn a_file_that_someone_else_has_changed_is_not_written_unasked() {
        for (answer, theirs, due) in
            [(Answer::Write, false, false), (Answer::GiveUp, true, true), (Answer::Cancel, true, false)]
        {
            let folder = tempfile::tempdir().unwrap();
            let (path, mut document) = edited(folder.path());
            std::fs::write(&path, TEXT.replace("radius 1", "radius 2")).unwrap();
            let mut guard = Guard::default();
            assert_eq!(guard.save(&mut document), None);
            assert_eq!(guard.question(), Some(&Question::Changed(None)));
            assert!(text(&path).contains("radius 2"));
            guard.answer(answer, &mut document);
            assert_eq!(guard.question(), None);
            assert_eq!(text(&path).contains("radius 2"), theirs, "{answer:?}");
            assert_eq!(guard.take_due(), due.then_some(Next::Open(path)), "{answer:?}");
            assert_eq!(document.is_saved(), answer == Answer::Write);
        }
    }

    #[test]
    fn saving_before_closing_asks_about_a_changed_file_too() {
        let folder = tempfile::tempdir().unwrap();
        let (path, mut document) = edited(folder.path());
        std::fs::write(&path, "").unwrap();
        let mut guard = Guard::default();
        guard.leave(Next::Close, &document);
        guard.answer(Answer::Write, &mut document);
        assert_eq!(state(&mut guard), (Some(Question::Changed(Some(Next::Close))), None));
        guard.answer(Answer::Write, &mut document);
        assert_eq!(guard.take_due(), Some(Next::Close));
        assert!(text(&path).contains("globe"));
    }

    #[test]
    fn showing_the_changed_file_closes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let (path, mut document) = edited(folder.path());
        std::fs::write(&path, "").unwrap();
        let mut guard = Guard::default();
        guard.leave(Next::Close, &document);
        guard.answer(Answer::Write, &mut document);
        guard.answer(Answer::GiveUp, &mut document);
        assert_eq!(guard.take_due(), Some(Next::Open(path)));
    }

    #[test]
    fn a_file_that_is_gone_is_written_again_unasked() {
        let folder = tempfile::tempdir().unwrap();
        let (path, mut document) = edited(folder.path());
        std::fs::remove_file(&path).unwrap();
        let told = Guard::default().save(&mut document).unwrap();
        assert!(told.starts_with("saved ") && text(&path).contains("globe"), "{told}");
    }

    #[test]
    fn the_second_of_two_viewers_is_asked_and_then_the_first() {
        let folder = tempfile::tempdir().unwrap();
        let (path, mut first) = edited(folder.path());
        let (_, mut second) = edited(folder.path());
        assert!(Guard::default().save(&mut first).is_some());
        let mut guard = Guard::default();
        assert_eq!(guard.save(&mut second), None);
        // The first has written what the second would write, and still the second is asked: it did not know of it.
        assert_eq!(guard.question(), Some(&Question::Changed(None)));
        second.undo();
        guard.answer(Answer::Write, &mut second);
        assert_eq!(text(&path), TEXT);
        assert_eq!(guard.save(&mut first), None);
        assert_eq!(guard.question(), Some(&Question::Changed(None)));
    }
}
