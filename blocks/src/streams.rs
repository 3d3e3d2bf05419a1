//! The blocks of streams as methods of a module, for streams of any payload.

use crate::arbiter::{Arbiter, ArbiterIn, Turns};
use crate::convert::{Narrow, Widen};
use crate::dual_clock::DualClockFifo;
use crate::fifo::{Fifo, Storage};
use crate::fork::Fork;
use crate::lifo::Lifo;
use crate::ports::StreamIn;
use crate::slice::{RegisterSlice, Slice};
use crate::split::{goes_to_one_of, split};
use tilewright_hdl::{Clock, Data, Module, Signal, Stream};

/// Methods that pass streams through blocks. Each makes an instance with the given name, which carries the fields of a
/// record side by side. One module serves all records of the same number of bits. So inside it, waves and Verilog show
/// one `payload`. See [the crate](crate) for an example.
///
/// ```
/// # use tilewright_hdl::*;
/// # use tilewright_blocks::{Slice, StreamBlocks};
/// # tilewright_sim::example(|m| {
/// bundle! { struct Job<T> { page: T, last: T } }
///
/// let (jobs, _) = m.offer(lit(1, 1), Job { page: lit(4, 11), last: lit(1, 1) });
/// let queued = m.fifo("u_queue", 4, jobs);
/// let job = m.slice("u_slice", Slice::Both, queued).take_when(1);
/// m.assert(job.taken.implies(job.page.eq(11) & job.last), "what comes out is a `Job` again");
/// # });
/// ```
pub trait StreamBlocks {
    /// The stream through a queue of `depth` words in registers: [`Fifo`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::StreamBlocks;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(5));
    /// let (numbers, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// let number = m.fifo("u_queue", 4, numbers).take_when(1);
    /// def!(out = mux(number.taken, *number, 0));
    /// # });
    /// assert_eq!(example.values("out"), [0, 5, 6, 7]);
    /// ```
    #[track_caller]
    fn fifo<P: Data>(self, name: &str, depth: u32, stream: Stream<P>) -> Stream<P>;

    /// The stream through a queue of `depth` words in a block RAM: [`Fifo`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::StreamBlocks;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(5));
    /// let (numbers, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// let number = m.block_ram_fifo("u_queue", 512, numbers).take_when(1);
    /// def!(out = mux(number.taken, *number, 0));
    /// # });
    /// assert_eq!(example.values("out"), [0, 0, 5, 6]); // a clock later than from registers
    /// ```
    #[track_caller]
    fn block_ram_fifo<P: Data>(self, name: &str, depth: u32, stream: Stream<P>) -> Stream<P>;

    /// The stream through a stack of `depth` words, and the one that it shows: [`Lifo`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::StreamBlocks;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (numbers, sent) = m.offer(count.lt(3), *count);
    /// count.when(sent, count + 1);
    /// let number = m.lifo("u_stack", 4, numbers).take_when(count.eq(3));
    /// def!(out = mux(number.taken, *number, 15));
    /// # });
    /// assert_eq!(example.values("out"), [15, 15, 15, 0, 2, 1]); // 0 is shown first, and stays until it is taken
    /// ```
    #[track_caller]
    fn lifo<P: Data>(self, name: &str, depth: u32, stream: Stream<P>) -> Stream<P>;

    /// The stream from one clock to another, through a queue of `depth` words: [`DualClockFifo`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::StreamBlocks;
    ///
    /// const HOST: Clock = Clock::new("host", Period::ns(10));
    /// const VIDEO: Clock = Clock::new("video", Period::ns(14));
    ///
    /// # let example = tilewright_sim::traced(|m| {
    /// let (colours, _) = m.on(HOST).offer(lit(1, 1), lit(24, 0xff8000));
    /// let shown = m.cross_by_fifo("u_crossing", 16, (HOST, VIDEO), colours);
    /// let colour = shown.take_when(1);
    /// def!(rgb = m.on(VIDEO).reg(24).reset(0));
    /// rgb.when(colour.taken, *colour);
    /// # });
    /// let rgb: [u64; 14] = example.values("rgb");
    /// assert_eq!((rgb[0], rgb[13]), (0, 0xff8000));
    /// ```
    #[track_caller]
    fn cross_by_fifo<P: Data>(self, name: &str, depth: u32, clocks: (Clock, Clock), stream: Stream<P>) -> Stream<P>;

    /// The stream through registers: [`RegisterSlice`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Slice, StreamBlocks};
    /// # let example = tilewright_sim::traced(|m| {
    /// let (words, _) = m.offer(lit(1, 1), lit(8, 7));
    /// let word = m.slice("u_slice", Slice::Forward, words).take_when(1);
    /// def!(taken = word.taken);
    /// # });
    /// assert_eq!(example.values("taken"), [0, 1, 1]);
    /// ```
    #[track_caller]
    fn slice<P: Data>(self, name: &str, cuts: Slice, stream: Stream<P>) -> Stream<P>;

