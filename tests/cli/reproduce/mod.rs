//! `tilewright reproduce`: the pages, their data, and what goes wrong.

mod all;
mod pixel_planes;
mod pixelflow;
mod quadtree;

use crate::harness::Folder;
use serde_json::Value;
use tilewright_report::browser;

/// Makes a page, which is whole in a browser, and has those parts and all of its data beside it; gives the report.
fn whole_page(folder: &Folder, command: &str, parts: &[&str]) -> Value {
    let report = folder.json(&format!("{command} --json"));
    let mut files: Vec<&str> = report["files"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    files.sort_unstable();
    let mut written: Vec<String> = std::fs::read_dir(folder.path("report"))
        .unwrap()
        .map(|it| format!("report/{}", it.unwrap().file_name().into_string().unwrap()))
        .collect();
    written.sort();
    assert_eq!(files, written);
    let always = ["index.html", "report.json", "statements.csv", "checks.csv"];
    for name in always.iter().chain(parts).map(|name| format!("report/{name}")) {
        assert!(files.contains(&name.as_str()), "{name} is missing in {files:?}");
    }
    let page = std::fs::read(folder.path("report/index.html")).unwrap();
    if let Some(complaints) = browser::complaints(&page) {
        assert_eq!(complaints, [""; 0]);
    }
    let all: Value = serde_json::from_str(&folder.read("report/report.json")).unwrap();
    for count in ["holds", "differs", "cannot_be_compared"] {
        assert_eq!(report[count], all[count], "{count}");
    }
    report
}

/// That all who measure agree and frames are golden images: so many checks at least, with a line that says so of one.
fn all_checks_hold(folder: &Folder, least: usize, of_a_frame: &str) {
    let checks = folder.read("report/checks.csv");
    let verdicts: Vec<&str> = checks.lines().skip(1).map(|line| line.rsplit(',').next().unwrap()).collect();
    assert!(verdicts.len() >= least && verdicts.iter().all(|verdict| *verdict == "holds"), "{checks}");
    assert!(checks.contains(of_a_frame), "{checks}");
}

/// The cells of a chart's CSV file: name and x, by formula, counted, of the model, of RTL, of the paper, and the seeds of the middle three.
fn rows(folder: &Folder, name: &str) -> Vec<Vec<String>> {
    let text = folder.read(name);
    let names = text.lines().next().unwrap();
    let columns =
        ",formula,plain count,transaction model,RTL,paper,plain count seeds,transaction model seeds,RTL seeds";
    assert!(names.ends_with(columns), "{names}");
    lines(folder, name).collect()
}

/// The cells of a file, after the line of names.
fn lines(folder: &Folder, name: &str) -> impl Iterator<Item = Vec<String>> {
    let lines: Vec<_> =
        folder.read(name).lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect();
    lines.into_iter()
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
    assert_eq!(said("reproduce vc2 -o report").0, 2);
    for (paper, other, own) in [
        ("quadtree", "--vectors", "--polygons"),
        ("pixel-planes-5", "--polygons", "--vectors"),
        ("all", "--vectors", "--polygons"),
    ] {
        let (code, sentence) = said(&format!("reproduce {paper} -o report {other} 3"));
        let expected = format!("{other} is an option of another paper: for a quick look at this one give {own}");
        assert!(code == 2 && sentence.contains(&expected), "{code}: {sentence}");
    }
    assert_eq!(folder.names(), ["file"]);
}
