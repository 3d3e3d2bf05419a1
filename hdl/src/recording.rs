//! A recorded run: what went in and came out before every edge. A simulator makes it, a printer turns it into a
//! testbench that repeats it elsewhere.

use crate::bits::Bits;

/// A run of a design's top module from time 0.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Recording {
    /// The instants at which clocks rise, in order of time; in a design without clocks, those of comparison.
    pub steps: Vec<Step>,
    /// State that starts neither at its reset value, nor with its contents, nor at zero.
    pub initial: Vec<Initial>,
}

/// One instant of a [`Recording`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    /// Its time in picoseconds, above 1 and at least 2 after the step before.
    pub time_ps: u64,
    /// The clocks that rise, by index in [`Module::clocks`](crate::ir::Module::clocks).
    pub rising: Vec<usize>,
    /// The clocks whose reset is high before and at the edge.
    pub resets: Vec<usize>,
    /// The inputs before and at the edge, in order of the ports.
    pub inputs: Vec<Bits>,
    /// What the outputs are just before the edge, in order of the ports.
    pub outputs: Vec<Bits>,
}

/// What a register, the data of a synchronous read or a memory holds at the start.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Initial {
    /// The path below the top, such as `u_row.u_cell[3].q`.
    pub path: String,
    /// The address of the first of the words of a memory; 0 for a register.
    pub address: u32,
    /// The value of a register; the words of a memory from that address on. Its other words start as they always do.
    pub words: Vec<Bits>,
}
