//! Which keys are for the window as a whole?

use winit::keyboard::NamedKey;

use super::Command;
use super::binding::{Binding, CTRL, CTRL_SHIFT, letter, named};

pub(super) const KEYS: &[Binding] = &[
    named(NamedKey::F1, "F1", Command::Help, "show or hide this list"),
    named(NamedKey::Tab, "Tab", Command::Panel, "show or hide the panel"),
    named(NamedKey::Escape, "Esc", Command::Escape, "select nothing, close or cancel what is open"),
    letter(CTRL, "z", "Ctrl+Z", Command::Undo, "undo"),
    letter(CTRL_SHIFT, "z", "Ctrl+Shift+Z", Command::Redo, "redo"),
    letter(CTRL, "y", "Ctrl+Y", Command::Redo, "redo"),
];
