//! Values of many lanes, as the language says them.

use super::{Pattern, Pick};

/// A row that is made of plain values, put through operations, and made plain again.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct LaneWork {
    /// The width of a lane.
    pub width: u32,
    /// The lanes of the row.
    pub lanes: u32,
    /// The columns, where it becomes a grid.
    pub columns: u32,
    /// It is signed.
    pub signed: bool,
    /// The values that are its lanes, over and over.
    pub start: Vec<Pick>,
    /// What is done with it.
    pub works: Vec<Work>,
    /// How it ends.
    pub end: End,
}

/// An operation on rows and grids.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Work {
    /// A plain value added.
    Add(Pick),
    /// The lane's own number, times this, exclusive or.
    Number(u64),
    /// What it was before the last operation, subtracted, if it has the same shape still.
    Before,
    /// The smaller of it and a plain value; or where the condition holds, its inverse.
    Least(Pick),
    /// Its inverse where a plain condition holds.
    Invert(Pick),
    /// Neighbours so far away along an axis.
    Shifted(i8, Pick),
    /// The last lane first.
    Reversed,
    /// Lanes in pairs, every second of them taken, in that order.
    Take(u8),
    /// A grid of it, or a row of the grid.
    Turn,
    /// Into a register in each lane, which takes a value where a lane's own bit says so, else counts where a plain one does.
    Hold {
        /// The value after a reset, in every second lane its inverse.
        reset: Option<Pattern>,
        /// The value at power-on, in all lanes.
        initial: Option<Pattern>,
        /// When it counts.
        count: Pick,
    },
    /// Into a register of a code in each lane, where a lane's own bit says so; what it is then is chosen by that.
    Colours {
        /// The code at power-on, if it is not that after a reset.
        initial: Option<u8>,
        /// What one of the codes stands for.
        chosen: Pick,
    },
    /// Through a memory in each lane, with one address or an address a lane.
    Remember {
        /// Where.
        address: Pick,
        /// Each lane has an address of its own.
        own: bool,
    },
}

/// How lanes become plain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// The sum of all.
    Sum,
    /// The smallest.
    Minimum,
    /// The largest.
    Maximum,
    /// The lane that a value says.
    Pick(Pick),
    /// Side by side.
    Pack,
    /// A tree of sums and inverses.
    Tree,
    /// A tree with a register a level.
    Stages,
    /// A tree of records: the smallest lane with its number.
    Least,
}
