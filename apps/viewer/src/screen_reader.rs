//! How do screen readers hear what the panel shows, and work its controls? By AccessKit, where the viewer was built with it.

use egui_winit::accesskit_winit::{Event, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};

use crate::app::{App, Wake};
use crate::screen::Screen;

impl From<Event> for Wake {
    fn from(event: Event) -> Self {
        Self::ScreenReader(event.window_event)
    }
}

/// Lets screen readers know of the window, which must not be visible yet, and shows it.
pub(crate) fn connect(screen: &mut Screen, event_loop: &ActiveEventLoop, proxy: EventLoopProxy<Wake>) {
    screen.input.init_accesskit(event_loop, &screen.window, proxy);
    screen.window.set_visible(true);
}

impl App {
    /// Tells a screen reader what there is, or does what a person asks for by one.
    pub(crate) fn screen_reader_asks(&mut self, event: WindowEvent) {
        let Some(screen) = &mut self.screen else { return };
        match event {
            WindowEvent::InitialTreeRequested => screen.egui.enable_accesskit(),
            WindowEvent::ActionRequested(request) => screen.input.on_accesskit_action_request(request),
            WindowEvent::AccessibilityDeactivated => screen.egui.disable_accesskit(),
        }
        self.viewer.stale.panel = true;
    }
}
