//! Draws the page.

use super::keys::KEYS;
use super::layout::{LEAST, Layout};
use super::source;
use super::state::{Mode, Prompt, State};
use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::style::{Modifier, Style};
use std::iter::zip;
use tilewright_sim::WaveLine;

const PLAIN: Style = Style::new();
const BOLD: Style = Style::new().add_modifier(Modifier::BOLD);
const DIM: Style = Style::new().add_modifier(Modifier::DIM);
/// What is at the present time, and what is selected.
const NOW: Style = Style::new().add_modifier(Modifier::REVERSED);

/// What the first line offers.
const OFFER: &str = "? keys  q quit";

/// Draws a page that was [prepared](State::prepare) for this layout.
pub fn draw(frame: &mut Frame, state: &State, layout: Option<&Layout>) {
    let area = frame.area();
    match layout {
        // A window that has just changed its size is drawn the next time.
        Some(layout) if layout.area != area => {}
        Some(layout) => Page { to: frame.buffer_mut(), state, layout }.draw(),
        None => {
            let (columns, lines) = LEAST;
            let sentence = format!("the window needs {columns} columns and {lines} lines");
            frame.buffer_mut().set_stringn(0, 0, sentence, area.width.into(), PLAIN);
        }
    }
}

struct Page<'a> {
    to: &'a mut Buffer,
    state: &'a State,
    layout: &'a Layout,
}

