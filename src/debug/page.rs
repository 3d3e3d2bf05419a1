//! The page in a terminal: it draws, waits for a key, and restores the terminal whatever happens.

use super::draw::draw;
use super::layout::Layout;
use super::state::{Ended, State};
use crate::shell::{Exit, Failure, interrupt};
use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event, KeyCode, KeyEvent, KeyModifiers};
use std::io::{self, IsTerminal};
use std::time::Duration;

/// The longest time between a signal and its effect.
const PATIENCE: Duration = Duration::from_millis(100);

/// Whether there is a terminal for a page.
///
/// # Errors
/// There is none.
pub fn check_terminal() -> Result<(), Failure> {
    let is_plain = std::env::var_os("TERM").is_none_or(|terminal| terminal == "dumb");
    if !is_plain && io::stdin().is_terminal() && io::stdout().is_terminal() {
        return Ok(());
    }
    let sentence = "debug needs a terminal for its page, and there is none: run it in one, or use `tilewright why` and `tilewright wave`";
    Err(Failure::new(Exit::BadInput, sentence))
}

/// Shows the page until the user leaves it.
///
/// # Errors
/// The terminal fails, or the simulation; a signal.
pub fn show(state: &mut State) -> Result<Ended, Failure> {
    let mut page = Page(ratatui::try_init().map_err(|error| broken(&error))?);
    page.run(state)
}

/// The terminal, which is restored when this is dropped. After a panic its hook restores it before the sentence is printed.
struct Page(DefaultTerminal);

impl Drop for Page {
    fn drop(&mut self) {
        ratatui::restore();
    }
}

impl Page {
    fn run(&mut self, state: &mut State) -> Result<Ended, Failure> {
        loop {
            self.draw(state)?;
            // A new size of the window is drawn, too.
            if let Event::Key(key) = wait()?
                && key.is_press()
            {
                state.key(key, &mut is_stopped)?;
            }
            if let Some(ended) = state.end {
                return Ok(ended);
            }
        }
    }

    fn draw(&mut self, state: &mut State) -> Result<(), Failure> {
        let broken = |error: io::Error| broken(&error);
        self.0.autoresize().map_err(broken)?;
        let layout = Layout::of(self.0.get_frame().area(), state);
        if let Some(layout) = &layout {
            state.prepare(layout.wave.into(), layout.nets.into())?;
        }
        self.0.draw(|frame| draw(frame, state, layout.as_ref())).map(|_| ()).map_err(broken)
    }
}

/// The next event of the terminal.
fn wait() -> Result<Event, Failure> {
    let broken = |error: io::Error| broken(&error);
    while !event::poll(PATIENCE).map_err(broken)? {
        if interrupt::asked() {
            return Err(Failure::new(interrupt::exit(), "the page was closed by a signal"));
        }
    }
    event::read().map_err(broken)
}

/// Whether the user stops a long run, by Esc or Ctrl-C.
fn is_stopped() -> bool {
    let is_key = event::poll(Duration::ZERO).unwrap_or(false);
    let stops = |key: KeyEvent| key.code == KeyCode::Esc || key.modifiers.contains(KeyModifiers::CONTROL);
    interrupt::asked() || is_key && event::read().is_ok_and(|event| event.as_key_press_event().is_some_and(stops))
}

fn broken(error: &io::Error) -> Failure {
    Failure::new(
        Exit::NoOutput,
        format!("the terminal cannot show the page ({error}): use `tilewright why` and `tilewright wave`"),
    )
}
