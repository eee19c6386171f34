//! Which key does what? One list: the window looks commands up in it, and the help page prints it.

use catoptra_raster::Tool;
use winit::keyboard::{Key, NamedKey};

use crate::input::Held;
use crate::seeing::See;
use crate::views::Side;

/// What a key asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Command {
    /// Show or hide the list of keys.
    Help,
    /// Show or hide the panel.
    Panel,
    /// Move the camera so that everything is seen.
    FrameAll,
    /// Move the camera so that the selected thing is seen.
    FrameSelected,
    /// Go back to the scene's camera.
    ResetCamera,
    /// Look through the scene's next camera.
    NextCamera,
    /// Look at the same target from a side.
    Look(Side),
    /// Look with parallel rays, or with perspective again.
    OtherProjection,
    /// Move the camera in its own plane: steps to the right and up.
    Step(i8, i8),
    /// Change between orbiting the camera and turning the objects.
    ToggleMode,
    /// Show or hide all overlays.
    ToggleOverlays,
    /// Select nothing, close what is open.
    Escape,
    /// Take what is selected out of the scene.
    Delete,
    /// Choose something to be added.
    Add,
    /// Make one more of what is selected.
    Duplicate,
    /// Take what is selected to the clipboard.
    Cut,
    /// Put what is selected on the clipboard.
    Copy,
    /// Put into the scene what is on the clipboard.
    Paste,
    /// Give the selected thing another name.
    Rename,
    /// Make a group of what is selected.
    Group,
    /// Take the members out of the selected groups.
    Ungroup,
    /// Hide what is selected, or show it again.
    Hide,
    /// Show all that is hidden.
    ShowAll,
    /// Lock what is selected, or unlock it.
    Lock,
    /// Select all that stands at the top of the scene.
    SelectAll,
    /// Take the last edit back.
    Undo,
    /// Make the last edit that was taken back again.
    Redo,
    /// Write the scene.
    Save,
    /// Write the scene to another file.
    SaveAs,
    /// Begin a new scene.
    New,
    /// Open a file.
    Open,
    /// Read the open file again.
    Reload,
    /// Write the picture.
    Picture,
    /// Look at the scene otherwise.
    See(See),
    /// Move, turn or scale what is selected with the pointer.
    Transform(Tool),
    /// Show the next handles about what is selected.
    NextTool,
    /// Put things onto surfaces as they are moved, or no more.
    OnSurfaces,
    /// Look through the selected light or camera, which then goes along, or end that.
    Fly,
    /// Close the window.
    Quit,
}

impl Command {
    /// Whether it is meant even while something is being typed.
    pub(crate) fn is_everywhere(self) -> bool {
        matches!(
            self,
            Self::Save | Self::SaveAs | Self::New | Self::Open | Self::Reload | Self::Quit | Self::Help
        )
    }
}

/// How a key is named: by what it types or by its cap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cap {
    Letter(&'static str),
    Named(NamedKey),
}

/// One line of the list.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Binding {
    cap: Cap,
    held: Held,
    /// How the key is written in the help.
    pub(crate) label: &'static str,
    /// What it does, in a few words.
    pub(crate) doc: &'static str,
    /// What it asks for.
    pub(crate) command: Command,
}

const NONE: Held = Held { ctrl: false, shift: false, alt: false };
const CTRL: Held = Held { ctrl: true, ..NONE };
const SHIFT: Held = Held { shift: true, ..NONE };
const ALT: Held = Held { alt: true, ..NONE };
const CTRL_SHIFT: Held = Held { ctrl: true, shift: true, ..NONE };

const fn named(key: NamedKey, label: &'static str, command: Command, doc: &'static str) -> Binding {
    Binding { cap: Cap::Named(key), held: NONE, label, doc, command }
}

const fn letter(
    held: Held,
    key: &'static str,
    label: &'static str,
    command: Command,
    doc: &'static str,
) -> Binding {
    Binding { cap: Cap::Letter(key), held, label, doc, command }
}

