//! A slot: the registers of an instruction while its bits are sent.

use super::super::instruction::{COEFFICIENT, Instruction, LONGEST, Microcode};
use super::super::pixel::{Control, Enabling, Mask, PixelProcessor};
use crate::prelude::*;

record! {
    /// The work for a slot.
    pub struct Order {
        microcode: Microcode,
        skip: below(LONGEST),
        length: up_to(LONGEST),
        read: below(PixelProcessor::BITS),
        write: below(PixelProcessor::BITS),
        constant: bits(COEFFICIENT).signed(),
    }

    /// A slot's copy of its work.
    struct Held { microcode: Microcode, length: up_to(LONGEST) }
}

impl Order {
    pub fn of(instruction: &Instruction, microcode: Microcode) -> Order {
        let Instruction { skip, length, read, write, coefficients, .. } = *instruction;
        Order { microcode, skip, length, read, write, constant: coefficients.c }
    }

    /// A number of clocks, in enough bits for two words.
    pub fn clocks(number: Signal) -> Signal {
        number.zext(up_to(2 * LONGEST))
    }
}

/// The progress of an instruction, bit by bit.
pub struct Slot {
    held: Reg<Held>,
    /// The number of bits to send, including this one.
    pub left: Reg,
    /// No bit is to be sent, or this is the last.
    pub ends: Signal,
    /// This bit is part of the word.
    pub is_word: Signal,
    read: Reg,
    write: Reg,
    bits: Reg,
    /// A bit of the constant, which is the coefficient `c` of an expression.
    pub constant: Signal,
}

impl Slot {
    pub fn new(m: Module, name: &str) -> Slot {
        let widths = Order::widths();
        let held = m.reg(name, Held::widths()).reset(0);
        m.within(name, || {
            def!(left = m.reg(up_to(2 * LONGEST)).reset(0));
            def!(is_word = left.ne(0) & left.le(Order::clocks(held.length)));
            def!(bits = m.reg(widths.constant));
            def!(ends = left.le(1));
            def!(read = m.reg(widths.read));
            def!(write = m.reg(widths.write));
            Slot { held, left, ends, is_word, read, write, bits, constant: bits.bit(0) }
        })
    }

    /// Takes new work at an edge where `begins` is high; otherwise continues.
    pub fn begin(&self, begins: Signal, order: Order) {
        self.held.when(begins, Held { microcode: order.microcode, length: order.length });
        let clocks = Order::clocks(order.skip) + Order::clocks(order.length);
        self.left.when(begins, clocks).when(self.left.ne(0), self.left - 1);
        self.read.when(begins, order.read).when(self.is_word, self.read + 1);
        self.write.when(begins, order.write).when(self.is_word, self.write + 1);
        self.bits.when(begins, order.constant).otherwise(self.bits >> 1);
    }

    /// The instruction needs the memory, now or later.
    pub fn on_memory(&self) -> Signal {
        self.left.ne(0) & self.held.microcode.on_memory
    }

    /// The bit that is read goes to the backing store.
    pub fn saves(&self) -> Signal {
        self.held.microcode.saves
    }

    /// The control of the pixels.
    pub fn control(&self) -> Control {
        let code = self.held.microcode;
        let is_last = self.is_word & self.left.eq(1);
        Control {
            source: code.source,
            constant: self.constant,
            adds: self.is_word & code.adds,
            first: code.begins & self.left.eq(Order::clocks(self.held.length)),
            mask: mux(self.is_word, code.mask, Mask::Nobody),
            compares: self.is_word & code.compares,
            gates: code.gates,
            enabling: mux(is_last, code.enabling, Enabling::Keep),
            captures: is_last & code.captures,
            read: *self.read,
            write: *self.write,
        }
    }
}

/// Sends the number that comes with `begins` bit by bit, least significant bit first, and then repeats its sign.
pub fn bit_by_bit(m: Module, name: &str, begins: Signal, number: Signal) -> Signal {
    let bits = m.reg(name, bits(number.width()).signed());
    bits.when(begins, number).otherwise(bits >> 1);
    bits.bit(0)
}
