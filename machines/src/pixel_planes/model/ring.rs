//! The ring: which message goes next, and the credit of bits.
//!
//! A station is a source of messages: first the bins of all renderers, then the finished planes of all renderers.

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
    /// The rest of the credit in clock `at`, in which all remaining messages had to wait.
    credit: u64,
    at: u64,
    /// The station that went last.
    last: usize,
    /// The station whose line is being sent.
    line_of: Option<usize>,
    /// The stations with a message, a bit each.
    asking: u64,
    /// Those of them that were not served in the current clock.
    open: u64,
    /// The stations that will have a message, and the first clock of that.
    later: BinaryHeap<Reverse<(u64, usize)>>,
    pub timing: RingTiming,
}

impl Ring {
    pub fn new(ring: &hardware::Ring, renderers: usize) -> Ring {
        Ring {
            renderers,
            rate: ring.rate.into(),
            most_credit: ring.most_credit().into(),
            bits: [hardware::Ring::INSTRUCTION.into(), ring.side.into()],
            credit: ring.most_credit().into(),
            at: 0,
            last: 2 * renderers - 1,
            line_of: None,
            asking: 0,
            open: 0,
            later: BinaryHeap::new(),
            timing: RingTiming { rate: ring.rate.into(), ..RingTiming::default() },
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

    /// Gives a station its next message, from the clock on in which its receiver takes it.
    pub fn ask(&mut self, station: usize, clock: u64) {
        self.later.push(Reverse((clock, station)));
    }

    /// The same for the next plane of the line that is being sent.
    pub fn ask_on(&mut self, renderer: usize, clock: u64) {
        self.line_of = Some(renderer);
        self.ask(self.station_of_planes(renderer), clock);
    }

    /// Ends the line that is being sent.
    pub fn end_line(&mut self) {
        self.line_of = None;
    }

    /// The messages that may go; during a line, only its planes among all planes.
    fn may_go(&self) -> u64 {
        let instructions = (1 << self.renderers) - 1;
        match self.line_of {
            None => self.asking,
            Some(renderer) => self.asking & (instructions | 1 << self.station_of_planes(renderer)),
        }
    }

    /// The first of some stations after the one that was served last.
    fn first(&self, stations: u64) -> usize {
        let behind = stations & (u64::MAX << self.last << 1);
        (if behind == 0 { stations } else { behind }).trailing_zeros() as usize
    }

    fn cost(&self, station: usize) -> u64 {
        self.bits[usize::from(station >= self.renderers)]
    }

    /// The next clock in which a message may go, as far as it is known.
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

    /// Begins a clock.
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
                // One plane a clock goes to the frame buffer.
                self.open &= (1 << self.renderers) - 1;
                self.timing.planes += 1;
            }
        }
        self.timing.bits += self.cost(station);
        Some(station)
    }
}
