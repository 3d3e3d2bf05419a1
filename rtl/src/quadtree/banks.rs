//! The memories of a video buffer: where its pixels are, and what stores them.

use super::spram::{Spram, SpramIn};

use crate::prelude::*;

/// What a bank of a video buffer is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Banks {
    /// A memory that reads a word and writes another one in each clock, as block RAMs do.
    TwoPorts,
    /// Single-port memories of an iCE40 UltraPlus: 16,384 words of 16 bits each. They read or write in a clock, so two
    /// reads are at least two clocks apart. Their words are unknown at the start.
    Spram,
}

/// The addresses of a video processor's pixels.
///
/// A line of 80 pixels does not take the addresses of 128. The pixels from number 64 on are behind all others, with
/// 16 addresses a line. So an address needs no adder.
#[derive(Clone, Copy)]
pub(super) struct Addresses {
    columns: u32,
    rows: u32,
}

impl Addresses {
    pub(super) fn of(columns: u32, rows: u32) -> Addresses {
        Addresses { columns, rows }
    }

    /// The bits of a column within the first part of a line, and within the rest of it; `None` if there is one part.
    fn parts(self) -> Option<[u32; 2]> {
        let whole = self.columns.ilog2();
        let rest = self.columns - (1 << whole);
        let parts = [whole, below(rest.max(1)).bits()];
        (rest > 0 && self.folded(parts) < self.plain()).then_some(parts)
    }

    /// The number of addresses if lines are in one part.
    fn plain(self) -> u32 {
        self.rows << below(self.columns).bits()
    }

    /// The number of addresses if lines are in two parts.
    fn folded(self, [whole, rest]: [u32; 2]) -> u32 {
        (1 << (whole + below(self.rows).bits())) + (self.rows << rest)
    }

    /// The number of addresses.
    pub(super) fn depth(self) -> u32 {
        self.parts().map_or(self.plain(), |parts| self.folded(parts))
    }

    /// The address of a pixel.
    pub(super) fn at(self, x: Signal, y: Signal) -> Signal {
        let width = below(self.depth()).bits();
        let Some([whole, rest]) = self.parts() else { return cat![y, x].trunc(width) };
        let first = cat![y, x.part(0, whole)].zext(width);
        let behind = cat![y, x.part(0, rest)].zext(width) | (lit(width, 1) << (width - 1));
        mux(x.bit(whole), behind, first)
    }

    /// The same as a number.
    pub(super) fn number(self, x: u32, y: u32) -> u32 {
        let line = |part: u32| y << part | x & ((1 << part) - 1);
        match self.parts() {
            None => line(below(self.columns).bits()),
            Some([whole, rest]) if x >> whole & 1 == 1 => 1 << (below(self.depth()).bits() - 1) | line(rest),
            Some([whole, _]) => line(whole),
        }
    }
}

/// A bank to be built.
pub(super) struct Bank {
    pub m: Module,
    pub name: String,
    /// Its words.
    pub depth: u32,
    /// The bits of a word.
    pub word: u32,
}

impl Bank {
    /// Reads a word where `reads` is high, which is there from the next clock until the next read. Also returns what
    /// writes.
    pub(super) fn read_when(self, banks: Banks, reads: Signal, at: Signal) -> (Signal, Writer) {
        let Bank { m, name, depth, word } = self;
        match banks {
            Banks::TwoPorts => {
                let empty = Bits::ones(word);
                let memory = m.memory(&name, depth, word, ReadUnderWrite::Any).fill(empty);
                (memory.read_when(reads, at), Writer::Memory(memory))
            }
            Banks::Spram => {
                let write = m.wire(&format!("{name}_write"), bit());
                let place = m.wire(&format!("{name}_place"), at.width());
                let written = m.wire(&format!("{name}_written"), word);
                m.assert(!(reads & *write), "a bank with one port is not read and written in the same clock");
                // Words beyond those of one memory are in the next ones.
                let count = depth.div_ceil(1 << Spram::ADDRESS);
                let address = mux(*write, *place, at);
                let number = |address: Signal| match count {
                    1 => lit(1, 0),
                    _ => address.part(Spram::ADDRESS, address.width() - Spram::ADDRESS),
                };
                let low = |address: Signal| match count {
                    1 => address.zext(Spram::ADDRESS),
                    _ => address.part(0, Spram::ADDRESS),
                };
                let shown = m.pipe_when(reads, &format!("{name}_number"), number(at));
                let words = (0..count).map(|memory| {
                    let ram = SpramIn {
                        address: low(address),
                        datain: written.zext(Spram::WORD),
                        chipselect: (reads | *write) & number(address).eq(memory),
                        wren: *write,
                        ..Spram::awake()
                    };
                    let ram = m.instance(&format!("u_{name}_{memory}"), &Spram, ram);
                    (memory, ram.dataout.trunc(word))
                });
                let words: Vec<(u32, Signal)> = words.collect();
                let arrived = case(shown, words[1..].iter().copied(), words[0].1);
                // A write takes the word from the output.
                let arrives = m.pipe(&format!("{name}_arrives"), reads);
                let kept = m.reg(&format!("{name}_kept"), word);
                let read = mux(arrives, arrived, *kept);
                kept.when(arrives, read);
                (read, Writer::Spram { write, place, written })
            }
        }
    }
}

/// The write port of a bank.
pub(super) enum Writer {
    Memory(Mem<Signal>),
    Spram { write: Wire, place: Wire, written: Wire },
}

impl Writer {
    pub(super) fn write(self, write: Signal, place: Signal, written: Signal) {
        match self {
            Writer::Memory(memory) => memory.write(write, place, written),
            Writer::Spram { write: to_write, place: to_place, written: to_written } => {
                to_write.drive(write);
                to_place.drive(place);
                to_written.drive(written);
            }
        }
    }
}
