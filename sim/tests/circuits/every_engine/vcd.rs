//! Waveform files: the whole text of a small one, filters, the flight recorder, and errors.

use std::fs;
use std::path::PathBuf;

use crate::circuits::engine::{engine, of};
use tilewright_hdl::{Module, bit, bits, block, codes, stack, when};
use tilewright_sim::{Error, Trace, Vcd};

codes! {
    enum Lamp { Off, On }
}

block! {
    struct OneLamp;
    in LampIn { toggle: bit() }
    out LampOut { lit: _ }
}

impl OneLamp {
    fn build(&self, m: Module, i: LampIn) -> LampOut {
        let lamp = m.fsm("lamp", Lamp::Off);
        lamp.next(|now| match now {
            Lamp::Off => when(i.toggle, Lamp::On),
            Lamp::On => when(i.toggle, Lamp::Off),
        });
        LampOut { lit: lamp.is(Lamp::On) }
    }
}

block! {
    /// Two lamps and a count of edges, which must stay below 3.
    struct Lamps;
    in LampsIn { toggle: bits(2) }
    out LampsOut { all: _, count: _ }
}

impl Lamps {
    fn build(&self, m: Module, i: LampsIn) -> LampsOut {
        let count = m.reg("count", 4).reset(0);
        count.next(count + 1);
        m.assert(count.lt(3), "the count goes on");
        let lamps = m.array("u_lamp", 2, &OneLamp, |_| LampIn { toggle: stack([i.toggle.bit(0), i.toggle.bit(1)]) });
        LampsOut { all: lamps.lit.and_all(), count: *count }
    }
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{:?}_{name}", engine()))
}

/// The text after two steps, the second with both lamps toggled.
fn two_steps(trace: Trace, name: &str) -> String {
    let mut sim = of(&Lamps);
    sim.trace(trace).unwrap();
    sim.step();
    sim.set(sim.i.toggle, 3);
    sim.step();
    sim.finish().unwrap();
    fs::read_to_string(path(name)).unwrap()
}

#[test]
fn a_file_has_the_hierarchy_of_the_verilog_and_real_times() {
    let text = two_steps(Vcd::to(path("whole.vcd")), "whole.vcd");
    let expected = "\
$version
    Tilewright 0.1.0
$end
$timescale 1 ps $end
$scope module lamps $end
$var wire 1 ! clk $end
$var wire 1 \" rst $end
$var wire 2 # toggle [1:0] $end
$var wire 1 $ all $end
$var reg 4 % count [3:0] $end
$scope begin u_lamp[0] $end
$scope module lane $end
$var wire 1 ! clk $end
$var wire 1 \" rst $end
$var wire 1 & toggle $end
$var wire 1 ' lit $end
$var reg 1 ' lamp $end
$var string 1 ( lamp_state $end
$upscope $end
$upscope $end
$scope begin u_lamp[1] $end
$scope module lane $end
$var wire 1 ! clk $end
$var wire 1 \" rst $end
$var wire 1 ) toggle $end
$var wire 1 * lit $end
$var reg 1 * lamp $end
$var string 1 + lamp_state $end
$upscope $end
$upscope $end
$upscope $end
$enddefinitions $end
#0
$dumpvars
b0 #
0$
b0 %
0&
0'
sOff (
0)
0*
sOff +
0!
0\"
$end
#10000
b11 #
b1 %
1&
1)
1!
#15000
0!
#20000
1$
b10 %
1'
sOn (
1*
sOn +
1!
#25000
0!
#30000
";
    assert_eq!(text, expected, "{text}");
}

block! {
    /// A register that is an output by another name.
    struct Shown;
    out ShownOut { shown: _ }
}

impl Shown {
    fn build(&self, m: Module, _: ()) -> ShownOut {
        let count = m.reg("count", 4).reset(0);
        count.next(count + 1);
        ShownOut { shown: *count }
    }
}

#[test]
fn an_output_that_is_a_register_by_another_name_is_a_wire() {
    let mut sim = of(&Shown);
    sim.trace(Vcd::to(path("shown.vcd"))).unwrap();
    sim.step();
    sim.finish().unwrap();
    let text = fs::read_to_string(path("shown.vcd")).unwrap();
    let kind = |name: &str| text.lines().find(|line| line.contains(name)).and_then(|line| line.split(' ').nth(1));
    assert_eq!((kind(" shown "), kind(" count ")), (Some("wire"), Some("reg")), "{text}");
}

/// The names of all variables of a file, which must be readable to its end.
fn names(text: &str) -> Vec<String> {
    let mut parser = vcd::Parser::new(text.as_bytes());
    let header = parser.parse_header().unwrap();
    parser.for_each(|command| drop(command.unwrap()));
    let mut names = Vec::new();
    let mut open: Vec<(String, &vcd::ScopeItem)> = header.items.iter().map(|item| (String::new(), item)).collect();
    while let Some((path, item)) = open.pop() {
        match item {
            vcd::ScopeItem::Var(var) => names.push(format!("{path}{}", var.reference)),
            vcd::ScopeItem::Scope(scope) => {
                open.extend(scope.items.iter().map(|item| (format!("{path}{}.", scope.identifier), item)));
            }
            _ => {}
        }
    }
    names.sort();
    names
}

