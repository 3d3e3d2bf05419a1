//! `wave --diff`.

use crate::cli::harness::Folder;

/// A waveform with a clock of 10 ns that counts to 9, in 8 bits and from 1 on; at 65 ns it counts `odd`.
fn counter(scopes: &[&str], unit: &str, scale: u64, odd: u64, more: &str) -> String {
    let open: String = scopes.iter().map(|scope| format!("$scope module {scope} $end\n")).collect();
    let close = "$upscope $end\n".repeat(scopes.len());
    let mut text = format!(
        "$timescale 1 {unit} $end\n{open}$var wire 1 ! clk $end\n$var reg 8 # count [7:0] $end\n{more}{close}$enddefinitions $end\n\
         #0\n$dumpvars\n0!\nbx #\n$end\n"
    );
    for clock in 1..10 {
        let count = if clock == 6 { odd } else { clock };
        text += &format!("#{}\n1!\nb{count:b} #\n#{}\n0!\n", clock * 10 * scale, (clock * 10 + 5) * scale);
    }
    text
}

#[test]
fn the_first_difference_is_shown_with_the_clocks_around_it() {
    let folder = Folder::with(&[
        ("a.vcd", &counter(&["top"], "ns", 1, 6, "$var wire 1 % spare $end\n")),
        ("b.vcd", &counter(&["tb", "dut"], "ps", 1000, 22, "")),
        ("same.vcd", &counter(&["tb", "dut"], "ps", 1000, 6, "")),
    ]);
    let run = folder.run("wave --diff a.vcd b.vcd");
    assert_eq!((run.code, run.stderr.as_str()), (Some(1), ""));
    let expected = "\
only in a.vcd: spare
the first difference is at 60000 ps, in 1 of 2 signals:
  count: 6 in a.vcd, 16 in b.vcd

time in ps  | 10000 | 20000 | 30000 | 40000 | 50000 | 60000 | 70000 | 80000 | 90000 |
a.vcd count | 1     | 2     | 3     | 4     | 5     | 6     | 7     | 8     | 9     |
b.vcd count | 1     | 2     | 3     | 4     | 5     | 16    | 7     | 8     | 9     |
";
    assert_eq!(run.stdout, expected);
    let same = folder.stdout("wave --diff same.vcd a.vcd");
    assert_eq!(same, "only in a.vcd: spare\nno difference in 2 signals from 0 to 95000 ps\n");
}

#[test]
fn a_run_is_what_it_is_in_each_format_and_differs_from_another_run() {
    let folder = Folder::new();
    let wave = |block: &str, file: &str| folder.stdout(&format!("wave {block} -o {file}"));
    wave("gfb-unit --set width=64 --set height=64", "a.vcd");
    wave("gfb-unit --set width=64 --set height=64", "a.fst");
    let same = folder.stdout("wave --diff a.vcd a.fst");
    assert!(same.starts_with("no difference in ") && same.lines().count() == 1, "{same}");
    // Only a part of it, from later on.
    wave("gfb-unit --set width=64 --set height=64 --from 1us --to 3us", "part.fst");
    assert!(folder.stdout("wave --diff part.fst a.vcd").ends_with(" from 1000000 to 3000000 ps\n"));
    wave("gfb-unit --set width=32 --set height=64", "b.fst");
    let run = folder.run("wave --diff a.fst b.fst");
    assert!(run.code == Some(1) && run.stdout.contains("the first difference is at "), "{run:?}");
}

#[test]
fn causes_are_those_of_the_block_whose_run_is_one_of_the_files() {
    let folder = Folder::new();
    folder.stdout("wave fifo -o before.vcd");
    folder.stdout("wave fifo --set depth=2 -o after.fst");
    // Whichever file it is, and wherever it stands.
    for (line, same, other, ours, theirs) in [
        ("wave fifo --diff before.vcd after.fst", "before.vcd", "after.fst", 1, 0),
        ("wave fifo --diff after.fst before.vcd", "before.vcd", "after.fst", 1, 0),
        ("wave fifo --set depth=2 --diff before.vcd after.fst", "after.fst", "before.vcd", 0, 1),
    ] {
        let run = folder.run(line);
        assert_eq!((run.code, run.stderr.as_str()), (Some(1), ""), "{line}: {run:?}");
        let head = format!("tilewright has the same run of fifo as {same}\n");
        let cause = format!(
            "why it has its value in tilewright:\ninto_ready = {ours}  cycle 3  blocks/src/fifo.rs:101  ({theirs} in {other})\n"
        );
        assert!(run.stdout.starts_with(&head) && run.stdout.contains(&cause), "{line}: {run:?}");
    }
    let run = folder.run("wave fifo --diff before.vcd after.fst --json");
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&report["same"], &report["runs"][1]), (&"before.vcd".into(), &"after.fst".into()));
    assert_eq!(report["difference"]["cause"]["name"], "into_ready");
    let same = folder.stdout("wave fifo --diff before.vcd before.vcd");
    let (head, last) = ("tilewright has the same run of fifo as before.vcd\n", "no difference in ");
    assert!(same.strip_prefix(head).is_some_and(|rest| rest.starts_with(last)), "{same}");
    // The circuit of another size made neither of both files.
    let run = folder.run("wave fifo --set depth=1 --diff before.vcd after.fst");
    assert!(run.code == Some(2) && run.stdout.is_empty(), "{run:?}");
    let sentence =
        "neither before.vcd nor after.fst is the run of fifo with these parameters, so what causes their difference";
    assert!(run.stderr.contains(sentence), "{run:?}");
}

