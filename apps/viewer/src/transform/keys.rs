//! Which keys mean something while things are being moved? Axes, numbers, and the end.

use catoptra_core::glam::DVec3;
use catoptra_raster::{Axis, Constraint};
use winit::keyboard::{Key, NamedKey};

use super::{apply, keep, pivot, take_back};
use crate::viewer::Viewer;

/// Characters of a number that is typed, or worked out.
const NUMBER: &str = "0123456789.+-*/()e";

/// The most that can be typed.
const LONGEST: usize = 40;

/// Takes in a key that goes down. All are for what is being moved, if something is: `false` if nothing is.
pub(crate) fn key(viewer: &mut Viewer, key: &Key, shift: bool) -> bool {
    let axes: [[DVec3; 3]; 2] = pivot::axes(viewer);
    let Some(transform) = &mut viewer.transform else { return false };
    match key {
        Key::Named(NamedKey::Escape) => {
            take_back(viewer);
            // The button may still be down; what it drags is over.
            viewer.pointer.cancel();
            return true;
        }
        Key::Named(NamedKey::Enter) => {
            keep(viewer);
            viewer.pointer.cancel();
            return true;
        }
        Key::Named(NamedKey::Backspace) => {
            transform.typed.pop();
        }
        Key::Character(text) => {
            let typed = text.to_lowercase();
            let axis = Axis::ALL.into_iter().find(|axis| typed.chars().eq([axis.letter()]));
            if let Some(axis) = axis {
                let constraint = if shift { Constraint::Across(axis) } else { Constraint::Along(axis) };
                transform.constrain(axes, constraint);
            } else if typed.chars().all(|c| NUMBER.contains(c)) && transform.typed.len() < LONGEST {
                transform.typed.push_str(&typed);
            }
        }
        _ => return true,
    }
    apply(viewer);
    true
}
