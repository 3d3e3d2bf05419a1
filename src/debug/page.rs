//! The page in a terminal: it draws, waits for a key, and restores the terminal whatever happens.

use super::draw::draw;
use super::layout::Layout;
use super::state::{Ended, State};
use crate::shell::{Exit, Failure, interrupt};
use crate::wcp::{self, Viewer};
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

/// Shows the page until the user leaves it. A viewer goes along with it.
///
/// # Errors
/// The terminal fails, or the simulation; a signal.
pub fn show(state: &mut State, viewer: Option<Viewer>) -> Result<Ended, Failure> {
    let terminal = ratatui::try_init().map_err(|error| broken(&error))?;
    Page { terminal, viewer }.run(state)
}

/// The terminal, which is restored when this is dropped. After a panic its hook restores it before the sentence is printed.
struct Page {
    terminal: DefaultTerminal,
    viewer: Option<Viewer>,
}

/// What happens.
enum Happens {
    /// In the terminal.
    Here(Event),
    /// In the viewer.
    There(wcp::Event),
    /// The viewer goes away.
    Alone,
}

impl Drop for Page {
    fn drop(&mut self) {
        ratatui::restore();
    }
}

impl Page {
    fn run(&mut self, state: &mut State) -> Result<Ended, Failure> {
        loop {
            self.lead_viewer(state);
            self.draw(state)?;
            match self.wait()? {
                Happens::Here(Event::Key(key)) if key.is_press() => state.key(key, &mut is_stopped)?,
                // A new size of the window is drawn, too.
                Happens::Here(_) => {}
                Happens::There(event) => {
                    state.follow(&event)?;
                    // Its user put the cursor somewhere in this clock, where it stays.
                    if let (wcp::Event::CursorMoved { .. }, Some(viewer)) = (event, &mut self.viewer) {
                        viewer.is_at(state.now);
                    }
                }
                Happens::Alone => self.lose_viewer(state),
            }
            if let Some(ended) = state.end {
                return Ok(ended);
            }
        }
    }

    /// Puts the viewer's cursor at the present time.
    fn lead_viewer(&mut self, state: &mut State) {
        if self.viewer.as_mut().is_some_and(|viewer| viewer.go_to(state.now).is_err()) {
            self.lose_viewer(state);
        }
    }

    fn lose_viewer(&mut self, state: &mut State) {
        self.viewer = None;
        "the viewer has closed the connection".clone_into(&mut state.message);
    }

    /// What happens next, in the terminal or in the viewer.
    fn wait(&mut self) -> Result<Happens, Failure> {
        let broken = |error: io::Error| broken(&error);
        while !event::poll(PATIENCE).map_err(broken)? {
            if interrupt::asked() {
                return Err(Failure::new(interrupt::exit(), "the page was closed by a signal"));
            }
            match self.viewer.as_mut().map(Viewer::event) {
                Some(Ok(Some(event))) => return Ok(Happens::There(event)),
                Some(Err(_)) => return Ok(Happens::Alone),
                Some(Ok(None)) | None => {}
            }
        }
        event::read().map(Happens::Here).map_err(broken)
    }

    fn draw(&mut self, state: &mut State) -> Result<(), Failure> {
        let broken = |error: io::Error| broken(&error);
        self.terminal.autoresize().map_err(broken)?;
        let layout = Layout::of(self.terminal.get_frame().area(), state);
        if let Some(layout) = &layout {
            state.prepare(layout.wave.into(), layout.nets.into())?;
        }
        self.terminal.draw(|frame| draw(frame, state, layout.as_ref())).map(|_| ()).map_err(broken)
    }
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
