//! Assumptions, covers, past values, power-on values and attributes reach every tool that reads the Verilog.

use std::process::Command;
use tilewright_gen::tools::{self, Checked};
use tilewright_gen::{VerilogFile, testbench, verilog};
use tilewright_hdl::recording::Step;
use tilewright_hdl::*;

block! {
    /// Counts what it is given, and looks back.
    pub struct Looking;
    in LookingIn {
        /// It counts.
        count: bit(),
        /// Numbers.
        x: bits(8).of(row(3)),
    }
    out LookingOut {
        /// What was counted, and nine.
        counted: bits(4),
        /// All numbers before.
        all: bits(8),
    }
}

impl Looking {
    fn build(&self, m: Module, i: LookingIn) -> LookingOut {
        let counted = m.reg("counted", 4).initial(9).attribute("keep", "true");
        counted.when(i.count, counted + 1);
        let words = m.memory("words", 16, 8, ReadUnderWrite::Old).attribute("ram_style", "\"block\"").fill(1);
        words.write(i.count, *counted, lit(8, 7));
        let held = m.reg("held", bits(8).of(row(3))).initial(7);
        held.next(i.x);
        m.assume(!mux(i.count, i.x.lane(0).eq(99), i.x.lane(1).eq(99)), "nobody says 99");
        m.assert(m.past(i.count).implies(counted.eq(m.past(*counted) + 1)), "it counts");
        m.assert(m.stable(i.x) | m.past(m.past(i.x)).ne(50), "after 50, it stays for two clocks");
        m.cover("12 is counted", counted.eq(12));
        m.cover("a lane is 5", i.x.eq(5));
        m.cover("it counts again", m.rose(i.count));
        m.cover("always", lit(1, 1));
        LookingOut { counted: *counted, all: held.xor_all() ^ words.read(*counted) }
    }
}

codes! { enum Way { Left, Right, Both } }

block! {
    /// Takes codes that it names nowhere but in what it states.
    pub struct Stated;
    in StatedIn {
        /// A way.
        way: one_of::<Way>(),
    }
    out StatedOut {
        /// It is no way.
        none: bit(),
    }
}

impl Stated {
    fn build(&self, m: Module, i: StatedIn) -> StatedOut {
        m.assume(i.way.is_code(), "a way is given");
        m.cover("right", i.way.is(Way::Right));
        StatedOut { none: i.way.bits().eq(3) }
    }
}

#[test]
fn a_code_that_only_a_statement_names_is_declared() {
    let files = verilog(&elaborate(&Stated).unwrap());
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{}", files[0].text));
    for part in
        ["assume (way <= WAY_BOTH);", "    localparam [1:0] WAY_BOTH  = 2'd2;", "    // Not used here: WAY_LEFT = 0."]
    {
        assert!(files[0].text.contains(part), "{}", files[0].text);
    }
}

block! {
    /// States something of registers, of which it reads one elsewhere, too.
    pub struct Apart;
    in ApartIn {
        /// Looked at by statements.
        x: bit(),
        /// Of its past there is a net.
        y: bit(),
    }
    out ApartOut {
        /// Not `y`.
        z: bit(),
    }
}

impl Apart {
    fn build(&self, m: Module, i: ApartIn) -> ApartOut {
        let held = m.reg("held", 1).reset(0);
        held.next(i.x);
        m.assert(m.past(i.x).eq(held), "it is held");
        def!(late = m.past(i.y) & !i.y);
        m.cover("y was high", late);
        let counts = m.reg("counts", 8).reset(0);
        counts.next(cat![i.x.repeat(5), i.y.repeat(3)]);
        m.cover("bit 2", counts.bit(2));
        ApartOut { z: !i.y }
    }
}

#[test]
fn a_synthesizer_does_not_see_registers_that_only_statements_look_at() {
    let files = verilog(&elaborate(&Apart).unwrap());
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{}", files[0].text));
    let (seen, stated) = files[0].text.split_once("`ifndef SYNTHESIS").unwrap();
    for register in ["reg held;", "reg [7:0] counts;", "reg x_past;", "reg has_past;"] {
        assert!(!seen.contains(register) && stated.contains(register), "{register}\n{}", files[0].text);
    }
    assert!(seen.contains("reg y_past;") && seen.contains("wire late = y_past"), "{}", files[0].text);
    assert!(!stated.contains("held["), "what is not there is not tied\n{}", files[0].text);
    assert!(stated.contains("_unused_stated = &{1'b0, counts[7:3], counts[1:0]};"), "{}", files[0].text);
}

/// The Verilog, and the testbench with this stimulus and the expected outputs.
fn run(stimulus: &[(u64, [u64; 3])]) -> (Vec<VerilogFile>, VerilogFile) {
    let design = elaborate(&Looking).unwrap();
    let (mut counted, mut held, mut words, mut word) = (9, [7; 3], [1; 16], 0);
    let mut steps = Vec::new();
    for ((count, x), cycle) in stimulus.iter().zip(1..) {
        let all = held.iter().fold(word, |all, held| all ^ held);
        steps.push(Step {
            time_ps: 10_000 * cycle,
            rising: vec![0],
            resets: vec![],
            inputs: vec![Bits::new(1, *count), Bits::new(24, x[0] | x[1] << 8 | x[2] << 16)],
            outputs: vec![Bits::new(4, counted), Bits::new(8, all)],
        });
        (held, word) = (*x, words[counted as usize]);
        if *count == 1 {
            words[counted as usize] = 7;
            counted = (counted + 1) % 16;
        }
    }
    (verilog(&design), testbench(&design, &Recording { steps, initial: Vec::new() }))
}

