//! What instructions do to a pixel, one after another: by definition, for tests.

use super::instruction::Instruction;
use super::pixel::{Begin, Condition, Control, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
use crate::pixel_planes::schedule::Step;
use crate::prelude::Codes;

/// What a processor holds, and what its control makes of it: by the words of [`Control`] and its codes alone.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pixel {
    /// With the communication registers.
    pub memory: Vec<u64>,
    pub accumulator: u64,
    pub carry: u64,
    /// The top one first.
    pub enable: Vec<u64>,
    pub flag: u64,
}

impl Pixel {
    pub fn new(depth: u32) -> Pixel {
        let (memory, enable) = (vec![0; PixelProcessor::BYTES as usize], vec![0; depth as usize]);
        Pixel { memory, accumulator: 0, carry: 0, enable, flag: 0 }
    }

    pub fn step(&mut self, c: &Control<u64>, expression: u64) {
        let w = self.memory[c.read as usize];
        let x = [c.constant, expression, self.accumulator, self.accumulator * self.flag][c.source as usize];
        let carry = [self.carry, 0, 1][c.begin as usize];
        let difference = w + (255 - x) + carry;
        let (result, carry) = match Function::ALL[c.function as usize] {
            Function::Operand => (x, self.carry),
            Function::Word => (w, self.carry),
            Function::Add => ((w + x + carry) % 256, (w + x + carry) / 256),
            Function::Subtract => (difference % 256, difference / 256),
            Function::Compare => (x, difference / 256),
            Function::And => (w & x, self.carry),
            Function::Or => (w | x, self.carry),
            Function::ExclusiveOr => (w ^ x, self.carry),
            Function::ShiftLeft => (w * 2 % 256 + carry, w / 128),
            Function::ShiftRight => (w / 2 + 128 * carry, w % 2),
            Function::AddHalved => ((w + x + carry) / 2, (w + x + carry) % 2),
        };
        self.carry = carry;
        let holds = [u64::from(x < 128), carry, 1 - carry][c.condition as usize];
        let (top, flag) = (self.enable[0], self.flag);
        self.flag = [flag, holds, holds * top][c.flagging as usize];

        let enters = if c.by_sign == 1 { u64::from(expression < 128) } else { holds };
        match Enabling::ALL[c.enabling as usize] {
            Enabling::Keep => {}
            Enabling::Set => self.enable[0] = 1,
            Enabling::Replace => self.enable[0] = enters,
            Enabling::Restrict => self.enable[0] = top * enters,
            Enabling::Push => {
                self.enable.insert(0, top * enters);
                self.enable.pop();
            }
            Enabling::Invert => self.enable[0] = self.enable[1] * (1 - top),
            Enabling::Pop => {
                self.enable.remove(0);
                self.enable.push(*self.enable.last().unwrap());
            }
        }

        if [0, 1, top, flag][c.mask as usize] == 1 {
            if c.stores == 1 {
                self.memory[c.write as usize] = result;
            }
            if c.accumulates == 1 {
                self.accumulator = result;
            }
        }
    }
}

impl Pixel {
    /// Does an instruction, whose expression is `value` here.
    pub fn run(&mut self, instruction: &Instruction<u64>, value: i128) {
        for (control, byte) in controls(instruction).iter().zip(instruction.skip..) {
            self.step(control, (value >> (8 * byte)) as u64 & 0xff);
        }
    }
}

/// What a pixel does with each byte of the word, one after another.
pub(super) fn controls(i: &Instruction<u64>) -> Vec<Control<u64>> {
    let constant = signed(i.c);
    let byte = |byte: u64| {
        let at = |address: u64| if i.descends == 1 { address.wrapping_sub(byte) } else { address + byte };
        let last = |code: u64, none: u64| if byte + 1 == i.length { code } else { none };
        Control {
            source: i.source,
            constant: (constant >> (8 * byte)) as u64 & 0xff,
            function: i.function,
            begin: if byte == 0 { i.begin } else { Begin::Kept.code() },
            mask: i.mask,
            accumulates: i.accumulates,
            stores: i.stores,
            condition: i.condition,
            enabling: last(i.enabling, Enabling::Keep.code()),
            by_sign: u64::from(is_by_sign(i)),
            flagging: last(i.flagging, Flagging::Keep.code()),
            read: at(i.read),
            write: at(i.write),
        }
    };
    (0..i.length).map(byte).collect()
}

/// A coefficient's number.
pub(super) fn signed(coefficient: u64) -> i128 {
    i128::from((coefficient << 24) as i64 >> 24)
}

fn is_conditional(enabling: u64) -> bool {
    [Enabling::Replace, Enabling::Restrict, Enabling::Push].iter().any(|code| code.code() == enabling)
}

fn is_by_sign(i: &Instruction<u64>) -> bool {
    is_conditional(i.enabling) && i.source == Source::Expression.code() && i.condition == Condition::Positive.code()
}

/// What it takes of a controller: the table of [`controller`](super::controller), in words of its own.
pub(super) fn step(i: &Instruction<u64>) -> Step {
    let on_enable = i.enabling != Enabling::Keep.code()
        || i.mask == Mask::Enabled.code()
        || i.flagging == Flagging::EnabledCondition.code();
    let on_tree = i.source == Source::Expression.code() || on_enable;
    let writes = i.mask != Mask::Nobody.code() && i.accumulates + i.stores > 0;
    let looks_at_alu = i.flagging != Flagging::Keep.code() || is_conditional(i.enabling) && !is_by_sign(i);
    let works = writes || looks_at_alu || i.function != Function::Operand.code();
    Step { on_tree, on_memory: works || !on_tree, saves: false, skip: i.skip as u8, length: i.length as u8 }
}

/// Whether something comes of what a pixel does: then which of it does.
pub(super) fn effect(c: &Control<u64>) -> Control<u64> {
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
