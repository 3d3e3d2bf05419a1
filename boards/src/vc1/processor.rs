//! What a processor of the VC-1 does with the triangles that it is given: it clears its patch table and converts them
//! to pixels.
//!
//! ```text
//! state --> [ entry ]--> clear
//!                       .-------------.
//! packet ==> [ box ] -->| 3 edges     |--- all >= 0 --.
//!            [ steps ]=>| depth       |==> word ======+==> request
//!                       | 3 colours   |
//!                       '-------------'
//! ```
//!
//! Throughput: a clock for each pixel of a triangle's box, and for a covered one the clocks that the local frame buffer
//! takes. The values are those of the integer contract: sums are exact or modulo a power of two, so steps from pixel to
//! pixel give the words of direct evaluation.
//!
//! A colour is cut to its high [`COLOUR_BITS`] bits; the others are ones.

use super::format::{COLUMNS, INTERPOLANTS, Interpolant, LEFT, ROWS, TOP, WORD_BITS, WORDS};
use tilewright_hdl::{Module, Reg, Signal, below, bit, bits, block, cat, def, lit, mux, one_of};
use tilewright_rtl::lfb::{Patches, Request, Wanted};
use tilewright_rtl::swap::SwapState;

/// The bits of each component of a colour that are drawn, stored and shown.
pub const COLOUR_BITS: u32 = 4;

block! {
    /// Draws triangles into a local frame buffer, and clears its patch table.
    pub struct Processor {
        /// The patches of the screen.
        pub patches: Patches,
    }
    latency = "a clock for each pixel of a triangle's box, or those of its access";
    source = "VC-1, section 3.2 (VC1-PE); the integer contract (facts E0)";
    in(self) ProcessorIn {
        /// The clocks run.
        runs: bit(),
        /// What the swap control lets the processor do.
        state: one_of::<SwapState>(),
        /// All triangles of the frame have been given out.
        given: bit(),
        /// There is a triangle for this processor.
        valid: bit(),
        /// The words of the triangle.
        words: [bits(WORD_BITS); WORDS],
    }
    out(self) ProcessorOut {
        /// The processor takes a triangle in this clock, if there is one.
        free: bit(),
        /// It has drawn its frame.
        done: bit(),
        /// A pixel to draw.
        request: stream(Request::widths(self.patches.screen())),
        /// An entry of the patch table to clear.
        clear: stream(Wanted { patch: below(self.patches.count()) }),
    }
}

impl Processor {
    fn build(&self, m: Module, i: ProcessorIn) -> ProcessorOut {
        let screen = self.patches.screen();
        def!(entry = m.reg(below(self.patches.count())).reset(0));
        let (clear, cleared) = m.offer(i.runs & i.state.is(SwapState::Clear), Wanted { patch: *entry });
        entry.when(cleared, mux(entry.eq(self.patches.count() - 1), 0, entry + 1));

        // The box of the triangle.
        def!(busy = m.reg(bit()).reset(0));
        def!(loads = i.valid & !busy);
        def!(left = m.pipe_when(loads, LEFT.of(&i.words)));
        def!(columns = m.pipe_when(loads, COLUMNS.of(&i.words)));
        def!(advances = m.wire(bit()));
        def!(x = m.reg(bits(9)));
        def!(y = m.reg(bits(8)));
        def!(columns_left = m.reg(bits(9)));
        def!(rows_left = m.reg(bits(8)));
        def!(row_ends = *advances & columns_left.eq(0));
        def!(ends = row_ends & rows_left.eq(0));
        x.when(loads, LEFT.of(&i.words)).when(row_ends, left).when(*advances, x + 1);
        y.when(loads, TOP.of(&i.words)).when(row_ends, y + 1);
        columns_left.when(loads, COLUMNS.of(&i.words)).when(row_ends, columns).when(*advances, columns_left - 1);
        rows_left.when(loads, ROWS.of(&i.words)).when(row_ends, rows_left - 1);
        busy.when(loads, 1).when(ends, 0);

        // The values at its pixels.
        let moves = Moves { loads, row_ends, advances: *advances };
        let names = ["edge0", "edge1", "edge2", "z", "red", "green", "blue"];
        let values: Vec<Signal> =
            names.iter().zip(INTERPOLANTS).map(|(name, at)| interpolated(m, name, at, &i.words, &moves)).collect();
        let [first, second, third] = [0, 1, 2].map(|edge| !values[edge].bit(INTERPOLANTS[edge].bits() - 1));
        def!(inside = first & second & third);
        let colour =
            |value: Signal| cat![value.part(24 - COLOUR_BITS, COLOUR_BITS), lit(8 - COLOUR_BITS, 0xff >> COLOUR_BITS)];
        def!(word = cat![values[3].part(16, 24), colour(values[4]), colour(values[5]), colour(values[6])]);
        let at = |position: Signal, side: u32| position.trunc(below(side));
        let pixel = Request { x: at(*x, screen.width), y: at(*y, screen.height), word };
        let (request, sent) = m.offer(*busy & inside, pixel);
        advances.drive(*busy & (!inside | sent));
        m.assert(i.valid.implies(i.state.is(SwapState::Draw)), "triangles come while the processor draws");
        let done = i.given & !busy & i.state.is(SwapState::Draw);
        ProcessorOut { free: !busy, done, request, clear }
    }
}

/// What happens in a clock.
struct Moves {
    loads: Signal,
    row_ends: Signal,
    advances: Signal,
}

/// A value at the pixel, which moves to the right and at the end of a row down.
fn interpolated(m: Module, name: &str, at: Interpolant, words: &[Signal], moves: &Moves) -> Signal {
    let Moves { loads, row_ends, advances } = *moves;
    let step = |what: &str, field: Signal| {
        let field = m.pipe_when(loads, &format!("{name}_{what}"), field);
        field.sext(at.bits())
    };
    let (right, down) = (step("right", at.right.of(words)), step("down", at.down.of(words)));
    let here: Reg = m.reg(name, bits(at.bits()));
    let row: Reg = m.reg(&format!("{name}_row"), bits(at.bits()));
    let below = (row + down).named(&format!("{name}_below"));
    let start = at.value.of(words);
    here.when(loads, start).when(row_ends, below).when(advances, here + right);
    row.when(loads, start).when(row_ends, below);
    *here
}
