//! Ctrl-C: the first one asks a run to stop and close its files, the second one ends the program at once.

use super::Exit;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C raises the returned flag. Only for a command that looks at it; others end at once, as usual.
pub fn flag() -> &'static AtomicBool {
    // Without a handler Ctrl-C ends the program at once, which is no reason to refuse to run.
    let _ = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(Exit::Interrupted as i32);
        }
    });
    &ASKED
}
