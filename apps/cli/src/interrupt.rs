//! What happens on Ctrl-C? The render under way is cancelled, so that the program ends in order and writes nothing.

use std::sync::Arc;

use catoptra_tracer::Control;

/// A control that Ctrl-C (and a request to terminate) cancels; a second Ctrl-C does no more than the first.
///
/// Without a handler, where the system refuses one, the signal ends the program at once: no file is half-written then either,
/// since files are moved to their place when complete.
pub(crate) fn control() -> Arc<Control> {
    let control = Arc::new(Control::default());
    let in_handler = Arc::clone(&control);
    if let Err(reason) = ctrlc::set_handler(move || in_handler.cancel()) {
        eprintln!("Ctrl-C will end the program at once: {reason}");
    }
    control
}
