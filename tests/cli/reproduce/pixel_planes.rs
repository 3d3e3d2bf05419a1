//! The page of Pixel-planes 5.

use super::{all_checks_hold, lines, rows, whole_page};
use crate::harness::Folder;

/// A page of so few vectors that it takes little time.
const QUICK: &str = "reproduce pixel-planes-5 -o report --vectors 60";

/// A report takes some seconds, so all is asked of one, and of one of another seed.
#[test]
fn a_report_is_whole() {
    let folder = Folder::new();
    its_page_is_whole_in_a_browser_and_its_data_is_beside_it(&folder);
    counts_stand_beside_formulas_with_their_seed(&folder);
    loads_are_within_their_bounds_and_those_of_the_circuit(&folder);
    times_are_above_their_bounds_and_those_of_the_circuit(&folder);
    folder.stdout("reproduce pixel-planes-5 -o other --vectors 60 --seed 2");
    for name in ["regions-45-degrees.csv", "load-of-vectors.csv", "vectors-load.csv"] {
        let [one, other] = ["report", "other"].map(|report| folder.read(format!("{report}/{name}")));
        assert_ne!(one, other, "{name}");
    }
}

fn its_page_is_whole_in_a_browser_and_its_data_is_beside_it(folder: &Folder) {
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
    let report = whole_page(folder, QUICK, &parts);
    assert!(report["holds"].as_u64().unwrap() > 10, "{report}");
    all_checks_hold(folder, 3 * 5, ",exactly 0,teapot,pixels that differ,,,RTL,0,,holds");
}

fn counts_stand_beside_formulas_with_their_seed(folder: &Folder) {
    for (name, places) in [("regions-45-degrees", 11), ("regions-50-pixels", 7), ("regions-by-side", 4)] {
        let rows = rows(folder, &format!("report/{name}.csv"));
        let counted: Vec<_> = rows.iter().filter(|cells| !cells[3].is_empty()).collect();
        assert_eq!(counted.len(), 3 * places, "{name}");
        for cells in counted {
            let [formula, count] = [2, 3].map(|column| cells[column].parse::<f64>().unwrap());
            // Of 60 vectors.
            assert!((count / formula - 1.0).abs() < 0.25, "{name}: {cells:?}");
            assert_eq!((cells[7].as_str(), cells[5].as_str()), ("1", ""), "{name}: {cells:?}");
        }
    }
    let printed = rows(folder, "report/regions-45-degrees.csv");
    assert!(printed.iter().any(|cells| cells[..2] == ["box", "50"] && cells[6] == "1.63"), "{printed:?}");
}

/// P_w between P/B and P R/B, of all scenes; of the frames drawn it is what the busiest renderer had.
fn loads_are_within_their_bounds_and_those_of_the_circuit(folder: &Folder) {
    let loads: Vec<_> = lines(folder, "report/loads.csv").collect();
    let number = |cells: &[String], column: usize| cells[column].parse::<f64>().ok();
    assert_eq!(loads.len(), 7);
    for cells in &loads {
        let [least, counted, greatest] = [4, 5, 7].map(|column| number(cells, column).unwrap());
        assert!(least <= counted && counted <= greatest, "{cells:?}");
    }
    let of = |name: &str| loads.iter().find(|cells| cells[0] == name).unwrap();
    assert_eq!(["one-each", "whole-screen"].map(|name| number(of(name), 6)), [Some(5.0), Some(400.0)]);
    for frame in lines(folder, "report/frames.csv") {
        assert_eq!(number(&frame, 3), number(of(&frame[0]), 6), "{frame:?}");
    }
    let drawing: Vec<f64> = lines(folder, "report/teapot-load.csv").map(|cells| cells[2].parse().unwrap()).collect();
    assert!(drawing.len() == 16 && drawing.iter().all(|part| (1.0..100.0).contains(part)), "{drawing:?}");
}

/// The paper's 239 ns; and no run is faster than the line of its ring, or the circuit than the model.
fn times_are_above_their_bounds_and_those_of_the_circuit(folder: &Folder) {
    let times = rows(folder, "report/time-by-renderers.csv");
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
    let waiting: Vec<f64> = rows(folder, "report/waiting.csv")
        .iter()
        .filter(|it| it[0] == "waiting")
        .map(|it| it[4].parse().unwrap())
        .collect();
    assert!(waiting.len() == 6 && waiting[5] > waiting[0], "{waiting:?}");
}
