//! `tilewright reproduce`: the page, its data, and what goes wrong.

use crate::harness::Folder;
use tilewright_report::browser;

/// A page of so few polygons that it takes no time.
const QUICK: &str = "reproduce quadtree -o report --polygons 3";

/// A report takes some seconds, so all is asked of one, and of one of another seed.
#[test]
fn a_report_is_whole() {
    let folder = Folder::new();
    its_page_is_whole_in_a_browser_and_its_data_is_beside_it(&folder);
    what_is_found_stands_beside_the_formula_with_its_seed(&folder);
    windows_are_measured_queues_lose_and_processors_are_busy(&folder);
    folder.stdout("reproduce quadtree -o other --polygons 3 --seed 2");
    for name in ["windows-1.csv", "stack-performance.csv", "loss-stacks.csv"] {
        let [one, other] = ["report", "other"].map(|report| folder.read(format!("{report}/{name}")));
        assert_ne!(one, other, "{name}");
    }
}

fn its_page_is_whole_in_a_browser_and_its_data_is_beside_it(folder: &Folder) {
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
    let parts = [
        "index.html",
        "report.json",
        "statements.csv",
        "checks.csv",
        "samples.csv",
        "windows-4.csv",
        "window-sizes.csv",
        "stack-performance.csv",
        "stack-efficiency.csv",
        "pipeline-performance.csv",
        "pipeline-load.csv",
        "pipeline-efficiency.csv",
        "stacks-as-run.csv",
        "pipelines-as-run.csv",
        "loss-stacks.csv",
        "loss-by-area.csv",
        "loss-pipelines.csv",
        "idle-pipelines.csv",
        "teapot-4-frame.png",
        "teapot-4-owners.png",
        "teapot-4-load.csv",
        "teapot-4-busy.csv",
        "teapot-4-stalled.csv",
    ];
    for name in parts.map(|name| format!("report/{name}")) {
        assert!(files.contains(&name.as_str()), "{name} is missing in {files:?}");
    }

    let counts = ["holds", "differs", "cannot_be_compared"].map(|name| report[name].as_u64().unwrap());
    let all: serde_json::Value = serde_json::from_str(&folder.read("report/report.json")).unwrap();
    assert_eq!(counts, ["holds", "differs", "cannot_be_compared"].map(|name| all[name].as_u64().unwrap()));
    assert!(counts[0] > 10 && counts[2] == 1, "{counts:?}");

    // All that measure agree, and the frame is the golden image.
    let checks = folder.read("report/checks.csv");
    let verdicts: Vec<&str> = checks.lines().skip(1).map(|line| line.rsplit(',').next().unwrap()).collect();
    assert!(verdicts.len() >= 4 && verdicts.iter().all(|verdict| *verdict == "holds"), "{checks}");
    assert!(checks.contains(",\"teapot, 4x4 processors\",pixels that differ,,,RTL,0,,holds"), "{checks}");

    let page = std::fs::read(folder.path("report/index.html")).unwrap();
    if let Some(complaints) = browser::complaints(&page) {
        assert_eq!(complaints, [""; 0]);
    }
}

/// The cells of a chart's CSV file: name and x, by formula, counted, of the model, of RTL, of the paper, and the seeds of the middle three.
fn rows(folder: &Folder, name: &str) -> Vec<Vec<String>> {
    let text = folder.read(name);
    let mut lines = text.lines();
    let names = lines.next().unwrap();
    let columns =
        ",formula,plain count,transaction model,RTL,paper,plain count seeds,transaction model seeds,RTL seeds";
    assert!(names.ends_with(columns), "{names}");
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn what_is_found_stands_beside_the_formula_with_its_seed(folder: &Folder) {
    for (name, levels, is_counted) in [
        ("windows-2", 8, true),
        ("stack-efficiency", 5, true),
        ("pipeline-load", 5, true),
        ("pipelines-as-run", 5, false),
    ] {
        let rows = rows(folder, &format!("report/{name}.csv"));
        let filled = |column: usize| rows.iter().filter(|cells| !cells[column].is_empty()).count();
        // At 61 areas along the curve and the 19 of the points, of which six are among them; a quick look has one on the hardware.
        let found = if is_counted { 19 * levels } else { 0 };
        assert_eq!([2, 3, 4, 5, 6].map(filled), [74 * levels, found, 19 * levels, levels, 0], "{name}");
        for cells in &rows {
            for column in [3, 4, 5] {
                let seed = if cells[column].is_empty() { "" } else { "1" };
                assert_eq!(cells[column + 4], seed, "what is measured names its seed: {cells:?}");
            }
            assert!(cells[5].is_empty() || cells[5] == cells[4], "the model is the hardware’s: {cells:?}");
        }
    }
}

/// The picture and the heat maps are the frame's, and what the depth of queues costs has no formula.
fn windows_are_measured_queues_lose_and_processors_are_busy(folder: &Folder) {
    let sizes = rows(folder, "report/window-sizes.csv");
    assert_eq!(sizes.len(), 9 + 8 + 7 + 6);
    assert!(sizes.iter().all(|cells| cells[2] == cells[4] && cells[4] == cells[5]), "{sizes:?}");
    let losses = rows(folder, "report/loss-stacks.csv");
    assert_eq!(losses.len(), 5 * 7);
    assert!(losses.iter().all(|cells| cells[2].is_empty() && cells[5].is_empty() && cells[8] == "1"), "{losses:?}");
    let busy: u64 = lines(folder, "report/teapot-4-busy.csv")
        .filter(|cells| cells[0] != "0")
        .map(|cells| cells[2].parse::<u64>().unwrap())
        .sum();
    let load: u64 = lines(folder, "report/teapot-4-load.csv").map(|cells| cells[2].parse::<u64>().unwrap()).sum();
    assert!(busy == load && load > 10_000, "busy clocks by level and processor, and by processor: {busy}, {load}");
    assert_eq!(lines(folder, "report/teapot-4-load.csv").count(), 16);
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
    assert_eq!(said("reproduce vc2 -o report").0, 2);
    assert_eq!(folder.names(), ["file"]);
}
