//! What is done to make a program fast, each of it for tests to switch.

/// The optimisation passes. None changes what a circuit does, which running a design with and without them shows.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// use tilewright_sim::Passes;
///
/// let design = tilewright_hdl::elaborate(&Counter)?;
/// let without_folding = Passes { fold: false, ..Passes::default() };
/// let mut sim = Simulation::with_passes(&design, &without_folding)?;
/// sim.run(5);
/// assert_eq!(sim.peek("count")?, 0); // as with it
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Passes {
    /// Instances of one module that were written one by one run as an array.
    pub siblings: bool,
    /// Constants are computed, and operations that do nothing are left out.
    pub fold: bool,
    /// What is equal is computed once.
    pub share: bool,
    /// What is the same in all lanes, or in all rows, is computed once.
    pub uniform: bool,
    /// Lanes that are computed alike, but were written one by one, are computed together.
    pub lift: bool,
    /// Words wider than a register of the machine are split into the fields that they are made of.
    pub fields: bool,
    /// From how many lanes on what has one bit in each is computed in words of as many lanes as the machine has bits; a row of fewer lanes
    /// in one word.
    pub pack_from: u32,
    /// Work on an array is postponed to one loop.
    pub postpone: bool,
    /// A choice by one value for all lanes becomes a branch around the loop; loops are parted, and left out where nothing would change.
    pub branch: bool,
    /// Choices between constants become tables, and shifted halves rotations.
    pub lookups: bool,
    /// Words of memories with the same ports stand side by side.
    pub side_by_side: bool,
    /// A memory that is full of one word at the start is not written then.
    pub blanks: bool,
    /// Bytes of a memory up to which lanes read it, each at its own address, in the loop that takes the words; larger
    /// ones have a loop of their own.
    pub near: usize,
    /// After how many edges without a change of the inputs that are up to 8 bits wide code is made for them.
    pub held_after: u64,
    /// After how many edges with a look at an output before each there is a function for what is left to do at an edge.
    pub looks_after: u64,
    /// From how many operations on a function is cut into several.
    pub longest: usize,
    /// How often a combination of numbers that choose what all lanes of a loop do has to come, until there is a version of the loop for it.
    pub versions_after: u32,
    /// How many operations on vectors such a loop has, at the least.
    pub versions_from: usize,
    /// How many lanes values of an instance of an array have, at the most, from which on the instances run one by one, as units, of which those
    /// are left out that have nothing to do.
    pub apart_from: u32,
    /// How many operations on single values such an instance has, at the least.
    pub apart_single: usize,
    /// How many operations on vectors an edge of a clock takes, about and at the least, so that it is left out where nothing happens at it,
    /// in a circuit of several clocks.
    pub idle_from: usize,
    /// No machine code is made of operations: what it would be made of is evaluated instead, by what operations mean. Slow; it
    /// tells whether a mistake is made before code or in it.
    pub evaluated: bool,
    /// What code works on lies between pages that nobody may touch, so that code that reaches out of it ends the program;
    /// on wherever debug assertions are.
    pub guarded: bool,
}

impl Default for Passes {
    fn default() -> Passes {
        Passes {
            siblings: true,
            fold: true,
            share: true,
            uniform: true,
            lift: true,
            fields: true,
            pack_from: 2,
            postpone: true,
            branch: true,
            lookups: true,
            side_by_side: true,
            blanks: true,
            near: 1 << 20,
            held_after: 50_000,
            looks_after: 300,
            longest: 500,
            versions_after: 32,
            versions_from: 4096,
            apart_from: 64,
            apart_single: 200,
            idle_from: 500,
            evaluated: false,
            guarded: cfg!(debug_assertions),
        }
    }
}

impl Passes {
    /// No pass: each operation of the description as it stands.
    ///
    /// ```
    /// use tilewright_sim::Passes;
    ///
    /// let folding_alone = Passes { fold: true, ..Passes::none() };
    /// assert!(!folding_alone.share && !folding_alone.lift);
    /// ```
    pub fn none() -> Passes {
        Passes {
            siblings: false,
            fold: false,
            share: false,
            uniform: false,
            lift: false,
            fields: false,
            pack_from: u32::MAX,
            postpone: false,
            branch: false,
            lookups: false,
            side_by_side: false,
            blanks: false,
            near: usize::MAX,
            held_after: u64::MAX,
            looks_after: u64::MAX,
            longest: usize::MAX,
            versions_after: u32::MAX,
            versions_from: usize::MAX,
            apart_from: u32::MAX,
            apart_single: usize::MAX,
            idle_from: usize::MAX,
            evaluated: false,
            guarded: cfg!(debug_assertions),
        }
    }
}
