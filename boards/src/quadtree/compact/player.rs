//! The player: sends the words of a step's packets.

use tilewright_hdl::{Bits, Module, below, bit, bits, block, def};
use tilewright_rtl::quadtree::format::Format;

use super::lanes::{Lane, Lanes, WORDS};

block! {
    /// Sends the words of one step after another, and begins with the first one again after the last.
    ///
    /// A word takes two clocks: one to read it, and one to send it.
    pub struct LanePlayer {
        /// The machine's format.
        pub format: Format,
        /// The words.
        pub lanes: Lanes,
    }
    in LanePlayerIn {
        /// High for one clock to send the packets of the next step; only if the previous ones are sent.
        go: bit(),
    }
    out(self) LanePlayerOut {
        /// The words.
        words: stream(Lane::widths(self.format)),
        /// All packets of the step are sent.
        done: bit(),
    }
}

impl LanePlayer {
    fn build(&self, m: Module, i: LanePlayerIn) -> LanePlayerOut {
        let words = m.rom("words", bits(self.lanes.word()), self.lanes.words().iter().map(Bits::clone));
        let count = self.lanes.words().len() as u32;
        def!(reads = m.reg(bit()).reset(0));
        def!(offers = m.reg(bit()).reset(0));
        def!(lane = m.reg(below(WORDS)).reset(0));
        def!(at = m.reg(below(count)).reset(0));
        let word = Lane::of(&self.format, words.read_when(reads, *at));
        at.when(reads & at.eq(count - 1), 0).when(reads, at + 1);

        let (words, sent) = m.offer(offers, word);
        def!(ends = sent & lane.eq(WORDS - 1) & word.is_last(&self.format));
        m.assume(i.go.implies(!reads & !offers), "a step begins when the previous one is sent");
        reads.next(i.go | (sent & !ends));
        offers.when(reads, 1).when(sent, 0);
        lane.when(sent, lane + 1);
        def!(done = m.reg(bit()).reset(1));
        done.when(i.go, 0).when(ends, 1);
        LanePlayerOut { words, done: *done }
    }
}
