//! What happens in a machine, and where: the events of which circuit and model have to have the same.

use super::timing::{MERGE_PERIOD, PE_PERIOD};

/// Something that happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// The edge at which it happened, counted from 1 at power-on: of the merger's clock for what the merger does, else of the
    /// processing elements'. [`Event::picoseconds`] is when that was.
    pub clock: u64,
    /// Where it happened.
    pub place: Place,
    /// What happened.
    pub what: What,
}

impl Event {
    /// Picoseconds of a clock of the processing elements.
    pub const PE_PERIOD: u64 = PE_PERIOD;

    /// When it happened, in simulated picoseconds.
    pub fn picoseconds(&self) -> u64 {
        match self.place {
            Place::Processor(_) | Place::Bus => self.clock * PE_PERIOD,
            Place::Merger => self.clock * MERGE_PERIOD,
        }
    }
}

/// A part of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// A processing element with its local frame buffer, by number.
    Processor(u32),
    /// The broadcast bus.
    Bus,
    /// The global frame buffer, which leads the merger.
    Merger,
}

/// What happens at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A local frame buffer takes a pixel, of that number in raster order.
    Draws(u32),
    /// A local frame buffer takes the clearing of that entry of its patch table.
    Clears(u32),
    /// A processing element takes that word from its queue.
    Receives(u32),
    /// The program has drawn its frame, and says so to the sync line.
    Ends,
    /// The sync line is high: the swap at the end of the frame is due.
    Due,
    /// All pages are taken, and a pixel waits for one.
    Overflows,
    /// A local frame buffer swaps.
    Swaps,
    /// The patch table is cleared: drawing begins, or goes on with the pixel that waits.
    Resumes,
    /// The bus takes a word of that sender; the host's number is that of the processing elements.
    Carries(u32, u32),
    /// The scan of the merger begins again with the first pixel, for another frame.
    Restarts,
    /// The banks of the global frame buffer change, for the so many-th time.
    Shows(u32),
}
