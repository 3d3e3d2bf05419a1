//! Signals. The first Ctrl-C, SIGTERM or SIGHUP asks a run to stop and close its files. The second one ends the program at once.

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
/// Whether the command has seen the signal.
static SEEN: AtomicBool = AtomicBool::new(false);

/// The time that a command has to see the signal.
const PATIENCE: Duration = Duration::from_secs(2);

/// The signals that ask a run to stop, each with its exit code.
const STOPS: &[(i32, Exit)] = &[
    (SIGINT, Exit::Interrupted),
    (SIGTERM, Exit::Terminated),
    #[cfg(unix)]
    (signal_hook::consts::SIGHUP, Exit::HungUp),
];

/// From now on a signal raises the returned flag. Only for commands that look at it; other commands end at once, as usual.
pub fn flag() -> &'static AtomicBool {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let heeded = STOPS.iter().filter(|(signal, _)| !is_ignored(*signal));
        // A signal that cannot be caught ends the program at once, which is no reason to refuse to run.
        let caught = heeded.map(|(signal, exit)| catch(*signal, *exit)).filter(Result::is_ok).count();
        if caught > 0 {
            let _ = thread::Builder::new().spawn(wait_for_the_command);
        }
    });
    &ASKED
}

/// Whether the command has to stop. It is then expected to stop.
pub fn asked() -> bool {
    let asked = flag().load(Relaxed);
    if asked {
        SEEN.store(true, Relaxed);
    }
    asked
}

/// For loops: whether to go on, or to stop because of a signal.
pub fn go_on() -> ControlFlow<()> {
    if asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// The exit code of a command that a signal stopped.
pub fn exit() -> Exit {
    let signal = SIGNAL.load(Relaxed);
    STOPS.iter().find(|stop| stop.0 as usize == signal).map_or(Exit::Interrupted, |stop| stop.1)
}

/// Turns what would kill the program without a word into an exit code, or into the error of a write.
pub fn tame() {
    // Out of memory or stack, Rust prints the bytes or the thread, and aborts.
    let _ = flag::register_conditional_shutdown(SIGABRT, Exit::NoMemory as i32, Arc::new(true.into()));
    // A file has reached the limit of `ulimit -f`.
    #[cfg(unix)]
    let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

fn catch(signal: i32, exit: Exit) -> io::Result<()> {
    flag::register_conditional_shutdown(signal, exit as i32, ASKED.clone())?;
    flag::register_usize(signal, SIGNAL.clone(), signal as usize)?;
    flag::register(signal, ASKED.clone())?;
    Ok(())
}

/// Whether the program was started with a signal ignored, as by `nohup`; known on Linux only.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Ends the program some time after a signal, unless the command has seen it and ends by itself.
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
