//! A stack.

use crate::ports::{StreamIn, StreamOut, state_that_it_stays};
use tilewright_hdl::{Module, ReadUnderWrite, bit, bits, block, def, mux, stream, up_to};

block! {
    /// A stack: sends the newest of its words, but a word once shown stays until it is taken.
    ///
    /// ```text
    ///             .---------------.
    /// into ======>| words [depth] |===>[held]===> out      last in, first out
    ///             '---------------'
    ///               used ^
    /// ```
    ///
    /// Throughput is one word per clock. The stack stores `depth` words and the one that it shows. Latency is 1 clock,
    /// in registers or distributed memory. There is no combinational path between any two ports.
    ///
    /// A word on a stream may not change, so words pushed while one is shown come out after it. This matters in the
    /// walk of a tree in which the children of a node replace it. The walk then alternates between two branches, and
    /// the stack has to store twice the nodes of one.
    ///
    /// ```
    /// # use tilewright_hdl::*;
    /// # use tilewright_blocks::{Lifo, StreamIn};
    /// # let example = tilewright_sim::traced(|m| {
    /// def!(count = m.reg(4).reset(0));
    /// let (into, sent) = m.offer(lit(1, 1), *count);
    /// count.when(sent, count + 1);
    /// m.instance("u_stack", &Lifo::new(3, 4), StreamIn { into }).out.take_when(0);
    /// # });
    /// assert_eq!(example.values("count"), [0, 1, 2, 3, 4, 4]); // three, and the one that is shown
    /// ```
    pub struct Lifo {
        depth: u32,
        width: u32,
    }
    latency = "1 clock";
    in(self) = StreamIn { into: stream(bits(self.width)) };
    out(self) = StreamOut { out: stream(bits(self.width)) };
}

impl Lifo {
    /// A stack of `depth` words, and the one that it shows, each of `width` bits.
    ///
    /// ```
    /// use tilewright_blocks::Lifo;
    /// let design = tilewright_hdl::elaborate(&Lifo::new(5, 8))?;
    /// assert_eq!(design.top().name, "lifo_depth5_width8");
    /// # Ok::<(), tilewright_hdl::Problems>(())
    /// ```
    ///
    /// # Panics
    ///
    /// `depth` is 0.
    #[track_caller]
    pub fn new(depth: u32, width: u32) -> Lifo {
        assert!(depth > 0 && width > 0, "a stack of {depth} words of {width} bits holds nothing");
        Lifo { depth, width }
    }

    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        def!(words = m.memory(self.depth, self.width, ReadUnderWrite::Any));
        def!(used = m.reg(up_to(self.depth)).reset(0));
        def!(shown = m.reg(bit()).reset(0));
        def!(held = m.reg(self.width));

        let (out, sent) = m.offer(shown, *held);
        let into = i.into.take_when(used.ne(self.depth));
        def!(moves = !shown | sent); // the word that comes in, or else the newest one, is shown
        def!(pushes = into.taken & !moves);
        def!(pops = moves & !into.taken & used.ne(0));
        words.write(pushes, used.low(), *into);
        used.when(pushes, used + 1).when(pops, used - 1);
        shown.when(moves, into.taken | pops);
        let newest = words.read_async((used - 1).low());
        held.when(moves, mux(into.taken, *into, newest));
        state_that_it_stays(m, &out);
        StreamOut { out }
    }
}
