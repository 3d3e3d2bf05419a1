//! `verilog --equal-to`.

use crate::cli::harness::{Folder, Run};
use tilewright_gen::tools::skipped_without;

const COUNTER: &str = include_str!("../../docs/guide/hand/counter.v");

fn lacks_tools() -> bool {
    skipped_without(&["yosys", "yosys-abc"]).is_some()
}

/// A folder with the counter, in which `from` is `to`.
fn with(from: &str, to: &str) -> Folder {
    let text = COUNTER.replacen(from, to, 1);
    assert_ne!(text, COUNTER, "{from}");
    Folder::with(&[("hand.v", &text)])
}

#[test]
fn a_module_is_proved_equal_with_its_parameters() {
    if lacks_tools() {
        return;
    }
    let folder = Folder::with(&[("hand.v", COUNTER)]);
    let line = "verilog counter --set limit=6 --equal-to hand.v --module counter -P LIMIT=6";
    assert_eq!(folder.stdout(line), "hand.v is equal to counter_limit6, for all inputs\n");
    assert_eq!(folder.names(), ["hand.v"]);
    let report = folder.json(&format!("{line} --json"));
    let expected = serde_json::json!({
        "format": 1, "block": "counter", "parameters": { "limit": 6 }, "result": "equal", "clocks": null, "run": null
    });
    assert_eq!(report, expected);
}

#[test]
fn a_difference_is_a_wave_of_both_and_a_failed_check() {
    if lacks_tools() {
        return;
    }
    let folder = with("rst || restart || wraps", "rst || restart || count == LIMIT - 1");
    let run = folder.run("verilog counter --equal-to hand.v");
    assert_eq!((run.code, run.stderr.as_str()), (Some(1), ""), "{run:?}");
    let heading = "`count` of counter in hand.v differs from counter_limit5 in clock 6, after a reset in clock 0:\n\n";
    let row = "\ncount of counter";
    assert!(run.stdout.starts_with(heading) && run.stdout.contains(row), "{run:?}");
    let run = folder.run("verilog counter --equal-to hand.v --json");
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    let (ours, theirs) = (&report["run"]["outputs"]["count"], &report["run"]["theirs"]["count"]);
    assert_eq!((run.code, &report["result"], &report["run"]["clock"]), (Some(1), &"differs".into(), &6.into()));
    assert_eq!(
        (ours, theirs),
        (
            &serde_json::json!(["0", "0", "1", "2", "3", "4", "4"]),
            &serde_json::json!(["0", "0", "1", "2", "3", "4", "0"])
        )
    );
    assert_eq!(report["run"]["differ"], serde_json::json!(["count"]));
    assert_eq!(report["run"]["reset"][0], true);
}

#[test]
fn what_is_open_has_an_exit_code_of_its_own() {
    if lacks_tools() {
        return;
    }
    let folder = Folder::with(&[("hand.v", COUNTER)]);
    let line = "verilog counter --set limit=1000000 --equal-to hand.v -P LIMIT=999999 --depth 3 --seconds 2";
    let run = folder.run(line);
    // How many clocks, depends on the computer.
    let said = "not settled: ";
    assert!(run.code == Some(5) && run.stdout.starts_with(said), "{run:?}");
}

#[test]
#[cfg(unix)]
fn the_time_is_over_also_while_yosys_works_and_nothing_was_searched_then() {
    use super::synth::{stub_path, with_programs};
    let folder = with_programs(&[("yosys", "exec sleep 60")]);
    std::fs::write(folder.path("hand.v"), COUNTER).unwrap();
    let mut command = folder.command("verilog counter --equal-to hand.v --seconds 1");
    let run = Run::of(command.env("PATH", stub_path(&folder)).output().unwrap());
    let said = "not settled: the time was over while Yosys made a circuit of both modules, so nothing is known of hand.v \
                and counter_limit5: give more --seconds, or both smaller parameters\n";
    assert_eq!((run.code, run.stdout.as_str()), (Some(5), said), "{run:?}");
}

/// Each mistake in the file or the command line, and what the sentence says.
#[test]
fn mistakes_are_named_with_place_and_remedy() {
    if lacks_tools() {
        return;
    }
    for (from, to, options, sentence) in [
        (";\nendmodule", "\nendmodule", "", "hand.v:15: syntax error, "),
        ("wire                       restart", "wire again", "", "hand.v:2: `counter` has no port `restart`"),
        ("$clog2(LIMIT) - 1", "3", "", "hand.v:7: `count` has 4 bits, and 3 bits in counter_limit5: change it"),
        ("counter", "other", "--module counter", "hand.v: there is no module `counter`: choose one of other\n"),
        ("counter", "other", "-P WIDTH=6", "hand.v: the module has no parameter `WIDTH`: leave it out\n"),
        ("counter", "other", "-P LIMIT=six", "'LIMIT=six' for '-P <NAME=VALUE>': the value has to be a whole number"),
        ("counter", "other", "--equal-to absent.v", "absent.v: cannot be read"),
        ("counter", "other", "-o out", "'--equal-to <FILE>' cannot be used with '--output <FOLDER>'"),
    ] {
        let run = with(from, to).run(&format!("verilog counter --equal-to hand.v {options}"));
        assert!(run.code == Some(2) && run.stdout.is_empty() && run.stderr.contains(sentence), "{sentence}\n{run:?}");
    }
    let run = Folder::new().run("verilog counter -o out --module counter");
    assert!(run.code == Some(2) && run.stderr.contains("cannot be used with"), "{run:?}");
}

#[test]
fn a_missing_program_is_named_with_its_remedy() {
    let folder = Folder::with(&[("hand.v", COUNTER)]);
    let mut command = folder.command("verilog counter --equal-to hand.v");
    let run = Run::of(command.env("PATH", folder.path("nowhere")).output().unwrap());
    assert!(run.code == Some(4) && run.stderr.contains("yosys is not installed: install it"), "{run:?}");
}

#[test]
#[cfg(unix)]
fn a_comparison_can_be_interrupted() {
    if lacks_tools() {
        return;
    }
    use crate::cli::interruption::{send, start_command};
    use std::time::{Duration, Instant};
    let folder = Folder::with(&[("hand.v", COUNTER)]);
    let line = "verilog counter --set limit=1000000000 --equal-to hand.v -P LIMIT=999999999 --seconds 600";
    let child = start_command(&mut folder.command(line));
    std::thread::sleep(Duration::from_millis(400));
    let begin = Instant::now();
    send(&child, "INT");
    let run = Run::of(child.wait_with_output().unwrap());
    assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
    assert_eq!(run.stderr, "error: the proof was interrupted\n");
    assert!(begin.elapsed() < Duration::from_secs(30));
}
