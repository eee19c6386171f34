//! Who gets an event of the window: egui or the picture?

use egui::Pos2;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{Key, NamedKey};
use winit::window::CursorIcon;

use crate::actions;
use crate::app::App;
use crate::dropped;
use crate::gestures;
use crate::guard::{Answer, Next};
use crate::input::{Button, Held, Mode};
use crate::keys::{self, Command};
use crate::screen::Screen;
use crate::seeing::See;
use crate::transform::{self, Ends};
use crate::walk;

/// Pixels of a touchpad that make one notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 50.0;

impl App {
    /// Takes in an event of the window.
    pub(crate) fn handle(&mut self, event: &WindowEvent) {
        let Some(mut screen) = self.screen.take() else { return };
        self.handle_on(&mut screen, event);
        self.screen = Some(screen);
    }

    fn handle_on(&mut self, screen: &mut Screen, event: &WindowEvent) {
        match event {
            WindowEvent::CursorMoved { position, .. } => {
                self.pointer_moved(screen, event, (position.x, position.y));
            }
            WindowEvent::MouseInput { state, button, .. } => self.button(screen, event, *state, *button),
            WindowEvent::MouseWheel { delta, .. } if self.over_picture && !self.asks() => self.wheel(*delta),
            WindowEvent::KeyboardInput { event: key, .. } if self.asks() => {
                self.key_to_question(screen, event, key);
            }
            WindowEvent::KeyboardInput { event: key, .. } => self.key(screen, event, key),
            WindowEvent::DroppedFile(path) if dropped::picture::is_picture(path) => {
                self.picture_dropped(path);
            }
            WindowEvent::DroppedFile(path) if dropped::model::is_model(path) => self.model_dropped(path),
            WindowEvent::DroppedFile(path) => self.viewer.leave(Next::Open(path.clone())),
            WindowEvent::ModifiersChanged(modifiers) => {
                self.modifiers = modifiers.state();
                let held = self.held();
                self.viewer.pointer.held = held;
                let at = self.viewer.pointer.at;
                transform::pull(&mut self.viewer, at, held.ctrl);
                self.forward(screen, event);
            }
            WindowEvent::Resized(_)
            | WindowEvent::ScaleFactorChanged { .. }
            | WindowEvent::Occluded(false) => {
                self.exposed = true;
                self.forward(screen, event);
                screen.window.request_redraw();
            }
            WindowEvent::Focused(false) => {
                let gesture = self.viewer.pointer.cancel();
                gestures::gesture(&mut self.viewer, gesture);
                self.viewer.show_before(false);
                self.forward(screen, event);
            }
            _ => self.forward(screen, event),
        }
    }

    /// Whether a question stands in the window, or something is chosen: then all keys and clicks are for that.
    fn asks(&self) -> bool {
        let viewer = &self.viewer;
        viewer.guard.question().is_some() || viewer.browser.is_some() || viewer.adding.is_some()
    }

    /// Gives an event to egui.
    fn forward(&mut self, screen: &mut Screen, event: &WindowEvent) {
        if screen.input.on_window_event(&screen.window, event).repaint {
            self.viewer.stale.panel = true;
        }
    }

    /// Egui need not know about a pointer that stays over the picture.
    fn pointer_moved(&mut self, screen: &mut Screen, event: &WindowEvent, to: (f64, f64)) {
        let was_over = self.over_picture;
        let pressed = self.viewer.pointer.is_pressed();
        self.over_picture = pressed || self.is_over_picture(screen, to);
        let gesture = self.viewer.pointer.moved(to);
        gestures::gesture(&mut self.viewer, gesture);
        if self.moves_by_keys() {
            transform::pull(&mut self.viewer, to, self.modifiers.control_key());
        }
        if !(was_over && self.over_picture) || screen.egui.egui_is_using_pointer() {
            self.forward(screen, event);
        } else if !pressed {
            self.show_grip(screen, to);
        }
        self.read_off(to);
    }

    /// Whether things follow the pointer without a button.
    fn moves_by_keys(&self) -> bool {
        self.viewer.transform.as_ref().is_some_and(|transform| transform.ends == Ends::ByClick)
    }

    fn is_over_picture(&self, screen: &Screen, at: (f64, f64)) -> bool {
        let (width, height) = self.viewer.size;
        let inside = at.0 >= 0.0 && at.1 >= 0.0 && at.0 < f64::from(width) && at.1 < f64::from(height);
        let scale = screen.pixels_per_point();
        let point = Pos2::new(at.0 as f32 / scale, at.1 as f32 / scale);
        let layer = screen.egui.layer_id_at(point);
        inside && !self.asks() && layer.is_none_or(|layer| layer.order == egui::Order::Background)
    }

    /// The pointer tells that something can be dragged.
    fn show_grip(&self, screen: &Screen, at: (f64, f64)) {
        let hold = gestures::hold_at(&self.viewer, at);
        screen.window.set_cursor(if hold.is_some() { CursorIcon::Grab } else { CursorIcon::Default });
    }

