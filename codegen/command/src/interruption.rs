//! Lets long work end early at Ctrl-C, with what is done so far.

use std::sync::atomic::{AtomicBool, Ordering};

/// True after the first Ctrl-C.
static IS_INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Exit code of a command that a second Ctrl-C ends, as shells give it: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// Returns the flag that the first Ctrl-C raises from now on; the second one ends the command.
pub fn flag() -> &'static AtomicBool {
    // Without a handler, the first Ctrl-C ends the command.
    let _ = ctrlc::set_handler(|| {
        if IS_INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    });
    &IS_INTERRUPTED
}
