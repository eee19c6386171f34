//! What does the pointer mean over the picture? A press that stays put is a click, one that travels is a drag whose
//! sort was settled when it began. Pure state, no window.

use catoptra_core::scene::EntityId;
use catoptra_raster::{Constraint, Grip};

use crate::selection::Picking;

/// What a plain left-drag does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Mode {
    /// The camera goes round what it looks at.
    #[default]
    Orbit,
    /// The objects turn about the origin, the camera stays.
    Turntable,
}

impl Mode {
    /// Both, in the order they are offered.
    pub(crate) const ALL: [Self; 2] = [Self::Orbit, Self::Turntable];

    /// Its name in the panel.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Orbit => "Orbit",
            Self::Turntable => "Turntable",
        }
    }

    /// The other one.
    pub(crate) fn other(self) -> Self {
        match self {
            Self::Orbit => Self::Turntable,
            Self::Turntable => Self::Orbit,
        }
    }
}

/// A mouse button that means something over the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Button {
    /// The main one.
    Left,
    /// The one under the wheel: it moves the camera, whatever the main one does.
    Middle,
    /// The right one: it pans.
    Right,
}

/// Which keys are held while a button or another key goes down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Held {
    /// Either of the Shift keys.
    pub(crate) shift: bool,
    /// Either of the Ctrl keys.
    pub(crate) ctrl: bool,
    /// Alt.
    pub(crate) alt: bool,
}

/// What stands under the pointer that can be dragged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Hold {
    /// A handle of a light.
    Grip(Grip),
    /// A handle that moves, turns or scales what is selected.
    Handle(Constraint),
    /// The mark of a light or a camera.
    Mark(EntityId),
}

/// What a drag changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Drag {
    /// The camera's place round its target.
    Orbit,
    /// The camera's place in its own plane.
    Pan,
    /// The camera's distance from its target.
    Zoom,
    /// How the objects are turned.
    Turn,
    /// What is held: a light's size, cone or aim, or where things are.
    Hold(Hold),
}

/// What came of a pointer event. Positions and differences are in pixels of the picture, y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Gesture {
    /// Nothing.
    None,
    /// Pressed and let go in one place.
    Click { at: (f64, f64), picking: Picking },
    /// Travelled while pressed.
    Dragged { drag: Drag, by: (f64, f64), to: (f64, f64) },
    /// Let go after travelling.
    Ended(Drag),
}

/// How far a press may stray, in pixels, and still be a click.
const CLICK_REACH: f64 = 3.0;

#[derive(Debug, Clone, Copy)]
struct Press {
    button: Button,
    from: (f64, f64),
    drag: Drag,
    picking: Picking,
    travelled: bool,
}

/// The pointer over the picture.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pointer {
    /// Where it was last seen, in pixels of the picture.
    pub(crate) at: (f64, f64),
    /// Which keys are held.
    pub(crate) held: Held,
    press: Option<Press>,
}

impl Pointer {
    /// Whether a press over the picture is under way: the picture then keeps the pointer wherever it goes.
    pub(crate) fn is_pressed(&self) -> bool {
        self.press.is_some()
    }

    /// Whether that button was pressed over the picture and is still down.
    pub(crate) fn holds(&self, button: Button) -> bool {
        self.press.is_some_and(|press| press.button == button)
    }

    /// A button goes down here. A second button while one is down changes nothing.
    pub(crate) fn press(&mut self, button: Button, held: Held, mode: Mode, hold: Option<Hold>) {
        if self.press.is_some() {
            return;
        }
        let drag = match (button, held.shift, hold, mode) {
            (Button::Right, ..) | (_, true, ..) => Drag::Pan,
            (Button::Middle, ..) if held.ctrl => Drag::Zoom,
            (Button::Left, false, Some(hold), _) => Drag::Hold(hold),
            (Button::Middle, ..) | (Button::Left, false, None, Mode::Orbit) => Drag::Orbit,
            (Button::Left, false, None, Mode::Turntable) => Drag::Turn,
        };
        let picking = if held.shift || held.ctrl { Picking::Toggle } else { Picking::Only };
        self.press = Some(Press { button, from: self.at, drag, picking, travelled: false });
    }

    /// The pointer comes here.
    pub(crate) fn moved(&mut self, to: (f64, f64)) -> Gesture {
        let before = self.at;
        self.at = to;
        let Some(press) = &mut self.press else { return Gesture::None };
        let by = if press.travelled {
            (to.0 - before.0, to.1 - before.1)
        } else {
            let stray = (to.0 - press.from.0, to.1 - press.from.1);
            if stray.0.abs().max(stray.1.abs()) <= CLICK_REACH {
                return Gesture::None;
            }
            press.travelled = true;
            stray
        };
        Gesture::Dragged { drag: press.drag, by, to }
    }

