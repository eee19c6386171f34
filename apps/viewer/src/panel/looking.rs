//! What of the scene is shown, how bright, and beside what? Passes, exposure, and the comparison with a picture on disk.

use std::path::PathBuf;

use catoptra_core::Extent;
use catoptra_raster::Tool;
use egui::{ComboBox, DragValue, RichText, Slider, TextEdit, Ui};

use super::number::Pace;
use super::{spoken, theme, widgets};
use crate::exposure::{Exposure, MOST};
use crate::pass::PASSES;
use crate::viewer::Viewer;

/// To one decimal.
fn tenths(stops: f64) -> f64 {
    (10.0 * stops).round() / 10.0
}

/// A list of the passes.
pub(super) fn pass(ui: &mut Ui, viewer: &mut Viewer) {
    let now = viewer.settings.pass;
    let shown = ComboBox::from_id_salt("pass").selected_text(now.name).show_ui(ui, |ui| {
        for pass in PASSES {
            if ui.selectable_label(pass.name == now.name, pass.name).on_hover_text(pass.doc).clicked() {
                viewer.show_pass(pass);
            }
        }
    });
    spoken::name(ui, &shown.response);
}

/// Whether the light of the selected lights is shown alone, where lights are told apart.
pub(super) fn lights_alone(ui: &mut Ui, viewer: &mut Viewer) {
    let mut alone = viewer.settings.lights_alone;
    let tip = "False colours of what the selected lights give, without the others.";
    if viewer.tells_lights_apart()
        && ui.checkbox(&mut alone, "selected lights alone").on_hover_text(tip).changed()
    {
        viewer.show_lights_alone(alone);
    }
}

/// Stops, and whether they follow the picture.
pub(super) fn exposure(ui: &mut Ui, viewer: &mut Viewer) {
    let mut new = viewer.settings.exposure;
    ui.horizontal(|ui| {
        // The slider rounds what it is shown: that is no change.
        let mut stops = tenths(new.stops);
        let slider = Slider::new(&mut stops, -MOST..=MOST).fixed_decimals(1).smart_aim(false);
        ui.spacing_mut().slider_width = 64.0;
        let tip =
            "Stops brighter, in this window alone; the scene has its own. A double click goes back to 0.";
        let slider = ui.add(slider.show_value(false)).on_hover_text(tip);
        spoken::name(ui, &slider);
        if slider.double_clicked() {
            stops = 0.0;
        }
        let number = DragValue::new(&mut stops).range(-MOST..=MOST).fixed_decimals(1).speed(0.1);
        let number = ui.add(number.update_while_editing(false));
        spoken::name_part(ui, &number, "as a number");
        if tenths(stops) != tenths(new.stops) {
            new = Exposure { stops: tenths(stops), automatic: false };
        }
        ui.checkbox(&mut new.automatic, "auto").on_hover_text("Exposure follows the picture.");
    });
    viewer.stale.trace |= new.automatic && !viewer.settings.exposure.automatic;
    viewer.expose(new);
}

/// How much is seen from the lower to the upper edge: of the view, wherever it has come from.
pub(super) fn extent(ui: &mut Ui, viewer: &mut Viewer) {
    let (now, unit) = match viewer.camera.extent() {
        Extent::Angle(fov) => (fov.to_degrees(), "°"),
        Extent::Height(height) => (height, "m"),
    };
    let pace = if unit == "m" { Pace::Scene } else { Pace::Angle };
    let Some(new) = widgets::number(ui, now, unit, pace) else { return };
    let extent = if unit == "m" { Extent::Height(new) } else { Extent::Angle(new.to_radians()) };
    match viewer.camera.clone().with_extent(extent) {
        Ok(camera) => viewer.look(camera),
        Err(refusal) => viewer.notify(refusal.to_string()),
    }
}

/// The handles about what is selected, and how they move it.
pub(super) fn tools(ui: &mut Ui, viewer: &mut Viewer) {
    let before = (viewer.settings.tool, viewer.settings.local_axes);
    ui.horizontal(|ui| {
        let tools = [("move", Some(Tool::Move)), ("turn", Some(Tool::Turn)), ("scale", Some(Tool::Scale))];
        for (name, tool) in tools.into_iter().chain([("none", None)]) {
            ui.selectable_value(&mut viewer.settings.tool, tool, name);
        }
    });
    ui.horizontal(|ui| {
        let tip = "Handles go along the axes of the active thing, not of the world.";
        ui.checkbox(&mut viewer.settings.local_axes, "own axes").on_hover_text(tip);
        let tip = "What is moved freely stands on the surface under the pointer.";
        ui.checkbox(&mut viewer.settings.on_surfaces, "on surfaces").on_hover_text(tip);
    });
    viewer.stale.overlay |= (viewer.settings.tool, viewer.settings.local_axes) != before;
}

/// A switch that marks what is brighter than white.
pub(super) fn clipped(ui: &mut Ui, viewer: &mut Viewer) {
    let mut on = viewer.settings.marks_clipped;
    ui.horizontal(|ui| {
        ui.checkbox(&mut on, "mark clipped");
        if let Some(share) = viewer.readout.clipped {
            ui.weak(format!("{:.1} %", 100.0 * share));
        }
    });
    if on != viewer.settings.marks_clipped {
        viewer.settings.marks_clipped = on;
        viewer.stale.overlay = true;
    }
}

/// A picture on disk beside the one in the window.
pub(super) fn comparison(ui: &mut Ui, viewer: &mut Viewer) {
    egui::CollapsingHeader::new("Compare").default_open(false).show(ui, |ui| {
        ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut viewer.comparison.typed).desired_width(150.0);
            let field = ui.add(field.hint_text("picture.png"));
            spoken::next(ui, "picture to compare with");
            spoken::name(ui, &field);
            let entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
            let asked = ui.button("Compare").on_hover_text("With the picture in this file.").clicked();
            if (asked || entered) && !viewer.comparison.typed.trim().is_empty() {
                viewer.comparison.want(PathBuf::from(viewer.comparison.typed.trim()));
            }
        });
        let Some(file) = viewer.comparison.file().map(|file| file.display().to_string()) else { return };
        ui.horizontal(|ui| {
            let before = viewer.comparison.line;
            let line = ui
                .add(Slider::new(&mut viewer.comparison.line, 0.0..=1.0).show_value(false))
                .on_hover_text(format!("Left of the line is this picture, right of it {file}."));
            spoken::next(ui, "line between the pictures");
            spoken::name(ui, &line);
            viewer.stale.overlay |= viewer.comparison.line != before;
            if ui.button("End").clicked() {
                viewer.comparison.end();
                viewer.stale.overlay = true;
            }
        });
        ui.add(egui::Label::new(difference(viewer)).wrap());
    });
}

fn difference(viewer: &Viewer) -> RichText {
    match (viewer.comparison.difference, viewer.comparison.size()) {
        (Some(found), _) => RichText::new(format!(
            "error {:.5} (RMS of displayed values), {:.2} % of pixels differ",
            found.error,
            100.0 * found.pixels
        ))
        .color(theme::ACCENT),
        (None, Some((width, height))) if (width, height) != viewer.size => RichText::new(format!(
            "{width}x{height} is stretched to {}x{}: no error",
            viewer.size.0, viewer.size.1
        ))
        .weak(),
        (None, _) => RichText::new("measured when the picture is traced in full").weak(),
    }
}
