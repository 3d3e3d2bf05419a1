//! A software model of a pixel that executes instructions, for the tests of programs and of the hardware.
//!
//! The model transcribes [`instruction`](super::instruction) and [`pixel`](super::pixel). An instruction controls the
//! pixel in as many clocks as its word has bytes, and [`Pixel::step`] is one such clock. The model does not know when
//! instructions begin and what they wait for, because that does not change their effect.

use super::instruction::{COEFFICIENT, Instruction};
use super::pixel::{Begin, Condition, Control, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
use crate::prelude::Codes;

/// A pixel's memory and flags.
///
/// ```
/// use tilewright_rtl::pixelflow::emulator::Pixel;
/// use tilewright_rtl::pixelflow::instruction::Instruction;
/// use tilewright_rtl::pixelflow::pixel::{Function, Mask, Source};
///
/// // The two bytes of 3 x + 2 y + 250 go to address 8.
/// let write = Instruction {
///     source: Source::Expression as u64,
///     function: Function::Operand as u64,
///     mask: Mask::Everybody as u64,
///     stores: 1,
///     length: 2,
///     write: 8,
///     a: 3,
///     b: 2,
///     c: 250,
///     ..Instruction::NOTHING
/// };
/// let mut pixel = Pixel::new();
/// pixel.run(&[write], 2, 1);
/// assert_eq!(pixel.memory[8..10], [2, 1]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pixel {
    /// Memory, followed by the communication registers.
    pub memory: [u8; PixelProcessor::BYTES as usize],
    /// The accumulator.
    pub accumulator: u8,
    /// The carry.
    pub carry: bool,
    /// The flag.
    pub flag: bool,
    /// The enable flags: bit 0 is the top one.
    pub enable: u32,
    /// The number of enable flags. A push onto a full stack loses a flag, and a pop copies the lowest flag.
    depth: u32,
}

impl Default for Pixel {
    fn default() -> Pixel {
        Pixel::new()
    }
}

impl Pixel {
    /// A pixel with all bytes and flags 0. Hardware starts with arbitrary values.
    pub fn new() -> Pixel {
        Pixel::of_depth(PixelProcessor::DEPTH)
    }

    /// A pixel with `depth` enable flags, 2 to 32.
    pub fn of_depth(depth: u32) -> Pixel {
        let memory = [0; PixelProcessor::BYTES as usize];
        Pixel { memory, accumulator: 0, carry: false, flag: false, enable: 0, depth }
    }

    /// Executes a program at the pixel (x, y) of the region.
    pub fn run(&mut self, program: &[Instruction<u64>], x: u32, y: u32) {
        program.iter().for_each(|instruction| self.instruction(instruction, expression(instruction, x, y)));
    }

    /// Executes an instruction whose expression has this value.
    pub fn instruction(&mut self, i: &Instruction<u64>, value: i64) {
        (0..i.length).for_each(|byte| self.step(&control(i, byte), byte_of(value, i.skip + byte)));
    }

    /// Executes a clock. Every part uses the flags from before the clock.
    pub fn step(&mut self, c: &Control<u64>, expression: u8) {
        let (word, constant) = (self.memory[c.read as usize], c.constant as u8);
        let operand = match Source::ALL[c.source as usize] {
            Source::Constant => constant,
            Source::Expression => expression,
            Source::Accumulator => self.accumulator,
            Source::Multiplicand => self.accumulator * u8::from(self.flag),
        };
        let carry = match Begin::ALL[c.begin as usize] {
            Begin::Kept => self.carry,
            Begin::Zero => false,
            Begin::One => true,
        };
        let (result, carry) = computed(Function::ALL[c.function as usize], word, operand, carry, self.carry);
        let writes = match Mask::ALL[c.mask as usize] {
            Mask::Nobody => false,
            Mask::Everybody => true,
            Mask::Enabled => self.is_enabled(),
            Mask::Flagged => self.flag,
        };
        if writes && c.accumulates == 1 {
            self.accumulator = result;
        }
        if writes && c.stores == 1 {
            self.memory[c.write as usize] = result;
        }
        self.carry = carry;
        let holds = match Condition::ALL[c.condition as usize] {
            Condition::Positive => operand < 0x80,
            Condition::Carry => carry,
            Condition::NoCarry => !carry,
        };
        let enters = if c.by_sign == 1 { expression < 0x80 } else { holds };
        self.set_flags(Enabling::ALL[c.enabling as usize], enters, Flagging::ALL[c.flagging as usize], holds);
    }

    fn set_flags(&mut self, enabling: Enabling, enters: bool, flagging: Flagging, holds: bool) {
        let (top, lowest) = (self.is_enabled(), self.enable & 1 << (self.depth - 1));
        self.flag = match flagging {
            Flagging::Keep => self.flag,
            Flagging::Condition => holds,
            Flagging::EnabledCondition => holds && top,
        };
        let with_top = |top: bool| self.enable & !1 | u32::from(top);
        self.enable = match enabling {
            Enabling::Keep => self.enable,
            Enabling::Set => with_top(true),
            Enabling::Replace => with_top(enters),
            Enabling::Restrict => with_top(top && enters),
            Enabling::Push => (self.enable & !lowest) << 1 | u32::from(top && enters),
            Enabling::Invert => with_top(self.enable & 2 != 0 && !top),
            Enabling::Pop => lowest | self.enable >> 1,
        };
    }

