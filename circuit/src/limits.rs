//! Limits on the width of a signal and the size of a design.

/// The widest signal, in bits.
pub const WIDEST: u32 = 1 << 20;

/// The deepest nesting of instances. A block that instantiates itself endlessly exceeds it.
pub const DEEPEST: usize = 100;

/// The most lanes in nested arrays.
pub const MOST_LANES: u64 = 1 << 24;

/// The most lanes that are checked one by one for a combinational loop: some gibibytes, some seconds.
pub const MOST_LOOPED_LANES: u64 = 1 << 26;

/// The most 64-bit limbs of a value in all its lanes: half a gibibyte.
pub const MOST_LIMBS: u64 = 1 << 26;

/// The most 64-bit limbs of a memory in all its lanes: 32 gibibytes.
pub const MOST_MEMORY_LIMBS: u64 = 1 << 32;
