//! A picture on a screen with a DVI or HDMI socket, from an ECP5: 640 x 480 pixels at 59.5 Hz, on the pins of a ULX3S.
//! `cargo run -p tilewright-blocks --example dvi -- FOLDER` writes its Verilog and constraints.

use std::path::Path;
use tilewright_blocks::*;
use tilewright_gen::{Dialect, Pins, constraints, verilog};
use tilewright_hdl::*;

/// The board's oscillator, which is also the clock of the pixels.
pub const PIXEL: Clock = Clock::new("pixel", Period::ns(40)).reset(Reset::PowerOn);
/// The clock of the serial lines, which send a bit at each of its edges.
pub const SERIAL: Clock = Clock::new("serial", Period::ns(8)).reset(Reset::PowerOn);

/// The pins of a ULX3S. A differential output has the pin of its positive half.
pub const PINS: &str = "
    pixel_clk  G2   LVCMOS33
    tmds[0]    A16  LVCMOS33D  DRIVE=4   # blue
    tmds[1]    A14  LVCMOS33D  DRIVE=4   # green
    tmds[2]    A12  LVCMOS33D  DRIVE=4   # red
    tmds[3]    A17  LVCMOS33D  DRIVE=4   # clock
    locked     B2   LVCMOS33             # LED 0
";

block! {
    /// The PLL of an ECP5 as it makes 125 MHz of 25 MHz. Its oscillator runs at 625 MHz.
    ///
    /// The model locks after some clocks.
    struct Pll;
    foreign = Foreign::module("EHXPLLL")
        .parameter("CLKI_DIV", 1)
        .parameter("CLKFB_DIV", 5)
        .parameter("CLKOP_DIV", 5)
        .parameter("CLKOP_CPHASE", 2)
        .parameter("FEEDBK_PATH", "CLKOP")
        .attribute("ICP_CURRENT", "12")
        .attribute("LPF_RESISTOR", "8")
        .attribute("MFG_ENABLE_FILTEROPAMP", "1")
        .attribute("MFG_GMCREF_SEL", "2")
        .clock_of(PIXEL, "CLKI")
        .clock_of(SERIAL, "CLKFB")
        .makes(SERIAL, "CLKOP")
        .capitals();
    in PllIn {
        rst: bit(),
        stdby: bit(),
        /// The phase can be moved while the PLL runs, which this one does not do.
        phasesel0: bit(),
        phasesel1: bit(),
        phasedir: bit(),
        phasestep: bit(),
        phaseloadreg: bit(),
        pllwakesync: bit(),
        enclkop: bit(),
    }
    out PllOut {
        /// The clock is stable.
        lock: bit(),
    }
}

impl Pll {
    fn build(&self, m: Module, i: PllIn) -> PllOut {
        m.ignore(&i);
        let m = m.on(PIXEL);
        def!(clocks = m.reg(up_to(7)).initial(0));
        clocks.when(clocks.ne(7), clocks + 1);
        def!(locked = m.reg(bit()).initial(0));
        locked.next(clocks.eq(7));
        PllOut { lock: *locked }
    }

    /// Its inputs, at rest.
    fn at_rest() -> PllIn {
        let [low, high] = [lit(1, 0), lit(1, 1)];
        PllIn {
            rst: low,
            stdby: low,
            phasesel0: low,
            phasesel1: low,
            phasedir: high,
            phasestep: high,
            phaseloadreg: high,
            pllwakesync: low,
            enclkop: low,
        }
    }
}

block! {
    /// A pin of an ECP5 that sends two bits in each clock: the first one while the clock is high.
    ///
    /// The model shows the first bit in its output, and the second one in its register `second`.
    struct DoubleRate;
    foreign = Foreign::module("ODDRX1F").clock_of(SERIAL, "SCLK").capitals();
    in DoubleRateIn { rst: bit(), d0: bit(), d1: bit() }
    out DoubleRateOut { q: bit() }
}

impl DoubleRate {
    fn build(&self, m: Module, i: DoubleRateIn) -> DoubleRateOut {
        let m = m.on(SERIAL);
        m.ignore(&i.rst);
        let _ = m.pipe("second", i.d1);
        DoubleRateOut { q: m.pipe("first", i.d0) }
    }
}

record! {
    /// A colour, or the symbols of one.
    struct Colour(width: u32) { red: bits(width), green: bits(width), blue: bits(width) }
}

block! {
    /// A chessboard. Its white squares are windows to bars that move to the left by a pixel a frame, and its black ones
    /// are shades.
    struct TestPicture;
    in TestPictureIn { x: bits(10), y: bits(10), frame: bits(8) }
    out(self) = Colour::widths(8);
}

impl TestPicture {
    fn build(&self, _: Module, i: TestPictureIn) -> Colour {
        def!(is_white = i.x.bit(5) ^ i.y.bit(5));
        def!(moved = i.x + i.frame.zext(10));
        let bar = |bit: u32| moved.bit(bit).repeat(8);
        let bars = Colour { red: bar(6), green: bar(7), blue: bar(8) };
        mux(is_white, bars, Colour { red: i.x.part(0, 8), green: i.y.part(0, 8), blue: lit(8, 0x80) })
    }
}

