//! The simulated hardware of a VC-1, from its programs' side.
//!
//! Programs see the ports of the local frame buffer units and of the bus, the signals of the swap control, the display, and time.

use std::collections::VecDeque;

use tilewright_rtl::clocks::{CRT, MERGE, PE};
use tilewright_rtl::gfb::{BLANK_LINES, Multipass, Passes};
use tilewright_rtl::swap::SwapState;
use tilewright_rtl::vc1::{Vc1, Vc1In, Vc1Out};
use tilewright_scenes::frame::blank;
use tilewright_sim::{Port, Simulation};

use super::edges::Edges;
use super::notes::{Handshakes, Notes};
use super::ports::Ports;
use super::processor::{Edge, Now, Processor};
use super::way::Following;
use super::words::Word;
use crate::error::Error;

/// The memory of the global frame buffer: each pixel's words in both banks.
const BANKS: &str = "u_gfb.banks";
/// Whether the average of a picture's passes is shown.
const AVERAGES: &str = "u_gfb.u_multipass.averages";

/// The running hardware.
pub(crate) struct Hardware {
    pub sim: Simulation<Vc1In, Vc1Out>,
    /// By processing element, the signals at its ports.
    pub(super) ports: Vec<Ports>,
    /// By processing element, the edge until which it computes and ignores its ports.
    acts_at: Vec<u64>,
    /// Processing elements whose ports may matter in the coming clock; a field to save an allocation.
    acting: Vec<usize>,
    /// Pages of image memory in each buffer.
    pages: u64,
    /// The host's offer to the bus, and the signals at its port.
    pub(super) command: Option<Word>,
    pub(super) command_port: Option<Word>,
    /// Pixels and words that the host still has to write into the displayed bank; the first one is at its port.
    writes: VecDeque<(u32, u64)>,
    /// The events.
    pub notes: Notes,
    /// What follows a pixel, if one is followed.
    pub following: Option<Box<Following>>,
    /// The number of clocks since any processing element did something, so that all ports are idle.
    idle: u64,
    /// Idle clocks that the processing elements still have to count.
    slept: u64,
    /// The number of clocks after which the bus is empty.
    bus_clocks: u64,
    /// Bits to flip in the last word of each packet on the bus, for a test that the words are drawn.
    #[cfg(test)]
    pub flips: u32,
    pe: Edges,
    merge: Edges,
    crt: Edges,
    /// The ends of the vertical blankings.
    dawn: Edges,
    /// Whether one ended in the last clock.
    dawns: bool,
    /// The clocks of a line of the display, and of a refresh.
    line_clocks: u64,
    refresh_clocks: u64,
    /// T_m in clocks of the merger (VC1-TM).
    pub merge_clocks: u64,
}

impl Hardware {
    pub fn new(machine: &Vc1) -> Result<Hardware, Error> {
        let sim = Simulation::of(machine)?;
        let gfb = machine.gfb();
        let (line_clocks, refresh_clocks) = (gfb.read_out().line_clocks(), gfb.read_out().refresh_clocks());
        let refresh = refresh_clocks * machine.display.period.picoseconds();
        Ok(Hardware {
            ports: vec![Ports::default(); sim.i.processors.len()],
            acts_at: vec![0; sim.i.processors.len()],
            acting: Vec::new(),
            pages: machine.lfb.pages.into(),
            command: None,
            command_port: None,
            writes: VecDeque::new(),
            notes: Notes::new(gfb.screen.width),
            following: None,
            idle: 0,
            slept: 0,
            bus_clocks: u64::from(4 * machine.word_clocks + 16),
            #[cfg(test)]
            flips: 0,
            pe: Edges::after(0, PE.period.picoseconds()),
            merge: Edges::after(0, MERGE.period.picoseconds()),
            crt: Edges::after(0, machine.display.period.picoseconds()),
            dawn: Edges::after(0, refresh),
            dawns: false,
            line_clocks,
            refresh_clocks,
            merge_clocks: gfb.sequencer().merge_clocks(),
            sim,
        })
    }

