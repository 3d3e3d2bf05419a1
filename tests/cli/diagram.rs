//! `diagram`.

use crate::cli::harness::Folder;
use std::path::Path;

/// The top blocks of the machines, whose pictures are in `docs/diagrams`.
const MACHINES: [&str; 4] = ["vc1", "quadtree-generator", "pixel-planes-5", "pixelflow"];

#[test]
fn the_pictures_of_the_machines_are_what_is_drawn() {
    let folder = Folder::new();
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/diagrams");
    for (machine, (option, end)) in MACHINES.into_iter().flat_map(|it| [(it, ("", "")), (it, (" --narrow", "-narrow"))])
    {
        let drawn = folder.stdout(&format!("diagram {machine}{option} -o -"));
        let there = std::fs::read_to_string(docs.join(format!("{machine}{end}.svg"))).unwrap_or_default();
        assert!(drawn == there, "run `tilewright diagram {machine}{option} -o docs/diagrams/{machine}{end}.svg`");
    }
    assert_eq!(std::fs::read_dir(docs).unwrap().count(), 2 * MACHINES.len());
}

#[test]
fn a_diagram_is_a_picture_a_graph_or_text() {
    let folder = Folder::new();
    let run = folder.run("diagram merging-unit -o mu.svg");
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(0), "", "wrote mu.svg\n"));
    assert!(folder.read("mu.svg").starts_with("<svg xmlns=") && !folder.read("mu.svg").contains("<script"));
    folder.stdout("diagram merging-unit -o mu.dot");
    assert!(folder.read("mu.dot").starts_with("digraph \"MergingUnit\" {\n"));
    let quiet = folder.run("diagram merging-unit --ascii --quiet -o mu.svg");
    assert_eq!((quiet.code, quiet.stderr.as_str()), (Some(0), ""));
    assert_eq!(quiet.stdout, include_str!("../../rtl/tests/diagrams/merging-unit.txt"));
}

#[test]
fn a_graph_is_not_narrow() {
    let folder = Folder::new();
    let run = folder.run("diagram merging-unit --narrow -o mu.dot");
    assert_eq!((run.code, folder.names().len()), (Some(2), 0), "{run:?}");
    assert!(run.stderr.contains("mu.dot: Graphviz decides on the places in a graph"), "{run:?}");
    assert_eq!(folder.run("diagram merging-unit --narrow --ascii").code, Some(2));
}

#[test]
fn the_report_counts_what_is_drawn() {
    let folder = Folder::new();
    let report = folder.json("diagram image-merger --set units=3 -o three.svg --json");
    let counts = ["boxes", "arrows", "hidden"].map(|key| report[key].as_u64().unwrap());
    assert_eq!(
        (counts, &report["parameters"]["units"], &report["files"][0]),
        ([5, 4, 0], &3.into(), &"three.svg".into())
    );
    assert!(folder.read("three.svg").contains(">u_merging_unit ×3</text>"));
}

#[test]
fn more_levels_open_instances() {
    let folder = Folder::new();
    let boxes = |depth: u32| {
        folder.json(&format!("diagram raster-processor --depth {depth} -o d.svg --json"))["boxes"].as_u64()
    };
    assert!(boxes(1) < boxes(2) && boxes(2) < boxes(3), "{:?}", [1, 2, 3].map(boxes));
    assert!(folder.read("d.svg").contains("class=\"frame\""));
}

#[test]
fn what_is_around_a_net_is_drawn_alone() {
    let folder = Folder::new();
    let boxes = |options: &str| {
        folder.stdout(&format!("diagram merging-unit --around {options} -o near.dot"));
        let dot = folder.read("near.dot");
        dot.lines()
            .filter_map(|line| line.split("[label=\"").nth(1)?.split("\\n").next().map(str::to_owned))
            .collect::<Vec<_>>()
    };
    assert!(boxes("left1 --steps 2").len() > 6);
    assert_eq!(boxes("left1"), ["left", "enable", "left1", "left2", "decided2", "right_is_nearer2"]);
}
