//! Which keys move things?

use catoptra_raster::Tool;

use super::Command;
use super::binding::{Binding, NONE, letter};

pub(super) const KEYS: &[Binding] = &[
    letter(NONE, "t", "T", Command::ToggleMode, "orbit the camera, or turn the objects (an edit)"),
    letter(
        NONE,
        "g",
        "G",
        Command::Transform(Tool::Move),
        "move what is selected; then X Y Z, numbers, Ctrl, Esc",
    ),
    letter(NONE, "r", "R", Command::Transform(Tool::Turn), "turn what is selected, as with G"),
    letter(NONE, "s", "S", Command::Transform(Tool::Scale), "scale what is selected, as with G"),
    letter(NONE, "q", "Q", Command::NextTool, "handles that move, turn or scale, or none"),
    letter(NONE, "n", "N", Command::OnSurfaces, "things that are moved stand on surfaces, or go freely"),
    letter(NONE, "i", "I", Command::Fly, "look through the selected light or camera and fly it"),
];
