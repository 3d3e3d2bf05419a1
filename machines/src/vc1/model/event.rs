//! The events of a machine, which have to be equal in circuit and model.

use super::timing::{MERGE_PERIOD, PE_PERIOD};

/// An event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// The edge at which it happened, counted from 1 at power-on. Events of the merger have edges of its clock, all others those of the
    /// processing elements' clock. [`Event::picoseconds`] gives the time.
    pub clock: u64,
    /// The place.
    pub place: Place,
    /// The kind, with its data.
    pub what: What,
}

impl Event {
    /// Picoseconds of a clock of the processing elements.
    pub const PE_PERIOD: u64 = PE_PERIOD;

    /// The time in simulated picoseconds.
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

/// A kind of event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A local frame buffer takes a pixel, of that number in raster order.
    Draws(u32),
    /// A local frame buffer takes the clearing of that entry of its patch table.
    Clears(u32),
    /// A processing element takes that word from its queue.
    Receives(u32),
    /// The program has drawn its frame, and releases the sync line.
    Ends,
    /// The sync line is high: the swap at the end of the frame is due.
    Due,
    /// All pages are taken, and a pixel waits for one.
    Overflows,
    /// A local frame buffer swaps.
    Swaps,
    /// The patch table is cleared: drawing begins, or continues with the waiting pixel.
    Resumes,
    /// The bus takes a word of that sender; the host's number is the count of processing elements.
    Carries(u32, u32),
    /// The scan of the merger restarts with the first pixel, for another frame.
    Restarts,
    /// The banks of the global frame buffer change; this is the ordinal of the change.
    Shows(u32),
}
