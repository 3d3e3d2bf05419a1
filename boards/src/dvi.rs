//! From what a screen shows to the bits of the four lines of DVI.

use crate::picture::Colour;
use crate::screen::Shown;
use tilewright_blocks::{StreamBlocks, TmdsEncoder, TmdsEncoderIn};
use tilewright_hdl::{Clock, Module, Signal, below, bit, bits, block, cat, def, lit, mux, row, stack};

/// Five bits high and five low: the serial line of the clock has an edge upwards for each symbol.
const CLOCK_SYMBOL: u64 = 0b00_0001_1111;

block! {
    /// Sends what a screen shows over the lines of DVI, two bits in each clock of the lines.
    ///
    /// ```text
    ///                                pixel | serial, which is five times as fast
    /// .--------.  colour  .---------.   .--|----.  every 5 clocks
    /// | screen |=========>| encoder |==>| queue |====>[ shifts by 2 ]===> first, second
    /// '--------'  sync    '---------'   '--|----'
    /// ```
    ///
    /// The phase of the clocks does not matter.
    pub struct DviSender {
        /// The clock of the pixels.
        pub pixel: Clock,
        /// The clock of the lines.
        pub serial: Clock,
    }
    in(self) DviSenderIn {
        /// What the screen shows.
        shown: Shown.on(self.pixel),
        /// High once both clocks run.
        runs: bit().on(self.pixel),
    }
    out DviSenderOut {
        /// The first bit of a clock, of blue, green, red and the clock.
        first: bit().of(row(4)),
        /// The second bit of a clock.
        second: bit().of(row(4)),
    }
}

impl DviSender {
    fn build(&self, m: Module, i: DviSenderIn) -> DviSenderOut {
        let (pixel, serial) = (m.on(self.pixel), m.on(self.serial));
        def!(symbols = encoded(pixel, i.shown));
        let (stream, sent) = pixel.offer(i.runs, symbols);
        pixel.assert(i.runs.implies(sent), "the queue has room for each symbol");
        let symbols = m.cross_by_fifo("u_queue", 8, (self.pixel, self.serial), stream);

        def!(phase = serial.reg(below(5)).reset(0));
        phase.next(mux(phase.eq(4), 0, phase + 1));
        // One symbol stays in the queue, so that it does not matter when within five clocks the next one comes.
        def!(begun = serial.reg(bit()).reset(0));
        begun.when(phase.eq(4) & symbols.valid, 1);
        // In phase 4. A register of its own, because it enables the whole end of the queue.
        def!(loads = serial.reg(bit()).reset(0));
        loads.next(phase.eq(3) & begun);
        let symbols = symbols.take_when(*loads);
        serial.assert(loads.implies(symbols.taken), "the queue has a symbol whenever one is due");

        // Low until the first symbol.
        def!(line = serial.reg(bits(10).of(row(4))).reset(0));
        let Colour { red, green, blue } = *symbols;
        line.when(symbols.taken, stack([blue, green, red, lit(10, CLOCK_SYMBOL)])).otherwise(line >> 2);
        DviSenderOut { first: line.bit(0), second: line.bit(1) }
    }
}

/// The symbols of the three colours. Blue brings the sync pulses along.
fn encoded(pixel: Module, shown: Shown) -> Colour {
    let Shown { colour, active, hsync, vsync } = shown;
    let encode = |name, data, control: Signal| {
        pixel.instance(name, &TmdsEncoder, TmdsEncoderIn { active, data, control }).symbol
    };
    Colour {
        red: encode("u_red", colour.red, lit(2, 0)),
        green: encode("u_green", colour.green, lit(2, 0)),
        blue: encode("u_blue", colour.blue, cat![vsync, hsync]),
    }
}
