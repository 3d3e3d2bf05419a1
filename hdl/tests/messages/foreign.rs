//! Foreign modules, the clocks that they make, and pads.

use crate::messages::common::*;
use tilewright_hdl::*;

/// A register with a reset that stands for a foreign module.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "a block that is built twice for one function is no harm")]
struct FlipFlop {
    on: Option<Clock>,
    foreign: fn() -> Foreign,
}

impl std::fmt::Debug for FlipFlop {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("FlipFlop")
    }
}

impl Block for FlipFlop {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(8) }
    }

    fn build(&self, m: Module, i: Link) -> Out {
        let m = self.on.map_or(m, |clock| m.on(clock));
        def!(held = m.reg(8).reset(0));
        held.next(i.x);
        Out { out: *held }
    }

    fn foreign(&self) -> Option<Foreign> {
        Some((self.foreign)())
    }
}

fn says(foreign: fn() -> Foreign, message: &str) {
    let found = problems(&FlipFlop { on: None, foreign });
    assert!(found.starts_with(message), "{found}");
}

#[test]
fn state_of_a_model_needs_the_ports_of_its_clock() {
    assert_eq!(
        problems(&FlipFlop { on: None, foreign: || Foreign::module("DFF") }),
        "the model `FlipFlop` has state with a clock, but `DFF` has no port for it [T511]\n  \
         --> [def!(held = m.reg(8).reset(0));]\n  \
         help: name the port: `.clock(\"..\")` behind `Foreign::module(\"DFF\")`"
    );
    assert_eq!(
        problems(&FlipFlop { on: Some(FAST), foreign: || Foreign::module("DFF").clock_of(FAST, "C") }),
        "the model `FlipFlop` has state with a reset of `fast`, but `DFF` has no port for it [T511]\n  \
         --> [def!(held = m.reg(8).reset(0));]\n  \
         help: name the port: `.reset_of(FAST, \"..\")` behind `Foreign::module(\"DFF\")`, \
         or use `.initial(..)` in place of `.reset(..)`"
    );
    says(|| Foreign::module("DFF").clock("C"), "the model `FlipFlop` has state with a reset, but `DFF` has no port");
    let right = FlipFlop { on: None, foreign: || Foreign::module("DFF").clock("C").reset("R") };
    assert!(elaborate(&right).is_ok());
}

/// A model of some state.
#[derive(Clone, PartialEq, Eq, Hash)]
#[allow(unpredictable_function_pointer_comparisons, reason = "as that of `FlipFlop`")]
struct Model(fn(Module, Signal) -> Signal);

impl std::fmt::Debug for Model {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("Model")
    }
}

impl Block for Model {
    type In = Link;
    type Out = Out;

    fn inputs(&self) -> Link<Width> {
        Link { x: bits(8) }
    }

    fn build(&self, m: Module, i: Link) -> Out {
        Out { out: (self.0)(m, i.x) }
    }

    fn foreign(&self) -> Option<Foreign> {
        Some(Foreign::module("DFF").clock_of(FAST, "C"))
    }
}

/// An output may depend on state through whatever is between them.
#[test]
fn state_of_a_model_is_found_wherever_it_is() {
    let models: [fn(Module, Signal) -> Signal; 6] = [
        |m, x| !m.pipe("held", x),
        |m, x| {
            def!(words = m.memory(4, 8, ReadUnderWrite::Any).fill(0));
            words.write(x.bit(0), x.slice(1..3), x);
            words.read_async(x.slice(3..5))
        },
        |m, x| m.memory("words", 4, 8, ReadUnderWrite::Any).fill(0).read(x.trunc(2)),
        |m, x| m.instance("u_inverter", &Inverter { registered: true }, Link { x }).out,
        |m, x| m.instance("u_inverter", &Inverter { registered: false }, Link { x: m.pipe("held", x) }).out,
        |m, x| m.on(FAST).pipe("seen", m.pipe("held", x).quasi_static("it stays")),
    ];
    for model in models {
        let found = problems(&Model(model));
        assert!(found.starts_with("the model `Model` has state with a clock, but `DFF` has no port for it"), "{found}");
    }
    assert!(elaborate(&Model(|m, x| m.on(FAST).pipe("held", x.quasi_static("it stays")))).is_ok());
}