    /// The stream to `N` receivers, each of which gets every word: [`Fork`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::StreamBlocks;
    /// # tilewright_sim::example(|m| {
    /// let (words, _) = m.offer(lit(1, 1), lit(8, 7));
    /// let [left, right] = m.fork("u_fork", words);
    /// let (left, right) = (left.take_when(1), right.take_when(1));
    /// m.assert(left.taken & right.taken & left.eq(*right), "both get the word");
    /// # });
    /// ```
    #[track_caller]
    fn fork<P: Data, const N: usize>(self, name: &str, stream: Stream<P>) -> [Stream<P>; N];

    /// The stream to one of `N` receivers for each word: `to` computes the receiver's number from the word. This is
    /// logic in the module, not an instance; [`Split`](crate::Split) is the same as a block.
    ///
    /// ```text
    ///              .===> 0
    /// stream ===>--+===> 1
    ///          to--'===> 2
    /// ```
    ///
    /// Latency 0. `valid` waits for no `ready`; the stream's `ready` is that of the word's receiver. A number without a
    /// receiver is a mistake of the design, and fails an assertion.
    ///
    /// ```
    /// # use tilewright_blocks::*;
    /// # use tilewright_hdl::*;
    /// # block! {
    /// #     /// Tells even from odd.
    /// #     struct Parity;
    /// #     in ParityIn { words: stream(8) }
    /// #     out ParityOut { even: stream(8), odd: stream(8) }
    /// # }
    /// # impl Parity {
    /// #     fn build(&self, m: Module, i: ParityIn) -> ParityOut {
    /// let [even, odd] = m.split_by(i.words, |word| word.bit(0));
    /// #         ParityOut { even, odd }
    /// #     }
    /// # }
    /// # elaborate(&Parity)?;
    /// # Ok::<(), Problems>(())
    /// ```
    #[track_caller]
    fn split_by<P: Data, const N: usize>(self, stream: Stream<P>, to: impl FnOnce(&P) -> Signal) -> [Stream<P>; N];

    /// The streams to one receiver, one word after another: [`Arbiter`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{StreamBlocks, Turns};
    /// # let example = tilewright_sim::traced(|m| {
    /// let streams = [1, 2, 3].map(|word| m.offer(lit(1, 1), lit(8, word)).0);
    /// def!(word = *m.arbiter("u_arbiter", Turns::RoundRobin, streams).take_when(1));
    /// # });
    /// assert_eq!(example.values("word"), [1, 2, 3, 1, 2]);
    /// ```
    #[track_caller]
    fn arbiter<P: Data>(self, name: &str, turns: Turns, streams: impl IntoIterator<Item = Stream<P>>) -> Stream<P>;

    /// Joins a word of each stream by the function `both`. This is logic in the module, not an instance;
    /// [`Join`](crate::Join) is a block for it.
    ///
    /// ```text
    /// left ====>|
    ///           |&===> both(left, right)
    /// right ===>|
    /// ```
    ///
    /// Latency 0. `valid` waits for no `ready`; each stream's `ready` is high when both words are taken.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::StreamBlocks;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (left, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// def!(half = m.reg(1).reset(0));
    /// half.next(!half);
    /// let (right, _) = m.offer(*half, lit(4, 10));
    ///
    /// let sum = m.join(left, right, |left, right| left + right).take_when(1);
    /// def!(sums = mux(sum.taken, *sum, 0));
    /// # });
    /// assert_eq!(example.values("sums"), [0, 10, 0, 11, 0, 12]); // one waits for the other
    /// ```
    #[track_caller]
    fn join<P: Data, Q: Data, R: Data>(
        self,
        left: Stream<P>,
        right: Stream<Q>,
        both: impl FnOnce(P, Q) -> R,
    ) -> Stream<R>;

    /// The stream with each word in `parts` parts, the least significant first: [`Narrow`]. A word's width must be a
    /// multiple of `parts`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::StreamBlocks;
    /// # let example = tilewright_sim::traced(|m| {
    /// let (words, _) = m.offer(lit(1, 1), lit(12, 0xabc));
    /// def!(part = *m.narrow("u_narrow", 3, words).take_when(1));
    /// # });
    /// assert_eq!(example.values("part"), [0xc, 0xb, 0xa, 0xc]);
    /// ```
    #[track_caller]
    fn narrow(self, name: &str, parts: u32, stream: Stream) -> Stream;

