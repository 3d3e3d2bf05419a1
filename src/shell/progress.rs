//! A line of progress on a terminal; nothing where standard error is not one.
//!
//! Work that knows how far it is shows it by a [`Progress`]. All other work has a line too, once it takes more than a second: a thread draws it.

use super::terminal::is_quiet;
use std::io::{self, IsTerminal, Write};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Work that shows how far it is; its line goes away when dropped.
pub struct Progress {
    begin: Instant,
}

/// The line on the terminal.
struct Line {
    /// Whether there may be one.
    is_visible: bool,
    /// Whether there is one.
    is_drawn: bool,
    /// What is going on, since when, and how much of it is done, from 0 to 1, where that is known.
    what: &'static str,
    begin: Option<Instant>,
    done: Option<f64>,
    /// When this was last said anew.
    said: Option<Instant>,
}

static LINE: Mutex<Line> =
    Mutex::new(Line { is_visible: false, is_drawn: false, what: WORKING, begin: None, done: None, said: None });

/// What work is called of which nothing else is said.
const WORKING: &str = "working";

/// A line is drawn no sooner after the one before it, unless it says something else.
const PAUSE: Duration = Duration::from_millis(50);

/// Work that says nothing of itself has no line before it takes so long, and a line that stands still gets a new time.
const SILENCE: Duration = Duration::from_secs(1);

/// The bar's width in characters: that of the line, at most 50, does not depend on the terminal's.
const BAR: usize = 20;

/// From now on long work has a line, if standard error is a terminal and nothing is to be quiet.
pub fn begin() {
    let is_plain = std::env::var_os("TERM").is_none_or(|terminal| terminal == "dumb");
    if is_plain || is_quiet() || !io::stderr().is_terminal() {
        return;
    }
    let mut line = lock();
    line.is_visible = true;
    line.say(WORKING, None, Instant::now());
    // Without another thread the work that says nothing of itself has no line.
    let _ = thread::Builder::new().spawn(|| {
        while lock().keep() {
            thread::sleep(SILENCE / 10);
        }
    });
}

/// From now on there is no line: a result is printed, perhaps to a program that shows it on the same terminal.
pub fn end() {
    let mut line = lock();
    line.clear();
    line.is_visible = false;
}

/// Says what is going on where nothing is known of how far it is.
pub fn phase(what: &'static str) {
    lock().say(what, None, Instant::now());
}

/// Removes the line, and keeps it away while something else is written.
pub fn aside(write: impl FnOnce()) {
    let mut line = lock();
    line.clear();
    write();
}

impl Progress {
    /// One at its beginning.
    pub fn new() -> Progress {
        Progress { begin: Instant::now() }
    }

    /// Shows what is going on and how much of it is done, from 0 to 1.
    pub fn show(&self, what: &'static str, fraction: f64) {
        let mut line = lock();
        let is_soon = line.said.is_some_and(|said| said.elapsed() < PAUSE);
        if line.is_visible && !(line.is_drawn && line.what == what && is_soon) {
            line.say(what, Some(fraction), self.begin);
            line.draw();
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

    /// Draws the line where nothing was said for long; whether there is still one to be kept.
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
