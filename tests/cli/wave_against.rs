//! `wave --against`.

use crate::cli::harness::{Folder, Run};
use tilewright_gen::tools::skipped_without;

const ICARUS: &[&str] = &["iverilog", "vvp"];
const VERILATOR: &[&str] = &["verilator", "perl", "make", "g++"];

/// A folder with the Verilog of a block in `out`, in which a part of a file is another one in `edited.v`.
fn edited(block: &str, file: &str, part: &str, other: &str) -> Folder {
    let folder = Folder::new();
    folder.stdout(&format!("verilog {block} -o out"));
    let text = folder.read(format!("out/{file}"));
    assert_eq!(text.matches(part).count(), 1, "{text}");
    std::fs::write(folder.path("edited.v"), text.replace(part, other)).unwrap();
    folder
}

fn assert_no_difference(run: &Run) {
    assert!(run.code == Some(0) && run.stderr.is_empty(), "{run:?}");
    let last = run.stdout.lines().last().unwrap();
    assert!(last.starts_with("no difference in ") && last.ends_with(" clocks"), "{run:?}");
}

#[test]
fn engines_agree_signal_by_signal() {
    let folder = Folder::new();
    for block in ["fifo", "merging-unit", "patch-table"] {
        for other in ["interpreter", "reference"] {
            assert_no_difference(&folder.run(&format!("wave {block} --against {other}")));
        }
    }
    let run = folder.run("wave fifo --engine reference --against interpreter");
    assert_eq!(run.stdout, "no difference in 14 signals, 3 words of memories and 13 clocks\n", "{run:?}");
    assert_eq!(folder.names(), [""; 0], "nothing is left behind");
}

#[test]
fn the_printed_verilog_agrees_in_both_simulators() {
    let folder = Folder::new();
    if skipped_without(ICARUS).is_none() {
        // Instances and lanes in rows, and two clocks.
        for block in ["fifo", "image-merger --set units=3", "patch-table", "gfb-unit --set width=16 --set height=8"] {
            let run = folder.run(&format!("wave {block} --against icarus"));
            assert_no_difference(&run);
            assert!(!run.stdout.contains("only in "), "{block}: {run:?}");
        }
    }
    if skipped_without(VERILATOR).is_none() {
        assert_no_difference(&folder.run("wave image-merger --set units=3 --against verilator"));
    }
}

#[test]
fn words_of_memories_are_compared_as_far_as_there_is_room() {
    let folder = Folder::new();
    // In the Verilog, the lanes of these words stand side by side.
    let all = "no difference in 158 signals, 3072 words of memories and 450 clocks\n";
    let some = "not compared: words of the memory u_store.bits, as the limit is 4096 words\n\
        no difference in 1049 signals, 3363 words of memories and 509 clocks\n";
    let mut lines =
        vec![("backing-store --against reference", all), ("quadratic-renderer --against interpreter", some)];
    if skipped_without(ICARUS).is_none() {
        lines.push(("backing-store --against icarus", all));
    }
    if skipped_without(VERILATOR).is_none() {
        lines.push(("backing-store --against verilator", all));
    }
    for (line, shown) in lines {
        assert_eq!(folder.stdout(&format!("wave {line}")), shown, "{line}");
    }
    let report = folder.json("wave quadratic-renderer --against interpreter --json");
    assert_eq!((&report["signals"], &report["words"]), (&1049.into(), &3363.into()));
    assert_eq!(
        (&report["left_out"], &report["lacking"]),
        (&serde_json::json!(["u_store.bits"]), &serde_json::json!([]))
    );
}

/// Both blocks read words that are written at the same edge, and do not use what they get.
#[test]
fn reads_that_may_give_any_value_are_compared_between_engines_alone() {
    let folder = Folder::new();
    let lines = |block: &str, other: &str| folder.stdout(&format!("wave {block} --against {other}"));
    for (block, read) in [("multiply-accumulate", "held"), ("video-buffer", "bank0_read, bank1_read")] {
        assert!(!lines(block, "reference").contains("not compared"), "{block}");
        if skipped_without(ICARUS).is_none() {
            let text = lines(block, "icarus");
            let reason = "as a read of a word that is written at the same edge may give any value";
            assert_eq!(text.lines().next(), Some(format!("not compared: {read}, {reason}").as_str()), "{block}");
            assert!(text.contains("\nno difference in "), "{text}");
        }
    }
}

