//! The times of the merger and the global frame buffer: sent pixels and changes of the banks (VC1-TM, VC1-SW2, VC1-SW3, VC1-ACB).
//!
//! After a restart the scan advances for two clocks, and then line by line: one clock a pixel, then an overhead without advances. So a formula gives
//! the number of advances, and the model does not step through a frame.

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
    /// Advances until all pixels are stored.
    way: u64,
    /// Advances at the end of a frame.
    processors: u32,
    pub display: Display,
    /// The edge of the last restart.
    restart: u64,
    /// The number of changes of the banks, including known future ones.
    pub shown: u32,
    /// The clock from which on the processing elements know of the last change.
    pub shown_from: u64,
    /// The number of processing elements that have ended the frame, and the first clock in which all these are known.
    ended: u32,
    all_ended: u64,
    multipass: Option<Multipass>,
}

/// Pictures of several passes.
#[derive(Clone, Debug)]
struct Multipass {
    passes: u32,
    /// The pass of the next frame.
    number: u32,
    /// The first clock in which the banks may change again.
    free: u64,
}

/// The times at which a frame is shown, in edges of the processing elements' clock.
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

    /// The number of advances from the restart to that clock, including it.
    fn advances(&self, clock: u64) -> u64 {
        let first = u64::from(SCAN_LATENCY);
        let clocks = clock.saturating_sub(self.restart);
        let lines = clocks.saturating_sub(first);
        let period = self.width + self.overhead;
        clocks.min(first) + lines / period * self.width + (lines % period).min(self.width)
    }

    /// The clock of the n-th advance since the restart.
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
        // The scan counter first skips the rest of a frame.
        let armed = u64::from(STAGES * processor);
        let last = self.advances(merger).max(armed) + self.pixels + u64::from(SCAN_LATENCY);
        let sent = self.clock_of(last) + 1;
        crossed(sent * MERGE_PERIOD, PE_PERIOD) + 1
    }

    /// A processing element ends its frame with a swap at that edge. After the last one, returns the times at which the frame is shown.
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
    /// Changes the banks. For the last pass, returns the edge at which its average is displayed.
    fn swap(&mut self, edge: u64, pixels: u64, display: &Display) -> Option<u64> {
        self.number += 1;
        // A sum takes one clock more than the number of pixels.
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