impl Page<'_> {
    fn draw(&mut self) {
        self.head();
        if let Mode::Help = self.state.mode {
            self.help();
        } else {
            self.axis();
            self.waves();
            match &self.state.mode {
                Mode::Causes(_) => self.causes(),
                _ => self.source(),
            }
        }
        self.foot();
    }

    /// Writes text into a line from a column on, at most so many characters.
    fn put(&mut self, column: u16, line: u16, text: &str, most: u16, style: Style) {
        let most = most.min(self.layout.area.width.saturating_sub(column));
        self.to.set_stringn(column, line, text, most.into(), style);
    }

    fn head(&mut self) {
        let State { block, parameters, instants, now, .. } = self.state;
        let width = self.layout.area.width;
        let room = width.saturating_sub(OFFER.len() as u16 + 1);
        let about = format!("{block}: {}", instants.words(*now));
        let after = about.chars().count() as u16 + 3;
        self.put(0, 0, &about, room.saturating_sub(1), BOLD);
        self.put(after, 0, parameters, room.saturating_sub(after + 1), DIM);
        self.put(room, 0, OFFER, width, DIM);
    }

    /// The cycles of the first clock, as far as there is room. The present one has a sign.
    fn axis(&mut self) {
        let Layout { left, wave, axis, .. } = *self.layout;
        let (shown, mut free) = (&self.state.shown, 0);
        let now = shown.column_of(self.state.now);
        let taken = now.map_or(usize::MAX, |now| now * shown.column);
        for (column, time) in shown.times.iter().enumerate() {
            let Some(cycle) = self.state.instants.cycle_at(*time) else { continue };
            let (at, text) = (column * shown.column, cycle.to_string());
            let is_free = at >= free && (at + text.len() + 1 < taken || at > taken);
            if is_free && at + text.len() < wave.into() {
                self.put(left + at as u16 + 1, axis, &text, wave, DIM);
                free = at + text.len() + 2;
            }
        }
        if let Some(column) = now {
            let (at, cycle) = (column * shown.column, self.state.instants.cycle_at(self.state.now));
            let text = format!("▾{}", cycle.map(|cycle| cycle.to_string()).unwrap_or_default());
            // A cycle beside it may be longer than a column.
            let padded = format!("{text:width$}", width = shown.column);
            self.put(left + at as u16, axis, &padded, wave, BOLD);
        }
    }

    fn waves(&mut self) {
        let Layout { axis, top, nets, .. } = *self.layout;
        for (line, clock) in zip(axis + 1..top, &self.state.shown.clocks) {
            self.wave(line, clock, false);
        }
        for ((line, net), number) in zip(top..top + nets, &self.state.shown.nets).zip(self.state.shown.first..) {
            self.wave(line, net, number == self.state.selected);
        }
    }

    /// A line: name, present value, wave. A value that has just changed is bold.
    fn wave(&mut self, line: u16, wave: &WaveLine, is_selected: bool) {
        let Layout { left, name, value, wave: room, .. } = *self.layout;
        let State { shown, now, .. } = self.state;
        let style = if is_selected { NOW } else { PLAIN };
        if is_selected {
            self.put(0, line, "▸", 1, PLAIN);
        }
        self.put(1, line, &start_cut(&wave.name, name), name, style);
        self.put(left, line, &wave.line, room, PLAIN);
        let Some(column) = shown.column_of(*now) else { return };
        if let Some(text) = wave.values.get(column) {
            let is_new = column > 0 && wave.values[column - 1] != *text;
            self.put(1 + name + 1, line, &end_cut(text, value), value, if is_new { BOLD } else { PLAIN });
        }
        let (at, end) = (column * shown.column, (column + 1) * shown.column);
        for column in at..end.min(room.into()) {
            self.to[(left + column as u16, line)].set_style(NOW);
        }
    }

    fn heading(&mut self, text: &str) {
        let Layout { heading, area, .. } = *self.layout;
        self.put(0, heading, &"─".repeat(area.width.into()), area.width, DIM);
        self.put(2, heading, &format!(" {text} "), area.width, PLAIN);
    }

    /// The source lines of the selected net.
    fn source(&mut self) {
        let Layout { heading, lower, area, .. } = *self.layout;
        let Some(net) = self.state.net() else { return self.heading("no net") };
        let Some(place) = &net.source else { return self.heading(&format!("{}: its line is not known", net.name)) };
        self.heading(&format!("{}: {place}", net.name));
        for (line, (number, text)) in zip(heading + 1.., source::lines(place, lower.into())) {
            let is_it = place.ends_with(&format!(":{number}"));
            let style = if is_it { BOLD } else { PLAIN };
            self.put(0, line, &format!("{}{number:5} {text}", if is_it { '▸' } else { ' ' }), area.width, style);
        }
    }

    /// The causes, with the selected one among them.
    fn causes(&mut self) {
        let Mode::Causes(causes) = &self.state.mode else { return };
        let Layout { heading, lower, area, .. } = *self.layout;
        self.heading("why: ↑ ↓ walk, Enter goes there, w asks there, Esc leaves");
        let room = usize::from(lower);
        let first = (causes.selected + 1).saturating_sub(room);
        for ((line, cause), number) in zip(heading + 1.., causes.lines.iter().skip(first).take(room)).zip(first..) {
            let style = if number == causes.selected { NOW } else { PLAIN };
            self.put(1 + 2 * cause.depth as u16, line, &cause.text, area.width, style);
        }
    }

    fn help(&mut self) {
        let names = KEYS.iter().map(|key| key.names.chars().count()).max().unwrap_or(0) as u16;
        let shown = KEYS.iter().filter(|key| !key.names.is_empty());
        for (line, key) in zip(2..self.layout.foot, shown) {
            self.put(2, line, key.names, names, BOLD);
            self.put(2 + names + 2, line, key.what, self.layout.area.width, PLAIN);
        }
    }

    /// What is typed, or a message, or what the page lists.
    fn foot(&mut self) {
        let Layout { foot, area, .. } = *self.layout;
        let State { mode, message, filter, listed, nets, .. } = self.state;
        let text = match mode {
            Mode::Typing(Prompt::Find, text) => format!("/{text}▏ {} nets", listed.len()),
            Mode::Typing(Prompt::Run, text) => format!("run to: {text}▏"),
            Mode::Typing(Prompt::RunBack, text) => format!("run back to: {text}▏"),
            _ if !message.is_empty() => message.clone(),
            Mode::Help => "any key leaves".to_owned(),
            _ if !filter.is_empty() => format!("{} of {} nets, with {filter}: Esc lists all", listed.len(), nets.len()),
            _ => format!("net {} of {}", self.state.selected + 1, nets.len()),
        };
        self.put(0, foot, &text, area.width, PLAIN);
    }
}

/// The end of a name that is too long, which says most.
fn start_cut(text: &str, room: u16) -> String {
    let (count, room) = (text.chars().count(), usize::from(room));
    match count > room {
        true => format!("..{}", text.chars().skip(count + 2 - room).collect::<String>()),
        false => text.to_owned(),
    }
}

/// The start of a value that is too long.
fn end_cut(text: &str, room: u16) -> String {
    let room = usize::from(room);
    match text.chars().count() > room {
        true => format!("{}..", text.chars().take(room.saturating_sub(2)).collect::<String>()),
        false => text.to_owned(),
    }
}