#[test]
fn a_mistake_in_the_verilog_is_found_where_it_begins() {
    if skipped_without(ICARUS).is_some() {
        return;
    }
    let right = "decided1 <= right[47:36] != left[47:36];";
    let folder = edited("merging-unit", "merging_unit.v", right, &right.replace("!=", "=="));
    let line = "wave merging-unit --against icarus --verilog edited.v";
    let run = folder.run(line);
    assert_eq!((run.code, run.stderr.as_str()), (Some(1), ""), "{run:?}");
    assert!(
        run.stdout.starts_with("the first difference is in cycle 2, at 160000 ps, in 1 of 16 signals:\n"),
        "{run:?}"
    );
    assert!(
        include_str!("../../docs/cli.md").contains(&run.stdout),
        "docs/cli.md shows another answer:\n{}",
        run.stdout
    );
    let run = folder.run(&format!("{line} --json"));
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    let difference = &report["difference"];
    assert_eq!((run.code, &difference["cycle"], &difference["picoseconds"]), (Some(1), &2.into(), &160_000.into()));
    assert_eq!(difference["signals"], serde_json::json!([{ "name": "decided1", "values": ["0", "1"] }]));
    assert_eq!((&difference["cause"]["name"], &difference["uncompared"]), (&"decided1".into(), &serde_json::json!([])));
}

#[test]
fn a_mistake_behind_others_is_found_at_its_first_signal() {
    if skipped_without(ICARUS).is_some() {
        return;
    }
    // A net, and all that follows from it in the same clock.
    let right = "assign into_ready = used != 2'd3;";
    let folder = edited("fifo", "fifo_depth3_width8_storage_registers.v", right, "assign into_ready = used != 2'd2;");
    let run = folder.run("wave fifo --against icarus --verilog edited.v");
    assert!(run.code == Some(1) && run.stdout.contains("\ninto_ready = 1  cycle 3  "), "{run:?}");
    let last = "the difference begins at into_ready: what its value comes from is the same in both\n";
    assert!(run.stdout.contains("  (0 in icarus)\n") && run.stdout.ends_with(last), "{run:?}");
}

#[test]
fn a_mistake_in_a_write_is_found_at_the_word_when_it_is_written() {
    if skipped_without(ICARUS).is_some() {
        return;
    }
    // The word is read three clocks later.
    let right = "if (into_taken) words[free] <= into_payload;";
    let wrong = right.replace("into_payload", "into_payload | 8'd1");
    let folder = edited("fifo", "fifo_depth3_width8_storage_registers.v", right, &wrong);
    let run = folder.run("wave fifo --against icarus --verilog edited.v");
    let shown = "in cycle 3, at 30000 ps, in 1 of 14 signals and 3 words of memories:\n  words[1]: 2 in tilewright, 3 in icarus\n";
    assert!(run.code == Some(1) && run.stdout.contains(shown), "{run:?}");
    assert!(
        run.stdout.contains("\nwords[1] = 2  cycle 3  (3 in icarus)\n  from into_payload = 2  cycle 2  "),
        "{run:?}"
    );
    let last = "the difference begins at words[1]: what its value comes from is the same in both\n";
    assert!(run.stdout.ends_with(last), "{run:?}");
    // A word that is read as soon as it is written comes before what reads it.
    let wrong = right.replace("into_payload", "into_payload | 8'd2");
    let folder = edited("fifo", "fifo_depth3_width8_storage_registers.v", right, &wrong);
    let run = folder.run("wave fifo --against icarus --verilog edited.v");
    let shown = "in cycle 2, at 20000 ps, in 2 of 14 signals and 3 words of memories:\n  words[0]: 1 in tilewright, 3 in icarus\n";
    assert!(run.code == Some(1) && run.stdout.contains(shown), "{run:?}");
}

#[test]
fn a_file_without_a_memory_is_compared_in_all_else() {
    if skipped_without(ICARUS).is_some() {
        return;
    }
    let folder = Folder::new();
    folder.stdout("verilog image-generation-controller -o out");
    let files = folder.files("out").into_iter();
    let (_, text) = { files }.find(|(name, _)| name.starts_with("image_generation_controller")).unwrap();
    let text = String::from_utf8(text).unwrap().replace(" microcode[", " other[").replace(" microcode [", " other [");
    std::fs::write(folder.path("edited.v"), text).unwrap();
    let run = folder.run("wave image-generation-controller --against icarus --verilog edited.v");
    assert_no_difference(&run);
    assert!(run.stdout.contains("only in tilewright: words of the memory microcode\n"), "{run:?}");
    assert!(!run.stdout.contains("words of memories"), "{run:?}");
}

