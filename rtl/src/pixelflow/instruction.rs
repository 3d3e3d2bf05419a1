//! The instructions of a node; each works on a word of 1 to 8 bytes, one byte in every clock (facts E4).
//!
//! An instruction states directly what the processors do. The controller decodes it once and broadcasts it. The first
//! `skip` bytes of an expression are ignored: a fraction, or all bytes of an edge below the one with its sign:
//!
//! ```text
//! bytes of the expression     0 1 ..         skip            skip + length - 1
//! the evaluator is busy       |---------------|--------------------|
//! ALU and memory are busy                     |--------------------|   read, read + 1, ..  write, write + 1, ..
//! ```
//!
//! So memory and ALU are free for the previous instruction while the lower bytes of an expression are under way. An
//! expression is never interrupted.
//!
//! | field | takes effect in |
//! |---|---|
//! | `begin` | the first byte of the word; later bytes keep the carry |
//! | `enabling`, `flagging` | the last byte, which has the sign and the carry of the whole word |
//! | all others | every byte |

use super::pixel::{Begin, Condition, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
use crate::prelude::*;

codes! {
    /// The synchronization of an instruction with the ports of the node.
    pub enum Sync {
        /// The instruction does not synchronize.
        Nothing,
        /// The instruction waits until the network has released the bank whose number is `c`.
        AwaitBank,
        /// When the instruction has ended, the bank whose number is `c` is given to the network.
        GiveBank,
        /// The instruction waits until the texture unit has finished.
        AwaitTexture,
        /// When the instruction has ended, the texture unit begins.
        StartTexture,
    }
}

/// The width of a coefficient in bits, as in the contract's depth planes (facts E0).
pub const COEFFICIENT: u32 = 40;

/// The greatest number of bytes of a word. Fewer than this may be skipped before it.
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
        /// The number of bytes of the expression before the word; 0 without an expression.
        skip: below(LONGEST),
        /// The number of bytes of the word: 1 to [`LONGEST`].
        length: up_to(LONGEST),
        /// Addresses decrease from byte to byte, most significant byte first: for shifts to the right.
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
        /// Coefficient C of the expression, in two's complement, relative to the region. Without an expression, C is
        /// the constant, least significant byte first; its sign extends it to a longer word.
        c: bits(COEFFICIENT).signed(),
    }
}

impl Instruction<u64> {
    /// An instruction of one byte that does nothing, as a starting point.
    pub const NOTHING: Instruction<u64> = Instruction { length: 1, ..Instruction::ZERO };

    /// The clocks that the instruction takes, without waiting.
    pub fn clocks(&self) -> u64 {
        self.skip + self.length
    }
}
