//! Communication registers: bytes of each pixel that both the array and a port access (PFL-NODE, facts E4).
//!
//! ```text
//!                        .------------ registers of each pixel ------------.
//! read, write address -->|  a byte of all pixels, at the array's addresses |--> word
//!    result, writes ---->|                                                 |
//!                        |  a byte of one pixel of each chip               |
//!  pixel, address ------>|                                                 |--> seen
//!  writes, bytes ------->|                                                 |
//!                        '-------------------------------------------------'
//! ```
//!
//! A chip has two lines of the region. Its port has 8 wires, so a byte of all pixels takes as many clocks as a chip has
//! pixels, for any number of chips. Port and array are independent, with clocks of their own. Instructions give a bank
//! and await its return, so port and array never access the same bytes.
//!
//! No FPGA has a memory that two clocks write and that is read at once. So array and port each write a memory of their
//! own, and a register is the exclusive or of both words.
//!
//! Latency: a read is valid in the same clock, and a write takes effect at the edge.

use super::ARRAY;
use crate::prelude::*;

block! {
    /// Registers of a region's pixels, with a port that accesses one pixel of each chip.
    pub struct CommunicationRegisters {
        /// The number of pixels in a line; a power of two.
        pub width: u32,
        /// The number of lines; a power of two.
        pub height: u32,
        /// The number of registers of a pixel; a power of two.
        pub bytes: u32,
        /// The clock of the port.
        pub port: Clock,
    }
    latency = "0 clocks to read; a write takes effect at the edge";
    source = "Reducing Latency on PixelFlow, section 3 (PFL-NODE)";
    in(self) CommunicationRegistersIn {
        /// The register that the array reads.
        read: below(self.bytes).on(ARRAY),
        /// The register that the array writes.
        write: below(self.bytes).on(ARRAY),
        /// The pixels whose register the array writes.
        writes: bit().of(grid(self.height / 2, 2 * self.width)).on(ARRAY),
        /// The byte that each pixel writes: a row for each chip, with its upper line before its lower one.
        result: bits(8).of(grid(self.height / 2, 2 * self.width)).on(ARRAY),
        /// The access of the port.
        port: PortAccess::widths(self).on(self.port),
    }
    out(self) CommunicationRegistersOut {
        /// The byte that each pixel reads.
        word: bits(8).of(grid(self.height / 2, 2 * self.width)),
        /// The byte of each chip that the port reads.
        seen: bits(8).of(row(self.height / 2)),
    }
}

record! {
    /// The access of a port: the pixel and the byte of each chip, and what the port writes there.
    pub struct PortAccess(registers: &CommunicationRegisters) {
        /// The pixel of each chip, counted line by line.
        pixel: below(2 * registers.width),
        /// The register of the pixel.
        address: below(registers.bytes),
        /// The register is written.
        writes: bit(),
        /// The bytes to write, one of each chip.
        bytes: bits(8).of(row(registers.height / 2)),
    }
}

impl CommunicationRegisters {
    fn build(&self, m: Module, i: CommunicationRegistersIn) -> CommunicationRegistersOut {
        let (chips, pixels) = (self.height / 2, 2 * self.width);
        let bytes = || bits(8).of(grid(chips, pixels));
        def!(by_array = m.memory(self.bytes, bytes(), ReadUnderWrite::Any).fill(0));
        def!(by_port = m.memory(self.bytes, bytes(), ReadUnderWrite::Any).fill(0));
        // Each side accesses only bytes that the other wrote before it gave the bank.
        let given = |read: Signal| read.quasi_static("port and array never access the same registers at the same time");
        let at = |memory: Mem, clock: Clock, address: Signal| given(memory.on(clock).read_async(address));

        def!(kept = at(by_port, ARRAY, i.write));
        by_array.on(ARRAY).write(i.writes, i.write, i.result ^ kept);
        let word = at(by_array, ARRAY, i.read) ^ at(by_port, ARRAY, i.read);

        let PortAccess { pixel, address, writes, bytes } = i.port;
        def!(here = constants(below(pixels).of(row(pixels)), |pixel| pixel).eq(pixel) & writes);
        let picked = |memory: Mem| at(memory, self.port, address).columns().pick(pixel.of(row(chips)));
        def!(array_byte = picked(by_array));
        def!(port_byte = picked(by_port));
        by_port.on(self.port).write(here.to_rows(chips), address, (bytes ^ array_byte).to_columns(pixels));
        CommunicationRegistersOut { word, seen: array_byte ^ port_byte }
    }
}

#[cfg(test)]
mod tests;
