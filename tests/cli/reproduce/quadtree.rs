//! The page of the quadtree generator.

use super::made::{Made, made};
use super::{all_checks_hold, is_whole};

/// A quick look, as the README has it.
const QUICK: &str = "quadtree -o report/ --polygons 20";
/// Another, as the help has it.
const OF_ANOTHER_SEED: &str = "quadtree -o report/ --polygons 20 --seed 7 --json";

#[test]
fn a_report_is_whole() {
    let made = made(QUICK);
    its_page_is_whole_in_a_browser_and_its_data_is_beside_it(made);
    what_is_found_stands_beside_the_formula_with_its_seed(made);
    windows_are_measured_queues_lose_and_processors_are_busy(made);
}

#[test]
fn another_seed_finds_other_numbers() {
    let [one, other] = [QUICK, OF_ANOTHER_SEED].map(made);
    let names = |made: &Made| made.files().map(|(name, _)| name.to_owned()).collect::<Vec<_>>();
    assert_eq!(names(one), names(other));
    assert_eq!(other.told(), names(other));
    for name in ["windows-1.csv", "stack-performance.csv", "loss-stacks.csv"] {
        assert_ne!(one.read(name), other.read(name), "{name}");
    }
}

fn its_page_is_whole_in_a_browser_and_its_data_is_beside_it(made: &Made) {
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
    is_whole(made, &parts);
    let [holds, _, unknown] = made.counts();
    assert!(holds > 10 && unknown == 1, "{holds} hold, {unknown} cannot be compared");
    all_checks_hold(made, 4, ",\"teapot, 4x4 processors\",pixels that differ,,,RTL,0,,holds");
}

fn what_is_found_stands_beside_the_formula_with_its_seed(made: &Made) {
    for (name, levels, is_counted) in [
        ("windows-2", 8, true),
        ("stack-efficiency", 5, true),
        ("pipeline-load", 5, true),
        ("pipelines-as-run", 5, false),
    ] {
        let rows = made.rows(&format!("{name}.csv"));
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
fn windows_are_measured_queues_lose_and_processors_are_busy(made: &Made) {
    let sizes = made.rows("window-sizes.csv");
    assert_eq!(sizes.len(), 9 + 8 + 7 + 6);
    assert!(sizes.iter().all(|cells| cells[2] == cells[4] && cells[4] == cells[5]), "{sizes:?}");
    let losses = made.rows("loss-stacks.csv");
    assert_eq!(losses.len(), 5 * 7);
    assert!(losses.iter().all(|cells| cells[2].is_empty() && cells[5].is_empty() && cells[8] == "1"), "{losses:?}");
    let busy: u64 = made
        .lines("teapot-4-busy.csv")
        .filter(|cells| cells[0] != "0")
        .map(|cells| cells[2].parse::<u64>().unwrap())
        .sum();
    let load: u64 = made.lines("teapot-4-load.csv").map(|cells| cells[2].parse::<u64>().unwrap()).sum();
    assert!(busy == load && load > 10_000, "busy clocks by level and processor, and by processor: {busy}, {load}");
    assert_eq!(made.lines("teapot-4-load.csv").count(), 16);
}
