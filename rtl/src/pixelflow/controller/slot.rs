//! A slot: the place of an instruction while its bytes are sent.

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
    pub struct Order {
        action: Action,
        skip: below(LONGEST),
        length: up_to(LONGEST),
        read: below(PixelProcessor::BYTES),
        write: below(PixelProcessor::BYTES),
        constant: bits(COEFFICIENT).signed(),
    }

    /// A slot's copy of its work.
    struct Held { action: Action, length: up_to(LONGEST) }
}

impl Order {
    pub fn of(i: &Instruction, on_memory: Signal, by_sign: Signal) -> Order {
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
        Order { action, skip: i.skip, length: i.length, read: i.read, write: i.write, constant: i.c }
    }

    /// The number of clocks it takes, in enough bits for two words.
    pub fn clocks(number: Signal) -> Signal {
        number.zext(up_to(2 * LONGEST))
    }
}

/// The bank with that number, one bit each.
pub fn bank(number: Signal) -> Signal {
    let second = number.bit(0);
    cat![second, !second]
}

/// The progress of an instruction, byte by byte.
pub struct Slot {
    held: Reg<Held>,
    /// There are bytes to send, including this one.
    pub left: Reg,
    /// There is none to send, or this is the last.
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
        let widths = Order::widths();
        let held = m.reg(name, Held::widths()).reset(0);
        m.within(name, || {
            def!(left = m.reg(up_to(2 * LONGEST)).reset(0));
            def!(is_word = left.ne(0) & left.le(Order::clocks(held.length)));
            def!(bytes = m.reg(widths.constant));
            def!(ends = left.le(1));
            def!(read = m.reg(widths.read));
            def!(write = m.reg(widths.write));
            Slot { held, left, ends, is_word, read, write, bytes, constant: bytes.slice(0..8).bits() }
        })
    }

    /// Takes new work at an edge where `begins` is high; otherwise continues.
    pub fn begin(&self, begins: Signal, order: Order) {
        self.held.when(begins, Held { action: order.action, length: order.length });
        let clocks = Order::clocks(order.skip) + Order::clocks(order.length);
        self.left.when(begins, clocks).when(self.left.ne(0), self.left - 1);
        let descends = self.held.action.descends;
        let following = |address: Reg| mux(descends, address - 1, address + 1);
        self.read.when(begins, order.read).when(self.is_word, following(self.read));
        self.write.when(begins, order.write).when(self.is_word, following(self.write));
        self.bytes.when(begins, order.constant).otherwise(self.bytes >> 8);
    }

    /// It needs ALU or memory now, or will need it.
    pub fn on_memory(&self) -> Signal {
        self.left.ne(0) & self.held.action.on_memory
    }

    fn is_last(&self) -> Signal {
        self.is_word & self.left.eq(1)
    }

    /// The control of the pixels.
    pub fn control(&self) -> Control {
        let action = self.held.action;
        let is_first = self.left.eq(Order::clocks(self.held.length));
        Control {
            source: action.source,
            constant: self.constant,
            // Otherwise the carry would not stay.
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

    /// What the ports get, with the last byte.
    pub fn given(&self) -> Given {
        let action = self.held.action;
        Given { banks: mux(self.is_last() & action.gives, action.bank, 0), texture: self.is_last() & action.starts }
    }
}

/// Sends the number that comes with `begins` byte by byte, from the least significant on, and then its sign for ever.
pub fn byte_by_byte(m: Module, name: &str, begins: Signal, number: Signal) -> Signal {
    let bytes = m.reg(name, bits(number.width()).signed());
    bytes.when(begins, number).otherwise(bytes >> 8);
    bytes.slice(0..8).bits()
}