    /// The stream with each word joined from `parts` parts, the least significant first: [`Widen`].
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::StreamBlocks;
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(1));
    /// let (digits, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// let word = m.widen("u_widen", 2, digits).take_when(1);
    /// def!(words = mux(word.taken, *word, 0));
    /// # });
    /// assert_eq!(example.values("words"), [0, 0, 0x21, 0, 0x43]);
    /// ```
    #[track_caller]
    fn widen(self, name: &str, parts: u32, stream: Stream) -> Stream;
}

impl StreamBlocks for Module {
    fn fifo<P: Data>(self, name: &str, depth: u32, stream: Stream<P>) -> Stream<P> {
        let into = stream.packed();
        let fifo = Fifo::new(depth, into.width(), Storage::Registers);
        self.instance(name, &fifo, StreamIn { into }).out.unpacked(&stream.payload)
    }

    fn block_ram_fifo<P: Data>(self, name: &str, depth: u32, stream: Stream<P>) -> Stream<P> {
        let into = stream.packed();
        let fifo = Fifo::new(depth, into.width(), Storage::BlockRam);
        self.instance(name, &fifo, StreamIn { into }).out.unpacked(&stream.payload)
    }

    fn lifo<P: Data>(self, name: &str, depth: u32, stream: Stream<P>) -> Stream<P> {
        let into = stream.packed();
        let lifo = Lifo::new(depth, into.width());
        self.instance(name, &lifo, StreamIn { into }).out.unpacked(&stream.payload)
    }

    fn cross_by_fifo<P: Data>(
        self,
        name: &str,
        depth: u32,
        (write, read): (Clock, Clock),
        stream: Stream<P>,
    ) -> Stream<P> {
        let into = stream.packed();
        let fifo = DualClockFifo::new(depth, into.width(), write, read);
        self.instance(name, &fifo, StreamIn { into }).out.unpacked(&stream.payload)
    }

    fn slice<P: Data>(self, name: &str, cuts: Slice, stream: Stream<P>) -> Stream<P> {
        let into = stream.packed();
        let slice = RegisterSlice { width: into.width(), cuts };
        self.instance(name, &slice, StreamIn { into }).out.unpacked(&stream.payload)
    }

    fn fork<P: Data, const N: usize>(self, name: &str, stream: Stream<P>) -> [Stream<P>; N] {
        let into = stream.packed();
        let out = self.instance(name, &Fork::new(N as u32, into.width()), StreamIn { into }).out;
        // A loop, because a closure would be the caller in error messages.
        let mut streams = Vec::with_capacity(N);
        for out in out {
            streams.push(out.unpacked(&stream.payload));
        }
        let Ok(streams) = streams.try_into() else { unreachable!("a fork has as many outputs as receivers") };
        streams
    }

    fn split_by<P: Data, const N: usize>(self, stream: Stream<P>, to: impl FnOnce(&P) -> Signal) -> [Stream<P>; N] {
        let (streams, has_receiver) = split(self, &stream, to(&stream.payload), N as u32);
        // The surrounding module computes the number from the word, so a number without a receiver is its mistake.
        if let Some(has_receiver) = has_receiver {
            self.assert(has_receiver, &goes_to_one_of(N as u32));
        }
        let Ok(streams) = streams.try_into() else { unreachable!("there is a stream for each receiver") };
        streams
    }

    fn arbiter<P: Data>(self, name: &str, turns: Turns, streams: impl IntoIterator<Item = Stream<P>>) -> Stream<P> {
        let (mut into, mut like) = (Vec::new(), None);
        for stream in streams {
            into.push(stream.packed());
            like.get_or_insert(stream.payload);
        }
        let width = into.first().map_or(1, |stream| stream.width());
        let arbiter = Arbiter::new(into.len() as u32, width, turns);
        let out = self.instance(name, &arbiter, ArbiterIn { into }).out;
        out.unpacked(&like.expect("an arbiter has a sender"))
    }

    fn join<P: Data, Q: Data, R: Data>(
        self,
        left: Stream<P>,
        right: Stream<Q>,
        both: impl FnOnce(P, Q) -> R,
    ) -> Stream<R> {
        let (out, sent) = self.offer(left.valid & right.valid, both(left.payload.clone(), right.payload.clone()));
        left.take_when(sent);
        right.take_when(sent);
        out
    }

    fn narrow(self, name: &str, parts: u32, stream: Stream) -> Stream {
        let narrow = Narrow::new(parts, (stream.width() / parts.max(1)).max(1));
        self.instance(name, &narrow, StreamIn { into: stream }).out
    }

    fn widen(self, name: &str, parts: u32, stream: Stream) -> Stream {
        self.instance(name, &Widen::new(parts, stream.width()), StreamIn { into: stream }).out
    }
}
