//! A recorded run: the inputs and outputs before every edge. A simulator records it; a printer makes a testbench of
//! it that repeats the run elsewhere.

use crate::bits::Bits;

/// A run of a design's top module from time 0.
///
/// ```
/// # use tilewright_hdl::*;
/// use tilewright_hdl::recording::{Recording, Step};
///
/// // A design without clocks, compared once: 1 + 2 must give 3.
/// let step = Step {
///     time_ps: 10_000,
///     rising: vec![],
///     resets: vec![],
///     inputs: vec![Bits::new(8, 1), Bits::new(8, 2)],
///     outputs: vec![Bits::new(8, 3)],
/// };
/// let recording = Recording { steps: vec![step], initial: vec![] };
/// assert_eq!(recording.steps[0].outputs[0], 3);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Recording {
    /// The instants at which clocks have an edge, in the sequence of time; in a design without clocks, the times of
    /// comparison.
    pub steps: Vec<Step>,
    /// State that starts with another value than its reset value, its contents, or zero.
    pub initial: Vec<Initial>,
}

/// One instant of a [`Recording`].
///
/// ```
/// # use tilewright_hdl::*;
/// // The first edge after a reset of a block whose one clock has a period of 10 ns.
/// let step = recording::Step {
///     time_ps: 20_000,
///     rising: vec![0],
///     resets: vec![],
///     inputs: vec![Bits::new(1, 1)],
///     outputs: vec![Bits::zero(8)],
/// };
/// assert_eq!(step.rising.first(), Some(&0));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Step {
    /// Its time in picoseconds: above 1, and at least 2 after the previous step.
    pub time_ps: u64,
    /// The clocks that rise or, where they act on their falling edge, fall; by index in
    /// [`Module::clocks`](crate::ir::Module::clocks).
    pub rising: Vec<usize>,
    /// The clocks whose reset is active before and at the edge, whatever its level then is.
    pub resets: Vec<usize>,
    /// The inputs before and at the edge, in the sequence of the ports.
    pub inputs: Vec<Bits>,
    /// The outputs just before the edge, in the sequence of the ports.
    pub outputs: Vec<Bits>,
}

/// The starting value of a register, of the data of a synchronous read, or of a memory.
///
/// ```
/// # use tilewright_hdl::*;
/// // Two words of a memory of 1024 that were poked before the run began.
/// let initial = recording::Initial {
///     path: "u_row.u_cell[3].table".to_owned(),
///     address: 100,
///     words: vec![Bits::new(8, 1), Bits::new(8, 2)],
/// };
/// assert_eq!(initial.address as usize + initial.words.len(), 102);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Initial {
    /// The path below the top, such as `u_row.u_cell[3].q`.
    pub path: String,
    /// The address of the first given word of a memory; 0 for a register.
    pub address: u32,
    /// The value of a register, or the words of a memory from that address on. Other words start as usual.
    pub words: Vec<Bits>,
}
