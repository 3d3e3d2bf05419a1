//! What the page shows, and what the keys do to it. It knows no terminal.

use super::causes::Causes;
use super::condition::Condition;
use super::instants::Instants;
use super::keys::{Action, action};
use super::nets::{Net, nets};
use super::search::{self, Found, Stop};
use super::shown::Shown;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tilewright_hdl::Design;
use tilewright_sim::{Error, Simulation};

/// The nets that a page key passes.
const PAGE: i64 = 10;

/// A scenario that was played, at one of its instants.
pub struct State {
    /// The block, and its parameters in words.
    pub block: &'static str,
    pub parameters: String,
    pub(super) sim: Simulation,
    pub instants: Instants,
    pub nets: Vec<Net>,
    /// The nets that are listed, by number.
    pub listed: Vec<usize>,
    /// The part of a name that they have.
    pub filter: String,
    /// The selected one among those that are listed.
    pub selected: usize,
    /// The present time in picoseconds.
    pub now: u64,
    pub mode: Mode,
    /// A sentence for the user.
    pub message: String,
    pub shown: Shown,
    /// Whether other nets are listed than those that are shown.
    pub(super) is_stale: bool,
    /// The last condition.
    condition: String,
    pub end: Option<Ended>,
}

/// What has the keys.
#[derive(Debug)]
pub enum Mode {
    /// The waves.
    Waves,
    /// A line that is typed.
    Typing(Prompt, String),
    Causes(Causes),
    Help,
}

/// What is typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Prompt {
    Find,
    Run,
    RunBack,
}

/// How the user ended it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    Quit,
    Interrupted,
}

impl State {
    /// A simulation at the end of a scenario. It is shown at a time, with a net selected.
    pub fn new(
        block: &'static str,
        parameters: String,
        design: &Design,
        sim: Simulation,
        now: u64,
        net: Option<&str>,
    ) -> State {
        let (instants, nets) = (Instants::of(&sim), nets(design, &sim));
        let selected = net.and_then(|name| nets.iter().position(|net| net.name == name)).unwrap_or(0);
        let listed = (0..nets.len()).collect();
        State {
            block,
            parameters,
            sim,
            instants,
            nets,
            listed,
            filter: String::new(),
            selected,
            now,
            mode: Mode::Waves,
            message: String::new(),
            shown: Shown::default(),
            is_stale: true,
            condition: String::new(),
            end: None,
        }
    }

    /// The selected net.
    pub fn net(&self) -> Option<&Net> {
        self.listed.get(self.selected).map(|net| &self.nets[*net])
    }

    /// Does what a key asks for. `stop` is asked now and then whether to stop a long run.
    ///
    /// # Errors
    /// The simulation cannot go to a time.
    pub fn key(&mut self, event: KeyEvent, stop: Stop) -> Result<(), Error> {
        self.message.clear();
        let action = action(event);
        if action == Some(Action::Interrupt) {
            self.end = Some(Ended::Interrupted);
            return Ok(());
        }
        match std::mem::replace(&mut self.mode, Mode::Waves) {
            Mode::Typing(prompt, text) => self.typed(prompt, text, event, stop),
            // Any key leaves the help.
            Mode::Help => Ok(()),
            mode => {
                self.mode = mode;
                action.map_or(Ok(()), |action| self.act(action))
            }
        }
    }

    fn act(&mut self, action: Action) -> Result<(), Error> {
        match action {
            Action::Step(by) => self.step(by),
            Action::First => self.now = 0,
            Action::Last => self.now = self.instants.end,
            Action::Select(by) => self.select(by),
            Action::Page(by) => self.select(PAGE * by),
            Action::Find => self.mode = Mode::Typing(Prompt::Find, String::new()),
            Action::Run => self.mode = Mode::Typing(Prompt::Run, String::new()),
            Action::RunBack => self.mode = Mode::Typing(Prompt::RunBack, String::new()),
            Action::Why => return self.ask_why(),
            Action::Enter => self.go_to_cause(),
            Action::Help => self.mode = Mode::Help,
            Action::Leave => match self.mode {
                Mode::Waves => self.list(""),
                _ => self.mode = Mode::Waves,
            },
            Action::Quit => self.end = Some(Ended::Quit),
            Action::Interrupt => self.end = Some(Ended::Interrupted),
        }
        Ok(())
    }