/// Every key there is.
pub(crate) const BINDINGS: &[Binding] = &[
    named(NamedKey::F1, "F1", Command::Help, "show or hide this list"),
    named(NamedKey::Tab, "Tab", Command::Panel, "show or hide the panel"),
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
    letter(NONE, "t", "T", Command::ToggleMode, "orbit the camera, or turn the objects (an edit)"),
    letter(NONE, "o", "O", Command::ToggleOverlays, "show or hide all overlays"),
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
    letter(NONE, "p", "P", Command::Picture, "write the picture as PNG"),
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
    named(NamedKey::Escape, "Esc", Command::Escape, "select nothing, close or cancel what is open"),
    letter(CTRL, "n", "Ctrl+N", Command::New, "begin a new scene; asks about unsaved edits"),
    letter(CTRL, "o", "Ctrl+O", Command::Open, "open a file; asks about unsaved edits"),
    letter(CTRL, "s", "Ctrl+S", Command::Save, "save; asks if the file was changed elsewhere"),
    letter(CTRL_SHIFT, "s", "Ctrl+Shift+S", Command::SaveAs, "save to another file"),
    named(NamedKey::F5, "F5", Command::Reload, "read the file again; asks about unsaved edits"),
    letter(CTRL, "z", "Ctrl+Z", Command::Undo, "undo"),
    letter(CTRL_SHIFT, "z", "Ctrl+Shift+Z", Command::Redo, "redo"),
    letter(CTRL, "y", "Ctrl+Y", Command::Redo, "redo"),
    letter(CTRL, "q", "Ctrl+Q", Command::Quit, "close the window; asks about unsaved edits"),
];

/// What the mouse does, and keys that go through buttons, for the help: what is done, and what follows.
pub(crate) const OTHERS: &[(&str, &str)] = &[
    ("Click", "select what is under the pointer"),
    ("Shift or Ctrl click", "select one more, or one less; Shift in the tree: all up to there"),
    ("Left drag", "orbit the camera; turntable: turn the objects"),
    ("Middle drag", "orbit the camera; with Shift pan, with Ctrl zoom"),
    ("Right or Shift drag", "pan"),
    ("W A S D, Q E, right button held", "move the camera ahead, aside, back; down and up"),
    ("Left drag on a handle", "move, turn or scale what is selected; numbers, Ctrl and Esc as with G"),
    ("X Y Z while moving", "along that axis, again: its own; with Shift in a plane"),
    ("Left drag on a mark", "move a light or a camera"),
    ("Left drag on an aim", "aim the selected light at what is under the pointer"),
    ("Left drag on a ring", "change a spot light's cone angle"),
    ("Left drag on a rim", "change the size of the selected lamp: sides, corners too"),
    ("Wheel", "zoom to the pointer; turntable: along the view"),
    ("Ctrl wheel", "the other of the two"),
    ("Drop a scene", "open it; asks about unsaved edits"),
    ("Drop a picture", "make it the texture of the selected shape"),
    ("Right click in the tree", "what can be done with what is selected"),
    ("Ctrl and +, -, 0", "panel and text larger, smaller, as usual"),
    ("Tab, Enter", "go through a question's buttons, press one"),
];

/// What that key asks for while others are held. Letters are compared without case. Where nothing is bound to Shift and a
/// plain key, Shift makes no difference.
pub(crate) fn command(key: &Key, held: Held) -> Option<Command> {
    let is_it = |binding: &&Binding, held: Held| {
        let same = match (binding.cap, key) {
            (Cap::Named(a), Key::Named(b)) => a == *b,
            (Cap::Letter(a), Key::Character(b)) => b.to_lowercase() == a,
            _ => false,
        };
        same && binding.held == held
    };
    let find = |held: Held| BINDINGS.iter().find(|binding| is_it(binding, held)).map(|b| b.command);
    find(held).or_else(|| find(Held { shift: false, ..held }).filter(|_| !held.ctrl && !held.alt))
}

/// The keys for a command, and what it does, as the list tells.
pub(crate) fn told(command: Command) -> Option<&'static Binding> {
    BINDINGS.iter().find(|binding| binding.command == command)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn typed(text: &str) -> Key {
        Key::Character(text.into())
    }

    #[test]
    fn undo_and_redo_differ_by_shift() {
        assert_eq!(command(&typed("z"), CTRL), Some(Command::Undo));
        assert_eq!(command(&typed("Z"), CTRL_SHIFT), Some(Command::Redo));
    }

    #[test]
    fn a_plain_letter_is_not_its_ctrl_command() {
        assert_eq!(command(&typed("s"), NONE), Some(Command::Transform(Tool::Scale)));
        assert_eq!(command(&typed("s"), CTRL), Some(Command::Save));
        assert_eq!(command(&typed("p"), NONE), Some(Command::Picture));
        assert_eq!(command(&typed("p"), CTRL), None);
    }

    #[test]
    fn no_two_lines_ask_for_the_same_key() {
        for (i, a) in BINDINGS.iter().enumerate() {
            for b in &BINDINGS[i + 1..] {
                assert!(a.cap != b.cap || a.held != b.held, "{} is bound twice", a.label);
            }
        }
    }

    #[test]
    fn every_line_is_found_by_its_own_key() {
        for binding in BINDINGS {
            let key = match binding.cap {
                Cap::Letter(text) => typed(text),
                Cap::Named(name) => Key::Named(name),
            };
            assert_eq!(command(&key, binding.held), Some(binding.command), "{}", binding.label);
        }
    }
}
