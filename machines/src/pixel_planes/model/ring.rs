//! The ring: whose turn it is, and what the credit pays for.
//!
//! A station is one that has messages: first the bins of all renderers, then what all renderers have finished.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use tilewright_rtl::pixel_planes::ring as hardware;

use super::timing::RingTiming;

pub(super) struct Ring {
    renderers: usize,
    rate: u64,
    most_credit: u64,
    /// Bits of an instruction, and of a plane.
    bits: [u64; 2],
    /// What is left of the credit in clock `at`, in which nothing was left to be done but what has to wait.
    credit: u64,
    at: u64,
    /// The station that went last.
    last: usize,
    /// Whose line is being sent.
    line_of: Option<usize>,
    /// Who has a message, a bit each.
    asking: u64,
    /// Of those, in the clock that is under way, who has not had a turn.
    open: u64,
    /// Who will have one, and from which clock on.
    later: BinaryHeap<Reverse<(u64, usize)>>,
    pub timing: RingTiming,
}

impl Ring {
    pub fn new(ring: &hardware::Ring, renderers: usize) -> Ring {
        Ring {
            renderers,
            rate: ring.rate().into(),
            most_credit: ring.most_credit().into(),
            bits: [hardware::Ring::INSTRUCTION.into(), ring.plane().into()],
            credit: ring.most_credit().into(),
            at: 0,
            last: 2 * renderers - 1,
            line_of: None,
            asking: 0,
            open: 0,
            later: BinaryHeap::new(),
            timing: RingTiming { rate: ring.rate().into(), ..RingTiming::default() },
        }
    }

    /// The station of a renderer's instructions.
    pub fn instructions_of(&self, renderer: usize) -> usize {
        renderer
    }

    /// The station of a renderer's planes.
    pub fn station_of_planes(&self, renderer: usize) -> usize {
        self.renderers + renderer
    }

    /// The renderer whose planes are sent from a station.
    pub fn planes_of(&self, station: usize) -> Option<usize> {
        station.checked_sub(self.renderers)
    }

    /// A station has its next message from a clock on in which its receiver takes it.
    pub fn ask(&mut self, station: usize, clock: u64) {
        self.later.push(Reverse((clock, station)));
    }

    /// The same of the next plane of the line that is being sent.
    pub fn ask_on(&mut self, renderer: usize, clock: u64) {
        self.line_of = Some(renderer);
        self.ask(self.station_of_planes(renderer), clock);
    }

    /// The line that is being sent is complete.
    pub fn end_line(&mut self) {
        self.line_of = None;
    }

    /// Those that may go: of planes only those of the line that is being sent.
    fn may_go(&self) -> u64 {
        let instructions = (1 << self.renderers) - 1;
        match self.line_of {
            None => self.asking,
            Some(renderer) => self.asking & (instructions | 1 << self.station_of_planes(renderer)),
        }
    }

    /// The first of some stations behind the one that went last.
    fn first(&self, stations: u64) -> usize {
        let behind = stations & (u64::MAX << self.last << 1);
        (if behind == 0 { stations } else { behind }).trailing_zeros() as usize
    }

    fn cost(&self, station: usize) -> u64 {
        self.bits[usize::from(station >= self.renderers)]
    }

    /// The next clock in which a message might go, as far as is known.
    pub fn next(&self) -> Option<u64> {
        let asked = self.later.peek().map(|Reverse((clock, _))| *clock);
        let may_go = self.may_go();
        if may_go == 0 {
            return asked;
        }
        let missing = self.cost(self.first(may_go)).saturating_sub(self.credit);
        let paid = self.at + missing.div_ceil(self.rate).max(1);
        Some(asked.map_or(paid, |asked| asked.min(paid)))
    }

    /// Begins with a clock.
    pub fn begin(&mut self, now: u64) {
        while let Some(&Reverse((_, station))) = self.later.peek().filter(|Reverse((clock, _))| *clock <= now) {
            self.later.pop();
            self.asking |= 1 << station;
        }
        self.credit = (self.credit + self.rate * (now - self.at)).min(self.most_credit);
        self.at = now;
        self.open = self.may_go();
    }

    /// The station whose message goes next in this clock, if there is credit for it.
    pub fn grant(&mut self) -> Option<usize> {
        let station = self.first(self.open);
        if self.open == 0 || self.credit < self.cost(station) {
            return None;
        }
        self.credit -= self.cost(station);
        self.asking &= !(1 << station);
        self.open &= !(1 << station);
        self.last = station;
        self.timing.last = self.at;
        match self.planes_of(station) {
            None => self.timing.instructions += 1,
            Some(_) => {
                // One a clock goes to the frame buffer.
                self.open &= (1 << self.renderers) - 1;
                self.timing.planes += 1;
            }
        }
        self.timing.bits += self.cost(station);
        Some(station)
    }
}
