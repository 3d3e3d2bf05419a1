//! Work of the machines that shows its progress, and that Ctrl-C stops.

use crate::shell::{Progress, interrupt};
use std::sync::atomic::AtomicBool;
use tilewright_machines::Watch;

/// Does the work with a line of progress, which is removed at the end. It stops soon after `cancel` becomes true.
pub fn watched<T>(cancel: &AtomicBool, work: impl FnOnce(&mut Watch) -> T) -> T {
    let progress = Progress::new();
    let mut show = |it: tilewright_machines::Progress| {
        progress.show(it.phase, it.fraction);
        // The work itself reads the flag next.
        interrupt::asked();
    };
    work(&mut Watch { progress: Some(&mut show), cancel: Some(cancel) })
}
