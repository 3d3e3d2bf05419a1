//! Constraints: clocks, crossings and pins in each dialect, the mistakes in tables of pins, and what the placers read.

use tilewright_gen::tools::{Device, Placed, place};
use tilewright_gen::{Dialect, Pins, constraints, verilog};
use tilewright_hdl::*;

/// Four times the default clock.
const FAST: Clock = Clock::new("fast", Period::ns(10)).reset(Reset::PowerOn);
/// 310 MHz divided by 12.
const ODD: Clock = Clock::new("odd", Period::ps(38_710)).reset(Reset::PowerOn);

block! {
    /// The PLL of an ECP5: 100 MHz of 25 MHz.
    struct Pll;
    foreign = Foreign::module("EHXPLLL")
        .parameter("CLKI_DIV", 1)
        .parameter("CLKFB_DIV", 4)
        .parameter("CLKOP_DIV", 6)
        .parameter("FEEDBK_PATH", "CLKOP")
        .clock("CLKI")
        .clock_of(FAST, "CLKFB")
        .makes(FAST, "CLKOP")
        .capitals();
    in PllIn { rst: bit() }
    out PllOut { lock: bit() }
}

impl Pll {
    fn build(&self, _: Module, i: PllIn) -> PllOut {
        PllOut { lock: !i.rst }
    }
}

block! {
    /// The oscillator of an ECP5.
    struct Oscillator;
    foreign = Foreign::module("OSCG").parameter("DIV", 12).makes(ODD, "OSC").capitals();
}

impl Oscillator {
    fn build(&self, _: Module, (): ()) {}
}

block! {
    /// Three clocks, a bus and an open drain.
    struct Chip;
    in ChipIn { call: bit(), sda: Outside::widths(1) }
    out ChipOut { count: bits(2).of(row(2)), seen: bit(), odd: bit() }
}

impl Chip {
    fn build(&self, m: Module, i: ChipIn) -> ChipOut {
        def!(pll = m.instance(&Pll, PllIn { rst: lit(1, 0) }));
        m.instance("u_oscillator", &Oscillator, ());
        def!(sda = m.instance(&Pad::new(1).pull_up(), PadIn::open_drain(i.call & pll.lock, i.sda)));
        def!(calls = m.toggle(sda.line));
        def!(count = m.on(FAST).reg(bits(2).of(row(2))).reset(0));
        count.next(count + 1);
        def!(seen = m.on(FAST).synchronize(calls));
        def!(odd = m.on(ODD).synchronize(calls));
        ChipOut { count: *count, seen, odd }
    }
}

/// At 25 MHz.
fn chip() -> ir::Design {
    elaborate_at(&Chip, DefaultClock::new(Period::ns(40)).reset(Reset::PowerOn)).unwrap()
}

const PINS: &str = "
    # The board's oscillator.
    clk       G2   LVCMOS33
    call      R1   LVCMOS33   pull-down
    sda       B19  LVCMOS33   pull-up
    count[0]  B2   DRIVE=4    LVCMOS33
    count[1]  C2
    count[2]  C1
    count[3]  D2
    seen      D1
    odd       E2
";

fn text(dialect: Dialect, pins: &str) -> String {
    let file = constraints(&chip(), dialect, &Pins::read(pins).unwrap()).unwrap();
    assert_eq!(file.name, format!("chip.{}", dialect.extension()));
    file.text
}

#[test]
fn what_sdc_says() {
    assert_eq!(
        text(Dialect::Sdc, ""),
        "\
# The constraints of `chip`.

create_clock -name clk -period 40 [get_ports {clk}]
create_generated_clock -name fast_clk -source [get_pins {u_pll/CLKI}] -multiply_by 4 [get_pins {u_pll/CLKOP}]
create_clock -name odd_clk -period 38.71 [get_pins {u_oscillator/OSC}]

# Clocks cross by synchronizers, by memories with a port on each clock, and by signals that are stable.
# Such a path takes one period of the faster clock at most.
set_max_delay -from [get_clocks {clk}] -to [get_clocks {fast_clk}] 10
set_false_path -hold -from [get_clocks {clk}] -to [get_clocks {fast_clk}]
set_max_delay -from [get_clocks {clk}] -to [get_clocks {odd_clk}] 38.71
set_false_path -hold -from [get_clocks {clk}] -to [get_clocks {odd_clk}]
set_max_delay -from [get_clocks {fast_clk}] -to [get_clocks {clk}] 10
set_false_path -hold -from [get_clocks {fast_clk}] -to [get_clocks {clk}]
set_max_delay -from [get_clocks {fast_clk}] -to [get_clocks {odd_clk}] 10
set_false_path -hold -from [get_clocks {fast_clk}] -to [get_clocks {odd_clk}]
set_max_delay -from [get_clocks {odd_clk}] -to [get_clocks {clk}] 38.71
set_false_path -hold -from [get_clocks {odd_clk}] -to [get_clocks {clk}]
set_max_delay -from [get_clocks {odd_clk}] -to [get_clocks {fast_clk}] 10
set_false_path -hold -from [get_clocks {odd_clk}] -to [get_clocks {fast_clk}]
"
    );
}

