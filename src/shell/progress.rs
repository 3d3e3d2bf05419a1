//! A line of progress on a terminal; nothing where standard error is not one.
//!
//! Work that knows its progress shows it with a [`Progress`]. For all other work that takes more than a second, a thread draws a line.

use super::terminal::is_quiet;
use std::io::{self, IsTerminal, Write};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Work that shows its progress. Dropping it removes the line.
pub struct Progress {
    begin: Instant,
}

/// The line on the terminal.
struct Line {
    /// Whether a line may be drawn.
    is_visible: bool,
    /// Whether a line is drawn.
    is_drawn: bool,
    /// The current work, its begin, and the part that is done, from 0 to 1, if that is known.
    what: &'static str,
    begin: Option<Instant>,
    done: Option<f64>,
    /// When this last changed.
    said: Option<Instant>,
}

static LINE: Mutex<Line> =
    Mutex::new(Line { is_visible: false, is_drawn: false, what: WORKING, begin: None, done: None, said: None });

/// The name of work that has no other.
const WORKING: &str = "working";

/// The least time between two lines with the same text.
const PAUSE: Duration = Duration::from_millis(50);

/// Work without a [`Progress`] gets a line after this time, and a line without changes gets a new time.
const SILENCE: Duration = Duration::from_secs(1);

/// The bar's width in characters. The line has at most 50 characters on every terminal.
const BAR: usize = 20;

/// From now on long work has a line, if standard error is a terminal and `--quiet` is not given.
pub fn begin() {
    let is_plain = std::env::var_os("TERM").is_none_or(|terminal| terminal == "dumb");
    if is_plain || is_quiet() || !io::stderr().is_terminal() {
        return;
    }
    let mut line = lock();
    line.is_visible = true;
    line.say(WORKING, None, Instant::now());
    // Without another thread, work without a `Progress` has no line.
    let _ = thread::Builder::new().spawn(|| {
        while lock().keep() {
            thread::sleep(SILENCE / 10);
        }
    });
}

/// Ends all lines before a result is printed, which another program may show on the same terminal.
pub fn end() {
    let mut line = lock();
    line.clear();
    line.is_visible = false;
}

/// Names the current work if its progress is not known.
pub fn phase(what: &'static str) {
    lock().say(what, None, Instant::now());
}

/// The current work, and the part of it that is done, from 0 to 1, if that is known.
pub fn now() -> (&'static str, Option<f64>) {
    let line = lock();
    (line.what, line.done)
}

/// Removes the line, and blocks it while something else is written.
pub fn aside(write: impl FnOnce()) {
    let mut line = lock();
    line.clear();
    write();
}

impl Progress {
    /// Work that begins now.
    pub fn new() -> Progress {
        Progress { begin: Instant::now() }
    }

    /// Shows the current work and the part of it that is done, from 0 to 1.
    pub fn show(&self, what: &'static str, fraction: f64) {
        let mut line = lock();
        let is_soon = line.said.is_some_and(|said| said.elapsed() < PAUSE);
        if !(line.is_drawn && line.what == what && is_soon) {
            line.say(what, Some(fraction), self.begin);
            if line.is_visible {
                line.draw();
            }
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        let mut line = lock();
        line.clear();
        line.say(WORKING, None, Instant::now());
    }
}

fn lock() -> MutexGuard<'static, Line> {
    LINE.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Line {
    fn say(&mut self, what: &'static str, done: Option<f64>, begin: Instant) {
        (self.what, self.done, self.begin) = (what, done, Some(begin));
        self.said = Some(Instant::now());
    }

    /// Draws the line if nothing has changed for long; whether a line is still wanted.
    fn keep(&mut self) -> bool {
        if self.is_visible && self.said.is_some_and(|said| said.elapsed() >= SILENCE) {
            self.draw();
            self.said = Some(Instant::now());
        }
        self.is_visible
    }

    fn draw(&mut self) {
        let passed = self.begin.map_or(Duration::ZERO, |begin| begin.elapsed());
        replace(&text(self.what, self.done, passed));
        self.is_drawn = true;
    }

    fn clear(&mut self) {
        if std::mem::take(&mut self.is_drawn) {
            replace("");
        }
    }
}

/// Replaces the line that the cursor is in.
fn replace(line: &str) {
    // Nobody is left to see it if standard error is closed.
    let _ = write!(io::stderr(), "\r{line}\x1b[K");
}

fn text(what: &str, done: Option<f64>, passed: Duration) -> String {
    let seconds = passed.as_secs();
    let Some(done) = done.map(|done| done.clamp(0.0, 1.0)) else {
        return format!("{what:12} {seconds}s");
    };
    let full = (done * BAR as f64) as usize;
    let bar = "#".repeat(full) + &"-".repeat(BAR - full);
    format!("{what:12} {bar} {:>3.0} %  {seconds}s", (done * 100.0).floor())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_shows_a_part_of_the_whole_and_the_time() {
        let passed = Duration::from_millis(3900);
        assert_eq!(text("drawing", Some(0.256), passed), "drawing      #####---------------  25 %  3s");
        assert_eq!(text("drawing", Some(7.0), passed), "drawing      #################### 100 %  3s");
        assert_eq!(text("reading out", Some(0.0), passed), "reading out  --------------------   0 %  3s");
        assert_eq!(text("compiling", None, passed), "compiling    3s");
    }
}