    /// A button goes up.
    pub(crate) fn release(&mut self, button: Button) -> Gesture {
        match self.press {
            Some(press) if press.button == button => {
                self.press = None;
                match press {
                    Press { travelled: true, drag, .. } => Gesture::Ended(drag),
                    Press { button: Button::Left, from: at, picking, .. } => Gesture::Click { at, picking },
                    Press { .. } => Gesture::None,
                }
            }
            _ => Gesture::None,
        }
    }

    /// Forgets a press, as when the window loses the pointer.
    pub(crate) fn cancel(&mut self) -> Gesture {
        match self.press.take() {
            Some(Press { travelled: true, drag, .. }) => Gesture::Ended(drag),
            _ => Gesture::None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHIFT: Held = Held { shift: true, ctrl: false, alt: false };
    const CTRL: Held = Held { shift: false, ctrl: true, alt: false };
    const NONE: Held = Held { shift: false, ctrl: false, alt: false };

    fn pressed(button: Button, held: Held, mode: Mode) -> Pointer {
        let mut pointer = Pointer { at: (10.0, 10.0), ..Pointer::default() };
        pointer.press(button, held, mode, None);
        pointer
    }

    #[test]
    fn a_press_that_stays_put_is_a_click() {
        let mut pointer = pressed(Button::Left, NONE, Mode::Orbit);
        assert_eq!(pointer.moved((12.0, 9.0)), Gesture::None);
        let only = Gesture::Click { at: (10.0, 10.0), picking: Picking::Only };
        assert_eq!(pointer.release(Button::Left), only);
    }

    #[test]
    fn a_click_with_shift_or_ctrl_adds_to_what_is_selected() {
        for held in [SHIFT, CTRL] {
            let toggle = Gesture::Click { at: (10.0, 10.0), picking: Picking::Toggle };
            assert_eq!(pressed(Button::Left, held, Mode::Orbit).release(Button::Left), toggle);
        }
    }

    #[test]
    fn a_drag_carries_every_pixel_once() {
        let mut pointer = pressed(Button::Left, NONE, Mode::Turntable);
        let mut total = 0.0;
        for x in [11.0, 12.0, 15.0, 19.0, 18.0] {
            if let Gesture::Dragged { drag, by, .. } = pointer.moved((x, 10.0)) {
                assert_eq!(drag, Drag::Turn);
                total += by.0;
            }
        }
        assert_eq!(total, 8.0);
        assert_eq!(pointer.release(Button::Left), Gesture::Ended(Drag::Turn));
    }

    #[test]
    fn shift_and_the_right_button_pan() {
        for mut pointer in
            [pressed(Button::Left, SHIFT, Mode::Orbit), pressed(Button::Right, NONE, Mode::Turntable)]
        {
            assert!(matches!(pointer.moved((50.0, 10.0)), Gesture::Dragged { drag: Drag::Pan, .. }));
        }
    }

    #[test]
    fn the_middle_button_orbits_pans_with_shift_and_zooms_with_ctrl() {
        for (held, drag) in [(NONE, Drag::Orbit), (SHIFT, Drag::Pan), (CTRL, Drag::Zoom)] {
            let moved = pressed(Button::Middle, held, Mode::Turntable).moved((50.0, 10.0));
            assert!(matches!(moved, Gesture::Dragged { drag: found, .. } if found == drag), "{moved:?}");
        }
        assert_eq!(pressed(Button::Middle, NONE, Mode::Orbit).release(Button::Middle), Gesture::None);
    }

    #[test]
    fn a_right_click_selects_nothing() {
        assert_eq!(pressed(Button::Right, NONE, Mode::Orbit).release(Button::Right), Gesture::None);
    }

    #[test]
    fn letting_go_of_another_button_ends_nothing() {
        let mut pointer = pressed(Button::Left, NONE, Mode::Orbit);
        assert_eq!(pointer.release(Button::Right), Gesture::None);
        assert!(pointer.is_pressed());
    }

    #[test]
    fn losing_the_pointer_ends_a_drag() {
        let mut pointer = pressed(Button::Left, NONE, Mode::Orbit);
        pointer.moved((40.0, 40.0));
        assert_eq!(pointer.cancel(), Gesture::Ended(Drag::Orbit));
        assert!(!pointer.is_pressed());
    }
}
