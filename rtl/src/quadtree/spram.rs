//! A single-port memory of an iCE40 UltraPlus, which has four of them.

use crate::prelude::*;

block! {
    /// 16,384 words of 16 bits. A clock reads a word or writes one.
    ///
    /// The model keeps the word that was read while another one is written. In the chip it is unknown then.
    pub struct Spram;
    latency = "1 clock to read";
    foreign = Foreign::module("SB_SPRAM256KA").clock("CLOCK").capitals();
    in SpramIn {
        /// The word to read or to write.
        address: bits(Spram::ADDRESS),
        /// The word that is written.
        datain: bits(Spram::WORD),
        /// The groups of four bits that are written, the lowest first.
        maskwren: bits(4),
        /// A word is written, not read.
        wren: bit(),
        /// A word is read or written.
        chipselect: bit(),
        /// Saves power: the output stays.
        standby: bit(),
        /// Saves more power: the output is low.
        sleep: bit(),
        /// Low saves most power: the words are lost.
        poweroff: bit(),
    }
    out SpramOut {
        /// The word read last.
        dataout: bits(Spram::WORD),
    }
}

impl Spram {
    /// The width of an address.
    pub const ADDRESS: u32 = 14;
    /// The width of a word.
    pub const WORD: u32 = 16;

    fn build(&self, m: Module, i: SpramIn) -> SpramOut {
        m.assume(!i.standby & !i.sleep & i.poweroff & i.maskwren.all_ones(), "the memory is awake and writes words");
        def!(words = m.memory(1 << Spram::ADDRESS, Spram::WORD, ReadUnderWrite::Any));
        words.write(i.chipselect & i.wren, i.address, i.datain);
        SpramOut { dataout: words.read_when(i.chipselect & !i.wren, i.address) }
    }

    /// The inputs of a memory that saves no power, and neither reads nor writes.
    pub(super) fn awake() -> SpramIn {
        let (low, high) = (lit(1, 0), lit(1, 1));
        SpramIn {
            address: lit(Spram::ADDRESS, 0),
            datain: lit(Spram::WORD, 0),
            maskwren: lit(4, 0b1111),
            wren: low,
            chipselect: low,
            standby: low,
            sleep: low,
            poweroff: high,
        }
    }
}
