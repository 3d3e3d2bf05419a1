//! Memories whose words are written byte by byte.

use tilewright_hdl::ir::About;
use tilewright_hdl::{Block, Clock, Module, ReadUnderWrite, Width, below, bits, block, bundle, row};

/// What such a memory holds at all.
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
    /// Latency 1 clock. `word` is what was there before the write of the same edge.
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
        /// Which word.
        address: below(self.depth),
        /// Which of its bytes are written, the lowest bit for the lowest byte.
        write: bits(self.bytes),
        /// What is written.
        data: bits(8 * self.bytes),
    }
    out(self) RamOut {
        /// What the word was.
        word: bits(8 * self.bytes),
    }
}

impl Ram {
    /// A memory of so many words of so many bytes.
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
    /// It has less than two words, or words of no byte.
    #[track_caller]
    pub fn new(depth: u32, bytes: u32) -> Ram {
        check(depth, bytes);
        Ram { depth, bytes }
    }

    fn build(&self, m: Module, i: RamIn) -> RamOut {
        if !self.depth.is_power_of_two() {
            m.assume(i.address.lt(self.depth), "an address is that of a word");
        }
        let bytes = row(self.bytes);
        let words =
            m.memory("words", self.depth, bits(8).of(bytes), ReadUnderWrite::Old).attribute("ram_style", "block");
        words.write(i.write.unpack(bytes), i.address, i.data.unpack(bytes));
        RamOut { word: words.read(i.address).pack() }
    }
}

bundle! {
    /// The inputs of [`DualClockRam`].
    ///
    /// ```
    /// use tilewright_blocks::DualClockRamIn;
    /// let upper_byte_of_5 = DualClockRamIn { to: 5, write: 0b10, data: 0xab00, from: 4 };
    /// assert_ne!(upper_byte_of_5.to, upper_byte_of_5.from); // what is written is not read yet
    /// ```
    pub struct DualClockRamIn<T> {
        /// Which word is written.
        pub to: T,
        /// Which of its bytes are, the lowest bit for the lowest byte.
        pub write: T,
        /// What is written.
        pub data: T,
        /// Which word is read, on the other clock.
        pub from: T,
    }

    /// The outputs of [`DualClockRam`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{DualClockRam, DualClockRamIn};
    /// # const HOST: Clock = Clock::new("host", Period::ns(10));
    /// # const VIDEO: Clock = Clock::new("video", Period::ns(14));
    /// let mut sim = tilewright_sim::Simulation::of(&DualClockRam::new(8, 1, HOST, VIDEO))?;
    /// sim.drive(DualClockRamIn { to: 5, write: 1, data: 7, from: 4 });
    /// sim.step_clock(HOST, 1);
    /// sim.drive(DualClockRamIn { to: 5, write: 0, data: 0, from: 5 });
    /// sim.step_clock(VIDEO, 1);
    /// assert_eq!(sim.get(sim.o.word), 7);
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct DualClockRamOut<T> {
        /// The word that is read.
        pub word: T,
    }
}

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
/// Latency 1 clock of the reader. What is read of a word that is written at the same time may be anything: who reads has to know which words
/// are done, as [`DualClockFifo`](crate::DualClockFifo) does by its pointers.
///
/// ```
/// use tilewright_blocks::DualClockRam;
/// use tilewright_hdl::{Clock, Period, elaborate};
///
/// const HOST: Clock = Clock::new("host", Period::ns(10));
/// const VIDEO: Clock = Clock::new("video", Period::ns(14));
///
/// let design = elaborate(&DualClockRam::new(640, 3, HOST, VIDEO))?; // a line of a picture
/// assert_eq!(design.top().clocks.len(), 2);
/// # Ok::<(), tilewright_hdl::Problems>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct DualClockRam {
    depth: u32,
    bytes: u32,
    writes: Clock,
    reads: Clock,
}

impl DualClockRam {
    /// A memory of so many words of so many bytes, between these clocks.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::DualClockRam;
    /// # const HOST: Clock = Clock::new("host", Period::ns(10));
    /// # const VIDEO: Clock = Clock::new("video", Period::ns(14));
    /// let ram = DualClockRam::new(16, 4, HOST, VIDEO);
    /// assert_eq!(ram.name(), "dual_clock_ram_depth16_bytes4_host_to_video");
    /// ```
    ///
    /// # Panics
    ///
    /// It has less than two words, or words of no byte, or the clocks are one.
    #[track_caller]
    pub fn new(depth: u32, bytes: u32, writes: Clock, reads: Clock) -> DualClockRam {
        check(depth, bytes);
        assert!(writes.name != reads.name, "a dual-clock memory on clock `{}` alone: take `Ram`", writes.name);
        DualClockRam { depth, bytes, writes, reads }
    }
}

impl Block for DualClockRam {
    type In = DualClockRamIn;
    type Out = DualClockRamOut;

    fn inputs(&self) -> DualClockRamIn<Width> {
        DualClockRamIn {
            to: below(self.depth).on(self.writes),
            write: bits(self.bytes).on(self.writes),
            data: bits(8 * self.bytes).on(self.writes),
            from: below(self.depth).on(self.reads),
        }
    }

    fn build(&self, m: Module, i: DualClockRamIn) -> DualClockRamOut {
        if !self.depth.is_power_of_two() {
            m.on(self.writes).assume(i.to.lt(self.depth), "an address is that of a word");
            m.on(self.reads).assume(i.from.lt(self.depth), "an address is that of a word");
        }
        let bytes = row(self.bytes);
        let words =
            m.memory("words", self.depth, bits(8).of(bytes), ReadUnderWrite::Any).attribute("ram_style", "block");
        words.on(self.writes).write(i.write.unpack(bytes), i.to, i.data.unpack(bytes));
        DualClockRamOut { word: words.on(self.reads).read(i.from).pack() }
    }
    fn about(&self) -> About {
        About {
            summary: "A memory that one clock writes byte by byte and another one reads.".into(),
            latency: "1 clock of the reader".into(),
            ..About::default()
        }
    }

    fn name(&self) -> String {
        format!("dual_clock_ram_depth{}_bytes{}_{}_to_{}", self.depth, self.bytes, self.writes.name, self.reads.name)
    }
}
