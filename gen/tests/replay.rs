//! Testbenches pass for what the hardware does, and fail for what it does not.

use crate::blocks::{Clocks, Counter, LineBuffer, Row};
use std::panic::{AssertUnwindSafe, catch_unwind};
use tilewright_gen::tools::{self, Problems};
use tilewright_gen::{testbench, verilog};
use tilewright_hdl::recording::{Initial, Step};
use tilewright_hdl::{
    Bits, Block, Module, ReadUnderWrite, Recording, bit, bits as wide, block, def, elaborate, lit, row,
};

/// A value and its width.
type Value = (u32, u64);

fn bits(values: &[Value]) -> Vec<Bits> {
    values.iter().map(|&(width, value)| Bits::new(width, value)).collect()
}

/// A step of one clock of 10 ns: its cycle, whether the reset is high, inputs, outputs.
fn step(cycle: u64, reset: bool, inputs: &[Value], outputs: &[Value]) -> Step {
    let resets = if reset { vec![0] } else { vec![] };
    let time_ps = 10_000 * (cycle + 1);
    Step { time_ps, rising: vec![0], resets, inputs: bits(inputs), outputs: bits(outputs) }
}

fn run<B: Block>(block: &B, recording: &Recording) -> Result<(), Problems> {
    let design = elaborate(block).expect("the block is sound");
    let (files, bench) = (verilog(&design), testbench(&design, recording));
    let _ = tools::replay_in_icarus(&files, &bench)?;
    let _ = tools::replay_in_verilator(&files, &bench)?;
    Ok(())
}

fn counting() -> Recording {
    let steps = vec![
        step(0, true, &[(1, 1)], &[(8, 0), (1, 0)]),
        step(1, false, &[(1, 1)], &[(8, 0), (1, 0)]),
        step(2, false, &[(1, 0)], &[(8, 1), (1, 0)]),
        step(3, false, &[(1, 1)], &[(8, 1), (1, 0)]),
        step(4, false, &[(1, 1)], &[(8, 2), (1, 1)]),
        step(5, false, &[(1, 1)], &[(8, 0), (1, 0)]),
    ];
    Recording { steps, initial: Vec::new() }
}

#[test]
fn a_counter_passes() {
    run(&Counter { width: 8, limit: 3 }, &counting()).unwrap();
}

/// The period of 60 Hz has more than 32 bits of picoseconds.
#[test]
fn a_clock_may_take_a_second() {
    let mut slow = counting();
    for (step, cycle) in slow.steps.iter_mut().zip(1..) {
        step.time_ps = cycle * 1_000_000_000_001;
    }
    run(&Counter { width: 8, limit: 3 }, &slow).unwrap();
    let mut uneven = slow.clone();
    uneven.steps[5].time_ps += 1_000_000_000_000;
    run(&Counter { width: 8, limit: 3 }, &uneven).unwrap();
}

/// Icarus rejects a literal with so many digits.
#[test]
fn outputs_of_70000_bits_are_compared() {
    let design = elaborate(&Counter { width: 70_000, limit: 3 }).expect("the block is sound");
    let outputs = |count: u64, wrapped: u64| vec![Bits::new(70_000, count), Bits::new(1, wrapped)];
    let mut recording = counting();
    for (step, (count, wrapped)) in recording.steps.iter_mut().zip([(0, 0), (0, 0), (1, 0), (1, 0), (2, 1), (0, 0)]) {
        step.outputs = outputs(count, wrapped);
    }
    let replay = |recording: &Recording| tools::replay_in_icarus(&verilog(&design), &testbench(&design, recording));
    let _ = replay(&recording).unwrap();
    let highest = Bits::new(1, 1).concat(&Bits::new(69_999, 1));
    recording.steps[3].outputs[0] = highest;
    match replay(&recording) {
        Ok(checked) => assert_eq!(checked, tools::Checked::Skipped, "Icarus accepts a wrong expectation"),
        Err(problems) => assert!(problems.to_string().contains("FAIL: 1 mismatches in 6 cycles"), "{problems}"),
    }
}

