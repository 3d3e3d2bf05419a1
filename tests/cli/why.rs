//! `why`.

use crate::cli::harness::Folder;
use serde_json::Value;

/// All causes of a report, as `when NAME` or `from NAME`, each before its own.
fn names(cause: &Value) -> Vec<String> {
    let name = format!("{} {}", cause["role"].as_str().unwrap(), cause["label"].as_str().unwrap());
    let causes = cause["causes"].as_array().unwrap().iter().flat_map(names);
    std::iter::once(name).chain(causes).collect()
}

/// The scan counter's column counts up to the end of a line.
#[test]
fn a_register_leads_back_to_its_last_writes() {
    let folder = Folder::new();
    let report = folder.json("why scan-counter --signal pixel_x --at 7 --depth 2 --json");
    let cause = &report["cause"];
    assert_eq!(
        (&report["format"], &report["block"], &report["complete"]),
        (&1.into(), &"scan-counter".into(), &false.into())
    );
    assert_eq!(
        (&cause["name"], &cause["picoseconds"]),
        (&"pixel_x".into(), &(cause["cycle"].as_u64().unwrap() * 80_000).into())
    );
    let source = cause["source"].as_str().unwrap();
    assert!(source.starts_with("rtl/src/lfb/scan_counter.rs:"), "{source}");
    // The line ends at column 15, and the next one begins.
    let expected = ["from pixel_x", "when scan_restart", "when line_end", "from scan_enable", "from x"];
    assert_eq!(names(cause), expected);

    let text = folder.stdout("why scan-counter --signal pixel_x --at 7 --depth 2");
    let [first, second, .., last] = text.lines().collect::<Vec<_>>()[..] else { panic!("{text}") };
    assert!(first.starts_with("pixel_x = ") && second.starts_with("  when scan_restart = 0"), "{text}");
    assert_eq!(last, "causes are left out: a greater --depth or --most tells more");
    assert_eq!(text.lines().count(), expected.len() + 1);
}

#[test]
fn inputs_end_the_search_and_a_tree_is_whole() {
    let folder = Folder::new();
    let report = folder.json("why decoder --signal one_hot --at 2 --json");
    assert_eq!(report["complete"], true);
    assert_eq!(names(&report["cause"]), ["from one_hot", "from index"]);
    assert_eq!(report["cause"]["causes"][0]["end"], "input");
    // A block of several clocks: the cycles are those of the clock that is named.
    let of = |clock: &str| {
        folder.json(&format!("why patch-table --signal page --at 3 --clock {clock} --json"))["cause"]["picoseconds"]
            .clone()
    };
    assert_ne!(of("pe"), of("merge"));
}

#[test]
fn what_there_is_not_is_said_with_a_remedy() {
    let folder = Folder::new();
    for (arguments, sentence) in [
        ("fifo --signal usde", "error: there is no signal `usde`: did you mean `used`?\n"),
        ("scan-counter --signal pixel_x --at 100000", "of `clk`: give --at a number up to "),
        ("patch-table --signal page --clock pee --at 3", "error: there is no clock `pee`: "),
        ("decoder --signal one_hot --depth 2000", "give a whole number from 0 to 1000"),
    ] {
        let run = folder.run(&format!("why {arguments}"));
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments}: {run:?}");
        assert!(run.stderr.contains(sentence), "{arguments}: {run:?}");
    }
}
