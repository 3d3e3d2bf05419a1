//! Represents a processing element and its program: draws patches at random places, a pixel now and then.

use tilewright_hdl::{Module, Reg, bits, block, cat, codes, def, index_width, lit, mux, one_of, when};
use tilewright_rtl::bus::BusWord;
use tilewright_rtl::lfb::{Patches, Request, Wanted};
use tilewright_rtl::swap::SwapState;
use tilewright_rtl::vc1::ProcessorIn;
use tilewright_rtl::word::WORD;

use crate::word::{below, xorshift};

codes! {
    /// The state of a painter.
    enum Phase {
        /// Clears the patch table, entry by entry.
        Clear,
        /// Draws.
        Draw,
        /// Waits for the others.
        Wait,
    }
}

block! {
    /// A painter on a screen of these patches, of 4x4 pixels.
    pub struct Painter {
        pub patches: Patches,
        /// The patches for a frame.
        pub painted: u32,
    }
    in PainterIn {
        /// The seed of the random generator.
        seed: bits(32),
        /// The state of the buffer swap: whether it may clear or draw.
        state: one_of::<SwapState>(),
    }
    out PainterOut {
        /// To the local frame buffer.
        vc1: ProcessorIn = _,
        /// A hash of the drawn pixels and their times.
        hash: bits(32),
    }
}

impl Painter {
    fn build(&self, m: Module, i: PainterIn) -> PainterOut {
        def!(phase = m.fsm(Phase::Clear));
        def!(seeded = m.reg(1).reset(0));
        seeded.next(true);
        def!(random = m.reg(32));
        random.next(mux(seeded, xorshift(*random), i.seed));

        def!(entry = m.reg(self.patches.patch_width()).reset(0));
        let (clear, cleared) = m.offer(phase.is(Phase::Clear) & i.state.eq(SwapState::Clear), Wanted { patch: *entry });
        def!(last_entry = entry.eq(self.patches.count() - 1));
        entry.enable(cleared).next(mux(last_entry, 0, entry + 1));

        // A pixel is computed in 16 clocks on average, and then requested until it is taken.
        def!(asks = m.reg(1).reset(0));
        def!(word = m.reg(WORD));
        def!(pixel = m.reg(4).reset(0));
        let columns = self.patches.columns();
        let rows = self.patches.count() / columns;
        def!(column = m.reg(index_width(columns.into())).reset(0));
        def!(row = m.reg(index_width(rows.into())).reset(0));
        let edge = |position: Reg, low: u32| cat![position, pixel.slice(low..low + 2)];
        let (request, taken) = m.offer(asks, Request { x: edge(column, 0), y: edge(row, 2), word: *word });
        def!(computed = phase.is(Phase::Draw) & !asks & random.slice(28..32).eq(0));
        asks.when(computed, 1).when(taken, 0);
        word.enable(computed).next(cat![random.slice(0..24), random.slice(8..32)]);
        pixel.enable(taken).next(pixel + 1);

        def!(patch_ends = taken & pixel.all_ones());
        let jump = |position: Reg, count: u32, low: u32| {
            let width = position.width();
            position.when(patch_ends, below(random.slice(low..low + width), count, (1 << width) - count));
        };
        jump(column, columns, 0);
        jump(row, rows, 12);
        def!(painted = m.reg(index_width(self.painted.into())).reset(0));
        def!(last_patch = painted.eq(self.painted - 1));
        painted.enable(patch_ends).next(mux(last_patch, 0, painted + 1));

        phase.next(|state| match state {
            Phase::Clear => when(cleared & last_entry, Phase::Draw),
            Phase::Draw => when(patch_ends & last_patch, Phase::Wait),
            Phase::Wait => when(i.state.eq(SwapState::Due), Phase::Clear),
        });

        def!(hash = m.reg(32).reset(0));
        hash.enable(taken).next(hash.rotate_left(1) ^ *random);
        let (sends, _) = m.offer(lit(1, 0), BusWord { word: lit(32, 0), last: lit(1, 0) });
        let vc1 = ProcessorIn { request, clear, sends, done: phase.is(Phase::Wait) };
        PainterOut { vc1, hash: *hash }
    }
}
