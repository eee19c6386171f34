//! What must one know of what is shown, since it is not the scene as the file has it, or since dragging changes that? Signs at
//! the upper edge of the picture.

use egui::{Align2, Area, Color32, Frame, Id, Margin, Order, Rect, RichText, Ui};

use super::theme;
use crate::input::Mode;
use crate::viewer::Viewer;

/// Shows all signs there are, one below the other.
pub(super) fn show(ui: &Ui, viewer: &Viewer, room: Rect) {
    let signs = signs(viewer);
    if signs.is_empty() {
        return;
    }
    Area::new(Id::new("signs"))
        .order(Order::Middle)
        .interactable(false)
        .pivot(Align2::CENTER_TOP)
        .fixed_pos(room.center_top() + egui::vec2(0.0, 8.0))
        .constrain_to(room)
        .show(ui.ctx(), |ui| {
            ui.set_max_width((room.width() - 40.0).max(40.0));
            for (text, weight) in signs {
                sign(ui, &text, weight);
            }
        });
}

/// How loud a sign is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Weight {
    /// The scene is about to be changed.
    Loud,
    /// What is seen is not what the file says.
    Quiet,
}

fn sign(ui: &mut Ui, text: &str, weight: Weight) {
    let (fill, ink): (Color32, Color32) = match weight {
        Weight::Loud => (theme::ACCENT, theme::FLOATING),
        Weight::Quiet => (theme::FLOATING, theme::ACCENT),
    };
    let frame = Frame::new().fill(fill).corner_radius(4).inner_margin(Margin::symmetric(10, 4));
    frame.show(ui, |ui| ui.add(egui::Label::new(RichText::new(text).strong().color(ink)).wrap()));
}

fn signs(viewer: &Viewer) -> Vec<(String, Weight)> {
    let turntable = (viewer.settings.mode == Mode::Turntable).then(|| {
        let text = "Turntable: dragging turns the objects and changes the scene. T goes back.";
        (text.to_owned(), Weight::Loud)
    });
    let on_surfaces = viewer.settings.on_surfaces;
    let transform = viewer.transform.as_ref().map(|transform| (transform.words(on_surfaces), Weight::Loud));
    let flown = viewer.flown.as_ref().and_then(|flown| viewer.document.scene().name(flown.id)).map(|name| {
        (format!("Looking through {name}: moving the view moves it. I or Esc ends that."), Weight::Loud)
    });
    let before = viewer.shows_before().then(|| "Before the last edit, while B is held.".to_owned());
    let headlight = viewer
        .headlight
        .then(|| "No lights in this scene: lit from the camera. Add one to light it yourself.".to_owned());
    let lights = viewer.lighting.words(viewer.document.scene());
    let quiet = [before, headlight, lights].into_iter().flatten().map(|text| (text, Weight::Quiet));
    [turntable, transform, flown].into_iter().flatten().chain(quiet).collect()
}
