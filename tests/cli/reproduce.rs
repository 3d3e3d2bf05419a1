//! `tilewright reproduce`: the page, its data, and what goes wrong.

use crate::harness::Folder;
use tilewright_report::browser;

/// A page of so few polygons that it takes no time.
const QUICK: &str = "reproduce quadtree -o report --polygons 3";

#[test]
fn a_page_is_whole_in_a_browser_and_its_data_is_beside_it() {
    let folder = Folder::new();
    let report = folder.json(&format!("{QUICK} --json"));
    let files: Vec<&str> = report["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let mut expected: Vec<String> = std::fs::read_dir(folder.path("report"))
        .unwrap()
        .map(|it| format!("report/{}", it.unwrap().file_name().into_string().unwrap()))
        .collect();
    expected.sort();
    assert_eq!(
        {
            let mut files = files.clone();
            files.sort_unstable();
            files
        },
        expected
    );
    for name in ["report/index.html", "report/report.json", "report/statements.csv", "report/windows-4.csv"] {
        assert!(files.contains(&name), "{name} is missing in {files:?}");
    }

    let counts = ["holds", "differs", "cannot_be_compared"].map(|name| report[name].as_u64().unwrap());
    let all: serde_json::Value = serde_json::from_str(&folder.read("report/report.json")).unwrap();
    assert_eq!(counts, ["holds", "differs", "cannot_be_compared"].map(|name| all[name].as_u64().unwrap()));
    assert!(counts[0] > 10 && counts[2] == 1, "{counts:?}");

    let page = std::fs::read(folder.path("report/index.html")).unwrap();
    if let Some(complaints) = browser::complaints(&page) {
        assert_eq!(complaints, [""; 0]);
    }
}

#[test]
fn what_is_counted_stands_beside_the_formula_with_its_seed() {
    let folder = Folder::new();
    folder.stdout(QUICK);
    let text = folder.read("report/windows-2.csv");
    let mut lines = text.lines();
    let names = lines.next().unwrap();
    assert!(names.ends_with(",formula,transaction model,RTL,paper,transaction model seeds,RTL seeds"), "{names}");
    let [formula, model, seeds] = [2, 3, 6];
    let (mut by_formula, mut counted) = (0, 0);
    for cells in lines.map(|line| line.split(',').collect::<Vec<_>>()) {
        by_formula += usize::from(!cells[formula].is_empty());
        counted += usize::from(!cells[model].is_empty());
        assert_eq!(cells[model].is_empty(), cells[seeds].is_empty(), "what is counted names its seed: {cells:?}");
    }
    // Eight levels: at 61 areas by formula, and at the study's 19 counted.
    assert_eq!((by_formula, counted), (8 * 61, 8 * 19));
}

#[test]
fn the_seed_decides() {
    let folder = Folder::new();
    let page = |line: &str, name: &str| {
        folder.stdout(&format!("reproduce quadtree --polygons 2 -o {name} {line}"));
        folder.read(format!("{name}/windows-1.csv"))
    };
    let [one, again, other] = [page("", "one"), page("--seed 1", "again"), page("--seed 2", "other")];
    assert_eq!(one, again);
    assert_ne!(one, other);
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
    assert_eq!(said("reproduce vc2 -o report").0, 2);
    assert_eq!(folder.names(), ["file"]);
}
