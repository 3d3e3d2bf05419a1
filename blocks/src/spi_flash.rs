//! A reader of serial flash memories.

use crate::axi_stream::PacketByte;
use crate::spi::{SpiMaster, SpiMasterIn, SpiWord};
use tilewright_hdl::{Module, below, bit, bits, block, codes, concat, def, lit, when};

codes! {
    /// What an [`SpiFlashReader`] sends.
    enum Phase {
        /// Nothing.
        Idle,
        /// The command and the address.
        Header,
        /// As many words as bytes are to be read.
        Data,
    }
}

block! {
    /// Reads bytes from a flash memory on SPI, such as those that FPGAs are configured from.
    ///
    /// ```text
    ///           .-----------------.  send      .--------.
    /// reads ===>| command, address|===========>| SPI    |---> sck, mosi, cs_n
    ///           | length          |  received  | master |
    /// bytes <===| last            |<===========|        |<--- miso
    ///           '-----------------'            '--------'
    /// ```
    ///
    /// A read is a start address, and the number of bytes from there on. The memory increments the address, and
    /// continues at address 0 after its last byte. The last byte of each read has `last`. A read of no bytes gives none.
    ///
    /// The command is 0x03, or 0x0b if `fast`. The latter has a dummy byte after the address, and memories allow a
    /// faster `sck` for it. `mosi` is low after the address. If the receiver waits, `sck` stops between two bytes, and
    /// the memory stays selected.
    ///
    /// Latency: a word takes the `16 * half_period + 1` clocks of an [`SpiMaster`] for 8 bits. The first byte comes 5
    /// words and 1 clock after its read was taken, or 6 words and 1 clock if `fast`. Each further byte comes a word
    /// after the byte before it was taken. The next read is taken while the last byte is on its way. Its command
    /// waits until the memory was deselected for `half_period` clocks. No `valid` waits for `ready`, and no path within
    /// a clock leads from one port to another.
    ///
    /// ```
    /// # use tilewright_blocks::{FlashRead, PacketByte, SpiFlashReader};
    /// # use tilewright_sim::{Pauses, Simulation, monitor};
    /// let mut sim = Simulation::of(&SpiFlashReader { half_period: 1, fast: false, length: 8 })?;
    /// sim.reset();
    /// let (reads, bytes, miso) = (sim.i.reads, sim.o.bytes, sim.i.miso);
    /// sim.set(miso, 1); // an empty memory
    /// let t = sim.testbench();
    /// let read = FlashRead { address: 0x1234, length: 2 };
    /// let expected = [(0xff, 0), (0xff, 1)].map(|(byte, last)| PacketByte { byte, last });
    /// t.run((t.send(reads, read), t.expect_all(bytes, expected, Pauses::NONE)));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct SpiFlashReader {
        /// The clocks from one edge of `sck` to the next.
        pub half_period: u32,
        /// Whether the command for a fast `sck` is used.
        pub fast: bool,
        /// The bits of the number of bytes.
        pub length: u32,
    }
    ranges { half_period: 1.., length: 1..=32 }
    latency(self) = format!("{} clocks to the first byte", (self.header_words() + 1) * self.clocks_of_a_word() + 1);
    in(self) SpiFlashReaderIn {
        /// What to read.
        ///
        /// ```
        /// # use tilewright_blocks::FlashRead;
        /// let first_page = FlashRead { address: 0, length: 256 };
        /// # assert_eq!(first_page.length, 256);
        /// ```
        reads: stream(pub struct FlashRead {
            /// The address of the first byte.
            address: bits(24),
            /// The number of bytes.
            length: bits(self.length),
        }),
        /// The line from the memory.
        miso: bit(),
    }
    out SpiFlashReaderOut {
        /// The bytes, with `last` at the end of each read.
        bytes: stream(PacketByte),
        /// The clock of the memory.
        sck: bit(),
        /// The line to the memory.
        mosi: bit(),
        /// Low while the memory is selected.
        cs_n: bit(),
    }
}

impl SpiFlashReader {
    /// The words that are sent before the first byte comes back.
    fn header_words(&self) -> u64 {
        if self.fast { 5 } else { 4 }
    }

    fn clocks_of_a_word(&self) -> u64 {
        16 * u64::from(self.half_period) + 1
    }

    fn build(&self, m: Module, i: SpiFlashReaderIn) -> SpiFlashReaderOut {
        let words = self.header_words();
        def!(phase = m.fsm(Phase::Idle));
        let read = i.reads.take_when(phase.is(Phase::Idle));
        def!(header = m.reg(8 * words));
        def!(place = m.reg(below(words)).reset(0));
        def!(left = m.reg(self.length));
        def!(is_data = phase.is(Phase::Data));
        def!(last = is_data & left.eq(1));
        let word = header.part(8 * (words - 1), 8);
        let (send, sent) = m.offer(!phase.is(Phase::Idle), SpiWord { word, last });
        def!(header_ends = sent & phase.is(Phase::Header) & place.eq(words - 1));
        phase.next(|phase| match phase {
            Phase::Idle => when(read.taken & read.length.ne(0), Phase::Header),
            Phase::Header => when(header_ends, Phase::Data),
            Phase::Data => when(sent & last, Phase::Idle),
        });
        let command = lit(8, if self.fast { 0x0b } else { 0x03 });
        let mut sent_first = vec![command, read.address];
        if self.fast {
            sent_first.push(lit(8, 0));
        }
        header.when(read.taken, concat(&sent_first)).when(sent, header << 8);
        place.when(header_ends, 0).when(sent & !is_data, place + 1);
        left.when(read.taken, read.length).when(sent & is_data, left - 1);

        // The master takes a word no sooner than the one received before it is taken. So what comes back is for the
        // word that was sent last.
        let block = SpiMaster { width: 8, half_period: self.half_period, mode: 0 };
        def!(master = m.instance(&block, SpiMasterIn { send, miso: i.miso }));
        def!(shows = m.reg(bit()).reset(0).when(sent, is_data));
        def!(ends = m.reg(bit()).when(sent, last));
        let (bytes, taken) = m.offer(master.received.valid & shows, PacketByte { byte: *master.received, last: *ends });
        m.cover("the memory waits for the receiver", bytes.valid & !bytes.ready);
        master.received.take_when(!shows | taken);
        SpiFlashReaderOut { bytes, sck: master.sck, mosi: master.mosi, cs_n: master.cs_n }
    }
}
