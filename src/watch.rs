//! Work of the machines that shows its progress, and that Ctrl-C stops.

use crate::shell::{Progress, interrupt};
use tilewright_machines::Watch;

/// Does the work with a line of progress, which is removed at the end.
pub fn watched<T>(work: impl FnOnce(&mut Watch) -> T) -> T {
    let progress = Progress::new();
    let mut show = |it: tilewright_machines::Progress| {
        progress.show(it.phase, it.fraction);
        // The work itself reads the flag next.
        interrupt::asked();
    };
    work(&mut Watch { progress: Some(&mut show), cancel: Some(interrupt::flag()) })
}
