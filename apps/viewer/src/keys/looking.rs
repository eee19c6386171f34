//! By which keys does one look elsewhere, or otherwise?

use winit::keyboard::NamedKey;

use super::Command;
use super::binding::{Binding, CTRL, NONE, letter, named};
use crate::seeing::See;
use crate::views::Side;

pub(super) const KEYS: &[Binding] = &[
    named(NamedKey::Home, "Home", Command::FrameAll, "see everything, lights too"),
    letter(NONE, "f", "F", Command::FrameSelected, "see what is selected"),
    letter(NONE, "0", "0", Command::ResetCamera, "back to the scene's camera"),
    letter(NONE, "c", "C", Command::NextCamera, "look through the next camera"),
    letter(NONE, "1", "1", Command::Look(Side::Front), "look from the front (numpad too)"),
    letter(NONE, "3", "3", Command::Look(Side::Right), "look from the right"),
    letter(NONE, "7", "7", Command::Look(Side::Top), "look from above"),
    letter(CTRL, "1", "Ctrl+1", Command::Look(Side::Back), "look from the back"),
    letter(CTRL, "3", "Ctrl+3", Command::Look(Side::Left), "look from the left"),
    letter(CTRL, "7", "Ctrl+7", Command::Look(Side::Bottom), "look from below, through the floor"),
    letter(NONE, "5", "5", Command::OtherProjection, "without perspective, or with it"),
    named(NamedKey::ArrowLeft, "Left", Command::Step(-1, 0), "move the camera left"),
    named(NamedKey::ArrowRight, "Right", Command::Step(1, 0), "move the camera right"),
    named(NamedKey::ArrowUp, "Up", Command::Step(0, 1), "move the camera up"),
    named(NamedKey::ArrowDown, "Down", Command::Step(0, -1), "move the camera down"),
    letter(NONE, "o", "O", Command::ToggleOverlays, "show or hide all overlays"),
    letter(NONE, "]", "]", Command::See(See::Brighter(1)), "show the picture brighter, by a third of a stop"),
    letter(NONE, "[", "[", Command::See(See::Brighter(-1)), "show the picture darker"),
    letter(NONE, "e", "E", Command::See(See::Automatic), "exposure follows the picture, or stays"),
    letter(
        NONE,
        "v",
        "V",
        Command::See(See::NextPass),
        "show the next pass: albedo, normals, irradiance, work",
    ),
    letter(
        NONE,
        "m",
        "M",
        Command::See(See::Mute),
        "mute the selected lights in this window; without any, none",
    ),
    letter(NONE, "l", "L", Command::See(See::Solo), "let the selected lights shine alone; without any, all"),
    letter(NONE, "b", "B (held)", Command::See(See::Before), "see the scene before the last edit"),
];