#[test]
fn what_xdc_says_in_other_words() {
    let text = text(Dialect::Xdc, PINS);
    for line in [
        "create_clock -name clk -period 40 [get_ports {clk}]\n",
        "set_max_delay -datapath_only -from [get_clocks {clk}] -to [get_clocks {fast_clk}] 10\n",
        "set_property -dict {PACKAGE_PIN B2 IOSTANDARD LVCMOS33 DRIVE 4} [get_ports {count[0]}]\n",
        "set_property -dict {PACKAGE_PIN B19 IOSTANDARD LVCMOS33 PULLTYPE PULLUP} [get_ports {sda}]\n",
        "set_property -dict {PACKAGE_PIN E2} [get_ports {odd}]\n",
    ] {
        assert!(text.contains(line), "{line}is not in\n{text}");
    }
    assert!(!text.contains("-hold"), "{text}");
}

#[test]
fn what_an_lpf_says() {
    assert_eq!(
        text(Dialect::Lpf, PINS),
        "\
# The constraints of `chip`.

FREQUENCY PORT \"clk\" 25 MHZ;
FREQUENCY NET \"fast_clk\" 100 MHZ;
FREQUENCY NET \"odd_clk\" 25.833119 MHZ;

# Clocks cross by synchronizers, by memories with a port on each clock, and by signals that are stable.
# nextpnr reports the delay of such a path, and has no command for a limit.

LOCATE COMP \"clk\" SITE \"G2\";
IOBUF PORT \"clk\" IO_TYPE=LVCMOS33;
LOCATE COMP \"call\" SITE \"R1\";
IOBUF PORT \"call\" IO_TYPE=LVCMOS33 PULLMODE=DOWN;
LOCATE COMP \"sda\" SITE \"B19\";
IOBUF PORT \"sda\" IO_TYPE=LVCMOS33 PULLMODE=UP;
LOCATE COMP \"count[0]\" SITE \"B2\";
IOBUF PORT \"count[0]\" IO_TYPE=LVCMOS33 DRIVE=4;
LOCATE COMP \"count[1]\" SITE \"C2\";
LOCATE COMP \"count[2]\" SITE \"C1\";
LOCATE COMP \"count[3]\" SITE \"D2\";
LOCATE COMP \"seen\" SITE \"D1\";
LOCATE COMP \"odd\" SITE \"E2\";
"
    );
}

/// The clocks with their constraints.
fn wanted(placed: &Placed) -> Vec<(&str, f64)> {
    placed.clocks.iter().map(|(net, clock)| (&**net, clock.wanted)).collect()
}

#[test]
fn a_placer_for_an_ecp5_takes_the_clocks_and_the_pins() {
    let file = constraints(&chip(), Dialect::Lpf, &Pins::read(PINS).unwrap()).unwrap();
    if let Some(placed) = place(&verilog(&chip()), &file, Device::LFE5U_25F).unwrap() {
        assert_eq!(wanted(&placed), [("clk", 25.0), ("fast_clk", 100.0), ("odd_clk", 25.83)], "{placed:?}");
        let crossings: Vec<_> = placed.crossings.keys().map(|(from, to)| (&**from, &**to)).collect();
        assert_eq!(crossings, [("clk", "fast_clk"), ("clk", "odd_clk")]);
    }
}

block! {
    /// Counts calls.
    struct Count;
    in CountIn { call: bit() }
    out CountOut { count: bits(4) }
}

