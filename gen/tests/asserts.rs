//! Assertions of the description reach every tool that reads the Verilog.

use std::process::Command;
use tilewright_gen::tools::{self, Checked, Problems};
use tilewright_gen::{VerilogFile, testbench, verilog};
use tilewright_hdl::recording::Step;
use tilewright_hdl::*;

const SLOW: Clock = Clock::new("slow", Period::ns(14));

/// The assertion of each lane, with text that needs escaping in Verilog.
const LANE_MESSAGE: &str = "100% of \"x\"\nstay \\below\\ 200, é";

block! {
    /// Stores its input.
    struct Cell;
    in CellIn { x: bits(8) }
    out CellOut { y: _ }
}

impl Cell {
    fn build(&self, m: Module, i: CellIn) -> CellOut {
        let y = m.pipe("held", i.x);
        m.assert(y.lt(200), LANE_MESSAGE);
        CellOut { y }
    }
}

block! {
    /// Assertions in lanes, on two clocks, about a choice, and about nets that nothing else reads; none of its
    /// registers has a reset.
    struct Asserted;
    in TopIn { x: bits(8), go: bit() }
    out TopOut { y: _, count: _, seen: _ }
}

impl Asserted {
    fn build(&self, m: Module, i: TopIn) -> TopOut {
        let cells = m.array("u_cell", 3, &Cell, |row| CellIn { x: row.y.previous(i.x) });
        let count = m.reg("count", 8);
        count.next(count + 1);
        def!(fits = count.lt(100));
        m.assert(fits, "the count stays small");
        m.assert(select([(i.go, i.x.ne(7)), (i.x.bit(0), i.x.ne(9))], lit(1, 1)), "no choice fails");
        m.assert(!cells.y.lane(2).eq(99), "the last lane is never 99");
        m.assert(lit(8, 1).lt(2), "what always holds is not printed");
        let slow = m.on(SLOW);
        let seen = slow.reg("seen", 8);
        seen.next(count.quasi_static("the test looks at what a race would spoil"));
        slow.assert(seen.ne(50), "the slow clock never sees 50");
        TopOut { y: cells.y.xor_all(), count: *count, seen: *seen }
    }
}

fn printed() -> (Design, Vec<VerilogFile>) {
    let design = elaborate(&Asserted).unwrap_or_else(|problems| panic!("{problems}"));
    let files = verilog(&design);
    (design, files)
}

/// Ten edges of the first clock, seven of the second, and the outputs for `x` at each of them; the reset of both is
/// high until the given time.
fn recording(x: [u64; 10], reset_until_ns: u64) -> Recording {
    let (mut lanes, mut count, mut seen) = ([0u64; 3], 0u64, 0u64);
    let mut steps = Vec::new();
    for ns in (1..=100u64).filter(|ns| ns.is_multiple_of(10) || ns.is_multiple_of(14)) {
        let rising: Vec<usize> =
            [10, 14].iter().enumerate().filter(|it| ns.is_multiple_of(*it.1)).map(|it| it.0).collect();
        let x = x[((ns - 1) / 10) as usize];
        steps.push(Step {
            time_ps: 1000 * ns,
            rising: rising.clone(),
            resets: if ns <= reset_until_ns { vec![0, 1] } else { vec![] },
            inputs: vec![Bits::new(8, x), Bits::new(1, 0)],
            outputs: [lanes[0] ^ lanes[1] ^ lanes[2], count, seen].map(|value| Bits::new(8, value)).to_vec(),
        });
        let before = count;
        if rising.contains(&0) {
            (lanes, count) = ([x, lanes[0], lanes[1]], count + 1);
        }
        if rising.contains(&1) {
            seen = before;
        }
    }
    Recording { steps, initial: Vec::new() }
}

fn replayed(files: &[VerilogFile], bench: &VerilogFile) -> Vec<(&'static str, Result<Checked, Problems>)> {
    vec![("icarus", tools::replay_in_icarus(files, bench)), ("verilator", tools::replay_in_verilator(files, bench))]
}

/// Every installed simulator prints this.
fn fails(files: &[VerilogFile], bench: &VerilogFile, what: &[&str]) {
    for (tool, result) in replayed(files, bench) {
        match result {
            Ok(checked) => assert_eq!(checked, Checked::Skipped, "{tool} does not hear the assertion"),
            Err(problems) => {
                let text = problems.to_string();
                assert!(what.iter().all(|part| text.contains(part)) && !text.contains("PASS: "), "{tool}: {text}");
            }
        }
    }
}