#[test]
fn a_wrong_expectation_fails_with_port_and_cycle() {
    let mut wrong = counting();
    wrong.steps[4].outputs[0] = Bits::new(8, 7);
    let design = elaborate(&Counter { width: 8, limit: 3 }).expect("the block is sound");
    match tools::replay_in_icarus(&verilog(&design), &testbench(&design, &wrong)) {
        Ok(checked) => assert_eq!(checked, tools::Checked::Skipped, "Icarus accepts a wrong expectation"),
        Err(problems) => {
            let text = problems.to_string();
            assert!(text.contains("FAIL: cycle 4: count is 02, expected 07"), "{text}");
            assert!(text.contains("FAIL: 1 mismatches in 6 cycles"), "{text}");
        }
    }
}

/// Each is compared all the same, at its own cycle, in more than one constant of rows.
#[test]
fn steps_that_are_alike_have_one_row() {
    let design = elaborate(&Counter { width: 8, limit: 200 }).expect("the block is sound");
    let count = |cycle: u64| cycle / 3 % 200;
    let counting = |cycle: u64| {
        let wrapped = count(cycle) == 199 && cycle % 3 == 2;
        step(cycle, false, &[(1, u64::from(cycle % 3 == 2))], &[(8, count(cycle)), (1, u64::from(wrapped))])
    };
    let mut recording = Recording { steps: (0..9000).map(counting).collect(), initial: Vec::new() };
    let text = testbench(&design, &recording).text;
    assert_eq!(text.matches(", 9'h").count(), 6000, "two rows for three steps");
    assert!(text.contains("2'h2, 2'h0, 9'h") && text.matches(" put(").count() > 1, "{}", &text[..2000]);
    run(&Counter { width: 8, limit: 200 }, &recording).unwrap();
    recording.steps[6001].outputs[0] = Bits::new(8, 255);
    match tools::replay_in_icarus(&verilog(&design), &testbench(&design, &recording)) {
        Ok(checked) => assert_eq!(checked, tools::Checked::Skipped, "Icarus accepts a wrong expectation"),
        Err(problems) => {
            assert!(problems.to_string().contains("FAIL: cycle 6001: count is 00, expected ff"), "{problems}")
        }
    }
}

/// The gaps between steps change all the time, the rest once in 500 steps.
#[test]
fn what_stays_while_other_values_change_is_written_once() {
    let block = Counter { width: 8, limit: 200 };
    let design = elaborate(&block).expect("the block is sound");
    let counting = |cycle: u64| {
        let (count, counts) = (cycle / 500, cycle % 500 == 499);
        let time_ps = 10 * (cycle + 1) + cycle % 2;
        Step { time_ps, ..step(cycle, false, &[(1, u64::from(counts))], &[(8, count), (1, 0)]) }
    };
    let mut recording = Recording { steps: (0..9000).map(counting).collect(), initial: Vec::new() };
    let text = testbench(&design, &recording).text;
    let sizes = ["gap_steps [0:8999];", "stimulus_steps [0:35];", "expected_steps [0:17];"];
    sizes.iter().for_each(|size| assert!(text.contains(size), "no {size} in {}", &text[..3000]));
    let gaps: Vec<&str> = text.lines().filter(|line| line.starts_with("            4'h")).collect();
    assert!(gaps.len() < 1000 && gaps.iter().all(|line| line.len() < 150), "short rows share a line: {}", gaps.len());
    run(&block, &recording).unwrap();
    recording.steps[6001].outputs[0] = Bits::new(8, 255);
    match tools::replay_in_icarus(&verilog(&design), &testbench(&design, &recording)) {
        Ok(checked) => assert_eq!(checked, tools::Checked::Skipped, "Icarus accepts a wrong expectation"),
        Err(problems) => {
            assert!(problems.to_string().contains("FAIL: cycle 6001: count is 0c, expected ff"), "{problems}")
        }
    }
}

/// The message for a recording of the counter that was changed so that it does not fit.
fn refusal(change: impl FnOnce(&mut Recording)) -> String {
    let mut recording = counting();
    change(&mut recording);
    let design = elaborate(&Counter { width: 8, limit: 3 }).expect("the block is sound");
    let printed = catch_unwind(AssertUnwindSafe(|| testbench(&design, &recording)));
    *printed.expect_err("the recording does not fit").downcast().expect("a panic has a message")
}

