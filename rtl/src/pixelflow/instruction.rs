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

bundle! {
    /// An instruction.
    pub struct Instruction<T> {
        /// Where the operand comes from: a [`Source`].
        pub source: T,
        /// The function of the ALU: a [`Function`].
        pub function: T,
        /// The carry that comes into the first byte: a [`Begin`].
        pub begin: T,
        /// Which processors write: a [`Mask`].
        pub mask: T,
        /// Results go to the accumulator.
        pub accumulates: T,
        /// Results go to memory.
        pub stores: T,
        /// What the last byte's `enabling` and `flagging` depend on: a [`Condition`].
        pub condition: T,
        /// The change of the enable flags with the last byte: an [`Enabling`].
        pub enabling: T,
        /// The change of the flag with the last byte: a [`Flagging`].
        pub flagging: T,
        /// Bytes of the expression before the word; 0 without an expression.
        pub skip: T,
        /// Bytes of the word: 1 to [`LONGEST`].
        pub length: T,
        /// Addresses decrease, from the most significant byte on: for shifts to the right.
        pub descends: T,
        /// The address of the first byte that is read.
        pub read: T,
        /// The address of the first byte that is written.
        pub write: T,
        /// The synchronization with the ports: a [`Sync`].
        pub sync: T,
        /// Coefficient A of the expression, in two's complement.
        pub a: T,
        /// Coefficient B of the expression, in two's complement.
        pub b: T,
        /// Coefficient C of the expression, in two's complement, relative to the region; the constant where there is no expression, from its least
        /// significant byte on. Longer words are of its sign.
        pub c: T,
    }
}

impl Instruction<Width> {
    /// The widths of its fields.
    pub fn widths() -> Instruction<Width> {
        let coefficient = bits(COEFFICIENT).signed();
        Instruction {
            source: one_of::<Source>(),
            function: one_of::<Function>(),
            begin: one_of::<Begin>(),
            mask: one_of::<Mask>(),
            accumulates: bit(),
            stores: bit(),
            condition: one_of::<Condition>(),
            enabling: one_of::<Enabling>(),
            flagging: one_of::<Flagging>(),
            skip: below(LONGEST),
            length: up_to(LONGEST),
            descends: bit(),
            read: below(PixelProcessor::BYTES),
            write: below(PixelProcessor::BYTES),
            sync: one_of::<Sync>(),
            a: coefficient,
            b: coefficient,
            c: coefficient,
        }
    }
}

impl Instruction<u64> {
    /// An instruction of one byte that does nothing, as a starting point.
    pub const NOTHING: Instruction<u64> = Instruction {
        source: 0,
        function: 0,
        begin: 0,
        mask: 0,
        accumulates: 0,
        stores: 0,
        condition: 0,
        enabling: 0,
        flagging: 0,
        skip: 0,
        length: 1,
        descends: 0,
        read: 0,
        write: 0,
        sync: 0,
        a: 0,
        b: 0,
        c: 0,
    };

    /// The clocks that it takes, without waiting.
    pub fn clocks(&self) -> u64 {
        self.skip + self.length
    }
}