block! {
    /// The picture as symbols, one for each pixel and colour.
    struct Symbols { timing: VideoTiming }
    in SymbolsIn { runs: bit() }
    out(self) = Colour::widths(10);
}

impl Symbols {
    fn build(&self, m: Module, i: SymbolsIn) -> Colour {
        def!(timing = m.instance(&self.timing, VideoTimingIn { enable: i.runs }));
        // High, as the pulses are low: there is none at the start.
        def!(vsync_was = m.reg(bit()).reset(1));
        vsync_was.next(timing.vsync);
        def!(frame = m.reg(8).reset(0));
        frame.when(timing.vsync & !vsync_was, frame + 1);
        let place = TestPictureIn { x: timing.x.zext(10), y: timing.y.zext(10), frame: *frame };
        def!(picture = m.instance(&TestPicture, place));
        def!(colour = m.pipe(picture));
        def!(active = m.pipe(timing.active));
        // Blue brings the sync pulses along.
        def!(sync = m.pipe(cat![timing.vsync, timing.hsync]));
        let encode =
            |name, data, control| m.instance(name, &TmdsEncoder, TmdsEncoderIn { active, data, control }).symbol;
        Colour {
            red: encode("u_red", colour.red, lit(2, 0)),
            green: encode("u_green", colour.green, lit(2, 0)),
            blue: encode("u_blue", colour.blue, sync),
        }
    }
}

/// Five bits high and five low: the serial line of the clock has an edge upwards for each symbol.
const CLOCK_SYMBOL: u64 = 0b00_0001_1111;

block! {
    /// The chip. A queue takes the symbols from the clock of the pixels to that of the lines.
    ///
    /// ```text
    ///                     PIXEL | SERIAL, which is five times as fast
    /// .---------.  symbols   .--|----.  every 5 clocks
    /// | picture |===========>| queue |====>[ shifts by 2 ]===>( double rate )===> tmds
    /// '---------'            '--|----'
    /// ```
    pub struct Dvi {
        /// Its visible part is at most 1024 pixels by 1024 lines.
        timing: VideoTiming
    }
    name = "dvi";
    out DviOut {
        /// Blue, green, red and the clock.
        tmds: bit().of(row(4)),
        /// The PLL has locked.
        locked: bit(),
    }
}

impl Dvi {
    /// 640 x 480 pixels.
    pub const VGA: Dvi = Dvi { timing: VideoTiming::VGA };

    /// The chip with another timing, for tests.
    pub fn new(timing: VideoTiming) -> Dvi {
        Dvi { timing }
    }

    fn build(&self, m: Module, (): ()) -> DviOut {
        let (pixel, serial) = (m.on(PIXEL), m.on(SERIAL));
        def!(pll = m.instance(&Pll, Pll::at_rest()));
        def!(locked = pixel.synchronize(pll.lock));

        def!(symbols = pixel.instance(&Symbols { timing: self.timing.clone() }, SymbolsIn { runs: locked }));
        let (stream, sent) = pixel.offer(locked, symbols);
        pixel.assert(locked.implies(sent), "the queue has room for each symbol");
        let symbols = m.cross_by_fifo("u_queue", 8, (PIXEL, SERIAL), stream);

        def!(phase = serial.reg(below(5)).reset(0));
        phase.next(mux(phase.eq(4), 0, phase + 1));
        def!(loads = phase.eq(4));
        // One symbol stays in the queue, so that it does not matter when within five clocks the next one comes.
        def!(begun = serial.reg(bit()).reset(0));
        begun.when(loads & symbols.valid, 1);
        let symbols = symbols.take_when(loads & begun);
        serial.assert((loads & begun).implies(symbols.taken), "the queue has a symbol whenever one is due");

        // Low until the first symbol.
        def!(line = serial.reg(bits(10).of(row(4))).reset(0));
        let Colour { red, green, blue } = *symbols;
        line.when(symbols.taken, stack([blue, green, red, lit(10, CLOCK_SYMBOL)])).otherwise(line >> 2);
        let into = DoubleRateIn { rst: lit(1, 0), d0: line.bit(0), d1: line.bit(1) };
        def!(tmds = serial.array(4, &DoubleRate, |_| into));
        DviOut { tmds: tmds.q, locked }
    }
}

/// Writes the Verilog and the constraints into a folder.
pub fn write(folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let design = elaborate(&Dvi::VGA)?;
    let constraints = constraints(&design, Dialect::Lpf, &Pins::read(PINS)?)?;
    for file in verilog(&design).iter().chain([&constraints]) {
        std::fs::write(folder.join(&file.name), &file.text)?;
    }
    Ok(())
}

/// Writes them where the command line says.
#[allow(dead_code, reason = "tests call `write`")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("name a folder for the files, as in `--example dvi -- dvi`")?;
    std::fs::create_dir_all(&folder)?;
    write(Path::new(&folder))?;
    println!("wrote the Verilog of the chip and dvi.lpf to {folder}");
    Ok(())
}