#[test]
fn nothing_stops_the_clock_of_a_foreign_module() {
    expect(
        |m, i| {
            let foreign = || Foreign::module("DFF").clock("C").reset("R");
            m.enabled(i.c, || m.instance("u_dff", &FlipFlop { on: None, foreign }, Link { x: i.a }).out)
        },
        "`DFF` is in an enabled part, but is a module of somebody else [T833]
         --> [m.enabled(i.c, || m.instance(\"u_dff\", &FlipFlop { on: None, foreign }, Link { x: i.a }).out)]
         help: it has no input for that enable: instantiate it outside, and enable it by a port of its own",
    );
}

#[test]
fn names_that_verilog_does_not_take() {
    let right = || Foreign::module("DFF").clock("C").reset("R");
    assert!(elaborate(&FlipFlop { on: None, foreign: right }).is_ok());
    for (foreign, message) in [
        (
            (|| Foreign::module("D FF").clock("C").reset("R")) as fn() -> Foreign,
            "`D FF` cannot be the name of a foreign module [T403]",
        ),
        (
            || Foreign::module("DFF").clock("C").reset("R").parameter("begin", 1),
            "`begin` cannot be the name of a parameter [T403]",
        ),
        (
            || Foreign::module("DFF").clock("C").reset("R").attribute("no name", "1"),
            "`no name` cannot be the name of an attribute [T403]",
        ),
        (|| Foreign::module("DFF").clock("C C").reset("R"), "`C C` cannot be the name of a clock [T403]"),
        (
            || Foreign::module("DFF").clock("C").reset("R").makes(FAST, "C O"),
            "`C O` cannot be the name of a clock [T403]",
        ),
        (|| Foreign::module("DFF").clock("C").reset("R").port("x", "C"), "input `C` has the name of a clock [T401]"),
        (
            || Foreign::module("DFF").clock("C").reset("R").parameter("INIT", 1).parameter("INIT", 0),
            "parameter `INIT` of `DFF` is given twice [T303]",
        ),
        (
            || Foreign::module("DFF").clock("C").reset("R").parameter("PERIOD", f64::NAN),
            "parameter `PERIOD` of `DFF` is NaN, which is no number of Verilog [T514]",
        ),
        (
            || Foreign::module("DFF").clock("C").reset("R").port("d", "D"),
            "port `D` of `DFF` is to be `d`, but `FlipFlop` has no such port [T510]",
        ),
        (
            || Foreign::module("flip_flop").clock("C").reset("R"),
            "`flip_flop` is a foreign module, and the module of `FlipFlop` [T405]",
        ),
    ] {
        says(foreign, message);
    }
}

block! {
    /// An oscillator that nothing is known of.
    struct Oscillator;
    foreign = Foreign::module("OSC").capitals();
    in = Link { x: bits(8) };
    out = Out { out: bits(8) };
}

impl Oscillator {
    fn build(&self, m: Module, i: Link) -> Out {
        m.unmodelled(&i, Out { out: bits(8) })
    }
}

#[test]
fn a_simulation_needs_models() {
    let design = elaborate(&Case(|m, i| m.instance("u_oscillator", &Oscillator, Link { x: i.a }).out)).unwrap();
    let says = "foreign module `OSC` has no model, so the design cannot be simulated [T512]";
    for error in [
        design.check_models().map_err(|problems| problems.to_string()),
        tilewright_sim::Simulation::from_design(&design).map(|_| ()).map_err(|error| error.to_string()),
        tilewright_sim::Batch::of(&Oscillator, 2).map(|_| ()).map_err(|error| error.to_string()),
    ] {
        let error = error.unwrap_err();
        assert!(error.starts_with(says), "{error}");
        assert!(error.contains("describe a model in the block's `build`, in place of `m.unmodelled(..)`"), "{error}");
    }
}

#[test]
fn only_a_foreign_module_is_without_a_circuit() {
    expect(
        |m, i| m.unmodelled(&i, bits(8)),
        "`Case` is described as unmodelled, but is no foreign module [T513]
         --> [|m, i| m.unmodelled(&i, bits(8)),]
         help: name the module in `block!`, as in `foreign = Foreign::module(\"EHXPLLL\");`, or describe a circuit",
    );
}

block! {
    /// Makes a clock of another.
    struct Pll;
    foreign = Foreign::module("PLL").clock("CKI").makes(FAST, "CKO").capitals();
    out PllOut { lock: bit() }
}

impl Pll {
    fn build(&self, _: Module, (): ()) -> PllOut {
        PllOut { lock: lit(1, 1) }
    }
}

block! {
    /// Has the clock made inside.
    struct Tuner;
    out TunerOut { lock: bit() }
}

impl Tuner {
    fn build(&self, m: Module, (): ()) -> TunerOut {
        TunerOut { lock: m.instance("u_pll", &Pll, ()).lock }
    }
}

#[test]
fn a_clock_is_made_once_and_in_the_top() {
    assert!(elaborate(&Tuner).is_ok());
    expect(
        |m, _| m.instance("u_tuner", &Tuner, ()).lock,
        "`u_pll` makes the clock `fast` in `tuner`, which is not the top [T808]
         --> [TunerOut { lock: m.instance(\"u_pll\", &Pll, ()).lock }]
         help: instantiate it in the top",
    );
    let twice = problems(&Case(|m, _| m.instance("u_one", &Pll, ()).lock & m.instance("u_two", &Pll, ()).lock));
    assert!(twice.starts_with("`u_two` makes the clock `fast`, which `u_one` makes [T808]"), "{twice}");
    let lanes = problems(&Case(|m, _| m.array("u_pll", 3, &Pll, |_| ()).lock.and_all()));
    assert!(lanes.starts_with("`u_pll` makes the clock `fast` in 3 lanes [T808]"), "{lanes}");
}

block! {
    /// Has a pad, and is told how to be wrong.
    struct Wired { wrong: u32 }
    in WiredIn {
        sda: Outside::widths(1),
        table: Outside::widths(1),
        friend: Outside::widths(1),
        clk: Outside::widths(1),
        other: Outside::widths(1),
        low: bit(),
    }
    out WiredOut { line: bit(), other: bit() }
}

impl Wired {
    fn build(&self, m: Module, i: WiredIn) -> WiredOut {
        m.ignore(&i);
        let (low, name) = (i.low, if self.wrong == 8 { "sda" } else { "u_sda" });
        let outside = match self.wrong {
            1 => Outside { value: i.sda.value, drives: i.low },
            2 => Outside { value: !i.sda.value, ..i.sda },
            3 => i.table,
            7 => i.clk,
            15 => Outside { drives: i.table.drives, ..i.sda },
            9 => i.friend,
            10 => i.other,
            _ => i.sda,
        };
        let pad = m.instance(name, &Pad::new(1).pull_up(), PadIn::open_drain(low, outside));
        let words = |name: &str| m.memory(name, 2, 1, ReadUnderWrite::Any).fill(0);
        let other = match self.wrong {
            4 => i.sda.value,
            5 => (!low).named("sda"),
            11 => m.pipe("seen", i.sda.value),
            16 => !i.sda.drives,
            12 => words("words").read_async(i.sda.value),
            13 => words("sda").read_async(low),
            _ => low,
        };
        match self.wrong {
            6 => m.display(low, "{}", &[i.sda.value]),
            14 => {
                let words = words("words");
                words.write(low, low, i.sda.value);
                m.display(low, "{}", &[words.read(low)]);
            }
            _ => {}
        }
        WiredOut { line: pad.line, other }
    }
}

block! {
    /// Has pads below its top.
    struct Board;
    in BoardIn { sda: Outside::widths(1), table: Outside::widths(1), low: bit() }
    out BoardOut { line: bit() }
}

impl Board {
    fn build(&self, m: Module, i: BoardIn) -> BoardOut {
        let BoardIn { sda, table, low } = i;
        let inner = WiredIn { sda, table, friend: sda, clk: sda, other: sda, low };
        BoardOut { line: m.instance("u_wired", &Wired { wrong: 0 }, inner).line }
    }
}

block! {
    /// Has pads in lanes.
    struct Row;
    in RowIn { sda: Outside { value: bit().of(row(2)), drives: bit().of(row(2)) } }
    out RowOut { line: bit().of(row(2)) }
}

impl Row {
    fn build(&self, m: Module, i: RowIn) -> RowOut {
        let into = PadIn { out: lit(1, 0), enable: lit(1, 0), outside: i.sda };
        RowOut { line: m.array("u_pads", 2, &Pad::new(1), |_| into).line }
    }
}

#[test]
fn pads_are_ports_of_the_top() {
    assert!(elaborate(&Wired { wrong: 0 }).is_ok());
    let help = "declare the input, as in `sda: Outside::widths(1)`, give it to one pad, and read the pad's `line`";
    let message = "the outside of pad `u_sda` is not an input of `wired_wrong1` that is used for it alone [T516]";
    for wrong in [1, 2, 4, 6, 11, 12, 14, 15, 16] {
        let found = problems(&Wired { wrong }).replace(&format!("wrong{wrong}"), "wrong1");
        assert!(found.starts_with(message) && found.ends_with(help), "{found}");
    }
    for (wrong, message) in [
        (3, "pad `table` has a reserved word for a name [T402]"),
        (5, "pad `sda` has the name of a net [T401]"),
        (7, "pad `clk` has the name of a clock [T401]"),
        (8, "pad `sda` has the name of an instance [T401]"),
        (9, "pad `friend` has a reserved word for a name [T402]"),
        (10, "pad `other` has the name of an output [T401]"),
        (13, "pad `sda` has the name of a memory [T401]"),
    ] {
        let found = problems(&Wired { wrong });
        assert!(found.starts_with(message), "{found}");
    }
    let below = problems(&Board);
    assert!(below.starts_with("pad `u_sda` is in `wired_wrong0`, which is not the top [T515]"), "{below}");
    let lanes = problems(&Row);
    assert!(lanes.starts_with("pad `u_pads` is an array of 2 lanes [T515]"), "{lanes}");
}