#[test]
fn a_recording_that_does_not_fit_is_refused() {
    let late = |ps: u64| move |recording: &mut Recording| recording.steps[1].time_ps = recording.steps[0].time_ps + ps;
    assert_eq!(refusal(late(1)), "step 1 of the recording is less than 2 ps after the step before");
    let mut recording = counting();
    late(2)(&mut recording);
    let design = elaborate(&Counter { width: 8, limit: 3 }).expect("the block is sound");
    let text = testbench(&design, &recording).text;
    assert!(text.contains("\n            15'h0002, 2'h1, 9'h000,\n"), "{text}");
    let clock = "step 2 of the recording names a clock that `counter_width8_limit3` does not have";
    assert_eq!(refusal(|recording| recording.steps[2].rising = vec![1]), clock);
    assert_eq!(refusal(|recording| recording.steps[2].resets = vec![1]), clock);
    let widths = "the values of step 3 of the recording have other widths than the ports";
    assert!(refusal(|recording| recording.steps[3].inputs[0] = Bits::new(2, 1)).contains(widths));
    assert!(refusal(|recording| recording.steps[3].outputs.truncate(1)).contains(widths));
    let start = |path: &str, words: usize| {
        let initial = Initial { path: path.to_string(), address: 0, words: vec![Bits::zero(8); words] };
        refusal(|recording| recording.initial = vec![initial])
    };
    let none = "the recording gives `total` an initial value, but the design has no such register or memory";
    assert_eq!(start("total", 1), none);
    assert_eq!(start("count", 2), "`count` is one value, the recording gives 2");
}

#[test]
fn lanes_and_memories_start_from_what_the_recording_says() {
    let outputs = [(1, 0), (1, 0), (8, 9), (8, 12), (8, 0x67)];
    let initial = [(0, 1), (1, 2), (4, 9)].map(|(lane, value)| Initial {
        path: format!("u_cell[{lane}].q"),
        address: 0,
        words: vec![Bits::new(8, value)],
    });
    let recording = Recording { steps: vec![step(0, false, &[(1, 0), (8, 5)], &outputs)], initial: initial.to_vec() };
    run(&Row { lanes: 5 }, &recording).unwrap();

    let line =
        Initial { path: "line".to_owned(), address: 6, words: [0x123, 0x456].map(|word| Bits::new(24, word)).to_vec() };
    let read = Initial { path: "line_read".to_owned(), address: 0, words: vec![Bits::new(24, 3)] };
    // Reads words 5, 6 and 7, one cycle later; the gain doubles.
    let cycle = |(cycle, (x, nearest)): (u64, (u64, u64))| {
        step(cycle, false, &[(1, 0), (10, 0), (24, 0), (10, x), (2, 1)], &[(24, nearest), (32, 2 * nearest)])
    };
    let steps = (0..).zip([(5, 3), (6, 0xff_ffff), (7, 0x123), (0, 0x456)]).map(cycle).collect();
    run(&LineBuffer, &Recording { steps, initial: vec![line, read] }).unwrap();
}

block! {
    /// A memory with a row of one bit in each word, which is plain in Verilog.
    struct Flags;
    in FlagsIn { write: bit(), at: bit() }
    out FlagsOut { flag: bit().of(row(1)) }
}

impl Flags {
    fn build(&self, m: Module, i: FlagsIn) -> FlagsOut {
        def!(flags = m.memory(2, bit().of(row(1)), ReadUnderWrite::Any));
        flags.write(i.write, i.at, i.at.of(row(1)));
        FlagsOut { flag: flags.read_async(i.at) }
    }
}

#[test]
fn a_single_lane_of_a_single_bit_starts_as_a_whole() {
    let words = [1, 0].map(|word| Bits::new(1, word)).to_vec();
    let initial = vec![Initial { path: "flags[0]".to_owned(), address: 0, words }];
    let steps = [(0, 1), (1, 0)].map(|(at, flag)| step(at, false, &[(1, 0), (1, at)], &[(1, flag)])).to_vec();
    run(&Flags, &Recording { steps, initial }).unwrap();
}

block! {
    /// A memory for each lane, which are written at addresses of their own and read at one.
    struct Shared;
    in SharedIn { to: wide(2).of(row(2)), from: wide(2) }
    out SharedOut { word: wide(2).of(row(2)) }
}

impl Shared {
    fn build(&self, m: Module, i: SharedIn) -> SharedOut {
        def!(words = m.memory(4, wide(2).of(row(2)), ReadUnderWrite::Any).fill(0));
        words.write(lit(1, 1), i.to, i.to);
        SharedOut { word: words.read_async(i.from + i.from) }
    }
}

