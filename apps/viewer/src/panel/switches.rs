//! How is the scene looked at? Mode, backend, display transform, overlays, and the scene's own settings.

use catoptra_core::InvalidPart;
use catoptra_core::scene::{Edit, Integrator, Settings};
use catoptra_tracer::{Display, backends};
use egui::{ComboBox, Ui};

use super::fields::{self, Offers, step_key};
use super::{looking, spoken, widgets};
use crate::input::Mode;
use crate::viewer::Viewer;

/// Shows the switches.
pub(super) fn show(ui: &mut Ui, viewer: &mut Viewer) {
    egui::CollapsingHeader::new("View").default_open(true).show(ui, |ui| {
        mode(ui, viewer);
        egui::Grid::new("view").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
            spoken::label(ui, "show");
            looking::pass(ui, viewer);
            ui.end_row();
            spoken::label(ui, "display");
            display(ui, viewer);
            ui.end_row();
            spoken::label(ui, "exposure");
            looking::exposure(ui, viewer);
            ui.end_row();
            spoken::label(ui, "sees")
                .on_hover_text("From the lower to the upper edge of this view; a camera has its own.");
            looking::extent(ui, viewer);
            ui.end_row();
            spoken::label(ui, "backend");
            backend(ui, viewer);
            ui.end_row();
            spoken::label(ui, "frame time");
            frame_time(ui, viewer);
            ui.end_row();
        });
        looking::lights_alone(ui, viewer);
        looking::tools(ui, viewer);
        looking::clipped(ui, viewer);
        overlays(ui, viewer);
    });
    looking::comparison(ui, viewer);
    egui::CollapsingHeader::new("Scene").default_open(true).show(ui, |ui| settings(ui, viewer));
}

fn mode(ui: &mut Ui, viewer: &mut Viewer) {
    ui.horizontal(|ui| {
        for mode in Mode::ALL {
            ui.selectable_value(&mut viewer.settings.mode, mode, mode.name());
        }
    });
}

fn display(ui: &mut Ui, viewer: &mut Viewer) {
    let before = viewer.settings.display;
    let shown = ComboBox::from_id_salt("display").selected_text(before.name()).show_ui(ui, |ui| {
        for display in Display::ALL {
            ui.selectable_value(&mut viewer.settings.display, *display, display.name());
        }
    });
    spoken::name(ui, &shown.response);
    viewer.stale.overlay |= viewer.settings.display != before;
}

fn backend(ui: &mut Ui, viewer: &mut Viewer) {
    let now = viewer.settings.backend.name();
    let shown = ComboBox::from_id_salt("backend").selected_text(now).show_ui(ui, |ui| {
        for backend in backends() {
            if ui.selectable_label(backend.name() == now, backend.name()).clicked() {
                viewer.settings.backend = *backend;
                viewer.stale.trace |= backend.name() != now;
            }
        }
    });
    spoken::name(ui, &shown.response);
}

/// Milliseconds that a frame may take while something moves.
const FRAME_TIMES: std::ops::RangeInclusive<f64> = 8.0..=100.0;

fn frame_time(ui: &mut Ui, viewer: &mut Viewer) {
    let told = "What a frame may take while something moves: more is sharper, less is smoother.";
    let shown = ui.scope(|ui| widgets::slide(ui, viewer.settings.frame_time, FRAME_TIMES, " ms", 0));
    shown.response.on_hover_text(told);
    if let Some(time) = shown.inner {
        viewer.settings.frame_time = time;
    }
}

fn overlays(ui: &mut Ui, viewer: &mut Viewer) {
    let before = (viewer.settings.style, viewer.shown.overlays);
    ui.checkbox(&mut viewer.shown.overlays, "overlays");
    let style = &mut viewer.settings.style;
    ui.add_enabled_ui(viewer.shown.overlays, |ui| {
        egui::Grid::new("overlays").num_columns(3).spacing([10.0, 2.0]).show(ui, |ui| {
            ui.checkbox(&mut style.grid, "grid");
            ui.checkbox(&mut style.axes, "axes");
            ui.checkbox(&mut style.cones, "all cones").on_hover_text("Cones of lights not selected, too.");
            ui.end_row();
            ui.checkbox(&mut style.lights, "lights");
            ui.checkbox(&mut style.cameras, "cameras");
            ui.checkbox(&mut style.selection, "bounds");
            ui.end_row();
            ui.checkbox(&mut style.beams, "beams").on_hover_text("Cones are filled, not lines alone.");
            ui.end_row();
        });
    });
    viewer.stale.overlay |= (viewer.settings.style, viewer.shown.overlays) != before;
}

/// The settings that are saved with the scene: background, what is shown, and how far it goes.
fn settings(ui: &mut Ui, viewer: &mut Viewer) {
    let now = *viewer.document.scene().settings();
    let (kind, values) = (Settings::KIND, now.values());
    let changed = fields::show(ui, step_key("settings", 0, ""), kind.fields, &values, &Offers::NONE);
    let changed = changed.map(|changed| (changed.field, changed.make(kind, values)));
    let occlusion = now.integrator() == Integrator::Occlusion;
    let limited = occlusion.then(|| limit(ui, &now)).flatten();
    if let Some((field, settings)) = changed.or(limited) {
        match settings {
            Ok(settings) => viewer.edit_on(Edit::Settings(settings), step_key("settings", 0, field)),
            Err(refusal) => viewer.notify(refusal.to_string()),
        }
    }
}

/// Metres up to which surfaces hide the sky when that is first limited.
const LIMIT: f64 = 1.0;

/// Whether occlusion ends somewhere; where, is a field of the settings from then on.
fn limit(ui: &mut Ui, now: &Settings) -> Option<(&'static str, Result<Settings, InvalidPart>)> {
    let mut limited = now.occlusion_distance().is_some();
    let changed = ui.checkbox(&mut limited, "occlusion ends at a distance").changed();
    changed.then(|| ("limit", now.with_occlusion_distance(limited.then_some(LIMIT))))
}
