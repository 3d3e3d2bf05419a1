//! Work of the machines that shows how far it is, and that Ctrl-C breaks off.

use crate::shell::{Progress, interrupt};
use tilewright_machines::Watch;

/// Does the work with a line of progress, which goes away at its end.
pub fn watched<T>(work: impl FnOnce(&mut Watch) -> T) -> T {
    let progress = Progress::new();
    let mut show = |it: tilewright_machines::Progress| {
        progress.show(it.phase, it.fraction);
        // The work looks at the flag itself, next.
        interrupt::asked();
    };
    work(&mut Watch { progress: Some(&mut show), cancel: Some(interrupt::flag()) })
}
