//! The instructions of a node; each works on a word of some bytes, a byte a clock (facts E4).
//!
//! An instruction states directly what the processors do. The controller decodes it once and broadcasts it. If it has
//! an expression, the first `skip` bytes of that are ignored: a fraction, or all bytes of an edge below its sign:
//!
//! ```text
//! bytes of the expression     0 1 ..         skip            skip + length - 1
//! the evaluator is taken      |---------------|--------------------|
//! ALU and memory are taken                    |--------------------|   read, read + 1, ..  write, write + 1, ..
//! ```
//!
//! So memory and ALU are free for the previous instruction while an expression's lower bytes are on their way, and an
//! expression is never interrupted.
//!
//! | field | in which bytes of the word |
//! |---|---|
//! | `begin` | the first; later bytes keep the carry |
//! | `enabling`, `flagging` | the last, which has the sign and the whole word's carry |
//! | all others | each |

use super::pixel::{Begin, Condition, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
use crate::prelude::*;

codes! {
    /// The synchronization of an instruction with the ports of the node.
    pub enum Sync {
        /// Nothing.
        Nothing,
        /// It waits until the network has released the bank whose number is `c`.
        AwaitBank,
        /// When it has ended, the bank whose number is `c` is given to the network.
        GiveBank,
        /// It waits until the texture unit has finished.
        AwaitTexture,
        /// When it has ended, the texture unit begins.
        StartTexture,
    }
}

/// The width of a coefficient in bits, as in the contract's depth planes (facts E0).
pub const COEFFICIENT: u32 = 40;

/// The most bytes of a word; fewer may be skipped before it.
pub const LONGEST: u32 = 8;

record! {
    /// An instruction.
    pub struct Instruction {
        /// Where the operand comes from: a [`Source`].
        source: one_of::<Source>(),
        /// The function of the ALU: a [`Function`].
        function: one_of::<Function>(),
        /// The carry that comes into the first byte: a [`Begin`].
        begin: one_of::<Begin>(),
        /// Which processors write: a [`Mask`].
        mask: one_of::<Mask>(),
        /// Results go to the accumulator.
        accumulates: bit(),
        /// Results go to memory.
        stores: bit(),
        /// What the last byte's `enabling` and `flagging` depend on: a [`Condition`].
        condition: one_of::<Condition>(),
        /// The change of the enable flags with the last byte: an [`Enabling`].
        enabling: one_of::<Enabling>(),
        /// The change of the flag with the last byte: a [`Flagging`].
        flagging: one_of::<Flagging>(),
        /// Bytes of the expression before the word; 0 without an expression.
        skip: below(LONGEST),
        /// Bytes of the word: 1 to [`LONGEST`].
        length: up_to(LONGEST),
        /// Addresses decrease, from the most significant byte on: for shifts to the right.
        descends: bit(),
        /// The address of the first byte that is read.
        read: below(PixelProcessor::BYTES),
        /// The address of the first byte that is written.
        write: below(PixelProcessor::BYTES),
        /// The synchronization with the ports: a [`Sync`].
        sync: one_of::<Sync>(),
        /// Coefficient A of the expression, in two's complement.
        a: bits(COEFFICIENT).signed(),
        /// Coefficient B of the expression, in two's complement.
        b: bits(COEFFICIENT).signed(),
        /// Coefficient C of the expression, in two's complement, relative to the region; the constant where there is no expression, from its least
        /// significant byte on. Longer words are of its sign.
        c: bits(COEFFICIENT).signed(),
    }
}

impl Instruction<u64> {
    /// An instruction of one byte that does nothing, as a starting point.
    pub const NOTHING: Instruction<u64> = Instruction { length: 1, ..Instruction::ZERO };

    /// The clocks that it takes, without waiting.
    pub fn clocks(&self) -> u64 {
        self.skip + self.length
    }
}
