//! Which key does what? One list, by topics: the window looks commands up in it, and the help page prints it.

mod binding;
mod command;
mod files;
mod looking;
mod making;
mod mouse;
mod moving;
mod window;

use winit::keyboard::Key;

use crate::input::Held;

use binding::{Binding, Cap};
pub(crate) use command::Command;
pub(crate) use mouse::OTHERS;

/// Every key there is, in the order of the help.
const TOPICS: [&[Binding]; 5] = [window::KEYS, looking::KEYS, moving::KEYS, making::KEYS, files::KEYS];

/// All lines of the list.
pub(crate) fn bindings() -> impl Iterator<Item = &'static Binding> {
    TOPICS.into_iter().flatten()
}

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
    let find = |held: Held| bindings().find(|binding| is_it(binding, held)).map(|b| b.command);
    find(held).or_else(|| find(Held { shift: false, ..held }).filter(|_| !held.ctrl && !held.alt))
}

/// The keys for a command, and what it does, as the list tells.
pub(crate) fn told(command: Command) -> Option<&'static Binding> {
    bindings().find(|binding| binding.command == command)
}

#[cfg(test)]
mod tests {
    use catoptra_raster::Tool;

    use super::binding::{CTRL, CTRL_SHIFT, NONE};
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
        for (i, a) in bindings().enumerate() {
            for b in bindings().skip(i + 1) {
                assert!(a.cap != b.cap || a.held != b.held, "{} is bound twice", a.label);
            }
        }
    }

    #[test]
    fn every_line_is_found_by_its_own_key() {
        for binding in bindings() {
            let key = match binding.cap {
                Cap::Letter(text) => typed(text),
                Cap::Named(name) => Key::Named(name),
            };
            assert_eq!(command(&key, binding.held), Some(binding.command), "{}", binding.label);
        }
    }
}
