//! What is given to instances and arrays, and how their outputs are read.

use super::{Binary, Meaning, Pick};
use tilewright_hdl::ir::Reduction;

/// A block that is declared with ports of records, and what is given to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Declared {
    /// The widths of the two fields of its records.
    pub widths: [u32; 2],
    /// What the fields are; where that is codes, the upper one.
    pub meaning: Meaning,
    /// How many records its list has.
    pub list: u32,
    /// The lanes, each with a constant record of its own; 0 for one instance alone.
    pub lanes: u32,
    /// The seed of those constants.
    pub numbers: u64,
    /// When it takes a record, what is added, the record, and the list.
    pub picks: [Pick; 4],
}

/// A block of the library, and what is given to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Library {
    /// Which.
    pub block: LibraryBlock,
    /// A number of bits, which the block takes as many of as it can.
    pub width: u32,
    /// What is given to it.
    pub picks: [Pick; 4],
}

/// The blocks of the library that have no streams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "they have the names of the blocks")]
pub enum LibraryBlock {
    Counter,
    ShiftRegister,
    Lfsr,
    /// One-hot codes and priorities.
    Encoders,
    Shifter,
    Multiplier,
    Crc,
}

/// What feeds an input of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Feed {
    /// One value to all lanes.
    Broadcast,
    /// A value for each lane.
    Each,
    /// The lane's number.
    Index,
    /// A constant for each lane.
    Table(u64),
    /// The linked output of the lane so many places away; a broadcast if the input has no link.
    Link(u8),
    /// All lanes of the linked output combined, if that is a register; else a broadcast.
    Back(Reduction),
    /// The linked output so many lanes on, around the end, if that is a register; else a broadcast.
    Rotate(u8),
    /// An array that was made before, if it has as many lanes, seen from so many lanes away; its lanes over and over
    /// otherwise.
    Other(Pick, i8),
    /// As [`Feed::Other`], but lanes are taken one by one, each put through the same operator with the broadcast.
    Lifted(Binary, Pick),
    /// As [`Feed::Lifted`], with a constant for each lane.
    LiftedTable(Binary, Pick),
}

/// How the lanes of an output become one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Gather {
    /// All lanes combined.
    Reduce(Reduction),
    /// One lane.
    Lane(u32),
    /// All lanes side by side.
    Concat,
}
