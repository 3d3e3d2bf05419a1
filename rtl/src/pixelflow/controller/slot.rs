//! A slot: the registers of an instruction while its bytes are sent.

use super::super::instruction::{COEFFICIENT, Instruction, LONGEST, Sync};
use super::super::pixel::{Begin, Condition, Control, Enabling, Flagging, Function, Mask, PixelProcessor, Source};
use super::{BANKS, Given};
use crate::prelude::*;

record! {
    /// The fields of an instruction that are the same for all of its bytes.
    pub struct Action {
        source: one_of::<Source>(),
        function: one_of::<Function>(),
        begin: one_of::<Begin>(),
        mask: one_of::<Mask>(),
        accumulates: bit(),
        stores: bit(),
        condition: one_of::<Condition>(),
        enabling: one_of::<Enabling>(),
        by_sign: bit(),
        flagging: one_of::<Flagging>(),
        on_memory: bit(),
        descends: bit(),
        gives: bit(),
        bank: bits(BANKS),
        starts: bit(),
    }

    /// The work for a slot.
    pub struct Work {
        action: Action,
        skip: below(LONGEST),
        length: up_to(LONGEST),
        read: below(PixelProcessor::BYTES),
        write: below(PixelProcessor::BYTES),
        constant: bits(COEFFICIENT).signed(),
    }

    /// The part of the work that a slot keeps unchanged.
    struct Held { action: Action, length: up_to(LONGEST) }
}

impl Work {
    pub fn of(i: &Instruction, on_memory: Signal, by_sign: Signal) -> Work {
        let action = Action {
            source: i.source,
            function: i.function,
            begin: i.begin,
            mask: i.mask,
            accumulates: i.accumulates,
            stores: i.stores,
            condition: i.condition,
            enabling: i.enabling,
            by_sign,
            flagging: i.flagging,
            on_memory,
            descends: i.descends,
            gives: i.sync.is(Sync::GiveBank),
            bank: bank(i.c),
            starts: i.sync.is(Sync::StartTexture),
        };
        Work { action, skip: i.skip, length: i.length, read: i.read, write: i.write, constant: i.c }
    }

    /// A number of clocks, in enough bits for two words.
    pub fn clocks(number: Signal) -> Signal {
        number.zext(up_to(2 * LONGEST))
    }
}

/// The bank with this number, as one bit of two.
pub fn bank(number: Signal) -> Signal {
    let second = number.bit(0);
    cat![second, !second]
}

/// The progress of an instruction, byte by byte.
pub struct Slot {
    held: Reg<Held>,
    /// The number of bytes to send, including this one.
    pub left: Reg,
    /// No byte is left to send, or this is the last one.
    pub ends: Signal,
    /// This byte is part of the word.
    pub is_word: Signal,
    read: Reg,
    write: Reg,
    bytes: Reg,
    /// A byte of the constant, which is the coefficient `c` of an expression.
    pub constant: Signal,
}

impl Slot {
    pub fn new(m: Module, name: &str) -> Slot {
        let widths = Work::widths();
        let held = m.reg(name, Held::widths()).reset(0);
        m.within(name, || {
            def!(left = m.reg(up_to(2 * LONGEST)).reset(0));
            def!(is_word = left.ne(0) & left.le(Work::clocks(held.length)));
            def!(bytes = m.reg(widths.constant));
            def!(ends = left.le(1));
            def!(read = m.reg(widths.read));
            def!(write = m.reg(widths.write));
            Slot { held, left, ends, is_word, read, write, bytes, constant: bytes.slice(0..8).bits() }
        })
    }

    /// Takes new work at an edge where `begins` is high; otherwise continues.
    pub fn begin(&self, begins: Signal, work: Work) {
        self.held.when(begins, Held { action: work.action, length: work.length });
        let clocks = Work::clocks(work.skip) + Work::clocks(work.length);
        self.left.when(begins, clocks).when(self.left.ne(0), self.left - 1);
        let descends = self.held.action.descends;
        let following = |address: Reg| mux(descends, address - 1, address + 1);
        self.read.when(begins, work.read).when(self.is_word, following(self.read));
        self.write.when(begins, work.write).when(self.is_word, following(self.write));
        self.bytes.when(begins, work.constant).otherwise(self.bytes >> 8);
    }

    /// The instruction needs ALU or memory now, or will need it.
    pub fn on_memory(&self) -> Signal {
        self.left.ne(0) & self.held.action.on_memory
    }

    fn is_last(&self) -> Signal {
        self.is_word & self.left.eq(1)
    }

    /// The control of the pixels.
    pub fn control(&self) -> Control {
        let action = self.held.action;
        let is_first = self.left.eq(Work::clocks(self.held.length));
        Control {
            source: action.source,
            constant: self.constant,
            // Before the word, the function must not change the carry.
            function: mux(self.is_word, action.function, Function::Operand),
            begin: mux(is_first, action.begin, Begin::Kept),
            mask: mux(self.is_word, action.mask, Mask::Nobody),
            accumulates: action.accumulates,
            stores: action.stores,
            condition: action.condition,
            enabling: mux(self.is_last(), action.enabling, Enabling::Keep),
            by_sign: action.by_sign,
            flagging: mux(self.is_last(), action.flagging, Flagging::Keep),
            read: *self.read,
            write: *self.write,
        }
    }

    /// The hand-over to the ports, with the last byte.
    pub fn given(&self) -> Given {
        let action = self.held.action;
        Given { banks: mux(self.is_last() & action.gives, action.bank, 0), texture: self.is_last() & action.starts }
    }
}

/// Sends the number that comes with `begins` byte by byte, the least significant first, and then bytes of its sign.
pub fn byte_by_byte(m: Module, name: &str, begins: Signal, number: Signal) -> Signal {
    let bytes = m.reg(name, bits(number.width()).signed());
    bytes.when(begins, number).otherwise(bytes >> 8);
    bytes.slice(0..8).bits()
}
