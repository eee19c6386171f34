//! What must be asked before work is lost? Edits that are not saved when the window closes or another scene comes in,
//! and what someone else has written into the file that is to be saved. No window, no drawing.

#[cfg(test)]
mod tests;

use std::path::PathBuf;

use catoptra_scene::OnDisk;

use crate::difference::Line;
use crate::document::Document;
use crate::recovery::Kept;

/// What ends the work on the open scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Next {
    /// The window closes.
    Close,
    /// The scene in that file is shown instead.
    Open(PathBuf),
    /// A new scene is shown instead.
    New,
    /// Edits that an earlier run has kept are shown instead.
    Recover(Kept),
}

impl Next {
    /// What a person calls what comes.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Open(file) => file.display().to_string(),
            Self::Recover(kept) => kept.name(),
            Self::New => "a new scene".to_owned(),
            Self::Close => "nothing".to_owned(),
        }
    }
}

/// What is to be done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Due {
    /// That comes now.
    Go(Next),
    /// The person is to choose a file to save to; that was to come after saving.
    Choose(Option<Next>),
}

/// What the person is asked; until it is answered nothing else can be done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Question {
    /// There are edits that are not saved, and this comes next.
    Unsaved(Next),
    /// The file to be saved holds something else than it did; this was to come after saving.
    Changed(Option<Next>),
    /// An earlier run has kept edits that were not saved.
    Recovered(Kept),
    /// The window is to close, and a picture for that file is still being made.
    Picture(PathBuf),
}

/// What the person may answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Answer {
    /// Write the scene, whatever stands in its file; bring kept edits back.
    Write,
    /// Give the edits up: go on without saving, show the file as it is now, forget kept edits.
    GiveUp,
    /// Save the scene to another file.
    Elsewhere,
    /// Leave all as it is, and forget what was to come next.
    Cancel,
}

/// What there is to tell: what was done, or what failed.
pub(crate) type Told = Result<String, String>;

/// The question, and what follows from its answer.
#[derive(Debug, Clone, Default)]
pub(crate) struct Guard {
    question: Option<Question>,
    problem: Option<String>,
    /// What differs between a changed file and what is to be written there.
    difference: Vec<Line>,
    due: Option<Due>,
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

    /// What differs between a file that someone else has changed and what would be written there.
    pub(crate) fn difference(&self) -> &[Line] {
        &self.difference
    }

    /// Offers edits that an earlier run has kept.
    pub(crate) fn offer(&mut self, kept: Kept) {
        self.question = Some(Question::Recovered(kept));
    }

    /// Asks whether the window is to close though a picture is being made.
    pub(crate) fn ask_about_picture(&mut self, path: PathBuf) {
        self.question = Some(Question::Picture(path));
    }

    /// What is to be done now, once.
    pub(crate) fn take_due(&mut self) -> Option<Due> {
        self.due.take()
    }

    /// Goes on to what comes next, or asks first whether the edits are to be saved. A wish takes the place of the one
    /// before.
    pub(crate) fn leave(&mut self, next: Next, document: &Document) {
        self.forget();
        if document.is_saved() {
            self.due = Some(Due::Go(next));
        } else {
            self.question = Some(Question::Unsaved(next));
        }
    }

    /// Whether a scene that was read may be shown now. Edits later than the revision at which it was wished for are
    /// asked about first, unless something is asked already: that was wished for later.
    pub(crate) fn lets_in(&mut self, next: &Next, wished_at: u64, document: &Document) -> bool {
        let lets_in = document.is_saved() || document.scene().revision() == wished_at;
        if !lets_in && self.question.is_none() {
            self.question = Some(Question::Unsaved(next.clone()));
        }
        lets_in
    }

    /// Saves the scene, or asks first what is to become of a file that someone else has changed. Returns what there is
    /// to tell.
    pub(crate) fn save(&mut self, document: &mut Document) -> Option<Told> {
        self.forget();
        self.save_unless_changed(document, None)
    }

    /// Saves the scene to a file that was chosen; then comes what was to come. Returns what there is to tell.
    pub(crate) fn save_to(
        &mut self,
        path: PathBuf,
        document: &mut Document,
        next: Option<Next>,
    ) -> Option<Told> {
        self.forget();
        let written = document.save_to(path);
        self.written(written, next)
    }

    /// Takes in the answer to the question. Returns what there is to tell.
    pub(crate) fn answer(&mut self, answer: Answer, document: &mut Document) -> Option<Told> {
        let question = self.question.clone()?;
        self.problem = None;
        match (question, answer) {
            (Question::Unsaved(next), Answer::Write) => self.save_unless_changed(document, Some(next)),
            (Question::Changed(next), Answer::Write) => self.write(document, next),
            (Question::Unsaved(next), Answer::GiveUp) => self.go(Some(next)),
            (Question::Changed(_), Answer::GiveUp) => self.go(Some(Next::Open(document.place()))),
            (Question::Unsaved(next), Answer::Elsewhere) => self.choose(Some(next)),
            (Question::Changed(next), Answer::Elsewhere) => self.choose(next),
            (Question::Recovered(kept), Answer::Write) => {
                self.leave(Next::Recover(kept), document);
                None
            }
            (Question::Recovered(kept), Answer::GiveUp) => {
                kept.forget();
                self.go(None)
            }
            (Question::Picture(_), Answer::GiveUp) => self.go(Some(Next::Close)),
            (Question::Recovered(_), Answer::Elsewhere)
            | (Question::Picture(_), Answer::Write | Answer::Elsewhere)
            | (_, Answer::Cancel) => self.go(None),
        }
    }

    /// Nothing is asked any more, as when another scene is shown.
    pub(crate) fn forget(&mut self) {
        *self = Self::default();
    }

    fn save_unless_changed(&mut self, document: &mut Document, next: Option<Next>) -> Option<Told> {
        if !document.has_place() {
            return self.choose(next);
        }
        if document.on_disk() == OnDisk::Changed {
            self.question = Some(Question::Changed(next));
            self.difference = document.difference();
            return None;
        }
        self.write(document, next)
    }

    /// Writes the scene. If that fails, a question that was asked stays, with the reason.
    fn write(&mut self, document: &mut Document, next: Option<Next>) -> Option<Told> {
        let written = document.save();
        self.written(written, next)
    }

    fn written(&mut self, written: Result<PathBuf, String>, next: Option<Next>) -> Option<Told> {
        match written {
            Ok(path) => {
                self.go(next);
                Some(Ok(format!("saved {}", path.display())))
            }
            Err(problem) if self.question.is_some() => {
                self.problem = Some(problem);
                None
            }
            Err(problem) => Some(Err(problem)),
        }
    }

    fn choose(&mut self, next: Option<Next>) -> Option<Told> {
        self.question = None;
        self.due = Some(Due::Choose(next));
        None
    }

    fn go(&mut self, next: Option<Next>) -> Option<Told> {
        self.question = None;
        self.due = next.map(Due::Go);
        None
    }
}
