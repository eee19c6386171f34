//! How do files come into the window, and what becomes of edits when it ends? Scenes are opened and opened again when
//! their files change; what is not saved is kept by itself and when the viewer is told to end, and offered at the next start.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use crate::app::{App, Wake};
use crate::guard::Next;
use crate::keeping::{Keeper, Unsaved};
use crate::loader::{self, Outcome};
use crate::viewer::{Broken, Wanted};
use crate::{desktop_dialog, dropped, making, recent, recovery};

impl App {
    /// Starts to read what comes next; the scene shown stays until that is there, and goes then with the edits made so far.
    pub(crate) fn open(&mut self, next: Next) {
        self.ticket += 1;
        self.wished_at = self.viewer.document.scene().revision();
        if let Next::Open(file) = &next {
            self.viewer.notify(format!("opening {}", file.display()));
        }
        let proxy = self.proxy.clone();
        loader::open(next, self.ticket, Arc::clone(&self.pool), move |outcome| {
            // The loop may have ended; then no one waits for the file.
            let _ = proxy.send_event(Wake::Opened(outcome));
        });
    }

    /// Shows what was read, or tells why it could not be.
    pub(crate) fn opened(&mut self, outcome: Outcome) {
        if outcome.ticket != self.ticket {
            return;
        }
        self.starting = false;
        match outcome.result {
            Ok(opened) => {
                if self.viewer.lets_in(&outcome.next, self.wished_at) {
                    self.viewer.show(*opened);
                    self.keeper.iter_mut().for_each(Keeper::forget);
                    self.welcome(&outcome.next);
                }
            }
            Err(report) => {
                self.viewer.notify(format!("{} was not opened", outcome.next.name()));
                self.viewer.error = Some(Broken { report, source: outcome.next });
            }
        }
        self.watch_files();
    }

    fn welcome(&mut self, shown: &Next) {
        self.viewer.notify(match shown {
            Next::Open(file) => {
                if let Some(state) = recovery::state_folder() {
                    recent::remember(&state, file);
                }
                format!("opened {}", file.display())
            }
            Next::Recover(_) => "unsaved edits are back; they are still to be saved".to_owned(),
            Next::New | Next::Close => "a new scene".to_owned(),
        });
    }

    /// Watches the files of the scene, and one that could not be opened.
    pub(crate) fn watch_files(&self) {
        let broken = self.viewer.error.as_ref().and_then(|broken| match &broken.source {
            Next::Open(file) => Some(file.clone()),
            _ => None,
        });
        self.watch.set(self.viewer.document.files().into_iter().chain(broken));
    }

    /// Reads what is shown again where its files were changed by someone else; edits that are not saved stay, and that is
    /// told.
    pub(crate) fn files_changed(&mut self, changed: &[PathBuf]) {
        let broken = match &self.viewer.error {
            Some(Broken { source: Next::Open(file), .. }) => Some(file.clone()),
            _ => None,
        };
        if let Some(file) = broken.filter(|file| changed.contains(file)) {
            return self.viewer.leave(Next::Open(file));
        }
        let source = self.viewer.document.source().map(Path::to_owned);
        let is_news = |file: &&PathBuf| {
            Some(file.as_path()) != source.as_deref() || !self.viewer.document.is_same_on_disk()
        };
        let Some(first) = changed.iter().find(is_news) else { return };
        let name = first.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match source {
            Some(source) if self.viewer.document.is_saved() => self.open(Next::Open(source)),
            _ => self.viewer.notify(format!("{name} was changed elsewhere: F5 reads the scene again")),
        }
    }

    /// Offers edits that an earlier run has kept, one after the other.
    pub(crate) fn offer_kept(&mut self) {
        if !self.starting
            && self.viewer.guard.question().is_none()
            && let Some(kept) = self.kept.pop()
        {
            self.viewer.guard.offer(kept);
            self.viewer.stale.panel = true;
        }
    }

    /// Keeps the edits that are not saved, since the viewer is told to end.
    ///
    /// # Errors
    /// Why they could not be kept, for people.
    pub(crate) fn keep_edits(&mut self) -> Result<(), String> {
        self.viewer.finish_name();
        let document = &self.viewer.document;
        let unsaved = (!document.is_saved()).then(|| document.unsaved());
        let kept = self.end_keeping(unsaved).map_err(|why| format!("unsaved edits are lost: {why}"))?;
        if let Some(place) = kept {
            eprintln!("unsaved edits are kept in {}", place.display());
        }
        Ok(())
    }

    /// Ends the keeping of edits with those that are to be kept at the end, if any.
    ///
    /// # Errors
    /// Why they could not be kept, for people.
    pub(crate) fn end_keeping(&mut self, unsaved: Option<Unsaved>) -> Result<Option<PathBuf>, String> {
        self.keeper.take().map_or(Ok(None), |keeper| keeper.end(unsaved))
    }

    /// Keeps edits by themselves, where that is due.
    pub(crate) fn keep_edits_if_due(&mut self) {
        let drags = self.viewer.pointer.is_pressed() || self.viewer.transform.is_some();
        if let Some(keeper) = &mut self.keeper {
            keeper.follow(&self.viewer.document, drags, Instant::now());
        }
    }

    /// Does what the viewer cannot do by itself.
    pub(crate) fn do_wanted(&mut self) {
        match self.viewer.wanted.take() {
            None => {}
            Some(Wanted::Model(file)) => self.model_dropped(&file),
            Some(Wanted::DesktopDialog) => {
                let Some(browser) = &self.viewer.browser else { return };
                let (proxy, name) = (self.proxy.clone(), browser.typed.clone());
                desktop_dialog::ask(&browser.purpose, &browser.folder, name, move |path| {
                    // The loop may have ended; then no one waits for the file.
                    let _ = proxy.send_event(Wake::Chosen(path));
                });
            }
            Some(Wanted::Copy(text)) => {
                if let Some(screen) = &mut self.screen {
                    screen.input.set_clipboard_text(text);
                }
            }
            Some(Wanted::Paste) => {
                let text = self.screen.as_mut().and_then(|screen| screen.input.clipboard_text());
                making::paste(&mut self.viewer, &text.unwrap_or_default());
            }
        }
    }

    /// Starts to read a picture that is to be a texture, if there is something that it can be put on.
    pub(crate) fn picture_dropped(&mut self, file: &Path) {
        if self.viewer.guard.question().is_some() {
            return self.viewer.notify("answer the question first, then drop the picture again");
        }
        let Some(target) = dropped::picture::target(&mut self.viewer) else { return };
        self.viewer.notify(format!("reading {}", file.display()));
        let proxy = self.proxy.clone();
        dropped::picture::read(file.to_owned(), target, move |outcome| {
            // The loop may have ended; then no one waits for the picture.
            let _ = proxy.send_event(Wake::Picture(outcome));
        });
    }

    /// Starts to read a model that is to stand in the scene.
    pub(crate) fn model_dropped(&mut self, file: &Path) {
        if self.viewer.guard.question().is_some() {
            return self.viewer.notify("answer the question first, then drop the model again");
        }
        self.viewer.notify(format!("reading {}", file.display()));
        let proxy = self.proxy.clone();
        dropped::model::read(file.to_owned(), &self.viewer, move |outcome| {
            // The loop may have ended; then no one waits for the model.
            let _ = proxy.send_event(Wake::Model(outcome));
        });
    }
}
