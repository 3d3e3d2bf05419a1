//! The instructions of a renderer, and what each operation means to pixels: the microcode (facts E3).
//!
//! An instruction processes a word of `length` bits, a bit a clock. If it has an expression, the expression's first
//! `skip` bits are ignored: a fraction, or all bits of an edge below its sign:
//!
//! ```text
//! bits of the expression      0 1 2 3 ..       skip                skip + length - 1
//! the tree is in use          |-------------------|-----------------------------|
//! the memory is in use                            |-----------------------------|   read, read + 1, ..  write, write + 1, ..
//! ```
//!
//! Expressions are linear, A x + B y + C. A [`Curve`](Operation::Curve) right before one adds D x² + E x y + F y² to
//! it. A curve occupies the tree for one clock. Only a renderer that evaluates quadratics takes curves.
//!
//! While an expression's lower bits are on their way, the memory is free for the previous instruction. An expression is
//! never interrupted. A test examines a sign, which is a word of one bit.

use super::linear_tree::Coefficients;
use super::pixel::{Enabling, Mask, PixelProcessor, Source};
use crate::prelude::*;

codes! {
    /// The operation of an instruction.
    pub enum Operation {
        /// All pixels are enabled.
        Enable,
        /// No pixel is enabled.
        Disable,
        /// The first edge: pixels are enabled where the expression is at least 0.
        TestFirst,
        /// A further edge: pixels stay enabled where the expression is at least 0.
        Test,
        /// The last edge: a `Test` that also sets the flag where the pixel stays enabled.
        TestLast,
        /// The flag is set where the pixel is enabled.
        Flag,
        /// The expression is written at all pixels.
        Evaluate,
        /// The expression is written where the pixel is enabled.
        EvaluateEnabled,
        /// The expression is written where the flag is set.
        EvaluateFlagged,
        /// The expression is added to a word of memory where the pixel is enabled.
        Add,
        /// The expression is written at all pixels. The flag is set where the pixel is enabled and the expression is
        /// less than a word of memory.
        Compare,
        /// `Compare` for the upper part of a longer word, whose lower part has already been compared.
        CompareOn,
        /// The flag is set where a constant is less than a word of memory.
        CompareConstant,
        /// The constant is written at all pixels.
        Fill,
        /// The constant is written where the flag is set.
        FillFlagged,
        /// A word of memory is written to another place, at all pixels.
        Copy,
        /// A word of memory is written to another place where the flag is set.
        CopyFlagged,
        /// A word of 48 bits is sent to the backing store for the region whose number is the constant.
        Save,
        /// The next expression is quadratic: this instruction's `a`, `b` and `c` are its `d`, `e` and `f`. Later
        /// expressions are linear again.
        Curve,
    }
}

/// The width of a coefficient in bits, as in the contract's depth planes (facts E0).
pub const COEFFICIENT: u32 = 40;

/// The greatest length of a word, in bits. Fewer bits than this may be skipped before it.
pub const LONGEST: u32 = 64;

record! {
    /// An instruction.
    pub struct Instruction {
        /// The operation: an [`Operation`].
        operation: one_of::<Operation>(),
        /// Bits of the expression before the word; 0 without an expression.
        skip: below(LONGEST),
        /// Bits of the word: 1 to [`LONGEST`].
        length: up_to(LONGEST),
        /// The first address that is read.
        read: below(PixelProcessor::BITS),
        /// The first address that is written.
        write: below(PixelProcessor::BITS),
        /// The coefficients of the expression, in two's complement, relative to the region. Without an expression, `c`
        /// is the constant; its sign extends to longer words. For a curve they are `d`, `e` and `f`.
        coefficients: Coefficients {
            a: bits(COEFFICIENT).signed(),
            b: bits(COEFFICIENT).signed(),
            c: bits(COEFFICIENT).signed(),
        },
    }
}

impl Instruction<u64> {
    /// The microcode of the instruction's operation.
    ///
    /// ```
    /// use tilewright_rtl::pixel_planes::programs::{clear, save};
    ///
    /// assert!(clear(0x00_00_ff).iter().all(|instruction| instruction.microcode().on_tree == 0));
    /// assert_eq!(save(3)[0].microcode().saves, 1);
    /// ```
    ///
    /// # Panics
    ///
    /// The code stands for no operation.
    pub fn microcode(&self) -> Microcode<u64> {
        let is = |operation: &&Operation| operation.code() == self.operation;
        Operation::ALL.iter().find(is).expect("an instruction has an operation").microcode()
    }
}