impl Count {
    fn build(&self, m: Module, i: CountIn) -> CountOut {
        def!(count = m.reg(4).reset(0));
        count.when(i.call, count + 1);
        CountOut { count: *count }
    }
}

/// At 12 MHz, nearly.
fn count() -> ir::Design {
    elaborate_at(&Count, Period::ps(83_334)).unwrap()
}

const COUNT_PINS: &str = "clk 21\nrst 78\ncall 79 pull-up\ncount[0] 99\ncount[1] 98\ncount[2] 97\ncount[3] 96";

#[test]
fn what_a_pcf_says_and_its_placer_takes() {
    let file = constraints(&count(), Dialect::Pcf, &Pins::read(COUNT_PINS).unwrap()).unwrap();
    let lines = ["set_frequency clk 11.999905", "", "set_io clk 21", "set_io rst 78", "set_io -pullup yes call 79"];
    assert!(file.text.contains(&lines.join("\n")), "{}", file.text);
    if let Some(placed) = place(&verilog(&count()), &file, Device::HX1K).unwrap() {
        assert_eq!(wanted(&placed), [("clk", 12.0)]);
        assert_eq!(placed.cells["SB_IO"], 7);
    }
}

#[test]
fn a_placer_takes_the_sdc_of_one_clock() {
    let file = constraints(&count(), Dialect::Sdc, &Pins::none()).unwrap();
    if let Some(placed) = place(&verilog(&count()), &file, Device::LFE5U_25F).unwrap() {
        assert_eq!(wanted(&placed), [("clk", 12.0)]);
    }
}

/// What is said of these pins.
fn said(dialect: Dialect, pins: &str) -> String {
    let checked = Pins::read(pins).and_then(|pins| constraints(&count(), dialect, &pins));
    checked.map(|file| file.text).unwrap_err().to_string()
}

#[test]
fn what_rows_get_wrong() {
    for (pins, wrong) in [
        ("\nclk", "line 2: `clk` has no pin: write the pin behind the port, as in `clk G2`"),
        ("clk 1\nclk 2", "line 2: port `clk` is given twice, first in line 1: give it one pin"),
        ("clk 1\nrst 1", "line 2: pin `1` is that of `clk` in line 1: give each port a pin of its own"),
        ("clk 1;", "line 1: `1;` is no port, pin or setting: use letters, digits, `_`, `[`, `]`, `-` and `.`"),
        ("clk 1 =4", "line 1: `=4` is no setting: write it as NAME=VALUE, such as `DRIVE=4`"),
        ("clk 1 A B", "line 1: `B` is the second setting of its kind: give one io type, pull and NAME=VALUE each"),
        (
            "clk 1 A=1 B=2 C=3 A=4",
            "line 1: `A=4` is the second setting of its kind: give one io type, pull and NAME=VALUE each",
        ),
        ("cal 1", "line 1: the chip has no port `cal`: did you mean `call`?"),
        ("zz 1 # no", "line 1: the chip has no port `zz`: its ports are `call`, `clk`, `count`, `rst`"),
        ("count 1", "line 1: `count` has 4 bits: write a row for each, `count[0]` to `count[3]`"),
        ("count[4] 1", "line 1: `count` has no bit `4`: its bits are `count[0]` to `count[3]`"),
        ("count[01] 1", "line 1: `count` has no bit `01`: its bits are `count[0]` to `count[3]`"),
        ("clk[0] 1", "line 1: `clk` has one bit: write `clk`"),
        (
            "clk\nrst",
            "line 1: `clk` has no pin: write the pin behind the port, as in `clk G2`\nline 2: `rst` has no pin: write the pin behind the port, as in `rst G2`",
        ),
    ] {
        assert_eq!(said(Dialect::Lpf, pins), wrong);
    }
}

#[test]
fn what_pins_leave_out_and_what_a_dialect_cannot_say() {
    let without = COUNT_PINS.replace("count[2] 97\n", "");
    assert_eq!(said(Dialect::Pcf, &without), "port `count[2]` has no pin: add the row `count[2] PIN`");
    let driven = COUNT_PINS.replace("99", "99 DRIVE=4");
    assert_eq!(said(Dialect::Pcf, &driven), "line 4: PCF knows `pull-up` alone: leave out `DRIVE=4`");
    assert!(said(Dialect::Sdc, "clk 21").starts_with("line 1: SDC has no pins: leave them out, or write XDC"));
}
