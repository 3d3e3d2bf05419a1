//! Memories whose words are written byte by byte.

use tilewright_hdl::{Clock, Module, ReadUnderWrite, below, bits, block, row};

/// Panics if a memory is too small.
#[track_caller]
fn check(depth: u32, bytes: u32) {
    assert!(depth > 1 && bytes > 0, "a memory of {depth} words of {bytes} bytes: it has 2 words of 1 byte or more");
}

block! {
    /// A memory with one port, whose words are written byte by byte.
    ///
    /// ```text
    ///   address ==>.---------------.
    ///     write ==>| words [depth] |==> word
    ///      data ==>'---------------'
    /// ```
    ///
    /// Latency 1 clock. `word` is the contents before the write of the same edge.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Ram, RamIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(first = m.reg(1).reset(1));
    /// first.next(0);
    /// let write = mux(*first, lit(2, 0b11), 0b10); // both bytes, then the upper one
    /// let data = mux(*first, lit(16, 0x1122), 0x3344);
    /// def!(word = m.instance("u_ram", &Ram::new(256, 2), RamIn { address: lit(8, 5), write, data }).word);
    /// # });
    /// assert_eq!(example.values("word"), [0, 0, 0x1122, 0x3322]);
    /// ```
    pub struct Ram {
        depth: u32,
        bytes: u32,
    }
    latency = "1 clock";
    in(self) RamIn {
        /// The address of the word.
        address: below(self.depth),
        /// The bytes of the word that are written: a bit for each, the lowest for the lowest byte.
        write: bits(self.bytes),
        /// The bytes to write.
        data: bits(8 * self.bytes),
    }
    out(self) RamOut {
        /// The word as it was before the write.
        word: bits(8 * self.bytes),
    }
}

impl Ram {
    /// A memory of `depth` words of `bytes` bytes.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Ram;
    ///
    /// let design = elaborate(&Ram::new(1024, 4))?;
    /// assert_eq!(design.top().memories[0].attributes[0].name, "ram_style"); // a block RAM
    /// # Ok::<(), Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `depth` is below 2, or `bytes` is 0.
    #[track_caller]
    pub fn new(depth: u32, bytes: u32) -> Ram {
        check(depth, bytes);
        Ram { depth, bytes }
    }

    fn build(&self, m: Module, i: RamIn) -> RamOut {
        if !self.depth.is_power_of_two() {
            m.assume(i.address.lt(self.depth), "an address is in range");
        }
        let bytes = row(self.bytes);
        let words =
            m.memory("words", self.depth, bits(8).of(bytes), ReadUnderWrite::Old).attribute("ram_style", "block");
        words.write(i.write.unpack(bytes), i.address, i.data.unpack(bytes));
        RamOut { word: words.read(i.address).pack() }
    }
}

block! {
    /// A memory that one clock writes byte by byte and another one reads.
    ///
    /// ```text
    ///                 write clock | read clock
    ///             .---------------|---------.
    ///   to, data =>               |         |<= from
    ///      write =>  words [depth]|         |=> word
    ///             '---------------|---------'
    /// ```
    ///
    /// Latency 1 clock of the reader. Reading a word while it is written may return anything. So the reader has to know
    /// which words are complete, as [`DualClockFifo`](crate::DualClockFifo) does by its pointers.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{DualClockRam, DualClockRamIn};
    /// # const HOST: Clock = Clock::new("host", Period::ns(10));
    /// # const VIDEO: Clock = Clock::new("video", Period::ns(14));
    /// let mut sim = tilewright_sim::Simulation::of(&DualClockRam::new(8, 2, HOST, VIDEO))?;
    /// sim.drive(DualClockRamIn { to: 5, write: 0b11, data: 0xabcd, from: 4 });
    /// sim.step_clock(HOST, 1);
    /// sim.drive(DualClockRamIn { to: 5, write: 0b10, data: 0x1234, from: 4 }); // the upper byte alone
    /// sim.step_clock(HOST, 1);
    /// sim.drive(DualClockRamIn { to: 5, write: 0, data: 0, from: 5 });
    /// sim.step_clock(VIDEO, 1);
    /// assert_eq!(sim.get(sim.o.word), 0x12cd);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct DualClockRam {
        depth: u32,
        bytes: u32,
        write: Clock,
        read: Clock,
    }
    latency = "1 clock of the reader";
    in(self) DualClockRamIn {
        /// The address of the word that is written.
        to: below(self.depth).on(self.write),
        /// The bytes of the word that are written: a bit for each, the lowest for the lowest byte.
        write: bits(self.bytes).on(self.write),
        /// The bytes to write.
        data: bits(8 * self.bytes).on(self.write),
        /// The address of the word that is read, on the other clock.
        from: below(self.depth).on(self.read),
    }
    out(self) DualClockRamOut {
        /// The word that is read.
        word: bits(8 * self.bytes),
    }
}

impl DualClockRam {
    /// A memory of `depth` words of `bytes` bytes, between these clocks.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::DualClockRam;
    /// # const HOST: Clock = Clock::new("host", Period::ns(10));
    /// # const VIDEO: Clock = Clock::new("video", Period::ns(14));
    /// let line_of_a_picture = DualClockRam::new(640, 3, HOST, VIDEO);
    /// assert_eq!(line_of_a_picture.name(), "dual_clock_ram_depth640_bytes3_write_host_read_video");
    /// ```
    ///
    /// # Panics
    ///
    /// `depth` is below 2, `bytes` is 0, or both clocks are the same.
    #[track_caller]
    pub fn new(depth: u32, bytes: u32, write: Clock, read: Clock) -> DualClockRam {
        check(depth, bytes);
        assert!(write.name != read.name, "a dual-clock memory on clock `{}` alone: use `Ram`", write.name);
        DualClockRam { depth, bytes, write, read }
    }

    fn build(&self, m: Module, i: DualClockRamIn) -> DualClockRamOut {
        if !self.depth.is_power_of_two() {
            m.on(self.write).assume(i.to.lt(self.depth), "an address is in range");
            m.on(self.read).assume(i.from.lt(self.depth), "an address is in range");
        }
        let bytes = row(self.bytes);
        let words =
            m.memory("words", self.depth, bits(8).of(bytes), ReadUnderWrite::Any).attribute("ram_style", "block");
        words.on(self.write).write(i.write.unpack(bytes), i.to, i.data.unpack(bytes));
        DualClockRamOut { word: words.on(self.read).read(i.from).pack() }
    }
}
