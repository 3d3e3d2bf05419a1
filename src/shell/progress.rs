//! A line of progress on a terminal; nothing where standard error is not one.

use super::terminal::is_quiet;
use std::cell::Cell;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::{Duration, Instant};

/// The line; it goes away when dropped.
pub struct Progress {
    is_visible: bool,
    begin: Instant,
    /// What the line says, and since when.
    shown: Cell<Option<(&'static str, Instant)>>,
}

/// Whether a line stands on the terminal.
static DRAWN: AtomicBool = AtomicBool::new(false);

/// A line is drawn no sooner after the one before it, unless it says something else.
const PAUSE: Duration = Duration::from_millis(50);

/// The bar's width in characters: that of the line, at most 50, does not depend on the terminal's.
const BAR: usize = 20;

impl Progress {
    /// One at its beginning.
    pub fn new() -> Progress {
        let is_plain = std::env::var_os("TERM").is_none_or(|terminal| terminal == "dumb");
        let is_visible = io::stderr().is_terminal() && !is_plain && !is_quiet();
        Progress { is_visible, begin: Instant::now(), shown: Cell::new(None) }
    }

    /// Shows what is going on and how much of it is done, from 0 to 1.
    pub fn show(&self, what: &'static str, fraction: f64) {
        if !self.is_visible {
            return;
        }
        let now = Instant::now();
        if self.shown.get().is_some_and(|(shown, at)| shown == what && now - at < PAUSE) {
            return;
        }
        self.shown.set(Some((what, now)));
        DRAWN.store(true, Relaxed);
        draw(&line(what, fraction, now - self.begin));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        clear();
    }
}

/// Removes the line that stands on the terminal.
pub fn clear() {
    if DRAWN.swap(false, Relaxed) {
        draw("");
    }
}

/// Replaces the line that the cursor is in.
fn draw(line: &str) {
    // Nobody is left to see it if standard error is closed.
    let _ = write!(io::stderr(), "\r{line}\x1b[K");
}

fn line(what: &str, fraction: f64, passed: Duration) -> String {
    let done = fraction.clamp(0.0, 1.0);
    let full = (done * BAR as f64) as usize;
    let bar = "#".repeat(full) + &"-".repeat(BAR - full);
    format!("{what:12} {bar} {:>3.0} %  {}s", (done * 100.0).floor(), passed.as_secs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_shows_a_part_of_the_whole_and_the_time() {
        let passed = Duration::from_millis(3900);
        assert_eq!(line("drawing", 0.256, passed), "drawing      #####---------------  25 %  3s");
        assert_eq!(line("drawing", 7.0, passed), "drawing      #################### 100 %  3s");
        assert_eq!(line("reading out", 0.0, passed), "reading out  --------------------   0 %  3s");
    }
}