#[test]
fn a_wave_of_before_an_edit_is_compared_with_the_run_after_it() {
    let folder = Folder::new();
    folder.stdout("wave fifo -o before.vcd");
    folder.stdout("wave fifo -o before.fst");
    folder.stdout("wave fifo -o words.vcd --memory words");
    folder.stdout("wave fifo -o words.fst --memory words[0..2]");
    let lacks = "only in tilewright: words of the memory words\n";
    for (file, lacks, words) in [
        ("before.vcd", lacks, ""),
        ("before.fst", lacks, ""),
        ("words.vcd", "", ", 3 words of memories"),
        ("words.fst", lacks, ", 2 words of memories"),
    ] {
        let shown = format!("{lacks}no difference in 14 signals{words} and 13 clocks\n");
        assert_eq!(folder.stdout(&format!("wave fifo --against {file}")), shown, "{file}");
    }
    // An edited file stands for a design that was edited.
    let text = folder.read("before.vcd");
    let line = text.lines().find(|line| line.contains(" used [")).unwrap();
    let id = line.split_whitespace().nth(3).unwrap();
    let odd = text.replacen(&format!("b11 {id}\n"), &format!("b01 {id}\n"), 1);
    assert_ne!(odd, text);
    std::fs::write(folder.path("odd.vcd"), odd).unwrap();
    let run = folder.run("wave fifo --against odd.vcd");
    assert_eq!((run.code, run.stderr.as_str()), (Some(1), ""), "{run:?}");
    let shown = "\nthe first difference is in cycle 4, at 40000 ps, in 1 of 14 signals:\n  used: 3 in tilewright, 1 in odd.vcd\n";
    assert!(run.stdout.contains(shown) && run.stdout.contains("\nused = 3  cycle 4  "), "{run:?}");
    // What is read of a word that is not in the file.
    let line = text.lines().find(|line| line.contains(" out_payload [")).unwrap();
    let id = line.split_whitespace().nth(3).unwrap();
    std::fs::write(folder.path("odd.vcd"), text.replacen(&format!("b10 {id}\n"), &format!("b110 {id}\n"), 1)).unwrap();
    let run = folder.run("wave fifo --against odd.vcd");
    let last = "the difference begins at out_payload, or before it at what was not compared: words[1]\n";
    assert!(run.code == Some(1) && run.stdout.ends_with(last), "{run:?}");
    // A shorter queue is full where the longer one is not.
    let run = folder.run("wave fifo --set depth=2 --against before.vcd");
    assert!(run.code == Some(1) && run.stdout.contains("into_ready: 0 in tilewright, 1 in before.vcd"), "{run:?}");
}

#[test]
fn what_cannot_be_compared_is_said_with_a_remedy() {
    let folder = Folder::with(&[
        ("no.vcd", "nothing"),
        ("other.v", "module other;\nendmodule\n"),
        ("broken.v", "module merging_unit (\n    input wire clk;\nendmodule\n"),
    ]);
    folder.stdout("wave fifo -o fifo.vcd");
    folder.stdout("wave fifo --from 20us -o late.vcd");
    for (line, code, sentence) in [
        ("wave --against icarus", 2, "<BLOCK"),
        ("wave fifo --against", 2, "a value is required for '--against <WHAT>'"),
        ("wave fifo --against icarsu", 2, "there is no file `icarsu`: did you mean `icarus`?"),
        (
            "wave fifo --against none.vcd",
            2,
            "name one of icarus, verilator, verilog, interpreter, reference, or a VCD or an FST file",
        ),
        ("wave fifo --against no.vcd", 2, "error: no.vcd: it is no sound waveform ("),
        ("wave fifo --against icarus -o x.vcd", 2, "cannot be used with"),
        ("wave fifo --verilog broken.v", 2, "--against"),
        ("wave fifo --against reference --verilog broken.v", 2, "--verilog is for a simulator of Verilog"),
        ("wave fifo --against icarus --verilog none.v", 2, "error: none.v: it cannot be read ("),
        ("wave merging-unit --against fifo.vcd", 2, "have no signal in common"),
    ] {
        let run = folder.run(line);
        assert!(run.code == Some(code) && run.stdout.is_empty() && run.stderr.contains(sentence), "{line}: {run:?}");
    }
    // Without anything on the search path.
    for (other, program) in [("icarus", "iverilog"), ("verilator", "verilator"), ("verilog", "iverilog")] {
        let output = folder.command(&format!("wave fifo --against {other}")).env("PATH", folder.path("")).output();
        let run = Run::of(output.unwrap());
        let sentence = format!("error: {program} is not installed: install it (Debian: apt-get install {program})\n");
        assert_eq!((run.code, run.stdout.as_str(), run.stderr), (Some(4), "", sentence));
    }
    if skipped_without(ICARUS).is_none() {
        let run = folder.run("wave merging-unit --against icarus --verilog other.v");
        assert!(
            run.code == Some(2) && run.stderr.contains("it has no module of the block: name a file with one of "),
            "{run:?}"
        );
        let run = folder.run("wave merging-unit --against icarus --verilog broken.v");
        let said = "error: icarus refuses the Verilog: broken.v:";
        assert!(run.code == Some(2) && run.stderr.contains(said) && run.stderr.lines().count() == 1, "{run:?}");
    }
}
