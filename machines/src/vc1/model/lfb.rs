//! A local frame buffer unit: when it takes an access, gives a page, overflows (VC1-ACC, VC1-PT, VC1-PIG).
//!
//! A look-up is read and examined, which are two clocks, and found in the third one; a page is given in a clock of its own before that.
//! From the clock in which it is found on the next one is accepted. The image memory takes three clocks more, and has no say in it.

use super::timing::{MERGE_PERIOD, PE_PERIOD, crossed};

/// Clocks in which the image memory draws a pixel that is found.
const DRAW_CLOCKS: u64 = 3;
/// Clocks from a clear until another access to the table.
pub(super) const CLEAR_CLOCKS: u64 = 3;

/// A local frame buffer unit.
#[derive(Clone, Debug)]
pub(super) struct Lfb {
    /// By patch, a bit: it has a page.
    resident: Vec<u64>,
    pages: u32,
    pub used: u32,
    /// The first clock in which the next look-up is accepted, if none is held.
    ready: u64,
    /// The first clock in which the table is not being cleared, and the scan has left the buffer.
    free: u64,
    /// The patch of a look-up that finds no page.
    held: Option<u32>,
    /// The edge at which the swap control takes notice of that.
    pub overflows: Option<u64>,
}

impl Lfb {
    pub fn new(patches: u32, pages: u32) -> Lfb {
        let resident = vec![0; patches.div_ceil(64) as usize];
        Lfb { resident, pages, used: 0, ready: 0, free: 0, held: None, overflows: None }
    }

    /// The edge at which it takes a pixel that stands at its port from that clock on; never, while one is held.
    pub fn takes_draw(&self, clock: u64) -> u64 {
        if self.held.is_some() { u64::MAX } else { clock.max(self.ready) }
    }

    /// The edge at which it takes a clear that stands at its port from that clock on.
    pub fn takes_clear(&self, clock: u64) -> u64 {
        clock.max(self.free)
    }

    /// It takes a pixel of that patch.
    pub fn draw(&mut self, edge: u64, patch: u32) {
        self.look_up(edge + 1, patch);
    }

    /// A look-up is read from that clock on.
    fn look_up(&mut self, clock: u64, patch: u32) {
        let examined = clock.max(self.free) + 1;
        let (place, bit) = (patch as usize / 64, 1 << (patch % 64));
        if self.resident[place] & bit != 0 {
            self.ready = examined + 1;
        } else if self.used < self.pages {
            self.resident[place] |= bit;
            self.used += 1;
            self.ready = examined + 2;
        } else {
            self.held = Some(patch);
            self.overflows = Some(examined + 1);
        }
    }

    /// It takes a clear.
    pub fn clear(&mut self, edge: u64) {
        self.free = edge + CLEAR_CLOCKS;
    }

    /// With the last clear: what is held is tried again.
    pub fn resume(&mut self, edge: u64) {
        if let Some(patch) = self.held.take() {
            self.look_up(edge + 1, patch);
        }
    }

    /// The buffers are swapped. The merger follows, and then the processor's side knows that it has.
    pub fn swap(&mut self, edge: u64) {
        self.resident.fill(0);
        (self.used, self.overflows) = (0, None);
        let merger = crossed(edge * PE_PERIOD, MERGE_PERIOD);
        self.free = self.free.max(crossed(merger * MERGE_PERIOD, PE_PERIOD) + 1);
    }

    /// The first clock in which nothing is under way; what is held is not looked at.
    pub fn idle_from(&self) -> u64 {
        self.ready + 1 + DRAW_CLOCKS
    }
}