/// Icarus does not truncate an expression in an index to its width.
#[test]
fn an_address_that_lanes_share_is_computed_once() {
    let step = |(cycle, (from, word))| step(cycle, false, &[(4, 0b10_10), (2, from)], &[(4, word)]);
    let steps = (0..).zip([(0, 0), (1, 0b10_10), (2, 0), (3, 0b10_10)]).map(step).collect();
    run(&Shared, &Recording { steps, initial: Vec::new() }).unwrap();
}

#[test]
fn several_clocks_keep_their_relative_times() {
    // Every 10 ns `count` grows, every 14 ns `seen` takes it; at 70 ns both edges see the values before.
    let steps = [10, 14, 20, 28, 30, 40, 42, 50, 56, 60, 70, 80].map(|ns: u64| {
        let rising: Vec<usize> =
            [10, 14].iter().enumerate().filter(|(_, period)| ns.is_multiple_of(**period)).map(|at| at.0).collect();
        let (count, seen) = ((ns - 1) / 10, (ns - 1) / 14 * 14);
        let seen = if seen == 70 { 6 } else { seen / 10 };
        Step { time_ps: ns * 1000, rising, resets: vec![], inputs: vec![], outputs: bits(&[(8, count), (8, seen)]) }
    });
    run(&Clocks, &Recording { steps: steps.to_vec(), initial: vec![] }).unwrap();
}

#[test]
fn a_dump_is_replayed_against_the_verilog() {
    let design = elaborate(&Counter { width: 8, limit: 3 }).expect("the block is sound");
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let check = |last: &str| {
        let mut dump = String::from("$timescale 1ps $end\n$scope module tb $end\n$scope module dut $end\n");
        for (id, width, name) in [("c", 1, "clk"), ("r", 1, "rst"), ("e", 1, "enable"), ("n", 8, "count")] {
            dump += &format!("$var wire {width} {id} {name} $end\n");
        }
        dump += "$upscope $end\n$upscope $end\n$enddefinitions $end\n#0\n0c\n1r\n1e\nb0 n\n";
        for (cycle, count) in ["0", "1", "10", last].iter().enumerate() {
            let reset = if cycle == 0 { "0r\n" } else { "" };
            dump += &format!("#{}\n1c\nb{count} n\n#{}\n0c\n{reset}", 10 + 20 * cycle, 20 + 20 * cycle);
        }
        let path = folder.path().join("run.vcd");
        std::fs::write(&path, dump + "#100\n").expect("a dump can be written");
        tools::yosys_replay_vcd(&verilog(&design), &path, "tb.dut", &["clk"])
    };
    let _ = check("0").unwrap();
    match check("11") {
        Ok(checked) => assert_eq!(checked, tools::Checked::Skipped, "Yosys accepts a wrong dump"),
        Err(problems) => assert!(problems.to_string().contains("difference"), "{problems}"),
    }
}

/// Yosys reads a VCD through another program, which the check knows.
#[cfg(unix)]
#[test]
fn a_program_that_is_called_through_another_is_named_when_it_is_missing() {
    if tools::skipped_without(&["yosys"]).is_some() {
        return;
    }
    let path = std::env::var_os("PATH").expect("yosys is on it");
    let yosys = std::env::split_paths(&path).map(|folder| folder.join("yosys")).find(|file| file.is_file());
    let yosys = yosys.expect("it is installed");
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    std::os::unix::fs::symlink(yosys, folder.path().join("yosys")).expect("a link can be made");
    let run = |in_ci: bool| {
        let mut command = std::process::Command::new(std::env::current_exe().expect("the test is a program"));
        command.args(["replay::a_dump_is_replayed_against_the_verilog", "--exact"]).env("PATH", folder.path());
        if in_ci {
            command.env("CI", "1")
        } else {
            command.env_remove("CI")
        };
        let output = command.output().expect("the test can be run");
        (output.status.success(), String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned())
    };
    let (passes, text) = run(false);
    assert!(passes && text.contains("skipped: vcd2fst is not installed"), "{text}");
    let (passes, text) = run(true);
    assert!(!passes && text.contains("vcd2fst is not installed, and CI is set"), "{text}");
}
