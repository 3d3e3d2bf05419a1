//! `list`.

use crate::cli::harness::Folder;
use serde_json::Value;

/// The names in a part of the JSON.
fn names(lists: &Value, part: &str) -> Vec<String> {
    let name = |it: &Value| it["name"].as_str().unwrap().to_owned();
    lists[part].as_array().unwrap().iter().map(name).collect()
}

#[test]
fn everything_has_one_line_under_its_heading() {
    let folder = Folder::new();
    let (text, lists) = (folder.stdout("list"), folder.json("list --json"));
    let things = text.lines().filter_map(|line| line.strip_prefix("  ")?.split("  ").next());
    let parts = ["scenes", "files", "machines", "blocks", "designs", "passes"];
    let expected: Vec<String> = parts.iter().flat_map(|part| names(&lists, part)).collect();
    assert_eq!(things.collect::<Vec<_>>(), expected);
    assert!(expected.len() > 130, "{expected:?}");
    assert!(text.lines().all(|line| line.len() <= 150), "{text}");
    let under = |heading: &str| text.split(heading).nth(1).unwrap().split("\n\n").next().unwrap();
    assert!(under("Blocks of the VC-1").contains("\n  merging-unit  "));
    assert!(under("Blocks for any design").contains("\n  fifo  "));
}

#[test]
fn a_part_is_shown_alone() {
    let folder = Folder::new();
    let whole = folder.stdout("list");
    for (part, first, count) in [("scenes", "teapot ", 10), ("passes", "flatten ", 17), ("designs", "pimN ", 11)] {
        let text = folder.stdout(&format!("list {part}"));
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines.len() == count && lines[1].trim_start().starts_with(first), "{text}");
        assert!(whole.contains(&text), "{text}");
    }
    assert_eq!(names(&folder.json("list scenes --json"), "blocks"), [""; 0]);
}

#[test]
fn a_block_is_told_in_full() {
    let folder = Folder::new();
    let text = folder.stdout("list dual_clock_fifo");
    for line in [
        "dual-clock-fifo: a queue from one clock to another",
        "Latency    3 clocks of the reader, or 4 if the edges of both clocks coincide",
        "Clock      read_clk, 14 ns, reset by read_rst",
        "  into_payload  8",
        "  out_valid    1  The output words.",
        "  --set depth=4  2 to 4096: capacity in words, a power of two",
        "  tilewright wave dual-clock-fifo",
    ] {
        assert!(text.lines().any(|it| it == line), "no `{line}` in {text}");
    }
    let text = folder.stdout("list merging-unit");
    for line in ["Latency    4 clocks with `enable`", "Source     VC-1, section 3.3, pipelined image merger (VC1-MU)"] {
        assert!(text.lines().any(|it| it == line), "no `{line}` in {text}");
    }
    assert!(!text.contains("Parameters"), "it has none: {text}");
    let lists = folder.json("list coverage-test --json");
    assert_eq!(names(&lists, "blocks"), ["coverage-test"]);
    assert_eq!((names(&lists, "machines"), names(&lists, "scenes")), (vec![], vec![]));
    let block = &lists["blocks"][0];
    let port = block["inputs"].as_array().unwrap().iter().find(|it| it["name"] == "works_window_edges").unwrap();
    assert_eq!((&port["width"], &port["lanes"], &port["form"]), (&32.into(), &3.into(), &"signed, 3 lanes".into()));
    assert_eq!(block["machine"], "quadtree");
}

#[test]
fn a_machine_that_is_also_a_block_is_told_as_both() {
    let folder = Folder::new();
    let lists = folder.json("list vc1 --json");
    assert_eq!((names(&lists, "machines"), names(&lists, "blocks")), (vec!["vc1".to_owned()], vec!["vc1".to_owned()]));
    let text = folder.stdout("list vc1");
    assert!(text.contains("\n  --processors N ") && text.contains("\n  --set processors="), "{text}");
}

#[test]
fn all_is_everything() {
    let folder = Folder::new();
    let all = folder.stdout("list all");
    for block in names(&folder.json("list --json"), "blocks") {
        assert!(all.contains(&format!("\n  tilewright wave {block}\n")), "{block}");
    }
    assert_eq!(folder.json("list all --json"), folder.json("list --json"));
}
