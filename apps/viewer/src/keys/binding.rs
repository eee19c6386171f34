//! How does one line of the list of keys say which key it is, what it does and what it asks for?

use winit::keyboard::NamedKey;

use super::Command;
use crate::input::Held;

/// How a key is named: by what it types or by its cap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cap {
    Letter(&'static str),
    Named(NamedKey),
}

/// One line of the list.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Binding {
    pub(super) cap: Cap,
    pub(super) held: Held,
    /// How the key is written in the help.
    pub(crate) label: &'static str,
    /// What it does, in a few words.
    pub(crate) doc: &'static str,
    /// What it asks for.
    pub(crate) command: Command,
}

pub(super) const NONE: Held = Held { ctrl: false, shift: false, alt: false };
pub(super) const CTRL: Held = Held { ctrl: true, ..NONE };
pub(super) const SHIFT: Held = Held { shift: true, ..NONE };
pub(super) const ALT: Held = Held { alt: true, ..NONE };
pub(super) const CTRL_SHIFT: Held = Held { ctrl: true, shift: true, ..NONE };

pub(super) const fn named(
    key: NamedKey,
    label: &'static str,
    command: Command,
    doc: &'static str,
) -> Binding {
    Binding { cap: Cap::Named(key), held: NONE, label, doc, command }
}

pub(super) const fn letter(
    held: Held,
    key: &'static str,
    label: &'static str,
    command: Command,
    doc: &'static str,
) -> Binding {
    Binding { cap: Cap::Letter(key), held, label, doc, command }
}