    /// Resets everything. Uncovered pixels get that colour, and pictures have that number of passes.
    pub fn reset(&mut self, background: [u8; 3], passes: Option<Passes>) -> Result<(), Error> {
        self.sim.set(self.sim.i.host.background, blank(background));
        self.sim.set(self.sim.i.ready, true);
        if let (Some(port), Some(passes)) = (self.sim.i.host.multipass.first().copied(), passes) {
            let said = Multipass::pictures_of(passes);
            self.sim.set(port.accumulates, said.accumulates);
            self.sim.set(port.passes, said.passes);
        }
        self.sim.try_reset()?;
        self.pe = Edges::after(self.cycles(PE), self.pe.period);
        self.merge = Edges::after(self.cycles(MERGE), self.merge.period);
        let clocks = self.cycles(CRT);
        self.crt = Edges::after(clocks, self.crt.period);
        // The display begins in its blanking. Half a line before its end, the banks have been stable for more than a line.
        let dawn = clocks + u64::from(BLANK_LINES) * self.line_clocks - self.line_clocks / 2;
        self.dawn.next = dawn * self.crt.period;
        if let Some(following) = &mut self.following {
            following.begins(clocks);
        }
        Ok(())
    }

    /// Simulates a clock of the processing elements, with the edges of the other clocks in it. The display's colours in it go to `display`, if
    /// that is given. Returns whether the sync line is high because all have drawn.
    pub fn clock(&mut self, processors: &mut [Processor], display: Option<&mut Vec<u32>>) -> Result<bool, Error> {
        // Once the line is high, only a command changes it.
        let is_idle = self.command.is_none() && (self.idle > 1 || processors.iter().all(Processor::is_idle));
        self.idle = if is_idle { self.idle + 1 } else { 0 };
        if self.idle > 1 {
            self.follow(processors, &[]);
            self.advance(display)?;
            self.slept += 1;
            return Ok(false);
        }
        let slept = std::mem::take(&mut self.slept);
        if slept > 0 {
            processors.iter_mut().for_each(|it| it.pass(slept));
        }
        self.present_command();
        let coming = self.edge() + 1;
        let mut acting = std::mem::take(&mut self.acting);
        acting.clear();
        acting.extend((0..processors.len()).filter(|&k| self.acts_at[k] <= coming));
        acting.iter().for_each(|&k| self.present(k, &processors[k]));
        acting.retain(|&k| !self.goes_ahead(k, &mut processors[k], coming));
        for &k in &acting {
            (self.ports[k].taken, self.ports[k].sent) = (self.takes(k), self.sends(k));
        }
        let command = self.command.is_some() && self.flag(self.sim.i.command.ready);
        let line = processors.iter().all(Processor::done) && self.flag(self.sim.o.line);
        self.follow(processors, &acting);
        self.advance(display)?;
        if command && let Some(word) = self.command.take() {
            if let Some(following) = &mut self.following {
                following.host(coming, word);
            }
            self.notes.bus(coming, processors.len() as u32, word);
        }
        acting.iter().for_each(|&k| self.see(k, &mut processors[k], coming));
        self.acting = acting;
        Ok(line)
    }

    /// Lets a processing element compute ahead, if it does not see its ports meanwhile. Returns whether it does.
    fn goes_ahead(&mut self, number: usize, processor: &mut Processor, coming: u64) -> bool {
        let computes = matches!(processor.now(), Now::Computing(..)) && !self.may_overflow(number);
        let clocks = if computes { processor.compute_ahead() } else { 0 };
        self.acts_at[number] = coming + clocks;
        clocks > 0
    }

    /// Whether the access in progress in a local frame buffer may find no page. At most one look-up is in progress.
    fn may_overflow(&mut self, number: usize) -> bool {
        let port = self.sim.o.processors[number];
        self.sim.get_u64(port.pages_used) == self.pages && !self.flag(port.idle)
    }

