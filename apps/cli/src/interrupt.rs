//! What happens on Ctrl-C? The render under way is cancelled, so that the program ends in order and writes nothing.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use catoptra_tracer::Control;

use crate::console::say;

/// Exit code of a program that was interrupted.
pub(crate) const CODE: u8 = 130;

/// Whether the program may be waiting for whoever reads what it writes.
static WAITS: AtomicBool = AtomicBool::new(false);

/// A control that Ctrl-C (and a request to terminate) cancels; a second Ctrl-C does no more than the first.
///
/// Without a handler, where the system refuses one, the signal ends the program at once: no file is half-written then either,
/// since files are moved to their place when complete.
pub(crate) fn control() -> Arc<Control> {
    let control = Arc::new(Control::default());
    let in_handler = Arc::clone(&control);
    let handler = move || {
        in_handler.cancel();
        if WAITS.load(Ordering::SeqCst) {
            std::process::exit(CODE.into());
        }
    };
    if let Err(reason) = ctrlc::set_handler(handler) {
        say(&format!("Ctrl-C will end the program at once: {reason}"));
    }
    control
}

/// Does what may wait for others without end, such as for the reader of a pipe: an interruption ends the program then.
/// `None` where it has been interrupted already.
pub(crate) fn while_waiting<T>(control: &Control, work: impl FnOnce() -> T) -> Option<T> {
    WAITS.store(true, Ordering::SeqCst);
    let done = (!control.is_cancelled()).then(work);
    WAITS.store(false, Ordering::SeqCst);
    done
}
