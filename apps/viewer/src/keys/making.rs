//! Which keys make things, set them aside and take them away?

use winit::keyboard::NamedKey;

use super::Command;
use super::binding::{ALT, Binding, CTRL, CTRL_SHIFT, NONE, SHIFT, letter, named};

pub(super) const KEYS: &[Binding] = &[
    named(NamedKey::Delete, "Delete", Command::Delete, "delete what is selected"),
    letter(SHIFT, "a", "Shift+A", Command::Add, "add something, where the pointer is"),
    letter(CTRL, "d", "Ctrl+D", Command::Duplicate, "duplicate what is selected"),
    letter(SHIFT, "d", "Shift+D", Command::Duplicate, "duplicate what is selected"),
    letter(CTRL, "x", "Ctrl+X", Command::Cut, "cut what is selected, as scene text"),
    letter(CTRL, "c", "Ctrl+C", Command::Copy, "copy what is selected, as scene text"),
    letter(CTRL, "v", "Ctrl+V", Command::Paste, "paste scene text"),
    named(NamedKey::F2, "F2", Command::Rename, "rename the selected thing"),
    letter(CTRL, "g", "Ctrl+G", Command::Group, "group what is selected"),
    letter(CTRL_SHIFT, "g", "Ctrl+Shift+G", Command::Ungroup, "ungroup the selected groups"),
    letter(NONE, "h", "H", Command::Hide, "hide what is selected, or show it again"),
    letter(ALT, "h", "Alt+H", Command::ShowAll, "show all that is hidden"),
    letter(CTRL, "l", "Ctrl+L", Command::Lock, "lock what is selected, or unlock it"),
    letter(CTRL, "a", "Ctrl+A", Command::SelectAll, "select everything"),
];
