//! Enabled parts, clocks in place of others, and displays, in Icarus, Verilator and Yosys.

use std::process::Command;

use tilewright_cosim::check::check_design;
use tilewright_gen::{VerilogFile, testbench, tools, verilog};
use tilewright_hdl::*;
use tilewright_sim::{Error, Simulation};

const INNER: Clock = Clock::new("inner", Period::ns(6));
const OUTER: Clock = Clock::new("outer", Period::ns(6));

codes! { enum Phase { Idle = 0, Run = 2, Finished = 5 } }

block! {
    /// Adds up what it is given on two clocks, and says so.
    struct Adder;
    in AdderIn { x: bits(8), phase: one_of::<Phase>() }
    out AdderOut { sum: bits(8), ticks: bits(8) }
}

impl Adder {
    fn build(&self, m: Module, i: AdderIn) -> AdderOut {
        def!(total = m.reg(8).reset(3));
        total.when(i.x.ne(0), total + i.x);
        def!(ticks = m.on(INNER).reg(8).reset(0));
        ticks.next(ticks + 1);
        def!(words = m.memory(6, 8, ReadUnderWrite::Old).fill(1));
        words.write(i.x.bit(0), i.x.slice(0..3), *total);
        def!(word = words.read(i.x.slice(0..3)));
        m.assert(m.past(i.x).eq(0) | total.eq(m.past(*total) + m.past(i.x)), "it adds");
        m.cover("it wraps", m.fell(total.msb()));
        let values = [*total, total.signed(), total + word, i.phase, m.past(i.x)];
        m.display(i.x.bit(1), "100% \"{}\" {} {:x}: {}, before {:b}", &values);
        AdderOut { sum: total ^ word, ticks: *ticks }
    }
}

block! {
    /// Pauses one adder, a row of them lane by lane, and the inner clock.
    struct Board;
    in BoardIn { x: bits(8), run: bits(3), tick: bit().on(OUTER), phase: one_of::<Phase>() }
    out BoardOut { sums: bits(8).of(row(2)), sum: bits(8), ticks: bits(8) }
}

impl Board {
    fn build(&self, m: Module, i: BoardIn) -> BoardOut {
        let outer = m.on(OUTER);
        let fed = || AdderIn { x: i.x, phase: i.phase };
        outer.in_place_of(INNER, || {
            let one = m.enabled(i.run.bit(0), || m.instance("u_one", &Adder, fed()));
            let each = i.run.slice(1..3).unpack(row(2));
            let row = outer.enabled(i.tick, || m.enabled(each, || m.array("u_row", 2, &Adder, |_| fed())));
            m.display(i.x.ge(20), "much", &[]);
            BoardOut { sums: row.sum, sum: one.sum, ticks: one.ticks ^ row.ticks.lane(0) }
        })
    }
}

fn stimulus(sim: &mut Simulation) -> Result<(), Error> {
    let [x, run, tick, phase] = ["x", "run", "tick", "phase"].map(|name| sim.port(name).unwrap());
    sim.set(run, 7);
    sim.set(tick, 1);
    sim.try_reset()?;
    for step in 0..120_u64 {
        sim.set(x, step * 37 % 43);
        sim.set(run, step * 5 % 8);
        sim.set(tick, step % 3 % 2);
        sim.set(phase, [0, 2, 5, 7][step as usize % 4]);
        sim.try_step()?;
    }
    Ok(())
}

#[test]
fn enabled_parts_and_clocks_in_place_of_others_are_repeated() {
    check_design(&elaborate(&Board).unwrap(), stimulus).unwrap_or_else(|problems| panic!("{problems}"));
}

/// The lines of a replay but its verdict, sorted: two modules print at one instant in any sequence.
fn lines(mut run: Command) -> Vec<String> {
    let output = run.output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.contains("PASS: "), "{text}");
    let own = |line: &&str| !line.starts_with("PASS: ") && !line.starts_with("- ");
    let mut lines: Vec<String> = text.lines().filter(own).map(str::to_owned).collect();
    lines.sort();
    lines
}

#[test]
fn simulators_show_the_same_lines() {
    let design = elaborate(&Board).unwrap();
    let mut sim = Simulation::from_design(&design).unwrap();
    let (recording, messages) = (sim.recording(), sim.messages());
    stimulus(&mut sim).unwrap();
    let mut shown = messages.lines();
    for part in ["much", ": Run, ", ": Finished, ", ": ?, ", "\" -", "100% \""] {
        assert!(shown.iter().any(|line| line.contains(part)), "{part}: {shown:#?}");
    }
    shown.sort();
    let (files, bench) = (verilog(&design), testbench(&design, &recording.take()));
    let folder = tempfile::tempdir().unwrap();
    let all: Vec<&VerilogFile> = files.iter().chain([&bench]).collect();
    all.iter().for_each(|file| std::fs::write(folder.path().join(&file.name), &file.text).unwrap());
    let names: Vec<&str> = all.iter().map(|file| file.name.as_str()).filter(|name| name.ends_with(".v")).collect();
    if tools::skipped_without(&["iverilog", "vvp"]).is_none() {
        let mut compile = Command::new("iverilog");
        compile.args(["-g2005", "-o", "bench.vvp"]).args(&names).current_dir(folder.path());
        assert!(compile.status().unwrap().success());
        let mut run = Command::new("vvp");
        run.args(["-n", "bench.vvp"]).current_dir(folder.path());
        assert_eq!(lines(run), shown);
    }
    if tools::skipped_without(&["verilator", "perl", "make", "g++"]).is_none() {
        let top = bench.name.trim_end_matches(".v");
        let program = tools::verilated(folder.path(), &names, top, &[]).unwrap_or_else(|problems| panic!("{problems}"));
        assert_eq!(lines(Command::new(program.expect("it is installed"))), shown);
    }
}
