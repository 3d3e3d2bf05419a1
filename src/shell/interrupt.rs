//! Signals. The first Ctrl-C, SIGTERM or SIGHUP asks a run to stop and close its files, the second one ends the program at once.

use super::{Exit, terminal};
use signal_hook::consts::{SIGABRT, SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, LazyLock, Once};
use std::thread;
use std::time::Duration;

/// Whether a signal has come, and which.
static ASKED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
static SIGNAL: LazyLock<Arc<AtomicUsize>> = LazyLock::new(Arc::default);
/// Whether the command knows.
static SEEN: AtomicBool = AtomicBool::new(false);

/// How long a command that does not look is waited for.
const PATIENCE: Duration = Duration::from_secs(2);

/// The signals that ask a run to stop, and how it ends then.
const STOPS: &[(i32, Exit)] = &[
    (SIGINT, Exit::Interrupted),
    (SIGTERM, Exit::Terminated),
    #[cfg(unix)]
    (signal_hook::consts::SIGHUP, Exit::HungUp),
];

/// From now on a signal raises the returned flag. Only for a command that looks at it; others end at once, as usual.
pub fn flag() -> &'static AtomicBool {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let heeded = STOPS.iter().filter(|(signal, _)| !is_ignored(*signal));
        // What cannot be caught ends the program at once, which is no reason to refuse to run.
        let caught = heeded.map(|(signal, exit)| catch(*signal, *exit)).filter(Result::is_ok).count();
        if caught > 0 {
            let _ = thread::Builder::new().spawn(wait_for_the_command);
        }
    });
    &ASKED
}

/// Whether the command is to stop, which it will now do.
pub fn asked() -> bool {
    let asked = flag().load(Relaxed);
    if asked {
        SEEN.store(true, Relaxed);
    }
    asked
}

/// What a loop is told that looks whether the command is to stop.
pub fn go_on() -> ControlFlow<()> {
    if asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// How a command ends that was asked to stop.
pub fn exit() -> Exit {
    let signal = SIGNAL.load(Relaxed);
    STOPS.iter().find(|stop| stop.0 as usize == signal).map_or(Exit::Interrupted, |stop| stop.1)
}

/// Turns what would kill the program without a word into an exit code, or into the error of a write.
pub fn tame() {
    // Without memory Rust says how many bytes it wanted, without stack which thread, and aborts.
    let _ = flag::register_conditional_shutdown(SIGABRT, Exit::NoMemory as i32, Arc::new(true.into()));
    // A file that has reached the limit of `ulimit -f`.
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

fn catch(signal: i32, exit: Exit) -> io::Result<()> {
    flag::register_conditional_shutdown(signal, exit as i32, ASKED.clone())?;
    flag::register_usize(signal, SIGNAL.clone(), signal as usize)?;
    flag::register(signal, ASKED.clone())?;
    Ok(())
}

/// Whether who started the program wants it to ignore a signal, as `nohup` does; known on Linux alone.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Ends the program some time after a signal, unless the command has looked and ends by itself.
fn wait_for_the_command() {
    while !ASKED.load(Relaxed) {
        thread::sleep(Duration::from_millis(20));
    }
    thread::sleep(PATIENCE);
    if !SEEN.load(Relaxed) {
        terminal::tell("error: interrupted");
        std::process::exit(exit() as i32);
    }
}
