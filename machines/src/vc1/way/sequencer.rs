//! The sequencer of the scan, in plain software: the same outputs from the same restarts.

use tilewright_rtl::gfb::SCAN_LATENCY;
use tilewright_rtl::vc1::Vc1;

/// The part of the scan that it is in.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Restart,
    Prime,
    Line,
    Overhead,
}

/// The state of the sequencer.
pub(super) struct Sequencer {
    width: u32,
    pixels: u32,
    overhead: u32,
    way: u32,
    part: Part,
    /// Pixels of the line that have entered.
    column: u32,
    left: u32,
    /// Pixels that have entered since the restart, and that were stored.
    fed: u64,
    way_left: u32,
    stored: u64,
}

/// Its outputs in a clock, each with its name.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Scan {
    pub restart: bool,
    pub enable: bool,
    pub feed: u32,
    pub blank: bool,
    pub stores: bool,
    pub store: u32,
}

impl Scan {
    /// The names of the outputs in the hardware.
    pub const NETS: [&str; 6] = ["scan_restart", "scan_enable", "feed", "blank", "stores", "store"];

    /// The hardware's, from these values of the nets.
    pub fn seen([restart, enable, feed, blank, stores, store]: [u64; 6]) -> Scan {
        let ([restart, enable, blank, stores], [feed, store]) =
            ([restart, enable, blank, stores].map(|bit| bit == 1), [feed, store].map(|number| number as u32));
        Scan { restart, enable, feed, blank, stores, store }
    }

    /// Its values by name.
    pub fn values(&self) -> [(&'static str, u32); 6] {
        let Scan { restart, enable, feed, blank, stores, store } = *self;
        let values = [restart.into(), enable.into(), feed, blank.into(), stores.into(), store];
        std::array::from_fn(|at| (Scan::NETS[at], values[at]))
    }
}

impl Sequencer {
    /// One in its reset.
    pub fn new(machine: &Vc1) -> Sequencer {
        let (screen, way) = (machine.lfb.patches.screen(), SCAN_LATENCY + machine.gfb().sequencer().chain());
        Sequencer {
            width: screen.width,
            pixels: screen.pixels(),
            overhead: machine.overhead,
            way,
            part: Part::Restart,
            column: 0,
            left: 0,
            fed: 0,
            way_left: way,
            stored: 0,
        }
    }

    /// Its outputs in this clock, in which it is told to restart or not.
    pub fn scan(&self, restart: bool) -> Scan {
        let enable = matches!(self.part, Part::Prime | Part::Line);
        let pixels = u64::from(self.pixels);
        Scan {
            restart: restart || self.part == Part::Restart,
            enable,
            feed: (self.fed % pixels) as u32,
            blank: self.fed < pixels,
            stores: enable && self.way_left == 0,
            store: (self.stored % pixels) as u32,
        }
    }

    /// An edge of the clock.
    pub fn edge(&mut self, restart: bool) {
        let Scan { restart, enable, stores, .. } = self.scan(restart);
        if restart {
            (self.part, self.left, self.column) = (Part::Prime, SCAN_LATENCY - 1, 0);
            (self.fed, self.way_left, self.stored) = (0, self.way, 0);
            return;
        }
        (self.fed, self.stored) = (self.fed + u64::from(enable), self.stored + u64::from(stores));
        self.way_left -= u32::from(enable && self.way_left > 0);
        match self.part {
            Part::Line if self.column + 1 == self.width => {
                (self.part, self.left, self.column) = (Part::Overhead, self.overhead - 1, 0);
            }
            Part::Line => self.column += 1,
            Part::Prime | Part::Overhead if self.left == 0 => self.part = Part::Line,
            Part::Prime | Part::Overhead => self.left -= 1,
            Part::Restart => {}
        }
    }
}
