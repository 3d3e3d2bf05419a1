//! What instructions do to a pixel, by definition: for the tests of programs, and of the hardware.
//!
//! It is the plain reading of [`instruction`](super::instruction) and [`pixel`](super::pixel), a byte after the other; what the instructions wait for and
//! when they begin is not here, as it does not change what they do.

use super::instruction::{COEFFICIENT, Instruction};
use super::pixel::{Begin, Condition, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
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
    /// Memory, and behind it the communication registers.
    pub memory: [u8; PixelProcessor::BYTES as usize],
    /// The accumulator.
    pub accumulator: u8,
    /// The carry.
    pub carry: bool,
    /// The flag.
    pub flag: bool,
    /// The enable flags: bit 0 is the top one.
    pub enable: u8,
}

impl Default for Pixel {
    fn default() -> Pixel {
        Pixel::new()
    }
}

impl Pixel {
    /// A pixel with zeros everywhere; hardware begins with any.
    pub fn new() -> Pixel {
        Pixel { memory: [0; PixelProcessor::BYTES as usize], accumulator: 0, carry: false, flag: false, enable: 0 }
    }

    /// Does what a program does to the pixel at (x, y) of the region.
    pub fn run(&mut self, program: &[Instruction<u64>], x: u32, y: u32) {
        program.iter().for_each(|instruction| self.instruction(instruction, expression(instruction, x, y)));
    }

    /// An instruction, where its expression has that value.
    pub fn instruction(&mut self, i: &Instruction<u64>, value: i64) {
        let byte_of = |word: i64, at: u64| (word >> (8 * at).min(63)) as u8;
        for byte in 0..i.length {
            let is_last = byte + 1 == i.length;
            let constant = byte_of(signed(i.c), byte);
            let expression = byte_of(value, i.skip + byte);
            let begin = if byte == 0 { Begin::ALL[i.begin as usize] } else { Begin::Kept };
            let address = |first: u64| (if i.descends == 1 { first - byte } else { first + byte }) as usize;
            self.byte(i, begin, [constant, expression], [address(i.read), address(i.write)], is_last);
        }
    }

    /// What happens in the clock of a byte: everything sees what the flags were before.
    fn byte(
        &mut self,
        i: &Instruction<u64>,
        begin: Begin,
        [constant, expression]: [u8; 2],
        [read, write]: [usize; 2],
        is_last: bool,
    ) {
        let operand = match Source::ALL[i.source as usize] {
            Source::Constant => constant,
            Source::Expression => expression,
            Source::Accumulator => self.accumulator,
            Source::Multiplicand => self.accumulator * u8::from(self.flag),
        };
        let carry = match begin {
            Begin::Kept => self.carry,
            Begin::Zero => false,
            Begin::One => true,
        };
        let (result, carry) =
            computed(Function::ALL[i.function as usize], self.memory[read], operand, carry, self.carry);
        let writes = match Mask::ALL[i.mask as usize] {
            Mask::Nobody => false,
            Mask::Everybody => true,
            Mask::Enabled => self.is_enabled(),
            Mask::Flagged => self.flag,
        };
        if writes && i.accumulates == 1 {
            self.accumulator = result;
        }
        if writes && i.stores == 1 {
            self.memory[write] = result;
        }
        self.carry = carry;
        if is_last {
            let holds = match Condition::ALL[i.condition as usize] {
                Condition::Positive => operand < 0x80,
                Condition::Carry => carry,
                Condition::NoCarry => !carry,
            };
            self.flags(Enabling::ALL[i.enabling as usize], Flagging::ALL[i.flagging as usize], holds);
        }
    }

    fn flags(&mut self, enabling: Enabling, flagging: Flagging, holds: bool) {
        let top = self.is_enabled();
        self.flag = match flagging {
            Flagging::Keep => self.flag,
            Flagging::Condition => holds,
            Flagging::EnabledCondition => holds && top,
        };
        let with_top = |top: bool| self.enable & !1 | u8::from(top);
        self.enable = match enabling {
            Enabling::Keep => self.enable,
            Enabling::Set => with_top(true),
            Enabling::Replace => with_top(holds),
            Enabling::Restrict => with_top(top && holds),
            Enabling::Push => self.enable << 1 | u8::from(top && holds),
            Enabling::Invert => with_top(self.enable & 2 != 0 && !top),
            Enabling::Pop => self.enable & 0x80 | self.enable >> 1,
        };
    }

    /// The top enable flag.
    pub fn is_enabled(&self) -> bool {
        self.enable & 1 == 1
    }
}

/// The result and the carry: of a word's byte `w`, an operand `x`, and the carry `c` that comes in, where `kept` is the one before.
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
fn signed(coefficient: u64) -> i64 {
    let above = i64::BITS - COEFFICIENT;
    (coefficient << above) as i64 >> above
}

#[cfg(test)]
mod tests;