record! {
    /// The meaning of an operation: a word of the microcode.
    pub struct Microcode {
        /// The operation uses the tree, or changes `enable`; operations of this kind do not overlap.
        on_tree: bit(),
        /// The operation uses the memory or the flag, in the clocks of its word.
        on_memory: bit(),
        /// The source of the bits: a [`Source`].
        source: one_of::<Source>(),
        /// The bits are added to the word that is read.
        adds: bit(),
        /// Carry and flag restart with the word.
        begins: bit(),
        /// Which pixels write: a [`Mask`].
        mask: one_of::<Mask>(),
        /// The flag is set where the bits are less than the word that is read.
        compares: bit(),
        /// The comparison sets the flag only where the pixel is enabled.
        gates: bit(),
        /// The effect of the word's last bit on `enable`: an [`Enabling`].
        enabling: one_of::<Enabling>(),
        /// With the word's last bit the flag takes the new value of `enable`.
        captures: bit(),
        /// The word that is read goes to the backing store.
        saves: bit(),
    }
}

impl Operation {
    /// The operation's microcode.
    pub fn microcode(self) -> Microcode<u64> {
        match self {
            Operation::Enable => enabling(Source::Constant, Enabling::Set),
            Operation::Disable => enabling(Source::Constant, Enabling::Clear),
            Operation::TestFirst => enabling(Source::Expression, Enabling::Replace),
            Operation::Test => enabling(Source::Expression, Enabling::Restrict),
            Operation::TestLast => capturing(enabling(Source::Expression, Enabling::Restrict)),
            Operation::Flag => capturing(enabling(Source::Constant, Enabling::Keep)),
            Operation::Evaluate => evaluating(Mask::Everybody),
            Operation::EvaluateEnabled => evaluating(Mask::Enabled),
            Operation::EvaluateFlagged => evaluating(Mask::Flagged),
            Operation::Add => Microcode { adds: 1, begins: 1, ..evaluating(Mask::Enabled) },
            Operation::Compare => Microcode { begins: 1, ..Operation::CompareOn.microcode() },
            Operation::CompareOn => Microcode { compares: 1, gates: 1, ..evaluating(Mask::Everybody) },
            Operation::CompareConstant => {
                Microcode { compares: 1, begins: 1, ..writing(Source::Constant, Mask::Nobody) }
            }
            Operation::Fill => writing(Source::Constant, Mask::Everybody),
            Operation::FillFlagged => writing(Source::Constant, Mask::Flagged),
            Operation::Copy => writing(Source::Memory, Mask::Everybody),
            Operation::CopyFlagged => writing(Source::Memory, Mask::Flagged),
            Operation::Save => Microcode { saves: 1, ..writing(Source::Memory, Mask::Nobody) },
            Operation::Curve => enabling(Source::Constant, Enabling::Keep),
        }
    }
}

/// An operation on the memory alone.
fn writing(source: Source, mask: Mask) -> Microcode<u64> {
    Microcode { on_memory: 1, source: source.code(), mask: mask.code(), ..Microcode::ZERO }
}

/// An operation on tree and memory side by side.
fn evaluating(mask: Mask) -> Microcode<u64> {
    Microcode { on_tree: 1, ..writing(Source::Expression, mask) }
}

/// An operation on `enable` alone.
fn enabling(source: Source, enabling: Enabling) -> Microcode<u64> {
    Microcode { on_tree: 1, on_memory: 0, enabling: enabling.code(), ..writing(source, Mask::Nobody) }
}

/// `microcode`, with a flag that takes the new value of `enable`.
fn capturing(microcode: Microcode<u64>) -> Microcode<u64> {
    Microcode { on_memory: 1, captures: 1, ..microcode }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The controller relies on this: instructions on the tree do not overlap, nor do those on the memory. One of each
    /// may overlap.
    #[test]
    fn what_two_instructions_share_keeps_them_in_order() {
        for operation in Operation::ALL {
            let code = operation.microcode();
            let name = operation.name();
            let looks_at_enable = code.mask == Mask::Enabled.code() || code.gates == 1 || code.captures == 1;
            let enables = code.enabling != Enabling::Keep.code();
            let evaluates = code.source == Source::Expression.code();
            assert!(
                code.on_tree == 1 || !(looks_at_enable || enables || evaluates),
                "{name} follows what changes enable"
            );
            let looks_at_flag = code.mask == Mask::Flagged.code() || code.compares == 1 || code.captures == 1;
            let uses_memory = code.mask != Mask::Nobody.code() || code.adds == 1 || code.saves == 1;
            assert_eq!(code.on_memory == 1, looks_at_flag || uses_memory, "{name} follows what changes memory or flag");
            assert!(code.on_tree == 1 || code.on_memory == 1, "{name} uses tree or memory");
        }
    }
}
