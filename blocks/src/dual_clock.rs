//! A queue from one clock to another.

use crate::ports::{StreamIn, StreamOut, state_that_it_stays};
use tilewright_hdl::{Clock, Module, ReadUnderWrite, Signal, bit, bits, block, concat, def, stream};

block! {
    /// A queue from one clock to another, with pointers in Gray code.
    ///
    /// ```text
    ///                 write clock | read clock
    ///             .---------------|---------.
    /// into ======>| words [depth] |         |======> out
    ///             '---------------|---------'
    ///   free --> gray ----------[ 2 ]-----> filled?
    ///   full? <---------------[ 2 ]-------- gray <-- oldest
    /// ```
    ///
    /// Each side gets the other's pointer in Gray code, through two registers. Only one bit changes at a time, so the
    /// side sees the pointer's current or an earlier value. So the queue may look fuller to the writer than it is, and
    /// emptier to the reader, but never the reverse.
    ///
    /// Latency 3 clocks of the reader after the writer's edge that takes a word: two for the pointer, one for the
    /// memory. If the edges of both clocks coincide, hardware may need one more. There is no combinational path between
    /// any two ports. Both resets must be asserted together.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::{DualClockFifo, StreamIn};
    ///
    /// const HOST: Clock = Clock::new("host", Period::ns(10));
    /// const VIDEO: Clock = Clock::new("video", Period::ns(14));
    ///
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.on(HOST).reg(4).reset(0));
    /// let (into, sent) = m.on(HOST).offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// let queue = DualClockFifo::new(4, 4, HOST, VIDEO);
    /// m.instance("u_queue", &queue, StreamIn { into }).out.take_when(0);
    /// # });
    /// // The edges of both clocks up to 60 ns. No word is taken out, so the queue accepts four.
    /// assert_eq!(example.values("count"), [0, 1, 1, 2, 2, 3, 4, 4, 4, 4]);
    /// ```
    pub struct DualClockFifo {
        depth: u32,
        width: u32,
        write: Clock,
        read: Clock,
    }
    latency = "3 clocks of the reader, or 4 if the edges of both clocks coincide";
    in(self) = StreamIn { into: stream(bits(self.width)).on(self.write) };
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl DualClockFifo {
    /// A queue of `depth` words, a power of two from 2 on, of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::DualClockFifo;
    ///
    /// const HOST: Clock = Clock::new("host", Period::ns(10));
    /// const VIDEO: Clock = Clock::new("video", Period::ns(14));
    ///
    /// let queue = DualClockFifo::new(16, 8, HOST, VIDEO);
    /// assert_eq!(queue.name(), "dual_clock_fifo_depth16_width8_write_host_read_video");
    /// ```
    ///
    /// # Panics
    ///
    /// `depth` is not a power of two, or both clocks are the same.
    #[track_caller]
    pub fn new(depth: u32, width: u32, write: Clock, read: Clock) -> DualClockFifo {
        assert!(
            depth > 1 && depth.is_power_of_two(),
            "a dual-clock FIFO of {depth} words: Gray code needs a power of two from 2 on"
        );
        assert!(width > 0, "a FIFO of {depth} words of 0 bits holds nothing");
        assert!(write.name != read.name, "a dual-clock FIFO on clock `{}` alone: use `Fifo`", write.name);
        DualClockFifo { depth, width, write, read }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        let (write, read) = (m.on(self.write), m.on(self.read));
        def!(words = m.memory(self.depth, self.width, ReadUnderWrite::Any));
        let address = words.address_width(); // One bit more tells full from empty.
        def!(free = write.reg(address + 1).reset(0));
        def!(free_gray = write.reg(address + 1).reset(0));
        def!(oldest = read.reg(address + 1).reset(0));
        def!(oldest_gray = read.reg(address + 1).reset(0));

        // In Gray code the pointers are `depth` apart if their two upper bits differ and no others.
        let seen_oldest = cross(write, "seen_oldest", *oldest_gray);
        def!(full = (free_gray ^ seen_oldest).eq(3u64 << (address - 1)));
        let into = i.into.take_when(!full);
        words.on(self.write).write(into.taken, free.low(), *into);
        def!(next_free = free + into.taken.zext(address + 1));
        free.next(next_free);
        free_gray.next(gray(next_free));

        let seen_free = cross(read, "seen_free", *free_gray);
        def!(shown = read.reg(bit()).reset(0));
        let (out, sent) = read.offer(shown, ());
        def!(next_oldest = oldest + sent.zext(address + 1));
        oldest.next(next_oldest);
        oldest_gray.next(gray(next_oldest));
        def!(filled = gray(next_oldest).ne(seen_free));
        shown.next(filled);
        let word = words.on(self.read).read_when(filled, next_oldest.low());
        let out = out.with(word);
        state_that_it_stays(read, &out);
        StreamOut { out }
    }
}

/// The Gray code of a number: the codes of consecutive numbers differ in one bit.
fn gray(number: Signal) -> Signal {
    number ^ (number >> 1)
}

/// A Gray code from another clock, synchronized through two registers of this one for each bit.
#[track_caller]
fn cross(m: Module, name: &str, code: Signal) -> Signal {
    // A loop, because a closure would be the caller in error messages.
    let mut bits = Vec::new();
    for bit in (0..code.width()).rev() {
        bits.push(m.synchronize(&format!("{name}{bit}"), code.bit(bit)));
    }
    concat(&bits)
}
