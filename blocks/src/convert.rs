//! Streams of a different width.

use crate::ports::{StreamIn, StreamOut, state_that_it_stays};
use tilewright_hdl::{Module, below, bit, bits, block, case, concat, def, mux, stream};

block! {
    /// Sends each word in parts, the least significant first.
    ///
    /// ```text
    /// into ===[ 3 | 2 | 1 | 0 ]===>|\
    ///                       [part]-|/===> out
    /// ```
    ///
    /// Latency 0, one part per clock. No `valid` waits for `ready`. `into.ready` equals `out.ready` at the last part,
    /// and is low otherwise.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Narrow, StreamIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// let (into, _) = m.offer(lit(1, 1), lit(12, 0xabc));
    /// def!(narrow = m.instance(&Narrow::new(3, 4), StreamIn { into }));
    /// let out = narrow.out;
    /// def!(part = *out.take_when(1));
    /// # });
    /// assert_eq!(example.values("part"), [0xc, 0xb, 0xa, 0xc]);
    /// ```
    pub struct Narrow {
        parts: u32,
        width: u32,
    }
    latency = "0 clocks";
    in(self) = StreamIn { into: stream(bits(self.parts * self.width)) };
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl Narrow {
    /// Splits each word into `parts` parts of `width` bits.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Narrow;
    ///
    /// // The input words have 12 bits.
    /// assert_eq!(Narrow::new(3, 4).inputs().into.payload.bits(), 12);
    /// ```
    ///
    /// # Panics
    ///
    /// `parts` or `width` is 0.
    #[track_caller]
    pub fn new(parts: u32, width: u32) -> Narrow {
        assert!(parts > 0 && width > 0, "a word of {parts} parts of {width} bits is nothing");
        Narrow { parts, width }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        def!(part = m.reg(below(self.parts)).reset(0));
        let at_end = part.eq(self.parts - 1);
        let word = i.into.payload;
        let parts = (0..self.parts - 1).map(|part| (part, word.part(part * self.width, self.width)));
        let payload = case(*part, parts, word.part((self.parts - 1) * self.width, self.width));
        let (out, sent) = m.offer(i.into.valid, payload);
        i.into.take_when(at_end & out.ready);
        part.when(sent, mux(at_end, 0, part + 1));
        StreamOut { out }
    }
}

block! {
    /// Joins several parts into a word, the least significant first.
    ///
    /// ```text
    /// into ===>[ 3 ][ 2 ][ 1 ][ 0 ]===> out      [full]
    /// ```
    ///
    /// Latency 1 clock from the last part, one part per clock. No `valid` waits for `ready`; `out.ready` passes to
    /// `into.ready`.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{StreamIn, Widen};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(1));
    /// let (into, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// def!(widen = m.instance(&Widen::new(2, 4), StreamIn { into }));
    /// let word = widen.out.take_when(1);
    /// def!(words = mux(word.taken, *word, 0));
    /// # });
    /// assert_eq!(example.values("words"), [0, 0, 0x21, 0, 0x43, 0]);
    /// ```
    pub struct Widen {
        parts: u32,
        width: u32,
    }
    latency = "1 clock";
    in(self) = StreamIn { into: stream(bits(self.width)) };
    out(self) = StreamOut { out: stream(bits(self.parts * self.width)) };
}

impl Widen {
    /// Joins `parts` parts of `width` bits into each word.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// use tilewright_blocks::Widen;
    ///
    /// // Each output word consists of three input words of 4 bits.
    /// assert_eq!(Widen::new(3, 4).inputs().into.payload.bits(), 4);
    /// ```
    ///
    /// # Panics
    ///
    /// `parts` or `width` is 0.
    #[track_caller]
    pub fn new(parts: u32, width: u32) -> Widen {
        assert!(parts > 0 && width > 0, "a word of {parts} parts of {width} bits is nothing");
        Widen { parts, width }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        def!(full = m.reg(bit()).reset(0));
        def!(part = m.reg(below(self.parts)).reset(0));
        let held: Vec<_> = (0..self.parts).map(|part| m.reg(&format!("held{part}"), self.width)).collect();
        let word: Vec<_> = held.iter().rev().map(|part| **part).collect();
        let (out, sent) = m.offer(full, concat(&word));
        let into = i.into.take_when(!full | out.ready);
        let at_end = part.eq(self.parts - 1);
        for (held, place) in held.into_iter().zip(0u64..) {
            held.when(into.taken & part.eq(place), *into);
        }
        part.when(into.taken, mux(at_end, 0, part + 1));
        full.when(into.taken & at_end, 1).when(sent, 0);
        state_that_it_stays(m, &out);
        StreamOut { out }
    }
}
