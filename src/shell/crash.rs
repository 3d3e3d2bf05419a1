//! The last resort: a panic becomes one sentence that asks for a report, and an exit code.

use super::{Exit, Failure, terminal, text};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};

/// Runs a command. If it panics, the user gets a sentence and [`Exit::Crash`]. The panic unwinds first, so that values dropped on its
/// way closes its files.
pub fn guard(command: impl FnOnce() -> Result<Exit, Failure>) -> Result<Exit, Failure> {
    panic::set_hook(Box::new(|panic| terminal::tell(&text::legible(&sentence(panic)))));
    panic::catch_unwind(AssertUnwindSafe(command)).unwrap_or(Ok(Exit::Crash))
}

/// Does work of a crate that may panic on bad input; `None` if it does. Nothing is printed.
pub fn quietly<T>(work: impl FnOnce() -> T) -> Option<T> {
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let done = panic::catch_unwind(AssertUnwindSafe(work));
    panic::set_hook(hook);
    done.ok()
}

fn sentence(panic: &PanicHookInfo) -> String {
    let payload = panic.payload();
    let text = payload.downcast_ref::<&str>().copied().or(payload.downcast_ref::<String>().map(String::as_str));
    let said = text.unwrap_or("no reason given");
    let place = panic.location().map_or_else(String::new, |it| format!(" at {}:{}", it.file(), it.line()));
    format!("error: this is a mistake in tilewright{place}, please report it with the command that led here: {said}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_ends_in_its_own_exit_code() {
        assert_eq!(guard(|| panic!("on purpose")).unwrap(), Exit::Crash);
        let _ = panic::take_hook();
    }
}