    fn step(&mut self, by: i64) {
        for _ in 0..by.unsigned_abs() {
            let next = if by > 0 { self.instants.after(self.now) } else { self.instants.before(self.now) };
            self.now = next.min(self.instants.end);
        }
    }

    /// Selects another net, or another cause where those are walked.
    fn select(&mut self, by: i64) {
        let (selected, count) = match &mut self.mode {
            Mode::Causes(causes) => (&mut causes.selected, causes.lines.len()),
            _ => (&mut self.selected, self.listed.len()),
        };
        *selected = selected.saturating_add_signed(by as isize).min(count.saturating_sub(1));
    }

    /// Lists the nets with this part in their names.
    fn list(&mut self, part: &str) {
        let before = self.listed.get(self.selected).copied();
        let part = part.to_lowercase();
        let is_listed = |net: &usize| self.nets[*net].name.to_lowercase().contains(&part);
        self.listed = (0..self.nets.len()).filter(is_listed).collect();
        let same = self.listed.iter().position(|net| Some(*net) == before);
        (self.selected, self.filter, self.is_stale) = (same.unwrap_or(0), part, true);
    }

    /// Takes a key of a line that is typed.
    fn typed(&mut self, prompt: Prompt, mut text: String, event: KeyEvent, stop: Stop) -> Result<(), Error> {
        match event.code {
            KeyCode::Enter => return self.enter(prompt, &text, stop),
            KeyCode::Esc => {
                if prompt == Prompt::Find {
                    self.list("");
                }
                return Ok(());
            }
            KeyCode::Backspace => drop(text.pop()),
            KeyCode::Char(typed) if (event.modifiers - KeyModifiers::SHIFT).is_empty() => text.push(typed),
            _ => {}
        }
        if prompt == Prompt::Find {
            self.list(&text);
        }
        self.mode = Mode::Typing(prompt, text);
        Ok(())
    }

    /// A line has been typed. An empty condition is the last one.
    fn enter(&mut self, prompt: Prompt, text: &str, stop: Stop) -> Result<(), Error> {
        if prompt == Prompt::Find {
            if self.listed.is_empty() {
                self.list("");
                self.message = format!("there is no net with `{text}` in its name");
            }
            return Ok(());
        }
        if !text.trim().is_empty() {
            text.trim().clone_into(&mut self.condition);
        }
        let condition = match Condition::parse(&self.condition, &self.nets) {
            Ok(condition) => condition,
            Err(sentence) => {
                self.message = sentence;
                return Ok(());
            }
        };
        let run = if prompt == Prompt::Run { search::forward } else { search::back };
        match run(&mut self.sim, &self.instants, &condition, self.now, stop)? {
            Found::At(time) => self.now = time,
            Found::Nowhere => {
                let when = if prompt == Prompt::Run { "after" } else { "before" };
                self.message = format!("{} is true at no clock {when} this one", self.condition);
            }
            Found::Stopped => self.message = "the run was stopped".to_owned(),
        }
        Ok(())
    }

    /// Looks for the causes of the selected net's value.
    pub(super) fn ask_why(&mut self) -> Result<(), Error> {
        let Some(name) = self.net().map(|net| net.name.clone()) else { return Ok(()) };
        self.sim.go_to(self.now)?;
        let cause = self.sim.why(name.as_str())?;
        self.mode = Mode::Causes(Causes::of(&cause, &self.nets));
        Ok(())
    }

    /// Goes to the net and the time of the selected cause.
    fn go_to_cause(&mut self) {
        let Mode::Causes(causes) = &self.mode else { return };
        let line = causes.line();
        let (net, time) = (line.net, line.time);
        if net.is_none() {
            self.message = format!("{} is no net: this is the cycle since when it has its value", line.name);
        }
        self.now = time;
        if let Some(net) = net {
            self.select_net(net);
        }
    }

    /// Selects a net by its number. If it is not listed, all are.
    pub(super) fn select_net(&mut self, net: usize) {
        if !self.listed.contains(&net) {
            self.list("");
        }
        self.selected = self.listed.iter().position(|listed| *listed == net).unwrap_or(0);
    }
}