    fn button(&mut self, screen: &mut Screen, event: &WindowEvent, state: ElementState, button: MouseButton) {
        let button = match button {
            MouseButton::Left => Button::Left,
            MouseButton::Right => Button::Right,
            MouseButton::Middle => Button::Middle,
            _ => return,
        };
        if state == ElementState::Released {
            let gesture = self.viewer.pointer.release(button);
            gestures::gesture(&mut self.viewer, gesture);
        } else if self.viewer.transform.is_some() {
            return self.end_transform(button);
        } else if self.over_picture && !self.asks() {
            let hold = gestures::hold_at(&self.viewer, self.viewer.pointer.at);
            let mode: Mode = self.viewer.settings.mode;
            self.viewer.pointer.press(button, self.held(), mode, hold);
            screen.egui.memory_mut(|memory| {
                if let Some(focused) = memory.focused() {
                    memory.surrender_focus(focused);
                }
            });
        }
        self.forward(screen, event);
    }

    /// A button goes down while things are moved: the left one keeps what was done, another takes it back.
    fn end_transform(&mut self, button: Button) {
        match button {
            Button::Left => transform::keep(&mut self.viewer),
            Button::Middle | Button::Right => transform::take_back(&mut self.viewer),
        }
        self.viewer.pointer.cancel();
    }

    fn wheel(&mut self, delta: MouseScrollDelta) {
        let notches = match delta {
            MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
            MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_NOTCH,
        };
        gestures::wheel(&mut self.viewer, notches, self.modifiers.control_key());
    }

    /// A key goes to egui while something there is being typed, and is a command otherwise.
    fn key(&mut self, screen: &mut Screen, event: &WindowEvent, key: &KeyEvent) {
        let typing = screen.egui.egui_wants_keyboard_input();
        let command = self.command(key);
        if key.state == ElementState::Pressed && self.key_to_transform(key) {
            return;
        }
        let (pressed, held) = (key.state == ElementState::Pressed, self.held());
        if pressed && !held.ctrl && !held.alt && walk::key(&mut self.viewer, &key.logical_key) {
            return;
        }
        let in_panel =
            || egui::Popup::is_any_open(&screen.egui) || egui::DragAndDrop::has_any_payload(&screen.egui);
        if command == Some(Command::Escape) && in_panel() {
            // It closes the menu, or gives up the drag, and nothing more.
            return self.forward(screen, event);
        }
        if command == Some(Command::See(See::Before)) && !typing {
            if !key.repeat {
                self.viewer.show_before(key.state == ElementState::Pressed);
            }
            return;
        }
        let everywhere = command.is_some_and(Command::is_everywhere);
        if key.state == ElementState::Pressed
            && let Some(command) = command
            && (!typing || everywhere)
        {
            if !key.repeat || matches!(command, Command::Step(..) | Command::Undo | Command::Redo) {
                actions::run(&mut self.viewer, command);
            }
        } else if typing || key.logical_key != Key::Named(NamedKey::Tab) {
            self.forward(screen, event);
        }
    }

    /// Gives a key to what is being moved; with Ctrl it is a command, and what is being moved is kept before.
    fn key_to_transform(&mut self, key: &KeyEvent) -> bool {
        let is_command = self.modifiers.control_key() || self.modifiers.super_key();
        let is_modifier = matches!(
            key.logical_key,
            Key::Named(NamedKey::Control | NamedKey::Super | NamedKey::Shift | NamedKey::Alt)
        );
        if is_command && !is_modifier {
            transform::keep(&mut self.viewer);
            return false;
        }
        transform::key(&mut self.viewer, &key.logical_key, self.modifiers.shift_key())
    }

    /// While something is asked, Esc cancels, Ctrl+Q asks anew, and all other keys go to the buttons.
    fn key_to_question(&mut self, screen: &mut Screen, event: &WindowEvent, key: &KeyEvent) {
        match self.command(key) {
            Some(Command::Escape) if key.state == ElementState::Pressed => self.cancel(),
            Some(Command::Quit) if key.state == ElementState::Pressed => self.viewer.leave(Next::Close),
            _ => self.forward(screen, event),
        }
    }

    /// Takes away what stands over the window.
    fn cancel(&mut self) {
        if self.viewer.adding.take().is_none() && self.viewer.browser.take().is_none() {
            self.viewer.answer(Answer::Cancel);
        }
        self.viewer.stale.panel = true;
    }

    /// What that key asks for under the modifiers that are held.
    fn command(&self, key: &KeyEvent) -> Option<Command> {
        keys::command(&key.logical_key, self.held())
    }

    /// The keys that are held.
    fn held(&self) -> Held {
        let keys = self.modifiers;
        Held { shift: keys.shift_key(), ctrl: keys.control_key() || keys.super_key(), alt: keys.alt_key() }
    }
}
