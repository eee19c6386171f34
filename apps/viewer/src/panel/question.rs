//! How is a person asked before work is lost? A box over all else, with a button for each answer.

use egui::{Frame, Id, Modal, Rect, RichText, Ui};

use super::theme;
use crate::guard::{Answer, Next, Question};
use crate::viewer::Viewer;

/// Width of the box in points, where the window has room.
const WIDTH: f32 = 380.0;

/// What is said and offered.
struct Words {
    title: String,
    text: String,
    /// The words for writing the scene and for giving the edits up.
    buttons: [&'static str; 2],
    /// What Enter answers.
    usual: Answer,
}

/// Asks what there is to ask. All keys and clicks are for the box while it stands there.
pub(super) fn show(ui: &Ui, viewer: &mut Viewer, window: Rect) {
    let Some(question) = viewer.guard.question() else { return };
    let words = words(question, viewer);
    let problem = viewer.guard.problem().map(str::to_owned);
    let frame = Frame::window(ui.style()).inner_margin(14);
    let modal = Modal::new(Id::new("question")).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width((window.width() - 40.0).clamp(60.0, WIDTH));
        ui.label(RichText::new(&words.title).strong().size(15.0));
        ui.add_space(4.0);
        ui.label(&words.text);
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

/// The answer that was given, by a click or by the keys: the usual one has them at first.
fn buttons(ui: &mut Ui, words: &Words) -> Option<Answer> {
    let [write, give_up] = words.buttons;
    let mut given = None;
    ui.horizontal_wrapped(|ui| {
        for (answer, name) in [(Answer::Write, write), (Answer::GiveUp, give_up), (Answer::Cancel, "Cancel")]
        {
            let button = ui.add(egui::Button::new(name).min_size(egui::vec2(72.0, 24.0)));
            if answer == words.usual && ui.memory(|memory| memory.focused().is_none()) {
                button.request_focus();
            }
            if button.clicked() {
                given = Some(answer);
            }
        }
    });
    given
}

fn words(question: &Question, viewer: &Viewer) -> Words {
    let (name, place) = (viewer.document.name(), viewer.document.place());
    match question {
        Question::Unsaved(next) => Words {
            title: match next {
                Next::Close => format!("Save “{name}” before closing?"),
                Next::Open(file) => format!("Save “{name}” before opening {}?", file.display()),
            },
            text: format!("It has edits that are not saved. Saving writes {}.", place.display()),
            buttons: ["Save", "Discard"],
            usual: Answer::Write,
        },
        Question::Changed(_) => Words {
            title: format!("“{name}” was changed elsewhere"),
            text: format!(
                "{} is no longer what was opened or saved here. Overwriting it loses what was changed there; \
                 reloading it loses the edits made here.",
                place.display()
            ),
            buttons: ["Overwrite", "Reload"],
            usual: Answer::Cancel,
        },
    }
}