const GOOD: [(u64, [u64; 3]); 6] =
    [(1, [1, 5, 3]), (0, [1, 2, 3]), (1, [5, 2, 5]), (1, [5, 2, 6]), (1, [5, 2, 6]), (0, [0, 0, 0])];

#[test]
fn linters_accept_them_and_the_text_says_them() {
    let files = verilog(&elaborate(&Looking).unwrap());
    tools::lint(&files).unwrap_or_else(|problems| panic!("{problems}\n{}", files[0].text));
    let text = &files[0].text;
    for part in [
        "(* keep = \"true\" *) output reg  [3:0]  counted,",
        "(* ram_style = \"\\\"block\\\"\" *)\n    reg [7:0] words [0:15];",
        "initial counted = 4'd9;",
        "initial held = 8'd7;",
        "if (!rst) assume (!(count ? (x[7:0] == 8'd99) : (x[15:8] == 8'd99)));",
        "if (!rst && (count ? (x[7:0] == 8'd99) : (x[15:8] == 8'd99))) begin",
        "if (!rst) assert (!has_past | asserted_or);",
        "if (!rst) cover (counted == 4'd12);",
        "$display(\"COVER: time %0t: %m: 12 is counted\", $time);",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

#[test]
fn a_run_in_which_they_hold_passes() {
    let (files, bench) = run(&GOOD);
    for (tool, result) in
        [("icarus", tools::replay_in_icarus(&files, &bench)), ("verilator", tools::replay_in_verilator(&files, &bench))]
    {
        let _ = result.unwrap_or_else(|problems| panic!("{tool}: {problems}"));
    }
}

/// In simulations of other people, covers print nothing.
#[test]
fn covers_are_printed_where_that_is_asked_for() {
    if tools::skipped_without(&["iverilog", "vvp"]).is_some() {
        return;
    }
    let (files, bench) = run(&GOOD);
    let folder = tempfile::tempdir().unwrap();
    for file in files.iter().chain([&bench]) {
        std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
    }
    for (option, count) in [("-DTILEWRIGHT_COVERS", 4), ("-DOTHER", 0)] {
        let mut compile = Command::new("iverilog");
        compile.args(["-g2005", option, "-o", "bench.vvp", &bench.name, &files[0].name]).current_dir(folder.path());
        assert!(compile.status().unwrap().success());
        let output = Command::new("vvp").args(["-n", "bench.vvp"]).current_dir(folder.path()).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let names: std::collections::BTreeSet<&str> = text
            .lines()
            .filter(|line| line.starts_with("COVER: "))
            .filter_map(|line| line.rsplit_once(": ").map(|(_, name)| name))
            .collect();
        assert!(names.len() <= count && names.is_empty() == (count == 0), "{option}: {text}");
    }
}

#[test]
fn a_simulator_stops_where_an_assumption_or_a_past_fails() {
    let early = |x: [u64; 3]| [vec![(1, x), (0, x)], vec![(0, [1, 1, 1]); 2]].concat();
    for (stimulus, says) in [
        (vec![(1, [99, 0, 0])], "looking_tb.dut: the stimulus breaks an assumption: nobody says 99"),
        (early([50, 1, 1]), "after 50, it stays for two clocks"),
    ] {
        let (files, bench) = run(&stimulus);
        for (tool, result) in [
            ("icarus", tools::replay_in_icarus(&files, &bench)),
            ("verilator", tools::replay_in_verilator(&files, &bench)),
        ] {
            match result {
                Ok(checked) => assert_eq!(checked, Checked::Skipped, "{tool} hears nothing of: {says}"),
                Err(problems) => assert!(problems.to_string().contains(says), "{tool}: {problems}"),
            }
        }
    }
}

/// Yosys finds one statement of each kind for each lane when it reads for a formal tool, and none when it reads for synthesis.
#[test]
fn a_formal_tool_finds_them() {
    let files = verilog(&elaborate(&Looking).unwrap());
    if tools::skipped_without(&["yosys"]).is_some() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(&files[0].name), &files[0].text).unwrap();
    for (read, counts) in [("read_verilog -formal", [1, 4, 6]), ("read_verilog", [0, 0, 0])] {
        let selects: Vec<String> = (["$assume", "$assert", "$cover"].iter().zip(counts))
            .map(|(kind, count)| format!("select -assert-count {count} t:{kind}"))
            .collect();
        let script = format!("{read} {}; hierarchy -check -top looking; proc; {}", files[0].name, selects.join("; "));
        let output = Command::new("yosys").args(["-q", "-p", &script]).current_dir(folder.path()).output().unwrap();
        let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert!(output.status.success() && !text.contains("Warning"), "{text}");
    }
}