    /// Shows a processing element its ports after an edge.
    fn see(&mut self, number: usize, processor: &mut Processor, clock: u64) {
        let port = self.sim.o.processors[number];
        let may = SwapState::of_code(self.sim.get_u64(port.state));
        let front = self.flag(port.received.valid).then(|| Word {
            word: self.sim.get_u64(port.received.word) as u32,
            last: self.sim.get_u64(port.received.last) == 1,
        });
        #[cfg(test)]
        let front = front.map(|it| Word { word: if it.last { it.word ^ self.flips } else { it.word }, ..it });
        let Ports { access, sends, taken, sent, .. } = self.ports[number];
        let (before, ended, receives) = (processor.may(), processor.done(), processor.receives());
        let received = processor.front().filter(|_| receives);
        processor.edge(Edge { taken, sent, may, front });
        let handshakes = Handshakes {
            taken: access.filter(|_| taken),
            sent: sends.filter(|_| sent),
            received,
            may: [before, may],
            ends: processor.done() && !ended,
        };
        if let Some(following) = &mut self.following {
            following.processor(&mut self.sim, clock, number as u32, &handshakes);
        }
        self.notes.processor(clock, number as u32, handshakes);
    }

    /// Shows the coming edge to what follows a pixel. Those processing elements look at their ports.
    fn follow(&mut self, processors: &[Processor], acting: &[usize]) {
        let Some(following) = &mut self.following else { return };
        let is_done = self.command.is_none() && processors.iter().all(Processor::done);
        let taken = acting.iter().filter(|&&k| self.ports[k].taken);
        let taken = taken.filter_map(|&k| Some((k, self.ports[k].access?)));
        following.before(&mut self.sim, self.pe.last() + 1, is_done, taken);
    }

    /// The last edge of the processing elements' clock, counted from 1 at power-on.
    pub fn edge(&self) -> u64 {
        self.pe.last()
    }

    /// Advances through clocks in which only the swap control works, at most this number and none after that time. Returns their number, which is
    /// 0 unless all have been idle for some clocks.
    pub fn rest(&mut self, clocks: u64, until: u64) -> Result<u64, Error> {
        if self.idle < self.bus_clocks {
            return Ok(0);
        }
        let clocks = self.pass(clocks, until)?;
        self.slept += clocks;
        Ok(clocks)
    }

    /// The same for clocks in which all processing elements compute ahead.
    pub fn compute(&mut self, clocks: u64, until: u64) -> Result<u64, Error> {
        let acts_at = self.acts_at.iter().copied().min().unwrap_or(0);
        let ahead = acts_at.saturating_sub(self.edge() + 1);
        if ahead == 0 || self.command.is_some() || self.command_port.is_some() {
            return Ok(0);
        }
        self.pass(clocks.min(ahead), until)
    }

    /// Advances through clocks in which no port matters, none of them after the next blanking. Returns their number.
    fn pass(&mut self, clocks: u64, until: u64) -> Result<u64, Error> {
        let until = until.min(self.dawn.next - 1);
        let clocks = clocks.min(until.saturating_sub(self.time()) / self.pe.period);
        let is_followed = self.following.as_ref().is_some_and(|it| it.is_busy());
        if !self.writes.is_empty() || clocks == 0 || is_followed {
            return Ok(0);
        }
        let end = self.pe.next + (clocks - 1) * self.pe.period;
        if let Some(following) = &mut self.following {
            // It looks at every clock of the merger.
            while self.merge.next <= end {
                self.sim.try_run_to(self.merge.next)?;
                self.merge.next += self.merge.period;
                following.merger(&mut self.sim, self.merge.last());
            }
        }
        self.sim.try_run_to(end)?;
        for edges in [&mut self.pe, &mut self.merge, &mut self.crt] {
            edges.came(end);
        }
        Ok(clocks)
    }

    /// The earliest time of the next change of the banks: a line before the blanking begins.
    pub fn next_blanking(&self) -> u64 {
        self.dawn.next.saturating_sub(u64::from(BLANK_LINES + 1) * self.line_clocks * self.crt.period)
    }

