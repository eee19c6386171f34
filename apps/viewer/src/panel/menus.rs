//! Which commands stand in menus? Lists of them; their words and keys are those of the list of keys.

use std::path::PathBuf;

use egui::{Button, Ui};

use crate::guard::Next;
use crate::keys::{self, Command};
use crate::viewer::Viewer;
use crate::views::Side;
use crate::{actions, recent, recovery};

/// What is done with files.
const FILE: &[Command] = &[
    Command::New,
    Command::Open,
    Command::Save,
    Command::SaveAs,
    Command::Reload,
    Command::Picture,
    Command::PictureAgain,
    Command::Quit,
];

/// What is done with the scene as a whole.
const EDIT: &[Command] =
    &[Command::Undo, Command::Redo, Command::Paste, Command::ShowAll, Command::SelectAll];

/// What is done with what is selected.
const SELECTED: &[Command] = &[
    Command::Rename,
    Command::Duplicate,
    Command::Cut,
    Command::Copy,
    Command::Group,
    Command::Ungroup,
    Command::Hide,
    Command::Lock,
    Command::FrameSelected,
    Command::Delete,
];

/// From where it is seen.
const VIEW: &[Command] = &[
    Command::FrameAll,
    Command::FrameSelected,
    Command::ResetCamera,
    Command::NextCamera,
    Command::Look(Side::Front),
    Command::Look(Side::Right),
    Command::Look(Side::Top),
    Command::Look(Side::Back),
    Command::Look(Side::Left),
    Command::Look(Side::Bottom),
    Command::OtherProjection,
];

/// The bar of menus.
pub(super) fn bar(ui: &mut Ui, viewer: &mut Viewer) {
    ui.horizontal(|ui| {
        ui.menu_button("File", |ui| {
            commands(ui, viewer, FILE);
            ui.separator();
            lately(ui, viewer);
        });
        ui.menu_button("Edit", |ui| {
            commands(ui, viewer, EDIT);
            ui.separator();
            commands(ui, viewer, SELECTED);
        });
        ui.menu_button("Look", |ui| commands(ui, viewer, VIEW));
        if ui.button("Add…").on_hover_text("Add something (Shift+A).").clicked() {
            viewer.adding = Some(crate::making::add::Adding::default());
        }
    });
}

/// The menu of what is selected.
pub(super) fn selected(ui: &mut Ui, viewer: &mut Viewer) {
    commands(ui, viewer, SELECTED);
}

fn commands(ui: &mut Ui, viewer: &mut Viewer, commands: &[Command]) {
    for binding in commands.iter().filter_map(|command| keys::told(*command)) {
        let words = binding.doc.split(';').next().unwrap_or_default();
        if ui.add(Button::new(words).shortcut_text(binding.label)).clicked() {
            actions::run(viewer, binding.command);
            ui.close();
        }
    }
}

/// The files that were opened lately.
fn lately(ui: &mut Ui, viewer: &mut Viewer) {
    let files: Vec<PathBuf> = recovery::state_folder().map(|state| recent::files(&state)).unwrap_or_default();
    ui.weak(if files.is_empty() { "nothing was opened yet" } else { "opened lately" });
    for file in files {
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if ui.button(name).on_hover_text(file.display().to_string()).clicked() {
            viewer.leave(Next::Open(file));
            ui.close();
        }
    }
}
