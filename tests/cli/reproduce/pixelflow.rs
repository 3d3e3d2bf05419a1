//! The page of PixelFlow.

use super::is_whole;
use super::made::{Made, made};

/// A quick look, as the README has it.
const QUICK: &str = "pixelflow -o report/ --primitives 20000";

#[test]
fn a_report_is_whole() {
    let made = made(QUICK);
    let parts = [
        "figure-3.csv",
        "figure-3-every-sample.csv",
        "figure-4.csv",
        "primitives.csv",
        "stages-base.csv",
        "stages-pre-sort.csv",
        "stages-non-texturing.csv",
        "stages-base-one-sample.csv",
        "pre-sorting.csv",
        "pre-sorting-circuit.csv",
        "teapot-1.png",
        "textured-1.png",
        "frames-latency.csv",
        "frames.csv",
        "stereo-latency.csv",
        "stereo-crossings.csv",
    ];
    is_whole(made, &parts);
    let [holds, ..] = made.counts();
    assert!(holds > 15, "{holds} hold");
    latencies_stand_beside_formulas_with_their_seed(made);
    the_circuits_frames_are_timed(made);
    two_eyes_have_halves_or_all_nodes(made);
    the_papers_numbers_are_judged(made);
}

fn latencies_stand_beside_formulas_with_their_seed(made: &Made) {
    let rows = made.rows("figure-4.csv");
    // Five systems, with no primitives, with some, and with all that a quick look has.
    assert_eq!(rows.len(), 5 * 3);
    for cells in rows {
        let [formula, model] = [2, 4].map(|column| cells[column].parse::<f64>().unwrap());
        // Of so few primitives the filling of the pipe is much of it, but for the system that has none.
        assert!((1.0..1.3).contains(&(model / formula)), "{cells:?}");
        assert_eq!(cells[8], "1", "{cells:?}");
    }
}

fn the_circuits_frames_are_timed(made: &Made) {
    let rows: Vec<_> = made.lines("frames.csv").collect();
    // Two pictures, and four systems with 100 and 300 triangles; and one of them on half of the nodes.
    assert_eq!(rows.len(), 2 + 5 * 2);
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    for (row, cells) in rows.iter().enumerate() {
        let latency = number(row, cells.len() - 1);
        assert!(latency > number(row, 5) && latency < 3.0, "{cells:?}");
        assert_eq!(cells[4] == "–", !cells[0].contains("pre-sort"), "{cells:?}");
    }
    // Of the base system with one shader more triangles take more, and in more regions.
    assert!((number(2, 1), number(3, 1)) == (100.0, 300.0) && number(3, 2) > number(3, 1), "{rows:?}");
    assert!(number(3, 5) > number(2, 5), "{rows:?}");
    // So do they on half of the nodes, where each rasterizer has twice as many.
    assert!(rows[11][0].ends_with("half of the nodes") && number(11, 5) > 1.5 * number(5, 5), "{rows:?}");
}

fn two_eyes_have_halves_or_all_nodes(made: &Made) {
    let rows = made.rows("stereo-latency.csv");
    // 100 and 300 triangles of each eye, both ways.
    assert_eq!(rows.len(), 2 * 2);
    for cells in &rows {
        let [formula, circuit] = [2, 5].map(|column| cells[column].parse::<f64>().unwrap());
        // Arrays are 64 times smaller than the paper's.
        assert!(circuit > 0.1 && circuit < formula, "{cells:?}");
    }
    let crossings: Vec<_> = made.lines("stereo-crossings.csv").collect();
    // Five systems, of one sample and of eight.
    assert_eq!(crossings.len(), 5 * 2);
    let base = crossings.iter().find(|cells| cells[..2] == ["base 4", "one"]).unwrap();
    assert_eq!((&base[4][..], base[2].parse::<f64>().unwrap() < base[3].parse::<f64>().unwrap()), ("13849", true));
}

fn the_papers_numbers_are_judged(made: &Made) {
    let statements: Vec<_> = made.lines("statements.csv").map(|cells| cells.join(",")).collect();
    let verdict = |start: &str, end: &str| {
        let found = statements.iter().filter(|line| line.starts_with(start)).any(|line| line.ends_with(end));
        assert!(found, "{start} .. {end} in {statements:#?}");
    };
    verdict("PFL-TCB", "holds");
    verdict(
        "PFL-600K,The non-texturing system draws over 600 thousand primitives in 30 ms without antialiasing: formula",
        "holds",
    );
    verdict("PFL D1", "differs by 32 % (35 ms)");
    // A quick look does not come so far.
    verdict(
        "PFL-600K,The non-texturing system draws over 600 thousand primitives in 30 ms without antialiasing: model",
        "cannot be compared: nothing was found",
    );
    let checks: Vec<_> = made.lines("checks.csv").collect();
    assert!(checks.len() == 34 && checks.iter().all(|cells| cells.last().unwrap() == "holds"), "{checks:?}");
}
