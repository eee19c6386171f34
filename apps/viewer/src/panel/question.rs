//! How is a person asked before work is lost? A box over all else, with a button for each answer.

use egui::{Button, Frame, Id, Modal, Rect, RichText, ScrollArea, Ui};

use super::theme;
use crate::difference::{Line, Side};
use crate::guard::{Answer, Next, Question};
use crate::recovery::Kept;
use crate::viewer::Viewer;

/// Width of the box in points, where the window has room.
const WIDTH: f32 = 400.0;

/// The most points of height that what differs may take.
const DIFFERENCE: f32 = 150.0;

/// What is said and offered.
struct Words {
    title: String,
    text: String,
    /// Answers with their words.
    buttons: Vec<(Answer, &'static str)>,
    /// What Enter answers.
    usual: Answer,
}

/// Asks what there is to ask. All keys and clicks are for the box while it stands there.
pub(super) fn show(ui: &Ui, viewer: &mut Viewer, window: Rect) {
    let Some(question) = viewer.guard.question() else { return };
    let words = words(question, viewer);
    let is_changed = matches!(question, Question::Changed(_));
    let problem = viewer.guard.problem().map(str::to_owned);
    let frame = Frame::window(ui.style()).inner_margin(14);
    let modal = Modal::new(Id::new("question")).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width((window.width() - 40.0).clamp(60.0, WIDTH));
        ui.label(RichText::new(&words.title).strong().size(15.0));
        ui.add_space(4.0);
        ui.label(&words.text);
        if is_changed {
            difference(ui, viewer.guard.difference(), (window.height() - 220.0).clamp(30.0, DIFFERENCE));
        }
        if let Some(problem) = problem {
            ui.add_space(4.0);
            ui.label(RichText::new(problem).color(theme::ACCENT));
        }
        ui.add_space(8.0);
        buttons(ui, &words)
    });
    if let Some(answer) = modal.inner {
        ui.memory_mut(|memory| memory.focused().inspect(|id| memory.surrender_focus(*id)));
        viewer.answer(answer);
    }
}

/// What differs between the file and the scene.
fn difference(ui: &mut Ui, lines: &[Line], height: f32) {
    ui.add_space(4.0);
    ui.weak("− in the file alone, + here alone:");
    ScrollArea::both().id_salt("difference").max_height(height).auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        for line in lines {
            let (sign, color) = match line.side {
                Side::Both => (' ', ui.visuals().weak_text_color()),
                Side::Old => ('−', theme::FAILURE),
                Side::New => ('+', theme::FINE),
            };
            let text = RichText::new(format!("{sign} {}", line.text)).monospace().size(11.0).color(color);
            ui.add(egui::Label::new(text).extend());
        }
    });
}

/// The answer that was given, by a click or by the keys: the usual one has them at first.
fn buttons(ui: &mut Ui, words: &Words) -> Option<Answer> {
    let mut given = None;
    ui.horizontal_wrapped(|ui| {
        for (answer, name) in &words.buttons {
            let button = ui.add(Button::new(*name).min_size(egui::vec2(72.0, 24.0)));
            if *answer == words.usual && ui.memory(|memory| memory.focused().is_none()) {
                button.request_focus();
            }
            if button.clicked() {
                given = Some(*answer);
            }
        }
    });
    given
}

fn words(question: &Question, viewer: &Viewer) -> Words {
    let name = viewer.document.name();
    let place = viewer.document.place();
    match question {
        Question::Unsaved(next) => Words {
            title: match next {
                Next::Close => format!("Save “{name}” before closing?"),
                next => format!("Save “{name}” before opening {}?", next.name()),
            },
            text: match viewer.document.has_place() {
                true => format!("It has edits that are not saved. Saving writes {}.", place.display()),
                false => "It has edits that are not saved, and no file yet. Saving asks for one.".to_owned(),
            },
            buttons: vec![(Answer::Write, "Save"), (Answer::GiveUp, "Discard"), (Answer::Cancel, "Cancel")],
            usual: Answer::Write,
        },
        Question::Changed(_) => Words {
            title: format!("“{name}” was changed elsewhere"),
            text: format!(
                "{} is no longer what was opened or saved here. Overwriting it loses what was changed there; \
                 reloading it loses the edits made here.",
                place.display()
            ),
            buttons: vec![
                (Answer::Write, "Overwrite"),
                (Answer::GiveUp, "Reload"),
                (Answer::Elsewhere, "Save as…"),
                (Answer::Cancel, "Cancel"),
            ],
            usual: Answer::Cancel,
        },
        Question::Recovered(kept) => recovered(kept),
        Question::Picture(path) => Words {
            title: "Close though a picture is being made?".to_owned(),
            text: format!("{} is not written if the window closes now.", path.display()),
            buttons: vec![(Answer::GiveUp, "Give it up"), (Answer::Cancel, "Keep the window open")],
            usual: Answer::Cancel,
        },
    }
}

fn recovered(kept: &Kept) -> Words {
    let later = if kept.is_older_than_its_file() {
        " The file was written since then: look at it before you save over it."
    } else {
        ""
    };
    Words {
        title: "Bring back edits that were not saved?".to_owned(),
        text: format!(
            "The viewer was ended with unsaved edits of {}.{later} Cancel keeps them for the next start.",
            kept.name()
        ),
        buttons: vec![(Answer::Write, "Bring back"), (Answer::GiveUp, "Discard"), (Answer::Cancel, "Cancel")],
        usual: Answer::Write,
    }
}
