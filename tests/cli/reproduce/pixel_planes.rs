//! The page of Pixel-planes 5.

use super::made::{Made, made};
use super::{all_checks_hold, is_whole};

/// A quick look, as the README has it.
const QUICK: &str = "pixel-planes-5 -o report/ --vectors 20";

#[test]
fn a_report_is_whole() {
    let made = made(QUICK);
    its_page_is_whole_in_a_browser_and_its_data_is_beside_it(made);
    counts_stand_beside_formulas_with_their_seed(made);
    loads_are_within_their_bounds_and_those_of_the_circuit(made);
    times_are_above_their_bounds_and_those_of_the_circuit(made);
}

fn its_page_is_whole_in_a_browser_and_its_data_is_beside_it(made: &Made) {
    let parts = [
        "regions-45-degrees.csv",
        "regions-15-degrees.csv",
        "regions-50-pixels.csv",
        "regions-400-pixels.csv",
        "regions-by-side.csv",
        "load-surfaces.csv",
        "load-lines.csv",
        "loads.csv",
        "balance.csv",
        "load-of-vectors.csv",
        "cycles.csv",
        "time-by-renderers.csv",
        "time-by-side.csv",
        "time-by-vectors.csv",
        "waiting.csv",
        "teapot-frame.png",
        "teapot-regions.png",
        "teapot-load.csv",
        "star-regions.png",
        "vectors-regions.png",
        "one-each-load.csv",
        "whole-screen-load.csv",
        "frames.csv",
    ];
    is_whole(made, &parts);
    let [holds, ..] = made.counts();
    assert!(holds > 10, "{holds} hold");
    all_checks_hold(made, 3 * 5, ",exactly 0,teapot,pixels that differ,,,RTL,0,,holds");
}

fn counts_stand_beside_formulas_with_their_seed(made: &Made) {
    for (name, places) in [("regions-45-degrees", 11), ("regions-50-pixels", 7), ("regions-by-side", 4)] {
        let rows = made.rows(&format!("{name}.csv"));
        let counted: Vec<_> = rows.iter().filter(|cells| !cells[3].is_empty()).collect();
        assert_eq!(counted.len(), 3 * places, "{name}");
        for cells in counted {
            let [formula, count] = [2, 3].map(|column| cells[column].parse::<f64>().unwrap());
            // Of 60 vectors.
            assert!((count / formula - 1.0).abs() < 0.25, "{name}: {cells:?}");
            assert_eq!((cells[7].as_str(), cells[5].as_str()), ("1", ""), "{name}: {cells:?}");
        }
    }
    let printed = made.rows("regions-45-degrees.csv");
    assert!(printed.iter().any(|cells| cells[..2] == ["box", "50"] && cells[6] == "1.63"), "{printed:?}");
}

/// P_w between P/B and P R/B, of all scenes; of the frames drawn it is what the busiest renderer had.
fn loads_are_within_their_bounds_and_those_of_the_circuit(made: &Made) {
    let loads: Vec<_> = made.lines("loads.csv").collect();
    let number = |cells: &[String], column: usize| cells[column].parse::<f64>().ok();
    assert_eq!(loads.len(), 7);
    for cells in &loads {
        let [least, counted, greatest] = [4, 5, 7].map(|column| number(cells, column).unwrap());
        assert!(least <= counted && counted <= greatest, "{cells:?}");
    }
    let of = |name: &str| loads.iter().find(|cells| cells[0] == name).unwrap();
    assert_eq!(["one-each", "whole-screen"].map(|name| number(of(name), 6)), [Some(5.0), Some(400.0)]);
    for frame in made.lines("frames.csv") {
        assert_eq!(number(&frame, 3), number(of(&frame[0]), 6), "{frame:?}");
    }
    let drawing: Vec<f64> = made.lines("teapot-load.csv").map(|cells| cells[2].parse().unwrap()).collect();
    assert!(drawing.len() == 16 && drawing.iter().all(|part| (1.0..100.0).contains(part)), "{drawing:?}");
}

/// The paper's 239 ns; and no run is faster than the line of its ring, or the circuit than the model.
fn times_are_above_their_bounds_and_those_of_the_circuit(made: &Made) {
    let times = made.rows("time-by-renderers.csv");
    let of = |name: &str| times.iter().filter(|cells| cells[0] == name).collect::<Vec<_>>();
    let paper = of("N = 94").into_iter().find(|cells| cells[1] == "16").unwrap();
    assert!(paper[2].starts_with("239.2") && paper[4].is_empty(), "{paper:?}");
    for ring in ["ample", "5 Gbit/s"] {
        assert_eq!(of(ring).len(), 6, "B = 1 to 32");
        for cells in of(ring) {
            let [bound, model] = [2, 4].map(|column| cells[column].parse::<f64>().unwrap());
            // Bins of few vectors are fewer or more than those of the formula.
            assert!(model > 0.8 * bound && cells[8] == "1", "{cells:?}");
        }
    }
    let on_circuit: Vec<_> = times.iter().filter(|cells| !cells[5].is_empty()).collect();
    assert!(on_circuit.len() == 1 && on_circuit[0][4] == on_circuit[0][5], "{on_circuit:?}");
    let waiting: Vec<f64> =
        made.rows("waiting.csv").iter().filter(|it| it[0] == "waiting").map(|it| it[4].parse().unwrap()).collect();
    assert!(waiting.len() == 6 && waiting[5] > waiting[0], "{waiting:?}");
}