#[test]
fn linters_accept_them_and_the_text_says_them() {
    let (_, files) = printed();
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{}", files[1].text));
    let (cell, top) = (&files[0].text, &files[1].text);
    assert!(cell.contains("if (!rst && !(held < 8'd200)) begin"), "{cell}");
    assert!(
        cell.contains(r#"$display("FAIL: time %0t: %m: 100%% of \"x\"\nstay \\below\\ 200, \303\251", $time);"#),
        "{cell}"
    );
    assert!(top.contains("if (!slow_rst && !(seen != 8'd50)) begin"), "{top}");
    assert!(!top.contains("always holds"), "{top}");
    assert!(
        cell.contains("`ifdef FORMAL\n    always @(posedge clk) begin\n        if (!rst) assert (held < 8'd200);"),
        "{cell}"
    );
}

#[test]
fn a_run_in_which_they_hold_passes() {
    let (design, files) = printed();
    let bench = testbench(&design, &recording([1, 2, 3, 4, 5, 6, 77, 8, 19, 10], 0));
    for (tool, result) in replayed(&files, &bench) {
        let _ = result.unwrap_or_else(|problems| panic!("{tool}: {problems}"));
    }
}

#[test]
fn one_that_fails_in_a_lane_is_reported_with_lane_time_and_message() {
    let (design, files) = printed();
    // At 50 ns lane 0 has taken it, at 60 ns lane 1: lane 0 is checked at the edge at 60 ns.
    let bench = testbench(&design, &recording([1, 2, 3, 4, 200, 6, 7, 8, 9, 10], 0));
    fails(
        &files,
        &bench,
        &["FAIL: time 60000: ", "asserted_tb.dut.u_cell[0].lane: 100% of \"x\"\nstay \\below\\ 200, é"],
    );
}

#[test]
fn one_that_fails_on_another_clock_or_at_the_last_edge_is_reported() {
    let (design, files) = printed();
    let slow = |text: &str| text.replace("8'd50", "8'd1");
    let edited: Vec<_> = files.iter().map(|file| VerilogFile { text: slow(&file.text), ..file.clone() }).collect();
    let bench = testbench(&design, &recording([1, 2, 3, 4, 5, 6, 7, 8, 19, 10], 0));
    fails(&edited, &bench, &["FAIL: time 28000: ", "asserted_tb.dut: the slow clock never sees 50"]);
    let last = |text: &str| text.replace("wire fits = count < 8'd100;", "wire fits = count < 8'd9;");
    let edited: Vec<_> = files.iter().map(|file| VerilogFile { text: last(&file.text), ..file.clone() }).collect();
    assert_ne!(edited, files);
    fails(&edited, &bench, &["FAIL: time 100000: ", "asserted_tb.dut: the count stays small"]);
}

/// With a terminal, without one, and where no input is possible.
#[test]
fn one_that_fails_ends_icarus_with_a_status() {
    let (design, files) = printed();
    let held = recording([1, 2, 3, 4, 5, 6, 77, 8, 19, 10], 0);
    let mut mismatched = held.clone();
    mismatched.steps[3].outputs[1] = Bits::new(8, 77);
    let benches = [(held, Some(0)), (recording([1, 2, 3, 4, 200, 6, 7, 8, 9, 10], 0), Some(1)), (mismatched, Some(1))];
    for (recording, status) in benches {
        let folder = tempfile::tempdir().unwrap();
        let bench = testbench(&design, &recording);
        let names: Vec<&str> = files.iter().chain([&bench]).map(|file| file.name.as_str()).collect();
        for file in files.iter().chain([&bench]) {
            std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
        }
        if tools::skipped_without(&["iverilog", "vvp"]).is_some() {
            return;
        }
        let run = |program: &str, arguments: &[&str]| {
            let mut command = Command::new(program);
            command.args(arguments).current_dir(folder.path()).stdin(std::process::Stdio::null());
            command.output().unwrap()
        };
        let compiled = run("iverilog", &[&["-g2005", "-o", "bench.vvp"], &names[..]].concat());
        assert!(compiled.status.success(), "{compiled:?}");
        for options in [&["bench.vvp"][..], &["-n", "bench.vvp"], &["-N", "bench.vvp"]] {
            let ended = run("vvp", options);
            assert_eq!(ended.status.code(), status, "{options:?}: {ended:?}");
        }
    }
}

#[test]
fn none_is_looked_at_while_the_reset_is_high() {
    let (design, files) = printed();
    let bench = testbench(&design, &recording([1, 200, 3, 4, 5, 6, 7, 8, 19, 10], 60));
    for (tool, result) in replayed(&files, &bench) {
        let _ = result.unwrap_or_else(|problems| panic!("{tool}: {problems}"));
    }
}

/// Yosys finds one statement for each assertion when it reads for a formal tool, and none when it reads for synthesis.
#[test]
fn a_formal_tool_finds_them() {
    let (_, files) = printed();
    if tools::skipped_without(&["yosys"]).is_some() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let mut names = Vec::new();
    for file in &files {
        std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
        names.push(file.name.as_str());
    }
    let count = |read: &str, count: u32| {
        let script = format!(
            "{read} {}; hierarchy -check -top asserted; proc; select -assert-count {count} t:$assert",
            names.join(" ")
        );
        let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder.path()).output().unwrap();
        let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert!(output.status.success() && !text.contains("Warning"), "{text}");
    };
    count("read_verilog -formal", 5);
    count("read_verilog", 0);
}
