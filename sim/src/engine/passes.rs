//! The optimisation passes, each of which tests can switch off.

use super::cranelift::VECTOR;

/// The optimisation passes. None changes the behaviour of a circuit; tests run designs with and without them to show
/// it.
///
/// ```
/// # use tilewright_sim::{Simulation, for_examples::Counter};
/// use tilewright_sim::Passes;
///
/// let design = tilewright_hdl::elaborate(&Counter)?;
/// let without_folding = Passes { fold: false, ..Passes::default() };
/// let mut sim = Simulation::with_passes(&design, &without_folding)?;
/// sim.run(5);
/// assert_eq!(sim.peek("count")?, 0); // the same as with it
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Passes {
    /// Runs separate instances of one module as an array.
    pub siblings: bool,
    /// Computes constants, and removes operations without effect.
    pub fold: bool,
    /// Computes equal expressions once.
    pub share: bool,
    /// Computes once what is the same in all lanes, or in all rows.
    pub uniform: bool,
    /// Computes lanes together that are described one by one but computed alike.
    pub lift: bool,
    /// Splits words wider than a machine register into the fields that they consist of.
    pub fields: bool,
    /// From this number of lanes on, 1-bit lanes are computed in words of as many lanes as a machine word has bits. A
    /// row with fewer lanes uses a single word.
    pub pack_from: u32,
    /// Postpones work on an array to one loop.
    pub postpone: bool,
    /// Makes a branch around the loop of a choice that all lanes share. Loops are split, and skipped if nothing would
    /// change.
    pub branch: bool,
    /// Makes tables of choices between constants, and rotations of shifted halves.
    pub lookups: bool,
    /// Places the words of memories with the same ports side by side.
    pub side_by_side: bool,
    /// Does not write a memory at the start if all its words are equal then.
    pub blanks: bool,
    /// The largest memory, in bytes, that lanes read at addresses of their own within the loop that uses the words.
    /// Larger ones have a loop of their own.
    pub near: usize,
    /// After this number of edges with unchanged inputs of up to 8 bits, code is made for their present values. For
    /// circuits of more than 200 cells it grows in proportion, as the time of making code does.
    pub held_after: u64,
    /// After this number of edges, each preceded by a look at an output, a function is made for the remaining work of
    /// an edge.
    pub looks_after: u64,
    /// Functions of more operations than this are split.
    pub longest: usize,
    /// A combination of numbers that select the operation of all lanes in a loop must occur this often before the
    /// loop gets a version for it.
    pub versions_after: u32,
    /// The least number of vector operations in such a loop.
    pub versions_from: usize,
    /// From this largest number of lanes within an instance of an array on, the instances run one by one, as units.
    /// Units with nothing to do are skipped.
    pub apart_from: u32,
    /// The least number of scalar operations in such an instance.
    pub apart_single: usize,
    /// The least number of vector operations, approximately, at a clock edge that is skipped when nothing happens at
    /// it. It applies to circuits with several clocks.
    pub idle_from: usize,
    /// What runs in place of machine code, if anything does.
    pub target: Target,
    /// Places the data of generated code between protected pages, so that an access out of bounds ends the program.
    /// It is on if debug assertions are.
    pub guarded: bool,
}

/// What the compiled engine makes. The others than code are slow: they tell whether a mistake is made before code
/// generation or in it, and try vectors that no processor at hand has.
///
/// ```
/// # use tilewright_sim::{EngineKind, Simulation, for_examples::Counter};
/// use tilewright_sim::{Passes, Target};
///
/// let design = tilewright_hdl::elaborate(&Counter)?;
/// for target in [Target::Functions, Target::Strips { vector: 256 }] {
///     let passes = Passes { target, ..Passes::default() };
///     let mut sim = Simulation::with_passes(&design, &passes)?.on(EngineKind::Compiled);
///     sim.run(5);
///     assert_eq!(sim.peek("count")?, 0);
/// }
/// # Ok::<(), tilewright_sim::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Machine code.
    Code,
    /// Lowered functions: the operations that would become code are interpreted.
    Functions,
    /// Strip programs with vectors of 64, 128 or 256 bits: each is checked and evaluated.
    Strips {
        /// Bits of a vector; a simulation with another number of them panics.
        vector: u32,
    },
}

impl Target {
    /// Bits of a vector.
    ///
    /// # Panics
    ///
    /// No target has vectors of so many bits.
    pub(crate) fn vector(self) -> u32 {
        let Target::Strips { vector } = self else { return VECTOR };
        assert!(matches!(vector, 64 | 128 | 256), "a target has vectors of 64, 128 or 256 bits, and not of {vector}");
        vector
    }
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
            target: Target::Code,
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
            target: Target::Code,
            guarded: cfg!(debug_assertions),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "a target has vectors of 64, 128 or 256 bits, and not of 512")]
    fn a_target_without_such_vectors_is_refused() {
        Target::Strips { vector: 512 }.vector();
    }
}
