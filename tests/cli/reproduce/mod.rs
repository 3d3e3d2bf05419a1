//! `tilewright reproduce`: the pages, their data, and what goes wrong.

mod all;
pub mod made;
mod pixel_planes;
mod pixelflow;
mod quadtree;
mod reasons;
mod vc1;

use crate::cli::harness::Folder;
use made::Made;
use serde_json::Value;
use tilewright_report::browser;

/// That a page is whole in a browser, and has those parts and all of its data beside it.
fn is_whole(made: &Made, parts: &[&str]) {
    let files: Vec<&str> = made.files().map(|(name, _)| name).collect();
    assert_eq!(made.told(), files);
    let always = ["index.html", "report.json", "statements.csv", "checks.csv"];
    for name in always.iter().chain(parts) {
        assert!(files.contains(name), "{name} is missing in {files:?}");
    }
    if let Some(complaints) = browser::complaints(made.read("index.html").as_bytes()) {
        assert_eq!(complaints, [""; 0]);
    }
    let all: Value = serde_json::from_str(&made.read("report.json")).unwrap();
    assert_eq!(made.counts(), ["holds", "differs", "cannot_be_compared"].map(|count| all[count].as_u64().unwrap()));
    each_figure_makes_a_claim(&all);
}

/// A figure stands under a short sentence that says what it shows, and statements come after the figures.
fn each_figure_makes_a_claim(report: &Value) {
    let mut claims = 0;
    for part in parts(report) {
        match part["kind"].as_str().unwrap() {
            "chart" | "timeline" | "picture" | "heat-map" => {
                let claim = part["claim"].as_str().unwrap_or_else(|| panic!("{} claims nothing", part["part"]["id"]));
                assert!(claim.ends_with('.') && claim.chars().count() < 170, "{claim}");
                claims += 1;
            }
            "verdicts" => assert!(claims > 2, "statements stand before the figures"),
            _ => (),
        }
    }
}

/// All parts of a page, in order.
fn parts(report: &Value) -> impl Iterator<Item = &Value> {
    report["sections"].as_array().unwrap().iter().flat_map(|section| section["parts"].as_array().unwrap())
}

/// That all who measure agree and frames are golden images: so many checks at least, with a line that says so of one.
fn all_checks_hold(made: &Made, least: usize, of_a_frame: &str) {
    let checks = made.read("checks.csv");
    let verdicts: Vec<&str> = checks.lines().skip(1).map(|line| line.rsplit(',').next().unwrap()).collect();
    assert!(verdicts.len() >= least && verdicts.iter().all(|verdict| *verdict == "holds"), "{checks}");
    assert!(checks.contains(of_a_frame), "{checks}");
}

#[test]
fn mistakes_are_said() {
    let folder = Folder::with(&[("file", "")]);
    let said = |line: &str| {
        let run = folder.run(line);
        assert_eq!(run.stdout, "", "{line}");
        (run.code.unwrap(), run.stderr)
    };
    let (code, sentence) = said("reproduce quadtree -o -");
    assert_eq!((code, sentence.contains("this writes several: name a folder")), (2, true), "{sentence}");
    assert_eq!(said("reproduce quadtree -o file/report --polygons 1").0, 3);
    assert_eq!(said("reproduce quadtree -o report --polygons 0").0, 2);
    assert_eq!(said("reproduce pixel-planes-5 -o report --vectors 0").0, 2);
    assert_eq!(said("reproduce vc1 -o report --views 0").0, 2);
    assert_eq!(said("reproduce vc2 -o report").0, 2);
    for (paper, other, own) in [
        ("quadtree", "--vectors", "--polygons"),
        ("pixel-planes-5", "--polygons", "--vectors"),
        ("quadtree", "--views", "--polygons"),
        ("vc1", "--polygons", "--views"),
        ("all", "--views", "--polygons"),
        ("all", "--vectors", "--polygons"),
    ] {
        let (code, sentence) = said(&format!("reproduce {paper} -o report {other} 3"));
        let expected = format!("{other} is an option of another paper: for a quick look at this one give {own}");
        assert!(code == 2 && sentence.contains(&expected), "{code}: {sentence}");
    }
    assert_eq!(folder.names(), ["file"]);
}
