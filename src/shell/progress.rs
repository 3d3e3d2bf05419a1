//! A progress bar on a terminal; nothing where standard error is not one.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// The bar; it goes away when dropped.
pub struct Progress(ProgressBar);

/// The bar's resolution.
const STEPS: u64 = 1000;

impl Progress {
    /// A bar at its beginning.
    pub fn new() -> Progress {
        let style = ProgressStyle::with_template("{msg:12} {wide_bar} {percent:>3} %  {elapsed}");
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
        Progress(bar.with_style(style.expect("the template is sound")))
    }

    /// Shows what is going on and how much of it is done, from 0 to 1.
    pub fn show(&self, what: &'static str, fraction: f64) {
        if self.0.message() != what {
            self.0.set_message(what);
        }
        self.0.set_position((fraction * STEPS as f64) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