    /// The top enable flag.
    pub fn is_enabled(&self) -> bool {
        self.enable & 1 == 1
    }
}

/// The control of the pixels for one byte of an instruction's word.
pub fn control(i: &Instruction<u64>, byte: u64) -> Control<u64> {
    let at = |address: u64| if i.descends == 1 { address.wrapping_sub(byte) } else { address + byte };
    let last = |code: u64, none: u64| if byte + 1 == i.length { code } else { none };
    Control {
        source: i.source,
        constant: byte_of(signed(i.c), byte).into(),
        function: i.function,
        begin: if byte == 0 { i.begin } else { Begin::Kept.code() },
        mask: i.mask,
        accumulates: i.accumulates,
        stores: i.stores,
        condition: i.condition,
        enabling: last(i.enabling, Enabling::Keep.code()),
        by_sign: is_by_sign(i).into(),
        flagging: last(i.flagging, Flagging::Keep.code()),
        read: at(i.read),
        write: at(i.write),
    }
}

/// The part of a pixel's control that has an effect; what has none is 0, so that controls with the same effect are equal.
pub fn effect(c: &Control<u64>) -> Control<u64> {
    let writes = c.mask != Mask::Nobody.code() && c.accumulates + c.stores > 0;
    let keeps = [Function::Operand, Function::Word, Function::And, Function::Or, Function::ExclusiveOr];
    let carries = !keeps.iter().any(|function| function.code() == c.function);
    let flags = c.flagging != Flagging::Keep.code();
    let (enters, by_sign) = (is_conditional(c.enabling), c.by_sign == 1);
    let looks = flags || enters && !by_sign;
    let if_so = |condition: bool, value: u64| if condition { value } else { 0 };
    let works = writes || carries || looks;
    Control {
        source: if_so(works, c.source),
        constant: if_so(works && c.source == Source::Constant.code(), c.constant),
        function: if_so(works, c.function),
        begin: if_so(works, c.begin),
        mask: if_so(writes, c.mask),
        accumulates: if_so(writes, c.accumulates),
        stores: if_so(writes, c.stores),
        condition: if_so(looks, c.condition),
        enabling: c.enabling,
        by_sign: if_so(enters, c.by_sign),
        flagging: c.flagging,
        read: if_so(works, c.read),
        write: if_so(writes && c.stores == 1, c.write),
    }
}

/// Whether the change of the enable flags depends on a condition.
pub(super) fn is_conditional(enabling: u64) -> bool {
    [Enabling::Replace, Enabling::Restrict, Enabling::Push].iter().any(|it| it.code() == enabling)
}

/// Whether the change of the enable flags depends on the expression's sign, which bypasses the ALU.
pub(super) fn is_by_sign(i: &Instruction<u64>) -> bool {
    is_conditional(i.enabling) && i.source == Source::Expression.code() && i.condition == Condition::Positive.code()
}

/// A byte of a number, extended by its sign.
pub(super) fn byte_of(number: i64, byte: u64) -> u8 {
    (number >> (8 * byte).min(63)) as u8
}

/// The result and the carry out. `w` is a byte of a word, `x` an operand, `c` the carry in, and `kept` the previous
/// carry.
fn computed(function: Function, w: u8, x: u8, c: bool, kept: bool) -> (u8, bool) {
    let sum = |x: u8| u16::from(w) + u16::from(x) + u16::from(c);
    let with_carry = |sum: u16| (sum as u8, sum > 0xff);
    match function {
        Function::Operand => (x, kept),
        Function::Word => (w, kept),
        Function::Add => with_carry(sum(x)),
        Function::Subtract => with_carry(sum(!x)),
        Function::Compare => (x, with_carry(sum(!x)).1),
        Function::And => (w & x, kept),
        Function::Or => (w | x, kept),
        Function::ExclusiveOr => (w ^ x, kept),
        Function::ShiftLeft => (w << 1 | u8::from(c), w & 0x80 != 0),
        Function::ShiftRight => (w >> 1 | u8::from(c) << 7, w & 1 != 0),
        Function::AddHalved => ((sum(x) >> 1) as u8, sum(x) & 1 != 0),
    }
}

/// The value of an instruction's expression at the pixel (x, y) of a region.
pub fn expression(i: &Instruction<u64>, x: u32, y: u32) -> i64 {
    let [a, b, c] = [i.a, i.b, i.c].map(signed);
    a * i64::from(x) + b * i64::from(y) + c
}

/// A coefficient in two's complement.
pub fn signed(coefficient: u64) -> i64 {
    let above = i64::BITS - COEFFICIENT;
    (coefficient << above) as i64 >> above
}
