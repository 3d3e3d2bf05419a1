//! The merger and the global frame buffer: what is sent when, and when the banks change (VC1-TM, VC1-SW2, VC1-SW3, VC1-ACB).
//!
//! After a restart the scan advances for two clocks, and then line by line: a clock a pixel, and an overhead without. So any number of
//! clocks with an advance is a formula, and nothing here goes through a frame.

use tilewright_rtl::gfb::{Passes, SCAN_LATENCY};
use tilewright_rtl::merger::STAGES;
use tilewright_rtl::vc1::Vc1;

use super::timing::{Display, MERGE_PERIOD, PE_PERIOD, crossed, reset_time, seen};

/// The merger and the global frame buffer.
#[derive(Clone, Debug)]
pub(super) struct Merger {
    width: u64,
    overhead: u64,
    pixels: u64,
    /// T_m in its clocks.
    merge_clocks: u64,
    /// Advances until all is stored.
    way: u64,
    /// Those that end a frame.
    processors: u32,
    pub display: Display,
    /// The edge of the last restart.
    restart: u64,
    /// How often the banks have changed, or will have as soon as all that is known comes to pass.
    pub shown: u32,
    /// The clock of the processing elements from which on they know of the last change.
    pub shown_from: u64,
    /// Processing elements that have ended the frame, and the first clock in which all that have are known.
    ended: u32,
    all_ended: u64,
    multipass: Option<Multipass>,
}

/// Pictures of several passes.
#[derive(Clone, Debug)]
struct Multipass {
    passes: u32,
    /// Of the next frame.
    number: u32,
    /// The first clock in which the banks may change again.
    free: u64,
}

/// When a frame is shown, in edges of the processing elements' clock at which it is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Showing {
    pub merged: u64,
    pub shown: u64,
    /// The merger's edge.
    pub edge: u64,
    pub refresh: u64,
    /// The blanking before the first refresh of an average, if this frame is the last pass of a picture.
    pub averaged: Option<u64>,
}

impl Merger {
    pub fn new(vc1: &Vc1, processors: u32, passes: Option<Passes>) -> Merger {
        let sequencer = vc1.gfb().sequencer();
        let screen = sequencer.screen;
        Merger {
            width: screen.width.into(),
            overhead: sequencer.overhead.into(),
            pixels: screen.pixels().into(),
            merge_clocks: sequencer.merge_clocks(),
            way: vc1.gfb_swap().way.into(),
            processors,
            display: Display::new(vc1),
            restart: reset_time(vc1) / MERGE_PERIOD + 1,
            shown: 0,
            shown_from: 0,
            ended: 0,
            all_ended: 0,
            multipass: passes.map(|passes| Multipass { passes: passes.count(), number: 0, free: 0 }),
        }
    }

    /// The clocks with an advance from the restart until that clock, which is one of them.
    fn advances(&self, clock: u64) -> u64 {
        let first = u64::from(SCAN_LATENCY);
        let clocks = clock.saturating_sub(self.restart);
        let lines = clocks.saturating_sub(first);
        let period = self.width + self.overhead;
        clocks.min(first) + lines / period * self.width + (lines % period).min(self.width)
    }

    /// The clock of the so many-th advance since the restart.
    fn clock_of(&self, advance: u64) -> u64 {
        let first = u64::from(SCAN_LATENCY);
        match advance.checked_sub(first + 1) {
            None => self.restart + advance,
            Some(pixel) => {
                self.restart + first + 1 + pixel / self.width * (self.width + self.overhead) + pixel % self.width
            }
        }
    }

    /// The first clock in which a processing element that swaps at that edge knows that its back buffer is sent.
    pub fn sent(&self, processor: u32, swap: u64) -> u64 {
        let merger = crossed(swap * PE_PERIOD, MERGE_PERIOD);
        // The scan counter passes over the rest of a frame first.
        let armed = u64::from(STAGES * processor);
        let last = self.advances(merger).max(armed) + self.pixels + u64::from(SCAN_LATENCY);
        let sent = self.clock_of(last) + 1;
        crossed(sent * MERGE_PERIOD, PE_PERIOD) + 1
    }

    /// A processing element ends its frame with a swap at that edge; if it is the last one, that says when the frame is shown.
    pub fn end(&mut self, swap: u64) -> Option<Showing> {
        let known = crossed(swap * PE_PERIOD, MERGE_PERIOD) + 2;
        self.all_ended = self.all_ended.max(known);
        self.ended += 1;
        (self.ended == self.processors).then(|| self.show())
    }

    fn show(&mut self) -> Showing {
        let all = std::mem::take(&mut self.all_ended);
        self.ended = 0;
        let stored = self.clock_of(self.advances(all - 1) + self.way) + 1;
        let merged = stored.max(all + self.merge_clocks);
        let free = self.multipass.as_ref().map_or(0, |it| it.free);
        let edge = self.display.open_from(merged.max(free));
        self.restart = edge;
        self.shown += 1;
        let time = edge * MERGE_PERIOD;
        self.shown_from = crossed(time, PE_PERIOD) + 1;
        let averages = self.multipass.as_mut().and_then(|it| it.swap(edge, self.pixels, &self.display));
        let shown = seen(time);
        Showing {
            merged: seen((merged - 1) * MERGE_PERIOD),
            shown,
            edge,
            refresh: self.display.refresh_at(shown * PE_PERIOD),
            averaged: averages.map(|edge| self.display.dawn_from(seen(edge * MERGE_PERIOD)).0),
        }
    }
}

impl Multipass {
    /// The banks change; if they bring the last pass, that is the edge at which its average comes on display.
    fn swap(&mut self, edge: u64, pixels: u64, display: &Display) -> Option<u64> {
        self.number += 1;
        // A sum is busy for a clock more than there are pixels.
        let summed = edge + pixels + 2;
        if self.number < self.passes {
            self.free = summed;
            return None;
        }
        self.number = 0;
        let averages = display.open_from(summed);
        self.free = display.closed_from(averages + 1) + 1;
        Some(averages)
    }
}