#[test]
fn patterns_choose_signals() {
    let text = two_steps(Vcd::to(path("some.vcd")).only("u_lamp[1].l*").only("all"), "some.vcd");
    let inside = ["lamp", "lamp_state", "lit"].map(|name| format!("lamps.u_lamp[1].lane.{name}"));
    assert_eq!(names(&text), [vec!["lamps.all".to_string(), "lamps.clk".to_string()], inside.to_vec()].concat());

    let mut sim = of(&Lamps);
    let error = sim.trace(Vcd::to(path("none.vcd")).only("u_lamp[2].**")).unwrap_err().to_string();
    assert_eq!(error, "there is no signal that matches `u_lamp[2].**`: did you mean `u_lamp[0].**`?");
    let error = sim.trace(Vcd::to(path("none.vcd")).only("u_lamp[1].clkk")).unwrap_err().to_string();
    assert_eq!(error, "there is no signal that matches `u_lamp[1].clkk`: did you mean `u_lamp[1].clk`?");
}

#[test]
fn cycles_choose_a_part_of_the_run() {
    let text = two_steps(Vcd::to(path("part.vcd")).only("count").cycles("clk", 1..2), "part.vcd");
    let (_, body) = text.split_once("$enddefinitions $end\n").unwrap();
    assert_eq!(body, "#10000\n$dumpvars\nb1 \"\n1!\n$end\n#15000\n0!\n#20000\n");
    let mut sim = of(&Lamps);
    let error = sim.trace(Vcd::to(path("part.vcd")).cycles("clkk", 0..1)).unwrap_err().to_string();
    assert_eq!(error, "there is no clock `clkk`: did you mean `clk`?");
}

#[test]
fn a_flight_recorder_writes_what_led_to_the_failure() {
    let file = path("flight.vcd");
    let _ = fs::remove_file(&file);
    let mut sim = of(&Lamps);
    sim.trace(Vcd::to(&file).only("count").last(2)).unwrap();
    sim.run(3);
    assert!(!file.exists());
    assert!(matches!(sim.try_step(), Err(Error::Violated(_))));
    let text = fs::read_to_string(&file).unwrap();
    let (_, body) = text.split_once("$enddefinitions $end\n").unwrap();
    assert_eq!(body, "#20000\n$dumpvars\nb10 \"\n1!\n$end\n#25000\n0!\n#30000\nb11 \"\n1!\n#35000\n0!\n");
}

#[test]
fn a_window_is_kept_to_its_ends() {
    let body = |text: String| text.split_once("$enddefinitions $end\n").unwrap().1.to_string();
    let window = |name: &str| Vcd::to(path(name)).only("count").times(12_000..26_000);
    let text = two_steps(window("window.vcd"), "window.vcd");
    let expected = "#12000\n$dumpvars\nb1 \"\n1!\n$end\n#15000\n0!\n#20000\nb10 \"\n1!\n#25000\n0!\n#26000\n";
    assert_eq!(body(text), expected);

    let file = path("window_flight.vcd");
    let mut sim = of(&Lamps);
    sim.trace(window("window_flight.vcd").last(9)).unwrap();
    assert!(matches!(sim.try_run(9), Err(Error::Violated(_))));
    assert_eq!(body(fs::read_to_string(file).unwrap()), expected.strip_suffix("#26000\n").unwrap());
}

#[test]
fn a_run_that_is_not_finished_leaves_a_file_that_opens() {
    let file = path("dropped.vcd");
    let mut sim = of(&Lamps);
    sim.trace(Vcd::to(&file)).unwrap();
    sim.run(2);
    drop(sim);
    let text = fs::read_to_string(&file).unwrap();
    assert_eq!(names(&text).len(), 17);
    assert!(text.ends_with("#15000\n0!\n"));
}

#[test]
fn a_full_device_is_an_error_that_names_the_file() {
    let mut sim = of(&Lamps);
    let error = sim.trace(Vcd::to("/dev/full")).unwrap_err().to_string();
    assert!(error.starts_with("cannot write the trace /dev/full: No space left"), "{error}");
    let error = sim.trace(Vcd::to(path("no_such_folder/a.vcd"))).unwrap_err().to_string();
    assert!(error.contains("no_such_folder/a.vcd: No such file"), "{error}");
}

#[test]
fn the_error_of_an_assertion_comes_before_that_of_its_trace() {
    let mut sim = of(&Lamps);
    sim.trace(Vcd::to(path("no_such_folder/b.vcd")).last(2)).unwrap();
    let error = sim.try_run(9).unwrap_err();
    assert!(matches!(error, Error::Violated(_)), "{error}");
    let error = sim.try_step().unwrap_err().to_string();
    assert!(error.contains("no_such_folder/b.vcd: No such file"), "{error}");
    assert!(matches!(sim.try_step(), Err(Error::Violated(_))), "an error is reported once");
    sim.finish().unwrap();
}

#[test]
fn a_reset_reports_a_trace_that_cannot_be_written() {
    let mut sim = of(&Lamps);
    sim.trace(Vcd::to(path("no_such_folder/d.vcd")).last(2)).unwrap();
    assert!(matches!(sim.try_run(9), Err(Error::Violated(_))));
    let error = sim.try_reset().unwrap_err().to_string();
    assert!(error.contains("no_such_folder/d.vcd: No such file"), "{error}");
    sim.try_reset().unwrap();
    assert_eq!(sim.get_u64(sim.o.count), 0);
}

#[test]
fn a_trace_is_finished_although_another_one_failed() {
    let mut sim = of(&Lamps);
    sim.trace(Vcd::to(path("no_such_folder/c.vcd")).last(2)).unwrap();
    sim.trace(Vcd::to(path("second.vcd"))).unwrap();
    assert!(matches!(sim.try_run(9), Err(Error::Violated(_))));
    let error = sim.finish().unwrap_err().to_string();
    assert!(error.contains("no_such_folder/c.vcd: No such file"), "{error}");
    let text = fs::read_to_string(path("second.vcd")).unwrap();
    assert!(text.ends_with("#35000\n0!\n#40000\n"), "{text}");
}
