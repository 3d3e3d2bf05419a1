//! The times of a local frame buffer unit: accesses, pages, overflows (VC1-ACC, VC1-PT, VC1-PIG).
//!
//! A look-up takes two clocks, for reading and examining, and is found in the third one. A new page takes an additional clock before that. The
//! next look-up is accepted from the clock on in which this one is found. The image memory takes three clocks more, without influence on this.

use super::timing::{MERGE_PERIOD, PE_PERIOD, crossed};

/// Clocks of the image memory for a found pixel.
const DRAW_CLOCKS: u64 = 3;
/// Clocks from a clear until another access to the table.
pub(super) const CLEAR_CLOCKS: u64 = 3;

/// A local frame buffer unit.
#[derive(Clone, Debug)]
pub(super) struct Lfb {
    /// A bit for each patch with a page.
    resident: Vec<u64>,
    pages: u32,
    pub used: u32,
    /// The first clock in which the next look-up is accepted, if no pixel waits for a page.
    ready: u64,
    /// The first clock in which the table is cleared, and the scan has left the buffer.
    free: u64,
    /// The patch of a look-up without a page.
    held: Option<u32>,
    /// The edge at which the swap control sees that.
    pub overflows: Option<u64>,
}

impl Lfb {
    pub fn new(patches: u32, pages: u32) -> Lfb {
        let resident = vec![0; patches.div_ceil(64) as usize];
        Lfb { resident, pages, used: 0, ready: 0, free: 0, held: None, overflows: None }
    }

    /// The edge at which it takes a pixel that is at its port from that clock on; never while another one waits for a page.
    pub fn takes_draw(&self, clock: u64) -> u64 {
        if self.held.is_some() { u64::MAX } else { clock.max(self.ready) }
    }

    /// The edge at which it takes a clear that is at its port from that clock on.
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

    /// After the last clear the waiting pixel is tried again.
    pub fn resume(&mut self, edge: u64) {
        if let Some(patch) = self.held.take() {
            self.look_up(edge + 1, patch);
        }
    }

    /// Swaps the buffers. The merger follows, and then the processor's side knows it.
    pub fn swap(&mut self, edge: u64) {
        self.resident.fill(0);
        (self.used, self.overflows) = (0, None);
        let merger = crossed(edge * PE_PERIOD, MERGE_PERIOD);
        self.free = self.free.max(crossed(merger * MERGE_PERIOD, PE_PERIOD) + 1);
    }

    /// The first clock in which no access is in progress; a waiting pixel does not count.
    pub fn idle_from(&self) -> u64 {
        self.ready + 1 + DRAW_CLOCKS
    }
}
