//! How does the viewer come to the end of a scene, and how is a scene saved? What is asked and told on the way.

use std::path::{Path, PathBuf};

use crate::browse::{Browser, Purpose};
use crate::guard::{Answer, Due, Next, Question, Told};
use crate::viewer::{Viewer, Wanted};

impl Viewer {
    /// Closes the window or shows another scene, once the edits are saved or given up.
    pub(crate) fn leave(&mut self, next: Next) {
        self.finish_name();
        self.guard.leave(next, &self.document);
        self.stale.panel = true;
    }

    /// Whether a scene that was wished for at that revision may be shown; else edits made since are asked about.
    pub(crate) fn lets_in(&mut self, next: &Next, wished_at: u64) -> bool {
        self.finish_name();
        self.stale.panel = true;
        self.guard.lets_in(next, wished_at, &self.document)
    }

    /// Saves the scene, unless it has no file or that was changed by someone else: then it is asked about.
    pub(crate) fn save(&mut self) {
        self.finish_name();
        let told = self.guard.save(&mut self.document);
        self.tell(told);
    }

    /// Asks where the scene is to be saved; then comes what was to come.
    pub(crate) fn save_elsewhere(&mut self, next: Option<Next>) {
        self.finish_name();
        let place = self.document.place();
        let folder = place.parent().unwrap_or(Path::new(""));
        let name = place.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        self.browse(Purpose::Save(next), folder, name);
    }

    /// Asks for a file.
    pub(crate) fn browse(&mut self, purpose: Purpose, folder: &Path, name: String) {
        self.browser = Some(Browser::new(purpose, folder, name));
        self.stale.panel = true;
    }

    /// Does with a file that was chosen what it was wanted for.
    pub(crate) fn chosen(&mut self, purpose: Purpose, path: PathBuf) {
        self.stale.panel = true;
        match purpose {
            Purpose::Open => self.leave(Next::Open(path)),
            Purpose::Save(next) => self.save_to(path, next),
            Purpose::Model => self.wanted = Some(Wanted::Model(path)),
            Purpose::Picture(spec) => self.want_picture(path, spec),
        }
    }

    /// Takes in what the desktop's own dialog has answered, if that is still waited for; without an answer the one in the
    /// window goes on.
    pub(crate) fn chosen_outside(&mut self, path: Option<PathBuf>) {
        self.stale.panel = true;
        let Some(mut browser) = self.browser.take_if(|browser| browser.waits) else { return };
        browser.waits = false;
        match path.and_then(|path| browser.choose_whole(path)) {
            Some(path) => self.chosen(browser.purpose, path),
            None => self.browser = Some(browser),
        }
    }

    /// Saves the scene to a file that was chosen; then comes what was to come.
    pub(crate) fn save_to(&mut self, path: PathBuf, next: Option<Next>) {
        let told = self.guard.save_to(path, &mut self.document, next);
        self.tell(told);
    }

    /// Answers what is asked.
    pub(crate) fn answer(&mut self, answer: Answer) {
        if let (Some(Question::Picture(_)), Answer::GiveUp) = (self.guard.question(), answer) {
            self.pictures.cancel();
        }
        let told = self.guard.answer(answer, &mut self.document);
        self.tell(told);
    }

    /// What is to be done now, once; a file to be saved to is asked for here.
    pub(crate) fn take_next(&mut self) -> Option<Next> {
        match self.guard.take_due()? {
            Due::Go(Next::Close) => match self.pictures.unfinished() {
                Some(path) => {
                    self.guard.ask_about_picture(path.to_owned());
                    self.stale.panel = true;
                    None
                }
                None => Some(Next::Close),
            },
            Due::Go(next) => Some(next),
            Due::Choose(next) => {
                self.save_elsewhere(next);
                None
            }
        }
    }

    /// Tells what was done; what failed stays until it is done or the person takes it away.
    fn tell(&mut self, told: Option<Told>) {
        self.stale.panel = true;
        match told {
            Some(Ok(done)) => {
                self.failure = None;
                self.notify(done);
            }
            Some(Err(problem)) => self.failure = Some(problem),
            None => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptra_core::scene::Edit;
    use catoptra_tracer::Pool;

    use super::*;
    use crate::document::Document;
    use crate::loader::Opened;

    #[test]
    fn what_could_not_be_saved_is_told_until_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        let path = inner.join("a.kdl");
        std::fs::write(&path, "ambient-light \"sky\" { radiance 1 }\n").unwrap();
        let mut viewer = Viewer::new(Opened::new(Document::open(&path).unwrap(), &Pool::new(1).unwrap()));
        let sky = viewer.document.scene().entity_named("sky").unwrap();
        viewer.edit(Edit::Name(sky, "heaven".to_owned()));
        std::fs::remove_dir_all(&inner).unwrap();
        viewer.save();
        assert!(viewer.failure.as_ref().is_some_and(|told| told.contains("was not saved")));
        viewer.notify("something else");
        assert!(viewer.failure.is_some() && !viewer.document.is_saved());
        std::fs::create_dir(&inner).unwrap();
        viewer.save();
        assert!(viewer.failure.is_none() && viewer.document.is_saved());
    }

    #[test]
    fn what_the_desktops_dialog_answers_counts_only_while_it_is_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = Viewer::new(Opened::new(Document::empty().unwrap(), &Pool::new(1).unwrap()));
        let file = folder.path().join("mine.kdl");
        viewer.save_elsewhere(None);
        viewer.chosen_outside(Some(file.clone()));
        assert!(viewer.browser.is_some() && !file.exists(), "it was not asked");
        viewer.browser.as_mut().unwrap().waits = true;
        viewer.chosen_outside(None);
        assert!(viewer.browser.as_ref().is_some_and(|browser| !browser.waits), "the other dialog goes on");
        viewer.browser.as_mut().unwrap().waits = true;
        viewer.chosen_outside(Some(file.clone()));
        assert!(viewer.browser.is_none() && file.exists());
        viewer.chosen_outside(Some(folder.path().join("late.kdl")));
        assert!(!folder.path().join("late.kdl").exists());
    }

    #[test]
    fn a_scene_without_a_file_is_saved_where_a_person_says() {
        let folder = tempfile::tempdir().unwrap();
        let mut viewer = Viewer::new(Opened::new(Document::empty().unwrap(), &Pool::new(1).unwrap()));
        viewer.save();
        assert_eq!(viewer.take_next(), None);
        assert_eq!(viewer.browser.take().unwrap().purpose, Purpose::Save(None));
        viewer.save_to(folder.path().join("mine.kdl"), Some(Next::Close));
        assert_eq!((viewer.take_next(), viewer.document.name()), (Some(Next::Close), "mine".to_owned()));
        let again = Document::open(&folder.path().join("mine.kdl")).unwrap();
        assert_eq!(again.scene().entities().len(), viewer.document.scene().entities().len());
    }
}
