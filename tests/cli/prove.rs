//! `prove`.

#[cfg(unix)]
use super::synth::{stub_path, with_programs};
use crate::cli::harness::Folder;
#[cfg(unix)]
use crate::cli::harness::Run;
use tilewright_gen::tools::skipped_without;

fn lacks_tools() -> bool {
    skipped_without(&["yosys", "z3"]).is_some()
}

#[test]
fn a_block_is_proved_and_a_run_reaches_its_covers() {
    if lacks_tools() {
        return;
    }
    let folder = Folder::new();
    let table = folder.stdout("prove fifo");
    for part in ["1  assert  proved, k = 0", "3  cover   reached in clock 3", "blocks/src/fifo.rs:"] {
        assert!(table.contains(part), "{part}\n{table}");
    }
    let report = folder.json("prove fifo --json");
    let run = &report["statements"][2]["run"];
    assert_eq!((&report["statements"][1]["result"], &run["clock"]), (&"proved".into(), &3.into()), "{report}");
    assert_eq!(run["inputs"]["into_valid"].as_array().unwrap().len(), 4, "{report}");
}

#[test]
fn a_run_is_shown_as_text_and_as_a_waveform() {
    if lacks_tools() {
        return;
    }
    let folder = Folder::new();
    let text = folder.stdout("prove fifo --show 3 --ascii -o run.vcd");
    assert!(text.contains("into_valid") && text.contains("clk"), "{text}");
    assert!(folder.read("run.vcd").contains("$enddefinitions"));
    let wrong = folder.run("prove fifo --show 17");
    assert_eq!((wrong.code, wrong.stderr.contains("from 1 to 16")), (Some(2), true), "{wrong:?}");
}

#[test]
fn what_is_open_has_an_exit_code_of_its_own() {
    if lacks_tools() {
        return;
    }
    let run = Folder::new().run("prove fifo --depth 2");
    assert!(run.code == Some(5) && run.stdout.contains("not reached in 2 clocks"), "{run:?}");
}

#[test]
#[cfg(unix)]
fn the_time_is_over_also_while_yosys_works_and_the_sentence_says_so() {
    let folder = with_programs(&[("yosys", "exec sleep 60")]);
    let mut command = folder.command("prove fifo --seconds 1");
    let run = Run::of(command.env("PATH", stub_path(&folder)).output().unwrap());
    let said =
        "the time was over while Yosys made formulas of the block: give more --seconds, or --set smaller parameters";
    assert!(run.code == Some(5) && run.stdout.contains(said), "{run:?}");
    assert!(run.stdout.contains("3  cover   not searched"), "{run:?}");
}

#[test]
fn what_cannot_be_proved_is_refused_with_a_remedy() {
    for (command, sentence) in [
        ("prove ticks", "`ticks_every3` states nothing to prove: add m.assert(..) or m.cover(..)"),
        ("prove ticks --harness", "no harness is around ticks: leave out --harness to prove what stands in it"),
        (
            "prove counter --set limit=7",
            "states nothing itself, and harnesses have sizes of their own: leave out --set",
        ),
    ] {
        let run = Folder::new().run(command);
        assert!(run.code == Some(2) && run.stderr.contains(sentence), "{run:?}");
    }
}

#[test]
fn a_block_that_states_nothing_has_its_harness_proved() {
    if lacks_tools() {
        return;
    }
    let folder = Folder::new();
    let text = folder.stdout("prove merging-unit");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines.len(), lines[0]), (3, "a harness around VC-1: merging unit, 48 bits"), "{text}");
    let part = "1  assert  proved, k = 4  four clocks later the lesser word comes out";
    assert!(lines[1].starts_with(part) && lines[1].contains("prove/claims/src/machines.rs:"), "{text}");
    let report = folder.json("prove encoder --json");
    let statements = report["statements"].as_array().unwrap();
    let is_of = |row: &serde_json::Value| row["harness"] == "encoder, decoder, priority encoder, 5 lines";
    assert!(!statements.is_empty() && statements.iter().all(is_of), "{report}");
}

#[test]
fn harnesses_are_proved_beside_what_stands_in_a_block_or_alone() {
    if lacks_tools() {
        return;
    }
    let folder = Folder::new();
    let both = folder.stdout("prove lifo");
    let lines: Vec<&str> = both.lines().collect();
    assert!(lines[0].starts_with("1  assert  proved, k = 1  a word that is shown is not withdrawn"), "{both}");
    assert_eq!((lines.len(), lines[1]), (3, "a harness around stack, 3 words"), "{both}");
    assert!(lines[2].starts_with("2  assert  proved, invariant  "), "{both}");
    let text = folder.stdout("prove skid-buffer --harness");
    assert!(text.starts_with("a harness around skid buffer\n1  assert  proved, invariant  "), "{text}");
    let set = folder.run("prove lifo --set depth=5");
    let said = "harnesses around lifo claim more, at sizes of their own: without --set";
    assert!(set.stderr.contains(said) && set.stdout.lines().count() == 1, "{set:?}");
}

#[test]
fn times_are_told_where_a_block_has_several_clocks() {
    if lacks_tools() {
        return;
    }
    let run = Folder::new().run("prove lfb-swap --depth 3 --json");
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    let statement = |number: usize| &report["statements"][number - 1];
    assert_eq!((run.code, &statement(1)["needs_periods"]), (Some(5), &false.into()), "{report}");
    assert_eq!(
        (&statement(6)["result"], &statement(6)["run"]["time_ps"]),
        (&"reached".into(), &75_000.into()),
        "{report}"
    );
}

#[test]
fn a_missing_program_is_named_with_its_remedy_and_nothing_is_written() {
    let folder = Folder::new();
    let run = folder.command("prove fifo -o run.vcd").env("PATH", folder.path("nowhere")).output().unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.code() == Some(4) && said.contains("yosys is not installed: install it"), "{run:?}");
    assert!(!folder.path("run.vcd").exists());
}
