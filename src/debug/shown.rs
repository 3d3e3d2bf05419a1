//! The part of the waves that is on the page.

use super::state::State;
use tilewright_sim::{Error, WaveLine, WaveLines};

/// The narrowest column of a wave, in characters.
const NARROWEST: usize = 4;

/// The waves of some nets over some instants.
#[derive(Debug, Default)]
pub struct Shown {
    /// The first net of the list that is shown.
    pub first: usize,
    /// The instants, one for each column.
    pub times: Vec<u64>,
    /// The width of a column in characters.
    pub column: usize,
    pub clocks: Vec<WaveLine>,
    pub nets: Vec<WaveLine>,
    /// The size that it was made for: characters of the wave, and nets.
    size: (usize, usize),
}

impl Shown {
    /// The column of a time.
    pub fn column_of(&self, time: u64) -> Option<usize> {
        self.times.binary_search(&time).ok()
    }
}

impl State {
    /// Makes the waves ready for a page with so many characters beside the names and so many nets.
    ///
    /// # Errors
    /// The simulation cannot go to a time.
    pub fn prepare(&mut self, width: usize, nets: usize) -> Result<(), Error> {
        let first = self.first_shown(nets);
        let is_there = self.shown.column_of(self.now).is_some();
        let is_same = self.shown.size == (width, nets) && self.shown.first == first && !self.is_stale;
        if is_there && is_same {
            return Ok(());
        }
        let most = (width / NARROWEST).max(1);
        // The waves stay where they are while the present time is among them. Else it goes to the middle, but for the end.
        let start = if is_there {
            self.shown.times[0]
        } else {
            self.instants.back(self.now, most - self.instants.from(self.now, most / 2 + 1).len())
        };
        let listed = &self.listed[first..self.listed.len().min(first + nets)];
        let names: Vec<String> = listed.iter().map(|net| self.nets[*net].name.clone()).collect();
        let wave = self.sim.blank_wave(names.iter().map(String::as_str));
        let times = self.instants.from(start, most);
        for &time in &times {
            self.sim.go_to(time)?;
            self.sim.add_column(&wave, self.instants.after(time));
        }
        let all = wave.lines(0..0).column;
        let fits = (width / all).clamp(1, times.len());
        let now = times.binary_search(&self.now).unwrap_or(0);
        let is_in_front = is_there && now < fits;
        let left = if is_in_front { 0 } else { now.saturating_sub(fits / 2).min(times.len() - fits) };
        let WaveLines { column, lines } = wave.lines(left..left + fits);
        let mut lines = lines.into_iter();
        let clocks = lines.by_ref().take(self.sim.program().clocks.len()).collect();
        let times = times[left..left + fits].to_vec();
        self.shown = Shown { first, times, column, clocks, nets: lines.collect(), size: (width, nets) };
        self.is_stale = false;
        Ok(())
    }

    /// The first net that is shown, so that the selected one is among them.
    fn first_shown(&self, nets: usize) -> usize {
        let most = self.listed.len().saturating_sub(nets);
        let lowest = (self.selected + 1).saturating_sub(nets);
        self.shown.first.clamp(lowest, self.selected.max(lowest)).min(most)
    }
}
