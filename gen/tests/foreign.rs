//! Foreign modules: instances of them with their parameters, or of their models. Pads, and clocks that are made inside.

use std::process::Command;
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

/// The text of the top.
fn without_comments(files: &[VerilogFile]) -> String {
    let lines = files.last().unwrap().text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let lines = lines.map(|line| line.split(" //").next().unwrap_or_default().trim_end());
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn an_instance_is_of_the_module_or_of_its_model() {
    let files = files();
    let text = without_comments(&files);
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

const VIDEO: Clock = Clock::new("video", Period::ps(39_722));

block! {
    /// A PLL of an iCE40: 25.125 MHz of 12 MHz.
    struct Pll;
    foreign = Foreign::module("SB_PLL40_CORE")
        .parameter("FEEDBACK_PATH", "SIMPLE")
        .parameter("DIVR", Bits::new(4, 0))
        .parameter("DIVF", Bits::new(7, 66))
        .parameter("DIVQ", Bits::new(3, 5))
        .parameter("FILTER_RANGE", Bits::new(3, 1))
        .clock("REFERENCECLK")
        .makes(VIDEO, "PLLOUTCORE")
        .capitals();
    in PllIn { resetb: bit(), bypass: bit() }
    out PllOut { lock: bit() }
}

impl Pll {
    fn build(&self, m: Module, i: PllIn) -> PllOut {
        m.ignore(&i.bypass);
        PllOut { lock: i.resetb }
    }
}

block! {
    /// A counter on a clock that is made inside, an open drain, and a bus.
    struct Chip;
    in ChipIn {
        /// The chip calls.
        call: bit(),
        /// The chip drives the bus.
        drive: bit().on(VIDEO),
        /// The line on which all call.
        irq: Outside::widths(1),
        /// The bus.
        bus: Outside { value: bits(4), drives: bit() }.on(VIDEO),
    }
    out ChipOut {
        /// Somebody calls.
        called: bit(),
        /// The bus.
        bus_line: bits(4),
        /// The clock is there.
        lock: bit(),
    }
}

impl Chip {
    fn build(&self, m: Module, i: ChipIn) -> ChipOut {
        def!(pll = m.instance(&Pll, PllIn { resetb: lit(1, 1), bypass: lit(1, 0) }));
        let video = m.on(VIDEO);
        def!(count = video.reg(4).reset(0));
        count.next(count + 1);
        def!(irq = m.instance(&Pad::new(1).pull_up(), PadIn::open_drain(i.call, i.irq)));
        def!(bus = video.instance(&Pad::new(4), PadIn { out: *count, enable: i.drive, outside: i.bus }));
        ChipOut { called: !irq.line, bus_line: bus.line, lock: pll.lock }
    }
}

fn chip() -> Vec<VerilogFile> {
    verilog(&elaborate(&Chip).unwrap())
}

#[test]
fn the_top_of_a_chip_has_other_ports_than_that_of_a_simulation() {
    let text = without_comments(&chip());
    for part in [
        "module chip (
`ifdef TILEWRIGHT_MODELS
    input  wire       video_clk,
    input  wire       irq_value,
    input  wire       irq_drives,
    input  wire [3:0] bus_value,
    input  wire       bus_drives,
    output wire [3:0] bus_line,
`else
    inout  wire       irq,
    inout  wire [3:0] bus,
`endif
    input  wire       clk,
    input  wire       rst,
    input  wire       video_rst,
    input  wire       call,
    input  wire       drive,
    output wire       called,
    output wire       lock
);",
        "`ifndef TILEWRIGHT_MODELS
    wire video_clk;
    wire [3:0] bus_line;
`endif",
        "    ) u_pll (
        .PLLOUTCORE   (video_clk),
`endif
        .REFERENCECLK (clk),",
        "`else
    assign bus = drive ? count : 4'bz;
    assign bus_line = bus;
`endif",
        "`else
    assign irq = call ? 1'b0 : 1'bz;
    assign u_irq_line = irq;
`endif",
    ] {
        assert!(text.contains(part), "{part}\n is not in\n{text}");
    }
}

#[test]
fn linters_take_the_models_of_pads_and_of_a_made_clock() {
    tools::lint(&chip()).unwrap();
}

#[test]
fn yosys_makes_pins_and_a_pll() {
    if let Some(cells) = tools::cells(&chip(), Target::Ice40).unwrap() {
        let drivers = cells.get("$_TBUF_").or(cells.get("SB_IO"));
        assert_eq!((cells.get("SB_PLL40_CORE"), drivers), (Some(&1), Some(&5)), "{cells:?}");
    }
}

block! {
    /// A wire that this chip and others pull low.
    struct Line;
    in LineIn { low: bit(), sda: Outside::widths(1) }
    out LineOut { is_low: bit() }
}

impl Line {
    fn build(&self, m: Module, i: LineIn) -> LineOut {
        def!(sda = m.instance(&Pad::new(1).pull_up(), PadIn::open_drain(i.low, i.sda)));
        LineOut { is_low: !sda.line }
    }
}

/// Both sides of a wire with a pull-up, by Verilog's own rules.
const BENCH: &str = "module bench;
    reg low, other;
    wire sda, is_low;
    pullup (sda);
    assign sda = other ? 1'b0 : 1'bz;
    line dut (.clk(1'b0), .rst(1'b0), .low(low), .sda(sda), .is_low(is_low));
    initial begin
        {low, other} = 2'b00; #1 $write(\"%b\", is_low);
        {low, other} = 2'b01; #1 $write(\"%b\", is_low);
        {low, other} = 2'b10; #1 $write(\"%b\", is_low);
        {low, other} = 2'b11; #1 $write(\"%b\", is_low);
    end
endmodule
";

/// What Icarus prints of a bench for a design without models; `None` if it is not installed.
fn printed(design: &Design, bench: &str) -> Option<String> {
    if tools::skipped_without(&["iverilog", "vvp"]).is_some() {
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let text: String = verilog(design).into_iter().map(|file| file.text).collect();
    std::fs::write(folder.path().join("all.v"), text + bench).unwrap();
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).current_dir(folder.path()).output().unwrap();
        String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()
    };
    assert_eq!(run("iverilog", &["-g2005", "-Wall", "-Wno-timescale", "-s", "bench", "-o", "bench.vvp", "all.v"]), "");
    Some(run("vvp", &["-n", "bench.vvp"]))
}

#[test]
fn without_models_verilog_resolves_a_line() {
    if let Some(printed) = printed(&elaborate(&Line).unwrap(), BENCH) {
        assert_eq!(printed, "0111");
    }
}

block! {
    /// A wire that one of two sides may drive.
    struct Sides;
    in SidesIn { second: bit(), drives: bits(2), values: bits(2), line: Outside::widths(1) }
    out SidesOut { is_low: bit() }
}

impl Sides {
    fn build(&self, m: Module, i: SidesIn) -> SidesOut {
        let of_side = |both: Signal| mux(i.second, both.bit(1), both.bit(0));
        let (out, enable) = (of_side(i.values), of_side(i.drives));
        def!(line = m.instance(&Pad::new(1).pull_up(), PadIn { out, enable, outside: i.line }));
        SidesOut { is_low: !line.line }
    }
}

/// The second side drives 0, then the first side drives it, then none drives.
const SIDES_BENCH: &str = "module bench;
    reg second;
    reg [1:0] drives, values;
    wire line, is_low;
    pullup (line);
    sides dut (.clk(1'b0), .rst(1'b0), .second(second), .drives(drives), .values(values), .line(line), .is_low(is_low));
    initial begin
        second = 1; drives = 2'b10; values = 2'b01; #1 $write(\"%b\", is_low);
        second = 0; drives = 2'b01; values = 2'b10; #1 $write(\"%b\", is_low);
        second = 1; drives = 2'b01; values = 2'b01; #1 $write(\"%b\", is_low);
        second = 0; drives = 2'b10; values = 2'b10; #1 $write(\"%b\", is_low);
    end
endmodule
";

#[test]
fn a_choice_decides_whether_a_pad_drives_and_another_one_what() {
    if let Some(printed) = printed(&elaborate(&Sides).unwrap(), SIDES_BENCH) {
        assert_eq!(printed, "1100");
    }
}

block! {
    /// A wire whose pad is in an enabled part.
    struct Watched;
    in WatchedIn { low: bit(), watches: bit(), sda: Outside::widths(1) }
    out WatchedOut { is_low: bit() }
}

impl Watched {
    fn build(&self, m: Module, i: WatchedIn) -> WatchedOut {
        let pad = || m.instance("u_sda", &Pad::new(1).pull_up(), PadIn::open_drain(i.low, i.sda));
        let sda = m.enabled(i.watches, pad);
        WatchedOut { is_low: !sda.line }
    }
}

block! {
    /// A pad with the name of the module, and one with a name that the printer would give.
    struct Sda;
    in SdaIn { sda: Outside::widths(1), _unused_ok: Outside::widths(1), low: bits(2) }
    out SdaOut { is_low: bit() }
}

impl Sda {
    fn build(&self, m: Module, i: SdaIn) -> SdaOut {
        let low = i.low.bit(0);
        def!(sda = m.instance(&Pad::new(1), PadIn::open_drain(low, i.sda)));
        def!(other = m.instance(&Pad::new(1), PadIn::open_drain(low, i._unused_ok)));
        SdaOut { is_low: !(sda.line & other.line) }
    }
}

#[test]
fn nothing_else_has_the_name_of_a_pad() {
    let text = without_comments(&verilog(&elaborate(&Sda).unwrap()));
    for part in [
        "module sda_ (",
        "    inout  wire       sda,\n",
        "    inout  wire       _unused_ok,\n",
        "    wire _unused_ok_2 =",
    ] {
        assert!(text.contains(part), "{part}\n is not in\n{text}");
    }
}

/// The enable is for the assertion of the model alone.
#[test]
fn a_pad_may_be_in_an_enabled_part() {
    let text = without_comments(&verilog(&elaborate(&Watched).unwrap()));
    for part in [
        "    input  wire sda_value,\n    input  wire sda_drives,\n`else\n    inout  wire sda,\n`endif\n",
        "        .outside_drives (sda_drives),\n        .clk_en         (watches),\n",
        "    assign sda = low ? 1'b0 : 1'bz;\n",
    ] {
        assert!(text.contains(part), "{part}\n is not in\n{text}");
    }
}
