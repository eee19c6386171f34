//! Which keys are for files?

use winit::keyboard::NamedKey;

use super::Command;
use super::binding::{Binding, CTRL, CTRL_SHIFT, NONE, SHIFT, letter, named};

pub(super) const KEYS: &[Binding] = &[
    letter(NONE, "p", "P", Command::Picture, "write a picture; asks for its size, samples and place"),
    letter(SHIFT, "p", "Shift+P", Command::PictureAgain, "write one more picture like the last"),
    letter(CTRL, "n", "Ctrl+N", Command::New, "begin a new scene; asks about unsaved edits"),
    letter(CTRL, "o", "Ctrl+O", Command::Open, "open a file; asks about unsaved edits"),
    letter(CTRL, "s", "Ctrl+S", Command::Save, "save; asks if the file was changed elsewhere"),
    letter(CTRL_SHIFT, "s", "Ctrl+Shift+S", Command::SaveAs, "save to another file"),
    named(NamedKey::F5, "F5", Command::Reload, "read the file again; asks about unsaved edits"),
    letter(CTRL, "q", "Ctrl+Q", Command::Quit, "close the window; asks about unsaved edits"),
];
