//! Foreign modules: instances of them with their parameters, or of their models.

use tilewright_gen::tools::{self, Target};
use tilewright_gen::{VerilogFile, verilog};
use tilewright_hdl::*;

block! {
    /// An output of an ECP5 with a word for each edge of the clock. The model shows the first.
    struct Ddr;
    foreign = Foreign::module("ODDRX1F").parameter("GSR", "DISABLED").clock("SCLK").reset("RST").capitals();
    in DdrIn { d0: bit(), d1: bit() }
    out DdrOut { q: bit() }
}

impl Ddr {
    fn build(&self, m: Module, i: DdrIn) -> DdrOut {
        m.ignore(&i.d1);
        def!(first = m.reg(1).reset(0));
        first.next(i.d0);
        m.assert(i.d0 | i.d1, "one of both is high");
        DdrOut { q: *first }
    }
}

block! {
    /// The oscillator of an ECP5.
    struct Oscillator { divider: u32 }
    foreign(self) = Foreign::module("OSCG").parameter("DIV", self.divider).attribute("keep", "true").capitals();
    out OscillatorOut { osc: _ }
}

impl Oscillator {
    fn build(&self, m: Module, _: ()) -> OscillatorOut {
        m.unmodelled(&(), OscillatorOut { osc: bit() })
    }
}

block! {
    /// A buffer between a pin and the circuit. Its model watches its pin, for which it needs a clock of its own.
    struct Buffer;
    foreign = Foreign::module("IB").port("pin", "I").port("word", "O");
    in BufferIn { pin: bit() }
    out BufferOut { word: bit() }
}

impl Buffer {
    fn build(&self, m: Module, i: BufferIn) -> BufferOut {
        m.assert(m.past(i.pin) | i.pin, "the pin is low for one clock at a time");
        BufferOut { word: i.pin }
    }
}

block! {
    /// Words that go out at both edges.
    struct Pins;
    in PinsIn { words: bits(2).of(row(4)), pin: bit() }
    out PinsOut { pins: bits(1).of(row(4)), tick: bit() }
}

impl Pins {
    fn build(&self, m: Module, i: PinsIn) -> PinsOut {
        def!(buffer = m.instance(&Buffer, BufferIn { pin: i.pin }));
        let into = DdrIn { d0: i.words.bit(0), d1: i.words.bit(1) | buffer.word };
        def!(ddr = m.array(4, &Ddr, |_| into));
        PinsOut { pins: ddr.q, tick: m.instance("u_oscillator", &Oscillator { divider: 128 }, ()).osc }
    }
}

fn files() -> Vec<VerilogFile> {
    verilog(&elaborate(&Pins).unwrap())
}

#[test]
fn an_instance_is_of_the_module_or_of_its_model() {
    let files = files();
    let text = &files.last().unwrap().text;
    let without_places: Vec<&str> = text.lines().map(|line| line.split(" //").next().unwrap().trim_end()).collect();
    let text = without_places.join("\n");
    for instance in [
        "`ifdef TILEWRIGHT_MODELS
    buffer u_buffer (
        .clk (clk),
        .rst (rst),
`else
    IB u_buffer (
`endif
        .I   (pin),
        .O   (u_buffer_O)
    );",
        "            `ifdef TILEWRIGHT_MODELS
            ddr lane (
            `else
            ODDRX1F #(
                .GSR (\"DISABLED\")
            ) lane (
            `endif
                .SCLK (clk),
                .RST  (rst),
                .D0   (",
        "`ifdef TILEWRIGHT_MODELS
    oscillator_divider128 u_oscillator (
`else
    (* keep = \"true\" *) OSCG #(
        .DIV (128)
    ) u_oscillator (
`endif
        .OSC (tick)
    );",
    ] {
        assert!(text.contains(instance), "{text}");
    }
    assert!(files[0].text.contains("// Model of    IB, in whose place it is if TILEWRIGHT_MODELS is defined\n"));
    assert!(files[2].text.contains("// Stub of     OSCG, in whose place it is if TILEWRIGHT_MODELS is defined\n"));
}

#[test]
fn linters_take_the_models() {
    tools::lint(&files()).unwrap();
}

#[test]
fn yosys_makes_the_cells_of_them() {
    if let Some(cells) = tools::cells(&files(), Target::Ecp5).unwrap() {
        for (cell, count) in [("ODDRX1F", 4), ("OSCG", 1), ("TRELLIS_IO", 1)] {
            assert_eq!(cells.get(cell), Some(&count), "{cell} of {cells:?}");
        }
    }
}
