//! A queue.
//!
//! ```text
//!             .---------------.
//! into ======>| words [depth] |======> out      first in, first out
//!             '---------------'
//!          free ^   used   ^ oldest
//! ```
//!
//! Throughput is one word per clock if the depth is at least 2 words, or 3 in a block RAM. `out` shows the oldest word
//! before it is taken (first word falls through). Latency is 1 clock in registers or distributed memory, and 2 in a
//! block RAM, whose read takes one. There is no combinational path between any two ports.

use crate::ports::{StreamIn, StreamOut, state_that_it_stays};
use tilewright_hdl::{Module, ReadUnderWrite, Reg, Signal, Stream, Taken, bit, bits, block, def, mux, stream, up_to};

/// Up to this many words are kept in registers that shift when one is taken. More words stay where they were written,
/// because selecting one then costs less than moving all.
const MOST_SHIFTED: u32 = 2;

/// The storage of a [`Fifo`]'s words.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{Fifo, Storage, StreamIn};
/// # let example = tilewright_sim::traced(|m| {
/// let (into, _) = m.offer(lit(1, 1), lit(8, 7));
/// let queue = Fifo::new(4, 8, Storage::BlockRam);
/// def!(taken = m.instance("u_queue", &queue, StreamIn { into }).out.take_when(1).taken);
/// # });
/// assert_eq!(example.values("taken"), [0, 0, 1, 1]); // 2 clocks, then one word per clock
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Storage {
    /// Registers for one or two words, otherwise an FPGA's distributed memory, which is read in the same clock.
    Registers,
    /// A block RAM, which is read at an edge.
    BlockRam,
}

block! {
    /// A queue: sends words in the sequence in which they arrive, and shows the oldest before it is taken.
    ///
    /// It stores up to `depth` words; see [the table](crate) for its latency. One module serves all records of the same
    /// number of bits. So inside it, waves and Verilog show a record as one `payload`; its fields get their names back
    /// at the output.
    ///
    /// ```text
    ///             .---------------.
    /// into ======>| words [depth] |======> out
    ///             '---------------'
    ///          free ^   used   ^ oldest
    /// ```
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Fifo, Storage, StreamIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (into, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// let queue = Fifo::new(3, 4, Storage::Registers);
    /// m.instance("u_queue", &queue, StreamIn { into }).out.take_when(0);
    /// # });
    /// assert_eq!(example.values("count"), [0, 1, 2, 3, 3, 3]); // the queue is full
    /// ```
    pub struct Fifo {
        depth: u32,
        width: u32,
        storage: Storage,
    }
    latency(self) = match self.storage {
        Storage::Registers => "1 clock",
        Storage::BlockRam => "2 clocks",
    };
    in(self) = StreamIn { into: stream(bits(self.width)) };
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl Fifo {
    /// A queue of `depth` words, which need not be a power of two, each of `width` bits.
    ///
    /// ```
    /// use tilewright_blocks::{Fifo, Storage};
    /// let design = tilewright_hdl::elaborate(&Fifo::new(5, 8, Storage::Registers))?;
    /// assert_eq!(design.top().name, "fifo_depth5_width8_storage_registers");
    /// # Ok::<(), tilewright_hdl::Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `depth` is 0.
    #[track_caller]
    pub fn new(depth: u32, width: u32, storage: Storage) -> Fifo {
        assert!(depth > 0 && width > 0, "a FIFO of {depth} words of {width} bits holds nothing");
        Fifo { depth, width, storage }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        def!(used = m.reg(up_to(self.depth)).reset(0));
        let into = i.into.take_when(used.ne(self.depth));
        let (out, sent) = match self.storage {
            Storage::Registers if self.depth <= MOST_SHIFTED => self.shifted(m, used, &into),
            _ => self.addressed(m, used, &into),
        };
        used.when(into.taken & !sent, used + 1).when(sent & !into.taken, used - 1);
        m.assert(used.le(self.depth), "at most `depth` words are stored");
        state_that_it_stays(m, &out);
        m.cover("the queue is full", m.rose(used.eq(self.depth)));
        m.cover("the queue becomes empty", m.rose(used.eq(0)));
        StreamOut { out }
    }

    /// Keeps the words in registers, the oldest in the first. When that is taken, the others move up. So the output
    /// needs no multiplexer.
    fn shifted(&self, m: Module, used: Reg, into: &Taken<Signal>) -> (Stream, Signal) {
        let words: Vec<Reg> = (0..self.depth).map(|place| m.reg(&format!("word{place}"), self.width)).collect();
        let (out, sent) = m.offer(used.ne(0), *words[0]);
        for (place, word) in (0..self.depth).zip(&words) {
            let arrives = into.taken & mux(sent, used.eq(place + 1), used.eq(place));
            let word = word.when(arrives, **into);
            if let Some(behind) = words.get(place as usize + 1) {
                word.when(sent, *behind);
            }
        }
        (out, sent)
    }

    /// Keeps the words in a memory, each at the address where it was written.
    fn addressed(&self, m: Module, used: Reg, into: &Taken<Signal>) -> (Stream, Signal) {
        def!(words = m.memory(self.depth, self.width, ReadUnderWrite::Any));
        let address = words.address_width();
        def!(free = m.reg(address).reset(0));
        def!(oldest = m.reg(address).reset(0));
        let after = |pointer: Reg| mux(pointer.eq(self.depth - 1), 0, pointer + 1);
        words.write(into.taken, free, **into);
        free.when(into.taken, after(free));
        let (out, sent) = match self.storage {
            Storage::Registers => m.offer(used.ne(0), words.read_async(oldest)),
            Storage::BlockRam => {
                // A word written at this edge is not read at it: `used` does not count it yet.
                def!(shown = m.reg(bit()).reset(0));
                let (out, sent) = m.offer(shown, ());
                def!(filled = mux(sent, used.ne(1), used.ne(0)));
                shown.next(filled);
                (out.with(words.read_when(filled, mux(sent, after(oldest), oldest))), sent)
            }
        };
        oldest.when(sent, after(oldest));
        (out, sent)
    }
}
