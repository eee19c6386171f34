//! Which signals would end the program without an error of its own, and what happens instead?

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGABRT, SIGXFSZ};
use signal_hook::flag::{register, register_conditional_shutdown};

/// Exit code where memory has run out, as for all other input that is too much.
const TOO_MUCH: i32 = 2;

/// Makes errors of them, as far as the system allows it.
///
/// A write past the limit on the size of files is refused like any other that fails. Where memory runs out, the standard
/// library says how much it could not get and aborts: the program ends there with exit code 2 instead of a core dump.
pub(crate) fn tame() {
    let refused = register(SIGXFSZ, Arc::default());
    let ended = register_conditional_shutdown(SIGABRT, TOO_MUCH, Arc::new(AtomicBool::new(true)));
    // Without them the program works all the same, and ends less gently.
    drop((refused, ended));
}