    /// Advances through the next edge of the processing elements' clock, and through those of other clocks before it.
    fn advance(&mut self, display: Option<&mut Vec<u32>>) -> Result<(), Error> {
        let end = self.pe.next;
        if let Some(colours) = display {
            while self.crt.next <= end {
                // With the display's usual slow clock there is at most one edge here, and its pixel stays until the end.
                let until = if self.crt.period < self.pe.period { self.crt.next } else { end };
                self.sim.try_run_to(until)?;
                self.crt.next += self.crt.period;
                if let Some(following) = &mut self.following {
                    following.display(&mut self.sim, self.crt.last());
                }
                if self.flag(self.sim.o.pixel.valid) {
                    colours.push(self.sim.get_u64(self.sim.o.pixel.rgb) as u32);
                }
            }
        } else {
            self.crt.came(end);
        }
        self.pe.next += self.pe.period;
        self.sim.try_run_to(end)?;
        self.dawns = self.dawn.came(end);
        if self.merge.came(end) {
            if let Some(following) = &mut self.following {
                following.merger(&mut self.sim, self.merge.last());
            }
            if self.writes.pop_front().is_some() {
                self.present_write();
            }
            let (shown, first_round) = (self.shown(), self.flag(self.sim.o.view.first_round));
            self.notes.merger(self.merge.last(), shown, first_round);
        }
        Ok(())
    }

    /// Puts the next of the host's writes at its port.
    fn present_write(&mut self) {
        let port = self.sim.i.host.accesses;
        let write = self.writes.front();
        if let Some(&(address, word)) = write {
            self.sim.set(port.address, address);
            self.sim.set(port.word, word);
            self.sim.set(port.writes, true);
        }
        self.sim.set(port.valid, write.is_some());
    }

    /// Writes pixels into the displayed bank, one in each clock of the merger. The rest of earlier pixels is not written.
    pub fn write(&mut self, words: impl Iterator<Item = (u32, u64)>) {
        self.writes.clear();
        self.writes.extend(words);
        self.present_write();
    }

    /// Whether all pixels are written.
    pub fn has_written(&self) -> bool {
        self.writes.is_empty()
    }

    /// Whether a blanking ended in the last clock, so that the display continues with the current content of its bank.
    pub fn dawns(&self) -> bool {
        self.dawns
    }

    /// Whether the display shows the average of a picture's passes.
    pub fn averages(&mut self) -> bool {
        !self.sim.i.host.multipass.is_empty() && self.sim.peek(AVERAGES).expect("the control has that output") == 1
    }

    /// Pages taken in the front buffer.
    pub fn pages_used(&mut self, processor: usize) -> u32 {
        self.sim.get_u64(self.sim.o.processors[processor].pages_used) as u32
    }

    /// Whether a frame is stored in the global frame buffer, and waits for the blanking.
    pub fn is_merged(&mut self) -> bool {
        self.flag(self.sim.o.is_merged)
    }

    /// A signal that toggles with each displayed frame.
    pub fn shown(&mut self) -> bool {
        self.flag(self.sim.o.shown)
    }

    /// The words of the displayed bank, row by row from the upper left.
    pub fn displayed(&mut self) -> Vec<u64> {
        let bank = u8::from(!self.shown());
        let words = self.sim.peek_words(&format!("{BANKS}[{bank}]")).expect("the banks have that name");
        words.iter().map(|word| word.to_u64().expect("a word has 48 bits")).collect()
    }

    /// T_m in picoseconds.
    pub fn merge_time(&self) -> u64 {
        self.merge_clocks * self.merge.period
    }

    /// The time of a whole frame from its swap on, in picoseconds, with some to spare.
    pub fn frame_time(&self) -> u64 {
        4 * self.merge_time() + 4 * self.refresh_clocks * self.crt.period
    }

    /// Simulated picoseconds.
    pub fn time(&self) -> u64 {
        self.sim.time()
    }

    /// The current refresh of the display; each begins with its blanking.
    pub fn refresh(&self) -> u64 {
        self.cycles(CRT) / self.refresh_clocks
    }

    fn cycles(&self, clock: impl AsRef<str>) -> u64 {
        self.sim.cycles(clock).expect("the VC-1 has that clock")
    }

    pub(super) fn flag(&mut self, port: Port) -> bool {
        self.sim.get_u64(port) != 0
    }
}