#[test]
fn files_that_cannot_be_compared_are_refused() {
    let folder = Folder::with(&[
        ("a.vcd", &counter(&["top"], "ns", 1, 6, "")),
        ("no.vcd", "nothing"),
        ("cut.fst", "\0\0"),
        ("undeclared.vcd", &(counter(&["top"], "ns", 1, 6, "") + "#200\n1?\n")),
        ("back.vcd", &(counter(&["top"], "ns", 1, 6, "") + "#20\n1!\n")),
        ("other.vcd", &counter(&["top"], "ns", 1, 6, "").replace(" clk ", " a ").replace(" count ", " b ")),
    ]);
    folder.stdout("wave gfb-unit -o whole.fst");
    let whole = std::fs::read(folder.path("whole.fst")).unwrap();
    for length in (1..whole.len()).step_by(whole.len() / 20) {
        std::fs::write(folder.path("part.fst"), &whole[..length]).unwrap();
        let run = folder.run("wave --diff part.fst whole.fst");
        assert!(matches!(run.code, Some(0 | 2)), "{length}: {run:?}");
    }
    for (line, sentence) in [
        ("wave --diff a.vcd none.vcd", "error: none.vcd: "),
        ("wave --diff a.vcd no.vcd", "error: no.vcd: it is no sound waveform ("),
        ("wave --diff a.vcd cut.fst", "error: cut.fst: it is no sound waveform ("),
        ("wave --diff undeclared.vcd a.vcd", "(`?` changes and is not declared)"),
        ("wave --diff back.vcd a.vcd", "(time goes back to 20)"),
        (
            "wave --diff a.vcd other.vcd",
            "error: a.vcd and other.vcd have no signal in common: name files of the same design",
        ),
        ("wave --diff a.vcd", "2 values required"),
        ("wave merging-unit --diff a.vcd a.vcd --against icarus", "cannot be used with"),
        (
            "wave merging-unit --diff a.vcd other.vcd",
            "error: neither a.vcd nor other.vcd is the run of merging-unit with these parameters",
        ),
        ("wave", "<BLOCK>"),
    ] {
        let run = folder.run(line);
        assert!(run.code == Some(2) && run.stdout.is_empty() && run.stderr.contains(sentence), "{line}: {run:?}");
    }
}

/// A waveform with these variables, each with its values at 0 and at 10 ns.
fn waveform(variables: &[(&str, u32, [&str; 2])]) -> String {
    let mut text = "$timescale 1 ns $end\n$scope module top $end\n".to_owned();
    let id = |at: usize| char::from(b'!' + at as u8);
    for (at, (path, width, _)) in variables.iter().enumerate() {
        let (scopes, name) = path.rsplit_once('.').map_or(("", *path), |(scopes, name)| (scopes, name));
        let scopes: Vec<&str> = scopes.split('.').filter(|scope| !scope.is_empty()).collect();
        scopes.iter().for_each(|scope| text += &format!("$scope module {scope} $end\n"));
        text += &format!("$var wire {width} {} {name} $end\n", id(at));
        text += &"$upscope $end\n".repeat(scopes.len());
    }
    text += "$upscope $end\n$enddefinitions $end\n";
    for (number, time) in [0, 10].into_iter().enumerate() {
        text += &format!("#{time}\n");
        variables
            .iter()
            .enumerate()
            .for_each(|(at, (.., values))| text += &format!("b{} {}\n", values[number], id(at)));
    }
    text + "#20\n"
}

#[test]
fn lanes_are_the_same_signals_in_each_form() {
    let ours = [
        ("word[0]", 2, ["01", "01"]),
        ("word[1]", 2, ["10", "11"]),
        ("sum[0]", 2, ["00", "01"]),
        ("sum[1]", 2, ["00", "10"]),
        ("u_cell[0].lane.x", 2, ["00", "01"]),
        ("u_cell[1].lane.x", 2, ["00", "11"]),
    ];
    let mut theirs = [
        ("word", 4, ["1001", "1101"]),
        ("row[0].sum", 2, ["00", "01"]),
        ("row[1].sum", 2, ["00", "10"]),
        ("row[0].u_cell.x", 2, ["00", "01"]),
        ("row[1].u_cell.x", 2, ["00", "11"]),
    ];
    let folder = Folder::with(&[("a.vcd", &waveform(&ours)), ("b.vcd", &waveform(&theirs))]);
    for files in ["a.vcd b.vcd", "b.vcd a.vcd"] {
        assert_eq!(folder.stdout(&format!("wave --diff {files}")), "no difference in 6 signals from 0 to 20 ns\n");
    }
    theirs[0].2[1] = "0101";
    theirs[4].2[1] = "10";
    std::fs::write(folder.path("b.vcd"), waveform(&theirs)).unwrap();
    let run = folder.run("wave --diff a.vcd b.vcd --json");
    assert_eq!(run.code, Some(1), "{run:?}");
    let report: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    let differing = serde_json::json!([
        { "name": "u_cell[1].x", "values": ["3", "2"] },
        { "name": "word[1]", "values": ["3", "1"] },
    ]);
    assert_eq!((&report["unit"], &report["difference"]["time"]), (&"ns".into(), &10.into()));
    assert_eq!(report["difference"]["signals"], differing);
    assert_eq!((&report["signals"], &report["only"]), (&6.into(), &serde_json::json!([[], []])));
    let other = folder.stdout("wave --diff a.vcd a.vcd --json");
    assert!(serde_json::from_str::<serde_json::Value>(&other).unwrap()["difference"].is_null());
}
