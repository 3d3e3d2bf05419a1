//! The page of the quadtree generator.

use super::{all_checks_hold, lines, rows, whole_page};
use crate::harness::Folder;

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
    let parts = [
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
    let report = whole_page(folder, QUICK, &parts);
    let [holds, unknown] = ["holds", "cannot_be_compared"].map(|name| report[name].as_u64().unwrap());
    assert!(holds > 10 && unknown == 1, "{report}");
    all_checks_hold(folder, 4, ",\"teapot, 4x4 processors\",pixels that differ,,,RTL,0,,holds");
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
